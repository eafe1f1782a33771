"""Figures alone of impacts across, as maps take them: those of the solution, and those beside what is drawn."""

from functools import cache

import numpy as np
import pytest

from app.wasm.modal_entries import BEAM_STEPS
from solvers import Modal, Scene, Solution
from solvers.bodies.beams import SUPPORTS, THEORIES
from solvers.contact import Rigid
from solvers.methods.modal.motion import ModalMotion
from solvers.scenes.library import scene_of

from . import test_module
from .answered import by_node
from .test_module import random_scene, struck_by

SWINGS = "pinned-free"  # which no browser answers
SEED, MODES, EACH = 23, (1, 4, 9, 20), 10
FEW, SEVERAL = 3, 6  # contacts: each magnifies what rounding leaves
CLOSE, SCATTERED = 1e-7, 1e-3
LONG, LOW, PERIODS, CUT_OFF = (
    ("timoshenko-1913-long", "xylophone-bar", "hammer-on-cantilever"),
    3,
    13.0,
    (0.001, 0.02, 1.0),
)
NAMES = "final", "target", "energy", "dissipated", "peak", "deepest", "touching", "parting", "duration"

pytestmark = pytest.mark.browser  # needs Node


@cache
def impacts() -> list[tuple[Scene, int]]:
    """Masses across beams on other supports by both theories, through every law and with rigid faces; some damped."""
    with pytest.MonkeyPatch.context() as patch:
        draw = np.random.default_rng(SEED)
        patch.setattr(test_module, "RANDOM", draw)
        found = []
        for support in (each for each in SUPPORTS if each != SWINGS):
            for number in range(2 * EACH):
                scene = random_scene(("hammer-on-cantilever",))
                ratio = scene.mass_ratio
                changes = {"support": support, "theory": THEORIES[number % 2], "at": float(draw.uniform(0.15, 0.85))}
                changes |= {"damping": 0.01} if number % EACH == 3 else {}
                scene = scene.replace({f"target.{name}": value for name, value in changes.items()})
                if number % EACH == 5:
                    scene = scene.replace({"contact": {"law": "rigid"}})
                found.append((scene.with_impactor_mass(scene.target.mass / ratio), int(draw.choice(MODES))))
    return found


def given_of(scene: Scene, modes: int) -> list:
    if not scene.rigid_contact:
        return struck_by(scene, modes)
    soft = scene.replace({"contact": {"law": "linear", "stiffness": 1.0}})
    return [struck_by(soft, modes)[0], Rigid.NAME, []]


@cache
def answers() -> tuple[list[dict], list[dict]]:
    """Figures alone, and the same impacts as they are drawn."""
    given = [given_of(*each) for each in impacts()]
    found = by_node({"beamFigures": given, "beam": given})
    return found["beamFigures"], found["beam"]


def known_of(solution: Solution) -> dict[str, tuple[float, float]]:
    """Figures of a solution in s, kg and the speed, and what they are held against where they are small."""
    speed, energies, unit = solution.scene.speed, solution.energy, solution.scene.speed**2
    initial = energies["initial"] / unit
    found = {
        "final": (solution.impactor_velocity / speed, 1.0),
        "energy": ((energies["target_rigid"] + energies["target_vibration"]) / unit, initial),
        "dissipated": (energies["dissipated"] / unit, initial),
        "peak": (solution.peak_force / speed, 0.0),
        "touching": (solution.contact_time, 0.0),
        "parting": (solution.contacts[-1].end, 0.0),
        "duration": (solution.duration, 0.0),
    }
    if not solution.scene.target.held:
        found["target"] = solution.target_velocity / speed, 1.0
    if not solution.scene.rigid_contact:
        found["deepest"] = solution.peak_indentation / speed, 0.0  # pyright: ignore[reportOptionalOperand]
    return found


def assert_same(here: dict, solution: Solution, close: float) -> None:
    assert here["contacts"] == len(solution.contacts), solution.scene.table()
    for name, (value, scale) in known_of(solution).items():
        assert here[name] == pytest.approx(value, rel=close, abs=close * scale), (name, solution.scene.table())


def test_they_are_those_of_the_solution():
    few = 0
    for (scene, modes), here in zip(impacts(), answers()[0], strict=True):
        solution = Modal(modes=modes, estimate=False).solve(scene)
        count = len(solution.contacts)
        assert here, scene.table()
        if count > SEVERAL:
            continue  # of which rounding makes others in the end
        few += count <= FEW
        assert_same(here, solution, CLOSE if count <= FEW else SCATTERED)
    assert few > len(impacts()) // 3


def test_they_are_those_beside_what_is_drawn():
    """To rounding, which many contacts make larger."""
    seen = 0
    for (scene, _), here, drawn in zip(impacts(), *answers(), strict=True):
        if not drawn:
            continue  # of which there is no room for the histories
        rows = np.array(drawn["contacts"])
        peaks, touching, parting = rows[:, 3].max(), (rows[:, 1] - rows[:, 0]).sum(), rows[-1, 1]
        named = drawn | {"peak": peaks, "touching": touching, "parting": parting}
        if len(rows) > SEVERAL:
            continue
        assert here["contacts"] == len(rows), scene.table()
        close = CLOSE if len(rows) <= FEW else SCATTERED
        for name in NAMES:
            scale = (
                scene.impactor.mass if name in ("energy", "dissipated") else named["peak"] if name == "peak" else 1.0
            )
            assert here[name] == pytest.approx(named[name], rel=close, abs=close * scale), (name, scene.table())
            seen += 1
    assert seen > 100


def over(scenes: tuple[str, ...], periods: float, patched: dict) -> list[tuple[dict, Solution]]:
    """Figures of these for so many of the slowest periods, and their solutions."""
    asked = [scene_of(name).replace(patched) for name in scenes]
    given = [given_of(scene, LOW) for scene in asked]
    for scene, (struck, *_) in zip(asked, given, strict=True):
        struck["duration"] = periods * scene.time_unit
    found = by_node({"beamFigures": given})["beamFigures"]
    method = Modal(modes=LOW, estimate=False)
    solutions = [method.solve(scene, periods * scene.time_unit) for scene in asked]
    return list(zip(found, solutions, strict=True))


@pytest.mark.parametrize("patched", [{}, {"contact": {"law": "rigid"}}], ids=["law", "rigid"])
def test_of_a_long_impact_they_are_those_of_the_solution(patched):
    """Of more steps than there is room for histories."""
    for here, solution in over(LONG, PERIODS, patched):
        motion = solution.known_motion
        assert isinstance(motion, ModalMotion) and motion.steps > BEAM_STEPS
        assert_same(here, solution, CLOSE)


@pytest.mark.parametrize("patched", [{}, {"contact": {"law": "rigid"}}], ids=["law", "rigid"])
def test_of_one_that_is_cut_off_they_are_those_of_the_solution(patched):
    touching = 0
    for share in CUT_OFF:
        for here, solution in over(LONG, share, patched):
            touching += solution.contacts[-1].end >= solution.duration
            assert_same(here, solution, CLOSE)
    assert touching > 1


def test_what_takes_more_steps_than_there_may_be_is_refused():
    struck, *law = given_of(scene_of(LONG[0]), LOW)
    struck["duration"] = 200 * struck["march"]["longest"]
    assert by_node({"beamFigures": [[struck, *law]]})["beamFigures"] == [{}]
