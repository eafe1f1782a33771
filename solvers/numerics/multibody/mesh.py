"""A clamped bar in its plane as finite elements with nodes anywhere, and a change from one set of its modes to another.

Unknowns are, node by node, displacement along and across the bar and rotation. Source: thesis 6.4.4, (6.25)-(6.30).
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..beams.dispersion import BeamLine
from ..elements.beam import Element, spread


class FrameMesh(NamedTuple):
    """Places of the free nodes (nodes,) [m], mass and stiffness (3 nodes, 3 nodes)."""

    nodes: np.ndarray
    mass: np.ndarray
    stiffness: np.ndarray


def frame_mesh(line: BeamLine, wave_speed: float, nodes: np.ndarray) -> FrameMesh:
    """Two-node elements between the clamp at x = 0 and these places [m]; consistent mass."""
    places = np.append(0.0, nodes)
    lengths, count = np.diff(places), places.size
    softness = 12.0 * line.bending_stiffness / (line.shear_stiffness * lengths**2)
    chain = Element(lengths, softness)
    bent = chain.mass(line.mass_per_length, line.rotary_inertia), chain.stiffness(line.bending_stiffness)
    pull = line.mass_per_length * wave_speed**2 / lengths  # E A / l
    along = (
        np.multiply.outer(line.mass_per_length * lengths / 6.0, np.array([[2.0, 1.0], [1.0, 2.0]])),
        np.multiply.outer(pull, np.array([[1.0, -1.0], [-1.0, 1.0]])),
    )
    found = np.zeros((2, 3 * count, 3 * count))
    for matrix, across, axial in zip(found, bent, along, strict=True):
        for number in range(count - 1):
            at = 3 * number
            matrix[np.ix_([at, at + 3], [at, at + 3])] += axial[number]
            turned = [at + 1, at + 2, at + 4, at + 5]
            matrix[np.ix_(turned, turned)] += across[number]
    return FrameMesh(places[1:], *found[:, 3:, 3:])


def lowest_modes(mass: np.ndarray, stiffness: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (count,) [rad/s] and mass-normalised modes (unknowns, count)."""
    from scipy.linalg import eigh

    inverses, vectors = eigh(mass, stiffness, subset_by_index=(mass.shape[0] - count, mass.shape[0] - 1))
    return 1.0 / np.sqrt(inverses[::-1]), (vectors / np.sqrt(inverses))[:, ::-1]


class MeshFields(NamedTuple):
    """Modes of one kind: frequencies (modes,) [rad/s]; shapes, slopes, turns, moments and shears as of `Modes`; static
    compliance of all others at a place [m/N]."""

    frequencies: np.ndarray
    fields: tuple[Callable[[np.ndarray], np.ndarray], ...]
    left_out: float


def mesh_fields(
    line: BeamLine, wave_speed: float, nodes: np.ndarray, count: int, place: float
) -> tuple[MeshFields, MeshFields]:
    """Of the lowest `count` modes those across the bar, and those along it; what is left out at `place` [m]."""
    mesh = frame_mesh(line, wave_speed, nodes)
    every = lowest_modes(mesh.mass, mesh.stiffness, mesh.mass.shape[0])
    frequencies, modes = every[0][:count], every[1][:, :count]
    places = np.append(0.0, nodes)
    lengths = np.diff(places)
    chain = Element(lengths, 12.0 * line.bending_stiffness / (line.shear_stiffness * lengths**2))
    axial = np.abs(modes[0::3]).max(axis=0) > np.abs(modes[1::3]).max(axis=0)
    across = np.zeros((2 * places.size, count))
    across[2::2], across[3::2] = modes[1::3], modes[2::3]
    along = np.vstack((np.zeros(count), modes[0::3]))

    def bent(shape: Callable, scale: float = 1.0) -> Callable[[np.ndarray], np.ndarray]:
        return lambda x: scale * across[:, ~axial].T @ spread(places, chain, shape, x)

    def stretched(x: np.ndarray) -> np.ndarray:
        return np.array([np.interp(x, places, mode) for mode in along[:, axial].T]).reshape(-1, np.size(x))

    def nothing(x: np.ndarray) -> np.ndarray:
        return np.zeros((int(axial.sum()), np.size(x)))

    at = np.array([place])
    weight = spread(places, chain, Element.deflections, at)[2:, 0]
    hats = np.array([np.interp(place, places, unit) for unit in np.eye(places.size)[1:]])
    others, high = every[1][:, count:], every[0][count:]
    given_way = (weight[0::2] @ others[1::3] + weight[1::2] @ others[2::3]) / high, hats @ others[0::3] / high
    fields = (
        bent(Element.deflections), bent(Element.slopes), bent(Element.rotations),
        bent(Element.curvatures, line.bending_stiffness), bent(Element.changes, line.bending_stiffness),
    )  # fmt: skip
    left_out = [float(part @ part) for part in given_way]
    return (
        MeshFields(frequencies[~axial], fields, left_out[0]),
        MeshFields(frequencies[axial], (stretched, nothing, nothing, nothing, nothing), left_out[1]),
    )


class Projected(NamedTuple):
    """Values of all unknowns, (unknowns,) each: `before`, of the modes of the bar; then of those of the bar with a mass
    on it: projected by the mass of both, (6.28), which gives the same; by the stiffness, (6.30), which is the same on
    paper; that in single precision; and by the mass of the bar alone."""

    before: np.ndarray
    by_mass: np.ndarray
    by_stiffness: np.ndarray
    in_single_precision: np.ndarray
    by_mass_of_bar: np.ndarray


class ModeChange(NamedTuple):
    """Velocities just after a mass has struck without restitution, and coordinates; `impulse` of the mass [N s];
    `lost`, of the energy, by the projection of the velocities by mass."""

    velocities: Projected
    coordinates: Projected
    impulse: float
    lost: float


def change_of_modes(
    mesh: FrameMesh, mass: float, node: int, count: int, approach: float, bent: np.ndarray
) -> ModeChange:
    """A mass [kg] comes across at `approach` [m/s] and strikes `node`: first the `count` modes of the bar, which has
    coordinates `bent` (unknowns,) and does not vibrate, then as many of both.

    Source: thesis tables 6.9 to 6.12. Differs: they find that no projection works; (6.28) and (6.30) are one operator,
    as K b = omega^2 M2 b for every mode b kept, and both return the field. Single precision fails as the tables do.
    """
    struck = 3 * node + 1
    _, bar = lowest_modes(mesh.mass, mesh.stiffness, count)
    mobility = float(bar[struck] @ bar[struck])
    impulse = approach / (1.0 / mass + mobility)
    before = bar @ bar[struck] * impulse
    both = mesh.mass.copy()
    both[struck, struck] += mass
    frequencies, joined = lowest_modes(both, mesh.stiffness, count)

    def projected(field: np.ndarray) -> Projected:
        return Projected(
            field,
            joined @ (joined.T @ (both @ field)),
            joined @ ((joined.T @ (mesh.stiffness @ field)) / frequencies**2),
            _by_stiffness_in_single(both, mesh.stiffness, field, count),
            joined @ (joined.T @ (mesh.mass @ field)),
        )

    velocities = projected(before)
    energy, after = 0.5 * before @ both @ before, velocities.by_mass
    lost = (energy - 0.5 * after @ both @ after) / energy
    return ModeChange(velocities, projected(bent), impulse, float(lost))


def _by_stiffness_in_single(mass: np.ndarray, stiffness: np.ndarray, field: np.ndarray, count: int) -> np.ndarray:
    """(6.30) with modes and matrices in single precision: the stiffness has a condition of 1e10."""
    from scipy.linalg import eigh

    small, rigid = mass.astype(np.float32), stiffness.astype(np.float32)
    _, vectors = eigh(rigid, small)
    kept = vectors[:, :count].astype(np.float32)
    square = np.einsum("ui,uv,vi->i", kept, rigid, kept, dtype=np.float32)
    return (kept @ ((kept.T @ (rigid @ field.astype(np.float32))) / square)).astype(float)
