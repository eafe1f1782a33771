"""The front that sets out as rigid faces of rods meet: its force is known exactly, whatever a method makes of it."""

from typing import Any

import numpy as np

from ..bodies import AnyBody, Mechanism, RotatingRod
from ..scene import Scene
from ..solution.motion import ResolvesForce
from ..solution.solution import Solution
from ..text.notes import Note, Severity

RIPPLES = "front-ripples"  # code of its note
LEAST_RIPPLE = 0.01  # of the force of the front; less is not reported
INSTANTS = 2_000  # at which the force behind the front is looked at, of which it takes in some tens of ripples


def front_force(scene: Scene) -> float | None:
    """Of the first front in a rigid contact [N]: v Z1 Z2 / (Z1 + Z2), what is no rod having no end of it.

    None where the faces give way, or no rod meets the other body end on.
    """
    fronts = [found for body in (scene.impactor, scene.target) if (found := _front(body)) is not None]
    if not fronts or not scene.rigid_contact or scene.prescribed_force:
        return None
    return scene.speed / sum(1.0 / impedance for impedance, _ in fronts)


def ripple(solution: Solution) -> float | None:
    """By what share of it the largest force that a solution tells of before anything comes back is off the front's.

    None where that is not known: see `front_force`; links that bend, and shear in beams, have fronts of their own.
    """
    scene, motion = solution.scene, solution.motion
    bodies: tuple[Any, Any] = scene.impactor, scene.target
    force = None if scene.normal is not None else front_force(scene)
    unknown = any(_has_fronts_unlike(body) for body in bodies)
    if force is None or unknown or motion is None or not solution.contacts:
        return None
    until = min(found[1] for body in bodies if (found := _front(body)) is not None)
    times = np.linspace(0.0, min(until, solution.duration), INSTANTS)
    shown = motion.resolved_force(times) if isinstance(motion, ResolvesForce) else solution.known_motion.force(times)
    return float(np.max(shown)) / force - 1.0


def notes_on_ripple(solution: Solution) -> list[Note]:
    """By how much a sum of modes or elements is off behind a front, where it is."""
    share = ripple(solution)
    if share is None or abs(share) < LEAST_RIPPLE:
        return []
    values = {"force": front_force(solution.scene), "share": 100.0 * abs(share), "over": share > 0.0}
    return [Note(RIPPLES, Severity.WARNING, **values)]


def _front(body: AnyBody) -> tuple[float, float] | None:
    """Impedance of the end that meets the other body [kg/s], and when a wave is back there at first [s]."""
    if body.rods:
        return body.rods[0].impedance, body.rods[0].round_trip_time
    if isinstance(body, RotatingRod) and not body.across:
        wave_speed = (body.material.young / body.material.density) ** 0.5
        return body.impedance, 2.0 * body.length / wave_speed
    return None


def _has_fronts_unlike(body: Any) -> bool:
    if isinstance(body, Mechanism):
        return body.flexible
    return getattr(body, "theory", None) == "timoshenko"
