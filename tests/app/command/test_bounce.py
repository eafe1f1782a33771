"""The command `impact bounce`."""

import json

import pytest
from pytest import approx

import solvers
from tests.app.command.calls import answer, refusal


def test_json_has_exactly_the_promised_keys(capsys):
    found = json.loads(answer(capsys, "bounce", "bouncing-ball", "--json"))
    known = solvers.bounces(solvers.load("bouncing-ball"))
    assert set(found) == {
        "scene", "method", "height", "gravity", "cut", "ended", "rest_time", "path", "bounces", "notes", "note_codes"
    }  # fmt: skip
    assert found["rest_time"] == known.rest_time and len(found["bounces"]) == len(known.bounces)
    assert set(found["bounces"][0]) == {
        "time", "speed", "rebound", "restitution", "contact_time", "height", "peak_force"
    }  # fmt: skip


def test_the_table_shows_the_first_bounces_and_the_last(capsys):
    lines = answer(capsys, "bounce", "bouncing-ball", "--set", "method.restitution=0.9").splitlines()
    numbers = [int(line.split()[0]) for line in lines if line.split() and line.split()[0].isdigit()]
    assert numbers[:11] == list(range(1, 12)) and len(numbers) == 13
    assert any("at rest after" in line for line in lines)


@pytest.mark.parametrize(
    "option, value, said",
    [
        ("--cut", "x", "a number from"),
        ("--cut", "nan", "a number from"),
        ("--cut", "0", "a number from"),
        ("--bounces", "nan", "a whole number"),
        ("--bounces", "1.5", "a whole number"),
        ("--bounces", "0", "a whole number"),
    ],
)
def test_options_that_cannot_be(capsys, option, value, said):
    assert said in refusal(capsys, "bounce", "bouncing-ball", option, value)


def test_a_dropped_scene_says_its_height(capsys):
    found = json.loads(answer(capsys, "solve", "drop-test", "--json"))
    assert found["scene"]["impactor"]["height"] == 0.5 and "velocity" not in found["scene"]["impactor"]
    assert found["energy"]["initial"] == approx(found["scene"]["impactor"]["mass"] * 9.80665 * 0.5, rel=1e-14)


def test_the_report_has_every_ball_of_a_row(capsys):
    lines = answer(capsys, "solve", "newtons-cradle").splitlines()
    balls = [line.split() for line in lines if line.strip().startswith("ball ")]
    known = solvers.solve(solvers.load("newtons-cradle")).ball_velocities
    assert [float(words[2]) for words in balls] == approx(known, rel=1e-6)
