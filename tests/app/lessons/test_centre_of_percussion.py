"""Numbers and statements of the lesson on the centre of percussion, computed."""

import numpy as np
import pytest

from app.lessons.shipped import shipped_lesson

from .numbers import assert_numbers, same, solution_of

NAME = "centre-of-percussion"
STEPS = shipped_lesson(NAME).steps
LENGTH, END, PERCUSSION = 1.2, 0.6, 0.8  # of the rod; from its middle; from its lower end [m]
GYRATION = LENGTH**2 / 12.0  # k2 [m2]
WANTED, KILO = 1.9, 1000.0


def struck(place):
    return solution_of(STEPS[0], place=place)


def lower_end(place):
    """Its velocity afterwards, to the right [m/s]."""
    solution = struck(place)
    across = np.cross(solution.target_spin, [0.0, -END, 0.0])
    return float(solution.target_velocity[0] + across[0])


def effective(place):
    """Of the rod where it is struck [kg]."""
    solution = struck(place)
    return 1.0 / (1.0 / solution.effective_mass - 1.0 / solution.scene.impactor.mass)


def weight():
    """Mass of the pendulum, of which not all counts [kg]."""
    return solution_of(STEPS[5]).table()["scene"]["impactor"]["mass"]


def pushed(place):
    """Impulse of the pin on the hanging bar, to the right [N s]."""
    return solution_of(STEPS[4], place=place).table()["joints"][0]["impulse"][0]


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    free, hung, swung = struck(1.0), solution_of(STEPS[4]), solution_of(STEPS[5])
    bar, pendulum = hung.scene.target.links[0], swung.scene.impactor
    values = {
        "1.2": lower_end(1.0), "2": free.scene.target.mass, "0.5": free.scene.impactor.mass,
        "3": -free.scene.impactor.velocity[0], "0.6": -free.target_velocity[0], "12": 12.0, "0.12": GYRATION,
        "1.8": abs(free.target_spin[2]) * END, "0.36": END**2, "1.9": WANTED, "0.8": PERCUSSION, "1": 1.0, "0": 0.0,
        "0.2": PERCUSSION - END, "0.51": hung.impulse, "0.26": pushed(1.0), "0.4": bar.length * 2.0 / 3.0,
        "0.197": weight(), "0.0041": pendulum.inertia, "0.19": pendulum.pivot_distance,
        "0.114": pendulum.inertia / pendulum.pivot_distance**2, "1000": KILO, "0.667": PERCUSSION / LENGTH,
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert same("1.2", LENGTH) and same("0.6", bar.length) and same("3", abs(free.target_spin[2]))
    assert same("3", END**2 / GYRATION)


def test_answers():
    heavy, still, swung = (STEPS[n].parts[at] for n, at in ((1, 2), (3, 2), (5, 2)))
    mass, pendulum = struck(1.0).scene.target.mass, solution_of(STEPS[5]).scene.impactor
    assert heavy.answer == pytest.approx(effective(1.0), rel=1e-9)
    assert effective(0.5) == pytest.approx(mass, rel=1e-9)
    assert [each.answer for each in heavy.mistakes[:4]] == pytest.approx([mass, mass / 2, mass / 3, mass * 4], rel=1e-4)
    assert still.answer == PERCUSSION and lower_end(PERCUSSION / LENGTH) == pytest.approx(0.0, abs=1e-12)
    found = PERCUSSION - END, LENGTH - PERCUSSION, PERCUSSION / LENGTH
    assert [each.answer for each in still.mistakes] == pytest.approx(found, rel=1e-4)
    assert found[0] * END == pytest.approx(GYRATION, rel=1e-9)
    equal = pendulum.inertia / pendulum.pivot_distance**2
    assert swung.answer == pytest.approx(equal, rel=1e-3)
    assert [each.answer for each in swung.mistakes[:2]] == pytest.approx(
        [weight(), pendulum.inertia / pendulum.pivot_distance], rel=2e-3
    )
    assert solution_of(STEPS[5]).scene.impactor.effective_mass == pytest.approx(equal, rel=1e-9)


def test_the_lower_end_goes_one_way_or_the_other():
    assert lower_end(0.5) < 0.0 < lower_end(0.75) < lower_end(1.0)
    upper = struck(0.4 / LENGTH)  # struck on the other side, the upper end stands still
    assert upper.target_velocity[0] + np.cross(upper.target_spin, [0.0, END, 0.0])[0] == pytest.approx(0.0, abs=1e-12)


def test_the_last_step_shows_the_rod_struck_where_its_lower_end_stands_still():
    assert lower_end(STEPS[-1].choices["place"]) == pytest.approx(0.0, abs=1e-3)
    assert struck(STEPS[-1].choices["place"]).target_spin[2] > 1.0


def test_the_push_is_largest_near_the_middle():
    low, high = STEPS[2].parts[2].found[0].range
    assert struck(low).impulse == pytest.approx(struck(high).impulse, rel=1e-9)
    assert struck(0.5).impulse > struck(high).impulse > WANTED > struck(0.6).impulse
    assert (struck(0.5).target_spin[2], STEPS[2].parts[2].start) == (pytest.approx(0.0, abs=1e-12), 1.0)


def test_the_pin_pushes_the_same_way_or_not_at_all():
    assert pushed(1.0) > 0.2 and pushed(2.0 / 3.0) == pytest.approx(0.0, abs=1e-9)
    assert solution_of(STEPS[4]).impactor_velocity < 0.0 < solution_of(STEPS[4]).target_velocity
