"""A rigid mass that is balanced against what rings, as a picture needs it, in one call: figures, histories and fields.

As in `waves.drawn`, so that it can be compiled ahead of time for where there is no Python. The speed is one.
"""

from typing import NamedTuple

import numpy as np

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from . import secular
from .balance_histories import (
    CONTACT_END,
    DRAWN,
    END,
    END_RATE,
    FACE,
    FACE_RATE,
    IMPULSE,
    LOST,
    MEAN,
    RINGING,
    WHOLE,
    average,
    between,
    cell_of,
    contacts_of,
    histories,
    instants,
    part_of,
    state,
)
from .balances import (
    MIN_FLIGHT,
    SAMPLES_PER_PERIOD,
    Bank,
    Events,
    Joined,
    Work,
    at_step_ends,
    event_located,
    join,
)
from .free_motion import Turn, set_exact_turn, set_newmark_frequencies, set_newmark_turn
from .waves.drawn import NO_ROOM, SOLVED, instant

# what `answer` writes into `out`: DURATION to PARTED as everywhere, STRUCK: energy of the target, POINTS of histories,
# BALANCES and STEPS: how many
DURATION, PUSHED, FINAL, TARGET, PARTED, COMPRESSING, STRUCK, DISSIPATED = range(8)
CONTACTS, POINTS, BALANCES, STEPS = range(8, 12)
FIGURES = 12
MOST_MODES = 38  # of the target, of those for whom there is no Python
MOST_LOCATED = 10  # of these where balances are located: those of more are chaotic, as rounding is, on every machine
CONTACT_LEFT = 4  # velocity of the mass after a contact


class Given(NamedTuple):
    """The target by its modes (modes,): frequencies, shapes where it is struck, means of them over its mass."""

    frequencies: np.ndarray
    at_contact: np.ndarray
    means: np.ndarray
    shapes: np.ndarray  # (modes and motion as a whole, places); stresses: tension per 1 of each coordinate
    stresses: np.ndarray


class Room(NamedTuple):
    """What a call works in, of so many modes of both bodies and so many events."""

    frequencies: np.ndarray  # (modes,), as are the next seven
    closing: np.ndarray
    start: np.ndarray
    flight: np.ndarray
    squares: np.ndarray
    q: np.ndarray
    p: np.ndarray
    turn: Turn
    joined: Joined
    holding: secular.Work
    work: Work
    events: Events
    time: np.ndarray  # (DRAWN + 2 events,)
    after: np.ndarray
    force: np.ndarray
    found: np.ndarray  # (COLUMNS, DRAWN + 2 events)
    contacts: np.ndarray  # (contacts, CONTACT_COLUMNS)


class Drawn(NamedTuple):
    """What is drawn besides the rows, at even times and places."""

    impactor: np.ndarray  # (instants,), displacement; and of the struck face
    face: np.ndarray
    stress: np.ndarray  # (few instants, places)
    velocity: np.ndarray
    displacement: np.ndarray


@inner_kernel
def _set_bank(mass, whole, given, room):
    """Both bodies as one bank, with their rates at the first touch; returns the place of the target as a whole."""
    first = 1 if np.isinf(whole) else 2
    room.frequencies[0], room.closing[0], room.start[0] = 0.0, 1.0 / np.sqrt(mass), np.sqrt(mass)
    if first == 2:
        room.frequencies[1], room.closing[1], room.start[1] = 0.0, -1.0 / np.sqrt(whole), 0.0
    for i in range(given.frequencies.size):
        room.frequencies[first + i], room.closing[first + i] = given.frequencies[i], -given.at_contact[i]
        room.start[first + i] = 0.0
    for i in range(room.start.size):
        room.q[i], room.p[i] = 0.0, room.start[i]
    return 1 if first == 2 else -1


@inner_kernel
def _copied(events, count):
    """The first of them."""
    return Events(
        events.time[:count], events.impulse[:count], events.lost[:count], events.stuck[:count],
        events.coordinates[:count], events.rates[:count],
    )  # fmt: skip


@inner_kernel
def _fields(bank, joined, events, duration, given, room, time, drawn):
    """At few instants straight between those of the histories, as they are elsewhere."""
    few, places, work = drawn.stress.shape[0], drawn.stress.shape[1], room.work
    for k in range(few):
        check_time()
        t = instant(k, few, duration)
        low = cell_of(time, t)
        part = part_of(time, low, t)
        state(bank, room.flight, joined, events, room.start, room.after[low], time[low], work, room.q, room.p)
        state(bank, room.flight, joined, events, room.start, room.after[low + 1], time[low + 1], work, work.q, work.p)
        for x in range(places):
            drawn.stress[k, x] = drawn.velocity[k, x] = drawn.displacement[k, x] = 0.0
        for i in range(1, bank.closing.size):
            q, p = room.q[i] + part * (work.q[i] - room.q[i]), room.p[i] + part * (work.p[i] - room.p[i])
            for x in range(places):
                drawn.stress[k, x] -= given.stresses[i - 1, x] * q
                drawn.displacement[k, x] += given.shapes[i - 1, x] * q
                drawn.velocity[k, x] += given.shapes[i - 1, x] * p


@inner_kernel
def _compressing(mass, common, time, found):
    """Impulse up to the instant at which the mass has come down to the `common` velocity; NaN: it never does."""
    rate, impulse = found[FACE_RATE], found[IMPULSE]
    for k in range(time.size):
        if rate[k] <= common:
            jumps = k == 0 or time[k] == time[k - 1]
            return impulse[k] if jumps else mass * (1.0 - common)
    return np.nan


@inner_kernel
def _figures(mass, whole, time, found, contacts, duration, out):
    last = contacts[int(out[CONTACTS]) - 1, CONTACT_END]
    rate = between(time, found[WHOLE], duration)
    out[DURATION], out[PUSHED] = duration, between(time, found[IMPULSE], duration)
    out[FINAL], out[TARGET] = between(time, found[FACE_RATE], duration), rate + between(time, found[MEAN], duration)
    out[PARTED] = between(time, found[END_RATE], last) - between(time, found[FACE_RATE], last)
    common = 0.0 if np.isinf(whole) else mass / (mass + whole)
    out[COMPRESSING] = np.nan if out[FINAL] > common else _compressing(mass, common, time, found)
    out[STRUCK] = between(time, found[RINGING], duration) + (0.0 if np.isinf(whole) else 0.5 * whole * rate * rate)
    out[DISSIPATED] = between(time, found[LOST], duration)
    for k in range(int(out[CONTACTS])):
        contacts[k, CONTACT_LEFT] = between(time, found[FACE_RATE], min(contacts[k, CONTACT_END], duration))


@inner_kernel
def _marched(bank, joined, how, period, end, room):
    """Let it run; see `answer`. Returns how many events there are, and the step."""
    (located, step, patience), (restitution, q, p, turn) = how[:3], (how[3], room.q, room.p, room.turn)
    if located:
        step = period / SAMPLES_PER_PERIOD
        set_exact_turn(turn, bank.frequencies, step)
        for i in range(q.size):
            room.flight[i] = bank.frequencies[i]
        count, _ = event_located(
            bank, joined, turn, step, restitution, MIN_FLIGHT * period, end, patience, q, p, room.events, room.work
        )
        return count, step
    set_newmark_turn(turn, bank.frequencies, step)
    set_newmark_frequencies(room.flight, bank.frequencies, step)
    count, _ = at_step_ends(bank, turn, restitution, step, end, patience, q, p, room.events)
    return count, step


@kernel
def answer(mass, whole, given, how, resolved, until, room, drawn, out):
    """Write what is drawn of a mass that strikes at a speed of one.

    whole: mass of the target that moves freely, or infinity; how: whether balances are located, the step where they are
    not, how long bodies that move apart are followed, the restitution; resolved: shorter flights are still contact;
    until: the duration, or 0, and then the longest, and how much is shown after the last event. Returns SOLVED or
    NO_ROOM.
    """
    target, (asked, longest, after) = _set_bank(mass, whole, given, room), until
    bank, most = Bank(room.frequencies, room.closing, target, 0.0, 0.0), room.events.time.size
    highest = 0.0
    for i in range(bank.frequencies.size):
        highest = max(highest, bank.frequencies[i])
    joined, period = room.joined, 2.0 * np.pi / highest
    if how[0]:
        weight = join(bank, room.joined, room.squares, room.holding)
        joined = Joined(joined.frequencies, joined.basis, joined.press, joined.shift, joined.drift, weight)
    if asked > 0.0:  # which is lived through
        how, longest = (how[0], how[1], np.inf, how[3]), asked
    count, step = _marched(bank, joined, how, period, longest, room)
    if count + 2 > most:
        return NO_ROOM
    events = _copied(room.events, count)
    duration = asked if asked > 0.0 else events.time[count - 1] + after
    rows = DRAWN + 2 * count
    time, force, found = room.time[:rows], room.force[:rows], room.found[:, :rows]
    instants(events, DRAWN, duration, time, room.after[:rows])
    histories(
        bank, room.flight, joined, events, room.start, 1, given.means, time, room.after[:rows], room.work, found
    )  # fmt: skip
    for k in range(rows):
        force[k] = 0.0
    if resolved > 0.0:
        average(time, found[IMPULSE], period, force)
    contacts = contacts_of(events, time, force, resolved, room.contacts)
    if contacts < 0:
        return NO_ROOM
    out[CONTACTS], out[POINTS], out[STEPS], out[BALANCES] = contacts, rows, np.ceil(duration / step), count
    for k in range(1, count):
        out[BALANCES] -= events.stuck[k - 1]
    _figures(mass, whole, time, found, room.contacts, duration, out)
    for k in range(drawn.impactor.size):
        t = instant(k, drawn.impactor.size, duration)
        drawn.impactor[k], drawn.face[k] = between(time, found[FACE], t), between(time, found[END], t)
    _fields(bank, joined, events, duration, given, room, time, drawn)
    return SOLVED
