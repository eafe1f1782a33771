"""Contacts of a node of a chain of rods (see `network`): stretches of time in which its faces press on each other."""

import numpy as np

from ...jit.kernels import kernel
from .collocation import SLOPE_AT_END, STAGES
from .laws import DENT
from .record import DEPTH, FORCE, OUT_LEFT, OUT_RIGHT, POINTS

# Times the tolerance of a solution. Echoes bring a damped surface back to just where it has stopped to press, where
# rounding would decide whether it does.
SILENT = 1e3
ROUNDING = 1e-12  # of the waves at a contact, and of v T: less force, and less of an opening, is none


@kernel
def end_of(record, node, last):
    """When a contact ends whose last stretch is `last`, as `periods` finds it.

    Where damping stops the surface from pressing, a stretch of `events.SHORT_STEP` at most crosses that corner of the
    force: there the force of the stretch before, which is smooth, is followed to its root.
    """
    begin, end = record.start[node, last], record.start[node, last + 1]
    presses_on = record.values[node, last, FORCE, STAGES] > 0.0
    if last == 0 or last + 1 == record.count[node] or presses_on or not record.closed[node, last + 1]:
        return end  # at their dent, or not at all
    before, slope = record.values[node, last - 1, FORCE], 0.0
    for i in range(POINTS):
        slope += SLOPE_AT_END[i] * before[i] / (begin - record.start[node, last - 1])
    if not (before[STAGES] > 0.0 and slope < 0.0):
        return end
    return min(begin - before[STAGES] / slope, end)


@kernel
def periods(record, node, tension, law, constants, remembers, silent, slopes, out):
    """Write the numbers of the first and the last stretch of every contact of a node, (contacts, 2); returns how many.

    Faces that stay together without force, as two equal rods do, do not press; openings no larger than rounding, from
    the dent that is left, part nothing. tension: of a bonded joint, whose period runs from its first force to its last.
    law, constants, remembers: as `network.solve` takes them; silent: of the largest force of a contact; where damping
    has stopped the surface from pressing, less than this is no force anew; slopes (2,): room. -1: `out` has no room.
    """
    known, first, last, deepest, largest = 0, -1, -1, 0.0, 0.0
    for n in range(record.count[node] + 1):
        together, presses, felt = False, False, 0.0
        if n < record.count[node]:
            values, waves, least = record.values[node, n], 0.0, np.inf
            for i in range(POINTS):
                force, left, right = values[FORCE, i], values[OUT_LEFT, i], values[OUT_RIGHT, i]
                felt = max(felt, abs(force) if tension else force)
                waves = max(waves, abs(left), abs(right), abs(force - left), abs(force - right))
                least = min(least, values[DEPTH, i])
            deepest = max(deepest, values[DEPTH, STAGES])
            dent = law(DENT, constants, 0.0, 0.0, deepest, slopes) if remembers else 0.0
            presses = record.closed[node, n] and felt > ROUNDING * waves
            together = record.closed[node, n] or least - dent > -ROUNDING
        if together and presses:
            largest = max(largest if first >= 0 else 0.0, felt)
            first = n if first < 0 else first
            last = n if n == last + 1 or felt > silent * largest else last
        if not together and first >= 0:
            if known == out.shape[0]:
                return -1
            out[known, 0], out[known, 1] = first, last
            known, first = known + 1, -1
    return known
