"""Transforms of histories, against closed forms."""

import numpy as np
import pytest
from pytest import approx

from solvers.numerics import spectra

FREQUENCY = np.array([0.0, 1e-7, 0.3, 1.0, 7.7, 60.0])


def test_a_rectangle_that_jumps():
    """Of height 3 from 0.5 to 2.5: 6 sinc(2 f), its middle at 1.5."""
    time, values = np.array([0.0, 0.5, 0.5, 2.5, 2.5, 4.0]), np.array([0.0, 0.0, 3.0, 3.0, 0.0, 0.0])
    known = 6.0 * np.sinc(2.0 * FREQUENCY) * np.exp(-3j * np.pi * FREQUENCY)
    assert spectra.transform(time, values, FREQUENCY) == approx(known, abs=1e-14)


def test_a_triangle():
    """Of height 1 and half width 1: sinc(f)^2, by stretches as unequal as they come."""
    time = np.array([-1.0, -0.9, -0.2, 0.0, 0.01, 0.7, 1.0])
    found = spectra.transform(time, 1.0 - np.abs(time), FREQUENCY)
    assert found == approx(np.sinc(FREQUENCY) ** 2, abs=1e-14)


@pytest.mark.parametrize("begins", [0.0, 0.37])
def test_the_window_is_that_of_a_product(begins):
    """1 - cos over all of the time, against the same by the trapezoidal rule."""
    time = begins + np.linspace(0.0, 2.0, 401)
    values = np.sin(9.0 * time) + 0.3
    fine = begins + np.linspace(0.0, 2.0, 200_001)
    windowed = np.interp(fine, time, values) * (1.0 - np.cos(np.pi * (fine - begins)))
    for frequency in (0.0, 0.3, 1.0, 7.7):
        known = np.trapezoid(windowed * np.exp(-2j * np.pi * frequency * fine), fine)
        assert spectra.hann(time, values, np.array([frequency]))[0] == approx(known, abs=1e-7)
