"""Impacts on rods one behind the other, by the module: equal to what the library says of them."""

from typing import Any

import numpy as np
import pytest

from app.messages.axial import _wave_history
from app.wasm.entry import INSTANTS
from solvers import Scene, Solution, Waves
from solvers.methods.waves.chain_scene import ChainScene
from solvers.numerics.waves.chain_drawn import WAVE_NUMBERS
from solvers.scenes.library import scene_of

from .answered import apart, by_node

IMPACTS = 60
CLOSE = 1e-10
RODS = ("two-unequal-rods", "figure-4.2", "figure-4.4", "figure-4.5", "stepped-rod")
MASSES = ("rod-with-end-mass", "rod-with-gap", "semi-infinite-rod")
ASKED = ("figure-4.8", "split-hopkinson")


def random_scenes() -> list[Scene]:
    """Of rods with other lengths, of masses and end masses of any size, and of every kind of far end."""
    random, found = np.random.default_rng(11), [scene_of(name) for name in (*RODS, *MASSES, *ASKED)]
    for _ in range(IMPACTS):
        scene = scene_of(str(random.choice([*RODS, *MASSES])))
        if scene.impactor.rods:
            changes = {"impactor.length": float(scene.impactor.length * random.uniform(0.4, 2.5))}
        else:
            scene = scene.with_impactor_mass(scene.target.mass / float(10.0 ** random.uniform(-1.0, 1.0)))
            changes = {"impactor.velocity": float(scene.speed * 10.0 ** random.uniform(-0.5, 0.5))}
        if scene.target.rods[-1].end_mass:
            changes["target.end_mass"] = float(10.0 ** random.uniform(-2.0, 1.0))
        if len(scene.target.rods) == 1 and scene.impactor.rods and not scene.target.velocity:
            changes["target.support"] = str(random.choice(["free", "fixed", "anechoic"]))
        found.append(scene.replace(changes))
    return found


def given_of(scene: Scene) -> list[Any]:
    """As app/static/wasm/chain.js makes it of a message."""
    known = ChainScene(scene)
    chain, asked = known.chain, scene.method.get("duration", 0.0) / known.trip
    rods = [
        {"impedance": z, "transit": lag, "drift": v}
        for z, lag, v in zip(chain.impedance, chain.transit, chain.drift, strict=True)
    ]
    end = float(chain.mass_right[-1])
    return [rods, chain.kind.tolist(), chain.gap.tolist(), asked, chain.mass_left[0], end if np.isfinite(end) else 0.0]


def solved(scene: Scene) -> Solution:
    return Waves().solve(scene, scene.method.get("duration"))


@pytest.mark.browser  # needs Node
def test_a_browser_finds_what_the_library_says():
    scenes = random_scenes()
    found = by_node({"chain": [given_of(scene) for scene in scenes]})["chain"]
    for scene, here in zip(scenes, found, strict=True):
        assert here, scene.table()
        _equal(scene, solved(scene), here)


def _equal(scene: Scene, solution: Solution, here: dict) -> None:
    trip, speed, force = scene.time_unit, scene.speed, scene.target.impedance * scene.speed
    energy, unit, motion = solution.energy, force * speed * trip, solution.known_motion
    assert solution.impactor_velocity is not None
    figures = {
        "duration": solution.duration / trip,
        "impulse": solution.impulse / force / trip,
        "final": solution.impactor_velocity / speed,
        "target": solution.target_velocity / speed,
        "first": energy["initial"] / unit,
        "striker": energy["impactor"] / unit,
        "energy": (energy["target_rigid"] + energy["target_vibration"]) / unit,
        "wholes": energy["target_rigid"] / unit,
        "steps": solution.diagnostics["steps"],
    }
    assert {name: here[name] for name in figures} == pytest.approx(figures, rel=CLOSE, abs=CLOSE), scene.table()
    rebounds = solution.restitution
    if rebounds["newton_at_contact"] is not None:
        assert here["apart"] == pytest.approx(rebounds["newton_at_contact"], abs=1e-9), scene.table()
    if rebounds["poisson"] is not None:
        assert here["impulse"] / here["compressing"] - 1.0 == pytest.approx(rebounds["poisson"], abs=1e-9)
    rows = [[c.start / trip, c.end / trip, c.impulse / force / trip, c.peak_force / force] for c in solution.contacts]
    found = [[each["start"], each["end"], each["push"], each["peak"]] for each in here["contacts"]]
    assert np.array(found) == pytest.approx(np.array(rows), rel=CLOSE, abs=CLOSE), scene.table()
    even = np.linspace(0.0, solution.duration, INSTANTS)
    paths = {"mass": motion.impactor_position(even), "end": motion.end_position(even)}
    for name, known in paths.items():
        assert not apart(here[name], known / speed / trip, 0.0, CLOSE), (name, scene.table())
    if not scene.target.held:
        speeds = motion.rigid_velocity(even) / speed
        gone = np.cumsum(0.5 * (speeds[1:] + speeds[:-1])) * (even[1] / trip)
        assert not apart(here["whole"][1:], gone, 0.0, CLOSE), scene.table()
    reach = np.linspace(0.0, solution.duration / trip, WAVE_NUMBERS // (2 * len(here["waves"])))
    for number, (time, wave) in enumerate(here["waves"]):
        times, waves = _wave_history(motion, number // 2, number % 2 == 0, reach)  # type: ignore[arg-type]
        fine = np.linspace(0.0, reach[-1], 1_013)
        assert np.abs(np.interp(fine, time, wave) - np.interp(fine, times, waves)).max() < 1e-6, scene.table()
