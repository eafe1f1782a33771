"""Rigid links that move far: a symplectic integrator whose joints stay closed, in positions and in velocities.

M q'' = f(q) - G(q)^T L, g(q, t) = 0, with the coordinates x, y of the centre and the angle of each link, so that M is a
diagonal. A step of RATTLE is symmetric and of second order; nine of them, of lengths of either sign, make one of sixth.
Error: sixth order in the step; joints and their rates to rounding; the energy stays near what it was, for ever.
Source: Andersen (1983); Jay (1996) for what moves by itself; Kahan and Li (1997) for the nine lengths.
"""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ..arrays import copy_to
from .elimination import decompose, resolve

STAGES = np.array(
    [
        0.39216144400731413928,
        0.33259913678935943860,
        -0.70624617255763935981,
        0.082213596293550800230,
        0.79854399093482996340,
        0.082213596293550800230,
        -0.70624617255763935981,
        0.33259913678935943860,
        0.39216144400731413928,
    ]
)
SINGLE = np.ones(1)  # of second order, in a ninth of the time
MAX_ITERATIONS = 30  # of the closing of the joints; three or four do
SLOW = 1e-3  # of the gaps: what an iteration may leave, else the next one is by factors of its own
CLOSED = 2e-15  # of the size of the mechanism


class Pins(NamedTuple):
    """Pairs of links that share a point, from the centres in the frames of either, (pins, 2) [m]; link -1 is ground,
    whose frame is the laboratory."""

    first: np.ndarray
    second: np.ndarray
    on_first: np.ndarray
    on_second: np.ndarray


class Lines(NamedTuple):
    """Distances of a point of the second link from one of the first, along a `direction` (lines, 2) that turns with the
    first, which are `rate` t [m/s]."""

    first: np.ndarray
    second: np.ndarray
    on_first: np.ndarray
    on_second: np.ndarray
    direction: np.ndarray
    rate: np.ndarray


class Angles(NamedTuple):
    """Angles of the second link against the first, which are offset [rad] + rate t [rad/s]."""

    first: np.ndarray
    second: np.ndarray
    offset: np.ndarray
    rate: np.ndarray


class Springs(NamedTuple):
    """Springs between links, without a force where they begin: on distances as of `Lines` [N/m], and on angles as of
    `Angles` [N m/rad]. The rates count for nothing."""

    lines: Lines
    line_stiffness: np.ndarray
    angles: Angles
    angle_stiffness: np.ndarray


class Linkage(NamedTuple):
    """Links by inverse masses (3 links,), of the angles the inverse inertia; load (3 links,) [N, N m] that do not
    change; what joins them, in the order of the constraints; size [m]."""

    mobility: np.ndarray
    load: np.ndarray
    pins: Pins
    lines: Lines
    angles: Angles
    springs: Springs
    size: float

    def take_step(self, w, stages, q, v, time, step, reactions):
        step_on(self, w, stages, q, v, time, step, reactions)

    def joints_at(self, q, time, gap, jacobian, moving):
        joints_at(self, q, time, gap, jacobian, moving)

    def face_at(self, contact, q, place, row):
        return face_of(contact, q, place, row)

    def respond(self, w, q, time, change):
        respond(self, w, q, time, change)

    def look(self, w, time, coordinates, rates, count, seen):
        look(self, w, time, coordinates, count, seen)


def constraints(linkage: Linkage) -> int:
    """Their number."""
    return 2 * linkage.pins.first.size + linkage.lines.first.size + linkage.angles.first.size


@kernel
def arm_of(q, link, own):
    """From the centre of a link to a point of it, in the laboratory; of the ground from the origin."""
    if link < 0:
        return own[0], own[1]
    cosine, sine = np.cos(q[3 * link + 2]), np.sin(q[3 * link + 2])
    return cosine * own[0] - sine * own[1], sine * own[0] + cosine * own[1]


@inner_kernel
def place_of(q, link, own):
    x, y = arm_of(q, link, own)
    return (x, y) if link < 0 else (q[3 * link] + x, q[3 * link + 1] + y)


@inner_kernel
def add_point(row, q, link, own, along_x, along_y, sign):
    """The velocity of a point in a direction, to a row of the Jacobian."""
    if link >= 0:
        x, y = arm_of(q, link, own)
        row[3 * link] += sign * along_x
        row[3 * link + 1] += sign * along_y
        row[3 * link + 2] += sign * (along_y * x - along_x * y)


@inner_kernel
def joints_at(linkage, q, time, gap, jacobian, moving):
    """Writes how far the constraints are from being met, (constraints,), their Jacobian (constraints, 3 links) and the
    rates at which they move by themselves, (constraints,)."""
    pins, lines, angles = linkage.pins, linkage.lines, linkage.angles
    for row in range(gap.size):
        moving[row] = 0.0
        for i in range(q.size):
            jacobian[row, i] = 0.0
    row = 0
    for k in range(pins.first.size):
        first, second = pins.first[k], pins.second[k]
        x1, y1 = place_of(q, first, pins.on_first[k])
        x2, y2 = place_of(q, second, pins.on_second[k])
        gap[row], gap[row + 1] = x2 - x1, y2 - y1
        for axis in range(2):
            along_x, along_y = 1.0 - axis, 1.0 * axis
            add_point(jacobian[row + axis], q, second, pins.on_second[k], along_x, along_y, 1.0)
            add_point(jacobian[row + axis], q, first, pins.on_first[k], along_x, along_y, -1.0)
        row += 2
    for k in range(lines.first.size):
        first, second = lines.first[k], lines.second[k]
        along_x, along_y = arm_of(q, first, lines.direction[k])
        x1, y1 = place_of(q, first, lines.on_first[k])
        x2, y2 = place_of(q, second, lines.on_second[k])
        gap[row] = along_x * (x2 - x1) + along_y * (y2 - y1) - lines.rate[k] * time
        add_point(jacobian[row], q, second, lines.on_second[k], along_x, along_y, 1.0)
        add_point(jacobian[row], q, first, lines.on_first[k], along_x, along_y, -1.0)
        if first >= 0:  # the direction turns with it
            jacobian[row, 3 * first + 2] += along_x * (y2 - y1) - along_y * (x2 - x1)
        moving[row] = lines.rate[k]
        row += 1
    for k in range(angles.first.size):
        first, second = angles.first[k], angles.second[k]
        turned = -angles.offset[k] - angles.rate[k] * time
        if second >= 0:
            turned += q[3 * second + 2]
            jacobian[row, 3 * second + 2] = 1.0
        if first >= 0:
            turned -= q[3 * first + 2]
            jacobian[row, 3 * first + 2] = -1.0
        gap[row], moving[row] = turned, angles.rate[k]
        row += 1


@inner_kernel
def response_to(linkage, later, jacobian, factor, found):
    """Rates of the constraints `later` by unit reactions of `jacobian`, (constraints, constraints)."""
    for i in range(found.shape[0]):
        for j in range(found.shape[0]):
            total = 0.0
            for k in range(jacobian.shape[1]):
                total += later[i, k] * linkage.mobility[k] * jacobian[j, k]
            found[i, j] = factor * total


@inner_kernel
def push_rates(linkage, jacobian, reactions, rates):
    """Take from the rates (size,) what reactions (constraints,) do to them."""
    for k in range(rates.size):
        total = 0.0
        for i in range(reactions.size):
            total += jacobian[i, k] * reactions[i]
        rates[k] -= linkage.mobility[k] * total


class Work(NamedTuple):
    """Arrays that a step needs, of constraints and coordinates."""

    gap: np.ndarray
    moving: np.ndarray
    given: np.ndarray
    jacobian: np.ndarray
    later: np.ndarray
    response: np.ndarray
    half: np.ndarray
    moved: np.ndarray
    force_now: np.ndarray
    row: np.ndarray
    order: np.ndarray


def work(count: int, size: int) -> Work:
    """Room for a step."""
    gap, moving, given = np.empty((3, count))
    jacobian, later = np.empty((2, count, size))
    half, moved, force_now, row = np.empty((4, size))
    order = np.empty(count, np.int64)
    response = np.empty((count, count))
    return Work(gap, moving, given, jacobian, later, response, half, moved, force_now, row, order)


@inner_kernel
def forces(linkage, q, found):
    """Writes the forces on all coordinates, (3 links,); returns the energy in the springs [J]."""
    lines, angles, energy = linkage.springs.lines, linkage.springs.angles, 0.0
    for k in range(q.size):
        found[k] = linkage.load[k]
    for k in range(lines.first.size):
        first, second, stiffness = lines.first[k], lines.second[k], linkage.springs.line_stiffness[k]
        along_x, along_y = arm_of(q, first, lines.direction[k])
        x1, y1 = place_of(q, first, lines.on_first[k])
        x2, y2 = place_of(q, second, lines.on_second[k])
        stretch = along_x * (x2 - x1) + along_y * (y2 - y1)
        energy += 0.5 * stiffness * stretch**2
        add_point(found, q, second, lines.on_second[k], along_x, along_y, -stiffness * stretch)
        add_point(found, q, first, lines.on_first[k], along_x, along_y, stiffness * stretch)
        if first >= 0:
            found[3 * first + 2] -= stiffness * stretch * (along_x * (y2 - y1) - along_y * (x2 - x1))
    for k in range(angles.first.size):
        first, second, stiffness = angles.first[k], angles.second[k], linkage.springs.angle_stiffness[k]
        turned = -angles.offset[k]
        turned += q[3 * second + 2] if second >= 0 else 0.0
        turned -= q[3 * first + 2] if first >= 0 else 0.0
        energy += 0.5 * stiffness * turned**2
        if second >= 0:
            found[3 * second + 2] -= stiffness * turned
        if first >= 0:
            found[3 * first + 2] += stiffness * turned
    return energy


@inner_kernel
def _rattle(linkage, w, q, v, time, step, reactions):
    """One step of RATTLE in place, from `time`, but for the closing of the rates, with the Jacobian there; adds the
    impulses of the constraints to `reactions` (constraints,). Leaves the Jacobian at its end."""
    count, size = reactions.size, q.size
    forces(linkage, q, w.force_now)
    for k in range(size):
        w.half[k] = v[k] + 0.5 * step * linkage.mobility[k] * w.force_now[k]
    last = np.inf
    for _ in range(MAX_ITERATIONS):  # push them so that all joints are closed at the end
        for k in range(size):
            w.moved[k] = q[k] + step * w.half[k]
        joints_at(linkage, w.moved, time + step, w.gap, w.later, w.moving)
        worst = 0.0
        for i in range(count):
            worst = max(worst, abs(w.gap[i]))
            w.given[i] = w.gap[i]
        if worst <= CLOSED * linkage.size or not worst < last:  # or as good as their rounding lets them be
            break
        if last == np.inf or worst > SLOW * last:
            response_to(linkage, w.later, w.jacobian, step, w.response)
            decompose(w.response, w.order)
        last = worst
        resolve(w.response, w.order, w.given)
        push_rates(linkage, w.jacobian, w.given, w.half)
        for i in range(count):
            reactions[i] += w.given[i]
    forces(linkage, w.moved, w.force_now)
    for k in range(size):
        q[k] = w.moved[k]
        v[k] = w.half[k] + 0.5 * step * linkage.mobility[k] * w.force_now[k]
    for i in range(count):
        copy_to(w.jacobian[i], w.later[i])


@inner_kernel
def _close_rates(linkage, w, v, reactions):
    """Push the rates onto those that the joints allow, in place, by the Jacobian as it is."""
    for i in range(reactions.size):
        w.given[i] = -w.moving[i]
        for k in range(v.size):
            w.given[i] += w.jacobian[i, k] * v[k]
    response_to(linkage, w.jacobian, w.jacobian, 1.0, w.response)
    decompose(w.response, w.order)
    resolve(w.response, w.order, w.given)
    push_rates(linkage, w.jacobian, w.given, v)
    for i in range(reactions.size):
        reactions[i] += w.given[i]


@inner_kernel
def face_of(contact, q, place, row):
    """Of the line of the struck link, which a point mass meets at `place` (2,): by how much it is in there, where along
    the line, and the normal; writes the velocity of the link along it per unit of each rate, (size,)."""
    for k in range(q.size):
        row[k] = 0.0
    start = 3 * contact.link
    x, y = place_of(q, contact.link, contact.on_link)
    nx, ny = arm_of(q, contact.link, contact.normal)
    dx, dy = place[0] - x, place[1] - y
    row[start], row[start + 1] = nx, ny
    row[start + 2] = (place[0] - q[start]) * ny - (place[1] - q[start + 1]) * nx
    return nx * dx + ny * dy, ny * dx - nx * dy, nx, ny


@inner_kernel
def respond(linkage, w, q, time, change):
    """In place of generalised impulses (size,) what they change the rates by; w.given: impulses of the constraints."""
    for k in range(q.size):
        change[k] *= linkage.mobility[k]
    joints_at(linkage, q, time, w.gap, w.jacobian, w.moving)
    for i in range(w.given.size):
        w.given[i] = 0.0
        for k in range(q.size):
            w.given[i] += w.jacobian[i, k] * change[k]
    response_to(linkage, w.jacobian, w.jacobian, 1.0, w.response)
    decompose(w.response, w.order)
    resolve(w.response, w.order, w.given)
    push_rates(linkage, w.jacobian, w.given, change)


@inner_kernel
def step_on(linkage, w, stages, q, v, time, step, reactions):
    """One step of the composition in place; see `STAGES`.

    Rates are closed at its end alone: what that would take from them within it, the next stage takes, along the same
    Jacobian.
    """
    if step == 0.0:
        return
    joints_at(linkage, q, time, w.gap, w.jacobian, w.moving)
    for k in range(stages.size):
        _rattle(linkage, w, q, v, time, stages[k] * step, reactions)
        time += stages[k] * step
    _close_rates(linkage, w, v, reactions)


class Seen(NamedTuple):
    """At instants energy in springs [J], and by how much the joints are open [m], (instants,)."""

    springs: np.ndarray
    gap: np.ndarray


def seen(instants: int, links: int) -> Seen:
    """Room for so many instants, of any number of links."""
    return Seen(*np.empty((2, instants)))


@inner_kernel
def look(linkage, w, time, coordinates, count, found):
    """Writes what is seen at the first `count` instants (instants,) of coordinates (instants, size)."""
    for row in range(count):
        found.springs[row] = forces(linkage, coordinates[row], w.force_now)
        joints_at(linkage, coordinates[row], time[row], w.gap, w.jacobian, w.moving)
        found.gap[row] = 0.0
        for i in range(w.gap.size):
            found.gap[row] = max(found.gap[row], abs(w.gap[i]))
