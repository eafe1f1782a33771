"""Tabor's indentation tests as a curve of force, and the power laws fitted to it: where `plastic-power` comes from.

Source: thesis 7.3.5, (7.17)-(7.32) and table 7.1, for a sphere on a half-space of the same material: E' = 2 E*.
"""

import math

import numpy as np

FIRST, FULL = 5.0, 80.0  # a E' / (R sigma_Y) between which flow is contained, (7.21)
PRINTED = (-1.18, 4.49, -1.47)  # (7.20), with which table 7.1 was made


def parabola() -> tuple[float, float, float]:
    """A, B and C of p / sigma = A log10(x)^2 + B log10(x) + C, (7.17): 1.1 at x = 5, and a peak of 2.8 at x = 80.

    Differs: (7.20) prints -1.18, 4.49, -1.47, which give 1.092 at x = 5; (7.19) is called nonlinear, which it is not.
    """
    first, full = math.log10(FIRST), math.log10(FULL)
    system = [[first**2, first, 1.0], [full**2, full, 1.0], [2.0 * full, 1.0, 0.0]]
    return tuple(np.linalg.solve(system, [1.1, 2.8, 0.0]).tolist())


def force(indentation, radius: float, modulus: float, strength: float, begins: float, full: float, curve=None):
    """Force [N] at an indentation [m] between those of first and of full flow, (7.28); E* and sigma_Y in Pa, R in m.

    Differs: (7.28) prints the logarithm of what is to be subtracted from it; (7.24) lacks the 2 of a^2 = 2 alpha R.
    """
    square = (1.0 + (np.asarray(indentation) - begins) / (full - begins)) * indentation * radius  # (7.25)
    return math.pi * strength * square * pressure(np.sqrt(square) * 2.0 * modulus / (radius * strength), curve)


def pressure(width, curve=None):
    """Mean pressure over the yield strength at a E' / (R sigma_Y) from FIRST to FULL, (7.17)."""
    a, b, c = parabola() if curve is None else curve
    depth = np.log10(width)
    return a * depth**2 + b * depth + c


def through_ends(first: tuple[float, float], last: tuple[float, float]) -> tuple[float, float]:
    """K and n of the power law through two points of indentation and force, (7.30)."""
    exponent = math.log(last[1] / first[1]) / math.log(last[0] / first[0])
    return first[1] / first[0] ** exponent, exponent


def least_squares(indentations: np.ndarray, forces: np.ndarray) -> tuple[float, float]:
    """K and n of the power law nearest to these points in logarithms."""
    exponent, level = np.polyfit(np.log(indentations), np.log(forces), 1)
    return math.exp(level), float(exponent)
