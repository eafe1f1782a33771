"""What strikes and what is struck: data, and what follows from them.

To add a kind of body: write its class (KEYS, read, table, and the attributes that every axial body has: mass, velocity,
fixed, held, radius, material, length, time_unit, modes) and name it in IMPACTORS or TARGETS.
"""

from collections.abc import Mapping

from .. import checks
from .beams import Beam
from .body import Body, check_struck, in_space, read_normal
from .compact import RigidMass, SpringMass, Wall
from .material import MATERIALS, Material, read_material
from .pulse import Pulse
from .rods import Joint, Rod, Rods

IMPACTORS = {"mass": RigidMass, "sphere": RigidMass, "rod": Rod, "beam": Beam, "body": Body, "pulse": Pulse}
TARGETS = {
    "rod": Rod,
    "rods": Rods,
    "beam": Beam,
    "mass": RigidMass,
    "spring-mass": SpringMass,
    "stop": Wall,
    "half-space": Wall,
    "body": Body,
}

__all__ = [
    "IMPACTORS",
    "MATERIALS",
    "TARGETS",
    "Beam",
    "Body",
    "Joint",
    "Material",
    "Pulse",
    "RigidMass",
    "Rod",
    "Rods",
    "SpringMass",
    "Wall",
    "check_struck",
    "in_space",
    "read_body",
    "read_material",
    "read_normal",
]


def read_body(key: str, given: object):
    """A body from the table `[impactor]` or `[target]` of a scene file, by its `kind`. Raises SceneError."""
    kinds, usual = (IMPACTORS, "mass") if key == "impactor" else (TARGETS, "rod")
    if not isinstance(given, Mapping):
        raise checks.SceneError(key, given, "a table with kind and what that kind needs")
    kind = checks.choice(f"{key}.kind", given.get("kind", usual), kinds)
    return kinds[kind].read(key, given)
