"""What the tests share: scenes, contact laws, and how a rate of convergence is measured."""

from collections.abc import Callable, Sequence

import numpy as np

import solvers
from solvers import Rod, Scene

# Thesis 5.3 and 9.5 (the bodies), 10.2 (the impact): the ball of m1 = 0.2 kg at 2.03 m/s on the free bronze rod, with
# the contact stiffness that its printed velocities imply.
STEEL_ROD = {"length": 0.3, "section": {"width": 0.03, "height": 0.03}, "material": "steel", "support": "fixed"}
BRONZE_ROD = {
    "length": 1.48,
    "section": {"area": 3.142e-4},
    "material": {"young": 98e9, "density": 8600.0},
    "support": "free",
}
STEEL_ROD_MASS = 2.133  # kg = 7900 * 0.03 * 0.03 * 0.3
BRONZE_STIFFNESS = 6.92e9  # N/m^1.5

STEEL_BEAM = {"kind": "beam", "length": 0.3, "section": {"width": 0.03, "height": 0.03}, "material": "steel"}

SUPPORTS = ("fixed", "free")
RIGID = {"law": "rigid"}

SCENES = {name: solvers.load(name) for name in solvers.scene_names()}


def struck_rod(
    mass_ratio: float = 1.0, support: str = "fixed", contact: dict | None = None, speed: float = 1.0
) -> Scene:
    """The steel rod struck by a mass that is its own divided by `mass_ratio`."""
    return Scene.from_table(
        {
            "impactor": {"mass": STEEL_ROD_MASS / mass_ratio, "velocity": speed},
            "target": STEEL_ROD | {"support": support},
            "contact": RIGID if contact is None else contact,
        }
    )


def struck_beam(mass_ratio: float = 1.0, contact: dict | None = None, **changes) -> Scene:
    """The steel cantilever of thesis 5.5 struck on its tip by a mass that is its own divided by `mass_ratio`."""
    return Scene.from_table(
        {
            "impactor": {"mass": STEEL_ROD_MASS / mass_ratio, "velocity": 1.0, "radius": 0.025},
            "target": STEEL_BEAM | changes,
            "contact": {"law": "hertz", "stiffness": 2.4e10} if contact is None else contact,
        }
    )


def bronze_rod() -> Scene:
    return Scene.from_table(
        {
            "impactor": {"mass": 0.2, "velocity": 2.03},
            "target": BRONZE_ROD,
            "contact": {"law": "hertz", "stiffness": BRONZE_STIFFNESS},
        }
    )


ROD: Rod = struck_rod().target
T = ROD.round_trip_time
SIGMA0_AREA = ROD.impedance * 1.0  # sigma_0 A = v A sqrt(E rho) at 1 m/s [N], (4.11)


def contact_table(law: str, softness: float = 1.0, restitution: float = 0.5) -> dict:
    """A law for the steel rod struck at 1 m/s: with softness 1 the contact is as stiff as the rod itself.

    One that is no spring is so at the depth of v T. Constants of the law's own are those of its EXAMPLE.
    """
    example = solvers.LAWS[law].EXAMPLE
    exponent = solvers.LAWS[law].EXPONENT or example.get("exponent", 1.5)
    known = {"stiffness": ROD.stiffness / softness * T ** (1.0 - exponent), "yield_indentation": 0.02 * T}
    table = {name: known.get(name, value) for name, value in example.items() if name not in RESTITUTIONS}
    return {"law": law} | table | ({"restitution": restitution} if RESTITUTIONS & example.keys() else {})


RESTITUTIONS = {"restitution", "nominal_restitution"}
POWER = solvers.LAWS["power"].EXAMPLE["exponent"]  # of the power law in the tests
LAWS = {law: struck_rod(contact=contact_table(law)).contact for law in solvers.LAWS}
WITH_INDENTATION = [law for law in solvers.LAWS if law != "rigid"]
SMOOTH = [law for law in WITH_INDENTATION if not (solvers.LAWS[law].PLASTIC or solvers.LAWS[law].JUMPS)]


def observed_order(value_at: Callable[[float], float], steps: Sequence[float]) -> float:
    """Slope of log(error) over log(step), from the differences of successive values; `steps` in a constant ratio."""
    steps = np.asarray(steps, float)
    assert np.allclose(steps[1:] / steps[:-1], steps[1] / steps[0]), "successive differences need one ratio"
    values = np.array([value_at(step) for step in steps])
    return float(np.polyfit(np.log(steps[:-1]), np.log(np.abs(np.diff(values))), 1)[0])
