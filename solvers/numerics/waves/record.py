"""What is known of every node of a chain of rods (see `network`): written step by step, read at any time."""

from typing import NamedTuple

import numpy as np

from ...jit.clock import check_time
from ...jit.kernels import inner_kernel, kernel
from .collocation import INTEGRATE, SLOPE_AT_END, SLOPE_AT_START, STAGE_NODES, STAGES, interpolate

# what is kept of every stretch, at NODES
OUT_LEFT, OUT_RIGHT, TOTAL_LEFT, TOTAL_RIGHT, FORCE, IMPULSE, DEPTH, SPEED, PLACE, LOST = range(10)
QUANTITIES = 10
POINTS = STAGES + 1
GOLDEN = 0.6180339887498949
FLAT = 1e-8  # of a stretch: closer to its top a smooth curve is flat to rounding


class Record(NamedTuple):
    """What is known of every node: start (nodes, stretches + 1), values (nodes, stretches, QUANTITIES, POINTS).

    closed (nodes, stretches): whether the faces are together; count (nodes,) stretches filled.
    """

    start: np.ndarray
    values: np.ndarray
    closed: np.ndarray
    count: np.ndarray


def new_record(nodes: int, capacity: int) -> Record:
    """An empty one, with room for so many stretches of each node; pages of memory that are never used cost nothing."""
    start = np.empty((nodes, capacity + 1))
    start[:, 0] = 0.0
    return Record(
        start,
        np.empty((nodes, capacity, QUANTITIES, POINTS)),
        np.empty((nodes, capacity), np.bool_),
        np.zeros(nodes, np.int64),
    )


@inner_kernel
def sample_at(record, node, quantity, t, after):
    """What is kept of a node at a time; at a jump the value after it, or before it if not `after`; 0 before."""
    count, start = record.count[node], record.start[node]
    if t < 0.0 or (t == 0.0 and not after) or count == 0:
        return 0.0
    low, high = 0, count
    while high - low > 1:
        middle = (low + high) // 2
        if start[middle] < t or (after and start[middle] == t):
            low = middle
        else:
            high = middle
    place = (t - start[low]) / (start[low + 1] - start[low])
    return interpolate(record.values[node, low, quantity], min(max(place, 0.0), 1.0))


@kernel
def sample(record, node, quantity, times, after, out):
    """Write what is kept of a node at `times`, as `sample_at` gives it."""
    for k in range(times.size):
        out[k] = sample_at(record, node, quantity, times[k], after)


@kernel
def square_integral(record, node, quantity, begin, end):
    """Integral of the square of a wave that a node sends, over [begin, end]."""
    total = 0.0
    for n in range(record.count[node]):
        a, b = max(begin, record.start[node, n]), min(end, record.start[node, n + 1])
        if b <= a:
            continue
        width = record.start[node, n + 1] - record.start[node, n]
        for i in range(STAGES):
            weight, place = (
                INTEGRATE[STAGES - 1, i] * (b - a),
                (a - record.start[node, n] + STAGE_NODES[i] * (b - a)) / width,
            )
            total += weight * interpolate(record.values[node, n, quantity], place) ** 2
    return total


@inner_kernel
def integral(record, node, quantity, end):
    """Of what is kept of a node, from the beginning to a time that it has come to."""
    total = 0.0
    for n in range(record.count[node]):
        begin = record.start[node, n]
        if begin >= end:
            break
        width = record.start[node, n + 1] - begin
        known = min(end - begin, width)
        for i in range(STAGES):
            value = interpolate(record.values[node, n, quantity], STAGE_NODES[i] * known / width)
            total += INTEGRATE[STAGES - 1, i] * known * value
    return total


@kernel
def integrals(record, node, quantity, times, out):
    """Write what is kept of a node, integrated from the beginning to each of `times`."""
    for k in range(times.size):
        out[k] = integral(record, node, quantity, times[k])


@kernel
def highest(record, node, quantity, first, last):
    """The largest value in the stretches first to last of a node, by golden section between the samples."""
    best = 0.0
    for n in range(first, last + 1):
        if n % 64 == 0:
            check_time()
        values = record.values[node, n, quantity]
        place, here = 0.0, values[0]
        for i in range(1, 13):
            value = interpolate(values, i / 12)
            if value > here:
                here, place = value, i / 12
        if here <= 0.9 * best:
            continue
        low, high = max(place - 1 / 12, 0.0), min(place + 1 / 12, 1.0)
        p, q = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        at_p, at_q = interpolate(values, p), interpolate(values, q)
        while high - low > FLAT:
            if at_p > at_q:
                high, q, at_q = q, p, at_p
                p = high - GOLDEN * (high - low)
                at_p = interpolate(values, p)
            else:
                low, p, at_p = p, q, at_q
                q = low + GOLDEN * (high - low)
                at_q = interpolate(values, q)
        best = max(best, here, at_p, at_q, interpolate(values, low), interpolate(values, high))
    return best


@inner_kernel
def jumped(record, state, node, tolerance):
    """Whether the last stretch begins with a jump or a bend in what the node sends, as `tolerance` resolves it."""
    n, peak = record.count[node] - 1, 0.0
    for other in range(state.largest.size):
        peak = max(peak, state.largest[other])
    least = max(0.01 * tolerance, 1e-14) * peak
    width = record.start[node, n + 1] - record.start[node, n]
    before_width = record.start[node, n] - record.start[node, n - 1] if n > 0 else width
    for quantity in (OUT_LEFT, OUT_RIGHT):
        now, bend = record.values[node, n, quantity], 0.0
        jump = now[0]
        for i in range(POINTS):
            bend += SLOPE_AT_START[i] * now[i] / width
        if n > 0:
            before = record.values[node, n - 1, quantity]
            jump -= before[STAGES]
            for i in range(POINTS):
                bend -= SLOPE_AT_END[i] * before[i] / before_width
        if abs(jump) > least or abs(bend) * min(width, before_width) > 10.0 * tolerance * peak:
            return True
    return False


@kernel
def pushed(record, node):
    """Impulse that has gone through a node so far."""
    count = record.count[node]
    return record.values[node, count - 1, IMPULSE, STAGES] if count > 0 else 0.0
