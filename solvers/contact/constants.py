"""Constants of contact laws: given outright, or derived from the radii and materials of the two bodies."""

import math
from collections.abc import Mapping
from typing import Any

from .. import validation
from ..text.notes import Note, Severity

STIFFNESS_RANGE = (1e-6, 1e20)  # of any law, in its own unit
EXPONENT_RANGE = (1.0, 3.0)
LENGTH_RANGE = (1e-15, 1e6)  # of indentations [m]
YIELD_VARIED = (1e-6, 1e-9, 1e-2)  # indentation at yield [m]: usual, and the range in which it is varied by hand
# Pressure over the Young's modulus of the softer body: Hertz's is 1.6 times the yield strength as flow begins, and even
# the hardest steel has no more than 1.4 % of its modulus. Not below YIELDING, as rubber bears any share.
LARGE_PRESSURE, YIELDING = 0.025, 1e9  # [Pa]
LARGEST_CONTACT = 1.0 / 3.0  # radius of the contact over that of the bodies: beyond, they are no longer half-spaces


def read_stiffness(given: Mapping[str, Any], unit: str) -> float:
    """`contact.stiffness` of a law that cannot derive it."""
    return validation.required_number("contact", given, "stiffness", *STIFFNESS_RANGE, unit)


def hertz_stiffness(given: Mapping[str, Any], impactor: Any, target: Any) -> float:
    """K_h [N/m^1.5]: as given, or 4/3 E* sqrt(R) of the two bodies.

    Differs: thesis (7.6) prints 2/3 E' sqrt(R) for a rigid sphere; that is right for two bodies of the same material
    (E* = E'/2), and a rigid partner gives 4/3 E' sqrt(R).
    """
    if "stiffness" in given:
        return read_stiffness(given, "N/m^1.5")
    radius, modulus = derived("stiffness", validation.a_number(*STIFFNESS_RANGE, "N/m^1.5"), impactor, target)
    return 4.0 / 3.0 * modulus * math.sqrt(radius)


def derived(name: str, what: Note, impactor: Any, target: Any) -> tuple[float, float]:
    """R [m] and E* [Pa] for a constant that was not given. Raises SceneError where the bodies do not give it."""
    radius, modulus = contact_radius(impactor, target), contact_modulus(impactor, target)
    if radius is None:
        raise validation.SceneError(f"contact.{name}", None, validation.allowed("radius-or", what=what.table()))
    if modulus is None:
        raise validation.SceneError(f"contact.{name}", None, validation.allowed("modulus-or", what=what.table()))
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


def yield_indentation(given: Mapping[str, Any], impactor: Any, target: Any) -> float:
    """alpha_Y [m], where plastic flow begins: as given, or from the lower of the two yield strengths.

    Source: thesis (7.26), a peak pressure of 1.6 yield strengths: alpha_Y = (0.8 pi sigma_Y / E*)^2 R.
    Differs: (7.7) has 2.72 pi^2 = 26.85 where (7.26) has (1.6 pi)^2 = 25.27, a pressure of 1.65 yield strengths; table
    7.1 was made with (7.26). Both are printed for two bodies of one material, E' = 2 E*.
    """
    if "yield_indentation" in given:
        return validation.number("contact.yield_indentation", given["yield_indentation"], *LENGTH_RANGE, "m")
    what = validation.a_number(*LENGTH_RANGE, "m")
    radius, modulus = derived("yield_indentation", what, impactor, target)
    strength = yield_strength(impactor, target)
    if strength is None:
        reason = validation.allowed("strength-or", what=what.table())
        raise validation.SceneError("contact.yield_indentation", None, reason)
    return first_yield(radius, modulus, strength)


def first_yield(radius: float, modulus: float, strength: float) -> float:
    """alpha_Y [m], (7.26)."""
    return (0.8 * math.pi * strength / modulus) ** 2 * radius


def yield_strength(impactor: Any, target: Any) -> float | None:
    """The lower yield strength of the two [Pa], as that body flows first; None if neither is known."""
    materials = (body.material for body in (impactor, target) if body.material is not None)
    return min((m.yield_strength for m in materials if m.yield_strength is not None), default=None)


def point_limits(deepest: float, impactor: Any, target: Any, plastic: bool) -> list[Note]:
    """What a law for two smooth bodies that touch in a point leaves out of an impact as deep as this [m]."""
    radius, modulus, strength = contact_radius(impactor, target), contact_modulus(impactor, target), None
    if radius is None:
        return []
    found = []
    strength = yield_strength(impactor, target)
    if strength is not None and modulus is not None and not plastic:
        begins = first_yield(radius, modulus, strength)
        if deepest > begins:
            found.append(Note("beyond-first-yield", Severity.WARNING, times=deepest / begins))
    if strength is None and modulus is not None and not plastic:
        pressure = 2.0 / math.pi * modulus * math.sqrt(deepest / radius)
        softer = min(body.material.young for body in (impactor, target) if body.material is not None)
        if softer >= YIELDING and pressure > LARGE_PRESSURE * softer:
            found.append(Note("pressure-large", Severity.REMARK, pressure=pressure, share=pressure / softer))
    contact = math.sqrt(deepest * radius * (2.0 if plastic else 1.0)) / radius
    if contact > LARGEST_CONTACT:
        slower = approach_speed(impactor, target) * (LARGEST_CONTACT / contact) ** (2.0 if plastic else 2.5)
        found.append(Note("contact-too-wide", Severity.WARNING, share=contact, slower=slower))
    return found
