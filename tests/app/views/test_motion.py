"""The answer of the view of a mechanism that moves on: picture, impacts, reactions, energies, and who may ask."""

import json

import numpy as np
import pytest
from pytest import approx

import solvers
from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.views import motion
from app.views.motion import followed, motion_data, of_mechanisms, restitution_of
from solvers.bodies import Mechanism


def asked(scene: str, seconds: float = 0.0, **changes) -> dict:
    return own_choices(scene) | {"motion_seconds": seconds, "motion_links": "flexible"} | changes


def answer(scene: str, seconds: float = 0.0, **changes) -> dict:
    return json.loads(motion_data(asked(scene, seconds, **changes)))


@pytest.fixture(scope="module")
def piston() -> dict:
    return answer("bouncing-on-piston", 0.6)


@pytest.fixture(scope="module")
def pendulum() -> dict:
    return answer("double-pendulum", 1.0)


def ends_of(found: dict) -> np.ndarray:
    """(instants, links, ends, x and y) [m]."""
    return np.array(found["places"]).reshape(len(found["time"]), len(found["mechanism"]["links"]), -1, 2)


def test_links_keep_their_lengths_and_stay_joined(pendulum):
    ends = ends_of(pendulum)
    lengths = np.hypot(*np.moveaxis(ends[:, :, 1] - ends[:, :, 0], -1, 0))
    assert lengths == approx(np.full(lengths.shape, 0.4), abs=2e-5)  # five digits are sent
    assert ends[:, 0, 1] == approx(ends[:, 1, 0], abs=2e-5)
    assert np.abs(ends - ends[0]).max() > 0.05


def test_the_mass_flies_freely_and_meets_the_piston_at_every_impact(piston):
    time = np.array(piston["time"])
    x, y = np.array(piston["mass_places"]).reshape(-1, 2).T
    assert np.abs(x).max() < 1e-12
    (_, end, _), (next_start, *_) = piston["impacts"][0], piston["impacts"][1]
    free = (time >= end) & (time <= next_start)
    curve = np.polynomial.Polynomial.fit(1e-3 * time[free], y[free], 2).convert()
    assert curve.coef[2] == approx(-0.5 * 9.81, rel=1e-2)
    assert piston["contacts"] == len(piston["impacts"]) > 1
    top = ends_of(piston)[:, 2, :, 1].mean(axis=1)
    for start, _, impulse in piston["impacts"]:
        at = int(np.abs(time - start).argmin())
        assert y[at] == approx(top[at], abs=2e-5) and impulse > 0.0


def test_parts_of_the_energy_add_up_to_what_was_there(piston, pendulum):
    for found in (piston, pendulum):
        total = np.sum([*found["energies"].values()], axis=0)
        assert total == approx(np.full(total.shape, total[0]), rel=1e-3)  # histories are straight between steps
        assert found["figures"]["energy_drift"] < 1e-9 and found["figures"]["constraint_error"] < 1e-12
    assert "dissipated" in piston["energies"] and "dissipated" not in pendulum["energies"]


def test_the_first_impact_is_the_rigid_impulse(piston):
    scene = Request.of(asked("bouncing-on-piston")).scene
    alone = solvers.solve(scene, "rigid", restitution=0.6)
    assert piston["parting"]["impulse"] == approx(alone.impulse, rel=1e-12)
    assert piston["parting"]["velocity"] == approx(alone.impactor_velocity, rel=1e-12)


def test_joints_get_the_impulses_of_the_library(piston):
    solution, *_ = followed(asked("bouncing-on-piston", 0.6))
    alone = solvers.solve(Request.of(asked("bouncing-on-piston")).scene, "rigid", restitution=0.6)
    expected = [np.hypot(*joint["impulse"]) for joint in alone.reactions]
    assert piston["jolts"][0] == approx(expected, rel=1e-4)
    assert len(piston["jolts"]) == min(8, len(solution.contacts))


def test_reactions_are_those_of_the_motion(pendulum):
    solution, *_ = followed(asked("double-pendulum", 1.0))
    forces = np.array(pendulum["reactions"]).reshape(-1, 2, 3)
    assert len(forces) == len(pendulum["history_time"])
    middle = len(forces) // 2
    expected = solution.motion.reaction_forces(1e-3 * pendulum["history_time"][middle])[0]
    assert forces[middle] == approx(expected, rel=1e-4, abs=1e-4)
    assert forces[:, 0, 1].mean() == approx(2.0 * 9.81, rel=0.05)  # the pin bears both bars of 1 kg


@pytest.mark.parametrize(("seconds", "flexible"), [(0.004, True), (0.5, False)])
def test_links_that_bend_are_followed_as_long_as_their_vibrations_can_be(seconds, flexible):
    found = answer("rotating-bar", seconds)
    solution, refused, _ = followed(asked("rotating-bar", seconds))
    assert solution is not None
    target = solution.scene.target
    assert isinstance(target, Mechanism) and target.flexible == flexible == (refused is None)
    assert (found["rigid"] is None) == flexible
    if not flexible:
        assert found["rigid"]["code"] == "refusals.flexible-steps"
    assert found["mechanism"]["links"][0]["flexible"] == flexible
    assert found["parting"]["contacts"] == (found["contacts"] if flexible else 1)
    bends = ends_of(found)[:, 0]
    across = bends[:, 0] - 2.0 * bends[:, bends.shape[1] // 2] + bends[:, -1]
    assert bends.shape[1] == (1 + motion.BENT_PARTS if flexible else 2)
    assert np.abs(across).max() > 5e-5 or not flexible  # five digits are sent
    rigid = answer("rotating-bar", seconds, motion_links="rigid")
    assert not rigid["mechanism"]["links"][0]["flexible"] and rigid["rigid"] is None and rigid["contacts"] >= 1


def test_restitution_is_that_of_the_slider_where_there_is_one():
    assert restitution_of(Request.of(own_choices("bouncing-on-piston"))) == 0.6
    assert restitution_of(Request.of(own_choices("four-bar") | {"restitution": 0.3})) == 1.0  # of its contact law
    assert answer("slider-crank", restitution=0.25)["restitution"] == 0.25


def test_what_would_take_too_long_is_cut_short_and_said(monkeypatch):
    monkeypatch.setattr(motion, "MOST_RIGID_STEPS", 100)  # of the 200 that a turn of its crank takes
    found = answer("slider-crank", 0.04)
    assert found["cut"] and found["duration"] == approx(0.5 * 50.26548, rel=1e-3)
    assert not answer("slider-crank", 0.02)["cut"] and not answer("slider-crank")["cut"]


def test_messages_are_small(piston):
    assert len(json.dumps(piston)) < 1e5
    bent = motion_data(asked("figure-6.7", 0.004))
    assert json.loads(bent)["mechanism"]["links"][0]["flexible"] and len(bent) < 1e5


def test_only_mechanisms_move_on():
    assert of_mechanisms(asked("fixed-rod")) is None and of_mechanisms(asked("four-bar")) is not None
    assert of_mechanisms(asked("four-bar") | {"bodies": "target.nothing=1"}) is None
    assert answer("fixed-rod")["refused"]["code"] == "refusals.no-mechanism"
