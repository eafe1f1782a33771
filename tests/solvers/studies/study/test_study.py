"""A study is what single solves say, whoever solves it, in whichever order, however often it is interrupted."""

import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray
from pytest import approx
from scipy import stats

import solvers
from solvers import SceneError, study
from solvers.notebook.datasets import read_study
from solvers.notebook.study_tables import lines, rows, summary
from solvers.studies.figures import FIGURES, USUAL
from solvers.studies.study import crew as crew_of
from solvers.studies.study import work
from solvers.studies.study.crew import Spans
from solvers.studies.study.parts import Parts, left_of
from solvers.studies.study.work import CRASHED, FAILED

VARY = {"impactor.velocity": [0.5, 1.0, 2.0], "contact.law": ["rigid", "hertz", "nonsense"]}
ROD = {"impactor.mass": "0.5..5:6", "impactor.velocity": [1.0, 2.0]}
WORKER = """
import sys, solvers
solvers.study("bronze-rod-steel-ball", {"impactor.velocity": "0.5..3:4000"}, out=sys.argv[1], workers=2, resume=True)
"""


def same(a: xarray.Dataset, b: xarray.Dataset) -> bool:
    """But for who solved it when."""
    return all(
        np.array_equal(a[name].values.astype(str), b[name].values.astype(str)) for name in (*a.data_vars, *a.coords)
    )


def test_every_point_is_a_solve_of_its_own():
    found = study("bronze-rod-steel-ball", VARY, figures=[*USUAL, "peak_stress"], workers=2)
    assert found.sizes == {"impactor.velocity": 3, "contact.law": 3}
    for speed in VARY["impactor.velocity"]:
        for law in ("rigid", "hertz"):
            scene = solvers.load("bronze-rod-steel-ball").replace({"impactor.velocity": speed, "contact.law": law})
            solution, point = solvers.solve(scene), found.sel({"impactor.velocity": speed, "contact.law": law})
            for name, (unit, of) in FIGURES.items():
                if name in point:
                    expected = np.nan if (value := of(solution)) is None else value
                    assert float(point[name]) == approx(expected, rel=0, abs=0, nan_ok=True), name
                    assert point[name].attrs["units"] == unit
            assert str(point.notes.values) == " ".join(dict.fromkeys(note.code for note in solution.notes))
            assert str(point.refused.values) == str(point.reason.values) == ""
    refused = found.sel({"contact.law": "nonsense"})
    assert (refused.refused == "allowed.choice").all() and np.isnan(refused.peak_force).all()
    assert "contact.law: got 'nonsense'" in str(refused.reason.values[0])
    scene = solvers.load("bronze-rod-steel-ball")
    given = tomllib.loads(found.attrs["scene"])
    assert solvers.Scene.from_table(given) == scene
    assert given == {name: table for name, table in scene.given.items() if name != "view"}  # and nothing that follows
    assert found["impactor.velocity"].attrs["units"] == "m/s" and "Strikewave" in found.attrs["version"]


def test_in_bulk_it_is_the_same_to_rounding():
    quick, slow = (study("fixed-rod", ROD, notes=notes, workers=1) for notes in (False, True))
    for name in USUAL:
        scale = float(np.nanmax(np.abs(slow[name]))) if not np.isnan(slow[name]).all() else 1.0
        if name not in ("energy_error", "momentum_error", "estimated_error"):  # which are rounding themselves
            assert quick[name].values == approx(slow[name].values, rel=1e-9, abs=1e-9 * scale, nan_ok=True), name


def test_nothing_hangs_on_who_solves_it():
    one, three = (study("free-rod", {"impactor.mass": "0.1..9:40"}, workers=count, seed=2) for count in (1, 3))
    assert same(one, three)


def test_a_method_that_is_compared_is_a_dimension():
    found = study("fixed-rod", {"method.name": ["waves", "modal", "rigid"], "impactor.velocity": [1.0, 2.0]})
    exact, modal = (found.peak_force.sel({"method.name": name}).values for name in ("waves", "modal"))
    assert exact[1] == approx(2.0 * exact[0], rel=1e-12) and (modal != exact).all()
    assert modal == approx(exact, rel=0.3) and (found.refused == "").all()  # it ripples behind a front


def test_what_fails_is_recorded_and_the_others_are_solved(monkeypatch):
    def figures_of(solution, names):
        if solution.scene.impactor.velocity == 2.0:
            raise ZeroDivisionError("by nothing")
        return [1.0] * len(names)

    monkeypatch.setattr(work, "figures_of", figures_of)
    found = study("fixed-rod", {"impactor.velocity": [1.0, 2.0, 3.0]}, workers=2)
    assert found.refused.values.tolist() == ["", FAILED, ""]
    assert str(found.reason.values[1]) == "ZeroDivisionError: by nothing"


@pytest.mark.skipif(sys.platform != "linux", reason="its workers know what is patched here as copies of this process")
def test_a_point_that_ends_its_process_is_found_and_left(monkeypatch):
    def figures_of(solution, names):
        if solution.scene.impactor.velocity in (2.0, 17.0):
            os.kill(os.getpid(), signal.SIGKILL)
        return [solution.scene.impactor.velocity] * len(names)

    monkeypatch.setattr(work, "figures_of", figures_of)
    found = study("fixed-rod", {"impactor.velocity": [float(k) for k in range(1, 31)]}, workers=2)
    bad = [k for k, code in enumerate(found.refused.values.tolist(), 1) if code]
    assert bad == [2, 17] and set(found.refused.values[[1, 16]].tolist()) == {CRASHED}
    assert np.nansum(found.peak_force.values) == sum(range(1, 31)) - 19


@pytest.mark.parametrize("ending", [".nc", ".zarr", ".parquet", ".csv"])
def test_a_file_has_all_of_it(tmp_path, ending):
    path = tmp_path / f"map{ending}"
    found = study("bronze-rod-steel-ball", VARY, out=path, workers=1)
    again = read_study(path)
    assert [each.name for each in tmp_path.iterdir() if not each.name.startswith("map")] == []
    assert again.attrs == found.attrs and not (tmp_path / f"map{ending}.parts").exists()
    for name in found.data_vars:
        a, b = (each[name].values.ravel() for each in (found, again))
        assert a.astype(str).tolist() == b.astype(str).tolist() or b == approx(a, rel=1e-15, nan_ok=True), name
    assert again["impactor.velocity"].values.tolist()[:3] in ([0.5, 1.0, 2.0], [0.5, 0.5, 0.5])
    resumed = study("bronze-rod-steel-ball", VARY, out=path, resume=True)
    assert resumed.attrs == found.attrs


def test_a_study_that_was_cancelled_goes_on(tmp_path):
    path, solved = tmp_path / "map.nc", []

    def stop():
        return bool(solved) and solved[-1].done >= 10

    vary = {"impactor.velocity": "0.5..3:400"}
    part = study("bronze-rod-steel-ball", vary, out=path, workers=1, progress=solved.append, cancelled=stop)
    there = int((part.refused == "").sum())
    assert 10 <= there < 400 and int((part.refused == "not-solved").sum()) == 400 - there and not path.exists()
    with pytest.raises(SceneError, match="resume"):
        study("bronze-rod-steel-ball", vary, out=path)
    with pytest.raises(SceneError, match="differs in: design, figures"):
        study("bronze-rod-steel-ball", {"impactor.velocity": "0.5..3:401"}, figures=["impulse"], out=path, resume=True)
    seen = []
    whole = study("bronze-rod-steel-ball", vary, out=path, resume=True, workers=2, progress=seen.append)
    assert seen[0].done == seen[0].resumed == there and seen[-1].done == 400
    assert same(whole, study("bronze-rod-steel-ball", vary, workers=2)) and path.exists()
    with pytest.raises(SceneError, match="a name that is new"):
        study("bronze-rod-steel-ball", vary, out=path)


def runs(pid: str) -> bool:
    """Whether there is such a process that has not ended, if only unheard of by its parent."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="by /proc")
def test_killed_in_the_middle_nothing_is_lost_and_no_worker_stays(tmp_path):
    path = tmp_path / "map.csv"
    parts = tmp_path / "map.csv.parts"
    begun = subprocess.Popen([sys.executable, "-c", WORKER, str(path)])
    deadline = time.monotonic() + 120
    while len(list(parts.glob("*.npz"))) < 4:
        assert time.monotonic() < deadline and begun.poll() is None
        time.sleep(0.02)
    workers = Path(f"/proc/{begun.pid}/task/{begun.pid}/children").read_text().split()
    begun.kill()
    begun.wait()
    there = Parts(parts).spans()
    kept = {path.name: path.stat().st_mtime_ns for path in parts.glob("*.npz")}
    assert workers and there
    while any(runs(pid) for pid in workers):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    done = sum(stop - start for start, stop in Parts(parts).spans())
    seen = []
    found = study(
        "bronze-rod-steel-ball", {"impactor.velocity": "0.5..3:4000"}, out=path, resume=True, progress=seen.append
    )
    assert seen[0].resumed == done >= sum(stop - start for start, stop in there) and kept
    assert (found.refused == "").all() and not parts.exists()


def test_what_goes_to_other_processes_is_the_same_there():
    made = work.Work(solvers.load("four-bar"), ("impactor.mass",), ("impulse",), solvers.Modal(modes=3), False, True)
    there = pickle.loads(pickle.dumps(made))
    fields = ("keys", "figures", "method", "notes", "trusted")
    assert [getattr(there, name) for name in fields] == [getattr(made, name) for name in fields]
    assert there.scene.given == made.scene.given


@pytest.mark.parametrize("name", ["four-bar", "newtons-cradle", "drop-test", "bent-rods", "hammer-on-cantilever"])
def test_scenes_of_every_kind_go_to_other_processes(name):
    found = study(name, {"impactor.velocity": [0.9, 1.1]}, figures=["impactor_velocity"], workers=1)
    for speed in (0.9, 1.1):
        solution = solvers.solve(solvers.load(name).replace({"impactor.velocity": speed}))
        assert float(found.impactor_velocity.sel({"impactor.velocity": speed})) == solution.impactor_velocity


def test_parts_that_are_damaged_are_named(tmp_path):
    parts, path = tmp_path / "map.nc.parts", tmp_path / "map.nc"
    vary = {"impactor.velocity": [1.0, 2.0]}
    parts.mkdir()
    (parts / "about.json").write_text("{")
    with pytest.raises(SceneError, match="differs in: scene, design"):
        study("fixed-rod", vary, out=path, resume=True)
    (parts / "about.json").unlink()
    (parts / "notes-of-mine.npz").write_text("no part")
    with pytest.raises(SceneError, match="folder or file of somebody else"):
        study("fixed-rod", vary, out=path)
    (parts / "notes-of-mine.npz").unlink()
    study("fixed-rod", vary, out=path, cancelled=lambda: True)
    (parts / "notes-of-mine.npz").write_text("no part")
    (parts / f"{0:012d}-{1:012d}.npz").write_text("nor this")
    with pytest.raises(SceneError, match="delete this one"):
        study("fixed-rod", vary, out=path, resume=True)
    (parts / f"{0:012d}-{1:012d}.npz").unlink()
    assert (study("fixed-rod", vary, out=path, resume=True).refused == "").all()
    assert [each.name for each in parts.iterdir()] == ["notes-of-mine.npz"]  # what is not its own stays


def test_a_full_disk_ends_it_and_keeps_what_is_there(tmp_path, monkeypatch):
    path, keep, kept = tmp_path / "map.nc", Parts.keep, []

    def full(self, span, part):
        if len(kept) == 2:
            raise OSError(28, "No space left on device")
        kept.append(span)
        keep(self, span, part)

    monkeypatch.setattr(Parts, "keep", full)
    vary = {"impactor.velocity": "0.5..3:60"}
    with pytest.raises(OSError, match="No space"):
        study("bronze-rod-steel-ball", vary, out=path, workers=1)
    assert Parts(tmp_path / "map.nc.parts").spans() == sorted(kept)
    monkeypatch.undo()
    assert (study("bronze-rod-steel-ball", vary, out=path, resume=True).refused == "").all()


@pytest.mark.parametrize(
    "options, said",
    [
        ({"out": "map.txt"}, "'.nc', '.zarr', '.parquet', '.csv'"),
        ({"out": "nowhere/map.nc"}, "a folder that is there"),
        ({"resume": True}, "without a file"),
        ({"workers": 0}, "whole number from 1"),
        ({"figures": ["nonsense"]}, "'peak_force'"),
        ({"seed": -1}, "whole number from 0"),
        ({"method": "nonsense"}, "method.name"),
        ({"vary": {"impactor.colour": ["red", "blue"]}}, "no such key"),
        ({"vary": {"method.modes": [10, 20]}, "method": "modal"}, "nothing beside method.modes"),
        ({"vary": {"method.name": ["waves", "modal"]}, "method": "quasi-static"}, "nothing beside method.name"),
        ({"vary": {"method": [{"name": "waves"}]}, "method": solvers.Waves()}, "nothing beside method"),
        ({"vary": {"peak_force": [1.0]}, "figures": ["peak_force"]}, "no such key"),
    ],
)
def test_what_is_refused_before_any_is_solved(tmp_path, monkeypatch, options, said):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SceneError) as refused:
        study("fixed-rod", **{"vary": {"impactor.velocity": [1.0, 2.0]}} | options)
    assert said in str(refused.value) and list(tmp_path.iterdir()) == []


def test_where_a_key_is_known_at_some_points_the_others_say_so():
    """Modes are no option of exact waves."""
    found = study("fixed-rod", {"method.name": ["waves", "modal"], "method.modes": [10, 20]}, figures=["peak_force"])
    assert (found.refused.sel({"method.name": "waves"}) == "allowed.key").all()
    for modes in (10, 20):
        solution = solvers.solve("fixed-rod", method="modal", modes=modes)
        assert float(found.peak_force.sel({"method.name": "modal", "method.modes": modes})) == solution.peak_force


def test_methods_with_options_of_their_own_are_tables(tmp_path):
    given = [{"name": "waves"}, {"name": "modal", "modes": 20}]
    for ending in (".nc", ".csv"):
        found = study("fixed-rod", {"method": given}, figures=["peak_force"], out=tmp_path / f"map{ending}")
        assert found["method"].values.tolist() == ['{"name": "waves"}', '{"name": "modal", "modes": 20}']
        assert float(found.peak_force[1]) == solvers.solve("fixed-rod", method="modal", modes=20).peak_force


def test_words_and_numbers_of_one_key_are_kept(tmp_path):
    found = study("fixed-rod", {"impactor.mass": [1, "two", 3]}, figures=["peak_force"], out=tmp_path / "map.nc")
    assert found["impactor.mass"].values.tolist() == ["1", "two", "3"]
    assert found.refused.values.tolist() == ["", "allowed.number", ""]


def test_bodies_in_space_are_refused():
    name = next(name for name in solvers.scene_names() if solvers.load(name).normal is not None)
    with pytest.raises(SceneError, match="bodies on an axis"):
        study(name, {"contact.friction": [0.1, 0.2]})


def _in_a_pool(count: int) -> float:
    return float(study("fixed-rod", {"impactor.mass": [1.0, 2.0]}, workers=count).peak_force.sum())


@pytest.mark.skipif(sys.platform != "linux", reason="by copies of this process")
def test_a_process_that_may_have_none_solves_it_itself():
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply(_in_a_pool, (2,)) == _in_a_pool(1)


def test_another_distribution_is_another_study(tmp_path):
    path = tmp_path / "map.nc"
    first, second = (stats.rv_histogram(([1, 2], [low, low + 0.1, low + 0.2])) for low in (1.0, 2.0))
    study("fixed-rod", {"impactor.mass": first}, points=5, out=path)
    with pytest.raises(SceneError, match="differs in: design"):
        study("fixed-rod", {"impactor.mass": second}, points=5, out=path, resume=True)
    assert study("fixed-rod", {"impactor.mass": first}, points=5, out=path, resume=True).sizes == {"point": 5}


def test_what_is_left_is_what_was_not_done():
    assert left_of(10, []) == [(0, 10)] and left_of(10, [(0, 10)]) == []
    assert left_of(10, [(0, 2), (2, 3), (5, 9)]) == [(3, 5), (9, 10)]
    spans = Spans([(0, 5), (7, 9)])
    assert [spans.take(3), spans.take(3), spans.take(3), spans.take(3)] == [(0, 3), (3, 5), (7, 9), None]


def test_parts_grow_to_what_half_a_second_holds(monkeypatch):
    sizes = []
    submit = crew_of.Processes.submit
    monkeypatch.setattr(crew_of.Processes, "submit", lambda self, w, r: sizes.append(len(r)) or submit(self, w, r))
    study("fixed-rod", {"impactor.velocity": "0.5..3:5000"}, notes=False, workers=1)
    assert sizes[0] == 1 and max(sizes) > 100 and sum(sizes) == 5000


def test_in_a_few_lines_it_says_how_far_figures_reach_and_where():
    found = study("bronze-rod-steel-ball", VARY, figures=["peak_force", "contacts"])
    known = summary(found)
    assert (known["points"], known["solved"], known["refused"], known["waiting"]) == (9, 6, 3, 0)
    high = known["figures"]["peak_force"]["highest"]
    assert high["value"] == float(np.nanmax(found.peak_force)) and high["at"]["impactor.velocity"] == 2.0
    (refused,) = known["refusals"]
    assert refused["code"] == "allowed.choice" and refused["points"] == 3
    assert refused["at"] == {"impactor.velocity": 0.5, "contact.law": "nonsense"}
    said = lines(found, known)
    assert "9 points (impactor.velocity 3 x contact.law 3): 6 solved, 3 refused" in said
    assert "3 points refused, the first at impactor.velocity=0.5, contact.law=nonsense" in said
    first = solvers.solve(
        solvers.load("bronze-rod-steel-ball").replace({"impactor.velocity": 0.5, "contact.law": "rigid"})
    )
    (note,) = (note for note in first.notes if note.code == "pulse-short")
    assert known["sentences"]["pulse-short"] == str(note) and f"with the note pulse-short, as the first: {note}" in said
    assert json.loads(json.dumps(rows(found), allow_nan=False))[2]["peak_force"] is None
