"""Beams as chains of two-node elements whose nodes move and turn; Euler-Bernoulli and Timoshenko are one element."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..beams.modes import BeamLine
from ..quadrature import gauss
from . import banded
from .mesh import Mesh

HELD = {  # what a support takes from the first and the last node: 0 its deflection, 1 its rotation
    "cantilever": ((0, 1), ()),
    "pinned-pinned": ((0,), (0,)),
    "clamped-clamped": ((0, 1), (0, 1)),
    "free-free": ((), ()),
    "pinned-free": ((0,), ()),
}


class Element(NamedTuple):
    """The shapes that loads at its ends give to a piece of beam, so that a mesh is exact where static loads act.

    Deflection of third and rotation of second degree go together, with `softness` 12 EI / (kappa G A l^2): no shear
    locking, and without softness the Hermite element. Of one element or of many, (elements,).
    Unknowns: deflection and rotation of the first node, then of the second. Shapes (4, x) at `part` (x,) from 0 to 1.
    Source: interdependent interpolation, Friedman and Kosmatka (1993).
    """

    length: np.ndarray  # l [m]
    softness: np.ndarray  # phi

    def deflections(self, part: np.ndarray) -> np.ndarray:
        l, f = self  # noqa: E741
        cubic = part * (part * (2.0 * part - 3.0) - f)
        first = part * (part * (part - 2.0 - 0.5 * f) + 1.0 + 0.5 * f)
        second = part * (part * (part - 1.0 + 0.5 * f) - 0.5 * f)
        return np.array([cubic + 1.0 + f, l * first, -cubic, l * second]) / (1.0 + f)

    def slopes(self, part: np.ndarray) -> np.ndarray:
        """Of the deflections [1/m]: rotation and shear together."""
        l, f = self  # noqa: E741
        cubic = (6.0 * part * (part - 1.0) - f) / l
        first = part * (3.0 * part - 4.0 - f) + 1.0 + 0.5 * f
        second = part * (3.0 * part - 2.0 + f) - 0.5 * f
        return np.array([cubic, first, -cubic, second]) / (1.0 + f)

    def rotations(self, part: np.ndarray) -> np.ndarray:
        l, f = self  # noqa: E741
        bent = 6.0 / l * part * (part - 1.0)
        first = part * (3.0 * part - 4.0 - f) + 1.0 + f
        return np.array([bent, first, -bent, part * (3.0 * part - 2.0 + f)]) / (1.0 + f)

    def curvatures(self, part: np.ndarray) -> np.ndarray:
        """Slopes of the rotations [1/m2]: bending moment over EI."""
        l, f = self  # noqa: E741
        bent = 6.0 / l * (2.0 * part - 1.0)
        return np.array([bent, 6.0 * part - 4.0 - f, -bent, 6.0 * part - 2.0 + f]) / (l * (1.0 + f))

    def changes(self, part: np.ndarray) -> np.ndarray:
        """Slopes of the curvatures [1/m3]: shear force over EI."""
        l, f = self  # noqa: E741
        one = np.ones_like(part)
        return np.array([12.0 / l * one, 6.0 * one, -12.0 / l * one, 6.0 * one]) / (l * l * (1.0 + f))

    def stiffness(self, bending_stiffness: float) -> np.ndarray:
        """(elements, 4, 4), of bending and of shear in series."""
        l, f = self  # noqa: E741
        ends = np.array([np.full_like(l, 2.0), l, np.full_like(l, -2.0), l])
        found = 3.0 * np.einsum("ie,je->eij", ends, ends)
        found[:, 1::2, 1::2] += ((1.0 + f) * l * l)[:, None, None] * np.array([[1.0, -1.0], [-1.0, 1.0]])
        return (bending_stiffness / (l**3 * (1.0 + f)))[:, None, None] * found

    def mass(self, mass_per_length: float, rotary_inertia: float) -> np.ndarray:
        """(elements, 4, 4), consistent with the shapes."""
        found = np.zeros((self.length.size, 4, 4))
        for root, weight in zip(*gauss(4), strict=True):  # exact for products of these shapes
            part = np.full_like(self.length, 0.5 * (root + 1.0))
            for inertia, shape in ((mass_per_length, self.deflections), (rotary_inertia, self.rotations)):
                share, values = 0.5 * weight * inertia * self.length, shape(part)
                found += np.einsum("e,ie,je->eij", share, values, values)
        return found

    def inertial(
        self, part: np.ndarray, mass_per_length: float, rotary_inertia: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """Bending moment [N m] and shear force [N], (4, x) each, that an acceleration of 1 of each unknown adds.

        With them both are in balance with the inertia along the element, so that they are zero at a free end and go on
        without a jump from one element to the next: from its first node, V' = -m y'' and M' = V + (rotary) psi''.
        """
        at_first = np.moveaxis(self.mass(mass_per_length, rotary_inertia), 0, -1)
        shears = at_first[0].copy()
        moments = self.length * part * at_first[0] - at_first[1]
        for root, weight in zip(*gauss(3), strict=True):  # exact, of fifth degree
            place, share = 0.5 * (root + 1.0) * part, 0.5 * weight * part * self.length
            pushed = share * mass_per_length * self.deflections(place)
            shears -= pushed
            moments += share * rotary_inertia * self.rotations(place) - self.length * (part - place) * pushed
        return moments, shears


def beam_mesh(line: BeamLine, support: str, place: float, elements: int, end_mass: float = 0.0) -> Mesh:
    """A uniform beam with a node where it is struck, `place` [m] from its first support.

    About `elements` elements, shared out on both sides of that node; `end_mass` [kg] rides on the far end. `neighbour`
    is EI / l^3 of the shorter element at that node, less by what its shear gives way.
    Error: static deflections are exact at the nodes; frequencies are of fourth order in 1 / elements, of second order
    where shear counts. Moments and shear forces are in balance with loads and inertia everywhere.
    Source: thesis 8.3, k_e = EI / l^3.
    """
    nodes, struck = _nodes(line.length, place, elements)
    lengths, count = np.diff(nodes), 2 * nodes.size
    chain = Element(lengths, 12.0 * line.bending_stiffness / (line.shear_stiffness * lengths**2))
    mass = _assembled(chain.mass(line.mass_per_length, line.rotary_inertia))
    mass[0, -2] += end_mass
    first, last = HELD[support]
    kept = np.setdiff1d(np.arange(count), [*first, *(count - 2 + end for end in last)])
    translation = np.tile([1.0, 0.0], nodes.size)
    swing = np.column_stack((nodes / line.length, np.full(nodes.size, 1.0 / line.length))).ravel()
    free = {"free-free": [translation, swing], "pinned-free": [swing]}.get(support, [])
    weights, stiffness = banded.times(mass, translation), line.bending_stiffness

    def field(shape: Callable, scale: float = 1.0) -> Callable:
        return lambda x: scale * spread(nodes, chain, shape, x)[kept]

    def inertial(number: int) -> Callable:
        return field(lambda here, part: here.inertial(part, line.mass_per_length, line.rotary_inertia)[number])

    return Mesh(
        nodes,
        banded.without(mass, kept),
        banded.without(_assembled(chain.stiffness(stiffness)), kept),
        int(np.searchsorted(kept, 2 * struck)),
        np.reshape(free, (len(free), count))[:, kept],
        weights[kept],
        float(weights @ translation),
        field(Element.deflections),
        field(Element.slopes),
        field(Element.curvatures, stiffness),
        field(Element.changes, stiffness),
        *_scales(line, chain, slice(max(struck - 1, 0), struck + 1)),
        inertial_moments=inertial(0),
        inertial_shears=inertial(1),
    )


def _nodes(length: float, place: float, elements: int) -> tuple[np.ndarray, int]:
    """Places of the nodes, and which of them is struck."""
    sides = [part for part in (place, length - place) if part > 1e-9 * length]
    counts = [max(1, round(elements * part / length)) for part in sides]
    lengths = np.repeat([part / count for part, count in zip(sides, counts, strict=True)], counts)
    return np.append(0.0, np.cumsum(lengths)), counts[0] if place > 1e-9 * length else 0


def _scales(line: BeamLine, chain: Element, near: slice) -> tuple[float, float, float]:
    """Stiffness next to the struck node, shortest transit and shortest period of an element."""
    from scipy.linalg import eigh

    neighbour = line.bending_stiffness / (chain.length**3 * (1.0 + chain.softness))
    # a wave as long as two elements, with the velocity of its group, no faster than shear waves
    speed = np.sqrt(line.shear_stiffness / line.mass_per_length)
    bent = chain.length**2 / (2.0 * np.pi * np.sqrt(line.bending_stiffness / line.mass_per_length))
    short = Element(*(np.atleast_1d(part[np.argmin(chain.length)]) for part in chain))
    stiffness, mass = short.stiffness(line.bending_stiffness), short.mass(line.mass_per_length, line.rotary_inertia)
    highest = np.sqrt(eigh(stiffness[0], mass[0], eigvals_only=True)[-1])
    transit = np.maximum(bent, chain.length / speed)
    return float(neighbour[near].max()), float(transit.min()), float(2.0 * np.pi / highest)


def _assembled(parts: np.ndarray) -> np.ndarray:
    """Bands of a chain of elements from their matrices (elements, 4, 4)."""
    count = parts.shape[0]
    found = np.zeros((4, 2 * count + 2))
    for row in range(4):
        for column in range(row + 1):
            found[row - column, column : column + 2 * count : 2] += parts[:, row, column]
    return found


def spread(nodes: np.ndarray, chain: Element, shape: Callable, x: np.ndarray) -> np.ndarray:
    """A field of all unknowns, (2 nodes, x)."""
    x = np.asarray(x, float)
    cell = np.clip(np.searchsorted(nodes, x, "right") - 1, 0, nodes.size - 2)
    here = Element(chain.length[cell], chain.softness[cell])
    values = shape(here, (x - nodes[cell]) / here.length)
    found, columns = np.zeros((2 * nodes.size, cell.size)), np.arange(cell.size)
    for row in range(4):
        found[2 * cell + row, columns] = values[row]
    return found
