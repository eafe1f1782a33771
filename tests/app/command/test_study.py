"""`impact study`: what it prints and writes, and the one line of each refusal."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
import xarray

from app.command.main import main

from ...patience import SECONDS
from .calls import answer, refusal

CALL = ("study", "fixed-rod", "--vary", "impactor.mass=0.5..2:4", "--vary", "contact.law=rigid,velvet")


def test_the_summary_as_json(capsys):
    found = json.loads(answer(capsys, *CALL, "--figure", "peak_force", "--workers", "1", "--json"))
    assert {key: found[key] for key in ("points", "solved", "refused", "resumed", "out")} == {
        **{"points": 8, "solved": 4, "refused": 4, "resumed": 0, "out": None}
    }
    assert found["seconds"] > 0.0 and len(found["rows"]) == 8
    (row,) = (row for row in found["rows"] if row["impactor.mass"] == 2.0 and row["contact.law"] == "rigid")
    assert row["peak_force"] == found["figures"]["peak_force"]["highest"]["value"]
    (refused,) = found["refusals"]
    assert refused["code"] == "allowed.choice" and refused["points"] == 4


def test_a_file_is_written_once_and_gone_on_with(capsys, tmp_path):
    path = str(tmp_path / "map.nc")
    drawn = ("--distribution", "impactor.velocity=5%", "--vary", "contact.law=rigid,velvet")
    call = ("study", "fixed-rod", *drawn, "--points", "20", "--seed", "3", "--out", path)
    said = answer(capsys, *call)
    assert f"written: {path}" in said and "20 points (point 20)" in said
    with xarray.open_dataset(path) as found:
        assert found.sizes == {"point": 20} and "impactor.velocity" in found.coords
    assert "a name that is new" in refusal(capsys, *call)
    assert "20 points were there before" in answer(capsys, *call, "--resume")


@pytest.mark.parametrize(
    "options, said",
    [
        ((), "--vary: got nothing"),
        (("--vary", "impactor.mass"), "KEY=VALUES"),
        (("--vary", "=1,2"), "KEY=VALUES"),
        (("--vary", "impactor.mass="), "KEY=VALUES"),
        (("--vary", "impactor.mass=1", "--vary", "impactor.mass=2"), "one value for a key"),
        (("--vary", "impactor.mass=1,2", "--points", "some"), "--points: got 'some'"),
        (("--vary", "impactor.mass=1,2", "--seed", "1.5"), "--seed: got '1.5'"),
        (("--vary", "impactor.mass=1,2", "--sample", "dice"), "'lhs'"),
        (("--vary", "impactor.mass=1,2", "--workers", "0"), "workers"),
        (("--vary", "impactor.mass=1,2", "--cluster", "nonsense"), "cluster: got 'nonsense'; allowed: tcp://HOST:PORT"),
        (("--vary", "impactor.mass=1,2", "--cluster", "local:2", "--workers", "2"), "nothing beside cluster"),
        (("--vary", "impactor.mass=1,2", "--figure", "beauty"), "'peak_force'"),
        (("--vary", "impactor.mass=1,2", "--out", "map.png"), "'.nc'"),
        (("--vary", "impactor.mass=1,2", "--out", "/nowhere/map.nc"), "a folder that is there"),
        (("--vary", "impactor.mass=1,2", "--resume"), "without a file"),
        (("--distribution", "impactor.mass=5%"), "'lhs'"),
    ],
)
def test_each_refusal_is_one_line(capsys, options, said):
    assert said in refusal(capsys, "study", "fixed-rod", *options)


def test_a_disk_that_cannot_be_written_is_one_line(capsys, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("solvers.studies.study.parts.Parts.keep", full)
    path = str(tmp_path / "map.nc")
    assert main([*CALL, "--out", path]) == 2
    assert f"--out: got '{path}'"[:50] in (said := capsys.readouterr().err) and "No space left" in said


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="by a signal")
@pytest.mark.parametrize("after", [0.1, 0.3, 0.8])
def test_an_interrupt_while_modules_are_read_shows_no_trace(after):
    call = [
        sys.executable,
        "-c",
        "import sys; from app.command.entry import run; print(1, flush=True); sys.exit(run())",
    ]
    begun = subprocess.Popen([*call, "scenes"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    begun.stdout.readline()
    time.sleep(after)
    begun.send_signal(signal.SIGINT)
    _, err = begun.communicate(timeout=SECONDS)
    assert "Traceback" not in err and begun.returncode in (0, 130)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="by a signal")
def test_an_interrupt_keeps_what_is_done(tmp_path):
    path = tmp_path / "map.csv"
    call = [sys.executable, "-m", "app.command", "study", "bronze-rod-steel-ball", "--out", str(path)]
    call += ["--vary", "impactor.velocity=0.5..3:20000"]
    begun = subprocess.Popen(call, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ)
    deadline = time.monotonic() + SECONDS
    while len(list(tmp_path.glob("map.csv.parts/*.npz"))) < 3:
        assert time.monotonic() < deadline and begun.poll() is None
        time.sleep(0.02)
    begun.send_signal(signal.SIGINT)
    out, err = begun.communicate(timeout=SECONDS)
    assert begun.returncode == 130 and "Traceback" not in err
    assert "still to do" in out and "written" not in out and "--resume goes on" in err and not path.exists()
