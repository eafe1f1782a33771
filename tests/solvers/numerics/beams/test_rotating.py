"""Bending of a beam that turns: tension done right, against a second formulation and bounds."""

from itertools import pairwise

import numpy as np
import pytest
from pytest import approx
from scipy.linalg import eigh

from solvers.numerics.beams.modes import BeamLine, beam_modes
from solvers.numerics.beams.rotating import (
    Bent,
    rotating_beam_modes,
    rotating_frequencies,
    rotating_spectrum,
    simplified_squares,
)

UNIT = BeamLine(1.0, 1.0, 1.0)
SHIFTS = (0.19333626, 5.47822489, 16.85951956)  # of omega^2 over Omega^2 as Omega -> 0; printed nowhere, see errata


def by_elements(speed: float, elements: int, count: int) -> np.ndarray:
    """Squares of the lowest frequencies by Hermite elements, with geometric stiffness and centrifugal softening."""
    size, length = 2 * elements + 2, 1.0 / elements
    stiffness, mass = np.zeros((2, size, size))
    nodes, weights = np.polynomial.legendre.leggauss(6)
    for element in range(elements):
        for node, weight in zip(0.5 * (nodes + 1.0), 0.5 * weights * length, strict=True):
            s = node
            shape = np.array([1 - 3 * s**2 + 2 * s**3, length * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3,
                              length * (s**3 - s**2)])  # fmt: skip
            slope = np.array([6 * s**2 - 6 * s, length * (1 - 4 * s + 3 * s**2), 6 * s - 6 * s**2,
                              length * (3 * s**2 - 2 * s)]) / length  # fmt: skip
            curve = np.array([12 * s - 6, length * (6 * s - 4), 6 - 12 * s, length * (6 * s - 2)]) / length**2
            x, own = (element + s) * length, slice(2 * element, 2 * element + 4)
            tension = 0.5 * speed**2 * (1.0 - x**2)
            stiffness[own, own] += weight * (np.outer(curve, curve) + tension * np.outer(slope, slope))
            stiffness[own, own] -= weight * speed**2 * np.outer(shape, shape)
            mass[own, own] += weight * np.outer(shape, shape)
    return eigh(stiffness[2:, 2:], mass[2:, 2:], eigvals_only=True)[:count]


@pytest.mark.parametrize("speed", [0.0, 1.0, 5.0, 30.0])
def test_elements_tend_to_the_polynomials(speed):
    """Fourth order in the elements, towards the same frequencies."""
    exact = rotating_spectrum(speed, 3).squares
    errors = [np.abs(by_elements(speed, n, 3) / exact - 1.0).max() for n in (20, 40)]
    assert errors[1] < 1e-4
    assert np.log2(errors[0] / errors[1]) == approx(4.0, abs=0.15)


@pytest.mark.parametrize("speed", [0.5, 6.0, 50.0])
def test_spectral_convergence(speed):
    """Every few polynomials take orders of magnitude off the error, faster than any power."""
    exact = rotating_spectrum(speed, 3).squares
    errors = [np.abs(rotating_spectrum(speed, 3, degree).squares / exact - 1.0).max() for degree in (6, 9, 12, 15)]
    falls = [before / after for before, after in pairwise(errors)]
    assert falls[1] > 2.0 * falls[0] > 20.0
    assert errors[3] < 1e-5
    assert (rotating_spectrum(speed, 3, 60).squares / exact - 1.0) == approx(0.0, abs=1e-12)


def test_slow_rotation():
    """omega^2 = omega_0^2 + shift Omega^2, where (5.56) has -1 for every mode."""
    still = rotating_spectrum(0.0, 3).squares
    assert np.sqrt(still) == approx(beam_modes(UNIT, "cantilever", 1.0, 3).frequencies, rel=1e-13)
    speed = 1e-2
    assert (rotating_spectrum(speed, 3).squares - still) / speed**2 == approx(SHIFTS, rel=1e-6)
    assert (simplified_squares(np.sqrt(still), speed) - still) / speed**2 == approx(-1.0, rel=1e-6)


@pytest.mark.parametrize("speed", [0.3, 3.0, 30.0, 300.0])
def test_bounds(speed):
    """Southwell: above stiffness and rotation each alone, 0, 5, 14 Omega^2 for a string; Rayleigh: below the shift."""
    squares, still = rotating_spectrum(speed, 3).squares, rotating_spectrum(0.0, 3).squares
    assert squares[0] > still[0]
    assert (squares > np.array([0.0, 5.0, 14.0]) * speed**2).all()
    assert squares[0] < still[0] + SHIFTS[0] * speed**2 * (1.0 + 1e-6)


def test_polynomials():
    """Curvatures of unit norm, clamped at the root; each field the slope of the one before."""
    bent, x = Bent(12), np.linspace(0.1, 0.9, 5)
    nodes, weights = np.polynomial.legendre.leggauss(30)
    curvatures = bent.at(0.5 * (nodes + 1.0))[2]
    assert (curvatures * (0.5 * weights)) @ curvatures.T == approx(np.eye(12), abs=1e-12)
    assert bent.at(np.zeros(1))[:2] == approx(np.zeros((2, 12, 1)), abs=1e-14)
    ahead, behind = bent.at(x + 1e-5), bent.at(x - 1e-5)
    for quantity in range(3):
        found = (ahead[quantity] - behind[quantity]) / 2e-5
        assert found == approx(bent.at(x)[quantity + 1], rel=1e-5, abs=1e-6)


def test_modes_of_a_turning_beam():
    """At rest those of the cantilever, its static compliance too; turning, orthogonal and stiffer."""
    line, place = BeamLine(0.3, 14_000.0, 7.11), 0.3
    still, known = rotating_beam_modes(line, place, 0.0, 8), beam_modes(line, "cantilever", place, 8)
    assert still.frequencies == approx(known.frequencies, rel=1e-12)
    assert np.abs(still.at_contact) == approx(np.abs(known.at_contact), rel=1e-9)
    assert still.residual_compliance == approx(known.residual_compliance, rel=1e-6)
    x = np.array([0.0, 0.1, 0.25])
    signs = np.sign(still.at_contact * known.at_contact)[:, None]
    for field in ("shapes", "slopes", "moments", "shears"):
        values = getattr(known, field)(x)
        assert signs * getattr(still, field)(x) == approx(values, rel=1e-7, abs=1e-7 * np.abs(values).max())
    assert np.abs(still.means) == approx(np.abs(known.means), rel=1e-9)
    turning = rotating_beam_modes(line, place, 2000.0, 8)
    assert turning.frequencies == approx(rotating_frequencies(line, 2000.0, 8), rel=1e-13)
    assert (turning.frequencies > still.frequencies).all()
    nodes, weights = np.polynomial.legendre.leggauss(60)
    shapes = turning.shapes(0.15 * (nodes + 1.0))
    assert line.mass_per_length * 0.15 * (shapes * weights) @ shapes.T == approx(np.eye(8), abs=1e-10)
