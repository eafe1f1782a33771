"""The command `impact record`."""

import csv
import json

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers.records import example, expected
from tests.app.command.calls import answer, refusal

BALL = solvers.solve(solvers.load("bronze-rod-steel-ball"), duration=2e-3)
PLACES = (0.5, 1.0)
LATE = 321.7  # us: the clock of the record at first touch


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """Two gauges in microstrain, twelve bits and noise, semicolons and decimal commas, 100 us before the impact."""
    time = np.arange(-100, 1500) * 1e-6
    strain = np.array([expected(BALL, "strain", time, x) for x in PLACES])
    peak = np.abs(strain).max()
    bit = 2.4 * peak / 4096
    strain = bit * np.round((strain + np.random.default_rng(0).normal(0.0, 0.003 * peak, strain.shape)) / bit)
    lines = ["time_us;microstrain_1;microstrain_2"]
    for t, (first, second) in zip(time, strain.T, strict=True):
        lines.append(f"{1e6 * t + LATE:.1f};{1e6 * first:.4f};{1e6 * second:.4f}".replace(".", ","))
    path = tmp_path_factory.mktemp("records") / "ball.csv"
    path.write_text("\n".join(lines) + "\n")
    return str(path)


def record(capsys, file, *arguments):
    words = ("record", file, "--scene", "bronze-rod-steel-ball", *arguments, "--json")
    return json.loads(answer(capsys, *words))


def test_the_record_is_put_where_it_belongs(capsys, file):
    found = record(capsys, file, "--at", "0.5")
    (gauge,) = found["gauges"]
    assert (gauge["at"], gauge["kind"], gauge["rows"]) == (0.5, "strain", 1600)
    assert gauge["shift"] == approx(-LATE * 1e-6, abs=0.1e-6)
    assert gauge["scale"] == approx(1.0, abs=2e-3)
    assert gauge["residual"] < 0.015  # the noise: 0.003 of the peak, in a record that is quiet for three quarters
    assert found["recovered"] is None and [note["code"] for note in found["note_codes"]] == ["pressure-large"]
    assert found["solution"]["peak_force"] == approx(BALL.peak_force)


@pytest.mark.parametrize("places", [("1.0",), PLACES], ids=["one gauge", "two gauges"])
def test_the_contact_force_is_recovered(capsys, file, tmp_path, places):
    series = tmp_path / "force.csv"
    at = [word for x in PLACES[: len(places)] for word in ("--at", str(x))]
    found = record(capsys, file, *at, "--recover", "--series", str(series))["recovered"]
    assert found["peak_force"] == approx(BALL.peak_force, rel=0.01)
    assert found["impulse"] == approx(BALL.impulse, rel=0.02)
    assert found["residual"] < 0.05
    with series.open() as lines:
        rows = list(csv.DictReader(lines))
    assert set(rows[0]) == {
        "time_s", "recovered_force_N", "solution_force_N", "sent_stress_Pa", "returned_stress_Pa"
    }  # fmt: skip
    force = np.array([float(row["recovered_force_N"]) for row in rows])
    assert force.max() == approx(found["peak_force"]) and float(rows[0]["time_s"]) == 0.0


def test_what_was_compared_can_be_written(capsys, file, tmp_path):
    series = tmp_path / "both.csv"
    record(capsys, file, "--at", "0.5", "--at", "1.0", "--series", str(series))
    with series.open() as lines:
        rows = list(csv.DictReader(lines))
    assert len(rows) == 1600
    measured, reported = (np.array([float(row[f"{who}_strain_2"]) for row in rows]) for who in ("measured", "solution"))
    assert np.linalg.norm(measured - reported) < 0.02 * np.linalg.norm(reported)


def test_the_report_says_it_in_a_table(capsys, file):
    words = ("record", file, "--scene", "bronze-rod-steel-ball", "--at", "0.5", "--recover")
    text = answer(capsys, *words)
    assert "recovered      solution" in text
    assert float(text.splitlines()[1].split()[3]) == approx(-LATE, abs=0.1)


def test_the_other_sign_is_noticed(capsys, file):
    notes = record(capsys, file, "--at", "0.5", "--sign", "-1")["notes"]
    assert any("try --sign -1" in note for note in notes)


def test_a_shift_that_is_given_is_kept(capsys, file):
    for words in (["--shift", "-3e-4"], ["--shift=-.3e-3"]):
        assert record(capsys, file, "--at", "0.5", *words)["gauges"][0]["shift"] == -3e-4


def test_a_file_without_names(capsys, tmp_path):
    time = np.linspace(0.0, 1.2e-4, 100)
    path = tmp_path / "force.txt"
    np.savetxt(path, np.column_stack((1e6 * time, 1e-3 * BALL.motion.force(time))))
    found = record(capsys, str(path), "--columns", "time_us,force_kN")
    assert found["gauges"][0]["kind"] == "force" and found["gauges"][0]["at"] == 0.0
    assert found["gauges"][0]["residual"] < 1e-3


@pytest.mark.parametrize(
    "arguments, said",
    [
        ([], "--at: got nothing"),
        (["--at", "x"], "--at: got 'x'"),
        (["--at", "nan"], "--at: got nan"),
        (["--at", "2"], "at: got 2.0; allowed: a number from 0 to 1.48"),
        (["--at", "0.5", "--at", "1", "--at", "1.2"], "no third place"),
        (["--at", "1", "--at", "0.5", "--recover"], "from the first gauge"),
        (["--at", "0.5", "--kind", "colour"], "kind: got 'colour'"),
        (["--at", "0.5", "--kind", "force"], "No column of the record is a force with its unit"),
        (["--at", "0.5", "--columns", "a,b"], "No column of the record is a time with its unit; it has a, b."),
        (["--at", "0.5", "--sign", "0"], "--sign: got '0'"),
        (["--at", "0.5", "--shift", "soon"], "--shift: got 'soon'"),
        (["--at", "0.5", "--shift", "1"], "where the solution is known"),
        (["--at", "0.5", "--series", "force.nc"], "--series: got 'force.nc'"),
        (["--at", "0.5", "--series", "/no/such/folder/a.csv"], "--series: got"),
    ],
    ids=lambda arguments: " ".join(arguments) if isinstance(arguments, list) else "",
)
def test_what_makes_no_sense_is_refused_in_one_line(capsys, file, arguments, said):
    assert said in refusal(capsys, "record", file, "--scene", "bronze-rod-steel-ball", *arguments)


@pytest.mark.parametrize("content", [b"", b"time_us,strain\n0,0\n", b"\0" * 999, b"1,2\n" * 2_500_000, None])
def test_bad_files_are_refused_in_one_line(capsys, tmp_path, content):
    path = tmp_path / "bad.csv"
    if content is not None:
        path.write_bytes(content)
    assert "record" in refusal(capsys, "record", str(path), "--scene", "bronze-rod-steel-ball", "--at", "1")


def test_only_rods_carry_waves(capsys, file):
    line = refusal(capsys, "record", file, "--scene", "note-rod", "--at", "1")
    assert "target is a rod" in line
    refusal(capsys, "record", file)


def test_the_example_comes_with_the_library(capsys):
    words = ("--scene", "bronze-rod-steel-ball", "--at", "1.0", "--json")
    found = json.loads(answer(capsys, "record", "--example", *words))
    assert found == json.loads(answer(capsys, "record", str(example()), *words))
    assert found["gauges"][0]["shift"] == approx(-37e-6, abs=0.2e-6)
    assert "FILE: got nothing; allowed: one file, or --example" in refusal(capsys, "record", *words)
    assert "FILE: got 'some.csv'" in refusal(capsys, "record", "some.csv", "--example", *words)


@pytest.mark.parametrize(
    "change", ["method.name=waves", "target.length=0.5", 'contact={ law = "hertz", stiffness = 1e10 }']
)
def test_what_was_saved_is_read_back_as_scene_and_record(capsys, tmp_path, change):
    path = str(tmp_path / "saved.csv")
    answer(capsys, "solve", "fixed-rod", "--set", change, "--series", path)
    solution = solvers.solve(solvers.load(path))
    assert json.loads(answer(capsys, "solve", path, "--json"))["peak_force"] == solution.peak_force
    found = json.loads(answer(capsys, "record", path, "--scene", path, "--json"))
    (gauge,) = found["gauges"]
    assert gauge["kind"] == "force" and gauge["at"] == 0.0
    assert abs(gauge["shift"]) < 1e-3 * solution.duration and gauge["scale"] == approx(1.0, abs=2e-3)
    assert gauge["residual"] < 0.03  # jumps are blurred over one step
