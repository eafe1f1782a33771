"""Symmetric matrices of a few diagonals against the same with all entries."""

import numpy as np
import pytest
from pytest import approx

from solvers.numerics.elements import banded

COUNTS, SIZES = (1, 2, 4), (1, 2, 3, 5, 9)


def matrix(count: int, size: int) -> np.ndarray:
    random = np.random.default_rng(10 * count + size)
    found = np.zeros((count, size))
    for j in range(min(count, size)):
        found[j, : size - j] = random.normal(size=size - j)
    found[0] = 10.0 + np.abs(found[0])
    return found


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("size", SIZES)
def test_products_parts_and_solutions(count, size):
    given = matrix(count, size)
    whole = banded.full(given)
    for j in range(min(count, size)):
        assert np.diag(whole, -j) == approx(given[j, : size - j])
    assert whole == approx(whole.T)
    rows = np.arange(3.0 * size).reshape(3, size) ** 1.5
    assert banded.times(given, rows) == approx(rows @ whole, rel=1e-13)
    kept = np.arange(size)[:: 2 if size > 3 else 1]
    assert banded.full(banded.without(given, kept)) == approx(whole[np.ix_(kept, kept)])
    solved = rows[2].copy()
    banded.solve(banded.factorised(given), solved)
    assert whole @ solved == approx(rows[2], rel=1e-13)


def test_blocks_are_not_joined():
    first, second = matrix(1, 2), matrix(4, 5)
    both = banded.full(banded.side_by_side(first, second))
    assert both[:2, :2] == approx(banded.full(first)) and both[2:, 2:] == approx(banded.full(second))
    assert not both[2:, :2].any()
