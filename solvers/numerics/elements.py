"""Bodies as chains of elements, and what follows from the chain: modes, compliance, a line of two bodies."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from . import bands
from .modes import Modes, front_time

CONSISTENT, AVERAGED, LUMPED = 0.0, 0.5, 1.0  # share of a rod's mass put on the nodes: how the mesh carries its inertia

ALIKE = 0.01  # of an element's mass: no more is moved to make the mass of a chain like its stiffness off the diagonal
ROUNDING = 1e-9  # of a diagonal entry
MANY = 20  # times as many unknowns as modes asked for: then the modes are looked for one by one


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
        """Who is apart for less may touch, as far as it can tell [s]. Bending waves disperse: a beam has no fronts."""
        return self.shortest_period if self.bends else front_time(self.size, self.shortest_period)

    def moving(self, velocity: float) -> np.ndarray:
        """Rates of all unknowns [m/s, rad/s] before the blow; of what is held all are zero."""
        return velocity * self.free[0] if velocity else np.zeros(self.size)

    @property
    def whole(self) -> np.ndarray | None:
        """The motion as a whole that a blow starts, (unknowns,), 1 where it is struck; None if the body is held."""
        if not self.free.size:
            return None
        inertia = bands.times(self.mass, self.free) @ self.free.T
        started = np.linalg.solve(inertia, self.free[:, self.struck]) @ self.free
        return started / started[self.struck]

    def rigid_energy(self, rates: np.ndarray) -> np.ndarray:
        """Kinetic energy of the motion as a whole (rows,) [J] from rates (rows, unknowns); none of what is held."""
        if not self.free.size:
            return np.zeros(rates.shape[0])
        inertia = bands.times(self.mass, self.free)
        momenta = rates @ inertia.T
        return 0.5 * (momenta * np.linalg.solve(inertia @ self.free.T, momenta.T).T).sum(1)

    @property
    def rigid_mass(self) -> float:
        """What a blow feels of the body's motion as a whole [kg]; infinite if it is held."""
        whole = self.whole
        return np.inf if whole is None else float(whole @ bands.times(self.mass, whole))


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
    beside = masses * (1.0 - lumping) / 6.0
    alike = springs * float(beside.sum() / springs.sum())  # off-diagonals as the stiffness has them: see `_chain_pairs`
    if np.abs(alike - beside).max() <= ALIKE * masses.min():
        beside = alike
    own = 0.5 * masses - beside
    mass = np.vstack((np.append(own, 0.0) + np.append(0.0, own), np.append(beside, 0.0)))
    mass[0, -1] += end_mass
    stiffness = np.vstack((np.append(springs, 0.0) + np.append(0.0, springs), np.append(-springs, 0.0)))
    place, count = np.append(0.0, np.cumsum(lengths)), mass.shape[1]
    kept, weights = np.arange(count - fixed), bands.times(mass, np.ones(count))
    shapes, slopes = chain_fields(place, kept.size)
    return Mesh(
        place,
        bands.without(mass, kept),
        bands.without(stiffness, kept),
        0,
        np.ones((0 if fixed else 1, kept.size)),
        weights[kept],
        float(weights.sum()),
        shapes,
        slopes,
        neighbour=float(springs[0]),
        transit=float(np.sqrt(masses / springs).min()),
        shortest_period=float(2.0 * np.pi * np.sqrt(0.5 * (own - beside) / springs).min()),
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


def without_mass_in_front(mesh: Mesh) -> Mesh:
    """The inertia of a rod's struck node moved to the one behind it, so that the face follows its force without delay.

    The mesh that is left begins at that node; its `neighbour` spring joins it to the massless face.
    Source: singular mass matrices for contact, Monjaraz Tec, Gross and Krack (2022).
    """
    mass, stiffness = mesh.mass[:, 1:].copy(), mesh.stiffness[:, 1:].copy()
    mass[0, :1] += mesh.mass[0, 0] + 2.0 * mesh.mass[1, 0]  # a single element of a fixed rod leaves no node
    stiffness[0, :1] -= mesh.neighbour
    weights = mesh.weights[1:].copy()
    weights[:1] += mesh.weights[0]
    return mesh._replace(mass=mass, stiffness=stiffness, free=mesh.free[:, 1:], weights=weights)


def mesh_modes(mesh: Mesh, count: int | None = None, massless: bool = False) -> Modes:
    """The lowest `count` modes of a mesh (all without it), motion as a whole apart, mass-normalised.

    The residual compliance is that of the modes of the mesh left out. `massless`, of a rod: the inertia of the struck
    node is moved to the one behind it; then the force on the face is found without delay from its own compliance.
    Error: the lowest are found to rounding, each as 1 / omega^2; the highest suffer from their ratio to the lowest.
    Source: thesis (6.17), (6.18).
    """
    body = without_mass_in_front(mesh) if massless else mesh
    available = body.size - body.free.shape[0] if body.size else 0
    kept = available if count is None else min(count, available)
    whole, (frequencies, vectors) = mesh.whole, _eigenpairs(body, kept)
    at_contact = vectors[:, body.struck] if kept else np.zeros(0)
    residual = _left_out(body, vectors) if kept < available else 0.0
    residual += 1.0 / mesh.neighbour if massless else 0.0
    full = vectors
    if massless:  # without its own inertia the face goes along with the node behind it
        full = np.hstack((vectors[:, :1], vectors)) if kept else np.zeros((0, mesh.size))

    def fields(field: Callable, rows: np.ndarray = full) -> Callable:
        return lambda x: rows @ field(x)

    bent = carried(mesh, full, -(frequencies[:, None] ** 2) * full) if mesh.bends else {}
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=mesh.rigid_mass,
        residual_compliance=residual,
        shapes=fields(mesh.shapes),
        slopes=fields(mesh.slopes),
        means=full @ mesh.weights / mesh.total_mass,
        static_shapes=fields(mesh.shapes, _static(mesh, body)),
        **bent,
        **_static_fields(mesh),
        **({} if whole is None else {"rigid_shape": lambda x: whole @ mesh.shapes(x)}),
        rigid_mean=1.0 if whole is None else float(whole @ mesh.weights / mesh.total_mass),
    )


def _eigenpairs(mesh: Mesh, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (count,) and mass-normalised modes (count, unknowns), motions as a whole apart."""
    from scipy.linalg import eigh

    if not count:
        return np.zeros(0), np.zeros((0, mesh.size))
    if mesh.mass.shape[0] == 2 and mesh.size > 2:
        share = mesh.mass[1, :-1] / mesh.stiffness[1, :-1]
        if np.ptp(share) <= ROUNDING * np.abs(share).max():
            return _chain_pairs(mesh, -float(share.mean()), count)
    shift, free, size = 0.0, mesh.free.shape[0], mesh.size
    if free:  # a square of about the lowest frequency makes the stiffness definite
        bent = _bent(mesh, _unit_load(mesh), mesh.free)
        shift = float(bent @ bands.times(mesh.stiffness, bent)) / float(bent @ bands.times(mesh.mass, bent))
    stiffness = mesh.stiffness + shift * mesh.mass
    if MANY * count < size:
        inverses, vectors = _largest(mesh.mass, stiffness, count + free)
    else:
        full = bands.full(mesh.mass), bands.full(stiffness)
        inverses, vectors = eigh(*full, subset_by_index=(size - free - count, size - 1))
    inverses, vectors = inverses[:count], vectors[:, :count]
    squares, modes = 1.0 / inverses[::-1] - shift, (vectors / np.sqrt(inverses)).T[::-1]
    modes *= np.where(modes[:, mesh.struck : mesh.struck + 1] < 0.0, -1.0, 1.0)
    return np.sqrt(squares), modes


def _chain_pairs(mesh: Mesh, share: float, count: int) -> tuple[np.ndarray, np.ndarray]:
    """`_eigenpairs` of a chain whose mass is a diagonal D less `share` [s^2] of its stiffness K, in O(unknowns) each.

    Straight elements through which a wave takes equally long have such a mass, whatever part of it is lumped: the
    vectors are those of K and D, one tridiagonal matrix, and 1 / omega^2 is the 1 / nu of that less `share`. From the
    vectors nu follows to rounding, as a sum of squares.
    """
    from scipy.linalg import eigh_tridiagonal

    lumped = mesh.mass[0] + share * mesh.stiffness[0]
    root, springs, free = np.sqrt(lumped), -mesh.stiffness[1, :-1], mesh.free.shape[0]
    many = 4 * count > mesh.size  # then it is quicker to find all; the driver for some of them that is quickest fails
    _, vectors = eigh_tridiagonal(
        mesh.stiffness[0] / lumped,
        -springs / (root[1:] * root[:-1]),
        **({"lapack_driver": "stevd"} if many else {"select": "i", "select_range": (0, free + count - 1)}),
    )
    modes = (vectors[:, free : free + count] / root[:, None]).T
    ground = mesh.stiffness[0] - np.append(springs, 0.0) - np.append(0.0, springs)
    ground[np.abs(ground) < ROUNDING * mesh.stiffness[0]] = 0.0
    squares = (np.diff(modes, axis=1) ** 2) @ springs + modes**2 @ ground
    modes /= np.sqrt(1.0 - share * squares)[:, None]
    modes *= np.where(modes[:, mesh.struck : mesh.struck + 1] < 0.0, -1.0, 1.0)
    return np.sqrt(squares / (1.0 - share * squares)), modes


def _largest(mass: np.ndarray, stiffness: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The largest 1 / omega^2, ascending, and their vectors (unknowns, count): Lanczos, O(unknowns) for each."""
    from scipy.linalg import cho_solve_banded, cholesky_banded
    from scipy.sparse.linalg import LinearOperator, eigsh

    size, factor = mass.shape[1], cholesky_banded(stiffness, lower=True)

    def operator(apply: Callable) -> LinearOperator:
        return LinearOperator((size, size), matvec=lambda vector: apply(vector.ravel()), dtype=float)

    return eigsh(
        operator(lambda vector: bands.times(mass, vector)),
        count,
        M=operator(lambda vector: bands.times(stiffness, vector)),
        Minv=operator(lambda vector: cho_solve_banded((factor, True), vector)),
        which="LA",
        v0=np.linspace(1.0, 2.0, size),
    )


def _bent(mesh: Mesh, load: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Static displacement under a load, without what motions or modes `kept` (motions, unknowns) take up of both."""
    from scipy.linalg import solveh_banded

    inertia = bands.times(mesh.mass, kept)
    gram = inertia @ kept.T
    stiffness = mesh.stiffness[: mesh.size].copy()
    free = mesh.free.shape[0]  # a free body is held anywhere: the load is in balance with its inertia
    if free == mesh.size:  # and so few nodes do not bend
        return np.zeros(mesh.size)
    stiffness[0, :free] += stiffness[0, :free]
    found = solveh_banded(stiffness, load - np.linalg.solve(gram, kept @ load) @ inertia, lower=True)
    return found - np.linalg.solve(gram, inertia @ found) @ kept


def _left_out(mesh: Mesh, modes: np.ndarray) -> float:
    """Compliance at the struck unknown of all modes but these [m/N]; O(unknowns), exact to its own rounding."""
    return max(float(_bent(mesh, _unit_load(mesh), np.vstack((mesh.free, modes)))[mesh.struck]), 0.0)


def _unit_load(mesh: Mesh) -> np.ndarray:
    """1 N where the body is struck, (unknowns,)."""
    load = np.zeros(mesh.size)
    load[mesh.struck : mesh.struck + 1] = 1.0  # a single element without mass in front leaves no unknown
    return load


def _static(mesh: Mesh, body: Mesh) -> np.ndarray:
    """Displacements (unknowns,) under a steady unit force; `body`: the mesh, or it without mass on its struck node."""
    bent = _bent(body, _unit_load(body), body.free)
    if body is mesh:
        return bent
    return np.append((bent[0] if bent.size else 0.0) + 1.0 / mesh.neighbour, bent)


def _static_fields(mesh: Mesh) -> dict[str, Callable]:
    """Of a beam under a steady force of 1 N where it is struck, as `Modes` has them."""
    if not mesh.bends:
        return {}
    load, free = _unit_load(mesh), mesh.free
    sped_up = np.linalg.solve(bands.times(mesh.mass, free) @ free.T, free @ load) @ free
    found = carried(mesh, _bent(mesh, load, free), sped_up)
    return {f"static_{name}": field for name, field in found.items()}


def carried(mesh: Mesh, displacement: np.ndarray, acceleration: np.ndarray) -> dict[str, Callable]:
    """Moments and shear forces of a beam, (..., x), from both (..., unknowns), in balance with its inertia."""
    return {
        "moments": lambda x: displacement @ mesh.moments(x) + acceleration @ mesh.inertial_moments(x),
        "shears": lambda x: displacement @ mesh.shears(x) + acceleration @ mesh.inertial_shears(x),
    }


def with_accelerations(mesh: Mesh) -> Mesh:
    """The fields of a beam by its unknowns and, behind them, their accelerations, of which the first two know nothing.

    Any other body as it is.
    """
    if not mesh.bends:
        return mesh

    def behind(field: Callable, other: Callable | None = None) -> Callable:
        return lambda x: np.vstack((field(x), np.zeros((mesh.size, np.size(x))) if other is None else other(x)))

    return mesh._replace(
        shapes=behind(mesh.shapes),
        slopes=behind(mesh.slopes),
        moments=behind(mesh.moments, mesh.inertial_moments),
        shears=behind(mesh.shears, mesh.inertial_shears),
    )


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
        return 0.5 * bent * bands.times(self.stiffness, bent)

    def accelerations(self, displacement: np.ndarray, force: np.ndarray) -> np.ndarray:
        """Of every unknown (rows, unknowns) under a contact force (rows,) [N]."""
        from scipy.linalg import solveh_banded

        load = -bands.times(self.stiffness, self._bent(displacement))
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
        bands.side_by_side(*pair) for pair in ((impactor.mass, target.mass), (impactor.stiffness, target.stiffness))
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
