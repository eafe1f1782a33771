"""The lessons that come with the program hold in their scenes, and every number in their sentences is computed here."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from app.lessons.beginning import template
from app.lessons.checking import check
from app.lessons.lesson import Summary
from app.lessons.shipped import FOLDER, in_order, lesson_files, lesson_names, shipped_lesson
from app.lessons.solving import solved
from solvers import solve

from .numbers import assert_numbers, same, solution_of

GRAVITY = 9.80665  # [m/s2]


@pytest.mark.parametrize("path", lesson_files(), ids=lambda path: path.stem)
def test_each_passes_its_check(path):
    found = check(path)
    assert (found.problems, found.missing) == ((), ())
    assert found.lesson is not None and found.lesson.lesson == path.name.split(".")[0]
    told = [step for step in found.lesson.steps if not any(isinstance(part, Summary) for part in step.parts)]
    assert 4 <= len(told) <= 8


def test_a_lesson_leads_to_one_that_is_there():
    following = {shipped_lesson(name).next for name in lesson_names()} - {""}
    assert following <= set(lesson_names())


def test_an_unknown_lesson_is_no_file():
    with pytest.raises(KeyError):
        shipped_lesson("../../secret")


@pytest.mark.parametrize("scene", ["fixed-rod", "drop-test", "four-bar", "spinning-ball", "hammer-on-cantilever"])
@pytest.mark.parametrize("language", ["en", "es"])
def test_the_template_is_a_lesson(tmp_path, scene, language):
    file = tmp_path / "own-one.md"
    file.write_text(template("own-one", scene, language), encoding="utf-8")
    found = check(file)
    assert found.problems == () and found.lesson is not None
    assert (found.lesson.lesson, found.lesson.scene, found.lesson.language) == ("own-one", scene, language)


@cache
def bounce():
    """What the sentences of the first lesson say, computed: values by where they come from."""
    solution = solution_of(shipped_lesson("bounce-twice").steps[0])
    rod, unit = solution.scene.target, solution.scene.time_unit
    first, second = solution.contacts
    begun, before, after = (np.interp(at * unit, solution.time, solution.force) for at in (1e-4, 0.999, 1.001))
    return {
        "mass": solution.scene.impactor.mass,
        "speed": solution.scene.speed,
        "force": 1e-3 * begun,
        "jump": (after - before) / begun,
        "part": first.end / unit,
        "touch-2": second.start / unit,
        "part-2": second.end / unit,
        "round-trip": 1.0,
        "length": rod.length,
        "wave-speed": 2.0 * rod.length / unit,
        "T": 1e6 * unit,
        "half": 0.5e6 * unit,
    }


CHART, SIZE = 2.6, 1000.0  # the end of the chart [T], and µs in ms


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers_of_bounce_twice(language):
    found = bounce()
    values = {
        "2.7": found["mass"], "1": found["speed"], "2.6": CHART, "36.7": found["force"], "2.03": found["touch-2"],
        "2.20": found["part-2"], "2": 2.0 * found["round-trip"], "0.3": found["length"], "5156": found["wave-speed"],
        "116": found["T"], "1000": SIZE,
    }  # fmt: skip
    assert_numbers("bounce-twice", language, values)


def test_answers_of_bounce_twice():
    found = bounce()
    steps = shipped_lesson("bounce-twice").steps
    sketch, number = steps[1].parts[2], steps[3].parts[2]
    assert same("36.7", found["force"]) and sketch.given == (0.0, 36.7)
    assert found["jump"] == pytest.approx(2.0, rel=0.01)
    assert 1.6 < found["part"] < 1.85 < found["touch-2"] < found["part-2"] < 2.6 == sketch.until
    assert number.answer == pytest.approx(found["T"], rel=1e-3)
    assert number.mistakes[0].answer == pytest.approx(found["half"], rel=1e-3)
    assert number.mistakes[1].numbers == pytest.approx([found["wave-speed"] / 0.3, found["wave-speed"] / 0.6], rel=1e-4)


@pytest.mark.parametrize("ratio, fewer", [(0.45, 1), (2.0, 1), (0.8, 2)])
def test_why_there_is_one_contact(ratio, fewer):
    """A light mass parts before 2 T; a heavy one is still there then."""
    solution = solution_of(shipped_lesson("bounce-twice").steps[2], mass_ratio=ratio)
    assert len(solution.contacts) == fewer
    end = solution.contacts[0].end / solution.scene.time_unit
    assert end > 2.0 if ratio < 0.6 else end < 2.0


@pytest.mark.parametrize("language", ["en", "es"])
def test_numbers_of_what_an_impact_is(language):
    lesson = shipped_lesson("what-an-impact-is")
    light, equal = (solve(solved(lesson.steps[number]).request.scene) for number in (0, 4))
    mass, speed = light.scene.impactor.mass, light.scene.speed
    back, onward = -light.impactor_velocity, light.target_velocity
    mean, peak = light.impulse / light.contact_time, light.peak_force
    slow, fast = equal.impactor_velocity, equal.target_velocity
    kept = (slow**2 + fast**2) / speed**2
    assert light.scene.target.mass == pytest.approx(3.0 * mass, rel=1e-9)
    assert equal.scene.target.mass == pytest.approx(equal.scene.impactor.mass, rel=1e-9)
    assert onward == pytest.approx(back, rel=1e-6)
    assert mass * GRAVITY < 1e-3 * mean
    assert equal.restitution["newton"] == pytest.approx(0.5, rel=1e-6)
    assert equal.table()["energy"]["dissipated"] / equal.scene.impactor.mass == pytest.approx(
        0.5 * (1.0 - kept), rel=1e-6
    )
    values = {
        "0.3": mass, "1": speed, "0.5": back, "0.45": light.impulse, "1.5": speed + back,
        "143": 1e6 * light.contact_time, "3.1": 1e-3 * mean, "5.7": 1e-3 * peak, "2.9": mass * GRAVITY,
        "0.25": slow, "0.75": fast, "37.5": 100 * (1 - kept), "0.625": kept,
    }  # fmt: skip
    assert same("0.5", fast - slow)  # the restitution, and the speed at which they part
    assert same("0.25", 0.5**2)  # of a wall
    assert_numbers("what-an-impact-is", language, values)
    impulse, force, lost = (lesson.steps[n].parts[2] for n in (1, 2, 4))
    assert impulse.answer == pytest.approx(light.impulse, rel=1e-3)
    assert [each.answer for each in impulse.mistakes] == pytest.approx(
        [mass * (speed - back), mass * speed, -light.impulse], rel=2e-3
    )
    assert same("3.1", force.answer) and force.answer == pytest.approx(1e-3 * mean, rel=1e-4)  # as the sentence says
    for value in (1e-3 * mean, 3.12, 3.13, 3.15):  # of the solution, and by hand from 0.45 N s in 143 µs
        assert abs(value - force.answer) <= force.tolerance
    assert force.mistakes[0].answer == pytest.approx(1e-3 * peak, rel=1e-3)
    assert [lost.answer, *(each.answer for each in lost.mistakes[:-1])] == pytest.approx(
        [100 * (1 - kept), 100 * kept, 50.0, 100 * (1 - 0.5**2)], rel=1e-4
    )


def test_the_first_ball_stops_where_masses_are_equal():
    step = shipped_lesson("what-an-impact-is").steps[3]
    lighter, equal, heavier = (solution_of(step, mass_ratio=ratio) for ratio in (1.01, 1.0, 0.99))
    assert abs(equal.impactor_velocity) < 1e-9
    assert lighter.impactor_velocity < 0.0 < heavier.impactor_velocity


def test_no_sentence_is_too_long_to_be_read():
    for path in lesson_files():
        assert max(map(len, path.read_text("utf-8").splitlines())) < 320, path.relative_to(FOLDER)


@pytest.mark.parametrize(
    "following, order",
    [
        ({"what-an-impact-is": "bounce-twice", "bounce-twice": ""}, ["what-an-impact-is", "bounce-twice"]),
        ({"b": "", "a": "", "z": "y", "y": ""}, ["z", "y", "a", "b"]),  # the longest course first
        ({"c": "b", "a": "b", "b": ""}, ["a", "b", "c"]),  # two lead to one
        ({"a": "b", "b": "a", "c": "none-such"}, ["c", "a", "b"]),  # a ring has no first one
        ({"a": "a"}, ["a"]),
    ],
)
def test_lessons_stand_as_they_follow_each_other(following, order):
    one = shipped_lesson("bounce-twice")
    given = [replace(one, lesson=name, next=then) for name, then in following.items()]
    assert [each.lesson for each in in_order(given)] == order
