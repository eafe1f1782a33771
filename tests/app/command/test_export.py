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
