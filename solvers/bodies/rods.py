"""Straight rods and chains of rods, along which waves run."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from .. import checks
from ..checks import SceneError
from ..numerics.elements import Mesh, rod_mesh
from ..numerics.modes import Modes, attached_rod_modes, rod_modes
from .compact import MASS_RANGE, read_impact_velocity, read_target_velocity
from .material import Material, read_material, read_radius
from .sections import section_of_bar

SUPPORTS = ("fixed", "free", "anechoic")
MAX_RODS = 12


@dataclass(frozen=True)
class Rod:
    """A uniform straight rod struck on one end face; waves run along it at one speed and keep their shape.

    Assumes: plane sections, uniaxial stress, small strain. x runs from the struck end (0) to the far end (length).
    `support` is that of the far end: "fixed", "free", or "anechoic", where waves run on for ever (a semi-infinite rod).
    Source: thesis 4.2.
    """

    length: float  # L [m]
    area: float  # A [m2]
    material: Material
    support: str
    velocity: float = 0.0  # [m/s], positive the way the impactor goes
    end_mass: float = 0.0  # rigid mass on the far end [kg]
    radius: float | None = None  # of curvature of the struck end [m]

    KEYS = ("kind", "length", "section", "material", "support", "at", "velocity", "end_mass", "radius")
    kind = "rod"
    swings = False

    @classmethod
    def read(cls, key: str, given: Mapping[str, object]) -> "Rod":
        """From the table `[impactor]` or `[target]` of a scene file. Raises SceneError naming the key."""
        given = checks.table(key, given, cls.KEYS)
        checks.number(f"{key}.at", given.get("at", 1.0), 1.0, 1.0, "(a rod is struck on its end)")
        length, area, material = _read_bar(key, given)
        if key == "impactor":
            checks.choice("impactor.support", given.get("support", "free"), ("free",))
            velocity, support = read_impact_velocity(given), "free"
        else:
            velocity = read_target_velocity(given)
            support = checks.choice("target.support", given.get("support", "fixed"), SUPPORTS)
        return cls(
            length,
            area,
            material,
            support,
            velocity if support == "free" else _still(key, velocity),
            _read_end_mass(key, given, support),
            read_radius(f"{key}.radius", given.get("radius")),
        )

    @property
    def fixed(self) -> bool:
        """Whether waves come back from the far end as they went."""
        return self.support == "fixed"

    @property
    def held(self) -> bool:
        """Whether something outside takes up momentum."""
        return self.support != "free"

    @property
    def mass(self) -> float:
        """m2 [kg], with what is fixed to its far end"""
        return self.material.density * self.area * self.length + self.end_mass

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

    time_unit = round_trip_time

    @property
    def stiffness(self) -> float:
        """E A / L [N/m]: under a slow load on the end of the fixed rod."""
        return self.material.young * self.area / self.length

    @property
    def rods(self) -> tuple["Rod", ...]:
        """The rod as a chain of one."""
        return (self,)

    joints = ()

    def modes(self, count: int) -> Modes:
        return rod_modes(self.length, self.mass, self.wave_speed, self.fixed, count)

    def attached_modes(self, count: int, struck_end: bool) -> Modes:
        """Of the free rod, as a frame fixed to its struck or its far end and shapes clamped there give them."""
        return attached_rod_modes(self.length, self.mass, self.wave_speed, count, struck_end)

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        """Two-node elements of equal length; `lumping` of their mass stands on the nodes."""
        return _mesh(self.rods, elements, self.fixed, lumping)

    def table(self) -> dict[str, object]:
        """As in a scene file."""
        written = {"kind": "rod"} | _bar_table(self) | {"support": self.support, "at": 1.0}
        for name, nothing in (("velocity", 0.0), ("end_mass", 0.0), ("radius", None)):
            if getattr(self, name) != nothing:
                written[name] = getattr(self, name)
        return written


@dataclass(frozen=True)
class Joint:
    """How a rod of a chain meets the one before it: bonded for good, or faces that can only push.

    `contact` is a table with a law, as in `[contact]`, for faces that give way; None: rigid faces.
    """

    bonded: bool
    gap: float = 0.0  # [m] between the faces before the blow
    contact: Mapping[str, object] | None = None


@dataclass(frozen=True)
class Rods:
    """Rods one behind the other, at rest or moving as one; the first is struck, the support is that of the last.

    Source: thesis 4.2 (waves at a change of section or material), 4.7.
    """

    rods: tuple[Rod, ...]
    joints: tuple[Joint, ...]  # between each rod and the next
    support: str
    velocity: float = 0.0
    radius: float | None = None

    KEYS = ("kind", "rods", "support", "velocity", "end_mass", "radius")
    ROD_KEYS = ("length", "section", "material", "joint", "gap", "contact")
    kind = "rods"
    swings = False

    @classmethod
    def read(cls, key: str, given: Mapping[str, object]) -> "Rods":
        """From the table `[target]`; `rods` is a list of tables. Raises SceneError naming the key."""
        given = checks.table(key, given, cls.KEYS)
        parts = checks.required(key, given, "rods", f"a list of 1 to {MAX_RODS} tables, each a rod")
        if not isinstance(parts, list) or not 1 <= len(parts) <= MAX_RODS:
            raise SceneError(f"{key}.rods", parts, f"a list of 1 to {MAX_RODS} tables, each a rod")
        support = checks.choice(f"{key}.support", given.get("support", "fixed"), SUPPORTS)
        velocity = read_target_velocity(given)
        if support != "free":
            _still(key, velocity)
        end_mass = _read_end_mass(key, given, support)
        rods, joints = [], []
        for number, part in enumerate(parts, 1):
            name = f"{key}.rods[{number}]"
            part = checks.table(name, part, cls.ROD_KEYS)
            last = number == len(parts)
            rods.append(Rod(*_read_bar(name, part), support if last else "free", velocity, end_mass if last else 0.0))
            if number > 1:
                joints.append(_read_joint(name, part))
            elif set(part) & {"joint", "gap", "contact"}:
                raise SceneError(name, dict(part), "no joint, gap or contact: the first rod meets the impactor")
        return cls(tuple(rods), tuple(joints), support, velocity, read_radius(f"{key}.radius", given.get("radius")))

    @property
    def fixed(self) -> bool:
        """Whether waves come back from the far end as they went."""
        return self.support == "fixed"

    @property
    def held(self) -> bool:
        """Whether something outside takes up momentum."""
        return self.support != "free"

    @property
    def mass(self) -> float:
        return sum(rod.mass for rod in self.rods)

    @property
    def length(self) -> float:
        return sum(rod.length for rod in self.rods)

    @property
    def area(self) -> float:
        """Of the struck end [m2]."""
        return self.rods[0].area

    @property
    def material(self) -> Material:
        """Of the struck end."""
        return self.rods[0].material

    @property
    def impedance(self) -> float:
        """Of the struck end [kg/s]."""
        return self.rods[0].impedance

    @property
    def round_trip_time(self) -> float:
        """Of the whole chain [s]."""
        return sum(rod.round_trip_time for rod in self.rods)

    time_unit = round_trip_time

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        """As for one rod; every joint is taken as bonded."""
        return _mesh(self.rods, elements, self.fixed, lumping)

    def table(self) -> dict[str, object]:
        """As in a scene file."""
        parts = [_bar_table(rod) for rod in self.rods]
        for part, joint in zip(parts[1:], self.joints, strict=True):
            part |= {"joint": "bonded"} if joint.bonded else {"joint": "touching", "gap": joint.gap}
            if joint.contact is not None:
                part["contact"] = dict(joint.contact)
        written: dict[str, object] = {"kind": "rods", "rods": parts, "support": self.support}
        for name, value, nothing in (
            ("velocity", self.velocity, 0.0),
            ("end_mass", self.rods[-1].end_mass, 0.0),
            ("radius", self.radius, None),
        ):
            if value != nothing:
                written[name] = value
        return written


def _mesh(rods: tuple[Rod, ...], elements: int, fixed: bool, lumping: float) -> Mesh:
    parts = [(rod.length, rod.mass - rod.end_mass, rod.stiffness) for rod in rods]
    return rod_mesh(parts, elements, fixed, rods[-1].end_mass, lumping)


def _read_bar(key: str, given: Mapping[str, object]) -> tuple[float, float, Material]:
    """Length, area and material."""
    length = checks.required(key, given, "length", "a number from 1e-06 to 1e+06 m")
    material = checks.required(key, given, "material", "a name or a table with young and density")
    return (
        checks.number(f"{key}.length", length, 1e-6, 1e6, "m"),
        section_of_bar(key, given).area,
        read_material(f"{key}.material", material),
    )


def _bar_table(rod: Rod) -> dict[str, object]:
    return {"length": rod.length, "section": {"area": rod.area}, "material": rod.material.table()}


def _read_joint(key: str, given: Mapping[str, object]) -> Joint:
    kind = checks.choice(f"{key}.joint", given.get("joint", "bonded"), ("bonded", "touching"))
    contact = given.get("contact")
    if kind == "bonded":
        for name in ("gap", "contact"):
            if name in given:
                raise SceneError(f"{key}.{name}", given[name], 'nothing here, or joint = "touching"')
        return Joint(True)
    if contact is not None and not isinstance(contact, Mapping):
        raise SceneError(f"{key}.contact", contact, "a table with the key law")
    return Joint(False, checks.number(f"{key}.gap", given.get("gap", 0.0), 0.0, 1e3, "m"), contact)


def _read_end_mass(key: str, given: Mapping[str, object], support: str) -> float:
    if "end_mass" not in given:
        return 0.0
    if support != "free":
        raise SceneError(f"{key}.end_mass", given["end_mass"], 'nothing here, or support = "free"')
    return checks.number(f"{key}.end_mass", given["end_mass"], *MASS_RANGE, "kg")


def _still(key: str, velocity: float) -> float:
    if velocity != 0.0:
        raise SceneError(f"{key}.velocity", velocity, '0, or support = "free": what is held does not move')
    return velocity
