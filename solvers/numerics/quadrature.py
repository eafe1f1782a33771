"""Nodes, weights and matrices of quadrature, rounded once from fifty digits: the same on every machine.

They stand in modules, so that compiled kernels hold them. Eigenvalues and inverses, from which NumPy has them, differ
in the last bits by the processor.
"""

from collections.abc import Callable, Sequence
from decimal import Decimal, localcontext
from functools import cache, wraps

import numpy as np

DIGITS = 50
NEWTON = 3  # steps from a root to fourteen digits, each of which doubles them

Row = list[Decimal]


def in_full(function: Callable) -> Callable:
    """A function that works with all these digits."""

    @wraps(function)
    def with_digits(*given):
        with localcontext(prec=DIGITS):
            return function(*given)

    return with_digits


@cache
@in_full
def gauss(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes in (-1, 1), rising, and weights of Gauss and Legendre, (count,) each: exact up to degree 2 count - 1."""
    nodes = _gauss_nodes(count)
    slopes = [_legendre(count, node)[1] for node in nodes]
    weights = [2 / ((1 - x * x) * slope**2) for x, slope in zip(nodes, slopes, strict=True)]
    return _fixed(nodes), _fixed(weights)


@in_full
def radau(count: int) -> Row:
    """Nodes in (0, 1], rising, the last being 1, of Radau."""

    def miss(x: Decimal) -> tuple[Decimal, Decimal]:
        (value, slope), (before, slope_before) = _legendre(count, x), _legendre(count - 1, x)
        return value - before, slope - slope_before

    difference = [0.0] * (count - 1) + [-1.0, 1.0]
    starts = np.sort(np.polynomial.legendre.legroots(difference).real)[:-1]
    return [(1 + _root(miss, start)) / 2 for start in starts] + [Decimal(1)]


@in_full
def gauss_within(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nodes in (0, 1), weights, and the matrix that integrates from 0 to each node, (count, count)."""
    nodes = [(1 + each) / 2 for each in _gauss_nodes(count)]
    return _fixed(nodes), 0.5 * gauss(count)[1], _fixed(integrals(nodes))


@in_full
def integrals(nodes: Sequence[Decimal]) -> list[Row]:
    """Of the polynomial through values at the nodes, from 0 to each node: rows that multiply the values."""
    bases = [_lagrange(nodes, k) for k in range(len(nodes))]
    return [[sum(c * x ** (p + 1) / (p + 1) for p, c in enumerate(base)) for base in bases] for x in nodes]


@in_full
def product(first: Sequence[Row], second: Sequence[Row]) -> list[Row]:
    """Of two matrices."""
    columns = list(zip(*second, strict=True))
    return [[sum(a * b for a, b in zip(row, column, strict=True)) for column in columns] for row in first]


@in_full
def barycentric_weights(nodes: Sequence[Decimal]) -> Row:
    """What stands over the distance to each node in the polynomial through values there."""
    found = []
    for k, node in enumerate(nodes):
        gaps = Decimal(1)
        for j, other in enumerate(nodes):
            gaps *= node - other if j != k else 1
        found.append(1 / gaps)
    return found


def _gauss_nodes(count: int) -> Row:
    starts = np.polynomial.legendre.leggauss(count)[0]
    right = [_root(lambda x: _legendre(count, x), start) for start in starts[(count + 1) // 2 :]]
    return [-each for each in reversed(right)] + [Decimal(0)] * (count % 2) + right


def _root(function: Callable[[Decimal], tuple[Decimal, Decimal]], start: float) -> Decimal:
    x = Decimal(float(start))
    for _ in range(NEWTON):
        value, slope = function(x)
        x -= value / slope
    return x


def _legendre(degree: int, x: Decimal) -> tuple[Decimal, Decimal]:
    """The polynomial of this degree, and its slope, inside of (-1, 1)."""
    before, value = Decimal(0), Decimal(1)
    for k in range(1, degree + 1):
        before, value = value, ((2 * k - 1) * x * value - (k - 1) * before) / k
    return value, degree * (before - x * value) / (1 - x * x)


def _lagrange(nodes: Sequence[Decimal], k: int) -> Row:
    """Coefficients, from that of 1, of the polynomial that is one at the k-th node and zero at the others."""
    found = [Decimal(1)]
    for j, node in enumerate(nodes):
        if j != k:
            raised, kept = [Decimal(0), *found], [node * each for each in found] + [Decimal(0)]
            found = [(a - b) / (nodes[k] - node) for a, b in zip(raised, kept, strict=True)]
    return found


def _fixed(values: Sequence) -> np.ndarray:
    """As floats that nobody changes: they are shared."""
    found = np.array(values, dtype=float)
    found.flags.writeable = False
    return found
