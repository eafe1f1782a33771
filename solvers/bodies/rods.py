"""Straight rods and chains of rods, along which waves run."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Self

import numpy as np

from .. import validation
from ..numerics.elements.mesh import Mesh, elements_of_rods, rod_mesh
from ..numerics.modes import Modes
from ..numerics.parting import swing_and_give
from ..numerics.rods import attached_rod_modes, composite_rod_modes, rod_modes
from ..text.notes import Note, Severity
from ..validation import SceneError, allowed
from .lumped import MASS_RANGE, read_impact_velocity, read_target_velocity
from .material import LENGTH_RANGE, MATERIALS, Material, read_radius, required_material
from .protocol import AnyBody
from .sections import section_of_bar

SUPPORTS = ("fixed", "free", "anechoic")
MAX_RODS = 12


class Waveguide(AnyBody):
    """Rods one behind the other, along each of which waves run at one speed and keep their shape."""

    support: str  # of the far end, one of SUPPORTS
    area: float  # of the struck end [m2]
    material: Material  # of the struck end
    impedance: float  # of the struck end, Z = rho c A [kg/s]: force over velocity in a travelling wave
    round_trip_time: float  # of all of it [s], (4.10): the unit in which everything that waves do is measured
    rods: tuple["Rod", ...]  # from the struck end on
    joints: tuple["Joint", ...]  # between each of them and the next

    @property
    def fixed(self) -> bool:
        """Whether waves come back from the far end as they went."""
        return self.support == "fixed"

    @property
    def held(self) -> bool:
        return self.support != "free"

    @property
    def endless(self) -> bool:
        return self.support == "anechoic"

    @property
    def time_unit(self) -> float:
        return self.round_trip_time

    @property
    def softness(self) -> float:
        return sum(1.0 / rod.stiffness for rod in self.rods)

    @cached_property
    def _swing(self) -> tuple[float, float, float]:
        """See `numerics.parting.swing_and_give`."""
        parts = np.array([(rod.impedance, 0.5 * rod.round_trip_time) for rod in self.rods])
        end = math.inf if self.held else self.rods[-1].end_mass
        return swing_and_give(parts[:, 0].copy(), parts[:, 1].copy(), 0.0, end)

    @property
    def slowest_period(self) -> float:
        return self._swing[0]

    @property
    def face_compliance(self) -> float:
        return self._swing[1]

    @property
    def stress_source(self) -> tuple[str, float]:
        """Tension E u'."""
        return "slopes", self.material.young


@dataclass(frozen=True)
class Rod(Waveguide):
    """A uniform straight rod struck on one end face; waves run along it at one speed and keep their shape.

    Assumes: plane sections, uniaxial stress, small strain. x runs from the struck end (0) to the far end (length).
    `support` is that of the far end: "fixed", "free", or "anechoic", where waves run on for ever (a semi-infinite rod).
    Source: thesis 4.2.
    """

    length: float  # L [m]
    area: float  # A [m2]
    material: Material = MATERIALS["steel"]
    support: str = "fixed"  # of a target, as in scene files; one that strikes is "free"
    velocity: float = 0.0  # [m/s], positive the way the impactor goes
    end_mass: float = 0.0  # rigid mass on the far end [kg]
    radius: float | None = None  # of curvature of the struck end [m]
    # I of its section, the least [m4], where that is known; only notes depend on it, so that tables leave it out
    second_moment: float | None = field(default=None, compare=False)

    KEYS = ("kind", "length", "section", "material", "support", "at", "velocity", "end_mass", "radius")
    kind = "rod"
    joints = ()

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "Rod":
        given = validation.table(key, given, cls.KEYS)
        validation.number(f"{key}.at", given.get("at", 1.0), 1.0, 1.0, "(a rod is struck on its end)")
        length, area, material = _read_bar(key, given)
        velocity, support = _read_motion(key, given)
        return cls(
            length,
            area,
            material,
            support,
            velocity,
            _read_end_mass(key, given, support),
            read_radius(f"{key}.radius", given.get("radius")),
            section_of_bar(key, given).least_moment,
        )

    @cached_property
    def mass(self) -> float:
        """m2"""
        return self.material.density * self.area * self.length + self.end_mass

    @cached_property
    def wave_speed(self) -> float:
        """c = sqrt(E / rho) [m/s]"""
        return math.sqrt(self.material.young / self.material.density)

    @cached_property
    def impedance(self) -> float:
        """rho c A"""
        return self.material.density * self.wave_speed * self.area

    @cached_property
    def round_trip_time(self) -> float:
        """T = 2 L / c"""
        return 2.0 * self.length / self.wave_speed

    @property
    def stiffness(self) -> float:
        """E A / L [N/m]: under a slow load on the end of the fixed rod."""
        return self.material.young * self.area / self.length

    @property
    def rods(self) -> tuple["Rod", ...]:
        """The rod as a chain of one."""
        return (self,)

    @property
    def no_modes(self) -> Note | None:
        if self.end_mass or self.endless:
            return Note("refusals.open-rod", Severity.REFUSAL)
        return None

    @property
    def slowest_period(self) -> float:
        """Exactly, without a mass on its end."""
        if self.end_mass:
            return super().slowest_period
        return (2.0 if self.held else 1.0) * self.round_trip_time

    def modes(self, count: int) -> Modes:
        return rod_modes(self.length, self.mass, self.wave_speed, self.fixed, count)

    def attached_modes(self, count: int, struck_end: bool) -> Modes:
        """Of the free rod, as a frame fixed to its struck or its far end and shapes clamped there give them."""
        return attached_rod_modes(self.length, self.mass, self.wave_speed, count, struck_end)

    def joined_modes(self, count: int, mass: float) -> Modes:
        """Of the rod and a rigid mass [kg] that stays on its struck end; see `numerics.rods.composite_rod_modes`.

        Of rods that have modes of their own.
        """
        return composite_rod_modes(self.length, self.mass, self.wave_speed, self.fixed, count, mass)

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        """Elements of equal length."""
        return _mesh(self.rods, elements, self.fixed, lumping)

    def table(self) -> dict[str, Any]:
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
    gap: float = 0.0  # [m] between the faces before the impact
    contact: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class Rods(Waveguide):
    """Rods one behind the other, at rest or moving as one; the first meets the other body, the last has the support.

    A chain that strikes is free.

    Source: thesis 4.2 (waves at a change of section or material), 4.7.
    """

    rods: tuple[Rod, ...] = field()
    joints: tuple[Joint, ...]  # between each rod and the next
    support: str
    velocity: float = 0.0
    radius: float | None = None

    KEYS = ("kind", "rods", "support", "velocity", "end_mass", "radius")
    ROD_KEYS = ("length", "section", "material", "joint", "gap", "contact")
    kind = "rods"

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "Rods":
        """From the table `[impactor]` or `[target]`; `rods` is a list of tables. Raises SceneError naming the key."""
        given = validation.table(key, given, cls.KEYS)
        parts = validation.required(key, given, "rods", allowed("list", low=1, high=MAX_RODS, of="rods"))
        if not isinstance(parts, list) or not 1 <= len(parts) <= MAX_RODS:
            raise SceneError(f"{key}.rods", parts, allowed("list", low=1, high=MAX_RODS, of="rods"))
        velocity, support = _read_motion(key, given)
        end_mass = _read_end_mass(key, given, support)
        rods, joints = [], []
        for number, part in enumerate(parts, 1):
            name = f"{key}.rods[{number}]"
            part = validation.table(name, part, cls.ROD_KEYS)
            last = number == len(parts)
            end = (support, velocity, end_mass) if last else ("free", velocity, 0.0)
            rods.append(Rod(*_read_bar(name, part), *end, None, section_of_bar(name, part).least_moment))
            if number > 1:
                joints.append(_read_joint(name, part))
            elif set(part) & {"joint", "gap", "contact"}:
                raise SceneError(name, dict(part), allowed("first-rod"))
        return cls(tuple(rods), tuple(joints), support, velocity, read_radius(f"{key}.radius", given.get("radius")))

    @property
    def no_modes(self) -> Note:
        return Note("refusals.chain-of-rods", Severity.REFUSAL)

    @property
    def bonded(self) -> bool:
        return all(joint.bonded for joint in self.joints)

    @property
    def mass(self) -> float:
        return sum(rod.mass for rod in self.rods)

    @property
    def length(self) -> float:
        return sum(rod.length for rod in self.rods)

    @property
    def area(self) -> float:
        return self.rods[0].area

    @property
    def material(self) -> Material:
        return self.rods[0].material

    @property
    def impedance(self) -> float:
        return self.rods[0].impedance

    @property
    def round_trip_time(self) -> float:
        return sum(rod.round_trip_time for rod in self.rods)

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        """As for one rod; every joint is taken as bonded."""
        return _mesh(self.rods, elements, self.fixed, lumping)

    def with_single_elements_cut(self, elements: int) -> Self:
        counts = elements_of_rods(_parts(self.rods), elements).tolist()
        if min(counts) > 1:
            return self
        rods, joints = [], []
        for rod, count, joint in zip(self.rods, counts, (*self.joints, None), strict=True):
            half = replace(rod, length=0.5 * rod.length)
            rods += [rod] if count > 1 else [replace(half, end_mass=0.0), half]
            joints += [joint] if count > 1 else [Joint(True), joint]
        return replace(self, rods=tuple(rods), joints=tuple(joints[:-1]))

    def table(self) -> dict[str, Any]:
        parts = [_bar_table(rod) for rod in self.rods]
        for part, joint in zip(parts[1:], self.joints, strict=True):
            part |= {"joint": "bonded"} if joint.bonded else {"joint": "touching", "gap": joint.gap}
            if joint.contact is not None:
                part["contact"] = dict(joint.contact)
        written: dict[str, Any] = {"kind": "rods", "rods": parts, "support": self.support}
        for name, value, nothing in (
            ("velocity", self.velocity, 0.0),
            ("end_mass", self.rods[-1].end_mass, 0.0),
            ("radius", self.radius, None),
        ):
            if value != nothing:
                written[name] = value
        return written


def _mesh(rods: tuple[Rod, ...], elements: int, fixed: bool, lumping: float) -> Mesh:
    return rod_mesh(_parts(rods), elements, fixed, rods[-1].end_mass, lumping)


def _parts(rods: tuple[Rod, ...]) -> list[tuple[float, float, float]]:
    return [(rod.length, rod.mass - rod.end_mass, rod.stiffness) for rod in rods]


def _read_bar(key: str, given: Mapping[str, Any]) -> tuple[float, float, Material]:
    """Length, area and material."""
    length = validation.required_number(key, given, "length", *LENGTH_RANGE, "m")
    material = required_material(key, given)
    return length, section_of_bar(key, given).area, material


def _bar_table(rod: Rod) -> dict[str, Any]:
    return {"length": rod.length, "section": {"area": rod.area}, "material": rod.material.table()}


def _read_joint(key: str, given: Mapping[str, Any]) -> Joint:
    kind = validation.choice(f"{key}.joint", given.get("joint", "bonded"), ("bonded", "touching"))
    contact = given.get("contact")
    if kind == "bonded":
        for name in ("gap", "contact"):
            if name in given:
                raise SceneError(f"{key}.{name}", given[name], allowed("only-with", key="joint", value=["touching"]))
        return Joint(True)
    if contact is not None and not isinstance(contact, Mapping):
        raise SceneError(f"{key}.contact", contact, allowed("law-table"))
    return Joint(False, validation.number(f"{key}.gap", given.get("gap", 0.0), 0.0, 1e3, "m"), contact)


def _read_motion(key: str, given: Mapping[str, Any]) -> tuple[float, str]:
    """Velocity before the impact, and the support of the far end, which decides whether it can have one."""
    if key == "impactor":
        support = validation.choice("impactor.support", given.get("support", "free"), ("free",))
        return read_impact_velocity(given), support
    velocity = read_target_velocity(given)
    support = validation.choice("target.support", given.get("support", "fixed"), SUPPORTS)
    return velocity if support == "free" else _still(key, velocity), support


def _read_end_mass(key: str, given: Mapping[str, Any], support: str) -> float:
    if "end_mass" not in given:
        return 0.0
    if support != "free":
        raise SceneError(f"{key}.end_mass", given["end_mass"], allowed("only-with", key="support", value=["free"]))
    return validation.number(f"{key}.end_mass", given["end_mass"], *MASS_RANGE, "kg")


def _still(key: str, velocity: float) -> float:
    if velocity != 0.0:
        raise SceneError(f"{key}.velocity", velocity, allowed("still", support=["free"]))
    return velocity
