"""Where step-by-step integrators keep the energy, chatter or fail: maps over step, stiffness, masses and more."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import validation
from ..contact.damping import LEAST_RESTITUTION
from ..contact.protocol import Damped
from ..methods import Modal
from ..methods.base import SceneNotSupported, never
from ..numerics.processors import all_processors
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..text.catalogue import library, spoken
from ..text.notes import Note, Severity, coded
from ..validation import SceneError, allowed
from .integrators import BOUND, DIVERGED, LASTING, Outcome
from .runs import INTEGRATORS, Problem, bound, damped, own_stiffness, problem_of, run

if TYPE_CHECKING:
    from ..notebook.plots import Drawn

USUAL_MODES = 20  # where neither the scene nor an axis says how many
NOT_RUN, CANNOT = 254, 255
SURE = 0.97  # of a limit by theory: failures below it are reported
UNSTABLE = "newmark-frozen"
THESIS_STIFFNESS = 100.0  # of an element, at which thesis 8.2 sees the solution diverge


@dataclass(frozen=True)
class Axis:
    """One thing that is varied; `values` (n,) in `unit`."""

    name: str
    unit: str
    values: np.ndarray
    log: bool


AXES = {  # usual range, whether by a constant factor
    "step": (0.03, 30.0, True),
    "contact_stiffness": (1e-2, 1e6, True),
    "mass_ratio": (1e-6, 1e6, True),
    "modes": (1, 1000, True),
    "restitution": (LEAST_RESTITUTION, 1.0, False),
    "speed": (1e-6, 1e3, True),
}


@dataclass(frozen=True)
class Map:
    """One integrator's runs; arrays (rows, columns) along the two axes.

    ending: 0 parted, 1 stopped at the bound of steps, 2 still at it after eight times the time expected, 3 more than
    doubled its energy; 254 not run (cancelled), 255 the integrator does not know the law, see `reason`. energy_error:
    the largest of the run, relative, signed; NaN where not run. chatter: touches of the raw force beyond the contacts.
    velocity: of the impactor at the end, over the speed of approach. limit_share: the step over the largest stable one
    by theory, 0 where every step is stable: its contour 1 is the limit, in the same axes.
    """

    integrator: str
    label: str
    limit_name: str
    ending: np.ndarray
    energy_error: np.ndarray
    chatter: np.ndarray
    velocity: np.ndarray
    steps: np.ndarray
    limit_share: np.ndarray
    limit: np.ndarray | None  # (columns,) largest stable step in units of the first axis, where that is the step
    reason: Note | None = None

    @property
    def failures(self) -> int:
        """Runs that grew past reason or did not part the bodies."""
        return int(np.sum((self.ending == DIVERGED) | (self.ending == LASTING)))

    @property
    def stopped(self) -> int:
        """Runs stopped at the bound of steps."""
        return int(np.sum(self.ending == BOUND))

    @property
    def worst_energy_error(self) -> float:
        """Of the runs that did not grow past reason."""
        kept = np.abs(self.energy_error[self.ending < DIVERGED])
        return float(kept.max()) if kept.size else math.nan

    def table(self) -> dict[str, Any]:
        """For JSON: plain lists, None for what is no number."""
        arrays = ("ending", "energy_error", "chatter", "velocity", "steps", "limit_share", "limit")
        words = {"integrator": self.integrator, "label": self.label, "limit_name": self.limit_name}
        found = {name: _plain(getattr(self, name)) for name in arrays}
        worst = {"failures": self.failures, "stopped": self.stopped, "worst_energy_error": self.worst_energy_error}
        worst = {key: _plain(value) for key, value in worst.items()}
        return words | found | worst | {"reason": self.reason and str(self.reason)}


@dataclass(frozen=True)
class Stability:
    """Maps of several integrators over the same two axes, rows along the first.

    `here` is where the scene itself lies on the axes; the step there is the default kernel's own. Runs are stopped
    after `bound` steps, fewer where an axis takes more modes.
    """

    scene: Scene
    axes: tuple[Axis, Axis]
    modes: int
    maps: dict[str, Map]
    here: tuple[float, float]
    bound: int
    notes: list[Note]

    def plot(self, integrator: str | None = None) -> "Drawn":
        """A HoloViews object over the two axes: the energy error of an integrator, or of all of `maps` one by one, its
        largest stable step and the scene itself. Runs that grew past reason, or did not end, have no colour.

        Raises SceneError for an integrator that was not run.
        """
        from ..notebook import plots  # loads HoloViews, which nothing else here needs

        return plots.stability(self, integrator)

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.stability_card(self)

    def table(self) -> dict[str, Any]:
        """For JSON."""
        axes = [
            {"name": axis.name, "unit": axis.unit, "log": axis.log, "values": axis.values.tolist()}
            for axis in self.axes
        ]
        return {
            "axes": axes,
            "modes": self.modes,
            "here": list(self.here),
            "bound": self.bound,
            "maps": [found.table() for found in self.maps.values()],
            **coded(self.notes),
        }


def stability(
    scene: SceneOrName,
    integrators: Sequence[str] | None = None,
    axes: Sequence[str] = ("step", "contact_stiffness"),
    grid: Sequence[int | Sequence[float]] = (40, 41),
    *,
    modes: int | None = None,
    most_steps: int | None = None,
    workers: int | None = None,
    cancel: Callable[[], bool] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Stability:
    """Maps of energy error, chatter and failure of each integrator over two axes.

    `axes`: two of step, contact_stiffness, mass_ratio, modes, restitution, speed; `grid`: for each the number of values
    over the usual range, or the values. Without the step as the first of them every run takes the default kernel's own.
    All integrators march the same kept modes (`modes`: as the scene's method says, or 20) under the same law from first
    touch until the bodies part; the default kernel, "modal", also lets the modes left out give way. The unit of contact
    stiffness of a rigid contact is 2 / pi^2 of that of the modes left out, which for a rod of N modes is that of one of
    N elements, E A N / L; a law is made stiffer with all of its dimensionless numbers kept. Restitution turns a law
    without damping into the one with damping and the same elastic part.
    `cancel()` true: what has not begun is not run. `progress(done, columns)` is called from the worker threads.
    Every run ends by itself: when no bulge can close the gap any more, or after eight times the time expected, or after
    `most_steps`, usually 100 000, fewer with more than 200 modes. Raises SceneError.
    Cost: 40 x 41 runs of six integrators with 20 modes take a few seconds on two cores; 1000 modes take minutes.
    """
    scene = scene_of(scene)
    names = [validation.choice("integrators", name, INTEGRATORS) for name in dict.fromkeys(integrators or INTEGRATORS)]
    first, second = _read_axes(scene, axes, grid)
    modes = _modes(scene) if modes is None else validation.whole_number("modes", modes, 1, 10_000)
    if most_steps is not None:
        validation.whole_number("most_steps", most_steps, 10, 10_000_000)
    asked = _Asked(scene, first, second, modes, names, most_steps, cancel or never)
    columns = _columns(asked, workers, progress)
    maps = {name: _map(name, number, first, columns) for number, name in enumerate(names)}
    own = problem_of(scene, {}, modes)
    found = Stability(scene, (first, second), modes, maps, _here(own, axes, modes), bound(own, most_steps), [])
    return replace(found, notes=_notes(found, own))


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return [_plain(item) for item in value.tolist()]
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


# --- what is asked for ------------------------------------------------------------------------------------------------


def _read_axes(scene: Scene, names: Sequence[str], grid: Sequence[int | Sequence[float]]) -> tuple[Axis, Axis]:
    names = tuple(names)
    check_axes(scene, names)
    if len(grid) != 2:
        raise SceneError("grid", grid, allowed("grid"))
    first, second = (_read_axis(name, given) for name, given in zip(names, grid, strict=True))
    return first, second


def check_axes(scene: Scene, names: Sequence[str]) -> None:
    """Raises SceneError for a scene that modes cannot solve, and for axes that do not go together, or with it."""
    held = scene.struck.impactor.held  # by a mechanism that strikes: integrators march what is free, or at rest
    refusal = Note("refusals.held-striker", Severity.REFUSAL) if held else Modal().refusal(scene)
    if refusal:
        raise SceneNotSupported("stability", scene.target.kind, refusal)
    if len(names) != 2 or names[0] == names[1]:
        raise SceneError("axes", names, allowed("two-axes", names=list(AXES)))
    for name in names:
        validation.choice("axes", name, AXES)
    if names[1] == "step":
        raise SceneError("axes", names, allowed("step-first"))
    if "restitution" in names and damped(scene.contact) is None:
        raise SceneError("axes", "restitution", allowed("no-damping-axis", law=scene.contact.NAME))
    if "mass_ratio" in names and not math.isfinite(scene.target.mass):
        raise SceneError("axes", "mass_ratio", allowed("no-mass-axis", target=scene.target.kind))


def _read_axis(name: str, given: int | Sequence[float]) -> Axis:
    low, high, log = AXES[name]
    given = validation.plain(given)
    if isinstance(given, int):
        count = validation.whole_number("grid", given, 2, 400)
        values = np.geomspace(low, high, count) if log else np.linspace(low, high, count)
    else:
        widest = (low * 1e-3, high * 1e3) if name in ("step", "contact_stiffness") else (low, high)
        values = np.array([validation.number(f"grid of {name}", float(value), *widest) for value in given])
    if name == "modes":
        values = np.unique(np.round(values))
    return Axis(name, library(spoken()).texts[f"name.axis-unit.{name}"], values, log)


def _modes(scene: Scene) -> int:
    for key in ("modes", "elements"):
        if key in scene.method:
            return validation.whole_number(f"method.{key}", scene.method[key], 1, 10_000)
    return USUAL_MODES


def _here(problem: Problem, axes: Sequence[str], modes: int) -> tuple[float, float]:
    scene = problem.scene
    law = scene.contact
    found = {
        "step": problem.usual_step / problem.step_unit,
        "contact_stiffness": own_stiffness(problem),
        "mass_ratio": scene.mass_ratio,
        "modes": float(modes),
        "restitution": law.delivered(scene.reduced_mass, scene.speed) if isinstance(law, Damped) else 1.0,
        "speed": scene.speed,
    }
    return found[axes[0]], found[axes[1]]


# --- runs -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Asked:
    scene: Scene
    first: Axis
    second: Axis
    modes: int
    names: list[str]
    most_steps: int | None
    cancelled: Callable[[], bool]

    def problem(self, row: float, column: float) -> Problem:
        values = {self.first.name: float(row), self.second.name: float(column)}
        return problem_of(self.scene, {name: value for name, value in values.items() if name != "step"}, self.modes)


@dataclass(frozen=True)
class _Cell:
    """What all integrators made of one point of the map; limits [rad of the highest kept mode]."""

    outcomes: list[Outcome | None]
    step: float
    limits: list[float]
    speed: float
    reasons: list[Note | None]


def _columns(asked: _Asked, workers: int | None, progress: Callable[[int, int], None] | None) -> list[list]:
    done = [0]

    def column(value: float) -> list[_Cell | None]:
        found = _column(asked, value)
        done[0] += 1
        if progress is not None:
            progress(done[0], asked.second.values.size)
        return found

    with all_processors(workers) as pool:
        return list(pool.map(column, asked.second.values))


def _column(asked: _Asked, value: float) -> list[_Cell | None]:
    """All runs of one column, None where cancelled."""
    found, problem = [], None
    for row in asked.first.values:
        if asked.cancelled():
            found.append(None)
            continue
        if problem is None or asked.first.name != "step":
            problem = asked.problem(row, value)
        step = float(row) * problem.step_unit if asked.first.name == "step" else problem.usual_step
        integrators = [INTEGRATORS[name] for name in asked.names]
        found.append(
            _Cell(
                [run(name, problem, step, asked.most_steps) for name in asked.names],
                step / problem.step_unit,
                [integrator.limit(problem) / problem.step_unit for integrator in integrators],
                problem.scene.speed,
                [integrator.why_not(problem) for integrator in integrators],
            )
        )
    return found


def _map(name: str, number: int, first: Axis, columns: list[list[_Cell | None]]) -> Map:
    shape = first.values.size, len(columns)
    ending, limit, reason = np.full(shape, NOT_RUN, np.uint8), np.full(shape[1], np.nan), None
    error, velocity, share = (np.full(shape, np.nan) for _ in range(3))
    chatter, steps = np.zeros(shape, np.int64), np.zeros(shape, np.int64)
    for j, column in enumerate(columns):
        for i, cell in enumerate(column):
            if cell is None:
                continue
            outcome, limit[j] = cell.outcomes[number], cell.limits[number]
            share[i, j], reason = cell.step / limit[j], reason or cell.reasons[number]
            ending[i, j] = CANNOT if outcome is None else outcome.ending
            if outcome is not None:
                error[i, j], velocity[i, j] = outcome.energy_error, outcome.velocity / cell.speed
                chatter[i, j], steps[i, j] = outcome.touches - outcome.contacts, outcome.steps
    long, bound_of = (library(spoken()).texts[f"name.integrator-{what}.{name}"] for what in ("long", "limit"))
    return Map(
        name, long, bound_of, ending, error, chatter, velocity, steps, share,
        limit if first.name == "step" else None, reason,
    )  # fmt: skip


# --- what the maps teach ----------------------------------------------------------------------------------------------


def _notes(found: Stability, own: Problem) -> list[Note]:
    notes = []
    if "modal" in found.maps:
        exact = found.maps["modal"]
        runs = int(np.sum(exact.ending < NOT_RUN))
        error = exact.worst_energy_error
        if math.isfinite(error):  # else nothing was run
            notes.append(Note("modal-keeps-energy", Severity.REMARK, failures=exact.failures, runs=runs, error=error))
    for each in found.maps.values():
        if each.reason:
            notes.append(
                Note("integrator-cannot", Severity.REFUSAL, integrators=[each.integrator], reason=each.reason.table())
            )
    impulsive = found.maps.get("moreau-jean")
    if impulsive is not None and impulsive.worst_energy_error > 1e-2 and not found.scene.contact.LOSSY:
        error = 100.0 * impulsive.worst_energy_error
        notes.append(Note("impulses-lose-energy", Severity.WARNING, error=error))
    early = [
        each.integrator for each in found.maps.values() if np.any(each.ending[each.limit_share < SURE] == DIVERGED)
    ]
    if early:
        notes.append(Note("fails-below-limit", Severity.WARNING, integrators=early))
    stopped = max((each.stopped for each in found.maps.values()), default=0)
    if stopped:
        notes.append(Note("runs-stopped", Severity.WARNING, runs=stopped, bound=found.bound))
    if UNSTABLE in found.maps and [axis.name for axis in found.axes] == ["step", "contact_stiffness"]:
        notes += _lesson(found, own)
    return notes


def _lesson(found: Stability, own: Problem) -> list[Note]:
    """The divergence of thesis 8.2, and what it is."""
    frozen, steps = found.maps[UNSTABLE], found.axes[0].values
    grown = frozen.ending == DIVERGED
    if not grown.any():
        return []
    share = 3.0 * frozen.limit_share  # omega_c * step
    column = int(np.argmin(np.abs(np.log(found.axes[1].values / THESIS_STIFFNESS))))
    factor, note = found.axes[1].values[column], []
    if found.scene.rigid_contact and grown[:, column].any():
        first = steps[grown[:, column]].min() * own.step_unit
        note = [Note("frozen-not-stiff", Severity.REMARK, stiffness=factor, step=first)]
    grows, least = int(grown.sum()), share[grown].min()
    return [Note("frozen-grows", Severity.REMARK, grown=grows, runs=grown.size, least=least), *note]
