"""Repeated balances by the module: equal to what the library says of them."""

from typing import Any

import numpy as np
import pytest

from app.wasm.balance_entries import EVENTS
from app.wasm.entry import INSTANTS
from app.wasm.spring_entries import FEW, PLACES
from solvers import Balance, Scene, Solution
from solvers.numerics.balance_drawn import MOST_LOCATED
from solvers.numerics.balances import SAMPLES_PER_PERIOD
from solvers.scenes.library import scene_of

from .answered import apart, by_node

IMPACTS = 100
CLOSE = 1e-11
CHAOTIC = 1e-8  # balances with the restitution of rigid faces are: rounding grows with each of them

AT_ONCE = 1e-6  # a flight that begins without speed or force lasts as long as rounding says: a root of it


def random_impacts() -> list[tuple[Scene, Balance]]:
    """Of a mass on a rod or on another that a spring holds."""
    random, found = np.random.default_rng(11), []
    for _ in range(IMPACTS):
        name = str(random.choice(["fixed-rod", "free-rod", "spring-mass"]))
        scene = scene_of(name).replace({"impactor.velocity": float(10.0 ** random.uniform(-1.0, 1.0))})
        scene = scene.with_impactor_mass(scene.target.mass / float(10.0 ** random.uniform(-1.0, 1.0)))
        options: dict[str, Any] = {"restitution": float(random.choice([0.0, 0.3, 0.7, 1.0])), "estimate": False}
        if name != "spring-mass":
            options["variant"] = str(random.choice(["event-located", "step-end"]))
            most = MOST_LOCATED if options["variant"] == "event-located" else 30
            options["elements"] = int(random.integers(3, most + 1))
            options["modes"] = int(random.integers(2, options["elements"])) if random.random() < 0.3 else None
        found.append((scene, Balance(**options)))
    return found


def given_of(scene: Scene, solution: Solution) -> dict[str, Any]:
    """As the page has it: of forces in Z v, stresses in v sqrt(E rho)."""
    run, speed, trip = solution.known_motion.run, scene.speed, scene.time_unit
    own, fields, x = run.pair.modes[1], run.pair.fields(), np.linspace(0.0, scene.target.length, PLACES)
    force = scene.target.impedance * speed if scene.target.rods else scene.reduced_mass / trip * speed
    shapes, slopes = (fields[name](x)[1:-2].ravel().tolist() for name in ("shapes", "slopes"))
    means = np.zeros(own.frequencies.size) if own.means is None else own.means
    record = {
        "located": solution.method["variant"] == "event-located",
        "step": run.pair.shortest_period / SAMPLES_PER_PERIOD,
        "resolved": run.pair.resolved_time,
        "frequencies": own.frequencies.tolist(),
        "atContact": own.at_contact.tolist(),
        "means": means.tolist(),
    }
    return {
        **{"balance": record, "balanceShapes": shapes, "balanceStresses": slopes, "forceUnit": force, "speed": speed},
        "stressUnit": force / scene.target.area if scene.target.rods else force,
        "chosen": {"restitution": solution.method["restitution"]},
        "impactor": {"mass": scene.impactor.mass},
        "target": {"held": scene.target.held, "mass": min(scene.target.mass, 1e12)},
        "trip": trip,
    }


@pytest.mark.browser  # needs Node
def test_a_browser_finds_what_the_library_says():
    impacts = random_impacts()
    solved = [method.solve(scene) for scene, method in impacts]
    given = [[given_of(scene, solution), 0.0] for (scene, _), solution in zip(impacts, solved, strict=True)]
    found = by_node({"balance": given})["balance"]
    for (scene, _), solution, here in zip(impacts, solved, found, strict=True):
        if solution.known_motion.run.events.time.size + 2 > EVENTS:
            assert here == {}
        else:
            _equal(scene, solution, here)
    assert sum(here == {} for here in found) < IMPACTS // 10


def _equal(scene: Scene, solution: Solution, here: dict[str, Any]) -> None:
    units = given_of(scene, solution)
    trip, speed, force, motion = scene.time_unit, scene.speed, units["forceUnit"], solution.known_motion
    close = CLOSE if solution.method["restitution"] < 1.0 else CHAOTIC
    rebounds, energy = solution.restitution, solution.energy
    figures = {
        "duration": solution.duration / trip,
        "impulse": solution.impulse / force / trip,
        "final": solution.impactor_velocity / speed,
        "energy": (energy["target_rigid"] + energy["target_vibration"]) / (force * speed * trip),
        "dissipated": energy["dissipated"] / (force * speed * trip),
        "apart": rebounds["newton_at_contact"],
        "steps": solution.diagnostics["steps"],
        "balances": solution.diagnostics["balances"],
    }
    assert {name: here[name] for name in figures} == pytest.approx(figures, rel=close, abs=close), scene.table()
    if not scene.target.held:
        assert here["target"] == pytest.approx(solution.target_velocity / speed, rel=close, abs=close)
    if rebounds["poisson"] is None:
        assert here["compressing"] is None  # NaN
    else:
        assert here["impulse"] / here["compressing"] - 1.0 == pytest.approx(rebounds["poisson"], abs=1e-9)
    off = AT_ONCE if solution.method["variant"] == "event-located" else close
    assert len(here["contacts"]) == len(solution.contacts)
    for contact, there in zip(here["contacts"], solution.contacts, strict=True):
        times = {"start": there.start / trip, "end": there.end / trip}
        assert {name: contact[name] for name in times} == pytest.approx(times, abs=off)
        assert contact["push"] == pytest.approx(there.impulse / force / trip, rel=close, abs=close)
        if there.peak_force is not None:
            assert contact["peak"] == pytest.approx(there.peak_force / force, rel=close)
    _drawn_equal(scene, solution, here, close)
    time, shown = np.array(here["time"]) * trip, np.array(here["force"])
    assert not apart(time, motion.time, 0.0, off * solution.duration)
    assert not apart(shown, motion.force_history()[1] / force, 0.0, off * max(1.0, np.abs(shown).max()))


def _drawn_equal(scene: Scene, solution: Solution, here: dict[str, Any], close: float) -> None:
    units, motion = given_of(scene, solution), solution.known_motion
    length, speed = scene.speed * scene.time_unit, scene.speed
    even, few = (np.linspace(0.0, solution.duration, count) for count in (INSTANTS, FEW))
    along = np.linspace(0.0, scene.target.length, PLACES)
    drawn = {"mass": motion.impactor_position(even) / length, "end": motion.end_position(even) / length}
    if scene.target.rods:
        drawn |= {
            "stress": motion.stress(few, along).ravel() / units["stressUnit"],
            "velocity": motion.velocity(few, along).ravel() / speed,
            "displacement": motion.displacement(few, along).ravel() / length,
        }
    for name, known in drawn.items():
        at_rest = few if name in ("stress", "velocity", "displacement") else even
        jumps = np.abs(at_rest[:, None] - motion.impulses[0]).min(axis=1) < 1e-9 * solution.duration
        kept = np.repeat(~jumps, known.size // at_rest.size)  # at a balance, before it or after
        found = np.array(here[name])[kept]
        assert not apart(found, known[kept], 0.0, 100.0 * close * np.abs(known).max()), name
