"""What the browser needs of a rod that turns: its place, its fields, and what the rotation does to it."""

from typing import Any, TypeGuard

import numpy as np

from solvers import Solution
from solvers.bodies import AnyBody, RotatingRod
from solvers.methods.modal.motion import ModalMotion

from .encoding import whole_numbers

INSTANTS, PLACES = 160, 31  # of the fields, which no waves of one speed give
LISTED = 3  # frequencies
BAR_PLACES = 25  # of one that bends, as many as of a pendulum


def turns(body: AnyBody) -> TypeGuard[RotatingRod]:
    """Whether it is a rod that turns and is struck along its length."""
    return isinstance(body, RotatingRod) and not body.across


def turning_rod(rod: RotatingRod) -> list[dict[str, Any]]:
    """As a rod that is fixed at its far end, the axis."""
    place = {"from": 0.0, "to": rod.length, "transit": 0.5, "impedance": 1.0, "drift": 0.0, "area": 1.0}
    return [place | {"joint": None, "mirror": 1}]


def turning_fields(solution: Solution, stress_unit: float, length_unit: float) -> dict[str, Any]:
    """Fields at (instant, place), displacements from the steady stretch."""
    rod, motion = solution.scene.target, solution.known_motion
    time, x = np.linspace(0.0, solution.duration, INSTANTS), np.linspace(0.0, rod.length, PLACES)
    return {
        "exactStress": whole_numbers(motion.stress(time, x) / stress_unit),
        "exactVelocity": whole_numbers(motion.velocity(time, x) / solution.scene.speed),
        "exactDisplacement": whole_numbers(motion.displacement(time, x) / length_unit),
    }


def bent_shapes(solution: Solution, time: np.ndarray, length_unit: float) -> dict[str, Any]:
    """Displacements along a rod that turns and is struck across, from its axis on; nothing of other bodies."""
    rod = solution.scene.target
    if not isinstance(rod, RotatingRod) or not rod.across:
        return {}
    places = np.linspace(0.0, rod.length, BAR_PLACES)
    return {"turningBar": whole_numbers(solution.known_motion.displacement(time, places) / length_unit)}


def axis_moments(name: str, solution: Solution, time: np.ndarray) -> dict[str, Any]:
    """Bending moments of a rod that turns and is struck across [N m], (instants, 3): at its axis, half way, and at the
    contact."""
    rod, motion = solution.scene.target, solution.known_motion
    if not isinstance(rod, RotatingRod) or not rod.across or not isinstance(motion, ModalMotion):
        return {}
    places = rod.at * rod.length * np.array([0.0, 0.5, 1.0])
    return {f"{name}Moments": whole_numbers(motion.moment(time, places))}


def rotation_fields(body: AnyBody) -> dict[str, Any]:
    """What the rotation does to a rod, along it and across; nothing of other bodies."""
    if not isinstance(body, RotatingRod):
        return {}
    found = body.figures()
    across = {name: found[name]["frequencies"][:LISTED] if name in found else [] for name in ("bending", "simplified")}
    rotation = {
        "at": body.at,
        "speed": body.speed,
        "critical": body.critical_speed,
        "stretch": body.steady_stretch,
        "strain": body.root_strain,
        "axial": found["axial"]["frequencies"][:LISTED],
    }
    return {"rotation": rotation | across}
