"""An impact on rods one behind the other by exact waves, of a mass or a rod, for the browser."""

from numba import carray

from solvers.methods.base import AFTERGLOW, MAX_ROUND_TRIPS
from solvers.methods.waves.method import RIGID_TOLERANCE
from solvers.numerics.law_functions import CONSTANTS
from solvers.numerics.waves import chain_drawn
from solvers.numerics.waves.collocation import STAGES
from solvers.numerics.waves.drawn import MOST_SAMPLES, NO_ROOM, Drawn
from solvers.numerics.waves.law_drawn import CONTACT_COLUMNS
from solvers.numerics.waves.laws import Work as LawWork
from solvers.numerics.waves.nodes import State, rewind
from solvers.numerics.waves.parts import Chain
from solvers.numerics.waves.record import POINTS as NODES
from solvers.numerics.waves.record import QUANTITIES, Record

from .entry import ANY_LAW, FLAGS, INSTANTS, INTEGERS, SPRING, Entry
from .wave_entries import record_room

MOST_RODS = chain_drawn.MOST_RODS
MOST_NODES = MOST_RODS + 1
STRETCHES = 4_000  # of each node; a thin specimen between long bars takes more than a thousand
JUMPS, SENT = 2_000, 4_800  # numbers of all waves together, jumps twice: at most five thirds of 2 400
FORCES = int(MOST_SAMPLES) + 1 + 2 * JUMPS
CONTACTS, GAPS = 64, 64


def chain(
    rods, contact, mass, end, asked, links, knots, beside, nodes, counts, flags, constants, rows, nothing, pressing,
    jumps, wave_time, wave, sent, force_time, force, impactor, face, whole, contacts, gaps, out, start, values,
    closed, breaks,
):  # fmt: skip
    """`solvers.numerics.waves.chain_drawn.answer`; rigid faces.

    rods, contact: how many, and how many of these strike; mass, end: of a mass that strikes, and on the far end; asked:
    for how long, or 0: until they have parted for good; links, knots: as `chain_drawn.place` takes them.
    """
    n = int(rods)
    if n > MOST_RODS:
        return NO_ROOM
    k = n + 1
    b, f = carray(beside, (9, k + 1)), carray(nodes, (9, k))
    c, yes = carray(counts, (6, k)), carray(flags, (6, k))
    struck = Chain(b[0][:n], b[1][:n], b[2][:n], c[0], b[3][:k], b[4][:k], b[5][:k], f[7], int(contact), 0.0, 0.0)
    chain_drawn.place(carray(links, (3, n)), carray(knots, (2, k)), mass, end, int(contact), struck, b[6])
    r, pulse = carray(rows, (8 + 3 * STAGES, NODES)), carray(nothing, (1, 2 + NODES))
    laws = carray(constants, (k, CONSTANTS + 1))
    record = Record(
        carray(start, (k, STRETCHES + 1)),
        carray(values, (k, STRETCHES, QUANTITIES, NODES)),
        carray(closed, (k, STRETCHES)),
        c[1],
    )
    state = State(
        f[0], f[1], f[2], f[3], f[4], f[5], f[6], yes[2], yes[3], yes[4], c[2], c[3],
        carray(breaks, (k, STRETCHES)), c[4], c[5], yes[5], b[7], b[8][:1],
    )  # fmt: skip
    for node in range(k):
        for i in range(CONSTANTS):
            laws[node, i] = 1.0
        laws[node, CONSTANTS] = SPRING
        yes[0][node] = yes[1][node] = False
        record.start[node, 0], record.count[node] = 0.0, 0
    rewind(struck, state)
    work = LawWork(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8:], r[8 + STAGES :], r[8 + 2 * STAGES :])
    drawn = Drawn(
        carray(jumps, (JUMPS,)), carray(wave_time, (SENT,)), carray(wave, (SENT,)), carray(force_time, (FORCES,)),
        carray(force, (FORCES,)), carray(impactor, (INSTANTS,)), carray(face, (INSTANTS,)), carray(whole, (INSTANTS,)),
    )  # fmt: skip
    return chain_drawn.answer(
        struck, record, state, work, ANY_LAW, (laws, yes[0], yes[1], pulse, b[6]),
        (RIGID_TOLERANCE, MAX_ROUND_TRIPS, AFTERGLOW, asked), carray(pressing, (CONTACTS, 2)),
        carray(contacts, (CONTACTS, CONTACT_COLUMNS)), carray(gaps, (GAPS, chain_drawn.GAP_COLUMNS)),
        carray(sent, (2 * n + 1,)), drawn, carray(out, (chain_drawn.COLUMNS,)),
    )  # fmt: skip


CHAIN_ENTRIES = {
    "chain": Entry(
        chain,
        5,
        {
            "links": 3 * MOST_RODS,
            "knots": 2 * MOST_NODES,
            "beside": 9 * (MOST_NODES + 1),
            "nodes": 9 * MOST_NODES,
            "counts": 6 * MOST_NODES,
            "flags": 6 * MOST_NODES,
            "constants": MOST_NODES * (CONSTANTS + 1),
            "rows": (8 + 3 * STAGES) * NODES,
            "nothing": 2 + NODES,
            "pressing": 2 * CONTACTS,
            "jumps": JUMPS,
            "waveTime": SENT,
            "wave": SENT,
            "sent": 2 * MOST_RODS + 1,
            "forceTime": FORCES,
            "force": FORCES,
            "impactor": INSTANTS,
            "face": INSTANTS,
            "whole": INSTANTS,
            "contacts": CONTACT_COLUMNS * CONTACTS,
            "gaps": chain_drawn.GAP_COLUMNS * GAPS,
            "out": chain_drawn.COLUMNS,
            **record_room(MOST_NODES, STRETCHES),
        },
        {"counts": INTEGERS, "pressing": INTEGERS, "flags": FLAGS, "closed": FLAGS},
        {
            "impulse": chain_drawn.IMPULSE_IN,
            "final": chain_drawn.FINAL,
            "target": chain_drawn.TARGET,
            "apart": chain_drawn.APART,
            "compressing": chain_drawn.COMPRESSING,
            "first": chain_drawn.FIRST,
            "striker": chain_drawn.STRIKER,
            "energy": chain_drawn.STRUCK,
            "wholes": chain_drawn.WHOLES,
            "faded": chain_drawn.FADED,
            "steps": chain_drawn.STEPS,
            "closed": chain_drawn.CLOSED,
            "contacts": chain_drawn.CONTACTS,
            "duration": chain_drawn.SHOWN,
            "forcePoints": chain_drawn.FORCE_POINTS,
        },
    ),
}
