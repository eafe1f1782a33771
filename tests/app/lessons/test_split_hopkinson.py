"""Numbers and statements of the lesson on the split Hopkinson bar, computed."""

import math

import numpy as np
import pytest

from app.lessons.shipped import shipped_lesson

from .numbers import assert_numbers, same, solution_of

NAME = "split-hopkinson"
STEPS = shipped_lesson(NAME).steps


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers(language):
    found = solution_of(STEPS[0])
    striker, (bar, specimen, _) = found.scene.impactor, found.scene.target.rods
    speed, unit = found.scene.speed, found.scene.time_unit
    pulse = found.contacts[0].end
    radius, thin = (math.sqrt(each.area / math.pi) for each in (bar, specimen))
    crossing = 2.0 * specimen.length / specimen.wave_speed
    force = found.table()["joints"][1][0]["peak_force"]
    measured, borne = (1e-6 * force / each.area for each in (bar, specimen))
    values = {
        "0.3": striker.length, "5156": bar.wave_speed, "116": 1e6 * pulse, "1000": 1e3, "0.6": bar.wave_speed * pulse,
        "10": speed, "5": 0.5 * speed, "64.0": 1e-3 * found.peak_force, "314": 1e6 * bar.area, "20": 2e3 * radius,
        "204": 1e-6 * found.peak_force / bar.area, "4": 1e3 * thin, "3.93": 1e6 * crossing, "30": pulse / crossing,
        "203": measured, "6.25": bar.area / specimen.area, "2": 2.0, "780": 1e6 * unit,
        "1270": 10.0 * round(0.1 * borne),
    }  # fmt: skip
    assert_numbers(NAME, language, values)
    assert same("10", 1e3 * radius) and same("10", 1e3 * specimen.length)
    length, stress, times, own = (STEPS[at].parts[2] for at in (0, 2, 4, 5))
    assert length.answer == pytest.approx(1e6 * pulse, rel=1e-3)
    assert stress.answer == pytest.approx(1e-6 * found.peak_force / bar.area, rel=1e-3)
    assert stress.mistakes[0].answer == pytest.approx(0.25 * stress.answer, rel=1e-3)
    assert stress.mistakes[-1].answer == -stress.answer
    assert times.answer == pytest.approx(pulse / crossing, rel=2e-3)
    assert times.mistakes[0].answer == pytest.approx(2.0 * times.answer)
    assert own.answer == pytest.approx(borne, rel=2e-3)
    assert [each.answer for each in own.mistakes[:2]] == pytest.approx([measured, measured * radius / thin], rel=3e-3)


def test_striker_stands_still_and_both_faces_come_to_feel_the_same():
    found = solution_of(STEPS[0])
    row = np.searchsorted(found.time, 1.1 * found.contacts[0].end)
    assert abs(found.force[row]) < 1e-9 * found.peak_force
    assert found.contacts[0].impulse == pytest.approx(found.scene.impactor.mass * found.scene.speed, rel=1e-9)
    near, far = (faces[0] for faces in found.table()["joints"])
    assert near["impulse"] == pytest.approx(far["impulse"], rel=2e-3)
    assert far["start"] - near["start"] == pytest.approx(1.964e-6, rel=1e-3)


def test_order_of_events():
    """The front comes to the specimen, and to the far end."""
    found = solution_of(STEPS[0])
    bar, specimen, other = found.scene.target.rods
    items, unit = STEPS[6].parts[2].items, found.scene.time_unit
    arrival = bar.length / bar.wave_speed
    end = arrival + specimen.length / specimen.wave_speed + other.length / other.wave_speed
    assert [items[2].at * unit, items[4].at * unit] == pytest.approx([arrival, end], rel=2e-3)
    assert found.contacts[0].end < arrival < items[3].at * unit < end
