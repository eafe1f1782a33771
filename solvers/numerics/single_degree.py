"""Structures with one degree of freedom under an impact: closed forms on given instants of contact and of flight.

Source: thesis 3.3.
"""

import math
from typing import NamedTuple, Self

import numpy as np
from numba.extending import register_jitable

from ..jit.kernels import kernel
from .waves.drawn import instant

SQUARE = 2.5  # (3.22): omega_3^2 = 135/54 E A / (L m)
SAMPLES = 1_000  # instants kept of a contact, and of a time unit after it; fewer, and drawn curves have corners
LONGEST_FLIGHT = 20.0  # time units that as many are kept of


class Response(NamedTuple):
    """Arrays (time,): the instants of contact, then those of flight; the parting stands twice."""

    time: np.ndarray  # [s]
    force: np.ndarray  # on the impactor [N]
    impulse: np.ndarray  # [N s]
    position: np.ndarray  # of the impactor [m]
    velocity: np.ndarray
    bent: np.ndarray  # coordinate of the structure [m]
    bent_rate: np.ndarray

    @classmethod
    def of(cls, time: np.ndarray) -> Self:
        """At these instants, not yet solved."""
        return cls(time, *np.empty((len(cls._fields) - 1, time.size)))


@register_jitable
def half_swing(mass, carried, stiffness):
    """Half a period [s] of both on a spring: how long a mass that strikes it stays. Source: thesis (3.17), (3.20)."""
    return math.pi * math.sqrt((mass + carried) / stiffness)


@register_jitable
def energy_of_spring(stiffness, carried, bent, rate):
    """Of a spring with what it carries [J]."""
    return 0.5 * stiffness * bent**2 + 0.5 * carried * rate**2


@register_jitable
def straight(share):
    """Displacement of a rod that bends as a spring at this share of its length, over that of its struck end."""
    return 1.0 - share


@register_jitable
def instants_of(parting, duration, unit):
    """How many: SAMPLES + 1 of the contact, and those of the flight that follows."""
    return SAMPLES + 3 + int(min(SAMPLES * max(duration - parting, 0.0) / unit, LONGEST_FLIGHT * SAMPLES))


@kernel
def spread(parting, duration, time):
    """Write the instants [s] of a contact and of the flight after it, both evenly."""
    contact = SAMPLES + 1
    flight, most = time.size - contact, max(duration - parting, 1e-9 * parting)
    for k in range(contact):
        time[k] = instant(k, contact, parting)
    for k in range(flight):
        time[contact + k] = parting + instant(k, flight, most)


@kernel
def on_spring(mass, carried, stiffness, speed, response):
    """A mass strikes a spring that carries another; they go on as one, and part when the first feels no force.

    (3.15)-(3.17) without the carried mass, (3.19), (3.20) with it: an impulse at once, then a half sine. `bent` is the
    end of the spring, which swings on by itself. response: with its instants as `spread` makes them.
    """
    frequency, own = np.sqrt(stiffness / (mass + carried)), np.sqrt(stiffness / carried) if carried > 0.0 else 0.0
    start, last = speed * mass / (mass + carried), SAMPLES
    for k in range(response.time.size):
        if k <= last:
            angle = frequency * response.time[k]
            depth, rate = start / frequency * np.sin(angle), start * np.cos(angle)
            response.force[k] = mass * frequency * start * np.sin(angle)
            response.impulse[k] = mass * (speed - start) + mass * start * 2.0 * np.sin(0.5 * angle) ** 2
            response.position[k] = response.bent[k] = depth
            response.velocity[k] = response.bent_rate[k] = rate
            continue
        since, swings = response.time[k] - response.time[last], carried > 0.0
        response.force[k], response.impulse[k] = 0.0, response.impulse[last]
        response.position[k], response.velocity[k] = -start * since, -start
        response.bent[k] = -start / own * np.sin(own * since) if swings else 0.0
        response.bent_rate[k] = -start * np.cos(own * since) if swings else 0.0


class Sway(NamedTuple):
    """A mass on a spring under its weight: u = sag + reach sin(frequency t - lag)."""

    frequency: float  # [rad/s]
    start: float  # rate of both as one [m/s]
    sag: float  # at rest under the weight [m]
    reach: float  # [m]
    lag: float  # [rad]
    parting: float  # [s]; infinite where the mass never leaves


def sway(mass: float, carried: float, stiffness: float, speed: float, fall: float) -> Sway:
    """Of a mass that strikes a spring that carries another; `fall` [m/s2] is what its weight gives it.

    They part where the spring would draw the mass down faster than it falls: where u is below the sag by
    fall / frequency^2. Without the carried mass that is u = 0; with it, and a slow impact, they never part.
    """
    frequency, start = math.sqrt(stiffness / (mass + carried)), speed * mass / (mass + carried)
    sag = mass * fall / stiffness
    reach, lag = math.hypot(start / frequency, sag), math.atan2(sag, start / frequency)
    needed = fall / frequency**2 / reach
    parting = (lag + math.pi + math.asin(min(needed, 1.0))) / frequency if needed < 1.0 + 1e-12 else math.inf
    return Sway(frequency, start, sag, reach, lag, parting)


def on_spring_under_weight(
    mass: float, carried: float, stiffness: float, speed: float, fall: float, time: np.ndarray, last: int
) -> Response:
    """`on_spring` where its weight acts on the mass all the time; `last`: number of the instant at which they part."""
    known, response = sway(mass, carried, stiffness, speed, fall), Response.of(time)
    angle = known.frequency * time - known.lag
    swing = known.reach * np.sin(angle)
    depth, rate = known.sag + swing, known.reach * known.frequency * np.cos(angle)
    since, down, left = time - time[last], depth[last], rate[last]
    apart = np.arange(time.size) > last
    own = math.sqrt(stiffness / carried) if carried > 0.0 else 0.0
    freely = (
        down * np.cos(own * since) + left * since * np.sinc(own * since / math.pi),
        -down * own * np.sin(own * since),
    )
    freely = freely[0], freely[1] + left * np.cos(own * since)
    swings = 1.0 if carried > 0.0 else 0.0
    response.force[:] = np.where(apart, 0.0, mass * (fall + known.frequency**2 * swing))
    response.position[:] = np.where(apart, down + since * (left + 0.5 * fall * since), depth)
    response.velocity[:] = np.where(apart, left + fall * since, rate)
    response.bent[:], response.bent_rate[:] = (
        np.where(apart, swings * free, held) for free, held in zip(freely, (depth, rate), strict=True)
    )
    response.impulse[:] = mass * (speed - response.velocity + fall * time)
    response.impulse[last + 1 :] = response.impulse[last]
    return response


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
