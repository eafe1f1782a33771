"""Numbers and statements of the lesson on restitution, computed."""

import pytest

from app.lessons.shipped import shipped_lesson

from .numbers import assert_numbers, same, solution_of

NAME = "restitution-is-no-constant"
STEPS = shipped_lesson(NAME).steps


def restitution(step, **choices):
    return solution_of(STEPS[step], **choices).restitution["newton"]


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    equal, light = solution_of(STEPS[0]), solution_of(STEPS[4])
    slow, fast, speed = equal.impactor_velocity, equal.target_velocity, equal.scene.speed
    kept = (slow**2 + fast**2) / speed**2
    energy = equal.table()["energy"]
    assert energy["dissipated"] == pytest.approx(0.0, abs=1e-9)
    assert energy["target_vibration"] / energy["initial"] == pytest.approx(1.0 - kept, rel=1e-6)
    values = {
        "2.13": equal.scene.impactor.mass, "1": speed, "0.135": slow, "0.865": fast, "0.73": fast - slow,
        "0.766": kept, "23.4": 100.0 * (1.0 - kept), "0.95": 0.95,  # of a goal
        "0.2": light.restitution["newton"], "0.99": restitution(3, mass_ratio=0.1),
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    first, share, other = (STEPS[at].parts[2] for at in (1, 2, 4))
    assert same("0.73", first.answer) and same("0.865", first.mistakes[0].answer)
    assert share.answer == pytest.approx(100.0 * (1.0 - kept), rel=2e-3)
    assert [each.answer for each in share.mistakes[:-1]] == pytest.approx(
        [100.0 * kept, 100.0 * (1.0 - equal.restitution["newton"])], rel=4e-3
    )
    assert other.answer == pytest.approx(light.restitution["newton"], rel=1e-3)


def test_bodies_and_order():
    assert solution_of(STEPS[0]).scene.mass_ratio == pytest.approx(1.0)
    light = solution_of(STEPS[4])
    assert light.scene.mass_ratio == pytest.approx(5.0)
    assert abs(light.impactor_velocity) < 1e-3 * light.scene.speed
    energy = light.table()["energy"]
    assert energy["target_vibration"] > 0.5 * energy["initial"]
    ordered = [restitution(3, mass_ratio=ratio) for ratio in (5.0, 1.0, 0.1)] + [restitution(5)]
    assert ordered == sorted(ordered) and ordered[-1] == pytest.approx(1.0, rel=1e-9)


def test_two_rods_stop_and_go_without_waves():
    found = solution_of(STEPS[5]).table()["energy"]
    assert found["target_vibration"] == pytest.approx(0.0, abs=1e-9)
    assert found["target_rigid"] == pytest.approx(found["initial"], rel=1e-9)


def test_heavy_masses_leave_no_waves():
    """Below a ratio of 0.31 the restitution is above 0.95, and not beyond it."""
    assert restitution(3, mass_ratio=0.31) > 0.95 > restitution(3, mass_ratio=0.32)
