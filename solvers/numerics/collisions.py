"""Two compact bodies pressed together by a contact law: mu a'' = -F, in closed form where there is one.

Every solution starts with a = 0, a' = speed and ends when the contact opens. mu [kg] is the reduced mass; a law has
force, stored, dent and corner as in `solvers.contact`.
Source: thesis 3.4, (3.28)-(3.34).
"""

import math
from typing import Any

import numpy as np

from . import damped_path, path_steps, weighted_path
from .closed_collisions import Collision, follow_power, follow_sine
from .law_functions import constants_of
from .path_collision import STAGES, STRETCHES, follow_path, instants, stretches
from .waves.laws import law_function

# of what never leaves, with damping and without: then it is followed no longer
SWINGS_TO_REST, SWINGS = 100.0, 5.0
MOST_INSTANTS = 40_000  # of a contact under weight, which may take for ever to come to rest


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
    """Any law with damping, by `damped_path.follow_damped`; `unit` [s]: about a contact time.

    Error: 1e-11 of the speed.
    """
    ask, constants, slopes = law_function(type(law)), constants_of([law])[0], np.empty(2)
    cell, room, count = np.empty((path_steps.ROWS, path_steps.STAGES)), damped_path.USUAL, -1
    while count < 0:
        found, room = Collision.of(room), 2 * room
        count = damped_path.follow_damped(ask, constants, slopes, mass, speed, unit, cell, found)
    return Collision(*(values[:count] for values in found))


def weighted_collision(
    law: Any, mass: float, speed: float, fall: float, unit: float, deepest: float, on: bool
) -> tuple[Collision, int, bool]:
    """Any law, under a weight that accelerates the mass by `fall` [m/s2], by `weighted_path.follow_weighted`; `unit`
    [s]: about a contact time; `deepest`: of earlier contacts [m]; on: followed however long it swings.

    Returns it, how it has ended, and whether the body can never leave. Error: 1e-11 of the largest speed.
    """
    ask, constants, slopes = law_function(type(law)), constants_of([law])[0], np.empty(2)
    cell, room, ended, size = np.empty((path_steps.ROWS, path_steps.STAGES)), damped_path.USUAL, 0, 0
    fastest = math.hypot(speed, fall * unit)
    scales = fastest * unit, fastest, mass * fastest / unit, fall * unit / fastest
    found, bound, swings = Collision.of(room), False, SWINGS_TO_REST if law.LOSSY else SWINGS
    swings = math.inf if on else swings
    while ended == weighted_path.NO_ROOM and room <= MOST_INSTANTS:
        found, room = Collision.of(room), 2 * room
        ended, size, bound = weighted_path.follow_weighted(
            ask, constants, slopes, (mass, speed, deepest, swings), scales, cell, found
        )
    return Collision(*(values[:size] for values in found)), ended, bool(bound)
