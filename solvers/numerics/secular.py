"""Oscillators held together at one place: modes of a diagonal stiffness on the plane that is normal to one vector.

Between two frequencies of the parts lies one of the whole: a root of sum w_i^2 / (d_i - x) = 0, found from the nearer
of the two, so that it keeps its digits however close it is. Cost: O(modes^2); a dense problem takes O(modes^3).
Source: Gu and Eisenstat (1995), for the weights that belong to the roots as rounding left them, which make the vectors
orthogonal.
"""

import numpy as np

from ..jit.kernels import allocating_kernel, kernel

SAME_POLE = 1e-13  # relative difference of two poles that are taken as one
LEAST_WEIGHT = 1e-15  # of the norm of the weights: who is moved by less takes no part
MAX_ITERATIONS = 200  # of a root: fifty of them halve the interval, whatever the others bring


def held_together(poles: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Squared frequencies (modes - 1,), ascending, and orthonormal vectors (modes, modes - 1) normal to `weights`.

    poles (modes,): squared frequencies of the parts, in any order.
    """
    order = np.argsort(poles, kind="stable")
    d, w = poles[order], weights[order] / np.linalg.norm(weights)
    turns, apart = _deflated(d, w)
    taking = np.setdiff1d(np.arange(d.size), apart)
    origin, offset = np.empty(max(taking.size - 1, 0), np.int64), np.empty(max(taking.size - 1, 0))
    vectors = np.zeros((d.size, d.size - 1))
    found = np.append(d[apart], np.zeros(offset.size))
    vectors[apart, np.arange(apart.size)] = 1.0
    own = d[taking]
    _roots(own, w[taking] ** 2, origin, offset)
    found[apart.size :] = own[origin] + offset
    vectors[taking, apart.size :] = _vectors(own, np.sign(w[taking]), origin, offset)
    for one, other, cosine, sine in reversed(turns):
        rows = vectors[one].copy(), vectors[other].copy()
        vectors[one], vectors[other] = cosine * rows[0] + sine * rows[1], cosine * rows[1] - sine * rows[0]
    ascending = np.argsort(found, kind="stable")
    back = np.empty_like(order)
    back[order] = np.arange(order.size)
    return found[ascending], np.ascontiguousarray(vectors[back][:, ascending])


def _deflated(d: np.ndarray, w: np.ndarray) -> tuple[list[tuple[int, int, float, float]], np.ndarray]:
    """Turns the weights (modes,) of equal poles into one of them, in place. Returns the turns, and who is left out."""
    turns, apart, last = [], [], -1
    for i in range(d.size):
        if abs(w[i]) <= LEAST_WEIGHT:
            apart.append(i)
            continue
        if last >= 0 and d[i] - d[last] <= SAME_POLE * d[i]:
            length = np.hypot(w[i], w[last])
            turns.append((last, i, w[i] / length, w[last] / length))
            w[i], w[last] = length, 0.0
            apart.append(last)
        last = i
    return turns, np.array(apart, np.int64)


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


@allocating_kernel
def _vectors(d, signs, origin, offset):
    """Orthonormal, (poles, poles - 1)."""
    size = d.size
    vectors, weights = np.empty((size, size - 1)), np.empty(size)
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
            vectors[i, k] = value
            square += value * value
        for i in range(size):
            vectors[i, k] /= np.sqrt(square)
    return vectors
