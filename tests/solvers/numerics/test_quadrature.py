"""Quadrature integrates exactly what it promises, and has the constants of the tables."""

from decimal import Decimal

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from numpy.polynomial.legendre import leggauss

from solvers.numerics.quadrature import barycentric_weights, gauss, gauss_within, integrals, radau


@pytest.mark.parametrize("count", [1, 2, 3, 6, 16, 41])
def test_nodes_and_weights_of_gauss_are_those_of_numpy_but_for_their_last_digits(count):
    for ours, theirs in zip(gauss(count), leggauss(count), strict=True):
        assert ours == pytest.approx(theirs, abs=1e-14)


def test_nodes_and_weights_of_gauss_are_the_nearest_numbers_to_the_true_ones():
    """Abramowitz and Stegun, table 25.4."""
    nodes, weights = gauss(16)
    assert nodes[8] == 0.09501250983763744018 and nodes[15] == 0.98940093499164993260
    assert weights[8] == 0.18945061045506849629 and weights[15] == 0.02715245941175409485
    assert (nodes == -nodes[::-1]).all() and (weights == weights[::-1]).all()


def test_radau_has_the_nodes_that_tables_give_for_three_stages():
    assert [float(each) for each in radau(3)] == pytest.approx([(4 - 6**0.5) / 10, (4 + 6**0.5) / 10, 1.0], rel=1e-15)


def test_from_zero_to_each_node_polynomials_are_integrated_exactly():
    nodes, weights, matrix = gauss_within(6)
    power = Polynomial([0.3, -1.0, 0.0, 2.0, 0.5, -0.7])
    assert matrix @ power(nodes) == pytest.approx(power.integ()(nodes), rel=1e-14)
    assert weights @ nodes**11 == pytest.approx(1.0 / 12.0, rel=1e-14)
    last = [float(each) for each in integrals(radau(6))[-1]]
    assert np.dot(last, np.array(radau(6), float) ** 10) == pytest.approx(1.0 / 11.0, rel=1e-14)


def test_weights_of_the_barycentric_formula_of_three_nodes():
    found = barycentric_weights([Decimal(0), Decimal(1), Decimal(3)])
    assert [float(each) for each in found] == [1.0 / 3.0, -0.5, 1.0 / 6.0]


def test_what_is_shared_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        gauss(4)[0][0] = 0.0
