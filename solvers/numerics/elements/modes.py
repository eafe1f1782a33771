"""Natural modes of a mesh, and what the modes left out of it give way."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..modes import Modes, as_a_whole
from . import banded
from .mesh import STIFFNESS_ROUNDING, Mesh

# Unknowns for each mode asked for: with more of them the modes are found one by one, else all at once. It is for speed.
MANY_UNKNOWNS = 20


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

    bent: dict[str, Any] = carried(mesh, full, -(frequencies[:, None] ** 2) * full) if mesh.bends else {}
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
        rigid_shape=as_a_whole if whole is None else lambda x: whole @ mesh.shapes(x),
        rigid_mean=1.0 if whole is None else float(whole @ mesh.weights / mesh.total_mass),
    )


def _eigenpairs(mesh: Mesh, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (count,) and mass-normalised modes (count, unknowns), motions as a whole apart."""
    from scipy.linalg import eigh

    if not count:
        return np.zeros(0), np.zeros((0, mesh.size))
    if mesh.mass.shape[0] == 2 and mesh.size > 2:
        share = mesh.mass[1, :-1] / mesh.stiffness[1, :-1]
        if np.ptp(share) <= STIFFNESS_ROUNDING * np.abs(share).max():
            return _chain_pairs(mesh, -float(share.mean()), count)
    shift, free, size = 0.0, mesh.free.shape[0], mesh.size
    if free:  # a square of about the lowest frequency makes the stiffness definite
        bent = _bent(mesh, _unit_load(mesh), mesh.free)
        shift = float(bent @ banded.times(mesh.stiffness, bent)) / float(bent @ banded.times(mesh.mass, bent))
    stiffness = mesh.stiffness + shift * mesh.mass
    if MANY_UNKNOWNS * count < size:
        inverses, vectors = _largest(mesh.mass, stiffness, count + free)
    else:
        full = banded.full(mesh.mass), banded.full(stiffness)
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
    some: dict[str, Any] = {"select": "i", "select_range": (0, free + count - 1)}
    every: dict[str, Any] = {"lapack_driver": "stevd"}
    _, vectors = eigh_tridiagonal(
        mesh.stiffness[0] / lumped,
        -springs / (root[1:] * root[:-1]),
        **(every if many else some),
    )
    modes = (vectors[:, free : free + count] / root[:, None]).T
    ground = mesh.stiffness[0] - np.append(springs, 0.0) - np.append(0.0, springs)
    ground[np.abs(ground) < STIFFNESS_ROUNDING * mesh.stiffness[0]] = 0.0
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
        return LinearOperator((size, size), matvec=lambda vector: apply(vector.ravel()), dtype=float)  # pyright: ignore[reportCallIssue]

    return eigsh(
        operator(lambda vector: banded.times(mass, vector)),
        count,
        M=operator(lambda vector: banded.times(stiffness, vector)),
        Minv=operator(lambda vector: cho_solve_banded((factor, True), vector)),
        which="LA",
        v0=np.linspace(1.0, 2.0, size),
    )


def _bent(mesh: Mesh, load: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Static displacement under a load, without what motions or modes `kept` (motions, unknowns) take up of both."""
    from scipy.linalg import solveh_banded

    inertia = banded.times(mesh.mass, kept)
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


def _static_fields(mesh: Mesh) -> dict[str, Any]:
    """Of a beam under a steady force of 1 N where it is struck, as `Modes` has them."""
    if not mesh.bends:
        return {}
    load, free = _unit_load(mesh), mesh.free
    sped_up = np.linalg.solve(banded.times(mesh.mass, free) @ free.T, free @ load) @ free
    found = carried(mesh, _bent(mesh, load, free), sped_up)
    return {f"static_{name}": field for name, field in found.items()}


def carried(mesh: Mesh, displacement: np.ndarray, acceleration: np.ndarray) -> dict[str, Callable]:
    """Moments and shear forces of a beam, (..., x), from both (..., unknowns), in balance with its inertia."""

    def with_inertia(at_rest: Callable | None, inertial: Callable | None) -> Callable:
        if at_rest is None or inertial is None:
            raise TypeError("only beams have moments and shear forces")
        return lambda x: displacement @ at_rest(x) + acceleration @ inertial(x)

    return {
        "moments": with_inertia(mesh.moments, mesh.inertial_moments),
        "shears": with_inertia(mesh.shears, mesh.inertial_shears),
    }
