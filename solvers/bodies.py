"""What strikes and what is struck: data, and what follows from them."""

import math
from dataclasses import asdict, dataclass

from . import checks
from .checks import SceneError
from .numerics.modes import Modes, rod_modes


@dataclass(frozen=True)
class Material:
    """Linear elastic, homogeneous."""

    young: float  # E [Pa]
    density: float  # rho [kg/m3]
    poisson: float = 0.3

    @property
    def plane_modulus(self) -> float:
        """E / (1 - nu^2) [Pa]: what a contact feels of one body."""
        return self.young / (1.0 - self.poisson**2)


MATERIALS = {
    "steel": Material(210e9, 7900.0, 0.30),  # thesis 5.3
    "bronze": Material(98e9, 8600.0, 0.34),  # thesis 9.5; Poisson's ratio is a handbook value
    "aluminium": Material(70e9, 2700.0, 0.33),
}


def read_material(key: str, given: object) -> Material:
    """A material by name, or by its constants.

    Raises SceneError naming the key.
    """
    if isinstance(given, str):
        return MATERIALS[checks.choice(key, given, MATERIALS)]
    given = checks.table(key, given, ("young", "density", "poisson", "yield"))
    if "yield" in given:  # of no consequence in an elastic rod
        checks.number(f"{key}.yield", given["yield"], 1.0, 1e13, "Pa")
    needed = "a number; or give a material by name: " + ", ".join(MATERIALS)
    return Material(
        checks.number(f"{key}.young", checks.required(key, given, "young", needed), 1e3, 1e13, "Pa"),
        checks.number(f"{key}.density", checks.required(key, given, "density", needed), 1e-2, 1e6, "kg/m3"),
        checks.number(f"{key}.poisson", given.get("poisson", 0.3), -0.99, 0.499),
    )


@dataclass(frozen=True)
class Impactor:
    """A rigid body that strikes with its centre of mass in line with the contact."""

    kind: str  # "mass" or "sphere"
    mass: float  # m1 [kg]
    velocity: float  # [m/s], towards the target
    radius: float | None = None  # of curvature at the contact [m]
    material: Material = MATERIALS["steel"]

    KEYS = ("kind", "mass", "velocity", "radius", "material")

    @classmethod
    def read(cls, given: object) -> "Impactor":
        """From the table `[impactor]` of a scene file. Raises SceneError naming the key."""
        given = checks.table("impactor", given, cls.KEYS)
        kind = checks.choice("impactor.kind", given.get("kind", "mass"), ("mass", "sphere"))
        material = read_material("impactor.material", given.get("material", "steel"))
        radius = given.get("radius")
        if radius is not None:
            radius = checks.number("impactor.radius", radius, 1e-6, 1e6, "m")
        if kind == "sphere" and radius is None:
            raise SceneError("impactor.radius", None, "a number from 1e-06 to 1e+06 m: a sphere needs its radius")
        if "mass" in given:
            mass = checks.number("impactor.mass", given["mass"], 1e-12, 1e12, "kg")
        elif kind == "sphere":
            mass = 4.0 / 3.0 * math.pi * radius**3 * material.density
        else:
            raise SceneError("impactor.mass", None, "a number from 1e-12 to 1e+12 kg (the key is missing)")
        velocity = checks.required("impactor", given, "velocity", "a number from 1e-09 to 1e+06 m/s")
        return cls(kind, mass, checks.number("impactor.velocity", velocity, 1e-9, 1e6, "m/s"), radius, material)


@dataclass(frozen=True)
class Rod:
    """A uniform straight rod struck on one end face; waves run along it at one speed and keep their shape.

    Assumes: plane sections, uniaxial stress, small strain. x runs from the struck end (0) to the far end (length).
    Source: thesis 4.2.
    """

    length: float  # L [m]
    area: float  # A [m2]
    material: Material
    support: str  # of the far end: "fixed" or "free"

    KEYS = ("kind", "length", "section", "material", "support", "at")

    @classmethod
    def read(cls, given: object) -> "Rod":
        """From the table `[target]` of a scene file. Raises SceneError naming the key."""
        given = checks.table("target", given, cls.KEYS)
        checks.choice("target.kind", given.get("kind", "rod"), ("rod",))
        checks.number("target.at", given.get("at", 1.0), 1.0, 1.0, "(a rod is struck on its end)")
        length = checks.required("target", given, "length", "a number from 1e-06 to 1e+06 m")
        section = checks.required("target", given, "section", _SECTION)
        material = checks.required("target", given, "material", "a name or a table with young and density")
        return cls(
            checks.number("target.length", length, 1e-6, 1e6, "m"),
            read_section("target.section", section),
            read_material("target.material", material),
            checks.choice("target.support", given.get("support", "fixed"), ("fixed", "free")),
        )

    @property
    def fixed(self) -> bool:
        return self.support == "fixed"

    @property
    def mass(self) -> float:
        """m2 [kg]"""
        return self.material.density * self.area * self.length

    @property
    def wave_speed(self) -> float:
        """c = sqrt(E / rho) [m/s]"""
        return math.sqrt(self.material.young / self.material.density)

    @property
    def impedance(self) -> float:
        """Z = rho c A [kg/s]: force over velocity in a travelling wave."""
        return self.material.density * self.wave_speed * self.area

    @property
    def round_trip_time(self) -> float:
        """T = 2 L / c [s], (4.10): the unit in which everything that waves do is measured."""
        return 2.0 * self.length / self.wave_speed

    @property
    def stiffness(self) -> float:
        """E A / L [N/m]: under a slow load on the end of the fixed rod."""
        return self.material.young * self.area / self.length

    def modes(self, count: int) -> Modes:
        return rod_modes(self.length, self.mass, self.wave_speed, self.fixed, count)


_SECTION = "{ width, height }, { radius } or { area }"


def read_section(key: str, given: object) -> float:
    """Area [m2] of a section given by width and height, by radius, or outright.

    Raises SceneError naming the key.
    """
    bending = ("second_moment", "shear_coefficient")  # of no consequence in a rod struck on its end
    given = checks.table(key, given, ("width", "height", "radius", "area", *bending))
    for name in bending:
        if name in given:
            checks.number(f"{key}.{name}", given[name], 1e-30, 1e16 if name == "second_moment" else 1.0)
    names = frozenset(given) - frozenset(bending)
    if names not in ({"width", "height"}, {"radius"}, {"area"}):
        got = dict(given)
        raise SceneError(key, got, f"exactly one of {_SECTION}")
    if "area" in given:
        return checks.number(f"{key}.area", given["area"], 1e-14, 1e8, "m2")
    sides = {name: checks.number(f"{key}.{name}", given[name], 1e-7, 1e4, "m") for name in names}
    return math.pi * sides["radius"] ** 2 if "radius" in sides else sides["width"] * sides["height"]


def as_table(body: Impactor | Rod) -> dict[str, object]:
    """The body as a table of a scene file."""
    if isinstance(body, Rod):
        return {
            "kind": "rod",
            "length": body.length,
            "section": {"area": body.area},
            "material": asdict(body.material),
            "support": body.support,
            "at": 1.0,
        }
    written = {"kind": body.kind, "mass": body.mass, "velocity": body.velocity}
    if body.radius is not None:
        written["radius"] = body.radius
    return written | {"material": asdict(body.material)}
