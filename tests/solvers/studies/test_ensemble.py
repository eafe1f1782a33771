"""Ensembles: every run is what a solve of its own says, known sensitivities, verdicts on jumps and on drift."""

import math
from dataclasses import replace

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Modal, SceneError, ensemble
from solvers.studies.ensemble import perturbations
from solvers.studies.sensitivity import FIGURES, FIRM, LOOSE, spread_table, summary
from tests.catalog import bronze_rod, contact_table, struck_beam, struck_rod

LAWS = ("rigid", "hertz", "linear", "hunt-crossley", "lankarani-nikravesh", "plastic-power")


def own_solves(scene, found, method) -> list:
    """Each run solved alone, over the duration and steps of the unperturbed one."""
    base = solvers.solve(scene, method)
    fixed = replace(method, steps=base.motion.steps) if isinstance(method, Modal) else method
    masses = [scene.impactor.mass * (1.0 + change) for change in found.perturbations.tolist()]
    return [fixed.solve(scene.replace({"impactor.mass": mass}), base.duration) for mass in masses]


def assert_same_figures(found, solutions):
    assert found.contacts.tolist() == [len(solution.contacts) for solution in solutions]
    for name, values in {
        "first_parting": [s.contacts[0].end for s in solutions],
        "last_parting": [s.contacts[-1].end for s in solutions],
        "contact_time": [sum(c.end - c.start for c in s.contacts) for s in solutions],
        "final_velocity": [s.impactor_velocity for s in solutions],
        "impulse": [s.impulse for s in solutions],
        "peak_force": [s.peak_force for s in solutions],
        "peak_indentation": [s.peak_indentation for s in solutions],
        "residual_indentation": [s.residual_indentation for s in solutions],
        "dissipated": [s.energy["dissipated"] for s in solutions],
    }.items():
        values = np.array([math.nan if value is None else value for value in values])
        # rounding, as checkpoints are farther apart
        assert getattr(found, name) == approx(values, rel=1e-9, abs=1e-12, nan_ok=True), name


@pytest.mark.parametrize("law", LAWS)
def test_runs_of_the_bare_kernel_are_those_of_whole_solves(law):
    scene, method = struck_rod(0.3, contact=contact_table(law)), Modal(modes=20, estimate=False)
    found = ensemble(scene, method, runs=10)
    solutions = own_solves(scene, found, method)
    assert_same_figures(found, solutions)
    for i, solution in enumerate(solutions):
        positions = solution.motion.end_position(found.time)
        assert (found.struck_position.lowest <= positions + 1e-12).all(), i
        assert (found.struck_position.highest >= positions - 1e-12).all(), i
        velocities = solution.motion.impactor_velocity(found.time)
        assert (found.impactor_velocity.lowest <= velocities + 1e-9).all(), i
        assert (found.impactor_velocity.highest >= velocities - 1e-9).all(), i


@pytest.mark.slow
@pytest.mark.parametrize("name", ["waves", "mode-switch"])
def test_runs_by_other_methods(name):
    scene, method = struck_rod(0.3), solvers.METHODS[name].read({})
    found = ensemble(scene, name, runs=10)
    assert found.method == method.table()
    assert_same_figures(found, own_solves(scene, found, method))


def test_a_changed_target_and_a_changed_law_are_followed():
    scene = bronze_rod()
    for key, value in (("target.length", scene.target.length), ("contact.stiffness", scene.contact.stiffness)):
        found = ensemble(scene, Modal(modes=20), runs=10, key=key)
        changed = scene.replace({key: value * (1.0 + float(found.perturbations[0]))})
        base = Modal(modes=20).solve(scene)
        own = Modal(modes=20).solve(changed, base.duration)
        assert found.final_velocity[0] == approx(own.impactor_velocity, abs=1e-6)  # another step within the duration


def test_sensitivities_of_a_free_rod_are_known():
    found = ensemble(struck_rod(1.0, "free"), "waves", runs=20)
    rows = {row.quantity: row for row in found.spread}
    # v = exp(-2 m2/m1), (4.13), and I = m1 (1 - v): the mass enters through m2/m1 only
    velocity = math.exp(-2.0)
    assert rows["final_velocity"].sensitivity == approx(2.0 * velocity, rel=1e-3)
    assert rows["impulse"].sensitivity == approx(1.0 - 2.0 * velocity / (1.0 - velocity), rel=1e-3)
    assert rows["first_parting"].half_range == approx(0.0, abs=1e-12)  # one round trip, for every mass
    assert {row.verdict for row in found.spread} == {"firm"}
    assert not found.ill_conditioned and str(found.summary).startswith("Well conditioned")
    assert rows["final_velocity"].half_range == approx(velocity * np.ptp(found.perturbations), rel=0.02)


def test_where_a_contact_comes_and_goes_its_figures_are_not_trusted():
    """At m2/m1 = 1.0107 the second contact of the fixed rod is lost, with no impulse in it."""
    found = ensemble(struck_rod(1.0107), runs=60)
    rows = {row.quantity: row for row in found.spread}
    assert set(found.contacts) == {1.0, 2.0}
    assert rows["contacts"].verdict == rows["last_parting"].verdict == "not to be trusted"
    assert rows["final_velocity"].verdict == rows["impulse"].verdict == rows["peak_force"].verdict == "firm"
    assert found.ill_conditioned and found.summary.code == "marginal-contact"
    assert str(found.summary).startswith("One contact is marginal")


def test_where_several_contacts_come_and_go_not_one_alone_is_said_to():
    changes = np.array([-1e-3, 1e-5, 1e-3])
    figures = {"final_velocity": np.full(3, 0.5), "contacts": np.array([13.0, 14.0, 16.0])}
    table = spread_table({"final_velocity": 0.5, "contacts": 15.0}, figures, changes, {"final_velocity": 1.0})
    said = str(summary(struck_rod(1.0), "impactor.mass", 1e-3, table, True))
    assert said.startswith("Some contacts are marginal") and "13 to 16 contacts" in said


def test_bands_are_ordered_and_keep_the_impulse():
    found = ensemble(bronze_rod(), Modal(modes=20), runs=40)
    for band in (found.force, found.struck_position, found.impactor_velocity):
        rows = np.array([band.lowest, band.low, band.median, band.high, band.highest])
        assert rows.shape == (5, found.time.size)
        assert (np.diff(rows, axis=0) >= 0.0).all()
    assert found.force.lowest.min() >= 0.0
    middles = np.concatenate((found.time[:1], 0.5 * (found.time[1:] + found.time[:-1]), found.time[-1:]))
    median_impulse = float(np.sum(found.force.median * np.diff(middles)))
    assert median_impulse == approx(float(np.median(found.impulse)), rel=1e-3)  # means of the intervals, not samples


def test_perturbations():
    found = perturbations(200, 1e-2, seed=3)
    sizes = np.abs(found)
    assert (np.diff(found) > 0.0).all() and (found > 0.0).sum() == 100
    assert 1e-6 < sizes.min() < 1.1e-6 and 0.95e-2 < sizes.max() <= 1e-2
    assert np.histogram(np.log10(sizes), bins=4, range=(-6.0, -2.0))[0] == approx(50, abs=0)
    assert (found == perturbations(200, 1e-2, seed=3)).all() and (found != perturbations(200, 1e-2, seed=4)).any()


def rows_of(response, changes):
    """Verdict on a figure of size one that answers the changes like this."""
    values = {"impulse": 1.0 + response(changes)}
    (row,) = spread_table({"impulse": 1.0}, values, changes, {})
    return row


def test_verdicts_distinguish_jumps_from_drift():
    changes = perturbations(200, 1e-2)
    drift = rows_of(lambda change: -3.0 * change, changes)
    assert drift.verdict == "firm" and drift.sensitivity == approx(-3.0) and drift.amplification < 3.0
    jump = rows_of(lambda change: 0.2 * (change > 1e-4), changes)
    assert jump.verdict == "not to be trusted" and jump.half_range == approx(0.1) and jump.amplification > 100.0
    small_jump = rows_of(lambda change: 0.05 * (change > 1e-4), changes)
    assert small_jump.verdict == "loose" and small_jump.half_range < LOOSE
    late_jump = rows_of(lambda change: 0.2 * (change > 2e-3), changes)
    assert late_jump.verdict == "loose" and late_jump.amplification > FIRM
    assert rows_of(lambda change: 1e-5 * np.sign(change), changes).verdict == "firm"  # the method's own steps


def test_the_table_is_plain_and_complete():
    found = ensemble(bronze_rod(), Modal(modes=10), runs=10)
    table = found.table()
    assert set(FIGURES) <= set(table)
    assert table["peak_indentation"] == found.peak_indentation.tolist()
    rigid = ensemble(struck_rod(), runs=10).table()
    assert rigid["peak_indentation"] == [None] * 10
    assert "peak_indentation" not in {row["quantity"] for row in rigid["spread"]}


def test_finite_elements_leave_the_runs_to_modes_unless_asked():
    scene = struck_rod(contact=contact_table("hertz")).replace({"method": {"name": "fe-nodal", "elements": 10}})
    found = ensemble(scene, runs=10)
    assert found.method["name"] == "modal" and "fe-nodal" in str(found.notes[0])
    assert ensemble(scene, "fe-nodal", runs=10).method["elements"] == 10


def test_an_impactor_that_can_bend_is_changed_in_length():
    found = ensemble(solvers.load("two-unequal-rods"), runs=10)
    assert found.key == "impactor.length" and not found.ill_conditioned


def test_progress_is_reported():
    reported = []
    ensemble(struck_rod(), runs=12, progress=lambda done, runs: reported.append((done, runs)))
    assert reported == [(done, 12) for done in range(1, 13)]


@pytest.mark.parametrize(
    ("given", "key"),
    [
        ({"runs": 9}, "runs"),
        ({"runs": 200.0}, "runs"),
        ({"spread": 0.0}, "spread"),
        ({"spread": math.nan}, "spread"),
        ({"seed": -1}, "seed"),
        ({"key": "target.support"}, "key"),
        ({"key": "impactor.nothing"}, "key"),
        ({"key": "contact"}, "key"),
        ({"method": "no-such-method"}, "method.name"),
    ],
)
def test_bad_input_is_refused(given, key):
    with pytest.raises(SceneError) as refused:
        ensemble(struck_rod(), **given)
    assert refused.value.key == key


def test_what_it_cannot_know_is_refused():
    for name in ("brick-off-centre", "pressure-bar"):
        with pytest.raises(SceneError, match="two bodies that meet on an axis"):
            ensemble(solvers.load(name))
    with pytest.raises(SceneError, match="mass"):  # of a rod there is none to change
        ensemble(solvers.load("two-unequal-rods"), key="impactor.mass")


def test_a_stiff_impact_on_a_beam_is_ill_conditioned():
    """Thesis 8.3 with 15 modes: the first parting is known to a hair, the sequence that follows is not."""
    stiff = struck_beam(contact={"law": "linear", "stiffness": 1.771875e10})
    found = ensemble(stiff, Modal(modes=15), runs=60)
    rows = {row.quantity: row for row in found.spread}
    assert rows["first_parting"].verdict == "firm"
    assert rows["contacts"].verdict == rows["final_velocity"].verdict == "not to be trusted"
    assert rows["final_velocity"].amplification > 1e3  # 1e-6 in mass matters
    assert found.ill_conditioned and str(found.summary).startswith("Ill-conditioned")
    assert np.ptp(found.force.highest - found.force.lowest) > 0.5 * found.force.highest.max()


def test_a_plastic_impact_on_a_beam_is_well_conditioned():
    scene, method = solvers.load("table-8.4"), Modal(modes=5, steps=8000, estimate=False)
    found = ensemble(scene, method, runs=10)
    rows = {row.quantity: row for row in found.spread}
    for name in ("final_velocity", "impulse", "dissipated", "residual_indentation"):
        assert rows[name].verdict == "firm" and abs(rows[name].sensitivity) < 2.5
    assert not found.ill_conditioned
    assert_same_figures(found, own_solves(scene, found, method))


def test_damping_of_the_beam_counts_as_lost():
    scene = solvers.load("xylophone-bar")
    found = ensemble(scene, runs=10)
    method = Modal(modes=scene.method["modes"], estimate=False)
    assert_same_figures(found, own_solves(scene, found, method))
    assert found.dissipated.min() > 0.0
