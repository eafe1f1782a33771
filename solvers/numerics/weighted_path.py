"""A compact body that its weight presses on what is held: mu a'' = mu g - F(a, a', deepest), as kernels.

Any law, with damping or memory or neither, by the steps of `path_steps`; the largest force, corners of the law, turning
points and the parting are instants of their own.

The body leaves when nothing presses any more and its speed carries it beyond where the contact opens. Once kinetic
energy, what the contact stores and the height cannot do that, it never leaves: it is followed until it rests.
"""

import math

import numpy as np

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from .path_steps import HALVINGS, longest, push, rises, stepped
from .waves.laws import CORNER, DENT, STORED

RESTING = 1e-6  # of the largest speed, and of the weight: what is left of either when a body rests
RISING, CLOSING, OPENING, SILENT = range(4)  # of a stretch: what ends it is written at `_goes_on`
NO_ROOM, LEFT, RESTS, GOES_ON = range(4)  # how `follow_weighted` has ended


@inner_kernel
def _goes_on(asked, constants, slopes, scales, memory, corner, phase, root, rate):
    """Whether the force still grows; the bodies come closer, up to the next corner of the law; still open, and press;
    do not press."""
    if phase == SILENT:
        return root > 0.0 and push(asked, constants, slopes, scales, memory, root, rate) <= 0.0
    if phase != OPENING:
        closes = rate > 0.0 and memory[0] + scales[0] * root * root < corner
        return closes and (phase == CLOSING or rises(asked, constants, slopes, scales, memory, root, rate))
    return rate < 0.0 and root > 0.0 and push(asked, constants, slopes, scales, memory, root, rate) > 0.0


@inner_kernel
def _followed(asked, constants, slopes, scales, memory, corner, phase, root, rate, cell):
    """Root, rate and the time gone by after a step, and whether the stretch has ended with it."""
    part = most = longest(asked, constants, slopes, scales, memory, root, rate)
    least, halvings = 0.0, 0
    while True:
        there = stepped(asked, constants, slopes, scales, memory, root, rate, part, cell)
        if halvings == HALVINGS:
            return there[0], there[1], there[2], True
        if _goes_on(asked, constants, slopes, scales, memory, corner, phase, there[0], there[1]):
            if halvings == 0:
                return there[0], there[1], there[2], False
            least = part
        else:
            most = part
        halvings += 1
        part = 0.5 * (least + most) if halvings < HALVINGS else most


@inner_kernel
def _kept(asked, constants, slopes, memory, scales, root, rate):
    """Of kinetic energy, what the contact stores, and height above where it opens, in their unit: above zero it may
    leave."""
    depth = scales[0] * root * root
    stored = asked(STORED, constants, memory[0] + depth, 0.0, max(memory[1], memory[0] + depth), slopes)
    return 0.5 * rate * rate + stored / (scales[0] * scales[2]) - scales[3] * root * root


@inner_kernel
def _write(course, k, begun, scales, now):
    """An instant of the contact; begun: mass, speed, energy and indentation at the touch; now: time, indentation, rate
    in its unit, force, energy stored. What is left of the energy is lost to the law."""
    mass, speed, energy, opens = begun
    time, depth, rate, pressed, stored = now
    fall, moves = scales[3] * scales[2] / mass, scales[1] * rate
    course.time[k], course.indentation[k], course.rate[k] = time, depth, moves
    course.force[k], course.stored[k] = pressed, stored
    course.impulse[k] = mass * (speed - moves + fall * time)
    course.lost[k] = max(energy + mass * fall * (depth - opens) - 0.5 * mass * moves * moves - stored, 0.0)


@kernel
def follow_weighted(asked, constants, slopes, start, scales, cell, course):
    """Write the whole contact; how it has ended, at how many instants, and whether it can never leave.

    asked: `waves.laws.law_function`; slopes: room for it (2,); start: reduced mass [kg], speed at the touch [m/s],
    the deepest indentation of earlier contacts [m], and after how many swings it is followed no longer; scales: units
    of indentation, rate and force, with force = mass * rate^2 / indentation, and the weight in that; cell: room (ROWS,
    STAGES).
    """
    mass, speed, deepest, swings = start
    unit = scales[0] / scales[1]
    opens = asked(DENT, constants, 0.0, 0.0, deepest, slopes)
    memory, root, rate, time = (opens, deepest), 0.0, speed / scales[1], 0.0
    corner = min(asked(CORNER, constants, opens, 0.0, deepest, slopes), deepest if deepest > 0.0 else math.inf)
    first = asked(STORED, constants, opens, 0.0, deepest, slopes)
    phase = RISING if rises(asked, constants, slopes, scales, memory, root, rate) else CLOSING
    bound, turns, energy = np.bool_(False), 0, 0.5 * mass * speed * speed + first
    for k in range(course.time.size):
        check_time()
        depth = memory[0] + scales[0] * root * root
        pressed = scales[2] * push(asked, constants, slopes, scales, memory, root, rate)
        stored = asked(STORED, constants, depth, 0.0, max(memory[1], depth), slopes)
        _write(course, k, (mass, speed, energy, opens), scales, (unit * time, depth, rate, pressed, stored))
        if abs(rate) <= RESTING and abs(pressed / scales[2] - scales[3]) <= RESTING * scales[3]:
            return RESTS, k + 1, bound
        root, rate, gone, ended = _followed(asked, constants, slopes, scales, memory, corner, phase, root, rate, cell)
        time += gone
        if not ended:
            continue
        depth = memory[0] + scales[0] * root * root
        if phase != OPENING and phase != SILENT and rate > 0.0 and depth >= corner:
            if depth >= memory[1] > 0.0:  # beyond where it has ever been: on the first way in again
                root, memory = math.sqrt(depth / scales[0]), (0.0, 0.0)
            corner = asked(CORNER, constants, depth, 0.0, memory[1], slopes)
            if corner <= depth:
                corner = math.inf
        elif phase == RISING and rate > RESTING:
            phase = CLOSING
        elif phase <= CLOSING:
            if memory[1] == 0.0:
                dent = asked(DENT, constants, 0.0, 0.0, depth, slopes)
                if dent > 0.0:
                    memory, root = (dent, depth), math.sqrt(max(depth - dent, 0.0) / scales[0])
            phase, rate = OPENING, min(rate, 0.0)
            bound = bound or _kept(asked, constants, slopes, memory, scales, root, 0.0) < 0.0
        elif phase == OPENING and rate >= 0.0 and root > 0.0:
            phase, corner = CLOSING, memory[1] if memory[1] > 0.0 else math.inf
            bound, turns = np.bool_(True), turns + 1
            if turns >= swings:
                return GOES_ON, k + 1, bound
        elif phase == SILENT and root > 0.0:
            phase = OPENING if rate < 0.0 else CLOSING
        elif root <= 0.0 or 0.5 * rate * rate >= scales[3] * root * root:
            if k + 1 == course.time.size:
                break
            depth = memory[0] + scales[0] * max(root, 0.0) ** 2
            _write(course, k + 1, (mass, speed, energy, opens), scales, (unit * time, depth, rate, 0.0, 0.0))
            return LEFT, k + 2, bound
        else:
            phase = SILENT
    return NO_ROOM, course.time.size, bound
