"""Waves in round bars against the stresses on their surface, written out anew, and limits of long and short waves."""

import math

import numpy as np
import pytest
from pytest import approx
from scipy.optimize import brentq
from scipy.special import jv

from solvers.numerics.pochhammer import highest, phase_speed, phase_speeds


def surface(speed: float, kappa: float, poisson: float) -> float:
    """Determinant of the stresses on the surface of a bar of radius 1, c0 = rho = 1; changes its sign at the speed.

    Displacements are u_r = A J0'(alpha r) + B J1(beta r), i u_z = A k J0(alpha r) - B / k (r J1(beta r))' / r.
    """
    young, shear = 1.0, 0.5 / (1.0 + poisson)
    lame = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
    omega = speed * kappa
    alpha = np.sqrt(complex(omega**2 / (lame + 2.0 * shear) - kappa**2))
    beta = np.sqrt(complex(omega**2 / shear - kappa**2))
    # radial stress and shear of both potentials
    radial = (
        -(lame * (alpha**2 + kappa**2) + 2.0 * shear * alpha**2) * jv(0, alpha) + 2.0 * shear * alpha * jv(1, alpha),
        2.0 * shear * kappa * (beta * jv(0, beta) - jv(1, beta)),
    )
    along = (-2.0 * kappa * alpha * jv(1, alpha), (beta**2 - kappa**2) * jv(1, beta))
    return float(((radial[0] * along[1] + radial[1] * along[0]) / jv(1, beta)).real)


@pytest.mark.parametrize("poisson", [0.25, 0.29, 0.35])
@pytest.mark.parametrize("over", [0.1, 0.25, 0.5, 0.7])  # diameter over wave length, as in Bancroft's table
def test_the_surface_is_free_of_stress_at_the_speed_of_the_first_mode(poisson, over):
    kappa = math.pi * over
    frequency, speed = phase_speeds(poisson)
    found = float(np.interp(kappa, frequency / speed, speed))
    assert surface(found - 1e-6, kappa, poisson) * surface(found + 1e-6, kappa, poisson) < 0.0
    assert found < 1.0 - 0.5 * (0.5 * poisson * kappa) ** 2


@pytest.mark.parametrize("poisson", [0.2, 0.29, 0.4])
def test_long_waves_are_those_of_rayleigh(poisson):
    """1 - (nu pi a / wave length)^2, up to the fourth power."""
    frequency, speed = (each[2:30] for each in phase_speeds(poisson))
    own = (0.5 * poisson * frequency / speed) ** 2  # k a = 2 pi a / wave length = omega a / c
    assert 1.0 - speed == approx(own, rel=0.01)
    assert phase_speed(np.array([0.0]), poisson) == [1.0]


def test_no_wave_is_slower_than_those_of_a_surface():
    """Rayleigh's: (2 - s)^2 = 4 sqrt(1 - s) sqrt(1 - q s), s = (c / c_s)^2, q = (c_s / c_d)^2."""
    poisson = 0.29
    ratio = (1.0 - 2.0 * poisson) / (2.0 - 2.0 * poisson)
    square = brentq(lambda s: (2.0 - s) ** 2 - 4.0 * math.sqrt((1.0 - s) * (1.0 - ratio * s)), 0.5, 0.99)
    slowest = math.sqrt(square / (2.0 + 2.0 * poisson))
    assert slowest < phase_speed(np.array([highest(poisson)]), poisson)[0] < 1.2 * slowest


def test_every_frequency_is_slower_than_the_one_below_it():
    for poisson in (0.05, 0.29, 0.499):
        frequency, speed = phase_speeds(poisson)
        assert (np.diff(frequency) > 0.0).all() and (np.diff(speed) <= 1e-9).all() and frequency[-1] >= highest(poisson)
