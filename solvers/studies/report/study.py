"""A study as a page for others: what was varied, how far its figures reach and where, and what was refused."""

import json
import shlex
import tomllib
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from ... import validation
from ...methods import usual_method
from ...methods.base import Method
from ...scene import Scene
from ...scenes.library import as_given, built_in, scene_names
from ...scenes.link import query_of
from ...solve import CHOICES, chosen_method
from ...text.catalogue import SOURCE
from ...validation import SceneError, allowed
from ..figures import FIGURES, asked_for
from ..study.design import MOST_POINTS
from ..study.plot import drawing
from ..varied import unit_of
from .again import study_words
from .inputs import Input, inputs_of
from .page import FILE, address, checked, save
from .reaches import Kind, Reach, Varied, reach_of, shown_of, varied_of

MADE_BY = ("scene", "method", "figures")  # attributes that, beside the design, make another study of it
LOOKED_AT = 33  # points all over it, of which methods and laws are named
SCATTERED = 2  # keys, of which one scatter has both
VARIED = "varied"  # in place of a tolerance


@dataclass(frozen=True, repr=False)
class StudyReport:
    """A study as a page of paper; a notebook shows it. SI units."""

    dataset: Any
    scene: Scene
    varied: list[Varied]
    inputs: list[Input]  # of the scene, those that are not varied
    methods: list[Mapping[str, Any]]  # with their options, of some points all over it
    laws: list[str]  # of contact, likewise
    why: str  # the method: asked, varied, scene or usual
    reaches: list[Reach]
    more: list[str]  # figures that are there, too
    empty: list[str]  # figures that were asked for, and that no point has
    counts: Mapping[str, int]  # points, solved, refused, waiting
    refusals: list[Kind]
    notes: list[Kind]
    error: Reach | None  # of the impactor's velocity, of its speed, as methods estimate it
    query: str | None  # by which the page opens the scene; None where it is too long for a link
    page: str
    asked: Mapping[str, Any] = field(default_factory=dict)  # name of the scene file, and figures

    @property
    def design(self) -> Mapping[str, Any]:
        """How its points were chosen: vary, sample, points, seed."""
        return json.loads(self.dataset.attrs["design"])

    @property
    def version(self) -> str:
        """Of the library and its sources by which it was solved."""
        return str(self.dataset.attrs.get("version", "")).removeprefix("Strikewave ")

    @property
    def fingerprint(self) -> str:
        """Twelve letters, the same for the same scene, design, method and figures."""
        about = self.dataset.attrs
        design = json.loads(about["design"], parse_int=float)  # in which 2 is 2.0
        made = json.dumps([design, *(about.get(name, "") for name in MADE_BY)])
        return sha256(made.encode()).hexdigest()[:12]

    @property
    def file(self) -> str:
        """What the scene file is called, that the page has with it."""
        return self.asked["file"]

    @property
    def toml(self) -> str:
        """The scene as a scene file, with the method that was asked for."""
        given, table = json.loads(self.dataset.attrs.get("method", "null")), self.scene.method
        if given is None or given == (table.get("name") or usual_method(self.scene)):
            return as_given(self.scene)
        kept = {name: value for name, value in table.items() if name == "duration"}
        kept |= {"name": given} if isinstance(given, str) else {"name": given["name"]} | _options(given)
        return as_given(self.scene.replace({"method": kept}))

    @cached_property
    def _words(self) -> dict[str, str] | None:
        shares = {
            each.keys[0]
            for each in self.varied
            if each.law and any(other != each.values[0] for other in each.values[1:])
        }
        return study_words(self.scene, self.design, shares)

    @property
    def command(self) -> str | None:
        """The lines that make the study, then its report; None where a value has no words for a command."""
        if self._words is None:
            return None
        design = self.design
        out = str(Path(self.file).with_suffix(".nc"))
        words = ["impact", "study", self.file]
        words += [part for key, said in self._words.items() for part in ("--vary", f"{key}={said}")]
        if design["sample"] != "grid":
            words += ["--sample", design["sample"], "--points", str(design["points"]), "--seed", str(design["seed"])]
        words += [part for name in self._figures or () for part in ("--figure", name)]
        words += [] if self.notes_looked_for else ["--no-notes"]
        shown = [part for name in self.asked["figures"] or () for part in ("--figure", name)]
        return f"{shlex.join([*words, '--out', out])}\n{shlex.join(['impact', 'report', out, *shown])}"

    @property
    def python(self) -> str | None:
        """The lines that do the same in Python."""
        if self._words is None:
            return None
        design = self.design
        words = [repr(self.file), repr(self._words)]
        if design["sample"] != "grid":
            words += [f"{name}={design[name]!r}" for name in ("sample", "points", "seed")]
        words += [f"figures={self._figures!r}"] if self._figures else []
        words += [] if self.notes_looked_for else ["notes=False"]
        shown = f", figures={list(self.asked['figures'])!r}" if self.asked["figures"] else ""
        study = f"study = solvers.study({', '.join(words)})"
        return f'import solvers\n{study}\nsolvers.report(study{shown}).save("report.html")'

    @property
    def _figures(self) -> list[str] | None:
        """Those that were asked for; None for the usual ones."""
        figures = self.dataset.attrs["figures"].split()
        return None if figures == list(asked_for(None)) else figures

    @property
    def notes_looked_for(self) -> bool:
        """Whether the study has asked for them."""
        return self.dataset.attrs.get("notes") != "not looked for"

    def picture(self) -> bytes | None:
        """Of the first figure that is shown, as SVG: the usual one, but one scatter of points drawn by chance, and of
        more than two keys which of them it follows. None where no point has a figure. Raises ImportError without the
        extra `plot`."""
        if not self.reaches:
            return None
        figure, keys = self.reaches[0].name, [key for each in self.varied for key in each.keys]
        if "point" not in self.dataset.sizes:
            return drawing(self.dataset, figure)
        if len(keys) > SCATTERED:
            with suppress(SceneError):  # too few points
                return drawing(self.dataset, figure, kind="bars")
        return drawing(self.dataset, figure, x=keys[0])

    def html(self) -> str:
        """A page that needs nothing else: no network, no script; A4 where it is printed. Raises as `picture`."""
        from ...notebook import study_sheet

        return study_sheet.page(self)

    def save(self, path: str | Path) -> Path:
        """Write `html()`, as `Report.save` does."""
        checked(path)
        return save(self.html(), path)

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        varied = [each.table() for each in self.varied]
        sample = {name: self.design[name] for name in ("sample", "seed")}
        known: dict[str, Any] = {"title": self.scene.title, "varied": varied} | sample | dict(self.counts)
        known |= {"methods": [dict(each) for each in self.methods], "laws": self.laws}
        known |= {"figures": {each.name: each.table() for each in self.reaches}, "more": self.more}
        known |= {"refusals": [each.table() for each in self.refusals], "notes": [each.table() for each in self.notes]}
        known |= {"estimated_error": self.error and self.error.table(), "version": self.version}
        return known | {"fingerprint": self.fingerprint, "link": self.query, "command": self.command}

    def _repr_html_(self) -> str:
        from ...notebook import study_sheet

        return study_sheet.article(self)

    def __repr__(self) -> str:
        return f"<StudyReport: {self.scene.title[:60]!r}, {self.counts['points']} points>"


def study_report(
    dataset: Any, figures: Sequence[str] | None = None, page: str = "", name: str | None = None
) -> StudyReport:
    """See `report`; `name`: what the scene file is called. Raises SceneError for what is no study, one that nobody can
    hold, and figures that it does not have."""
    from ...notebook import study_plots, study_tables  # load HoloViews, which nothing else here needs

    scene, there = _known(dataset)
    if isinstance(figures, str):
        raise SceneError("figures", figures, allowed("choice", options=there))
    names = None if figures is None else list(dict.fromkeys(_one_of(each, there) for each in figures))
    dataset = study_plots.gridded(dataset)
    dataset = _with_units(dataset, scene)
    known = study_tables.summary(dataset)
    varied = varied_of(dataset)
    shown, more = shown_of(there, names, known["figures"], sum(len(each.keys) for each in varied))
    methods, laws = _solved_by(dataset, scene)
    keys = {key for each in varied for key in each.keys}
    error = known["figures"].get("estimated_error")
    return StudyReport(
        dataset, scene, varied, _inputs(scene, keys), methods, laws, _why(dataset, scene, keys),
        [reach_of(dataset, each, known["figures"][each]) for each in shown], more,
        [name for name in names or () if name not in known["figures"]],
        {each: known[each] for each in ("points", "solved", "refused", "waiting")},
        [Kind(each["code"], each["points"], each["reason"], each["at"]) for each in known["refusals"]],
        [Kind(code, count, known["sentences"].get(code, code), known["noted_at"][code])
         for code, count in known["notes"].items()],
        None if error is None else reach_of(dataset, "estimated_error", error),
        query_of(scene, _built_in(scene)), address(page), {"file": name or FILE, "figures": names},
    )  # fmt: skip


def _known(dataset: Any) -> tuple[Scene, list[str]]:
    """The scene of a study, and its figures. Raises SceneError for what has not all that a study writes."""
    try:
        points = int(json.loads(dataset.attrs["design"])["points"])
        tables = tomllib.loads(dataset.attrs["scene"])
        there = [str(each) for each in dataset.attrs["figures"].split() if each in dataset]
        size = dataset.refused.size
    except (AttributeError, KeyError, TypeError, ValueError):
        raise SceneError("study", type(dataset).__name__, allowed("study-dataset")) from None
    if size != points:
        raise SceneError("study", f"{size} points", allowed("study-whole", points=points))
    if size > MOST_POINTS:
        raise SceneError("study", f"{size:.3g} points", allowed("report-points", most=MOST_POINTS))
    return Scene.from_table(tables), there


def _built_in(scene: Scene) -> str | None:
    """The name of a built-in scene that is the same; there are some two hundred, read in half a second."""
    return next((name for name in scene_names() if built_in(name, SOURCE) == scene), None)


def _one_of(name: str, there: Sequence[str]) -> str:
    return validation.choice("figures", name, there)


def _with_units(dataset: Any, scene: Scene) -> Any:
    """With the units that tables of rows do not keep."""
    units = {name: unit for name, (unit, _) in FIGURES.items() if name in dataset}
    units |= {str(key): unit_of(scene, str(key)) for key in dataset.coords if key != "point"}
    named = {
        name: dataset[name].assign_attrs({"units": unit, "long_name": name.replace("_", " ")})
        if name in FIGURES
        else dataset[name].assign_attrs(units=unit)
        for name, unit in units.items()
        if "units" not in dataset[name].attrs
    }
    return dataset.assign({name: array for name, array in named.items() if name in FIGURES}).assign_coords(
        {name: array for name, array in named.items() if name not in FIGURES}
    )


def _solved_by(dataset: Any, scene: Scene) -> tuple[list[Mapping[str, Any]], list[str]]:
    """Methods and laws of contact at some points all over it."""
    from ...notebook import study_tables

    given = json.loads(dataset.attrs.get("method", "null"))
    methods: dict[str, Mapping[str, Any]] = {}
    laws = []
    for point in sorted({round(share * (dataset.refused.size - 1)) for share in np.linspace(0.0, 1.0, LOOKED_AT)}):
        values = {key: _plain(value) for key, value in study_tables.at(dataset, point).items()}
        try:
            found = scene.replace(values)
            asked = CHOICES[given["name"]].read(_options(given)) if isinstance(given, Mapping) else given
            table = _table_of(chosen_method(found, asked)[0])
        except SceneError:
            continue
        methods.setdefault(json.dumps(table, sort_keys=True), table)
        laws.append(found.contact.NAME)
    return list(methods.values()), list(dict.fromkeys(laws))


def _table_of(method: Method) -> Mapping[str, Any]:
    """With what makes it finer, and its model."""
    kept = ("name", "model", *method.RESOLUTIONS)
    return {name: value for name, value in method.table().items() if name in kept and value is not None}


def _options(method: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in method.items() if name != "name" and value is not None}


def _plain(value: Any) -> Any:
    """A table that stands as words is one again."""
    return json.loads(value) if isinstance(value, str) and value.startswith("{") else value


def _why(dataset: Any, scene: Scene, keys: set[str]) -> str:
    if any(key.partition(".")[0] == "method" for key in keys):
        return VARIED
    if json.loads(dataset.attrs.get("method", "null")) is not None:
        return "asked"
    return "scene" if scene.method.get("name") else "usual"


def _inputs(scene: Scene, keys: set[str]) -> list[Input]:
    """What is given of the scene and not varied; what follows from it is another one at each point."""
    marked = {}
    for row in inputs_of(scene, {}):
        marked |= {key: VARIED for key in keys if row.key and (key == row.key or key.startswith(f"{row.key}."))}
    return [row for row in inputs_of(scene, marked) if not row.follows and not row.tolerance]
