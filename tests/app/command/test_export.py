"""Files that other programs read."""

import numpy as np
import pytest
from scipy.io import netcdf_file

import solvers
from app.command.main import main


def test_a_netcdf_file_holds_histories_and_fields(tmp_path, capsys):
    target = tmp_path / "blow.nc"
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
