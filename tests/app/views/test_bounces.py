"""The answer of the view of bounces: flights, the series of Zeno, gravity, what does not bounce."""

import json
import math

import numpy as np
import pytest
from pytest import approx

from app.choices.choices import SCENES
from app.choices.kinds import kind_of
from app.choices.scene_of import own_choices
from app.views.bounces import MOST, bounces_data
from app.views.registry import VIEWS
from solvers.bodies.drop import STANDARD_GRAVITY
from tests.app.sentences import sentence


def asked(scene: str, gravity: float = STANDARD_GRAVITY, **changes) -> dict:
    return own_choices(scene) | changes | {"bounce_gravity": gravity}


def answer(scene: str, gravity: float = STANDARD_GRAVITY, **changes) -> dict:
    return json.loads(bounces_data(asked(scene, gravity, **changes)))


@pytest.fixture(scope="module")
def ball() -> dict:
    return answer("bouncing-ball")


def test_rest_is_that_of_the_series_and_flights_obey_gravity(ball):
    assert ball["height"] == approx(1.0, rel=1e-12) and ball["ended"] == "cut" and not ball["stopped"]
    fall = math.sqrt(2.0 / STANDARD_GRAVITY)
    assert ball["rest_time"] == approx(9.0 * fall, rel=1e-12) and ball["path"] == approx(1.64 / 0.36, rel=1e-12)
    time, height = np.array(ball["path_time"]), np.array(ball["path_height"])
    assert (np.diff(time) >= 0.0).all() and (height >= 0.0).all() and time[-1] == approx(ball["rest_time"], rel=1e-5)
    for first, second in zip(ball["bounces"], ball["bounces"][1:4], strict=False):
        within = (time >= first["time"]) & (time <= second["time"])
        free = first["rebound"] * (time - first["time"]) - 0.5 * STANDARD_GRAVITY * (time - first["time"]) ** 2
        assert height[within] == approx(free[within], abs=3e-5)  # times have six digits
        assert height[within].max() == approx(0.64 * first["speed"] ** 2 / 2.0 / STANDARD_GRAVITY, rel=1e-5)


def test_less_gravity_is_a_higher_fall_at_the_same_speed(ball):
    moon = answer("bouncing-ball", 1.62)
    assert moon["bounces"][0]["speed"] == approx(ball["bounces"][0]["speed"], rel=1e-12)
    assert moon["height"] / ball["height"] == approx(STANDARD_GRAVITY / 1.62, rel=1e-12)
    assert moon["rest_time"] / ball["rest_time"] == approx(STANDARD_GRAVITY / 1.62, rel=1e-9)


def test_sliders_are_followed_and_the_end_is_said():
    plastic = answer("bouncing-ball", restitution=0.0)
    assert (plastic["ended"], plastic["rest_time"]) == ("stays", approx(math.sqrt(2.0 / STANDARD_GRAVITY)))
    assert plastic["path_height"][-1] == 0.0
    elastic = answer("bouncing-ball", restitution=1.0)
    assert (len(elastic["bounces"]), elastic["rest_time"], elastic["ended"]) == (MOST, None, "count")
    yielding = answer("drop-test")
    given = [bounce["restitution"] for bounce in yielding["bounces"]]
    assert given == sorted(given) and {note["code"] for note in yielding["notes"]} >= {"bounces-on-fresh-spots"}


def test_who_cancels_gets_what_is_known():
    found = json.loads(bounces_data(asked("drop-test"), lambda: True))
    assert found["stopped"] and len(found["bounces"]) == 1 and found["ended"] == "count"


def test_what_does_not_bounce_is_refused_or_not_asked():
    assert "a mass that strikes what is held" in sentence(answer("free-rod")["error"])
    (view,) = (view for view in VIEWS if view.name == "bounces")
    assert [kind_of(SCENES[name]).NAME in view.kinds for name in ("slider-crank", "bouncing-ball")] == [False, True]
