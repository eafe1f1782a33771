"""Histories of a stretch of time, sampled for it, in the messages of every kind that has a clock."""

import numpy as np
import pytest
from pytest import approx

import solvers
from app.choices.request import IN_VIEW
from app.choices.scene_of import own_choices
from app.messages.encoding import around, read_header
from app.messages.solve import solve_frame

from .own import arrays, own_message

SCENES = {  # by arrays of instants that are of the stretch
    "fixed-rod": ("motionTime",),
    "rotating-bar": ("time", "reactionTime"),
    "timoshenko-1913-short": ("time",),
    "four-bar-moves": ("time", "reactionTime", "energyTime", "bendTime"),
}


@pytest.mark.parametrize("scene", SCENES)
def test_histories_are_of_the_stretch_alone_and_as_dense_as_those_of_the_whole(scene):
    whole, header = arrays(own_message(scene)), read_header(own_message(scene))
    end = header["trip"] * header["duration"]
    low, high = 0.30 * end, 0.34 * end
    message = solve_frame(own_choices(scene) | {IN_VIEW: f"{low} {high}"})
    found = arrays(message)
    assert read_header(message)["stretch"] == [low, high] and header["stretch"] is None
    for name in SCENES[scene]:
        time, before = header["trip"] * found[name], header["trip"] * whole[name]
        assert time.min() >= 0.999 * low and time.max() <= 1.001 * high
        assert time.size > 2 * ((before >= low) & (before <= high)).sum()


def test_velocities_jump_at_an_impact():
    scene = "four-bar-moves"
    impact = arrays(own_message(scene))["contacts"][2, 0]
    found = arrays(solve_frame(own_choices(scene) | {IN_VIEW: f"{impact - 5e-4} {impact + 5e-4}"}))
    at = np.flatnonzero(np.diff(found["time"]) == 0.0)
    assert found["time"][at] == approx(impact, rel=1e-6) and at.size == 1
    told = arrays(own_message(scene))["rates"][2]
    for column, name in enumerate(("impactorRate", "struckRate")):
        assert found[name][at[0] : at[0] + 2] == approx(told[:, column], rel=1e-6)
    assert abs(told[1, 0] - told[0, 0]) > 0.01


def test_an_edge_stands_twice_before_and_after():
    time, after = around(np.array([0.0, 1.0, 2.0]), np.array([1.0, 1.5, 3.0]))
    assert time.tolist() == [0.0, 1.0, 1.0, 1.5, 1.5, 2.0]
    assert after.tolist() == [True, False, True, False, True, True]


def test_of_a_force_by_steps_every_step_within_the_stretch_is_sent():
    scene = "fixed-rod"
    header = read_header(own_message(scene))
    end = header["trip"] * header["duration"]
    low, high = 0.30 * end, 0.34 * end
    solution = solvers.solve(scene, method=solvers.Waves())
    steps = solution.known_motion.force_history()[0]
    found = header["trip"] * arrays(solve_frame(own_choices(scene) | {IN_VIEW: f"{low} {high}"}))["exactTime"]
    assert found == approx(steps[(steps >= low) & (steps <= high)], rel=1e-6)
