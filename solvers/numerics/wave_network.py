"""Waves in a chain of rods: every rod end a node, every node a small equation with delays.

A rod carries two force waves: one sent by its left end, which arrives at its right end a transit time later, and one
the other way. With f arriving, a rod end under the compressive force F sends F - f back into the rod and moves at

    v0 + (2 f - F) / Z  at a right end,    v0 + (F - 2 f) / Z  at a left end,                       (4.17), (4.18)

a rigid mass at v' = -F / m or F / m. A node joins a left and a right body by a condition on F and on the closing speed
a' = v_left - v_right: F = 0 at a free end, a' = 0 where they are bonded or press on each other as rigid faces,
F = law(a, a') through a contact law. What arrives was sent a transit time ago, so that nodes know nothing of each
other's present: each goes its own way, the one furthest behind first. Stretches between events, and between the
arrivals of jumps, are smooth: a collocation polynomial each. Any consistent units.
"""

from typing import NamedTuple

import numpy as np

from ..jit import kernel
from .collocation import (
    BACK_TO_START,
    INTEGRATE,
    INTEGRATE_TWICE,
    NODES,
    SLOPE_AT_END,
    SLOPE_AT_START,
    STAGE_NODES,
    STAGES,
    interpolate,
    solve_in_place,
)

# what holds at a node
FREE, ABSORBING, PRESSED, BONDED, RIGID_FACES, LAW = range(6)
# how a solve ended
PARTED, STOPPED, FULL, FAILED = range(4)
# what is kept of every stretch, at NODES
OUT_LEFT, OUT_RIGHT, TOTAL_LEFT, TOTAL_RIGHT, FORCE, IMPULSE, DEPTH, SPEED, PLACE, LOST = range(10)
QUANTITIES = 10
POINTS = STAGES + 1
LONG_STEP, SHORT_STEP = 1e-2, 1e-7
LOOKS = 24  # into each stretch, for events
LOOK_AHEAD = 5  # stretches of a neighbour that one step may cover
NO_PULL = 1e-12  # force that rigid faces may pull with before they part; depth they may press in before they touch


class Chain(NamedTuple):
    """Nodes 0 to n joined by n rods, rod i between nodes i and i + 1.

    impedance, transit, drift (rods,): Z, L / c and the velocity before the blow; kind (nodes,); mass_left, mass_right
    (nodes,): a rigid body beside the node, 0 for none, infinite for a wall; mass_drift (nodes,), its first velocity;
    gap (nodes,): between the faces before the blow; contact: the node that the impactor strikes.
    """

    impedance: np.ndarray
    transit: np.ndarray
    drift: np.ndarray
    kind: np.ndarray
    mass_left: np.ndarray
    mass_right: np.ndarray
    mass_drift: np.ndarray
    gap: np.ndarray
    contact: int


class Record(NamedTuple):
    """What is known of every node: start (nodes, stretches + 1), values (nodes, stretches, QUANTITIES, POINTS).

    closed (nodes, stretches): whether the faces are together; count (nodes,) stretches filled.
    """

    start: np.ndarray
    values: np.ndarray
    closed: np.ndarray
    count: np.ndarray


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


class Work(NamedTuple):
    """Room for one step of one node."""

    from_left: np.ndarray  # (POINTS,) arriving waves
    from_right: np.ndarray
    closing: np.ndarray  # (POINTS,) closing speed if there were no force
    forces: np.ndarray  # (POINTS,); not `force`, which is a method of laws
    depth: np.ndarray  # (POINTS,)
    rate: np.ndarray  # (POINTS,)
    matrix: np.ndarray
    right: np.ndarray


@kernel
def new_record(nodes, capacity):
    return Record(
        np.zeros((nodes, capacity + 1)),
        np.zeros((nodes, capacity, QUANTITIES, POINTS)),
        np.zeros((nodes, capacity), np.bool_),
        np.zeros(nodes, np.int64),
    )


@kernel
def _new_state(chain, capacity):
    nodes = chain.kind.size
    state = State(
        np.zeros(nodes),
        -chain.gap,
        np.zeros(nodes),
        chain.mass_drift.copy(),
        np.zeros(nodes),
        np.full(nodes, 1e-3),
        np.zeros(nodes),
        chain.gap > 0.0,
        chain.gap <= 0.0,
        np.ones(nodes, np.bool_),
        np.zeros(nodes, np.int64),
        np.zeros(nodes, np.int64),
        np.zeros((nodes, capacity)),
        np.zeros(nodes, np.int64),
        np.zeros(nodes, np.int64),
    )
    for node in range(nodes):
        if chain.kind[node] == LAW:
            state.closed[node] = False
    state.closed[chain.contact] = True
    return state


@kernel
def _new_work():
    return Work(
        np.zeros(POINTS),
        np.zeros(POINTS),
        np.zeros(POINTS),
        np.zeros(POINTS),
        np.zeros(POINTS),
        np.zeros(POINTS),
        np.zeros((STAGES, STAGES)),
        np.zeros(STAGES),
    )


@kernel
def _tiny(t):
    """Two times closer than this are told apart by rounding only."""
    return 4e-15 * max(t, 1.0)


@kernel
def add_break(state, node, t):
    """A jump arrives at a node at time t; two that only rounding parts are one."""
    count = state.break_count[node]
    if count >= state.breaks.shape[1]:
        return False
    place = count
    while place > state.next_break[node] and state.breaks[node, place - 1] > t:
        place -= 1
    if place > 0 and t - state.breaks[node, place - 1] <= _tiny(t):
        return True
    if place < count and state.breaks[node, place] - t <= _tiny(t):
        return True
    for k in range(count, place, -1):
        state.breaks[node, k] = state.breaks[node, k - 1]
    state.breaks[node, place] = t
    state.break_count[node] = count + 1
    return True


@kernel
def _arrivals(record, sender, quantity, delay, t, step, seek, arriving):
    """Fill `arriving` (POINTS,) with what `sender` sent a `delay` before t + step * NODES; returns where to look next.

    The first is the value after a jump at t, the last the value before a jump at t + step.
    """
    back, near = t - delay, _tiny(t)
    if back < -near and back + step <= near:  # nothing was sent before the blow
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


@kernel
def _mobility(chain, node):
    """Of the bodies beside a node: 1 / Z summed over its rods, 1 / m over its masses."""
    rods, masses = 0.0, 0.0
    if node > 0:
        rods += 1.0 / chain.impedance[node - 1]
    if node < chain.kind.size - 1:
        rods += 1.0 / chain.impedance[node]
    for mass in (chain.mass_left[node], chain.mass_right[node]):
        if mass > 0.0:
            masses += 1.0 / mass
    return rods, masses


@kernel
def _free_closing(chain, state, node, work):
    """Closing speed of the faces if they did not press on each other, at every point."""
    for i in range(POINTS):
        left = right = 0.0
        if node > 0:
            left = chain.drift[node - 1] + 2.0 * work.from_left[i] / chain.impedance[node - 1]
        elif chain.mass_left[node] > 0.0:
            left = state.speed[node]
        if node < chain.kind.size - 1:
            right = chain.drift[node] - 2.0 * work.from_right[i] / chain.impedance[node]
        elif chain.mass_right[node] > 0.0:
            right = state.speed[node]
        work.closing[i] = left - right


@kernel
def _bonded_force(rods, masses, step, work):
    """Force at every point that keeps the faces together."""
    work.forces[0] = work.closing[0] / rods
    if masses == 0.0:
        for i in range(1, POINTS):
            work.forces[i] = work.closing[i] / rods
        return True
    for i in range(STAGES):
        work.right[i] = work.closing[i + 1]
        for j in range(STAGES):
            work.matrix[i, j] = step * masses * INTEGRATE[i, j]
        work.matrix[i, i] += rods
    good = solve_in_place(work.matrix, work.right, STAGES)
    for i in range(STAGES):
        work.forces[i + 1] = work.right[i]
    return good


@kernel
def _follow(rods, masses, depth, step, work):
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


@kernel
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


@kernel
def _law_force(law, rods, masses, depth, deepest, step, work):
    """Force at every point from a contact law, by Newton's method on all stages at once."""
    settled, before = False, np.inf
    for _ in range(40):
        _follow(rods, masses, depth, step, work)
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


@kernel
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


@kernel
def _first_crossing(values, level, upward):
    """First place in (0, 1] where a polynomial passes a level, going up or down; 2 if it does not."""
    sign = 1.0 if upward else -1.0
    before = 0.0
    for i in range(1, LOOKS + 1):
        place = i / LOOKS
        if sign * (interpolate(values, place) - level) > 0.0:
            low, high = before, place
            for _ in range(60):
                middle = 0.5 * (low + high)
                if sign * (interpolate(values, middle) - level) > 0.0:
                    high = middle
                else:
                    low = middle
            return high
        before = place
    return 2.0


@kernel
def _keep(chain, state, record, node, step, work, lost_so_far, stored_change, counts_loss):
    """Write a stretch and move the node to its end."""
    n = record.count[node]
    values = record.values[node, n]
    previous = record.values[node, n - 1]
    for quantity in (TOTAL_LEFT, TOTAL_RIGHT, IMPULSE):
        values[quantity, 0] = previous[quantity, STAGES] if n > 0 else 0.0
    mass = chain.mass_left[node] if chain.mass_left[node] > 0.0 else chain.mass_right[node]
    pushed = -1.0 if chain.mass_left[node] > 0.0 else 1.0
    gain = pushed / mass if mass > 0.0 else 0.0
    values[SPEED, 0], values[PLACE, 0], values[LOST, 0] = state.speed[node], state.place[node], lost_so_far
    for i in range(POINTS):
        values[OUT_LEFT, i] = work.forces[i] - work.from_left[i]
        values[OUT_RIGHT, i] = work.forces[i] - work.from_right[i]
        values[FORCE, i] = work.forces[i]
        values[DEPTH, i] = work.depth[i]
    for i in range(STAGES):
        left, right, impulse, speed, place, taken = 0.0, 0.0, 0.0, 0.0, step * STAGE_NODES[i] * state.speed[node], 0.0
        for j in range(STAGES):
            share = step * INTEGRATE[i, j]
            left += share * values[OUT_LEFT, j + 1]
            right += share * values[OUT_RIGHT, j + 1]
            impulse += share * work.forces[j + 1]
            speed += share * gain * work.forces[j + 1]
            place += step * step * INTEGRATE_TWICE[i, j] * gain * work.forces[j + 1]
            taken += share * work.forces[j + 1] * work.rate[j + 1]
        values[TOTAL_LEFT, i + 1] = values[TOTAL_LEFT, 0] + left
        values[TOTAL_RIGHT, i + 1] = values[TOTAL_RIGHT, 0] + right
        values[IMPULSE, i + 1] = values[IMPULSE, 0] + impulse
        values[SPEED, i + 1] = state.speed[node] + speed
        values[PLACE, i + 1] = state.place[node] + place
        values[LOST, i + 1] = lost_so_far + (taken - stored_change[i] if counts_loss else 0.0)
    record.closed[node, n] = state.closed[node]
    state.time[node] += step
    record.start[node, n + 1] = state.time[node]
    record.count[node] = n + 1
    state.depth[node] = work.depth[STAGES]
    state.speed[node] = values[SPEED, STAGES]
    state.place[node] = values[PLACE, STAGES]


@kernel
def _jumped(record, state, node, tolerance):
    """Whether the last stretch begins with a jump or a bend in what the node sends, as far as `tolerance` can tell."""
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
def _seen(record, sender, delay, t, seek):
    """How far a step from t may go so as to look at no more than LOOK_AHEAD of the sender's stretches.

    Whatever the sender resolved, a short pulse say, its neighbour then cannot step across.
    """
    count, start, back = record.count[sender], record.start[sender], t - delay
    if count <= LOOK_AHEAD:
        return np.inf
    while seek < count - 1 and start[seek + 1] <= back + _tiny(t):
        seek += 1
    last = seek + LOOK_AHEAD
    return start[last] - back if last < count else np.inf


@kernel
def _given_force(pulse, t):
    """A force given as straight lines between points (2, points), times and values; zero beyond them."""
    times, forces = pulse[0], pulse[1]
    if t < times[0] or t > times[-1]:
        return 0.0
    low, high = 0, times.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if times[middle] <= t:
            low = middle
        else:
            high = middle
    width = times[high] - times[low]
    return forces[low] + (forces[high] - forces[low]) * ((t - times[low]) / width if width > 0.0 else 1.0)


SMOOTH, PARTS, TOUCHES, BENDS, TURNS, FAILS, RETRIES = range(7)  # how a stretch ends


@kernel
def _prepare(chain, state, record, node, step, work):
    """Arriving waves and free closing speed of the next step of a node."""
    t = state.time[node]
    if node > 0:
        state.seek_left[node] = _arrivals(
            record, node - 1, OUT_RIGHT, chain.transit[node - 1], t, step, state.seek_left[node], work.from_left
        )
    if node < chain.kind.size - 1:
        state.seek_right[node] = _arrivals(
            record, node + 1, OUT_LEFT, chain.transit[node], t, step, state.seek_right[node], work.from_right
        )
    _free_closing(chain, state, node, work)


@kernel
def _simple_forces(chain, state, node, rods, masses, pulse, step, work):
    """Force, depth and rate of one step where no law is at work."""
    kind, good = chain.kind[node], True
    if kind == ABSORBING:
        work.forces[:] = work.from_left
    elif kind == PRESSED:
        t, inside = state.time[node], 1e-9 * step
        for i in range(POINTS):  # seen from inside the step, as the force may jump at its ends
            work.forces[i] = _given_force(pulse, t + min(max(step * NODES[i], inside), step - inside))
    elif kind == FREE or not state.closed[node]:
        work.forces[:] = 0.0
    else:
        good = _bonded_force(rods, masses, step, work)
    _follow(rods, masses, state.depth[node], step, work)
    return good


@kernel
def _law_forces(state, node, law, rods, masses, guess, step, work):
    """Force, depth and rate of one step through a contact law."""
    depth, deepest = state.depth[node], state.deepest[node]
    inside = max(depth, 1e-300)  # faces that have just met press already, if the law's force jumps at touch
    work.forces[0] = _first_force(law, rods, inside, work.closing[0], deepest, guess)
    for i in range(1, POINTS):
        work.forces[i] = work.forces[0]
    return _law_force(law, rods, masses, depth, deepest, step, work)


@kernel
def _face_events(state, node, dent, pull, step, located, work):
    """What happens within a step at rigid faces, or at any faces that are apart: how it ends, step, looks taken."""
    if state.closed[node]:
        if work.forces[0] < -pull:  # a front of tension parts them at once
            state.closed[node], state.opened[node] = False, False
            return RETRIES, step, located
        place = _first_crossing(work.forces, -pull, False)
        ending = PARTS
    else:
        if not state.opened[node] and work.depth[0] >= dent - pull and work.rate[0] > 1e-13:
            state.closed[node] = True
            state.depth[node] = max(dent, state.depth[node])
            return RETRIES, step, located
        place = _first_crossing(work.depth, dent if state.opened[node] else dent + NO_PULL, True)
        ending = TOUCHES
    if place <= 1.0 - 1e-9 and located < 3:
        return RETRIES, step * place, located + 1
    return ending if located > 0 or place <= 1.0 else SMOOTH, step, located


@kernel
def _law_events(state, node, remembers, loses, dent, corner, span, step, located, attempt, work):
    """The same where the faces press on each other through a law; `located` is the event that is being closed in on."""
    if remembers and state.loading[node] and work.rate[0] < 0.0:  # an arriving front has turned it already
        state.loading[node] = False
        return RETRIES, step, 0
    end = work.depth[STAGES]
    parts = end < dent or located == PARTS
    if parts or (remembers and (end > corner or located == BENDS)):
        level = dent if parts else corner
        late = (end - level) / (min(work.rate[STAGES], -1e-300) if parts else max(work.rate[STAGES], 1e-300))
        if abs(late) <= 2e-15 * max(step, state.time[node]) or attempt > 80:
            work.depth[STAGES] = level
            return PARTS if parts else BENDS, step, located
        return RETRIES, min(max(step - late, 0.1 * step), min(1.5 * step, span)), PARTS if parts else BENDS
    if remembers and state.loading[node]:
        place = _first_crossing(work.rate, 0.0, False)  # where it begins to give way again, the curve changes
        if place <= 1.0 - 1e-9 and located < TURNS + 3:
            return RETRIES, step * place, max(located, TURNS) + 1
        if located > TURNS or place <= 1.0:
            return TURNS, step, located
    first, last = work.forces[0], work.forces[STAGES]
    if loses and state.depth[node] > dent and (first > 0.0) != (last > 0.0) and step > SHORT_STEP:
        # where damping stops the surface from pressing, the force has a corner: step up to it, not across it
        return RETRIES, 0.25 * step, 0
    return SMOOTH, step, located


@kernel
def _error(state, tolerance, step, pressing, work):
    """Of the step as a share of what is allowed, and the largest force so far."""
    peak = 0.0
    for other in range(state.largest.size):
        peak = max(peak, state.largest[other])
    for i in range(POINTS):
        peak = max(peak, abs(work.forces[i]), abs(work.from_left[i]), abs(work.from_right[i]))
    return (_unresolved(work, step, pressing) / (tolerance * peak) if peak > 0.0 else 0.0), peak


@kernel
def _advance(chain, state, record, node, law, remembers, loses, pulse, span, tolerance, work):
    """Move one node on by at most `span`; returns how the stretch ends."""
    rods, masses = _mobility(chain, node)
    with_law, deepest = chain.kind[node] == LAW, state.deepest[node]
    dent = law.dent(deepest) if with_law else 0.0
    if node > 0:
        span = min(span, _seen(record, node - 1, chain.transit[node - 1], state.time[node], state.seek_left[node]))
    if node < chain.kind.size - 1:
        span = min(span, _seen(record, node + 1, chain.transit[node], state.time[node], state.seek_right[node]))
    n, step = record.count[node], min(state.step[node], span)
    guess = record.values[node, n - 1, FORCE, STAGES] if n > 0 else 0.0
    if step > 0.5 * span:
        step = span if step > 0.9 * span else 0.5 * span
    ends, located, error = RETRIES, 0, 0.0
    for attempt in range(100):
        if step < 1e-15 * (state.time[node] + 1e-3):
            break
        _prepare(chain, state, record, node, step, work)
        pressing = with_law and state.closed[node]
        if pressing:
            good = _law_forces(state, node, law, rods, masses, guess, step, work)
        else:
            good = _simple_forces(chain, state, node, rods, masses, pulse, step, work)
        if not good:
            step, located = 0.25 * step, 0
            continue
        error, peak = _error(state, tolerance, step, pressing, work)
        if error > 1.0 and step > 1e-13 and (located == 0 or attempt < 60):
            step, located = step * max(0.1, 0.8 * error ** (-1.0 / STAGES)), 0
            continue
        if pressing:
            corner = np.inf
            if remembers:
                corner = law.corner(state.depth[node], deepest)
                if not state.loading[node] and state.depth[node] >= deepest:  # should it come back, it loads on
                    corner = deepest * (1.0 + 1e-12)
            ends, step, located = _law_events(
                state, node, remembers, loses, dent, corner, span, step, located, attempt, work
            )
        elif with_law or chain.kind[node] == RIGID_FACES:
            ends, step, located = _face_events(state, node, dent, NO_PULL * peak, step, located, work)
        else:
            ends = SMOOTH
        if ends != RETRIES:
            break
    if ends == RETRIES:
        return FAILS
    grown = step * min(4.0, 0.8 * max(error, 1e-9) ** (-1.0 / STAGES))
    state.step[node] = max(grown, state.step[node]) if step == span or ends != SMOOTH else grown
    counts_loss = with_law and state.closed[node] and (remembers or loses)
    if counts_loss:
        stored = law.stored(state.depth[node], deepest)
        for i in range(STAGES):
            work.right[i] = law.stored(work.depth[i + 1], max(deepest, work.depth[i + 1])) - stored
    _finish(chain, state, record, node, counts_loss, remembers, dent, step, ends, work)
    return ends


@kernel
def _finish(chain, state, record, node, counts_loss, remembers, dent, step, ends, work):
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


@kernel
def _next_node(chain, state, until):
    """The node furthest behind, how far it can go, and whether a jump reaches it now."""
    node, fresh = 0, False
    for other in range(1, chain.kind.size):
        if state.time[other] < state.time[node]:
            node = other
    t = state.time[node]
    while state.next_break[node] < state.break_count[node]:
        if state.breaks[node, state.next_break[node]] - t > _tiny(t):
            break
        state.next_break[node] += 1
        fresh = True
    limit = until
    if state.next_break[node] < state.break_count[node]:
        limit = min(limit, state.breaks[node, state.next_break[node]])
    if node > 0:
        limit = min(limit, state.time[node - 1] + chain.transit[node - 1])
    if node < chain.kind.size - 1:
        limit = min(limit, state.time[node + 1] + chain.transit[node])
    return node, limit, fresh


@kernel
def _announce(chain, state, record, node, t, limit, changed, tolerance):
    """After a stretch that began at t: tell the neighbours if it began with a jump. False if there is no more room."""
    if limit - state.time[node] <= _tiny(limit):
        state.time[node] = limit
        record.start[node, record.count[node]] = limit
    good = True
    if changed and _jumped(record, state, node, tolerance):
        if node > 0:
            good = add_break(state, node - 1, t + chain.transit[node - 1])
        if good and node < chain.kind.size - 1:
            good = add_break(state, node + 1, t + chain.transit[node])
    return good


@kernel
def _pushed(record, node):
    """Impulse that has gone through a node so far."""
    count = record.count[node]
    return record.values[node, count - 1, IMPULSE, STAGES] if count > 0 else 0.0


@kernel
def _parted(chain, state, record, masses, parting, wait):
    """Whether the impactor has been apart for a while, and no part of the chain can catch up with the one before it.

    Parts lie between joints that can open; `masses` (nodes,): of the part to the right of such a joint, infinite if it
    is held, and of the impactor at last.
    """
    node = chain.contact
    if state.time[node] < parting + wait:
        return False
    through = _pushed(record, node)
    slower = (chain.drift[node - 1] if node > 0 else chain.mass_drift[node]) - through / masses[-1]
    while node < chain.kind.size - 1:
        following = node + 1
        while following < chain.kind.size - 1 and chain.kind[following] == BONDED:
            following += 1
        opens = chain.kind[following] == RIGID_FACES or chain.kind[following] == LAW
        passed = _pushed(record, following) if opens else 0.0
        moving = chain.drift[node] + (through - passed) / masses[node]
        if moving < slower - NO_PULL:
            return False
        slower, through, node = moving, passed, following
    return True


@kernel
def _begin(chain, pulse, capacity):
    nodes = chain.kind.size
    record, state = new_record(nodes, capacity), _new_state(chain, capacity)
    for node in range(nodes):
        if chain.kind[node] == PRESSED:
            for t in pulse[0]:
                add_break(state, node, t)
    return record, state, _new_work()


@kernel
def solve(chain, contact_law, joint_laws, remembers, loses, pulse, masses, wait, until, tolerance, capacity):
    """Follow every node to `until`, or until the impactor has parted from the target for good.

    joint_laws: a tuple, one for each node. remembers, loses (2,): whether the contact's law and those of the joints
    have memory, and damping. pulse (2, points): times and values of the force on a PRESSED node. masses (nodes + 1,):
    of the parts of the chain, see `_parted`. wait: how long after parting no touch may come. Returns status, record,
    state.
    """
    record, state, work = _begin(chain, pulse, capacity)
    changed = np.ones(chain.kind.size, np.bool_)  # whether the next stretch may begin with a jump
    parting, status = np.inf, STOPPED
    while True:
        node, limit, fresh = _next_node(chain, state, until)
        t, was_closed = state.time[node], state.closed[node]
        if until - t <= _tiny(t):
            break
        if record.count[node] >= capacity:
            status = FULL
            break
        if node == chain.contact:
            ends = _advance(
                chain, state, record, node, contact_law, remembers[0], loses[0], pulse, limit - t, tolerance, work
            )
        else:
            ends = _advance(
                chain, state, record, node, joint_laws[node], remembers[1], loses[1], pulse, limit - t, tolerance, work
            )
        if ends == FAILS:
            status = FAILED
            break
        fresh = fresh or changed[node] or was_closed != record.closed[node, record.count[node] - 1]
        if not _announce(chain, state, record, node, t, limit, fresh, tolerance):
            status = FULL
            break
        changed[node] = ends != SMOOTH
        if node == chain.contact:
            if state.closed[node]:
                parting = np.inf
            elif parting == np.inf:
                parting = t
            elif _parted(chain, state, record, masses, parting, wait):
                status = PARTED
                break
    return status, record, state


@kernel
def sample(record, node, quantity, times, after, out):
    """Write what is kept of a node at `times`; at a jump the value after it, or before it if not `after`; 0 before."""
    count, start = record.count[node], record.start[node]
    for k in range(times.size):
        t = times[k]
        if t < 0.0 or (t == 0.0 and not after) or count == 0:
            out[k] = 0.0
            continue
        low, high = 0, count
        while high - low > 1:
            middle = (low + high) // 2
            if start[middle] < t or (after and start[middle] == t):
                low = middle
            else:
                high = middle
        place = (t - start[low]) / (start[low + 1] - start[low])
        out[k] = interpolate(record.values[node, low, quantity], min(max(place, 0.0), 1.0))


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


@kernel
def highest(record, node, first, last):
    """The largest force in the stretches first to last of a node, by golden section between the samples."""
    best = 0.0
    for n in range(first, last + 1):
        values = record.values[node, n, FORCE]
        place, here = 0.0, values[0]
        for i in range(1, 13):
            value = interpolate(values, i / 12)
            if value > here:
                here, place = value, i / 12
        if here <= 0.9 * best:
            continue
        low, high = max(place - 1 / 12, 0.0), min(place + 1 / 12, 1.0)
        for _ in range(60):
            third = (high - low) * 0.3819660112501051
            at_p, at_q = interpolate(values, low + third), interpolate(values, high - third)
            here = max(here, at_p, at_q)
            if at_p > at_q:
                high -= third
            else:
                low += third
        best = max(best, here)
    return best
