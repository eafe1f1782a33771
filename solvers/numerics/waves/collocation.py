"""Radau IIA collocation: implicit, stiffly accurate, of order 2 * STAGES - 1, with dense output of order STAGES + 1."""

from decimal import Decimal

import numpy as np

from ...jit.kernels import inner_kernel
from ..quadrature import barycentric_weights, in_full, integrals, product, radau

STAGES = 6
_STAGE_NODES = radau(STAGES)  # in (0, 1], the last being 1
_NODES = [Decimal(0), *_STAGE_NODES]
_FULL_WEIGHTS = barycentric_weights(_NODES)
_INTEGRATE = integrals(_STAGE_NODES)

STAGE_NODES, INTEGRATE = np.array(_STAGE_NODES, float), np.array(_INTEGRATE, float)  # from 0 to each node
INTEGRATE_TWICE = np.array(product(_INTEGRATE, _INTEGRATE), float)
NODES, _WEIGHTS = np.array(_NODES, float), np.array(_FULL_WEIGHTS, float)  # the start and every stage


@in_full
def _back_to_start() -> list[Decimal]:
    shares = [w / -x for w, x in zip(barycentric_weights(_STAGE_NODES), _STAGE_NODES, strict=True)]
    return [each / sum(shares) for each in shares]


@in_full
def _slope_weights(k: int) -> list[Decimal]:
    """What multiplies the values at the nodes in the derivative of their polynomial at the k-th of them."""
    slope = [Decimal(0)] * len(_NODES)
    for j, node in enumerate(_NODES):
        if j != k:
            slope[j] = _FULL_WEIGHTS[j] / _FULL_WEIGHTS[k] / (_NODES[k] - node)
    slope[k] = -sum(slope)
    return slope


# value at 0 of the polynomial through the stages alone: against the true start value it gives the error of the step
BACK_TO_START = np.array(_back_to_start(), float)
SLOPE_AT_START, SLOPE_AT_END = (np.array(_slope_weights(k), float) for k in (0, STAGES))


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
