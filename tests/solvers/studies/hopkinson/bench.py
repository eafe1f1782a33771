"""A split Hopkinson bar on the bench of the tests: solved with a specimen of known law, and measured by two gauges."""

import math
from functools import lru_cache

import numpy as np

import solvers
from solvers import Scene
from solvers.records import Record
from tests.solvers.studies.hopkinson.specimen import Bilinear

STEEL = solvers.MATERIALS["steel"]
SPEED = math.sqrt(STEEL.young / STEEL.density)
BAR = {"length": 1.5, "diameter": 0.02, "material": "steel"}
AREA, LENGTH = math.pi * 0.005**2, 0.0113
YOUNG, TANGENT, YIELD = 70e9, 2e9, 300e6  # Pa, of the specimen
STRIKER = {"length": 0.258, "velocity": 15.4}
BARS = {
    "incident": BAR | {"gauge": 0.75},
    "transmitted": BAR | {"gauge": 0.5},
    "specimen": {"length": LENGTH, "diameter": 0.01},
    "striker": STRIKER,
}


def law_stress(strain):
    """What went in [Pa], loading."""
    return np.minimum(YOUNG * strain, YIELD + TANGENT * (strain - YIELD / YOUNG))


@lru_cache
def solution() -> solvers.Solution:
    """The scene of `BARS`."""
    before, solvers.LAWS["bilinear"] = solvers.LAWS.get("bilinear"), Bilinear
    assert before is None
    try:
        specimen = {"law": "bilinear", "stiffness": YOUNG * AREA / LENGTH, "hardening": TANGENT * AREA / LENGTH}
        specimen |= {"yield_indentation": YIELD / YOUNG * LENGTH}
        bar = {"length": 1.5, "section": {"radius": 0.01}, "material": "steel"}
        table = {
            "impactor": {"kind": "rod", "section": {"radius": 0.01}, "material": "steel"} | STRIKER,
            "target": {
                "kind": "rods",
                "support": "free",
                "rods": [bar, bar | {"joint": "touching", "contact": specimen}],
            },
        }
        found = solvers.solve(Scene.from_table(table), "waves", duration=0.9e-3)
        found.known_motion.stress(np.array([0.0]), np.array([0.5]))
        return found
    finally:
        del solvers.LAWS["bilinear"]


def measured(step: float = 1e-7, until: float = 0.85e-3) -> tuple[Record, Record]:
    """Strains of both gauges."""
    time = np.arange(0.0, until, step)
    stress = solution().known_motion.stress(time, np.array([0.75, 2.0]))
    one, two = -stress.T / STEEL.young
    return Record(time, one, "strain"), Record(time, two, "strain")
