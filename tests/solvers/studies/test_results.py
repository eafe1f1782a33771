"""One kind of result for all studies: labelled arrays with units, a picture, a table to print and one for notebooks."""

from xml.etree import ElementTree

import holoviews as hv
import numpy as np
import pytest
import xarray

import solvers
from solvers.studies.mass_ratios import mass_ratio_sweep
from solvers.text.catalogue import CHOSEN

ROD = "fixed-rod"
RESULTS = {
    "solve_many": lambda: solvers.solve_many(ROD, {"impactor.mass": [0.5, 2.0, 60.0]}),
    "sweep": lambda: solvers.sweep(ROD, "impactor.mass", [0.5, 2.0, 60.0]),
    "ensemble": lambda: solvers.ensemble(ROD, runs=10),
    "convergence": lambda: solvers.convergence(ROD, (3, 5, 10, 20)),
    "mass ratios": lambda: mass_ratio_sweep("fixed", np.array([3.0, 0.05, 1.0])),
}


@pytest.fixture(scope="module", params=RESULTS.values(), ids=RESULTS)
def result(request):
    return request.param()


def test_each_is_a_dataset_with_units_that_is_written_and_read_without_loss(result, tmp_path):
    data = result.dataset()
    assert all("units" in values.attrs and values.long_name for values in data.data_vars.values())
    assert data.attrs["version"].startswith("Strikewave ")
    data.to_netcdf(tmp_path / "result.nc")
    with xarray.open_dataset(tmp_path / "result.nc") as read:
        xarray.testing.assert_identical(read.load(), data)


def test_each_is_drawn_printed_and_shown(result, monkeypatch):
    drawn = result.plot()
    assert isinstance(drawn, hv.core.Dimensioned) and hv.render(drawn, backend="bokeh") is not None
    said = {}
    for language in ("en", "es"):
        monkeypatch.setenv(CHOSEN, language)
        assert "\n" in str(result)
        card = ElementTree.fromstring(result._repr_html_())
        said[language] = str(result), "".join(card.itertext())
    assert said["en"][1] != said["es"][1]


def test_the_arrays_are_those_of_the_ensemble():
    found = RESULTS["ensemble"]()
    data = found.dataset()
    assert data.change.values.tolist() == found.perturbations.tolist()
    assert data.peak_force.values.tolist() == found.peak_force.tolist() and data.peak_force.units == "N"
    for name in ("force", "struck_position", "impactor_velocity"):
        for edge in ("lowest", "low", "median", "high", "highest"):
            band = data[name].sel(band=edge).values
            np.testing.assert_array_equal(band, getattr(getattr(found, name), edge))


def test_the_arrays_are_those_of_the_convergence():
    found = RESULTS["convergence"]()
    data = found.dataset()
    assert data.modes.values.tolist() == [3, 5, 10, 20]
    for name, values in found.values.items():
        assert data[name].values.tolist() == values.tolist()
        assert data[name].units == found.units[name] and data[name].attrs.get("order") == found.order[name]
        assert data[f"{name}_difference"].values.tolist() == found.differences[name].tolist()


def test_the_arrays_are_those_of_all_mass_ratios_in_rising_order():
    found = RESULTS["mass ratios"]()
    data = found.dataset()
    assert data.mass_ratio.values.tolist() == [0.05, 1.0, 3.0] and data.support == "fixed"
    order = np.argsort(found.mass_ratio)
    assert data.rebound_velocity.values.tolist() == found.rebound_velocity[order].tolist()
    assert data.contacts.values.tolist() == found.contacts[order].tolist()
    np.testing.assert_array_equal(data.end_2, found.periods[order, 1, 1])
    assert data.start_2.units == "T" and found.plot("end_1")["end_1"].tolist() == found.periods[:, 0, 1].tolist()


def test_many_print_how_far_each_figure_reaches_and_where():
    found = solvers.solve_many(ROD, {"impactor.mass": [0.5, 2.0, 60.0]}, figures=["impulse", "target_velocity"])
    head, _, lowest, highest, same = str(found).splitlines()
    assert head == "3 scenes, by impactor.mass"
    assert lowest.split()[:5] == ["impulse", "[N", "s]", f"{found.impulse[0]:.6g}", "at"]
    assert highest.split() == [f"{found.impulse[2]:.6g}", "at", "impactor.mass=60"]
    assert same.split()[-2:] == ["0", "throughout"]
    unvaried = str(solvers.solve_many([ROD, "free-rod"], figures=["peak_force"]))
    assert unvaried.startswith("2 scenes\n") and "scene=0" in unvaried
    assert found.plot()["impulse"].tolist() == found.impulse.tolist()
