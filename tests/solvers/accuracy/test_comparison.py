"""Every method against the exact waves: rows for all, errors that are right, refusals that say why."""

import math

import pytest
from pytest import approx

import solvers
from solvers import METHODS, ContactPeriod, Modal, SceneNotSupported, Waves, compare
from solvers.accuracy.comparison import chosen_methods, force_error, overlapping
from tests.catalog import T, bronze_rod, struck_rod

MASS_RATIOS = (0.8, 1.0)  # where thesis 4.5 has two contacts, the second one short


def period(start: float, end: float) -> ContactPeriod:
    return ContactPeriod(start, end, 1.0, 1.0)


@pytest.mark.slow
def test_every_method_has_a_row():
    scene = struck_rod(0.8)
    rows = compare(scene, repeats=1)
    assert {row.method["name"] for row in rows} == set(METHODS)
    for row in rows:
        refused = METHODS[row.method["name"]].read({}).refusal(scene)
        if row.reason is None:
            assert refused is None
            assert math.isfinite(row.rebound_error) and row.wall_time > 0.0
            assert 0 <= row.true_contacts_found <= row.true_contacts == 2
            assert row.second_contact_found == (row.true_contacts_found == 2)
        else:
            assert row.rebound_error is row.contacts is row.wall_time is None


@pytest.mark.parametrize("mass_ratio", MASS_RATIOS)
def test_the_shipped_default_finds_both_contacts_and_nothing_else(mass_ratio):
    scene = struck_rod(mass_ratio)
    default = solvers.solve(scene)
    (row,) = compare(scene, [default.method["name"]], repeats=1)
    assert row.label == "waves"
    assert (row.contacts, row.true_contacts_found, row.raw_contacts) == (2, 2, 2)
    assert row.second_contact_found is True
    assert row.rebound_error == row.duration_error == row.force_error == 0.0  # the exact solution against itself


@pytest.mark.parametrize("mass_ratio", MASS_RATIOS)
def test_fifty_modes_find_both_contacts_under_their_chatter(mass_ratio):
    (row,) = compare(struck_rod(mass_ratio), ["modal"], repeats=1)
    assert (row.contacts, row.true_contacts_found) == (2, 2)
    assert row.raw_contacts > row.contacts  # the raw force of a truncated model makes and breaks contact
    assert row.resolved_force_error < row.force_error


def test_errors_are_found_minus_exact_in_units_of_the_impact():
    scene = struck_rod(2.0, speed=3.0)
    (row,) = compare(scene, [Modal(modes=10)], repeats=1)
    exact, found = solvers.solve(scene, "waves"), solvers.solve(scene, "modal", modes=10)
    assert row.rebound_error == approx((found.impactor_velocity - exact.impactor_velocity) / 3.0, rel=1e-12)
    unit = scene.target.round_trip_time
    assert row.duration_error == approx((found.contacts[0].end - exact.contacts[0].end) / unit, rel=1e-12)
    assert row.second_contact_found is None  # thesis figure 4.19: one contact at mass ratio 2


def test_an_error_of_the_force_is_relative():
    scene = struck_rod(1.0)
    exact = solvers.solve(scene)
    until = exact.contacts[-1].end
    assert force_error(exact, until, lambda time: 0.0 * time) == 1.0
    # a tenth too much everywhere is a tenth in any norm; rounding
    assert force_error(exact, until, lambda time: 1.1 * exact.motion.force(time)) == approx(0.1, rel=1e-12)


def test_finer_steps_come_nearer():
    rows = compare(struck_rod(1.0), [Waves(steps=steps) for steps in (100, 1000)], repeats=1)
    # at least first order, and ten times as fine
    assert abs(rows[1].rebound_error) < 0.1 * abs(rows[0].rebound_error)
    assert rows[1].force_error < rows[0].force_error
    assert [row.label for row in rows] == ["waves steps=100", "waves steps=1000"]


@pytest.mark.parametrize(
    "true, found, seen",
    [
        ([(0, 2), (3, 4)], [(0, 1.9), (3.5, 3.6)], [True, True]),
        ([(0, 2), (3, 4)], [(0, 5)], [True, False]),  # one long contact is not two
        ([(0, 2), (3, 4)], [(0, 2), (2.1, 2.9)], [True, False]),
        ([(0, 2), (3, 4)], [(0, 1), (1.5, 2), (3.9, 4.5)], [True, True]),  # a spare one does not stand for another
        ([(0, 2)], [(0, 0)], [True]),  # an impact of no duration
        ([(0, 2), (3, 4)], [], [False, False]),
    ],
)
def test_which_true_contacts_are_found(true, found, seen):
    assert overlapping([period(*pair) for pair in true], [period(*pair) for pair in found]) == seen


def test_a_method_that_cannot_says_why():
    scene = bronze_rod()
    (row,) = compare(scene, [Waves(steps=500)], repeats=1)
    assert row.reason == Waves(steps=500).refusal(scene)
    assert row.rebound_error is row.force_error is row.contacts is row.wall_time is None
    assert row.table()["method"] == {"name": "waves", "steps": 500, "tolerance": 1e-9}


def test_the_resolution_that_the_scene_gives_is_used():
    scene = struck_rod(1.0).replace({"method": {"name": "modal", "modes": 7}})
    chosen = chosen_methods(scene)
    assert [method.modes for method in chosen if method.NAME == "modal"] == [7]
    assert {method.NAME for method in chosen} == set(METHODS)


def test_without_an_exact_solution_there_is_nothing_to_compare_with():
    with pytest.raises(SceneNotSupported):
        compare(solvers.load("note-rod"))


def test_an_impact_of_no_duration_has_no_force():
    (row,) = compare(struck_rod(1.0), ["rigid"], repeats=1)
    # a rigid wall of restitution 1 sends the mass back as it came; thesis (4.37): exactly 0.69888 of it
    assert row.rebound_error == approx(-1.0 + 0.6988755819961635, abs=1e-12)
    assert row.force_error is None and row.resolved_force_error is None
    assert row.duration_error == approx(-1.784980427257793e-4 / T, rel=1e-12)  # (4.31), seconds


def test_where_the_true_force_is_an_impulse_without_duration_there_is_no_error_of_a_force():
    rows = compare(solvers.load("compound-pendulum"), repeats=1)
    assert any(row.reason is None for row in rows) and all(row.force_error is None for row in rows)
