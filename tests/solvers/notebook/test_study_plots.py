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


# --- figures of many scenes -------------------------------------------------------------------------------------------

SPEEDS, STIFFNESSES = [1.0, 2.0, 3.0], [1e8, 1e9, 1e10, 1e11]
GRID = {
    "impactor.velocity": np.repeat(SPEEDS, 4)[::-1],
    "contact.stiffness": np.tile(STIFFNESSES, 3),
}
HERTZ = solvers.load("bronze-rod-steel-ball")


@pytest.fixture(scope="module")
def many():
    return solvers.solve_many(HERTZ, GRID)


def test_a_grid_of_two_keys_is_a_dataset_over_both(many):
    data = many.dataset()
    assert dict(data.sizes) == {"impactor.velocity": 3, "contact.stiffness": 4}
    units = {"impactor.velocity": "m/s", "contact.stiffness": "N/m^1.5", "peak_force": "N", "impactor_velocity": "m/s"}
    assert {name: data[name].units for name in units} == units
    for row, (speed, stiffness) in enumerate(zip(*GRID.values(), strict=True)):
        at = data.sel({"impactor.velocity": speed, "contact.stiffness": stiffness})
        assert float(at.peak_force) == many.peak_force[row]
        assert int(at.contacts) == many.contacts[row]


def test_a_grid_of_two_keys_is_drawn_as_a_map(many):
    drawn = many.plot("peak_force")
    assert labels(drawn) == {"impactor.velocity (m/s)", "contact.stiffness (N/m^1.5)"}
    assert isinstance(drawn, hv.QuadMesh)
    cells = drawn.dimension_values("peak_force", flat=False)
    whole = many.dataset().peak_force.transpose("contact.stiffness", "impactor.velocity")
    np.testing.assert_array_equal(cells, whole.values)
    edges = drawn.interface.coords(drawn, "contact.stiffness", edges=True)
    np.testing.assert_allclose(np.sqrt(edges[1:] * edges[:-1]), STIFFNESSES, rtol=1e-12)  # by powers of ten


def test_two_keys_that_form_no_grid_are_drawn_as_points():
    loose = {"impactor.velocity": [1.0, 2.0, 3.0], "contact.stiffness": [1e9, 2e9, 4e9]}
    found = solvers.solve_many(HERTZ, loose)
    drawn = found.plot("peak_force")
    assert labels(drawn) == {"impactor.velocity (m/s)", "contact.stiffness (N/m^1.5)"}
    np.testing.assert_array_equal(drawn["peak_force"], found.peak_force)
    data = found.dataset()
    assert dict(data.sizes) == {"scene": 3}
    assert data["contact.stiffness"].units == "N/m^1.5"


def test_three_keys_are_a_dataset_over_three_and_drawn_by_number():
    lengths, masses, speeds = np.meshgrid([0.2, 0.3], [1.0, 2.0, 3.0], [1.0, 4.0], indexing="ij")
    columns = {"target.length": lengths, "impactor.mass": masses, "impactor.velocity": speeds}
    found = solvers.solve_many("fixed-rod", {key: values.ravel() for key, values in columns.items()})
    data = found.dataset()
    np.testing.assert_array_equal(data.impulse.values.ravel(), found.impulse)
    assert data.impulse.dims == tuple(columns)
    assert labels(found.plot("impulse")) == {"scene", "impulse (N s)"}


@pytest.mark.parametrize("scene, key, values", [
    (HERTZ, "contact.stiffness", STIFFNESSES),
    ("fixed-rod", "impactor.mass", [3.0, 1.0, 2.0]),  # the quick way
])  # fmt: skip
def test_a_sweep_is_a_dataset_and_a_plot_over_its_key(scene, key, values):
    found = solvers.sweep(scene, key, values)
    data = found.dataset()
    assert data.impulse.dims == (key,)
    assert data[key].units == {"impactor.mass": "kg", "contact.stiffness": "N/m^1.5"}[key]
    for row in found:
        at = data.sel({key: row["value"]})
        assert float(at.impactor_velocity) == row["impactor"]["final_velocity"]
        deep = row["peak_indentation"]
        assert float(at.peak_indentation) == pytest.approx(np.nan if deep is None else deep, nan_ok=True)
    assert (found[0]["peak_indentation"] is None) == (key == "impactor.mass")
    assert labels(found.plot("peak_force")) == {f"{key} ({data[key].units})", "peak force (N)"}
    with pytest.raises(SceneError, match="what: got 'heat'"):
        found.plot("heat")


def test_a_sweep_of_bodies_in_space_is_no_dataset():
    found = solvers.sweep("spinning-ball", "contact.friction", [0.1, 0.2])
    with pytest.raises(SceneError, match="bodies in space"):
        found.dataset()
