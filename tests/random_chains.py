"""Random chains of rods, the same for the same number: what `waves` must solve, whatever it is given.

Every chain is asked for over 20 round trips of its longest rod.
"""

import math
from typing import Any

import numpy as np

import solvers
from bench.random_scenes import random_contact
from solvers import Scene, Solution
from solvers.bodies.rods import MAX_RODS
from solvers.methods.validity import ended_early

TRIPS = 20.0
MATERIALS = ("steel", "aluminium", "bronze")


def random_chain(number: int) -> tuple[Scene, float]:
    """A mass or a rod on 1 to 12 rods of any lengths, joints, gaps and ends; and the time asked for [s].

    Lengths 0.02 to 1 m, sections 1e-4 to 1e-2 m2, gaps 1e-8 to 1e-3 m, masses of the impactor 0.03 to 30 times the
    chain's, evenly in their logarithm; laws about 0.1 to 30 times as soft as the rods.
    """
    chance = np.random.default_rng([number, 20])
    count = int(chance.integers(1, MAX_RODS + 1))
    joint_law = str(chance.choice(["rigid", "rigid", "rigid", *solvers.LAWS]))
    speed = between(chance, 0.1, 10.0)
    bonded = chance.choice([0.0, 0.4, 1.0])
    rods = [random_rod(chance) for _ in range(count)]
    for part in rods[1:]:
        if chance.random() < bonded:
            continue
        part |= {"joint": "touching", "gap": between(chance, 1e-8, 1e-3) if chance.random() < 0.6 else 0.0}
        part["contact"] = _law(chance, joint_law, speed)
    support = str(chance.choice(["free", "fixed", "anechoic"]))
    target: dict[str, object] = {"kind": "rods", "rods": rods, "support": support}
    if support == "free" and chance.random() < 0.3:
        target["end_mass"] = between(chance, 0.01, 10.0)
    weight = sum(7900.0 * part["length"] * part["section"]["area"] for part in rods)
    impactor: dict[str, object] = {"mass": between(chance, 0.03, 30.0) * weight, "velocity": speed}
    if chance.random() < 0.2:
        impactor = {"kind": "rod", "velocity": speed} | random_rod(chance)
    table = {
        "impactor": impactor,
        "target": target,
        "contact": _law(chance, str(chance.choice([*solvers.LAWS])), speed),
    }
    scene = Scene.from_table(table)
    return scene, TRIPS * max(rod.round_trip_time for rod in scene.target.rods)


def between(chance: np.random.Generator, low: float, high: float) -> float:
    """Evenly in the logarithm."""
    return math.exp(chance.uniform(math.log(low), math.log(high)))


def random_rod(chance: np.random.Generator) -> dict[str, Any]:
    return {
        "length": between(chance, 0.02, 1.0),
        "section": {"area": between(chance, 1e-4, 1e-2)},
        "material": str(chance.choice(MATERIALS)),
    }


def _law(chance: np.random.Generator, name: str, speed: float) -> dict[str, object]:
    """Of a rod of middling size: 0.2 m, 1e-3 m2, of steel."""
    return random_contact(chance, name, 1e9 / between(chance, 0.1, 30.0), 8e-5 * speed)


def wrong_with(solution: Solution, scene: Scene, duration: float) -> list[str]:
    """What a solution of a random chain must not be, in words; nothing if all is well."""
    found, done = [], solution.diagnostics
    if ended_early(solution.notes) or solution.duration < duration * (1.0 - 1e-12):
        found.append(f"ends at {solution.duration:.4g} s of {duration:.4g} s: {solution.notes}")
    error = done["estimated_error"]
    if not error < 0.05 and not any("so sensitive is this chain" in str(note) for note in solution.notes):
        found.append(f"an error of {error:.2g} v is not reported")
    if not abs(done["momentum_error"]) <= max(1e-9, error):
        found.append(f"momentum is off by {done['momentum_error']:.2g}, error {error:.2g}")
    stepped = any("on a grid" in str(note) for note in solution.notes)
    missing = solution.motion.history.unresolved() if stepped else 0.0
    if not abs(done["energy_error"] + missing) <= max(1e-8, error if stepped else 10.0 * error):
        found.append(f"energy is off by {done['energy_error']:.2g}, of it {-missing:.2g} known; error {error:.2g}")
    if solution.energy["dissipated"] < -1e-6 * solution.energy["initial"]:
        found.append(f"laws give energy: {solution.energy['dissipated']:.2g} J")
    pulls = [False, *(joint.bonded for joint in scene.target.joints)]
    for number, periods in enumerate((solution.contacts, *solution.joints)):
        if any(period.end > solution.duration * (1.0 + 1e-12) for period in periods):
            found.append(f"a contact at joint {number} ends after the end")
        if not pulls[number] and any(period.impulse < -1e-9 * scene.impactor.mass * scene.speed for period in periods):
            found.append(f"faces pull on each other at joint {number}")
    return found
