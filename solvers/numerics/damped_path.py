"""Two compact bodies pressed together by a law with damping: mu a'' = -F(a, a'), as kernels.

In the root z of the indentation, while time runs by dt = 2 z ds: what meets at a speed then begins smoothly, and parts
so. By collocation; the deepest indentation and the parting are instants of their own.
"""

import math

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from .quadrature import gauss_within
from .waves.laws import FORCE, STORED

STAGES = 6
ROWS = 3  # of room (ROWS, STAGES) for a step: root, rate and pull at each stage
SWING, SLOWED = 1.0 / 64.0, 0.25  # the longest step: a share of a radian, and of the time in which damping acts
WIDTH = 0.5  # about the largest root
USUAL = 500  # instants; most contacts have fewer
FAINT = 1e-10  # times the force without damping: what presses less has parted, before rounding alone presses
TOUCHED = 1e-300  # indentation of faces that have just met: a law whose force jumps then presses
SETTLED, ITERATIONS = 1e-16, 100  # of all stages, beside one
HALVINGS = 60  # of a step, to its last bit
_NODES, _WEIGHTS, _INTEGRATE = gauss_within(STAGES)


@inner_kernel
def _pull(asked, constants, slopes, units, root, rate):
    """dw / ds, with w the rate; leaves the slopes of the force. units: of indentation, rate and force."""
    depth = units[0] * root * root if root > 0.0 else 0.0
    return -2.0 * root * asked(FORCE, constants, depth, units[1] * rate, 0.0, slopes) / units[2]


@inner_kernel
def _longest(asked, constants, slopes, units, root, rate):
    """How long a step may be from here."""
    depth = units[0] * root * root
    force = asked(FORCE, constants, depth, units[1] * rate, 0.0, slopes)
    stiff = 2.0 * (force + 2.0 * depth * slopes[0]) / units[2]
    damping = 2.0 * root * slopes[1] * units[1] / units[2]
    return 1.0 / ((math.sqrt(max(stiff, 0.0)) + abs(rate) / WIDTH) / SWING + damping / SLOWED)


@inner_kernel
def _stepped(asked, constants, slopes, units, root, rate, step, cell):
    """Root, rate and the time gone by after a step, whose stages are written into `cell`."""
    for i in range(STAGES):
        cell[0, i], cell[1, i] = root + step * _NODES[i] * rate, rate
    for _ in range(ITERATIONS):
        change = 0.0
        for i in range(STAGES):
            cell[2, i] = _pull(asked, constants, slopes, units, cell[0, i], cell[1, i])
        for row, start in ((1, rate), (0, root)):
            for i in range(STAGES):
                gone = 0.0
                for j in range(STAGES):
                    gone += _INTEGRATE[i, j] * cell[row + 1, j]
                change = max(change, abs(start + step * gone - cell[row, i]))
                cell[row, i] = start + step * gone
        if change <= SETTLED:
            break
    moved, slowed, time = 0.0, 0.0, 0.0
    for i in range(STAGES):
        moved += _WEIGHTS[i] * cell[1, i]
        slowed += _WEIGHTS[i] * cell[2, i]
        time += _WEIGHTS[i] * 2.0 * cell[0, i]
    return root + step * moved, rate + step * slowed, step * time


@inner_kernel
def _goes_on(asked, constants, slopes, units, loading, root, rate):
    """Whether bodies come closer, while they have done so until now, or then still press."""
    if loading:
        return rate > 0.0
    pull = _pull(asked, constants, slopes, units, root, rate)
    return root > 0.0 and pull < FAINT * _pull(asked, constants, slopes, units, root, 0.0)


@inner_kernel
def _followed(asked, constants, slopes, units, loading, root, rate, cell):
    """Root, rate and the time gone by after a step, and whether what went on before has ended with it."""
    part = most = _longest(asked, constants, slopes, units, root, rate)
    least, halvings = 0.0, 0
    while True:
        there = _stepped(asked, constants, slopes, units, root, rate, part, cell)
        if halvings == HALVINGS:
            return there[0], there[1], there[2], True
        if _goes_on(asked, constants, slopes, units, loading, there[0], there[1]):
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
    STAGES). What creeps back without a force is flight.
    """
    units = speed * unit, speed, mass * speed / unit
    root, rate, time, loading, parted = 0.0, 1.0, 0.0, True, False
    for k in range(course.time.size):
        check_time()
        depth, force, stored = units[0] * root * root, 0.0, 0.0
        if not parted:
            force = asked(FORCE, constants, max(depth, TOUCHED), speed * rate, 0.0, slopes)
            stored = asked(STORED, constants, depth, 0.0, depth, slopes)
        course.time[k], course.indentation[k], course.rate[k] = unit * time, depth, speed * rate
        course.force[k], course.impulse[k], course.stored[k] = force, mass * speed * (1.0 - rate), stored
        course.lost[k] = max(0.5 * mass * speed * speed * (1.0 - rate) * (1.0 + rate) - stored, 0.0)
        if parted:
            return k + 1
        root, rate, gone, ended = _followed(asked, constants, slopes, units, loading, root, rate, cell)
        time += gone
        parted, loading = ended and not loading, loading and not ended
    return -1
