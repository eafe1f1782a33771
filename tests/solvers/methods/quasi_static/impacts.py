"""Impacts of two masses and of two rods."""

import dataclasses

from solvers import Scene
from tests.catalog import STEEL_ROD
from tests.solvers.numerics.plain_laws import MASS, SPEED


def two_masses(law, m2=0.5, v2=0.0, target="mass") -> Scene:
    """A mass of 0.2 kg at 2.03 m/s against another, or against a stop."""
    other = {"kind": "stop"} if target == "stop" else {"kind": "mass", "mass": m2, "velocity": v2}
    scene = Scene.from_table({"impactor": {"mass": MASS, "velocity": SPEED}, "target": other})
    return dataclasses.replace(scene, contact=law)


def rods(target=None, speed=1.0) -> Scene:
    bar = {key: value for key, value in STEEL_ROD.items() if key != "support"} | {"kind": "rod"}
    target = bar | {"support": "free", "velocity": -speed} if target is None else target
    return Scene.from_table({"impactor": bar | {"velocity": speed}, "target": target})
