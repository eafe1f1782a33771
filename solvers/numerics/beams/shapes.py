"""Harmonic motions of uniform beams at their natural frequencies, on the beam of unit length, mass and stiffness."""

from dataclasses import replace

import numpy as np

from .dispersion import BeamLine, dispersion
from .end_conditions import conditions, null_vectors
from .fields import BendingField
from .roots import (
    CANTILEVER,
    EVEN_CLAMPED,
    EVEN_FREE,
    EVEN_PINNED,
    ODD_CLAMPED,
    ODD_FREE,
    ODD_PINNED,
    count_below,
    roots,
    slender_roots,
)

# By support: the problems it falls into, how many motions as a whole each has, and its length
PROBLEMS = {
    "cantilever": ((CANTILEVER, 0, 0.5),),
    "pinned-pinned": ((EVEN_PINNED, 0, 0.5), (ODD_PINNED, 0, 0.5)),
    "clamped-clamped": ((EVEN_CLAMPED, 0, 0.5), (ODD_CLAMPED, 0, 0.5)),
    "free-free": ((EVEN_FREE, 1, 0.5), (ODD_FREE, 1, 0.5)),
    "pinned-free": ((ODD_FREE, 1, 1.0),),
}


def modes_below(line: BeamLine, support: str, frequency: float, end_mass: float = 0.0) -> int:
    """How many vibration modes a beam has below this frequency [rad/s]; `end_mass` [kg] on a cantilever's free end."""
    z, numbers = float(np.sqrt(frequency / line.frequency_unit)), (line.shear_number, line.rotary_number)
    counts = (
        count_below(problem, z, half, *numbers, end_mass / line.mass) - rigid
        for problem, rigid, half in PROBLEMS[support]
    )
    return int(sum(counts))


def natural_field(line: BeamLine, support: str, count: int, end_mass: float = 0.0) -> BendingField:
    """The lowest `count` motions, of any size; `end_mass` on the free end of a cantilever, over the beam's mass.

    Even and odd motions of a symmetric beam are found apart, so that two near frequencies do not mix.
    """
    if support == "pinned-pinned":
        return _pinned(line, count)
    shear, rotary = line.shear_number, line.rotary_number
    if shear == rotary == end_mass == 0.0:
        found = [slender_roots(problem, count, half) for problem, _, half in PROBLEMS[support]]
    else:
        numbers = shear, rotary, end_mass
        found = [roots(problem, count, rigid, half, *numbers) for problem, rigid, half in PROBLEMS[support]]
    if support == "pinned-free":
        return _about_centre(found[0] ** 4, shear, rotary, np.ones(count, int), support, 0.0, 1.0)
    if support == "cantilever":
        return _cantilever(found[0] ** 4, shear, rotary, end_mass)
    order = np.argsort(np.concatenate(found), kind="stable")[:count]
    square = np.concatenate(found)[order] ** 4
    return _about_centre(square, shear, rotary, (order >= count).astype(int), support, 0.5, 0.5)


def _cantilever(square, shear, rotary, end_mass) -> BendingField:
    field = BendingField(square, shear, rotary, np.zeros((square.size, 4)))
    rows, sizes = conditions(field, "cantilever", end_mass)
    return replace(field, amplitudes=sizes * null_vectors(rows))


def _about_centre(square, shear, rotary, odd, support, centre, reach) -> BendingField:
    """Motions odd or even about the centre that meet what the support demands at x = 1."""
    field = BendingField(square, shear, rotary, np.zeros((square.size, 4)), centre, reach)
    columns = np.stack([odd, odd + 2], axis=1)  # of u and w
    rows, sizes = conditions(field, support)
    pair = np.take_along_axis(rows[:, 2:], columns[:, None, :], axis=2)
    amplitudes = np.zeros((square.size, 4))
    np.put_along_axis(amplitudes, columns, null_vectors(pair), axis=1)
    return replace(field, amplitudes=amplitudes * sizes)


def _pinned(line, count) -> BendingField:
    """Sines of n half waves, one or two for each n; with rotary inertia also pure shear, y = 0, at the cut-off."""
    waves = np.arange(1, count + 1)
    lower, upper = dispersion(line, np.pi * waves / line.length)
    frequencies = np.concatenate([lower, [line.cut_off], upper])
    order = np.argsort(frequencies, kind="stable")[:count]
    numbers = np.concatenate([waves, [0], waves])[order]
    amplitudes = np.zeros((count, 4))
    amplitudes[np.arange(count), 2 * (order >= count) + (numbers % 2 == 0)] = 1.0
    square = (frequencies[order] / line.frequency_unit) ** 2
    return BendingField(square, line.shear_number, line.rotary_number, amplitudes)
