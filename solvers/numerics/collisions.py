"""Two compact bodies pressed together by a contact law: mu a'' = -F, in closed form where there is one.

Every solution starts with a = 0, a' = speed and ends when the contact opens. mu [kg] is the reduced mass; a law has
force, stored, dent and corner as in `solvers.contact`.
Source: thesis 3.4, (3.28)-(3.34).
"""

import math
from typing import Any

import numpy as np

from .closed_collisions import Collision, follow_power, follow_sine
from .law_functions import constants_of
from .path_collision import STAGES, STRETCHES, follow_path, instants, stretches
from .waves.laws import law_function

SUBSTEPS = 6  # kept of each step of a differential equation


def duration_of_power(exponent: float) -> float:
    """Contact time under F = K a^n in units of a_max / speed: pi for a spring, 2.94328 for Hertz.

    2 int_0^1 ds / sqrt(1 - s^(n + 1)), by gamma functions.
    """
    share = 1.0 / (exponent + 1.0)
    return 2.0 * math.sqrt(math.pi) * math.gamma(1.0 + share) / math.gamma(0.5 + share)


def power_collision(stiffness: float, exponent: float, mass: float, speed: float, samples: int) -> Collision:
    """`follow_power` at an even number of stretches of time."""
    found = Collision.of(samples // 2 * 2 + 1)
    follow_power(stiffness, exponent, mass, speed, found)
    return found


def sine_collision(stiffness: float, mass: float, speed: float, samples: int) -> Collision:
    """`follow_sine` at so many stretches of time."""
    found = Collision.of(samples + 1)
    follow_sine(stiffness, mass, speed, found)
    return found


def path_collision(law: Any, mass: float, speed: float) -> Collision:
    """Any law without damping, with or without memory, by `path_collision.follow_path`."""
    ask, constants, slopes = law_function(type(law)), constants_of([law])[0], np.empty(2)
    cell, edges = np.empty((2, STAGES)), np.empty(STRETCHES + 1)
    count = stretches(ask, constants, slopes, 0.5 * mass * speed**2, cell, edges)
    found = Collision.of(instants(count))
    follow_path(ask, constants, slopes, mass, speed, cell, edges[: count + 1], found)
    return found


def damped_collision(law: Any, mass: float, speed: float, unit: float) -> Collision:
    """Any law with damping, as one ordinary differential equation of high order; `unit` [s]: about a contact time.

    Error: 1e-11 of the speed. The contact lasts as long as it presses; what creeps back without a force is flight.
    """
    from scipy.integrate import solve_ivp

    def motion(_, state):
        a, rate, _ = state
        force = law.force(a * speed * unit, rate * speed, 0.0) * unit / (mass * speed)
        return rate, -force, force * rate

    def opens(_, state):
        return state[0]

    opens.terminal, opens.direction = True, -1.0
    found = solve_ivp(
        motion, (0.0, 1e4), (0.0, 1.0, 0.0), "DOP853", events=opens, rtol=1e-12, atol=1e-14, dense_output=True
    )
    parts = np.linspace(0.0, 1.0, SUBSTEPS, endpoint=False)
    time = np.append((found.t[:-1, None] + np.diff(found.t)[:, None] * parts).ravel(), found.t[-1])
    a, rate, work = found.sol(time)
    a[0], a[-1] = 0.0, max(a[-1], 0.0) if found.status == 0 else 0.0
    a, rate, work = a * speed * unit, rate * speed, work * mass * speed**2
    force = np.array([law.force(depth, fast, 0.0) for depth, fast in zip(a, rate, strict=True)])
    stored = np.array([law.stored(depth, 0.0) for depth in a])
    last = int(np.flatnonzero(force > 0.0)[-1]) + 1
    force[last], stored[last] = 0.0, 0.0  # what is stored in a surface too slow to press is lost
    return Collision(*(
        values[: last + 1]
        for values in (time * unit, a, rate, force, mass * (speed - rate), stored, np.maximum(work - stored, 0.0))
    ))  # fmt: skip
