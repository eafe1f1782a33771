"""What is left out where a mechanism keeps its configuration while it is struck, and by how much figures are off."""

from typing import Any

import numpy as np

from ..bodies import Mechanism
from ..scene import Scene
from ..solution.solution import Solution
from ..text.notes import Note, Severity

# Share by which velocities along the normal are off as the configuration turns, or for springs that are left out; with
# more the figures are uncertain.
MAX_LEFT_OUT, MAX_LEFT_OUT_LATER = 0.01, 0.05  # by the end of the contact, and of the time solved
SPRING_INSTANTS = 400  # of an impact, at which springs are looked at: their impulse to second order, 1e-5


def notes_on_freezing(solution: Solution, motion: Any) -> list[Note]:
    """What is left out, and by how much velocities are off for it; `motion`: a `mechanisms.MechanismMotion`."""
    return _turning_notes(solution, motion) + _spring_notes(solution, motion)


def _spring_notes(solution: Solution, motion: Any) -> list[Note]:
    """What springs would have given: of first order in their stiffness, by the motion without them.

    After a contact of a linear law (1/4 - 1/pi^2) (w t)^2 of the speed at which the struck point leaves, w being the
    frequency on the springs; with them it leaves some tenth less off.
    """
    frozen, springs = motion.frozen, motion.mechanism.springs
    lasts = solution.contacts[-1].end if solution.contacts else 0.0
    if not springs or not lasts or np.isinf(frozen.rigid_mass):
        return []
    instants = np.linspace(0.0, lasts, SPRING_INSTANTS)
    rows = np.array([frozen.system.opening(spring.joint) for spring in springs])
    stretch = np.trapezoid(motion.coordinates(instants) @ rows.T, instants, axis=0)
    pulls = np.array([spring.stiffness for spring in springs]) * stretch
    error = abs(float(pulls @ rows @ frozen.whole)) / frozen.rigid_mass / solution.scene.speed
    grave = Severity.REMARK if error <= MAX_LEFT_OUT else Severity.WARNING
    return [Note("springs-left-out", grave, springs=len(springs), error=100.0 * error)]


def _turning_notes(solution: Solution, motion: Any) -> list[Note]:
    """By how much the configuration turns meanwhile, and what that makes `whole`, in all the time solved."""
    lasts = solution.contacts[-1].end - solution.contacts[0].start if solution.contacts else 0.0
    spins = {name: abs(motion.frozen.system.spin(i, motion.frozen.rates)) for i, name in enumerate(motion.names)}
    fastest = max(spins, key=lambda name: spins[name])
    angle = spins[fastest] * lasts
    afterwards, most = _turned(motion, solution.duration)
    fastest = fastest if angle else most
    error = freezing_error(solution.scene, lasts, solution.impulse, angle)
    grave = Severity.REMARK if error <= MAX_LEFT_OUT else Severity.WARNING
    farthest = max(spins[fastest] * solution.duration, afterwards)
    whole = freezing_error(solution.scene, solution.duration, solution.impulse, farthest)
    late = whole > MAX_LEFT_OUT_LATER
    if not angle and not late:
        return []
    if late:
        grave = Severity.WARNING
    said = {"angle": float(np.degrees(angle)), "error": 100.0 * error, "whole": 100.0 * min(whole, 1.0), "late": late}
    return [Note("configuration-frozen", grave, link=fastest, **said)]


def _turned(motion: Any, until: float) -> tuple[float, str]:
    """By how much the link turns by a time [s] that turns most, thrown by the impact or as it falls; and its name."""
    turned = np.abs(
        motion.coordinates(np.array([until]))[0][np.array(motion.frozen.system.offsets)[: len(motion.names)] + 2]
    )
    return float(turned.max()), motion.names[int(turned.argmax())]


def freezing_error(scene: Scene, lasts: float, impulse: float, angle: float) -> float:
    """Of velocities along the normal over that of approach, if the configuration is kept while a contact lasts [s] and
    gives an impulse [N s], in which it turns by an angle.

    By the turn of the normal, and as what moves otherwise accelerates otherwise: right to a factor of two, see
    `tests/solvers/methods/multibody/test_contact_laws.py`.
    """
    gained = scene.target.known_as(Mechanism).frozen.acceleration_gained(impulse)
    return 0.5 * angle**2 + 0.5 * abs(gained) * lasts / scene.speed
