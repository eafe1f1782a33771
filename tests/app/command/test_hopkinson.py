"""The command `impact hopkinson`."""

import csv
import json

import numpy as np
import pytest
from pytest import approx

from tests.app.command.calls import answer, refusal
from tests.solvers.studies.hopkinson.bench import law_stress, measured

BARS = """
[incident]
length = 1.5
diameter = 0.02
material = "steel"
gauge = 0.75

[transmitted]
length = 1.5
diameter = 0.02
material = "steel"
gauge = 0.5

[specimen]
length = 0.0113
diameter = 0.01

[striker]
length = 0.258
velocity = 15.4
"""
KEYS = {
    "strain_rate", "peak_stress", "equilibrium", "momentum", "loading", "waves", "dispersion", "windows", "gauges",
    "striker", "uncertainty", "stress_strain", "notes", "note_codes",
}  # fmt: skip
CURVES = {
    "time", "strain", "stress", "stress_one_wave", "stress_two_waves", "stress_three_waves", "strain_rate",
    "true_strain", "true_stress",
}  # fmt: skip


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A record of 14 bits with noise, in microstrain, and its bars."""
    folder = tmp_path_factory.mktemp("hopkinson")
    one, two = measured(1e-6)
    bit = 4e-3 / 2**14
    random = np.random.default_rng(1)
    lines = ["time_us,microstrain_incident,microstrain_transmitted"]
    for time, *strains in zip(one.time, one.values, two.values, strict=True):
        cells = [1e6 * bit * round((strain + random.normal(0.0, 2e-6)) / bit) for strain in strains]
        lines.append(f"{1e6 * time:.3f},{cells[0]:.6g},{cells[1]:.6g}")
    (folder / "record.csv").write_text("\n".join(lines) + "\n")
    (folder / "bars.toml").write_text(BARS)
    return folder


def call(files, *arguments):
    return ("hopkinson", str(files / "record.csv"), "--bars", str(files / "bars.toml"), *arguments)


def test_the_record_gives_the_law(capsys, files, tmp_path):
    series = tmp_path / "curve.csv"
    found = json.loads(answer(capsys, *call(files, "--json", "--series", str(series))))
    assert found.keys() == KEYS and found["stress_strain"].keys() == CURVES
    curves = {name: np.array(values) for name, values in found["stress_strain"].items()}
    inner = (curves["time"] > 12e-6) & (curves["time"] < 100e-6)
    noise = found["uncertainty"]["stress_one_wave"]
    apart = curves["stress_one_wave"] - law_stress(curves["strain"])
    assert np.abs(apart[inner]).max() < 4.0 * noise + 2e9 * 1050.0 * 1e-6
    assert curves["stress_three_waves"] == approx(0.5 * (curves["stress_one_wave"] + curves["stress_two_waves"]))
    assert found["notes"] == [] and found["loading"] == "compression" and found["equilibrium"] < 0.03
    with series.open() as lines:
        rows = list(csv.DictReader(lines))
    assert len(rows) == curves["time"].size
    assert [float(row["stress_Pa"]) for row in rows] == approx(curves["stress"])
    assert [float(row["strain_rate_per_s"]) for row in rows] == approx(curves["strain_rate"])


def test_the_report_has_results_and_windows(capsys, files):
    said = answer(capsys, *call(files))
    assert "strain rate, mean" in said and "±" in said and "um/m" in said and "begin at" in said
    assert answer(capsys, *call(files, "--waves", "3")) != said


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--waves", "4"), "--waves: got '4'; allowed: '1', '2', '3'"),
        (("--sign", "2"), "--sign: got '2'"),
        (("--start", "soon"), "--start: got 'soon'; allowed: a number"),
        (("--start", "5"), "--start: got 5.0; allowed: a number from 0 to"),
        (("--window", "1"), "--window: got 1.0; allowed: a number from"),
        (("--kind", "force"), "force"),
        (("--columns", "time_us,microstrain"), "Row 2 of the record has 3 cells"),
        (("--series", "x.txt"), "--series"),
    ],
)
def test_a_wrong_option_is_named(capsys, files, arguments, said):
    assert said in refusal(capsys, *call(files, *arguments))


def test_files_that_cannot_be_used(capsys, files, tmp_path):
    record, bars = str(files / "record.csv"), str(files / "bars.toml")
    assert "--bars: got" in refusal(capsys, "hopkinson", record, "--bars", str(tmp_path / "none.toml"))
    assert "no file" in refusal(capsys, "hopkinson", str(tmp_path / "none.csv"), "--bars", bars)
    assert "--bars" in refusal(capsys, "hopkinson", record)
    wrong = tmp_path / "bars.toml"
    wrong.write_text(BARS.replace("gauge = 0.75", "gauge = 0.2"))
    said = refusal(capsys, "hopkinson", record, "--bars", str(wrong))
    assert said.startswith("impact: incident.gauge: got 0.2; allowed: a distance") and "0.258 m" in said
    wrong.write_text(BARS.replace("[specimen]\nlength = 0.0113", "[specimen]\nlenth = 0.0113"))
    said = refusal(capsys, "hopkinson", record, "--bars", str(wrong))
    assert "specimen.lenth: got 0.0113; allowed: no such key" in said
    one = tmp_path / "one.csv"
    one.write_text("\n".join(line.rsplit(",", 1)[0] for line in (files / "record.csv").read_text().splitlines()))
    assert "one column of strain" in refusal(capsys, "hopkinson", str(one), "--bars", bars)
    lines = (files / "record.csv").read_text().splitlines()
    one.write_text("\n".join([*lines[:300], lines[300].rsplit(",", 1)[0], *lines[301:]]))
    assert "Row 301 of the record has 2 cells" in refusal(capsys, "hopkinson", str(one), "--bars", bars)
    one.write_text("\n".join(lines[:300]))
    assert "must go on beyond" in refusal(capsys, "hopkinson", str(one), "--bars", bars)


def test_histories_that_were_solved_and_saved_are_a_record(capsys, tmp_path):
    """The elastic specimen of the scene: 70 GPa."""
    saved, bars = tmp_path / "split.csv", tmp_path / "bars.toml"
    answer(capsys, "solve", "split-hopkinson", "--series", str(saved), "--at", "0.5", "--at", "1.51")
    bar = 'length = 1.0\ndiameter = 0.02\nmaterial = "steel"\ngauge = 0.5\n'
    bars.write_text(f"[incident]\n{bar}[transmitted]\n{bar}[specimen]\nlength = 0.01\ndiameter = 0.008\n")
    found = json.loads(answer(capsys, "hopkinson", str(saved), "--bars", str(bars), "--json"))
    curves = {name: np.array(values) for name, values in found["stress_strain"].items()}
    inner = (curves["time"] > 60e-6) & (curves["time"] < 115e-6)
    modulus = curves["stress_three_waves"][inner] / curves["strain"][inner]
    assert modulus == approx(70e9, rel=0.012)  # half a step of 0.6 us at 700 1/s, beside a strain of 1.7 %
    assert found["peak_stress"] == approx(1.2709e9, rel=1e-4) and found["striker"] is None


def test_volts_of_an_amplifier(capsys, files, tmp_path):
    """Two lines before the table, and 2 mV for each microstrain."""
    _, *rows = (files / "record.csv").read_text().splitlines()
    cells = [[float(cell) for cell in row.split(",")] for row in rows]
    volts = [f"{time:g},{2e-3 * one:.8g},{2e-3 * two + 0.1:.8g}" for time, one, two in cells]
    path = tmp_path / "volts.csv"
    path.write_text("\n".join(["Scope", "4 channels", "time_us,CH1,transmitted", *volts]))
    given = ("hopkinson", str(path), "--bars", str(files / "bars.toml"), "--skip", "2", "--json")
    found = json.loads(answer(capsys, *given, "--scale", "CH1=5e-4", "--scale", "transmitted=5e-4:-5e-5"))
    own = json.loads(answer(capsys, *call(files, "--json")))
    assert found["strain_rate"] == approx(own["strain_rate"], rel=1e-6)
    assert found["gauges"]["transmitted"]["offset"] == approx(own["gauges"]["transmitted"]["offset"], abs=1e-9)
    for word, said in (
        ("CH1", "NAME=FACTOR"),
        ("CH1=x", "NAME=FACTOR"),
        ("CH9=1", "CH1, transmitted"),
        ("=2", "NAME=FACTOR"),
    ):
        assert said in refusal(capsys, *given, "--scale", word)
    assert "--skip: got 'few'" in refusal(capsys, *given[:4], "--skip", "few")
