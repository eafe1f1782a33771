"""Numbers and statements of the lesson on modes and waves, computed."""

from functools import cache

import numpy as np
import pytest
from scipy.special import sici

from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.lessons.shipped import shipped_lesson
from app.messages.solutions import both

from .numbers import assert_numbers, solution_of

NAME = "modes-against-waves"
STEPS = shipped_lesson(NAME).steps
EXACT = solution_of(STEPS[0])
MOST, FEWEST, GUESS = 40, 3, 5.0  # of modes in the table; a percentage that is not right
LIMIT = EXACT.peak_force * (2.0 * sici(np.pi)[0] / np.pi)  # of the modes: the jump, and Gibbs' overshoot


@cache
def by_modes(modes, method="mode-switch"):
    """The solution that the page has beside the exact one."""
    step = STEPS[1]
    solution = both(Request.of(own_choices(step.scene) | step.choices | {"method": method, "modes": modes}))[1]
    assert solution is not None and solution.method["name"] == method and solution.method["modes"] == modes
    return solution


def error(name, modes):
    """Of a result by so many modes [%]."""
    return 100.0 * abs(getattr(by_modes(modes), name) / getattr(EXACT, name) - 1.0)


def peak_time(modes):
    """[T]"""
    solution = by_modes(modes)
    return solution.time[np.argmax(solution.force)] / EXACT.scene.time_unit


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    unit, slowest = EXACT.scene.time_unit, by_modes(20, "modal").target_modes.frequencies[0]
    drop = np.interp(0.999 * unit, EXACT.time, EXACT.force)
    values = {
        "2.13": EXACT.scene.impactor.mass, "0.3": EXACT.scene.target.length, "1": EXACT.scene.speed,
        "8.593": 1e-3 * slowest, "8593": slowest, "116": 1e6 / slowest, "1000": 1e3, "20": 20.0, "100": 100.0,
        "36.7": 1e-3 * EXACT.peak_force, "36.66": 1e-3 * EXACT.peak_force, "5.0": 1e-3 * drop,
        "41.4": 1e-3 * by_modes(20).peak_force, "0.025": peak_time(20), "13": error("peak_force", 20),
        "17": error("peak_force", 100), "3": FEWEST, "40": MOST, "42.32": 1e-3 * by_modes(MOST).peak_force,
        "43.2": 1e-3 * LIMIT, "18": 100.0 * (LIMIT / EXACT.peak_force - 1.0), "5": GUESS, "1.844": EXACT.impulse,
        "0.7": error("impulse", FEWEST), "1.831": by_modes(FEWEST).impulse, "0.04": error("impulse", 20),
        "0.2": error("impactor_velocity", 20), "1.2": error("contact_time", 20), "0.05": 1.0 / 20.0,
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert 1.0 / slowest == pytest.approx(unit, rel=1e-9)  # mode 1 is back after each T


def test_answers():
    swing, peak = STEPS[0].parts[2], STEPS[3].parts[2]
    period = 1e6 * EXACT.scene.time_unit
    assert [swing.answer, swing.mistakes[0].answer] == pytest.approx([period, 0.5 * period], rel=1e-3)
    too_high = by_modes(MOST).peak_force - EXACT.peak_force
    own = 100.0 * too_high / by_modes(MOST).peak_force
    wrong = [error("peak_force", 20), own, error("peak_force", 5)]
    assert peak.answer == pytest.approx(error("peak_force", MOST), rel=5e-3)
    assert [each.answer for each in peak.mistakes[:-1]] == pytest.approx(wrong, abs=0.05)
    errors = [error(name, 20) for name in ("impulse", "impactor_velocity", "contact_time", "peak_force")]
    assert errors == sorted(errors) and errors[0] < 0.1 < 10.0 < errors[-1]


def test_ripples_get_shorter_but_not_lower():
    counts = 20, 100, 200
    heights = [by_modes(count).peak_force for count in counts]
    assert heights == sorted(heights) and LIMIT > heights[-1] > 0.99 * LIMIT
    assert [count * peak_time(count) for count in counts] == pytest.approx([0.5, 0.5, 0.5], rel=0.02)
    assert by_modes(20).force[0] == 0.0


def test_areas_cancel_with_few_modes():
    few = by_modes(FEWEST)
    inside = EXACT.time < 0.9 * EXACT.scene.time_unit
    apart = np.interp(EXACT.time[inside], few.time, few.force) - EXACT.force[inside]
    assert np.count_nonzero(np.diff(np.sign(apart[1:]))) >= 3
    assert np.max(np.abs(apart[1:])) > 0.2 * EXACT.peak_force
    assert few.peak_force < EXACT.peak_force < by_modes(5).peak_force  # which passes it by accident


def test_in_modes_of_the_rod_alone_the_contact_chatters():
    """Once in a period of the highest mode; the mean force swings with it."""
    alone = by_modes(20, "modal")
    touching = alone.force > 0.0
    begun = np.count_nonzero(touching[1:] & ~touching[:-1]) + bool(touching[0])
    assert 18 <= begun <= 21 and len(EXACT.contacts) == 1
