"""A point mass that strikes links again and again as they move: by a contact law, or by impulses without duration.

Impacts are located to rounding. Source: of impulses thesis 6.3, (6.12), in the configuration of each impact.
"""

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ...jit.reference import refer
from .flight import LOST, advance, copy_state, feel, meeting, push, write
from .pressing import press

# Of a step: after two flights as short as this the mass rests on the link. Endless ever smaller impacts end there.
SHORTEST_FLIGHT = 1e-2
CLOSE = 1e-7  # of a step, by which two instants are one: joints of links that bend are not closed in shorter ones


@inner_kernel
def balance(linkage, w, contact, restitution, state, time):
    """One balance of impulse and momentum in place: thesis (6.12)."""
    closing, mobility, nx, ny = feel(linkage, w, contact, state, time)
    push(w, contact, state, (1.0 + restitution) * closing / mobility, nx, ny)
    state.contact[LOST] += 0.5 * (1.0 - restitution**2) * closing**2 / mobility


@inner_kernel
def _rest(linkage, w, contact, state, depth, time):
    """Put a mass that rests on the link back onto its line, and take away by what they approach; what its height
    changes by is lost."""
    _, _, nx, ny = linkage.face_at(contact, state.q, state.place, w.row)
    state.place[0] -= depth * nx
    state.place[1] -= depth * ny
    balance(linkage, w, contact, 0.0, state, time)
    state.contact[LOST] -= depth * contact.mass * (nx * contact.gravity[0] + ny * contact.gravity[1])


@kernel
def march(linkage, w, contact, law, surface, stages, restitution, step, steps, every, state, later, kept, seen):
    """From a state in which they touch and approach, in place, through `steps` steps; `later` is room for another.
    Tuples, but the functions of the `law`, are best given by reference.

    Impacts follow the contact `law` of the `surface` in steps of their own or, where both are None, are impulses with a
    restitution. A mass that comes beside the link passes it. Where flights between impulses become too short it rests
    on the link, kept there at the ends of steps, until it is left behind; links that come to rest on a mass that is
    held end it. Returns the number of rows written to `kept`:
    one for `every` so many steps, at the last, two an impulse and one for every step of a contact, if there is room;
    and in `seen` what is seen of the links there.
    """
    linkage, w, contact, surface = refer(linkage), refer(w), refer(contact), refer(surface)
    state, later, kept, seen = refer(state), refer(later), refer(kept), refer(seen)
    room, until, face, time, row, number = kept.time.size - 2, steps * step, 0.0, 0.0, np.int64(0), 0  # no literal row
    met, rate, before, last, short = True, 1.0, -1.0, -np.inf, 0
    while number < steps and row < room:
        if met:
            if law is not None:
                time, row, face = press(linkage, w, contact, law, surface, stages, state, later, kept, row, time, until)
            elif rate > 0.0:
                write(kept, row, time, state)
                balance(linkage, w, contact, restitution, state, time)
                write(kept, row + 1, time, state)
                row += 2
                short = short + 1 if time - last < SHORTEST_FLIGHT * step else 0
                last = time
            else:  # they touch, and are pressed together
                short = 2
            met, before = False, -1.0
            while number < steps and (number + 1) * step <= time + CLOSE * step:
                number += 1
            continue
        end = (number + 1) * step
        if short >= 2 and np.isinf(contact.mass):  # links at rest on a stop are not followed
            break
        if short >= 2:
            depth, _, along = advance(linkage, w, contact, stages, state, time, end - time)
            if depth >= 0.0 and contact.low <= along <= contact.high:
                _rest(linkage, w, contact, state, depth, end)
            else:
                short, before = 0, depth
        else:
            copy_state(later, state)
            depth, _, along = advance(linkage, w, contact, stages, later, time, end - time)
            if depth > face >= before and contact.low <= along <= contact.high:
                length = meeting(linkage, w, contact, stages, state, later, time, end - time, face)
                _, rate, _ = advance(linkage, w, contact, stages, state, time, length)
                met, time = True, time + length
                continue
            copy_state(state, later)
            before = depth
        time, number = end, number + 1
        if number % every == 0 or number == steps:
            write(kept, row, time, state)
            row += 1
    linkage.look(w, kept.time, kept.coordinates, kept.rates, row, seen)
    return row
