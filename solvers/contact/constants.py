"""Constants of contact laws: given outright, or derived from the radii and materials of the two bodies."""

import math
from collections.abc import Mapping
from typing import Any

from .. import checks

STIFFNESS_RANGE = (1e-6, 1e20)  # of any law, in its own unit


def read_stiffness(given: Mapping[str, object], unit: str) -> float:
    """`contact.stiffness` of a law that cannot derive it."""
    value = checks.required("contact", given, "stiffness", f"a number from 1e-06 to 1e+20 {unit}")
    return checks.number("contact.stiffness", value, *STIFFNESS_RANGE, unit)


def hertz_stiffness(given: Mapping[str, object], impactor: Any, target: Any) -> float:
    """K_h [N/m^1.5]: as given, or 4/3 E* sqrt(R) of the two bodies.

    Differs: thesis (7.6) prints 2/3 E' sqrt(R) for a rigid sphere; that is right for two bodies of the same material
    (E* = E'/2), and a rigid partner gives 4/3 E' sqrt(R).
    """
    if "stiffness" in given:
        return read_stiffness(given, "N/m^1.5")
    radius, modulus = derived("stiffness", "1e-06 to 1e+20 N/m^1.5", impactor, target)
    return 4.0 / 3.0 * modulus * math.sqrt(radius)


def derived(name: str, values: str, impactor: Any, target: Any) -> tuple[float, float]:
    """R [m] and E* [Pa] for a constant that was not given. Raises SceneError where the bodies cannot tell."""
    radius, modulus = contact_radius(impactor, target), contact_modulus(impactor, target)
    if radius is None:
        allowed = f"a number from {values}, or impactor.radius or target.radius to derive it from (all are missing)"
        raise checks.SceneError(f"contact.{name}", None, allowed)
    if modulus is None:
        allowed = f"a number from {values}, or a material of at least one body (both are rigid)"
        raise checks.SceneError(f"contact.{name}", None, allowed)
    return radius, modulus


def contact_radius(impactor: Any, target: Any) -> float | None:
    """R [m] with 1/R = 1/R1 + 1/R2, a flat face having no curvature; None if both are flat."""
    curvature = sum(1.0 / body.radius for body in (impactor, target) if body.radius is not None)
    return 1.0 / curvature if curvature else None


def contact_modulus(impactor: Any, target: Any) -> float | None:
    """E* [Pa] with 1/E* = sum of (1 - nu^2) / E, a rigid body giving nothing; None if both are rigid."""
    softness = sum(1.0 / body.material.plane_modulus for body in (impactor, target) if body.material is not None)
    return 1.0 / softness if softness else None


def reduced_mass(impactor: Any, target: Any) -> float:
    """m1 m2 / (m1 + m2) [kg] of the two as rigid bodies; that of the impactor alone if the target is held."""
    return impactor.mass if target.held else impactor.mass / (1.0 + impactor.mass / target.mass)


def approach_speed(impactor: Any, target: Any) -> float:
    """v1 - v2 [m/s]."""
    return impactor.velocity - target.velocity
