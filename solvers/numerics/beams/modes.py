"""Natural modes of uniform beams, from the exact characteristic equations of both theories.

Everything is computed on the beam of unit length, mass and bending stiffness and given back in SI units.
Source: thesis (5.30)-(5.41), (8.7)-(8.12); Huang (1961). Differs: (8.7) prints sinh + sinh and cos - cosh in its
denominators; the shapes here are derived anew, in a form that overflows at no number of modes. A characteristic
equation with cosh only loses every Timoshenko mode above the cut-off; the count of `roots` has both branches.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np

from ..modes import Modes, as_a_whole
from .dispersion import BeamLine, dispersion, group_speeds, phase_speeds, speed_limit
from .fields import BendingField
from .point_mass import riding_field
from .residual import MIN_ASYMPTOTIC_MODES, slender_tail
from .shapes import modes_below, natural_field
from .statics import overhang_compliance, rigid_motion, static_compliance, static_shape

__all__ = [
    "BeamLine",
    "attached_beam_modes",
    "beam_modes",
    "dispersion",
    "group_speeds",
    "modes_below",
    "overhanging_modes",
    "phase_speeds",
    "speed_limit",
    "static_compliance",
    "static_shape",
]

# Of the whole compliance: a part that a difference no longer gives to seven digits, and that is summed instead.
LOST_COMPLIANCE = 1e-8


def beam_modes(line: BeamLine, support: str, place: float, count: int, end_mass: float = 0.0) -> Modes:
    """The lowest `count` vibration modes of a beam, struck at `place` [m] from its first support.

    `end_mass` [kg] is a point mass on the free end of a cantilever; shapes are normalised, and averaged, with it.
    Free motions come on top, as one: a force at one place sets a free beam into translation and rotation together.
    Error: frequencies to 1e-12 at any number of modes; shapes meet their ends, and one another, to 1e-11 at 500.
    """
    at_end = end_mass / line.mass
    field, means = _normalised(natural_field(line, support, count, at_end), at_end)
    tail = _tail_of(line, support, place / line.length, count, at_end)
    return _in_si_units(line, support, place, field, means, 0.0, tail)


def attached_beam_modes(
    line: BeamLine, support: str, place: float, count: int, attached_mass: float, end_mass: float = 0.0
) -> Modes:
    """Modes of the beam and a point mass [kg] that rides on it at `place` [m], where both are struck.

    Shapes are normalised with both masses, but averaged (`means`, `rigid_mean`) over the beam's own and `end_mass`.
    Moments and shear forces are the beam's; the shear force jumps at the rider, where the inner side's is given.
    A free or pinned-free beam moves as a whole with the same `rigid_shape` as without the rider, and with a mass
    larger by the rider's. A free one can also turn about the rider; no force at `place` sets it into that motion, with
    the rider or without, so a projection from the one set of modes on the other needs the one rigid motion only.
    At the tip of a cantilever the modes are those of `beam_modes` with an end mass.
    """
    at_end, rider, at = end_mass / line.mass, attached_mass / line.mass, place / line.length
    if rider == 0.0:
        return beam_modes(line, support, place, count, end_mass)
    tail = None
    if support == "cantilever" and at == 1.0:
        field = replace(natural_field(line, support, count, at_end + rider), place=1.0)
        tail = _tail_of(line, support, 1.0, count, at_end + rider)
    else:
        bare, _ = _normalised(natural_field(line, support, count + 8, at_end), at_end)  # no node is shared by 8
        field = riding_field(line, support, at, count, rider, bare, at_end)
    field, means = _normalised(field, at_end, rider)
    return _in_si_units(line, support, place, field, means, attached_mass, tail)


def overhanging_modes(line: BeamLine, pin: float, place: float, count: int) -> Modes:
    """The lowest modes of a beam pinned at x = 0 and at `pin` [m], with a free end beyond, struck at `place` [m].

    A rider too heavy to be moved is a pin. The static fields are not given.
    """
    field, means = _overhanging(line, pin / line.length, count)
    found = _in_si_units(line, "pinned-free", place, field, means, 0.0)
    whole = overhang_compliance(line, pin, place)
    left_out = max(whole - float(np.sum((found.at_contact / found.frequencies) ** 2)), 0.0)
    nothing: dict = {"static_shapes": None, "static_moments": None, "static_shears": None}
    return replace(
        found, rigid_mass=np.inf, residual_compliance=left_out, rigid_shape=as_a_whole, rigid_mean=1.0, **nothing
    )


@lru_cache(maxsize=64)  # of a link whose mechanism is struck elsewhere, or has another mass
def _overhanging(line: BeamLine, pin: float, count: int) -> tuple[BendingField, np.ndarray]:
    """Those motions, and their means over the beam."""
    bare, _ = _normalised(natural_field(line, "pinned-free", count + 8), 0.0)
    field, means = _normalised(riding_field(line, "pinned-free", pin, count, np.inf, bare), 0.0)
    return replace(field, place=pin), means


def _normalised(field: BendingField, at_end: float, rider: float = 0.0) -> tuple[BendingField, np.ndarray]:
    """Motions of unit modal mass and their means over beam and end mass."""
    mean, square = field.integrals()
    end, place = field.displacement(field.potentials(np.array([1.0, field.place]))).T
    factors = 1.0 / np.sqrt(square + at_end * end**2 + rider * place**2)
    return field.scaled(factors), factors * (mean + at_end * end) / (1.0 + at_end)


def _tail_of(line, support, at, count, at_end) -> Callable[[], float] | None:
    """The sum of what the modes left out give way, where it is known."""
    slender = line.shear_number == line.rotary_number == 0.0
    return partial(slender_tail, support, at, count, at_end) if slender and count >= MIN_ASYMPTOTIC_MODES else None


def _in_si_units(
    line, support, place, field, means, attached_mass: float, tail: Callable[[], float] | None = None
) -> Modes:
    """Modes of the beam from the mass-normalised `field` of the unit beam; `tail` sums the compliance left out."""
    per_mass = 1.0 / np.sqrt(line.mass)
    stiffness = line.bending_stiffness / line.length**2 * per_mass
    frequencies = line.frequency_unit * np.sqrt(field.square)

    def seen(quantity, factor):
        return lambda x: factor * quantity(field.potentials(np.atleast_1d(np.asarray(x, float)) / line.length))

    shapes = seen(field.displacement, per_mass)
    at_contact = shapes(np.array([place]))[:, 0]
    rigid = rigid_motion(line, support, place)
    static = static_shape(line, support, place, attached_mass)
    whole = static.compliance
    left_out = max(whole - float(np.sum((at_contact / frequencies) ** 2)), 0.0)
    if tail and left_out < LOST_COMPLIANCE * whole:
        left_out = tail() * line.length**3 / line.bending_stiffness
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=rigid.mass + attached_mass,
        residual_compliance=left_out,
        shapes=shapes,
        slopes=seen(field.slope, per_mass / line.length),
        turns=seen(field.turn, per_mass / line.length),
        rigid_shape=rigid.shape,
        means=per_mass * means,
        rigid_mean=float(rigid.shape(0.5 * line.length)),
        moments=seen(field.moment, stiffness),
        shears=seen(field.shear_force, stiffness / line.length),
        static_shapes=static.deflections,
        static_moments=static.moments,
        static_shears=static.shears,
    )
