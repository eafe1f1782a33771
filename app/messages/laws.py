"""What the browser needs of a contact law to answer other choices by itself: see app/wasm."""

import math
from dataclasses import replace
from typing import Any

from solvers import LAWS, Scene
from solvers.bodies import RigidMass, Waveguide
from solvers.contact import Rigid


def law_fields(scene: Scene) -> dict[str, Any] | None:
    """The law of an impact on rods with its constants in units of T, v and Z v, and the powers with which these grow
    with the speed and with the mass that both bodies are felt with; None where nothing gives way.

    The constants are products of powers, so that what doubling does to them tells these. A damping grows where it
    follows from a restitution, which stays.
    """
    law, impactor, target = scene.contact, scene.impactor, scene.target
    if isinstance(law, Rigid) or not isinstance(target, Waveguide) or not isinstance(impactor, RigidMass):
        return None
    constants = _scaled(scene, law, 1.0)
    faster = replace(impactor, velocity=target.velocity + 2.0 * scene.speed)
    heavy = replace(impactor, mass=target.mass)
    light = replace(impactor, mass=target.mass / (2.0 if target.held else 3.0))  # felt with half the mass
    return {
        "name": law.NAME,
        "constants": constants,
        "bySpeed": _powers(constants, _scaled(scene, _between(scene, faster), 2.0)),
        "byMass": _powers(*(_scaled(scene, _between(scene, body), 1.0) for body in (light, heavy))),
    }


def _between(scene: Scene, impactor: Any) -> Any:
    """The law of this scene if another impactor struck."""
    law, given = scene.contact, scene.given.get("contact", {})
    follows = law.LOSSY and {"restitution", "nominal_restitution"} & set(given)
    return LAWS[law.NAME].read(given, impactor, scene.target) if follows else law


def _scaled(scene: Scene, law: Any, times: float) -> list[float]:
    """Its constants, at a speed that is so many times as high."""
    speed = times * scene.speed
    return list(law.scaled(speed * scene.time_unit, speed, scene.target.known_as(Waveguide).impedance * speed))


def _powers(before: list[float], after: list[float]) -> list[float]:
    return [math.log2(b / a) if a and b else 0.0 for a, b in zip(before, after, strict=True)]
