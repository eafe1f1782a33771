"""A rod that bends as a spring, by the module: equal to what the library says of it."""

import numpy as np
import pytest

from app.messages import axial
from app.messages.laws import carried_by_spring
from app.wasm.entry import INSTANTS
from app.wasm.spring_entries import FEW, PLACES
from solvers import QuasiStatic, Scene
from solvers.scenes.library import scene_of

from .answered import apart, by_node

IMPACTS = 100
CLOSE = 1e-11


def random_impacts() -> list[tuple[Scene, str, float]]:
    """Of a mass on a fixed rod: by which model, and for how many round trips."""
    random, found = np.random.default_rng(7), []
    for _ in range(IMPACTS):
        scene = scene_of("fixed-rod").replace({"impactor.velocity": float(10.0 ** random.uniform(-1.0, 1.0))})
        ratio = float(10.0 ** random.uniform(-1.5, 1.5))
        model = str(random.choice(["structural", "structural-massless"]))
        lasts = np.pi * np.sqrt((0.5 / ratio + (0.5 / 3.0 if model == "structural" else 0.0)) / 2.0)
        duration = float(lasts * random.uniform(1.001, 3.0))
        found.append((scene.with_impactor_mass(scene.target.mass / ratio), model, duration))
    return found


@pytest.mark.browser  # needs Node
def test_a_browser_finds_what_the_library_says():
    impacts, given = random_impacts(), []
    solved = [QuasiStatic(model=model).solve(scene, duration * scene.time_unit) for scene, model, duration in impacts]
    for (scene, _, duration), solution in zip(impacts, solved, strict=True):
        given.append([0.5 / scene.mass_ratio, 0.5 * carried_by_spring(solution), 2.0, duration])
    for (scene, *_), solution, here in zip(impacts, solved, by_node({"spring": given})["spring"], strict=True):
        _equal(scene, solution, here)


def _equal(scene: Scene, solution, here: dict) -> None:
    trip, speed, force = scene.time_unit, scene.speed, scene.target.impedance * scene.speed
    (contact,), rebounds, energy = solution.contacts, solution.restitution, solution.energy
    motion, diagnostics = solution.known_motion, solution.diagnostics
    figures = {
        "impulse": solution.impulse / force / trip,
        "final": solution.impactor_velocity / speed,
        "energy": energy["target_vibration"] / (force * speed * trip),
        "dissipated": energy["dissipated"] / (force * speed * trip),
        "root": diagnostics["peak_root_force"] / force,
        "atOnce": diagnostics["initial_impulse"] / force / trip,
        "apart": rebounds["newton_at_contact"],
        "steps": diagnostics["steps"],
    }
    assert {name: here[name] for name in figures} == pytest.approx(figures, rel=CLOSE, abs=CLOSE)
    assert here["impulse"] / here["compressing"] - 1.0 == pytest.approx(rebounds["poisson"], abs=CLOSE)
    listed = {"start": 0.0, "end": contact.end / trip, "push": contact.impulse / force / trip}
    listed |= {"peak": contact.peak_force / force, "after": figures["final"]}
    assert here["contacts"] == [pytest.approx(listed, rel=CLOSE)]
    even = np.linspace(0.0, solution.duration, INSTANTS)
    few, along = np.linspace(0.0, solution.duration, FEW), np.linspace(0.0, scene.target.length, PLACES)
    drawn = {
        "mass": motion.impactor_position(even) / (speed * trip),
        "end": motion.end_position(even) / (speed * trip),
        "force": motion.force(np.array(here["forceTime"]) * trip) / force,
        "stress": motion.stress(few, along).ravel() / (force / scene.target.area),
        "velocity": motion.velocity(few, along).ravel() / speed,
        "displacement": motion.displacement(few, along).ravel() / (speed * trip),
    }
    for name, known in drawn.items():
        parted = np.abs(few / trip - here["contacts"][0]["end"]) < CLOSE  # where the end of the rod changes its way
        assert not parted.any(), scene.table()
        assert not apart(here[name], known, 0.0, CLOSE * np.abs(known).max()), name


def test_fields_are_of_as_many_instants_and_places_as_the_server_sends():
    assert (FEW, PLACES) == (axial.INSTANTS, axial.PLACES)


@pytest.mark.browser
def test_bodies_that_still_touch_are_left_to_the_server():
    assert by_node({"spring": [[0.5, 0.0, 2.0, 1.0]]}) == {"spring": [{}]}
