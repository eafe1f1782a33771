"""What a motion can be asked for, with names and units: one table for arrays and plots."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

# Long names are in English in every language: they go into files of arrays (netCDF), which others read elsewhere.
PARTS = {
    "impactor": "kinetic and elastic energy of the impactor",
    "target_rigid": "energy of the target moving as a whole",
    "target_vibration": "energy of the target's vibration",
    "local": "energy stored in the contact",
    "dissipated": "energy lost",
    "drives": "energy taken up by the drives of a mechanism",
    "weight": "energy gone into height",
    "springs": "energy stored in the springs of a mechanism",
}


class Figure(NamedTuple):
    """`of(motion, time)` gives (time,), of a field `of(motion, time, x)` gives (time, x), in `unit`."""

    unit: str
    long_name: str
    of: Callable[..., np.ndarray]


STRIKING = {
    "impactor_position": Figure("m", "displacement of the impactor", lambda m, t: m.impactor_position(t)),
    "impactor_velocity": Figure("m/s", "velocity of the impactor", lambda m, t: m.impactor_velocity(t)),
}
HISTORIES = {
    "contact_force": Figure("N", "contact force, compression positive", lambda m, t: m.force(t)),
    "impulse": Figure("N s", "impulse of the contact force so far", lambda m, t: m.impulse(t)),
    "end_position": Figure("m", "displacement of the struck face of the target", lambda m, t: m.end_position(t)),
    "end_velocity": Figure("m/s", "velocity of the struck face of the target", lambda m, t: m.end_velocity(t)),
    "target_mean_velocity": Figure("m/s", "mean velocity of the target", lambda m, t: m.rigid_velocity(t)),
}
FIELDS = {
    "displacement": Figure("m", "displacement", lambda m, t, x: m.displacement(t, x)),
    "velocity": Figure("m/s", "velocity", lambda m, t, x: m.velocity(t, x)),
    "stress": Figure("Pa", "stress, compression positive", lambda m, t, x: m.stress(t, x)),
}
BENDING = {
    "bending_moment": Figure("N m", "bending moment", lambda m, t, x: m.moment(t, x)),
    "shear_force": Figure("N", "shear force", lambda m, t, x: m.shear(t, x)),
}


BANDS = {  # of an ensemble
    "force": Figure("N", "contact force", HISTORIES["contact_force"].of),
    "struck_position": HISTORIES["end_position"],
    "impactor_velocity": STRIKING["impactor_velocity"],
}


def histories_of(scene: Any) -> dict[str, Figure]:
    """Of this scene over time: a prescribed force has no impactor that moves."""
    return HISTORIES if scene.prescribed_force else HISTORIES | STRIKING


def fields_of(scene: Any) -> dict[str, Figure]:
    """Of this scene over time and place."""
    return FIELDS | BENDING if scene.target.bends else FIELDS


def reach(solution: Any) -> tuple[float, float]:
    """First and last place [m] of its fields: those of the target, before them those of a rod that strikes along the
    axis, if the motion knows it; both zero where no body has a length.
    """
    scene = solution.scene
    along = bool(scene.impactor.rods) and not scene.target.bends and getattr(solution.motion, "has_field", True)
    return -scene.impactor.length if along else 0.0, scene.target.length


def origin(scene: Any) -> str:
    """From where places are measured."""
    return "the first support" if scene.target.bends else "the struck end"
