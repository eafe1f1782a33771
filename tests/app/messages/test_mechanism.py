"""What the page draws of a mechanism that is struck."""

import numpy as np
import pytest
from pytest import approx

import solvers
from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.messages.encoding import read_header
from app.messages.histories import extremes
from app.messages.mechanism.frame import mechanism_solution
from app.messages.mechanism.resting import rigid_answer
from app.messages.solve import solve_frame
from tests.catalog import SCENES

from .own import arrays, own_message

MOVING = [name for name, scene in SCENES.items() if scene.method.get("name") == "multibody"]


@pytest.mark.parametrize("name", MOVING)
def test_links_that_are_held_still_in_their_directions_are_not_shown_until_they_fly_apart(name):
    """A scene that is followed for seconds as it moves is not shown so long by a method that knows it at the impact.

    Within its impacts, of 26 ms, the tip of the four-bar goes a sixth of its size.
    """
    found = arrays(solve_frame(own_choices(name) | {"method": solvers.usual_method(solvers.load(name))}))
    points = found["linkPoints"].reshape(-1, 2)
    assert np.abs(found["linkMoves"]).max() < 0.2 * np.ptp(points, axis=0).max()


@pytest.fixture(scope="module")
def bent_rods():
    """The message of an impact on the first of two links that bend, and its solution."""
    chosen = own_choices("bent-rods")
    return arrays(solve_frame(chosen)), mechanism_solution(Request.of(chosen))[0]


def test_a_force_keeps_what_is_least_and_most_in_every_stretch():
    force = np.where(np.arange(6_000) % 3_000 < 40, 5.0 + np.sin(np.arange(6_000)), 0.0)  # two contacts
    time, seen = extremes(1e-3, force)
    assert seen.max() == force.max() and seen.min() == 0.0 and time[0] > 0.0 and time[-1] < 6.0
    assert np.all(np.diff(time) >= 0.0) and seen.size < 700  # of 600 stretches; at rest each once
    assert np.all(seen[(time > 0.05) & (time < 2.99)] == 0.0)


@pytest.mark.parametrize("name", ["four-bar", "rotating-bar"])
def test_messages_of_links_that_bend_are_short(name):
    assert len(own_message(name)) <= 100_000


def test_a_link_beside_the_struck_one_moves_and_bends_as_the_solution_says(bent_rods):
    found, solution = bent_rods
    time, count = found["bendTime"], found["shapeOf1"].shape[1]
    amounts = found["amountsOf1"]
    moved = amounts @ (found["shapeOf1"] * found["shapeScaleOf1"][:, None])
    places = solution.motion.link_points(time, count - 1)["second"]
    expected = (places - places[0]) @ solution.scene.target.struck.normal
    assert moved == approx(expected, abs=1e-3 * np.abs(expected).max())
    moments = amounts @ (found["momentOf1"] * found["momentScaleOf1"][:, None])
    shears = amounts @ (found["shearOf1"] * found["shearScaleOf1"][:, None])
    assert np.abs(moments).max() > 1.0  # N m: an axial wave goes on as bending
    slope = np.gradient(moments, 0.3 / (count - 1), axis=1)[:, 2:-2]
    assert slope == approx(shears[:, 2:-2], abs=0.1 * np.abs(shears).max())  # of 8 shapes on 31 places
    assert np.abs(moments[:, [0, -1]]).max() < 1e-3 * np.abs(moments).max()  # a pin and a free end
    assert "amountsOf0" not in found  # the struck one has fields of its own


def test_reactions_of_rigid_links_stand_beside_and_give_their_impulses(bent_rods):
    found, solution = bent_rods
    rigid = rigid_answer(solution)
    time, forces = found["referenceReactionTime"], found["referenceReactions"]
    expected = rigid.reactions[0]["impulse"]
    assert np.trapezoid(forces[:, 0, :2], time, axis=0) == approx(expected, rel=1e-2, abs=1e-2 * np.hypot(*expected))


def test_links_meet_again_at_the_speeds_from_before():
    """Without restitution they go on together: what is told of how they meet is from just before."""
    rates = arrays(solve_frame(own_choices("table-6.10")))["rates"].reshape(-1, 2, 2)
    apart = rates[:, :, 0] - rates[:, :, 1]
    assert (apart[:, 0] > 0.0).all() and np.abs(apart[:20, 1]).max() < 1e-9


def test_nodes_of_elements_are_told_as_shares_of_the_length():
    [link] = read_header(own_message("figure-6.12"))["mechanism"]["links"]
    assert link["nodes"] == approx([0.25, 0.5, 0.75, 299 / 300, 1.0])
    assert read_header(own_message("figure-6.7"))["mechanism"]["links"][0]["nodes"] == []
