"""Shapes by which a link bends and stretches in its floating frame, and what of them the inertia of the frame feels.

The frame has its origin on the first end of the link and its x axis along it. Source: thesis 6.2.
"""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..beams.dispersion import BeamLine
from ..beams.modes import beam_modes, overhanging_modes
from ..modes import Modes, as_a_whole
from ..quadrature import gauss
from ..rods import rod_modes
from .mesh import mesh_fields

SUPPORTS = {
    "clamped-free": "cantilever",
    "pinned-free": "pinned-free",
    "pinned-pinned": "pinned-pinned",
    "mean-axis": "free-free",
}  # of the beam whose natural modes are the shapes, by the conditions of reference
ON_SUPPORT = 1e-9  # of the length: so near to a clamp or a pin nothing gives way
NODES, WEIGHTS = gauss(16)  # of a panel; half a wave in each is integrated to rounding


class Flexible(NamedTuple):
    """A uniform bar in a floating frame: how the frame is attached, and how many shapes of either kind it has."""

    line: BeamLine
    wave_speed: float  # along the bar, sqrt(E / rho) [m/s]
    attachment: str  # a word of SUPPORTS
    bending: int
    axial: int
    second_pin: float  # of a frame pinned twice [m]: the length, unless the bar overhangs
    nodes: tuple[float, ...] = ()  # of finite elements, whose lowest `bending` modes of either kind are taken [m]


@dataclass(frozen=True)
class Shapes:
    """Mass-normalised shapes of one link, those of bending first.

    frequencies (shapes,) [rad/s]; momentum (shapes, 2), integral of the shape over the mass, along and across the link
    [kg^1/2]; angular (shapes,), moment about the origin of what goes across, rotary inertia with it [kg^1/2 m]; radial
    (shapes,), integral of x times what goes along: the centrifugal load per unit of spin squared [kg^1/2 m];
    left_out (2,), static compliance at the struck place of all other shapes, along and across [m/N]; cuts, places
    between which they are smooth [m].
    """

    bending: Modes
    axial: Modes
    frequencies: np.ndarray
    momentum: np.ndarray
    angular: np.ndarray
    radial: np.ndarray
    left_out: np.ndarray
    cuts: np.ndarray

    def displacements(self, x: np.ndarray) -> np.ndarray:
        """Along and across the link per unit of each coordinate, (shapes, x, 2) [kg^-1/2]."""
        across, along = self.bending.shapes(np.asarray(x, float)), self.axial.shapes(np.asarray(x, float))
        found = np.zeros((self.frequencies.size, np.size(x), 2))
        found[: across.shape[0], :, 1] = across
        found[across.shape[0] :, :, 0] = along
        return found

    def slopes(self, x: np.ndarray) -> np.ndarray:
        """Of the axis that bends, per unit of each coordinate, (shapes, x) [kg^-1/2 / m]."""
        return self._of_bending("slopes", x)

    def turns(self, x: np.ndarray) -> np.ndarray:
        """By what the section turns per unit of each coordinate, (shapes, x) [kg^-1/2 / m]."""
        return self._of_bending("turns", x)

    def carried(self, name: str, x: np.ndarray) -> np.ndarray:
        """Bending "moments" [N m] or "shears" [N] per unit of each coordinate, (shapes, x)."""
        return self._of_bending(name, x)

    def _of_bending(self, name: str, x: np.ndarray) -> np.ndarray:
        found, field = np.zeros((self.frequencies.size, np.size(x))), getattr(self.bending, name)
        if field is not None:
            found[: self.bending.frequencies.size] = field(np.asarray(x, float))
        return found


def link_shapes(bar: Flexible, place: float | None = None) -> Shapes:
    """Shapes of a bar, which is struck at `place` [m], if it is.

    Error: integrals to rounding; frequencies as those of `numerics.beams` and `numerics.rods`.
    """
    length = bar.line.length
    at = 0.5 * length if place is None else place
    bending, axial = mesh_shapes(bar, at) if bar.nodes else (_bending(bar, at), _axial(bar, at))
    cuts = np.unique([0.0, bar.second_pin, length, *bar.nodes])
    x, weights = panels(cuts, max(bar.bending, bar.axial))
    weights = weights * bar.line.mass_per_length
    across, along = bending.shapes(x), axial.shapes(x)
    angular = across @ (weights * x)
    if bar.line.rotary_inertia and bending.turns is not None:
        angular += bending.turns(x) @ (weights * bar.line.rotary_inertia / bar.line.mass_per_length)
    of_bending, of_axial = np.zeros(across.shape[0]), np.zeros(along.shape[0])
    return Shapes(
        bending,
        axial,
        np.concatenate((bending.frequencies, axial.frequencies)),
        np.column_stack((np.append(of_bending, along @ weights), np.append(across @ weights, of_axial))),
        np.append(angular, of_axial),
        np.append(of_bending, along @ (weights * x)),
        np.array([axial.residual_compliance, bending.residual_compliance]) * (place is not None),
        cuts,
    )


def no_shapes() -> Shapes:
    """Of a rigid link."""
    nothing = np.zeros(0)
    return Shapes(_none(), _none(), nothing, np.zeros((0, 2)), nothing, nothing, np.zeros(2), nothing)


def _none() -> Modes:
    def no_shape(x: np.ndarray) -> np.ndarray:
        return np.zeros((0, np.size(x)))

    return Modes(np.zeros(0), np.zeros(0), np.inf, 0.0, no_shape, no_shape)


def panels(cuts: np.ndarray, waves: int) -> tuple[np.ndarray, np.ndarray]:
    """Places and weights of integrals over the length, in panels that no cut is inside of."""
    edges = np.concatenate([np.linspace(*ends, waves + 3)[:-1] for ends in pairwise(cuts)])
    edges = np.append(edges, cuts[-1])
    half = 0.5 * np.diff(edges)
    x = edges[:-1, None] + half[:, None] * (1.0 + NODES)
    return x.ravel(), (half[:, None] * WEIGHTS).ravel()


def _bending(bar: Flexible, place: float) -> Modes:
    if not bar.bending:
        return _none()
    length, support = bar.line.length, SUPPORTS[bar.attachment]
    overhangs = bar.attachment == "pinned-pinned" and bar.second_pin < length
    held = {"cantilever": (0.0,), "pinned-free": (0.0,), "pinned-pinned": (0.0, bar.second_pin), "free-free": ()}
    if any(abs(place - at) <= ON_SUPPORT * length for at in held[support]):
        return replace(_bending(bar, 0.5 * bar.second_pin), residual_compliance=0.0)
    if overhangs:
        return overhanging_modes(bar.line, bar.second_pin, place, bar.bending)
    return beam_modes(bar.line, support, place, bar.bending)


def _axial(bar: Flexible, place: float) -> Modes:
    """Of a rod whose first end is that of the frame, or of a free one; struck anywhere."""
    if not bar.axial:
        return _none()
    length, line, fixed = bar.line.length, bar.line, bar.attachment != "mean-axis"
    rod = rod_modes(length, line.mass, bar.wave_speed, fixed, bar.axial)
    if fixed:  # they run from the free end, inwards
        outwards, slopes = (lambda x: -rod.shapes(length - x)), (lambda x: rod.slopes(length - x))
    else:
        outwards, slopes = rod.shapes, rod.slopes
    at_place, part = outwards(np.array([place]))[:, 0], place / length
    whole = length**2 / (line.mass * bar.wave_speed**2) * (part if fixed else 1.0 / 3.0 - part + part**2)
    left_out = max(whole - float(np.sum((at_place / rod.frequencies) ** 2)), 0.0)
    return replace(rod, shapes=outwards, slopes=slopes, at_contact=at_place, residual_compliance=left_out)


def mesh_shapes(bar: Flexible, place: float) -> tuple[Modes, Modes]:
    """Of finite elements: those of bending, and those along the bar."""
    found = []
    for fields in mesh_fields(bar.line, bar.wave_speed, np.array(bar.nodes), bar.bending, place):
        shapes, slopes, turns, moments, shears = fields.fields
        found.append(
            Modes(
                frequencies=fields.frequencies,
                at_contact=shapes(np.array([place]))[:, 0],
                rigid_mass=np.inf,
                residual_compliance=fields.left_out,
                shapes=shapes,
                slopes=slopes,
                rigid_shape=as_a_whole,
                turns=turns,
                moments=moments,
                shears=shears,
            )
        )
    return found[0], found[1]
