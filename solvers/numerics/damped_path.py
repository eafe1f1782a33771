"""Two compact bodies pressed together by a law with damping: mu a'' = -F(a, a'), as kernels.

By the steps of `path_steps`; the largest force, the deepest indentation and the parting are instants of their own.
"""

import math

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from .path_steps import HALVINGS, TOUCHED, longest, push, rises, stepped
from .waves.laws import FORCE, STORED

ANEW = (0.0, 0.0)  # faces without a dent, never pressed before
USUAL = 500  # instants; most contacts have fewer
FAINT = 1e-12  # times the force without damping: what presses less goes on at its speed, before rounding alone presses
CREPT = 50  # instants until it has parted, where it presses as faintly all the way
SLOW = 1e-6  # of the speed: as deep as it gets, but for a part in 1e12
RISING, CLOSING, OPENING, CREEPING, PARTED = range(5)


@inner_kernel
def _pull(asked, constants, slopes, scales, root, rate):
    """dw / ds, with w the rate; leaves the slopes of the force."""
    return -2.0 * root * push(asked, constants, slopes, scales, ANEW, root, rate)


@inner_kernel
def _goes_on(asked, constants, slopes, scales, phase, root, rate):
    """Whether the force still grows, the bodies still come closer, or still press."""
    if phase == RISING:
        return rises(asked, constants, slopes, scales, ANEW, root, rate)
    if phase == CLOSING:
        return rate > 0.0
    pull = _pull(asked, constants, slopes, scales, root, rate)
    return root > 0.0 and pull < FAINT * _pull(asked, constants, slopes, scales, root, 0.0)


@inner_kernel
def _after(asked, constants, slopes, scales, phase, root, rate):
    """What follows a phase. Damping that grows with the indentation as the force does may leave a faint one until it is
    none; other damping outweighs it all at once.
    """
    if phase == RISING and rate > SLOW:
        return CLOSING
    if phase != OPENING:
        return OPENING
    faint = 2.0 * FAINT * _pull(asked, constants, slopes, scales, root, 0.0)
    creeps = _pull(asked, constants, slopes, scales, root, rate) > faint
    return CREEPING if creeps and _pull(asked, constants, slopes, scales, 0.5 * root, rate) < 0.0 else PARTED


@inner_kernel
def _followed(asked, constants, slopes, scales, phase, root, rate, cell):
    """Root, rate and the time gone by after a step, and whether the phase has ended with it."""
    part = most = longest(asked, constants, slopes, scales, ANEW, root, rate)
    least, halvings = 0.0, 0
    while True:
        there = stepped(asked, constants, slopes, scales, ANEW, root, rate, part, cell)
        if halvings == HALVINGS:
            return there[0], there[1], there[2], True
        if _goes_on(asked, constants, slopes, scales, phase, there[0], there[1]):
            if halvings == 0:
                return there[0], there[1], there[2], False
            least = part
        else:
            most = part
        halvings += 1
        part = 0.5 * (least + most) if halvings < HALVINGS else least


@kernel
def follow_damped(asked, constants, slopes, mass, speed, unit, cell, course):
    """Write the whole contact; at how many instants, or -1 where there is no room for them.

    asked: `waves.laws.law_function`; slopes: room for it (2,); unit: about how long they touch [s]; cell: room (ROWS,
    STAGES).
    """
    scales = speed * unit, speed, mass * speed / unit, 0.0
    root, rate, time, crept, faint = 0.0, 1.0, 0.0, 0, 0.0
    phase = RISING if rises(asked, constants, slopes, scales, ANEW, root, rate) else CLOSING
    for k in range(course.time.size):
        check_time()
        depth, force, stored = scales[0] * root * root, 0.0, 0.0
        if phase != PARTED:
            force = asked(FORCE, constants, max(depth, TOUCHED), speed * rate, 0.0, slopes)
            stored = asked(STORED, constants, depth, 0.0, depth, slopes)
        course.time[k], course.indentation[k], course.rate[k] = unit * time, depth, speed * rate
        course.force[k], course.impulse[k], course.stored[k] = force, mass * speed * (1.0 - rate), stored
        course.lost[k] = max(0.5 * mass * speed * speed * (1.0 - rate) * (1.0 + rate) - stored, 0.0)
        if phase == PARTED:
            return k + 1
        if phase == CREEPING:
            crept += 1
            root = math.sqrt(faint * (CREPT - crept) / CREPT)
            time -= faint / CREPT / rate
            phase = PARTED if crept == CREPT else CREEPING
            continue
        root, rate, gone, ended = _followed(asked, constants, slopes, scales, phase, root, rate, cell)
        time += gone
        if ended:
            phase = _after(asked, constants, slopes, scales, phase, root, rate)
            faint = root * root
    return -1
