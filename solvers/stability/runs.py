"""One run of an integrator on a scene: the scene with other values, the step's limit by theory, the bound of steps."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ..contact import HuntCrossley, KelvinVoigt, LeeWang, Linear
from ..contact.duration import steepest_stiffness
from ..contact.protocol import OfPower
from ..methods import Modal
from ..methods.modal.march import default_step
from ..methods.modal.pair import Pair
from ..numerics.modal_contacts import LEAST_OPENING
from ..numerics.oscillators import Residual, oscillator_bank
from ..scene import Scene
from ..text.notes import Note, Severity
from . import integrators
from .integrators import BOUND, LASTING, Limits, Outcome, Rows

MAX_EXPECTED_TIMES = 8.0  # times what the impact is expected to last, after which a run has failed to part the bodies
MOST_STEPS, MOST_WORK = 100_000, 20_000_000  # of one run, and steps times modes; where more is needed it says so
FROZEN_LIMIT = 3.0  # of omega_c * step; measured, see `tests/solvers/stability/test_maps.py`


class Problem(NamedTuple):
    """A scene as the integrators take it, before the step is chosen."""

    scene: Scene
    pair: Pair
    law: Any
    residual: float  # [m/N]
    rows: Rows
    stiffness: float  # the largest that the contact reaches [N/m]
    expected: float  # how long the impact may last [s]
    quiet: float  # how long the bodies must be apart [s]
    usual_step: float  # [s]

    @property
    def mobility(self) -> float:
        """Rate of closing that a unit impulse takes away [1/kg]."""
        return float(self.rows.mobility.sum())

    @property
    def step_unit(self) -> float:
        """One rad of the highest kept mode [s], or of the contact spring where no body rings."""
        kept = self.pair.frequencies
        return 1.0 / float(kept.max()) if kept.size else 1.0 / math.sqrt(self.stiffness * self.mobility)


@dataclass(frozen=True)
class Integrator:
    """How a run is made, and up to which step theory says that it is stable."""

    limit: Callable[["Problem"], float]  # [s]
    run: Callable[["Problem", float, Limits], Outcome]
    why_not: Callable[["Problem"], Note | None] = lambda problem: None


# --- scenes as problems -----------------------------------------------------------------------------------------------


def _unit_stiffness(pair: Pair) -> float:
    """About that of an element [N/m]: of a rod of N modes, E A N / L."""
    return 2.0 / math.pi**2 / pair.residual_compliance


def own_stiffness(problem: Problem) -> float:
    """Where the scene lies on the axis of stiffness: the rigid contact of `modal` is that of the modes left out."""
    return math.pi**2 / 2.0 if problem.scene.rigid_contact else 1.0


def _stiffer(scene: Scene, pair: Pair, factor: float) -> Scene:
    """The scene with a contact so many times stiffer: a rigid one has the stiffness of an element."""
    if scene.rigid_contact:
        return replace(scene, contact=Linear(factor * _unit_stiffness(pair)))
    return replace(scene, contact=_same_impact_stiffer(scene.contact, factor))


def _same_impact_stiffer(law: Any, factor: float) -> Any:
    """F'(a) = s F(s a), s^2 = factor: the same collision, s times as quick, its restitution and yield kept."""
    scale = math.sqrt(factor)
    return law.scaled(scale, 1.0, 1.0 / scale)


def damped(law: Any) -> type[Any] | None:
    """The law with damping that has the same elastic part."""
    if law.LOSSY:
        return type(law)
    return {"rigid": KelvinVoigt, "linear": KelvinVoigt, "hertz": HuntCrossley, "power": LeeWang}.get(law.NAME)


def _with_restitution(scene: Scene, pair: Pair, restitution: float) -> Scene:
    law = scene.contact
    unit = _unit_stiffness(pair) if pair.residual_compliance else 0.0
    table = {"stiffness": unit if scene.rigid_contact else law.stiffness}
    if isinstance(law, OfPower):
        table["exponent"] = law.exponent
    kind = damped(law)
    assert kind is not None  # `check_axes` refuses others
    return replace(scene, contact=kind.read(table | {"restitution": restitution}, scene.impactor, scene.target))


def problem_of(scene: Scene, values: Mapping[str, float], modes: int) -> Problem:
    """The scene with these values of the axes; the step is chosen later."""
    changes, scene = {}, scene.struck
    if "mass_ratio" in values:
        changes |= scene.impactor.of_mass(scene.target.mass / values["mass_ratio"])
    if "speed" in values:
        changes |= scene.impactor.of_velocity(scene.target.velocity + values["speed"])
    changes = {f"impactor.{key}": value for key, value in changes.items()}
    scene = scene.replace(changes) if changes else scene  # first of all: what follows is no longer in its tables
    kept = int(values.get("modes", modes))
    scene = scene.with_modes(kept).at_contact
    pair = Modal(modes=kept).pair(scene)
    if "restitution" in values:
        scene = _with_restitution(scene, pair, values["restitution"])
    if "contact_stiffness" in values:
        scene = _stiffer(scene, pair, values["contact_stiffness"])
    law, residual = pair.law(scene)
    softness = (pair.at_contact / pair.frequencies) ** 2
    give = float(softness.sum()) + pair.residual_compliance
    steepest = steepest_stiffness(law, scene.reduced_mass, scene.speed)
    parts = [part for part in (pair.impactor, pair.target) if part.frequencies.size]
    slowest = [2.0 * math.pi / float(part.frequencies[0]) for part in parts]
    touch = math.pi * math.sqrt(scene.reduced_mass * (give + 4.0 / steepest))
    return Problem(
        scene, pair, law, residual,
        integrators.rows(pair.frequencies, pair.at_contact, pair.impactor.rigid_mass, pair.target.rigid_mass),
        steepest, sum(slowest) + touch, max(slowest, default=touch), default_step(scene, pair),
    )  # fmt: skip


# --- runs -------------------------------------------------------------------------------------------------------------


def bound(problem: Problem, most_steps: int | None) -> int:
    """Steps after which a run is stopped: `most_steps`, or what may be spent on a run of so many modes."""
    return most_steps or max(1_000, min(MOST_STEPS, MOST_WORK // problem.rows.squares.size))


def run(name: str, problem: Problem, step: float, most_steps: int | None = None) -> Outcome | None:
    """One run, and how it ends: stopped at the bound, or failed to part the bodies in all the time they could need.

    None if the integrator does not know the law.
    """
    integrator = INTEGRATORS[name]
    if integrator.why_not(problem):
        return None
    most, needed = bound(problem, most_steps), math.ceil(MAX_EXPECTED_TIMES * problem.expected / step)
    peak = problem.scene.speed * math.sqrt(problem.stiffness * problem.scene.reduced_mass)
    opening = LEAST_OPENING * problem.pair.residual_compliance * peak
    quiet = max(2, math.ceil(problem.quiet / step))
    outcome = integrator.run(problem, step, Limits(quiet, min(max(needed, 2 * quiet), most), opening))
    return outcome._replace(ending=LASTING) if outcome.ending == BOUND and needed <= most else outcome


def _exact(problem: Problem, step: float, limits: Limits) -> Outcome:
    """As `modal` marches."""
    law, pair = problem.law, problem.pair
    settling = min(0.5, step / pair.resolved_time) if problem.residual and (law.JUMPS or law.PLASTIC) else 0.0
    bank = oscillator_bank(pair.frequencies, pair.at_contact, step)
    return _run_bank(problem, Residual(problem.residual, settling, law.JUMPS), step, bank, limits)


def _implicit(problem: Problem, step: float, limits: Limits) -> Outcome:
    """Newmark's rule turns every oscillator by 2 atan(omega step / 2)."""
    pair = problem.pair
    turning = 2.0 / step * np.arctan(0.5 * step * pair.frequencies)
    bank = oscillator_bank(pair.frequencies, pair.at_contact, step, turning)
    return _run_bank(problem, Residual(0.0), step, bank, limits)


def _run_bank(problem: Problem, residual: Residual, step: float, bank: Any, limits: Limits) -> Outcome:
    impactor, target = problem.pair.impactor, problem.pair.target
    return Outcome(*integrators.run_exact(
        problem.law, residual, impactor.rigid_mass, target.rigid_mass, step, bank, problem.scene.speed, limits
    ))  # fmt: skip


def _run(problem: Problem, integrator: Any, rigid: bool, step: float, limits: Limits) -> Outcome:
    return integrators.run(integrator, problem.law, rigid, problem.rows, step, problem.scene.speed, limits)


def _central_difference(problem: Problem, step: float, limits: Limits) -> Outcome:
    law = problem.law
    return _run(problem, integrators.CentralDifference(step, problem.rows, law.LOSSY), False, step, limits)


def _runge_kutta(problem: Problem, step: float, limits: Limits) -> Outcome:
    return _run(problem, integrators.RungeKutta(step, problem.rows), False, step, limits)


def _frozen(problem: Problem, step: float, limits: Limits) -> Outcome:
    rule = integrators.trapezoid(problem.rows, step)
    return _run(problem, integrators.FrozenNewmark(rule), False, step, limits)


def _moreau_jean(problem: Problem, step: float, limits: Limits) -> Outcome:
    law, scene = problem.law, problem.scene
    restitution = law.delivered(scene.reduced_mass, scene.speed) if law.LOSSY else 0.0
    rule = integrators.trapezoid(problem.rows, step)
    return _run(problem, integrators.MoreauJean(rule, restitution, law.LOSSY), True, step, limits)


def _highest(problem: Problem) -> float:
    return integrators.highest_frequency(problem.rows, problem.stiffness)


def _no_plastic_law(problem: Problem) -> Note | None:
    return Note("refusals.impulses-of-plastic-law", Severity.REFUSAL) if problem.law.PLASTIC else None


def _endless(problem: Problem) -> float:
    return math.inf


INTEGRATORS = {
    "modal": Integrator(_endless, _exact),
    "newmark": Integrator(_endless, _implicit),
    "newmark-frozen": Integrator(
        lambda problem: FROZEN_LIMIT / math.sqrt(problem.stiffness * problem.mobility), _frozen
    ),
    "central-difference": Integrator(lambda problem: 2.0 / _highest(problem), _central_difference),
    "rk4": Integrator(lambda problem: 2.0 * math.sqrt(2.0) / _highest(problem), _runge_kutta),
    "moreau-jean": Integrator(_endless, _moreau_jean, _no_plastic_law),
}
