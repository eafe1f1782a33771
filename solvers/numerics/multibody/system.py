"""Planar links and joints in one configuration: mass matrix, constraint Jacobian, and loads.

Coordinates of a link: place of the origin of its frame, angle of its axis, then its shapes; all links in a row. The
shapes and their rates are small: matrices are those of the undeformed links.
Source: thesis 6.2, (6.3), (6.4), (6.7); Shabana (1998). Cost: O(coordinates^2) to assemble.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .shapes import Shapes

GROUND = -1
REVOLUTE, PRISMATIC, FIXED = "revolute", "prismatic", "fixed"


class Link(NamedTuple):
    """One link: origin of its frame (2,) [m], angle of its axis [rad], length [m], mass [kg], moment of inertia about
    its centre [kg m2], which is half way along it, and its shapes."""

    origin: np.ndarray
    angle: float
    length: float
    mass: float
    inertia: float
    shapes: Shapes

    @property
    def axes(self) -> np.ndarray:
        """Unit vectors along and across it, (2, 2) as rows."""
        cosine, sine = np.cos(self.angle), np.sin(self.angle)
        return np.array([[cosine, sine], [-sine, cosine]])

    @property
    def size(self) -> int:
        return 3 + self.shapes.frequencies.size

    def point(self, at: np.ndarray) -> np.ndarray:
        """Velocity of the material point at `at` (2,) [m] per unit of each rate, (2, size)."""
        arm = at - self.origin
        x = np.array([np.clip(self.axes[0] @ arm, 0.0, self.length)])
        found = np.zeros((2, self.size))
        found[:, :2], found[:, 2] = np.eye(2), (-arm[1], arm[0])
        found[:, 3:] = (self.shapes.displacements(x)[:, 0] @ self.axes).T
        return found

    def points(self, x: np.ndarray) -> np.ndarray:
        """The same of the points at x (x,) [m] along it, (x, 2, size)."""
        x = np.clip(np.atleast_1d(np.asarray(x, float)), 0.0, self.length)
        arms, found = np.multiply.outer(x, self.axes[0]), np.zeros((x.size, 2, self.size))
        found[:, :, :2], found[:, 0, 2], found[:, 1, 2] = np.eye(2), -arms[:, 1], arms[:, 0]
        found[:, :, 3:] = (self.shapes.displacements(x) @ self.axes).transpose(1, 2, 0)
        return found

    def turn(self, at: np.ndarray) -> np.ndarray:
        """Angular velocity of the section at `at` per unit of each rate, (size,)."""
        x = np.array([np.clip(self.axes[0] @ (at - self.origin), 0.0, self.length)])
        return np.concatenate(((0.0, 0.0, 1.0), self.shapes.turns(x)[:, 0]))

    def mass_matrix(self) -> np.ndarray:
        """(size, size)."""
        half, (_, across) = 0.5 * self.length, self.axes
        found = np.eye(self.size)
        found[:2, :2] *= self.mass
        found[2, 2] = self.inertia + self.mass * half**2
        found[:2, 2] = found[2, :2] = self.mass * half * across
        coupled = self.shapes.momentum @ self.axes
        found[3:, :2], found[:2, 3:] = coupled, coupled.T
        found[3:, 2] = found[2, 3:] = self.shapes.angular
        return found

    def load(self, gravity: np.ndarray) -> np.ndarray:
        """Generalised weight, (size,)."""
        half, (_, across) = 0.5 * self.length, self.axes
        own = self.shapes.momentum @ (self.axes @ gravity)
        return np.concatenate((self.mass * gravity, [self.mass * half * (across @ gravity)], own))

    def centrifugal(self, spin: float) -> np.ndarray:
        """Generalised force quadratic in its angular velocity [rad/s], (size,)."""
        pull = 0.5 * self.mass * self.length * self.axes[0]
        return spin**2 * np.concatenate((pull, [0.0], self.shapes.radial))

    def centripetal(self, at: np.ndarray, spin: float) -> np.ndarray:
        """Acceleration of a point by the angular velocity alone, (2,)."""
        return -(spin**2) * (at - self.origin)


class Joint(NamedTuple):
    """Two links, by number or GROUND, that share the point `at` (2,) [m]; `axis` (2,) of a prismatic one, a unit vector
    that turns with the first link."""

    kind: str
    first: int
    second: int
    at: np.ndarray
    axis: np.ndarray


class Drive(NamedTuple):
    """A joint whose relative rate, of the second link against the first, is given; only to begin with, or for good."""

    joint: int
    rate: float  # [rad/s], or [m/s] along a prismatic axis
    held: bool


@dataclass(frozen=True)
class System:
    """A mechanism in one configuration."""

    links: Sequence[Link]
    joints: Sequence[Joint]
    drives: Sequence[Drive]
    gravity: np.ndarray

    @cached_property
    def offsets(self) -> list[int]:
        """Where the coordinates of each link begin, and their number."""
        return [0, *np.cumsum([link.size for link in self.links]).tolist()]

    @property
    def size(self) -> int:
        return self.offsets[-1]

    @cached_property
    def rigid(self) -> np.ndarray:
        """Which coordinates are those of a frame, (size,)."""
        return np.concatenate([np.arange(link.size) < 3 for link in self.links])

    @cached_property
    def mass(self) -> np.ndarray:
        found = np.zeros((self.size, self.size))
        for link, start in zip(self.links, self.offsets, strict=False):
            found[start : start + link.size, start : start + link.size] = link.mass_matrix()
        return found

    @cached_property
    def stiffness(self) -> np.ndarray:
        """Its diagonal, (size,): squared frequencies of the shapes."""
        parts = [np.concatenate((np.zeros(3), link.shapes.frequencies**2)) for link in self.links]
        return np.concatenate(parts)

    @cached_property
    def weight(self) -> np.ndarray:
        return np.concatenate([link.load(self.gravity) for link in self.links])

    def followed(self, link: int, at: np.ndarray, change: np.ndarray) -> np.ndarray:
        """Where a point of a link comes when the coordinates change by (size,), (2,)."""
        if link == GROUND:
            return at
        start, origin = self.offsets[link], self.links[link].origin
        cosine, sine = np.cos(change[start + 2]), np.sin(change[start + 2])
        return origin + change[start : start + 2] + np.array([[cosine, -sine], [sine, cosine]]) @ (at - origin)

    def moved(self, change: np.ndarray) -> "System":
        """In another configuration, of links that do not deform: coordinates changed by (size,)."""
        links = [
            link._replace(origin=link.origin + change[start : start + 2], angle=link.angle + change[start + 2])
            for link, start in zip(self.links, self.offsets, strict=False)
        ]
        joints = []
        for joint in self.joints:
            tip = self.followed(joint.first, joint.at + joint.axis, change)
            at = self.followed(joint.second, joint.at, change)
            joints.append(joint._replace(at=at, axis=tip - self.followed(joint.first, joint.at, change)))
        return replace(self, links=links, joints=joints)

    def point(self, link: int, at: np.ndarray) -> np.ndarray:
        """Velocity of a point of a link, or of the ground, per unit of each rate, (2, size)."""
        return self._placed(link, np.zeros((2, 0)) if link == GROUND else self.links[link].point(at))

    def turn(self, link: int, at: np.ndarray) -> np.ndarray:
        """Angular velocity of the section of a link there, (size,)."""
        own = np.zeros((1, 0)) if link == GROUND else self.links[link].turn(at)[None]
        return self._placed(link, own)[0]

    def _placed(self, link: int, own: np.ndarray) -> np.ndarray:
        found = np.zeros((own.shape[0], self.size))
        if link != GROUND:
            found[:, self.offsets[link] : self.offsets[link + 1]] = own
        return found

    @cached_property
    def _rows(self) -> list[tuple[np.ndarray, int, np.ndarray]]:
        """Of each constraint: its row of the Jacobian, its joint, and what a unit of its reaction does to the second
        link there: force along x and y, and moment."""
        found = []
        for number, joint in enumerate(self.joints):
            apart = self.point(joint.second, joint.at) - self.point(joint.first, joint.at)
            turned = self.turn(joint.second, joint.at) - self.turn(joint.first, joint.at)
            if joint.kind == PRISMATIC:
                across = np.array([-joint.axis[1], joint.axis[0]])
                found.append((across @ apart, number, np.append(across, 0.0)))
            else:
                found += [(apart[i], number, np.eye(3)[i]) for i in range(2)]
            if joint.kind != REVOLUTE:
                found.append((turned, number, np.eye(3)[2]))
        for drive in self.drives:
            joint = self.joints[drive.joint]
            effect = np.append(joint.axis, 0.0) if joint.kind == PRISMATIC else np.eye(3)[2]
            found.append((self.opening(drive.joint), drive.joint, effect))
        return found

    def opening(self, number: int) -> np.ndarray:
        """Rate at which a joint that can move does so, of its second link against the first, per unit of each rate:
        angular velocity, or along a prismatic axis, (size,)."""
        joint = self.joints[number]
        if joint.kind == PRISMATIC:
            return joint.axis @ (self.point(joint.second, joint.at) - self.point(joint.first, joint.at))
        return self.turn(joint.second, joint.at) - self.turn(joint.first, joint.at)

    @cached_property
    def jacobian(self) -> np.ndarray:
        """Of all constraints, those of the joints first, then those of the drives, (constraints, size)."""
        return np.array([row for row, _, _ in self._rows]).reshape(-1, self.size)

    @cached_property
    def joint_of(self) -> np.ndarray:
        """The joint of each constraint, (constraints,)."""
        return np.array([joint for _, joint, _ in self._rows], int)

    @cached_property
    def effect(self) -> np.ndarray:
        """What a unit of each reaction does to the second link at its joint: force and moment, (constraints, 3)."""
        return np.array([effect for _, _, effect in self._rows]).reshape(-1, 3)

    @property
    def joint_rows(self) -> int:
        return self.joint_of.size - len(self.drives)

    @cached_property
    def rates(self) -> np.ndarray:
        """Required of each constraint, (constraints,)."""
        return np.append(np.zeros(self.joint_rows), [drive.rate for drive in self.drives])

    @cached_property
    def held(self) -> np.ndarray:
        """Which constraints last, (constraints,) of bool."""
        return np.append(np.ones(self.joint_rows, bool), [drive.held for drive in self.drives]).astype(bool)

    def spin(self, link: int, rates: np.ndarray) -> float:
        return 0.0 if link == GROUND else float(rates[self.offsets[link] + 2])

    def centrifugal(self, rates: np.ndarray) -> np.ndarray:
        """Generalised forces quadratic in the rates (size,), of links that do not deform."""
        return np.concatenate([link.centrifugal(self.spin(i, rates)) for i, link in enumerate(self.links)])

    def drift(self, rates: np.ndarray) -> np.ndarray:
        """What J v' must be, (constraints,): less the accelerations of the joints by the rates alone."""
        found = np.zeros(self.joint_of.size)
        for row, (_, number, effect) in enumerate(self._rows):
            joint = self.joints[number]
            apart = self.centripetal(joint.second, joint.at, rates) - self.centripetal(joint.first, joint.at, rates)
            found[row] = -effect[:2] @ apart
            if joint.kind == PRISMATIC and row < self.joint_rows and effect[2] == 0.0:
                slid = joint.axis @ (self.point(joint.second, joint.at) - self.point(joint.first, joint.at)) @ rates
                found[row] += 2.0 * self.spin(joint.first, rates) * slid
        return found

    def centripetal(self, link: int, at: np.ndarray, rates: np.ndarray) -> np.ndarray:
        return np.zeros(2) if link == GROUND else self.links[link].centripetal(at, self.spin(link, rates))
