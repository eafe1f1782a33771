"""What the integrator has recorded of a mechanism with flexible links, as a motion."""

from functools import cached_property
from typing import Any

import numpy as np

from ...numerics.multibody.flight import Course
from ...numerics.multibody.integrals import shortening
from ...numerics.multibody.variational import Floating, Seen
from ...scene import Scene
from .linkage import Rows
from .motion import MovingMotion, said, turned

PLACES = 21  # at which slopes are looked at


class FlexibleMotion(MovingMotion):
    """Of links of which some bend or stretch; fields are those of the struck link, x from its first end.

    "target_rigid" is the energy of rigid links with the same momenta and angular momenta, "target_vibration" all else:
    that of deformation, beside the steady one of before the impact.
    """

    def __init__(self, scene: Scene, course: Course, seen: Seen, linkage: Floating, rows: Rows):
        self._linkage, self._seen = linkage, seen
        super().__init__(scene, course, rows, seen.centres, seen.rates)

    def _energies(self) -> dict[str, np.ndarray]:
        found, stiffness = super()._energies(), self.mechanism.system.stiffness
        found["target_vibration"] = (
            self._seen.kinetic - found["target_rigid"] + 0.5 * self.course.coordinates**2 @ stiffness
        )
        before = sum(part[0] for part in found.values()) - self.scene.initial_energy
        found["target_vibration"] -= before
        return found

    def reactions(self, until: float) -> list[dict[str, Any]]:
        """By a contact law all that the joints give up to a time [s] beside their steady reactions before it; of
        impulses what they do at once."""
        if self.scene.rigid_contact:
            return super().reactions(until)
        system, frozen = self.mechanism.system, self.mechanism.frozen
        found = np.zeros((len(self.mechanism.joints), 3))
        for row, number in enumerate(np.flatnonzero(system.held)):
            found[system.joint_of[number]] += until * frozen.reactions_before[row] * system.effect[number]
        rows = np.arange(int(np.searchsorted(self.time, until)))
        given = self.course.reactions[rows + 1] - self.course.reactions[rows]
        return said(found + self._by_joint(given, rows).sum(axis=0))

    def _stretched(self) -> np.ndarray:
        return self._seen.springs

    @property
    def steepest(self) -> float:
        """Slope of any link at any instant, the largest; infinite if they bend beyond all bounds."""
        worst = 0.0
        for number, link in enumerate(self.mechanism.system.links):
            if link.shapes.frequencies.size:
                x = np.linspace(0.0, link.length, PLACES)
                slopes = self.course.coordinates[:, self._own(number)][:, 3:] @ link.shapes.slopes(x)
                worst = max(worst, float(np.abs(np.nan_to_num(slopes, nan=np.inf)).max()))
        return worst

    @property
    def widest_gap(self) -> float:
        return float(self._seen.gap.max())

    def _struck_point(self) -> tuple[np.ndarray, np.ndarray]:
        at = self.mechanism.struck.at * self.mechanism.struck_link.length
        place, rate = self._points(np.array([at]), self.course.coordinates, self.course.rates)
        return place[:, 0], rate[:, 0]

    def _directions(self, number: int, rows: np.ndarray) -> np.ndarray:
        ties, stations, q = self._linkage.ties, self._linkage.stations, self.course.coordinates[rows]
        tie = int(ties.ends[0]) + number
        station, angle = ties.first[tie], np.zeros(rows.size)
        link = int(stations.link[station])
        if link >= 0:
            own = q[:, self._own(link)]
            angle = own[:, 2] + own[:, 3:] @ stations.turns[station, : own.shape[1] - 3]
        return turned(ties.direction[tie], angle)

    def _own(self, link: int) -> slice:
        return slice(self.mechanism.system.offsets[link], self.mechanism.system.offsets[link + 1])

    def _points(self, x, coordinates, rates, link: int | None = None, magnified: float = 1.0):
        """Places and velocities (time, x, 2) of points at x [m] along a link, the struck one if none is named."""
        number = self._number if link is None else link
        bar, own = self.mechanism.system.links[number], self._own(number)
        q, v = coordinates[:, own], rates[:, own]
        shapes, shorter = bar.shapes.displacements(x), np.array([shortening(bar, each) for each in x])
        within, moved = (np.einsum("ts,sxk->txk", magnified * given[:, 3:], shapes) for given in (q, v))
        within[:, :, 0] += x - 0.5 * np.einsum("ts,xsr,tr->tx", q[:, 3:], shorter, q[:, 3:], optimize=True)
        moved[:, :, 0] -= np.einsum("ts,xsr,tr->tx", v[:, 3:], shorter, q[:, 3:], optimize=True)
        moved += v[:, 2, None, None] * np.stack((-within[:, :, 1], within[:, :, 0]), axis=2)
        cosine, sine = np.cos(q[:, 2])[:, None], np.sin(q[:, 2])[:, None]

        def rotated(given: np.ndarray) -> np.ndarray:
            along, across = given[:, :, 0], given[:, :, 1]
            return np.stack((cosine * along - sine * across, sine * along + cosine * across), axis=2)

        return q[:, None, :2] + rotated(within), v[:, None, :2] + rotated(moved)

    def link_points(self, time, parts: int = 1, magnified: float = 1.0) -> dict[str, np.ndarray]:
        q, found = self.coordinates(time), {}
        for number, link in enumerate(self.mechanism.links):
            x = np.linspace(0.0, link.length, parts + 1)
            found[link.name] = self._points(x, q, np.zeros_like(q), number, magnified)[0]
        return found

    # --- fields of the struck link, along the normal

    @cached_property
    def _normal(self) -> np.ndarray:
        return np.array(self.mechanism.struck.normal)

    @property
    def has_field(self) -> bool:
        return True

    def _between(self, time, values: np.ndarray) -> np.ndarray:
        return np.stack([self._at(time, column) for column in values.T], axis=-1)

    def displacement(self, time, x):
        x = np.atleast_1d(np.asarray(x, float))
        q = np.vstack((self.course.coordinates[:1], self._between(np.atleast_1d(time), self.course.coordinates)))
        places = self._points(x, q, np.zeros_like(q))[0] @ self._normal
        return places[1:] - places[0]

    def velocity(self, time, x):
        time = np.atleast_1d(time)
        given = self._between(time, self.course.coordinates), self._between(time, self.course.rates)
        return self._points(np.atleast_1d(np.asarray(x, float)), *given)[1] @ self._normal

    def _carried(self, name: str, time, x):
        number = self._number
        amplitudes = self._between(np.atleast_1d(time), self.course.coordinates)[:, self._own(number)][:, 3:]
        return amplitudes @ self.mechanism.system.links[number].shapes.carried(name, np.atleast_1d(x))

    def moment(self, time, x):
        """Bending moment in the struck link [N m] (time, x)."""
        return self._carried("moments", time, x)

    def shear(self, time, x):
        """Shear force in the struck link [N] (time, x)."""
        return self._carried("shears", time, x)

    def stress(self, time, x):
        """On the side that is struck, compression positive [Pa]."""
        return -self.mechanism.at_rest.fibre * self.moment(time, x)
