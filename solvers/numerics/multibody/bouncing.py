"""A point mass that strikes links again and again as they move: impacts without duration, located to rounding.

Source: thesis 6.3, (6.12), in the configuration of each impact.
"""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ...jit.reference import refer
from ..arrays import add_to, copy_to, dot
from .moving import Linkage
from .variational import Floating

# Of a step: after two flights as short as this the mass rests on the link. Endless ever smaller impacts end there.
SHORTEST_FLIGHT = 1e-2
MAX_SEARCHES = 100  # of an impact; six or seven do


class Contact(NamedTuple):
    """A point mass [kg] in front of a link, which it strikes along `normal` (2,), that turns with the link, at the line
    through `on_link` (2,) across it; the line is as long as the link, from `low` to `high` [m] along it. A flexible
    link is met on the line as it is bent."""

    link: int
    on_link: np.ndarray
    normal: np.ndarray
    low: float
    high: float
    mass: float
    gravity: np.ndarray


@inner_kernel
def overlap(linkage, w, contact, state):
    """By how much the mass is in the link, and how fast that grows; where along the line it is."""
    depth, along, nx, ny = linkage.face_at(contact, state.q, state.place, w.row)
    return depth, nx * state.speed[0] + ny * state.speed[1] - dot(w.row, state.v), along


@inner_kernel
def balance(linkage, w, contact, restitution, state, time):
    """One balance of impulse and momentum in place: thesis (6.12). Returns the impulse and the energy lost."""
    _, _, nx, ny = linkage.face_at(contact, state.q, state.place, w.row)
    closing = nx * state.speed[0] + ny * state.speed[1] - dot(w.row, state.v)
    copy_to(w.half, w.row)
    linkage.respond(w, state.q, time, w.half)
    effective = 1.0 / (1.0 / contact.mass + dot(w.row, w.half))
    impulse = (1.0 + restitution) * closing * effective
    add_to(state.v, impulse, w.half)
    add_to(state.reactions, impulse, w.given)
    state.speed[0] -= impulse * nx / contact.mass
    state.speed[1] -= impulse * ny / contact.mass
    return impulse, 0.5 * effective * (1.0 - restitution**2) * closing**2


@inner_kernel
def _fly(place, speed, gravity, time):
    """Move the mass freely, in place."""
    for i in range(2):
        place[i] += time * (speed[i] + 0.5 * time * gravity[i])
        speed[i] += time * gravity[i]


class Course(NamedTuple):
    """What happened: at instants (instants,) [s], at an impact twice, coordinates and rates (instants, size), place
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


def course(instants: int, size: int, rows: int) -> Course:
    """Room for so many instants, coordinates and constraints."""
    coordinates, rates = np.empty((2, instants, size))
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


@inner_kernel
def _copied(target, source):
    copy_to(target.q, source.q)
    copy_to(target.v, source.v)
    copy_to(target.place, source.place)
    copy_to(target.speed, source.speed)
    copy_to(target.reactions, source.reactions)


@inner_kernel
def _write(kept, row, time, state, impulse, lost):
    kept.time[row], kept.impulse[row], kept.lost[row] = time, impulse, lost
    copy_to(kept.coordinates[row], state.q)
    copy_to(kept.rates[row], state.v)
    copy_to(kept.place[row], state.place)
    copy_to(kept.speed[row], state.speed)
    copy_to(kept.reactions[row], state.reactions)


@inner_kernel
def _advance(linkage, w, contact, stages, state, time, step):
    """Links and mass in place, without a contact. Returns overlap, its rate and the place along the link."""
    linkage.take_step(w, stages, state.q, state.v, time, step, state.reactions)
    _fly(state.place, state.speed, contact.gravity, step)
    return overlap(linkage, w, contact, state)


@inner_kernel
def _meeting(linkage, w, contact, stages, state, later, time, longest):
    """How long until the mass comes into the link, within `longest` [s], at the end of which it is in there by what
    `later` says, which is written over: by Newton, between bounds."""
    low, high, found = 0.0, longest, longest
    depth, rate, _ = overlap(linkage, w, contact, later)
    close = 2e-16 * (time + longest)
    for _ in range(MAX_SEARCHES):
        before = found
        found -= depth / rate if rate > 0.0 else 0.0  # where it leaves the link is no answer
        if not low < found < high:
            found = 0.5 * (low + high)
        if not low < found < high:
            break
        _copied(later, state)
        depth, rate, _ = _advance(linkage, w, contact, stages, later, time, found)
        if depth > 0.0:
            high = found
        else:
            low = found
        if high - low <= close or (rate > 0.0 and abs(found - before) <= close):
            break
    return found


@inner_kernel
def _rest(linkage, w, contact, state, depth, time):
    """Put a mass that rests on the link back onto its line, and take away by what they approach.

    Returns the impulse and the energy lost, that of its height with it.
    """
    _, _, nx, ny = linkage.face_at(contact, state.q, state.place, w.row)
    state.place[0] -= depth * nx
    state.place[1] -= depth * ny
    raised = -depth * contact.mass * (nx * contact.gravity[0] + ny * contact.gravity[1])
    impulse, lost = balance(linkage, w, contact, 0.0, state, time)
    return impulse, lost + raised


@kernel
def march(linkage: Linkage | Floating, w, contact, stages, restitution, step, steps, every, state, later, kept):
    """From a state in which they touch and approach, in place, through `steps` steps; `later` is room for another.

    Impacts are located to rounding within their step; a mass that comes beside the link passes it. Where flights become
    too short it rests on the link, kept there at the ends of steps, until it is left behind. Returns the number of rows
    written to `kept`: one for `every` so many steps, at the last, and two an impact, if there is room.
    """
    linkage, w, contact, state, later, kept = (
        refer(linkage), refer(w), refer(contact), refer(state), refer(later), refer(kept),
    )  # fmt: skip
    _write(kept, 0, 0.0, state, 0.0, 0.0)
    impulse, lost = balance(linkage, w, contact, restitution, state, 0.0)
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
                    given, less = balance(linkage, w, contact, restitution, state, time)
                    impulse += given
                    lost += less
                    _write(kept, row + 1, time, state, impulse, lost)
                    row += 2
                    short = short + 1 if time - last < SHORTEST_FLIGHT * step else 0
                    last = time
                before = -1.0
                if not rate > 0.0:  # they touch, and are pressed together
                    short = 2
                if short >= 2:
                    break
                continue
            _copied(state, later)
            before, time = depth, end
        if row + 2 >= kept.time.size:
            break
        if time == end and ((number + 1) % every == 0 or number + 1 == steps):
            _write(kept, row, time, state, impulse, lost)
            row += 1
    return row
