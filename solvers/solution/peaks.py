"""The largest values of an impact, with the instant and the place: what a designer asks of a solution."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ..text.notes import Note, Severity
from .motion import Bends, ResolvesForce, SendsWaves, knows_field

PLACES = 90  # intervals along the bodies at which fields are looked at first
INSTANTS, PER_UNIT, MOST = 400, 180, 4_800  # at which they are: at least, in each unit of time, at most
FEW, MORE = 2, 10  # so few places are looked at so many times as often
TRIED = 4  # local maxima that are looked at closer
FINER, ROUNDS = 11, 2  # points around each, each time between the two beside the largest
CLOSE = 1e-9  # of a rod's length, of the first and the last place from its ends
NUDGE = 1e-9  # of the unit of time, by which a front is behind rather than at a place
PER_TRIP, PER_PULSE = 400, 50  # instants at which a wave is sent, in each unit of time and in the shortest contact
SENT = 4_000, 40_000  # of them at least and at most
ROUNDING = 1e-12  # of a wave's time through a rod
ALIKE = 1e-9  # of the largest: which of those that are as large is said must not hang on rounding; the first
NOTHING = 1e-9  # of the stress of a front: rounding

Field = Callable[[np.ndarray, np.ndarray], np.ndarray]  # of times and places, (time, x)


class Peak(NamedTuple):
    """Value with its sign, when [s], and where [m] in the coordinate x of fields; None of what has no place."""

    value: float
    time: float
    x: float | None = None


def _acceleration(solution: Any) -> Peak | None:
    """Of a rigid impactor by the contact force, as an accelerometer on it shows: F / m, without its weight."""
    force = solution.peak_force
    if solution.motion is None or not solution.scene.impactor.free_mass or not force:
        return None
    motion = solution.known_motion
    time, known = motion.force_history()[0], [motion.force]
    if isinstance(motion, ResolvesForce):
        known.append(motion.resolved_force)
    history, force_at = min(((each(time), each) for each in known), key=lambda pair: abs(pair[0].max() - force))
    largest = _first(history)
    start, end = time[max(largest - 1, 0)], time[min(largest + 1, time.size - 1)]
    when = start if start == end else _zoomed(_over_time(force_at), start, end, np.zeros(1)).time
    return Peak(force / solution.scene.impactor.mass, float(when))


def _displacement(solution: Any) -> Peak | None:
    """Of the struck face of a body that does not go off as a whole, along the way of the impactor."""
    target = solution.scene.target
    if solution.motion is None or not (target.fixed or target.endless) or target.turns or np.isinf(target.mass):
        return None
    found = _largest(solution, _over_time(solution.known_motion.end_position), np.zeros(1))
    return found and found._replace(x=None)


def _deflection(solution: Any) -> Peak | None:
    """Of a held beam across its length, wherever it is largest; None of free beams, which go off as wholes."""
    if not _bends(solution) or not solution.scene.target.held:
        return None
    return _largest(solution, solution.known_motion.displacement, _places(solution))


def _stress(solution: Any) -> Peak | None:
    """Along rods, in the striking one where x < 0; in the outer fibre of a beam. Compression, or that of the side that
    is struck, is positive."""
    if _sends_waves(solution):
        pressed, pulled = (_of_waves(solution, sign) for sign in (1.0, -1.0))
        return _first_largest([peak for peak in (pressed, pulled) if peak is not None])
    if _stressed_along(solution) or _bends(solution):
        return _largest(solution, solution.known_motion.stress, _places(solution))
    return None


def _tension(solution: Any) -> Peak | None:
    """The largest tensile stress along rods, positive: where they spall."""
    if _sends_waves(solution):
        found = _of_waves(solution, -1.0)
    elif _stressed_along(solution):
        stress = solution.known_motion.stress
        found = _largest(solution, lambda time, x: np.minimum(stress(time, x), 0.0), _places(solution))
    else:
        return None
    rod = _rods(solution)[0]
    front = solution.scene.meeting_speed * rod.impedance / rod.area
    return found._replace(value=-found.value) if found and -found.value > NOTHING * front else None


def _moment(solution: Any) -> Peak | None:
    """Bending moment of a beam."""
    return _largest(solution, solution.known_motion.moment, _places(solution)) if _bends(solution) else None


def _support_force(solution: Any) -> Peak | None:
    """Of the support that has most to bear: compression of a rod's held end or of a spring, shear at a beam's end,
    by the impact alone, without what weight has put there before. None of a beam that is struck rigidly: there it
    grows with the number of modes."""
    if solution.motion is None or not solution.scene.target.held:
        return None
    motion, target = solution.known_motion, solution.scene.target
    if _bends(solution):
        if solution.scene.rigid_contact:
            return None
        return _largest(solution, motion.shear, np.array([0.0, target.length]))
    if target.rods and _stressed_along(solution):
        area, end, also = target.rods[-1].area, np.array([target.length]), np.zeros(0)
        if _sends_waves(solution):
            unit, last = solution.scene.time_unit, len(_rods(solution)) - 1
            sent = solution.motion.jumps(last, True, solution.duration / unit)
            also = sent * unit + 0.5 * target.rods[-1].round_trip_time
        return _largest(solution, lambda time, x: area * motion.stress(time, x), end, also)
    if target.half_swing is not None:
        pressed = _over_time(motion.end_position)
        found = _largest(solution, lambda time, x: pressed(time, x) / target.softness, np.zeros(1))
        return found and found._replace(x=None)
    return None


class Asked(NamedTuple):
    """A figure: unit, and how a solution gives it."""

    unit: str
    find: Callable[[Any], Peak | None]


PEAKS = {
    "acceleration": Asked("m/s2", _acceleration),
    "displacement": Asked("m", _displacement),
    "deflection": Asked("m", _deflection),
    "stress": Asked("Pa", _stress),
    "tension": Asked("Pa", _tension),
    "moment": Asked("N m", _moment),
    "support_force": Asked("N", _support_force),
}


class Peaks(dict[str, Peak]):
    """Those that a solution has, by name; `remarks`: what is to be known of them, that its notes do not say."""

    remarks: list[Note]


def peaks_of(solution: Any) -> Peaks:
    """All of them."""
    found = Peaks((name, peak) for name, asked in PEAKS.items() if (peak := asked.find(solution)) is not None)
    by_method = "stress" in found and _stressed_along(solution) and not _sends_waves(solution)
    found.remarks = [Note("peaks-by-method", Severity.REMARK)] if by_method else []
    return found


def _bends(solution: Any) -> bool:
    """Whether the target is one beam, and its motion knows how that is bent."""
    target = solution.scene.target
    return target.bends and target.kind == "beam" and isinstance(solution.motion, Bends)


def _stressed_along(solution: Any) -> bool:
    """Whether rods are struck along their axis, and the motion knows their stress."""
    return (
        solution.motion is not None
        and knows_field(solution.motion)
        and not solution.scene.target.bends
        and bool(_rods(solution))
    )


def _sends_waves(solution: Any) -> bool:
    """Whether it knows the waves in its rods one by one."""
    return isinstance(solution.motion, SendsWaves) and _stressed_along(solution)


def _rods(solution: Any) -> tuple[Any, ...]:
    """From left to right, those of the impactor before those of the target."""
    scene = solution.scene
    return (*(() if scene.target.bends else scene.impactor.rods[::-1]), *scene.target.rods)


def _over_time(history: Callable[[np.ndarray], np.ndarray]) -> Field:
    """A history as a field that has one place."""
    return lambda time, _: np.asarray(history(time), float)[:, None]


def _places(solution: Any) -> np.ndarray:
    """Evenly along each body, close to both sides of every change of section, and where a beam is struck."""
    if _bends(solution):
        target = solution.scene.target
        return np.union1d(np.linspace(0.0, target.length, PLACES + 1), target.place)
    edges = _edges(solution)
    count = max(PLACES // (edges.size - 1), 10)
    inside = np.linspace(CLOSE, 1.0 - CLOSE, count + 1)
    return np.concatenate([left + inside * (right - left) for left, right in pairwise(edges)])


def _edges(solution: Any) -> np.ndarray:
    """Where the rods begin and end [m]; x = 0 where the bodies meet."""
    edges = np.concatenate(([0.0], np.cumsum([rod.length for rod in _rods(solution)])))
    return edges - edges[len(_rods(solution)) - len(solution.scene.target.rods)]


def _of_waves(solution: Any, sign: float) -> Peak | None:
    """The largest compression (`sign` 1) or tension (-1) in rods whose waves are known, with its sign.

    At any place stress is the sum of two waves, sent from the left end at u and from the right one at w, and any two
    with |w - u| up to the time a wave takes through the rod meet somewhere: the largest of one, with the largest of the
    other in that window.
    """
    motion, scene = solution.known_motion, solution.scene
    unit, reach, edges = scene.time_unit, solution.duration / scene.time_unit, _edges(solution)
    shortest = min((contact.duration for contact in solution.contacts if contact.duration > 0.0), default=unit)
    count = int(np.clip(reach * max(PER_TRIP, PER_PULSE * unit / shortest), *SENT))
    found = []
    for number, rod in enumerate(_rods(solution)):
        lag = 0.5 * rod.round_trip_time / unit
        (u, right), (w, left) = (_sent(motion, number, way, lag, reach, count, sign) for way in (True, False))
        first = np.searchsorted(w, u - lag * (1.0 + ROUNDING))
        last = np.searchsorted(w, np.minimum(u + lag, 2.0 * reach - lag - u) + lag * ROUNDING, "right")
        some = np.flatnonzero(last > first)
        sums = right[some] + _largest_within(left, first[some], last[some])
        if not some.size or sums.max() <= 0.0:
            continue
        best = some[_first(sums)]
        met = first[best] + _first(left[first[best] : last[best]])
        share = np.clip(0.5 * (w[met] - u[best] + lag) / lag, 0.0, 1.0)
        when = np.clip(0.5 * (u[best] + w[met] + lag), 0.0, reach) * unit
        value = sign * sums.max() * scene.impedance * scene.speed / rod.area
        found.append(Peak(float(value), float(when), float(edges[number] + share * rod.length)))
    return _first_largest(found)


def _first(values: np.ndarray) -> int:
    """Of the largest; of several that are as large the first."""
    largest = values.max()
    return int(np.argmax(values >= largest - ALIKE * abs(largest)))


def _first_largest(found: list[Peak]) -> Peak | None:
    """By size; of several that are as large the earliest, and compression before tension."""
    if not found:
        return None
    least = max(abs(peak.value) for peak in found) * (1.0 - ALIKE)
    return min((peak for peak in found if abs(peak.value) >= least), key=lambda peak: (-np.sign(peak.value), peak.time))


def _sent(motion: SendsWaves, number: int, right_going: bool, lag: float, reach: float, count: int, sign: float):
    """Times [T] and the waves sent then by an end of a rod, `sign` of them [Z v], with both values of every jump."""
    even = np.concatenate(([-lag], np.linspace(0.0, reach, count)))
    times = np.repeat(np.union1d(even, motion.jumps(number, right_going, reach)[:count]), 2)
    values = np.empty(times.size)
    for side in (0, 1):
        values[side::2] = motion.sent(number, right_going, times[side::2], bool(side))
    return times, sign * values


def _largest_within(values: np.ndarray, first: np.ndarray, last: np.ndarray) -> np.ndarray:
    """The largest of values[first:last] of each pair, none of which is empty."""
    levels = [values]  # the largest of 1, 2, 4, ... from each place on
    while 2 ** len(levels) <= values.size:
        step = 2 ** (len(levels) - 1)
        levels.append(np.maximum(levels[-1][:-step], levels[-1][step:]))
    level = np.log2(last - first).astype(int)
    found = np.empty(first.size)
    for power in np.unique(level):
        here = level == power
        found[here] = np.maximum(levels[power][first[here]], levels[power][last[here] - 2**power])
    return found


def _largest(solution: Any, field: Field, places: np.ndarray, also: np.ndarray | None = None) -> Peak | None:
    """By size, of a field in all its time; None where there is nothing of it.

    Looked at where a front of waves in one rod is at one of the places, at the instants `also` and just after them,
    then finer around the largest.
    """
    unit = solution.scene.time_unit or solution.duration
    often = MORE if places.size <= FEW else 1
    step = unit / (PER_UNIT * often)
    while solution.duration / step < INSTANTS * often:
        step /= 2.0
    step *= max(1.0, np.ceil(solution.duration / step / (MOST * often)))
    times = np.arange(int(solution.duration / step) + 1) * step
    times = np.concatenate((times, [solution.duration], () if also is None else also[:MOST]))
    times = np.unique(np.minimum(np.concatenate((times, times + NUDGE * unit)), solution.duration))
    sizes = np.abs(field(times, places))
    if not sizes.any():
        return None
    found = []
    for row, column in _highest(sizes):
        around = places[max(column - 1, 0) : column + 2]
        here = Peak(float(field(times[[row]], places[[column]])[0, 0]), float(times[row]), float(places[column]))
        found += [here, _zoomed(field, times[max(row - 1, 0)], times[min(row + 1, times.size - 1)], around)]
    return _first_largest(found)


def _highest(sizes: np.ndarray) -> list[tuple[int, int]]:
    """Rows and columns of the highest local maxima."""
    framed = np.pad(sizes, 1, constant_values=-1.0)
    beside = np.maximum.reduce([framed[:-2, 1:-1], framed[2:, 1:-1], framed[1:-1, :-2], framed[1:-1, 2:]])
    rows, columns = np.nonzero((sizes >= beside) & (sizes > 0.0))
    order = np.argsort(-np.round(sizes[rows, columns] / (ALIKE * sizes.max())), kind="stable")[:TRIED]
    return list(zip(rows[order].tolist(), columns[order].tolist(), strict=True))


def _zoomed(field: Field, start: float, end: float, places: np.ndarray) -> Peak:
    """The largest by size between two instants and the first and the last of the places, these among them."""
    left, right = places[0], places[-1]
    found = Peak(0.0, float(start), float(left))
    for _ in range(ROUNDS):
        times = np.linspace(start, end, FINER)
        places = np.linspace(left, right, FINER) if right > left else places[:1]
        values = field(times, places)
        row, column = np.unravel_index(np.abs(values).argmax(), values.shape)
        here = Peak(float(values[row, column]), float(times[row]), float(places[column]))
        found = max(found, here, key=lambda peak: abs(peak.value))
        start, end = times[max(row - 1, 0)], times[min(row + 1, FINER - 1)]
        left, right = places[max(column - 1, 0)], places[min(column + 1, places.size - 1)]
    return found
