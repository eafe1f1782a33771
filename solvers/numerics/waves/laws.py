"""What a contact law does in one step of a node of a chain of rods (see `network`).

These few functions are compiled for every law; the network itself is compiled once and calls them by their address.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numba import types

from ...jit.kernels import address, inner_kernel, kernel
from .collocation import INTEGRATE, INTEGRATE_TWICE, STAGES, solve_in_place
from .record import POINTS

DENT, CORNER, STORED, PRESS = range(4)  # what a law is asked for
SIGNATURE = types.float64(
    types.int64, types.Array(types.float64, 1, "C"), *[types.float64] * 6, types.Array(types.float64, 2, "C")
)


class Work(NamedTuple):
    """Room for one step of one node: views of the rows of one array."""

    from_left: np.ndarray  # (POINTS,) arriving waves
    from_right: np.ndarray
    closing: np.ndarray  # (POINTS,) closing speed if there were no force
    forces: np.ndarray  # (POINTS,); not `force`, which is a method of laws
    depth: np.ndarray  # (POINTS,)
    rate: np.ndarray  # (POINTS,)
    right: np.ndarray
    matrix: np.ndarray  # its first STAGES columns
    rows: np.ndarray  # all of it


def _work_in(rows):
    return Work(rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7:], rows)


work_in = inner_kernel(_work_in)


def new_work() -> Work:
    return _work_in(np.zeros((7 + STAGES, POINTS)))


@lru_cache
def law_function(kind: type) -> Callable:
    """`ask` of a contact law by its address: compiled for this kind of law, called by kernels that are not."""
    count = len(kind._fields)

    @kernel
    def asked(question, constants, rods, masses, depth, deepest, guess, step, rows):
        c = constants
        law = kind(*(c[0], c[1], c[2], c[3], c[4], c[5])[:count])
        return ask(law, question, rods, masses, depth, deepest, guess, step, rows)

    return address(asked, SIGNATURE)


@inner_kernel
def follow(rods, masses, depth, step, work):
    """Depth and rate at every point from the force."""
    work.depth[0], work.rate[0] = depth, work.closing[0] - rods * work.forces[0]
    for i in range(STAGES):
        a, slowed = depth, 0.0
        for j in range(STAGES):
            a += step * INTEGRATE[i, j] * (work.closing[j + 1] - rods * work.forces[j + 1])
            a -= masses * step * step * INTEGRATE_TWICE[i, j] * work.forces[j + 1]
            slowed += masses * step * INTEGRATE[i, j] * work.forces[j + 1]
        work.depth[i + 1] = a
        work.rate[i + 1] = work.closing[i + 1] - rods * work.forces[i + 1] - slowed


@inner_kernel
def _first_force(law, rods, depth, closing, deepest, guess):
    """Force at the start of a stretch: of a law that depends on the rate, the root of one increasing equation."""
    force = law.force(depth, closing - rods * guess, deepest)
    if force == guess:
        return force
    low, high = 0.0, max(law.force(depth, closing, deepest), 0.0)
    force = min(max(guess, low), high)
    for _ in range(100):
        miss = force - law.force(depth, closing - rods * force, deepest)
        if miss > 0.0:
            high = force
        else:
            low = force
        slope = 1.0 + rods * law.slopes(depth, closing - rods * force, deepest)[1]
        following = force - miss / slope
        if not low <= following <= high:
            following = 0.5 * (low + high)
        if abs(following - force) <= 2e-16 * abs(force):
            return following
        force = following
    return force


@inner_kernel
def _law_force(law, rods, masses, depth, deepest, step, work):
    """Force at every point from a contact law, by Newton's method on all stages at once."""
    settled, before = False, np.inf
    for _ in range(40):
        follow(rods, masses, depth, step, work)
        if settled:
            return True
        for i in range(STAGES):
            by_depth, by_rate = law.slopes(work.depth[i + 1], work.rate[i + 1], deepest)
            work.right[i] = law.force(work.depth[i + 1], work.rate[i + 1], deepest) - work.forces[i + 1]
            for j in range(STAGES):
                drop = step * INTEGRATE[i, j] * rods + masses * step * step * INTEGRATE_TWICE[i, j]
                work.matrix[i, j] = by_depth * drop + by_rate * masses * step * INTEGRATE[i, j]
            work.matrix[i, i] += 1.0 + by_rate * rods
        if not solve_in_place(work.matrix, work.right, STAGES):
            return False
        largest, change = 0.0, 0.0
        for i in range(STAGES):
            work.forces[i + 1] += work.right[i]
            largest = max(largest, abs(work.forces[i + 1]))
            change = max(change, abs(work.right[i]))
        if not change < np.inf:
            return False
        # rounding in the rate is magnified by strong damping: then the corrections stop falling before they vanish
        settled = change <= 1e-14 * largest + 1e-300 or (change <= 1e-9 * largest + 1e-12 and change > 0.25 * before)
        before = change
    return False


@inner_kernel
def ask(law, question, rods, masses, depth, deepest, guess, step, rows):
    """Answer what the network asks of a law; of energies and forces the answer is in `rows`.

    STORED: the energy given back from each stage's depth, less that from `depth`, into `right`. PRESS: force, depth and
    rate of one step at every point; 0 if no solution was found.
    """
    if question == DENT:
        return law.dent(deepest)
    if question == CORNER:
        return law.corner(depth, deepest)
    work = work_in(rows)
    if question == STORED:
        stored = law.stored(depth, deepest)
        for i in range(STAGES):
            work.right[i] = law.stored(work.depth[i + 1], max(deepest, work.depth[i + 1])) - stored
        return 1.0
    inside = max(depth, 1e-300)  # faces that have just met press already, if the law's force jumps at touch
    work.forces[0] = _first_force(law, rods, inside, work.closing[0], deepest, guess)
    for i in range(1, POINTS):
        work.forces[i] = work.forces[0]
    return 1.0 if _law_force(law, rods, masses, depth, deepest, step, work) else 0.0
