"""Natural modes of uniform beams, from the exact characteristic equations of both theories.

Everything is computed on the beam of unit length, mass and bending stiffness and given back in SI units.
Source: thesis (5.30)-(5.41), (8.7)-(8.12); Huang (1961). Differs: (8.7) prints sinh + sinh and cos - cosh in its
denominators; the shapes here are derived anew, in a form that overflows at no number of modes. A characteristic
equation with cosh only loses every Timoshenko mode above the cut-off; the count of `beam_roots` has both branches.
"""

import numpy as np

from .beam_roots import CANTILEVER, EVEN_CLAMPED, EVEN_FREE, ODD_CLAMPED, ODD_FREE, roots
from .beam_statics import DISPLACEMENT, ENDS, MOMENT, SHEAR, TURN, rigid_motion, static_shape
from .bending_fields import BendingField
from .bending_waves import BeamLine
from .modes import Modes

__all__ = ["BeamLine", "beam_modes"]


def beam_modes(line: BeamLine, support: str, place: float, count: int, end_mass: float = 0.0) -> Modes:
    """The lowest `count` vibration modes of a beam, struck at `place` [m] from its first support.

    `end_mass` [kg] is a point mass on the free end of a cantilever; shapes are normalised, and averaged, with it.
    Free motions come on top, as one: a force at one place sets a free beam into translation and rotation together.
    Error: frequencies to 1e-12 and shapes to 1e-11 at any number of modes.
    """
    rider = end_mass / line.mass
    field = _cantilever(line, count, rider) if support == "cantilever" else _symmetric(line, support, count)
    mean, square = field.integrals()
    at_end = field.displacement(field.potentials(np.ones(1)))[:, 0]
    factors = 1.0 / np.sqrt(square + rider * at_end**2)
    field, means = field.scaled(factors), factors * (mean + rider * at_end) / (1.0 + rider)
    return _in_si_units(line, support, place, field, means, 0.0)


# -- the unit beam ----------------------------------------------------------------------------------------------------


def _cantilever(line, count, rider) -> BendingField:
    found = roots(CANTILEVER, count, 0, 0.5, line.shear_number, line.rotary_number, rider)
    field = BendingField(found**4, line.shear_number, line.rotary_number, np.zeros((count, 4)))
    rows = _end_rows(field, "cantilever")
    rows[:, 3] += rider * _rows(field, np.ones(1), (DISPLACEMENT,))[:, 0]
    return BendingField(field.square, field.shear, field.rotary, _null_vectors(rows))


def _rows(field, x, quantities, side=None) -> np.ndarray:
    """What each amplitude alone gives of these quantities at x: (modes, quantities, amplitudes); shear / square."""
    parts = field.basis(x, side)
    seen = {
        DISPLACEMENT: field.displacement,
        TURN: field.turn,
        MOMENT: field.moment,
        SHEAR: lambda at: at.u + at.w,
    }
    return np.stack([np.stack([seen[q](part)[:, 0] for part in parts], axis=-1) for q in quantities], axis=1)


def _end_rows(field, support) -> np.ndarray:
    near, far = ENDS[support]
    return np.concatenate([_rows(field, np.zeros(1), near, -1.0), _rows(field, np.ones(1), far, 1.0)], axis=1)


def _null_vectors(matrices: np.ndarray) -> np.ndarray:
    """The vector that each of these matrices makes vanish, rows and columns brought to the same size first."""
    matrices = matrices / np.abs(matrices).max(axis=2, keepdims=True)
    sizes = np.abs(matrices).max(axis=1)
    return np.linalg.svd(matrices / sizes[:, None, :])[2][:, -1, :] / sizes


def _symmetric(line, support, count) -> BendingField:
    """Even and odd motions about the middle apart, so that two near frequencies do not mix; or about the pin."""
    shear, rotary = line.shear_number, line.rotary_number
    if support == "pinned-pinned":
        return _pinned(shear, rotary, count)
    if support == "pinned-free":
        square = roots(ODD_FREE, count, 1, 1.0, shear, rotary, 0.0) ** 4
        return _about_centre(square, shear, rotary, np.ones(count, bool), ENDS[support][1], 0.0, 1.0)
    held = support == "clamped-clamped"
    problems = (EVEN_CLAMPED, ODD_CLAMPED) if held else (EVEN_FREE, ODD_FREE)
    both = [roots(problem, count, 0 if held else 1, 0.5, shear, rotary, 0.0) for problem in problems]
    order = np.argsort(np.concatenate(both), kind="stable")[:count]
    square = np.concatenate(both)[order] ** 4
    return _about_centre(square, shear, rotary, order >= count, ENDS[support][1], 0.5, 0.5)


def _about_centre(square, shear, rotary, odd, far, centre, reach) -> BendingField:
    """Motions about the centre of which the two quantities `far` vanish at x = 1."""
    field = BendingField(square, shear, rotary, np.zeros((square.size, 4)), centre, reach)
    rows = _rows(field, np.ones(1), far)
    number = np.arange(square.size)
    columns = np.stack([odd.astype(int), odd.astype(int) + 2], axis=1)  # of u and w
    amplitudes = np.zeros((square.size, 4))
    amplitudes[number[:, None], columns] = _null_vectors(
        rows[number[:, None, None], np.arange(2)[None, :, None], columns[:, None, :]]
    )
    return BendingField(square, shear, rotary, amplitudes, centre, reach)


def _pinned(shear, rotary, count) -> BendingField:
    """Sines of n half waves, one or two for each n; with rotary inertia also pure shear, y = 0, at the cut-off."""
    waves = np.arange(1, count + 1)
    k2 = (np.pi * waves) ** 2
    middle = 1.0 + k2 * (shear + rotary)
    root = np.sqrt(1.0 + 2.0 * k2 * (shear + rotary) + (k2 * (shear - rotary)) ** 2)
    squares, numbers, upper = 2.0 * k2**2 / (middle + root), waves, np.zeros(count, bool)
    if shear * rotary > 0.0:
        squares = np.concatenate([squares, [1.0 / (shear * rotary)], (middle + root) / (2.0 * shear * rotary)])
        numbers = np.concatenate([waves, [0], waves])
        upper = np.concatenate([upper, np.ones(count + 1, bool)])
    order = np.argsort(squares, kind="stable")[:count]
    amplitudes = np.zeros((count, 4))
    amplitudes[np.arange(count), 2 * upper[order] + (numbers[order] % 2 == 0)] = 1.0
    return BendingField(squares[order], shear, rotary, amplitudes)


# -- and the real one -------------------------------------------------------------------------------------------------


def _in_si_units(line, support, place, field, means, attached_mass) -> Modes:
    """Modes of the beam from the mass-normalised `field` of the unit beam."""
    per_mass = 1.0 / np.sqrt(line.mass)
    stiffness = line.bending_stiffness / line.length**2 * per_mass
    frequencies = line.frequency_unit * np.sqrt(field.square)

    def seen(quantity, factor):
        return lambda x: factor * quantity(field.potentials(np.atleast_1d(np.asarray(x, float)) / line.length))

    shapes = seen(field.displacement, per_mass)
    at_contact = shapes(np.array([place]))[:, 0]
    rigid = rigid_motion(line, support, place)
    whole = static_shape(line, support, place, attached_mass).compliance
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=rigid.mass + attached_mass,
        residual_compliance=max(whole - float(np.sum((at_contact / frequencies) ** 2)), 0.0),
        shapes=shapes,
        slopes=seen(field.slope, per_mass / line.length),
        rigid_shape=rigid.shape,
        means=per_mass * means,
        rigid_mean=float(rigid.shape(0.5 * line.length)),
        moments=seen(field.moment, stiffness),
        shears=seen(field.shear_force, stiffness / line.length),
    )
