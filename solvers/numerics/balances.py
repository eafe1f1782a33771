"""Repeated balances of impulse and momentum between two bodies known by their modes.

Both bodies are one bank of oscillators in mass-normalised coordinates q, rigid-body motion being omega = 0; the faces
overlap by w.q and an impulse P changes q' by -w P. A balance with restitution e is P = (1 + e) w.q' / w.w; between
balances everything moves freely.
Where the bodies accelerate towards each other by themselves, by `fall` + `surge` t [m/s2], the overlap is
w.q + fall t^2 / 2 + surge t^3 / 6.
Source: thesis 6.3 and 6.4.1.
"""

from typing import NamedTuple

import numpy as np

from ..jit.kernels import allocating_kernel, inner_kernel, kernel
from .arrays import add_to, copy_to, dot, multiply, multiply_by
from .free_motion import Turn, rise_in, rises, step_back, step_on, sum_after, turn_by
from .secular import held_together


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


def single_balance(mobility: np.ndarray, closing: np.ndarray, rates: np.ndarray, restitution: float) -> np.ndarray:
    """Jumps of velocity in one balance, in any coordinates: nodes of a mesh or modes.

    `mobility` (n, n): inverse of the mass matrix; `closing` (n,): rate of overlap per unit of each rate.
    Source: thesis (6.13); table 6.1.
    """
    response = mobility @ closing
    return -(1.0 + restitution) * float(closing @ rates) / float(closing @ response) * response


def led(bank, time):
    """How far both bodies come together without touching, how fast, and their acceleration."""
    fall = bank.fall + bank.surge * time
    half, sixth = 0.5 * bank.fall * time * time, bank.surge * time**3 / 6.0
    return half + sixth, time * (bank.fall + 0.5 * bank.surge * time), fall


_led = kernel(led)  # `led` itself takes arrays of times


@kernel
def _apart(bank, p, time):
    """Whether both bodies as a whole move away from each other."""
    first = bank.closing[0] * p[0] + _led(bank, time)[1]
    return first + bank.closing[bank.target] * p[bank.target] < 0.0 if bank.target >= 0 else first < 0.0


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

    From (q, p) up to `end` [s], or until the bodies part and do not meet for `patience` [s]. Returns the number of
    events and the time reached; stops when there is no room for more.
    Source: thesis (6.21); with Newmark's turn tables 6.2 to 6.5 follow digit for digit.
    Differs: (6.22) speaks of halving the step; the tables were made without.
    """
    impulse, lost = _balance(bank, restitution, dot(bank.closing, p), p)
    _write(events, 0, 0.0, impulse, lost, NOT_JOINED, q, p)
    count, k = 1, 0
    while k * step < end and count < events.time.size:
        if k * step - events.time[count - 1] > patience and _apart(bank, p, k * step):
            break
        k += 1
        overlap, rate = step_on(turn, bank.closing, q, p)
        lead, speed, _ = _led(bank, k * step)
        overlap += lead
        rate += speed
        if overlap >= 0.0 and rate > 0.0:
            impulse, lost = _balance(bank, restitution, rate, p)
            _write(events, count, k * step, impulse, lost, NOT_JOINED, q, p)
            count += 1
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
    while time < end and count < events.time.size:
        if time - events.time[count - 1] > patience and _apart(bank, p, time):
            break
        copy_to(q1, q)
        copy_to(p1, p)
        turn = Turn(turns.stay[level], turns.go[level], turns.back[level])
        overlap, rate = step_on(turn, bank.closing, q1, p1)
        lead, speed, _ = _led(bank, time + part)
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
            count += 1
    return count, time


@inner_kernel
def _fly(bank, turn, step, q, p, q1, p1, begun, longest):
    """Free flight from (q, p) at `begun` [s] until the faces meet: q1, p1 there. Returns its duration, or -1 if over
    `longest`.

    In every step the cubic through overlap and rate at both ends shows whether they met and parted again within it.
    """
    copy_to(q1, q)
    copy_to(p1, p)
    overlap, rate = 0.0, dot(bank.closing, p) + _led(bank, begun)[1]
    steps, elapsed = 0, 0.0
    while elapsed < longest:
        before, rate_before, now = overlap, rate, begun + elapsed
        overlap, rate = step_on(turn, bank.closing, q1, p1)
        lead, speed, _ = _led(bank, now + step)
        overlap += lead
        rate += speed
        high = rises(before, rate_before, overlap, rate, step)
        if high > 0.0 and (steps > 0 or rate_before < 0.0 or overlap > 0.0):
            low = 0.0 if steps > 0 else 1e-9 * step  # past the touch that the flight began with
            step_back(turn, q1, p1)
            into = rise_in(bank, q1, p1, low, high, *_led(bank, now))
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
    squares = bank.frequencies**2
    found, basis = held_together(squares, bank.closing)
    norm = float(bank.closing @ bank.closing)
    press = -(bank.closing * squares / norm) @ basis
    frequencies = np.sqrt(np.maximum(found, 0.0))
    pushed = basis[0] / bank.closing[0]
    swings = frequencies > 0.0
    shift = np.where(swings, pushed / np.where(swings, frequencies, 1.0) ** 2, 0.0)
    drift = np.where(swings, 0.0, pushed)
    return Joined(frequencies, basis, press, shift, drift, 1.0 / norm + float(press @ shift))


@allocating_kernel
def _stick(bank, joined, step, q, p, begun, longest):
    """Move as one from `begun` [s] until the faces would pull; in place. Returns how long, and whether it ended so."""
    basis, modes = joined.basis, joined.frequencies.size
    lead, speed, fall = _led(bank, begun)  # which hardly changes while they stick
    q[0] += lead / bank.closing[0]
    p[0] += speed / bank.closing[0]
    own, own_rate, weight = np.empty(modes), np.empty(modes), fall * joined.weight
    multiply_by(own, q, basis)
    add_to(own, -fall, joined.shift)
    multiply_by(own_rate, p, basis)
    closing = np.zeros(modes)
    add_to(closing, -1.0, joined.press)
    after = Bank(joined.frequencies, closing, -1, 0.0, 0.0)  # its "overlap" is the pull
    turn_stay, turn_go, turn_back = np.empty(modes), np.empty(modes), np.empty(modes)
    for i in range(modes):
        omega = joined.frequencies[i]
        sine = np.sin(omega * step)
        turn_stay[i], turn_back[i] = np.cos(omega * step), -omega * sine
        turn_go[i] = sine / omega if omega > 0.0 else step
    turn = Turn(turn_stay, turn_go, turn_back)
    elapsed, parted = 0.0, False
    pull, rate = sum_after(after, 0.0, own, own_rate)
    pull -= weight
    while elapsed < longest:
        before, rate_before = pull, rate
        pull, rate = step_on(turn, after.closing, own, own_rate)
        pull -= weight
        high = rises(before, rate_before, pull, rate, step)
        if high > 0.0:
            step_back(turn, own, own_rate)
            into = rise_in(after, own, own_rate, 0.0, high, -weight, 0.0, 0.0)
            turn_by(after, into, own, own_rate)
            elapsed += into
            parted = True
            break
        elapsed += step
    add_to(own, fall, joined.shift)
    add_to(own, 0.5 * fall * elapsed**2, joined.drift)
    multiply(q, basis, own)
    add_to(own_rate, fall * elapsed, joined.drift)
    multiply(p, basis, own_rate)
    lead, speed, _ = _led(bank, begun + elapsed)
    q[0] -= lead / bank.closing[0]
    p[0] -= speed / bank.closing[0]
    return elapsed, parted


@allocating_kernel
def event_located(bank, joined, turn, step, restitution, soft, end, patience, q, p, events):
    """Balances at the very instants at which the faces meet, free flight between them exact.

    `step` only looks for the instants: well below the shortest period. Where so little speed is left that the next
    flight would be shorter than `soft` [s], the faces stay together until they would pull, as the endless sequence of
    ever smaller balances has it. Arguments and result as for `at_step_ends`.
    """
    q1, p1 = np.empty(q.size), np.empty(q.size)
    count, time = 0, 0.0
    while time < end and count + 2 <= events.time.size:
        _, speed, fall = _led(bank, time)
        rate = dot(bank.closing, p) + speed
        impulse, lost = _balance(bank, restitution, rate, p)
        parting = restitution * rate
        push = fall  # how fast the faces would come back
        for i in range(q.size):
            push -= bank.closing[i] * bank.frequencies[i] ** 2 * q[i]
        sticks = push > 0.0 and 2.0 * parting <= soft * push
        if sticks:
            more, less = _balance(bank, 0.0, dot(bank.closing, p) + speed, p)
            impulse, lost = impulse + more, lost + less
        _write(events, count, time, impulse, lost, sticks, q, p)
        count += 1
        if sticks:
            before = p[0]
            elapsed, parted = _stick(bank, joined, step, q, p, time, end - time)
            time += elapsed
            _write(events, count, time, (before - p[0]) / bank.closing[0], 0.0, NOT_JOINED, q, p)
            count += 1
            if not parted:
                break
        # what accelerates by itself may never come, though it does not part for good
        free = bank.fall == 0.0 and bank.surge == 0.0 and not _apart(bank, p, time)
        longest = min(end - time, np.inf if free else patience)
        elapsed = _fly(bank, turn, step, q, p, q1, p1, time, longest)
        if elapsed < 0.0:
            break
        time += elapsed
        copy_to(q, q1)
        copy_to(p, p1)
    return count, time


def course(bank: Bank, flight: np.ndarray, joined: Joined, events: Events, after: np.ndarray, delay: np.ndarray):
    """Coordinates and rates `delay` [s] after the events `after`, (times, modes) each.

    `flight` [rad/s]: frequencies of the free motion; Newmark's are a little lower than those of the bank.
    """
    q, p = _swing(bank.frequencies, flight, events.coordinates[after], events.rates[after], delay[:, None])
    stuck = np.flatnonzero(events.stuck[after])
    if stuck.size:
        begun, late = events.time[after[stuck]], delay[stuck]
        at, rate = events.coordinates[after[stuck]], events.rates[after[stuck]]
        lead, speed, fall = led(bank, begun)
        at[:, 0] += lead / bank.closing[0]
        rate[:, 0] += speed / bank.closing[0]
        shift = np.multiply.outer(fall, joined.shift)
        own, own_rate = _swing(
            joined.frequencies, joined.frequencies, at @ joined.basis - shift, rate @ joined.basis, late[:, None]
        )
        q[stuck] = (own + shift + np.multiply.outer(0.5 * fall * late**2, joined.drift)) @ joined.basis.T
        p[stuck] = (own_rate + np.multiply.outer(fall * late, joined.drift)) @ joined.basis.T
        lead, speed, _ = led(bank, begun + late)
        q[stuck, 0] -= lead / bank.closing[0]
        p[stuck, 0] -= speed / bank.closing[0]
    return q, p


def _swing(frequencies, flight, q, p, delay):
    angle = flight * delay
    cosine, sine = np.cos(angle), np.sin(angle)
    go = np.where(frequencies > 0.0, sine / np.where(frequencies > 0.0, frequencies, 1.0), delay)
    return cosine * q + go * p, cosine * p - frequencies * sine * q


def newmark_frequencies(frequencies: np.ndarray, step: float) -> np.ndarray:
    """Those with which Newmark's step turns the modes: 2 atan(omega step / 2) / step."""
    return 2.0 / step * np.arctan(0.5 * frequencies * step)
