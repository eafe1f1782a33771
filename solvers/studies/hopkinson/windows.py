"""Where the incident, the reflected and the transmitted pulse stand in records of two gauges.

The incident pulse is found by itself; the others follow from the places of the gauges and the speeds of waves. What
comes by before the first pulse is noise about the zero of the gauges.
"""

import math
from typing import NamedTuple

import numpy as np

from ...records import Record
from ...records.refused import RecordError
from ...text.notes import Note, Severity
from ...validation import SceneError, allowed, number
from .bars import Bars, GaugedBar

LEAST_QUIET = 8  # samples before the pulse
LEAST_SAMPLES = 12  # within it
FEWEST_BITS = 16  # levels of a record: with fewer it is an ideal one, not one of a coarse converter
SURE = 5.0  # standard deviations: no sample of noise lies beyond
ROUGH = 0.4  # of the largest strain, which may be twice that of the incident pulse where pulses meet later on
FOOT = 0.01  # of the pulse: it begins there, if noise allows
LEAD = 0.05  # of the pulse: windows begin so much before it
ENDED = 0.1  # of the pulse: below that it has ended
OFF = 0.02  # of the way: later or earlier than that the reflected pulse is said to be


class Gauge(NamedTuple):
    """A record as strain of a bar, positive where the test loads it, zero being that before the pulse."""

    time: np.ndarray  # (n,) [s]
    strain: np.ndarray  # (n,)
    step: float  # [s]
    noise: float  # standard deviation
    offset: float  # of the record's zero, tension positive
    quiet: int  # samples of which noise and offset are known

    def at(self, times: np.ndarray) -> np.ndarray:
        """Straight between samples."""
        return np.interp(times, self.time, self.strain)


class Windows(NamedTuple):
    """Begin and length of the three windows; all are of one length."""

    start: float  # of the incident pulse at its gauge [s]
    length: float  # [s]
    height: float  # of the incident pulse, median of its upper half, strain
    duration: float  # of the incident pulse, at half of its height [s]
    tension: bool  # whether the first pulse is tensile
    incident: Gauge
    transmitted: Gauge
    notes: tuple[Note, ...]

    def starts(self, bars: Bars) -> tuple[float, float, float]:
        """Of the windows of incident, reflected and transmitted pulse [s]."""
        there = self.start + bars.incident.delay
        return self.start, there + bars.incident.delay, there + bars.transmitted.delay


def find_windows(
    records: tuple[Record, Record], bars: Bars, start: float | None = None, length: float | None = None
) -> Windows:
    """`start` and `length` of the windows [s] where they are not to be found.

    Raises SceneError where pulses overlap, or the record does not show them.
    """
    one, two = (as_strain(record, bar) for record, bar in zip(records, (bars.incident, bars.transmitted), strict=True))
    rough, tension = _rough_start(records[0], one)
    sign = 1.0 if tension else -1.0
    incident = _gauge(records[0], one, rough, sign)
    transmitted = _gauge(records[1], two, rough, sign)
    ends = rough + 2.0 * bars.incident.delay
    begun = (incident.time >= rough) & (incident.time <= ends)
    peak = float(incident.strain[begun].max(initial=0.0))
    if not SURE * incident.noise < 0.5 * peak:
        raise RecordError("hopkinson-noise", peak, peak=1e6 * peak, noise=1e6 * incident.noise)
    upper = incident.strain[begun & (incident.strain > 0.5 * peak)]
    height = float(np.median(upper))
    found = start is None
    if start is None:
        start = _foot(incident, height, max(SURE * incident.noise, FOOT * height))
    else:
        start = number("start", start, float(incident.time[0]), rough, "s")  # by then it has risen
    arrival = start + 2.0 * bars.incident.delay
    if arrival > incident.time[-1] - LEAST_SAMPLES * incident.step:
        raise RecordError("hopkinson-short", float(incident.time[-1]), end=incident.time[-1], arrival=arrival)
    ended, duration = _ended(incident, bars, start, arrival, height)
    notes = [] if not tension else [Note("hopkinson.tension", Severity.REMARK)]
    notes += _tail(incident, ended, arrival, height)
    notes += _arrives(incident, bars.incident, start, ended, arrival)
    if found:  # the foot of the pulse lies in the noise
        start -= min(LEAD * (ended - start), 0.25 * (arrival - ended), start - float(incident.time[0]))
    known = Windows(start, ended - start, height, duration, tension, incident, transmitted, tuple(notes))
    return _within_reach(known, bars, length)


def as_strain(record: Record, bar: GaugedBar) -> np.ndarray:
    """The values of a record as strain of its bar, tension positive."""
    factor = {"strain": 1.0, "stress": -1.0 / bar.young, "force": -1.0 / (bar.young * bar.area)}[record.kind]
    return factor * record.values


def _rough_start(record: Record, strain: np.ndarray) -> tuple[float, bool]:
    """When so much of the largest strain is first reached, and whether in tension."""
    moved = strain - np.median(strain[:LEAST_QUIET])
    largest = float(np.abs(moved).max())
    if largest == 0.0:
        raise RecordError("constant", float(record.values[0]), value=record.values[0])
    first = int(np.argmax(np.abs(moved) > ROUGH * largest))
    return float(record.time[first]), bool(moved[first] > 0.0)


def _gauge(record: Record, strain: np.ndarray, rough: float, sign: float) -> Gauge:
    """With zero and noise of what is before the pulse, but for the last quarter, where it may rise already."""
    quiet = int(0.75 * np.count_nonzero(record.time < rough))
    if quiet < LEAST_QUIET:
        raise RecordError("hopkinson-quiet", quiet, samples=quiet, least=LEAST_QUIET)
    offset = float(strain[:quiet].mean())
    steps = np.diff(np.unique(strain))
    bit = float(steps.min()) if steps.size > FEWEST_BITS else 0.0  # of the converter: below it noise is not seen
    noise = max(float(strain[:quiet].std(ddof=1)), bit / math.sqrt(12.0))
    return Gauge(record.time, sign * (strain - offset), record.step, noise, offset, quiet)


def _foot(gauge: Gauge, height: float, threshold: float) -> float:
    """Where the pulse leaves the noise: between the last sample below the threshold, before half its height, and the
    next."""
    half = int(np.argmax(gauge.strain > 0.5 * height))
    below = np.flatnonzero(gauge.strain[:half] <= threshold)
    at = int(below[-1]) if below.size else 0
    first, second = gauge.strain[at], gauge.strain[at + 1]
    part = (threshold - first) / (second - first) if second > first else 0.0
    return float(gauge.time[at] + part * (gauge.time[at + 1] - gauge.time[at])) if part < 1.0 else float(gauge.time[at])


def _ended(gauge: Gauge, bars: Bars, start: float, arrival: float, height: float) -> tuple[float, float]:
    """When the incident pulse has ended, and how long it lasts at half of its height [s]."""
    known = (gauge.time >= start) & (gauge.time <= arrival - gauge.step)
    time, strain = gauge.time[known], gauge.strain[known]
    if not (strain > 0.5 * height).any():
        raise _overlap(bars)
    up = int(np.argmax(strain > 0.5 * height))
    down = up + int(np.argmax(strain[up:] < 0.5 * height))
    foot = down + int(np.argmax(strain[down:] < max(ENDED * height, 2.0 * gauge.noise)))
    if down == up or not strain[foot] < max(ENDED * height, 2.0 * gauge.noise):
        raise _overlap(bars)
    return float(time[foot]), float(time[down] - time[up])


def _overlap(bars: Bars) -> SceneError:
    """What would do: a gauge further from the specimen, or a shorter striker."""
    bar = bars.incident
    pulse = 0.0 if bars.striker is None else bars.striker.pulse
    needed = 0.5 * pulse * bar.wave_speed
    speed = bar.wave_speed if bars.striker is None else bars.striker.bar.wave_speed
    values = {"pulse": pulse, "needed": needed, "between": 2.0 * bar.delay, "striker": bar.delay * speed}
    return SceneError("incident.gauge", bar.gauge, allowed("gauge-apart", known=needed > bar.gauge, **values))


def _tail(gauge: Gauge, ended: float, arrival: float, height: float) -> list[Note]:
    """What is left of the incident pulse when its reflection comes."""
    last = gauge.strain[(gauge.time >= max(ended, arrival - 0.25 * (arrival - ended))) & (gauge.time < arrival)]
    if last.size < 3:
        return []
    share, unsure = float(last.mean()) / height, SURE * gauge.noise / height / math.sqrt(min(last.size, gauge.quiet))
    if abs(share) <= max(0.02, unsure):
        return []
    return [Note("hopkinson.tail", Severity.WARNING, share=share)]


def _arrives(gauge: Gauge, bar: GaugedBar, start: float, ended: float, arrival: float) -> list[Note]:
    """Whether the reflected pulse comes when gauge and speed say, where it stands clear of the incident one."""
    span = min(ended - start, gauge.time[-1] - arrival)
    late = (gauge.time > ended + 0.1 * (arrival - ended)) & (gauge.time <= arrival + span)
    time, back = gauge.time[late], -gauge.strain[late]
    peak = float(back.max(initial=0.0))
    level = max(0.1 * peak, 2.0 * SURE * gauge.noise)
    if peak <= 2.0 * level or np.count_nonzero(time < arrival) < LEAST_QUIET or back[0] > 0.5 * level:
        return []
    own = gauge.strain[(gauge.time >= start) & (gauge.time <= ended)]
    begins = gauge.time[gauge.time >= start][int(np.argmax(own > level / peak * float(own.max())))]
    way = float(time[int(np.argmax(back > level))] - begins)
    if abs(way - 2.0 * bar.delay) <= max(3.0 * gauge.step, OFF * 2.0 * bar.delay):
        return []
    by = way - 2.0 * bar.delay
    values = {"late": by >= 0.0, "by": abs(by), "speed": 2.0 * bar.gauge / way}
    return [Note("hopkinson.arrival", Severity.WARNING, **values)]


def _within_reach(found: Windows, bars: Bars, length: float | None) -> Windows:
    """With windows no longer than no echo and no end of the record falls into."""
    one, two = bars.incident, bars.transmitted
    starts = found.starts(bars)
    reach = {
        "incident": 2.0 * (one.length - one.gauge) / one.wave_speed,
        "transmitted": 2.0 * (two.length - two.gauge) / two.wave_speed,
        "record": min(float(found.incident.time[-1]) - starts[1], float(found.transmitted.time[-1]) - starts[2]),
    }
    why = min(reach, key=lambda name: reach[name])
    step = found.incident.step
    if reach[why] < LEAST_SAMPLES * step:
        raise RecordError("hopkinson-reach", reach[why], why=why, reach=reach[why], least=LEAST_SAMPLES * step)
    if length is not None:
        most = min(reach[why], 2.0 * one.delay)
        return found._replace(length=number("window", length, LEAST_SAMPLES * step, most, "s", "record"))
    if found.length < LEAST_SAMPLES * step:
        raise RecordError("hopkinson-steps", found.length, length=found.length, step=step, least=LEAST_SAMPLES)
    if found.length <= reach[why] + step:
        return found._replace(length=min(found.length, reach[why]))
    note = Note("hopkinson.cut", Severity.WARNING, why=why, wanted=found.length, reach=reach[why])
    return found._replace(length=reach[why], notes=(*found.notes, note))
