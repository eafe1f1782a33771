"""Symmetric matrices of a few diagonals: stored, multiplied, factorised and solved in as many sweeps.

`bands` (1 + half, unknowns) hold the diagonal and what lies below it: bands[j, i] is entry (i + j, i), zero beyond the
last row. `half` is 1 for a chain of springs and 3 for a beam, whose nodes move and turn.
"""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel, kernel


def widened(bands: np.ndarray, count: int) -> np.ndarray:
    """The same matrix stored with `count` bands."""
    return np.vstack((bands, np.zeros((count - bands.shape[0], bands.shape[1]))))


def side_by_side(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Both matrices as blocks of one, not joined; with two bands at least."""
    count = max(2, first.shape[0], second.shape[0])
    return np.hstack((widened(first, count), widened(second, count)))


def without(bands: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Rows and columns `kept` (ascending) alone."""
    count, size = bands.shape[0], kept.size
    found = np.zeros((count, size))
    for j in range(min(count, size)):
        apart = kept[j:] - kept[: size - j]
        near = apart < count
        found[j, : size - j][near] = bands[apart[near], kept[: size - j][near]]
    return found


def full(bands: np.ndarray) -> np.ndarray:
    """All entries, (unknowns, unknowns)."""
    size = bands.shape[1]
    found = np.diag(bands[0])
    for j in range(1, min(bands.shape[0], size)):
        part = bands[j, : size - j]
        found += np.diag(part, j) + np.diag(part, -j)
    return found


def times(bands: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """The matrix times every row, (..., unknowns)."""
    found, size = bands[0] * rows, bands.shape[1]
    for j in range(1, min(bands.shape[0], size)):
        part = bands[j, : size - j]
        found[..., j:] += part * rows[..., : size - j]
        found[..., : size - j] += part * rows[..., j:]
    return found


class Factors(NamedTuple):
    """L D L^T of such a matrix: `below` (half, unknowns) holds entry (i, i - j) of L at [j - 1, i]; one over D.

    `broad` is empty for three diagonals: a kernel is compiled for either number of them.
    """

    below: np.ndarray
    inverse: np.ndarray
    broad: tuple[int, ...]


def factorised(bands: np.ndarray) -> Factors:
    """Once per scene: O(unknowns). Source: elimination without pivots, as the matrices are positive."""
    size = bands.shape[1]
    half = 1 if bands.shape[0] <= 2 else 3
    below, inverse = np.zeros((half, size)), np.zeros(size)
    _factorise(widened(bands, half + 1), below, inverse)
    return Factors(below, inverse, () if half == 1 else (half,))


@kernel
def _factorise(bands, below, inverse):
    half, size = below.shape
    for i in range(size):
        pivot = bands[0, i]
        for j in range(min(half, i), 0, -1):  # entries (i, i - j) of L D, then of L
            entry = bands[j, i - j]
            for k in range(j + 1, min(half, i) + 1):
                entry -= below[k - 1, i] * below[k - j - 1, i - j] / inverse[i - k]
            below[j - 1, i] = entry * inverse[i - j]
            pivot -= entry * below[j - 1, i]
        inverse[i] = 1.0 / pivot


@kernel
def solve(factors, vector):
    """In place."""
    below, inverse, last = factors.below, factors.inverse, vector.size - 1
    broad = len(factors.broad) > 0
    one = two = three = 0.0
    for i in range(last + 1):
        value = vector[i]
        if broad:
            value -= below[1, i] * two + below[2, i] * three
            three, two = two, one
        one = value - below[0, i] * one
        vector[i] = one * inverse[i]
    substitute(factors, vector)


@inner_kernel
def substitute(factors, vector):
    """The backward sweep: L^T x = vector, in place."""
    below, last = factors.below, vector.size - 1
    broad = len(factors.broad) > 0
    one = two = three = 0.0
    for i in range(last, -1, -1):
        value = vector[i]
        if broad:
            value -= below[1, min(i + 2, last)] * two + below[2, min(i + 3, last)] * three
            three, two = two, one
        one = value - below[0, min(i + 1, last)] * one
        vector[i] = one
