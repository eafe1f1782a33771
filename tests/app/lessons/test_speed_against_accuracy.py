"""Numbers and statements of the lesson on which model is enough, computed."""

import json
import math

import pytest

from app.choices.choices import SCENES
from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.lessons.shipped import shipped_lesson
from app.messages.solutions import both
from app.views.convergence import convergence_data
from solvers import RigidImpulse
from solvers.accuracy.store import shipped
from solvers.accuracy.tradeoff_table import TradeOff

from .numbers import assert_numbers, solution_of

NAME = "speed-against-accuracy"
STEPS = shipped_lesson(NAME).steps
LIMIT, GUESSED, FEW, MANY = 1.0, 50.0, 6, 400  # percent; percent that are not right; modes
RATIOS = 0.01, 0.1, 1.0, 10.0  # of rod and mass, as they stand in the order
MILLI, MICRO = 1e-3, 1e6

EXACT, HEAVY, BALLS = (solution_of(STEPS[number]) for number in (0, 4, 6))


def beside(**choices):
    """The exact solution of a mass on the rod, and what the page has beside it."""
    exact, other = both(Request.of(own_choices("fixed-rod") | choices))
    assert other is not None
    return exact, other


def error(exact, other, name="impactor_velocity"):
    """[%]"""
    return 100.0 * abs(getattr(other, name) / getattr(exact, name) - 1.0)


def table():
    """What the step on convergence shows: values by the number of modes."""
    step = STEPS[2]
    found = json.loads(convergence_data(own_choices(step.scene) | step.choices | {"convergence_by": "own"}))
    assert found["method"] == "modal"
    return {name: dict(zip(found["counts"], values, strict=True)) for name, values in found["values"].items()}


def growth(name, before, after):
    """From one number of modes to another [%]."""
    values = table()[name]
    return 100.0 * abs(values[after] / values[before] - 1.0)


def spring(ratio=RATIOS[0]):
    return beside(method="quasi-static", mass_ratio=ratio)


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    _, modes = beside(method="modal", modes=5)
    errors = [error(*spring(ratio)) for ratio in RATIOS]
    exact, heavy = spring()
    unit = exact.scene.time_unit
    values = {
        "1": LIMIT, "0.75": -spring(1.0)[1].impactor_velocity, "0.70": -EXACT.impactor_velocity, "7": errors[2],
        "0.701": -modes.impactor_velocity, "0.699": -EXACT.impactor_velocity, "0.2": errors[1],
        "78.3": MILLI * EXACT.peak_force, "51.1": MILLI * modes.peak_force, "3": min(table()["peak_force"]),
        "40": max(table()["peak_force"]), "10": error(exact, heavy, "peak_force"), "20": 20.0,
        "0.6": growth("final_velocity", 20, 40), "6": FEW, "400": MANY, "50": GUESSED,
        "15.7": heavy.contact_time / unit, "15.6": exact.contacts[0].end / unit, "15": exact.contacts[0].end // unit,
        "365": MILLI * heavy.peak_force, "403": MILLI * exact.peak_force, "0.1": errors[0], "69": errors[3],
        "138": MICRO * BALLS.contact_time, "0.543": -BALLS.impactor_velocity,
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert EXACT.scene.speed == BALLS.scene.speed == 1.0 and exact.scene.mass_ratio == pytest.approx(RATIOS[0])
    assert error(EXACT, modes) == pytest.approx(0.2, abs=0.05)
    assert errors == sorted(errors)
    assert error(exact, heavy, "contact_time") < LIMIT


def test_answers():
    peak, grows = STEPS[1].parts[2], STEPS[2].parts[2]
    _, modes = beside(method="modal", modes=5)
    there = 100.0 * modes.peak_force / EXACT.peak_force
    assert peak.answer == pytest.approx(100.0 - there, rel=2e-3)
    wrong = [100.0 * (100.0 / there - 1.0), there]
    assert [each.answer for each in peak.mistakes[:-1]] == pytest.approx(wrong, rel=2e-3)
    assert grows.answer == pytest.approx(growth("peak_force", 20, 40), rel=2e-3)
    wrong = [growth("peak_force", 10, 20), growth("peak_force", 40, 20), growth("final_velocity", 20, 40)]
    assert [each.answer for each in grows.mistakes[:-1]] == pytest.approx(wrong, rel=1e-2)


def test_areas_are_alike_where_forces_are_not():
    _, modes = beside(method="modal", modes=5)
    assert error(EXACT, modes, "impulse") < 0.2 and error(EXACT, modes, "peak_force") > 30.0


def test_exact_waves_are_fastest_here():
    """In the table that comes with the program, of the scene of this step."""
    stored = shipped(SCENES[STEPS[3].scene])
    assert stored is not None
    points = {(each["method"]["name"], each["label"]): each for each in TradeOff.from_table(stored).table()["points"]}
    times = {key: each["wall_time"] for key, each in points.items()}
    exact = next(time for (name, label), time in times.items() if label == "waves")
    few, many = (times["modal", f"modal modes={count}"] for count in (FEW, MANY))
    assert exact == min(times.values()) and 2.0 * exact < few < 0.5 * many


def test_rigid_bodies_are_enough_for_two_balls():
    simple = RigidImpulse(1.0).solve(BALLS.scene)
    assert simple.impactor_velocity == pytest.approx(BALLS.impactor_velocity, rel=1e-6)
    scene = BALLS.scene
    steel = scene.impactor.material
    across = 4.0 * scene.target.radius * math.sqrt(steel.density / steel.young)  # to and fro in the larger one
    assert BALLS.contact_time > 5.0 * across
