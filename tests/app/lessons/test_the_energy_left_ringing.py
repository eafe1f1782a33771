"""Numbers and statements of the lesson on the energy that rings, computed."""

import numpy as np
import pytest

from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.lessons.shipped import shipped_lesson
from app.views.energy import energy_shares

from .numbers import assert_numbers, solution_of

NAME = "the-energy-left-ringing"
STEPS = shipped_lesson(NAME).steps
WANTED, BRIGHT = 0.5, 200.0 / 3.0  # of the restitution; percent that ring
MILLI = 1e3

ROD, MIDDLE, NODE = (solution_of(STEPS[number]) for number in (0, 1, 4))


def part(solution, name):
    """Of the energy at the end [%]."""
    return 100.0 * solution.energy[name] / solution.energy["initial"]


def shares(number):
    """What the chart of a step draws."""
    return energy_shares(Request.of(own_choices(STEPS[number].scene) | STEPS[number].choices))


def ringing(solution):
    """Of each mode after the contact, by number: its share of what rings [%]."""
    modes = solution.target_modes
    energies = modes.energies(solution.contacts[-1].end)[0]
    return dict(zip(modes.numbers.tolist(), 100.0 * energies / energies.sum(), strict=True))


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    tone, second = MIDDLE.target_modes.frequencies[0], NODE.target_modes.frequencies[0]
    waves = shares(0)["target_vibration"]
    scene, vibration = MIDDLE.scene, part(MIDDLE, "target_vibration")
    values = {
        "23": part(ROD, "target_vibration"), "50": waves.max(), "0.35": shares(0)["time"][waves.argmax()],
        "1": ROD.contact_time / ROD.scene.time_unit, "30": MILLI * scene.impactor.mass,
        "280": MILLI * scene.target.mass, "0.47": MILLI * MIDDLE.contact_time, "38": part(MIDDLE, "impactor"),
        "28": part(MIDDLE, "target_rigid"), "34": vibration, "0": 0.0, "17": 0.5 * vibration, "751": tone,
        "0.67": 0.5 * MILLI / tone, "99.9": ringing(MIDDLE)[1], "2": 2.0, "3": 3.0, "4": 4.0, "5": 5.0, "6": 6.0,
        "78": MILLI * NODE.scene.target.at * NODE.scene.target.length, "5.8": part(NODE, "target_vibration"),
        "2.069": 1e-3 * second, "0.5": WANTED, "0.788": MIDDLE.restitution["newton"],
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert part(NODE, "target_vibration") / vibration == pytest.approx(1.0 / 6.0, rel=0.03)
    assert part(NODE, "target_rigid") > 50.0


def test_answers():
    asked, period = STEPS[2].parts[2], MILLI / MIDDLE.target_modes.frequencies[0]
    assert asked.answer == pytest.approx(0.5 * period, rel=1e-3)
    assert asked.mistakes[0].answer == pytest.approx(period, rel=1e-3)
    assert asked.mistakes[1].numbers == pytest.approx([1e3 / period, 2e3 / period, 0.5e3 / period], rel=1e-3)


def test_waves_take_up_half_and_give_some_back():
    waves = shares(0)["target_vibration"]
    assert np.all(np.diff(waves[: waves.argmax()]) > 0.0) and np.all(np.diff(waves[waves.argmax() :]) < 1e-9)


def test_bending_goes_up_and_down_while_the_sum_stays():
    """Between nothing and all that rings, with peaks half a period apart."""
    found = shares(1)
    free = found["time"] > MIDDLE.contacts[-1].end
    time, bent, moving = (found[key][free] for key in ("time", "target_strain", "target_kinetic"))
    assert bent + moving == pytest.approx(bent[0] + moving[0], rel=1e-9)
    ringing_on = part(MIDDLE, "target_vibration") - bent[-1]  # as motion, beside that of the bar as a whole
    assert moving[-1] - part(MIDDLE, "target_rigid") == pytest.approx(ringing_on, abs=0.1)
    assert bent.max() == pytest.approx(part(MIDDLE, "target_vibration"), rel=0.01) and bent.min() < 0.1
    early = time < 0.9e-3
    apart = time[~early][bent[~early].argmax()] - time[early][bent[early].argmax()]
    assert apart == pytest.approx(0.5 / MIDDLE.target_modes.frequencies[0], rel=0.02)


def test_which_modes_ring():
    middle, node = ringing(MIDDLE), ringing(NODE)
    assert all(number % 2 for number in middle)
    assert middle[3] < 0.1 and 1.8 < MIDDLE.contact_time * MIDDLE.target_modes.frequencies[1] < 2.0
    assert 1 not in node and node[2] > 99.0


def test_a_hard_stick_makes_more_modes_ring():
    asked = STEPS[5].parts[2]
    edges = [solution_of(STEPS[5], hertz_stiffness=each) for each in asked.found[0].range]
    assert all(each.restitution["newton"] < WANTED and part(each, "target_vibration") > BRIGHT for each in edges)
    assert all(ringing(each)[3] + ringing(each)[5] > 50.0 for each in edges)
    before = solution_of(STEPS[5], hertz_stiffness=4e9)
    assert before.restitution["newton"] > WANTED
