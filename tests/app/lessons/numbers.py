"""Numbers in the sentences of a lesson, against values that are computed."""

import re
from collections.abc import Mapping
from typing import Any

import pytest

from app.lessons.lesson import Step
from app.lessons.record import lesson_record
from app.lessons.shipped import shipped_lesson
from app.lessons.solving import solved
from solvers import Solution

from .written import nodes_in

NUMBER = re.compile(r"\d+(?:[.,]\d+)?")


def solution_of(step: Step, **changes: Any) -> Solution:
    """What a step shows, with other `changes` of its choices."""
    return solved(step, **changes).solution


def same(written: str, value: float) -> bool:
    """Whether a number as it is written is this value, to its last digit."""
    digits = len(written.replace(",", ".").partition(".")[2])
    return float(written.replace(",", ".")) == pytest.approx(value, abs=0.5001 * 10.0**-digits)


def assert_numbers(name: str, language: str, values: Mapping[str, float]) -> None:
    """Each number in the sentences is one of these, and these are what they are called."""
    record = lesson_record(shipped_lesson(name, language))
    texts = [node["text"] for node in nodes_in(record) if node["kind"] == "text"]
    texts += [step["title"] for step in record["steps"]] + [record["title"]]
    written = {number.replace(",", ".") for text in texts for number in NUMBER.findall(text)}
    assert written == set(values)
    for number, value in values.items():
        assert same(number, value), (number, value)
