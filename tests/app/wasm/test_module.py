"""The kernels that browsers have: of today's sources, and equal to those of this machine."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.wasm.entries import room
from app.wasm.module import MODULE, named_in, signed, sources
from solvers import Waves
from solvers.numerics.waves.rigid_drawn import LEAST_JUMP
from solvers.scenes.library import scene_of

from . import native

HERE = Path(__file__).parent
RANDOM = np.random.default_rng(41)
IMPACTS = [
    *((float(beta), side) for beta in (1e-3, 0.02, 0.25, 1.0, 4.0, 50.0, 1e3) for side in (1.0, -1.0)),
    *((float(10.0**power), float(RANDOM.choice([1.0, -1.0]))) for power in RANDOM.uniform(-1.7, 1.7, 300)),
]


def answers(module: Path) -> list[dict]:
    command = ["node", HERE / "answers.mjs", module, MODULE.with_name("kernels.js")]
    given = json.dumps(IMPACTS)
    return json.loads(subprocess.run(command, input=given, capture_output=True, text=True, check=True).stdout)


def test_the_module_is_of_todays_sources():
    assert named_in(MODULE.read_bytes()) == sources(), "make wasm"
    assert MODULE.with_name("room.js").read_text("utf-8") == room(), "make wasm"


def test_a_module_names_its_sources():
    assert named_in(signed(b"code")) == sources()
    assert named_in(b"code") == ""


@pytest.mark.parametrize("name", ["fixed-rod", "free-rod"])
@pytest.mark.parametrize("ratio", [0.05, 0.25, 1.0, 4.0])
def test_what_is_drawn_is_the_exact_solution(name, ratio):
    scene = scene_of(name)
    scene = scene.with_impactor_mass(scene.target.mass / ratio)
    solution, trip = Waves().solve(scene), scene.time_unit
    motion, length = solution.known_motion, scene.speed * trip
    found = native.rod(scene.mass_ratio, 1.0 if scene.target.held else -1.0)
    assert found is not None
    time = np.linspace(0.0, solution.duration, len(found["mass"]))
    assert np.allclose(found["mass"], motion.impactor_position(time) / length, atol=1e-13)
    assert np.allclose(found["end"], motion.end_position(time) / length, atol=1e-13)
    fine = np.linspace(0.0, solution.duration, 20_001)
    speed = motion.rigid_velocity(fine) / scene.speed
    moved = np.concatenate(([0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1])) * (fine[1] / trip)))
    assert np.allclose(found["whole"], np.interp(time, fine, moved), atol=(time[1] / trip) ** 2)
    at, force = np.array(found["force_time"]), np.array(found["force"])
    unit = scene.target.impedance * scene.speed
    either = [motion.force(at * trip, after) / unit for after in (False, True)]
    assert np.minimum(*(np.abs(force - each) for each in either)).max() < 1e-12
    twice = np.flatnonzero(np.diff(at) == 0.0)
    assert np.abs(np.diff(force)[twice]).min() > LEAST_JUMP  # a jump, with both its values
    assert found["contacts"][3::6] == pytest.approx(_left(solution), abs=1e-13)


def _left(solution) -> list[float]:
    ends = np.array([contact.end for contact in solution.contacts])
    return (solution.known_motion.impactor_velocity(ends) / solution.scene.speed).tolist()


@pytest.mark.browser  # needs Node
def test_a_browser_finds_what_this_machine_finds():
    _equal(answers(MODULE))


@pytest.mark.browser  # takes a minute, and needs Node
def test_the_module_can_be_built_again(tmp_path):
    built = tmp_path / "kernels.wasm"
    command = [sys.executable, "-m", "app.wasm.build", built]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    _equal(answers(built))


def _equal(found: list[dict]) -> None:
    """To rounding: now and then the exponential of musl and that of this machine differ in the last bit."""
    assert len(found) == len(IMPACTS)
    for (beta, side), here in zip(IMPACTS, found, strict=True):
        there = native.rod(beta, side)
        assert there is not None and here, (beta, side)  # nothing is beyond it at any mass ratio
        for name, values in there.items():
            assert here[name] == pytest.approx(values, rel=1e-12, abs=1e-13, nan_ok=True), (beta, side, name)
