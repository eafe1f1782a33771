"""Numbers and statements of the lesson on links that bend, computed."""

from functools import cache

import numpy as np
import pytest

from app.lessons.shipped import shipped_lesson
from solvers import solve

from .numbers import assert_numbers, same, solution_of

NAME = "a-link-that-bends"
STEPS = shipped_lesson(NAME).steps
HARD = 1e9  # stiffness of the contact
SOFT = (1e6, 3e6, 6e6)  # at which there is one contact
DEPTH, TIP, COUPLER, LESS = 0.008, 0.8, 0.5, 4.0  # [m], percent
MILLI = 1e3


@cache
def bent(stiffness=HARD):
    return solution_of(STEPS[0], hertz_stiffness=stiffness)


@cache
def rigid(stiffness=HARD):
    """The same impact on a bar that does not bend."""
    scene = bent(stiffness).scene
    links = [{key: value for key, value in link.items() if key != "modes"} for link in scene.target.table()["links"]]
    return solve(scene.replace({"target": scene.target.table() | {"links": links}}))


@cache
def begun():
    """Times of the first contact [s], its force and that of the pin [N]."""
    time = np.linspace(0.0, bent().contacts[0].end, 2001)
    return time, np.interp(time, bent().time, bent().force), bent().motion.reaction_forces(time)[:, 0, 1]


def joint(solution, number):
    return np.array(solution.table()["joints"][number]["impulse"])


def excess(stiffness):
    return rigid(stiffness).peak_force / bent(stiffness).peak_force


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    solution, bar = bent(), bent().scene.target.links[0]
    tip, mass = bar.length * 3.142, solution.scene.impactor.velocity
    (time, force, pin), four, flexible = begun(), solution_of(STEPS[5]), solution_of(STEPS[5], method="modal")
    first, last = int(force.argmax()), int(abs(pin).argmax())
    values = {
        "0.943": tip, "0.057": mass, "1": tip + mass, "0.3": bar.length, "8": MILLI * DEPTH,
        "1.871": -solution.impactor_velocity, "4": LESS, "0.15": MILLI * time[first], "835": force[first],
        "32": abs(pin[first]), "1167": abs(pin[last]), "0.75": MILLI * time[last],
        "0.85": MILLI * rigid().contact_time, "4.92": 1e-3 * rigid().peak_force, "10": len(solution.contacts),
        "14.6": MILLI * solution.contacts[-1].end, "1.41": 1e-3 * solution.peak_force,
        "13.6": MILLI * solution.scene.time_unit, "1.4": excess(SOFT[0]), "1.7": excess(SOFT[-1]), "3.5": excess(HARD),
        "4.27": four.impulse, "0.8": TIP, "0.5": COUPLER, "15": len(flexible.contacts), "6.37": joint(flexible, 2)[0],
        "7": 100.0 * (1.0 - joint(flexible, 2)[0] / joint(four, 2)[0]),
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert 0.96 < solution.impactor_velocity / rigid().impactor_velocity < 0.97
    assert solution.scene.target.table()["links"][0]["section"]["height"] == DEPTH


def test_answers():
    bar, mass = bent().scene.target.links[0], bent().scene.impactor.velocity
    tip = bar.length * 3.142
    leaves, coupler = STEPS[0].parts[2], STEPS[5].parts[2]
    assert leaves.answer == pytest.approx(-rigid().impactor_velocity, rel=1e-3)
    assert leaves.answer == pytest.approx(2.0 * tip + mass, rel=1e-3)
    assert [each.answer for each in leaves.mistakes] == pytest.approx([tip + mass, tip, 2.0 * tip], rel=1e-3)
    four = solution_of(STEPS[5])
    held = joint(four, 2)[0]
    assert coupler.answer == pytest.approx(held, rel=1e-3)
    assert held == pytest.approx(four.impulse * TIP / COUPLER, rel=1e-9)
    found = four.impulse, four.impulse * COUPLER / TIP, abs(joint(four, 3)[0])
    assert [each.answer for each in coupler.mistakes] == pytest.approx(found, rel=2e-3)


def test_the_rigid_bar_passes_its_force_on_at_once():
    time = np.linspace(1e-6, rigid().contact_time, 501)
    force, pin = np.interp(time, rigid().time, rigid().force), rigid().motion.reaction_forces(time)[:, 0, 1]
    assert len(rigid().contacts) == 1
    assert abs(abs(pin) - force).max() < 0.01 * rigid().peak_force


def test_the_pin_of_the_bent_bar_feels_it_later_and_the_other_way_before():
    time, force, pin = begun()
    last = int(abs(pin).argmax())
    assert (pin[:last] * pin[last]).min() < -0.3 * pin[last] ** 2
    items, unit = STEPS[3].parts[2].items, bent().scene.time_unit
    found = time[int(force.argmax())] / unit, time[last] / unit
    assert [items[1].at, items[2].at] == pytest.approx(found, abs=2e-4)
    assert items[5].at == pytest.approx(bent().contacts[-1].end / unit, abs=0.01)


@pytest.mark.parametrize("stiffness", SOFT)
def test_a_soft_contact_lasts_longer_than_the_slowest_period(stiffness):
    solution = bent(stiffness)
    assert len(solution.contacts) == 1 and solution.contact_time > solution.scene.time_unit
    assert 1.36 < excess(stiffness) < 1.71
    assert STEPS[4].parts[2].found[0].range == (SOFT[0], SOFT[-1])
    assert same("13.6", MILLI * solution.scene.time_unit)


@pytest.mark.parametrize("change", [{"mass_ratio": 0.99}, {"mass_ratio": 1.01}, {"modes": 16}])
def test_a_little_more_or_less_of_anything_is_the_same_story(change):
    other = solution_of(STEPS[0], **change)
    assert other.impactor_velocity == pytest.approx(bent().impactor_velocity, rel=0.01)
    assert other.peak_force == pytest.approx(bent().peak_force, rel=0.03)
