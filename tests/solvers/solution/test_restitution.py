"""Restitution three ways on free and fixed rods: every figure of thesis 4.6 and 4.7."""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Modal, Waves
from solvers.solution.restitution import common_velocity, common_velocity_times, compression_time, restitution
from tests.catalog import T, struck_rod


@pytest.mark.parametrize("beta", [0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 6.0])
def test_free_rod(beta):
    """Reference cases of thesis 4.4: one instant of common velocity, two definitions agree, the third is above 1."""
    found = Waves().solve(struck_rod(beta, "free"))
    rest = math.exp(-2.0 * beta)
    assert found.contacts[0].end / T == approx(1.0, abs=1e-13)
    assert found.impactor_velocity == approx(rest, abs=1e-13)  # (4.13)
    assert found.target_velocity == approx((1.0 - rest) / beta, rel=1e-12)  # (4.16)
    after = np.array([found.contacts[0].end])
    assert found.motion.end_velocity(after) == approx(2.0, rel=1e-12)  # (4.14) prints 1 + exp(-2 beta)
    common = common_velocity(found.scene)
    assert common == approx(1.0 / (1.0 + beta), rel=1e-14)
    instant = compression_time(found.motion, common, found.duration)
    assert instant / T == approx(math.log1p(beta) / (2.0 * beta), rel=1e-10)  # (4.38)
    assert common_velocity_times(found.motion, found.contacts[0].end) == approx([instant], rel=1e-10)
    both = (1.0 - (1.0 + beta) * rest) / beta
    assert found.restitution["poisson"] == approx(both, rel=1e-9)  # (4.39)
    assert found.restitution["newton"] == approx(both, rel=1e-11)  # (4.40)
    assert found.restitution["newton_at_contact"] == approx(2.0 - rest, rel=1e-11)  # (4.46) prints 1


def test_fixed_rod_first_contact_alone():
    """Reference case of thesis 4.6: as if the mass were taken away after the first contact."""
    found = Waves().solve(struck_rod(1.0))
    end = found.contacts[0].end
    crossings = common_velocity_times(found.motion, end)
    # three, figure 4.19; the numbers are those of (4.28) = (4.29) corrected
    assert np.array(crossings) / T == approx([0.346574, 0.617236, 1.092166], abs=1e-6)
    instant = compression_time(found.motion, 0.0, end)
    assert instant / T == approx(1.033833820809153, rel=1e-10)  # (4.41): 1.034
    three = restitution(found.scene, found.motion, end, end)
    assert three["newton"] == approx(0.6876189398006519, rel=1e-11)  # (4.43)
    assert three["poisson"] == approx(0.6876189398006519, rel=1e-9)  # (4.42)
    assert three["newton_at_contact"] == approx(0.0, abs=1e-10)  # (4.47)


def test_fixed_rod_both_contacts():
    found = Waves().solve(struck_rod(1.0))
    assert found.restitution["newton"] == approx(0.6988755819961635, rel=1e-11)  # (4.37)
    assert found.restitution["poisson"] == approx(0.6988755819961635, rel=1e-9)
    assert found.restitution["newton_at_contact"] == approx(0.0, abs=1e-10)  # (4.47), after both


def test_other_methods_give_the_same_crossings():
    found = Modal(modes=200, estimate=False).solve(struck_rod(1.0, "free"))
    (instant,) = common_velocity_times(found.motion, found.contacts[0].end)
    assert instant / T == approx(0.34657359, abs=2e-3)


def test_no_crossing_is_an_empty_list():
    found = Waves().solve(struck_rod(1.0, "free"))
    assert common_velocity_times(found.motion, 0.3 * T) == []
    assert compression_time(found.motion, common_velocity(found.scene), 0.3 * T) is None


def test_surfaces_that_part_as_a_front_arrives_are_those_behind_it():
    """Two equal rods, the struck one with a step of section: as they part both faces stand still."""
    found = solvers.solve(solvers.load("stepped-rod"))
    assert found.restitution["newton_at_contact"] == approx(0.0, abs=1e-12)
    after = np.array([found.contacts[-1].end * (1.0 + 1e-9)])
    fields = found.motion.velocity(after, np.array([-1e-9, 1e-9]))[0]
    assert fields == approx([0.0, 0.0], abs=1e-9)
