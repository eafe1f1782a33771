"""Numbers and statements of the lesson on rigid bodies, computed."""

import math

import pytest

from app.lessons.shipped import shipped_lesson

from .numbers import assert_numbers, solution_of

NAME = "when-is-a-body-rigid"
STEPS = shipped_lesson(NAME).steps
SHORT = 0.1  # [m]
WANTED, LIMIT = 0.95, 1.0  # of the restitution; percent
MICRO = 1e6


def trips(solution):
    """The first contact, in T."""
    return solution.contacts[0].end / solution.scene.time_unit


def waves(solution):
    """The share of the energy that stays in the rod as waves [%]."""
    energy = solution.table()["energy"]
    return 100.0 * energy["target_vibration"] / energy["initial"]


def shortest():
    long = solution_of(STEPS[0])
    ratio = long.scene.mass_ratio * SHORT / long.scene.target.length
    return solution_of(STEPS[2], bodies=f"target.length={SHORT}", mass_ratio=ratio)


def of_spring():
    """Stiffness of the rod as a spring [N/m], and the half period [s]."""
    scene = solution_of(STEPS[4]).scene
    stiffness = scene.target.material.young * scene.target.area / scene.target.length
    return stiffness, math.pi * math.sqrt(scene.impactor.mass / stiffness)


def in_order():
    """The impacts of the order."""
    return [solution_of(STEPS[0]), *(solution_of(STEPS[5], mass_ratio=ratio) for ratio in (1.0, 0.5, 0.01))]


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    long, short, tiny, heavy = solution_of(STEPS[0]), solution_of(STEPS[2]), shortest(), solution_of(STEPS[4])
    speed, ratio, unit = long.scene.speed, long.scene.mass_ratio, long.scene.time_unit
    stiffness, half = of_spring()
    found = in_order()
    values = {
        "110": 1e3 * long.scene.impactor.mass, "2.03": speed, "1.48": long.scene.target.length, "36": ratio,
        "1.92": speed * (ratio - 1.0) / (ratio + 1.0), "1.11": -long.impactor_velocity, "64": waves(long),
        "115": MICRO * long.contact_time, "3376": long.scene.target.wave_speed, "877": MICRO * unit,
        "0.13": trips(long), "0.4": short.scene.target.length, "237": MICRO * short.scene.time_unit, "0.1": SHORT,
        "59": MICRO * tiny.scene.time_unit, "1": LIMIT, "0.59": long.restitution["newton"], "0.95": WANTED,
        "213": heavy.scene.impactor.mass, "630": 1e-6 * stiffness, "1.83": 1e3 * half,
        "15.7": half / heavy.scene.time_unit, "15.6": trips(heavy), "0.5": waves(heavy),
        "1.5": trips(found[1]), "2.4": trips(found[2]), "51": waves(found[1]), "14": waves(found[2]),
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert waves(tiny) < LIMIT


def test_answers():
    long, (_, half) = solution_of(STEPS[0]), of_spring()
    asked, period = STEPS[1].parts[2], STEPS[4].parts[2]
    assert asked.answer == pytest.approx(trips(long), rel=1e-3)
    assert [each.answer for each in asked.mistakes] == pytest.approx(
        [2.0 * trips(long), 1.0 / trips(long), 0.5 / trips(long)], rel=1e-3
    )
    assert period.answer == pytest.approx(1e3 * half, rel=1e-3)
    assert [each.answer for each in period.mistakes[:2]] == pytest.approx([2e3 * half, 1e3 * half / math.pi], rel=1e-3)
    ordered = in_order()
    assert [trips(each) for each in ordered] == sorted(trips(each) for each in ordered)
    assert [waves(each) for each in ordered] == sorted((waves(each) for each in ordered), reverse=True)


def test_the_ball_cannot_know_how_long_the_rod_is():
    """The same ball and rod, as long as the contact is over before T."""
    long, short = solution_of(STEPS[0]), solution_of(STEPS[2])
    assert short.scene.impactor.mass == pytest.approx(long.scene.impactor.mass, rel=1e-4)
    assert trips(short) < 1.0 and short.scene.target.wave_speed * short.contact_time < short.scene.target.length
    assert short.impactor_velocity == pytest.approx(long.impactor_velocity, rel=1e-4)
    assert shortest().scene.impactor.mass == pytest.approx(long.scene.impactor.mass, rel=1e-4)
    assert trips(shortest()) > 1.0


def test_a_soft_contact_makes_the_rod_rigid():
    asked = STEPS[3].parts[2]
    assert asked.start == pytest.approx(solution_of(STEPS[0]).scene.contact.stiffness, rel=1e-3)
    edge = solution_of(STEPS[3], hertz_stiffness=asked.found[0].range[1])
    assert edge.restitution["newton"] > WANTED > solution_of(STEPS[3], hertz_stiffness=2e8).restitution["newton"]
    assert 0.7 < trips(edge) < 1.1
    shares = [waves(solution_of(STEPS[3], hertz_stiffness=each)) for each in (1e7, 1e8, 1e9, 1e10)]
    assert shares == sorted(shares)
