"""Polynomials in kernels: values, shifts, and every real root on an interval."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import Polynomial
from pytest import approx

from solvers.jit.kernels import kernel
from solvers.numerics import polynomials
from solvers.numerics.polynomials import RootWork

COEFFICIENTS = st.lists(st.floats(-10.0, 10.0), min_size=1, max_size=9).map(np.array)


# what kernels call, for Python


@kernel
def value(coefficients, degree, x):
    return polynomials.value(coefficients, degree, x)


@kernel
def shift(coefficients, degree, by, shifted):
    polynomials.shift(coefficients, degree, by, shifted)


@kernel
def trim(coefficients, degree, reach):
    return polynomials.trim(coefficients, degree, reach)


@kernel
def roots(coefficients, degree, length, found, work):
    return polynomials.roots(coefficients, degree, length, found, work)


@kernel
def bracketed_root(coefficients, degree, a, b, rising):
    return polynomials.bracketed_root(coefficients, degree, a, b, rising)


def found_roots(coefficients, length: float) -> np.ndarray:
    coefficients = np.asarray(coefficients, float)
    found, work = np.zeros(coefficients.size + 2), RootWork.of(coefficients.size)
    return found[: roots(coefficients, coefficients.size - 1, length, found, work)].copy()


@given(COEFFICIENTS, st.floats(-3.0, 3.0))
def test_value(coefficients, x):
    scale = float(Polynomial(np.abs(coefficients))(abs(x)))
    assert value(coefficients, coefficients.size - 1, x) == approx(
        float(Polynomial(coefficients)(x)), abs=1e-14 * scale
    )


@given(COEFFICIENTS, st.floats(-2.0, 2.0))
def test_shift(coefficients, by):
    shifted = np.zeros(coefficients.size)
    shift(coefficients, coefficients.size - 1, by, shifted)
    scale = float(Polynomial(np.abs(coefficients))(abs(by) + 1.0))
    for x in (0.0, 0.3, 1.0):
        assert float(Polynomial(shifted)(x)) == approx(float(Polynomial(coefficients)(by + x)), abs=1e-13 * scale)


def test_trim_drops_only_what_no_double_can_see():
    assert trim(np.array([1.0, 2.0, 1e-21]), 2, 1.0) == 1
    assert trim(np.array([1.0, 2.0, 1e-19]), 2, 1.0) == 2
    assert trim(np.array([1.0, 2.0, 1e-21]), 2, 1e3) == 2  # seen from afar
    assert trim(np.array([1.0, 0.0, 0.0]), 2, 1.0) == 0


@pytest.mark.slow
@settings(max_examples=200)
@given(st.lists(st.integers(1, 99), min_size=1, max_size=6, unique=True), st.floats(0.1, 10.0), st.booleans())
def test_separate_roots(places, length, negative):
    wanted = np.sort(np.array(places)) / 100.0 * length
    polynomial = Polynomial.fromroots(wanted) * (-1.0 if negative else 1.0)
    found = found_roots(polynomial.coef, length)
    assert found.size == wanted.size
    # a root moves by the rounding of p over its slope there
    rounding = 1e-15 * Polynomial(np.abs(polynomial.coef))(wanted) / np.abs(polynomial.deriv()(wanted))
    assert np.all(np.abs(found - wanted) <= 10.0 * rounding + 1e-15 * length)


@given(st.lists(st.floats(-10.0, 10.0), min_size=3, max_size=9).map(np.array), st.floats(0.2, 4.0))
@settings(max_examples=300)
def test_random_polynomials_change_sign_at_every_root_and_nowhere_else(coefficients, length):
    found = found_roots(coefficients, length)
    assert np.all(np.diff(found) >= 0.0)
    assert np.all(
        (found > 0.0) & (found < length)
        | (np.abs(found) <= 1e-13 * length)
        | (np.abs(found - length) <= 1e-13 * length)
    )
    x = np.linspace(0.0, length, 2001)[1:-1]
    p = Polynomial(coefficients)(x)
    sure = np.abs(p) > 1e-12 * Polynomial(np.abs(coefficients))(x)
    x, p = x[sure], p[sure]
    for k in np.flatnonzero(p[:-1] * p[1:] < 0.0):
        assert np.any((found >= x[k]) & (found <= x[k + 1])), "a change of sign without a root"


@pytest.mark.parametrize("apart", [1e-2, 1e-4, 1e-6])
def test_clustered_roots_are_all_found(apart):
    wanted = np.array([0.21, 0.47, 0.47 + apart, 0.9])
    found = found_roots(Polynomial.fromroots(wanted).coef, 1.0)
    assert found.size == 4
    assert found == approx(wanted, abs=1e-14 / apart)  # rounding of the coefficients over the slope at the roots


@pytest.mark.parametrize("wanted", [[0.01, 0.25], [0.01, 0.04, 0.25], [0.03, 0.15], [0.075, 0.15, 0.225]])
@pytest.mark.parametrize("length", [0.3, 1.0])
def test_roots_at_halves_and_quarters_of_the_interval(wanted, length):
    """Where the interval is halved, the sign of the polynomial is a matter of rounding; the root is there anyway."""
    inside = [root for root in wanted if root < length]
    assert found_roots(Polynomial.fromroots(wanted).coef, length) == approx(np.array(inside), abs=1e-14)


def test_a_double_root_that_only_touches():
    # by rounding, none, one, or two roots next to each other: but nowhere else
    found = found_roots(Polynomial.fromroots([0.5, 0.5]).coef, 1.0)
    assert found.size <= 2
    assert np.all(np.abs(found - 0.5) < 1e-7)
    found = found_roots(Polynomial.fromroots([0.3, 0.5, 0.5]).coef, 1.0)
    assert 1 <= found.size <= 3
    assert found[0] == approx(0.3, abs=1e-14)


@pytest.mark.parametrize(
    "coefficients",
    [[1.0], [1.0, 0.0, 1.0], [-3.0, 1.0], [0.5, 1.0], [1.0, -2.0, 1.0 + 1e-6], [0.0], [2.0, 0.0, 0.0]],
    ids=["constant", "complex", "beyond", "before", "just complex", "zero", "padded"],
)
def test_no_roots(coefficients):
    assert found_roots(coefficients, 2.0 if coefficients[0] != 0.5 else 1.0).size == 0


def test_degree_forty():
    wanted = np.array([0.07, 0.23, 0.41, 0.58, 0.77, 0.93])
    with_complex = Polynomial.fromroots(wanted)
    for k in range(17):
        with_complex *= Polynomial([1.0 + (0.1 * k) ** 2, -0.2 * k, 1.0])  # no real roots
    assert with_complex.degree() == 40
    found = found_roots(with_complex.coef, 1.0)
    # the rounding of the coefficients over the slope at the root
    slopes = np.abs(with_complex.deriv()(wanted))
    assert np.all(np.abs(found - wanted) <= 1e-15 * Polynomial(np.abs(with_complex.coef))(wanted) / slopes)


def test_bracketed_root_stays_inside():
    # the tangent at the middle leads far away: x^3 - 2 x + 2 on [-3, 0]
    coefficients = np.array([2.0, -2.0, 0.0, 1.0])
    assert bracketed_root(coefficients, 3, -3.0, 0.0, True) == approx(-1.7692923542386314, rel=1e-15)
