"""Free motion of a bank of oscillators, and the instant at which a sum over them rises through zero.

Such a sum is the overlap of two faces, or the pull between them; its rate comes with it. A bank is any record with
frequencies [rad/s], zero for motion as a whole, and closing, the weight of each oscillator in the sum, (modes,) both.
"""

from typing import NamedTuple

import numpy as np

from ..jit.kernels import inner_kernel, kernel, summing_kernel


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
