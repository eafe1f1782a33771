"""Pictures of studies: which elements they have, of which values, on axes with units."""

import holoviews as hv
import numpy as np
import pytest

import solvers
from solvers import SceneError, plot_study, study
from solvers.notebook.datasets import read_study
from solvers.notebook.study_plots import by_factor, gridded

ROD = {"impactor.mass": "0.1..10:13:log"}
BALL = {"impactor.velocity": [2.0, 1.0, 0.5], "contact.law": "rigid,hertz,velvet"}


def rod(vary, **options):
    return study("fixed-rod", vary, figures=["peak_force", "contacts"], notes=False, workers=1, **options)


@pytest.fixture(scope="module")
def ball():
    return study("bronze-rod-steel-ball", BALL, figures=["peak_force", "peak_indentation"], workers=1)


def labels(drawn) -> list[str]:
    figure = hv.render(drawn, backend="bokeh")
    return [figure.xaxis[0].axis_label, figure.yaxis[0].axis_label]


def legend(drawn) -> list[str]:
    return [item.label.value for item in hv.render(drawn, backend="bokeh").legend[0].items]


def element(drawn, kind, label=None):
    (found,) = (each for each in drawn if isinstance(each, kind) and label in (None, each.label))
    return found


def test_a_curve_over_one_key_has_gaps_where_contacts_change():
    found = rod(ROD)
    drawn = plot_study(found, "peak_force")
    assert labels(drawn) == ["impactor.mass (kg)", "peak force (N)"]
    curve, lines = element(drawn, hv.Curve), element(drawn, hv.VLines)
    gaps = np.isnan(curve["peak_force"])
    np.testing.assert_array_equal(curve["peak_force"][~gaps], found.peak_force)
    contacts, mass = found.contacts.values, found["impactor.mass"].values
    changes = np.nonzero(np.diff(contacts))[0]
    assert gaps.sum() == changes.size > 0
    between = np.sqrt(mass[changes] * mass[changes + 1])  # on an axis of powers
    np.testing.assert_allclose(curve["impactor.mass"][gaps], between)
    np.testing.assert_allclose(lines["impactor.mass"], between)
    assert hv.Store.lookup_options("bokeh", curve, "plot").kwargs["logx"]
    assert "Steel rod" in hv.render(drawn, backend="bokeh").title.text
    assert "peak_force" in [dimension.name for dimension in next(iter(plot_study(found))).dimensions()]


def test_points_that_are_refused_are_marked():
    drawn = plot_study(rod({"impactor.mass": [-1.0, 1.0, 2.0]}), "peak_force")
    assert element(drawn, hv.Scatter, "refused")["impactor.mass"].tolist() == [-1.0]
    assert "refused" in legend(drawn)


def test_two_keys_are_a_map_with_lines():
    found = rod({**ROD, "impactor.velocity": [2.0, -0.5, 1.0]})
    drawn = plot_study(found, "peak_force")
    assert labels(drawn) == ["impactor.mass (kg)", "impactor.velocity (m/s)"]
    cells = element(drawn, hv.QuadMesh).dimension_values("peak_force", flat=False)
    whole = found.peak_force.transpose("impactor.velocity", "impactor.mass").sortby("impactor.velocity")
    np.testing.assert_array_equal(cells, whole.values)
    levels = [each["peak_force"][0] for each in element(drawn, hv.Contours).split()]
    assert len(levels) > 2 and float(found.peak_force.min()) <= min(levels) < max(levels) <= found.peak_force.max()
    assert set(element(drawn, hv.Scatter, "refused")["impactor.velocity"]) == {-0.5}
    border = element(drawn, hv.Curve, "other number of contacts")
    contacts = found.contacts.sel({"impactor.velocity": 1.0}).values
    sides = border["impactor.mass"][np.isfinite(border["impactor.mass"])]
    assert np.unique(sides.round(9)).size == np.count_nonzero(np.diff(contacts))
    assert legend(drawn) == ["other number of contacts", "refused"]
    turned = plot_study(found, "peak_force", x="impactor.velocity")
    assert labels(turned) == ["impactor.velocity (m/s)", "impactor.mass (kg)"]


def test_words_have_a_curve_each(ball):
    drawn = plot_study(ball, "peak_force")
    curves = {each.label: each for each in drawn if isinstance(each, hv.Curve)}
    assert list(curves) == [f"contact.law = {law}" for law in ("rigid", "hertz", "velvet")]
    hertz = ball.peak_force.sel({"contact.law": "hertz"}).values
    np.testing.assert_array_equal(curves["contact.law = hertz"]["peak_force"], hertz[::-1])  # along rising speeds
    assert element(drawn, hv.Scatter, "refused: contact.law = velvet")["impactor.velocity"].tolist() == [0.5, 1.0, 2.0]
    across = plot_study(ball, "peak_force", x="contact.law")
    assert labels(across) == ["contact.law", "peak force (N)"]
    fast = element(across, hv.Scatter, "impactor.velocity = 2")
    assert list(fast["contact.law"]) == ["rigid", "hertz"]


def test_a_figure_that_some_points_do_not_have_is_a_gap(ball):
    curves = {each.label: each for each in plot_study(ball, "peak_indentation") if isinstance(each, hv.Curve)}
    assert np.isnan(curves["contact.law = rigid"]["peak_indentation"]).all()
    assert np.isfinite(curves["contact.law = hertz"]["peak_indentation"]).all()


def test_further_keys_are_at_their_first_values_and_the_title_says_so():
    vary = {"impactor.mass": [1.0, 2.0], "impactor.velocity": [1.0, 2.0], "target.length": [0.2, 0.4]}
    found = rod(vary)
    drawn = plot_study(found, "peak_force", y="target.length")
    assert labels(drawn) == ["impactor.mass (kg)", "target.length (m)"]
    assert "impactor.velocity = 1" in hv.render(drawn, backend="bokeh").title.text.replace("\n", " ")
    cells = element(drawn, hv.QuadMesh).dimension_values("peak_force", flat=False)
    np.testing.assert_array_equal(cells, found.peak_force.values[:, 0].T)


def test_keys_that_go_together_are_one_axis():
    found = rod({"impactor.mass,impactor.velocity": "(1,2),(2,1)"})
    assert labels(plot_study(found, "peak_force"))[0] == "impactor.mass (kg)"
    assert labels(plot_study(found, "peak_force", x="impactor.velocity"))[0] == "impactor.velocity (m/s)"
    with pytest.raises(SceneError, match=r"y: got 'impactor\.velocity'; allowed: another key than impactor\.mass"):
        plot_study(found, "peak_force", "impactor.mass", "impactor.velocity")


def test_points_drawn_by_chance_are_a_scatter_over_each_key():
    found = rod({"impactor.mass": "uniform(-0.2, 2)", "impactor.velocity": "5%"}, points=40)
    drawn = plot_study(found, "peak_force")
    assert isinstance(drawn, hv.Layout) and len(drawn) == 2
    there = found.refused.values == ""
    for overlay, (x, colour) in zip(drawn, [list(found.coords)[1:], list(found.coords)[:0:-1]], strict=True):
        points = element(overlay, hv.Scatter, "")
        np.testing.assert_array_equal(points[x], found[x].values[there])
        np.testing.assert_array_equal(points[colour], found[colour].values[there])
        np.testing.assert_array_equal(points["peak_force"], found.peak_force.values[there])
        assert len(element(overlay, hv.Scatter, "refused")) == (~there).sum() > 0
    one = plot_study(found, "peak_force", x="impactor.velocity")
    assert labels(one) == ["impactor.velocity (m/s)", "peak force (N)"]


def test_points_of_uncertain_inputs_are_drawn_too():
    found = solvers.uncertain("fixed-rod", {"impactor.mass": "5%"}, ["impulse"], 8, workers=1)
    assert labels(plot_study(found.dataset)) == ["impactor.mass (kg)", "impulse (N s)"]


@pytest.mark.parametrize("ending", [".nc", ".csv", ".parquet", ".zarr"])
def test_a_grid_is_known_again_from_a_file(ending, tmp_path):
    path = tmp_path / f"map{ending}"
    found = rod({"impactor.mass": [1.0, 2.0, 3.0], "impactor.velocity": [1.0, 2.0]}, out=path)
    again = gridded(read_study(path))
    assert again.peak_force.dims == found.peak_force.dims == ("impactor.mass", "impactor.velocity")
    np.testing.assert_allclose(again.peak_force, found.peak_force)
    assert element(plot_study(read_study(path), "peak_force"), hv.QuadMesh)


@pytest.mark.parametrize(
    "values, log",
    [
        ([1, 10, 100], True),
        ([1, 2, 3], False),
        ([1, 2], False),
        ([1, 100], True),
        ([-1, 1, 100], False),
        ([1, 1], False),
    ],
)
def test_axes_of_powers(values, log):
    assert by_factor(np.array(values, float)) == log


def test_refusals(ball):
    with pytest.raises(SceneError, match="figure: got 'heat'; allowed: 'peak_force'"):
        plot_study(ball, "heat")
    with pytest.raises(SceneError, match="figure: got 'refused'"):
        plot_study(ball, "refused")
    with pytest.raises(SceneError, match=r"x: got 'heat'; allowed: 'impactor\.velocity', 'contact\.law'"):
        plot_study(ball, "peak_force", x="heat")
    with pytest.raises(SceneError, match=r"y: got 'contact\.law'; allowed: another key"):
        plot_study(ball, "peak_force", x="contact.law", y="contact.law")
