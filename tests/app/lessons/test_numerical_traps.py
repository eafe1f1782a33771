"""Numbers and statements of the lesson on numerical traps, computed by the methods that it speaks of."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from app.lessons.shipped import shipped_lesson
from solvers import FeNodal, solve

from .numbers import assert_numbers, same, solution_of

NAME = "numerical-traps"
STEPS = shipped_lesson(NAME).steps
MICRO, LOOK, FINER = 1e6, 0.1, 40  # how often they are looked at [T], elements
HEAVIER = 1.0 / 1.01  # mass ratio
SHORT, NEXT, MIDDLE, LONG = 5.89e-8, 9.82e-8, 2.95e-7, 5.89e-7  # steps [s]


@cache
def frozen(stiffness, steps, elements=20):
    """With the status of the contact kept for each step; of 0.3 ms."""
    method = {"contact_stiffness": stiffness, "steps": steps, "status": "frozen", "elements": elements}
    scene = solution_of(STEPS[0]).scene
    return solve(scene.replace({"method": scene.method | method}))


@cache
def balanced(elements, step):
    scene = solution_of(STEPS[3]).scene
    return solve(scene.replace({"method": scene.method | {"elements": elements, "step": step}}))


def shares(solution):
    """Of the energy in the end, in mass and rod [%]."""
    energy = solution.energy
    rod = energy["target_rigid"] + energy["target_vibration"]
    return [100.0 * each / energy["initial"] for each in (energy["impactor"], rod)]


def lost(elements, step):
    energy = balanced(elements, step).energy
    return 100.0 * energy["dissipated"] / energy["initial"]


@cache
def whole(ratio=1.0):
    """The impact of the beam to its end."""
    return solution_of(replace(STEPS[5], scene="figure-5.19"), mass_ratio=ratio)


@cache
def pulled(ratio=1.0):
    """The force at the start of contact 11, which is negative [N]."""
    solution = solution_of(STEPS[5], mass_ratio=ratio)
    return solution.contacts[10].start, float(np.interp(solution.contacts[10].start, solution.time, solution.force))


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    exact, coarse, burst, long = solution_of(STEPS[0]), frozen(10.0, 300), frozen(100.0, 300), solution_of(STEPS[5])
    scene, (mass, rod), second = exact.scene, shares(coarse), exact.contacts[1]
    fine, fit, within = frozen(100.0, 10000), solution_of(STEPS[6]), solve(exact.scene)
    values = {
        "2.133": scene.impactor.mass, "1": scene.speed, "20": coarse.method["elements"],
        "0.771": -coarse.impactor_velocity, "0.699": -exact.impactor_velocity, "100": 100.0, "59.5": mass,
        "112.4": rod, "172": mass + rod, "1088": -burst.impactor_velocity, "40": FINER,
        "0.03": MICRO * fine.duration / 10000, "0.697": -fine.impactor_velocity, "0.8": sum(shares(fine)) - 100.0,
        "0.690": -within.impactor_velocity, "589": 1e9 * LONG, "0.750": -balanced(30, NEXT).impactor_velocity,
        "6233": round(balanced(30, SHORT).duration / SHORT), "0.301": -1e-3 * pulled()[1], "1.3": 1e3 * long.duration,
        "4.2": 1e3 * whole().contacts[-1].end,
        "30": balanced(30, LONG).method["elements"], "0.589": MICRO * LONG, "74": lost(30, LONG), "16": lost(30, SHORT),
        "0.420": -balanced(30, LONG).impactor_velocity, "0.732": -balanced(30, SHORT).impactor_velocity,
        "93": lost(60, LONG), "0.0589": MICRO * SHORT, "10": 10.0, "60": 60.0, "1.2": 1e3 * pulled()[0],
        "301": -pulled()[1], "12": 1e-3 * long.peak_force, "0.01": 100.0 * (1.0001 - 1.0), "276": -pulled(1.0001)[1],
        "326": -pulled(0.9999)[1], "49": len(whole().contacts),
        "0.82": -whole(HEAVIER).impactor_velocity, "0.81": -whole().impactor_velocity,
        "0.04": (second.end - second.start) / scene.time_unit,
        "2.12": second.start / scene.time_unit, "2.16": second.end / scene.time_unit, "0.1": LOOK, "2": 2.0,
        "0.025": 1.0 / 20.0 / 2.0, "0.7": 100.0 * second.impulse / fit.impulse,
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert same("1", MICRO * coarse.duration / 300) and same("40", lost(10, LONG))
    assert len(whole(HEAVIER).contacts) == 40


def test_answers():
    mass, rod = shares(frozen(10.0, 300))
    nowhere, second = STEPS[1].parts[2], STEPS[6].parts[2]
    assert nowhere.answer == pytest.approx(mass + rod - 100.0, abs=0.1)
    assert [each.answer for each in nowhere.mistakes[:-1]] == pytest.approx([rod - 100.0, mass + rod], abs=0.1)
    exact = solution_of(STEPS[6])
    unit, (first, again) = exact.scene.time_unit, exact.contacts
    assert second.answer == pytest.approx((again.end - again.start) / unit, rel=0.01)
    assert [each.answer for each in second.mistakes] == pytest.approx([again.start / unit, first.end / unit], rel=0.01)


def test_a_finer_mesh_and_longer_steps_are_worse():
    """Of the frozen status; a status that is found within the step keeps the energy."""
    assert sum(shares(frozen(100.0, 300, FINER))) > sum(shares(frozen(100.0, 300))) > 1e3
    implicit = solve(solution_of(STEPS[0]).scene)
    assert implicit.method["status"] == "implicit" and implicit.method["steps"] == 300
    assert sum(shares(implicit)) == pytest.approx(100.0, abs=1e-6)
    assert implicit.impactor_velocity == pytest.approx(solution_of(STEPS[0]).impactor_velocity, abs=0.01)


def test_the_loss_belongs_to_the_steps():
    order = [lost(30, SHORT), lost(10, LONG), lost(30, LONG), lost(60, LONG)]
    assert order == sorted(order)
    assert lost(30, LONG) > lost(30, MIDDLE) > lost(30, SHORT) > lost(30, SHORT / 5)
    assert solution_of(STEPS[3]).energy["dissipated"] == 0.0  # of the exact impact


def test_the_pull_is_no_property_of_the_impact():
    """It changes with a hundredth of a percent of mass, the first contacts do not."""
    found = [solution_of(STEPS[5], mass_ratio=ratio).contacts[:7] for ratio in (0.9999, 1.0001)]
    starts = [[each.start for each in contacts] for contacts in found]
    assert starts[0] == pytest.approx(starts[1], rel=1e-3)
    first, last = STEPS[5].parts[0].play
    assert first < pulled()[0] / solution_of(STEPS[5]).scene.time_unit < last


def test_the_mesh_misses_the_second_contact():
    exact = solution_of(STEPS[6])
    coarse = FeNodal(elements=STEPS[6].parts[0].beside["elements"]).solve(exact.scene)
    assert len(coarse.contacts) == 1 and len(exact.contacts) == 2
    at = coarse.time / exact.scene.time_unit
    assert (coarse.force[(at > 0.93) & (at < 0.97)] == 0.0).all()  # just before 1 T
    assert 1e-3 * (exact.peak_force - coarse.peak_force) == pytest.approx(20.0, abs=1.5)


def test_what_is_said_to_be_exact_is_shown_so():
    assert all(STEPS[number].choices["method"] == "waves" for number in (0, 1, 2))
