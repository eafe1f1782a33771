"""The weight of what falls, for methods that leave it out while it touches: how much that matters."""

import math
from typing import Any

import numpy as np

from ..contact.duration import contact_time
from ..numerics.collisions import SWINGS, SWINGS_TO_REST
from ..numerics.weighted_path import RESTING
from ..scene import Scene
from ..solution.solution import Solution
from ..text.notes import Note, Severity
from .springs import is_spring, spring_of

PARTS = 4  # of the time so far, in the last of which a body at rest does not move; of a period, how often is looked
MAX_LEFT_OUT = 0.01  # of the speed of approach: with more a method that leaves weight out refuses the scene
LARGE_SAG = 0.1  # of what the impact adds: less is not said
INSTANTS = 250  # at which that is looked for
LOOKS = 8  # in the time so far, at most: each goes through all of it
MOST_SWINGS = 10.0  # times as many as of what never leaves: then it is cut short
GOES_ON, FLIES, RESTS, SINKS, SWINGS_ON, ENDLESS = range(6)  # how an impact under weight goes


def weight_too_large(scene: Scene) -> Note | None:
    """Why a scene is refused by a method without weight; None: so little is left out that a note says all."""
    share = scene.weight_acceleration * about_so_long(scene) / scene.speed
    return Note("refusals.weight", Severity.REFUSAL, share=100.0 * share) if share > MAX_LEFT_OUT else None


def about_so_long(scene: Scene) -> float:
    """An impact on what is held [s]: half a swing on what gives way, the contact by itself, and a round trip."""
    bends = math.pi * math.sqrt(scene.impactor.mass * scene.target.softness)
    alone = 0.0 if scene.rigid_contact else contact_time(scene.contact, scene.reduced_mass, scene.speed)
    rings = sum(body.time_unit or 0.0 for body in (scene.impactor, scene.target))
    return bends + alone + rings


def leave_out_weight(solution: Solution) -> None:
    """Say by how much velocities are off without weight, g t / v up to the last parting, and count it as an error."""
    scene = solution.scene
    if not scene.weight_acceleration or not solution.contacts:
        return
    lasts = min(solution.contacts[-1].end, solution.duration)
    share = scene.weight_acceleration * lasts / scene.speed
    grave = Severity.REMARK if share <= MAX_LEFT_OUT else Severity.WARNING
    left_out = Note("weight-left-out", grave, share=100.0 * share)

    def with_share(_: Solution, found: dict[str, Any]) -> dict[str, Any]:
        return found | {"estimated_error": (found.get("estimated_error") or 0.0) + share}

    solution.refine("diagnostics", with_share)
    solution.refine("notes", lambda _, notes: [*notes, left_out])


def is_at_rest(scene: Scene, velocity: np.ndarray, force: float) -> bool:
    """Whether an impactor, with velocities so far (instants,) [m/s], hardly moves any more, pressed by its weight."""
    weight, last = scene.impactor.mass * scene.weight_acceleration, velocity[-max(2, velocity.size // PARTS) :]
    still = np.abs(last).max() <= RESTING * np.abs(velocity).max()
    return bool(still and abs(force - weight) <= RESTING * weight)


def stays(scene: Scene, velocity: np.ndarray, force: float, kept: float, least: float = 0.0) -> int:
    """How an impactor goes on that has not left, with velocities so far (instants,) [m/s], pressed by a force [N].

    kept: kinetic energy, what bends, and the height over where it touched first [J]: with less than `least` it never
    leaves.
    """
    if is_at_rest(scene, velocity, force):
        return RESTS
    swings = 0.5 * float(np.count_nonzero(np.diff(np.signbit(velocity))))
    most = SWINGS_TO_REST if loses(scene) else SWINGS
    if kept < least and swings >= most:
        return SWINGS_ON
    return ENDLESS if swings >= MOST_SWINGS * most else GOES_ON


def loses(scene: Scene) -> bool:
    """Whether swings under weight die away."""
    bodies = scene.impactor, scene.target
    return bool(scene.contact.LOSSY or any(body.damping or body.endless for body in bodies))


def moved(scene: Scene, step: float, pushes: np.ndarray, mass: float) -> tuple[np.ndarray, np.ndarray]:
    """Velocity and place of the impactor as a whole at all instants, by its weight and by pushes (steps,) [N s]."""
    time = step * np.arange(pushes.size + 1)
    velocity = scene.impactor.velocity + scene.weight_acceleration * time - np.append(0.0, np.cumsum(pushes)) / mass
    return velocity, np.append(0.0, np.cumsum(0.5 * step * (velocity[1:] + velocity[:-1])))


def comes_to_rest(scene: Scene, time: float, depth: float) -> Note:
    """That it does, after a time [s], so far from where it touched first [m]."""
    weight = scene.impactor.mass * scene.weight_acceleration
    return Note("comes-to-rest", Severity.REMARK, time=time, depth=depth, force=weight)


def never_leaves(scene: Scene, time: float) -> Note:
    """That it does not, but swings, followed for a time [s]."""
    return Note("never-leaves", Severity.REMARK, time=time, damped=loses(scene))


def left_out_later(scene: Scene, acceleration: float, duration: float) -> list[Note]:
    """That bodies move on by themselves [m/s2] in a time that is asked for [s], where no method follows them."""
    share = abs(acceleration) * duration / scene.speed
    grave = Severity.REMARK if share <= MAX_LEFT_OUT else Severity.WARNING
    return [Note("weight-left-out-later", grave, time=duration, share=100.0 * share)] if share else []


def sag_of(scene: Scene) -> float:
    """How far what is held has given way under its own weight where it is struck [m], before the impact."""
    target = scene.target
    if not (scene.weight_acceleration and target.held) or target.endless:
        return 0.0
    if target.rods:
        if not all(joint.bonded for joint in getattr(target, "joints", ())):  # how they lie on each other is not known
            return 0.0
        before = np.cumsum([0.0, *(rod.mass for rod in target.rods[:-1])])
        pulled = sum((above + 0.5 * rod.mass) / rod.stiffness for above, rod in zip(before, target.rods, strict=True))
        return scene.weight_acceleration * float(pulled)
    if not (is_spring(target) and target.fixed):  # on one pin it turns
        return 0.0
    spring = spring_of(target)
    return scene.weight_acceleration * target.mass * spring.mean / spring.stiffness


def hangs_low(solution: Solution) -> list[Note]:
    """That the sag of what is held is as large as what the impact adds, or a good part of it."""
    sag, motion = sag_of(solution.scene), solution.motion
    if not sag or motion is None or not solution.duration > 0.0:
        return []
    added = float(np.abs(motion.end_position(np.linspace(0.0, solution.duration, INSTANTS))).max())
    return [Note("held-hangs", Severity.REMARK, sag=sag, added=added)] if sag > LARGE_SAG * added else []


def falls_along(scene: Scene) -> list[Note]:
    """Where nothing holds the target, it falls as what strikes it does."""
    alike = scene.gravity and not scene.target.held and not scene.prescribed_force
    return [Note("weight-falls-along", Severity.REMARK)] if alike else []
