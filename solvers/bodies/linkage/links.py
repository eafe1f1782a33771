"""Links of a mechanism, as scene files give them."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from ... import validation
from ...numerics.beams.dispersion import BeamLine
from ...numerics.multibody import shapes, system
from ...validation import SceneError, allowed, bound_beside
from ..beams import THEORIES
from ..lumped import MASS_RANGE
from ..material import LENGTH_RANGE, Material, read_material
from ..sections import Section, read_section

Point = tuple[float, float]

GROUND = "ground"
FARTHEST = 1e6  # [m], of a point from the origin
INERTIA_RANGE = (1e-24, 1e24)  # kg m2
MOST_SLENDER = 1e5  # length of a flexible link over the root of its section: beyond, it has no period in 16 digits
LEAST_SLENDER = 1.0  # shorter, its bending is not that of a bar, and the frequencies of its shapes drown all others
NEAREST_NODES = 1e-6  # of the length
MOST_MODES = 200  # of a link, of either kind
LONGEST_NAME = 40  # characters


@dataclass(frozen=True)
class Link:
    """A straight uniform bar, or a rigid body, between two points of the first configuration; its centre is half way.

    With `modes` or `axial` it is flexible: a floating frame on `shapes`, with so many shapes of bending and stretching.
    Source: thesis 6.2.
    """

    name: str
    start: Point  # `from` of a scene file [m]
    end: Point  # `to`
    mass: float  # [kg]
    inertia: float  # about its centre [kg m2]
    section: Section | None = None
    material: Material | None = None
    modes: int = 0
    axial: int = 0
    shapes: str = "clamped-free"
    theory: str = "euler-bernoulli"
    nodes: tuple[float, ...] = ()  # of finite elements, whose lowest `modes` of either kind are the shapes [m]
    own_inertia: bool = False  # whether it is not that of a uniform bar

    KEYS = (
        "name",
        "from",
        "to",
        "mass",
        "inertia",
        "section",
        "material",
        "modes",
        "axial",
        "shapes",
        "theory",
        "nodes",
    )

    @classmethod
    def read(cls, key: str, given: object) -> "Link":
        """From a table of `target.links`. Raises SceneError naming the key, and the link."""
        given = validation.table(key, given, cls.KEYS)
        name = validation.required(key, given, "name", allowed("link-name"))
        if not isinstance(name, str) or not 0 < len(name) <= LONGEST_NAME or name == GROUND:
            raise SceneError(f"{key}.name", name, allowed("link-name"))
        start, end = (
            read_point(f"{key}.{word}", validation.required(key, given, word, allowed("point", unit="m")))
            for word in ("from", "to")
        )
        section = read_section(f"{key}.section", given["section"]) if "section" in given else None
        material = read_material(f"{key}.material", given["material"]) if "material" in given else None
        modes, axial = (
            validation.whole_number(f"{key}.{word}", given.get(word, 0), 0, MOST_MODES) for word in ("modes", "axial")
        )
        length = math.dist(start, end)
        mass = _read_mass(key, name, given, length, section, material)
        if modes or axial:
            _check_flexible(key, name, length, section, material, modes)
        usual = mass * length**2 / 12.0
        if "inertia" in given:
            inertia = validation.number(f"{key}.inertia", given["inertia"], *INERTIA_RANGE, "kg m2")
        elif usual < INERTIA_RANGE[0]:
            raise SceneError(f"{key}.inertia", None, allowed("link-inertia", link=name))
        else:
            inertia = usual
        if (modes or axial) and "inertia" in given:
            raise SceneError(f"{key}.inertia", given["inertia"], allowed("uniform-link", link=name))
        return cls(
            name,
            start,
            end,
            mass,
            inertia,
            section,
            material,
            modes,
            axial,
            validation.choice(f"{key}.shapes", given.get("shapes", "clamped-free"), shapes.SUPPORTS),
            validation.choice(f"{key}.theory", given.get("theory", "euler-bernoulli"), THEORIES),
            _read_nodes(key, given, length, modes),
            "inertia" in given,
        )

    @property
    def length(self) -> float:
        return math.dist(self.start, self.end)

    @property
    def centre(self) -> np.ndarray:
        return 0.5 * (np.array(self.start) + np.array(self.end))

    @property
    def flexible(self) -> bool:
        return self.modes + self.axial > 0

    def with_modes(self, count: int) -> "Link":
        """By so many modes of bending and of stretching, where it has any; of finite elements at most all there are."""
        most = min(count, 3 * len(self.nodes)) if self.nodes else count
        return replace(self, modes=most if self.modes else 0, axial=count if self.axial else 0)

    @property
    def along(self) -> np.ndarray:
        """Unit vector from its first end to its last, (2,)."""
        return (np.array(self.end) - np.array(self.start)) / self.length if self.length else np.array([1.0, 0.0])

    def off_axis(self, at: Point) -> float:
        """How far a point is from the bar [m]."""
        arm = np.array(at) - np.array(self.start)
        nearest = np.clip(arm @ self.along, 0.0, self.length) * self.along
        return float(np.hypot(*(arm - nearest)))

    @cached_property
    def line(self) -> BeamLine:
        """What the theory of bending knows of it."""
        assert self.section is not None and self.material is not None
        poisson, young, shears = self.material.poisson, self.material.young, self.theory == "timoshenko"
        rigidity = self.section.shear_coefficient_for(poisson) * 0.5 * young / (1.0 + poisson) * self.section.area
        second = self.section.second_moment or 0.0
        density = self.mass / (self.section.area * self.length)
        return BeamLine(
            length=self.length,
            bending_stiffness=young * second,
            mass_per_length=self.mass / self.length,
            rotary_inertia=density * second if shears else 0.0,
            shear_stiffness=rigidity if shears else math.inf,
        )

    @property
    def wave_speed(self) -> float:
        """Along it, sqrt(E / rho) [m/s]."""
        assert self.section is not None and self.material is not None
        return math.sqrt(self.material.young * self.section.area * self.length / self.mass)

    def in_frame(self, second_pin: float, struck: float | None) -> system.Link:
        """As the numerics take it: pinned for the second time at `second_pin` [m], struck at `struck` [m] of it."""
        inertia, found = self.inertia, shapes.no_shapes()
        if self.flexible:
            bar = shapes.Flexible(
                self.line, self.wave_speed, self.shapes, self.modes, self.axial, second_pin, self.nodes
            )
            found = shapes.link_shapes(bar, struck)
            inertia += self.line.rotary_inertia * self.length
        angle = math.atan2(self.along[1], self.along[0])
        return system.Link(np.array(self.start), angle, self.length, self.mass, inertia, found)

    def table(self) -> dict[str, Any]:
        """As in a scene file."""
        written = {"name": self.name, "from": list(self.start), "to": list(self.end), "mass": self.mass}
        if self.own_inertia:
            written["inertia"] = self.inertia
        for name, value in (("section", self.section), ("material", self.material)):
            if value is not None:
                written[name] = value.table()
        if self.flexible:
            written |= {"modes": self.modes, "axial": self.axial, "shapes": self.shapes, "theory": self.theory}
        if self.nodes:
            written["nodes"] = list(self.nodes)
        return written


def read_point(key: str, given: object, largest: float = FARTHEST, unit: str = "m") -> Point:
    """Two numbers. Raises SceneError naming the key, or the place in the list."""
    if not isinstance(given, (list, tuple)) or len(given) != 2:
        raise SceneError(key, given, allowed("point", unit=unit))
    x, y = (validation.number(f"{key}[{i}]", value, -largest, largest) for i, value in enumerate(given, 1))
    return x, y


def _read_mass(
    key: str, name: str, given: Mapping[str, Any], length: float, section: Section | None, material: Material | None
) -> float:
    """`mass`, or that of a bar of this section and material."""
    if "mass" in given:
        return validation.number(f"{key}.mass", given["mass"], *MASS_RANGE, "kg")
    if section is None or material is None or not length:
        raise SceneError(f"{key}.mass", None, allowed("link-mass", link=name))
    return material.density * section.area * length


def _read_nodes(key: str, given: Mapping[str, Any], length: float, modes: int) -> tuple[float, ...]:
    """`nodes` of finite elements along the link, the last at its end; modes along it are among the lowest `modes`."""
    if "nodes" not in given:
        return ()
    found = given["nodes"]
    if not isinstance(found, (list, tuple)) or not 1 <= len(found) <= MOST_MODES:
        raise SceneError(f"{key}.nodes", found, allowed("list", low=1, high=MOST_MODES, of="numbers"))
    places = [validation.number(f"{key}.nodes[{i}]", each, 0.0, length, "m") for i, each in enumerate(found, 1)]
    ordered = all(later - before > NEAREST_NODES * length for before, later in pairwise([0.0, *places]))
    if not ordered or abs(places[-1] - length) > NEAREST_NODES * length:
        raise SceneError(f"{key}.nodes", list(found), allowed("nodes", length=length))
    if given.get("shapes", "clamped-free") != "clamped-free" or given.get("axial"):
        reason = allowed("only-with", key="shapes", value=["clamped-free"])
        raise SceneError(f"{key}.nodes", list(found), reason)
    if not 1 <= modes <= 3 * len(places):
        raise SceneError(f"{key}.modes", modes, allowed("whole-number", low=1, high=3 * len(places)))
    return tuple(places)


def _check_flexible(
    key: str, name: str, length: float, section: Section | None, material: Material | None, modes: int
) -> None:
    """A flexible link needs a length, a section that bends and a material."""
    if length < LENGTH_RANGE[0]:
        raise SceneError(f"{key}.to", None, allowed("link-length", link=name))
    for word, value in (("section", section), ("material", material)):
        if value is None:
            raise SceneError(f"{key}.{word}", None, allowed("flexible-link", link=name))
    if section is not None and length > (most := MOST_SLENDER * math.sqrt(section.area)):
        raise SceneError(f"{key}.to", length, allowed("link-slender", link=name, most=bound_beside(most, length, 3)))
    if section is not None and length < (least := LEAST_SLENDER * math.sqrt(section.area)):
        raise SceneError(f"{key}.to", length, allowed("link-thick", link=name, least=bound_beside(least, length, 3)))
    if modes and section is not None and section.second_moment is None:
        raise SceneError(f"{key}.section.second_moment", None, allowed("second-moment"))
