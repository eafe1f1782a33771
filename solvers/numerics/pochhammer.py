"""Longitudinal waves in a round bar: how fast each frequency of the first mode runs.

With the radius a as unit of length, and kappa = k a, the equation of Pochhammer and Chree is

    2 alpha (beta^2 + kappa^2) J1(alpha) J1(beta) - (beta^2 - kappa^2)^2 J0(alpha) J1(beta)
        - 4 kappa^2 alpha beta J1(alpha) J0(beta) = 0,

alpha^2 = kappa^2 (c^2 / c_d^2 - 1), beta^2 = kappa^2 (c^2 / c_s^2 - 1). The first mode is slower than dilatational
waves, so that alpha is imaginary; beta is real up to where the mode is as slow as shear waves. Divided by beta, and by
I0 of what is imaginary, all terms are real and bounded.
Source: Kolsky, Stress Waves in Solids (1963), 3.3; Bancroft, Phys. Rev. 59 (1941) 588.
"""

import math
from functools import lru_cache

import numpy as np

STEP = 0.005  # of k a, between points of the curve: straight between them, c is off by 1e-6
SHEAR_ROOT = 3.8317059702075125  # J1 = 0: there, in omega a / c_s, the first of the higher modes begins


def shear_ratio(poisson: float) -> float:
    """Speed of shear waves over that of thin bars, c_s / c0."""
    return 1.0 / math.sqrt(2.0 * (1.0 + poisson))


def highest(poisson: float) -> float:
    """omega a / c0 above which a bar carries higher modes, too: the root of J1 in shear, or the dilatational mode."""
    return min(SHEAR_ROOT * shear_ratio(poisson), _dilatational_cutoff(poisson))


@lru_cache(maxsize=32)
def phase_speeds(poisson: float) -> tuple[np.ndarray, np.ndarray]:
    """omega a / c0, (n,), from 0 to beyond `highest`, and c / c0 of the first mode there, (n,).

    Error: 1e-12 at the points, 1e-6 between them.
    """
    from scipy.optimize import brentq

    lowest = 0.8 * shear_ratio(poisson)  # below Rayleigh's waves, which run at 0.87 to 0.96 of shear
    frequency, speed = [0.0], [1.0]
    while frequency[-1] < highest(poisson):
        kappa = STEP * len(frequency)
        # ever slower: from the one before on there is no other mode below
        found = float(brentq(_equation, lowest, speed[-1] + 1e-9, args=(kappa, poisson), xtol=1e-14, rtol=1e-14))
        frequency.append(found * kappa)
        speed.append(found)
    return np.array(frequency), np.array(speed)


def phase_speed(frequency: np.ndarray, poisson: float) -> np.ndarray:
    """c / c0 at omega a / c0; above `highest` that of it."""
    return np.interp(np.abs(frequency), *phase_speeds(float(poisson)))


def _equation(speed: float, kappa: float, poisson: float) -> float:
    """Zero for c / c0 of a mode of the wave number kappa = k a; of one sign below the first mode."""
    from scipy.special import i0e, i1e, j0, j1

    dilatational = (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson))  # (c_d / c0)^2
    square = kappa * kappa
    q = kappa * math.sqrt(max(1.0 - speed**2 / dilatational, 0.0))  # alpha = i q
    turned = -q * i1e(q) / i0e(q)  # alpha J1(alpha) / J0(alpha)
    beta = square * (speed**2 / shear_ratio(poisson) ** 2 - 1.0)  # its square
    p = math.sqrt(abs(beta))
    if p < 1e-8:
        zeroth, first = 1.0, 0.5
    elif beta > 0.0:
        zeroth, first = j0(p), j1(p) / p
    else:
        zeroth, first = 1.0, i1e(p) / (i0e(p) * p)
    return 2.0 * turned * (beta + square) * first - (beta - square) ** 2 * first - 4.0 * square * turned * zeroth


def _dilatational_cutoff(poisson: float) -> float:
    """omega a / c0 of the lowest mode that only breathes, k = 0:
    x J0(x) = (1 - 2 nu) / (1 - nu) J1(x), x = omega a / c_d.
    """
    from scipy.optimize import brentq
    from scipy.special import j0, j1

    share = (1.0 - 2.0 * poisson) / (1.0 - poisson)
    x = float(brentq(lambda x: x * j0(x) - share * j1(x), 1e-3, 3.0))
    return x * math.sqrt((1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)))
