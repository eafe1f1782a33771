"""Numbers and statements of the lesson on friction in an impact, computed."""

import numpy as np
import pytest

from app.lessons.shipped import shipped_lesson
from solvers import solve

from .numbers import assert_numbers, same, solution_of

NAME = "a-ball-with-spin"
STEPS = shipped_lesson(NAME).steps
RADIUS, FRICTION, KILO = 0.03, 0.5, 1000.0  # [m]
SMALL, LARGER = 0.1, 0.2  # of friction


def struck(friction=FRICTION):
    return solution_of(STEPS[0], friction=friction)


def along(friction):
    """Velocity afterwards, to the right [m/s]."""
    return struck(friction).impactor_velocity[0]


def slides():
    """Before the impact, to the right [m/s]."""
    ball = struck().scene.impactor
    return ball.velocity[0] + ball.spin[2] * RADIUS


def sideways():
    """Impulse along the floor [N s]."""
    ball = struck().scene.impactor
    return ball.mass * (ball.velocity[0] - struck().impactor_velocity[0])


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    solution = struck()
    ball, energy = solution.scene.impactor, solution.energy
    values = {
        "0.1": ball.mass, "1": ball.velocity[0], "3": -ball.velocity[1], "120": ball.spin[2], "0.31": -along(FRICTION),
        "30": 1e3 * RADIUS, "0.03": RADIUS, "3.6": ball.spin[2] * RADIUS, "4.6": slides(), "0.5": FRICTION,
        "2": 2.0, "7": 7.0, "5": 5.0, "1.31": sideways() / ball.mass, "0.759": energy["initial"], "0.131": sideways(),
        "2.3": slides() / 2.0, "0.30": energy["friction"], "0.16": energy["dissipated"], "1000": KILO,
        "2.4": solution.impactor_velocity[1], "61": 100.0 * (1.0 - energy["impactor"] / energy["initial"]),
        "0.46": along(SMALL), "0.08": -along(LARGER), "0.2": LARGER, "0.4": 0.4,
        "0.263": solution.sliding[0].until,
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert same("1", along(0.0)) and same("0.31", -along(0.4))
    inertia = ball.inertia[2][2]
    assert ball.mass * RADIUS**2 / inertia == pytest.approx(2.5, rel=1e-9)  # of a solid ball


def test_answers():
    solution = struck()
    ball, energy = solution.scene.impactor, solution.energy
    sliding, grips, rubbed = (STEPS[n].parts[2] for n in (1, 2, 5))
    spun = ball.spin[2] * RADIUS
    assert sliding.answer == pytest.approx(slides(), rel=1e-9)
    found = spun, spun - ball.velocity[0], ball.velocity[0]
    assert [each.answer for each in sliding.mistakes[:3]] == pytest.approx(found, rel=1e-9)
    stop = ball.mass * slides()
    assert grips.answer == pytest.approx(sideways(), rel=1e-3)
    assert sideways() == pytest.approx(2.0 / 7.0 * stop, rel=1e-9)
    assert [each.answer for each in grips.mistakes] == pytest.approx(
        [stop, stop * 0.4, solution.sliding[0].until, stop * 3.5, -sideways()], rel=1e-3
    )
    assert rubbed.answer == pytest.approx(energy["friction"], rel=2e-3)
    assert energy["friction"] == pytest.approx(sideways() * slides() / 2.0, rel=1e-9)
    assert [each.answer for each in rubbed.mistakes[:2]] == pytest.approx(
        [2.0 * energy["friction"], energy["dissipated"]], rel=2e-3
    )


def test_the_spin_is_nearly_gone_and_costs_most():
    solution = struck()
    assert abs(solution.impactor_spin[2]) < 0.1 * solution.scene.impactor.spin[2]
    still = solve(solution.scene.replace({"impactor.spin": [0.0, 0.0, 0.0]}))
    lost = [each.energy["dissipated"] + each.energy["friction"] for each in (still, solution)]
    assert lost[0] < 0.5 * lost[1] and solution.energy["friction"] > solution.energy["dissipated"]


def test_more_friction_than_it_takes_changes_nothing():
    """Sliding ends at half the normal impulse with twice the friction, the velocities are the same."""
    ends = {friction: struck(friction).sliding[0].until for friction in (FRICTION, 2.0 * FRICTION)}
    assert ends[2.0 * FRICTION] == pytest.approx(0.5 * ends[FRICTION], rel=1e-9)
    low, high = STEPS[4].parts[2].found[0].range
    for friction in (low, FRICTION, high):
        solution = struck(friction)
        assert solution.impactor_velocity == pytest.approx(struck().impactor_velocity, abs=1e-9)
        assert [each.kind for each in solution.sliding] == ["slip", "stick"]
        assert sideways() < friction * solution.normal_impulse
    for friction in (SMALL, LARGER, 0.24):
        solution = struck(friction)
        across = solution.scene.impactor.mass * (1.0 - solution.impactor_velocity[0])
        assert [each.kind for each in solution.sliding] == ["slip"]
        assert across == pytest.approx(friction * solution.normal_impulse, rel=1e-9)


def test_the_floors_are_in_order():
    speeds = [along(friction) for friction in (0.0, SMALL, LARGER, 0.4)]
    assert (np.diff(speeds) < 0.0).all() and speeds[1] > 0.0 > speeds[2]
