"""Histories of an impact on a beam, as arrays of its message: motions, velocities and contact force over time.

Of all of the impact, or of a stretch of time that is looked at closely.
"""

import math

import numpy as np

from solvers import Solution
from solvers.methods.mechanisms import MechanismMotion
from solvers.methods.modal.motion import ModalMotion
from solvers.methods.multibody.motion import MovingMotion

from .encoding import FORCE_POINTS, Stretch, around, force_history, instants, over

MOTION_POINTS = 500  # of the motions of impactor and struck place
LISTED_RATES = 60  # contacts before and after which velocities are listed


def motion_instants(solution: Solution, stretch: Stretch) -> tuple[np.ndarray, np.ndarray]:
    """Of the motions [s], and which are after a jump of the velocities: closer together at first, but evenly where it
    goes on, or over a stretch; there with the impacts, each before and after."""
    if not isinstance(solution.motion, MovingMotion) and not stretch:
        time = instants(solution.duration, MOTION_POINTS)
        return time, np.ones(time.size, bool)
    time = over(stretch, solution.duration, MOTION_POINTS)
    edges = np.unique([edge for contact in solution.contacts for edge in (contact.start, contact.end)])
    seen = edges[(edges >= time[0]) & (edges <= time[-1])][: 2 * LISTED_RATES]
    return around(time, seen)


def paths(solution: Solution, time: np.ndarray, name: str) -> dict[str, np.ndarray]:
    """Displacement of the impactor and of the struck place [m]."""
    motion = solution.known_motion
    found = {"impactorPath": motion.impactor_position(time), "struckPath": motion.end_position(time)}
    return {name + key[0].upper() + key[1:] if name else key: values for key, values in found.items()}


def struck_velocity(solution: Solution, time: np.ndarray, after: bool = True) -> np.ndarray:
    """Of the struck place [m/s]; a modal motion gives it over one of its steps, which costs no sum over its modes."""
    motion = solution.known_motion
    if not isinstance(motion, ModalMotion) or motion.pair.split:
        return motion.end_velocity(time, after)
    before = np.clip(np.floor(time / motion.step) * motion.step, 0.0, motion.duration - motion.step)
    return (motion.end_position(before + motion.step) - motion.end_position(before)) / motion.step


def force_arrays(solution: Solution, name: str, stretch: Stretch) -> dict[str, np.ndarray]:
    """Contact force [N] over time [s]; of modes in rigid contact as far as they resolve it."""
    motion = solution.known_motion
    if isinstance(motion, MechanismMotion):  # who looks from elsewhere sees the same force
        motion = motion.relative
    if isinstance(motion, ModalMotion) and solution.scene.rigid_contact:
        time = instants(solution.duration, FORCE_POINTS, stretch)
        force = motion.resolved_force(time)
    elif isinstance(motion, ModalMotion):
        time, force = extremes(motion.step, motion.record.contact_force, stretch)
    elif isinstance(motion, MovingMotion) and solution.scene.rigid_contact:
        time, force = np.array([0.0, solution.duration]), np.zeros(2)  # impulses without duration
    else:
        time, force = force_history(solution, stretch)
    return {f"{name}Time": time, f"{name}Force": force}


def extremes(step: float, force: np.ndarray, stretch: Stretch = None) -> tuple[np.ndarray, np.ndarray]:
    """Times [s] and least and largest values of a force in groups of steps, so that no contact is thinned away; one
    where they are the same."""
    first = 0
    if stretch:
        first = min(int(stretch[0] / step), force.size - 1)
        force = force[first : max(math.ceil(stretch[1] / step), first + 1)]
    group = -(-2 * force.size // FORCE_POINTS)
    groups = np.pad(force, (0, -force.size % group), mode="edge").reshape(-1, group)
    values = np.stack([groups.min(axis=1), groups.max(axis=1)], axis=1)
    differ = np.stack((np.ones(values.shape[0], bool), values[:, 1] > values[:, 0]), axis=1)
    middles = (first + (np.arange(groups.shape[0]) + 0.5) * group) * step
    return np.repeat(middles, differ.sum(axis=1)), values[differ]


def rates_at(solution: Solution, time: np.ndarray, after: bool) -> np.ndarray:
    """Velocities of the impactor and of the struck place, (2, time) [m/s]."""
    return np.stack(
        (solution.known_motion.impactor_velocity(time, after), struck_velocity(solution, time, after)),
    )


def rates_of_contacts(solution: Solution) -> dict[str, np.ndarray]:
    """Velocity of the impactor and of the struck place just before each contact begins and after it ends [m/s]."""
    listed, both = solution.contacts[:LISTED_RATES], []
    for after, edges in ((False, [c.start for c in listed]), (True, [min(c.end, solution.duration) for c in listed])):
        time = np.array(edges)
        both.append(rates_at(solution, time, after).T)
    return {"rates": np.stack(both, axis=1)}
