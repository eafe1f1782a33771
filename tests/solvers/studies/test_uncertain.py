"""Spreads and indices of variance, against a mass on a spring: its peak force is v sqrt(k m)."""

import json
import math
import warnings
from xml.etree import ElementTree

import numpy as np
import pytest
from pytest import approx
from scipy import stats

import solvers
from solvers import SceneError, uncertain
from solvers.studies.study.design import PAIRED, paired_design
from solvers.studies.study.work import Work
from solvers.studies.uncertain import indices

SPRING = solvers.Scene.from_table(
    {
        "title": "A mass on a spring",
        "impactor": {"kind": "mass", "mass": 2.0, "velocity": 1.0},
        "target": {"kind": "stop"},
        "contact": {"law": "linear", "stiffness": 1e6},
    }
)
SMALL = {
    "impactor.velocity": "lognormal(1, 0.02)",
    "contact.stiffness": "lognormal(1e6, 0.02)",
    "impactor.mass": "lognormal(2, 0.02)",
}
FIGURES = ("peak_force", "impulse", "contacts")


@pytest.fixture(scope="module")
def small():
    return uncertain(SPRING, SMALL, FIGURES, 256, workers=2)


def test_bars_have_the_total_indices_with_their_intervals(small, tmp_path):
    out = tmp_path / "own.svg"
    bars, within = small.plot("impulse", out)
    outcome = small.figures["impulse"]
    assert list(bars["input"]) == outcome.ranking[::-1]
    assert list(bars["total"]) == [outcome.shares[key].total for key in outcome.ranking[::-1]]
    for key, total, below, above in zip(*map(within.dimension_values, range(4)), strict=True):
        low, high = outcome.shares[key].total_within
        assert (total - below, total + above) == approx((low, high))
    assert "total index of Sobol" in out.read_text("utf-8")
    assert list(next(iter(small.plot()))["input"]) == small.figures["peak_force"].ranking[::-1]
    for figure, said in (("heat", "figure: got 'heat'"), ("contacts", "allowed: a figure with indices")):
        with pytest.raises(SceneError, match=said):
            small.plot(figure)


def test_a_product_of_powers_owes_each_factor_its_square(small):
    peak = small.figures["peak_force"]
    assert peak.mean == approx(math.sqrt(2e6), rel=1e-3)
    assert peak.deviation / peak.mean == approx(0.02 * math.sqrt(1.5), rel=0.02)
    assert peak.quantiles[50] == approx(math.sqrt(2e6), rel=1e-3)
    spread = 0.02 * math.sqrt(1.5) * stats.norm.ppf(0.95)
    assert peak.quantiles[95] == approx(math.sqrt(2e6) * math.exp(spread), rel=2e-3)
    assert list(peak.quantiles.values()) == sorted(peak.quantiles.values())
    assert peak.lowest < peak.quantiles[5] and peak.quantiles[95] < peak.highest
    for key, power in (("impactor.velocity", 1.0), ("contact.stiffness", 0.5), ("impactor.mass", 0.5)):
        share = peak.shares[key]
        assert share.total == approx(power**2 / 1.5, rel=0.08) == share.first
        assert share.total_within[0] < power**2 / 1.5 < share.total_within[1]
        assert share.first_within[0] < power**2 / 1.5 < share.first_within[1]
        assert share.elasticity == approx(power, rel=5e-3)
    assert peak.ranking[0] == "impactor.velocity" and set(peak.ranking) == set(SMALL)
    assert sum(share.first for share in peak.shares.values()) == approx(1.0, abs=0.03)  # nearly a sum


def test_what_has_no_effect_has_no_index(small):
    impulse = small.figures["impulse"].shares  # 2 m v, whatever the stiffness
    assert impulse["contact.stiffness"].total == approx(0.0, abs=1e-9)
    low, high = impulse["contact.stiffness"].first_within
    assert low - 1e-9 <= 0.0 <= high + 1e-9
    assert impulse["impactor.mass"].total == approx(0.5, rel=0.1)


def test_a_figure_that_does_not_vary_has_no_indices():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = uncertain(SPRING, {"impactor.mass": "5%"}, ["contacts", "residual_indentation"], 8, workers=1)
        same = found.figures["contacts"]
        assert (same.mean, same.deviation, same.shares, same.ranking) == (1.0, 0.0, None, [])
        assert "contacts: no indices" in str(found)
        json.dumps(found.table(), allow_nan=False)


def test_numbers_of_contacts_are_whole():
    found = uncertain("fixed-rod", {"impactor.mass": "30%", "impactor.velocity": "5%"}, ["contacts"], 32, workers=1)
    counts = found.figures["contacts"]
    assert counts.deviation > 0.0
    assert all(each == round(each) for each in counts.quantiles.values())


def test_whole_inputs_that_are_drawn_the_same_are_no_warning():
    hammer = "docs/hammer.toml"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = uncertain(hammer, {"method.modes": "1%", "impactor.mass": "5%"}, ["peak_force"], 8, workers=1)
    assert found.figures["peak_force"].shares["method.modes"].total == 0.0


def test_one_input_makes_all_of_it():
    (share,) = (
        uncertain(SPRING, {"impactor.mass": "5%"}, ["peak_force"], 64, workers=1).figures["peak_force"].shares.values()
    )
    assert share.total == approx(1.0, rel=0.1) and share.elasticity == approx(0.5, rel=1e-2)


def test_indices_are_those_of_scipy():
    values = np.random.default_rng(1).normal(size=(5, 64)).cumsum(0)
    theirs = stats.sobol_indices(func={"f_A": values[:1], "f_B": values[1:2], "f_AB": values[2:, None]}, n=64)
    np.testing.assert_allclose(indices(values), [theirs.first_order, theirs.total_order], rtol=1e-12)


def test_the_design_is_a_b_and_those_between():
    design = paired_design(SPRING, {"impactor.mass": "5%", "impactor.velocity,contact.stiffness": "1,2"}, 9, 3)
    assert (design.size, design.sample) == (16 * 4, PAIRED)
    first, second, mass, rest = np.array(design.rows(0, 64), float).reshape(4, 16, 3)
    assert not np.isin(first[:, 0], second[:, 0]).any()
    np.testing.assert_array_equal(mass, np.column_stack([second[:, 0], first[:, 1:]]))
    np.testing.assert_array_equal(rest, np.column_stack([first[:, 0], second[:, 1:]]))
    assert np.array_equal(first[:, 1], first[:, 2]) and design.rows(20, 30) == design.rows(0, 64)[20:30]


def test_the_same_seed_gives_the_same_with_any_number_of_workers(small):
    tables = [each.table() for each in (small, uncertain(SPRING, SMALL, FIGURES, 256, workers=1))]
    for table in tables:
        del table["wall_time"]
    assert tables[0] == tables[1]
    other = uncertain(SPRING, SMALL, ["peak_force"], 256, seed=1, workers=2)
    assert other.figures["peak_force"].mean != small.figures["peak_force"].mean


def test_all_points_are_there_as_a_dataset(small):
    assert small.dataset.sizes == {"point": 256 * 5} and small.solves == 1280
    points = small.dataset
    force = points["impactor.velocity"] * np.sqrt(points["contact.stiffness"] * points["impactor.mass"])
    np.testing.assert_allclose(points.peak_force, force, rtol=1e-9)
    assert json.loads(points.attrs["design"])["sample"] == PAIRED
    assert small.figures["peak_force"].mean == approx(float(points.peak_force[:512].mean()), rel=1e-12)


def test_it_is_printed_and_shown(small):
    said = str(small)
    assert "256 base samples, 1280 solves" in said and "peak force [N]" in said and "95 %" in said
    shown = small._repr_html_()
    assert "Uncertainty" in shown and "impactor.mass: lognormal(2, 0.02)" in shown
    ElementTree.fromstring(shown)
    assert repr(small).startswith("<Uncertain: peak_force, impulse, contacts by impactor.velocity")
    table = json.loads(json.dumps(small.table(), allow_nan=False))
    assert table["figures"]["peak_force"]["ranking"][0] == "impactor.velocity" and table["notes"] == []


# --- what has no answer -----------------------------------------------------------------------------------------------


def test_points_are_rounded_up_and_it_says_so():
    found = uncertain(SPRING, {"impactor.mass": "5%"}, ["peak_force"], 9, workers=1)
    assert (found.asked, found.samples, found.solves) == (9, 16, 48)
    assert [note.code for note in found.notes] == ["samples-rounded-up"]


def test_base_samples_with_a_refusal_are_left_out_wholly():
    wide = {"impactor.mass": "uniform(-0.3, 2)", "impactor.velocity": "5%"}
    found = uncertain(SPRING, wide, ["peak_force"], 64, workers=2)
    missing = (found.dataset["impactor.mass"].values < 0.0).reshape(4, 64)
    assert found.refused == missing.sum() > 0
    assert found.kept == 64 - missing.any(0).sum() == found.figures["peak_force"].samples
    assert found.why.startswith("impactor.mass: got -")
    (note,) = found.notes
    assert note.code == "samples-left-out" and found.why in str(note)
    kept = found.dataset.peak_force.values.reshape(4, 64)[:, ~missing.any(0)]
    assert found.figures["peak_force"].mean == approx(kept[:2].mean(), rel=1e-12)
    assert 0.0 < found.figures["peak_force"].shares["impactor.velocity"].total < 0.2


def test_figures_that_are_not_to_be_trusted_are_no_answer():
    scene = solvers.load("fixed-rod").replace({"method": {"name": "modal", "modes": 2}})
    (invalid,) = (note for note in solvers.solve(scene).notes if note.severity == "invalid")
    for trusted, refused in ((True, invalid.code), (False, "")):
        part = Work(scene, ("impactor.mass",), ("impulse",), None, True, trusted)([(1.0,)])
        assert part.refused.tolist() == [refused] and np.isnan(part.figures).all() == trusted
        assert invalid.code in part.notes[0]


def test_words_have_indices_and_no_elasticity():
    drawn = {"contact.law": "rigid,hertz", "impactor.velocity": "20%"}
    found = uncertain("bronze-rod-steel-ball", drawn, ["contact_time"], 16, workers=2)
    shares = found.figures["contact_time"].shares
    assert math.isnan(shares["contact.law"].elasticity) and not math.isnan(shares["impactor.velocity"].elasticity)
    assert found.inputs["contact.law"] == "rigid, hertz"


def test_a_figure_that_some_points_do_not_have():
    drawn = {"contact.law": "rigid,hertz", "impactor.velocity": "20%"}
    found = uncertain("bronze-rod-steel-ball", drawn, ["peak_indentation", "impulse"], 16, workers=2)
    deep = found.figures["peak_indentation"]
    assert deep.samples < found.kept == found.figures["impulse"].samples == 16
    assert deep.shares is None
    assert [note.code for note in found.notes] == ["figure-at-some"]


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"tolerances": {}}, "vary: got nothing"),
        ({"tolerances": {"impactor.mass": "normal(2)"}}, r"normal\(mean, deviation\)"),
        (
            {"tolerances": {"impactor.mass": "normal(-1, 1)"}},
            r"at least half .* not, the first of them as impactor\.mass",
        ),
        ({"figures": ["beauty"]}, "figures: got 'beauty'"),
        ({"points": 7}, "points: got 7"),
        ({"seed": -1}, "seed: got -1"),
        ({"workers": 0}, "workers: got 0"),
        ({"scene": "spinning-ball"}, "scene"),
    ],
    ids=str,
)
def test_refusals(changes, said):
    call = {"scene": SPRING, "tolerances": {"impactor.mass": "5%"}, "points": 8, "workers": 1} | changes
    with pytest.raises(SceneError, match=said):
        uncertain(**call)


def test_methods_with_options_may_be_uncertain():
    """As when it is asked how much of a spread is owed to the choice of a model."""
    methods = [{"name": "waves"}, {"name": "modal", "modes": 20}]
    found = solvers.uncertain("fixed-rod", {"method": methods, "impactor.mass": "5%"}, ["peak_force"], points=16)
    assert "modal" in found.inputs["method"] and found.figures["peak_force"].shares["method"].total > 0.0
