"""Contacts of bodies known by their modes: when they press on each other, and what of that is chatter."""

import math
from typing import NamedTuple

import numpy as np

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from ..jit.reference import refer
from .arrays import largest
from .waves.laws import DENT, FORCE

# Of what the modes left out give way under the peak force: who opens by less may still be touching. Measured on exact
# waves, mass ratios 0.02 to 50 on fixed and free rods, 20 to 200 modes: false gaps stay below, true ones open wider.
LEAST_OPENING = 0.4
# Share of the rate by which a dent closes that is rounding: strong damping lets it close at the very rate at which the
# force is zero, and the steps in which there is one are a matter of the last bits.
ROUNDING = 1e-9
JUST_TOUCHING = 1e-300  # depth [m] of faces that have just met: they press already if the law's force jumps
START, END, IMPULSE, PEAK = range(4)  # columns of the contacts
COLUMNS = 4


class Resolved(NamedTuple):
    """What the kept modes can tell of a march."""

    step: float  # [s]
    window: float  # shortest kept period [s]: nothing finer is known; 0 if no mode is left out
    opening: float  # `least_opening` [m]
    every_gap: bool  # whether no contact can chatter
    rigid: bool
    gives: bool  # whether the modes left out give way, or all there is of a rigid contact
    parted: bool  # whether the march has gone on until none can come any more


@kernel
def gathered(record, step, deepest, impulses):
    """Write the largest indentation so far and the impulse so far at every instant, (steps + 1,)."""
    record = refer(record)
    most, impulse = 0.0, 0.0
    deepest[0], impulses[0] = max(record.indentation[0], 0.0), 0.0
    for k in range(record.contact_force.size):
        most = max(most, record.indentation[k], record.indentation[k + 1])
        impulse += record.contact_force[k]
        deepest[k + 1], impulses[k + 1] = most, impulse * step


@inner_kernel
def between(time, step, values):
    """A history known at the instants, at any time: straight between them."""
    place = min(max(time / step, 0.0), values.size - 1.0)
    k = min(int(place), values.size - 2)
    return values[k] + (place - k) * (values[k + 1] - values[k])


@inner_kernel
def _resolved(time, step, window, force, impulses):
    if window == 0.0:
        return force[min(max(int(time / step + 1e-9), 0), force.size - 1)]
    half = 0.5 * window
    return (between(time + half, step, impulses) - between(time - half, step, impulses)) / window


@kernel
def resolve(time, step, window, force, impulses, found):
    """Write the force averaged over a window about each time, the finest that the kept modes resolve, (times,)."""
    for k in range(time.size):
        found[k] = _resolved(time[k], step, window, force, impulses)


@inner_kernel
def _highest(first, last, step, window, force, impulses):
    """The largest resolved force at the instants from one to another."""
    found = 0.0
    for k in range(first, last + 1):
        if k % 4096 == 0:
            check_time()
        found = max(found, _resolved(k * step, step, window, force, impulses))
    return found


@kernel
def least_opening(compliance, step, window, force, impulses):
    """How far faces must part before modes resolve it [m]; compliance: of those left out [m/N]."""
    return LEAST_OPENING * compliance * _highest(0, force.size, step, window, force, impulses)


@kernel
def pressed(force, until):
    """How many steps it took, of `until`, to the end of the last one with a force; 0: there is none."""
    while until > 0 and force[until - 1] == 0.0:
        until -= 1
    return until


@inner_kernel
def _closes(k, record, step, deepest, law, constants, slopes):
    """Whether a dent closes within this step without a force, and yet as slowly as the law lets it: not parted yet."""
    depth, later = record.indentation[k], record.indentation[k + 1]
    rate = (1.0 - ROUNDING) * (later - depth) / step
    return later < depth and law(FORCE, constants, depth, rate, deepest, slopes) > 0.0


@kernel
def closed(last, until, record, step, law, constants, slopes):
    """The first instant from `last` on, up to which there was a force, at which no dent closes any more; or `until`."""
    record = refer(record)
    deepest = max(largest(record.indentation, last + 1), 0.0)
    while last < until and _closes(last, record, step, deepest, law, constants, slopes):
        last += 1
    return last


@kernel
def touches(record, step, deepest, law, constants, slopes, runs):
    """Write the first step, and the one after the last, of every stretch of steps with a force, and as long as the dent
    closes behind it; how many."""
    record = refer(record)
    force, count, pressed = record.contact_force, 0, np.bool_(False)
    for k in range(force.size + 1):
        presses = k < force.size and force[k] > 0.0
        if pressed and not presses and k < force.size:
            presses = _closes(k, record, step, deepest[k], law, constants, slopes)
        if presses != pressed:
            runs[count, 0 if presses else 1] = k
            count += 0 if presses else 1
        pressed = presses
    return count


@inner_kernel
def _apart(first, last, record, known, dent):
    """Whether faces truly part between these instants: for longer than a window, and by what the modes resolve."""
    if known.every_gap:
        return True
    if (last - first) * known.step < known.window:
        return False
    least = record.indentation[first]
    for k in range(first + 1, last + 1):
        least = min(least, record.indentation[k])
    return dent - least > known.opening


@inner_kernel
def _upward_zero(before, x, y):
    """Where between x <= 0 (at 0) and y (at 1) the parabola through both and `before` (at -1) rises through zero."""
    bend = 0.5 * (before - 2.0 * x + y)
    slope = (y - x) - bend
    square = slope * slope - 4.0 * bend * x
    if square > 0.0 and slope + math.sqrt(square) > 0.0:
        place = -2.0 * x / (slope + math.sqrt(square))
        if place <= 1.0:
            return place
    return min(-x / (y - x), 1.0) if y > 0.0 else 1.0


@kernel
def run_out(first, second, third):
    """How many steps after three steps with these mean forces the force comes to zero: from 0 to 2."""
    # forces in the middle of the steps; the parabola through them, from the last one on
    slope, bend = 0.5 * (3.0 * third - 4.0 * second + first), 0.5 * (third - 2.0 * second + first)
    square = slope * slope - 4.0 * bend * third
    if square <= 0.0 or slope - math.sqrt(square) >= 0.0:
        return 1.0
    return min(max(-2.0 * third / (slope - math.sqrt(square)) - 0.5, 0.0), 2.0)


@inner_kernel
def _start(first, record, known, dent):
    """When faces met [s], in the first step with a force."""
    depth = record.indentation
    if first == 0 or depth[first] >= dent:
        return first * known.step
    before, x, y = depth[first - 1] - dent, depth[first] - dent, depth[first + 1] - dent
    return known.step * (first + _upward_zero(before, x, y))


@inner_kernel
def _first_force(first, start, record, known, law, constants, slopes):
    """The force as faces meet [N], which the first step's mean falls short of where the law's force jumps."""
    if known.gives:  # at once: there is no jump
        return 0.0
    depth, rate = record.indentation, record.velocity[0] - record.rigid_velocity[0]
    if first > 0:
        rate = depth[first] - depth[first - 1]
        if first > 1:
            rate += (rate - (depth[first - 1] - depth[first - 2])) * (0.5 + start / known.step - first)
        rate /= known.step
    return law(FORCE, constants, JUST_TOUCHING, rate, 0.0, slopes)


@inner_kernel
def _end(after, record, known, dent):
    """When the force ran out [s], in the step before instant `after`; the end, if that comes too soon."""
    depth, force, step = record.indentation, record.contact_force, known.step
    steps = force.size
    gap = depth[after] - dent
    if after == steps and gap > 0.0:
        return steps * step
    if not known.parted and after < steps and not known.every_gap:
        least = depth[after]
        for k in range(after + 1, steps + 1):
            least = min(least, depth[k])
        opened = dent - least
        if (steps - after) * step < known.window or 0.0 < opened <= known.opening:
            return steps * step
    if gap > 0.0:  # damping has used up the force before the faces were apart; it is smooth up to there
        lasts = run_out(force[after - 4], force[after - 3], force[after - 2]) if after >= 4 else 1.0
        return step * (after - 1 + lasts)
    later, before = depth[min(after + 1, steps)] - dent, depth[after - 1] - dent
    return step * (after - _upward_zero(later, gap, before))


@kernel
def unsure(record, deepest, runs, known, longest, law, constants, slopes):
    """How many gaps between touches are not counted, and yet take more steps than `longest`."""
    record, known, count = refer(record), refer(known), 0
    for k in range(runs.shape[0] - 1):
        end, start = runs[k, 1], runs[k + 1, 0]
        dent = law(DENT, constants, 0.0, 0.0, deepest[end], slopes)
        count += 1 if start - end > longest and not _apart(end, start, record, known, dent) else 0
    return count


@kernel
def contacts(record, deepest, impulses, runs, known, law, constants, slopes, table):
    """Write contact periods as far as the modes resolve them, (contacts, COLUMNS) [s, N s, N]; how many, -1: no room.

    deepest, impulses: as `gathered`; runs: all that `touches` finds; law, constants: `waves.laws.law_function`; slopes
    (2,): room.
    """
    record, known, count = refer(record), refer(known), 0
    force, step, begun, anew = record.contact_force, known.step, 0, True
    for k in range(runs.shape[0]):
        first, after = runs[k, 0], runs[k, 1]
        dent = law(DENT, constants, 0.0, 0.0, deepest[first], slopes)
        if anew:
            if count == table.shape[0]:
                return -1
            begun, count = first, count + 1
            table[count - 1, START] = _start(first, record, known, dent)
        dent = law(DENT, constants, 0.0, 0.0, deepest[after], slopes)
        anew = k + 1 == runs.shape[0] or _apart(after, runs[k + 1, 0], record, known, dent)
        if not anew:
            continue
        check_time()  # before the end, which looks for who opens later in all steps
        row = table[count - 1]
        row[IMPULSE], row[PEAK] = impulses[after] - impulses[begun], force[begun]
        if known.rigid:
            row[PEAK] = _highest(begun, after, step, known.window, force, impulses)
        else:
            row[PEAK] = max(row[PEAK], _first_force(begun, row[START], record, known, law, constants, slopes))
            for pressed in range(begun + 1, after):
                row[PEAK] = max(row[PEAK], force[pressed])
        row[END] = _end(after, record, known, dent)
    return count
