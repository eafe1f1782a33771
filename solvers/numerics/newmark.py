"""Time steps of a line of nodes: Newmark's constant mean acceleration and the explicit central difference.

Both touch every node once per step. The contact force F presses the node `front` back and the next one forward; the
indentation is u[front] - u[front + 1]. Where the second body has no node it does not move.
Source: thesis 6.4.1 and 8.2 (delta = 1/2, alpha = 1/4).
"""

from typing import NamedTuple

import numpy as np

from ..jit import kernel
from .elements import Line


class Record(NamedTuple):
    """What a march writes at every instant (steps + 1,), and of all nodes at every stride-th (rows, nodes)."""

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


class Factors(NamedTuple):
    """Of a symmetric matrix with three diagonals, L D L^T: `below` the diagonal of L, one over D."""

    below: np.ndarray
    inverse: np.ndarray


def factorised(diagonal: np.ndarray, beside: np.ndarray) -> Factors:
    """Once per scene: O(nodes). Source: Thomas's elimination."""
    below, inverse = np.zeros(diagonal.size), np.zeros(diagonal.size)
    _factorise(diagonal, beside, below, inverse)
    return Factors(below, inverse)


@kernel
def _factorise(diagonal, beside, below, inverse):
    last = diagonal.size - 1
    inverse[0] = 1.0 / diagonal[0]
    for i in range(last):
        below[i] = beside[i] * inverse[i]
        inverse[i + 1] = 1.0 / (diagonal[i + 1] - below[i] * beside[i])


class Newmark(NamedTuple):
    """What a step needs of a line; `response` (nodes,) is the displacement under a unit pair of contact forces."""

    factors: Factors
    response: np.ndarray  # [m/N]
    compliance: float  # closing of the faces per newton over one step [m/N]
    inertia: np.ndarray  # 4 M / step: both diagonals, and twice the stiffness
    inertia_beside: np.ndarray
    stiffness: np.ndarray
    stiffness_beside: np.ndarray
    front: int


def newmark(line: Line, step: float) -> Newmark:
    """The matrices of (4 M / step^2 + K) du = 4 M v / step - 2 K u - 2 w F, factorised for a step [s]."""
    factors = factorised(
        4.0 / step**2 * line.mass + line.stiffness, 4.0 / step**2 * line.mass_beside + line.stiffness_beside
    )
    response = np.zeros(line.mass.size)
    response[line.front] = 1.0
    if line.front + 1 < response.size:
        response[line.front + 1] = -1.0
    solve(factors, response)
    closing = response[line.front] - (response[line.front + 1] if line.front + 1 < response.size else 0.0)
    return Newmark(
        factors,
        response,
        2.0 * float(closing),
        4.0 / step * line.mass,
        4.0 / step * line.mass_beside,
        2.0 * line.stiffness,
        2.0 * line.stiffness_beside,
        line.front,
    )


@kernel
def solve(factors, vector):
    """In place."""
    last = vector.size - 1
    for i in range(last):
        vector[i + 1] -= factors.below[i] * vector[i]
    vector[last] *= factors.inverse[last]
    for i in range(last - 1, -1, -1):
        vector[i] = vector[i] * factors.inverse[i] - factors.below[i] * vector[i + 1]


@kernel
def _write(record, k, stride, force, impulse, indentation, deepest, lost, u, v, front):
    record.contact_force[k], record.impulse[k], record.indentation[k] = force, impulse, indentation
    record.deepest[k], record.lost[k] = deepest, lost
    record.first[k], record.first_velocity[k] = u[front], v[front]
    if front + 1 < u.size:
        record.second[k], record.second_velocity[k] = u[front + 1], v[front + 1]
    if k % stride == 0:
        record.displacement[k // stride] = u
        record.velocity[k // stride] = v


@kernel
def march_implicit(law, line, step, u, v, stride, begin, end, record):
    """Newmark's step for the bodies; the contact force, constant over it, does exactly the law's work.

    u, v (nodes,) hold instant `begin` and are advanced to `end`. Error: second order; energy is kept to rounding for
    any law, stiffness and step, as the bodies' part of the step keeps it too.
    """
    front, nodes = line.front, u.size
    last = nodes - 1
    below, inverse, response = line.factors.below, line.factors.inverse, line.response
    change = np.zeros(nodes)
    turn, rate_unit = 2.0 / step, 1.0 / step
    indentation, deepest = record.indentation[begin], record.deepest[begin]
    impulse, lost = record.impulse[begin], record.lost[begin]
    force, force_before = 0.0, 0.0
    for k in range(begin, end):
        carried, left, left_v = 0.0, 0.0, 0.0
        for i in range(last):  # right-hand side and elimination in one sweep
            load = line.inertia[i] * v[i] - line.stiffness[i] * u[i] + left_v - left
            load += line.inertia_beside[i] * v[i + 1] - line.stiffness_beside[i] * u[i + 1]
            left, left_v = line.stiffness_beside[i] * u[i], line.inertia_beside[i] * v[i]
            carried = load - carried
            change[i] = carried * inverse[i]
            carried *= below[i]
        load = line.inertia[last] * v[last] - line.stiffness[last] * u[last] + left_v - left
        change[last] = (load - carried) * inverse[last]
        for i in range(last - 1, -1, -1):
            change[i] -= below[i] * change[i + 1]
        free = indentation + change[front]
        if front < last:
            free -= change[front + 1]
        expected = force + force - force_before
        force_before = force
        force, indentation, loss = law.mean_force(indentation, free, line.compliance, rate_unit, expected, deepest)
        deepest = max(deepest, indentation)
        lost += loss
        impulse += step * force
        push = 2.0 * force
        for i in range(nodes):
            moved = change[i] - push * response[i]
            u[i] += moved
            v[i] = turn * moved - v[i]
        rate = v[front] - (v[front + 1] if front < last else 0.0)
        now = law.force(indentation, rate, deepest)
        _write(record, k + 1, stride, now, impulse, indentation, deepest, lost, u, v, front)


@kernel
def march_frozen(stiffness, apart, together, step, u, v, acceleration, stride, begin, end, record):
    """Newmark's step with the contact spring [N/m] in the matrix if the faces overlapped when the step began.

    `apart`, `together`: the line without and with that spring. Puts energy in where the faces part within a step;
    grows without bound where the spring is stiff. Stops and returns the instant at which the motion is past reason.
    Source: thesis 8.2, whose step, status and start this is: table 8.1 follows digit for digit.
    """
    front, nodes = apart.front, u.size
    load = np.empty(nodes)
    impulse, force, pressed = record.impulse[begin], record.contact_force[begin], 0.0
    deepest = record.deepest[begin]
    pace = 0.25 * step  # of the matrix 4 M / step
    for k in range(begin, end):
        matrices = together if force > 0.0 else apart
        # 4 M / step^2 u + 4 M / step v + M a, in terms of the matrix 4 M / step
        for i in range(nodes):
            u_rate = u[i] / step + v[i] + pace * acceleration[i]
            load[i] = matrices.inertia[i] * u_rate
            if i > 0:
                load[i] += matrices.inertia_beside[i - 1] * (u[i - 1] / step + v[i - 1] + pace * acceleration[i - 1])
            if i + 1 < nodes:
                load[i] += matrices.inertia_beside[i] * (u[i + 1] / step + v[i + 1] + pace * acceleration[i + 1])
        solve(matrices.factors, load)
        for i in range(nodes):
            moved = 2.0 * (load[i] - u[i]) / step
            now = 2.0 * (moved - 2.0 * v[i]) / step - acceleration[i]
            v[i] = moved - v[i]
            u[i], acceleration[i] = load[i], now
        indentation = u[front] - (u[front + 1] if front + 1 < nodes else 0.0)
        before, pressed = pressed, (stiffness * indentation if force > 0.0 else 0.0)  # what the bodies felt
        impulse += 0.5 * step * (before + pressed)
        force = max(stiffness * indentation, 0.0)
        deepest = max(deepest, indentation)
        _write(record, k + 1, stride, force, impulse, indentation, deepest, 0.0, u, v, front)
        if not abs(v[front]) < 1e3 * abs(record.first_velocity[0]):
            return k + 1
    return end


class Explicit(NamedTuple):
    """What an explicit step needs: springs between neighbours and to the ground, all over step / mass."""

    gain: np.ndarray  # step / mass of each node [s/kg]
    spring: np.ndarray  # (nodes + 1,): before the first, between each two, behind the last [N/m]
    front: int


def explicit(line: Line, step: float) -> Explicit:
    """Of a line with lumped masses."""
    between = -line.stiffness_beside
    spring = np.zeros(line.mass.size + 1)
    spring[1:-1] = between
    spring[-1] = line.stiffness[-1] - spring[-2]  # what holds the far end of the target
    return Explicit(step / line.mass, spring, line.front)


@kernel
def _centred(law, lossy, indentation, rate, slowing, deepest):
    """The force F at a rate that F itself slows by slowing * F: one increasing equation, Newton kept in brackets."""
    high = law.force(indentation, rate, deepest)
    if not lossy or high <= 0.0:
        return high
    low, force = 0.0, high
    for _ in range(60):
        slowed = rate - slowing * force
        miss = force - law.force(indentation, slowed, deepest)
        if miss > 0.0:
            high = force
        else:
            low = force
        _, by_rate = law.slopes(indentation, slowed, deepest)
        following = force - miss / (1.0 + slowing * by_rate)
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - force) <= 1e-15 * high:
            break
        force = following
    return force


@kernel
def march_explicit(law, lossy, line, step, u, v, stride, begin, end, record):
    """Central difference: u at the instants, v half a step before them (in `record` at the instants).

    The law's force belongs to the instant; its rate is carried there by the accelerations. Error: second order, first
    order where the force jumps at first touch.
    Stable below 2 / (highest frequency of the line with the contact spring). `lossy`: what the force's work leaves
    unstored is counted as lost.
    """
    front, nodes = line.front, u.size
    ends = front + 1 < nodes
    gain, spring = line.gain, line.spring
    mobility = gain[front] + (gain[front + 1] if ends else 0.0)
    indentation, deepest = record.indentation[begin], record.deepest[begin]
    impulse, work = record.impulse[begin], record.lost[begin]
    work += law.stored(indentation, deepest)
    force = record.contact_force[begin]
    for k in range(begin, end):
        _kick(gain, spring, u, v)
        v[front] -= gain[front] * force
        if ends:
            v[front + 1] += gain[front + 1] * force
        _drift(step, u, v)
        # the state at the next instant, with half a kick of what acts there
        before, was = force, indentation
        indentation = u[front] - (u[front + 1] if ends else 0.0)
        a1 = gain[front] * (spring[front] * ((u[front - 1] if front > 0 else 0.0) - u[front]))
        a2 = 0.0
        if ends:
            i = front + 1
            a2 = gain[i] * (spring[i + 1] * ((u[i + 1] if i + 1 < nodes else 0.0) - u[i]))
        deepest_before = deepest
        deepest = max(deepest, indentation)
        rate = v[front] - (v[front + 1] if ends else 0.0) + 0.5 * (a1 - a2)
        force = _centred(law, lossy, indentation, rate, 0.5 * mobility, deepest_before)
        impulse += 0.5 * step * (before + force)
        work += 0.5 * (before + force) * (indentation - was)
        lost = work - law.stored(indentation, deepest) if lossy else 0.0
        record.contact_force[k + 1], record.impulse[k + 1], record.indentation[k + 1] = force, impulse, indentation
        record.deepest[k + 1], record.lost[k + 1] = deepest, lost
        record.first[k + 1] = u[front]
        record.first_velocity[k + 1] = v[front] + 0.5 * (a1 - gain[front] * force)
        if ends:
            record.second[k + 1] = u[front + 1]
            record.second_velocity[k + 1] = v[front + 1] + 0.5 * (a2 + gain[front + 1] * force)
        if (k + 1) % stride == 0:
            row = (k + 1) // stride
            record.displacement[row] = u
            halfway = record.velocity[row]
            halfway[:] = v
            _kick(0.5 * gain, spring, u, halfway)
            halfway[front] = record.first_velocity[k + 1]
            if ends:
                halfway[front + 1] = record.second_velocity[k + 1]


@kernel
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


@kernel
def _drift(step, u, v):
    for i in range(u.size):
        u[i] += step * v[i]
