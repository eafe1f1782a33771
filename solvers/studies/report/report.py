"""One impact as a page for others: what is known of a design, and how well."""

import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, overload, runtime_checkable

from ...accuracy.auto import Auto
from ...accuracy.report import CHOSEN
from ...methods.base import Method
from ...provenance import version
from ...scene import Scene
from ...scenes.library import SceneOrName, scene_names, scene_of, to_toml
from ...scenes.link import query_of
from ...solution.solution import Solution
from ...solve import chosen_method
from ...text.notes import Note, Severity, coded
from ...validation import SceneError, allowed
from ..figures import LOOKED_FOR, asked_for
from ..study.study import Progress
from ..uncertain import USUAL_SAMPLES, Uncertain, uncertain
from ..varied import with_values
from .inputs import Input, inputs_of
from .numbers import USUAL, Number, as_asked, finer_solution, numbers_of
from .page import FILE, address, checked, save
from .study import StudyReport, study_report

if TYPE_CHECKING:
    from .pictures import Curves, Field

USUALLY = {"points": USUAL_SAMPLES, "seed": 0}


@dataclass(frozen=True, repr=False)
class Report:
    """One impact as a page of paper; a notebook shows it. SI units."""

    scene: Scene
    solution: Solution
    inputs: list[Input]
    numbers: list[Number]
    pictures: list["Curves | Field"]
    uncertain: Uncertain | None  # within the tolerances of inputs, where there are any
    why: str  # the method: asked, scene, usual or auto
    finer: str  # what the errors are found by, see `Finer.by`; closed, or none
    version: str  # of the library and its sources
    query: str | None  # by which the page opens the scene; None where it is too long for a link
    page: str  # the address of a page; "" where none is named
    asked: Mapping[str, Any]  # how it was asked for: name, file, changes, tolerances, figures, method, points, seed

    @property
    def notes(self) -> list[Note]:
        """Of the solution, its largest values and the spread; without why the method was chosen, if that is well."""
        found = [*self.solution.notes, *self.solution.peaks.remarks, *(self.uncertain.notes if self.uncertain else ())]
        kept = [note for note in found if note.code != CHOSEN or note.severity is not Severity.REMARK]
        order = list(Severity)
        return sorted(dict.fromkeys(kept), key=lambda note: -order.index(note.severity))

    @property
    def chosen(self) -> Note | None:
        """Why `auto` took this method."""
        return next((note for note in self.solution.notes if note.code == CHOSEN), None)

    @property
    def toml(self) -> str:
        """The scene as a scene file."""
        return to_toml(self.scene)

    @property
    def file(self) -> str:
        """What the scene file is called, that the page has with it."""
        return self.asked["file"]

    @property
    def laws(self) -> list[tuple[str, str]]:
        """Tolerances by key, as they were given in words, or in those of their distribution."""
        given, said = self.asked["tolerances"] or {}, self.uncertain.inputs if self.uncertain else {}
        keys = [key if isinstance(key, str) else ",".join(key) for key in given]
        return [
            (key, law if isinstance(law, str) else said[",".join(map(str.strip, key.split(",")))])
            for key, law in zip(keys, given.values(), strict=True)
        ]

    @property
    def command(self) -> str:
        """The line that makes the report again."""
        asked, method = self.asked, self.asked["method"]
        words = ["impact", "report", asked["name"] or self.file]
        changes = dict(asked["changes"])
        if isinstance(method, Method):
            changes |= {f"method.{key}": value for key, value in method.table().items() if value is not None}
        words += [part for key, value in changes.items() for part in ("--set", f"{key}={_word(value)}")]
        words += [part for key, law in self.laws for part in ("--tolerance", f"{key}={law}")]
        words += [part for name in asked["figures"] or () for part in ("--figure", name)]
        words += ["--method", method] if isinstance(method, str) else []
        if self.uncertain:
            other = [key for key, usual in USUALLY.items() if asked[key] != usual]
            words += [part for key in other for part in (f"--{key}", str(asked[key]))]
        return " ".join(map(shlex.quote, words))

    @property
    def python(self) -> str:
        """The lines that do the same in Python."""
        asked = self.asked
        given = {
            "changes": dict(asked["changes"]),
            "tolerances": dict(self.laws) or None,
            "figures": asked["figures"] and list(asked["figures"]),
        }
        method = asked["method"]
        words = [repr(asked["name"] or self.file), *(f"{name}={value!r}" for name, value in given.items() if value)]
        words += [f"method={'solvers.' if isinstance(method, Method) else ''}{method!r}"] if method else []
        if self.uncertain:
            words += [f"{key}={asked[key]}" for key, usual in USUALLY.items() if asked[key] != usual]
        return f'import solvers\nsolvers.report({", ".join(words)}).save("report.html")'

    def html(self) -> str:
        """A page that needs nothing else: no network, no script; A4 where it is printed."""
        from ...notebook import sheet

        return sheet.page(self)

    def save(self, path: str | Path) -> Path:
        """Write `html()` to a file that ends in .html, in place of one that is there. Raises SceneError for another
        name, or a folder that is not there; OSError where it cannot be written."""
        checked(path)
        return save(self.html(), path)

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        spread = self.uncertain.table()["figures"] if self.uncertain else {}
        figures = {each.name: each.table() | {"spread": spread.get(each.name)} for each in self.numbers}
        inputs = [
            {"key": each.key, "tolerance": each.tolerance, "follows": each.follows}
            | {"values": {one.name: {"value": one.value, "unit": one.unit} for one in each.values}}
            for each in self.inputs
        ]
        known = {"title": self.scene.title, "method": self.solution.method, "inputs": inputs, "figures": figures}
        known |= {"version": self.version, "link": self.query, "command": self.command}
        return known | coded(self.notes)

    def _repr_html_(self) -> str:
        from ...notebook import sheet

        return sheet.article(self)

    def __repr__(self) -> str:
        return f"<Report: {self.scene.title[:60]!r} by {self.solution.method['name']}>"


@runtime_checkable
class Labelled(Protocol):
    """Labelled arrays with attributes, as an xarray.Dataset."""

    @property
    def attrs(self) -> Any: ...

    @property
    def data_vars(self) -> Any: ...


@overload
def report(scene: Labelled, *, figures: Sequence[str] | None = None, page: str = "") -> StudyReport: ...


@overload
def report(
    scene: SceneOrName,
    tolerances: Mapping[Any, Any] | None = None,
    figures: Sequence[str] | None = None,
    method: str | Method | None = None,
    *,
    changes: Mapping[str, Any] | None = None,
    points: int = USUAL_SAMPLES,
    seed: int = 0,
    workers: int | None = None,
    page: str = "",
    progress: Callable[[Progress], Any] | None = None,
) -> Report: ...


def report(
    scene: SceneOrName | Labelled,
    tolerances: Mapping[Any, Any] | None = None,
    figures: Sequence[str] | None = None,
    method: str | Method | None = None,
    *,
    changes: Mapping[str, Any] | None = None,
    points: int = USUAL_SAMPLES,
    seed: int = 0,
    workers: int | None = None,
    page: str = "",
    progress: Callable[[Progress], Any] | None = None,
) -> Report | StudyReport:
    """One impact, or a study, as one page of A4, to hand on: inputs, the model and its limits, pictures, figures,
    warnings, the version, a link, and how to do it again.

    `tolerances`, `points`, `seed`, `workers`, `progress` as of `uncertain`: the spread of `figures`, or of the usual
    ones that need no search; else none. `figures`: names as in `Figures`. `changes`: other values of the scene, by key.
    `page`: the address of a page, to which the link then leads.
    Error of each figure: what the method leaves in it, by its own estimate or by twice the difference to a solution
    with twice its resolution; None where neither is known. What the model leaves out is said in words.
    Of the Dataset of a `study` in place of a scene: what was varied, the usual picture of the first figure, the least,
    median and largest value of each and where they are, refusals and notes by their kinds; `figures` and `page` alone
    go with it.
    Cost: the solve, a finer one, and with tolerances those of `uncertain`; of a study none.
    Raises SceneError as `solve` and `uncertain` do, for a `page` that is no address, for what goes with a scene alone
    where there is a study, and for figures that the study does not have.
    """
    of_scene = (tolerances, figures, method, changes, points, seed, workers, page, progress)
    if not isinstance(scene, Labelled):
        return _report(scene, *of_scene)
    usual = {"tolerances": None, "method": None, "changes": None, "workers": None} | USUALLY
    given = {"tolerances": tolerances, "method": method, "changes": changes, "workers": workers}
    for name, value in (given | {"points": points, "seed": seed}).items():
        if value != usual[name]:
            raise SceneError(name, value, allowed("nothing-beside", other="study"))
    return study_report(scene, figures, page)


def _report(
    scene: SceneOrName,
    tolerances: Mapping[Any, Any] | None,
    figures: Sequence[str] | None,
    method: str | Method | None,
    changes: Mapping[str, Any] | None,
    points: int,
    seed: int,
    workers: int | None,
    page: str,
    progress: Callable[[Progress], Any] | None,
) -> Report:
    """Of one impact."""
    from .pictures import pictures_of  # whose names of histories only those who draw load

    found, changes = scene_of(scene), dict(changes or {})
    name = scene if isinstance(scene, str) and scene in scene_names() else None
    file = FILE
    if not isinstance(scene, Scene) and not (name and changes):
        file = f"{name or Path(scene).stem}.toml"
    found = with_values(found, changes) if changes else found
    names = None if figures is None else asked_for(figures)
    page = address(page)
    chosen, duration = chosen_method(found, method)
    solution = chosen.solve_in_full(found, duration)
    finer = finer_solution(solution)
    numbers = as_asked(solution, names, numbers_of(solution, names or USUAL, finer))
    spread = None
    if tolerances:
        free = [each.name for each in numbers if names or each.name not in LOOKED_FOR]
        spread = uncertain(found, tolerances, free, points, seed, method, workers, progress)
    changes = {} if name is None else changes  # which the file has in it
    asked = {
        "name": name,
        "file": file,
        "changes": changes,
        "tolerances": tolerances,
        "figures": names,
        "method": method,
    }
    asked |= {"points": points, "seed": seed}
    closed = solution.method["name"] == "rigid"
    return Report(
        found, solution, inputs_of(found, spread.inputs if spread else {}), numbers, pictures_of(solution), spread,
        _why(found, chosen, method), finer.by if finer else "closed" if closed else "none", version(),
        query_of(found, None if changes else name), page, asked,
    )  # fmt: skip


def _why(scene: Scene, chosen: Method, method: object) -> str:
    """Whose choice the method was."""
    if isinstance(chosen, Auto):
        return "auto"
    return "asked" if method is not None else "scene" if scene.method.get("name") else "usual"


def _word(value: Any) -> str:
    """As `--set` reads it."""
    if isinstance(value, bool):
        return str(value).lower()
    return str(list(value)) if isinstance(value, (list, tuple)) else str(value)
