"""What the criteria of a sketch say of a line: the exact curve must get every `yes`, which `check` sees to.

A line is one value for each hundredth of T, in units of the chart; over a map for each hundredth of what is shown, in
shares of it. The page judges by the same rules.
"""

import math
from typing import NamedTuple

import numpy as np

from solvers import Solution

from .lesson import Boundary, Judge, Sketch, Time

BIN = 0.01  # [T]
NOTHING = 0.025  # of the height of the chart: what is drawn below is zero
SHORT, LONG = 5, 15  # bins on either side of a rise; a jump is steep, a hump rises over the longer stretch
STEEP = 0.6  # least share of the long rise that a jump has in the short one
SLIGHT = 0.4  # least share of its height from which a rise is a small jump
GAP = 10  # bins without force behind which they have parted
BREAK = 3  # bins without force between two contacts
SCALES = {"kN": 1e-3, "N": 1.0}


class Verdict(NamedTuple):
    """The outcome of a criterion, and two times [T], NaN where there are none: in the line, and in truth."""

    outcome: str
    yours: float = math.nan
    true: float = math.nan


def exact_line(solution: Solution, sketch: Sketch, until: float) -> np.ndarray:
    """The contact force of a solution until this time [T], shape (bins,), in units of the chart."""
    time = BIN * np.arange(round(until / BIN) + 1)
    found = np.interp(time * solution.scene.time_unit, solution.time, solution.force, right=0.0)
    found[0] = found[1]  # it begins at once, where a front sets out
    return SCALES[sketch.unit] * found


def exact_boundary(sketch: Boundary) -> np.ndarray:
    """The line over a map that was solved for, shape (bins,)."""
    places = np.linspace(0.0, 1.0, len(sketch.truth))
    return np.interp(np.linspace(0.0, 1.0, round(1.0 / BIN) + 1), places, sketch.truth)


def judged(line: np.ndarray, sketch: Sketch, times: dict[str, float]) -> list[Verdict]:
    """One verdict for each criterion; `times` of events [T]. Gaps of a line are to be filled before."""
    zero = NOTHING * (sketch.axis[1] - sketch.axis[0])
    truth = exact_boundary(sketch) if isinstance(sketch, Boundary) else line
    return [JUDGED[each.criterion](_Line(line, zero, truth), each, _when(each, times)) for each in sketch.judges]


def _when(judge: Judge, times: dict[str, float]) -> tuple[float, float]:
    first, last = judge.at if isinstance(judge.at, tuple) else (judge.at, judge.at)
    return _time(first, times), _time(last, times)


def _time(given: Time, times: dict[str, float]) -> float:
    return times[given] if isinstance(given, str) else given


class _Line:
    def __init__(self, values: np.ndarray, zero: float, truth: np.ndarray):
        self.values, self.nothing, self.truth = values, values <= zero, truth

    def between(self, first: float, last: float) -> np.ndarray:
        """Values of a stretch [T]."""
        return self.values[max(round(first / BIN), 0) : max(round(last / BIN) + 1, 0)]

    def parted(self) -> int | None:
        """The bin from which on there is no force for a while; behind the first contact."""
        for start in range(GAP, self.values.size - GAP):
            if self.nothing[start : start + GAP].all() and not self.nothing[:start].all():
                return start
        return None

    def rise(self, place: int, reach: int) -> float:
        """By how much it grows around a bin."""
        low, high = max(place - reach, 0), min(place + reach, self.values.size - 1)
        return float(self.values[high] - self.values[low])

    def jumps(self, least: float) -> list[tuple[float, float]]:
        """Steep rises, (time [T], height) each, but for the beginning, and for those out of a pause."""
        found: list[tuple[float, float]] = []
        run: list[int] = []
        for place in range(LONG, self.values.size):
            paused = self.nothing[max(place - LONG, 0) : place - SHORT].all()
            rise = self.rise(place, SHORT)
            if not paused and rise >= max(least, STEEP * self.rise(place, LONG)):
                run.append(place)
            elif run:
                found.append(self._jump(run))
                run = []
        return [*found, self._jump(run)] if run else found

    def _jump(self, run: list[int]) -> tuple[float, float]:
        """Where half of a rise is reached."""
        low, high = max(run[0] - SHORT, 0), min(run[-1] + SHORT, self.values.size - 1)
        part = self.values[low : high + 1]
        height = max(self.rise(place, SHORT) for place in run)
        half = float(part.min()) + 0.5 * float(part.max() - part.min())
        steepest = low + int(np.argmax(part >= half))
        return BIN * steepest, height


def _falls(line: _Line, judge: Judge, when: tuple[float, float], sign: float = 1.0) -> Verdict:
    """Nowhere above what it was before, by more than the slack, and in the end below; close to both ends it may be
    anything."""
    part = sign * line.between(when[0] + judge.within, when[1] - judge.within)
    level = part.size > 0 and part[0] - part[-1] <= judge.slack
    fine = part.size == 0 or (not level and (part - np.minimum.accumulate(part)).max() <= judge.slack)
    return Verdict("yes" if fine else "no")


def _rises(line: _Line, judge: Judge, when: tuple[float, float]) -> Verdict:
    return _falls(line, judge, when, -1.0)


def _jump(line: _Line, judge: Judge, when: tuple[float, float]) -> Verdict:
    jumps = line.jumps(SLIGHT * judge.by)
    high = [each for each in jumps if each[1] >= judge.by]
    if not jumps:
        return Verdict("none", true=when[0])
    time, height = min(high or jumps, key=lambda each: abs(each[0] - when[0]))
    if abs(time - when[0]) <= judge.within + 1e-9:
        return Verdict("yes" if height >= judge.by else "small", time, when[0])
    if not high:
        return Verdict("none", true=when[0])
    return Verdict("early" if time < when[0] else "late", time, when[0])


def _zero_from(line: _Line, judge: Judge, when: tuple[float, float]) -> Verdict:
    parted = line.parted()
    if parted is None:
        return Verdict("none", true=when[0])
    time = BIN * parted
    if abs(time - when[0]) <= judge.within + 1e-9:
        return Verdict("yes", time, when[0])
    return Verdict("early" if time < when[0] else "late", time, when[0])


def _push(line: _Line, judge: Judge, when: tuple[float, float]) -> Verdict:
    """A second hump, behind a pause."""
    first, last = round((when[0] - judge.within) / BIN), round((when[1] + judge.within) / BIN)
    part = line.values[max(first, 0) : max(last + 1, 0)]
    if part.size == 0 or part.max() < judge.above:
        return Verdict("none", true=when[0])
    highest = max(first, 0) + int(part.argmax())
    begun = int(np.argmax(~line.nothing))
    pauses = np.convolve(line.nothing[begun:highest], np.ones(BREAK), "valid") if highest - begun >= BREAK else []
    return Verdict("yes" if np.any(np.asarray(pauses) > BREAK - 0.5) else "none", BIN * highest, when[0])


def _zero_beyond(line: _Line, judge: Judge, when: tuple[float, float]) -> Verdict:
    part = line.values[round((when[0] + judge.within) / BIN) :]
    return Verdict("yes" if part.size == 0 or part.max() <= judge.slack else "no", true=when[0])


def _near(line: _Line, judge: Judge, when: tuple[float, float]) -> Verdict:
    """Nowhere farther from the truth than it may be."""
    first, last = round(when[0] / BIN), round(when[1] / BIN)
    off = (line.values - line.truth)[first : last + 1]
    worst = int(np.abs(off).argmax())
    place = BIN * (first + worst)
    if abs(off[worst]) <= judge.within + 1e-9:
        return Verdict("yes", place, place)
    return Verdict("high" if off[worst] > 0.0 else "low", place, place)


JUDGED = {
    "near": _near,
    "falls": _falls,
    "rises": _rises,
    "jump": _jump,
    "zero-from": _zero_from,
    "push": _push,
    "zero-beyond": _zero_beyond,
}
