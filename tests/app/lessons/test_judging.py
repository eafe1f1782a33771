"""The exact curve gets every yes, each usual mistake its own sentence, and a rough hand is no mistake."""

import numpy as np
import pytest

from app.lessons.events import times_of
from app.lessons.judging import BIN, exact_line, judged
from app.lessons.lesson import Sketch
from app.lessons.shipped import shipped_lesson
from app.lessons.solving import solved

STEP = shipped_lesson("bounce-twice").steps[1]
(SKETCH,) = [part for part in STEP.parts if isinstance(part, Sketch)]
SOLUTION = solved(STEP).solution
TIMES = times_of(SOLUTION)
LINE = exact_line(SOLUTION, SKETCH, 2.6)
TIME = BIN * np.arange(LINE.size)
RIGHT = ["yes"] * 5  # falls, jump, zero-from, push, zero-beyond


def outcomes(line):
    return [each.outcome for each in judged(np.asarray(line), SKETCH, TIMES)]


def through(*points):
    """A line through points (time, force); the same time twice is a jump."""
    return np.interp(TIME, [t + 1e-9 * n for n, (t, _) in enumerate(points)], [f for _, f in points])


SECOND = ((2.03, 0), (2.04, 50), (2.19, 40), (2.2, 0), (2.6, 0))


def test_the_exact_curve_gets_every_yes():
    assert outcomes(LINE) == RIGHT


@pytest.mark.parametrize("seed", range(5))
def test_a_rough_hand_gets_every_yes(seed):
    noise = np.random.default_rng(seed).normal(size=LINE.size)
    noise = np.convolve(noise, np.ones(15) / 15.0, "same")
    assert outcomes(np.where(LINE > 0, np.maximum(LINE + 2.0 * noise, 0.0), 0.0)) == RIGHT


@pytest.mark.parametrize("shift", [-0.08, 0.08])
def test_a_line_a_little_early_or_late_gets_every_yes(shift):
    assert outcomes(np.interp(TIME - shift, TIME, LINE)) == RIGHT


@pytest.mark.parametrize(
    "line, said",
    [
        (through((0, 37), (1, 10), (1, 80), (1.7, 0), *SECOND), RIGHT),
        (through((0, 37), (0.5, 70), (1, 80), (1, 120), (1.7, 0), *SECOND), ["no", "yes", "yes", "yes", "yes"]),
        (through((0, 37), (0.6, 25), (0.6, 80), (1.7, 0), *SECOND), ["no", "early", "yes", "yes", "yes"]),
        (through((0, 37), (1.3, 10), (1.3, 80), (1.7, 0), *SECOND), ["yes", "late", "yes", "yes", "yes"]),
        (through((0, 37), (1, 15), (1, 32), (1.7, 0), *SECOND), ["yes", "small", "yes", "yes", "yes"]),
        (through((0, 37), (1.7, 0), *SECOND), ["yes", "none", "yes", "yes", "yes"]),
        (through((0, 37), (1, 10), (1, 80), (1.4, 0), *SECOND), ["yes", "yes", "early", "yes", "yes"]),
        (through((0, 37), (1, 10), (1, 80), (1.98, 0), (2.6, 0)), ["yes", "yes", "late", "none", "yes"]),
        (through((0, 37), (1, 10), (1, 80), (1.7, 0), (2.6, 0)), ["yes", "yes", "yes", "none", "yes"]),
        (through((0, 37), (1, 10), (1, 80), (2.6, 40)), ["yes", "yes", "none", "none", "no"]),
        (37 * np.exp(-0.5 * TIME), ["yes", "none", "none", "none", "no"]),
        (80 * np.sin(np.pi * np.minimum(TIME / 1.7, 1)), ["no", "none", "yes", "none", "yes"]),
        (0 * TIME, ["no", "none", "none", "none", "yes"]),
    ],
    ids=[
        *("straight", "rises", "early", "late", "small", "no jump", "parts early", "parts late", "once", "never parts"),
        *("decays", "hump", "empty"),
    ],
)  # fmt: skip
def test_each_mistake_has_its_sentence(line, said):
    assert outcomes(line) == said


def test_times_in_words_are_those_of_the_line():
    found = judged(through((0, 37), (0.6, 25), (0.6, 80), (1.7, 0), *SECOND), SKETCH, TIMES)
    assert found[1].yours == pytest.approx(0.6, abs=0.02) and found[1].true == 1.0
    assert found[2].yours == pytest.approx(1.66, abs=0.05) and found[2].true == TIMES["part"]
