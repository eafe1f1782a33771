"""The exact method does not hang on which of the two bodies strikes: every scene against its mirror."""

import math
from typing import Any

import pytest
from pytest import approx

import solvers
from solvers import Scene

ROD = {"kind": "rod", "length": 1.0, "section": {"radius": 0.01}, "material": "steel"}
SPEED = 5.0  # m/s


def scene(impactor: dict, target: dict, contact: dict | None = None, speed: float = SPEED, drift: float = 0.0) -> Scene:
    """Of bodies without their velocities; `drift` [m/s]: of the target, and with it of all."""
    moving = {"velocity": drift} if drift else {}
    tables = {"impactor": impactor | {"velocity": speed + drift}, "target": target | moving}
    return Scene.from_table(tables | {"contact": contact or {"law": "rigid"}})


def outcome(solution: Any, swapped: bool = False, drift: float = 0.0) -> dict[str, Any]:
    """What cannot hang on who strikes: velocities as those of the impactor and the target of the scene not swapped."""
    first, second = solution.impactor_velocity - drift, solution.target_velocity - drift
    if swapped:
        first, second = SPEED - second, SPEED - first
    return {
        "impulse": solution.impulse,
        "peak": solution.peak_force,
        "edges": [edge for contact in solution.contacts for edge in (contact.start, contact.end)],
        "velocities": [first, second],
    }


def same(one: dict[str, Any], other: dict[str, Any], share: float) -> None:
    assert len(one["edges"]) == len(other["edges"])
    assert other["impulse"] == approx(one["impulse"], rel=share)
    assert other["peak"] == approx(one["peak"], rel=share)
    assert other["edges"] == approx(one["edges"], rel=share, abs=share * one["edges"][-1])
    assert other["velocities"] == approx(one["velocities"], abs=share * SPEED)


def test_a_mass_behind_a_rod_that_strikes_pushes_on():
    """Two equal rods, one with 1 kg at its far end: it still has m v e^(-Z t / m) after the first round trip."""
    solution = solvers.solve(scene(ROD | {"end_mass": 1.0}, ROD | {"support": "free"}))
    rod = solution.scene.target
    trip, impedance = rod.round_trip_time, rod.impedance
    impulse = 0.5 * impedance * SPEED * trip + 0.5 * 1.0 * SPEED * (1.0 - math.log(2.0))
    assert solution.impulse == approx(impulse, rel=1e-9)
    assert solution.contacts[0].end == approx(trip + math.log(2.0) / impedance, rel=1e-9)
    assert solution.impactor_velocity == approx(SPEED - impulse / (rod.mass + 1.0), rel=1e-9)
    assert solution.target_velocity == approx(impulse / rod.mass, rel=1e-9)
    assert abs(solution.diagnostics["energy_error"]) < 1e-12


@pytest.mark.parametrize("contact", [None, {"law": "hertz", "stiffness": 1e10}], ids=["rigid", "hertz"])
@pytest.mark.parametrize("ends", [(1.0, 0.0), (0.0, 0.3), (2.0, 0.5)])
def test_the_end_of_a_body_counts_on_either_side(ends, contact):
    bodies = [ROD | {"length": length, "end_mass": mass or None} for length, mass in zip((1.0, 0.7), ends, strict=True)]
    bodies = [{key: value for key, value in body.items() if value is not None} for body in bodies]
    one, other = (scene(impactor, target | {"support": "free"}, contact) for impactor, target in (bodies, bodies[::-1]))
    same(outcome(solvers.solve(one)), outcome(solvers.solve(other), swapped=True), 1e-8)


def test_a_mass_on_a_drop_weight_comes_back_from_a_column():
    tup = {"kind": "rod", "length": 0.3, "section": {"radius": 0.03}, "material": "steel", "end_mass": 50.0}
    column = {"kind": "rod", "length": 2.0, "section": {"radius": 0.1}, "material": "concrete", "support": "fixed"}
    tables = {"impactor": tup | {"velocity": 4.4287, "radius": 0.1}, "target": column, "contact": {"law": "hertz"}}
    exact, meshed = (solvers.solve(Scene.from_table(tables), method=name) for name in ("waves", "fe-modal"))
    assert meshed.impactor_velocity == approx(exact.impactor_velocity, rel=1e-4)  # of 100 elements, second order
    assert meshed.peak_force == approx(exact.peak_force, rel=1e-4)
    assert exact.impactor_velocity < 0.0
