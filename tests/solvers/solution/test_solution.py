"""What a solution gives by itself: its history as arrays, and how bodies turn on."""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import SceneError
from tests.catalog import SCENES, T


@pytest.mark.parametrize("method", ["waves", "modal", "fe-nodal"])
@pytest.mark.parametrize("name", ["fixed-rod", "bronze-rod-steel-ball"])
def test_force_over_time_is_an_array_and_holds_the_impulse(name, method):
    solution = solvers.solve(name, method)
    time, force = solution.time, solution.force
    assert time.shape == force.shape and (np.diff(time) >= 0.0).all()
    assert time[0] == 0.0 and time[-1] == approx(solution.duration, rel=1e-3)
    # of modes constant over each step; of others straight lines between instants, where contacts begin and end inside
    assert np.trapezoid(force, time) == approx(solution.impulse, rel=1e-12 if method == "modal" else 1e-3)
    peak = solution.diagnostics.get("raw_peak_force", solution.peak_force)
    assert force.max() == approx(peak, rel=1e-3)
    assert solution.force is force


def test_bodies_in_space_have_no_history():
    solution = solvers.solve("brick-off-centre")
    for name in ("time", "force"):
        with pytest.raises(SceneError, match="a solution with a history"):
            getattr(solution, name)


@pytest.mark.parametrize("name", ["figure-9.2", "figure-10.8", "figure-9.11"])
def test_a_pendulum_says_how_it_turns_on(name):
    solution = solvers.solve(SCENES[name])
    for body, swing in solution.swings.items():
        spin = getattr(solution, f"{body}_spin")
        distance = getattr(solution.scene, body).pivot_distance
        assert spin == swing.spin == approx(getattr(solution, f"{body}_velocity") / distance, rel=1e-12)
        assert solution.table()[body]["final_spin"] == spin
    assert solution.swings and None in (solution.impactor_spin, solution.target_spin)


def test_spins_of_bodies_in_space_are_vectors_and_what_does_not_turn_has_none():
    brick = solvers.solve("brick-off-centre")
    assert np.shape(brick.impactor_spin) == (3,) == np.shape(brick.target_spin)
    rod = solvers.solve("fixed-rod")
    assert rod.impactor_spin is None and rod.target_spin is None


def test_for_how_long_the_bodies_are_in_contact():
    """The sum of all periods, with none of the time between; of a sudden impulse nothing."""
    solution = solvers.solve("fixed-rod")
    assert len(solution.contacts) == 2
    assert solution.contact_time == approx(1.572054 * T, rel=1e-5)  # 1.533834 + (2.162843 - 2.124623)
    assert solution.table()["contact_time"] == sum(contact.duration for contact in solution.contacts)
    sudden = solvers.solve("rigid-pendulum")
    assert sudden.contact_time == sudden.contacts[0].duration == 0.0
