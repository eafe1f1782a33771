"""A lesson on paper as plain text in Markdown: its questions with room for answers, or the key to them."""

from collections.abc import Callable
from typing import Any

from solvers.text.catalogue import SOURCE, Catalogue

from ..choices.choices import title_of
from ..text.catalogues import LANGUAGES, lessons, page
from .checking import spans_met
from .lesson import (
    Boundary,
    Choice,
    Lesson,
    Number,
    Order,
    Part,
    Question,
    Sentence,
    Set,
    Sketch,
    Step,
    Summary,
    Text,
    Time,
)

LINE = "_" * 30
DIGITS = 4  # of a number
MARKS = {"emphasis": "*", "strong": "**", "code": "`", "formula": "$"}


def words(nodes: Sentence) -> str:
    """Nodes of a sentence, or of paragraphs and lists, as they would be written in a lesson file; gaps are dots."""
    found = []
    for number, node in enumerate(nodes, 1):
        inner = node.text or words(node.nodes)
        if node.kind in ("paragraph", "list", "steps"):
            inner = _numbered(node.nodes) if node.kind == "steps" else inner
            found.append(f"{inner.rstrip()}\n\n" if number < len(nodes) else inner.rstrip())
        elif node.kind == "item":
            found.append(f"- {inner.rstrip()}\n")
        else:
            mark = MARKS.get(node.kind, "")
            found.append({"value": "…", "break": "\n"}.get(node.kind, f"{mark}{inner}{mark}"))
    return "".join(found)


def _numbered(items: Sentence) -> str:
    return "".join(f"{number}. {words(each.nodes).rstrip()}\n" for number, each in enumerate(items, 1))


class Paper:
    """In the language of the lesson, where the program has it."""

    def __init__(self, lesson: Lesson):
        self.lesson = lesson
        self.language = next((each for each in LANGUAGES if each == lesson.language.split("-")[0]), SOURCE)
        self.catalogue: Catalogue = lessons(self.language)

    def _said(self, code: str, **values: Any) -> str:
        return self.catalogue.text(f"print.{code}", **values)

    def handout(self) -> str:
        """All steps but the summary, and no answer."""
        head = f"# {self.lesson.title_before}\n\n{self._said('name')} {LINE}    {self._said('date')} {LINE[:16]}"
        return "\n\n".join([head, *(part for step in self._asked() for part in self._step(step))]) + "\n"

    def key(self) -> str:
        """What is right, with what is said of it."""
        parts = [f"# {self._said('key', title=self.lesson.title)}"]
        for number, step in enumerate(self.lesson.steps, 1):
            for part in step.parts:
                if isinstance(part, Question):
                    parts += [f"## {number}. {step.title}", RIGHT[part.KIND](self, part)]
        return "\n\n".join(parts) + "\n"

    def _asked(self) -> list[Step]:
        return [step for step in self.lesson.steps if not any(isinstance(part, Summary) for part in step.parts)]

    def _step(self, step: Step) -> list[str]:
        found = [f"## {self.lesson.steps.index(step) + 1}. {step.title}"]
        found += [words(part.nodes) for part in step.parts if isinstance(part, Text)]
        return found + [ASKED[part.KIND](self, part) for part in step.parts if isinstance(part, Question)]

    def _step_of(self, part: Part) -> Step:
        return next(step for step in self.lesson.steps if part in step.parts)

    def setting(self, name: str) -> str:
        """What a control is called on the page."""
        return page(self.language).text(title_of(name))

    def ask_choice(self, part: Choice) -> str:
        return "\n".join(f"- [ ] {words(each.text)}" for each in part.options)

    def ask_number(self, part: Number) -> str:
        return f"{LINE} {' / '.join(part.units)}"

    def ask_order(self, part: Order) -> str:
        """In the order of their letters, which is seldom the right one."""
        items = sorted(words(each.text) for each in part.items)
        return "\n\n".join([self._said("number-them"), "\n".join(f"- ____ {each}" for each in items)])

    def ask_set(self, part: Set) -> str:
        low, high = part.range
        return self._said("set", title=self.setting(part.slider), low=low, high=high, start=part.start) + f" {LINE}"

    def ask_sketch(self, part: Sketch) -> str:
        if isinstance(part, Boundary):
            across, upwards = (self.setting(each) for each in part.settings)
            (left, right), (low, high) = part.ranges
            ends = {"left": left, "right": right, "low": low, "high": high}
            return self._said("boundary", contacts=part.contacts, across=across, upwards=upwards, **ends)
        low, high = part.axis
        return self._said("sketch", unit=part.unit, low=low, high=high, until=self._time(part.until))

    def _time(self, time: Time) -> str:
        return time if isinstance(time, str) else self._said("time", value=time)

    def right_choice(self, part: Choice) -> str:
        options = sorted(part.options, key=lambda each: not each.right)
        return "\n\n".join(
            f"{'**✓**' if each.right else '✗'} {words(each.text)}: {words(each.say)}" for each in options
        )

    def right_number(self, part: Number) -> str:
        answer = self._said(
            "number", value=_round(part.answer or 0.0), within=_round(part.tolerance, 2), unit=part.unit
        )
        wrong = [
            f"- {self._said('wrong', value=_round(each.answer), unit=part.unit)}: {words(each.say)}"
            for each in part.mistakes
            if each.answer
        ]
        return "\n\n".join([answer, words(part.yes), *(["\n".join(wrong)] if wrong else [])])

    def right_order(self, part: Order) -> str:
        return "\n".join(f"{number}. {words(each.text)}" for number, each in enumerate(part.items, 1))

    def right_set(self, part: Set) -> str:
        title, found = self.setting(part.slider), []
        for each in part.found:
            spans = [each.range] if each.range else spans_met(part, self._step_of(part))
            where = [self._said("within", title=title, low=_round(low, 3), high=_round(high, 3)) for low, high in spans]
            found.append(f"**{'; '.join(where)}**: {words(each.say)}")
        return "\n\n".join(found)

    def right_sketch(self, part: Sketch) -> str:
        return "\n".join(f"- {words(each.says['yes'])}" for each in part.judges)


def _round(value: float, digits: int = DIGITS) -> float:
    return float(f"{value:.{digits}g}")


ASKED: dict[str, Callable[[Paper, Any], str]] = {
    "choice": Paper.ask_choice,
    "number": Paper.ask_number,
    "order": Paper.ask_order,
    "set": Paper.ask_set,
    "sketch": Paper.ask_sketch,
}
RIGHT: dict[str, Callable[[Paper, Any], str]] = {
    "choice": Paper.right_choice,
    "number": Paper.right_number,
    "order": Paper.right_order,
    "set": Paper.right_set,
    "sketch": Paper.right_sketch,
}
