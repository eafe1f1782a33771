"""When the bodies of a scene have parted for good, by the rule of `numerics.parting`."""

import math
from collections.abc import Mapping
from enum import Enum
from typing import Any

from ..bodies import AnyBody, Rod, SpringMass
from ..numerics.parting import WATCHED_PERIODS
from ..scene import Scene
from ..text.notes import Note, Severity

# Of bodies that move apart so slowly that they were not clear of each other in the time that they were watched.
MAY_TOUCH_AGAIN = Note("may-touch-again", Severity.WARNING, periods=WATCHED_PERIODS)


class End(Enum):
    """How the time solved ended."""

    FOLLOWED = 0  # where it was asked for, or at a limit of the method
    PARTED = 1  # the bodies will never touch again
    MAY_TOUCH = 2  # they were watched for long as they move apart, but are not clear of each other
    NEVER = 3  # under its weight what has fallen cannot leave any more


def swinging(scene: Scene) -> list[AnyBody]:
    """Which of both bodies swing or ring by themselves."""
    return [body for body in (scene.impactor, scene.target) if body.slowest_period is not None]


def moves_alike(scene: Scene) -> bool:
    """Whether all that swings moves alike in every slowest period: one uniform rod, or one mass on a spring."""
    found = swinging(scene)
    return len(found) == 1 and (
        isinstance(found[0], SpringMass) or (isinstance(found[0], Rod) and not found[0].end_mass)
    )


def patience(scene: Scene) -> float:
    """For how long bodies that move apart are watched, unless they are clear of each other before [s]."""
    periods = [body.slowest_period or 0.0 for body in swinging(scene)]
    return max(periods, default=0.0) * (1.0 if moves_alike(scene) else WATCHED_PERIODS)


def may_gain(scene: Scene, found: Mapping[str, Any], end: End) -> float:
    """By how much the final velocity may still change, of the impact speed: where the bodies touch again, at most as
    if all that still rings drove them apart. `found`: as `summary` gives it.
    """
    if end is not End.MAY_TOUCH:
        return 0.0
    velocity, mass, energy = found["impactor_velocity"], scene.impactor.mass, found["energy"]
    own = max(energy["impactor"] - 0.5 * mass * velocity**2, 0.0) if math.isfinite(mass) else 0.0
    ringing = max(energy["target_vibration"], 0.0) + own
    apart = velocity - found["target_velocity"]
    return (math.hypot(apart, math.sqrt(2.0 * ringing / scene.reduced_mass)) - abs(apart)) / scene.speed
