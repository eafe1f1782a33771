"""Structures with one degree of freedom under an impact: closed forms on given instants of contact and of flight.

Source: thesis 3.3.
"""

from typing import NamedTuple

import numpy as np

SQUARE = 2.5  # (3.22): omega_3^2 = 135/54 E A / (L m)


class Response(NamedTuple):
    """Arrays (time,): the instants of contact, then those of flight; the parting stands twice."""

    time: np.ndarray  # [s]
    force: np.ndarray  # on the impactor [N]
    impulse: np.ndarray  # [N s]
    position: np.ndarray  # of the impactor [m]
    velocity: np.ndarray
    bent: np.ndarray  # coordinate of the structure [m]
    bent_rate: np.ndarray


def on_spring(
    mass: float, carried: float, stiffness: float, speed: float, contact: np.ndarray, flight: np.ndarray
) -> Response:
    """A mass strikes a spring that carries another; they go on as one, and part when the first feels no force.

    (3.15)-(3.17) without the carried mass, (3.19), (3.20) with it: an impulse at once, then a half sine. `bent` is the
    end of the spring, which swings on by itself.
    """
    frequency = np.sqrt(stiffness / (mass + carried))
    start = speed * mass / (mass + carried)
    angle, since = frequency * contact, flight - contact[-1]
    swing, swing_rate = np.zeros_like(since), np.zeros_like(since)
    if carried:
        own = np.sqrt(stiffness / carried)
        swing, swing_rate = -start / own * np.sin(own * since), -start * np.cos(own * since)
    depth, rate = start / frequency * np.sin(angle), start * np.cos(angle)
    impulse = mass * (speed - start) + mass * start * 2.0 * np.sin(0.5 * angle) ** 2
    return Response(
        time=np.concatenate((contact, flight)),
        force=_then(mass * frequency * start * np.sin(angle), 0.0 * since),
        impulse=_then(impulse, impulse[-1] + 0.0 * since),
        position=_then(depth, -start * since),
        velocity=_then(rate, -start + 0.0 * since),
        bent=_then(depth, swing),
        bent_rate=_then(rate, swing_rate),
    )


def against_equal(
    mass: float, stiffness: float, speed: float, start: float, contact: np.ndarray, flight: np.ndarray
) -> Response:
    """A rod strikes its equal that comes as fast, or a rigid stop; it bends as a rod that hangs under its own weight.

    `bent` is the approach x1 of its middle to the touching face, which starts at the rate `start`; force (3.23).
    Position and velocity are those of the centre of mass, by the impulse of the force.
    """
    frequency = np.sqrt(SQUARE * stiffness / mass)
    angle, since = frequency * contact, flight - contact[-1]
    pull = 8.0 / 3.0 * stiffness * start
    impulse = pull / frequency**2 * 2.0 * np.sin(0.5 * angle) ** 2
    position = speed * contact - pull / (frequency**2 * mass) * (contact - np.sin(angle) / frequency)
    after = speed - impulse[-1] / mass
    return Response(
        time=np.concatenate((contact, flight)),
        force=_then(pull / frequency * np.sin(angle), 0.0 * since),
        impulse=_then(impulse, impulse[-1] + 0.0 * since),
        position=_then(position, position[-1] + after * since),
        velocity=_then(speed - impulse / mass, after + 0.0 * since),
        bent=_then(start / frequency * np.sin(angle), 0.0 * since),
        bent_rate=_then(start * np.cos(angle), 0.0 * since),
    )


def _then(during: np.ndarray, after: np.ndarray) -> np.ndarray:
    return np.concatenate((during, after))
