"""A mass that is balanced against a rod or a mass on a spring, for the browser."""

from numba import carray

from solvers.methods.balance.motion import ROUND_TRIPS
from solvers.methods.base import AFTERGLOW, MAX_ROUND_TRIPS
from solvers.numerics import balance_drawn, secular
from solvers.numerics.balance_histories import COLUMNS, CONTACT_COLUMNS, DRAWN
from solvers.numerics.balances import Events, Joined, Work
from solvers.numerics.free_motion import Turn
from solvers.numerics.waves.drawn import NO_ROOM

from .entry import FLAGS, INSTANTS, INTEGERS, Entry
from .spring_entries import FEW, PLACES

MODES, EVENTS, CONTACTS = balance_drawn.MOST_MODES + 2, 2_500, 64  # with both bodies as wholes
ROWS = DRAWN + 2 * EVENTS


def balance(
    mass, whole, count, located, step, resolved, restitution, duration, modes, shapes, stresses, oscillators, basis,
    numbers, vectors, turns, event, stuck, coordinates, time, after, found, contacts, impactor, face, stress, velocity,
    displacement, out,
):  # fmt: skip
    """`solvers.numerics.balance_drawn.answer`, in units T, v and Z v.

    whole: mass of what is struck that moves freely, or infinity; count: of its modes; located: or 0: at ends of steps;
    duration: 0: until the bodies have parted for good; modes: frequencies, amplitudes where it is struck, means.
    """
    n = int(count)
    size = n + (1 if whole > 1e300 else 2)
    if size > MODES:
        return NO_ROOM
    m, o, i = carray(modes, (3, n)), carray(oscillators, (22, size)), carray(numbers, (5, size))
    less = size - 1
    given = balance_drawn.Given(m[0], m[1], m[2], carray(shapes, (less, PLACES)), carray(stresses, (less, PLACES)))
    joined = Joined(o[10][:less], carray(basis, (size, less)), o[11][:less], o[12][:less], o[13][:less], 0.0)
    holding = secular.Work(
        i[0],
        i[1],
        i[2],
        i[3],
        i[4],
        o[14],
        o[15],
        o[16],
        o[17],
        carray(turns, (size, 2)),
        carray(vectors, (size, less)),
    )
    w = carray(coordinates, (2 * EVENTS + 8, size))
    work = Work(
        o[18], o[19], o[20][:less], o[21][:less], w[2 * EVENTS][:less],
        Turn(w[2 * EVENTS + 1][:less], w[2 * EVENTS + 2][:less], w[2 * EVENTS + 3][:less]),
    )  # fmt: skip
    e = carray(event, (3, EVENTS))
    events = Events(e[0], e[1], e[2], carray(stuck, (EVENTS,)), w[:EVENTS], w[EVENTS : 2 * EVENTS])
    t = carray(time, (2, ROWS))
    room = balance_drawn.Room(
        o[0], o[1], o[2], o[3], o[4], o[5], o[6], Turn(o[7], o[8], o[9]), joined, holding, work, events, t[0],
        carray(after, (ROWS,)), t[1], carray(found, (COLUMNS, ROWS)), carray(contacts, (CONTACTS, CONTACT_COLUMNS)),
    )  # fmt: skip
    fields = (FEW, PLACES)
    drawn = balance_drawn.Drawn(
        carray(impactor, (INSTANTS,)), carray(face, (INSTANTS,)), carray(stress, fields), carray(velocity, fields),
        carray(displacement, fields),
    )  # fmt: skip
    return balance_drawn.answer(
        mass, whole, given, (located > 0.0, step, ROUND_TRIPS, restitution), resolved,
        (duration, MAX_ROUND_TRIPS * 1.0, AFTERGLOW * 1.0), room, drawn, carray(out, (balance_drawn.FIGURES,)),
    )  # fmt: skip


BALANCE_ENTRIES = {
    "balance": Entry(
        balance,
        8,
        {
            "modes": 3 * MODES,
            "shapes": MODES * PLACES,
            "stresses": MODES * PLACES,
            "oscillators": 22 * MODES,
            "basis": MODES * MODES,
            "numbers": 5 * MODES,
            "vectors": MODES * MODES,
            "turns": 2 * MODES,
            "event": 3 * EVENTS,
            "stuck": EVENTS,
            "coordinates": (2 * EVENTS + 8) * MODES,
            "time": 2 * ROWS,
            "after": ROWS,
            "found": COLUMNS * ROWS,
            "contacts": CONTACT_COLUMNS * CONTACTS,
            "impactor": INSTANTS,
            "face": INSTANTS,
            "stress": FEW * PLACES,
            "velocity": FEW * PLACES,
            "displacement": FEW * PLACES,
            "out": balance_drawn.FIGURES,
        },
        {"numbers": INTEGERS, "after": INTEGERS, "stuck": FLAGS},
        {
            "duration": balance_drawn.DURATION,
            "impulse": balance_drawn.PUSHED,
            "final": balance_drawn.FINAL,
            "target": balance_drawn.TARGET,
            "apart": balance_drawn.PARTED,
            "compressing": balance_drawn.COMPRESSING,
            "energy": balance_drawn.STRUCK,
            "dissipated": balance_drawn.DISSIPATED,
            "contacts": balance_drawn.CONTACTS,
            "points": balance_drawn.POINTS,
            "balances": balance_drawn.BALANCES,
            "steps": balance_drawn.STEPS,
        },
    ),
}
