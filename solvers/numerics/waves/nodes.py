"""One step of one node of a chain of rods (see `network`): what arrives, its force, and what happens within it."""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ..arrays import copy_to
from .collocation import (
    BACK_TO_START,
    INTEGRATE,
    INTEGRATE_TWICE,
    NODES,
    STAGE_NODES,
    STAGES,
    interpolate,
    solve_in_place,
)
from .events import BENDS, NO_PULL, PARTS, TOUCHES, TURNS
from .laws import follow
from .parts import ABSORBING, FREE, LAW, PRESSED, RIGID_FACES, Chain, swings
from .record import DEPTH, FORCE, IMPULSE, LOST, OUT_LEFT, OUT_RIGHT, PLACE, POINTS, SPEED, TOTAL_LEFT, TOTAL_RIGHT

# [T] From which on the error of a step counts in full, that of a shorter one in proportion, as there are more of them.
# Smaller, and steep fronts are followed in ever shorter steps.
LONG_STEP = 1e-2
LOOK_AHEAD = 5  # stretches of a neighbour that one step may cover


class State(NamedTuple):
    """Where every node is: (nodes,) each."""

    time: np.ndarray
    depth: np.ndarray
    deepest: np.ndarray
    speed: np.ndarray  # of the mass beside it
    place: np.ndarray
    step: np.ndarray  # tried next
    largest: np.ndarray  # force so far
    opened: np.ndarray  # whether the faces have come apart since they last met
    closed: np.ndarray
    loading: np.ndarray  # whether a law with memory is on the curve of first loading
    seek_left: np.ndarray  # where the last look into the neighbour's past ended
    seek_right: np.ndarray
    breaks: np.ndarray  # (nodes, many): times at which jumps arrive, ascending
    break_count: np.ndarray
    next_break: np.ndarray
    changed: np.ndarray  # whether the next stretch may begin with a jump
    through: np.ndarray  # impulse so far; room for it
    parting: np.ndarray  # (1,): since when the impactor is apart; infinite while it touches


def new_state(chain: Chain, capacity: int) -> State:
    """Where every node is before the impact; room for so many arrivals of jumps at each."""
    nodes = chain.kind.size
    fields = {name: np.zeros(nodes) for name in State._fields}
    fields |= {name: np.zeros(nodes, np.bool_) for name in ("opened", "closed", "loading", "changed")}
    counts = ("seek_left", "seek_right", "break_count", "next_break")
    fields |= {name: np.zeros(nodes, np.int64) for name in counts}
    state = State(**fields | {"breaks": np.zeros((nodes, capacity)), "parting": np.zeros(1)})
    rewind(chain, state)
    return state


@kernel
def rewind(chain, state):
    """Put every node where it is before the impact."""
    for node in range(chain.kind.size):
        state.time[node], state.step[node] = 0.0, 1e-3
        state.depth[node], state.deepest[node], state.largest[node] = -chain.gap[node], 0.0, 0.0
        state.speed[node], state.place[node], state.through[node] = chain.mass_drift[node], 0.0, 0.0
        state.opened[node] = chain.gap[node] > 0.0
        state.closed[node] = node == chain.contact or (chain.gap[node] <= 0.0 and chain.kind[node] != LAW)
        state.loading[node] = state.changed[node] = True
        state.seek_left[node] = state.seek_right[node] = 0
        state.break_count[node] = state.next_break[node] = 0
    state.parting[0] = np.inf


@inner_kernel
def tiny(t):
    """Two times closer than this differ by rounding only."""
    return 4e-15 * max(t, 1.0)


@inner_kernel
def add_break(state, node, t):
    """A jump arrives at a node at time t; two that only rounding parts are one."""
    count = state.break_count[node]
    if count >= state.breaks.shape[1]:
        return False
    place = count
    while place > state.next_break[node] and state.breaks[node, place - 1] > t:
        place -= 1
    if place > 0 and t - state.breaks[node, place - 1] <= tiny(t):
        return True
    if place < count and state.breaks[node, place] - t <= tiny(t):
        return True
    for k in range(count, place, -1):
        state.breaks[node, k] = state.breaks[node, k - 1]
    state.breaks[node, place] = t
    state.break_count[node] = count + 1
    return True


@inner_kernel
def _arrivals(record, sender, quantity, delay, t, step, seek, arriving):
    """Fill `arriving` (POINTS,) with what `sender` sent a `delay` before t + step * NODES; returns where to look next.

    The first is the value after a jump at t, the last the value before a jump at t + step.
    """
    back, near = t - delay, tiny(t)
    if back < -near and back + step <= near:  # nothing was sent before the impact
        for i in range(POINTS):
            arriving[i] = 0.0
        return seek
    count = record.count[sender]
    start = record.start[sender]
    while seek < count - 1 and start[seek + 1] <= back + near:
        seek += 1
    look = seek
    for i in range(POINTS):
        s = back + step * NODES[i]
        while look < count - 1 and start[look + 1] < s - near:
            look += 1
        place = (s - start[look]) / (start[look + 1] - start[look])
        arriving[i] = (
            0.0 if s < -near else interpolate(record.values[sender, look, quantity], min(max(place, 0.0), 1.0))
        )
    return seek


@inner_kernel
def _freely(square, speed, place, t):
    """Speed and place of a mass a time later, without a force: see `parts.swings`."""
    if square == 0.0:
        return speed, place + t * speed
    frequency = np.sqrt(square)
    turned, still = np.sin(frequency * t), np.cos(frequency * t)
    return speed * still - place * frequency * turned, place * still + speed / frequency * turned


@inner_kernel
def _respond(square, step, work):
    """Fill `slows` and `shifts` for a step; on a spring by the same collocation, as a'' = f - square a."""
    for j in range(STAGES):
        if square == 0.0:
            for i in range(STAGES):
                work.slows[i, j] = step * INTEGRATE[i, j]
                work.shifts[i, j] = step * step * INTEGRATE_TWICE[i, j]
            continue
        for i in range(STAGES):
            work.right[i] = step * step * INTEGRATE_TWICE[i, j]
            for k in range(STAGES):
                work.matrix[i, k] = step * step * square * INTEGRATE_TWICE[i, k]
            work.matrix[i, i] += 1.0
        solve_in_place(work.matrix, work.right, STAGES)
        for i in range(STAGES):
            work.shifts[i, j] = work.right[i]
        for i in range(STAGES):
            work.slows[i, j] = step * INTEGRATE[i, j]
            for k in range(STAGES):
                work.slows[i, j] -= step * INTEGRATE[i, k] * square * work.shifts[k, j]


@inner_kernel
def _free_closing(chain, state, node, step, work):
    """Closing speed of the faces if they did not press on each other, at every point."""
    square = swings(chain, node)
    for i in range(POINTS):
        left = right = 0.0
        if node > 0:
            left = chain.drift[node - 1] + 2.0 * work.from_left[i] / chain.impedance[node - 1]
        elif chain.mass_left[node] > 0.0:
            left = state.speed[node]
        if node < chain.kind.size - 1:
            right = chain.drift[node] - 2.0 * work.from_right[i] / chain.impedance[node]
        elif chain.mass_right[node] > 0.0:
            right = _freely(square, state.speed[node], state.place[node], step * NODES[i])[0]
        work.closing[i] = left - right
        if node == chain.contact:  # what falls speeds up as a whole
            work.closing[i] += chain.fall * (state.time[node] + step * NODES[i])


@inner_kernel
def _bonded_force(rods, masses, work):
    """Force at every point that keeps the faces together."""
    work.forces[0] = work.closing[0] / rods
    if masses == 0.0:
        for i in range(1, POINTS):
            work.forces[i] = work.closing[i] / rods
        return True
    for i in range(STAGES):
        work.right[i] = work.closing[i + 1]
        for j in range(STAGES):
            work.matrix[i, j] = masses * work.slows[i, j]
        work.matrix[i, i] += rods
    good = solve_in_place(work.matrix, work.right, STAGES)
    for i in range(STAGES):
        work.forces[i + 1] = work.right[i]
    return good


@inner_kernel
def _unresolved(work, step, pressing):
    """How far the stretch is from a polynomial: of the force of a law, and of what is sent.

    Where no law is at work only the area counts, or the rounding of t would be taken for detail where a stiff contact
    sends steep fronts.
    """
    miss, miss_left, miss_right = -work.forces[0], work.from_left[0], work.from_right[0]
    for i in range(STAGES):
        miss += BACK_TO_START[i] * work.forces[i + 1]
        miss_left -= BACK_TO_START[i] * work.from_left[i + 1]
        miss_right -= BACK_TO_START[i] * work.from_right[i + 1]
    weight = min(1.0, step / LONG_STEP)
    sent = max(abs(miss_left), abs(miss_right)) * weight
    return max(abs(miss) * (1.0 if pressing else weight), sent)


@inner_kernel
def _keep(chain, state, record, node, step, work, lost_so_far, stored_change, counts_loss):
    """Write a stretch and move the node to its end."""
    n = record.count[node]
    values = record.values[node, n]
    previous = record.values[node, n - 1]
    for quantity in (TOTAL_LEFT, TOTAL_RIGHT, IMPULSE):
        values[quantity, 0] = previous[quantity, STAGES] if n > 0 else 0.0
    mass = chain.mass_left[node] if chain.mass_left[node] > 0.0 else chain.mass_right[node]
    pushed = -1.0 if chain.mass_left[node] > 0.0 else 1.0
    gain, square = (pushed / mass if mass > 0.0 else 0.0), swings(chain, node)
    values[SPEED, 0], values[PLACE, 0], values[LOST, 0] = state.speed[node], state.place[node], lost_so_far
    for i in range(POINTS):
        values[OUT_LEFT, i] = work.forces[i] - work.from_left[i]
        values[OUT_RIGHT, i] = work.forces[i] - work.from_right[i]
        values[FORCE, i] = work.forces[i]
        values[DEPTH, i] = work.depth[i]
    for i in range(STAGES):
        left, right, impulse, taken = 0.0, 0.0, 0.0, 0.0
        speed, place = _freely(square, state.speed[node], state.place[node], step * STAGE_NODES[i])
        for j in range(STAGES):
            share = step * INTEGRATE[i, j]
            left += share * values[OUT_LEFT, j + 1]
            right += share * values[OUT_RIGHT, j + 1]
            impulse += share * work.forces[j + 1]
            speed += gain * work.slows[i, j] * work.forces[j + 1]
            place += gain * work.shifts[i, j] * work.forces[j + 1]
            taken += share * work.forces[j + 1] * work.rate[j + 1]
        values[TOTAL_LEFT, i + 1] = values[TOTAL_LEFT, 0] + left
        values[TOTAL_RIGHT, i + 1] = values[TOTAL_RIGHT, 0] + right
        values[IMPULSE, i + 1] = values[IMPULSE, 0] + impulse
        values[SPEED, i + 1] = speed
        values[PLACE, i + 1] = place
        values[LOST, i + 1] = lost_so_far + (taken - stored_change[i] if counts_loss else 0.0)
    record.closed[node, n] = state.closed[node]
    state.time[node] += step
    record.start[node, n + 1] = state.time[node]
    record.count[node] = n + 1
    state.depth[node] = work.depth[STAGES]
    state.speed[node] = values[SPEED, STAGES]
    state.place[node] = values[PLACE, STAGES]


@inner_kernel
def seen(record, sender, delay, t, seek):
    """How far a step from t may go so as to look at no more than LOOK_AHEAD of the sender's stretches.

    Whatever the sender resolved, a short pulse say, its neighbour then cannot step across.
    """
    count, start, back = record.count[sender], record.start[sender], t - delay
    if count <= LOOK_AHEAD:
        return np.inf
    while seek < count - 1 and start[seek + 1] <= back + tiny(t):
        seek += 1
    last = seek + LOOK_AHEAD
    return start[last] - back if last < count else np.inf


@inner_kernel
def _given_force(pulse, t, step, forces):
    """Fill `forces` (POINTS,) of a step within one piece of a pulse (pieces, 2 + POINTS), see `network.solve`."""
    middle, low, high = t + 0.5 * step, 0, pulse.shape[0]  # the force may jump at the ends of the step
    while high - low > 1:
        half = (low + high) // 2
        if pulse[half, 0] <= middle:
            low = half
        else:
            high = half
    begin, end = pulse[low, 0], pulse[low, 1]
    for i in range(POINTS):
        place = min(max((t + step * NODES[i] - begin) / (end - begin), 0.0), 1.0)
        forces[i] = interpolate(pulse[low, 2:], place) if middle < end else 0.0


@inner_kernel
def prepare(chain, state, record, node, step, work):
    """Arriving waves and free closing speed of the next step of a node, and what forces do to the mass beside it."""
    t = state.time[node]
    if chain.mass_left[node] + chain.mass_right[node] > 0.0:
        _respond(swings(chain, node), step, work)
    work.from_left[:] = 0.0  # nothing arrives at an end from where no rod is
    work.from_right[:] = 0.0
    if node > 0:
        state.seek_left[node] = _arrivals(
            record,
            node - 1,
            np.int64(OUT_RIGHT),
            chain.transit[node - 1],
            t,
            step,
            state.seek_left[node],
            work.from_left,
        )
    if node < chain.kind.size - 1:
        state.seek_right[node] = _arrivals(
            record, node + 1, np.int64(OUT_LEFT), chain.transit[node], t, step, state.seek_right[node], work.from_right
        )
    _free_closing(chain, state, node, step, work)


@inner_kernel
def simple_forces(chain, state, node, rods, masses, pulse, step, work):
    """Force, depth and rate of one step where no law is at work."""
    kind, good = chain.kind[node], True
    if kind == ABSORBING:
        copy_to(work.forces, work.from_left)
    elif kind == PRESSED:
        _given_force(pulse, state.time[node], step, work.forces)
    elif kind == FREE or not state.closed[node]:
        for i in range(POINTS):
            work.forces[i] = 0.0
    else:
        good = _bonded_force(rods, masses, work)
    follow(rods, masses, state.depth[node], step, work)
    return good


@inner_kernel
def share_of_error(state, tolerance, step, pressing, work):
    """Of the step as a share of what is allowed, and the largest force so far."""
    peak = 0.0
    for other in range(state.largest.size):
        peak = max(peak, state.largest[other])
    for i in range(POINTS):
        peak = max(peak, abs(work.forces[i]), abs(work.from_left[i]), abs(work.from_right[i]))
    return (_unresolved(work, step, pressing) / (tolerance * peak) if peak > 0.0 else 0.0), peak


@inner_kernel
def finish(chain, state, record, node, counts_loss, remembers, dent, step, ends, work):
    """Write the stretch just solved and take over what it changed."""
    n = record.count[node]
    lost = record.values[node, n - 1, LOST, STAGES] if n > 0 else 0.0
    for i in range(POINTS):
        state.largest[node] = max(state.largest[node], abs(work.forces[i]))
        if not state.closed[node] and work.depth[i] < dent - NO_PULL:
            state.opened[node] = True
    _keep(chain, state, record, node, step, work, lost, work.right, counts_loss)
    if remembers:
        state.deepest[node] = max(state.deepest[node], state.depth[node])
        if ends == BENDS:
            state.loading[node] = state.depth[node] >= state.deepest[node]
        elif ends in (TURNS, PARTS):
            state.loading[node] = False
    if ends == PARTS:
        state.closed[node], state.opened[node] = False, False
        if chain.kind[node] == RIGID_FACES:
            state.depth[node] = 0.0
    elif ends == TOUCHES:
        state.closed[node] = True
        if state.opened[node]:
            state.depth[node] = dent
