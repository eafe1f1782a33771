"""What the integrator has recorded of a mechanism, as a motion."""

from abc import abstractmethod
from functools import cached_property
from typing import Any

import numpy as np

from ...bodies import Mechanism
from ...numerics.multibody.flight import GIVING, IMPULSE, INDENTATION, LOST, Course
from ...numerics.multibody.moving import Linkage, Seen
from ...numerics.multibody.system import GROUND
from ...scene import Scene
from ...solution.sampled_motion import SampledMotion
from ...solution.solution import ContactPeriod
from .linkage import ANGLE, LINE, PIN_X, PIN_Y, Rows


class MovingMotion(SampledMotion):
    """A mechanism that moves on, and the mass that strikes it, by a contact law or by impulses without duration.

    Histories are along the normal of the first impact, which does not turn with the links; straight between instants,
    but for the force of a contact law, which is constant in between. `centres`, of the links, and their `rates`, spins
    and velocities as rigid bodies, are (instants, 3 links) each.
    """

    def __init__(self, scene: Scene, course: Course, rows: Rows, centres: np.ndarray, rates: np.ndarray):
        self.scene, self.course, self._rows, self.centres, self.rates = scene, course, rows, centres, rates
        self.mechanism = scene.target.known_as(Mechanism)
        system, normal = self.mechanism.system, np.array(self.mechanism.struck.normal)
        self._number = [link.name for link in self.mechanism.links].index(self.mechanism.struck.link)
        struck, rate = self._struck, _ = self._struck_point()
        masses = np.array([link.mass for link in system.links])
        swift = rates.reshape(course.time.size, -1, 3)
        impulse = course.contact[:, IMPULSE]
        self._given, self._lasting = np.diff(impulse), np.diff(course.time)
        self._struck_rows, self._by_law = np.flatnonzero(self._given != 0.0), not scene.rigid_contact
        super().__init__(
            time=course.time,
            force=np.zeros(course.time.size),
            impulse=impulse,
            impactor_position=(course.place - course.place[0]) @ normal,
            impactor_velocity=course.speed @ normal,
            end_position=(struck - struck[0]) @ normal,
            end_velocity=rate @ normal,
            rigid_velocity=masses @ (swift[:, :, :2] @ normal).T / masses.sum(),
            energies=self._energies(),
        )

    def _energies(self) -> dict[str, np.ndarray]:
        """Parts [J]; "drives" is what the drives have taken up, "weight" what has gone into height."""
        course, system = self.course, self.mechanism.system
        inertia = np.concatenate([(link.mass, link.mass, link.inertia) for link in system.links])
        load = np.concatenate([(*(link.mass * system.gravity), 0.0) for link in system.links])
        mass = 0.0 if self.scene.impactor.held else self.scene.impactor.mass
        weight = -(self.centres - self.centres[0]) @ load
        weight -= mass * (course.place - course.place[0]) @ system.gravity
        return {
            "impactor": 0.5 * mass * (course.speed**2).sum(axis=1),
            "target_rigid": 0.5 * (self.rates**2 @ inertia),
            "target_vibration": np.zeros(course.time.size),
            "local": self._stored(),
            "dissipated": course.contact[:, LOST],
            "drives": course.reactions @ self._rows.rate,
            "weight": weight,
            **({"springs": self._stretched()} if self.mechanism.springs else {}),
        }

    @abstractmethod
    def _stretched(self) -> np.ndarray:
        """Energy in the springs at every instant [J]."""

    @abstractmethod
    def _struck_point(self) -> tuple[np.ndarray, np.ndarray]:
        """Places and velocities (instants, 2) of the point that is struck first."""

    @abstractmethod
    def _directions(self, number: int, rows: np.ndarray) -> np.ndarray:
        """Of one of the lines among the constraints, at some instants, (instants, 2)."""

    @abstractmethod
    def link_points(self, time, parts: int = 1, magnified: float = 1.0) -> dict[str, np.ndarray]:
        """Where the links are, by name: (time, parts + 1, 2) [m], at even distances along each; what they bend and
        stretch is drawn `magnified` times."""

    @property
    @abstractmethod
    def widest_gap(self) -> float:
        """By how much any joint is ever open at the instants [m]."""

    def missed(self, low: float, high: float, near: float) -> tuple[float, float] | None:
        """When the mass first comes behind the line of the struck link beside it, which is met from `low` to `high` [m]
        from the struck point on, and how far beside that [s, m]; None where it never does so as `near` [m]."""
        place = self.course.place - self._struck
        turn = self.centres[:, 3 * self._number + 2]
        normal = turned(np.array(self.mechanism.struck.normal), turn - turn[0])
        along = normal[:, 1] * place[:, 0] - normal[:, 0] * place[:, 1]
        beside = np.maximum(low - along, along - high)
        behind = ((normal * place).sum(axis=1) > 0.0) & (beside > 0.0)
        passes = np.flatnonzero(behind[1:] & ~behind[:-1] & (beside[1:] <= near)) + 1
        return (float(self.time[passes[0]]), float(beside[passes[0]])) if passes.size else None

    def contacts(self) -> list[ContactPeriod]:
        """Contacts by the law; or impacts without duration, and stretches in which the mass rests on the link."""
        found, time, force = [], self.time, self.forces
        for row in self._struck_rows.tolist():
            start, end, impulse = float(time[row]), float(time[row + 1]), float(self._given[row])
            peak = float(force[row]) if self._by_law else None
            if found and end > start and start <= found[-1].end:  # it lasts, or begins to rest
                before = found.pop()
                start, impulse = before.start, before.impulse + impulse
                peak = None if peak is None else max(peak, before.peak_force)
            found.append(ContactPeriod(start, end, impulse, peak))
        return found

    def given_to_links(self, rows: np.ndarray) -> np.ndarray:
        """Size of the impulse that the contact gives the links in some steps, by what they gain of momentum beside that
        by their weight and the ground, (rows,) [N s]."""
        system, course = self.mechanism.system, self.course
        masses = np.array([link.mass for link in system.links])
        momentum = masses @ self.rates.reshape(course.time.size, -1, 3)[:, :, :2]
        found = np.diff(momentum, axis=0)[rows]
        found -= masses.sum() * np.multiply.outer(np.diff(course.time)[rows], system.gravity)
        pushed = self._by_joint(course.reactions[rows + 1] - course.reactions[rows], rows)[:, :, :2]
        for number, joint in enumerate(system.joints):
            found -= pushed[:, number] * ((joint.first == GROUND) - 1.0 * (joint.second == GROUND))
        return np.hypot(*found.T)

    @property
    def impulses(self) -> tuple[np.ndarray, np.ndarray]:
        """Times [s] and impulses [N s] of the impacts without duration."""
        sudden = self._struck_rows[self._lasting[self._struck_rows] == 0.0]
        return self.time[sudden], self._given[sudden]

    # --- contact force, constant between instants; impulses without duration are left out, and those at rest

    @cached_property
    def forces(self) -> np.ndarray:
        """Between the instants, (instants - 1,) [N]."""
        if not self._by_law:
            return np.zeros(self._given.size)
        return self._given / np.where(self._lasting > 0.0, self._lasting, 1.0)

    def force(self, time, after=True):
        time = np.clip(np.asarray(time, float), self.time[0], self.time[-1])
        row = np.searchsorted(self.time, time, "right" if after else "left") - 1
        return self.forces[np.clip(row, 0, self.forces.size - 1)]

    def force_history(self):
        """Times and forces; every instant stands twice."""
        return np.repeat(self.time, 2)[1:-1], np.repeat(self.forces, 2)

    def _stored(self) -> np.ndarray:
        """Energy that the contact would give back, and the modes left out, at every instant [J]."""
        depths, law = self.course.contact[:, INDENTATION], self.scene.contact
        found = 0.5 * self.mechanism.frozen.modes.residual_compliance * self.course.contact[:, GIVING] ** 2
        if self._by_law:
            deepest = np.maximum.accumulate(np.maximum(depths, 0.0))
            for row in np.flatnonzero(depths > 0.0).tolist():
                found[row] += law.stored(float(depths[row]), float(deepest[row]))
        return found

    def coordinates(self, time) -> np.ndarray:
        """Of the integrator, (time, size): places of the centres and angles of rigid links."""
        time = np.atleast_1d(np.asarray(time, float))
        return np.stack([np.interp(time, self.time, values) for values in self.course.coordinates.T], axis=1)

    def impactor_places(self, time) -> np.ndarray:
        """Where the mass is, (time, 2) [m]."""
        return np.stack([np.interp(time, self.time, values) for values in self.course.place.T], axis=1)

    def link_rates(self, time: float) -> dict[str, dict[str, Any]]:
        """By link: velocity of its centre, and spin."""
        row = int(np.clip(np.searchsorted(self.time, time, "right") - 1, 0, self.time.size - 1))
        rates = self.rates[row].reshape(-1, 3)
        return {
            link.name: {"final_velocity": own[:2].tolist(), "final_spin": float(own[2])}
            for link, own in zip(self.mechanism.links, rates, strict=True)
        }

    def reactions(self, until: float) -> list[dict[str, Any]]:
        """What the impulses of all contacts up to a time [s] make every joint do at once to its second link."""
        rows = self._struck_rows
        counts = (self.time[rows] < until) | (self.time[rows + 1] <= until)
        rows = rows[counts & (self._by_law | (self._lasting[rows] == 0.0))]
        return said(self._by_joint(self.course.sudden[rows + 1] - self.course.sudden[rows], rows).sum(axis=0))

    def reaction_forces(self, time) -> np.ndarray:
        """What the first link of each joint does to the second, averaged over the step about each instant and without
        the impacts: force along x and y [N] and moment [N m], (time, joints, 3)."""
        instants = np.atleast_1d(np.asarray(time, float))
        rows = np.clip(np.searchsorted(self.time, instants, "right") - 1, 1, self.time.size - 2)
        rows -= self._lasting[rows] == 0.0
        pushed = self.course.reactions[rows + 1] - self.course.reactions[rows]
        return self._by_joint(pushed / self._lasting[rows, None], rows)

    def _by_joint(self, reactions: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Impulse and moment on the second link of each joint, (instants, joints, 3), from those of the constraints
        (instants, constraints) at these rows."""
        found = np.zeros((rows.size, len(self.mechanism.joints), 3))
        known = self._rows
        for values, joint, kind, number in zip(reactions.T, known.joint, known.kind, known.number, strict=True):
            if kind in (PIN_X, PIN_Y):
                found[:, joint, int(kind == PIN_Y)] -= values
            elif kind == ANGLE:
                found[:, joint, 2] -= values
            else:
                assert kind == LINE
                found[:, joint, :2] -= values[:, None] * self._directions(number, rows)
        return found


def said(joints: np.ndarray) -> list[dict[str, Any]]:
    """Impulse and moment of every joint, (joints, 3), as results say them."""
    return [{"impulse": row[:2].tolist(), "moment_impulse": float(row[2])} for row in joints]


def turned(direction: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """A direction (2,), turned by some angles, (angles, 2)."""
    x, y = direction
    return np.stack((np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y), axis=1)


class RigidMotion(MovingMotion):
    """Of rigid links."""

    def __init__(self, scene: Scene, course: Course, seen: Seen, linkage: Linkage, rows: Rows):
        self._linkage, self._seen = linkage, seen
        super().__init__(scene, course, rows, course.coordinates, course.rates)

    def _stretched(self) -> np.ndarray:
        return self._seen.springs

    def _struck_point(self) -> tuple[np.ndarray, np.ndarray]:
        course, start = self.course, 3 * self._number
        q, v = course.coordinates[:, start : start + 3], course.rates[:, start : start + 3]
        arm = self.mechanism.contact_point - q[0, :2]
        turned = q[:, 2] - q[0, 2]
        x = np.cos(turned) * arm[0] - np.sin(turned) * arm[1]
        y = np.sin(turned) * arm[0] + np.cos(turned) * arm[1]
        return q[:, :2] + np.stack((x, y), 1), v[:, :2] + v[:, 2:] * np.stack((-y, x), 1)

    def _directions(self, number: int, rows: np.ndarray) -> np.ndarray:
        lines = self._linkage.lines
        link = int(lines.first[number])
        angle = self.course.coordinates[rows, 3 * link + 2] if link >= 0 else np.zeros(rows.size)
        return turned(lines.direction[number], angle)

    def link_points(self, time, parts: int = 1, magnified: float = 1.0) -> dict[str, np.ndarray]:
        """Where the links are, by name: (time, parts + 1, 2) [m], at even distances along each."""
        q, found = self.coordinates(time), {}
        for number, link in enumerate(self.mechanism.links):
            x, y, angle = q[:, 3 * number : 3 * number + 3].T
            along = np.linspace(-0.5, 0.5, parts + 1) * link.length
            found[link.name] = np.stack(
                (
                    x[:, None] + np.multiply.outer(np.cos(angle), along),
                    y[:, None] + np.multiply.outer(np.sin(angle), along),
                ),
                axis=2,
            )
        return found

    @property
    def widest_gap(self) -> float:
        return float(self._seen.gap.max())
