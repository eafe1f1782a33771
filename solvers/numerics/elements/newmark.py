"""Time steps of two meshes: Newmark's constant mean acceleration and, for rods, the explicit central difference.

Both touch every unknown once per step. The contact force F presses the unknown `front` back and `other` forward; the
indentation is u[front] - u[other]. Where the second body has no node it does not move, and `other` is -1. Weight gives
the impactor `fall` [m/s2]: fall t^2 / 2 is then added, and u and v are those in the frame that falls with it.
Source: thesis 6.4.1 and 8.2 (delta = 1/2, alpha = 1/4).
"""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import allocating_kernel, inner_kernel, kernel
from ..arrays import add_to, copy_to
from ..law_functions import FORCE, MEMORY, STORED
from .banded import Factors, factorised, solve, substitute, widened
from .line import Line, Wholes

TAKEN_OUT = 4  # steps between which motions as wholes gather in the unknowns: an impact changes them little in so few


class Record(NamedTuple):
    """What a march writes at every instant (steps + 1,), and of all nodes at every stride-th (rows, unknowns)."""

    contact_force: np.ndarray  # [N]
    impulse: np.ndarray  # of the contact so far [N s]
    indentation: np.ndarray  # [m]
    deepest: np.ndarray  # indentation so far [m]
    lost: np.ndarray  # energy dissipated by the law so far [J]
    first: np.ndarray  # displacement of the impactor's face [m]
    first_velocity: np.ndarray
    second: np.ndarray  # displacement of the target's face [m]
    second_velocity: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray


def record(steps: int, stride: int, nodes: int) -> Record:
    return Record(*(np.zeros(steps + 1) for _ in range(9)), *(np.zeros((steps // stride + 1, nodes)) for _ in range(2)))


class Newmark(NamedTuple):
    """What a step needs of a line; `response` (unknowns,) is the displacement under a unit pair of contact forces."""

    factors: Factors
    response: np.ndarray  # [m/N]
    compliance: float  # closing of the faces per newton over one step [m/N]
    inertia: np.ndarray  # 4 M / step, and twice the stiffness: bands
    stiffness: np.ndarray
    front: int
    other: int
    wholes: Wholes


def newmark(line: Line, step: float) -> Newmark:
    """The matrices of (4 M / step^2 + K) du = 4 M v / step - 2 K u - 2 w F, factorised for a step [s]."""
    factors = factorised(4.0 / step**2 * line.mass + line.stiffness)
    response = np.zeros(line.mass.shape[1])
    response[line.front] = 1.0
    if line.other >= 0:
        response[line.other] = -1.0
    solve(factors, response)
    closing = response[line.front] - (response[line.other] if line.other >= 0 else 0.0)
    count = factors.below.shape[0] + 1
    inertia, stiffness = 4.0 / step * widened(line.mass, count), 2.0 * widened(line.stiffness, count)
    return Newmark(factors, response, 2.0 * float(closing), inertia, stiffness, line.front, line.other, line.wholes)


@kernel
def _write(record, k, stride, force, impulse, indentation, deepest, lost, u, v, front, other):
    record.contact_force[k], record.impulse[k], record.indentation[k] = force, impulse, indentation
    record.deepest[k], record.lost[k] = deepest, lost
    record.first[k], record.first_velocity[k] = u[front], v[front]
    if other >= 0:
        record.second[k], record.second_velocity[k] = u[other], v[other]
    if k % stride == 0:
        copy_to(record.displacement[k // stride], u)
        copy_to(record.velocity[k // stride], v)


@inner_kernel
def _take_out(shapes, anchors, spans, u, v, drift):
    """Moves motions as wholes out of the unknowns into `drift` (2, motions), displacements and rates."""
    for m in range(anchors.size):
        moved, rate = u[anchors[m]], v[anchors[m]]
        drift[0, m] += moved
        drift[1, m] += rate
        for i in range(spans[m, 0], spans[m, 1]):
            u[i] -= moved * shapes[m, i]
            v[i] -= rate * shapes[m, i]


@kernel
def _sum(amounts, values, row):
    total = 0.0
    for m in range(values.size):
        total += amounts[row, m] * values[m]
    return total


@inner_kernel
def _free_change(line, u, v, change):
    """Displacements of one step without contact: right-hand side and forward sweep at once, then the backward one."""
    inertia, stiffness = line.inertia, line.stiffness
    below, inverse, broad = line.factors.below, line.factors.inverse, len(line.factors.broad) > 0
    last = u.size - 1
    one = two = three = 0.0  # of the sweep, one row and more above
    left = left_two = left_three = 0.0  # what the rows above pull at the next ones
    for i in range(last + 1):
        u_i, v_i, j = u[i], v[i], min(i + 1, last)
        load = inertia[0, i] * v_i - stiffness[0, i] * u_i + left
        load += inertia[1, i] * v[j] - stiffness[1, i] * u[j]
        left = inertia[1, i] * v_i - stiffness[1, i] * u_i
        if broad:
            j, k = min(i + 2, last), min(i + 3, last)
            load += inertia[2, i] * v[j] - stiffness[2, i] * u[j]
            load += inertia[3, i] * v[k] - stiffness[3, i] * u[k]
            left += left_two
            left_two = left_three + inertia[2, i] * v_i - stiffness[2, i] * u_i
            left_three = inertia[3, i] * v_i - stiffness[3, i] * u_i
            load -= below[1, i] * two + below[2, i] * three
            three, two = two, one
        one = load - below[0, i] * one
        change[i] = one * inverse[i]
    substitute(line.factors, change)


@allocating_kernel
def march_implicit(law, ask, constants, line, fall, step, u, v, drift, stride, begin, end, record):
    """Newmark's step for the bodies; the contact force, constant over it, does exactly the law's work.

    u, v (unknowns,) hold instant `begin` and are advanced to `end`, less motions as wholes, which are in `drift`
    (2, motions): the scheme carries these at constant velocity, and they bend nothing. Error: second order; energy is
    kept to rounding for any law, stiffness and step, as the bodies' part of the step keeps it too.
    law, ask, constants: see `law_functions.stepped`.
    """
    front, other, response, ends = line.front, line.other, line.response, line.other >= 0
    shapes, anchors, spans = line.wholes
    at_front, at_other = shapes[:, front].copy(), shapes[:, other].copy() if ends else np.zeros(anchors.size)
    closing = at_front - at_other
    _take_out(shapes, anchors, spans, u, v, drift)
    change = np.zeros(u.size)
    turn, rate_unit = 2.0 / step, 1.0 / step
    indentation, deepest = record.indentation[begin], record.deepest[begin]
    memory = np.zeros(MEMORY)
    law(constants, 0.0, 0.0, 0.0, 0.0, 0.0, deepest, memory)
    impulse, lost = record.impulse[begin], record.lost[begin]
    force, force_before = 0.0, 0.0
    for k in range(begin, end):
        _free_change(line, u, v, change)
        free = indentation + change[front] - (change[other] if ends else 0.0) + step * _sum(drift, closing, 1)
        free += fall * step * step * (k + 0.5)
        expected = force + force - force_before
        force_before = force
        force = law(constants, indentation, free, line.compliance, rate_unit, expected, deepest, memory)
        indentation = memory[0]
        deepest = max(deepest, indentation)
        lost += memory[1]
        impulse += step * force
        push = 2.0 * force
        for i in range(u.size):
            moved = change[i] - push * response[i]
            u[i] += moved
            v[i] = turn * moved - v[i]
        for m in range(anchors.size):
            drift[0, m] += step * drift[1, m]
        if k % TAKEN_OUT == 0:
            _take_out(shapes, anchors, spans, u, v, drift)
        rate = v[front] - (v[other] if ends else 0.0) + _sum(drift, closing, 1) + fall * step * (k + 1)
        now = ask(FORCE, constants, indentation, rate, 0.0, deepest)
        _write(record, k + 1, stride, now, impulse, indentation, deepest, lost, u, v, front, other)
        record.first[k + 1] += _sum(drift, at_front, 0)
        record.first_velocity[k + 1] += _sum(drift, at_front, 1)
        if ends:
            record.second[k + 1] += _sum(drift, at_other, 0)
            record.second_velocity[k + 1] += _sum(drift, at_other, 1)
        if (k + 1) % stride == 0:
            for m in range(anchors.size):
                add_to(record.displacement[(k + 1) // stride], drift[0, m], shapes[m])
                add_to(record.velocity[(k + 1) // stride], drift[1, m], shapes[m])


@allocating_kernel
def march_frozen(stiffness, line, fall, step, u, v, stride, begin, end, record):
    """Newmark's step with the contact spring [N/m] in the matrix if the faces overlapped when the step began.

    The spring joins two unknowns: its part of the solution follows from `response`, without a matrix of its own.
    Puts energy in where the faces part within a step; grows without bound where the spring is stiff. Stops and returns
    the instant at which the motion is past reason.
    Error: second order; solved for the change of a step, as for the whole position rounding would grow as step^-2.
    Source: thesis 8.2, whose step, status and start this is: table 8.1 follows digit for digit.
    """
    front, other, response = line.front, line.other, line.response
    change = np.zeros(u.size)
    turn, indentation, deepest = 2.0 / step, record.indentation[begin], record.deepest[begin]
    impulse, force, closing = record.impulse[begin], record.contact_force[begin], 0.5 * line.compliance
    held = stiffness / (1.0 + stiffness * closing)  # newtons per metre that the faces would overlap
    # what the bodies feel, a pull too, at the instants: as the status was when the step to there began
    pressed = stiffness * indentation if begin > 0 and record.contact_force[begin - 1] > 0.0 else 0.0
    for k in range(begin, end):
        _free_change(line, u, v, change)
        free = indentation + change[front] + fall * step * step * (k + 0.5)
        if other >= 0:
            free -= change[other]
        before, pressed = pressed, held * (free - closing * pressed) if force > 0.0 else 0.0
        impulse += 0.5 * step * (before + pressed)
        for i in range(u.size):
            moved = change[i] - (before + pressed) * response[i]
            u[i] += moved
            v[i] = turn * moved - v[i]
        indentation = u[front] - (u[other] if other >= 0 else 0.0) + 0.5 * fall * (step * (k + 1)) ** 2
        force = max(stiffness * indentation, 0.0)
        deepest = max(deepest, indentation)
        _write(record, k + 1, stride, force, impulse, indentation, deepest, 0.0, u, v, front, other)
        if not abs(v[front]) < 1e3 * abs(record.first_velocity[0]):
            return k + 1
    return end


class Explicit(NamedTuple):
    """What an explicit step needs: springs between neighbours and to the ground, all over step / mass."""

    gain: np.ndarray  # step / mass of each node [s/kg]
    half_gain: np.ndarray
    spring: np.ndarray  # (nodes + 1,): before the first, between each two, behind the last [N/m]
    front: int
    other: int


def explicit(line: Line, step: float) -> Explicit:
    """Of rods and points with lumped masses."""
    spring = np.append(0.0, -line.stiffness[1])
    spring[-1] = line.stiffness[0, -1] - spring[-2]  # what holds the far end of the target
    gain = step / line.mass[0]
    return Explicit(gain, 0.5 * gain, spring, line.front, line.other)


@inner_kernel
def _pull(line, u, i):
    """Change of a node's velocity over one step by its neighbours."""
    before = u[i - 1] - u[i] if i > 0 else -u[i]
    behind = u[i + 1] - u[i] if i + 1 < u.size else -u[i]
    return line.gain[i] * (line.spring[i] * before + line.spring[i + 1] * behind)


@kernel
def march_explicit(ask, constants, lossy, line, fall, step, u, v, stride, begin, end, record):
    """Central difference: u at the instants, v half a step before them (in `record` at the instants).

    The law's force belongs to the instant; its rate is carried there by the accelerations. Error: second order, first
    order where the force jumps at first touch.
    Stable below 2 / (highest frequency of the line with the contact spring). ask, constants: see
    `law_functions.asked`. `lossy`: what the force's work leaves unstored is counted as lost.
    """
    front, other = line.front, line.other
    ends = other >= 0
    gain, spring = line.gain, line.spring
    slowing = 0.5 * (gain[front] + (gain[other] if ends else 0.0)) if lossy else 0.0
    indentation, deepest = record.indentation[begin], record.deepest[begin]
    impulse, work = record.impulse[begin], record.lost[begin]
    work += ask(STORED, constants, indentation, 0.0, 0.0, deepest)
    force = record.contact_force[begin]
    for k in range(begin, end):
        _kick(gain, spring, u, v)
        v[front] -= gain[front] * force
        if ends:
            v[other] += gain[other] * force
        _drift(step, u, v)
        # the state at the next instant, with half a kick of what acts there
        before, was = force, indentation
        indentation = u[front] - (u[other] if ends else 0.0) + 0.5 * fall * (step * (k + 1)) ** 2
        a1 = _pull(line, u, front)
        a2 = _pull(line, u, other) if ends else 0.0
        deepest_before = deepest
        deepest = max(deepest, indentation)
        rate = v[front] - (v[other] if ends else 0.0) + 0.5 * (a1 - a2) + fall * step * (k + 1)
        force = ask(FORCE, constants, indentation, rate, slowing, deepest_before)
        impulse += 0.5 * step * (before + force)
        work += 0.5 * (before + force) * (indentation - was)
        lost = work - ask(STORED, constants, indentation, 0.0, 0.0, deepest) if lossy else 0.0
        record.contact_force[k + 1], record.impulse[k + 1], record.indentation[k + 1] = force, impulse, indentation
        record.deepest[k + 1], record.lost[k + 1] = deepest, lost
        record.first[k + 1] = u[front]
        record.first_velocity[k + 1] = v[front] + 0.5 * (a1 - gain[front] * force)
        if ends:
            record.second[k + 1] = u[other]
            record.second_velocity[k + 1] = v[other] + 0.5 * (a2 + gain[other] * force)
        if (k + 1) % stride == 0:
            row = (k + 1) // stride
            copy_to(record.displacement[row], u)
            halfway = record.velocity[row]
            copy_to(halfway, v)
            _kick(line.half_gain, spring, u, halfway)
            halfway[front] = record.first_velocity[k + 1]
            if ends:
                halfway[other] = record.second_velocity[k + 1]


@inner_kernel
def _kick(gain, spring, u, v):
    """Velocities changed by what the neighbours pull over one step."""
    last = u.size - 1
    if last == 0:
        v[0] -= gain[0] * (spring[0] + spring[1]) * u[0]
        return
    v[0] += gain[0] * (spring[1] * (u[1] - u[0]) - spring[0] * u[0])
    for i in range(1, last):
        v[i] += gain[i] * (spring[i + 1] * (u[i + 1] - u[i]) - spring[i] * (u[i] - u[i - 1]))
    v[last] -= gain[last] * (spring[last] * (u[last] - u[last - 1]) + spring[last + 1] * u[last])


@inner_kernel
def _drift(step, u, v):
    for i in range(u.size):
        u[i] += step * v[i]
