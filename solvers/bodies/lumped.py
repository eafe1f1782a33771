"""Bodies in which no wave runs: rigid masses, a mass on a spring, walls."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from .. import validation
from ..numerics.elements.mesh import Mesh, point_mesh
from ..numerics.modes import Modes, one_mode, rigid_body
from ..validation import SceneError
from .material import LENGTH_RANGE, MATERIALS, Material, read_material, read_radius, required_material
from .protocol import Lumped

MASS_RANGE = (1e-12, 1e12)  # kg
SPEED_RANGE = (1e-9, 1e6)  # m/s, of an approach


def read_impact_velocity(given: Mapping[str, Any]) -> float:
    """`impactor.velocity`, which cannot be left out."""
    return validation.required_number("impactor", given, "velocity", *SPEED_RANGE, "m/s")


def read_target_velocity(given: Mapping[str, Any]) -> float:
    """`target.velocity`, zero unless given; positive the way the impactor goes."""
    return validation.number("target.velocity", given.get("velocity", 0.0), -SPEED_RANGE[1], SPEED_RANGE[1], "m/s")


@dataclass(frozen=True)
class RigidMass(Lumped):
    """A rigid body whose centre of mass lies in line with the contact: impactor or target."""

    mass: float  # [kg]
    velocity: float = 0.0  # [m/s], positive the way the impactor goes; what strikes needs one
    radius: float | None = None  # of curvature at the contact [m]
    material: Material = MATERIALS["steel"]
    kind: str = field(default="mass", kw_only=True)  # or "sphere"

    KEYS = ("kind", "mass", "velocity", "radius", "material")
    free_mass = True

    def __post_init__(self) -> None:
        if isinstance(self.mass, str):  # the kind came first until 0.2
            raise SceneError("mass", self.mass, validation.a_number(*MASS_RANGE, "kg"))

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "RigidMass":
        given = validation.table(key, given, cls.KEYS)
        kind = str(given.get("kind", "mass"))
        material = read_material(f"{key}.material", given.get("material", "steel"))
        radius = read_radius(f"{key}.radius", given.get("radius"))
        if kind == "sphere" and radius is None:
            reason = validation.allowed("sphere-radius", what=validation.a_number(*LENGTH_RANGE, "m").table())
            raise SceneError(f"{key}.radius", None, reason)
        if radius is not None and kind == "sphere" and "mass" not in given:
            mass = 4.0 / 3.0 * math.pi * radius**3 * material.density
        else:
            mass = validation.required_number(key, given, "mass", *MASS_RANGE, "kg")
        velocity = read_impact_velocity(given) if key == "impactor" else read_target_velocity(given)
        return cls(mass, velocity, radius, material, kind=kind)

    def of_mass(self, mass: float) -> dict[str, float]:
        return {"mass": mass}

    def modes(self, count: int) -> Modes:
        return rigid_body(self.mass)

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        return point_mesh(self.mass)

    def table(self) -> dict[str, Any]:
        written = {"kind": self.kind, "mass": self.mass, "velocity": self.velocity}
        return written | _radius(self.radius) | {"material": self.material.table()}


@dataclass(frozen=True)
class SpringMass(Lumped):
    """A mass on a spring whose other end is held: the simplest body that can ring. Source: thesis 4.6."""

    mass: float  # [kg]
    stiffness: float  # [N/m]
    radius: float | None = None
    material: Material = MATERIALS["steel"]

    KEYS = ("kind", "mass", "stiffness", "radius", "material")
    kind = "spring-mass"
    velocity = 0.0
    fixed = held = True

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "SpringMass":
        given = validation.table(key, given, cls.KEYS)
        return cls(
            validation.required_number(key, given, "mass", *MASS_RANGE, "kg"),
            validation.required_number(key, given, "stiffness", 1e-6, 1e20, "N/m"),
            read_radius(f"{key}.radius", given.get("radius")),
            read_material(f"{key}.material", given.get("material", "steel")),
        )

    @property
    def frequency(self) -> float:
        """sqrt(k / m) [rad/s]"""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def half_swing(self) -> float:
        return math.pi / self.frequency

    @property
    def softness(self) -> float:
        return 1.0 / self.stiffness

    def modes(self, count: int) -> Modes:
        return one_mode(self.mass, self.frequency)

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        return point_mesh(self.mass, self.stiffness)

    def table(self) -> dict[str, Any]:
        written = {"kind": self.kind, "mass": self.mass, "stiffness": self.stiffness}
        return written | _radius(self.radius) | {"material": self.material.table()}


@dataclass(frozen=True)
class Wall(Lumped):
    """What does not move: a rigid stop, or an elastic half-space that gives way at the contact only."""

    kind: str  # "stop" or "half-space"
    radius: float | None = None
    material: Material | None = None  # None: rigid
    velocity: float = 0.0  # [m/s], as seen from a mechanism that runs into it

    KEYS = ("kind", "radius", "material")
    mass = math.inf
    fixed = held = True

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "Wall":
        given = validation.table(key, given, cls.KEYS)
        kind = str(given["kind"])
        if kind == "half-space":
            required_material(key, given)
        material = given.get("material")
        return cls(
            kind,
            read_radius(f"{key}.radius", given.get("radius")),
            None if material is None else read_material(f"{key}.material", material),
        )

    @property
    def kinetic_energy(self) -> float:
        return 0.0

    @property
    def endless(self) -> bool:
        return self.kind == "half-space"

    def modes(self, count: int) -> Modes:
        return rigid_body(math.inf)

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        return point_mesh(math.inf)

    def table(self) -> dict[str, Any]:
        material = {} if self.material is None else {"material": self.material.table()}
        return {"kind": self.kind} | _radius(self.radius) | material


def _radius(radius: float | None) -> dict[str, float]:
    return {} if radius is None else {"radius": radius}
