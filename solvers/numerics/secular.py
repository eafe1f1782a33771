"""Oscillators held together at one place: modes of a diagonal stiffness on the plane that is normal to one vector.

Between two frequencies of the parts lies one of the whole: a root of sum w_i^2 / (d_i - x) = 0, found from the nearer
of the two, so that it keeps its digits however close it is. Cost: O(modes^2); a dense problem takes O(modes^3).
Source: Gu and Eisenstat (1995), for the weights that belong to the roots as rounding left them, which make the vectors
orthogonal.
"""

from typing import NamedTuple, Self

import numpy as np

from ..jit.kernels import inner_kernel, kernel
from .arrays import copy_to, dot

SAME_POLE = 1e-13  # relative difference of two poles that are taken as one
LEAST_WEIGHT = 1e-15  # of the norm of the weights: who is moved by less takes no part
MAX_ITERATIONS = 200  # of a root: fifty of them halve the interval, whatever the others bring


class Work(NamedTuple):
    """Room for so many modes."""

    order: np.ndarray  # (modes,) of int, as are the next four: modes by their poles
    origin: np.ndarray
    taking: np.ndarray
    first: np.ndarray  # of modes that are turned into each other, one and the other
    second: np.ndarray
    poles: np.ndarray  # (modes,), as are the next three
    weights: np.ndarray
    own: np.ndarray
    offset: np.ndarray
    turns: np.ndarray  # (modes, 2), cosine and sine
    vectors: np.ndarray  # (modes, modes - 1)

    @classmethod
    def of(cls, modes: int) -> Self:
        order, origin, taking, first, second = np.empty((5, modes), np.int64)
        poles, weights, own, offset = np.empty((4, modes))
        turns, vectors = np.empty((modes, 2)), np.empty((modes, modes - 1))
        return cls(order, origin, taking, first, second, poles, weights, own, offset, turns, vectors)


def held_together(poles: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Squared frequencies (modes - 1,), ascending, and orthonormal vectors (modes, modes - 1) normal to `weights`.

    poles (modes,): squared frequencies of the parts, in any order.
    """
    found, vectors = np.empty(poles.size - 1), np.empty((poles.size, poles.size - 1))
    hold_together(poles, weights, Work.of(poles.size), found, vectors)
    return found, vectors


@kernel
def hold_together(poles, weights, work, found, vectors):
    """Write what `held_together` returns."""
    size, norm = poles.size, np.sqrt(dot(weights, weights))
    _ascending(poles, work.order)
    for i in range(size):
        work.poles[i], work.weights[i] = poles[work.order[i]], weights[work.order[i]] / norm
        for k in range(size - 1):
            work.vectors[i, k] = 0.0
    turned, many = _deflated(work, found)
    apart = size - many
    own, origin, offset = work.own[:many], work.origin[: max(many - 1, 0)], work.offset[: max(many - 1, 0)]
    for i in range(many):
        own[i] = work.weights[work.taking[i]] ** 2
    kept, signs = work.poles, work.weights
    for i in range(many):  # taking ascends: nothing is overwritten that is still to come
        kept[i], signs[i] = kept[work.taking[i]], np.sign(signs[work.taking[i]])
    _roots(kept[:many], own, origin, offset)
    for k in range(offset.size):
        found[apart + k] = kept[origin[k]] + offset[k]
    _write_vectors(kept[:many], signs, origin, offset, own, work.taking, work.vectors[:, apart:])
    for turn in range(turned - 1, -1, -1):
        one, other, (cosine, sine) = work.first[turn], work.second[turn], work.turns[turn]
        for k in range(size - 1):
            before, after = work.vectors[one, k], work.vectors[other, k]
            work.vectors[one, k] = cosine * before + sine * after
            work.vectors[other, k] = cosine * after - sine * before
    ranks, sorted_out = work.origin[: size - 1], work.own[: size - 1]
    _ascending(found, ranks)
    for k in range(size - 1):
        sorted_out[k] = found[ranks[k]]
        for i in range(size):
            vectors[work.order[i], k] = work.vectors[i, ranks[k]]
    copy_to(found, sorted_out)


@inner_kernel
def _ascending(values, order):
    """Write the places of values in their order; of equal ones in that in which they stand."""
    for i in range(values.size):
        k = i
        while k > 0 and values[order[k - 1]] > values[i]:
            order[k] = order[k - 1]
            k -= 1
        order[k] = i


@inner_kernel
def _deflated(work, found):
    """Turn the weights of equal poles into one of them, in place; write roots and vectors of who is left out, and who
    takes part. Returns how many turns, and how many take part."""
    turned, apart, last = 0, 0, -1
    d, w = work.poles, work.weights
    for i in range(d.size):
        left_out = -1
        if abs(w[i]) <= LEAST_WEIGHT:
            left_out = i
        elif last >= 0 and d[i] - d[last] <= SAME_POLE * d[i]:
            length = np.hypot(w[i], w[last])
            work.first[turned], work.second[turned] = last, i
            work.turns[turned, 0], work.turns[turned, 1] = w[i] / length, w[last] / length
            turned += 1
            w[i], w[last] = length, 0.0
            left_out = last
        if left_out >= 0:
            found[apart] = d[left_out]
            work.vectors[left_out, apart] = 1.0
            apart += 1
        if left_out != i:
            last = i
    many = 0
    for i in range(d.size):
        if abs(w[i]) > LEAST_WEIGHT:
            work.taking[many] = i
            many += 1
    return turned, many


@kernel
def _sum(d, squares, pole, offset):
    """Of w_i^2 / (d_i - x) at x = d[pole] + offset."""
    total = 0.0
    for i in range(d.size):
        total += squares[i] / ((d[i] - d[pole]) - offset)
    return total


@kernel
def _roots(d, squares, origin, offset):
    """Each root as its nearer pole and the distance from there, by regula falsi (Illinois) on the sum times both."""
    for k in range(d.size - 1):
        gap = d[k + 1] - d[k]
        left = _sum(d, squares, k, 0.5 * gap) >= 0.0
        pole, other = (k, k + 1) if left else (k + 1, k)
        low, high = 0.0, (0.5 * gap if left else -0.5 * gap)  # from the pole to the middle
        width = d[other] - d[pole]
        at_low, at_high = -squares[pole] * width, 0.0
        at_high = _sum(d, squares, pole, high) * high * (width - high)
        x = high
        for step in range(MAX_ITERATIONS):
            if at_high == 0.0:
                x = high
                break
            x = (low * at_high - high * at_low) / (at_high - at_low)
            if step % 4 == 3 or not min(low, high) < x < max(low, high):
                x = 0.5 * (low + high)
            value = _sum(d, squares, pole, x) * x * (width - x)
            if value == 0.0:
                break
            if (value > 0.0) == (at_high > 0.0):
                high, at_high = x, value
                at_low *= 0.5
            else:
                low, at_low = x, value
                at_high *= 0.5
            if abs(high - low) <= 4e-16 * abs(x):
                break
        origin[k], offset[k] = pole, x


@inner_kernel
def _write_vectors(d, signs, origin, offset, weights, rows, vectors):
    """Orthonormal, (poles, poles - 1), into these rows; weights (poles,): room."""
    size = d.size
    for i in range(size):
        product = 1.0
        for k in range(size - 1):
            root = (d[origin[k]] - d[i]) + offset[k]
            product *= root / (d[k if k < i else k + 1] - d[i])
        weights[i] = signs[i] * np.sqrt(abs(product))
    for k in range(size - 1):
        square = 0.0
        for i in range(size):
            value = weights[i] / ((d[i] - d[origin[k]]) - offset[k])
            vectors[rows[i], k] = value
            square += value * value
        for i in range(size):
            vectors[rows[i], k] /= np.sqrt(square)
