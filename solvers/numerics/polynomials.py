"""Polynomials in kernels: ascending coefficients, degree = len - 1; and all their real roots on an interval."""

from typing import NamedTuple

import numpy as np

from ..jit.kernels import inner_kernel
from .quadrature import gauss

SPLITS = np.array([0.4872, 0.4139, 0.5571, 0.3433])  # tried in turn
GAUSS_NODES, GAUSS_WEIGHTS = gauss(16)
MAX_INTERVALS = 64  # of a search for roots, that wait; halved 50 times they are nothing


class RootWork(NamedTuple):
    """Room for `roots`: Bernstein coefficients of the intervals that wait, their left ends and widths."""

    rows: np.ndarray  # (MAX_INTERVALS, terms)
    left: np.ndarray  # (MAX_INTERVALS,)
    width: np.ndarray  # (MAX_INTERVALS,)
    scaled: np.ndarray  # (terms,)

    @classmethod
    def of(cls, terms: int) -> "RootWork":
        return cls(np.empty((MAX_INTERVALS, terms)), np.empty(MAX_INTERVALS), np.empty(MAX_INTERVALS), np.empty(terms))


@inner_kernel
def value(coefficients, degree, x):
    total = coefficients[degree]
    for k in range(degree - 1, -1, -1):
        total = total * x + coefficients[k]
    return total


@inner_kernel
def shift(coefficients, degree, by, shifted):
    """Write the coefficients of p(by + x) into `shifted` (Taylor shift by repeated synthetic division)."""
    for k in range(degree + 1):
        shifted[k] = coefficients[k]
    for k in range(degree):
        for j in range(degree - 1, k - 1, -1):
            shifted[j] += by * shifted[j + 1]


@inner_kernel
def trim(coefficients, degree, reach):
    """The degree without the tail that no double can see for |x| <= reach."""
    largest, power = 0.0, 1.0
    for k in range(degree + 1):
        largest = max(largest, abs(coefficients[k]) * power)
        power *= reach
    while degree > 0:
        power /= reach
        if abs(coefficients[degree]) * power > 1e-20 * largest:
            break
        degree -= 1
    return degree


@inner_kernel
def roots(coefficients, degree, length, found, work):
    """Every root of the polynomial in (0, length), ascending, into `found`; returns how many.

    Bernstein coefficients bound the number of roots by their sign changes; splitting until at most one is left misses
    none, however close two of them lie. Two roots closer than 1e-14 of the length count as one.
    """
    stack, left, width, scaled = work
    power = 1.0
    for k in range(degree + 1):
        scaled[k] = coefficients[k] * power
        power *= length
    for j in range(degree + 1):  # monomial to Bernstein: b_j = sum_k C(j, k) / C(n, k) a_k
        ratio, total = 1.0, 0.0
        for k in range(j + 1):
            total += ratio * scaled[k]
            ratio *= (j - k) / (degree - k) if k < degree else 0.0
        stack[0, j] = total
    left[0], width[0] = 0.0, 1.0
    top, count = 1, 0
    while top > 0:
        top -= 1
        row = stack[top]
        changes, sign, largest = 0, 0.0, 0.0
        for j in range(degree + 1):
            largest = max(largest, abs(row[j]))
            if row[j] != 0.0:
                if row[j] * sign < 0.0:
                    changes += 1
                sign = 1.0 if row[j] > 0.0 else -1.0
        if changes == 0:
            continue
        if changes == 1 or width[top] < 1e-14:
            a, b = left[top] * length, (left[top] + width[top]) * length
            if count < found.size:
                found[count] = bracketed_root(coefficients, degree, a, b, sign > 0.0)
                count += 1
            continue
        # split by de Casteljau, not where a root happens to lie: there the sign is a matter of rounding
        part = SPLITS[0]
        for k in range(SPLITS.size):
            part = SPLITS[k]
            for j in range(degree + 1):
                stack[top + 1, j] = row[j]
            for level in range(1, degree + 1):
                for j in range(degree, level - 1, -1):
                    stack[top + 1, j] = part * stack[top + 1, j] + (1.0 - part) * stack[top + 1, j - 1]
            if abs(stack[top + 1, degree]) > 1e-13 * largest:
                break
        # the right piece stays in place, the left piece goes on top and is looked at first
        for level in range(degree):
            for j in range(degree - level):
                row[j] = (1.0 - part) * row[j] + part * row[j + 1]
        left[top + 1], width[top + 1] = left[top], part * width[top]
        left[top], width[top] = left[top] + part * width[top], (1.0 - part) * width[top]
        top += 2
        if top > MAX_INTERVALS - 2:
            break
    return count


@inner_kernel
def bracketed_root(coefficients, degree, a, b, rising):
    """The only root in [a, b], where the polynomial rises or falls, by Newton's method kept inside by halving."""
    x = 0.5 * (a + b)
    for _ in range(200):
        p, slope = coefficients[degree], 0.0
        for k in range(degree - 1, -1, -1):
            slope = slope * x + p
            p = p * x + coefficients[k]
        if p == 0.0:
            return x
        if (p > 0.0) != rising:
            a = x
        else:
            b = x
        following = x - p / slope if slope != 0.0 else a
        if not a < following < b:
            following = 0.5 * (a + b)
        if abs(following - x) <= 1e-16 * abs(x) or b - a <= 2e-16 * abs(b):
            return following
        x = following
    return x
