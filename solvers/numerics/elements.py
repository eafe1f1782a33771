"""Rods as chains of two-node elements, and what follows from the chain: matrices, modes, a line of two bodies."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from .modes import Modes

CONSISTENT, AVERAGED, LUMPED = 0.0, 0.5, 1.0  # share of the mass put on the nodes: how the mesh carries its inertia


class Mesh(NamedTuple):
    """A body as nodes in a row, the first of them struck; a node held by a support is left out.

    Both matrices are symmetric with three diagonals: `mass`, `stiffness` (nodes,) on the diagonal and `*_beside`
    (nodes - 1,) next to it. An end that is held appears in `place` only.
    """

    place: np.ndarray  # of every node at rest, that held too, from the struck face into the body [m]
    mass: np.ndarray  # [kg]
    mass_beside: np.ndarray
    stiffness: np.ndarray  # [N/m]
    stiffness_beside: np.ndarray
    neighbour: float = 0.0  # stiffness of the element at the struck node [N/m]; 0 where there is none
    transit: float = np.inf  # shortest that a wave takes through an element [s]
    shortest_period: float = 0.0  # of an element on its own [s], just below that of the whole mesh

    @property
    def rings(self) -> bool:
        """Whether it has elements."""
        return self.place.size > 1

    @property
    def total_mass(self) -> float:
        return float(self.mass.sum() + 2.0 * self.mass_beside.sum())

    def shapes(self, x: np.ndarray) -> np.ndarray:
        """Displacement at x [m] for 1 m at each node alone, (nodes, x)."""
        if not self.rings:
            return np.ones((self.mass.size, np.size(x)))
        cell, part = self._cell(x)
        return self._spread(cell, 1.0 - part, part)

    def slopes(self, x: np.ndarray) -> np.ndarray:
        """Strain at x [m] for 1 m at each node alone, (nodes, x) [1/m]."""
        if not self.rings:
            return np.zeros((self.mass.size, np.size(x)))
        cell, _ = self._cell(x)
        length = np.diff(self.place)[cell]
        return self._spread(cell, -1.0 / length, 1.0 / length)

    def _cell(self, x):
        x = np.asarray(x, float)
        cell = np.clip(np.searchsorted(self.place, x, "right") - 1, 0, self.place.size - 2)
        return cell, (x - self.place[cell]) / np.diff(self.place)[cell]

    def _spread(self, cell, first, second):
        found = np.zeros((self.place.size, cell.size))
        found[cell, np.arange(cell.size)] = first
        found[cell + 1, np.arange(cell.size)] = second
        return found[: self.mass.size]


def rod_mesh(
    parts: Sequence[tuple[float, float, float]], elements: int, fixed: bool, end_mass: float, lumping: float
) -> Mesh:
    """Rods bonded one behind the other, each (length [m], mass [kg], stiffness E A / L [N/m]), the first one struck.

    About `elements` elements in all, shared out so that a wave takes as long through each; `lumping` of their mass
    stands on the nodes, the rest is consistent with straight shapes.
    Source: thesis (6.16); `CONSISTENT` is its choice.
    """
    transit = np.array([np.sqrt(mass / stiffness) for _, mass, stiffness in parts])
    counts = np.maximum(1, np.rint(elements * transit / transit.sum()).astype(int))
    lengths, masses, springs = (
        np.repeat([part[i] * (n if i == 2 else 1.0 / n) for part, n in zip(parts, counts, strict=True)], counts)
        for i in range(3)
    )
    own, beside = masses * (1.0 / 3.0 + lumping / 6.0), masses * (1.0 - lumping) / 6.0
    mass = np.append(own, 0.0) + np.append(0.0, own)
    mass[-1] += end_mass
    stiffness = np.append(springs, 0.0) + np.append(0.0, springs)
    kept = mass.size - fixed
    return Mesh(
        np.append(0.0, np.cumsum(lengths)),
        mass[:kept],
        beside[: kept - 1],
        stiffness[:kept],
        -springs[: kept - 1],
        float(springs[0]),
        float(np.sqrt(masses / springs).min()),
        float(2.0 * np.pi * np.sqrt(0.5 * (own - beside) / springs).min()),
    )


def point_mesh(mass: float, stiffness: float = 0.0) -> Mesh:
    """A rigid mass [kg], free or on a spring [N/m] that is held; of infinite mass: no node at all."""
    nodes, none = int(np.isfinite(mass)), np.zeros(0)
    return Mesh(np.zeros(nodes), np.full(nodes, mass), none, np.full(nodes, stiffness), none)


def without_mass_in_front(mesh: Mesh) -> Mesh:
    """The inertia of the struck node moved to the one behind it, so that the face follows its force without delay.

    The mesh that is left begins at that node; its `neighbour` spring joins it to the massless face.
    Source: singular mass matrices for contact, Monjaraz Tec, Gross and Krack (2022).
    """
    mass = mesh.mass[1:].copy()
    mass[0] += mesh.mass[0] + 2.0 * mesh.mass_beside[0]
    stiffness = mesh.stiffness[1:].copy()
    stiffness[0] -= mesh.neighbour
    beside = mesh.mass_beside[1:], mesh.stiffness_beside[1:]
    return mesh._replace(
        place=mesh.place[1:], mass=mass, mass_beside=beside[0], stiffness=stiffness, stiffness_beside=beside[1]
    )


def mesh_modes(mesh: Mesh, count: int | None = None, massless: bool = False) -> Modes:
    """The lowest `count` modes of a mesh (all without it), rigid-body motion apart, mass-normalised.

    The residual compliance is that of the mesh less that of the modes kept. `massless`: the inertia of the struck
    node is moved to the one behind it; then the force on the face is found without delay from its own compliance.
    Source: thesis (6.17), (6.18).
    """
    from scipy.linalg import eigh

    body = without_mass_in_front(mesh) if massless else mesh
    held = body.stiffness.sum() + 2.0 * body.stiffness_beside.sum() > 1e-9 * body.stiffness.sum()
    free = body.mass.size > 0 and not held
    available = body.mass.size - free
    kept = available if count is None else min(count, available)
    if kept == 0:
        none = np.zeros(0)
        nothing = lambda x: np.zeros((0, np.size(x)))  # noqa: E731
        return Modes(none, none, mesh.total_mass if free else np.inf, 0.0, nothing, nothing)
    matrices = (_full(body.stiffness, body.stiffness_beside), _full(body.mass, body.mass_beside))
    squares, vectors = eigh(*matrices, subset_by_index=(int(free), int(free) + kept - 1))
    vectors *= np.sign(vectors[0])
    frequencies, at_contact = np.sqrt(squares), vectors[0]
    face = 1.0 / body.neighbour if massless else 0.0
    residual = face + _compliance(body, free) - float(((at_contact / frequencies) ** 2).sum())
    whole = np.vstack((vectors[:1], vectors)) if massless else vectors
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=mesh.total_mass if free else np.inf,
        residual_compliance=max(residual, 0.0) if kept < available or massless else 0.0,
        shapes=lambda x: whole.T @ mesh.shapes(x),
        slopes=lambda x: whole.T @ mesh.slopes(x),
    )


def _full(diagonal: np.ndarray, beside: np.ndarray) -> np.ndarray:
    return np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1)


def _compliance(mesh: Mesh, free: bool) -> float:
    """Displacement of the struck node under 1 N [m/N]; of a free mesh relative to its rigid-body motion."""
    from scipy.linalg import solve_banded

    def times(diagonal, beside, vector):
        found = diagonal * vector
        found[1:] += beside * vector[:-1]
        found[:-1] += beside * vector[1:]
        return found

    whole, load = np.ones(mesh.mass.size), np.zeros(mesh.mass.size)
    load[0] = 1.0
    stiffness = mesh.stiffness.copy()
    inertia = times(mesh.mass, mesh.mass_beside, whole)
    if free:  # accelerated as a whole by the load, and held anywhere
        load -= inertia / inertia.sum()
        stiffness[0] += mesh.stiffness[0]
    bands = np.zeros((3, mesh.mass.size))
    bands[0, 1:], bands[1], bands[2, :-1] = mesh.stiffness_beside, stiffness, mesh.stiffness_beside
    bent = solve_banded((1, 1), bands, load)
    if free:
        bent -= (inertia @ bent) / inertia.sum()
    return float(bent[0])


def two_sided(first: Callable, second: Callable, sign: float) -> Callable:
    """Fields of both bodies by rows: those of `first` where x is negative, at -x and times `sign`, else of `second`."""

    def found(x: np.ndarray) -> np.ndarray:
        x = np.asarray(x, float)
        blocks = sign * first(np.where(x < 0.0, -x, 0.0)), second(np.where(x < 0.0, 0.0, x))
        return np.vstack((blocks[0] * (x < 0.0), blocks[1] * (x >= 0.0)))

    return found


class Line(NamedTuple):
    """Two bodies on one axis as one row of nodes: the impactor's, its struck face last, then the target's.

    Arrays as in `Mesh`; `front` is the node of the impactor's face, that of the target's is the next one, if any.
    """

    mass: np.ndarray
    mass_beside: np.ndarray
    stiffness: np.ndarray
    stiffness_beside: np.ndarray
    front: int


def line(impactor: Mesh, target: Mesh) -> Line:
    """Both bodies in a row, not joined."""
    joint = np.zeros(1 if target.mass.size else 0)
    pairs = ((impactor.mass, target.mass), (impactor.stiffness, target.stiffness))
    beside = ((impactor.mass_beside, target.mass_beside), (impactor.stiffness_beside, target.stiffness_beside))
    mass, stiffness = (np.concatenate((first[::-1], second)) for first, second in pairs)
    mass_beside, stiffness_beside = (np.concatenate((first[::-1], joint, second)) for first, second in beside)
    return Line(mass, mass_beside, stiffness, stiffness_beside, impactor.mass.size - 1)


def highest_frequency(line: Line, contact_stiffness: float) -> float:
    """Of a line with lumped masses and the contact spring [N/m] between its faces [rad/s]."""
    from scipy.linalg import eigvalsh_tridiagonal

    stiffness, beside = line.stiffness.copy(), line.stiffness_beside.copy()
    stiffness[line.front] += contact_stiffness
    if line.front + 1 < stiffness.size:
        stiffness[line.front + 1] += contact_stiffness
        beside[line.front] -= contact_stiffness
    last = stiffness.size - 1
    root = np.sqrt(line.mass)
    diagonal, beside = stiffness / line.mass, beside / (root[1:] * root[:-1])
    return float(np.sqrt(eigvalsh_tridiagonal(diagonal, beside, select="i", select_range=(last, last))[0]))
