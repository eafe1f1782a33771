"""Free motion of a bank of oscillators, and the instant at which a sum over them rises through zero.

Such a sum is the overlap of two faces, or the pull between them; its rate comes with it. A bank is any record with
frequencies [rad/s], zero for motion as a whole, and closing, the weight of each oscillator in the sum, (modes,) both.
"""

from typing import NamedTuple

import numpy as np

from ..jit.kernels import inner_kernel, kernel, summing_kernel

NO_RATE = 1e-9  # of that at the ends of a step: a rate that rounding makes, as faces come free of each other


class Turn(NamedTuple):
    """One step of free motion, (modes,) each: q1 = stay q + go p, p1 = back q + stay p."""

    stay: np.ndarray
    go: np.ndarray
    back: np.ndarray


def turn_of(modes: int) -> Turn:
    return Turn(*np.empty((3, modes)))


def exact_turn(frequencies: np.ndarray, step: float) -> Turn:
    turn = turn_of(frequencies.size)
    set_exact_turn(turn, frequencies, step)
    return turn


def newmark_turn(frequencies: np.ndarray, step: float) -> Turn:
    """Of Newmark's constant mean acceleration: the same in modes as in nodes."""
    turn = turn_of(frequencies.size)
    set_newmark_turn(turn, frequencies, step)
    return turn


def newmark_frequencies(frequencies: np.ndarray, step: float) -> np.ndarray:
    """Those with which Newmark's step turns the modes."""
    found = np.empty(frequencies.size)
    set_newmark_frequencies(found, frequencies, step)
    return found


@kernel
def set_newmark_frequencies(turned, frequencies, step):
    for i in range(frequencies.size):
        turned[i] = 2.0 / step * np.arctan(0.5 * frequencies[i] * step)


@kernel
def set_exact_turn(turn, frequencies, step):
    for i in range(frequencies.size):
        omega = frequencies[i]
        sine = np.sin(omega * step)
        turn.stay[i], turn.back[i] = np.cos(omega * step), -omega * sine
        turn.go[i] = sine / omega if omega > 0.0 else step


@kernel
def set_newmark_turn(turn, frequencies, step):
    for i in range(frequencies.size):
        square = (0.5 * frequencies[i] * step) ** 2
        turn.stay[i], turn.go[i] = (1.0 - square) / (1.0 + square), step / (1.0 + square)
        turn.back[i] = -(frequencies[i] ** 2) * step / (1.0 + square)


@summing_kernel
def step_on(turn, closing, q, p):
    """Advance one step in place; returns the sum and its rate."""
    total, rate = 0.0, 0.0
    for i in range(q.size):
        moved = turn.stay[i] * q[i] + turn.go[i] * p[i]
        p[i] = turn.stay[i] * p[i] + turn.back[i] * q[i]
        q[i] = moved
        total += closing[i] * moved
        rate += closing[i] * p[i]
    return total, rate


@inner_kernel
def step_back(turn, q, p):
    """Undo one step in place."""
    for i in range(q.size):
        was = turn.stay[i] * q[i] - turn.go[i] * p[i]
        p[i] = turn.stay[i] * p[i] - turn.back[i] * q[i]
        q[i] = was


@inner_kernel
def rises(a, a_rate, b, b_rate, step):
    """A place in (0, step] where the sum is positive, or zero: its end, or the top of the cubic in between.

    a, b: the sum at both ends of the step, with its rates.
    """
    if b >= 0.0:
        return step
    if not (a_rate > 0.0 and b_rate < 0.0):
        return 0.0
    # top of the cubic: slope zero
    c1, c2 = a_rate * step, 3.0 * (b - a) - step * (2.0 * a_rate + b_rate)
    c3 = 2.0 * (a - b) + step * (a_rate + b_rate)
    root = c2 * c2 - 3.0 * c3 * c1
    if root < 0.0:
        return 0.0
    place = c1 / (-c2 + np.sqrt(root)) if -c2 + np.sqrt(root) > 0.0 else 1.0
    top = a + place * (c1 + place * (c2 + place * c3))
    return place * step if top > 0.0 and 0.0 < place < 1.0 else 0.0


@summing_kernel
def sum_after(bank, time, q, p):
    """The sum and its rate after free motion for `time`."""
    total, rate = 0.0, 0.0
    for i in range(q.size):
        omega = bank.frequencies[i]
        cosine, sine = np.cos(omega * time), np.sin(omega * time)
        go = sine / omega if omega > 0.0 else time
        total += bank.closing[i] * (cosine * q[i] + go * p[i])
        rate += bank.closing[i] * (cosine * p[i] - omega * sine * q[i])
    return total, rate


@summing_kernel
def bend_after(bank, time, q, p):
    """The second derivative of the sum after free motion for `time`."""
    total = 0.0
    for i in range(q.size):
        omega = bank.frequencies[i]
        total -= bank.closing[i] * omega * (omega * np.cos(omega * time) * q[i] + np.sin(omega * time) * p[i])
    return total


@summing_kernel
def most_bend(bank, q, p):
    """More than the second derivative of the sum comes to in any free motion."""
    total = 0.0
    for i in range(q.size):
        omega = bank.frequencies[i]
        total += abs(bank.closing[i]) * omega * np.sqrt((omega * q[i]) ** 2 + p[i] ** 2)
    return total


@inner_kernel
def _vanishes(bank, q, p, bends, low, at_low, high, at_high, step, speed, fall):
    """Where between `low` and `high`, with these values of unlike sign, the rate of the sum is zero, or its second
    derivative: false position, the end that stays halved (Illinois). q, p: at the end of the step."""
    place = low
    for _ in range(60):
        before, place = place, high - at_high * (high - low) / (at_high - at_low)
        value = bend_after(bank, place - step, q, p) + fall
        if not bends:
            value = sum_after(bank, place - step, q, p)[1] + speed + fall * place
        if value * at_high > 0.0:
            high, at_high, at_low = place, value, 0.5 * at_low
        else:
            low, at_low, at_high = place, value, 0.5 * at_high
        if value == 0.0 or abs(place - before) <= 1e-13 * step:
            break
    return place


@inner_kernel
def rises_within(bank, q, p, a, a_rate, b, b_rate, step, most, lead, speed, fall):
    """A place in (0, step] where the sum is positive: its end, or its highest place in between; 0 if it never is.

    As `rises`, but exact: q, p at the end of the step, most: `most_bend`, and what lead adds to it. Within a sixteenth
    of the shortest period the second derivative changes its sign once at most, so that nothing is missed of one
    oscillator, and of several hardly anything. lead, speed, fall: as `rise_in`, by the time from the step's start.
    """
    if b >= 0.0:
        return step
    if max(a, b) + 0.125 * most * step * step <= 0.0 or (a_rate <= 0.0 < b_rate):
        return 0.0
    low, at_low, high, at_high = 0.0, a_rate, step, b_rate
    if not a_rate > 0.0 > b_rate:  # up and down, or down and up, within the step
        first, last = bend_after(bank, -step, q, p) + fall, bend_after(bank, 0.0, q, p) + fall
        if first * last >= 0.0 or (first > 0.0) == (a_rate > 0.0):
            return 0.0
        place = _vanishes(bank, q, p, True, 0.0, first, step, last, step, speed, fall)
        rate = sum_after(bank, place - step, q, p)[1] + speed + fall * place
        if (rate > 0.0) == (a_rate > 0.0) or abs(rate) <= NO_RATE * max(abs(a_rate), abs(b_rate)):
            return 0.0
        if rate > 0.0:
            low, at_low = place, rate
        else:
            high, at_high = place, rate
    place = _vanishes(bank, q, p, False, low, at_low, high, at_high, step, speed, fall)
    top = sum_after(bank, place - step, q, p)[0] + lead + place * (speed + 0.5 * fall * place)
    return place if top > 0.0 and place > 0.0 else 0.0


@inner_kernel
def turn_by(bank, time, q, p):
    """Move freely for `time`, in place."""
    for i in range(q.size):
        omega = bank.frequencies[i]
        cosine, sine = np.cos(omega * time), np.sin(omega * time)
        go = sine / omega if omega > 0.0 else time
        q[i], p[i] = cosine * q[i] + go * p[i], cosine * p[i] - omega * sine * q[i]


@inner_kernel
def rise_in(bank, q, p, low, high, lead, speed, fall):
    """The instant in (low, high) at which the sum, and lead + speed t + fall t^2 / 2 with it, becomes positive: Newton
    kept in brackets."""
    place = high
    for _ in range(100):
        total, rate = sum_after(bank, place, q, p)
        total += lead + place * (speed + 0.5 * fall * place)
        rate += speed + fall * place
        if total > 0.0:
            high = place
        else:
            low = place
        following = place - total / rate if rate > 0.0 else 0.5 * (low + high)
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - place) <= 1e-15 * high or high - low <= 1e-15 * high:
            return following
        place = following
    return place
