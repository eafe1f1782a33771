"""Figures of a solution, each with what its numbers are off by: from its own estimate, or from a finer solution."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from ...bodies import Mechanism
from ...methods.estimates import LEFT_BY_MODES
from ...methods.fronts import RIPPLES
from ...solution.solution import Solution
from ...solve import CHOICES
from ...text.notes import Severity
from ...validation import SceneError
from ..figures import FIGURES, LOOKED_FOR

USUAL = (
    "peak_force", "contacts", "contact_time", "impulse", "impactor_velocity", "target_velocity", "newton",
    "peak_indentation", "residual_indentation", "dissipated", "peak_displacement", "peak_deflection", "peak_stress",
    "peak_support_force",
)  # fmt: skip
REFINED = ("modes", "elements", "steps")  # options of which twice as many are finer
LOOKED = 1e-3  # of a largest value over place and time: how closely it is looked for, see `Solution.peaks`
SAME_MOMENTUM = 1e-6  # of the impulse: the momentum that it changes is the same but for rounding
FINER_TOLERANCE, LEAST_TOLERANCE = 1e-2, 1e-13  # of waves: so much of the own one; the least that they take
FORCES = ("peak_force", "peak_acceleration")  # which ripples behind a front make wrong, however many modes there are
INSIDE = ("peak_stress", "peak_tension", "peak_moment", "peak_support_force")
BY_METHOD = "peaks-by-method"  # the note on these
ILL = {
    "ill-conditioned-mass",
    "ill-conditioned-mesh",
    "switching-ill-conditioned",
    "balances-chaotic",
    "sensitive-chain",
}
CLOSED = ("waves", "rigid")  # methods whose estimate holds for all figures: nothing in them is cut off


@dataclass(frozen=True)
class Number:
    """One figure: its value, and the error that the method leaves in it. SI units."""

    name: str
    unit: str
    value: Any  # a number, a vector of bodies in space, None where the impact has no such figure
    error: float | None  # of its numbers; None: not known
    finer: Any = None  # the same of the finer solution
    noted: bool = False  # a note says that no difference to a finer solution is its error

    def table(self) -> dict[str, Any]:
        """As plain values."""
        value = list(self.value) if isinstance(self.value, tuple) else self.value
        return {"value": value, "unit": self.unit, "error": self.error}


class Finer(NamedTuple):
    """Another solution of the same impact, and what makes it finer."""

    solution: Solution
    by: str  # modes, elements or steps: twice as many; links: of them; tolerance: a hundredth of it


def numbers_of(solution: Solution, names: Sequence[str], finer: Finer | None) -> list[Number]:
    """These figures; with what a `finer` solution says of their errors, where there is one."""
    found, unsettled = [], _unsettled(solution)
    for name in names:
        unit, figure = FIGURES[name]
        value, beside = figure(solution), None if finer is None else figure(finer.solution)
        noted = name in unsettled
        error = None if value is None or noted else _error(solution, name, value, beside)
        found.append(Number(name, unit, value, error, beside, noted))
    return found


def _unsettled(solution: Solution) -> set[str]:
    """Figures that may be off by more than a finer solution shows, as notes say: ripples behind a front do not shrink
    with more modes, and a sequence of contacts that is ill-conditioned becomes another one."""
    notes = {note.code: note for note in (*solution.notes, *solution.peaks.remarks)}
    if any(note.severity is Severity.INVALID for note in notes.values()):
        return set(FIGURES)
    if notes.keys() & ILL:
        return set(FIGURES) - {"impactor_velocity"}
    found = {*FORCES, *INSIDE} if notes.keys() & RIPPLES else set()
    return found | set(INSIDE) if BY_METHOD in notes else found


def _error(solution: Solution, name: str, value: Any, beside: Any) -> float | None:
    """Of the velocity of the impactor as the method itself estimates it; of other figures twice the difference to the
    finer solution, as of an error that falls with the first power of the resolution."""
    estimate = solution.diagnostics["estimated_error"]
    if name in ("energy_error", "momentum_error", "estimated_error"):
        return None
    if name == "impactor_velocity" and estimate is not None:
        return estimate * solution.scene.meeting_speed
    size = max(map(abs, value)) if isinstance(value, tuple) else abs(value)
    looked = LOOKED * size if name in LOOKED_FOR else 0.0
    least = estimate * size if estimate is not None and solution.method["name"] in CLOSED else 0.0
    carried = _carried(solution, name, estimate)
    least = max(least, carried or 0.0)
    if beside is not None and not isinstance(value, tuple):
        return max(LEFT_BY_MODES * abs(beside - value), least) + looked
    if solution.method["name"] == "rigid" and estimate is not None:
        return least
    return carried


def _carried(solution: Solution, name: str, estimate: float | None) -> float | None:
    """What the estimate for the velocity of the impactor means for a figure that follows from it, where it does."""
    scene = solution.scene
    if estimate is None or scene.normal is not None or scene.prescribed_force:
        return None
    if not (scene.impactor.free_mass or _moves_as_one_mass(solution)):
        return None
    speed = estimate * scene.meeting_speed
    moved = 0.0 if scene.target.held else 1.0 / scene.mass_ratio  # of the target, for one of the impactor
    follows = {"newton": (1.0 + moved) * estimate, "impulse": scene.impactor.mass * speed}
    return (follows | {"target_velocity": moved * speed}).get(name)


def _moves_as_one_mass(solution: Solution) -> bool:
    """Whether the impulse is the change of the impactor's momentum, as of a free body that rings."""
    impactor = solution.scene.impactor
    changed = impactor.mass * (impactor.velocity - solution.impactor_velocity)
    return abs(changed - solution.impulse) <= SAME_MOMENTUM * abs(solution.impulse)


def finer_solution(solution: Solution) -> Finer | None:
    """The same impact by the same method with twice its modes, elements or steps; waves with a hundredth of their
    tolerance. None where no resolution makes it finer, or the method takes no more."""
    scene, options = solution.scene, {name: value for name, value in solution.method.items() if value is not None}
    kind = CHOICES[options.pop("name")]
    duration = scene.method.get("duration")
    try:
        if isinstance(scene.struck.target, Mechanism):
            flexible = scene is scene.struck and scene.target.known_as(Mechanism).flexible
            if not flexible or "modes" not in kind.RESOLUTIONS:
                return None
            most = max(options.get("modes") or 0, scene.refined.target.known_as(Mechanism).most_modes)
            method = kind.read(options | {"modes": most}).without_estimate()
            return Finer(method.solve(scene.refined, duration), "links")
        for name in kind.RESOLUTIONS:
            if name in REFINED and options.get(name):
                method = kind.read(options | {name: 2 * options[name]}).without_estimate()
                return Finer(method.solve(scene, duration), name)
        if "tolerance" in kind.RESOLUTIONS:
            tolerance = max(FINER_TOLERANCE * options["tolerance"], LEAST_TOLERANCE)
            return Finer(kind.read(options | {"tolerance": tolerance}).solve(scene, duration), "tolerance")
    except SceneError:  # it takes no more
        return None
    return None


def as_asked(solution: Solution, names: Sequence[str] | None, numbers: Sequence[Number]) -> list[Number]:
    """Without the usual figures that this impact does not have, or that are zero as nothing is there to be lost."""
    if names is not None:
        return list(numbers)
    held = solution.scene.target.held or not solution.scene.target.mass < float("inf")
    empty = ("residual_indentation", "dissipated", *(["target_velocity"] if held else []))
    kept = []
    for each in numbers:
        if each.value is None or (each.name in empty and not _some(each.value)):
            continue
        kept.append(each)
    if any(each.name == "peak_deflection" for each in kept):
        kept = [each for each in kept if each.name != "peak_displacement"]
    return [replace(each, error=None) if each.name == "contacts" else each for each in kept]


def _some(value: Any) -> bool:
    return any(value) if isinstance(value, tuple) else bool(value)
