"""Joints between links, and the drives that set them going, as scene files give them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ... import validation
from ...numerics.multibody import system
from ...validation import SceneError, allowed
from .links import GROUND, Link, Point, read_point

KINDS = (system.REVOLUTE, system.PRISMATIC, system.FIXED)
# Of the length of a link: farther from it is no joint of it. Points of scene files have four digits or so.
OFF_LINK = 2e-3
STIFFNESS_RANGE = (1e-12, 1e15)
FASTEST = 1e6  # [rad/s] or [m/s]


@dataclass(frozen=True)
class Joint:
    """Two links that share a point: they turn about it, slide along an axis of the first, or are one."""

    kind: str
    links: tuple[str, str]
    at: Point  # in the first configuration [m]
    axis: Point = (1.0, 0.0)  # of a prismatic one, a unit vector

    KEYS = ("kind", "links", "at", "axis")

    @classmethod
    def read(cls, key: str, given: object, links: Sequence[Link], size: float) -> "Joint":
        """From a table of `target.joints`; `size` of the mechanism [m]. Raises SceneError naming joint and link."""
        given = validation.table(key, given, cls.KEYS)
        kind = validation.choice(f"{key}.kind", given.get("kind", system.REVOLUTE), KINDS)
        names = {link.name: link for link in links}
        chosen = validation.required(key, given, "links", allowed("joined-links", links=[GROUND, *names]))
        if not isinstance(chosen, (list, tuple)) or len(chosen) != 2 or not all(isinstance(n, str) for n in chosen):
            raise SceneError(f"{key}.links", chosen, allowed("joined-links", links=[GROUND, *names]))
        first, second = (
            validation.choice(f"{key}.links[{i}]", name, (GROUND, *names)) for i, name in enumerate(chosen, 1)
        )
        if first == second:
            raise SceneError(f"{key}.links", list(chosen), allowed("joined-links", links=[GROUND, *names]))
        at = read_point(f"{key}.at", validation.required(key, given, "at", allowed("point", unit="m")))
        for name in (first, second):
            if name != GROUND and names[name].off_axis(at) > OFF_LINK * (names[name].length or size):
                far = names[name].off_axis(at)
                raise SceneError(f"{key}.at", list(at), allowed("on-link", link=name, far=far))
        if "axis" in given and kind != system.PRISMATIC:
            reason = allowed("only-with", key="kind", value=[system.PRISMATIC])
            raise SceneError(f"{key}.axis", given["axis"], reason)
        axis = (1.0, 0.0)
        if kind == system.PRISMATIC:
            axis = read_direction(f"{key}.axis", validation.required(key, given, "axis", allowed("direction-in-plane")))
        return cls(kind, (first, second), at, axis)

    def in_frame(self, links: Sequence[Link]) -> system.Joint:
        """As the numerics take it."""
        numbers = {GROUND: system.GROUND} | {link.name: i for i, link in enumerate(links)}
        first, second = (numbers[name] for name in self.links)
        return system.Joint(self.kind, first, second, np.array(self.at), np.array(self.axis))

    def table(self) -> dict[str, Any]:
        """As in a scene file."""
        written = {"kind": self.kind, "links": list(self.links), "at": list(self.at)}
        return written | ({"axis": list(self.axis)} if self.kind == system.PRISMATIC else {})


@dataclass(frozen=True)
class Drive:
    """What makes the second link of a joint move against the first: held at its speed, or only started with it."""

    joint: int
    speed: float  # [rad/s], or [m/s] of a prismatic joint
    initial: bool = False

    KEYS = ("joint", "speed", "initial")

    @classmethod
    def read(cls, key: str, given: object, joints: Sequence[Joint]) -> "Drive":
        """From a table of `target.drives`. Raises SceneError naming the key."""
        given = validation.table(key, given, cls.KEYS)
        joint = _read_joint(key, given, joints)
        initial = validation.flag(f"{key}.initial", given.get("initial", False))
        unit = "m/s" if joints[joint].kind == system.PRISMATIC else "rad/s"
        return cls(joint, validation.required_number(key, given, "speed", -FASTEST, FASTEST, unit), initial)

    def in_frame(self) -> system.Drive:
        """As the numerics take it."""
        return system.Drive(self.joint, self.speed, not self.initial)

    def table(self) -> dict[str, Any]:
        """As in a scene file."""
        return {"joint": self.joint, "speed": self.speed} | ({"initial": True} if self.initial else {})


@dataclass(frozen=True)
class Spring:
    """Between both links of a joint, without a force in the first configuration: torsion, or along a prismatic axis."""

    joint: int
    stiffness: float  # [N m/rad], or [N/m] of a prismatic joint

    KEYS = ("joint", "stiffness")

    @classmethod
    def read(cls, key: str, given: object, joints: Sequence[Joint]) -> "Spring":
        """From a table of `target.springs`. Raises SceneError naming the key."""
        given = validation.table(key, given, cls.KEYS)
        joint = _read_joint(key, given, joints)
        unit = "N/m" if joints[joint].kind == system.PRISMATIC else "N m/rad"
        return cls(joint, validation.required_number(key, given, "stiffness", *STIFFNESS_RANGE, unit))

    def table(self) -> dict[str, Any]:
        """As in a scene file."""
        return {"joint": self.joint, "stiffness": self.stiffness}


def _read_joint(key: str, given: Mapping[str, Any], joints: Sequence[Joint]) -> int:
    """The number of a joint that can move."""
    most = len(joints) - 1
    what = allowed("whole-number", low=0, high=most)
    joint = validation.whole_number(f"{key}.joint", validation.required(key, given, "joint", what), 0, most)
    if joints[joint].kind == system.FIXED:
        raise SceneError(f"{key}.joint", joint, allowed("moving-joint"))
    return joint


def read_direction(key: str, given: object) -> Point:
    """A direction in the plane, made a unit vector."""
    whole = isinstance(given, (list, tuple)) and len(given) == 2
    vector = np.array(read_point(key, given, 1e9)) if whole else np.zeros(2)
    length = math.hypot(*vector.tolist())
    if length == 0.0:
        raise SceneError(key, given, allowed("direction-in-plane"))
    x, y = (vector if abs(length - 1.0) < 1e-15 else vector / length).tolist()
    return x, y
