"""Waves in a chain of rods: every rod end a node, every node a small equation with delays.

A rod carries two force waves: one sent by its left end, which arrives at its right end a transit time later, and one
the other way. With f arriving, a rod end under the compressive force F sends F - f back into the rod and moves at

    v0 + (2 f - F) / Z  at a right end,    v0 + (F - 2 f) / Z  at a left end,                       (4.17), (4.18)

a rigid mass at v' = -F / m or F / m. A node joins a left and a right body by a condition on F and on the closing speed
a' = v_left - v_right: F = 0 at a free end, a' = 0 where they are bonded or press on each other as rigid faces,
F = law(a, a') through a contact law. What arrives was sent a transit time ago, so that nodes know nothing of each
other's present: each goes its own way, the one furthest behind first. Stretches between events, and between the
arrivals of jumps, are smooth: a collocation polynomial each. Any consistent units.

Here: who goes next and how far, step by step. `record` keeps what every node did, `nodes` solves one step of
one node, `laws` what a contact law does in it.
"""

import numpy as np

from ...jit.clock import check_time
from ...jit.kernels import inner_kernel, kernel
from ...jit.reference import refer
from .collocation import STAGES
from .events import FAILS, NO_PULL, RETRIES, SMOOTH, face_events, law_events
from .laws import CORNER, DENT, press, store
from .nodes import add_break, finish, prepare, seen, share_of_error, simple_forces, tiny
from .parts import LAW, PRESSED, RIGID_FACES, mobility, opens, swings
from .record import FORCE, jumped, pushed

FORESEEN = 0.1  # of the force that a rejected step shows: so large it will be
LEAST_STEP = 1e-13  # tried next, as a share of the time: below it rounding is taken for detail
PART_OF_SWING = 0.25  # of a radian, the longest step of a mass on a spring: what a polynomial follows to 1e-10

# how a solve ended
PARTED, STOPPED, FULL, FAILED = range(4)


@inner_kernel
def _advance(chain, state, record, node, law, constants, remembers, loses, pulse, span, tolerance, work):
    """Move one node on by at most `span`; returns how the stretch ends."""
    rods, masses = mobility(chain, node)
    with_law, deepest = chain.kind[node] == LAW, state.deepest[node]
    dent = law(DENT, constants, 0.0, 0.0, deepest, work.slopes) if with_law and remembers else 0.0
    if node > 0:
        span = min(span, seen(record, node - 1, chain.transit[node - 1], state.time[node], state.seek_left[node]))
    if node < chain.kind.size - 1:
        span = min(span, seen(record, node + 1, chain.transit[node], state.time[node], state.seek_right[node]))
    if swings(chain, node) > 0.0:
        span = min(span, PART_OF_SWING / np.sqrt(swings(chain, node)))
    n, step = record.count[node], min(state.step[node], span)
    guess = record.values[node, n - 1, FORCE, STAGES] if n > 0 else 0.0
    if step > 0.5 * span:
        step = span if step > 0.9 * span else 0.5 * span
    ends, located, error = RETRIES, np.int64(0), 0.0  # no literal: what takes it would be compiled twice
    for attempt in range(100):
        if step < 1e-15 * (state.time[node] + 1e-3):
            break
        prepare(chain, state, record, node, step, work)
        pressing = with_law and state.closed[node]
        if pressing:
            good = press(law, constants, rods, masses, state.depth[node], deepest, guess, step, work)
        else:
            good = simple_forces(chain, state, node, rods, masses, pulse, step, work)
        if not good:
            step, located = 0.25 * step, 0
            continue
        error, peak = share_of_error(state, tolerance, step, pressing, work)
        state.largest[node] = max(state.largest[node], FORESEEN * peak)
        if error > 1.0 and step > LEAST_STEP and (located == 0 or attempt < 60):
            step, located = step * max(0.1, 0.8 * error ** (-1.0 / STAGES)), 0
            continue
        if pressing:
            corner = np.inf
            if remembers:
                corner = law(CORNER, constants, state.depth[node], 0.0, deepest, work.slopes)
                if not state.loading[node] and state.depth[node] >= deepest:  # should it come back, it loads on
                    corner = deepest * (1.0 + 1e-12)
            ends, step, located = law_events(
                state, node, remembers, loses, dent, corner, span, step, located, attempt, work
            )
        elif with_law or chain.kind[node] == RIGID_FACES:
            ends, step, located = face_events(state, node, rods, dent, NO_PULL * peak, step, located, work)
        else:
            ends = SMOOTH
        if ends != RETRIES:
            break
    if ends == RETRIES:
        return FAILS
    grown = step * min(4.0, 0.8 * max(error, 1e-9) ** (-1.0 / STAGES))
    if step == span or ends != SMOOTH:
        grown = max(grown, state.step[node])
    state.step[node] = max(grown, LEAST_STEP * max(state.time[node], 1.0))
    counts_loss = with_law and state.closed[node] and (remembers or loses)
    if counts_loss:
        store(law, constants, state.depth[node], deepest, work)
    finish(chain, state, record, node, counts_loss, remembers, dent, step, ends, work)
    return ends


@inner_kernel
def _next_node(chain, state, until):
    """The node furthest behind, how far it can go, and whether a jump reaches it now."""
    node, fresh = 0, False
    for other in range(1, chain.kind.size):
        if state.time[other] < state.time[node]:
            node = other
    t = state.time[node]
    while state.next_break[node] < state.break_count[node]:
        if state.breaks[node, state.next_break[node]] - t > tiny(t):
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


@inner_kernel
def _announce(chain, state, record, node, t, limit, changed, tolerance):
    """After a stretch that began at t: let the neighbours know if with a jump. False if there is no more room."""
    if limit - state.time[node] <= tiny(limit):
        state.time[node] = limit
        record.start[node, record.count[node]] = limit
    good = True
    if changed and jumped(record, state, node, tolerance):
        if node > 0:
            good = add_break(state, node - 1, t + chain.transit[node - 1])
        if good and node < chain.kind.size - 1:
            good = add_break(state, node + 1, t + chain.transit[node])
    return good


@kernel
def separate(chain, masses, pushed, creep):
    """Whether no part of the chain can catch up with the one before it, from the one furthest left on.

    Parts lie between joints that can open; `masses` (nodes + 1,): of the part to the right of such a joint, infinite if
    it is held, and of the first part at last; `pushed` (nodes,): impulse through every node so far; `creep`: a speed
    with which none comes closer in any time that matters.
    """
    chain = refer(chain)
    node, last = 0, chain.kind.size - 1
    while node < chain.contact and not opens(chain, node):
        node += 1
    slower = (chain.drift[0] if node > 0 else chain.mass_drift[0]) - pushed[node] / masses[-1]
    while True:
        following = node + 1
        while following < last and not opens(chain, following):
            following += 1
        passed = pushed[following] if following <= last and opens(chain, following) else 0.0
        drift = chain.drift[node] if node < last else chain.mass_drift[node]
        moving = drift + (pushed[node] - passed) / masses[node]
        if moving < slower - creep:
            return False
        if following > last or not opens(chain, following):
            return True
        slower, node = moving, following


@inner_kernel
def _parted(chain, state, record, masses, wait, creep):
    """Whether the impactor has been apart for a while, and for good."""
    if state.time[chain.contact] < state.parting[0] + wait:
        return False
    for node in range(chain.kind.size):
        state.through[node] = pushed(record, node)
    return separate(chain, masses, state.through, creep)


@kernel
def solve(
    chain, record, state, work, contact, joint, constants, remembers, loses, pulse, masses, wait, creep, until,
    tolerance,
):  # fmt: skip
    """Follow every node to `until`, or until the impactor has parted from the target for good; returns the status.

    record, state: new ones, which are filled, or those of a solve that stopped, to go on. contact, joint: their laws,
    see `laws.law_function`; of that of every node the constants (nodes, CONSTANTS), and whether it remembers, and
    loses (nodes,). pulse (pieces, 2 + POINTS): of each smooth piece of the force on a PRESSED node, one after another,
    its begin, its end and the force at its NODES. masses (nodes + 1,), creep: see `separate`. wait: how long after
    parting no touch may come.
    """
    chain, record, state, work = refer(chain), refer(record), refer(state), refer(work)
    nodes, capacity = chain.kind.size, record.closed.shape[1]
    for node in range(nodes):
        if chain.kind[node] == PRESSED and record.count[node] == 0:
            for begin, end in pulse[:, :2]:
                add_break(state, node, begin)
                add_break(state, node, end)
    while True:
        node, limit, fresh = _next_node(chain, state, until)
        t, was_closed = state.time[node], state.closed[node]
        if until - t <= tiny(t):
            return STOPPED
        if record.count[node] >= capacity:
            return FULL
        if record.count[node] % 8 == 0:
            check_time()
        law = contact if node == chain.contact else joint
        ends = _advance(
            chain, state, record, node, law, constants[node], remembers[node], loses[node], pulse, limit - t,
            tolerance, work,
        )  # fmt: skip
        if ends == FAILS:
            return FAILED
        fresh = fresh or state.changed[node] or was_closed != record.closed[node, record.count[node] - 1]
        if not _announce(chain, state, record, node, t, limit, fresh, tolerance):
            return FULL
        state.changed[node] = ends != SMOOTH
        if node == chain.contact:
            if state.closed[node]:
                state.parting[0] = np.inf
            elif state.parting[0] == np.inf:
                state.parting[0] = t
            elif _parted(chain, state, record, masses, wait, creep):
                return PARTED
