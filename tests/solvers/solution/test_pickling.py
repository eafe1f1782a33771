"""Solutions go from one process to another, whole: what pools of processes need, and what is kept in files."""

import copy
import importlib
import pickle
import subprocess
import sys

import numpy as np
import pytest

import solvers
from solvers import SceneError
from solvers.solution import closures
from tests.catalog import SCENES

CASES = [
    ("fixed-rod", method) for method in ("waves", "modal", "fe-nodal", "fe-modal", "mode-switch", "balance", "rigid")
] + [
    ("bronze-rod-steel-ball", "quasi-static"),
    *((name, None) for name in ("table-8.4", "four-bar", "four-bar-moves", "trip-hammer", "rotating-bar", "table-6.6")),
    *((name, None) for name in ("figure-10.11", "brick-off-centre", "newtons-cradle", "pressure-bar", "rod-with-gap")),
]


@pytest.mark.parametrize("name, method", CASES)
def test_what_is_pickled_is_the_same_solution(name, method):
    solution = solvers.solve(name, method)
    again = pickle.loads(pickle.dumps(solution))
    assert again.table() == solution.table() and repr(again) == repr(solution)
    assert again.scene == solution.scene and hash(again.scene) == hash(solution.scene)
    if solution.motion is not None:
        time = np.linspace(0.0, solution.duration, 30)
        places = np.linspace(0.0, solution.scene.target.length, 5)
        for what in ("force", "impulse", "impactor_position", "end_position", "rigid_velocity"):
            assert getattr(again.motion, what)(time).tolist() == getattr(solution.motion, what)(time).tolist()
        if places[-1]:
            stress = again.known_motion.stress(time, places), solution.known_motion.stress(time, places)
            assert np.array_equal(*stress, equal_nan=True)


def test_another_process_reads_it(tmp_path):
    solution = solvers.solve("table-8.4")
    (tmp_path / "solution").write_bytes(pickle.dumps(solution))
    script = "import pickle, sys; print(repr(pickle.load(open(sys.argv[1], 'rb')).motion.end_position(1e-4)))"
    call = [sys.executable, "-c", script, str(tmp_path / "solution")]
    said = subprocess.run(call, capture_output=True, text=True, check=True).stdout
    assert said.strip() == repr(solution.known_motion.end_position(1e-4))


def test_what_other_code_has_pickled_is_refused(monkeypatch):
    known = pickle.dumps(solvers.solve("table-8.4"))
    monkeypatch.setattr(closures, "_codes", lambda module: [])
    with pytest.raises(SceneError, match="a solution that this version of the library pickled"):
        pickle.loads(known)


def test_every_scene_can_be_a_key():
    assert len({scene: name for name, scene in SCENES.items()}) == len(SCENES)
    assert hash(solvers.load("fixed-rod")) == hash(SCENES["fixed-rod"])


def test_functions_of_others_are_refused_as_ever():
    with pytest.raises((AttributeError, pickle.PicklingError)):
        closures.written(lambda: None)


def test_a_function_that_holds_itself(monkeypatch, tmp_path):
    """As one that calls itself does."""
    (tmp_path / "powers_of.py").write_text(
        "def powers(base):\n    def power(n):\n        return 1 if n == 0 else base * power(n - 1)\n    return power\n"
    )
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(closures, "PACKAGE", "powers_of")
    powers = importlib.import_module("powers_of").powers
    assert closures.read(closures.written(powers(3)))(4) == 81


def test_a_copy_shares_the_motion_and_works_out_nothing(monkeypatch):
    monkeypatch.setattr(solvers.Modal, "_estimated_error", lambda *_: pytest.fail("worked out"))
    solution = solvers.solve("fixed-rod", "modal")
    other = copy.copy(solution)
    assert other.motion is solution.motion and other.peak_force == solution.peak_force
