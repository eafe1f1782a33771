"""Restitution three ways, and the instants on which it rests.

Centre-of-mass velocities, impulses and touching surfaces agree for bodies that move as a whole; where waves run they
need not, as the surfaces may part at any speed and the mean velocities may agree more than once.
Source: thesis 4.6 and 4.7. Differs: (4.46) prints 1 for the surfaces of a free rod; they part at 2 - exp(-2 beta).
"""

import numpy as np

from ..scene import Scene
from .motion import Motion, MovesFace

CROSSING_SAMPLES = 4_000  # over the time in which crossings are searched for


JUST_AFTER = 1e-14  # of a round trip: more than the rounding of the instant at which a front arrives


def common_velocity(scene: Scene) -> float:
    """Of both bodies' centre of mass [m/s]; zero if the target is held."""
    if scene.target.held:
        return 0.0
    m1, m2 = scene.impactor.mass, scene.target.mass
    return (m1 * scene.impactor.velocity + m2 * scene.target.velocity) / (m1 + m2)


def restitution(
    scene: Scene, motion: Motion, parting: float, until: float, fall: float = 0.0
) -> dict[str, float | None]:
    """`newton` by centre-of-mass velocities at `until` [s], (4.40); `poisson` by impulses before and after the bodies
    have one velocity, (4.39); `newton_at_contact` by the touching surfaces just after `parting` [s], (4.45).

    fall: of an impactor that flies under its weight from the parting on [m/s2].
    A held target counts as a body at rest, its mean over a period of vibration (4.43). Where a body turns about a pin
    there is no restitution of centres of mass, and none by impulses where bodies turn at all: they are None.
    """
    end, parted = np.array([until]), np.array([parting + JUST_AFTER * scene.time_unit])
    # what flies under its weight, as it was when it parted
    impactor = float(motion.impactor_velocity(end)[0]) - fall * (until - parting)
    target = 0.0 if scene.target.held else float(motion.rigid_velocity(end)[0])
    face_velocity = motion.face_velocity if isinstance(motion, MovesFace) else motion.impactor_velocity
    apart = float(motion.end_velocity(parted)[0] - face_velocity(parted)[0])
    searched = parting if fall else until  # then it speeds up again
    turns = scene.impactor.turns or scene.target.turns
    return {
        "newton": None if scene.target.swings else (target - impactor) / scene.speed,
        "poisson": None if turns else poisson(motion, common_velocity(scene), until, searched),
        "newton_at_contact": apart / scene.speed,
    }


def poisson(motion: Motion, common: float, until: float, parting: float) -> float | None:
    """Impulse after over impulse before the end of compression, which comes before `parting`; None if it never does."""
    instant = compression_time(motion, common, parting)
    if instant is None:
        return None
    before = float(motion.impulse(np.array([instant]))[0])
    if before <= 0.0:  # so heavy an impactor that the common velocity is its own, to rounding
        return None
    return float(motion.impulse(np.array([until]))[0]) / before - 1.0


def compression_time(motion: Motion, common: float, until: float) -> float | None:
    """When the impactor has come down to the `common` velocity [s]: (4.38), (4.41); None if it never does."""
    if float(motion.impactor_velocity(np.array([until]))[0]) > common:
        return None
    low, high = 0.0, until
    for _ in range(6):  # the velocity of the impactor only falls; each look narrows the instant 400 times
        times = np.linspace(low, high, 401)
        later = int(np.argmax(motion.impactor_velocity(times) <= common))
        low, high = float(times[max(later - 1, 0)]), float(times[later])
    return high


def common_velocity_times(motion: Motion, until: float) -> list[float]:
    """All instants [s] at which the mean velocities of impactor and target agree, thesis figure 4.19.

    One for a free rod. A held rod is pushed by its support too: its mean velocity meets the impactor's several times,
    so that none of them is the end of compression. Found if further apart than `until` / 4000.
    """

    def ahead(times: np.ndarray) -> np.ndarray:
        return motion.impactor_velocity(times) - motion.rigid_velocity(times)

    times = np.linspace(0.0, until, CROSSING_SAMPLES + 1)
    difference = ahead(times)
    crossings = np.flatnonzero(np.signbit(difference[1:]) != np.signbit(difference[:-1]))
    low, high, falling = times[crossings], times[crossings + 1], ~np.signbit(difference[crossings])
    for _ in range(50):
        middle = 0.5 * (low + high)
        later = ~np.signbit(ahead(middle)) == falling
        low, high = np.where(later, middle, low), np.where(later, high, middle)
    return high.tolist()
