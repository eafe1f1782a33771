"""The steel sphere of thesis table 7.1 on a half-space."""

from solvers import Scene

STEEL_GROUND = {"kind": "half-space", "material": "steel"}
STEEL_400 = {"young": 210e9, "density": 7900.0, "poisson": 0.3, "yield": 400e6}


def sphere_scene(contact, impactor=None, target=None) -> Scene:
    """The steel sphere of table 7.1 on a half-space of the same steel."""
    return Scene.from_table(
        {
            "impactor": {"kind": "sphere", "radius": 0.04, "material": STEEL_400, "velocity": 1.0} | (impactor or {}),
            "target": {"kind": "half-space", "material": STEEL_400} if target is None else target,
            "contact": contact,
        }
    )
