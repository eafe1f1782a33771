"""Radau IIA collocation: the order of its quadrature, of its interpolation and of its steps."""

import numpy as np
import pytest
from pytest import approx

from solvers.jit.kernels import kernel
from solvers.numerics.waves import collocation
from solvers.numerics.waves.collocation import (
    BACK_TO_START,
    INTEGRATE,
    INTEGRATE_TWICE,
    NODES,
    STAGE_NODES,
    STAGES,
)


@kernel
def interpolate(values, place):
    """For Python."""
    return collocation.interpolate(values, place)


@kernel
def solve_in_place(matrix, right, size):
    """For Python."""
    return collocation.solve_in_place(matrix, right, size)


def test_nodes_of_radau():
    assert STAGE_NODES[-1] == 1.0
    assert NODES[0] == 0.0
    assert np.all(np.diff(NODES) > 0.0)
    # the classical two-stage scheme has 1/3 and 1; six stages: roots of P6 - P5 on [0, 1]
    legendre = np.polynomial.Legendre.basis
    assert (legendre(6, [0, 1]) - legendre(5, [0, 1]))(STAGE_NODES) == approx(np.zeros(STAGES), abs=1e-13)


@pytest.mark.parametrize("power", range(2 * STAGES - 1))
def test_the_last_row_integrates_up_to_degree_ten(power):
    # a stiffly accurate scheme of order 2 s - 1 = 11
    assert INTEGRATE[-1] @ STAGE_NODES**power == approx(1.0 / (power + 1), rel=1e-13)


def test_and_no_further():
    power = 2 * STAGES - 1
    assert abs(INTEGRATE[-1] @ STAGE_NODES**power - 1.0 / (power + 1)) > 1e-7


@pytest.mark.parametrize("power", range(STAGES))
def test_every_row_integrates_up_to_degree_five(power):
    assert INTEGRATE @ STAGE_NODES**power == approx(STAGE_NODES ** (power + 1) / (power + 1), rel=1e-12, abs=1e-14)


@pytest.mark.parametrize("power", range(STAGES - 1))
def test_twice(power):
    wanted = STAGE_NODES ** (power + 2) / ((power + 1) * (power + 2))
    assert INTEGRATE_TWICE @ STAGE_NODES**power == approx(wanted, rel=1e-12, abs=1e-14)


def test_interpolation_is_exact_up_to_degree_six():
    polynomial = np.polynomial.Polynomial([1.0, -2.0, 0.5, 3.0, -1.0, 2.0, 4.0])
    for place in (0.0, 0.01, 0.37, float(NODES[3]), 0.99, 1.0):
        assert interpolate(polynomial(NODES), place) == approx(polynomial(place), rel=1e-13)
    assert polynomial.degree() == STAGES


def test_back_to_start_extrapolates_the_stages():
    polynomial = np.polynomial.Polynomial([0.7, -2.0, 0.5, 3.0, -1.0, 2.0])
    assert BACK_TO_START @ polynomial(STAGE_NODES) == approx(0.7, abs=1e-12)


def test_steps_are_of_order_eleven():
    def error(h):
        """Of u' = i u from 1 to time 12; the stage equations are linear."""
        system, u = np.eye(STAGES) - 1j * h * INTEGRATE, 1.0 + 0.0j
        for _ in range(round(12.0 / h)):
            u = np.linalg.solve(system, np.full(STAGES, u))[-1]
        return abs(u - np.exp(12.0j))

    steps = np.array([12.0 / n for n in (6, 8, 10, 12)])  # beyond, rounding takes over
    errors = np.array([error(h) for h in steps])
    assert errors[-1] > 1e-14
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == approx(11.0, abs=0.5)


def test_linear_systems():
    rng = np.random.default_rng(0)
    for size in (1, 2, STAGES):
        matrix, wanted = rng.normal(size=(size, size)), rng.normal(size=size)
        right = matrix @ wanted
        tolerance = 1e-14 * np.linalg.cond(matrix)
        assert solve_in_place(matrix.copy(), right, size)
        assert right == approx(wanted, abs=tolerance * 10.0)


def test_rows_are_exchanged_where_the_pivot_is_zero():
    right = np.array([3.0, 5.0])
    assert solve_in_place(np.array([[0.0, 1.0], [1.0, 0.0]]), right, 2)
    assert right == approx([5.0, 3.0])


def test_a_singular_system_is_reported():
    assert not solve_in_place(np.array([[1.0, 2.0], [2.0, 4.0]]), np.array([1.0, 1.0]), 2)
    assert not solve_in_place(np.array([[np.nan, 2.0], [2.0, 4.0]]), np.array([1.0, 1.0]), 2)
