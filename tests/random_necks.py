"""Random heads on thin necks, the same for the same number: what swings slowly, long after its waves are back."""

from typing import Any

import numpy as np

import solvers
from bench.random_scenes import random_contact
from solvers import Scene
from tests.random_chains import MATERIALS, between

BLOWS = ("mass", "mass-rigid", "rod", "rod-rigid", "gap")


def random_neck(number: int, blow: str | None = None) -> Scene:
    """A thick rod before a thin one, 10 to 100 times thinner, which is fixed or ends in a mass; struck by a mass or a
    rod, 0.1 to 3 times as heavy as the head, by a law or with rigid faces; "gap": another rod touches the neck or not.
    """
    chance = np.random.default_rng([number, 55])
    blow = blow or BLOWS[number % len(BLOWS)]
    thick, speed = between(chance, 3e-4, 3e-3), between(chance, 0.1, 3.0)
    head, neck = _rod(chance, thick, 0.05, 0.3), _rod(chance, thick / between(chance, 10.0, 100.0), 0.05, 0.4)
    target: dict[str, Any] = {"kind": "rods", "rods": [head, neck | {"joint": "bonded"}]}
    heavy = 7900.0 * thick * head["length"]
    if chance.random() < 0.5:
        target |= {"support": "free", "end_mass": between(chance, 3.0, 30.0) * heavy}
    else:
        target["support"] = "fixed"
    if blow == "gap":
        gap = between(chance, 1e-7, 1e-4) if chance.random() < 0.7 else 0.0
        behind = _rod(chance, thick, 0.05, 0.3) | {"joint": "touching", "gap": gap}
        target["rods"].append(behind)
    impactor: dict[str, Any] = {"mass": between(chance, 0.1, 3.0) * heavy, "velocity": speed}
    if blow.startswith("rod"):
        impactor = {"kind": "rod", "velocity": speed} | _rod(chance, thick, 0.03, 0.3)
    law = "rigid" if blow.endswith("rigid") else str(chance.choice([name for name in solvers.LAWS if name != "rigid"]))
    stiffness = 2e11 * thick / head["length"] * between(chance, 0.1, 10.0)
    contact = random_contact(chance, law, stiffness, 8e-5 * speed)
    return Scene.from_table({"impactor": impactor, "target": target, "contact": contact})


def _rod(chance: np.random.Generator, area: float, shortest: float, longest: float) -> dict[str, Any]:
    length, material = between(chance, shortest, longest), str(chance.choice(MATERIALS))
    return {"length": length, "section": {"area": area}, "material": material}
