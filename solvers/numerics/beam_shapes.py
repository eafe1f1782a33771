"""Harmonic motions of uniform beams at their natural frequencies, on the beam of unit length, mass and stiffness."""

from dataclasses import replace

import numpy as np

from .beam_roots import CANTILEVER, EVEN_CLAMPED, EVEN_FREE, ODD_CLAMPED, ODD_FREE, roots
from .bending_ends import column_sizes, end_rows, null_vectors
from .bending_fields import BendingField
from .bending_waves import BeamLine


def natural_field(line: BeamLine, support: str, count: int, end_mass: float = 0.0) -> BendingField:
    """The lowest `count` motions, of any size; `end_mass` on the free end of a cantilever, over the beam's mass."""
    return _cantilever(line, count, end_mass) if support == "cantilever" else _symmetric(line, support, count)


def _cantilever(line, count, end_mass) -> BendingField:
    found = roots(CANTILEVER, count, 0, 0.5, line.shear_number, line.rotary_number, end_mass)
    field = BendingField(found**4, line.shear_number, line.rotary_number, np.zeros((count, 4)))
    both = [end_rows(field, near, "cantilever", end_mass) for near in (True, False)]
    return replace(field, amplitudes=column_sizes(field) * null_vectors(np.concatenate(both, axis=1)))


def _symmetric(line, support, count) -> BendingField:
    """Even and odd motions about the middle apart, so that two near frequencies do not mix; or about the pin."""
    shear, rotary = line.shear_number, line.rotary_number
    if support == "pinned-pinned":
        return _pinned(shear, rotary, count)
    if support == "pinned-free":
        square = roots(ODD_FREE, count, 1, 1.0, shear, rotary, 0.0) ** 4
        return _about_centre(square, shear, rotary, np.ones(count, int), support, 0.0, 1.0)
    held = support == "clamped-clamped"
    problems = (EVEN_CLAMPED, ODD_CLAMPED) if held else (EVEN_FREE, ODD_FREE)
    both = [roots(problem, count, 0 if held else 1, 0.5, shear, rotary, 0.0) for problem in problems]
    order = np.argsort(np.concatenate(both), kind="stable")[:count]
    square = np.concatenate(both)[order] ** 4
    return _about_centre(square, shear, rotary, (order >= count).astype(int), support, 0.5, 0.5)


def _about_centre(square, shear, rotary, odd, support, centre, reach) -> BendingField:
    """Motions odd or even about the centre that meet what the support demands at x = 1."""
    field = BendingField(square, shear, rotary, np.zeros((square.size, 4)), centre, reach)
    columns = np.stack([odd, odd + 2], axis=1)  # of u and w
    pair = np.take_along_axis(end_rows(field, False, support), columns[:, None, :], axis=2)
    amplitudes = np.zeros((square.size, 4))
    np.put_along_axis(amplitudes, columns, null_vectors(pair), axis=1)
    return replace(field, amplitudes=amplitudes * column_sizes(field))


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
