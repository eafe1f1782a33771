"""The impact of a rigid mass that strikes a uniform rod through a contact law, as a picture needs it: see `drawn`."""

import numpy as np

from ...jit.clock import check_time
from ...jit.kernels import inner_kernel, kernel
from ...jit.reference import refer
from .drawn import BEYOND, NO_ROOM, SOLVED, history_of, instant, samples_of
from .events import NO_PULL
from .laws import DENT, STORED
from .laws import FORCE as FORCE_OF
from .network import PARTED, STOPPED, solve
from .parts import BONDED, FREE, LAW
from .periods import SILENT, end_of, periods
from .record import (
    DEPTH,
    FORCE,
    IMPULSE,
    LOST,
    OUT_LEFT,
    OUT_RIGHT,
    PLACE,
    SPEED,
    TOTAL_LEFT,
    TOTAL_RIGHT,
    highest,
    sample_at,
    square_integral,
)

# what `answer` writes into `out`: times T, velocities v, impulse Z v T, energies Z v v T, indentations v T; what the
# rod holds, and what the contact has lost; velocity with which the faces part, impulse to the end of compression
IMPULSE_IN, FINAL, TARGET, APART, COMPRESSING, ROD, DISSIPATED, DEEPEST, DENT_LEFT = range(9)
CONTACTS, SHOWN, WAVE_POINTS, FORCE_POINTS = range(9, 13)
COLUMNS = 13
START, END, PUSH, PEAK, LEFT = range(5)  # columns of its contacts; LEFT: velocity of the mass at the end
CONTACT_COLUMNS = 5
WAIT, LAG = 2.0, 0.5  # T: how long after parting no touch may come; from one end of the rod to the other
JUST_AFTER = 1e-14  # T: more than the rounding of the instant at which a front arrives


@inner_kernel
def place(beta, reflection, chain, masses):
    """Write a rod of beta times the mass of the impactor, fixed (1) or free (-1) at its far end, for `network`."""
    fixed, mass = reflection > 0.0, 0.5 / beta
    chain.impedance[0], chain.transit[0], chain.drift[0] = 1.0, LAG, 0.0
    for node in range(2):
        chain.mass_left[node] = chain.mass_right[node] = chain.mass_drift[node] = chain.gap[node] = 0.0
    chain.kind[0], chain.kind[1] = LAW, BONDED if fixed else FREE
    chain.mass_left[0], chain.mass_drift[0] = mass, 1.0
    chain.mass_right[1] = np.inf if fixed else 0.0
    masses[0], masses[1], masses[2] = np.inf if fixed else 0.5, np.inf, mass


@inner_kernel
def _either_side(t, record, node, quantity, last):
    """What is kept of a node before and after t; at the end of the time solved no value after a jump is known."""
    before = sample_at(record, node, quantity, t, np.bool_(False))
    return before, before if t >= last else sample_at(record, node, quantity, t, np.bool_(True))


kept_history = history_of(_either_side)


@inner_kernel
def force_jumps(record, state, node, found):
    """Write when the force at a node may jump or bend, in order; how many, -1: no room."""
    found[0] = 0.0
    count, n, k, stretches = 1, 1, 0, record.count[node]
    while n < stretches or k < state.break_count[node]:
        while n < stretches and record.closed[node, n] == record.closed[node, n - 1]:
            n += 1
        event = record.start[node, n] if n < stretches else np.inf
        arrival = state.breaks[node, k] if k < state.break_count[node] else np.inf
        t = min(event, arrival)
        n += 1 if event == t else 0
        k += 1 if arrival == t else 0
        if t > found[count - 1] and t < np.inf:
            if count == found.size:
                return -1
            found[count] = t
            count += 1
    return count


@inner_kernel
def sent_jumps(record, node, quantity, found):
    """Write when a wave that a node sends jumps, in order; how many, as far as there is room."""
    count = 0
    for n in range(record.count[node]):
        before = record.values[node, n - 1, quantity, -1] if n > 0 else 0.0
        if abs(record.values[node, n, quantity, 0] - before) > 1e-6 and count < found.size:
            found[count] = record.start[node, n]
            count += 1
    return count


@inner_kernel
def _inside(record, t):
    """Velocity of the centre of the rod, from what its waves carry, (4.29)."""
    after = np.bool_(True)
    right = sample_at(record, 0, TOTAL_RIGHT, t, after) - sample_at(record, 0, TOTAL_RIGHT, t - LAG, after)
    left = sample_at(record, 1, TOTAL_LEFT, t, after) - sample_at(record, 1, TOTAL_LEFT, t - LAG, after)
    return 2.0 * (right - left)


@inner_kernel
def _end(record, t):
    """How far the struck end has come."""
    after = np.bool_(True)
    return sample_at(record, 0, TOTAL_RIGHT, t, after) - sample_at(record, 1, TOTAL_LEFT, t - LAG, after)


@inner_kernel
def _motions(record, last, mass, end, whole):
    moved, before = 0.0, 0.0
    for i in range(mass.size):
        t = instant(i, mass.size, last)
        speed = _inside(record, t)
        moved += 0.5 * last / (mass.size - 1) * (before + speed)
        mass[i], end[i] = sample_at(record, 0, PLACE, t, np.bool_(True)), _end(record, t)
        whole[i], before = moved, speed


@inner_kernel
def _compressed(record, common, last):
    """Impulse when the mass has come down to the `common` velocity, (4.38), (4.41); NaN if it never does."""
    after = np.bool_(True)
    if sample_at(record, 0, SPEED, last, after) > common:
        return np.nan
    low, high = 0.0, last  # the velocity of the mass only falls
    while True:
        middle = 0.5 * (low + high)
        if middle <= low or middle >= high:
            return sample_at(record, 0, IMPULSE, high, after)
        if sample_at(record, 0, SPEED, middle, after) <= common:
            high = middle
        else:
            low = middle


@inner_kernel
def _table(record, pressing, count, contacts):
    for k in range(count):
        first, beyond = pressing[k, 0], pressing[k, 1]
        contacts[k, START], contacts[k, END] = record.start[0, first], end_of(record, 0, beyond)
        contacts[k, PUSH] = record.values[0, beyond, IMPULSE, -1] - record.values[0, first, IMPULSE, 0]
        contacts[k, PEAK] = highest(record, 0, FORCE, first, beyond)
        contacts[k, LEFT] = record.values[0, beyond, SPEED, -1]


@inner_kernel
def _figures(chain, record, law, constants, slopes, parted, last, out):
    after, free = np.bool_(True), chain.mass_right[1] == 0.0
    out[IMPULSE_IN] = sample_at(record, 0, IMPULSE, last, after)
    out[FINAL] = sample_at(record, 0, SPEED, last, after)
    out[TARGET] = _inside(record, last) if free else 0.0
    t = parted + JUST_AFTER
    face = sample_at(record, 0, OUT_RIGHT, t, after) - sample_at(record, 1, OUT_LEFT, t - LAG, after)
    out[APART] = face - sample_at(record, 0, SPEED, t, after)
    beta = 0.5 / chain.mass_left[0]
    out[COMPRESSING] = _compressed(record, 1.0 / (1.0 + beta) if free else 0.0, last)
    out[ROD] = square_integral(record, 0, OUT_RIGHT, max(last - LAG, 0.0), last)
    out[ROD] += square_integral(record, 1, OUT_LEFT, max(last - LAG, 0.0), last)
    out[DEEPEST] = highest(record, 0, DEPTH, 0, record.count[0] - 1)
    out[DENT_LEFT] = law(DENT, constants, 0.0, 0.0, out[DEEPEST], slopes)
    depth = sample_at(record, 0, DEPTH, parted, np.bool_(False))
    out[DISSIPATED] = sample_at(record, 0, LOST, parted, np.bool_(False))
    out[DISSIPATED] += law(STORED, constants, depth, 0.0, out[DEEPEST], slopes)


@inner_kernel
def _cycle(record, law, constants, slopes, until, deepest, depths, forces, loading, unloading):
    """The law slowly to the greatest indentation and back, at even depths, and what the impact did, at even times."""
    for k in range(depths.size):
        t = instant(k, depths.size, until)
        depths[k] = sample_at(record, 0, DEPTH, t, np.bool_(True))
        pressed = depths[k] > law(DENT, constants, 0.0, 0.0, 0.0, slopes)
        forces[k] = max(sample_at(record, 0, FORCE, t, t < until), 0.0) if pressed else 0.0
    for k in range(loading.size):
        depth = instant(k, loading.size, deepest)
        loading[k] = law(FORCE_OF, constants, depth, 0.0, 0.0, slopes)
        unloading[k] = law(FORCE_OF, constants, depth, 0.0, deepest, slopes)


@kernel
def answer(chain, record, state, work, law, of_law, ends, points, pressing, contacts, drawn, cycle, out):
    """Solve an impact until the bodies part for good, or for as long as is asked, and write what is drawn of it.

    chain: two nodes, the mass beside the first; record, state, work: room for the solution; law: `laws.law_function`;
    of_law: what `network.solve` takes besides, (constants, remembers, loses, pulse, masses); ends: (tolerance, most,
    afterglow, asked), as `chain_drawn.answer` has them; points: even times of the wave; pressing (room, 2), contacts
    (room, CONTACT_COLUMNS); drawn: `Drawn`; cycle: indentation and force of the impact (instants,), loading and
    unloading by the law (depths,); out (COLUMNS,). Returns SOLVED, or NO_ROOM, also where they have not parted by
    `most`.
    """
    chain, record, state, work = refer(chain), refer(record), refer(state), refer(work)
    tolerance, most, afterglow, asked = ends
    wait, until = (np.inf, min(asked, most)) if asked > 0.0 else (WAIT, most * 1.0)
    status = solve(chain, record, state, work, law, law, *of_law, wait, NO_PULL, until, tolerance)
    own, remembers, slopes, silent = (
        of_law[0][0],
        of_law[1][0],
        work.slopes,
        SILENT * tolerance if of_law[2][0] else 0.0,
    )
    count = periods(record, 0, np.bool_(False), law, own, remembers, silent, slopes, pressing)
    jumps = force_jumps(record, state, 0, drawn.jumps)
    if status != (STOPPED if asked > 0.0 else PARTED) or count < 1 or jumps < 0:
        return NO_ROOM
    _table(record, pressing, count, contacts)
    parted = contacts[count - 1, END]
    last = min(asked if asked > 0.0 else parted + afterglow, state.time[0], state.time[1])
    force = record, np.int64(0), np.int64(FORCE), last
    out[FORCE_POINTS] = kept_history(samples_of(last), last, drawn.jumps[:jumps], force, drawn.force_time, drawn.force)
    found = drawn.jumps[: sent_jumps(record, 0, OUT_RIGHT, drawn.jumps)]
    sent = record, np.int64(0), np.int64(OUT_RIGHT), last
    out[WAVE_POINTS] = kept_history(points, last, found, sent, drawn.wave_time, drawn.wave)
    check_time()
    _motions(record, last, drawn.mass, drawn.end, drawn.whole)
    _figures(chain, record, law, own, slopes, parted, last, out)
    _cycle(record, law, own, slopes, min(last, BEYOND * parted), out[DEEPEST], *cycle)
    out[CONTACTS], out[SHOWN] = count, last
    return SOLVED
