"""Radau IIA collocation: implicit, stiffly accurate, of order 2 * STAGES - 1, with dense output of order STAGES + 1."""

import numpy as np
from numpy.polynomial import Legendre

from ...jit.kernels import inner_kernel

STAGES = 6


def _radau(stages: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes in (0, 1], the last being 1, and the matrix that integrates from 0 to each node."""
    difference = Legendre.basis(stages, [0, 1]) - Legendre.basis(stages - 1, [0, 1])
    nodes = np.sort(difference.roots().real)
    nodes[-1] = 1.0
    basis = [Legendre.basis(k, [0, 1]) for k in range(stages)]
    values = np.array([[p(c) for p in basis] for c in nodes])
    integrals = np.array([[p.integ(lbnd=0)(c) for p in basis] for c in nodes])
    return nodes, integrals @ np.linalg.inv(values)


STAGE_NODES, INTEGRATE = _radau(STAGES)
INTEGRATE_TWICE = INTEGRATE @ INTEGRATE
NODES = np.concatenate(([0.0], STAGE_NODES))  # of the stored segments: the start and every stage


def _barycentric_weights(nodes: np.ndarray) -> np.ndarray:
    gaps = nodes[:, None] - nodes[None, :] + np.eye(nodes.size)
    return 1.0 / gaps.prod(axis=1)


_WEIGHTS = _barycentric_weights(NODES)
_STAGE_WEIGHTS = _barycentric_weights(STAGE_NODES)
# value at 0 of the polynomial through the stages alone: against the true start value it gives the error of the step
BACK_TO_START = (_STAGE_WEIGHTS / -STAGE_NODES) / (_STAGE_WEIGHTS / -STAGE_NODES).sum()


def _slope_weights(nodes: np.ndarray, weights: np.ndarray, k: int) -> np.ndarray:
    """What multiplies the values at `nodes` in the derivative of their polynomial at the k-th of them."""
    others = np.arange(nodes.size) != k
    slope = np.zeros(nodes.size)
    slope[others] = (weights[others] / weights[k]) / (nodes[k] - nodes[others])
    slope[k] = -slope.sum()
    return slope


SLOPE_AT_START = _slope_weights(NODES, _WEIGHTS, 0)
SLOPE_AT_END = _slope_weights(NODES, _WEIGHTS, STAGES)


@inner_kernel
def interpolate(values, place):
    """The polynomial through `values` (at NODES) at `place`, in [0, 1]."""
    above, below = 0.0, 0.0
    for k in range(NODES.size):
        distance = place - NODES[k]
        if distance == 0.0:
            return values[k]
        share = _WEIGHTS[k] / distance
        above += share * values[k]
        below += share
    return above / below


@inner_kernel
def solve_in_place(matrix, right, size):
    """Gaussian elimination with row exchange; the solution replaces `right`. False if the matrix is singular."""
    for k in range(size):
        pivot = k
        for i in range(k + 1, size):
            if abs(matrix[i, k]) > abs(matrix[pivot, k]):
                pivot = i
        if not abs(matrix[pivot, k]) > 0.0:
            return False
        if pivot != k:
            for j in range(k, size):
                matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
            right[k], right[pivot] = right[pivot], right[k]
        for i in range(k + 1, size):
            factor = matrix[i, k] / matrix[k, k]
            for j in range(k + 1, size):
                matrix[i, j] -= factor * matrix[k, j]
            right[i] -= factor * right[k]
    for k in range(size - 1, -1, -1):
        for j in range(k + 1, size):
            right[k] -= matrix[k, j] * right[j]
        right[k] /= matrix[k, k]
    return True
