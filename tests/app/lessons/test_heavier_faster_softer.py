"""Numbers and statements of the lesson on masses, speed and stiffness, computed."""

import numpy as np
import pytest

from app.lessons.scales import value_at
from app.lessons.shipped import shipped_lesson

from .numbers import assert_numbers, same, solution_of

NAME = "heavier-faster-softer"
STEPS = shipped_lesson(NAME).steps
GOAL, SIZE = 2.9, 1000.0  # [kN], N in a kN
MICRO, KILO = 1e6, 1e-3


def mean(solution):
    """Of the force [kN]."""
    return KILO * solution.impulse / solution.contact_time


def each_changed():
    """The four impacts of the order: softer, as at first, heavier, faster."""
    stiffness = STEPS[3].parts[2].start
    return [
        solution_of(STEPS[2], **changes)
        for changes in ({"hertz_stiffness": 0.5 * stiffness}, {}, {"mass_ratio": 1.5}, {"speed": 2.0})
    ]


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    softer, first, heavier, faster = each_changed()
    spring, slow_spring = solution_of(STEPS[4]), solution_of(STEPS[4], speed=1.0)
    rod, light = solution_of(STEPS[5]), solution_of(STEPS[5], mass_ratio=1.0)
    shorter, stronger = faster.contact_time / first.contact_time, mean(faster) / mean(first)
    stiff = solution_of(STEPS[6])
    asked = STEPS[6].parts[2]
    assert stiff.scene.speed == 1.0 and len(stiff.contacts) == 2
    assert heavier.scene.impactor.mass == pytest.approx(2.0 * first.scene.impactor.mass)
    assert faster.peak_force / first.peak_force == pytest.approx(stronger, rel=1e-4)
    assert (stronger, shorter) == pytest.approx((2.0**1.2, 2.0**-0.2), rel=1e-3)
    assert spring.contact_time == pytest.approx(slow_spring.contact_time, rel=1e-6)
    assert spring.peak_force == pytest.approx(2.0 * slow_spring.peak_force, rel=1e-4)
    values = {
        "0.3": first.scene.impactor.mass, "1": first.scene.speed, "143": MICRO * first.contact_time,
        "2": faster.scene.speed, "125": MICRO * faster.contact_time, "0.45": first.impulse, "3.1": mean(first),
        "0.87": shorter, "2.3": stronger, "5.7": KILO * first.peak_force, "13.2": KILO * faster.peak_force,
        "4.3": KILO * softer.peak_force, "7.6": KILO * heavier.peak_force, "173": MICRO * heavier.contact_time,
        "2.9": GOAL, "4.96": KILO * slow_spring.peak_force, "142": MICRO * spring.contact_time, "1000": SIZE,
        "2.13": light.scene.impactor.mass, "36.7": KILO * rod.peak_force, "116": MICRO * rod.contact_time,
        "1.84": light.impulse, "2.70": rod.impulse, "0.71": stiff.scene.impactor.mass, "1.02": border()[20] * 1e-11,
        "10": asked.ranges[0][1], "3.2": 10.0**0.5,
    }  # fmt: skip
    assert_numbers(NAME, language, values)


def border():
    """Stiffness of the second contact, at equal ratios of the speed [N/m^1.5]."""
    asked = STEPS[6].parts[2]
    return np.array([value_at(share, asked.ranges[1], asked.logs[1]) for share in asked.truth])


def test_a_second_contact_begins_where_stiffness_times_the_root_of_the_speed_is_the_same():
    """Hertz's law scales so: its force is K d^1.5, and d goes with the speed where K sqrt(v) stays."""
    asked = STEPS[6].parts[2]
    speeds = np.geomspace(*asked.ranges[0], len(asked.truth))
    assert border() * np.sqrt(speeds) == pytest.approx(border()[20], rel=2e-3)
    for speed, stiffness in zip(speeds[::10], border()[::10], strict=True):
        counts = [
            len(solution_of(STEPS[6], speed=speed, hertz_stiffness=each * stiffness).contacts) for each in (0.99, 1.01)
        ]
        assert counts == [1, 2]


def test_answers():
    softer, first, heavier, faster = each_changed()
    peaks = [each.peak_force for each in (softer, first, heavier, faster)]
    assert peaks == sorted(peaks)
    asked, spring = STEPS[1].parts[2], STEPS[4].parts[2]
    assert asked.answer == pytest.approx(mean(faster), rel=1e-3)
    assert [each.answer for each in asked.mistakes[:3]] == pytest.approx(
        [2.0 * mean(first), 0.5 * mean(faster), KILO * faster.peak_force], rel=3e-3
    )
    linear, slow = solution_of(STEPS[4]), solution_of(STEPS[4], speed=1.0)
    assert spring.answer == pytest.approx(KILO * linear.peak_force, rel=1e-3)
    assert [each.answer for each in spring.mistakes[:3]] == pytest.approx(
        [KILO * factor * slow.peak_force for factor in (2.0**1.2, 4.0, 1.0)], rel=1e-3
    )


def test_half_the_force_takes_twice_the_time():
    asked = STEPS[3].parts[2]
    first, soft = solution_of(STEPS[3]), solution_of(STEPS[3], hertz_stiffness=asked.found[0].range[1])
    assert asked.start == pytest.approx(first.scene.contact.stiffness, rel=1e-3)
    assert soft.peak_force < 0.51 * first.peak_force and soft.contact_time > 1.95 * first.contact_time
    assert soft.impulse == pytest.approx(first.impulse, rel=1e-6)
    assert solution_of(STEPS[3], hertz_stiffness=3.1e9).peak_force > GOAL / KILO


def test_a_heavy_mass_changes_only_the_impulse_on_a_free_rod():
    light, heavy = solution_of(STEPS[5], mass_ratio=1.0), solution_of(STEPS[5])
    unit = heavy.scene.time_unit
    assert heavy.scene.impactor.mass == pytest.approx(2.0 * light.scene.impactor.mass)
    assert (heavy.peak_force, heavy.contact_time) == pytest.approx((light.peak_force, light.contact_time), rel=1e-6)
    assert same("1.0", heavy.contact_time / unit) and heavy.impulse > 1.4 * light.impulse
