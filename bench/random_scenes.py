"""Random impacts of all kinds, the same for the same seed."""

import math

import numpy as np

import solvers
from solvers import Scene

STEEL = {"young": 210e9, "density": 7900.0, "poisson": 0.3}
BEAM_SUPPORTS = ("cantilever", "pinned-pinned", "clamped-clamped", "free-free", "pinned-free")


def random_scene(chance: np.random.Generator, beams: float = 0.0) -> Scene:
    """A mass on a fixed or a free steel rod, or with probability `beams` on a beam; any contact law.

    Mass ratio 0.03 to 30 and softness of the contact 0.1 to 30 times that of the body, both evenly in their logarithm.
    """
    width = chance.uniform(0.01, 0.05)
    length = chance.uniform(10.0, 30.0) * width
    target = {"length": length, "section": {"width": width, "height": width}, "material": STEEL}
    beam = chance.random() < beams
    if beam:
        theory = str(chance.choice(("euler-bernoulli", "timoshenko")))
        target |= {"kind": "beam", "support": str(chance.choice(BEAM_SUPPORTS)), "theory": theory}
    else:
        target |= {"kind": "rod", "support": str(chance.choice(("fixed", "free")))}
    mass = STEEL["density"] * length * width**2 / math.exp(chance.uniform(math.log(0.03), math.log(30.0)))
    speed = math.exp(chance.uniform(math.log(0.1), math.log(10.0)))
    law = str(chance.choice(list(solvers.LAWS)))
    softness = math.exp(chance.uniform(math.log(0.1), math.log(30.0)))
    stiffness, time = STEEL["young"] * width**2 / length, 2.0 * length / math.sqrt(STEEL["young"] / STEEL["density"])
    if beam:  # in bending: E I / L^3 and about the lowest period
        stiffness, time = 4.0 * STEEL["young"] * width**4 / length**3, time * length / width
    impactor = {"mass": mass, "velocity": speed}
    contact = random_contact(chance, law, stiffness / softness, speed * time)
    return Scene.from_table({"impactor": impactor, "target": target, "contact": contact})


def random_contact(chance: np.random.Generator, law: str, stiffness: float, depth: float) -> dict[str, object]:
    """Constants with which the law at this depth [m] is about as stiff as a spring [N/m]."""
    if law == "rigid":
        return {"law": law}
    exponent = 1.0 if law in ("linear", "kelvin-voigt") else 1.5
    table: dict[str, object] = {"law": law}
    if law == "power":
        exponent = table["exponent"] = chance.uniform(1.0, 2.0)
    table["stiffness"] = stiffness * depth ** (1.0 - exponent)
    if solvers.LAWS[law].PLASTIC:
        table["yield_indentation"] = depth * math.exp(chance.uniform(math.log(0.003), math.log(0.3)))
    elif solvers.LAWS[law].LOSSY:
        table["restitution"] = chance.uniform(0.2, 0.95)
    return table
