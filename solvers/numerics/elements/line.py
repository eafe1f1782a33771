"""Two bodies as meshes side by side, not joined: a line from the far end of one to that of the other."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from . import banded
from .mesh import Mesh


def two_sided(first: Callable, second: Callable, sign: float) -> Callable:
    """Fields of both bodies by rows: those of `first` where x is negative, at -x and times `sign`, else of `second`."""

    def found(x: np.ndarray) -> np.ndarray:
        x = np.asarray(x, float)
        blocks = sign * first(np.where(x < 0.0, -x, 0.0)), second(np.where(x < 0.0, 0.0, x))
        return np.vstack((blocks[0] * (x < 0.0), blocks[1] * (x >= 0.0)))

    return found


class Line(NamedTuple):
    """Two bodies, not joined: the unknowns of the impactor, then those of the target.

    Arrays as in `Mesh`; `front` is the unknown of the impactor's face, `other` that of the target's, -1 if it has none.
    """

    mass: np.ndarray
    stiffness: np.ndarray
    split: int  # unknowns of the impactor
    front: int
    other: int
    wholes: "Wholes"

    def strain_energy(self, displacement: np.ndarray) -> np.ndarray:
        """Of every unknown's share (rows, unknowns) [J]; without the digits that motions as a whole would take."""
        bent = self._bent(displacement)
        return 0.5 * bent * banded.times(self.stiffness, bent)

    def accelerations(self, displacement: np.ndarray, force: np.ndarray) -> np.ndarray:
        """Of every unknown (rows, unknowns) under a contact force (rows,) [N]."""
        from scipy.linalg import solveh_banded

        load = -banded.times(self.stiffness, self._bent(displacement))
        load[:, self.front] -= force
        if self.other >= 0:
            load[:, self.other] += force
        return solveh_banded(self.mass, load.T, lower=True, overwrite_b=True).T

    def _bent(self, displacement: np.ndarray) -> np.ndarray:
        return displacement - displacement[:, self.wholes.anchors] @ self.wholes.shapes


class Wholes(NamedTuple):
    """What two bodies do as wholes: motions without strain, each 1 at its own anchor and 0 at the others'.

    A mesh that has gone far has lost the digits of its strain, so that its forces are taken from what is left.
    """

    shapes: np.ndarray  # (motions, unknowns)
    anchors: np.ndarray  # (motions,): unknowns
    spans: np.ndarray  # (motions, 2): first unknown of the body and the one after its last

    def still(self) -> np.ndarray:
        """Displacements and rates of none of them, (2, motions)."""
        return np.zeros((2, self.anchors.size))


def line(impactor: Mesh, target: Mesh) -> Line:
    mass, stiffness = (
        banded.side_by_side(*pair) for pair in ((impactor.mass, target.mass), (impactor.stiffness, target.stiffness))
    )
    split = impactor.size
    other = split + target.struck if target.size else -1
    return Line(mass, stiffness, split, impactor.struck, other, _wholes(impactor, target))


def _wholes(impactor: Mesh, target: Mesh) -> Wholes:
    size = impactor.size + target.size
    shapes, anchors, spans = [np.zeros((0, size))], [], []
    for mesh, start in ((impactor, 0), (target, impactor.size)):
        count = mesh.free.shape[0]
        rows = np.zeros((count, size))
        if count:
            rows[:, start : start + mesh.size] = np.linalg.solve(mesh.free[:, :count], mesh.free)
        shapes.append(rows)
        anchors += range(start, start + count)
        spans += count * [(start, start + mesh.size)]
    return Wholes(np.vstack(shapes), np.array(anchors, np.int64), np.array(spans, np.int64).reshape(-1, 2))


def highest_frequency(line: Line, contact_stiffness: float) -> float:
    """Of rods and points with lumped masses and the contact spring [N/m] between their faces [rad/s]."""
    from scipy.linalg import eigvalsh_tridiagonal

    row = np.append(np.arange(line.split)[::-1], np.arange(line.split, line.mass.shape[1]))  # face to face
    stiffness, mass, face = line.stiffness[0, row], line.mass[0, row], line.split - 1
    beside = np.concatenate((line.stiffness[1, : line.split][::-1][1:], line.stiffness[1, face:-1]))
    stiffness[face] += contact_stiffness
    if line.other >= 0:
        stiffness[face + 1] += contact_stiffness
        beside[face] -= contact_stiffness
    last, root = stiffness.size - 1, np.sqrt(mass)
    found = eigvalsh_tridiagonal(
        stiffness / mass, beside / (root[1:] * root[:-1]), select="i", select_range=(last, last)
    )
    return float(np.sqrt(found[0]))
