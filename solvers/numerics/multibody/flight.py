"""A point mass beside links that move: where both are, what they feel of each other, and what is kept of it."""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel
from ..arrays import add_to, copy_to, dot

MAX_SEARCHES = 100  # of an impact; six or seven do
# Of a contact: sums so far of impulses [N s] and of energy lost [J]; indentation [m]; force in what else gives way [N].
IMPULSE, LOST, INDENTATION, GIVING = range(4)


class Contact(NamedTuple):
    """A point mass [kg], infinite if it is held, in front of a link, which it strikes along `normal` (2,), that turns
    with the link, at the line through `on_link` (2,) across it; the line is as long as the link, from `low` to `high`
    [m] along it. A flexible link is met on the line as it is bent."""

    link: int
    on_link: np.ndarray
    normal: np.ndarray
    low: float
    high: float
    mass: float
    gravity: np.ndarray


class Course(NamedTuple):
    """What happened: at instants (instants,) [s], at a sudden impact twice, coordinates and rates (instants, size),
    place and velocity of the mass (instants, 2), sums so far of impulses of the constraints, and of these what they do
    at once against the contact, (instants, constraints); `contact` (instants, 4), see `IMPULSE`."""

    time: np.ndarray
    coordinates: np.ndarray
    rates: np.ndarray
    place: np.ndarray
    speed: np.ndarray
    reactions: np.ndarray
    sudden: np.ndarray
    contact: np.ndarray


def course(instants: int, size: int, rows: int) -> Course:
    """Room for so many instants, coordinates and constraints."""
    coordinates, rates = np.empty((2, instants, size))
    place, speed = np.empty((2, instants, 2))
    reactions, sudden = np.empty((2, instants, rows))
    return Course(np.empty(instants), coordinates, rates, place, speed, reactions, sudden, np.empty((instants, 4)))


class State(NamedTuple):
    """Coordinates, rates, place and velocity of the mass, impulses of the constraints, and of these what they do at
    once; `contact` (4,), see `IMPULSE`. They are parts of `whole`."""

    whole: np.ndarray
    q: np.ndarray
    v: np.ndarray
    place: np.ndarray
    speed: np.ndarray
    reactions: np.ndarray
    sudden: np.ndarray
    contact: np.ndarray


def state_of(coordinates: np.ndarray, rates: np.ndarray, place: np.ndarray, speed: np.ndarray, rows: int) -> State:
    """Before any impact, with room for the impulses of so many constraints."""
    parts = coordinates, rates, place, speed, np.zeros(rows), np.zeros(rows), np.zeros(4)
    whole = np.concatenate(parts)
    return State(whole, *np.split(whole, np.cumsum([part.size for part in parts])[:-1]))


@inner_kernel
def copy_state(target, source):
    copy_to(target.whole, source.whole)


@inner_kernel
def write(kept, row, time, state):
    """Keep the state in a row."""
    kept.time[row] = time
    copy_to(kept.coordinates[row], state.q)
    copy_to(kept.rates[row], state.v)
    copy_to(kept.place[row], state.place)
    copy_to(kept.speed[row], state.speed)
    copy_to(kept.reactions[row], state.reactions)
    copy_to(kept.sudden[row], state.sudden)
    copy_to(kept.contact[row], state.contact)


@inner_kernel
def overlap(linkage, w, contact, state):
    """By how much the mass is in the link, and how fast that grows; where along the line it is."""
    depth, along, nx, ny = linkage.face_at(contact, state.q, state.place, w.row)
    return depth, nx * state.speed[0] + ny * state.speed[1] - dot(w.row, state.v), along


@inner_kernel
def advance(linkage, w, contact, stages, state, time, step):
    """Links and mass in place, without a contact. Returns overlap, its rate and the place along the link."""
    linkage.take_step(w, stages, state.q, state.v, time, step, state.reactions)
    for i in range(2):
        state.place[i] += step * (state.speed[i] + 0.5 * step * contact.gravity[i])
        state.speed[i] += step * contact.gravity[i]
    return overlap(linkage, w, contact, state)


@inner_kernel
def meeting(linkage, w, contact, stages, state, later, time, longest, surface):
    """How long until the mass is in the link by `surface` [m], within `longest` [s], at the end of which it is farther
    in by what `later` says, which is written over: by Newton, between bounds."""
    low, high, found = 0.0, longest, longest
    depth, rate, _ = overlap(linkage, w, contact, later)
    close = 2e-16 * (time + longest)
    for _ in range(MAX_SEARCHES):
        before = found
        found -= (depth - surface) / rate if rate > 0.0 else 0.0  # where it leaves the link is no answer
        if not low < found < high:
            found = 0.5 * (low + high)
        if not low < found < high:
            break
        copy_state(later, state)
        depth, rate, _ = advance(linkage, w, contact, stages, later, time, found)
        if depth > surface:
            high = found
        else:
            low = found
        if high - low <= close or (rate > 0.0 and abs(found - before) <= close):
            break
    return found


@inner_kernel
def feel(linkage, w, contact, state, time):
    """Rate of approach, by how much a unit impulse slows it [1/kg], and the normal; leaves what the impulse does to the
    rates of the links in `w.half`, and to the constraints in `w.given`."""
    _, _, nx, ny = linkage.face_at(contact, state.q, state.place, w.row)
    closing = nx * state.speed[0] + ny * state.speed[1] - dot(w.row, state.v)
    copy_to(w.half, w.row)
    linkage.respond(w, state.q, time, w.half)
    return closing, 1.0 / contact.mass + dot(w.row, w.half), nx, ny


@inner_kernel
def push(w, contact, state, impulse, nx, ny):
    """Let an impulse act on the mass and the links, in place, by what `feel` has left."""
    add_to(state.v, impulse, w.half)
    add_to(state.reactions, impulse, w.given)
    add_to(state.sudden, impulse, w.given)
    state.speed[0] -= impulse * nx / contact.mass
    state.speed[1] -= impulse * ny / contact.mass
    state.contact[IMPULSE] += impulse
