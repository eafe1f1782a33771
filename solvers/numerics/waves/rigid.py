"""Exact waves in a rod struck by a rigid mass: St. Venant's problem, any number of contact periods.

Units here: time in round trips T, velocity in the impact speed v, stress in sigma_0 = v sqrt(E rho), displacement in
v T.
One history says all: s(t), the stress wave sent into the rod by the struck end. It comes back as r s(t - 1), with
r = +1 from a fixed and -1 from a free far end, so that at the struck end

    velocity = s(t) - r s(t - 1),    stress = s(t) + r s(t - 1)                                 (4.17), (4.18)

While they touch, v1' = -2 beta * stress, (4.8); while apart the stress is zero. On every piece between events and their
returns, s is a polynomial times exp(-2 beta t): coefficients are kept, nothing is stepped.
"""

from typing import NamedTuple

import numpy as np

from ...jit.clock import check_time
from ...jit.kernels import inner_kernel, kernel
from ..polynomials import GAUSS_NODES, GAUSS_WEIGHTS, RootWork, roots, shift, trim, value

WINDOW, HORIZON = 2.0, 80.0  # of the exponent x: searched window by window, as exp(-x) ends all beyond the horizon
PARTED, STOPPED, FULL = 0, 1, 2
FOREVER = 20_000.0  # asked for that long, an impact is followed only until the bodies part for good


@inner_kernel
def decaying_integral(coefficients, degree, a, b):
    """Integral of exp(-x) p(x) over [a, b]."""
    total = 0.0
    while a < b:
        end = min(b, a + WINDOW) if a < HORIZON else b
        half, middle = 0.5 * (end - a), 0.5 * (a + end)
        for k in range(GAUSS_NODES.size):
            x = middle + half * GAUSS_NODES[k]
            total += half * GAUSS_WEIGHTS[k] * np.exp(-x) * value(coefficients, degree, x)
        a = end
    return total


@inner_kernel
def _next_window(a, length):
    return min(length, a + WINDOW) if a < HORIZON else length


@inner_kernel
def _first_fall_below_zero(p, degree, length, work):
    """The first x in (0, length) where p, positive before, turns negative; or infinity."""
    found = work.found
    a = 0.0
    while a < length:
        b = _next_window(a, length)
        shift(p, degree, a, work.shifted)
        for k in range(roots(work.shifted, degree, b - a, found, work.roots)):
            x = a + found[k]
            after = found[k + 1] - found[k] if found[k + 1] > found[k] else b - x
            if value(p, degree, x + 0.5 * min(after, 1e-6 * (b - a))) < 0.0:
                return x
        a = b
    return np.inf


@inner_kernel
def _highest(p, degree, length, work):
    """The largest value of exp(-x) p(x) on [0, length]."""
    slope, found = work.slope, work.found
    best = p[0]
    for k in range(degree):
        slope[k] = (k + 1) * p[k + 1] - p[k]
    slope[degree] = -p[degree]
    a = 0.0
    while a < length:
        b = _next_window(a, length)
        shift(slope, degree, a, work.shifted)
        for k in range(roots(work.shifted, degree, b - a, found, work.roots)):
            x = a + found[k]
            best = max(best, np.exp(-x) * value(p, degree, x))
        best = max(best, np.exp(-b) * value(p, degree, b))
        a = b
    return best


@inner_kernel
def _closing_speed(v1, incoming, degree, x):
    return v1 + 2.0 * np.exp(-x) * value(incoming, degree, x)


@inner_kernel
def _first_touch(gap, opened, v1, incoming, degree, length, kappa, work):
    """While apart: the first x in (0, length] where x1 - u_end, negative, comes back to zero; or infinity.

    The closing speed v1 + 2 exp(-x) S(x) is monotone between the roots of S' - S, and so the gap between the zeros of
    the speed: each stretch holds at most one touch, and none is missed. Returns also the gap at the end of the piece
    and whether the bodies have come apart by more than rounding.
    """
    slope, found = work.slope, work.found
    for k in range(degree):
        slope[k] = (k + 1) * incoming[k + 1] - incoming[k]
    slope[degree] = -incoming[degree]
    a = 0.0
    while a < length:
        b = _next_window(a, length)
        shift(slope, degree, a, work.shifted)
        turns = roots(work.shifted, degree, b - a, found, work.roots)
        x = a
        for k in range(turns + 1):
            monotone_end = a + found[k] if k < turns else b
            while x < monotone_end:
                end = monotone_end
                at_x, at_end = _closing_speed(v1, incoming, degree, x), _closing_speed(v1, incoming, degree, end)
                if at_x * at_end < 0.0:  # stop at the zero of the speed
                    low, high = x, end
                    while high - low > 4e-16 * high:
                        middle = 0.5 * (low + high)
                        if not low < middle < high:
                            break
                        if (_closing_speed(v1, incoming, degree, middle) > 0.0) == (at_x > 0.0):
                            low = middle
                        else:
                            high = middle
                    end = high
                gap_end = gap + (v1 * (end - x) + 2.0 * decaying_integral(incoming, degree, x, end)) / kappa
                if gap_end > 0.0 and (opened or gap_end > 1e-14):
                    low, high, touch, gap_low = x, end, 0.5 * (x + end), gap
                    for _ in range(200):  # Newton on the gap, kept inside by halving
                        g = (
                            gap_low
                            + (v1 * (touch - low) + 2.0 * decaying_integral(incoming, degree, low, touch)) / kappa
                        )
                        if g > 0.0:
                            high = touch
                        else:
                            low, gap_low = touch, g
                        speed = _closing_speed(v1, incoming, degree, touch)
                        following = touch - g * kappa / speed if speed > 0.0 else low
                        if not low < following < high:
                            following = 0.5 * (low + high)
                        if abs(following - touch) <= 2e-16 * touch or high - low <= 2e-16 * high:
                            break
                        touch = following
                    return touch, 0.0, True
                gap = gap_end
                if gap < -1e-14:
                    opened = True
                x = end
        a = b
    return np.inf, gap, opened


class Work(NamedTuple):
    """Room for one piece at a time; each of the first five (terms + 1,), `found` one longer."""

    incoming: np.ndarray
    outgoing: np.ndarray
    pressure: np.ndarray
    slope: np.ndarray
    shifted: np.ndarray
    found: np.ndarray
    roots: RootWork


class Pieces(NamedTuple):
    """The wave sent, and the contacts, as `strike` writes them: as many as there is room for."""

    start: np.ndarray  # (pieces + 1,)
    coefficients: np.ndarray  # (pieces, terms), in x = 2 beta (t - start)
    degrees: np.ndarray  # (pieces,)
    integral: np.ndarray  # (pieces + 1,), of s up to each start
    # of each contact: start, end, velocity of the mass before and after, peak stress, position of the mass at the end,
    # velocity of the struck end just after
    contacts: np.ndarray  # (contacts, 7)
    work: Work

    @classmethod
    def of(cls, pieces: int, terms: int, contacts: int) -> "Pieces":
        incoming, outgoing, pressure, slope, shifted = np.zeros((5, terms + 1))
        work = Work(incoming, outgoing, pressure, slope, shifted, np.zeros(terms + 2), RootWork.of(terms + 1))
        return cls(
            np.empty(pieces + 1), np.empty((pieces, terms)), np.empty(pieces, np.int64), np.empty(pieces + 1),
            np.empty((contacts, 7)), work,
        )  # fmt: skip

    def first(self, count: int, contacts: int) -> tuple[np.ndarray, ...]:
        """Those that were written: starts, coefficients, degrees, integrals and contacts."""
        wave = self.start[: count + 1], self.coefficients[:count], self.degrees[:count], self.integral[: count + 1]
        return *wave, self.contacts[:contacts]


@inner_kernel
def _offset(t, j, first, kappa, start):
    """How far piece j, which arrives at `t`, has passed; 0 at its `first` moment."""
    return 0.0 if first or j < 0 else kappa * (t - 1.0 - start[j])


@inner_kernel
def _arriving(j, offset, reflection, coefficients, degrees, incoming):
    """Write the wave that comes back, from `offset` in piece j on; returns its degree."""
    incoming[0] = 0.0
    if j < 0:
        return 0
    degree = degrees[j]
    shift(coefficients[j], degree, offset, incoming)
    damp = reflection * np.exp(-offset)
    for k in range(degree + 1):
        incoming[k] *= damp
    return degree


@inner_kernel
def _pressing(v1, arrives, degree, length, work):
    """Write the wave sent while the bodies touch.

    Returns where they part (beyond `length` if they do not), its degree, velocity of the mass at the end, peak stress.
    """
    incoming, outgoing, pressure = work.incoming, work.outgoing, work.pressure
    outgoing[0] = v1  # Q: the velocity of the mass is exp(-x) Q(x)
    for k in range(degree + 1):
        outgoing[k + 1] = -2.0 * incoming[k] / (k + 1)
    incoming[degree + 1] = 0.0
    degree = degree + 1 if arrives else 0
    for k in range(degree + 1):
        pressure[k] = outgoing[k] + 2.0 * incoming[k]
    if pressure[0] < 0.0 or (pressure[0] == 0.0 and degree > 0 and pressure[1] <= 0.0):
        return 0.0, degree, v1, 0.0
    x = _first_fall_below_zero(pressure, degree, length, work)
    if x <= 0.0:
        return 0.0, degree, v1, 0.0
    end = min(x, length)
    peak = _highest(pressure, degree, end, work)
    v1 = np.exp(-end) * value(outgoing, degree, end)
    for k in range(degree + 1):
        outgoing[k] += incoming[k]
    return x, degree, v1, peak


@inner_kernel
def _write(n, degree, end, kappa, outgoing, coefficients, degrees, integral):
    """Piece n of the wave sent, of length `end`."""
    degree = trim(outgoing, min(degree, coefficients.shape[1] - 2), end)
    for k in range(degree + 1):
        coefficients[n, k] = outgoing[k]
    degrees[n] = degree
    integral[n + 1] = integral[n] + decaying_integral(coefficients[n], degree, 0.0, end) / kappa


@inner_kernel
def _write_parting(contact, t, v1, n, j, offset, reflection, kappa, coefficients, degrees, integral):
    """What holds at the end of a contact (see `Pieces.contacts`): the mass stands where the struck end does."""
    returned = arriving = 0.0
    if j >= 0:
        returned = integral[j] + decaying_integral(coefficients[j], degrees[j], 0.0, offset) / kappa
        arriving = np.exp(-offset) * value(coefficients[j], degrees[j], offset)
    contact[1], contact[3] = t, v1
    contact[5], contact[6] = integral[n] - reflection * returned, -2.0 * reflection * arriving


@kernel
def strike(beta, reflection, until, sent):
    """The impact of a mass at unit speed, up to `until` or until the bodies part for good.

    Returns status, number of pieces and of contacts, which are written into `sent`.
    """
    start, coefficients, degrees, integral, contacts, work = sent
    kappa, period = 2.0 * beta, 2.0 if reflection > 0.0 else 1.0
    t, v1, gap = 0.0, 1.0, 0.0
    touching, opened, first = True, gap < 0.0, True  # no literal: it would be compiled twice
    j, n, count, status = -1, 0, 1, FULL
    contacts[0, 0], contacts[0, 2], contacts[0, 4] = t, v1, 0.0
    start[0], integral[0] = t, 0.0
    while n < degrees.size and count < contacts.shape[0]:
        check_time()
        # the wave that arrives: piece j, from its own origin to ours
        arrival_end = 1.0 if j < 0 else (start[j + 1] if j + 1 < n else t) + 1.0
        if arrival_end - t <= 1e-15 * arrival_end:
            j += 1
            first = True
            continue
        degree = _arriving(j, _offset(t, j, first, kappa, start), reflection, coefficients, degrees, work.incoming)
        length = kappa * (min(arrival_end, until) - t)
        if length <= 0.0:
            status = STOPPED
            break
        if touching:
            x, degree, v1, peak = _pressing(v1, j >= 0, degree, length, work)
            contacts[count - 1, 4] = max(contacts[count - 1, 4], peak)
        else:
            for k in range(degree + 1):
                work.outgoing[k] = -work.incoming[k]
            x, gap, opened = _first_touch(gap, opened, v1, work.incoming, degree, length, kappa, work)
        changes, end = x <= length, min(x, length)
        if end > 0.0:
            _write(n, degree, end, kappa, work.outgoing, coefficients, degrees, integral)
            reached = arrival_end if end == length and arrival_end <= until else t + end / kappa
            first = reached == arrival_end
            j += 1 if first else 0
            n += 1
            t = start[n] = reached
        if changes and touching:
            touching, opened, gap = False, False, 0.0
            offset = _offset(t, j, first, kappa, start)
            _write_parting(contacts[count - 1], t, v1, n, j, offset, reflection, kappa, coefficients, degrees, integral)
        elif changes:
            touching = True
            contacts[count, 0], contacts[count, 2], contacts[count, 4] = t, v1, 0.0
            count += 1
        elif not touching:
            drift = -v1 if reflection > 0.0 else (1.0 - v1) / beta - v1
            if until >= FOREVER and drift > 0.0 and t >= contacts[count - 1, 1] + period:
                status = PARTED
                break
        if t >= until:
            status = STOPPED
            break
    if touching:
        contacts[count - 1, 1], contacts[count - 1, 3] = t, v1
        contacts[count - 1, 5], contacts[count - 1, 6] = np.nan, v1
    return status, n, count


@inner_kernel
def _piece(t, after, start, count):
    """Which piece of s holds at t > 0; at a jump the one after it, or before it if not `after`."""
    low, high = 0, count
    while high - low > 1:
        middle = (low + high) // 2
        if start[middle] < t or (after and start[middle] == t):
            low = middle
        else:
            high = middle
    return low


@inner_kernel
def wave_at(t, after, kappa, start, coefficients, degrees):
    """s(t); at a jump the value after it, or before it if not `after`."""
    if t < 0.0 or (t == 0.0 and not after):
        return 0.0
    n = _piece(t, after, start, degrees.size)
    x = kappa * (t - start[n])
    return np.exp(-x) * value(coefficients[n], degrees[n], x)


@inner_kernel
def total_at(t, kappa, start, coefficients, degrees, integral):
    """Integral of s from 0 to t."""
    if t < 0.0:
        return 0.0
    n = _piece(t, np.bool_(True), start, degrees.size)  # no literal: it would be compiled once more
    return integral[n] + decaying_integral(coefficients[n], degrees[n], 0.0, kappa * (t - start[n])) / kappa


@kernel
def sample(times, after, kappa, start, coefficients, degrees, integral, wave, total):
    """Write s(t) and its integral from 0 for `times`; at a jump the value after it, or before it if not `after`.

    An empty `total` asks for s alone.
    """
    for i in range(times.size):
        wave[i] = wave_at(times[i], after, kappa, start, coefficients, degrees)
        if total.size:
            total[i] = total_at(times[i], kappa, start, coefficients, degrees, integral)


@kernel
def stored_energy(begin, end, kappa, start, coefficients, degrees):
    """Integral of s(t)^2 over [begin, end], for 0 <= begin."""
    total = 0.0
    for j in range(degrees.size):
        a, b = max(begin, start[j]), min(end, start[j + 1])
        x = kappa * (a - start[j])
        last = kappa * (b - start[j])
        while x < last:
            stop = min(last, x + WINDOW) if x < HORIZON else last
            half, middle = 0.5 * (stop - x), 0.5 * (x + stop)
            for k in range(GAUSS_NODES.size):
                y = middle + half * GAUSS_NODES[k]
                total += half * GAUSS_WEIGHTS[k] * (np.exp(-y) * value(coefficients[j], degrees[j], y)) ** 2 / kappa
            x = stop
    return total
