"""When a rigid link is enough."""

import pytest
from pytest import approx

import solvers
from solvers import Modal, Waves, plan
from solvers.regimes.solved import COUNTS
from tests.catalog import SCENES
from tests.solvers.bodies.linkage.mechanisms import four_bar, rotating_bar

FINE = {"impactor.modes": 80, "method": {"name": "modal", "modes": 80}}
HERTZ = {"law": "hertz", "stiffness": 1e9}
SAME = 1.0 + 1e-9  # what is computed twice by the same solves, but for rounding


def test_the_chosen_model_is_as_good_as_it_says():
    scene = four_bar(20, contact=HERTZ)
    found = plan(scene, "final-velocities", 0.02)
    fine = Modal(modes=40, estimate=False).solve(four_bar(40, contact=HERTZ))
    missed = abs(solvers.solve(found.planned).impactor_velocity - fine.impactor_velocity) / scene.speed
    assert missed <= found.expected_error * SAME and found.expected_error <= 0.02
    assert found.chosen.modes in COUNTS


def test_rigid_links_are_enough_for_a_soft_contact_and_not_for_a_hard_one():
    still = {"target.drives": [{"joint": 0, "speed": 0.0}], "impactor.velocity": 1.0}
    soft, hard = (rotating_bar(10, contact={"law": "linear", "stiffness": k}, **still) for k in (1e2, 1e9))
    assert plan(soft, "peak-force", 0.05).model == "local-quasi-static"
    assert plan(hard, "peak-force", 0.05).chosen.modes
    for scene in (soft, hard):
        errors = [candidate.expected_error for candidate in plan(scene).candidates if candidate.modes]
        assert errors == sorted(errors, reverse=True)


@pytest.mark.parametrize("question", ["peak-force", "contact-times", "stresses"])
def test_an_impulse_predicts_no_force(question):
    found = plan(four_bar(6, contact=HERTZ), question, 1e-6)
    assert found.candidates[0].expected_error == float("inf")
    assert "nothing here does better" in found.reason or found.expected_error <= 1e-6


def test_whether_a_pendulum_must_bend_is_solved():
    """Figure 9.11: rigid it is a fifth of the speed off; what is chosen is as good as it says, against 80 modes."""
    scene = SCENES["figure-9.11"]
    found = plan(scene, "final-velocities", 0.01)
    assert found.measured and found.chosen.modes == 5
    rigid = next(each for each in found.candidates if each.name == "rigid-pendulum")
    exact, waves = solvers.solve(scene.replace(FINE)), solvers.solve(SCENES["figure-9.2"])
    missed = abs(solvers.solve(scene.replace(rigid.changes)).impactor_velocity - exact.impactor_velocity) / scene.speed
    assert missed == approx(rigid.expected_error, rel=1e-3) and missed == approx(0.21, abs=0.005)
    assert solvers.solve(scene.replace(rigid.changes)).peak_force == approx(waves.peak_force, rel=5e-3)
    assert abs(solvers.solve(found.planned).impactor_velocity - exact.impactor_velocity) / scene.speed <= 0.01
    assert "with a rigid pendulum it would be 21 %" in found.reason


@pytest.mark.parametrize("name", ["figure-10.8", "figure-5.21", "figure-5.22"])
def test_stops_and_rods_that_turn_are_solved_too(name):
    for question in ("final-velocities", "peak-force", "contact-times"):
        found = plan(SCENES[name], question, 0.05)
        assert found.measured and found.chosen.modes and found.expected_error <= 0.05
    assert plan(SCENES[name], "stresses").candidates


def test_more_modes_than_links_have_are_asked_of_the_links():
    """Of figure 6.2 three are given, and eight are needed; of a mechanism that strikes, of the impactor."""
    found = plan(SCENES["figure-6.2"], "final-velocities", 0.05)
    assert [link.modes for link in SCENES["figure-6.2"].target.links] == [3, 3]
    assert found.chosen.modes == 8 and found.chosen.changes["target.links.2.modes"] == 8
    assert [link.modes for link in found.planned.target.links] == [8, 8]
    striking = plan(SCENES["trip-hammer"].replace({"impactor.links.1.modes": 3}), "final-velocities", 1e-3)
    assert striking.chosen.modes == striking.chosen.changes["impactor.links.1.modes"] == 5
    assert striking.planned.impactor.links[0].modes == 5


@pytest.mark.parametrize(
    "name, question, read",
    [
        ("bronze-rod-steel-ball", "peak-force", lambda found: found.peak_force),
        ("hammer-on-cantilever", "contact-times", lambda found: found.contacts[-1].end),
        ("two-unequal-rods", "final-velocities", lambda found: found.impactor_velocity),
    ],
)
def test_any_scene_that_rings_is_solved_with_each_model_where_that_is_asked_for(name, question, read):
    """By exact waves where they can, else by 80 modes; each error is that of the model as it is to be solved."""
    scene = SCENES[name]
    found = plan(scene, question, 0.01, solve=True)
    true = read(Modal(modes=80).solve(scene) if scene.target.bends else Waves().solve(scene))
    size = scene.speed if question == "final-velocities" else true
    names = [each.name for each in found.candidates]
    assert names.index("rigid-impulse") == 0 and found.measured
    assert ("waves" in names) == (not scene.target.bends)
    for candidate in found.candidates:
        if candidate.expected_error < float("inf") and not candidate.modes:
            missed = abs(read(solvers.solve(scene.replace(candidate.changes))) - true) / size
            assert missed == approx(candidate.expected_error, rel=1e-3, abs=1e-7)
    assert abs(read(solvers.solve(found.planned)) - true) / size <= max(0.01, found.expected_error * SAME)
    errors = [candidate.expected_error for candidate in found.candidates if candidate.modes]
    assert errors == sorted(errors, reverse=True)


@pytest.mark.parametrize("name", ["drop-test", "two-balls", "brick-off-centre"])
def test_what_has_nothing_that_rings_is_planned_as_before(name):
    assert plan(SCENES[name], "peak-force", solve=True).table() == plan(SCENES[name], "peak-force").table()


def test_weight_is_in_each_model():
    """A model that leaves out weight is none of those of a scene in which it acts."""
    scene = SCENES["hammer-on-cantilever"].replace({"contact": HERTZ, "impactor": {"mass": 0.5, "height": 0.2}})
    found = plan(scene, "peak-force", 0.01, solve=True)
    assert scene.weight_acceleration and any(each.modes for each in found.candidates)
    for candidate in found.candidates:
        method = candidate.changes["method"]
        assert not solvers.METHODS[method["name"]]().neglects_weight(scene)
