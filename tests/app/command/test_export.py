"""Files that other programs read."""

import json
import sys

import numpy as np
import pytest
from scipy.io import netcdf_file

import solvers
from app.command.main import main


def test_a_netcdf_file_holds_histories_and_fields(tmp_path, capsys):
    target = tmp_path / "impact.nc"
    assert main(["solve", "fixed-rod", "--series", str(target)]) == 0
    solution = solvers.solve(solvers.load("fixed-rod"))
    with netcdf_file(target, mmap=False) as file:
        stress, instants, places = (file.variables[name] for name in ("stress", "instant", "x"))
        assert stress.units == b"Pa"
        assert stress[:] == pytest.approx(solution.motion.stress(instants[:], places[:]))
        force, time = file.variables["contact_force"], file.variables["time"]
        assert force[:].max() == pytest.approx(solution.peak_force)
        assert (np.diff(time[:]) >= 0.0).all()
        assert (np.diff(time[:]) == 0.0).any()  # a jump: the time stands twice
        assert file.version_byte == 1  # the classic format
        assert file.title.decode() == solution.scene.title
        assert file.version.decode().startswith(f"Strikewave {solvers.__version__}+")
        assert solvers.Scene.from_table(json.loads(file.scene)) == solution.scene
        assert file.conventions == b"SI units; time zero at first touch; x from the struck end; compression positive"


def test_a_netcdf_file_has_the_names_that_scripts_rely_on(tmp_path, capsys):
    target = tmp_path / "beam.nc"
    assert main(["solve", "timoshenko-1913-long", "--series", str(target)]) == 0
    with netcdf_file(target, mmap=False) as file:
        found = {name: (values.dimensions, values.units.decode()) for name, values in file.variables.items()}
    fields = ("instant", "x")
    assert found == {
        "time": (("time",), "s"),
        "contact_force": (("time",), "N"),
        "impactor_position": (("time",), "m"),
        "impactor_velocity": (("time",), "m/s"),
        "struck_end_position": (("time",), "m"),
        "target_mean_velocity": (("time",), "m/s"),
        "instant": (("instant",), "s"),
        "x": (("x",), "m"),
        "stress": (fields, "Pa"),
        "velocity": (fields, "m/s"),
        "displacement": (fields, "m"),
        "bending_moment": (fields, "N m"),
        "shear_force": (fields, "N"),
    }


def test_without_xarray_netcdf_is_refused_before_solving_and_csv_is_written(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    assert main(["solve", "fixed-rod", "--series", str(tmp_path / "impact.nc")]) == 2
    said = capsys.readouterr()
    assert "NetCDF needs xarray: pip install 'strikewave[notebook]'" in said.err
    assert said.err.count("\n") == 1
    assert said.out == ""
    assert main(["solve", "fixed-rod", "--series", str(tmp_path / "impact.csv")]) == 0
    written = (tmp_path / "impact.csv").read_text().splitlines()
    assert next(line for line in written if not line.startswith("#")).startswith("time_s,contact_force_N,")


def test_a_netcdf_file_that_cannot_be_written_is_reported(tmp_path, capsys):
    assert main(["solve", "fixed-rod", "--series", str(tmp_path / "nowhere" / "impact.nc")]) == 2
    assert "a file that can be written (No such file or directory)" in capsys.readouterr().err


@pytest.mark.parametrize("scene", ["fixed-rod", "timoshenko-1913-long", "stepped-rod"])
def test_histories_at_places_are_columns_of_their_fields(scene, tmp_path, capsys):
    target, solution = tmp_path / "impact.csv", solvers.solve(scene)
    inside = [0.25 * solution.scene.target.length, 0.5 * solution.scene.target.length]
    asked = [word for x in inside for word in ("--at", repr(x))]
    assert main(["solve", scene, "--series", str(target), *asked]) == 0
    lines = [line for line in target.read_text().splitlines() if not line.startswith("#")]
    names, rows = lines[0].split(","), np.loadtxt(lines[1:], delimiter=",")
    column = dict(zip(names, rows.T, strict=True))
    time = column["time_s"]
    assert (np.diff(time) >= 0.0).all() and np.diff(time).max() <= 1.001 * solution.duration / 1999
    for x in inside:
        for field, unit in (("stress", "Pa"), ("velocity", "m_per_s"), ("displacement", "m")):
            found = column[f"{field}_at_{x:.9g}_m_{unit}"]
            # but where the twelve digits written move an instant over a front
            true = getattr(solution.motion, field)(time, np.array([x]))[:, 0]
            assert np.mean(np.abs(found - true) > 1e-6 * np.abs(true).max()) < 0.01
    assert np.trapezoid(column["contact_force_N"], time) == pytest.approx(solution.impulse, rel=1e-3)
    assert solvers.load(target).target == solution.scene.target


@pytest.mark.parametrize(
    "more, told",
    [
        (["--at", "0.1"], "--at: got '0.1'; allowed: nothing, or beside it --series FILE.csv"),
        (["--at", "0.1", "--series", "x.nc"], "--at: got '0.1'; allowed: nothing, or beside it --series FILE.csv"),
        (["--at", "middle", "--series", "x.csv"], "allowed: a place as a number, in m"),
        (["--at", "30", "--series", "x.csv"], "--at: got 30.0; allowed: a number from 0 to 0.3 m"),
        (["--at", "nan", "--series", "x.csv"], "--at: got nan; allowed: a number from 0 to 0.3 m"),
    ],
)
def test_places_that_are_none_are_refused(more, told, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["solve", "fixed-rod", *more]) == 2
    assert told in capsys.readouterr().err
    assert not [*tmp_path.iterdir()]
