"""Waves by steps on a grid of times: the cost of a step at the struck interface, and what a step is worth."""

import numpy as np

import solvers
from solvers.numerics.waves import rigid as rigid_waves
from solvers.numerics.waves import stepped as stepped_waves

from .size import some
from .timing import median, row

STEPS = (500, 5_000, 50_000)  # over three round trips
TRIPS = 3


def measure() -> dict[str, object]:
    exact = solvers.solve(solvers.load("fixed-rod"))
    sent = rigid_waves.Pieces.of(400, 40, 400)
    spent = median(lambda: rigid_waves.strike(1.0, 1.0, 3.0, sent), 200)
    rows = [row("event-exact kernel, whole impact", 1e6 * spent, "us")]
    for steps in some(STEPS):
        per_trip = steps // TRIPS

        def stepped(steps=steps, per_trip=per_trip):
            return stepped_waves.strike(1.0, 1.0, per_trip, steps, True, 50)

        spent = median(stepped, 200 if steps < 10_000 else 50)
        error = stepped()[4][-1, 3] - exact.impactor_velocity
        rows += [
            row(f"{steps} steps: per step and interface", 1e9 * spent / steps, "ns", "<= 20"),
            row(f"{steps} steps: error of the rebound", np.abs(error), "v"),
        ]
    return dict(rows + _chain())


def _chain() -> list:
    """A striker on two rods with a specimen between them: every end and joint steps by its own clock."""
    bar = {"length": 1.0, "section": {"radius": 0.01}, "material": "steel"}
    specimen = {"length": 0.01, "section": {"radius": 0.008}, "material": "aluminium"}
    scene = solvers.Scene.from_table(
        {
            "impactor": {"kind": "rod", "velocity": 5.0} | bar | {"length": 0.2},
            "target": {"kind": "rods", "rods": [bar, specimen, bar], "support": "fixed"},
            "contact": {"law": "rigid"},
        }
    )
    trips = 3.0 * scene.time_unit
    spent = median(lambda: solvers.solve(scene, duration=trips), 9)
    steps = solvers.solve(scene, duration=trips).diagnostics["steps"]
    return [
        row("rod on a chain of three, event-located, whole solve()", 1e3 * spent, "ms"),
        row("rod on a chain of three: per step of an end or joint", 1e6 * spent / steps, "us"),
    ]
