"""Two compact bodies pressed together by a contact law: mu a'' = -F, in closed form where there is one.

Every solution starts with a = 0, a' = speed and ends when the contact opens. mu [kg] is the reduced mass; a law has
force, stored, dent and corner as in `solvers.contact`.
Source: thesis 3.4, (3.28)-(3.34).
"""

import math
from typing import Any

import numpy as np

from .closed_collisions import Collision, follow_power, follow_sine
from .quadrature import gauss_within

CELLS_PER_STRETCH = 200  # of each stretch of the path on which the law has one formula
# Last over first indentation of such a stretch: over more, a power is no polynomial in each cell.
WIDEST_STRETCH = 100.0
QUADRATURE_STAGES = 6  # of the quadrature in each cell
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
    """Any law without damping, with or without memory, by work integrals along loading and unloading.

    The deepest indentation is where the work of loading has used up the energy; unloading gives back what is stored.
    Error: rounding, as every stretch with one formula is integrated by itself in a variable in which it is smooth.
    """
    energy = 0.5 * mass * speed**2
    deepest, stretches = _loading(law, energy)
    down = _fallen(lambda a: law.force(a, 0.0, deepest), law.dent(deepest), deepest, True, True, 0.0, mass)
    up: Any = None
    for number, (low, high) in enumerate(reversed(stretches)):
        done = 0.0 if up is None else up[2][-1]
        bottom = number == len(stretches) - 1
        part = _fallen(lambda a: law.force(a, 0.0, 0.0), low, high, number == 0, bottom, done, mass)
        up = part if up is None else tuple(
            np.concatenate((first, (first[-1] if name == 0 else 0.0) + second[1:]))
            for name, (first, second) in enumerate(zip(up, part, strict=True))
        )  # fmt: skip
    rise, a_up, given_up = up
    fall, a_down, given_down = down
    time = np.concatenate((rise[-1] - rise[::-1], rise[-1] + fall[1:]))
    indentation = np.concatenate((a_up[::-1], a_down[1:]))
    rate = np.sqrt(2.0 / mass * np.concatenate((given_up[::-1], given_down[1:])))
    rate[a_up.size :] *= -1.0
    loading = np.arange(time.size) < a_up.size
    force = [law.force(a, 0.0, 0.0 if rising else deepest) for a, rising in zip(indentation, loading, strict=True)]
    stored = [law.stored(a, a if rising else deepest) for a, rising in zip(indentation, loading, strict=True)]
    stored = np.array(stored)
    lost = np.where(loading, energy - 0.5 * mass * rate**2 - stored, energy - stored[a_up.size - 1])
    return Collision(time, indentation, rate, np.array(force), mass * (speed - rate), stored, np.maximum(lost, 0.0))


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


def _loading(law: Any, energy: float) -> tuple[float, list[tuple[float, float]]]:
    """The deepest indentation, and the stretches of the loading curve up to there, one formula on each."""
    from scipy.optimize import brentq

    def work(low, high):
        return (high - low) * law.mean(low, high, 0.0, 0.0)[0]

    low, done, stretches = 0.0, 0.0, []
    while True:
        high = min(law.corner(low, 0.0), WIDEST_STRETCH * low if low > 0.0 else math.inf)
        if not math.isfinite(high):
            high = 1e-9
            while done + work(low, high) < energy:
                high *= 2.0
        more = work(low, high)
        if done + more >= energy:
            deepest = brentq(
                lambda a, low=low, done=done: done + work(low, a) - energy, low, high, xtol=1e-18, rtol=1e-14
            )
            return deepest, [*stretches, (low, deepest)]
        stretches.append((low, high))
        low, done = high, done + more


def _fallen(force, low: float, high: float, top: bool, bottom: bool, given: float, mass: float):
    """Back down a stretch of the curve from `high`: time since there, indentation, work given back since the very top.

    At the top the rate starts as a square root, at the bottom the force ends as a power: the variable u runs over both
    smoothly. `given` [J] has been given back above the stretch.
    """
    u = (np.arange(CELLS_PER_STRETCH)[:, None] + _NODES) / CELLS_PER_STRETCH
    whole = np.arange(CELLS_PER_STRETCH + 1) / CELLS_PER_STRETCH

    def place(u):
        share = 1.0 - u**2 if top else 1.0 - u
        return low + (high - low) * (share**3 if bottom else share)

    def slope(u):
        share, change = (1.0 - u**2, 2.0 * u) if top else (1.0 - u, np.ones_like(u))
        return (high - low) * (3.0 * share**2 * change if bottom else change)

    pull = np.array([[force(a) for a in row] for row in place(u)]) * slope(u) / CELLS_PER_STRETCH  # work per cell
    inside = pull @ _INTEGRATE.T
    above = given + np.concatenate(([0.0], np.cumsum(pull @ _WEIGHTS)))
    work = above[:-1, None] + inside
    time = (slope(u) / CELLS_PER_STRETCH / np.sqrt(2.0 / mass * work)) @ _WEIGHTS
    return np.concatenate(([0.0], np.cumsum(time))), place(whole), above


_NODES, _WEIGHTS, _INTEGRATE = gauss_within(QUADRATURE_STAGES)
