"""Roots by halving, beside scipy's."""

import math

import pytest
from pytest import approx
from scipy.optimize import brentq

from solvers.contact.halving import root_between


@pytest.mark.parametrize(
    ("function", "low", "high"),
    [
        (lambda x: x**3 - 2.0, 0.0, 2.0),
        (lambda x: math.cos(x) - x, 0.0, 1.0),
        (lambda x: 1e-8 - x, 0.0, 1.0),
        (lambda x: math.log(x) - 20.0, 1.0, 1e12),
    ],
)
def test_the_root_is_that_of_brent(function, low, high):
    assert root_between(function, low, high) == approx(brentq(function, low, high, xtol=1e-15), rel=1e-14, abs=2e-15)


def test_it_ends_at_rounding_and_at_a_root_in_an_end():
    assert root_between(lambda x: x - 0.1, 0.0, 1.0, tolerance=0.0) == approx(0.1, rel=3e-16)
    assert root_between(lambda x: x, 0.0, 1.0) == 0.0 and root_between(lambda x: -x, -1.0, 0.0) == 0.0


def test_without_a_change_of_sign_it_refuses():
    with pytest.raises(ValueError, match="same sign"):
        root_between(lambda x: x * x + 1.0, -1.0, 1.0)
