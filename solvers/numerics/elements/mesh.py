"""Bodies as chains of finite elements: masses and springs of their nodes, and the fields between them."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..modes import front_time
from . import banded

CONSISTENT, AVERAGED, LUMPED = 0.0, 0.5, 1.0  # share of a rod's mass put on the nodes: how the mesh carries its inertia

# Share of an element's mass: so much, and no more, is moved to make the mass of a chain like its stiffness off the
# diagonal, by which its modes are found by a far quicker way. Larger, and the mesh is another one where rods differ.
NEGLIGIBLE_TRANSFER = 0.01
# Of the entries summed: what rounding leaves of zero, or of equal ratios. Smaller, and rounding is taken for a support.
STIFFNESS_ROUNDING = 1e-9


class Mesh(NamedTuple):
    """A body as nodes in a row; what a support holds is left out of the unknowns.

    Unknowns are displacements, for beams also rotations. `mass` and `stiffness` are `bands` (1 + half, unknowns);
    shapes(x), slopes(x) (unknowns, x) are displacement and its slope at x [m] for 1 at each unknown alone, moments(x)
    and shears(x) those of a beam at rest, to which inertial_moments(x) and inertial_shears(x) add what an acceleration
    of 1 does.
    """

    place: np.ndarray  # of every node at rest, that held too [m]
    mass: np.ndarray  # [kg, kg m, kg m2]
    stiffness: np.ndarray  # [N/m, N, N m]
    struck: int  # the unknown that the contact force acts on
    free: np.ndarray  # (motions, unknowns): as a whole, without strain; none if held, a translation first if not
    weights: np.ndarray  # (unknowns,): momentum per velocity [kg]
    total_mass: float  # [kg], with what the support carries
    shapes: Callable[[np.ndarray], np.ndarray]
    slopes: Callable[[np.ndarray], np.ndarray]
    moments: Callable[[np.ndarray], np.ndarray] | None = None
    shears: Callable[[np.ndarray], np.ndarray] | None = None
    neighbour: float = 0.0  # stiffness of the element at the struck node [N/m]; 0 where there is none
    transit: float = np.inf  # shortest that a wave takes through an element [s]
    shortest_period: float = 0.0  # of an element on its own [s], just below that of the whole mesh
    struck_period: float = 0.0  # of the element at the struck node of a rod [s]
    inertial_moments: Callable[[np.ndarray], np.ndarray] | None = None
    inertial_shears: Callable[[np.ndarray], np.ndarray] | None = None

    @property
    def rings(self) -> bool:
        """Whether it has elements."""
        return self.place.size > 1

    @property
    def bends(self) -> bool:
        """Whether it is a beam."""
        return self.moments is not None

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.mass.shape[1]

    @property
    def resolved_time(self) -> float:
        """Bodies apart for less may still touch [s]. Bending waves disperse: a beam has no fronts."""
        return self.shortest_period if self.bends else front_time(self.size, self.shortest_period)

    def moving(self, velocity: float) -> np.ndarray:
        """Rates of all unknowns [m/s, rad/s] before the impact, by that of the struck place [m/s]; of what is held all
        are zero.
        """
        return velocity / self.free[0, self.struck] * self.free[0] if velocity else np.zeros(self.size)

    @property
    def whole(self) -> np.ndarray | None:
        """The motion as a whole that an impact starts, (unknowns,), 1 where it is struck; None if the body is held."""
        if not self.free.size:
            return None
        inertia = banded.times(self.mass, self.free) @ self.free.T
        started = np.linalg.solve(inertia, self.free[:, self.struck]) @ self.free
        return started / started[self.struck]

    def rigid_energy(self, rates: np.ndarray) -> np.ndarray:
        """Kinetic energy of the motion as a whole (rows,) [J] from rates (rows, unknowns); none of what is held."""
        if not self.free.size:
            return np.zeros(rates.shape[0])
        inertia = banded.times(self.mass, self.free)
        momenta = rates @ inertia.T
        return 0.5 * (momenta * np.linalg.solve(inertia @ self.free.T, momenta.T).T).sum(1)

    def ringing(self, u: np.ndarray, v: np.ndarray) -> tuple[float, float]:
        """How far it has moved as a whole where it is struck [m], and the energy of all else [J], from displacements
        and rates (unknowns,).
        """
        energy = 0.5 * float(v @ banded.times(self.mass, v) + u @ banded.times(self.stiffness, u))
        if not self.free.size:
            return 0.0, energy
        inertia = banded.times(self.mass, self.free)
        moved = np.linalg.solve(inertia @ self.free.T, inertia @ u) @ self.free[:, self.struck]
        return float(moved), energy - float(self.rigid_energy(v[None, :])[0])

    @property
    def rigid_mass(self) -> float:
        """What an impact feels of the body's motion as a whole [kg]; infinite if it is held."""
        whole = self.whole
        return np.inf if whole is None else float(whole @ banded.times(self.mass, whole))


def chain_fields(place: np.ndarray, kept: int) -> tuple[Callable, Callable]:
    """Shapes and slopes of straight elements between the nodes, of the first `kept` nodes."""

    def spread(x, first, second):
        x = np.asarray(x, float)
        cell = np.clip(np.searchsorted(place, x, "right") - 1, 0, place.size - 2)
        length = np.diff(place)[cell]
        found = np.zeros((place.size, cell.size))
        columns = np.arange(cell.size)
        part = (x - place[cell]) / length
        found[cell, columns], found[cell + 1, columns] = first(part, length), second(part, length)
        return found[:kept]

    return (
        lambda x: spread(x, lambda part, length: 1.0 - part, lambda part, length: part),
        lambda x: spread(x, lambda part, length: -1.0 / length, lambda part, length: 1.0 / length),
    )


def elements_of_rods(parts: Sequence[tuple[float, float, float]], elements: int) -> np.ndarray:
    """How many of about so many each of these rods gets, so that a wave takes as long through each, see `rod_mesh`."""
    transit = np.array([np.sqrt(mass / stiffness) for _, mass, stiffness in parts])
    return np.maximum(1, np.rint(elements * transit / transit.sum()).astype(int))


def rod_mesh(
    parts: Sequence[tuple[float, float, float]], elements: int, fixed: bool, end_mass: float, lumping: float
) -> Mesh:
    """Rods bonded one behind the other, each (length [m], mass [kg], stiffness E A / L [N/m]), the first one struck.

    About `elements` elements in all, shared out so that a wave takes as long through each; `lumping` of their mass
    stands on the nodes, the rest is consistent with straight shapes.
    Source: thesis (6.16); `CONSISTENT` is its choice.
    """
    counts = elements_of_rods(parts, elements)
    lengths, masses, springs = (
        np.repeat([part[i] * (n if i == 2 else 1.0 / n) for part, n in zip(parts, counts, strict=True)], counts)
        for i in range(3)
    )
    beside = masses * (1.0 - lumping) / 6.0
    alike = springs * float(beside.sum() / springs.sum())  # off-diagonals as the stiffness has them: see `_chain_pairs`
    if np.abs(alike - beside).max() <= NEGLIGIBLE_TRANSFER * masses.min():
        beside = alike
    own = 0.5 * masses - beside
    mass = np.vstack((np.append(own, 0.0) + np.append(0.0, own), np.append(beside, 0.0)))
    periods = 2.0 * np.pi * np.sqrt(0.5 * (own - beside) / springs)
    mass[0, -1] += end_mass
    stiffness = np.vstack((np.append(springs, 0.0) + np.append(0.0, springs), np.append(-springs, 0.0)))
    place, count = np.append(0.0, np.cumsum(lengths)), mass.shape[1]
    kept, weights = np.arange(count - fixed), banded.times(mass, np.ones(count))
    shapes, slopes = chain_fields(place, kept.size)
    return Mesh(
        place,
        banded.without(mass, kept),
        banded.without(stiffness, kept),
        0,
        np.ones((0 if fixed else 1, kept.size)),
        weights[kept],
        float(weights.sum()),
        shapes,
        slopes,
        neighbour=float(springs[0]),
        transit=float(np.sqrt(masses / springs).min()),
        shortest_period=float(periods.min()),
        struck_period=float(periods[0]),
    )


def point_mesh(mass: float, stiffness: float = 0.0) -> Mesh:
    """A rigid mass [kg], free or on a spring [N/m] that is held; of infinite mass: no node at all."""
    nodes = int(np.isfinite(mass))
    own = np.full((1, nodes), mass)
    return Mesh(
        np.zeros(nodes),
        own,
        np.full((1, nodes), stiffness),
        0,
        np.ones((int(nodes > 0 and stiffness == 0.0), nodes)),
        own[0],
        mass,
        lambda x: np.ones((nodes, np.size(x))),
        lambda x: np.zeros((nodes, np.size(x))),
    )


def about_pivot(mesh: Mesh) -> Mesh:
    """A body that turns about a pivot: its momentum is that about the pivot, its mass that felt where it is struck."""
    whole = mesh.whole
    assert whole is not None
    weights = banded.times(mesh.mass, whole)
    return mesh._replace(free=whole[None, :], weights=weights, total_mass=float(weights @ whole))


def with_accelerations(mesh: Mesh) -> Mesh:
    """The fields of a beam by its unknowns and, behind them, their accelerations, of which the first two know nothing.

    Any other body as it is.
    """
    if not mesh.bends:
        return mesh

    def behind(field: Callable | Any, other: Callable | None = None) -> Callable:
        return lambda x: np.vstack((field(x), np.zeros((mesh.size, np.size(x))) if other is None else other(x)))

    return mesh._replace(
        shapes=behind(mesh.shapes),
        slopes=behind(mesh.slopes),
        moments=behind(mesh.moments, mesh.inertial_moments),
        shears=behind(mesh.shears, mesh.inertial_shears),
    )
