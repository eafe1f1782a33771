"""The contact force from what gauges on the rod have measured, without a word about the impactor or its contact.

Stress at x is what runs outward plus what comes back, each without change of shape:

    stress(x, t) = sent(t - x / c) + returned(t + x / c)

with both waves taken as they pass the struck end, where the contact force is A (sent + returned). Time zero of a
record must be that of the first touch, so that the section at x is at rest until x / c.
Assumes: plane waves: sections several radii from the struck end, frequencies below about 0.1 c / radius (above it waves
disperse).
Error: second order in the step h of the records, which are straight between samples; h^1.5 at the corners of a Hertz
pulse; a jump is blurred over h. Interpolation never enlarges noise.
Cost: rows times echoes; 24 million readings take half a second.
Source: thesis 9.6 (strain is a replica of the contact force some instants before), 4.2.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import validation
from ..validation import SceneError, allowed, bound_beside
from .record import Record, as_stress
from .refused import RecordError

MOST_READINGS = 50_000_000  # interpolated for the sums below: a second or two


@dataclass(frozen=True)
class RecoveredWaves:
    """Both waves at the struck end of a rod, as far as the records reach."""

    rod: Any
    time: np.ndarray  # (n,) [s] from first touch, evenly spaced
    sent: np.ndarray  # (n,) stress of the wave that runs into the rod [Pa]
    returned: np.ndarray  # (n,) stress of the wave that arrives [Pa]
    terms: int  # readings added up in a wave at the last instant: its white noise grows by the root of this number

    @property
    def force(self) -> np.ndarray:
        """Contact force [N]."""
        return self.rod.area * (self.sent + self.returned)

    @property
    def velocity(self) -> np.ndarray:
        """Of the struck end [m/s], for a rod at rest before the impact."""
        return (self.sent - self.returned) * self.rod.area / self.rod.impedance

    def stress(self, x: float) -> tuple[np.ndarray, np.ndarray]:
        """Times [s] at which the stress [Pa] at section `x` [m] is known, and the stress."""
        lag = validation.number("x", x, 0.0, self.rod.length, "m", "rod") / self.rod.wave_speed
        times = self.time[self.time <= self.time[-1] - lag]
        sent = np.interp(times - lag, self.time, self.sent, left=0.0)
        return times, sent + np.interp(times + lag, self.time, self.returned)


def from_one_gauge(record: Record, rod: Any, x: float) -> RecoveredWaves:
    """The waves from one record of strain, stress or force at section `x` [m], the far end being known.

    That end turns a wave s into r s, with r = -1 free, +1 fixed, 0 where it never comes back. So

        record(t) = s(t - x/c) + r s(t - T + x/c),   s(t) = sum over k of (-r)^k record(t + x/c - k D),  D = T - 2 x/c

    The first term alone is the pulse shifted back, exact until t = D; the others take away the echoes of the far end,
    and there are t / D of them. Gauges near the far end are poor (D is small): white noise in the force grows by at
    most the root of 2 t / D + 2, or of twice that at a fixed end; an offset of zero by at most T / D + 1.
    Differs: thesis 9.6 shifts back only, so its record ends where the pulse meets its own reflection.
    Raises SceneError for a rod whose far end carries a mass (use two gauges), or a gauge too near that end.
    """
    if rod.end_mass:
        raise SceneError("target.end_mass", rod.end_mass, allowed("record.no-end-mass"))
    reflection = {"free": -1.0, "fixed": 1.0, "anechoic": 0.0}[rod.support]
    lag = _lag(rod, x)
    delay = rod.round_trip_time - 2.0 * lag
    if reflection and delay < record.step:
        most = rod.length - 0.5 * record.step * rod.wave_speed
        raise SceneError("at", x, allowed("record.one-gauge", most=bound_beside(most, x)))
    quiet, time = _Quiet(record, rod, lag), _instants(record, lag)
    terms = 1 + int(time[-1] / delay) if reflection else 1
    _check_terms(terms, time.size)

    def sent(at):
        return sum((-reflection) ** k * quiet.at(at + lag - k * delay) for k in range(terms))

    return RecoveredWaves(rod, time, sent(time), reflection * sent(time - rod.round_trip_time), terms)


def from_two_gauges(first: Record, second: Record, rod: Any, x1: float, x2: float) -> RecoveredWaves:
    """The waves from records at two sections, x1 < x2 [m], of a rod whose far end may be anything.

    With d = (x2 - x1) / c, the outward wave at the first gauge is

        a(t) = sum over k of [record1(t - 2 k d) - record2(t - (2 k + 1) d)]

    and what is left of record1 comes back. The records need not be sampled alike. Frequencies of k c / (2 (x2 - x1)),
    zero among them, are the same at both gauges and cannot be distinguished: white noise in the force grows by at most
    the root of 2 t / d + 5, an offset between the gauges by at most 2 x1 / (x2 - x1) + 2. Gauges near the struck end
    and far from each other are best.
    """
    lag1, lag2 = _lag(rod, x1), _lag(rod, x2)
    apart = lag2 - lag1
    if not apart >= max(first.step, second.step):
        least = max(first.step, second.step) * rod.wave_speed
        raise SceneError("at", x2, allowed("record.second-gauge", least=bound_beside(x1 + least, x2)))
    one, two = _Quiet(first, rod, lag1), _Quiet(second, rod, lag2)
    ends = min(first.time[-1] - lag1, second.time[-1] + apart - lag1)
    time = _instants(first, lag1, ends)
    pairs = 1 + int(time[-1] / (2.0 * apart))
    _check_terms(2 * pairs, time.size)

    def outward(at):  # at the first gauge
        return sum(one.at(at - 2 * k * apart) - two.at(at - (2 * k + 1) * apart) for k in range(pairs))

    returned = one.at(time - lag1) - outward(time - lag1)
    return RecoveredWaves(rod, time, outward(time + lag1), returned, 2 * pairs)


class _Quiet:
    """A record as stress, nothing before the first wave can have come: what is measured earlier is noise."""

    def __init__(self, record: Record, rod: Any, lag: float):
        self._time, self._stress, self._lag = record.time, as_stress(record, rod), lag
        if record.time[0] > lag + record.step:
            raise RecordError("begins-late", float(record.time[0]), start=record.time[0], time=lag)

    def at(self, times: np.ndarray) -> np.ndarray:
        slack = 1e-9 * (self._time[-1] - self._time[0])
        values = np.interp(times, self._time, self._stress, left=0.0)
        return np.where(times >= self._lag - slack, values, 0.0)


def _lag(rod: Any, x: float) -> float:
    return validation.number("at", x, 0.0, rod.length, "m", "rod") / rod.wave_speed


def _instants(record: Record, lag: float, ends: float = math.inf) -> np.ndarray:
    """From first touch to the last instant that the record covers, at the record's own step."""
    last = min(float(record.time[-1]) - lag, ends)
    if not last >= 2.0 * record.step:
        raise RecordError("ends-early", last, end=record.time[-1], time=lag)
    return np.arange(0, math.floor(last / record.step * (1.0 + 1e-12)) + 1) * record.step


def _check_terms(terms: int, instants: int) -> None:
    if terms * instants > MOST_READINGS:
        raise RecordError("echoes", instants, rows=instants, most=MOST_READINGS // terms, terms=terms)
