"""Beams that bend too far for their theory say so, with the size of what is left out."""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from pytest import approx

import solvers
from solvers.methods.theory_limits import MAX_DEPTHS, MAX_SLOPE, TENSION

SHAPES = {  # slope and curvature of a deflection of 1 in the middle of a length of 1
    "clamped-clamped": (lambda x: np.pi * np.sin(2 * np.pi * x), lambda x: 2 * np.pi**2 * np.cos(2 * np.pi * x)),
    "pinned-pinned": (lambda x: np.pi * np.cos(np.pi * x), lambda x: -(np.pi**2) * np.sin(np.pi * x)),
}


def struck(support, speed, **changes):
    beam = {
        "kind": "beam", "length": 1.0, "section": {"width": 0.05, "height": 0.01}, "material": "steel",
        "support": support, "at": 1.0 if support == "cantilever" else 0.5,
    }  # fmt: skip
    scene = {
        "impactor": {"kind": "mass", "mass": 2.0, "velocity": speed},
        "target": beam | changes,
        "contact": {"law": "linear", "stiffness": 1e5},
        "method": {"name": "modal", "modes": 10},
    }
    solution = solvers.solve(solvers.Scene.from_table(scene))
    return solution, {note.code: note.values for note in solution.notes}


@pytest.mark.parametrize("support", TENSION)
def test_the_share_of_tension_is_that_of_the_shape(support):
    """E A e against E I y'': the force of either is the derivative of its energy by w."""
    slope, curvature = SHAPES[support]
    points, weights = leggauss(20)
    x, weights = 0.5 * (points + 1.0), 0.5 * weights
    stretch = 0.5 * weights @ slope(x) ** 2  # w^2 times
    tension, bending = 0.5 * stretch**2, 0.5 * weights @ curvature(x) ** 2  # w^4 E A, w^2 E I times
    assert TENSION[support] == approx(4.0 * tension / (2.0 * bending))


@pytest.mark.parametrize("support", TENSION)
def test_a_beam_held_at_both_ends_is_stretched_beyond_half_its_depth(support):
    solution, notes = struck(support, 1.0)
    times, x = np.linspace(0.0, solution.duration, 400), np.linspace(0.0, 1.0, 101)
    depths = np.abs(solution.known_motion.displacement(times, x)).max() / 0.01  # linear: grows with the speed
    assert "beam-stretches" not in struck(support, 0.9 * MAX_DEPTHS / depths)[1]
    found = struck(support, 2.0 * MAX_DEPTHS / depths)[1]["beam-stretches"]
    assert found["depths"] == approx(2.0 * MAX_DEPTHS, rel=0.02)  # of 120 instants
    assert found["share"] == approx(TENSION[support] * 12.0 * found["depths"] ** 2)
    assert "beam-stretches" not in notes or depths > MAX_DEPTHS


@pytest.mark.parametrize("support", ["cantilever", "free-free"])
def test_others_bend_to_a_slope(support):
    notes = struck(support, 0.05)[1]
    assert not {"beam-stretches", "beam-bends-far"} & set(notes)
    found = struck(support, 60.0, material="titanium", section={"width": 0.05, "height": 0.004})[1]
    assert found["beam-bends-far"]["slope"] > MAX_SLOPE
