"""Repeated balances of impulse and momentum between two bodies known by their modes.

Both bodies are one bank of oscillators in mass-normalised coordinates q, rigid-body motion being omega = 0; the faces
overlap by w.q and an impulse P changes q' by -w P. A balance with restitution e is P = (1 + e) w.q' / w.w; between
balances everything moves freely.
Where the bodies accelerate towards each other by themselves, by `fall` + `surge` t [m/s2], the overlap is
w.q + fall t^2 / 2 + surge t^3 / 6.
Source: thesis 6.3 and 6.4.1.
"""

from typing import NamedTuple, Self

import numpy as np

from ..jit.clock import check_time
from ..jit.kernels import allocating_kernel, inner_kernel, kernel
from . import secular
from .arrays import add_to, copy_to, dot, multiply, multiply_by
from .free_motion import (
    Turn,
    most_bend,
    rise_in,
    rises_within,
    set_exact_turn,
    step_back,
    step_on,
    sum_after,
    turn_by,
    turn_of,
)  # fmt: skip
from .secular import hold_together

SAMPLES_PER_PERIOD = 16  # of the highest mode, at which the faces are looked at; with fewer, balances are missed
MIN_FLIGHT = 1e-4  # of that period: shorter flights between balances are taken as staying together


class Bank(NamedTuple):
    """frequencies [rad/s], zero for motion as a whole, and closing w [kg^-1/2], both (modes,).

    The first is the motion of the impactor as a whole; `target` is the place of that of the target, -1 if it is held.
    """

    frequencies: np.ndarray
    closing: np.ndarray
    target: int
    fall: float = 0.0  # by which both accelerate towards each other without touching [m/s2]
    surge: float = 0.0  # how fast that grows [m/s3]


class Events(NamedTuple):
    """What happened, in order, (events,): balances, and ends of stretches in which the faces moved as one.

    `stuck`: such a stretch runs from this event to the next, whose impulse is what was delivered in it.
    coordinates and rates after the event, (events, modes).
    """

    time: np.ndarray  # [s]
    impulse: np.ndarray  # [N s]
    lost: np.ndarray  # energy [J]
    stuck: np.ndarray
    coordinates: np.ndarray
    rates: np.ndarray


def events(most: int, modes: int) -> Events:
    time, impulse, lost = np.zeros((3, most))
    coordinates, rates = np.zeros((2, most, modes))
    return Events(time, impulse, lost, np.zeros(most, np.bool_), coordinates, rates)


class Work(NamedTuple):
    """Room for a march, (modes,) each, the last of one less; `pull`: of the faces, per unit of each coordinate."""

    q: np.ndarray
    p: np.ndarray
    own: np.ndarray
    own_rate: np.ndarray
    pull: np.ndarray
    turn: Turn

    @classmethod
    def of(cls, modes: int) -> Self:
        (q, p), (own, own_rate, pull) = np.empty((2, modes)), np.empty((3, modes - 1))
        return cls(q, p, own, own_rate, pull, turn_of(modes - 1))


def single_balance(mobility: np.ndarray, closing: np.ndarray, rates: np.ndarray, restitution: float) -> np.ndarray:
    """Jumps of velocity in one balance, in any coordinates: nodes of a mesh or modes.

    `mobility` (n, n): inverse of the mass matrix; `closing` (n,): rate of overlap per unit of each rate.
    Source: thesis (6.13); table 6.1.
    """
    response = mobility @ closing
    return -(1.0 + restitution) * float(closing @ rates) / float(closing @ response) * response


@kernel
def led_at(bank, time):
    """How far both bodies come together without touching, how fast, and their acceleration."""
    fall = bank.fall + bank.surge * time
    half, sixth = 0.5 * bank.fall * time * time, bank.surge * time**3 / 6.0
    return half + sixth, time * (bank.fall + 0.5 * bank.surge * time), fall


@inner_kernel
def _approach(bank, p, time):
    """How fast both bodies as wholes come closer."""
    first = bank.closing[0] * p[0] + led_at(bank, time)[1]
    return first + bank.closing[bank.target] * p[bank.target] if bank.target >= 0 else first


@kernel
def clear_after(bank, q, p):
    """How soon both bodies, which do not accelerate by themselves, are clear of each other for good, see `parting`:
    infinite where they do not move apart as wholes.
    """
    speed, ahead, reach = _approach(bank, p, 0.0), bank.closing[0] * q[0], 0.0
    if bank.target >= 0:
        ahead += bank.closing[bank.target] * q[bank.target]
    for i in range(q.size):
        if bank.frequencies[i] > 0.0:
            reach += abs(bank.closing[i]) * np.hypot(q[i], p[i] / bank.frequencies[i])
    return max((reach + ahead) / -speed, 0.0) if speed < 0.0 else np.inf


@inner_kernel
def _watched(bank, q, p, patience):
    """For how long a flight is followed, at most, until the bodies have parted for good."""
    if bank.fall != 0.0 or bank.surge != 0.0:  # what accelerates by itself may never come
        return patience
    soon = clear_after(bank, q, p)
    return min(soon, patience) if soon < np.inf else soon


NOT_JOINED = np.bool_(False)  # no literal: what takes it would be compiled twice


@kernel
def _write(events, count, time, impulse, lost, stuck, q, p):
    events.time[count], events.impulse[count], events.lost[count] = time, impulse, lost
    events.stuck[count] = stuck
    copy_to(events.coordinates[count], q)
    copy_to(events.rates[count], p)


@inner_kernel
def _balance(bank, restitution, rate, p):
    """One balance, in place. Returns its impulse and the energy lost."""
    effective = 1.0 / dot(bank.closing, bank.closing)  # mass of the contact
    impulse = (1.0 + restitution) * rate * effective
    for i in range(p.size):
        p[i] -= bank.closing[i] * impulse
    return impulse, 0.5 * effective * (1.0 - restitution * restitution) * rate * rate


@kernel
def at_step_ends(bank, turn, restitution, step, end, patience, q, p, events):
    """A balance at the end of every step whose faces overlap and approach, and at time zero.

    From (q, p) up to `end` [s], or until the bodies have parted for good, watched for `patience` [s] at most. Returns
    the number of events and the time reached; stops when there is no room for more.
    Source: thesis (6.21); with Newmark's turn tables 6.2 to 6.5 follow digit for digit.
    Differs: (6.22) speaks of halving the step; the tables were made without.
    """
    impulse, lost = _balance(bank, restitution, dot(bank.closing, p), p)
    _write(events, 0, 0.0, impulse, lost, NOT_JOINED, q, p)
    count, k, longest = 1, 0, _watched(bank, q, p, patience)
    while k * step < end and count < events.time.size:
        if k * step - events.time[count - 1] > longest and _approach(bank, p, k * step) < 0.0:
            break
        if k % 64 == 0:
            check_time()
        k += 1
        overlap, rate = step_on(turn, bank.closing, q, p)
        lead, speed, _ = led_at(bank, k * step)
        overlap += lead
        rate += speed
        if overlap >= 0.0 and rate > 0.0:
            impulse, lost = _balance(bank, restitution, rate, p)
            _write(events, count, k * step, impulse, lost, NOT_JOINED, q, p)
            count, longest = count + 1, _watched(bank, q, p, patience)
    return count, k * step


@allocating_kernel
def by_halving(bank, turns, restitution, step, tolerance, end, patience, q, p, events):
    """As `at_step_ends`, with a step halved whose faces would come to overlap by more than `tolerance` [m].

    turns: of the step and its halves, (levels, modes) each. After a balance the whole step is repeated.
    Source: thesis (6.22).
    """
    levels, modes = turns.stay.shape
    q1, p1 = np.empty(modes), np.empty(modes)
    impulse, lost = _balance(bank, restitution, dot(bank.closing, p), p)
    _write(events, 0, 0.0, impulse, lost, NOT_JOINED, q, p)
    count, time, level, part, before = 1, 0.0, 0, step, 0.0
    longest = _watched(bank, q, p, patience)
    while time < end and count < events.time.size:
        if time - events.time[count - 1] > longest and _approach(bank, p, time) < 0.0:
            break
        copy_to(q1, q)
        copy_to(p1, p)
        turn = Turn(turns.stay[level], turns.go[level], turns.back[level])
        overlap, rate = step_on(turn, bank.closing, q1, p1)
        lead, speed, _ = led_at(bank, time + part)
        overlap += lead
        rate += speed
        if overlap > tolerance >= before and level + 1 < levels:
            level += 1
            part *= 0.5
            continue
        copy_to(q, q1)
        copy_to(p, p1)
        time += part
        before = overlap
        level, part = 0, step
        if overlap >= 0.0 and rate > 0.0:
            impulse, lost = _balance(bank, restitution, rate, p)
            _write(events, count, time, impulse, lost, NOT_JOINED, q, p)
            count, longest = count + 1, _watched(bank, q, p, patience)
    return count, time


@inner_kernel
def _fly(bank, turn, step, q, p, q1, p1, begun, longest):
    """Free flight from (q, p) at `begun` [s] until the faces meet: q1, p1 there. Returns its duration, or -1 if over
    `longest`."""
    copy_to(q1, q)
    copy_to(p1, p)
    most = most_bend(bank, q, p)
    overlap, rate = 0.0, dot(bank.closing, p) + led_at(bank, begun)[1]
    steps, elapsed = 0, 0.0
    while elapsed < longest:
        if steps % 64 == 0:
            check_time()
        before, rate_before, now = overlap, rate, begun + elapsed
        overlap, rate = step_on(turn, bank.closing, q1, p1)
        lead, speed, _ = led_at(bank, now + step)
        overlap += lead
        rate += speed
        ahead = led_at(bank, now)
        bent = most + abs(ahead[2]) + abs(bank.surge) * step
        high = rises_within(bank, q1, p1, before, rate_before, overlap, rate, step, bent, *ahead)
        if high > 0.0 and (steps > 0 or rate_before < 0.0 or overlap > 0.0):
            low = 0.0 if steps > 0 else 1e-9 * step  # past the touch that the flight began with
            step_back(turn, q1, p1)
            into = rise_in(bank, q1, p1, low, high, *ahead)
            turn_by(bank, into, q1, p1)
            return elapsed + into
        steps += 1
        elapsed += step
    return -1.0


class Joined(NamedTuple):
    """Both bodies while their faces stick together: modes of the whole, (modes - 1,); basis (modes, modes - 1)."""

    frequencies: np.ndarray
    basis: np.ndarray
    press: np.ndarray  # of the faces, per unit of each coordinate [N / (m kg^1/2)]
    # While both bodies accelerate towards each other, per unit of that acceleration:
    shift: np.ndarray  # where the coordinates are in balance [kg^1/2 s2]
    drift: np.ndarray  # acceleration of those without a frequency [kg^1/2]
    weight: float  # with which the faces press besides [kg]


def apart() -> Joined:
    """For variants whose faces never stick."""
    nothing = np.zeros(0)
    return Joined(nothing, np.zeros((0, 0)), nothing, nothing, nothing, 0.0)


def joined(bank: Bank) -> Joined:
    """Modes of both bodies with w.q = 0."""
    modes = bank.closing.size
    frequencies, press, shift, drift = np.empty((4, modes - 1))
    known = Joined(frequencies, np.empty((modes, modes - 1)), press, shift, drift, 0.0)
    return known._replace(weight=join(bank, known, np.empty(modes), secular.Work.of(modes)))


@kernel
def join(bank, joined, squares, work):
    """Write these modes but for the weight, which it returns; squares (modes,): room."""
    norm = dot(bank.closing, bank.closing)
    for i in range(squares.size):
        squares[i] = bank.frequencies[i] ** 2
    hold_together(squares, bank.closing, work, joined.frequencies, joined.basis)
    weight = 1.0 / norm
    for k in range(joined.frequencies.size):
        pushed = joined.basis[0, k] / bank.closing[0]
        square = max(joined.frequencies[k], 0.0)
        swings = square > 0.0
        joined.frequencies[k] = np.sqrt(square)
        joined.shift[k], joined.drift[k] = (pushed / square, 0.0) if swings else (0.0, pushed)
        joined.press[k] = 0.0
        for i in range(squares.size):
            joined.press[k] -= bank.closing[i] * squares[i] / norm * joined.basis[i, k]
        weight += joined.press[k] * joined.shift[k]
    return weight


@inner_kernel
def hold(bank, joined, begun, q, p, own, own_rate):
    """Coordinates and rates of the whole, less its shift, where the faces meet at `begun` [s]: q, p are changed.
    Returns the acceleration of both bodies towards each other, which hardly changes while they stick."""
    lead, speed, fall = led_at(bank, begun)
    q[0] += lead / bank.closing[0]
    p[0] += speed / bank.closing[0]
    multiply_by(own, q, joined.basis)
    add_to(own, -fall, joined.shift)
    multiply_by(own_rate, p, joined.basis)
    return fall


@inner_kernel
def release(bank, joined, fall, begun, elapsed, own, own_rate, q, p):
    """Coordinates and rates of both bodies again, from those of the whole after free motion."""
    add_to(own, fall, joined.shift)
    add_to(own, 0.5 * fall * elapsed**2, joined.drift)
    multiply(q, joined.basis, own)
    add_to(own_rate, fall * elapsed, joined.drift)
    multiply(p, joined.basis, own_rate)
    lead, speed, _ = led_at(bank, begun + elapsed)
    q[0] -= lead / bank.closing[0]
    p[0] -= speed / bank.closing[0]


@inner_kernel
def _stick(bank, joined, step, q, p, begun, longest, work):
    """Move as one from `begun` [s] until the faces would pull; in place. Returns how long, and whether it ended so."""
    own, own_rate, turn = work.own, work.own_rate, work.turn
    fall = hold(bank, joined, begun, q, p, own, own_rate)
    weight = fall * joined.weight
    for k in range(own.size):
        work.pull[k] = -joined.press[k]
    after = Bank(joined.frequencies, work.pull, -1, 0.0, 0.0)  # its "overlap" is the pull
    set_exact_turn(turn, joined.frequencies, step)
    steps, elapsed, parted = 0, 0.0, False
    pull, rate = sum_after(after, 0.0, own, own_rate)
    pull, most = pull - weight, most_bend(after, own, own_rate)
    while elapsed < longest:
        if steps % 64 == 0:
            check_time()
        steps += 1
        before, rate_before = pull, rate
        pull, rate = step_on(turn, after.closing, own, own_rate)
        pull -= weight
        high = rises_within(after, own, own_rate, before, rate_before, pull, rate, step, most, -weight, 0.0, 0.0)
        if high > 0.0:
            step_back(turn, own, own_rate)
            into = rise_in(after, own, own_rate, 0.0, high, -weight, 0.0, 0.0)
            turn_by(after, into, own, own_rate)
            elapsed += into
            parted = True
            break
        elapsed += step
    release(bank, joined, fall, begun, elapsed, own, own_rate, q, p)
    return elapsed, parted


@kernel
def event_located(bank, joined, turn, step, restitution, soft, end, patience, q, p, events, work):
    """Balances at the very instants at which the faces meet, free flight between them exact.

    `step` only looks for the instants: well below the shortest period. Where so little speed is left that the next
    flight would be shorter than `soft` [s], the faces stay together until they would pull, as the endless sequence of
    ever smaller balances has it. Arguments and result as for `at_step_ends`; work: room.
    """
    q1, p1 = work.q, work.p
    count, time = 0, 0.0
    while time < end and count + 2 <= events.time.size:
        _, speed, fall = led_at(bank, time)
        rate = dot(bank.closing, p) + speed
        impulse, lost = _balance(bank, restitution, rate, p)
        parting = restitution * rate
        push = fall + bank.surge * soft / 3.0  # how fast the faces would come back, as far as a short flight goes
        for i in range(q.size):
            push -= bank.closing[i] * bank.frequencies[i] ** 2 * (q[i] + p[i] * soft / 3.0)
        sticks = push > 0.0 and 2.0 * parting <= soft * push
        if sticks:
            more, less = _balance(bank, 0.0, dot(bank.closing, p) + speed, p)
            impulse, lost = impulse + more, lost + less
        _write(events, count, time, impulse, lost, sticks, q, p)
        count += 1
        if sticks:
            before = p[0]
            elapsed, parted = _stick(bank, joined, step, q, p, time, end - time, work)
            time += elapsed
            _write(events, count, time, (before - p[0]) / bank.closing[0], 0.0, NOT_JOINED, q, p)
            count += 1
            if not parted:
                break
        elapsed = _fly(bank, turn, step, q, p, q1, p1, time, min(end - time, _watched(bank, q, p, patience)))
        if elapsed < 0.0:
            break
        time += elapsed
        copy_to(q, q1)
        copy_to(p, p1)
    return count, time
