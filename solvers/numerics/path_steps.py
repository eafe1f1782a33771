"""Steps of two compact bodies that any law presses together: mu a'' = W - F(a, a', deepest), as kernels.

In the root z of the indentation over that at which the contact opens, while time runs by dt = 2 z ds: what meets at a
speed then begins smoothly, and parts so. By collocation.
"""

import math

from ..jit.kernels import inner_kernel
from .quadrature import gauss_within
from .waves.laws import FORCE

STAGES = 6
ROWS = 3  # of room (ROWS, STAGES) for a step: root, rate and pull at each stage
SWING, SLOWED = 1.0 / 64.0, 0.25  # the longest step: a share of a radian, and of the time in which damping acts
WIDTH = 0.5  # about the largest root
TOUCHED = 1e-300  # indentation of faces that have just met: a law whose force jumps then presses
SETTLED, ITERATIONS = 1e-16, 100  # of all stages, beside one
HALVINGS = 60  # of a step, to its last bit
_NODES, _WEIGHTS, _INTEGRATE = gauss_within(STAGES)


@inner_kernel
def push(asked, constants, slopes, scales, memory, root, rate):
    """The contact force, in its unit; leaves the slopes. scales: units of indentation, rate and force, and the weight
    in that; memory: indentation at which the contact opens, and the deepest.
    """
    depth = max(memory[0] + scales[0] * root * root, TOUCHED)
    return asked(FORCE, constants, depth, scales[1] * rate, memory[1], slopes) / scales[2]


@inner_kernel
def longest(asked, constants, slopes, scales, memory, root, rate):
    """How long a step may be from here."""
    pressed = push(asked, constants, slopes, scales, memory, root, rate)
    stiff = 2.0 * (pressed + scales[3] + 2.0 * root * root * slopes[0] * scales[0] / scales[2])
    damping = 2.0 * root * slopes[1] * scales[1] / scales[2]
    return 1.0 / ((math.sqrt(max(stiff, 0.0)) + abs(rate) / WIDTH) / SWING + damping / SLOWED)


@inner_kernel
def stepped(asked, constants, slopes, scales, memory, root, rate, step, cell):
    """Root, rate and the time gone by after a step, whose stages are written into `cell`."""
    for i in range(STAGES):
        cell[0, i], cell[1, i] = root + step * _NODES[i] * rate, rate
    for _ in range(ITERATIONS):
        change = 0.0
        for i in range(STAGES):
            pressed = 0.0
            if cell[0, i] > 0.0:
                pressed = push(asked, constants, slopes, scales, memory, cell[0, i], cell[1, i])
            cell[2, i] = 2.0 * cell[0, i] * (scales[3] - pressed)
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
def rises(asked, constants, slopes, scales, memory, root, rate):
    """Whether the force grows."""
    pressed = push(asked, constants, slopes, scales, memory, root, rate)
    return slopes[0] * scales[0] * rate + slopes[1] * scales[1] * (scales[3] - pressed) > 0.0
