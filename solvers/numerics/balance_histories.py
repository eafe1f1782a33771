"""What balances found as histories: states at any time, the averaged force, contacts.

Rows of a history are instants, at each event two: before and after it.
"""

import numpy as np

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from .arrays import copy_to, dot
from .balances import Bank, Events, Joined, Work, hold, led_at, release
from .waves.drawn import instant

# what `histories` writes: position and velocity of the face of the impactor and of the struck one, velocity of the
# target as a whole and what its modes add to its mean, energies of the modes of both, impulse, energy lost
FACE, FACE_RATE, END, END_RATE, WHOLE, MEAN, STRIKER, RINGING, IMPULSE, LOST = range(10)
COLUMNS = 10
CONTACT_START, CONTACT_END, CONTACT_IMPULSE, CONTACT_PEAK = range(4)
CONTACT_COLUMNS = 5  # the last, for the velocity after it, is left to who needs it
ROUNDING = 1e-9  # of a period: closer instants are one
DRAWN = 1500  # even instants among those of the events


@inner_kernel
def between(time, values, t):
    """A history at any time: straight between the instants; where one stands twice, after it."""
    low = cell_of(time, t)
    return values[low] + part_of(time, low, t) * (values[low + 1] - values[low])


@inner_kernel
def cell_of(time, t):
    """The last instant that is not later than t, but for the last of all."""
    low, high = 0, time.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if time[middle] <= t:
            low = middle
        else:
            high = middle
    return low


@inner_kernel
def part_of(time, low, t):
    """Of the way from an instant to the next."""
    width = time[low + 1] - time[low]
    return (min(t, time[low + 1]) - time[low]) / width if width > 0.0 else 1.0


@inner_kernel
def _swing(frequencies, flight, delay, q, p):
    for i in range(q.size):
        cosine, sine = np.cos(flight[i] * delay), np.sin(flight[i] * delay)
        go = sine / frequencies[i] if frequencies[i] > 0.0 else delay
        q[i], p[i] = cosine * q[i] + go * p[i], cosine * p[i] - frequencies[i] * sine * q[i]


@inner_kernel
def state(bank, flight, joined, events, start, after, time, work, q, p):
    """Coordinates and rates at a time [s] that is later than the event `after`; -1: before the first.

    `flight` [rad/s]: frequencies of the free motion; Newmark's are a little lower than those of the bank.
    start (modes,): rates before the first event.
    """
    if after < 0:
        for i in range(q.size):
            q[i], p[i] = 0.0, start[i]
        return
    copy_to(q, events.coordinates[after])
    copy_to(p, events.rates[after])
    begun = events.time[after]
    if events.stuck[after]:
        fall = hold(bank, joined, begun, q, p, work.own, work.own_rate)
        _swing(joined.frequencies, joined.frequencies, time - begun, work.own, work.own_rate)
        release(bank, joined, fall, begun, time - begun, work.own, work.own_rate, q, p)
    else:
        _swing(bank.frequencies, flight, time - begun, q, p)


@kernel
def states(bank, flight, joined, events, start, after, time, work, q, p):
    """`state` at many times, (times, modes) each."""
    for k in range(time.size):
        state(bank, flight, joined, events, start, after[k], time[k], work, q[k], p[k])


@kernel
def instants(events, drawn, duration, time, after):
    """Write so many even times and those of the events, each twice, in order: (drawn + 2 events,), and the event that
    each comes after."""
    count, following, last = 0, 0, events.time.size
    for k in range(drawn):
        t = instant(k, drawn, duration)
        while following < last and events.time[following] <= t:
            count = _twice(events, following, count, time, after)
            following += 1
        time[count], after[count] = t, following - 1
        count += 1
    for event in range(following, last):
        count = _twice(events, event, count, time, after)


@inner_kernel
def _twice(events, event, count, time, after):
    for k in range(2):
        time[count + k], after[count + k] = events.time[event], event - 1 + k
    return count + 2


@kernel
def histories(bank, flight, joined, events, start, split, means, time, after, work, found):
    """Write what there is (COLUMNS, times); split: modes of the impactor; means: of those of the target, or none."""
    q, p, size, target = work.q, work.p, bank.closing.size, bank.target
    lost, event = 0.0, -1
    for k in range(time.size):
        if k % 16 == 0:
            check_time()
        state(bank, flight, joined, events, start, after[k], time[k], work, q, p)
        while event < after[k]:
            event += 1
            lost += events.lost[event]
        lead, speed, _ = led_at(bank, time[k])
        found[FACE, k], found[FACE_RATE, k] = bank.closing[0] * q[0] + lead, bank.closing[0] * p[0] + speed
        found[IMPULSE, k], found[LOST, k] = (start[0] - p[0]) / bank.closing[0], lost
        found[WHOLE, k] = -bank.closing[target] * p[target] if target >= 0 else 0.0
        found[MEAN, k] = dot(means, p[size - means.size :])
        found[END, k] = found[END_RATE, k] = found[STRIKER, k] = found[RINGING, k] = 0.0
        for i in range(1, size):
            energy = 0.5 * (p[i] * p[i] + (bank.frequencies[i] * q[i]) ** 2)
            if i < split:
                found[STRIKER, k] += energy
                continue
            found[END, k] -= bank.closing[i] * q[i]
            found[END_RATE, k] -= bank.closing[i] * p[i]
            found[RINGING, k] += 0.0 if i == target else energy


@kernel
def average(time, impulse, period, force):
    """Write the impulse of the period about each instant over the part of it that is after the first touch.

    A balance at its very end counts, one at its beginning does not: of even steps some stand at both.
    """
    late = ROUNDING * period
    for k in range(time.size):
        first, last = max(time[k] - 0.5 * period + late, 0.0), time[k] + 0.5 * period + late
        gained = between(time, impulse, last) - (between(time, impulse, first) if first > 0.0 else 0.0)
        force[k] = gained / (last - first)


@kernel
def contacts_of(events, time, force, resolved, contacts):
    """Write the contacts (contacts, CONTACT_COLUMNS), and return how many: balances that follow each other by less
    than `resolved` [s] make one. Of an impact of no duration the peak is NaN. Returns -1 where there is no room.
    """
    count, last = 0, events.time.size
    for k in range(last):
        if k > 0 and events.stuck[k - 1]:  # the end of a stretch in which the faces moved as one
            continue
        end = events.time[min(k + 1, last - 1)] if events.stuck[k] else events.time[k]
        if count == 0 or events.time[k] - contacts[count - 1, CONTACT_END] > resolved:
            if count == contacts.shape[0]:
                return -1
            contacts[count, CONTACT_START], contacts[count, CONTACT_IMPULSE] = events.time[k], 0.0
            count += 1
        contacts[count - 1, CONTACT_END] = end
        contacts[count - 1, CONTACT_IMPULSE] += events.impulse[k]
        if events.stuck[k] and k + 1 < last:
            contacts[count - 1, CONTACT_IMPULSE] += events.impulse[k + 1]
    row = 0
    for k in range(count):
        contact = contacts[k]
        contact[CONTACT_PEAK] = 0.0 if resolved > 0.0 else np.nan
        while row < time.size and time[row] < contact[CONTACT_START]:
            row += 1
        while resolved > 0.0 and row < time.size and time[row] <= contact[CONTACT_END]:
            contact[CONTACT_PEAK] = max(contact[CONTACT_PEAK], force[row])
            row += 1
    return count


def course(
    bank: Bank, flight: np.ndarray, joined: Joined, events: Events, start: np.ndarray, after: np.ndarray,
    time: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Coordinates and rates at times [s], each later than the event named by `after`, (times, modes) each."""
    q, p = np.empty((2, time.size, bank.closing.size))
    states(bank, flight, joined, events, start, after, time, Work.of(bank.closing.size), q, p)
    return q, p
