"""Numbers and statements of the lesson on bending, computed."""

import math
from functools import cache

import numpy as np
import pytest

from app.lessons.shipped import shipped_lesson
from solvers.numerics.beams.modes import phase_speeds

from .numbers import assert_numbers, same, solution_of

NAME = "bending"
STEPS = shipped_lesson(NAME).steps
KILO, TURN = 1000.0, 2.0  # of units; in 2 pi
LIGHTEST, HEAVIEST = 30, 200  # mass ratios at which they touch once


@cache
def struck():
    return solution_of(STEPS[0])


def speed(step, length):
    """Of crests so far apart [m/s]."""
    line = solution_of(STEPS[step]).scene.target.line
    return float(phase_speeds(line, np.array([2.0 * math.pi / length]))[0][0])


def spring():
    """Stiffness of the bar at its end [N/m], and what moves with it [kg]."""
    scene = struck().scene
    line = scene.target.line
    return 3.0 * line.bending_stiffness / line.length**3, scene.impactor.mass + 0.25 * scene.target.mass


def half(mass):
    return math.pi * math.sqrt(mass / spring()[0])


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    solution, (stiffness, mass) = struck(), spring()
    first, last = solution.contacts[0], solution.contacts[-1]
    length, depth = solution.scene.target.length, 2.0 * solution.scene.target.half_depth
    slender = speed(0, length) / speed(5, length)
    values = {
        "0.5": solution.scene.impactor.mass, "1": solution.scene.speed, "0.4": length, "20": 1e3 * depth, "2": TURN,
        "0.2": length / 2, "935": speed(1, length / 2), "0.1": length / 4, "0.36": 1e3 * first.end,
        "0.50": 1.0 - first.impulse / solution.scene.impactor.mass, "197": 1e-3 * stiffness, "0.97": mass,
        "7.0": 1e3 * half(mass), "6.5": 1e3 * last.end, "1000": KILO, "0.85": 1e3 * solution.contact_time,
        "13": 100.0 * solution.contact_time / last.end, "9352": speed(0, depth), "5156": bar_speed(),
        "2761": speed(5, depth),
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert same("2", 100.0 * (slender - 1.0))
    assert len(solution.contacts) == 5


def bar_speed():
    """Of a front along the axis [m/s]."""
    material = struck().scene.target.material
    return math.sqrt(material.young / material.density)


def test_short_waves_run_ahead():
    """From the struck end to the left bends are shorter and shorter, and the left half is nearly straight."""
    solution = struck()
    data = solution.dataset()
    row = data.bending_moment.sel(time=0.008 * solution.scene.time_unit, method="nearest").values
    crossings = data.x.values[1:][np.sign(row[1:]) != np.sign(row[:-1])]
    widths = np.diff(crossings[crossings > 0.05])
    assert len(widths) > 3 and (np.diff(widths) > 0.0).all()
    assert abs(row[: len(row) // 2]).max() < 0.2 * abs(row).max()


def test_answers():
    (_, mass), hammer = spring(), struck().scene.impactor.mass
    asked, period = STEPS[1].parts[2], STEPS[3].parts[2]
    wave = speed(1, 0.1)
    assert asked.answer == pytest.approx(wave, rel=1e-3)
    assert [each.answer for each in asked.mistakes] == pytest.approx(
        [4.0 * speed(1, 0.2), wave / 2.0, speed(1, 0.4)], rel=1e-3
    )
    assert period.answer == pytest.approx(1e3 * half(mass), rel=2e-3)
    assert [each.answer for each in period.mistakes[:3]] == pytest.approx(
        [2e3 * half(mass), 1e3 * half(hammer), 1e3 * half(mass) / math.pi], rel=2e-3
    )
    assert 2.0 * speed(1, 0.04) == pytest.approx(speed(1, 0.02), rel=1e-9)
    assert speed(5, 0.02) < bar_speed() < speed(1, 0.02)


def test_five_contacts_of_two_kinds():
    """Twice the trembling end, twice the bar that swings back; nearly so with one percent more or less mass."""
    unit = struck().scene.time_unit
    starts = [each.start / unit for each in struck().contacts]
    assert starts[2] < 0.1 < 0.25 < starts[3] < 0.5
    lowest = struck().dataset().end_position
    assert float(lowest.time[int(lowest.values.argmax())]) / unit == pytest.approx(
        STEPS[6].parts[2].items[3].at, abs=0.01
    )
    for ratio in (3.755, 3.83):
        assert len(solution_of(STEPS[0], mass_ratio=ratio).contacts) == 5


@pytest.mark.parametrize("ratio", [LIGHTEST, 60, HEAVIEST])
def test_a_light_hammer_is_thrown_back_at_once(ratio):
    solution = solution_of(STEPS[4], mass_ratio=ratio)
    assert len(solution.contacts) == 1 and solution.impactor_velocity < 0.0
    assert STEPS[4].parts[2].found[0].range == (LIGHTEST, HEAVIEST)
