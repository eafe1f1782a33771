"""A lesson as it is read: steps of parts, each part text, what is shown, a question, or what is said behind one.

Times are in T, the time unit of the scene, from the first touch on, or names of events (`app.lessons.events`).
"""

from dataclasses import dataclass, field
from typing import Any, ClassVar

from .formula import Formula

Time = float | str
Span = tuple[Time, Time]


@dataclass(frozen=True)
class Node:
    """A piece of text. `kind` is paragraph, list, steps (a numbered list), item, emphasis, strong or link, which have
    `nodes`; text, code, formula (as scene files write them), break, or value: a gap, `text` its name, that the page
    fills. `target`: the address of a link, http or https."""

    kind: str
    text: str = ""
    nodes: "tuple[Node, ...]" = ()
    target: str = ""


Sentence = tuple[Node, ...]


@dataclass(frozen=True, kw_only=True)
class Part:
    """Of a step. `line`: where it begins in its file."""

    KIND: ClassVar = ""
    line: int = field(default=0, compare=False)


@dataclass(frozen=True, kw_only=True)
class Text(Part):
    """Paragraphs and lists."""

    KIND: ClassVar = "text"
    nodes: Sentence


@dataclass(frozen=True, kw_only=True)
class Scene(Part):
    """What is shown from here on; None: as before. `play` runs once, `at` stands still; `beside` is of this step."""

    KIND: ClassVar = "scene"
    scene: str | None = None
    changes: dict[str, Any] = field(default_factory=dict)  # choices of the page
    show: tuple[str, ...] | None = None
    map: tuple[str, ...] = ()  # its result, and the settings across and upwards; without them the page's own
    beside: dict[str, Any] = field(default_factory=dict)  # choices of a second solution, in which it differs
    play: Span | None = None
    at: Time | None = None
    time: str = "both"
    sliders: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Question(Part):
    """By its name, which no other one of the lesson has."""

    name: str


@dataclass(frozen=True, kw_only=True)
class Option:
    text: Sentence
    say: Sentence
    right: bool = False


@dataclass(frozen=True, kw_only=True)
class Choice(Question):
    """One of several sentences; more than one may be right."""

    KIND: ClassVar = "choice"
    options: tuple[Option, ...]


@dataclass(frozen=True, kw_only=True)
class Mistake:
    """A usual one: an `answer` in the unit of the right one, digits in whatever unit, or another power of ten."""

    say: Sentence
    answer: float | None = None
    numbers: tuple[float, ...] = ()
    power_of_ten: bool = False


@dataclass(frozen=True)
class Unsolved:
    """What of a question is to be solved for; `share`: the tolerance, of the answer, None where it is a number."""

    answer: Formula | None
    share: float | None
    mistakes: tuple[Formula | None, ...]


@dataclass(frozen=True, kw_only=True)
class Number(Question):
    """A number and its unit; `tolerance` in the unit of `answer`. `units` are offered, `factors` make SI of them.

    `answer` is None until it is solved for; see `app.lessons.answers`.
    """

    KIND: ClassVar = "number"
    answer: float | None
    unit: str
    tolerance: float
    units: tuple[str, ...]
    factors: tuple[float, ...]
    yes: Sentence
    no: Sentence
    mistakes: tuple[Mistake, ...]
    unsolved: Unsolved | None = field(default=None, compare=False)
    lines: dict[str, int] = field(default_factory=dict, compare=False)  # of `answer`, and those of mistakes


@dataclass(frozen=True, kw_only=True)
class Item:
    text: Sentence
    at: Time | None = None
    line: int = field(default=0, compare=False)


@dataclass(frozen=True, kw_only=True)
class Order(Question):
    """What follows what; `items` are in their right order."""

    KIND: ClassVar = "order"
    items: tuple[Item, ...]
    yes: Sentence
    no: Sentence


@dataclass(frozen=True)
class Goal:
    """`quantity relation value`, such as contacts = 1; SI units."""

    quantity: str
    relation: str
    value: float

    def __str__(self) -> str:
        return f"{self.quantity} {self.relation} {self.value:g}"


@dataclass(frozen=True, kw_only=True)
class Found:
    """What is said where the goal is met in `range`; None: anywhere."""

    say: Sentence
    range: tuple[float, float] | None = None
    line: int = field(default=0, compare=False)


@dataclass(frozen=True, kw_only=True)
class Set(Question):
    """A slider that is moved until a goal is met."""

    KIND: ClassVar = "set"
    slider: str
    range: tuple[float, float]
    start: float
    goal: Goal
    not_yet: Sentence
    more: Sentence | None
    all: Sentence | None
    found: tuple[Found, ...]
    lines: dict[str, int] = field(default_factory=dict, compare=False)  # of `start` and `goal`


@dataclass(frozen=True, kw_only=True)
class Judge:
    """A criterion of a line that is drawn, in units of the chart; `says`: sentences by the outcome."""

    criterion: str
    at: Time | Span
    says: dict[str, Sentence]
    within: float = 0.1  # [T]
    slack: float = 0.0  # what does not count, of the value
    by: float = 0.0  # least height of a jump
    above: float = 0.0  # least height of a push
    line: int = field(default=0, compare=False)


@dataclass(frozen=True, kw_only=True)
class Sketch(Question):
    """A line over time that is drawn before it is seen."""

    KIND: ClassVar = "sketch"
    track: str
    unit: str
    until: Time
    axis: tuple[float, float]
    given: tuple[float, float] | None  # a point [T, value]
    judges: tuple[Judge, ...]


@dataclass(frozen=True, kw_only=True)
class Boundary(Sketch):
    """A line over a map that is drawn before its colours are seen: from where on there are so many contacts.

    Places along it, and values, are shares of what is shown of both settings: `until` is 1, `axis` from 0 to 1.
    """

    contacts: int
    settings: tuple[str, str]  # across and upwards
    ranges: tuple[tuple[float, float], tuple[float, float]]  # what of them is shown
    logs: tuple[bool, bool]  # whether shares of them are of ratios
    truth: tuple[float, ...] = ()  # at equal steps across; empty until it is solved for


@dataclass(frozen=True, kw_only=True)
class After(Part):
    """What is shown and said behind the answer."""

    KIND: ClassVar = "after"
    play: Span | None = None
    at: Time | None = None
    nodes: Sentence = ()


@dataclass(frozen=True, kw_only=True)
class Summary(Part):
    """What was predicted and what happened, side by side; then a sentence."""

    KIND: ClassVar = "summary"
    say: Sentence


@dataclass(frozen=True, kw_only=True)
class Step:
    """`scene` and `choices`: what is shown with all that earlier steps have changed."""

    title: str
    line: int = field(default=0, compare=False)
    scene: str
    choices: dict[str, Any]
    parts: tuple[Part, ...]


@dataclass(frozen=True, kw_only=True)
class Lesson:
    """`title_before` hides what the title gives away; `missing`: sentences that a translation has from its original."""

    lesson: str
    version: int
    language: str
    title: str
    title_before: str
    scene: str
    minutes: int | None
    audience: str
    next: str
    translates: str
    steps: tuple[Step, ...]
    missing: tuple[str, ...] = ()
