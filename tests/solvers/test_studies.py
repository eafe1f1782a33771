"""Sweeps: every row is what a solve of its own says, and what is known of the blow at all mass ratios."""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import SceneError
from solvers.studies import PIECES, RATIO_RANGE, _blows, mass_ratio_sweep, spaced, sweep
from tests.catalog import ROD, SUPPORTS, T, struck_rod


@pytest.mark.parametrize("support", SUPPORTS)
def test_all_ratios_are_those_of_the_exact_method(support):
    found = mass_ratio_sweep(support)
    assert found.mass_ratio[[0, -1]] == approx([1e-3, 1e3])
    for i, ratio in enumerate(found.mass_ratio):
        solution = solvers.solve(struck_rod(ratio, support), "waves")
        assert found.contacts[i] == len(solution.contacts)
        periods = [(contact.start / T, contact.end / T) for contact in solution.contacts]
        assert found.periods[i, : len(periods)] == approx(np.array(periods), rel=1e-12)
        assert np.isnan(found.periods[i, len(periods) :]).all()
        assert found.rebound_velocity[i] == approx(solution.impactor_velocity, abs=1e-12)
        assert found.peak_stress[i] == approx(solution.peak_force / ROD.impedance, rel=1e-12)
        restitution = solution.restitution
        # rounding of the target's velocity (1 - v) / beta, of order 1e-16 / beta
        assert found.restitution[i] == approx(restitution["newton"], abs=1e-11)
        assert found.restitution_at_contact[i] == approx(restitution["newton_at_contact"], abs=1e-9)


def test_restitution_by_impulses_is_that_by_velocities():
    for support in SUPPORTS:
        found = mass_ratio_sweep(support, np.array([0.05, 0.5, 1.0, 3.0]))
        for ratio, value in zip(found.mass_ratio, found.restitution, strict=True):
            poisson = solvers.solve(struck_rod(ratio, support), "waves").restitution["poisson"]
            assert poisson == approx(value, abs=1e-10)  # the instant of common velocity is found to 400^-6


def test_a_free_rod_is_struck_once_by_the_closed_form():
    found = mass_ratio_sweep("free")
    assert (found.contacts == 1).all()
    assert found.periods[:, 0, 1] == approx(1.0, rel=1e-12)  # one round trip, (4.12)
    assert found.rebound_velocity == approx(np.exp(-2.0 * found.mass_ratio), abs=1e-14)  # (4.13)


def test_rebound_is_not_monotone_and_second_contacts_come_and_go():
    found = mass_ratio_sweep("fixed")
    turns = np.sum(np.diff(np.sign(np.diff(found.rebound_velocity))) != 0)
    assert turns > 10
    comings = np.sum(np.abs(np.diff(found.contacts)) == 1)
    assert comings > 20 and set(found.contacts) == {1, 2}


def test_mass_ratio_one_is_near_the_loss_of_its_second_contact():
    near = mass_ratio_sweep("fixed", np.array([0.99, 1.0, 1.005, 1.02]))
    assert near.contacts.tolist() == [2, 2, 2, 1]


@pytest.mark.parametrize("support", SUPPORTS)
def test_extreme_ratios(support):
    found = mass_ratio_sweep(support, np.array([1e-6, 1e6]))
    # a heavy mass runs on with the free rod and comes back from the fixed one, which it finds to be a spring
    assert found.rebound_velocity[0] == approx(1.0 if support == "free" else -1.0, abs=5e-3)
    # a light mass is stopped by the wave it sends; from a fixed end that comes back with pressure (2 - 2 x) exp(-x) and
    # throws it off, up to x = 1
    assert found.rebound_velocity[1] == approx(0.0 if support == "free" else -2.0 / np.e, rel=1e-9)


@pytest.mark.parametrize("reflection", [1.0, -1.0])
def test_every_blow_is_followed_to_its_end(reflection):
    ratios = np.geomspace(*RATIO_RANGE, 500)
    complete, count, _ = _blows(reflection, ratios, PIECES[-1])
    assert complete and count.max() <= 2


@pytest.mark.parametrize("ratios", [[], [0.0], [-1.0], [np.nan], [np.inf], [1e7], [[1.0]]])
def test_ratios_that_are_none_are_refused(ratios):
    with pytest.raises(SceneError, match="mass ratios from 1e-06 to 1e"):
        mass_ratio_sweep("fixed", np.array(ratios))


def test_an_unknown_support_is_refused():
    with pytest.raises(SceneError, match="support: got 'loose'"):
        mass_ratio_sweep("loose")


def test_spacing_follows_the_range():
    assert spaced(1.0, 99.0, 3) == approx([1.0, 50.0, 99.0])
    assert spaced(1.0, 100.0, 3) == approx([1.0, 10.0, 100.0])
    assert spaced(1.0, 4.0, 3, "log") == approx([1.0, 2.0, 4.0])
    assert spaced(-1.0, 1.0, 3) == approx([-1.0, 0.0, 1.0])


@pytest.mark.parametrize(
    "given", [(1.0, 1.0, 3), (2.0, 1.0, 3), (0.0, 1.0, 3, "log"), (1.0, 2.0, 1), (1.0, np.inf, 3), (1.0, 2.0, 3, "odd")]
)
def test_ranges_that_are_none_are_refused(given):
    with pytest.raises(SceneError):
        spaced(*given)


def test_rows_are_the_solves():
    scene = solvers.load("fixed-rod")
    rows = sweep(scene, "impactor.mass", [0.5, 1.0, 2.133])
    for row in rows:
        table = solvers.solve(scene.replace({"impactor.mass": row["value"]})).table()
        assert row["contacts"] == len(table["contacts"])
        for key in ("impulse", "peak_force", "impactor", "restitution"):
            assert row[key] == table[key]
        assert row["energy_error"] == table["diagnostics"]["energy_error"]


def test_keys_of_whole_numbers_get_each_of_them_once():
    scene = solvers.load("fixed-rod").replace({"method.name": "modal"})
    rows = sweep(scene, "method.modes", [5.0, 5.4, 6.2])
    assert [row["value"] for row in rows] == [5, 6]


@pytest.mark.parametrize(
    "key, values, said",
    [
        ("impactor.mass", [1.0, -1.0], "impactor.mass: got -1.0"),
        ("target.colour", [1.0], "target.colour: got 1"),
        ("method.tolerance", [1e-9, 1.0], "method.tolerance: got 1.0"),
        ("impactor.mass", [], "number of values: got 0"),
        ("impactor.mass", [1.0, np.nan], "impactor.mass: got nan"),
        ("method.steps", [100.0, np.inf], "method.steps: got inf"),
    ],
)
def test_the_value_that_cannot_be_solved_is_named(key, values, said):
    with pytest.raises(SceneError, match=said):
        sweep(solvers.load("fixed-rod"), key, values)
