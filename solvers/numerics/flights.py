"""Flights of bodies that ring: how many steps of a march can be taken at once, as the faces cannot meet in them."""

import math
from typing import NamedTuple

import numpy as np

from ..jit.kernels import inner_kernel
from .arrays import copy_to

SLACK = 1.0 + 1e-6  # on what may be approached in a step: more than rounding
MARGIN = 6.0  # steps before the faces could meet at the earliest: from there on each is marched


class Flights(NamedTuple):
    """What turns every oscillator by a stride: cosine and sine (modes,); and the angle (modes,) of one step. Empty:
    every step is marched."""

    cosine: np.ndarray
    sine: np.ndarray
    angle: np.ndarray


@inner_kernel
def every_step(room):
    """No flights: every step is marched. room: any array; for kernels that count no references."""
    none = room[:0]
    return Flights(none, none, none)


@inner_kernel
def set_flights(frequencies, step, stride, flights):
    """Write those of `flights_of`, where there is room for them (modes,)."""
    for i in range(flights.angle.size):
        angle = frequencies[i] * step
        flights.angle[i] = angle
        flights.cosine[i], flights.sine[i] = math.cos(stride * angle), math.sin(stride * angle)


def flights_of(frequencies: np.ndarray, step: float, stride: int) -> Flights:
    """Of undamped oscillators (modes,) [rad/s] in a march by steps [s], in strides of so many."""
    angle = frequencies * step
    return Flights(np.cos(stride * angle), np.sin(stride * angle), angle)


@inner_kernel
def _steps_apart(flights, q, p, ahead, approach, gap, springs):
    """How many steps can be taken at once.

    ahead, approach: of the impactor before the target as wholes [m], and by how much more after a step; gap: between
    the faces; springs: by which the modes left out may swing in it. Neither can the faces come closer faster than by
    what all oscillators together move in a step, nor can they meet before the bodies have come within their swings.
    """
    swings, ringing = springs, 0.0
    for i in range(flights.angle.size):
        amplitude = math.sqrt(q[i] * q[i] + p[i] * p[i])
        swings += amplitude
        ringing += amplitude * flights.angle[i]
    closing = SLACK * (ringing + max(approach, 0.0))
    steps = (gap - 2.0 * springs) / closing if closing > 0.0 else math.inf
    far = -(ahead + SLACK * swings)
    if far > 0.0:
        steps = max(steps, far / approach if approach > 0.0 else math.inf)
    return max(steps - MARGIN, 0.0)


@inner_kernel
def _bent(flights, q, p):
    """By how much the oscillators close the gap [m], and how much more after a step."""
    bent = more = 0.0
    for i in range(flights.angle.size):
        bent += q[i]
        more += flights.angle[i] * p[i]
    return bent, more


@inner_kernel
def _open(first, after, before, then, compliance, record):
    """Write the gaps behind one instant and up to another, from how far the faces were `before` it and are `then` [m],
    and how much further after a step: by the cubic through them, and by the spring at each."""
    width = float(after - first)
    step, rise, end_rise = then[0] - before[0], width * before[1], width * then[1]
    for k in range(first + 1, after + 1):
        x = (k - first) / width
        apart = before[0] + x * (rise + x * (3.0 * step - 2.0 * rise - end_rise + x * (rise + end_rise - 2.0 * step)))
        record.indentation[k] = min(-apart - compliance * record.spring_force[k], 0.0)


@inner_kernel
def fly(flights, q, p, record, begin, end, stride, step, compliance, weight):
    """Take as many strides as can be at once from instant `begin` on, and not beyond `end`; where that leads.

    The oscillators (modes,) are turned in place and kept at each checkpoint. Of what else is recorded the gap is exact
    there, and near it between; positions between are left out. compliance: of the modes left out; weight: of a new
    force in that of their spring, see `oscillators.Residual`.
    """
    ahead = record.position[begin] - record.rigid_position[begin]
    spring, lost = record.spring_force[begin], record.lost[begin]
    approach, gap = step * (record.velocity[begin] - record.rigid_velocity[begin]), -record.indentation[begin]
    apart = _steps_apart(flights, q, p, ahead, approach, gap, compliance * abs(spring))
    strides = int(min(apart, float(end - begin))) // stride
    end = begin + strides * stride
    once = compliance * (1.0 - 0.5 * weight) * weight  # which the spring loses in a step, as it swings
    for k in range(begin, end):
        record.contact_force[k] = 0.0
        lost += once * spring * spring
        spring *= 1.0 - weight
        record.spring_force[k + 1], record.lost[k + 1] = spring, lost
        record.velocity[k + 1], record.rigid_velocity[k + 1] = record.velocity[begin], record.rigid_velocity[begin]
    bent, more = _bent(flights, q, p)
    for row in range(begin // stride + 1, end // stride + 1):
        before = bent - ahead, more - approach
        for i in range(flights.angle.size):
            turned = flights.cosine[i] * q[i] + flights.sine[i] * p[i]
            p[i] = flights.cosine[i] * p[i] - flights.sine[i] * q[i]
            q[i] = turned
        copy_to(record.checkpoint_displacement[row], q)
        copy_to(record.checkpoint_velocity[row], p)
        ahead += stride * approach
        bent, more = _bent(flights, q, p)
        _open((row - 1) * stride, row * stride, before, (bent - ahead, more - approach), compliance, record)
    moved = (end - begin) * step
    record.position[end] = record.position[begin] + moved * record.velocity[begin]
    record.rigid_position[end] = record.rigid_position[begin] + moved * record.rigid_velocity[begin]
    return end
