"""The error of the modes kept: what others say of it, and what none of them can see."""

import math
from collections.abc import Callable

from ...bodies import FlexiblePendulum, Waveguide
from ...scene import Scene
from ..estimates import error_left
from ..validity import bodies_that_bend
from .motion import ModalMotion

# Other numbers of modes, as shares; of a rigid contact more of them, as its rebound scatters.
SHARES, RIGID_SHARES, FINER_SHARES = (1 / 2, 2 / 3), (1 / 2, 2 / 5, 1 / 3, 1 / 4), (3 / 2, 2.0)
FEW_MODES = 20
MIN_IMPULSE_SHARE = 0.2  # of the largest impulse: shorter contacts of less are not asked to be resolved
MIN_STEPS_PER_CONTACT = 20.0  # with fewer neither its peak nor its losses are resolved, which is said


def error_of_modes(motion: ModalMotion, modes: int, solved: Callable[[int], float]) -> float:
    """Of the final velocity, relative to the impact speed. `solved`: that velocity by so many modes in half the steps.

    Of few modes, as of a pendulum that has its own, against more, which cost little: fewer are no beam any longer. The
    factors are such that random impacts keep to it: `tests/random_estimates.py`.
    """
    scene = motion.scene

    def difference(count: int) -> float:
        return (motion.final_velocity - solved(count)) / scene.speed

    if any(motion.pair.truncated):
        shares, order, factor = _others(scene, modes)
        counts = [max(1, round(share * modes)) for share in shares]
        estimated = factor * error_left([(count / modes, difference(count)) for count in counts], order)
    else:
        estimated = abs(difference(modes))
    steps = steps_of_a_contact(motion)
    if steps < MIN_STEPS_PER_CONTACT:  # so coarse that half the steps may be as wrong; second order
        estimated = max(estimated, 2.0 * steps**-2.0)
    lasts = scene.halting_time if bodies_that_bend(scene) and scene.rigid_contact else _fading_time(scene)
    # shorter than any mode kept: all numbers of modes are wrong alike
    return max(estimated, 1.0) if lasts < motion.pair.resolved_time else estimated


def _others(scene: Scene, modes: int) -> tuple[tuple[float, ...], float, float]:
    """Other numbers of modes, as shares, the order of the error and a factor on what they leave."""
    few = modes <= FEW_MODES or isinstance(scene.impactor, FlexiblePendulum)
    if few and not scene.target.own_modes:  # which has no more
        return FINER_SHARES, 1.0, 1.0
    if scene.rigid_contact:
        return RIGID_SHARES, 1.0, 1.75
    return SHARES, 4 / 3 if scene.contact.JUMPS else 2.0, 1.0


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
