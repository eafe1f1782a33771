"""Values of one table of a fence, taken key by key: what cannot be is noted with its line, and a usual value stands."""

import math
import re
from collections.abc import Callable, Collection, Iterable
from typing import Any, NamedTuple

from solvers import SceneError
from solvers.text.notes import Note
from solvers.validation import allowed, choice, flag, number

from .document import Lines
from .events import FIRST, LAST, is_event
from .lesson import Sentence, Span, Time
from .problems import Problems, wanted
from .prose import sentence

LONGEST = 600  # characters of a sentence
LARGEST = 1e15
NAME = re.compile(r"[a-z][a-z0-9-]{0,39}")


class EventUse(NamedTuple):
    """An event that a part names, to be looked for in the scene of its step."""

    step: int  # from 0 on
    line: int
    key: str
    event: str


class Reading:
    """What is gathered while a lesson is read; `events`: that can happen in the scene that is shown."""

    def __init__(self, problems: Problems, events: tuple[str, ...] = ()):
        self.problems, self.step, self.events = problems, 0, events
        self.uses: list[EventUse] = []
        self.names: set[str] = set()


class Fields:
    """`key`: of the table within its fence, such as `judge[2]`."""

    def __init__(self, reading: Reading, given: dict[str, Any], lines: Lines, key: str = ""):
        self.reading, self.given, self.lines, self.key = reading, given, lines, key
        self.taken: list[str] = []

    def full(self, name: str) -> str:
        """The key within the fence."""
        return f"{self.key}.{name}".strip(".")

    def line(self, name: str) -> int:
        return self.lines.of(self.full(name))

    def take(self, name: str) -> Any:
        """The value as it stands, None without one."""
        self.taken.append(name)
        return self.given.get(name)

    def refuse(self, name: str, value: object, reason: Note) -> None:
        """Note what a key got and what is allowed; what is missing is a problem of the table."""
        with self.reading.problems.refused(self.line(name)):
            raise SceneError(self.full(name), value, reason)

    def problem(self, name: str, code: str, **values: Any) -> None:
        self.reading.problems.add(self.line(name), code, key=self.full(name), **values)

    def tried(self, name: str, read: Callable[[str, Any], Any], usual: Any, must: bool) -> Any:
        """`read` of key and value, which raises SceneError; `usual` where nothing is, unless it `must` be."""
        value = self.take(name)
        if value is None and not must:
            return usual
        with self.reading.problems.refused(self.line(name)):
            return read(self.full(name), value)
        return usual

    def close(self) -> None:
        """All other keys are refused."""
        for name, value in self.given.items():
            if name not in self.taken:
                self.refuse(name, value, allowed("key", keys=", ".join(self.taken)))

    def sentence(self, name: str, gaps: Collection[str] = (), must: bool = True) -> Sentence | None:
        """Nodes of a line of text."""
        value = self.take(name)
        if value is None and not must:
            return None
        if not isinstance(value, str) or not value.strip() or len(value) > LONGEST:
            self.refuse(name, value, wanted("sentence", most=LONGEST))
            return ()
        return sentence(value, self.line(name), self.reading.problems, gaps, self.full(name))

    def said(self, name: str, gaps: Collection[str] = ()) -> Sentence:
        """A sentence that must be there."""
        return self.sentence(name, gaps) or ()

    def number(self, name: str, low: float = -LARGEST, high: float = LARGEST, usual: float | None = None) -> float:
        """`usual`: without one it must be there."""
        return self.tried(name, lambda key, value: number(key, value, low, high), usual or 0.0, usual is None)

    def flag(self, name: str) -> bool:
        return self.tried(name, flag, False, False)

    def choice(self, name: str, options: Iterable[str], usual: str | None = None) -> str:
        options = tuple(options)
        return self.tried(name, lambda key, value: choice(key, value, options), usual or options[0], usual is None)

    def names(self, name: str, options: Iterable[str], most: int = 10) -> tuple[str, ...] | None:
        """A list of words; None without one."""
        options = tuple(options)

        def read(key: str, value: Any) -> tuple[str, ...]:
            if not isinstance(value, list) or len(value) > most:
                raise SceneError(key, value, allowed("list-up-to", most=most))
            return tuple(choice(f"{key}[{n}]", each, options) for n, each in enumerate(value, 1))

        return self.tried(name, read, None, False)

    def time(self, name: str, must: bool = False) -> Time | None:
        return self.tried(name, self._time, None, must)

    def span(self, name: str, must: bool = False) -> Span | None:
        return self.tried(name, self._span, None, must)

    def _time(self, key: str, value: Any) -> Time:
        if is_event(value):
            self.reading.uses.append(EventUse(self.reading.step, self.lines.of(key), key, value))
            return value
        try:
            return number(key, value, FIRST, LAST)
        except SceneError:
            raise SceneError(key, value, wanted("time", low=FIRST, high=LAST, names=[*self.reading.events])) from None

    def _span(self, key: str, value: Any) -> Span:
        if not isinstance(value, list) or len(value) != 2:
            raise SceneError(key, value, wanted("span"))
        first, last = self._time(f"{key}[1]", value[0]), self._time(f"{key}[2]", value[1])
        if isinstance(first, float) and isinstance(last, float) and not first < last:
            raise SceneError(key, value, wanted("span"))
        return first, last

    def interval(self, name: str, low: float, high: float, must: bool = False) -> tuple[float, float] | None:
        """Two numbers that rise."""

        def read(key: str, value: Any) -> tuple[float, float]:
            first, last = numbers(value, 2) or (math.nan, math.nan)
            if not low <= first < last <= high:
                raise SceneError(key, value, wanted("interval", low=low, high=high))
            return first, last

        return self.tried(name, read, None, must)

    def tables(self, name: str, least: int, most: int) -> list["Fields"]:
        """Tables of a list, `[[name]]` each."""
        value = self.take(name)
        given = [] if value is None else value
        tables = given if isinstance(given, list) and all(isinstance(each, dict) for each in given) else None
        if tables is None or not least <= len(tables) <= most:
            self.refuse(name, value, wanted("tables", low=least, high=most, table=f"[[{name}]]"))
            return []
        return [Fields(self.reading, each, self.lines, f"{self.full(name)}[{n}]") for n, each in enumerate(tables, 1)]


def numbers(value: Any, count: int | None = None) -> tuple[float, ...] | None:
    """A list of so many finite numbers, None for anything else."""
    if not isinstance(value, list) or len(value) != (len(value) if count is None else count):
        return None
    try:
        return tuple(number("", each, -LARGEST, LARGEST) for each in value)
    except SceneError:
        return None
