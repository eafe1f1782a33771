"""What a contact law does in one step of a node of a chain of rods (see `network`).

One small function is compiled for every law; all else is compiled once and calls it by its address.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numba import types

from ...jit.kernels import address, addressed_kernel, inner_kernel
from ..law_functions import CONSTANTS, one_of
from .collocation import INTEGRATE, STAGES, solve_in_place
from .record import POINTS

DENT, CORNER, STORED, FORCE = range(4)  # what a law is asked for
_ROW = types.Array(types.float64, 1, "C")
SIGNATURE = types.float64(types.int64, _ROW, *[types.float64] * 3, _ROW)


class Work(NamedTuple):
    """Room for one step of one node: views of the rows of one array."""

    from_left: np.ndarray  # (POINTS,) arriving waves
    from_right: np.ndarray
    closing: np.ndarray  # (POINTS,) closing speed if there were no force
    forces: np.ndarray  # (POINTS,); not `force`, which is a method of laws
    depth: np.ndarray  # (POINTS,)
    rate: np.ndarray  # (POINTS,)
    right: np.ndarray
    slopes: np.ndarray  # (2,) of the force, by depth and rate
    matrix: np.ndarray  # its first STAGES columns
    slows: np.ndarray  # (STAGES, POINTS): what a force at each stage has done to the speed of a unit mass at another
    shifts: np.ndarray  # the same to its place


def new_work() -> Work:
    rows = np.zeros((8 + 3 * STAGES, POINTS))
    matrix, slows, shifts = (rows[8 + k * STAGES : 8 + (k + 1) * STAGES] for k in range(3))
    return Work(*rows[:7], slopes=rows[7], matrix=matrix, slows=slows, shifts=shifts)


def law_kernel(kind: type) -> Callable:
    """A contact law as a kernel: takes the question, the law's constants, depth, rate, deepest, and room for the
    slopes, which it writes where the question is FORCE."""
    count = len(kind._fields)

    @addressed_kernel
    def asked(question, constants, depth, rate, deepest, slopes):
        c = constants
        law = kind(*(c[0], c[1], c[2], c[3], c[4], c[5])[:count])
        if question == FORCE:
            slopes[0], slopes[1] = law.slopes(depth, rate, deepest)
            return law.force(depth, rate, deepest)
        if question == DENT:
            return law.dent(deepest)
        return law.corner(depth, deepest) if question == CORNER else law.stored(depth, deepest)

    return asked


def any_law(kinds: Sequence[type]) -> Callable:
    """The same for several sorts of laws, by the number of one among `kinds` that follows its CONSTANTS."""

    chosen = one_of([law_kernel(kind) for kind in kinds])

    @inner_kernel
    def asked(question, constants, depth, rate, deepest, slopes):
        return chosen(int(constants[CONSTANTS]), question, constants, depth, rate, deepest, slopes)

    return asked


@lru_cache
def law_function(kind: type) -> Callable:
    """The same by its address."""
    return address(law_kernel(kind), SIGNATURE)


@inner_kernel
def follow(rods, masses, depth, step, work):
    """Depth and rate at every point from the force."""
    work.depth[0], work.rate[0] = depth, work.closing[0] - rods * work.forces[0]
    for i in range(STAGES):
        a, slowed = depth, 0.0
        for j in range(STAGES):
            a += step * INTEGRATE[i, j] * (work.closing[j + 1] - rods * work.forces[j + 1])
            a -= masses * work.shifts[i, j] * work.forces[j + 1]
            slowed += masses * work.slows[i, j] * work.forces[j + 1]
        work.depth[i + 1] = a
        work.rate[i + 1] = work.closing[i + 1] - rods * work.forces[i + 1] - slowed


@inner_kernel
def _first_force(law, constants, rods, depth, closing, deepest, guess, slopes):
    """Force at the start of a stretch: of a law that depends on the rate, the root of one increasing equation."""
    force = law(FORCE, constants, depth, closing - rods * guess, deepest, slopes)
    if force == guess:
        return force
    low, high = 0.0, max(law(FORCE, constants, depth, closing, deepest, slopes), 0.0)
    force = min(max(guess, low), high)
    for _ in range(100):
        miss = force - law(FORCE, constants, depth, closing - rods * force, deepest, slopes)
        if miss > 0.0:
            high = force
        else:
            low = force
        following = force - miss / (1.0 + rods * slopes[1])
        if not low <= following <= high:
            following = 0.5 * (low + high)
        if abs(following - force) <= 2e-16 * abs(force):
            return following
        force = following
    return force


@inner_kernel
def press(law, constants, rods, masses, depth, deepest, guess, step, work):
    """Force, depth and rate of one step at every point from a contact law, by Newton's method on all stages at once;
    whether a solution was found."""
    inside = max(depth, 1e-300)  # faces that have just met press already, if the law's force jumps at touch
    first = _first_force(law, constants, rods, inside, work.closing[0], deepest, guess, work.slopes)
    for i in range(POINTS):
        work.forces[i] = first
    settled, before = False, np.inf
    for _ in range(40):
        follow(rods, masses, depth, step, work)
        if settled:
            return True
        for i in range(STAGES):
            force = law(FORCE, constants, work.depth[i + 1], work.rate[i + 1], deepest, work.slopes)
            work.right[i] = force - work.forces[i + 1]
            for j in range(STAGES):
                drop = step * INTEGRATE[i, j] * rods + masses * work.shifts[i, j]
                work.matrix[i, j] = work.slopes[0] * drop + work.slopes[1] * masses * work.slows[i, j]
            work.matrix[i, i] += 1.0 + work.slopes[1] * rods
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
def store(law, constants, depth, deepest, work):
    """The energy given back from each stage's depth, less that from `depth`, into `right`."""
    stored = law(STORED, constants, depth, 0.0, deepest, work.slopes)
    for i in range(STAGES):
        reached = max(deepest, work.depth[i + 1])
        work.right[i] = law(STORED, constants, work.depth[i + 1], 0.0, reached, work.slopes) - stored
