"""How long two compact bodies touch by a contact law, and how stiff it becomes between them."""

import math
from functools import lru_cache

import numpy as np
from numba.extending import register_jitable

from .elastic import Rigid
from .protocol import Law, OfPower


def exponent_of(law: Law) -> float:
    """The power of the indentation with which the force of a law grows at first; 1 where nothing gives way."""
    if law.EXPONENT is not None:
        return law.EXPONENT
    return law.exponent if isinstance(law, OfPower) else 1.0


# The unit of time of a scene is asked for often. Of several laws: with the same constants they are equal as tuples.
@lru_cache(maxsize=256, typed=True)
def contact_time(law: Law, mass: float, speed: float) -> float:
    """About how long two compact bodies of this reduced mass [kg] touch [s]: half a swing on the secant stiffness."""
    if isinstance(law, Rigid):
        return 1e-3  # an impact of no duration at all: something to draw it on
    return half_swing(lambda depth: law.force(depth, 0.0, 0.0), (), mass, speed)


@register_jitable
def half_swing(force, known, mass, speed):
    """On the secant stiffness at the depth that it lets a mass come to; known: what `force` takes after the depth."""
    depth, stiffness = speed * 1e-4, 0.0
    for _ in range(200):
        stiffness = force(depth, *known) / depth
        depth = math.sqrt(depth * speed * math.sqrt(mass / stiffness))
    return math.pi * math.sqrt(mass / stiffness)


def steepest_stiffness(law: Law, mass: float, speed: float) -> float:
    """Largest stiffness of the law [N/m] that this reduced mass [kg] can reach: the law stores all its energy."""
    energy = 0.5 * mass * speed**2
    depth = 1e-3 * speed * contact_time(law, mass, speed)
    for _ in range(300):
        if law.stored(depth, depth) >= energy:
            break
        depth *= 1.25
    return max(float(law.slopes(part * depth, 0.0, 0.0)[0]) for part in np.linspace(1e-3, 1.0, 200).tolist())
