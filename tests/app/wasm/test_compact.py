"""Two bodies that move as wholes, by the module: equal to what the library says of them."""

import math

import numpy as np
import pytest

from app.wasm.entry import INSTANTS
from solvers import Modal, QuasiStatic, Scene
from solvers.contact.damping import LEAST_RESTITUTION
from solvers.contact.duration import exponent_of
from solvers.scenes.library import scene_of

from .answered import apart, by_node

IMPACTS = 120
CLOSE = 1e-11
HARD = 0.03  # restitution of a hard damping: by less, rounding of the rate moves the parting by more than 1e-10
LAWS = [
    {"law": "hertz", "stiffness": 1e10},
    {"law": "power", "stiffness": 1e9, "exponent": 1.3},
    {"law": "power", "stiffness": 1e11, "exponent": 2.4},
    {"law": "plastic-linear", "stiffness": 1e10, "yield_indentation": 1e-6},
    {"law": "plastic-power", "stiffness": 1e10, "yield_indentation": 1e-7},
    {"law": "yigit-christoforou", "stiffness": 1e9, "yield_indentation": 1e-5},
    {"law": "hunt-crossley", "stiffness": 1e10, "restitution": 0.5},
    {"law": "lankarani-nikravesh", "stiffness": 1e9, "restitution": 0.5},
    {"law": "lee-wang", "stiffness": 1e10, "restitution": 0.5, "exponent": 1.5},
    {"law": "lee-wang", "stiffness": 1e9, "restitution": 0.5, "exponent": 2.1},
]


def random_impacts() -> list[tuple[Scene, bool]]:
    """Of a mass on a mass or a wall, and whether by the half sine."""
    random, found = np.random.default_rng(11), []
    for _ in range(IMPACTS):
        law = dict(LAWS[int(random.integers(len(LAWS)))])
        law["stiffness"] *= float(10.0 ** random.uniform(-1.0, 1.0))
        if "restitution" in law:
            law["restitution"] = float(random.choice([HARD, 1.0, *random.uniform(HARD, 1.0, 3)]))
        scene = scene_of(str(random.choice(["two-balls", "figure-3.8"]))).replace({"contact": law})
        scene = scene.replace({"impactor.velocity": float(10.0 ** random.uniform(-1.0, 1.0))})
        scene = scene.with_impactor_mass(scene.impactor.mass * float(10.0 ** random.uniform(-3.0, 3.0)))
        found.append((scene, law["law"] == "hertz" and random.uniform() < 0.3))
    return found


def given_of(scene: Scene) -> list:
    law = {"name": scene.contact.NAME, "exponent": exponent_of(scene.contact), "yields": scene.contact.PLASTIC}
    law |= {"damps": scene.contact.LOSSY}
    law |= {"constants": list(scene.contact.scaled(scene.speed, scene.speed, scene.speed))}
    return [scene.impactor.mass, scene.target.mass if math.isfinite(scene.target.mass) else None, law]


@pytest.mark.browser  # needs Node
def test_who_creeps_apart_does_so_once():
    """By a march, forces of rounding come and go while the dent closes; what stands beside it has none."""
    scenes = [
        scene_of(name).replace({"contact": {"law": law, "stiffness": 1e9, "restitution": LEAST_RESTITUTION}})
        for name in ("two-balls", "figure-3.8")
        for law in ("hunt-crossley", "lankarani-nikravesh", "lee-wang")
    ]
    answers = by_node({"compact": [[*given_of(scene), False] for scene in scenes]})["compact"]
    for scene, here in zip(scenes, answers, strict=True):
        assert len(here["exact"]["contacts"]) == 1
        assert here["exact"]["apart"] == pytest.approx(LEAST_RESTITUTION, abs=1e-6)
        closed = QuasiStatic(model="local").solve(scene)
        assert here["other"]["apart"] == pytest.approx(closed.restitution["newton"], abs=CLOSE)


@pytest.mark.browser  # needs Node
def test_a_browser_finds_what_the_library_says():
    impacts, given = random_impacts(), []
    for scene, sine in impacts:
        given.append([*given_of(scene), sine])
    for (scene, sine), here in zip(impacts, by_node({"compact": given})["compact"], strict=True):
        marched = Modal(modes=1).solve(scene)
        closed = QuasiStatic(model="hertz-sine" if sine else "local").solve(scene, marched.duration)
        _equal(scene, marched, here, here["exact"], ("impactor", "face"))
        _equal(scene, closed, here, here["other"], ("otherImpactor", "otherFace"))
        force = scene.reduced_mass * scene.speed / scene.time_unit
        raw = np.array(here["otherTime"]) * scene.time_unit
        known = closed.known_motion.force(raw)
        assert not apart(np.array(here["otherForce"]) * force, known, 0.0, 1e-9 * known.max())
        steps = marched.known_motion.record.contact_force
        assert not apart(np.array(here["force"])[::2] * force, steps, 0.0, 1e-9 * steps.max())
        assert here["exact"]["steps"] == steps.size and here["exact"]["touches"] == len(marched.contacts)


def _equal(scene: Scene, solution, here: dict, figures: dict, paths: tuple[str, str]) -> None:
    trip, speed, reduced = scene.time_unit, scene.speed, scene.reduced_mass
    (contact,), rebounds, force = solution.contacts, solution.restitution, reduced * speed / trip
    assert here["trip"] == pytest.approx(trip, rel=CLOSE)
    assert here["duration"] == pytest.approx(solution.duration / trip, rel=CLOSE)
    known = {
        "impulse": solution.impulse / force / trip,
        "final": solution.impactor_velocity / speed,
        "target": solution.target_velocity / speed,
        "apart": rebounds["newton_at_contact"],
        "local": solution.energy["local"] / (reduced * speed**2),
        "dissipated": solution.energy["dissipated"] / (reduced * speed**2),
    }
    dents = {"deepest": solution.peak_indentation, "dent": solution.residual_indentation}
    assert {name: figures[name] for name in known} == pytest.approx(known, rel=CLOSE, abs=CLOSE), scene.table()
    for name, value in dents.items():
        assert figures["cycle"][name] == pytest.approx(value / (speed * trip), rel=CLOSE, abs=CLOSE), scene.table()
    assert figures["impulse"] / figures["compressing"] - 1.0 == pytest.approx(rebounds["poisson"], abs=CLOSE)
    listed = {"start": 0.0, "end": contact.end / trip, "push": contact.impulse / force / trip}
    listed |= {"peak": contact.peak_force / force}
    (row,) = figures["contacts"]
    assert {name: row[name] for name in listed} == pytest.approx(listed, rel=1e-10), scene.table()
    even, motion = np.linspace(0.0, solution.duration, INSTANTS), solution.known_motion
    for name, path in zip(paths, (motion.impactor_position(even), motion.end_position(even)), strict=True):
        assert not apart(np.array(here[name]) * speed * trip, path, 0.0, 1e-10 * speed * trip), name
