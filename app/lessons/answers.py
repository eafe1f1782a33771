"""Answers that are solved for: `answer = "{impulse}"` becomes a number of the impact that its step shows."""

import json
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

from .figures import OF_RESULTS, figure, of_formula
from .formula import Formula, Mixed, Quantity
from .lesson import Boundary, Lesson, Number, Part
from .problems import Problems
from .solving import Shown
from .units import TIME_UNIT, alike, dimension_of

STORED = Path(__file__).parent / "library" / "answers.json"  # of the lessons of the program


class Solved(NamedTuple):
    """In the unit of the question; `mistakes`: of those that have an answer, None for the others."""

    answer: float
    mistakes: tuple[float | None, ...]


Truth = tuple[float, ...]  # of a boundary that is drawn


def with_answers(lesson: Lesson, found: Mapping[str, Solved | Truth]) -> Lesson:
    """The lesson with what was solved for its questions, by name."""

    def filled(part: Part) -> Part:
        own = found.get(part.name) if isinstance(part, Number | Boundary) else None
        if isinstance(part, Boundary) and own:
            return replace(part, truth=own)
        if not isinstance(part, Number) or part.unsolved is None or not isinstance(own, Solved):
            return part
        answer, answers = own
        share = part.unsolved.share
        tolerance = part.tolerance if share is None else share * abs(answer)
        mistakes = tuple(replace(each, answer=own) for each, own in zip(part.mistakes, answers, strict=True))
        return replace(part, answer=answer, tolerance=tolerance, mistakes=mistakes)

    steps = tuple(replace(step, parts=tuple(map(filled, step.parts))) for step in lesson.steps)
    return replace(lesson, steps=steps)


def solves(lesson: Lesson) -> bool:
    """Whether any answer is to be solved for."""
    parts = [part for step in lesson.steps for part in step.parts]
    return any(isinstance(part, Boundary) or (isinstance(part, Number) and part.unsolved) for part in parts)


def unsolved(lesson: Lesson) -> list[Number | Boundary]:
    """Questions that have no answer yet."""
    parts = [part for step in lesson.steps for part in step.parts if isinstance(part, Number | Boundary)]
    return [part for part in parts if _lacks(part)]


def _lacks(part: Number | Boundary) -> bool:
    if isinstance(part, Boundary):
        return not part.truth
    formulas = part.unsolved.mistakes if part.unsolved else ()
    pairs = zip(formulas, part.mistakes, strict=False)
    return part.answer is None or any(given is not None and each.answer is None for given, each in pairs)


def answers_of(part: Number, shown: Shown, problems: Problems) -> Solved | None:
    """What a question asks for in the impact of its step; what the impact contradicts is noted."""
    count = len(problems)
    unsolved = part.unsolved
    answer, mistakes = part.answer, [each.answer for each in part.mistakes]
    if unsolved is not None:
        if unsolved.answer is not None:
            answer = _solved(unsolved.answer, "answer", part, shown, problems)
        for k, given in enumerate(unsolved.mistakes):
            if given is not None:
                mistakes[k] = _solved(given, f"mistake[{k + 1}].answer", part, shown, problems)
    if len(problems) > count or answer is None:
        return None
    share = unsolved.share if unsolved else None
    within = part.tolerance if share is None else share * abs(answer)
    _agrees(part, answer, within, shown, problems)
    for k, own in enumerate(mistakes, 1):
        if own is not None and abs(own - answer) <= within:
            key = f"mistake[{k}].answer"
            problems.add(part.lines[key], "mistake-right", key=key, value=own, answer=answer)
    return Solved(answer, tuple(mistakes))


def _agrees(part: Number, answer: float, within: float, shown: Shown, problems: Problems) -> None:
    """A question that is called as a result, such as `peak-force`, asks for its size."""
    name = part.name.replace("-", "_")
    named = figure(name, shown) if name in OF_RESULTS else None
    if named is None or named.dimension not in (None, dimension_of(part.unit)):
        return
    value = named.value / _factor(part.unit, shown)
    if abs(abs(value) - abs(answer)) > within:
        problems.add(
            part.lines["answer"], "answer-contradicts", key="answer", value=answer, name=part.name, solved=value
        )


def _solved(given: Formula, key: str, part: Number, shown: Shown, problems: Problems) -> float | None:
    line = part.lines[key]
    try:
        found: Quantity | None = of_formula(given, shown)
    except Mixed:
        problems.add(line, "formula-mixed", key=key, value=given.text)
        return None
    if found is None:
        problems.add(line, "formula-nothing", key=key, value=given.text)
        return None
    if found.dimension not in (None, dimension_of(part.unit)):
        problems.add(line, "formula-unit", key=key, value=given.text, unit=part.unit)
        return None
    return found.value / _factor(part.unit, shown)


def _factor(unit: str, shown: Shown) -> float:
    return shown.solution.scene.time_unit if unit == TIME_UNIT else alike(unit).get(unit, 1.0)


@cache
def stored() -> dict[str, dict[str, Solved | Truth]]:
    """Those of the lessons of the program, by lesson and question: a server reads them without solving anything."""
    found = json.loads(STORED.read_text(encoding="utf-8")) if STORED.is_file() else {}
    return {lesson: {name: _stored(own) for name, own in questions.items()} for lesson, questions in found.items()}


def _stored(own: dict[str, list[float]] | list) -> Solved | Truth:
    if isinstance(own, dict):
        return tuple(own["boundary"])
    answer, mistakes = own
    return Solved(answer, tuple(mistakes))
