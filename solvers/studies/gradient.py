"""How figures of an impact follow the numbers of its scene, to first order."""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .. import validation
from ..accuracy.auto import Auto
from ..methods import METHODS, Waves
from ..methods.base import Method
from ..numerics.processors import all_processors
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.solution import Solution
from ..solve import read_method
from ..text.notes import Note, Severity, coded
from ..validation import SceneError, allowed
from .differences import Slopes, helps, judged, narrower, offsets, slopes
from .figures import FIGURES, asked_for, figures_of
from .sensitivity import plain
from .varied import unit_of, value_of

USUAL, USUAL_KEY = ("peak_force", "impactor_velocity", "contact_time"), "impactor.mass"
WIDEST, NARROWEST = 1e-2, 2e-5  # reach of the differences, of the number itself, of the speed of approach for speeds
WANTED, WANTED_OF_STEPS = 1e-5, 1e-3  # relative errors that suffice; the second one where the method marches by steps
FINER = 4  # times the steps of the method: derivatives of peaks are first order in them
MOST_KEYS, MOST_LOOKS = 100, 4


@dataclass(frozen=True, repr=False)
class Gradient:
    """Derivatives of figures by numbers of a scene. Those of figure and key are `found.value[figure][key]`, and so for
    `error`, `elasticity`, `unit`, `why` and `reach`; SI units.
    """

    method: dict[str, Any]
    figures: dict[str, float]  # of the scene itself, NaN where one does not exist
    at: dict[str, float]  # the numbers of the scene, by key
    value: dict[str, dict[str, float]]  # NaN: there is none here
    error: dict[str, dict[str, float]]  # of the differences, noise of the method with it, in units of the value
    elasticity: dict[str, dict[str, float]]  # d ln(figure) / d ln(key); NaN where either is zero
    unit: dict[str, dict[str, str]]
    why: dict[str, dict[str, Note | None]]  # there is none
    reach: dict[str, dict[str, float]]  # of the differences either way, in units of the key
    nearest: dict[str, tuple[float, float] | None]  # by key: distances between which contacts change
    solves: int
    notes: list[Note]
    wall_time: float
    title: str = ""  # of the scene

    def __str__(self) -> str:
        from ..notebook import tables

        return tables.gradient(self)

    def __repr__(self) -> str:
        return f"<Gradient of {', '.join(self.value)} by {', '.join(self.at)}: {self.title[:60]!r}>"

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.gradient_card(self)

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        why = {
            figure: {key: None if note is None else note.table() for key, note in notes.items()}
            for figure, notes in self.why.items()
        }
        rest = {name: value for name, value in vars(self).items() if name not in ("why", "notes", "title")}
        return plain(rest) | {"why": why} | coded(self.notes)


def gradient(
    scene: SceneOrName,
    of: str | Sequence[str] = USUAL,
    to: str | Sequence[str] = USUAL_KEY,
    method: str | Method | None = None,
    workers: int | None = None,
) -> Gradient:
    """Derivatives of the figures `of` an impact, names as in `Figures`, by the numbers `to` of its scene, keys as
    "contact.stiffness"; with the elasticity of each, by how many per cent the figure changes with one of the number.

    Central differences of order six within 1 % of the number (a velocity: of the speed of approach). Where the contacts
    are others there, or a figure follows no smooth course, within less, down to 2e-5 of it. Where they still are, a
    figure jumps or has a corner, or the scene allows the number on one side alone, the value is NaN and `why` says so.
    Every solve has the method of the middle one, its steps and its duration where it marches, and no estimate of the
    error unless `of` names it. `method`: the scene's own by default.
    Error: `error`, of the differences, with the noise of the method; of methods that march by steps what half the steps
    change, too, 1e-3 or less where contacts are few. What all solves share, such as too few modes, is not in it.
    Cost: six solves for each key, eight where the method marches, then with four times its steps; two more each time
    that a step is halved. On `workers` threads (as many as there are processors).
    Raises SceneError for figures and keys that do not exist, keys that take no numbers or whole ones alone, bodies in
    space; SceneNotSupported as `solve` does.
    """
    begun, scene = time.perf_counter(), scene_of(scene)
    if scene.normal is not None:
        raise SceneError("scene", scene.title, allowed("scenes-on-axis"))
    names = asked_for((of,) if isinstance(of, str) else of)
    keys = _keys(to)
    numbers = {key: _number(scene, key) for key in keys}
    middle = _Middle(scene, names, method)
    along = [_Along(middle, key, *numbers[key]) for key in keys]
    with all_processors(workers) as pool:
        wanted = [(each, number) for each in along if not each.bound for number in each.first_numbers()]
        list(pool.map(lambda pair: pair[0].row(pair[1]), wanted))
        found = dict(zip(keys, pool.map(_Along.follow, along), strict=True))
    by_figure = {
        field: {name: {key: getattr(found[key], field)[i] for key in keys} for i, name in enumerate(names)}
        for field in ("value", "error", "why", "reach")
    }
    figures = dict(zip(names, middle.row.tolist(), strict=True))
    at = {key: number for key, (number, _) in numbers.items()}
    value = by_figure["value"]
    return Gradient(
        middle.method.table(),
        figures,
        at,
        **by_figure,
        elasticity={
            name: {key: _elasticity(value[name][key], at[key], figures[name]) for key in keys} for name in names
        },
        unit={name: {key: unit_of_slope(FIGURES[name][0], unit_of(scene, key)) for key in keys} for name in names},
        nearest={each.key: each.nearest for each in along},
        solves=middle.solves + sum(each.solves for each in along),
        notes=[note for each in along for note in each.notes()],
        wall_time=time.perf_counter() - begun,
        title=scene.title,
    )


def unit_of_slope(figure: str, key: str) -> str:
    """Unit of a derivative, as "N/kg", "1/m" or "s/(m/s)"."""
    if not key or not figure:
        return f"1/{_bracketed(key)}" if key else figure
    return "" if figure == key else f"{figure}/{_bracketed(key)}"


def _bracketed(unit: str) -> str:
    return f"({unit})" if set(unit) & set("/ ") else unit


def _elasticity(slope: float, at: float, figure: float) -> float:
    return slope * at / figure if at and figure else math.nan


def _keys(to: str | Sequence[str]) -> list[str]:
    keys: list[Any] = list(dict.fromkeys(to if isinstance(to, (list, tuple)) else (to,)))
    validation.whole_number("number of keys", len(keys), 1, MOST_KEYS)
    for key in keys:
        if not isinstance(key, str) or key.partition(".")[0] not in ("impactor", "target", "contact"):
            raise SceneError("to", key, allowed("key-of-bodies"))
    return keys


def _number(scene: Scene, key: str) -> tuple[float, float]:
    """The number of the scene and what its changes are measured by. Raises SceneError if there is no such number."""
    number = value_of(scene, key)
    scene.replace({key: number})
    real = isinstance(number, (int, float)) and not isinstance(number, bool)
    scale = 0.0 if not real else scene.speed if unit_of(scene, key) == "m/s" else abs(number)
    if scale <= 0.0 or not any(_allowed(scene, key, number + side * NARROWEST * scale) for side in (-1.0, 1.0)):
        raise SceneError(key, number, allowed("differentiable"))
    return float(number), scale


def _allowed(scene: Scene, key: str, number: float) -> bool:
    try:
        scene.replace({key: number})
    except SceneError:
        return False
    return True


class _Middle:
    """The scene itself, solved; and how all beside it are."""

    def __init__(self, scene: Scene, names: Sequence[str], given: str | Method | None):
        self.scene, self.names = scene, names
        method, duration = read_method(scene.method, scene)
        if isinstance(given, Method):
            method = given
        elif given is not None and given != method.NAME:
            method, _ = read_method({"name": given}, scene)
        bare = method.without_estimate()
        first, self.solves = bare.solve(scene, duration), 1
        if isinstance(method, Auto):
            options = dict(first.method)
            method = METHODS[options.pop("name")].read(options)
            first, self.solves = method.without_estimate().solve(scene, duration), 2
        self.method = method if "estimated_error" in names else method.without_estimate()
        self.duration, self.coarser = duration, None
        if not isinstance(method, Waves) and hasattr(method, "steps"):
            self._keep_steps(first)
        solution = self.method.solve(scene, self.duration)
        self.solves += 1
        self.row, self.contacts = self.row_of(solution), _contacts(solution)

    def _keep_steps(self, first: Solution) -> None:
        """For all that is solved the same number of steps over the same time; half of them show what they miss."""
        options = {"steps": getattr(self.method, "steps", None)}
        if options["steps"] is None:
            options["steps"] = FINER * first.diagnostics["steps"]
        self.duration = first.duration
        self.method = replace(self.method, **options)
        self.coarser = replace(self.method, **{"steps": math.ceil(0.5 * options["steps"])})

    @property
    def wanted(self) -> float:
        return WANTED if self.coarser is None else WANTED_OF_STEPS

    def row_of(self, solution: Solution) -> np.ndarray:
        """The figures (figures,), NaN where one does not exist."""
        return np.array([math.nan if value is None else value for value in figures_of(solution, self.names)], float)

    def scales(self, key_scale: float) -> np.ndarray:
        """Of each figure over the key; of velocities the speed of approach over it."""
        speeds = np.array([self.scene.speed if FIGURES[name][0] == "m/s" else 0.0 for name in self.names])
        return np.maximum(np.nan_to_num(np.abs(self.row)), speeds) / key_scale


def _contacts(solution: Solution) -> tuple:
    """What may not change beside the scene: how many contacts there are, at joints too, and whether one is cut off."""
    contacts = solution.contacts
    cut = bool(contacts) and contacts[-1].end >= solution.duration * (1.0 - 1e-12)
    return len(contacts), tuple(len(joint) for joint in solution.joints), cut


@dataclass(frozen=True)
class _Found:
    """By one key, of each figure."""

    value: list[float]
    error: list[float]
    why: list[Note | None]
    reach: list[float]


class _Along:
    """The figures as one number of the scene changes; every number is solved once."""

    def __init__(self, middle: _Middle, key: str, at: float, scale: float):
        self.middle, self.key, self.at, self.scale = middle, key, at, scale
        self.rows: dict[float, np.ndarray | None] = {at: middle.row}
        self.refused: set[float] = set()  # numbers that the scene or the method does not allow
        self.same, self.changed = 0.0, math.inf  # largest distance with the same contacts, smallest with others
        self.solves = 0
        least = NARROWEST * scale
        self.bound = not all(_allowed(middle.scene, key, at + side * least) for side in (-1.0, 1.0))

    @property
    def nearest(self) -> tuple[float, float] | None:
        return None if math.isinf(self.changed) else (self.same, self.changed)

    def first_numbers(self) -> list[float]:
        return [self.at + offset for offset in offsets(WIDEST * self.scale)]

    def row(self, number: float) -> np.ndarray | None:
        """The figures there; None where the scene is refused, or its contacts are others."""
        if number not in self.rows:
            self.rows[number] = self._solved(number)
        return self.rows[number]

    def _solved(self, number: float) -> np.ndarray | None:
        try:
            solution = self._solution(number, self.middle.method)
        except SceneError:
            self.refused.add(number)
            return None
        self.solves += 1
        return self.middle.row_of(solution) if _contacts(solution) == self.middle.contacts else None

    def _solution(self, number: float, method: Method) -> Solution:
        return method.solve(self.middle.scene.replace({self.key: number}), self.middle.duration)

    def known(self, number: float) -> np.ndarray:
        """The same where there must be some."""
        row = self.row(number)
        assert row is not None
        return row

    def follow(self) -> _Found:
        """By the widest step within which the contacts are the same, and by smaller ones while that helps."""
        looks: list[Slopes] = []
        step, scale = WIDEST * self.scale, self.middle.scales(self.scale)
        exists = np.isfinite(self.middle.row)
        while not self.bound and step >= NARROWEST * self.scale and len(looks) < MOST_LOOKS:
            alike = self._alike(step)
            if all(alike):
                looks.append(slopes(self.known, self.at, step))
                if not helps(looks, scale, self.middle.wanted):
                    break
            step = narrower(alike, step)
        if not looks:
            note, nothing = self._note("contacts" if self.nearest else "bound", math.nan), [math.nan] * exists.size
            return _Found(nothing, nothing, [note] * exists.size, nothing)
        missed = self._missed_by_steps(looks[-1].step[0])
        looks = [replace(look, error=look.error + missed) for look in looks]
        best, why = judged(looks, scale, self.middle.wanted)
        why = ["missing" if not there else each for each, there in zip(why, exists, strict=True)]
        notes = [self._note(each, reach) for each, reach in zip(why, best.step.tolist(), strict=True)]
        there = np.array([not each for each in why])
        value, error = (np.where(there, each, math.nan).tolist() for each in (best.value, best.error))
        return _Found(value, error, notes, best.step.tolist())

    def _missed_by_steps(self, step: float) -> np.ndarray | float:
        """Twice by how much plain differences change with half the steps: peaks follow them by leaps."""
        if self.middle.coarser is None:
            return 0.0
        numbers = (self.at - step, self.at + step)
        below, above = (self.middle.row_of(self._solution(number, self.middle.coarser)) for number in numbers)
        self.solves += 2
        return np.abs((above - below) - (self.known(numbers[1]) - self.known(numbers[0]))) / step

    def _alike(self, step: float) -> list[bool]:
        """Whether nothing changes at each distance of the stencil, either way."""
        both = []
        for distance in offsets(step)[1::2]:
            numbers = (self.at - distance, self.at + distance)
            others = [number for number in numbers if self.row(number) is None]
            both.append(not others)
            if set(others) - self.refused:
                self.changed = min(self.changed, distance)
            elif not others:
                self.same = max(self.same, distance)
        self.same = self.same if self.same < self.changed else 0.0
        return both

    def notes(self) -> list[Note]:
        """That contacts change beyond what the differences have reached."""
        if self.nearest is None or not self.same:
            return []
        within, beyond = self.nearest
        values = {"key": self.key, "within": within, "beyond": beyond, "unit": self._unit()}
        return [Note("contacts-change-beside", Severity.REMARK, **values)]

    def _unit(self) -> str:
        return unit_of(self.middle.scene, self.key) or "none"

    def _note(self, why: str, reach: float) -> Note | None:
        values = {"key": self.key, "unit": self._unit()}
        if why == "contacts":
            return Note("contacts-change-here", Severity.WARNING, **values, beyond=self.changed)
        if why == "bound":
            return Note("one-side-allowed", Severity.WARNING, **values, at=self.at)
        if why == "jump":
            return Note("figure-jumps", Severity.WARNING, **values, reach=reach)
        if why == "corner":
            return Note("figure-has-corner", Severity.WARNING, **values, reach=reach)
        if why == "unsettled":
            return Note("differences-scatter", Severity.WARNING, **values, reach=reach)
        return Note("no-such-figure-here", Severity.REMARK) if why == "missing" else None
