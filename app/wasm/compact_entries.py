"""Two compact bodies, marched through a contact law and by the closed form or path of it, for the browser."""

import numba
from numba import carray

from solvers.contact.duration import half_swing
from solvers.methods.base import AFTERGLOW, MAX_ROUND_TRIPS
from solvers.numerics import compact_drawn, modal_drawn, path_collision, path_steps
from solvers.numerics.closed_collisions import Collision
from solvers.numerics.law_functions import CONSTANTS
from solvers.numerics.single_degree import SAMPLES
from solvers.numerics.waves.laws import FORCE

from .entry import ANY_LAW, CYCLE, DEPTHS, INSTANTS, INTEGERS, JUMPING, LOSES, REMEMBERS, Entry
from .modal_entries import AnyStepped, march_room, room_of

CONTACTS, STEPS = 4, 2_000
COURSE = max(SAMPLES + 1, path_collision.instants(6))  # of what stands beside: few have more than four stretches
EDGES = path_collision.STRETCHES + 1


@numba.njit
def _force(depth, constants, slopes):
    return ANY_LAW(FORCE, constants, depth, 0.0, 0.0, slopes)


def compact(
    mass, whole, exponent, kind, constants, shapes, oscillators, saved, saved_rates, slopes, histories, runs,
    contacts, impactor, face, force_time, force, other_impactor, other_face, other_time, other_force, course, cell,
    edges, cycle, law_cycle, figures, out,
):  # fmt: skip
    """`solvers.numerics.compact_drawn.answer`: of both masses, in s, kg and v; kind: POWER and so on."""
    room = march_room(1, STEPS, 2, saved, saved_rates, oscillators, slopes, histories, runs)
    c, s, h = carray(constants, (CONSTANTS + 1,)), carray(shapes, (3, 1)), carray(course, (8, COURSE + 1))
    n, number = COURSE, int(c[CONSTANTS])
    pressed, curve = carray(cycle, (3, CYCLE)), carray(law_cycle, (2, DEPTHS))
    reduced = 1.0 / (1.0 / mass + 1.0 / whole)
    trip = half_swing(_force, (c, room.slopes), reduced, 1.0)
    drawn = compact_drawn.Drawn(
        carray(impactor, (INSTANTS,)), carray(face, (INSTANTS,)), carray(force_time, (2 * STEPS,)),
        carray(force, (2 * STEPS,)), carray(other_impactor, (INSTANTS,)), carray(other_face, (INSTANTS,)),
        carray(other_time, (COURSE + 1,)), carray(other_force, (COURSE + 1,)), h[7],
    )  # fmt: skip
    nothing = pressed[0][:0]
    bent = modal_drawn.Bent(
        nothing, nothing, nothing, nothing, nothing, carray(shapes, (0, 4)), nothing, pressed[0], pressed[1],
        pressed[2], curve[0], curve[1],
    )  # fmt: skip
    followed = Collision(h[0][:n], h[1][:n], h[2][:n], h[3][:n], h[4][:n], h[5][:n], h[6][:n])
    path = compact_drawn.Path(carray(cell, (path_steps.ROWS, path_steps.STAGES)), carray(edges, (EDGES,)))
    return compact_drawn.answer(
        AnyStepped(number, c[0], c[1], c[2], c[3], c[4], c[5]), ANY_LAW, (c, LOSES[number]),
        compact_drawn.Sort(int(kind), exponent, c[0], SAMPLES + 1),
        (mass, whole), trip, (JUMPING[number], REMEMBERS[number]), (MAX_ROUND_TRIPS, AFTERGLOW), (s[0], s[1], s[2]),
        room, carray(contacts, (CONTACTS, modal_drawn.CONTACT_COLUMNS)), bent, path, followed, drawn,
        carray(figures, (modal_drawn.COLUMNS,)), carray(out, (compact_drawn.COLUMNS,)),
    )  # fmt: skip


COMPACT_ENTRIES = {
    "compact": Entry(
        compact,
        4,
        {
            **room_of(1, STEPS, 2),
            "contacts": modal_drawn.CONTACT_COLUMNS * CONTACTS,
            "impactor": INSTANTS,
            "face": INSTANTS,
            "forceTime": 2 * STEPS,
            "force": 2 * STEPS,
            "otherImpactor": INSTANTS,
            "otherFace": INSTANTS,
            "otherTime": COURSE + 1,
            "otherForce": COURSE + 1,
            "course": 8 * (COURSE + 1),
            "cell": path_steps.ROWS * path_steps.STAGES,
            "edges": EDGES,
            "cycle": 3 * CYCLE,
            "lawCycle": 2 * DEPTHS,
            "figures": modal_drawn.COLUMNS,
            "out": compact_drawn.COLUMNS,
        },
        {"runs": INTEGERS},
        {
            "trip": compact_drawn.TRIP,
            "duration": compact_drawn.DURATION,
            "steps": compact_drawn.STEPS,
            "impulse": compact_drawn.IMPULSE,
            "final": compact_drawn.FINAL,
            "target": compact_drawn.TARGET,
            "apart": compact_drawn.APART,
            "compressing": compact_drawn.COMPRESSING,
            "local": compact_drawn.LOCAL,
            "dissipated": compact_drawn.DISSIPATED,
            "deepest": compact_drawn.DEEPEST,
            "dent": compact_drawn.DENT_LEFT,
            "contacts": compact_drawn.CONTACTS,
            "touches": compact_drawn.TOUCHES,
            "highest": compact_drawn.HIGHEST,
            "pushed": compact_drawn.PUSHED,
            "left": compact_drawn.LEFT,
            "gone": compact_drawn.GONE,
            "parted": compact_drawn.PARTED,
            "held": compact_drawn.HELD,
            "lost": compact_drawn.LOST,
            "depth": compact_drawn.DEPTH,
            "dented": compact_drawn.DENTED,
            "points": compact_drawn.POINTS,
            "end": compact_drawn.END,
            "peak": compact_drawn.PEAK,
        },
    ),
}
