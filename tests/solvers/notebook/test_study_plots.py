"""Plots of studies: the values of their arrays on axes with units, drawn by Bokeh without complaint."""

import holoviews as hv
import numpy as np
import pytest

import solvers
from solvers import SceneError


def labels(drawn) -> set[str]:
    figure = hv.render(drawn, backend="bokeh")
    return {axis.axis_label for axis in (*figure.xaxis, *figure.yaxis)}


@pytest.fixture(scope="module")
def ensemble():
    return solvers.ensemble("fixed-rod", runs=12)


def test_an_ensemble_as_bands(ensemble):
    drawn = ensemble.plot()
    assert labels(drawn) == {"time (s)", "contact force (N)"}
    np.testing.assert_array_equal(drawn.Curve.Median["force"], ensemble.force.median)
    np.testing.assert_array_equal(drawn.Area.All_runs.dimension_values("upper"), ensemble.force.highest)
    np.testing.assert_array_equal(drawn.Curve.Median["time"], ensemble.time)
    velocity = ensemble.plot("impactor_velocity")
    assert labels(velocity) == {"time (s)", "velocity of the impactor (m/s)"}


def test_a_figure_of_an_ensemble_over_its_changes(ensemble):
    drawn = ensemble.plot("final_velocity")
    assert labels(drawn) == {"relative change of impactor.mass", "final velocity (m/s)"}
    np.testing.assert_array_equal(drawn["final_velocity"], ensemble.final_velocity)
    with pytest.raises(SceneError, match=r"what: got 'heat'; allowed: 'force'"):
        ensemble.plot("heat")


@pytest.mark.parametrize("varied", [{"modes": [3, 6, 12]}, {"elements": [4, 8, 16]}], ids=str)
def test_differences_of_a_convergence(varied):
    found = solvers.convergence("fixed-rod", **varied)
    drawn = found.plot()
    assert labels(drawn) == {found.kind, "difference to the finest"}
    curve = next(each for each in drawn if each.label == "impulse")
    np.testing.assert_array_equal(curve["difference"], found.differences["impulse"][:-1])  # the finest has none
    values = found.plot("peak_force")
    assert labels(values) == {found.kind, "peak force (N)"}
    np.testing.assert_array_equal(values["peak_force"], found.values["peak_force"])
    with pytest.raises(SceneError, match=r"what: got 'heat'; allowed: 'differences'"):
        found.plot("heat")


def test_a_convergence_over_restitutions_has_even_axes():
    found = solvers.convergence("fixed-rod", method="balance", restitutions=[1.0, 0.5, 0.0])
    assert labels(found.plot()) == {"restitution", "difference to the last"}


def test_the_points_of_a_tradeoff():
    found = solvers.stored_tradeoff("fixed-rod")
    drawn = found.plot("peak-force")
    assert labels(drawn) == {"wall time (s)", "error of peak-force"}
    known = [point for point in found.points if point.errors["peak-force"] is not None]
    scattered = np.concatenate([each["wall_time"] for each in drawn if isinstance(each, hv.Scatter)])
    assert sorted(scattered) == sorted(point.wall_time for point in known)
    front = next(each for each in drawn if each.label == "nothing better")
    assert front["wall_time"].tolist() == [point.wall_time for point in found.front("peak-force")]
    assert min(each["error"].min() for each in drawn) > 0.0
    with pytest.raises(SceneError, match=r"quantity: got 'heat'; allowed: .*'rebound'"):
        found.plot("heat")


def test_a_map_of_regimes():
    found = solvers.regime_map()
    axes = {"contact time over the period of the target", "mass ratio, target over impactor"}
    drawn = found.plot()
    assert labels(drawn) == axes
    shown = found.relative_time > 0.0
    for number, name in enumerate([*found.models, "none of them"]):
        at = {
            pair
            for each in drawn
            if each.label == name
            for pair in zip(each["relative_time"], each["mass_ratio"], strict=True)
        }
        row, column = np.nonzero(found.smallest[:, shown] == number)
        assert at == set(zip(found.relative_time[shown][column], found.mass_ratio[row], strict=True))
    for model in found.models:
        assert labels(found.plot(model)) == axes
    with pytest.raises(SceneError, match=r"what: got 'heat'; allowed: 'smallest'"):
        found.plot("heat")


def test_maps_of_stability():
    found = solvers.stability("fixed-rod", grid=(6, 5), modes=5)
    shown = [name for name, each in found.maps.items() if each.reason is None]
    assert len(found.plot()) == len(shown) > 3
    axes = {f"{axis.name.replace('_', ' ')} ({axis.unit})" for axis in found.axes}
    for name in shown:
        drawn = found.plot(name)
        assert labels(drawn) == axes
        cells = next(iter(drawn)).dimension_values("energy_error", flat=False)
        np.testing.assert_array_equal(np.isnan(cells), found.maps[name].ending >= 2)
    with pytest.raises(SceneError, match=r"integrator: got 'heun'"):
        found.plot("heun")
