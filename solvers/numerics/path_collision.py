"""Two compact bodies pressed together by a law without damping, with or without memory: mu a'' = -F, as kernels.

The deepest indentation is where the work of loading has used up the energy; unloading gives back what is stored. Every
stretch with one formula is integrated by itself, in a variable in which it is smooth, so that the error is rounding.
"""

import math

import numpy as np
from numba.extending import register_jitable

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from .quadrature import gauss_within
from .waves.laws import CORNER, DENT, FORCE, STORED

CELLS = 200  # of each stretch of the path on which the law has one formula
# Last over first indentation of such a stretch: over more, a power is no polynomial in each cell.
WIDEST = 100.0
STAGES = 6  # of the quadrature in each cell
STRETCHES = 12  # at most: a power without a corner has one, a plastic law three, and one more for every WIDEST
_NODES, _WEIGHTS, _INTEGRATE = gauss_within(STAGES)


@register_jitable
def instants(stretches: int) -> int:
    """Of a path of so many stretches of loading: those of unloading with them."""
    return (stretches + 1) * CELLS + 1


@inner_kernel
def _cell(ask, constants, slopes, path, cell, pull, run):
    """Work and run of the path from `high` down to `low` at each node of a cell: see `_fallen`. Returns their sum."""
    low, high, deepest, top, bottom = path
    work = 0.0
    for j in range(STAGES):
        u = (cell + _NODES[j]) / CELLS
        share, change = (1.0 - u * u, 2.0 * u) if top else (1.0 - u, 1.0)
        place = low + (high - low) * (share**3 if bottom else share)
        run[j] = (high - low) * (3.0 * share**2 * change if bottom else change) / CELLS
        pull[j] = ask(FORCE, constants, place, 0.0, deepest, slopes) * run[j]
        work += pull[j] * _WEIGHTS[j]
    return work


@inner_kernel
def _work(ask, constants, slopes, low, high, cell):
    """Of loading from one indentation to another, with one formula in between."""
    check_time()
    done, no = 0.0, np.bool_(False)
    for k in range(CELLS):
        done += _cell(ask, constants, slopes, (low, high, 0.0, no, low == 0.0), k, cell[0], cell[1])
    return done


@inner_kernel
def _reached(ask, constants, slopes, low, high, energy, cell):
    """The indentation at which the work from `low` is this energy, by Newton from above: the force of loading grows."""
    depth = high
    for _ in range(100):
        miss = _work(ask, constants, slopes, low, depth, cell) - energy
        force = ask(FORCE, constants, depth, 0.0, 0.0, slopes)
        before, depth = depth, min(max(depth - miss / force, 0.5 * (low + depth)), high)
        if abs(depth - before) <= 1e-15 * depth:
            break
    return depth


@kernel
def stretches(ask, constants, slopes, energy, cell, edges):
    """Write the edges (STRETCHES + 1,) of those of loading, down from zero to the deepest indentation; how many.

    ask: `waves.laws.law_function`; slopes: room for it (2,); cell: room (2, STAGES). -1: no room.
    """
    edges[0] = done = 0.0
    for k in range(edges.size - 1):
        low = edges[k]
        high = ask(CORNER, constants, low, 0.0, 0.0, slopes)
        if low > 0.0:
            high = min(high, WIDEST * low)
        if high == math.inf:
            high = 1e-9
            while _work(ask, constants, slopes, low, high, cell) < energy:
                high *= 2.0
        more = _work(ask, constants, slopes, low, high, cell)
        edges[k + 1] = high
        if done + more >= energy:
            edges[k + 1] = _reached(ask, constants, slopes, low, high, energy - done, cell)
            return k + 1
        done += more
    return -1


@inner_kernel
def _fallen(ask, constants, slopes, path, given, mass, cell, begin, way, course):
    """Back down a stretch of the curve: into `course`, from its instant `begin` on by `way`, time since the very top,
    indentation, and, as its rate, the work given back since there.

    path: indentations `low` and `high`, the deepest before, whether it begins at the top, where the rate starts as a
    square root, and ends at the bottom, where the force ends as a power: the variable u runs over both smoothly. given:
    what has been given back above it [J].
    """
    check_time()
    low, high, _, top, bottom = path
    above, time, at = given, course.time[begin], begin
    course.indentation[at], course.rate[at] = high, above
    for k in range(CELLS):
        work = _cell(ask, constants, slopes, path, k, cell[0], cell[1])
        for i in range(STAGES):
            inside = 0.0
            for j in range(STAGES):
                inside += _INTEGRATE[i, j] * cell[0][j]
            time += cell[1][i] * _WEIGHTS[i] / math.sqrt(2.0 / mass * (above + inside))
        above += work
        u = (k + 1) / CELLS
        share = 1.0 - u * u if top else 1.0 - u
        at += way
        course.time[at], course.rate[at] = time, above
        course.indentation[at] = low + (high - low) * (share**3 if bottom else share)
    return above


@kernel
def follow_path(ask, constants, slopes, mass, speed, cell, edges, course):
    """The whole contact at `instants` of these stretches, see there; edges: as many as they have."""
    loading, energy, deepest = edges.size - 1, 0.5 * mass * speed**2, edges[edges.size - 1]
    top, yes = loading * CELLS, np.bool_(True)
    course.time[top] = given = 0.0
    dent = ask(DENT, constants, 0.0, 0.0, deepest, slopes)
    _fallen(ask, constants, slopes, (dent, deepest, deepest, yes, yes), 0.0, mass, cell, top, 1, course)
    for k in range(loading):
        path = edges[loading - k - 1], edges[loading - k], 0.0, k == 0, k == loading - 1
        given = _fallen(ask, constants, slopes, path, given, mass, cell, top - k * CELLS, -1, course)
    rise = course.time[0]
    held = ask(STORED, constants, deepest, 0.0, deepest, slopes)
    for k in range(course.time.size):
        depth, fast, rising = course.indentation[k], 2.0 / mass * course.rate[k], k <= top
        course.time[k] = rise - course.time[k] if rising else rise + course.time[k]
        course.rate[k] = math.sqrt(fast) if rising else -math.sqrt(fast)
        course.force[k] = ask(FORCE, constants, depth, 0.0, 0.0 if rising else deepest, slopes)
        course.stored[k] = ask(STORED, constants, depth, 0.0, depth if rising else deepest, slopes)
        kept = 0.5 * mass * fast + course.stored[k] if rising else held
        course.lost[k], course.impulse[k] = max(energy - kept, 0.0), mass * (speed - course.rate[k])
