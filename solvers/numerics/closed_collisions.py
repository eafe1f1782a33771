"""Two compact bodies pressed together by a power of the indentation: mu a'' = -K a^n, as kernels.

Every solution starts with a = 0, a' = speed and ends when the contact opens. mu [kg] is the reduced mass.
Source: thesis 3.4, (3.28)-(3.34).
"""

import math
from typing import NamedTuple

import numpy as np
from numba.extending import register_jitable

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from .waves.drawn import instant

SINE_PEAK, SINE_RATE = 1.14, 1.068  # (3.34): in units of mu v^2 / a_max and v / a_max
TERMS = 80  # of a series whose terms at least halve: more than rounding leaves of it


class Collision(NamedTuple):
    """Arrays (time,) from first touch to parting."""

    time: np.ndarray  # [s]
    indentation: np.ndarray  # [m]
    rate: np.ndarray  # [m/s]
    force: np.ndarray  # [N]
    impulse: np.ndarray  # [N s]
    stored: np.ndarray  # [J], what the contact would give back
    lost: np.ndarray  # [J], to the law

    @classmethod
    def of(cls, instants: int) -> "Collision":
        """Not yet solved, of an odd number of them."""
        return cls(*np.empty((len(cls._fields), instants)))


@register_jitable
def deepest_of_power(stiffness, exponent, mass, speed):
    """Largest indentation under F = K a^n: all kinetic energy is stored. Source: (3.33) for n = 3/2."""
    return (0.5 * (exponent + 1.0) * mass * speed**2 / stiffness) ** (1.0 / (exponent + 1.0))


@inner_kernel
def _beta(x, a, b):
    """Incomplete beta function of x up to 1/2 over x^a: int_0^x t^(a - 1) (1 - t)^(b - 1) dt = x^a times this."""
    found, term = 0.0, 1.0
    for k in range(TERMS):
        found += term / (a + k)
        term *= x * (k + 1.0 - b) / (k + 1.0)
    return found


@inner_kernel
def _halves(share):
    """Time to half of the energy and from there to rest, in the unit of `_moved`."""
    return 0.5**share * _beta(0.5, share, 0.5), math.sqrt(0.5) * _beta(0.5, 0.5, share)


@inner_kernel
def _moved(part, share, first, second):
    """Indentation and rate, as shares of the largest, at this part of the time to the deepest indentation.

    That time is int x^(share - 1) (1 - x)^(-1/2) dx over the share x of the energy that is stored. Newton in the
    indentation x^share up to half of it, beyond in the rate (1 - x)^(1/2): there the series converge, and their slopes
    keep the sign.
    """
    gone, left = part * (first + second), (1.0 - part) * (first + second)
    if gone <= first:
        depth, energy = gone * share, 0.0
        for _ in range(50):
            energy = depth ** (1.0 / share)
            change = (depth * _beta(energy, share, 0.5) - gone) * share * math.sqrt(1.0 - energy)
            depth -= change
            if abs(change) <= 1e-16 * depth:
                break
        return depth, math.sqrt(1.0 - depth ** (1.0 / share))
    rate = 0.5 * left
    for _ in range(50):
        moving = rate * rate
        change = (rate * _beta(moving, 0.5, share) - left) * 0.5 * (1.0 - moving) ** (1.0 - share)
        rate -= change
        if abs(change) <= 1e-16 * rate:
            break
    return (1.0 - rate * rate) ** share, rate


@kernel
def follow_power(stiffness, exponent, mass, speed, course):
    """F = K a^n, exactly: the share of the energy that is stored is an inverse incomplete beta function of time."""
    deepest, share, energy = deepest_of_power(stiffness, exponent, mass, speed), 1.0 / (exponent + 1.0), 0.5 * mass
    energy *= speed * speed
    first, second = _halves(share)
    last = course.time.size - 1
    half = (first + second) * share * deepest / speed
    for k in range(last // 2 + 1):
        if k % 16 == 0:
            check_time()
        part = instant(k, last // 2 + 1, 1.0)
        depth, rate = _moved(part, share, first, second)
        for n, way in ((k, 1.0), (last - k, -1.0)):
            course.time[n] = half * (part if way > 0.0 else 2.0 - part)
            course.indentation[n], course.rate[n] = deepest * depth, way * speed * rate
            course.force[n] = stiffness * course.indentation[n] ** exponent
            course.impulse[n] = mass * (speed - course.rate[n])
            course.stored[n], course.lost[n] = energy * depth ** (1.0 / share), 0.0


@kernel
def follow_sine(stiffness, mass, speed, course):
    """Hertz contact by the half sine of (3.34), which Goldsmith fitted: F = 1.14 mu v^2 / a_max sin(1.068 v t / a_max).

    Differs: (3.34) prints m2 - m1 for m1 + m2 in mu = m1 m2 / (m1 + m2).
    Error: duration -0.06 %, peak -8.8 % of 1.25 mu v^2 / a_max, impulse +6.7 %, so that the rebound is too fast.
    """
    deepest = deepest_of_power(stiffness, 1.5, mass, speed)
    for k in range(course.time.size):
        angle = instant(k, course.time.size, math.pi)
        push = SINE_PEAK / SINE_RATE * mass * speed * 2.0 * math.sin(0.5 * angle) ** 2
        rate = speed - push / mass
        course.time[k], course.indentation[k] = angle * deepest / (SINE_RATE * speed), deepest * math.sin(angle)
        course.rate[k], course.impulse[k] = rate, push
        course.force[k] = SINE_PEAK * mass * speed**2 / deepest * math.sin(angle)
        course.stored[k], course.lost[k] = max(0.5 * mass * (speed**2 - rate**2), 0.0), 0.0
