"""What a scene is opened with, as it shows what it is named after: its table `[view]`, read and refused key by key."""

from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

import param

from solvers import Scene, SceneError
from solvers.studies.levels import COUNTED, VALUES
from solvers.text.notes import Note
from solvers.validation import a_number, allowed, choice, flag, number, required, table, text

from .bodies import LONGEST as LONGEST_BODIES
from .choices import SCENES, Choices, accepts

IN_SPACE = ("hodograph", "course")  # charts of bodies there
CHARTS = ("waves", "force", "moments", "moved", "stress", "along", "support", "reactions", "energy", *IN_SPACE)
OF_LAW = ("force", "pressure", "radius")  # what the chart of the contact law shows over the indentation
BY_GAUGE = ("stress", "strain", "waves", "velocity", "displacement", "moment", "shear", "deflection")
READ = (*BY_GAUGE, *OF_LAW)
PICTURE = "picture"  # alone
TABS = (PICTURE, "controls", "charts", "story", "numbers", "analysis")
OF_NODES = ("coordinates",)  # of the view of a mode change, in place of velocities
FARTHEST, LONGEST = 1e6, 1e9  # [m], [s]
COMPARED = ("question", "first", "second", "alone")  # keys of a comparison
KEYS = ("charts", "place", "read", "time", "until", "views", "tab", "vary", "compare", "try")
MOST = 20  # entries of a list
LONGEST_WORD = 40  # letters of a key of the catalogue


class Comparison(NamedTuple):
    """A question of the catalogue, and two settings that answer it; `alone`: other than the scene has them, not than
    what is chosen. `between`: settings that are kept on the way from the first to the second."""

    question: str
    first: dict[str, Any]
    second: dict[str, Any]
    alone: bool = False
    between: tuple[dict[str, Any], ...] = ()

    @classmethod
    def of(cls, question: str, choice: str, *values: Any) -> "Comparison":
        """Of two or more values of one choice."""
        first, *between, second = ({choice: value} for value in values)
        return cls(question, first, second, between=tuple(between))


class Trial(NamedTuple):
    """What can be tried: words of the catalogue, and a choice with its value."""

    say: str
    choice: str
    value: Any


class Opening(NamedTuple):
    """Charts and views by their names in the stacks of the page and in `app.views.registry`."""

    charts: tuple[str, ...] = ()
    place: float | None = None  # of the figure, from the struck end [m]
    read: str | None = None  # the quantity that its gauge reads, or the chart of its contact law shows
    time: float | None = None  # that is shown, from the first touch on [s]
    until: float | None = None  # the part of the impact that is looked at, from the first touch on [s]
    views: tuple[str, ...] = ()
    tab: str | None = None  # of the dock that opens beside the picture
    varied: str = ""  # what the view of convergence varies, see `solvers.studies.levels`
    by: tuple[float, ...] = ()  # its values
    comparisons: tuple[Comparison, ...] = ()
    trials: tuple[Trial, ...] = ()

    @classmethod
    def of(cls, scene: Scene) -> "Opening":
        """Of a scene. Raises SceneError that names the key, the value and what is allowed."""
        given = table("view", scene.view, KEYS)
        varied = table("view.vary", given.get("vary", {}), (*COUNTED, *VALUES))
        if len(varied) > 1:
            raise SceneError("view.vary", dict(varied), allowed("one-varied"))
        kind = next(iter(varied), "")
        by = _list(f"view.vary.{kind}", varied.get(kind, []))
        for value in by:
            number(f"view.vary.{kind}", value, 0.0, LONGEST)
        compare, tries = (enumerate(_list(f"view.{name}", given.get(name, [])), 1) for name in ("compare", "try"))
        return cls(
            charts=_names("view.charts", given.get("charts", []), (*CHARTS, *OF_NODES)),
            place=_number("view.place", given.get("place"), FARTHEST, "m"),
            read=_option("view.read", given.get("read"), READ),
            time=_number("view.time", given.get("time"), LONGEST, "s"),
            until=_number("view.until", given.get("until"), LONGEST, "s"),
            views=_names("view.views", given.get("views", [])),
            tab=_option("view.tab", given.get("tab"), TABS),
            varied=kind,
            by=tuple(by),
            comparisons=tuple(_comparison(n, each) for n, each in compare),
            trials=tuple(_trial(n, each) for n, each in tries),
        )

    @property
    def _tab(self) -> str | None:
        """Of the dock that opens, if any does."""
        usual = "analysis" if self.views else "charts" if self.charts else PICTURE
        tab = self.tab or usual
        return None if tab == PICTURE else tab

    def table(self) -> dict[str, Any]:
        """What the browser needs of it."""
        return {
            "charts": [name for name in self.charts if name in CHARTS],
            "place": self.place,
            "read": self.read,
            "tab": self._tab,
            "time": self.time,
            "until": self.until,
            "compare": [each._asdict() for each in self.comparisons],
            "trials": [list(each) for each in self.trials],
        }


@lru_cache(maxsize=512)
def opening_of(scene: str) -> Opening:
    """Of a scene; nothing for most, for another name, and for what a visitor's own says that cannot be."""
    try:
        return Opening.of(SCENES[scene])
    except (KeyError, ValueError):
        if scene in SCENES:
            raise
        return Opening()


def _comparison(number: int, given: object) -> Comparison:
    key = f"view.compare[{number}]"
    read = table(key, given, COMPARED)
    first, second = (_settings(f"{key}.{name}", read.get(name, {})) for name in ("first", "second"))
    return Comparison(_word(key, read, "question"), first, second, flag(f"{key}.alone", read.get("alone", False)))


def _settings(key: str, given: object) -> dict[str, Any]:
    return {name: _chosen(f"{key}.{name}", name, value) for name, value in table(key, given, Choices.CHOSEN).items()}


def _trial(number: int, given: object) -> Trial:
    key = f"view.try[{number}]"
    read = table(key, given, Trial._fields)
    name = choice(f"{key}.choice", read.get("choice"), Choices.CHOSEN)
    return Trial(_word(key, read, "say"), name, _chosen(f"{key}.value", name, read.get("value")))


def _chosen(key: str, name: str, value: object) -> Any:
    if not accepts(name, value):
        raise SceneError(key, value, possible(Choices.param[name]))
    return value


def possible(parameter: Any) -> Note:
    """What a choice, by its parameter, may be."""
    if isinstance(parameter, param.Selector):
        return allowed("choice", options=list(parameter.objects))
    if not isinstance(parameter, param.Number):
        return allowed("text", longest=LONGEST_BODIES)
    bounds: Any = parameter.bounds
    low, high = bounds
    return allowed("whole-number", low=low, high=high) if isinstance(parameter, param.Integer) else a_number(low, high)


def _word(key: str, given: Mapping[str, Any], name: str) -> str:
    return text(f"{key}.{name}", required(key, given, name, allowed("text", longest=LONGEST_WORD)), LONGEST_WORD)


def _list(key: str, value: object) -> list[Any]:
    if not isinstance(value, list) or len(value) > MOST:
        raise SceneError(key, value, allowed("list-up-to", most=MOST))
    return value


def _names(key: str, value: object, options: Iterable[str] | None = None) -> tuple[str, ...]:
    given = enumerate(_list(key, value), 1)
    return tuple(
        text(f"{key}[{n}]", each) if options is None else choice(f"{key}[{n}]", each, options) for n, each in given
    )


def _option(key: str, value: object, options: Iterable[str]) -> str | None:
    return None if value is None else choice(key, value, options)


def _number(key: str, value: object, high: float, unit: str) -> float | None:
    return None if value is None else number(key, value, 0.0, high, unit)
