"""Heads of saved histories: the scene comes back from them."""

import math
import tomllib

import numpy as np
import pytest

import solvers
from solvers import Scene, SceneError
from solvers.records.files import load_record
from solvers.scenes.saved import as_toml, commented, saved_head
from tests.catalog import SCENES


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_is_written_and_read_again(name):
    table = SCENES[name].table()
    again = Scene.from_table(tomllib.loads(as_toml(table)))
    assert again.table() == table


def test_words_that_no_line_could_hold_are_written_all_the_same():
    odd = {"title": 'a "b"\n\\ \x7f µ', "a b": {"x": [1, 2.0, math.inf, True, {"y": -1e-30}], "left out": None}}
    assert tomllib.loads(as_toml(odd)) == odd | {"a b": {"x": odd["a b"]["x"]}}


def test_a_saved_table_is_a_scene_and_its_method(tmp_path):
    scene = solvers.load("fixed-rod").replace({"target.length": 0.45, "impactor.mass": 0.7})
    solution = solvers.solve(scene, "modal", modes=12)
    methods = {"waves": {"name": "waves", "steps": None}, "modal": solution.method}
    path = tmp_path / "saved.csv"
    path.write_text(commented(saved_head(scene, solution.method, solution.duration, methods)) + "time_s,force_N\n0,1\n")
    found = solvers.load(path)
    method = {key: value for key, value in solution.method.items() if value is not None}
    assert found.table() == scene.replace({"method": {**method, "duration": solution.duration}}).table()
    again = solvers.solve(found)
    assert (again.duration, again.impactor_velocity) == (solution.duration, solution.impactor_velocity)
    assert '# methods = { waves = { name = "waves" }, modal = {' in path.read_text()


def test_a_table_without_a_scene_is_refused(tmp_path):
    path = tmp_path / "measured.csv"
    path.write_text("# at the bridge, in June\ntime_s,force_N\n0,1\n")
    with pytest.raises(SceneError, match="scene"):
        solvers.load(path)


HEAD = "# [saved]\ntime_s,force_waves_N,force_modal_N,compression_waves_at_150_mm_Pa\n"


def saved(tmp_path, time, head=HEAD):
    path = tmp_path / "saved.csv"
    rows = "".join(f"{t},{math.sin(3e4 * t)},0,{2 * t}\n" for t in time)
    path.write_text(head + rows)
    return path


def test_saved_histories_are_a_record_without_a_question(tmp_path):
    path = saved(tmp_path, np.linspace(0.0, 1e-4, 50))
    record = load_record(path)
    assert (record.kind, record.place) == ("force", None)
    assert record.values == pytest.approx(np.sin(3e4 * record.time))
    stress = load_record(path, kind="stress")
    assert stress.place == pytest.approx(0.15) and stress.shifted(1e-6).scaled(2.0).place == stress.place
    measured = saved(tmp_path, np.linspace(0.0, 1e-4, 50), HEAD.replace("# [saved]\n", ""))
    with pytest.raises(SceneError, match="kind"):
        load_record(measured)


def test_histories_with_jumps_and_steps_of_their_own_are_a_record(tmp_path):
    time = np.sort(np.concatenate([np.geomspace(1e-8, 1e-4, 80), [0.0, 2e-5, 2e-5]]))
    record = load_record(saved(tmp_path, time))
    assert np.ptp(np.diff(record.time)) < 1e-6 * record.step
    assert record.values == pytest.approx(np.sin(3e4 * record.time), abs=0.01)


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_is_written_as_a_file_that_is_read_back(name, tmp_path):
    (tmp_path / "scene.toml").write_text(solvers.to_toml(SCENES[name]), encoding="utf-8")
    assert solvers.load(tmp_path / "scene.toml").table() == SCENES[name].table()
