"""A point mass that strikes rigid links again and again as they move: impacts without duration, located to rounding.

Source: thesis 6.3, (6.12), in the configuration of each impact.
"""

from typing import NamedTuple

import numpy as np

from ...jit import kernel
from ..arrays import copy_to
from .moving import arm_of, joints_at, place_of, push_rates, response_to, solve, step_on

# Of a step: after two flights as short as this the mass rests on the link. Endless ever smaller impacts end there.
SHORTEST_FLIGHT = 1e-2


class Contact(NamedTuple):
    """A point mass [kg] in front of a link, which it strikes along `normal` (2,), that turns with the link, at the line
    through `on_link` (2,) across it; the line is as long as the link, from `low` to `high` [m] along it."""

    link: int
    on_link: np.ndarray
    normal: np.ndarray
    low: float
    high: float
    mass: float
    gravity: np.ndarray


@kernel
def overlap(contact, q, v, place, speed):
    """By how much the mass is in the link, and how fast that grows; where along the line it is."""
    x, y = place_of(q, contact.link, contact.on_link)
    nx, ny = arm_of(q, contact.link, contact.normal)
    dx, dy = place[0] - x, place[1] - y
    along = ny * dx - nx * dy
    start = 3 * contact.link
    arm_x, arm_y = place[0] - q[start], place[1] - q[start + 1]
    vx, vy = v[start] - v[start + 2] * arm_y, v[start + 1] + v[start + 2] * arm_x
    return nx * dx + ny * dy, nx * (speed[0] - vx) + ny * (speed[1] - vy), along


@kernel
def balance(linkage, w, contact, restitution, q, v, place, speed, time, reactions):
    """One balance of impulse and momentum in place: thesis (6.12). Returns the impulse and the energy lost."""
    count, start = reactions.size, 3 * contact.link
    _, closing, _ = overlap(contact, q, v, place, speed)
    nx, ny = arm_of(q, contact.link, contact.normal)
    turning = (place[0] - q[start]) * ny - (place[1] - q[start + 1]) * nx
    for k in range(q.size):
        w.half[k] = 0.0
    w.half[start] = linkage.mobility[start] * nx
    w.half[start + 1] = linkage.mobility[start + 1] * ny
    w.half[start + 2] = linkage.mobility[start + 2] * turning
    joints_at(linkage, q, time, w.gap, w.jacobian, w.moving)
    for i in range(count):
        w.given[i] = 0.0
        for k in range(q.size):
            w.given[i] += w.jacobian[i, k] * w.half[k]
    response_to(linkage, w.jacobian, w.jacobian, 1.0, w.response)
    solve(w.response, w.given)
    push_rates(linkage, w.jacobian, w.given, w.half)
    felt = nx * w.half[start] + ny * w.half[start + 1] + turning * w.half[start + 2]
    effective = 1.0 / (1.0 / contact.mass + felt)
    impulse = (1.0 + restitution) * closing * effective
    for k in range(q.size):
        v[k] += impulse * w.half[k]
    for i in range(count):
        reactions[i] += impulse * w.given[i]
    speed[0] -= impulse * nx / contact.mass
    speed[1] -= impulse * ny / contact.mass
    return impulse, 0.5 * effective * (1.0 - restitution**2) * closing**2


@kernel
def _fly(place, speed, gravity, time):
    """Move the mass freely, in place."""
    for i in range(2):
        place[i] += time * (speed[i] + 0.5 * time * gravity[i])
        speed[i] += time * gravity[i]


class Course(NamedTuple):
    """What happened: at instants (instants,) [s], at an impact twice, coordinates and rates (instants, 3 links), place
    and velocity of the mass (instants, 2), sums so far of impulses of the constraints (instants, constraints), of
    contact impulses [N s] and of energy lost [J], (instants,)."""

    time: np.ndarray
    coordinates: np.ndarray
    rates: np.ndarray
    place: np.ndarray
    speed: np.ndarray
    reactions: np.ndarray
    impulse: np.ndarray
    lost: np.ndarray


def course(instants: int, links: int, rows: int) -> Course:
    """Room for so many."""
    coordinates, rates = np.empty((2, instants, 3 * links))
    place, speed = np.empty((2, instants, 2))
    impulse, lost = np.empty((2, instants))
    return Course(np.empty(instants), coordinates, rates, place, speed, np.empty((instants, rows)), impulse, lost)


class State(NamedTuple):
    """Coordinates, rates, place and velocity of the mass, impulses of the constraints."""

    q: np.ndarray
    v: np.ndarray
    place: np.ndarray
    speed: np.ndarray
    reactions: np.ndarray


@kernel
def _copied(target, source):
    copy_to(target.q, source.q)
    copy_to(target.v, source.v)
    copy_to(target.place, source.place)
    copy_to(target.speed, source.speed)
    copy_to(target.reactions, source.reactions)


@kernel
def _write(kept, row, time, state, impulse, lost):
    kept.time[row], kept.impulse[row], kept.lost[row] = time, impulse, lost
    copy_to(kept.coordinates[row], state.q)
    copy_to(kept.rates[row], state.v)
    copy_to(kept.place[row], state.place)
    copy_to(kept.speed[row], state.speed)
    copy_to(kept.reactions[row], state.reactions)


@kernel
def _advance(linkage, w, contact, stages, state, time, step):
    """Links and mass in place, without a contact. Returns overlap, its rate and the place along the link."""
    step_on(linkage, w, stages, state.q, state.v, time, step, state.reactions)
    _fly(state.place, state.speed, contact.gravity, step)
    return overlap(contact, state.q, state.v, state.place, state.speed)


@kernel
def _meeting(linkage, w, contact, stages, state, later, time, longest):
    """How long until the mass meets the link, within `longest` [s]; `later` is written over."""
    low, high = 0.0, longest
    while high - low > 2e-16 * (time + longest):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        _copied(later, state)
        depth, _, _ = _advance(linkage, w, contact, stages, later, time, middle)
        if depth > 0.0:
            high = middle
        else:
            low = middle
    return low


@kernel
def _rest(linkage, w, contact, state, depth, time):
    """Put a mass that rests on the link back onto its line, and take away by what they approach.

    Returns the impulse and the energy lost, that of its height with it.
    """
    nx, ny = arm_of(state.q, contact.link, contact.normal)
    state.place[0] -= depth * nx
    state.place[1] -= depth * ny
    raised = -depth * contact.mass * (nx * contact.gravity[0] + ny * contact.gravity[1])
    impulse, lost = balance(linkage, w, contact, 0.0, state.q, state.v, state.place, state.speed, time, state.reactions)
    return impulse, lost + raised


@kernel
def march(linkage, w, contact, stages, restitution, step, steps, state, later, kept):
    """From a state in which they touch and approach, in place, through `steps` steps; `later` is room for another.

    Impacts are located to rounding within their step; a mass that comes beside the link passes it. Where flights become
    too short it rests on the link, kept there at the ends of steps, until it is left behind. Returns the number of rows
    written to `kept`: one a step and two an impact, if there is room.
    """
    _write(kept, 0, 0.0, state, 0.0, 0.0)
    impulse, lost = balance(
        linkage, w, contact, restitution, state.q, state.v, state.place, state.speed, 0.0, state.reactions
    )
    _write(kept, 1, 0.0, state, impulse, lost)
    row, time, before, last, short = 2, 0.0, -1.0, 0.0, 0
    for number in range(steps):
        end = (number + 1) * step
        if short >= 2:
            depth, _, along = _advance(linkage, w, contact, stages, state, time, end - time)
            time = end
            if depth >= 0.0 and contact.low <= along <= contact.high:
                given, less = _rest(linkage, w, contact, state, depth, time)
                impulse += given
                lost += less
            else:
                short, before = 0, depth
        while time < end and row + 2 < kept.time.size:
            _copied(later, state)
            depth, _, along = _advance(linkage, w, contact, stages, later, time, end - time)
            if depth > 0.0 >= before and contact.low <= along <= contact.high:
                length = _meeting(linkage, w, contact, stages, state, later, time, end - time)
                _, rate, _ = _advance(linkage, w, contact, stages, state, time, length)
                time += length
                if rate > 0.0:
                    _write(kept, row, time, state, impulse, lost)
                    given, less = balance(
                        linkage, w, contact, restitution, state.q, state.v, state.place, state.speed, time,
                        state.reactions,
                    )  # fmt: skip
                    impulse += given
                    lost += less
                    _write(kept, row + 1, time, state, impulse, lost)
                    row += 2
                    short = short + 1 if time - last < SHORTEST_FLIGHT * step else 0
                    last = time
                before = -1.0
                if short >= 2:
                    break
                continue
            _copied(state, later)
            before, time = depth, end
        if row + 2 >= kept.time.size:
            break
        if time == end:
            _write(kept, row, time, state, impulse, lost)
            row += 1
    return row
