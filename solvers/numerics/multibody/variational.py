"""Flexible links that move far: a symplectic integrator whose joints stay closed, in positions and in velocities.

A step is that of the action of the midpoint, h L((q0 + q1) / 2, (q1 - q0) / h), whose joints are closed at its end:
RATTLE, for a mass matrix that changes. It is implicit, symmetric, of second order, stable at any frequency, and keeps
momentum and angular momentum to rounding; nine of them make one of sixth order.
Error: sixth order in the step where that resolves the fastest vibration; the energy stays near what it was, for ever.
Source: Marsden and West (2001); Kahan and Li (1997) for the nine lengths.
"""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel
from ..arrays import add_to, copy_to, dot
from .elimination import decompose, resolve
from .floating import Face, Frames, Stations, Ties, add_springs, face_of, gaps_at, joints_at
from .inertia import actions, as_rigid, divide_by_mass, factor_mass

MAX_ITERATIONS = 60  # of the step; six or seven do where the links turn by little in it
SETTLED = 1e-15  # change of all coordinates, in units of the linkage, that counts as none


class Floating(NamedTuple):
    """What moves, what joins it, gravity [m/s2], `unit` (size,) of every coordinate, to know what is small, and what is
    struck."""

    frames: Frames
    stations: Stations
    ties: Ties
    gravity: np.ndarray
    unit: np.ndarray
    face: Face

    def take_step(self, w, stages, q, v, time, step, reactions):
        step_on(self, w, stages, q, v, time, step, reactions)

    def joints_at(self, q, time, gap, jacobian, moving):
        joints_at(self, q, time, gap, jacobian, moving)

    def face_at(self, contact, q, place, row):
        return face_of(self, contact, q, place, row)

    def respond(self, w, q, time, change):
        respond(self, w, q, time, change)

    def look(self, w, time, coordinates, rates, count, seen):
        look(self, w, time, coordinates, rates, count, seen)


class Room(NamedTuple):
    """Arrays that the fields of one link need: amplitudes, rates, momenta, forces, (fields,); by what those of the axis
    change with the shapes, and the rates of that, (2, shapes)."""

    amplitude: np.ndarray
    speed: np.ndarray
    momentum: np.ndarray
    push: np.ndarray
    by: np.ndarray
    by_rate: np.ndarray


class Work(NamedTuple):
    """Arrays that a step needs: of constraints, of coordinates, and of factors of each link."""

    gap: np.ndarray
    moving: np.ndarray
    given: np.ndarray
    pushed: np.ndarray
    jacobian: np.ndarray
    later: np.ndarray
    soft: np.ndarray
    response: np.ndarray
    begun: np.ndarray
    middle: np.ndarray
    rate: np.ndarray
    moved: np.ndarray
    momentum: np.ndarray
    force_now: np.ndarray
    change: np.ndarray
    row: np.ndarray
    half: np.ndarray
    order: np.ndarray
    factor: np.ndarray
    room: Room


def work(count: int, size: int, links: int, most: int) -> Work:
    """Room for a step of `count` constraints, of links with up to `most` coordinates."""
    gap, moving, given, pushed = np.empty((4, count))
    jacobian, later, soft = np.empty((3, count, size))
    begun, middle, rate, moved, momentum, force_now, change, row, half = np.empty((9, size))
    amplitude, speed, own_momentum, push = np.empty((4, most))
    by, by_rate = np.empty((2, 2, most))
    return Work(
        gap, moving, given, pushed, jacobian, later, soft, np.empty((count, count)),
        begun, middle, rate, moved, momentum, force_now, change, row, half,
        np.empty(count, np.int64), np.empty((links, most, most)),
        Room(amplitude, speed, own_momentum, push, by, by_rate),
    )  # fmt: skip


@inner_kernel
def soften(linkage, w, step, q):
    """Factors at these coordinates, and by them what unit reactions of the Jacobian do, (constraints, size)."""
    factor_mass(linkage, w.room, q, step, w.factor)
    for i in range(w.gap.size):
        copy_to(w.soft[i], w.jacobian[i])
        divide_by_mass(linkage, w.factor, w.soft[i])


@inner_kernel
def _stiffen(w, later, factor):
    """Factors of what reactions do to `factor` times the rows `later` (constraints, size), by `soft`."""
    for i in range(w.given.size):
        for j in range(w.given.size):
            w.response[i, j] = factor * dot(later[i], w.soft[j])
    decompose(w.response, w.order)


@inner_kernel
def _react(w, change):
    """Reactions w.given (constraints,), in place of what must be lost, taken from a change of the rates (size,)."""
    resolve(w.response, w.order, w.given)
    for i in range(w.given.size):
        add_to(change, -w.given[i], w.soft[i])


@inner_kernel
def _variational(linkage, w, q, time, step, reactions):
    """One step in place, from `time`, with the Jacobian there, the momenta w.begun and about the rates w.rate, all
    (size,); adds the impulses of the constraints to `reactions` (constraints,). Leaves the same at its end.

    What reactions do is that at where the rates lead: it converges to the same, as the joints are closed at the end.
    """
    count, size, last = reactions.size, q.size, np.inf
    for k in range(size):
        w.moved[k], w.middle[k] = q[k] + step * w.rate[k], q[k] + 0.5 * step * w.rate[k]
    for i in range(count):
        w.pushed[i] = 0.0
    soften(linkage, w, step, w.middle)
    joints_at(linkage, w.moved, time + step, w.gap, w.later, w.moving)
    _stiffen(w, w.later, step)
    for _ in range(MAX_ITERATIONS):
        actions(linkage, w.room, w.middle, w.rate, w.momentum, w.force_now)
        for k in range(size):
            w.change[k] = w.begun[k] - w.momentum[k] + 0.5 * step * w.force_now[k]
        for i in range(count):
            add_to(w.change, -w.pushed[i], w.jacobian[i])
        divide_by_mass(linkage, w.factor, w.change)
        for i in range(count):
            w.given[i] = w.gap[i] + step * dot(w.later[i], w.change)
        _react(w, w.change)
        worst = 0.0
        for k in range(size):
            w.rate[k] += w.change[k]
            w.moved[k], w.middle[k] = q[k] + step * w.rate[k], q[k] + 0.5 * step * w.rate[k]
            worst = max(worst, abs(step * w.change[k]) / linkage.unit[k])
        for i in range(count):
            w.pushed[i] += w.given[i]
        gaps_at(linkage, w.moved, time + step, w.gap)
        if worst <= SETTLED or not worst < last:  # or as good as their rounding lets them be
            break
        last = worst
    for k in range(size):
        q[k] = w.moved[k]
        w.begun[k] += step * w.force_now[k]  # of the last iteration, after which nothing changes but by rounding
    for i in range(count):
        add_to(w.begun, -w.pushed[i], w.jacobian[i])
        reactions[i] += w.pushed[i]
    joints_at(linkage, q, time + step, w.gap, w.jacobian, w.moving)


@inner_kernel
def _rates_of_momenta(linkage, w, q, v, reactions):
    """In place of momenta (size,) the rates that the joints allow, by the Jacobian as it is."""
    soften(linkage, w, 0.0, q)
    divide_by_mass(linkage, w.factor, v)
    _close(w, v)
    for i in range(reactions.size):
        reactions[i] += w.given[i]


@inner_kernel
def _close(w, v):
    """Push the rates (size,) onto those that the joints allow, at the factors of the mass."""
    for i in range(w.given.size):
        w.given[i] = dot(w.jacobian[i], v) - w.moving[i]
    _stiffen(w, w.jacobian, 1.0)
    _react(w, v)


@inner_kernel
def respond(linkage, w, q, time, change):
    """In place of generalised impulses (size,) what they change the rates by; w.given: impulses of the constraints."""
    joints_at(linkage, q, time, w.gap, w.jacobian, w.moving)
    soften(linkage, w, 0.0, q)
    divide_by_mass(linkage, w.factor, change)
    for i in range(w.moving.size):
        w.moving[i] = 0.0
    _close(w, change)


@inner_kernel
def step_on(linkage, w, stages, q, v, time, step, reactions):
    """One step of the composition in place; see `moving.STAGES`.

    Within it there are momenta, and rates are closed at its end alone: what that would take from momenta before, the
    next stage takes, along the same Jacobian.
    """
    if step == 0.0:
        return
    joints_at(linkage, q, time, w.gap, w.jacobian, w.moving)
    actions(linkage, w.room, q, v, w.begun, w.force_now)
    copy_to(w.rate, v)
    for k in range(stages.size):
        _variational(linkage, w, q, time, stages[k] * step, reactions)
        time += stages[k] * step
    copy_to(v, w.begun)
    _rates_of_momenta(linkage, w, q, v, reactions)


class Seen(NamedTuple):
    """At instants, of every link its centre and angle, and velocity and spin by its momenta, (instants, 3 links);
    kinetic energy, energy in springs [J], and by how much the joints are open [m], (instants,)."""

    centres: np.ndarray
    rates: np.ndarray
    kinetic: np.ndarray
    springs: np.ndarray
    gap: np.ndarray


def seen(instants: int, links: int) -> Seen:
    """Room for so many instants and links."""
    return Seen(*np.empty((2, instants, 3 * links)), *np.empty((3, instants)))


@inner_kernel
def look(linkage, w, time, coordinates, rates, count, found):
    """Writes what is seen at the first `count` instants (instants,) of coordinates and rates (instants, size)."""
    for row in range(count):
        q, v = coordinates[row], rates[row]
        actions(linkage, w.room, q, v, w.momentum, w.force_now)
        as_rigid(linkage, w.room, q, w.momentum, found.centres[row], found.rates[row])
        found.kinetic[row] = 0.5 * dot(w.momentum, v)
        found.springs[row] = add_springs(linkage, q, w.force_now)
        joints_at(linkage, q, time[row], w.gap, w.jacobian, w.moving)
        found.gap[row] = 0.0
        for i in range(w.gap.size):
            found.gap[row] = max(found.gap[row], abs(w.gap[i]))
