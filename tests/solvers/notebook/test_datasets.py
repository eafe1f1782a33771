"""Labelled arrays: the motion's own values, in every kind of scene."""

import doctest
import json
import subprocess
import sys

import numpy as np
import pytest
import xarray

import solvers
from solvers.notebook import datasets

from ...patience import SECONDS

KINDS = {  # one of each pair of bodies that has a motion of its own
    "a mass on a rod": "fixed-rod",
    "a ball on a beam": "timoshenko-1913-long",
    "a force on a chain of rods": "pressure-bar",
    "a rod on a rod": "two-equal-rods",
    "a ball on a half-space": "sphere-on-half-space",
    "a mass on an oscillator": "spring-mass",
    "a mass on a mechanism": "rotating-bar",
    "a ball on a mechanism that moves on": "double-pendulum",
}


@pytest.fixture(scope="module", params=list(KINDS.values()), ids=list(KINDS))
def solution(request):
    return solvers.solve(solvers.load(request.param))


def test_the_values_are_those_of_the_motion(solution):
    data, motion, scene = solution.dataset(), solution.motion, solution.scene
    time, x = data.time.values, data.x.values
    assert time[0] == 0.0
    assert time[-1] == solution.duration
    assert x[-1] == scene.target.length
    np.testing.assert_array_equal(data.contact_force, motion.force(time))
    np.testing.assert_array_equal(data.impulse, motion.impulse(time))
    np.testing.assert_array_equal(data.end_velocity, motion.end_velocity(time))
    np.testing.assert_array_equal(data.stress, motion.stress(time, x))
    np.testing.assert_array_equal(data.velocity, motion.velocity(time, x))
    np.testing.assert_array_equal(data.displacement, motion.displacement(time, x))
    for part, values in motion.energies(time).items():
        np.testing.assert_array_equal(data.energy.sel(energy_part=part), values)


def test_what_a_scene_does_not_have_is_not_there(solution):
    data, scene = solution.dataset(), solution.scene
    assert ("impactor_velocity" in data) == (scene.impactor.kind != "pulse")
    assert ("bending_moment" in data) == ("shear_force" in data) == scene.target.bends
    assert (data.x.size > 1) == (scene.target.length > 0.0)


def test_every_variable_says_its_unit_and_what_it_is(solution):
    data = solution.dataset()
    for values in data.data_vars.values():
        assert values.units
        assert values.long_name
    assert data.title == solution.scene.title
    assert json.loads(data.attrs["method"]) == solution.method
    assert json.loads(data.attrs["diagnostics"]) == solution.diagnostics
    assert solvers.Scene.from_table(json.loads(data.attrs["scene"])) == solution.scene


def test_energy_is_kept_by_the_exact_waves():
    data = solvers.solve(solvers.load("fixed-rod")).dataset()
    assert data.energy.sum("energy_part").values == pytest.approx(0.5 * solvers.load("fixed-rod").impactor.mass)


def test_moments_and_shear_forces_are_those_of_the_beam():
    solution = solvers.solve(solvers.load("timoshenko-1913-long"))
    time, x = np.linspace(0.0, solution.duration, 5), np.linspace(0.0, solution.scene.target.length, 7)
    data = solution.dataset(time, x)
    assert dict(data.sizes) == {"time": 5, "x": 7, "energy_part": 5}
    np.testing.assert_array_equal(data.bending_moment, solution.motion.moment(time, x))
    np.testing.assert_array_equal(data.shear_force, solution.motion.shear(time, x))


def test_a_rod_that_strikes_lies_before_the_contact():
    solution = solvers.solve(solvers.load("two-equal-rods"))
    data = solution.dataset()
    assert data.x.values[0] == -solution.scene.impactor.length
    assert data.velocity.isel(time=0).sel(x=-0.1, method="nearest") == pytest.approx(solution.scene.impactor.velocity)


def test_a_motion_that_knows_no_place_in_the_impactor_is_not_asked_for_one():
    steel = {"kind": "rod", "length": 0.3, "section": {"area": 9e-4}, "material": "steel", "velocity": 1.0}
    scene = solvers.Scene.from_table(
        {"impactor": steel, "target": {"kind": "mass", "mass": 1.0}, "contact": {"law": "linear", "stiffness": 1e8}}
    )
    whole, modal = (solvers.solve(scene, method=name).dataset() for name in ("quasi-static", "modal"))
    assert whole.x.values.tolist() == [0.0]
    assert modal.x.values[0] == -0.3
    assert modal.velocity.values[0, 0] == pytest.approx(1.0)


def test_a_dataset_is_written_and_read_without_loss(solution, tmp_path):
    data = solution.dataset()
    data.to_netcdf(tmp_path / "impact.nc")
    with xarray.open_dataset(tmp_path / "impact.nc") as read:
        xarray.testing.assert_identical(read.load(), data)


def test_one_impulse_between_bodies_in_space_has_no_history():
    solution = solvers.solve(solvers.load("brick-off-centre"))
    for asked in (solution.dataset, solution.plot):
        with pytest.raises(solvers.SceneError, match="one impulse between bodies in space has none"):
            asked()


@pytest.mark.slow
def test_without_xarray_the_sentence_names_the_extra():
    call = (
        "import sys; sys.modules['xarray'] = None\n"
        "import solvers\n"
        "solution = solvers.solve(solvers.load('fixed-rod'))\n"
        "try: solution.dataset()\n"
        "except ImportError as error: print(error)"
    )
    done = subprocess.run([sys.executable, "-c", call], capture_output=True, text=True, timeout=SECONDS)
    assert done.stdout == "dataset() needs xarray: pip install 'strikewave[notebook]'\n", done.stderr


def test_the_examples_run():
    assert doctest.testmod(datasets).failed == 0
    assert doctest.testmod(datasets).attempted == 5
