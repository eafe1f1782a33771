"""What a report draws of a solution, as plain arrays: the contact force over time, and what runs through the bodies."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...bodies import Mechanism
from ...notebook.figures import FIELDS, HISTORIES, STRIKING, histories_of, reach
from ...solution.motion import ResolvesForce, knows_field
from ...solution.solution import Solution

INSTANTS, PLACES = 361, 161  # of a field
POINTS = 601  # of a curve that is sampled
AFTER = 1.15  # of the time to the last parting that is shown
BINS = 700  # of a history with more instants than the picture has points across


@dataclass(frozen=True)
class Curves:
    """Histories of one unit; contacts are shaded."""

    name: str  # force, velocity or displacement
    unit: str
    lines: Mapping[str, tuple[np.ndarray, np.ndarray]]  # by whose it is: time [s] and values
    spans: tuple[tuple[float, float], ...]  # of contacts [s]
    until: float  # [s]


@dataclass(frozen=True)
class Field:
    """Values (time, x) over the time and the length of the bodies."""

    name: str  # stress or deflection
    unit: str
    time: np.ndarray  # [s]
    x: np.ndarray  # [m]
    values: np.ndarray
    bends: bool  # places are measured from the first support, else from the struck end


def pictures_of(solution: Solution) -> list[Curves | Field]:
    """Two, or none of bodies in space, which have no history."""
    if solution.motion is None or not solution.duration > 0.0:
        return []
    until = _until(solution)
    found: list[Curves | Field] = []
    if solution.contact_time > 0.0 and solution.peak_force:
        found.append(_force(solution, until))
    field = _field(solution, until)
    found += [field] if field is not None else [_velocities(solution, until)]
    if len(found) < 2:
        found.append(_positions(solution, until))
    return found


def _until(solution: Solution) -> float:
    last = max((contact.end for contact in solution.contacts), default=0.0)
    return min(AFTER * last, solution.duration) if solution.contact_time > 0.0 else solution.duration


def _spans(solution: Solution, until: float) -> tuple[tuple[float, float], ...]:
    return tuple((each.start, min(each.end, until)) for each in solution.contacts if each.start < until)


def _force(solution: Solution, until: float) -> Curves:
    """Every jump and every peak is kept; of a force that chatters also the resolved one, whose peak is the figure."""
    time, force = solution.time, solution.force
    inside = time <= until
    instants = np.unique(time[inside])
    time, force = _thinned(time[inside], force[inside])
    lines = {"contact": (time, force)}
    if solution.scene.rigid_contact and isinstance(solution.motion, ResolvesForce):
        resolved = np.asarray(solution.motion.resolved_force(instants), float)
        lines = {"resolved": _thinned(instants, resolved), "raw": (time, force)}
    return Curves("force", "N", lines, _spans(solution, until), until)


def _thinned(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The least and the largest of each stretch, in their order, where there are more than can be drawn."""
    if time.size <= 4 * BINS:
        return time, values
    kept = [0, time.size - 1]
    for part in np.array_split(np.arange(time.size), BINS):
        kept += [int(part[values[part].argmin()]), int(part[values[part].argmax()])]
    kept = sorted(set(kept))
    return time[kept], values[kept]


def _field(solution: Solution, until: float) -> Field | None:
    """Stress along rods, deflection of a beam; None where all places of the bodies move as one."""
    scene, motion = solution.scene, solution.known_motion
    first, last = reach(solution)
    if last <= first or isinstance(scene.struck.target, Mechanism) or not knows_field(motion):
        return None
    time, x = np.linspace(0.0, until, INSTANTS), np.linspace(first, last, PLACES)
    bends = scene.target.bends
    figure = FIELDS["displacement" if bends else "stress"]
    values = np.asarray(figure.of(motion, time, x), float)
    if not np.isfinite(values).all() or not np.abs(values).max() > 0.0:
        return None
    return Field("deflection" if bends else "stress", figure.unit, time, x, values, bends)


def _velocities(solution: Solution, until: float) -> Curves:
    return _motion(solution, until, "velocity", {"impactor": "impactor_velocity", "struck": "end_velocity"})


def _positions(solution: Solution, until: float) -> Curves:
    return _motion(solution, until, "displacement", {"impactor": "impactor_position", "struck": "end_position"})


def _motion(solution: Solution, until: float, name: str, names: Mapping[str, str]) -> Curves:
    """Of the impactor and of the struck face, where they are known."""
    time, own, motion = np.linspace(0.0, until, POINTS), histories_of(solution.scene), solution.known_motion
    known = HISTORIES | STRIKING
    lines = {
        label: (time, np.asarray(known[history].of(motion, time), float))
        for label, history in names.items()
        if history in own
    }
    return Curves(name, "m/s" if name == "velocity" else "m", lines, _spans(solution, until), until)
