"""Pictures of a study's points one after another: scatters, lines over all keys, ranked bars; and of very many."""

import json

import holoviews as hv
import numpy as np
import pytest
import xarray

import solvers
from solvers import SceneError, plot_study, study
from solvers.notebook import study_parts, study_points
from solvers.notebook.study_plots import KINDS

from .test_plot_study import element, labels, legend, rod

DRAWN = {"impactor.mass": "uniform(-0.2, 2)", "impactor.velocity": "5%"}


@pytest.fixture(scope="module")
def drawn_points():
    return rod(DRAWN, points=60)


@pytest.fixture(scope="module")
def ball():
    vary = {"impactor.velocity": [0.5, 1.0, 1.5, 2.0], "contact.law": "rigid,hertz", "impactor.mass": [0.1, 0.2]}
    return study("bronze-rod-steel-ball", vary, figures=["peak_force", "peak_indentation"], workers=1)


def made(columns, figures, keys=("a", "b"), refused=None):
    """A study of drawn points with these values."""
    count = len(columns[keys[0]])
    design = {"vary": [{"keys": [key], "law": "uniform(0, 1)"} for key in keys], "sample": "random", "points": count}
    words = np.full(count, "", object) if refused is None else np.where(refused, "not-towards", "").astype(object)
    variables = {name: ("point", values, {"units": "N", "long_name": name}) for name, values in figures.items()}
    places = {"point": np.arange(count)} | {key: ("point", columns[key], {"units": "m"}) for key in keys}
    about = {"design": json.dumps(design), "scene": 'title = "Made"', "figures": " ".join(figures)}
    return xarray.Dataset(variables | {"refused": ("point", words)}, places, about)


def test_a_matrix_has_each_figure_over_each_key(drawn_points):
    drawn = plot_study(drawn_points, "contacts", kind="matrix")
    there = drawn_points.refused.values == ""
    axes = [tuple(dimension.name for dimension in part.dimensions()[:2]) for part in drawn]
    keys = ["impactor.mass", "impactor.velocity"]
    assert axes == [(key, figure) for figure in ("contacts", "peak_force") for key in keys]
    np.testing.assert_array_equal(list(drawn)[3]["impactor.velocity"], drawn_points["impactor.velocity"].values[there])
    np.testing.assert_array_equal(list(drawn)[3]["peak_force"], drawn_points.peak_force.values[there])


def test_parallel_lines_stand_at_the_share_of_each_span(drawn_points):
    drawn = plot_study(drawn_points, "peak_force", kind="parallel")
    lines = element(drawn, hv.Contours).split()
    there = drawn_points.refused.values == ""
    assert len(lines) == there.sum() < there.size
    mass = drawn_points["impactor.mass"].values[there]
    heights = np.array([line["height"] for line in lines])
    assert mass.max() > 100.0 * mass.min()
    np.testing.assert_allclose(heights[:, 0], np.log(mass / mass.min()) / np.log(mass.max() / mass.min()))
    speed = drawn_points["impactor.velocity"].values[there]
    np.testing.assert_allclose(heights[:, 1], (speed - speed.min()) / np.ptp(speed))
    force = drawn_points.peak_force.values[there]
    np.testing.assert_array_equal([line["peak_force"][0] for line in lines], force)
    figure = hv.render(drawn, backend="bokeh")
    said = list(figure.xaxis[0].major_label_overrides.values())
    assert said == ["impactor.mass (kg), log", "impactor.velocity (m/s)", "contacts", "peak force (N)"]
    assert f"{force.max():.4g}" in list(element(drawn, hv.Labels)["text"])


def test_words_have_a_height_each_and_what_is_missing_a_gap(ball):
    lines = element(plot_study(ball, "peak_force", kind="parallel"), hv.Contours).split()
    assert len(lines) == ball.refused.size
    assert {line["height"][1] for line in lines} == {0.0, 1.0}
    assert np.isnan([line["height"][3] for line in lines]).sum() == 8  # rigid contacts have no indentation


def test_bars_rank_keys_by_squared_rank_correlation():
    from scipy import stats

    found = rod({"impactor.mass": "uniform(1, 2)", "impactor.velocity": "1%", "target.length": "1%"}, points=80)
    bars = plot_study(found, "peak_force", kind="bars")
    expected = {
        key: stats.spearmanr(found[key].values, found.peak_force.values).statistic ** 2
        for key in ("impactor.mass", "impactor.velocity", "target.length")
    }
    assert list(bars["key"]) == sorted(expected, key=lambda key: expected[key])  # the first stands at the bottom
    np.testing.assert_allclose(bars["share"], sorted(expected.values()), rtol=1e-9)
    assert "80 points" in hv.render(bars, backend="bokeh").title.text.replace("\n", " ")


def test_bars_of_words_and_of_keys_that_go_together(ball):
    bars = plot_study(ball, "peak_force", kind="bars")
    shares = dict(zip(bars["key"], bars["share"], strict=True))
    ranks = study_points.ranks(ball.peak_force.values.ravel()).reshape(ball.peak_force.shape)
    between = ranks.mean((0, 2))
    assert shares["contact.law"] == pytest.approx(between.var() / ranks.var(), rel=1e-9)
    both = rod({"impactor.mass,impactor.velocity": "(1,2),(2,1),(3,3)", "target.length": "0.2..0.5:6"})
    bars = plot_study(both, "peak_force", kind="bars")
    assert set(bars["key"]) == {"impactor.mass,impactor.velocity", "target.length"}


def test_what_falls_and_rises_has_a_small_bar_and_the_title_says_how_much_all_explain():
    b, a = np.linspace(0.0, 1.0, 400), np.random.default_rng(1).permutation(400) / 400
    bars = plot_study(made({"a": a, "b": b}, {"f": (b - 0.5) ** 2 + 1e-9 * a}), kind="bars")
    assert dict(zip(bars["key"], bars["share"], strict=True))["b"] < 0.02
    assert float(hv.render(bars, backend="bokeh").title.text.split()[-1]) < 0.05


def test_ranks_are_those_of_scipy():
    from scipy import stats

    values = np.random.default_rng(0).integers(0, 9, 50).astype(float)
    np.testing.assert_array_equal(study_points.ranks(values), stats.rankdata(values))


def test_bars_of_uncertain_inputs_leave_out_the_points_between():
    found = solvers.uncertain(
        "fixed-rod", {"impactor.mass": "5%", "impactor.velocity": "5%"}, ["impulse"], 8, workers=1
    )
    bars = plot_study(found.dataset, kind="bars")
    assert "16 points" in hv.render(bars, backend="bokeh").title.text.replace("\n", " ")


def test_points_of_a_grid_and_curves_where_a_map_is_usual(ball):
    found = rod({"impactor.mass": [1.0, 2.0, 3.0], "impactor.velocity": [1.0, 2.0]})
    points = plot_study(found, "peak_force", kind="points")
    assert isinstance(points, hv.Layout) and len(points) == 2
    first = next(iter(points))
    np.testing.assert_array_equal(first["peak_force"], found.peak_force.values.ravel())
    np.testing.assert_array_equal(first["impactor.mass"], [1.0, 1.0, 2.0, 2.0, 3.0, 3.0])
    np.testing.assert_array_equal(first["impactor.velocity"], [1.0, 2.0] * 3)
    curves = [each for each in plot_study(found, "peak_force", kind="curves") if isinstance(each, hv.Curve)]
    assert [each.label for each in curves] == ["impactor.velocity = 1", "impactor.velocity = 2"]
    assert element(plot_study(found, "peak_force", kind="map"), hv.QuadMesh)


def test_kinds_that_make_no_sense_are_refused(drawn_points, ball):
    one = rod({"impactor.mass": [1.0, 2.0, 3.0]})
    two = np.array([1.0, 2.0])
    none = made({"a": two, "b": two}, {"f": np.full(2, np.nan)}, refused=np.array([True, True]))
    for found, asked, said in (
        (one, {"kind": "pie"}, "kind: got 'pie'; allowed: 'curves', 'map'"),
        (one, {"kind": "map"}, "kind: got 'map'; allowed: another kind: a map needs two keys"),
        (ball, {"kind": "map", "y": "contact.law"}, "kind: got 'map'"),
        (one, {"kind": "bars"}, "kind: got 'bars'; allowed: another kind: bars need at least 10 points"),
        (drawn_points, {"kind": "map"}, "kind: got 'map'; allowed: 'points', 'parallel', 'matrix', 'bars'"),
        (drawn_points, {"kind": "curves"}, "kind: got 'curves'"),
        (drawn_points, {"kind": "bars", "x": "impactor.mass"}, "x: got 'impactor.mass'; allowed: nothing beside kind"),
        (drawn_points, {"kind": "matrix", "y": "impactor.mass"}, "y: got 'impactor.mass'"),
        (rod(DRAWN | {"impactor.mass": "uniform(1, 2)"}, points=20), {"kind": "bars", "figure": "contacts"}, "figure:"),
        (none, {"kind": "parallel"}, "figure: got 'f'; allowed: a figure that some point has"),
        (none, {"kind": "matrix"}, "figure: got 'f'"),
    ):
        with pytest.raises(SceneError) as refused:
            plot_study(found, **asked)
        assert said in str(refused.value)
    assert {"curves", "map", "points"} < set(KINDS)


# --- very many --------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def many():
    draw, count = np.random.default_rng(0), study_parts.MANY + 50_000
    a, b = draw.uniform(-0.5, 2.0, count), draw.uniform(1.0, 2.0, count)
    return made({"a": a, "b": b}, {"f": np.where(a > 0.0, a * b, np.nan), "g": b}, refused=a <= 0.0)


def test_many_points_are_counted_in_cells(many):
    there = int((many.refused == "").sum())
    assert there > study_parts.MANY
    over_a, over_b = plot_study(many)
    cells = element(over_a, hv.Image).dimension_values(2)
    assert np.nansum(cells) == there
    assert cells.size < 30_000
    crosses = element(over_a, hv.Scatter, "refused")
    assert 0 < len(crosses) <= 2 * study_points.CROSSES and max(crosses["a"]) <= 0.0
    assert legend(over_a) == ["refused"]
    assert labels(over_b) == ["b (m)", "f (N)"]
    mean = element(plot_study(many, x="a", y="b"), hv.Image)
    (column,) = np.nonzero(np.isfinite(mean.dimension_values(2)))
    assert 1.0 <= mean.dimension_values(2)[column].min() < mean.dimension_values(2)[column].max() <= 2.0
    parts = list(plot_study(many, kind="matrix"))
    assert [np.nansum(part.dimension_values(2)) for part in parts[:2]] == [there, there]


def test_cells_have_the_points_that_lie_in_them(many):
    over_a = element(next(iter(plot_study(many))), hv.Image)
    counts = over_a.dimension_values(2, flat=False)
    left, low, right, high = over_a.bounds.lbrt()
    known = many.refused.values == ""
    expected = np.histogram2d(many.f.values[known], many.a.values[known], counts.shape, [(low, high), (left, right)])[0]
    np.testing.assert_array_equal(np.nan_to_num(counts), expected)


def test_many_lines_are_means_in_cells(many):
    drawn = plot_study(many, kind="parallel")
    cells = element(drawn, hv.Image).dimension_values("f")
    f = many.f.values[many.refused.values == ""]
    assert f.min() <= np.nanmin(cells) < np.nanmax(cells) <= f.max()
    last = element(drawn, hv.Image).dimension_values("f", flat=False)[:, -1]  # beside the axis of the figure itself
    assert np.nanmax(last) > 0.9 * f.max()


def test_a_long_curve_keeps_its_peaks_gaps_and_changes():
    x = np.linspace(1.0, 2.0, study_parts.MANY + 30_000)
    f = np.sin(40.0 * x)
    f[70_001], f[90_123] = 7.0, np.nan
    refused, contacts = np.isnan(f), np.where(x < 1.61, 1.0, 2.0)
    design = {"vary": [{"keys": ["a"], "values": [[value] for value in x.tolist()]}], "sample": "grid"}
    words = np.where(refused, "not-towards", "").astype(object)
    found = xarray.Dataset(
        {"f": ("a", f), "contacts": ("a", contacts), "refused": ("a", words)}, {"a": x},
        {"design": json.dumps(design), "scene": "", "figures": "f contacts"},
    )  # fmt: skip
    drawn = plot_study(found)
    curve = element(drawn, hv.Curve)
    assert len(curve) < 6_000 and np.nanmax(curve["f"]) == 7.0
    assert element(drawn, hv.Scatter, "refused")["a"].tolist() == [x[90_123]]
    assert element(drawn, hv.VLines)["a"][0] == pytest.approx(1.61, abs=1e-5)


def test_a_large_map_has_means_of_blocks_and_all_its_borders():
    x, y = np.linspace(1.0, 2.0, 401), np.linspace(-1.0, 1.0, 301)
    values = x[:, None] * np.where(y > 0.0, y, np.nan)
    design = {"vary": [{"keys": ["a"], "values": []}, {"keys": ["b"], "values": []}], "sample": "grid"}
    words = np.where(np.isnan(values), "not-towards", "").astype(object)
    words[100, 250] = "not-towards"
    values[100, 250] = np.nan
    contacts = np.where(np.isnan(values), np.nan, 1.0 + (x > 1.5)[:, None])
    found = xarray.Dataset(
        {"f": (("a", "b"), values), "contacts": (("a", "b"), contacts), "refused": (("a", "b"), words)},
        {"a": x, "b": y}, {"design": json.dumps(design), "scene": "", "figures": "f contacts"},
    )  # fmt: skip
    drawn = plot_study(found)
    mesh = element(drawn, hv.QuadMesh).dimension_values("f", flat=False)
    assert mesh.size <= study_parts.BLOCKS**2
    assert mesh[-1, -1] == pytest.approx(values[-1:, -1:].mean())
    np.testing.assert_allclose(mesh[90, 3], np.nanmean(values[6:8, 180:182]))
    crosses = element(drawn, hv.Scatter, "refused")
    assert (x[100], y[250]) in set(zip(crosses["a"], crosses["b"], strict=True))
    assert len(crosses) < 1_000
    border = element(drawn, hv.Curve, study_parts.CHANGED)
    assert np.isfinite(border["a"]).sum() == 2 * 150
    assert np.nanmax(border["a"]) == pytest.approx(1.50125, abs=1e-9)
