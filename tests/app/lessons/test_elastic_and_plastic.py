"""Numbers and statements of the lesson on elastic and plastic contact, computed."""

import math

import numpy as np
import pytest

from app.lessons.shipped import shipped_lesson
from app.lessons.solving import solved
from solvers.studies.bounces import bounces

from .numbers import assert_numbers, solution_of

NAME = "elastic-and-plastic"
STEPS = shipped_lesson(NAME).steps
GRAVITY = 9.80665  # [m/s2]
WANTED, FALL, STIFFER = 0.99, 1e-5, 3.31  # restitution; [m]; a velocity that is not right [m/s]
MILLI, MICRO = 1e3, 1e6
DROP = 0.5  # [m], of the scene drop-test

ELASTIC, PLASTIC, FAST = (solution_of(STEPS[number]) for number in (0, 2, 5))


def damped():
    """The contact that has lost as much, and keeps its shape."""
    return solution_of(STEPS[2], **STEPS[4].parts[0].beside)


def lost(solution):
    """[J]"""
    return solution.energy["dissipated"]


def yield_speed():
    """At which Hertz's contact comes to its first yield [m/s]."""
    law = PLASTIC.scene.contact
    return math.sqrt(0.8 * law.stiffness * law.yield_indentation**2.5 / PLASTIC.scene.impactor.mass)


def fallen(height: float) -> float:
    """The speed [m/s] after a fall from a height [m]."""
    return math.sqrt(2.0 * GRAVITY * height)


def risen() -> list[float]:
    """Heights [m] to which the ball rises after each of four impacts, the first from where it is dropped."""
    found = bounces(solved(STEPS[6]).solution.scene, count=4)
    return [each.height for each in found.bounces]


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    mass, restitution = PLASTIC.scene.impactor.mass, PLASTIC.restitution["newton"]
    rises = risen()
    values = {
        "33": MILLI * mass, "33.1": MILLI * mass, "1": PLASTIC.scene.speed, "1757": ELASTIC.peak_force,
        "23.5": MICRO * ELASTIC.peak_indentation, "16.5": MILLI * ELASTIC.energy["initial"], "1000": MILLI,
        "400": 1e-6 * PLASTIC.scene.impactor.material.yield_strength, "13.2": MICRO * PLASTIC.residual_indentation,
        "0.76": MICRO * PLASTIC.scene.contact.yield_indentation, "1374": PLASTIC.peak_force,
        "28.0": MICRO * PLASTIC.peak_indentation, "0.703": restitution, "8.4": MILLI * lost(PLASTIC),
        "1588": damped().peak_force, "4": FAST.scene.speed, "2.81": 4.0 * restitution, "3.31": STIFFER,
        "2.28": -FAST.impactor_velocity, "0.57": FAST.restitution["newton"],
        "0.5": DROP, "64": 100.0 * rises[0] / DROP, "43": 100.0 * rises[1] / DROP, "29": 100.0 * rises[2] / DROP,
        "21": 100.0 * rises[3] / DROP, "66.6": 100.0 * rises[1] / rises[0],
        "3.13": fallen(DROP), "2.5": fallen(rises[0]),
        "60": MICRO * FAST.residual_indentation, "0.99": WANTED, "13.7": MILLI * yield_speed(), "0.01": MILLI * FALL,
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert 0.5 < lost(PLASTIC) / PLASTIC.energy["initial"] < 0.51
    assert lost(FAST) / FAST.energy["initial"] == pytest.approx(2.0 / 3.0, rel=0.02)
    assert math.sqrt(2.0 * GRAVITY * FALL) > yield_speed()
    assert FAST.scene.speed * restitution < STIFFER


def test_answers():
    area, asked = STEPS[1].parts[2], STEPS[3].parts[2]
    energy, rebound = MILLI * ELASTIC.energy["initial"], PLASTIC.restitution["newton"]
    straight = 0.5 * MILLI * ELASTIC.peak_force * ELASTIC.peak_indentation
    assert area.answer == pytest.approx(energy, rel=1e-3)
    assert [each.answer for each in area.mistakes[:2]] == pytest.approx([2.0 * energy, straight], rel=2e-3)
    assert asked.answer == pytest.approx(MILLI * lost(PLASTIC), rel=1e-3)
    wrong = [energy * (1.0 - rebound), energy * rebound**2]
    assert [each.answer for each in asked.mistakes[:2]] == pytest.approx(wrong, rel=1e-3)


def test_elastic_on_one_line_and_plastic_on_two():
    for solution in (ELASTIC, PLASTIC):
        law, deepest = solution.scene.contact, solution.peak_indentation
        depth = np.linspace(0.0, deepest, 4001)
        up = np.array([law.force(each, 0.0, each) for each in depth])
        down = np.array([law.force(each, 0.0, deepest) for each in depth])
        assert np.trapezoid(up, depth) == pytest.approx(solution.energy["initial"], rel=1e-3)
        assert np.trapezoid(up - down, depth) == pytest.approx(lost(solution), rel=1e-3, abs=1e-9)
    assert ELASTIC.residual_indentation == 0.0


def test_damping_loses_as_much_and_leaves_no_dent():
    solution = damped()
    assert lost(solution) == pytest.approx(lost(PLASTIC), rel=1e-3)
    assert solution.residual_indentation == 0.0 < PLASTIC.residual_indentation
    assert np.argmax(solution.force) / len(solution.force) < 0.5


def test_restitution_falls_with_speed():
    step, edge = STEPS[7], STEPS[7].parts[2].found[0].range[1]
    speeds = (0.01, 0.99 * yield_speed(), 1.05 * yield_speed(), edge, 0.1, 1.0, 4.0, 10.0)
    found = [solution_of(step, speed=speed).restitution["newton"] for speed in speeds]
    assert found[:2] == pytest.approx([1.0, 1.0], abs=1e-12) and found[1:] == sorted(found[1:], reverse=True)
    assert 1.0 > found[3] > WANTED > solution_of(step, speed=0.021).restitution["newton"]
