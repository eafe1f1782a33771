"""Harmonic motions of a uniform beam on which a point mass rides, anywhere."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from .dispersion import BeamLine
from .end_conditions import conditions, null_vectors
from .fields import BendingField
from .statics import rigid_motion

# Displacement over the largest: below it the rider alters the frequency of a mode by less than its rounding, and no
# root beside the pole could be distinguished from it.
NODE_AMPLITUDE = 1e-7


def riding_field(
    line: BeamLine, support: str, place: float, count: int, rider: float, bare: BendingField, end_mass: float = 0.0
) -> BendingField:
    """The lowest `count` motions with a mass `rider` at `place`; both and `end_mass` over the beam's own.

    `bare` are the normalised motions without the rider, a few more than `count`. It lowers each frequency, but not
    below the one before, so each stretch between two of them holds just one; modes with a node at `place` stay.
    Source: thesis (5.30)-(5.37) for a mass at the tip.
    """
    at_place = bare.displacement(bare.potentials(np.array([place])))[:, 0]
    node = np.abs(at_place) <= NODE_AMPLITUDE * max(np.abs(at_place).max(), 1.0)
    poles, strengths = bare.square[~node], bare.square[~node] * at_place[~node] ** 2
    field = BendingField(poles, line.shear_number, line.rotary_number, np.zeros((poles.size, 5)), place=place)

    def system(square):
        """Ends and rider: the force on the beam is what the rider's inertia gives, (modes, 5, 5)."""
        matrices, sizes = conditions(replace(field, square=square), support, end_mass)
        matrices[:, 4, 4] -= sizes[:, 4] / rider
        return matrices, sizes

    squares = np.sort(
        np.concatenate([_between(poles, strengths, system, line, support, place, rider), bare.square[node]])
    )
    squares = squares[:count]
    matrices, sizes = system(squares)
    matrices[:, 4] /= 1.0 + sizes[:, 4:] / rider
    return replace(field, square=squares, amplitudes=sizes * null_vectors(matrices))


def _between(poles, strengths, system, line, support, place, rider) -> np.ndarray:
    """Squared frequencies, one below each pole of what the rider's place gives way under a harmonic force.

    That response, times the square, less 1 / rider, rises from minus to plus infinity between two poles; times the
    distances from both it is smooth, and known at both ends.
    """
    if poles.size == 0:
        return poles
    lower = np.concatenate([[0.0], poles[:-1]])
    first = np.arange(poles.size) == 0
    rigid = rigid_motion(BeamLine(1.0, 1.0, 1.0, line.rotary_number), support, place)
    before = -(1.0 / rigid.mass + 1.0 / rider)  # of the first stretch, where there is no lower pole

    def smooth(square):
        matrices, sizes = system(square)
        response = np.linalg.det(matrices) / (np.linalg.det(matrices[:, :4, :4]) * sizes[:, 4])
        return response * (poles - square) * np.where(first, 1.0, square - lower)

    gap = poles - lower
    at_low = np.where(first, before * gap, -np.concatenate([[0.0], strengths[:-1]]) * gap)
    at_high = strengths * np.where(first, 1.0, gap)
    return _zeros(smooth, lower, poles, at_low, at_high)


def _zeros(function: Callable, low, high, at_low, at_high) -> np.ndarray:
    """A zero in each interval (n,) with values of other sign at its ends, by Chandrupatla's method (1997)."""
    a, b, c = low.copy(), high.copy(), low.copy()
    fa, fb, fc = at_low.copy(), at_high.copy(), at_low.copy()
    t = fa / (fa - fb)
    for _ in range(200):
        x = a + t * (b - a)
        fx = function(x)
        same = np.sign(fx) == np.sign(fa)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, fx
        best = np.where(np.abs(fa) < np.abs(fb), a, b)
        width = np.abs(b - a)
        least = 4.5e-16 * np.abs(best) / np.where(width > 0.0, width, 1.0)
        if np.all((least > 0.5) | (fa == 0.0) | (width == 0.0)):
            break
        with np.errstate(all="ignore"):
            xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
            inverse = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
            t = np.where((phi**2 < xi) & ((1.0 - phi) ** 2 < 1.0 - xi), inverse, 0.5)
        t = np.clip(t, np.minimum(least, 0.5), 1.0 - np.minimum(least, 0.5))
    return best
