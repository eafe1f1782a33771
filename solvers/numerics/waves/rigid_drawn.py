"""The impact of a rigid mass on a uniform rod as a picture needs it: see `drawn`."""

import numpy as np

from ...jit.clock import check_time
from ...jit.kernels import inner_kernel, kernel
from .drawn import NO_ROOM, SOLVED, history_of, instant, samples_of
from .rigid import FOREVER, PARTED, strike, total_at, wave_at
from .rigid_figures import FIGURES, figures

# what `answer` writes into `out`, after the figures of `rigid_figures.figures`
PIECES, CONTACTS, REACH, SHOWN, WAVE_POINTS, FORCE_POINTS = range(FIGURES, FIGURES + 6)
COLUMNS = FIGURES + 6


@inner_kernel
def _jumps(contacts, reach, found):
    """Write when the wave may jump or bend, in order: every event and every return of one. How many; -1: no room."""
    trips, count = int(np.floor(reach)) + 1, 0
    if 2 * contacts.shape[0] * trips > found.size:
        return -1
    for k in range(2 * contacts.shape[0]):
        event = contacts[k // 2, k % 2]
        for trip in range(trips):
            at = event + trip
            place = count
            while place > 0 and found[place - 1] > at:
                place -= 1
            if at > reach or (place > 0 and found[place - 1] == at):
                continue
            for later in range(count, place, -1):
                found[later] = found[later - 1]
            found[place] = at
            count += 1
    return count


@inner_kernel
def _wave_either_side(t, reach, kappa, start, coefficients, degrees):
    """The wave before and after t; at the end of the time solved no value after a jump is known."""
    before = wave_at(t, np.bool_(False), kappa, start, coefficients, degrees)
    return before, before if t >= reach else wave_at(t, np.bool_(True), kappa, start, coefficients, degrees)


@inner_kernel
def _pressing(t, after, contacts):
    """Whether they touch just before t, or just after."""
    for k in range(contacts.shape[0]):
        start, end = contacts[k, 0], contacts[k, 1]
        if (start <= t < end) if after else (start < t <= end):
            return True
    return False


@inner_kernel
def _force_either_side(t, reach, reflection, contacts, kappa, start, coefficients, degrees):
    before, after = _wave_either_side(t, reach, kappa, start, coefficients, degrees)
    back = wave_at(t - 1.0, np.bool_(False), kappa, start, coefficients, degrees)
    back_after = back if t >= reach else wave_at(t - 1.0, np.bool_(True), kappa, start, coefficients, degrees)
    before = max(before + reflection * back, 0.0) if _pressing(t, np.bool_(False), contacts) else 0.0
    after = max(after + reflection * back_after, 0.0) if _pressing(t, np.bool_(True), contacts) else 0.0
    return before, after


_wave_history, _force_history = history_of(_wave_either_side), history_of(_force_either_side)


@inner_kernel
def _motions(last, reflection, contacts, kappa, start, coefficients, degrees, integral, mass, end, whole):
    """Write the paths of mass and struck end, together while they touch, and of the centre of the rod, (4.29)."""
    moved, before = 0.0, 0.0
    for i in range(mass.size):
        if i % 16 == 0:
            check_time()
        t = instant(i, mass.size, last)
        now = total_at(t, kappa, start, coefficients, degrees, integral)
        half = total_at(t - 0.5, kappa, start, coefficients, degrees, integral)
        back = total_at(t - 1.0, kappa, start, coefficients, degrees, integral)
        speed = 2.0 * ((now - half) - reflection * (half - back))
        moved += 0.5 * last / (mass.size - 1) * (before + speed)
        mass[i] = end[i] = now - reflection * back
        whole[i], before = moved, speed
        for k in range(contacts.shape[0]):
            touches = contacts[k + 1, 0] if k + 1 < contacts.shape[0] else np.inf
            if not np.isnan(contacts[k, 5]) and contacts[k, 1] <= t <= touches:
                mass[i] = contacts[k, 5] + contacts[k, 3] * (t - contacts[k, 1])


@kernel
def answer(beta, reflection, afterglow, points, sent, drawn, out):
    """Solve an impact until the bodies part for good, and write what is drawn of it, `afterglow` T beyond that.

    points: even times of the wave; sent: `rigid.Pieces`; drawn: `Drawn`; out (COLUMNS,). Returns SOLVED, or NO_ROOM.
    """
    status, pieces, count = strike(beta, reflection, FOREVER, sent)
    if status != PARTED:
        return NO_ROOM
    kappa, contacts = 2.0 * beta, sent.contacts[:count]
    start, coefficients, degrees = sent.start[: pieces + 1], sent.coefficients[:pieces], sent.degrees[:pieces]
    integral, reach = sent.integral[: pieces + 1], sent.start[pieces]
    last = min(contacts[count - 1, 1] + afterglow, reach)
    found = _jumps(contacts, reach, drawn.jumps)
    if found < 0:
        return NO_ROOM
    jumps = drawn.jumps[:found]
    figures(last, beta, reflection, start, coefficients, degrees, integral, contacts, out)
    wave = kappa, start, coefficients, degrees
    sent, force = (last, *wave), (reach, reflection, contacts, *wave)
    out[WAVE_POINTS] = _wave_history(points, last, jumps, sent, drawn.wave_time, drawn.wave)
    out[FORCE_POINTS] = _force_history(samples_of(last), last, jumps, force, drawn.force_time, drawn.force)
    _motions(last, reflection, contacts, *wave, integral, drawn.mass, drawn.end, drawn.whole)
    out[PIECES], out[CONTACTS], out[REACH], out[SHOWN] = pieces, count, reach, last
    return SOLVED
