"""The command `impact tradeoff`: a table to read, the same as JSON, and what there is when interrupted."""

import json
from dataclasses import replace

import pytest

import solvers
from app.command.main import main
from app.command.tradeoff import report
from solvers.accuracy import calibration, store
from tests.app.command.calls import answer, refusal

QUICK = ("tradeoff", "brick-off-centre")  # one closed form: measured in an instant


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))


def test_the_table_names_reference_machine_and_best_points():
    scene = solvers.load("bronze-rod-steel-ball")
    found = solvers.stored_tradeoff(scene)
    said = report(scene, found, "peak-force")
    assert "errors measured by  exact: travelling waves" in said
    assert found.machine["processor"] in said
    assert "mode-switch cannot: the contact must be rigid" in said
    rows = [line for line in said.splitlines() if " 1/1" in line]
    assert len(rows) == len(found.points)
    starred = {line.split()[1] for line in rows if line.startswith("  * ")}
    assert starred == {point.label.split()[0] for point in found.front("peak-force")}
    assert sum(line.startswith("  * ") for line in rows) == len(found.front("peak-force"))


def test_json_is_the_whole_table(capsys):
    found = json.loads(answer(capsys, *QUICK, "--json"))
    assert set(found) == {
        "scene", "quantities", "reference", "points", "refused", "remarks", "machine", "version", "date", "seconds",
        "stopped", "refused_codes", "remark_codes", "code", "calibration", "shipped", "changed", "scale",
    }  # fmt: skip
    (point,) = found["points"]
    assert point["method"]["name"] == "rigid" and "rebound" in point["best_for"]
    assert set(point["errors"]) == set(found["quantities"])
    again = json.loads(answer(capsys, *QUICK, "--json"))
    assert again == found  # from the cache
    assert json.loads(answer(capsys, *QUICK, "--json", "--fresh")) != found


def test_another_quantity_and_other_values(capsys):
    said = answer(capsys, *QUICK, "--quantity", "impulse", "--set", "impactor.mass=3.0")
    assert "Pareto-optimal in impulse" in said


def test_what_cannot_be_asked(capsys):
    assert "--quantity: got 'speed'; allowed: rebound" in refusal(capsys, *QUICK, "--quantity", "speed")
    assert "scene: got 'nowhere'" in refusal(capsys, "tradeoff", "nowhere")


def test_what_is_stored_says_where_its_times_are_from(capsys, monkeypatch):
    scene, there = solvers.load("free-rod"), {"python": 1e-3, "kernels": 2e-2, "algebra": 3e-2}
    known = store.shipped(scene) | {"calibration": there}
    known["machine"] = known["machine"] | {"processor": "Some processor"}
    monkeypatch.setattr(store, "shipped", lambda scene: known)
    said = answer(capsys, "tradeoff", "free-rod", "--stored")
    assert "times measured on   Some processor, " in said
    assert "came with the library, times as measured on another machine than this; 'impact calibrate'" in said
    monkeypatch.setattr(calibration, "known", lambda: there)
    assert "came with the library, times scaled to this machine" in answer(capsys, "tradeoff", "free-rod", "--stored")
    found = json.loads(answer(capsys, "tradeoff", "free-rod", "--stored", "--json"))
    assert found["shipped"] and found["scale"] == {"python": 1.0, "kernels": 1.0, "algebra": 1.0}
    named = solvers.stored_tradeoff(scene)
    assert "methods have changed since" in report(scene, replace(named, changed=["modal"]), "rebound")
    assert "methods have changed since" not in report(scene, replace(named, changed=[]), "rebound")


def test_a_scene_without_a_stored_table_is_refused(capsys):
    said = refusal(capsys, *QUICK, "--stored", "--set", "impactor.mass=3.1")
    assert said.startswith("impact: --stored: got ") and "without --stored it is measured" in said


def test_calibrate_measures_this_machine_and_keeps_it(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(solvers, "calibrate", lambda: calibration.calibrate(0.01))
    said = answer(capsys, "calibrate")
    assert [line.split()[0] for line in said.splitlines()[:3]] == ["Python", "kernels", "linear"]
    assert "Kept" in said and list(tmp_path.rglob("calibration-*.json"))
    found = json.loads(answer(capsys, "calibrate", "--json"))
    assert found["seconds"] == calibration.known() and "processor" in found["machine"]


def test_interrupted_it_prints_what_it_has(capsys, monkeypatch):
    known = solvers.stored_tradeoff(solvers.load("free-rod"))

    def interrupted(scene, progress, fresh):
        progress(known)
        raise KeyboardInterrupt

    monkeypatch.setattr(solvers, "tradeoff", interrupted)
    assert main(["tradeoff", "free-rod"]) == 130
    said = capsys.readouterr().out
    assert "not complete: interrupted" in said and "modal modes=50" in said


def test_interrupted_before_the_first_point(capsys, monkeypatch):
    def interrupted(scene, progress, fresh):
        raise KeyboardInterrupt

    monkeypatch.setattr(solvers, "tradeoff", interrupted)
    assert main(["tradeoff", "free-rod"]) == 130
    assert capsys.readouterr().err == "impact: stopped\n"
