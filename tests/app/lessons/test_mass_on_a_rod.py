"""Numbers and statements of the lesson on a mass that strikes a rod, computed."""

import numpy as np
import pytest

from app.lessons.shipped import shipped_lesson

from .numbers import assert_numbers, same, solution_of

NAME = "mass-on-a-rod"
STEPS = shipped_lesson(NAME).steps
MOMENT, WAY, SIZE = 20.0, 5.156, 1000.0  # [µs], [mm in a µs], N in a kN
END, MIDDLE = 1.7, 0.5  # of the sketch [T]


def force(solution, at):
    """In kN, at this time [T]."""
    return 1e-3 * np.interp(at * solution.scene.time_unit, solution.time, solution.force)


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    fixed, endless = solution_of(STEPS[0]), solution_of(STEPS[4])
    rod, mass, speed = fixed.scene.target, fixed.scene.impactor.mass, fixed.scene.speed
    per_metre, wave_speed = rod.mass / rod.length, rod.wave_speed
    impedance = 1e-3 * per_metre * wave_speed
    decay = 1e3 * mass / impedance  # [µs]
    shares = force(endless, 0.5) / impedance, force(endless, 1.0) / force(endless, 0.5)
    assert shares == pytest.approx((np.exp(-1.0), np.exp(-1.0)), rel=1e-4)
    assert same("58", decay) and same("58", 0.5e6 * fixed.scene.time_unit)
    assert same("36.7", force(fixed, 1e-4)) and same("2.13", mass * speed)
    values = {
        "2.13": mass, "1": speed, "5156": wave_speed, "20": MOMENT, "103": 1e-3 * MOMENT * wave_speed,
        "7.11": per_metre, "5.156": 1e-3 * wave_speed, "36.7": impedance * speed, "116": 1e6 * endless.scene.time_unit,
        "8": 8.0, "2": 2.0, "3": 3.0, "0.5": MIDDLE, "4": 4.0,  # of the four strikes
        "13.5": force(fixed, 0.5), "37": 100.0 * shares[0], "58": decay, "1000": SIZE, "73.3": 2.0 * impedance,
    }  # fmt: skip
    assert_numbers(NAME, language, values)


def test_answers():
    rod = solution_of(STEPS[0]).scene.target
    way, push, fall = (STEPS[at].parts[2] for at in (1, 2, 5))
    assert way.answer == pytest.approx(1e-3 * MOMENT * rod.wave_speed, rel=2e-3)
    assert way.mistakes[0].numbers[1] == pytest.approx(rod.wave_speed / MOMENT, rel=1e-3)
    assert way.mistakes[0].numbers[2] == pytest.approx(1e3 * MOMENT / rod.wave_speed, rel=1e-3)
    assert push.answer == pytest.approx(1e-3 * rod.impedance, rel=1e-3)
    assert push.mistakes[0].answer == pytest.approx(0.5 * push.answer)
    decay = 1e6 * solution_of(STEPS[0]).scene.impactor.mass / rod.impedance
    assert fall.answer == pytest.approx(decay, rel=1e-3)
    assert fall.mistakes[0].answer == pytest.approx(0.5 * decay, rel=1e-3)
    assert fall.mistakes[1].numbers[0] == pytest.approx(1e3 / decay, rel=2e-3)
    assert STEPS[1].parts[3].at == pytest.approx(1e-6 * MOMENT / rod.round_trip_time, rel=2e-3)


def test_only_the_speed_counts_at_the_first_touch():
    """The four strikes of the order, by their masses and speeds."""
    rod = solution_of(STEPS[3]).scene.target
    found = []
    for mass, speed in ((8.0, 1.0), (2.0, 2.0), (1.0, 3.0), (0.5, 4.0)):
        solution = solution_of(STEPS[3], mass_ratio=rod.mass / mass, speed=speed)
        assert force(solution, 1e-5) == pytest.approx(1e-3 * rod.impedance * speed, rel=1e-3)
        found.append(force(solution, 1e-5))
    assert found == sorted(found)


def test_a_double_mass_pushes_for_twice_as_long():
    single, double = solution_of(STEPS[4]), solution_of(STEPS[4], mass_ratio=0.5)
    assert double.peak_force == pytest.approx(single.peak_force, rel=1e-6)
    assert force(double, 1.0) == pytest.approx(force(single, 0.5), rel=1e-4)
    assert double.impulse == pytest.approx(2.0 * single.impulse, rel=1e-6)


def test_the_wall_feels_twice_what_the_front_brings():
    solution = solution_of(STEPS[6])
    rod, unit = solution.scene.target, solution.scene.time_unit
    assert len(STEPS[6].parts[2].options) == 3
    moving = 2.0 * rod.impedance * solution.scene.speed  # to stop what arrives, beside what it brings
    stress = solution.known_motion.stress([0.501 * unit], [rod.length])  # at the wall
    assert abs(np.ravel(stress)[0]) * rod.area == pytest.approx(moving, rel=5e-3)
