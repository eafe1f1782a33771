"""A planar mechanism as a target: links, joints, drives, and where it is struck."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from ... import validation
from ...numerics.multibody.frozen import Frozen
from ...numerics.multibody.mesh import ModeChange, change_of_modes, frame_mesh
from ...numerics.multibody.system import System
from ...text.notes import Note
from ...validation import SceneError, allowed
from ..material import Material, read_radius
from ..protocol import AnyBody
from .joints import Drive, Joint, Spring, read_direction
from .links import GROUND, LONGEST_NAME, Link, Point, read_point
from .mobility import OpenStart, check_mobility, open_start
from .struck import StruckMechanism

MOST_LINKS = 50
STRONGEST_GRAVITY = 1e6  # m/s2
NO_GRAVITY = (0.0, 0.0)
NODE_DISTANCE = 1e-6  # of the length: so near to a node a link is struck on it
LEAST_FINE, MOST_FINE = 20, 60  # modes of a link, by which the error of fewer is measured


@dataclass(frozen=True)
class Struck:
    """Where a mechanism is struck: a link, a fraction of it from its first end on, the normal from the impactor on."""

    link: str
    at: float
    normal: Point

    KEYS = ("link", "at", "normal")

    @classmethod
    def read(cls, key: str, given: object, links: Sequence[Link]) -> "Struck":
        given = validation.table(key, given, cls.KEYS)
        names = [link.name for link in links]
        link = validation.required(key, given, "link", allowed("choice", options=names))
        normal = validation.required(key, given, "normal", allowed("direction-in-plane"))
        return cls(
            validation.choice(f"{key}.link", link, names),
            validation.required_number(key, given, "at", 0.0, 1.0),
            read_direction(f"{key}.normal", normal),
        )

    def table(self) -> dict[str, Any]:
        """As in a scene file."""
        return {"link": self.link, "at": self.at, "normal": list(self.normal)}


@dataclass(frozen=True)
class Mechanism(AnyBody):
    """Links between points of a first configuration, in which it is struck; joined to each other and to the ground.

    Velocities of the impact are along the normal of the struck point. Before it no link vibrates: rates follow from
    the drives, and what none of them settles moves so that the kinetic energy is least.
    Source: thesis 6.2, 6.3. `StruckMechanism` is what an impact feels of it.
    """

    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    drives: tuple[Drive, ...]
    struck: Struck
    gravity: Point = NO_GRAVITY  # [m/s2]
    radius: float | None = None  # of curvature where it is struck [m]
    springs: tuple[Spring, ...] = ()  # which give nothing in the first configuration, and so nothing in an impact there

    KEYS = ("kind", "links", "joints", "drives", "springs", "struck", "gravity", "radius")
    kind = "mechanism"

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "Mechanism":
        given = validation.table(key, given, cls.KEYS)
        links = tuple(
            _read_link(f"{key}.links[{i}]", each)
            for i, each in enumerate(_listed(key, given, "links", 1, MOST_LINKS), 1)
        )
        names = [link.name for link in links]
        for number, name in enumerate(names, 1):
            if name in names[: number - 1]:
                raise SceneError(f"{key}.links[{number}].name", name, allowed("another-name"))
        size = _size(links)
        joints = tuple(
            Joint.read(f"{key}.joints[{i}]", each, links, size)
            for i, each in enumerate(_listed(key, given, "joints", 0, 3 * MOST_LINKS), 1)
        )
        drives = tuple(
            Drive.read(f"{key}.drives[{i}]", each, joints)
            for i, each in enumerate(_listed(key, given, "drives", 0, len(joints)), 1)
        )
        struck = Struck.read(f"{key}.struck", validation.required(key, given, "struck", allowed("struck")), links)
        gravity = read_point(f"{key}.gravity", given.get("gravity", NO_GRAVITY), STRONGEST_GRAVITY, "m/s2")
        springs = tuple(
            Spring.read(f"{key}.springs[{i}]", each, joints)
            for i, each in enumerate(_listed(key, given, "springs", 0, len(joints)), 1)
        )
        radius = read_radius(f"{key}.radius", given.get("radius"))
        return _checked(cls(links, joints, drives, struck, gravity, radius, springs), key)

    @property
    def struck_link(self) -> Link:
        return next(link for link in self.links if link.name == self.struck.link)

    @cached_property
    def contact_point(self) -> np.ndarray:
        """In the first configuration, (2,) [m]."""
        link = self.struck_link
        return np.array(link.start) + self.struck.at * (np.array(link.end) - np.array(link.start))

    @cached_property
    def system(self) -> System:
        """As the numerics take it."""
        bodies = []
        for link in self.links:
            struck = self.struck.at * link.length if link.name == self.struck.link else None
            bodies.append(link.in_frame(self._second_pin(link), struck))
        drives = [drive.in_frame() for drive in self.drives]
        return System(bodies, [joint.in_frame(self.links) for joint in self.joints], drives, np.array(self.gravity))

    def _second_pin(self, link: Link) -> float:
        """Of a link pinned twice the joint next to its far end [m], where it overhangs; else the far end."""
        places = [
            float((np.array(joint.at) - np.array(link.start)) @ link.along)
            for joint in self.joints
            if link.name in joint.links
        ]
        inner = [place for place in places if place > link.length * 1e-6]
        return min(max(inner, default=link.length), link.length)

    @cached_property
    def frozen(self) -> Frozen:
        """In its first configuration, struck."""
        number = [link.name for link in self.links].index(self.struck.link)
        return Frozen(self.system, number, self.contact_point, np.array(self.struck.normal))

    @cached_property
    def open_start(self) -> OpenStart | None:
        """What no drive settles of how it moves before the impact."""
        return open_start(self.system, _size(self.links))

    @cached_property
    def at_rest(self) -> StruckMechanism:
        """As the impact feels it, seen from its struck point."""
        link, fibre = self.struck_link, 0.0
        section = link.section
        if section is not None and section.second_moment is not None:
            side = float(np.sign(self.frozen.system.links[self.frozen.link].axes[1] @ self.frozen.normal))
            fibre = side * section.half_depth / section.second_moment
        return StruckMechanism(self, self.frozen, fibre, link.material, self.radius, self.flexible)

    @cached_property
    def extent(self) -> float:
        """The larger of its sides along x and y [m]; 1 where it is a point."""
        points = np.array([point for link in self.links for point in (link.start, link.end)])
        return float(np.ptp(points, axis=0).max()) or 1.0

    @property
    def most_modes(self) -> int:
        """Of any link, of bending or of stretching."""
        return max(max(link.modes, link.axial) for link in self.links)

    def with_modes(self, most: int) -> "Mechanism":
        """With so many modes of bending, and as many of stretching, of each link, where it has more."""
        if self.most_modes <= most:
            return self
        if most not in self._coarser:
            fewer = (replace(link, modes=min(link.modes, most), axial=min(link.axial, most)) for link in self.links)
            self._coarser[most] = replace(self, links=tuple(fewer))
        return self._coarser[most]

    def with_own_modes(self, count: int) -> "Mechanism":
        """With so many modes of bending, and of stretching, of each link that has any; of a mesh up to all it has."""
        if not self.flexible:
            return self
        return replace(self, links=tuple(link.with_modes(count) for link in self.links))

    @cached_property
    def _coarser(self) -> dict[int, "Mechanism"]:
        """With fewer modes, by their number: what is worked out of it once serves every solve."""
        return {}

    @property
    def turned_round(self) -> "Mechanism":
        """Struck along the same line from the other side."""
        x, y = self.struck.normal
        return replace(self, struck=replace(self.struck, normal=(0.0 - x, 0.0 - y)))

    @cached_property
    def refined(self) -> "Mechanism":
        """With twice as many modes of each link that has any, at least LEAST_FINE; a mesh has no more than it has."""
        most = max(min(max(2 * self.most_modes, LEAST_FINE), MOST_FINE), self.most_modes)
        links = (
            link if link.nodes else replace(link, modes=most * bool(link.modes), axial=most * bool(link.axial))
            for link in self.links
        )
        return replace(self, links=tuple(links))

    @cached_property
    def with_rigid_links(self) -> "Mechanism":
        """The same, of which no link bends or stretches."""
        return replace(self, links=tuple(replace(link, modes=0, axial=0, nodes=()) for link in self.links))

    @property
    def flexible(self) -> bool:
        """Whether any link is."""
        return any(link.flexible for link in self.links)

    @property
    def mass(self) -> float:
        """Of all links."""
        return sum(link.mass for link in self.links)

    @property
    def velocity(self) -> float:
        return self.frozen.velocity

    def velocity_at(self, share: float) -> float:
        """Along the normal before the impact of any point of the struck link, a fraction of it from its first end on
        [m/s]."""
        link, frozen = self.struck_link, self.frozen
        at = np.array(link.start) + share * (np.array(link.end) - np.array(link.start))
        return float(frozen.normal @ self.system.point(frozen.link, at) @ frozen.rates)

    def mode_change(self, mass: float, speed: float) -> ModeChange | None:
        """What becomes of velocities and coordinates of the nodes where a mass [kg] at `speed` [m/s] along the normal
        joins a link of finite elements, from the modes of the link to those of both: thesis 6.4.4; None where that is
        no node."""
        node = self._struck_node
        if node is None or not math.isfinite(mass):
            return None
        link, frozen = self.struck_link, self.frozen
        given, start = frozen.system.links[frozen.link], frozen.system.offsets[frozen.link]
        mesh = frame_mesh(link.line, link.wave_speed, np.array(link.nodes))
        shape, nodes = frozen.bent[start + 3 : start + given.size], np.array(link.nodes)
        moved = np.tensordot(shape, given.shapes.displacements(nodes), 1)  # along and across
        bent = np.column_stack((moved, shape @ given.shapes.turns(nodes))).ravel()
        approach = speed * float(given.axes[1] @ frozen.normal)
        return change_of_modes(mesh, mass, node, link.modes, approach, bent)

    @property
    def _struck_node(self) -> int | None:
        """Of the nodes of the struck link the one that is struck, if one is."""
        link = self.struck_link
        near = np.flatnonzero(np.abs(np.array(link.nodes) - self.struck.at * link.length) < NODE_DISTANCE * link.length)
        return int(near[0]) if near.size else None

    @property
    def kinetic_energy(self) -> float:
        rates = self.frozen.rates
        return 0.5 * float(rates @ self.system.mass @ rates)

    @property
    def material(self) -> Material | None:
        return self.struck_link.material

    @property
    def length(self) -> float:
        return self.struck_link.length

    @property
    def held(self) -> bool:
        return any(GROUND in joint.links for joint in self.joints)

    turns = own_modes = True

    @property
    def bends(self) -> bool:
        return self.flexible

    @property
    def no_modes(self) -> Note | None:
        return None

    @property
    def time_unit(self) -> float | None:
        return self.at_rest.time_unit

    @property
    def softness(self) -> float:
        return self.at_rest.softness

    def table(self) -> dict[str, Any]:
        written: dict[str, Any] = {"kind": "mechanism", "links": [link.table() for link in self.links]}
        for name, parts in (("joints", self.joints), ("drives", self.drives), ("springs", self.springs)):
            if parts:
                written[name] = [part.table() for part in parts]
        written["struck"] = self.struck.table()
        if self.gravity != NO_GRAVITY:
            written["gravity"] = list(self.gravity)
        return written | ({} if self.radius is None else {"radius": self.radius})


@lru_cache(maxsize=32)
def _checked(mechanism: Mechanism, key: str) -> Mechanism:
    """The first of equal mechanisms, if it can move as it is asked to: all that is worked out of it serves every impact
    on it. Raises SceneError as `check_mobility`."""
    check_mobility(key, mechanism.system, mechanism.joints, mechanism.drives, _size(mechanism.links))
    return mechanism


def _read_link(key: str, given: object) -> Link:
    """One of them; what is refused says of which, by its name."""
    name = given.get("name") if isinstance(given, Mapping) else None
    with validation.naming(name if isinstance(name, str) and len(name) <= LONGEST_NAME else ""):
        return Link.read(key, given)


def _listed(key: str, given: Mapping[str, Any], name: str, low: int, high: int) -> Sequence[object]:
    found = given.get(name, [])
    if not isinstance(found, (list, tuple)) or not low <= len(found) <= high:
        raise SceneError(f"{key}.{name}", found or None, allowed("list", low=low, high=high, of="tables"))
    return found


def _size(links: Sequence[Link]) -> float:
    """Largest extent of the mechanism [m]."""
    points = np.array([point for link in links for point in (link.start, link.end)])
    return float(np.ptp(points, axis=0).max()) or 1.0
