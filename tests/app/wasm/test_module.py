"""The kernels that browsers have: of today's sources, and equal to those of this machine."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from app.wasm.entries import INSTANTS, KINDS, room
from app.wasm.module import MODULE, named_in, signed, sources
from solvers import Scene, Waves
from solvers.methods.waves.chain_scene import ChainScene
from solvers.numerics.waves.drawn import LEAST_JUMP
from solvers.scenes.library import scene_of

from . import native

HERE = Path(__file__).parent
RANDOM = np.random.default_rng(41)
RATIOS = (1e-3, 0.02, 0.25, 1.0, 4.0, 50.0, 1e3)
IMPACTS = [
    *((float(beta), side) for beta in RATIOS for side in (1.0, -1.0)),
    *((float(10.0**power), float(RANDOM.choice([1.0, -1.0]))) for power in RANDOM.uniform(-1.7, 1.7, 386)),
]
THROUGH_LAWS = 1_600
DRAWN_TOO = 40  # of them, the histories as well: they are long


def random_scene() -> Scene:
    """A mass that strikes a rod through a contact law, neither hard nor soft beyond what the page has."""
    kind = KINDS[RANDOM.integers(len(KINDS))]
    table = {"law": kind.NAME} | dict(kind.EXAMPLE)
    hardness = 10.0 ** RANDOM.uniform(-1.5, 1.5)
    table["stiffness"] = {"linear": 1e9, "kelvin-voigt": 1e9, "power": 1e9}.get(kind.NAME, 1e10) * hardness
    if "restitution" in kind.KEYS:
        table.pop("nominal_restitution", None)
        table["restitution"] = float(RANDOM.uniform(0.05, 1.0))
    scene = scene_of(str(RANDOM.choice(["fixed-rod", "free-rod"])))
    scene = scene.replace({"impactor.velocity": float(10.0 ** RANDOM.uniform(-1.0, 1.0))})
    ratio = 10.0 ** RANDOM.uniform(-1.5, 1.5)
    return scene.with_impactor_mass(scene.target.mass / ratio).replace({"contact": table})


def impact_of(scene: Scene, drawn: bool = False) -> list:
    given = ChainScene(scene)
    constants = given.kernel_laws()[2][0].tolist()
    return [scene.mass_ratio, 1.0 if scene.target.held else -1.0, scene.contact.NAME, constants, drawn]


def answers(module: Path, through: list[Scene]) -> tuple[list[dict], list[dict]]:
    command = ["node", HERE / "answers.mjs", module, MODULE.with_name("kernels.js")]
    given = {"rod": IMPACTS, "law": [impact_of(scene, number < DRAWN_TOO) for number, scene in enumerate(through)]}
    done = subprocess.run(command, input=json.dumps(given), capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    return found["rod"], found["law"]


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
    assert found["contacts"][3::5] == pytest.approx(_left(solution), abs=1e-13)


def _left(solution) -> list[float]:
    ends = np.array([contact.end for contact in solution.contacts])
    return (solution.known_motion.impactor_velocity(ends) / solution.scene.speed).tolist()


@pytest.mark.parametrize("name", ["fixed-rod", "free-rod"])
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.NAME)
def test_what_is_drawn_through_a_law_is_the_solution(name, kind):
    scene = scene_of(name).replace({"contact": {"law": kind.NAME} | dict(kind.EXAMPLE)})
    solution, trip = Waves().solve(scene), scene.time_unit
    found, motion, length = native.law(scene), solution.known_motion, scene.speed * scene.time_unit
    assert found is not None
    force, energy = scene.target.impedance * scene.speed, solution.energy
    impulse, final, target, apart, compressing, held, lost, deepest, dent = found["out"]
    assert impulse * force * trip == pytest.approx(solution.impulse, rel=1e-9)
    assert [final, target] == pytest.approx(
        [solution.impactor_velocity / scene.speed, solution.target_velocity / scene.speed], abs=1e-9
    )
    rebounds = solution.restitution
    assert apart == pytest.approx(rebounds["newton_at_contact"], abs=1e-8)
    if rebounds["poisson"] is not None:
        assert impulse / compressing - 1.0 == pytest.approx(rebounds["poisson"], abs=1e-8)
    rod = energy["target_rigid"] + energy["target_vibration"]
    assert held * force * length == pytest.approx(rod, abs=1e-9 * energy["initial"])
    assert lost * force * length == pytest.approx(energy["dissipated"], abs=1e-8 * energy["initial"])
    assert deepest * length == pytest.approx(solution.peak_indentation, rel=1e-9)
    assert dent * length == pytest.approx(solution.residual_indentation, abs=1e-8 * solution.peak_indentation)
    times = np.linspace(0.0, solution.duration, INSTANTS)
    assert found["mass"] == pytest.approx(motion.impactor_position(times) / length, abs=1e-9)
    assert found["end"] == pytest.approx(motion.end_position(times) / length, abs=1e-9)
    at, pressed = np.array(found["force_time"]), np.array(found["force"])
    either = [motion.force(at * trip, after) / force for after in (False, True)]
    assert np.minimum(*(np.abs(np.maximum(pressed, 0.0) - each) for each in either)).max() < 1e-7
    rows = np.array(found["contacts"]).reshape(-1, 5)
    known = [[c.start / trip, c.end / trip, c.impulse / force / trip, c.peak_force / force] for c in solution.contacts]
    assert rows[:, :4] == pytest.approx(np.array(known), rel=1e-8, abs=1e-9)


@pytest.mark.slow
@pytest.mark.browser  # needs Node
def test_a_browser_finds_what_this_machine_finds():
    _equal(MODULE, [random_scene() for _ in range(THROUGH_LAWS)])


@pytest.mark.slow
@pytest.mark.browser  # takes two minutes, and needs Node
def test_the_module_can_be_built_again(tmp_path):
    built = tmp_path / "kernels.wasm"
    command = [sys.executable, "-m", "app.wasm.build", built]
    done = subprocess.run(command, capture_output=True, text=True, timeout=500)
    assert done.returncode == 0, done.stderr
    _equal(built, [random_scene() for _ in range(DRAWN_TOO)])


def _equal(module: Path, through: list[Scene]) -> None:
    """To rounding where the wave is exact: now and then the exponential of musl and that of this machine differ in the
    last bit. Through a law to what the steps are allowed, which such a bit may make longer or shorter; where damping
    lets the force fade, the instant at which it ends is less sure than that.
    """
    rigid, by_laws = answers(module, through)
    assert (len(rigid), len(by_laws)) == (len(IMPACTS), len(through))
    for (beta, side), here in zip(IMPACTS, rigid, strict=True):
        there = native.rod(beta, side)
        assert there is not None and here, (beta, side)  # nothing is beyond it at any mass ratio
        for name, values in there.items():
            assert here[name] == pytest.approx(values, rel=1e-12, abs=1e-13, nan_ok=True), (beta, side, name)
    for scene, here in zip(through, by_laws, strict=True):
        there = native.law(scene)
        assert bool(here) == (there is not None), scene.table()  # the same are refused
        if "force" in here:
            for name in ("force", "wave"):
                here[name], there[name] = (_curve(found, name) for found in (here, there))
        for name in here.keys() - {"force_time", "wave_time"}:
            close, given = 1e-8 if name == "out" and not scene.contact.LOSSY else 1e-6, (impact_of(scene), name)
            assert here[name] == pytest.approx(there[name], rel=close, abs=close, nan_ok=True), given


def _curve(found: dict, name: str) -> list[float]:
    """A history at even times: whether the least of jumps stands twice is no matter."""
    time = np.array(found[f"{name}_time"])
    even = np.linspace(0.0, time[-1], 1_013)
    return np.interp(even, time, found[name]).tolist()
