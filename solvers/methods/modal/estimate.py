"""The error of the modes kept: what others say of it, and what none of them can see."""

import math
from collections.abc import Callable

import numpy as np

from ...bodies import AnyBody, FlexiblePendulum, Waveguide
from ...bodies.linkage.struck import StruckMechanism
from ...scene import Scene
from ..estimates import LEFT_BY_MODES, error_left
from ..validity import bodies_that_bend
from .motion import ModalMotion

MOST_MODES = 10_000  # of any solve

# Other numbers of modes, as shares. Against many more the difference is the error.
MANY_MORE, MORE, FEWER = (4.0, 6.0), (3 / 2, 2.0), (1 / 2, 2 / 3)
FEWER_RIGID = (1 / 2, 2 / 5, 1 / 3, 1 / 4)  # more of them, as the rebound scatters
FEW_MODES = 20
FADING_RATIO = 0.8  # target over impactor
# Of the first contact by a law: shortest periods that it must last for all modes left out to follow it as springs do,
# and steps in which twice its time is solved with as many modes as that takes.
PERIODS_OF_SPRINGS, STEPS_OF_FIRST_CONTACT = 4.0, 400
SCATTER = 1.1  # of that about its order
MIN_IMPULSE_SHARE = 0.2  # of the largest impulse: shorter contacts of less are not asked to be resolved
MIN_STEPS_PER_CONTACT = 20.0  # with fewer neither its peak nor its losses are resolved, which is said


def error_of_modes(
    motion: ModalMotion, modes: int, solved: Callable[[int, AnyBody], float], begun: Callable[[int, float], float]
) -> float:
    """Of the final velocity, relative to the impact speed. `solved`: that as they part by so many modes, and a target,
    in steps to match; `begun`: that at an instant of the first contact [s] by so many.

    Of few modes, as of a pendulum or of links that have their own, against more, which cost little: fewer are no beam
    any longer. The factors are such that random impacts keep to it: `tests/random_estimates.py`.
    """
    scene = motion.scene

    def difference(count: int, target: AnyBody = scene.target) -> float:
        return (motion.parting_velocity - solved(count, target)) / scene.speed

    missed = _missed_by_springs(motion, modes, begun)
    if isinstance(scene.target, StruckMechanism) and scene.target.most_modes:
        estimated = LEFT_BY_MODES * abs(difference(2 * modes, scene.target.refined))
    elif not any(motion.pair.truncated):
        estimated = abs(difference(modes))
    elif missed is not None and len(motion.contacts()) == 1:
        estimated = missed
    else:
        shares, order, factor = _others(scene, modes)
        counts = [max(1, round(share * modes)) for share in shares]
        estimated = factor * error_left([(count / modes, difference(count)) for count in counts], order)
        estimated = max(estimated, missed or 0.0)
    steps = steps_of_a_contact(motion)
    if steps < MIN_STEPS_PER_CONTACT:  # so coarse that half the steps may be as wrong; second order
        estimated = max(estimated, 2.0 * steps**-2.0)
    lasts = scene.halting_time if bodies_that_bend(scene) and scene.rigid_contact else _fading_time(scene)
    # shorter than any mode kept: all numbers of modes are wrong alike
    return max(estimated, 1.0) if lasts < motion.pair.resolved_time else estimated


def _others(scene: Scene, modes: int) -> tuple[tuple[float, ...], float, float]:
    """Other numbers of modes, as shares, the order of the error and a factor on what they leave."""
    few, jumps = modes <= FEW_MODES, scene.contact.JUMPS
    ringing = [body for body in (scene.impactor, scene.target) if body.time_unit is not None]
    if all(isinstance(body, Waveguide) for body in ringing):
        if few:
            return (MANY_MORE, 1.0, 1.5) if scene.rigid_contact else (MANY_MORE, 4 / 3, 1.25)
        if (
            scene.rigid_contact
        ):  # a free rod about as heavy as the mass is left while the force is fading, which settles slowly
            return MORE, 2 / 3 if not scene.target.fixed and scene.mass_ratio > FADING_RATIO else 3 / 2, 2.6
        return (MORE, 4 / 3, 2.0) if jumps else (MORE, 2.0, 2.0)
    if few or isinstance(scene.impactor, FlexiblePendulum):
        return MORE, 1.0, 1.0
    if scene.rigid_contact:
        return FEWER_RIGID, 1.0, 1.75
    return FEWER, 4 / 3 if jumps else 2.0, 1.0


def _missed_by_springs(motion: ModalMotion, modes: int, begun: Callable[[int, float], float]) -> float | None:
    """What the first contact with a rod by a law is off by as modes left out are springs, of the speed of approach.

    One shorter than their periods meets a dashpot, the impedance of the rod. Against as many modes as make springs of
    those left out then, for twice as long as it lasts; second order in them. None where they are springs to it anyway.
    """
    scene, resolved = motion.scene, motion.pair.resolved_time
    ringing = [body for body in (scene.impactor, scene.target) if body.time_unit is not None]
    if scene.rigid_contact or not all(isinstance(body, Waveguide) for body in ringing):
        return None
    first = motion.contacts()[0]
    lasts = first.end - first.start
    end = min(first.end + lasts, motion.duration)
    asked = math.ceil(modes * PERIODS_OF_SPRINGS * resolved / lasts)
    if asked <= modes:
        return None
    if asked > PERIODS_OF_SPRINGS * MOST_MODES:
        return 1.0
    more = min(max(asked, 3 * modes), MOST_MODES)  # of hardly more modes the difference says little
    velocity = float(motion.impactor_velocity(np.array([end]))[0])
    difference = abs(velocity - begun(more, end)) / scene.speed
    return SCATTER * difference / (1.0 - PERIODS_OF_SPRINGS**-2.0)


def _fading_time(scene: Scene) -> float:
    """Time in which the force of a rigid impact between a mass and a rod fades, m / Z [s]; infinite for others."""
    ringing = [body for body in (scene.impactor, scene.target) if body.time_unit is not None]
    if len(ringing) != 1 or not isinstance(ringing[0], Waveguide) or not scene.rigid_contact:
        return math.inf
    mass = scene.target.mass if ringing[0] is scene.impactor else scene.impactor.mass
    return mass / ringing[0].impedance


def steps_of_a_contact(motion: ModalMotion) -> float:
    """How many steps the shortest contact has that counts, by a law of its own; infinite where the contact is rigid."""
    if motion.scene.rigid_contact:
        return math.inf
    contacts = motion.contacts()
    least = MIN_IMPULSE_SHARE * max(contact.impulse for contact in contacts)
    return min(contact.end - contact.start for contact in contacts if contact.impulse >= least) / motion.step
