"""Sweeps: every row is what a solve of its own says, and what is known of the impact at all mass ratios."""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import SceneError
from solvers.numerics.waves.rigid import Pieces
from solvers.solution.solution import Later
from solvers.studies.mass_ratios import MOST_CONTACTS, PIECES, RATIO_RANGE, TERMS, _impacts, mass_ratio_sweep
from solvers.studies.study.work import Work
from solvers.studies.sweep import spaced, sweep
from tests.catalog import ROD, SUPPORTS, T, struck_rod


@pytest.mark.slow
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
def test_every_impact_is_followed_to_its_end(reflection):
    ratios = np.geomspace(*RATIO_RANGE, 500)
    count, contacts = np.zeros(500, np.int64), np.full((500, MOST_CONTACTS, 7), np.nan)
    assert _impacts(reflection, ratios, Pieces.of(PIECES[-1], TERMS, MOST_CONTACTS), count, contacts)
    assert count.min() >= 1 and count.max() <= 2


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


@pytest.mark.slow
def test_rows_are_the_solves():
    scene = solvers.load("fixed-rod")
    rows = sweep(scene, "impactor.mass", [0.5, 1.0, 2.133])
    for row in rows:
        table = solvers.solve(scene.replace({"impactor.mass": row["value"]})).table()
        assert row["contacts"] == len(table["contacts"])
        for key in ("impulse", "peak_force"):
            assert row[key] == approx(table[key], rel=1e-14)
        assert row["contact_time"] == approx(table["contact_time"], rel=1e-13)
        assert row["impactor"]["final_velocity"] == approx(table["impactor"]["final_velocity"], abs=1e-15)
        assert row["restitution"] == approx(table["restitution"], abs=1e-13)
        assert row["energy_error"] == approx(table["diagnostics"]["energy_error"], abs=1e-13)


# --- very many at once ------------------------------------------------------------------------------------------------


def checked_against_single_solves(found, scenes):
    for i, scene in enumerate(scenes):
        table = solvers.solve(scene).table()
        assert found.contacts[i] == len(table["contacts"])
        assert found.impulse[i] == approx(table["impulse"], rel=1e-13)
        assert found.peak_force[i] == approx(table["peak_force"], rel=1e-13)
        assert found.contact_time[i] == approx(table["contact_time"], rel=1e-12)
        assert found.duration[i] == approx(table["duration"], rel=1e-12)
        assert found.dissipated[i] == approx(table["energy"]["dissipated"], abs=1e-12)
        for name in ("peak_indentation", "residual_indentation"):
            got = getattr(found, name)[i]
            assert np.isnan(got) if table[name] is None else got == approx(table[name], rel=1e-13)
        assert found.impactor_velocity[i] == approx(table["impactor"]["final_velocity"], abs=1e-13)
        assert found.target_velocity[i] == approx(table["target"]["final_velocity"], abs=1e-13)
        for name, value in table["restitution"].items():
            got = getattr(found, name)[i]
            assert np.isnan(got) if value is None else got == approx(value, abs=1e-12)
        assert abs(found.energy_error[i] - table["diagnostics"]["energy_error"]) < 1e-12
        assert found.estimated_error[i] == approx(table["diagnostics"]["estimated_error"], abs=1e-12)


def test_many_scenes_are_the_single_solves():
    base = solvers.load("fixed-rod")
    scenes = [
        base.replace({"target.support": support, "target.length": 0.1 * length, "impactor.mass": mass})
        for support in ("fixed", "free")
        for length in (1.0, 4.0)
        for mass in (0.003, 0.2, 1.0, 2.133, 7.0, 400.0)
    ]
    checked_against_single_solves(solvers.solve_many(scenes), scenes)


def test_columns_are_the_single_solves():
    base, rng = solvers.load("fixed-rod"), np.random.default_rng(5)
    columns = {
        "impactor.mass": 2.0 / 10 ** rng.uniform(-2, 2, 40),
        "impactor.velocity": rng.uniform(0.1, 9.0, 40),
        "target.length": rng.uniform(0.05, 3.0, 40),
    }
    rows = [base.replace({key: float(values[i]) for key, values in columns.items()}) for i in range(40)]
    checked_against_single_solves(solvers.solve_many(base, columns, workers=2), rows)


def test_scenes_that_are_not_the_simple_one_are_solved_one_by_one():
    base = solvers.load("fixed-rod").replace({"contact": {"law": "hertz", "stiffness": 1e10}})
    found = solvers.solve_many(base, {"impactor.mass": [1.0, 2.0]})
    checked_against_single_solves(found, [base.replace({"impactor.mass": mass}) for mass in (1.0, 2.0)])
    modal = solvers.solve_many(solvers.load("fixed-rod"), {"impactor.mass": [1.0, 2.0]}, method="modal")
    assert modal.estimated_error.min() > 1e-6


def test_what_is_asked_for_alone_is_worked_out(monkeypatch):
    """Reading one figure of each once cost 1.5 to 2.4 times a loop that does, as all were worked out."""
    base, columns = solvers.load("fixed-rod"), {"impactor.mass": [1.0, 2.0]}
    assert solvers.solve_many(base, columns, figures=["impulse"]).impulse.tolist() == (
        solvers.solve_many(base, columns).impulse.tolist()
    )
    monkeypatch.setattr(solvers.Modal, "_figures", lambda *_: pytest.fail("worked out"))
    found = solvers.solve_many(base, columns, method="modal", figures=["peak_force", "contact_time"])
    assert list(found.columns) == ["contact_time", "peak_force"] and (found.contact_time > 0.0).all()
    assert repr(found) == "<Figures of 2 scenes: impactor.mass, contact_time, peak_force>"
    with pytest.raises(SceneError, match="figures: got 'impulse'; allowed: one of those that were asked for"):
        found.impulse  # noqa: B018
    for wrong in (["depth"], "impulse", []):
        with pytest.raises(SceneError, match="figures: got"):
            solvers.solve_many(base, columns, figures=wrong)


def test_many_as_arrays_with_names_and_as_a_plot():
    found = solvers.solve_many(solvers.load("fixed-rod"), {"impactor.mass": [1.0, 2.0, 4.0]})
    data = found.dataset()
    assert data.impulse.units == "N s" and data["impactor.mass"].values.tolist() == [1.0, 2.0, 4.0]
    assert data.impulse.values.tolist() == found.impulse.tolist() and len(found) == 3
    assert found.plot("impulse")["impulse"].tolist() == found.impulse.tolist()
    with pytest.raises(SceneError, match="what: got 'depth'"):
        found.plot("depth")


def test_an_impact_too_long_for_all_the_others_is_solved_alone():
    base, mass = solvers.load("fixed-rod"), 2.133 * 9e5
    found = solvers.solve_many(base, {"impactor.mass": [1.0, mass]})
    checked_against_single_solves(found, [base.replace({"impactor.mass": each}) for each in (1.0, mass)])


@pytest.mark.parametrize(
    "columns, said",
    [
        ({"impactor.mass": [1.0, -1.0, 2.0]}, "impactor.mass: got -1.0"),
        ({"impactor.mass": [1.0, np.nan, 2.0]}, "impactor.mass: got nan"),
        ({"impactor.mass": [1.0, 1e12]}, "impactor.mass: got 1000000000000.0"),  # with this rod beyond all mass ratios
        ({"impactor.mass": [1.0, 2.0], "target.length": [1.0]}, "target.length: got '1 values'"),
        ({"target.colour": [1.0]}, "target.colour"),
        ({"impactor.mass": [[1.0]]}, "impactor.mass: got 'an array of shape"),
        ({"impactor.mass": ["heavy"]}, r"impactor.mass: got \['heavy'\]; allowed: a list of 1 to 1000000 numbers"),
        ({"impactor.mass": [[1.0, 2.0], [1.0]]}, "impactor.mass: got"),
        ({}, "columns: got 'nothing'"),
        (None, "columns: got 'nothing'"),
    ],
)
def test_columns_that_cannot_be_are_refused(columns, said):
    with pytest.raises(SceneError, match=said):
        solvers.solve_many(solvers.load("fixed-rod"), columns)


def test_lists_that_cannot_be_are_refused():
    with pytest.raises(SceneError, match="number of scenes"):
        solvers.solve_many([])
    with pytest.raises(SceneError, match="columns"):
        solvers.solve_many([solvers.load("fixed-rod")], {"impactor.mass": [1.0]})


def test_figures_are_worked_out_when_they_are_read_and_once():
    solution = solvers.solve(solvers.load("fixed-rod"))
    assert isinstance(vars(solution)["_energy"], Later) and isinstance(vars(solution)["_notes"], Later)
    assert solution.energy is solution.energy and solution.notes is solution.notes


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
        ("impactor.mass", ["heavy"], "impactor.mass: got"),
        ("impactor.mass", [[1.0]], "impactor.mass: got"),
        ("method.tolerance", [1e-9] * 2001, "number of values: got 2001"),
    ],
)
def test_the_value_that_cannot_be_solved_is_named(key, values, said):
    with pytest.raises(SceneError, match=said):
        sweep(solvers.load("fixed-rod"), key, values)


def test_what_bodies_hold_at_the_end_is_a_figure_where_it_is_asked_for():
    """A piston with the impedance of the rod hands all on; others, as waves are sent back and on at the step."""
    found = solvers.solve_many(
        "split-hopkinson", {"impactor.velocity": [1.0, 2.0]}, figures=["impactor_energy", "target_energy"]
    )
    scene = solvers.load("split-hopkinson").replace({"impactor.velocity": 2.0})
    energy = solvers.solve(scene).energy
    assert found.impactor_energy[1] == approx(energy["impactor"], rel=1e-12)
    assert found.target_energy[1] == approx(energy["target_rigid"] + energy["target_vibration"], rel=1e-12)
    assert found.target_energy[1] == approx(4.0 * found.target_energy[0], rel=1e-9)
    quick = solvers.solve_many("fixed-rod", {"impactor.mass": [1.0, 2.0]}, figures=["impactor_energy", "target_energy"])
    held = 0.5 * np.array([1.0, 2.0]) * solvers.load("fixed-rod").impactor.velocity ** 2
    assert quick.impactor_energy + quick.target_energy == approx(held, rel=1e-12)


@pytest.mark.parametrize("values", [[np.nan], [np.nan, np.nan], [np.inf, np.nan]])
def test_columns_without_any_number_are_refused(values):
    """`nanargmin` of nothing but NaN once raised a ValueError of its own."""
    with pytest.raises(SceneError, match=r"impactor\.mass: got (nan|inf)"):
        solvers.solve_many("fixed-rod", {"impactor.mass": values})


def test_a_sweep_of_very_many_is_that_of_columns():
    """Both are of the same room, and neither looks at a scene twice."""
    values, base = np.geomspace(0.01, 100.0, 3_000), solvers.load("fixed-rod")
    found, rows = solvers.solve_many(base, {"impactor.mass": values}), sweep(base, "impactor.mass", values)
    assert [row["contacts"] for row in rows] == found.contacts.tolist()
    assert [row["impactor"]["final_velocity"] for row in rows] == found.impactor_velocity.tolist()
    assert {row["peak_indentation"] for row in rows} == {None}
    work = Work(base, ("impactor.mass",), ("impulse",), None, notes=False)
    assert work([(value,) for value in values.tolist()]).figures[:, 0].tolist() == found.impulse.tolist()


def test_what_has_not_begun_is_left_out_of_a_cancelled_sweep_but_not_its_first_value():
    scene = solvers.load("fixed-rod").replace({"contact": {"law": "hertz", "stiffness": 1e10}})
    assert [row["value"] for row in sweep(scene, "impactor.mass", [1.0, 2.0, 3.0], cancel=lambda: True)] == [1.0]
    asked = iter([False, True])
    rows = sweep(scene, "impactor.mass", [1.0, 2.0, 3.0], workers=1, cancel=lambda: next(asked))
    assert [row["value"] for row in rows] == [1.0, 2.0]


def test_bodies_in_space_are_swept_with_velocities_of_three_components():
    rows = sweep("brick-off-centre", "impactor.mass", [0.9, 1.1])
    solution = solvers.solve(solvers.load("brick-off-centre").replace({"impactor.mass": 1.1}))
    assert rows[1]["impactor"]["final_velocity"] == list(solution.impactor_velocity)
    assert rows[1]["restitution"] == solution.restitution
