"""Whether a lesson holds in its scenes, which are solved: events happen, goals are met, exact curves judged right."""

import math
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import param

from solvers import SceneError, Solution
from solvers.jit.compiling import NotCompiled

from ..choices.choices import Choices
from .answers import Solved, Truth, answers_of, with_answers
from .boundary import boundary_of
from .events import times_of
from .judging import exact_boundary, exact_line, judged
from .lesson import Boundary, Lesson, Number, Order, Part, Scene, Set, Sketch, Span, Step, Time
from .problems import LessonError, Problem, Problems
from .reading import Read, read_in_full
from .scales import value_at
from .showing import has
from .solving import Shown, fallen, meets, solved

PLACES = 9  # of a range, at which a goal is tried
PLACES_ANYWHERE = 41
LEVELS = 101  # heights of a map at which a level line is tried
WIDE = 10.0  # from this ratio of its ends on, places of a range are spaced by a constant factor


class Checked(NamedTuple):
    """`lesson`: None where it cannot be read; `missing`: sentences that a translation has from its original."""

    lesson: Lesson | None
    problems: tuple[Problem, ...]
    missing: tuple[str, ...] = ()


def check(path: Path) -> Checked:
    """All that is wrong with a lesson file, by line."""
    try:
        found = read_in_full(path)
    except LessonError as error:
        return Checked(None, error.problems)
    done = _Check(found)
    problems = tuple(sorted(done.problems, key=lambda each: each.line))
    return Checked(with_answers(found.lesson, done.answers), problems, found.lesson.missing)


def tried(found: Read, seconds: float) -> tuple[Lesson, Problems, bool]:
    """The lesson with its answers, what is wrong in its scenes, and whether all of it was tried within so many seconds
    of computing.

    Where kernels may not be compiled, steps that need others are not tried.
    """
    done = _Check(found, seconds)
    return with_answers(found.lesson, done.answers), done.problems, done.whole


class _Over(Exception):
    """The time is over."""


class _Check:
    """Of one lesson; steps that show the same are solved once."""

    def __init__(self, read: Read, seconds: float = math.inf):
        self.problems, self.whole = Problems(), True
        self.opens = False  # whether a drop is shown as a whole by now
        self.known: dict[str, Shown | None] = {}
        self.answers: dict[str, Solved | Truth] = {}
        self.ends = time.process_time() + seconds
        for number, step in enumerate(read.lesson.steps):
            try:
                self._step(number, step, read)
            except NotCompiled:
                self.whole = False
            except _Over:
                self.whole = False
                return

    def _step(self, number: int, step: Step, read: Read) -> None:
        shown = self._solved(step)
        if shown is None:
            return
        self.opens = next(
            ("opening" in part.show for part in step.parts if isinstance(part, Scene) and part.show), self.opens
        )
        times = fallen(shown) if self.opens else times_of(shown.solution)
        for use in read.uses:
            if use.step == number and use.event not in times:
                names = [name for name in times if name != "second" and name[-1] not in "3456789"]
                self.problems.add(use.line, "event-missing", key=use.key, value=use.event, names=names)
        for part in step.parts:
            self._spans(part, times)
            if isinstance(part, Scene):
                self._scene(part, step)
            if isinstance(part, Boundary):
                self._boundary(part, step)
            elif isinstance(part, Sketch):
                self._sketch(part, shown.solution, times)
            if isinstance(part, Order):
                self._order(part, times)
            if isinstance(part, Number) and (found := answers_of(part, shown, self.problems)):
                self.answers[part.name] = found
            if isinstance(part, Set):
                self._goal(part, step)

    def _now(self, step: Step, **changes: Any) -> Shown:
        if time.process_time() > self.ends:
            raise _Over
        return solved(step, **changes)

    def _solved(self, step: Step) -> Shown | None:
        shown = repr((step.scene, sorted(step.choices.items())))
        if shown not in self.known:
            self.known[shown] = None
            try:
                self.known[shown] = self._now(step)
            except ValueError as error:
                code = "scene-unsolved" if isinstance(error, SceneError) else "scene-refused"
                self.problems.add(step.line, code, why=" ".join(str(error).split())[:300])
        return self.known[shown]

    def _scene(self, part: Scene, step: Step) -> None:
        """What is shown has something to show, and what stands beside it can be solved."""
        shown = self._solved(step)
        for name in part.show or ():
            if shown and not has(shown, name):
                self.problems.add(part.line, "shows-nothing", key="show", value=name)
        if part.beside and shown and shown.solution.peak_force is None:
            self.problems.add(part.line, "beside-nothing")
        if part.beside and shown and part.beside.items() <= shown.request.chosen.items():
            self.problems.add(part.line, "beside-same")
        if part.beside:
            self._solved(replace(step, line=part.line, choices=step.choices | part.beside))

    def _spans(self, part: Part, times: dict[str, float]) -> None:
        """Those of events end behind where they begin."""
        spans = [(part.line, "play", getattr(part, "play", None))]
        judges = part.judges if isinstance(part, Sketch) else ()
        spans += [(each.line, each.criterion, each.at) for each in judges if isinstance(each.at, tuple)]
        for line, key, span in spans:
            first, last = (_time(each, times) for each in span or (0.0, 1.0))
            if first >= last:
                self.problems.add(line, "span-falls", key=key)

    def _sketch(self, part: Sketch, solution: Solution, times: dict[str, float]) -> None:
        """No right line is called wrong: the exact curve gets every `yes`."""
        named = {each for judge in part.judges for each in _ends(judge.at)} | {part.until}
        if part.track != "force" or any(math.isnan(_time(each, times)) for each in named):
            return
        self._accepts(part, exact_line(solution, part, _time(part.until, times)), times)

    def _accepts(self, part: Sketch, line: np.ndarray, times: dict[str, float]) -> None:
        for judge, verdict in zip(part.judges, judged(line, part, times), strict=True):
            if verdict.outcome != "yes":
                self.problems.add(judge.line, "truth-refused", key=judge.criterion, value=verdict.outcome)

    def _boundary(self, part: Boundary, step: Step) -> None:
        """It is there all across, once, and no level line would do."""
        found = boundary_of(part, lambda **changes: self._now(step, **changes), self.problems)
        if found is None:
            return
        self.answers[part.name] = found
        solved_for = replace(part, truth=found)
        line = exact_boundary(solved_for)
        self._accepts(solved_for, line, {})
        for level in np.linspace(0.0, 1.0, LEVELS):
            said = judged(np.full(line.size, level), solved_for, {})
            if said and all(verdict.outcome == "yes" for verdict in said):
                value = value_at(level, part.ranges[1], part.logs[1])
                self.problems.add(part.line, "boundary-level", name=part.settings[1], value=value)
                return

    def _order(self, part: Order, times: dict[str, float]) -> None:
        last = -math.inf
        for number, item in enumerate(part.items, 1):
            now = math.nan if item.at is None else _time(item.at, times)
            if now <= last:
                self.problems.add(item.line, "times-fall", key=f"item[{number}].at", value=item.at)
            last = last if math.isnan(now) else now

    def _goal(self, part: Set, step: Step) -> None:
        """Met in each range, at least somewhere, and not from the beginning."""
        about = {"slider": part.slider, "goal": str(part.goal)}
        if self._met(part, step, [part.start]):
            self.problems.add(part.lines["start"], "goal-met", place=part.start, **about)
        for number, each in enumerate(part.found, 1):
            if each.range is None:
                continue
            for place in _places(each.range, PLACES):
                if not self._met(part, step, [place]):
                    self.problems.add(each.line, "goal-unmet", key=f"found[{number}].range", place=place, **about)
                    break
        anywhere = _places(part.range, PLACES_ANYWHERE)
        ends = [end for each in part.found for end in each.range or ()]
        if not self._met(part, step, [*ends, *anywhere]):
            low, high = part.range
            self.problems.add(part.lines["goal"], "goal-unreached", low=low, high=high, **about)

    def _met(self, part: Set, step: Step, places: Iterable[float]) -> bool:
        """At one of the places."""
        return any(_met(part, place, lambda **changes: self._now(step, **changes)) for place in places)


def spans_met(part: Set, step: Step) -> list[tuple[float, float]]:
    """Stretches of a slider, between its places that are tried, in which the goal is met."""
    found: list[tuple[float, float]] = []
    last = False
    for place in _places(part.range, PLACES_ANYWHERE):
        met = _met(part, place, lambda **changes: solved(step, **changes))
        if met:
            found[-1:] = [(found[-1][0], place)] if last else [*found[-1:], (place, place)]
        last = met
    return found


def _met(part: Set, place: float, now: Callable[..., Shown]) -> bool:
    """Where there is no solution it is not met."""
    value = round(place) if isinstance(Choices.param[part.slider], param.Integer) else place
    try:
        return meets(now(**{part.slider: value}), part.goal)
    except ValueError:
        return False


def _time(given: Time, times: dict[str, float]) -> float:
    """In T; NaN of what does not happen, which is refused by itself."""
    return times.get(given, math.nan) if isinstance(given, str) else given


def _ends(at: Time | Span) -> Span:
    return at if isinstance(at, tuple) else (at, at)


def _places(span: tuple[float, float], count: int) -> list[float]:
    low, high = span
    spaced = np.geomspace if low > 0.0 and high > WIDE * low else np.linspace
    return spaced(low, high, count).clip(low, high).tolist()
