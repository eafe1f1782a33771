"""The kernels that browsers have: of today's sources, and equal to those of this machine."""

import json
import subprocess
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import pytest

from app.messages.histories import struck_velocity
from app.wasm.entries import room
from app.wasm.entry import INSTANTS, KINDS
from app.wasm.modal_entries import BEAM_CONTACTS, BEAM_STEPS
from app.wasm.module import MODULE, named_in, signed, sources
from solvers import Modal, Scene, Waves
from solvers.methods.modal.motion import ModalMotion
from solvers.methods.waves.chain_scene import ChainScene
from solvers.numerics.modal_steps import steps_drawn
from solvers.numerics.waves.drawn import LEAST_JUMP
from solvers.scenes.library import scene_of

from . import native
from .answered import FIREFOX, Answers, apart, by_firefox, by_node

SEED = 41
RANDOM = np.random.default_rng(SEED)
RATIOS = (1e-3, 0.02, 0.25, 1.0, 4.0, 50.0, 1e3)
IMPACTS = [
    *((float(beta), side) for beta in RATIOS for side in (1.0, -1.0)),
    *((float(10.0**power), float(RANDOM.choice([1.0, -1.0]))) for power in RANDOM.uniform(-1.7, 1.7, 86)),
]
THROUGH_LAWS, ASKED_SHARE = 320, 0.2
BY_MODES, RIGID_SHARE, STIFF_SHARE = 140, 0.3, 0.3
MODES = (1, 5, 20, 50, 200, 400)
BEAMS = ("hammer-on-cantilever", "timoshenko-1913-short", "timoshenko-1913-long", "xylophone-bar", "xylophone-bar-node")
MOST_ATTACHED = 100
ACROSS, BEAM_MODES, FEW_CONTACTS = 80, (1, 5, 10, 30), 6
BETWEEN = 1e-3  # of the largest value: what straight lines between other instants differ by
NEARLY_FULL = 0.75  # of what there is room for: where rounding makes contacts, either may find some more of them
DRAWN_TOO = 40  # of them, the histories as well: they are long


@pytest.fixture(autouse=True)
def always_the_same():
    """The same impacts for a test, whichever ran before it."""
    global RANDOM
    RANDOM = np.random.default_rng(SEED)


def random_scene(names: Sequence[str] = ("fixed-rod", "free-rod")) -> Scene:
    """A mass that strikes one of these through a contact law, neither hard nor soft beyond what the page has."""
    kind = KINDS[RANDOM.integers(len(KINDS))]
    table = {"law": kind.NAME} | dict(kind.EXAMPLE)
    hardness = 10.0 ** RANDOM.uniform(-1.5, 1.5)
    table["stiffness"] = {"linear": 1e9, "kelvin-voigt": 1e9, "power": 1e9}.get(kind.NAME, 1e10) * hardness
    if "restitution" in kind.KEYS:
        table.pop("nominal_restitution", None)
        table["restitution"] = float(RANDOM.uniform(0.05, 1.0))
    scene = scene_of(str(RANDOM.choice(list(names))))
    scene = scene.replace({"impactor.velocity": float(10.0 ** RANDOM.uniform(-1.0, 1.0))})
    ratio = 10.0 ** RANDOM.uniform(-1.5, 1.5)
    return scene.with_impactor_mass(scene.target.mass / ratio).replace({"contact": table})


def random_time() -> float:
    """For how long an impact is to be followed [T], seldom; 0: until the bodies have parted."""
    return float(RANDOM.uniform(0.3, 4.0)) if RANDOM.uniform() < ASKED_SHARE else 0.0


def impact_of(scene: Scene, drawn: bool = False, asked: float = 0.0) -> list:
    constants = [] if scene.rigid_contact else ChainScene(scene).kernel_laws()[2][0].tolist()
    return [scene.mass_ratio, 1.0 if scene.target.held else -1.0, scene.contact.NAME, constants, drawn, asked]


class Marched(NamedTuple):
    """An impact by modes: of a scene, by so many, over so many round trips T of which the bodies touch for some."""

    scene: Scene
    modes: int
    touching: float
    duration: float
    kind: str  # own ones, of which those left out give way or do not, or given ones: of a frame


def random_march() -> Marched:
    """Rigid or by any law, by 1 to 400 modes, or as many as a frame may have."""
    scene, duration = random_scene(), float(RANDOM.uniform(2.0, 6.0))
    kind, modes = "own", int(RANDOM.choice(MODES))
    if RANDOM.uniform() < RIGID_SHARE:
        scene = scene.replace({"contact": {"law": "rigid"}})
    elif RANDOM.uniform() < STIFF_SHARE:
        kind = "stiff" if scene.target.held or modes > MOST_ATTACHED else "given"
    return Marched(scene, modes, duration * float(RANDOM.uniform(0.05, 0.9)), duration, kind)


def random_beam() -> tuple[Scene, int]:
    """A mass across a beam, which is known by so many modes."""
    return random_scene(BEAMS), int(RANDOM.choice(BEAM_MODES))


def struck_by(scene: Scene, count: int) -> list:
    """What the kernel is given of a beam: as `app.messages.beam.march_of`, in s, kg and the speed."""
    modes, target = scene.target.modes(count).excited(), scene.target
    march = {
        "frequencies": modes.frequencies.tolist(),
        "atContact": modes.at_contact.tolist(),
        "compliance": modes.residual_compliance,
        "mean": modes.rigid_mean,
        "longest": scene.time_unit,
    }
    masses = {
        "mass": scene.impactor.mass,
        "rigidMass": None if target.held else modes.rigid_mass,
        "whole": None if target.held else target.mass,
    }
    constants = list(scene.contact.scaled(scene.speed, scene.speed, scene.speed))
    return [masses | {"damping": target.damping, "duration": 0, "march": march}, scene.contact.NAME, constants]


def given_of(through: list[tuple[Scene, float]], marched: list[Marched], beams: list[tuple[Scene, int]]) -> Answers:
    return {
        "rod": IMPACTS,
        "law": [impact_of(scene, number < DRAWN_TOO, asked) for number, (scene, asked) in enumerate(through)],
        "modes": [[*impact_of(scene)[:4], *counted] for scene, *counted in marched],
        "beam": [struck_by(*each) for each in beams],
    }


def test_the_module_is_of_todays_sources():
    assert named_in(MODULE.read_bytes()) == sources(), "make wasm"
    assert MODULE.with_name("room.js").read_text("utf-8") == room(), "make wasm"


@pytest.mark.browser  # needs Node
def test_a_module_is_given_a_clock_and_nothing_else():
    listed = "WebAssembly.Module.imports(new WebAssembly.Module(require('fs').readFileSync(process.argv[1])))"
    command = ["node", "-e", f"console.log(JSON.stringify({listed}))", MODULE]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == [{"module": "strikewave", "name": "check_time", "kind": "function"}]


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
    through = [(random_scene(), random_time()) for _ in range(THROUGH_LAWS)]
    marched = [random_march() for _ in range(BY_MODES)]
    _equal(by_node, through, marched, [random_beam() for _ in range(ACROSS)])


@pytest.mark.slow
@pytest.mark.browser
@pytest.mark.skipif(FIREFOX is None, reason="Firefox is not installed: firefox-esr, or another that FIREFOX names")
def test_firefox_finds_what_this_machine_finds(tmp_path):
    """And to the last bit what Node finds, whose engine is that of Chromium."""

    def answer(given: Answers) -> Answers:
        found, other = by_firefox(given, tmp_path), by_node(given)
        for kind, answers in other.items():
            assert found[kind] == answers, kind
        return found

    through, marched = [(random_scene(), random_time()) for _ in range(100)], [random_march() for _ in range(50)]
    _equal(answer, through, marched, [random_beam() for _ in range(20)])


def _equal(
    answer: Callable[[Answers], Answers],
    through: list[tuple[Scene, float]],
    marched: list[Marched],
    beams: list[tuple[Scene, int]],
) -> None:
    """To rounding where the wave is exact: now and then the exponential of musl and that of this machine differ in the
    last bit. Through a law to what the steps are allowed, which such a bit may make longer or shorter; where damping
    lets the force fade, the instant at which it ends is less sure than that.
    """
    answers = answer(given_of(through, marched, beams))
    rigid, by_laws, by_modes, across = (answers[kind] for kind in ("rod", "law", "modes", "beam"))
    found = len(rigid), len(by_laws), len(by_modes), len(across)
    assert found == (len(IMPACTS), len(through), len(marched), len(beams))
    for (beta, side), here in zip(IMPACTS, rigid, strict=True):
        there = native.rod(beta, side)
        assert there is not None and here, (beta, side)  # nothing is beyond it at any mass ratio
        for name, values in there.items():
            assert not apart(here[name], values, 1e-12, 1e-13), (beta, side, name)
    for (scene, asked), here in zip(through, by_laws, strict=True):
        there = native.law(scene, asked)
        if not here:  # the same are refused, but for those that fill the room: rounding halves a step more or less
            assert there is None or there["filled"][0] > NEARLY_FULL, scene.table()
            continue
        assert there is not None, scene.table()
        if "force" in here:
            for name in ("force", "wave"):
                curve, known = (_curve(found, name) for found in (here, there))
                assert np.abs(curve - known).max() < BETWEEN * np.abs(known).max(), (impact_of(scene), asked, name)
        for name in here.keys() - {"force_time", "wave_time", "force", "wave"}:
            close, given = 1e-8 if name == "out" and not scene.contact.LOSSY else 1e-6, (impact_of(scene), asked, name)
            assert not apart(here[name], there[name], close, close), given
    for impact, here in zip(marched, by_modes, strict=True):
        _equal_by_modes(impact, here)
    for (scene, modes), here in zip(beams, across, strict=True):
        _equal_across(scene, modes, here)


def _equal_across(scene: Scene, modes: int, here: dict) -> None:
    """To rounding, which many contacts make larger: a mass changed by as little moves them as far."""
    found, given = Modal(modes=modes, estimate=False).solve(scene), (scene.title, struck_by(scene, modes))
    motion, speed = found.known_motion, scene.speed
    assert isinstance(motion, ModalMotion)
    if not here:
        assert motion.steps > NEARLY_FULL * BEAM_STEPS or len(found.contacts) > NEARLY_FULL * BEAM_CONTACTS, given
        return
    rows = [[c.start, c.end, c.impulse / speed, c.peak_force / speed] for c in found.contacts]
    if len(rows) > FEW_CONTACTS:  # of which rounding makes others in the end
        rows = rows[:FEW_CONTACTS]
        assert np.array(here["contacts"])[:FEW_CONTACTS, :4] == pytest.approx(np.array(rows), rel=1e-3), given
        return
    close = 1e-6
    assert here["steps"] == motion.steps and here["duration"] == pytest.approx(found.duration, rel=1e-9), given
    assert len(here["contacts"]) == len(rows), given
    for column, largest in enumerate(np.abs(rows).max(axis=0)):
        known = [row[column] for row in rows]
        assert [row[column] for row in here["contacts"]] == pytest.approx(known, abs=close * largest), given
    times = np.array(here["time"])
    paths = {"impactor": motion.impactor_position(times), "face": motion.end_position(times)}
    rates = {"impactorRate": motion.impactor_velocity(times), "struckRate": struck_velocity(found, times)}
    for name, known in (paths | rates).items():
        assert not apart(here[name], known / speed, 0.0, close * np.abs(known).max() / speed), (name, given)
    energies, unit = found.energy, speed**2
    known = {
        "final": found.impactor_velocity / speed,
        "target": found.target_velocity / speed,
        "energy": (energies["target_rigid"] + energies["target_vibration"]) / unit,
        "local": energies["local"] / unit,
        "dissipated": energies["dissipated"] / unit,
        "deepest": found.peak_indentation / speed,
        "dent": found.residual_indentation / speed,
        "apart": found.restitution["newton_at_contact"],
    }
    scales = {name: energies["initial"] / unit for name in ("energy", "local", "dissipated")}
    scales |= {"deepest": known["deepest"], "dent": known["deepest"]}
    for name, value in known.items():
        if value is not None and not (name == "target" and scene.target.held):
            assert here[name] == pytest.approx(value, abs=close * scales.get(name, 1.0)), (name, given)


def _equal_by_modes(impact: Marched, here: dict) -> None:
    """To rounding; where the contact is rigid, what the modes left out chatter makes it larger."""
    scene, modes, touching, duration, kind = impact
    trip, force = scene.time_unit, scene.target.impedance * scene.speed
    length, energy, close = scene.speed * trip, force * scene.speed * trip, 1e-9
    steps = steps_drawn(scene.target.modes(modes).shortest_period / trip, touching, duration)
    frame = "attached" if kind == "given" else "mean-axis"
    method = Modal(modes=modes, steps=steps, residual=kind == "own", frame=frame, estimate=False)
    found = method.solve(scene, duration * trip)
    motion, given = found.known_motion, (impact_of(scene), *impact[1:])
    assert isinstance(motion, ModalMotion)
    pressed = motion.record.contact_force
    assert np.abs(np.array(here["force"]) * force - pressed).max() < 1e-6 * pressed.max(), given
    times = np.linspace(0.0, found.duration, INSTANTS)
    assert not apart(here["mass"], motion.impactor_position(times) / length, 0.0, close), given
    assert not apart(here["end"], motion.end_position(times) / length, 0.0, close), given
    rows = [[c.start / trip, c.end / trip, c.impulse / force / trip, c.peak_force / force] for c in found.contacts]
    assert np.array(here["contacts"])[:, :4] == pytest.approx(np.array(rows), rel=close, abs=close), given
    diagnostics, energies, rebounds = found.diagnostics, found.energy, found.restitution
    known = {
        "final": found.impactor_velocity / scene.speed,
        "target": found.target_velocity / scene.speed,
        "impulse": found.impulse / force / trip,
        "energy": (energies["target_rigid"] + energies["target_vibration"]) / energy,
        "local": energies["local"] / energy,
        "dissipated": energies["dissipated"] / energy,
        "window": diagnostics["resolved_time"] / trip,
        "touches": diagnostics["raw_contacts"],
        "highest": diagnostics["raw_peak_force"] / force,
        "deepest": None if found.peak_indentation is None else found.peak_indentation / length,
        "dent": None if found.residual_indentation is None else found.residual_indentation / length,
        "apart": rebounds["newton_at_contact"],
    }
    for name, value in known.items():
        assert value is None or here[name] == pytest.approx(value, rel=close, abs=close), (name, given)
    if rebounds["poisson"] is not None:
        assert here["impulse"] / here["compressing"] - 1.0 == pytest.approx(rebounds["poisson"], abs=close), given


def _curve(found: dict, name: str) -> np.ndarray:
    """A history at even times: either is drawn at instants of its own where a jump is the least that stands twice."""
    time = np.array(found[f"{name}_time"])
    even = np.linspace(0.0, time[-1], 1_013)
    return np.interp(even, time, found[name])
