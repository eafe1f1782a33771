"""The front that sets out as faces of rods meet: until a wave is back that adds to it no contact force exceeds it, and
between rigid faces that is the force, whatever a method makes of it."""

import math
from typing import Any

import numpy as np

from ..bodies import AnyBody, Mechanism, RotatingRod, Waveguide
from ..scene import Scene
from ..solution.motion import ResolvesForce
from ..solution.solution import Solution
from ..text.notes import Note, Severity

OF_RIGID = "front-ripples"
OF_LAW = "law-ripples"
RIPPLES = {OF_RIGID, OF_LAW}  # codes of its notes
LEAST_RIPPLE = 0.01  # of the force of the front; less is not reported
INSTANTS = 2_000  # at which the force behind the front is looked at, of which it takes in some tens of ripples


def front_force(scene: Scene) -> float | None:
    """Of the first front [N]: v Z1 Z2 / (Z1 + Z2), what is no rod having no end of it; None if no rod meets end on.

    Between rigid faces. A law by which they give way comes to that from below: F = Z (v - d') with d' >= 0 until it
    parts or a wave is back.
    """
    fronts = [found for body in (scene.impactor, scene.target) if (found := _front(body)) is not None]
    if not fronts or scene.prescribed_force:
        return None
    return scene.speed / sum(1.0 / impedance for impedance, _ in fronts)


def ripple(solution: Solution) -> float | None:
    """By what share of it the largest force that a solution has until then is off the front's; of a law,
    how far it is above, if it is.

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
    falling = max(scene.weight_acceleration, 0.0) / scene.speed
    peaks = [(each.peak_force or 0.0, each.end) for each in solution.contacts if each.end <= until]
    off = max(found / (force * (1.0 + falling * at)) for found, at in [*zip(shown, times, strict=True), *peaks]) - 1.0
    return float(off if scene.rigid_contact else max(off, 0.0))


def notes_on_ripple(solution: Solution) -> list[Note]:
    """By how much a sum of modes or elements is off behind a front, where it is."""
    share = ripple(solution)
    if share is None or abs(share) < LEAST_RIPPLE:
        return []
    values = {"force": front_force(solution.scene), "share": 100.0 * abs(share)}
    if solution.scene.rigid_contact:
        return [Note(OF_RIGID, Severity.WARNING, **values, over=share > 0.0)]
    return [Note(OF_LAW, Severity.WARNING, **values)]


def _front(body: AnyBody) -> tuple[float, float] | None:
    """Impedance of the end that meets the other body [kg/s], and when a wave that adds to the force is first back [s]:
    what a free end sends back takes away from it."""
    if body.rods:
        first, *others = body.rods
        trip, last = first.round_trip_time, first
        for rod, joint in zip(others, body.known_as(Waveguide).joints, strict=True):
            if not joint.bonded or not math.isclose(rod.impedance, first.impedance, rel_tol=1e-9):
                return first.impedance, trip
            trip, last = trip + rod.round_trip_time, rod
        return first.impedance, trip * (2.0 if last.support == "free" and not last.end_mass else 1.0)
    if isinstance(body, RotatingRod) and not body.across:
        wave_speed = (body.material.young / body.material.density) ** 0.5
        return body.impedance, 2.0 * body.length / wave_speed
    return None


def _has_fronts_unlike(body: Any) -> bool:
    if isinstance(body, Mechanism):
        return body.flexible
    return getattr(body, "theory", None) == "timoshenko"
