"""What strikes and what is struck: data, and what follows from them.

To add a kind of body: write its class on one of `Lumped`, `Waveguide`, `Bending` or `AnyBody`, which say what methods
may ask of it, and name it in IMPACTORS or TARGETS.
"""

from collections.abc import Mapping

from .. import validation
from .balls import Balls
from .beams import Beam, Bending
from .drop import DROPPED, fallen
from .drop import KEYS as DROP_KEYS
from .linkage import Mechanism
from .lumped import RigidMass, SpringMass, Wall
from .material import MATERIALS, Material, read_material
from .pendulum import FlexiblePendulum, Pendulum, Pivoted, Swing
from .protocol import AnyBody, Lumped
from .pulse import Pulse
from .rigid_body import Body, check_struck, in_space, read_normal
from .rods import Joint, Rod, Rods, Waveguide
from .rotating import RotatingRod
from .sections import Section

IMPACTORS: dict[str, type[AnyBody]] = {
    "mass": RigidMass,
    "sphere": RigidMass,
    "rod": Rod,
    "rods": Rods,
    "beam": Beam,
    "pendulum": Pendulum,
    "body": Body,
    "pulse": Pulse,
    "mechanism": Mechanism,
}
TARGETS: dict[str, type[AnyBody]] = {
    "rod": Rod,
    "rods": Rods,
    "rotating-rod": RotatingRod,
    "beam": Beam,
    "mass": RigidMass,
    "pendulum": Pendulum,
    "spring-mass": SpringMass,
    "stop": Wall,
    "half-space": Wall,
    "body": Body,
    "balls": Balls,
    "mechanism": Mechanism,
}

__all__ = [
    "IMPACTORS",
    "MATERIALS",
    "TARGETS",
    "AnyBody",
    "Balls",
    "Beam",
    "Bending",
    "Body",
    "FlexiblePendulum",
    "Joint",
    "Lumped",
    "Material",
    "Mechanism",
    "Pendulum",
    "Pivoted",
    "Pulse",
    "RigidMass",
    "Rod",
    "Rods",
    "RotatingRod",
    "Section",
    "SpringMass",
    "Swing",
    "Wall",
    "Waveguide",
    "check_struck",
    "in_space",
    "read_body",
    "read_material",
    "read_normal",
]


def read_body(key: str, given: object) -> AnyBody:
    """A body from the table `[impactor]` or `[target]` of a scene file, by its `kind`. Raises SceneError."""
    kinds, usual = (IMPACTORS, "mass") if key == "impactor" else (TARGETS, "rod")
    if not isinstance(given, Mapping):
        raise validation.SceneError(key, given, validation.allowed("kind-table"))
    kind = validation.choice(f"{key}.kind", given.get("kind", usual), kinds)
    drops = key == "impactor" and kind != Mechanism.kind  # which has a gravity of its own
    if drops and kind in DROPPED:
        validation.table(key, given, (*kinds[kind].KEYS, *DROP_KEYS))
    return kinds[kind].read(key, fallen(given, kind) if drops else given)
