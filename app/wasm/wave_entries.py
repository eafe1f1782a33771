"""An impact on a rod by exact waves, for the browser."""

from collections.abc import Callable

import numba
from numba import carray

from solvers.contact.damping import OF_KERNELS
from solvers.methods.base import AFTERGLOW, MAX_ROUND_TRIPS
from solvers.numerics.law_functions import CONSTANTS, one_of
from solvers.numerics.polynomials import MAX_INTERVALS, RootWork
from solvers.numerics.waves import law_drawn, rigid_drawn, rigid_figures
from solvers.numerics.waves.collocation import STAGES
from solvers.numerics.waves.drawn import MOST_SAMPLES, Drawn
from solvers.numerics.waves.laws import Work as LawWork
from solvers.numerics.waves.nodes import State, rewind
from solvers.numerics.waves.parts import Chain
from solvers.numerics.waves.record import POINTS as NODES
from solvers.numerics.waves.record import QUANTITIES, Record
from solvers.numerics.waves.rigid import Pieces, Work

from .entry import ANY_LAW, CYCLE, DEPTHS, FLAGS, INSTANTS, INTEGERS, LOSES, REMEMBERS, Entry

PIECES, TERMS = 64, 40  # of the wave sent: most impacts have a dozen
POINTS, JUMPS, FORCES = 2_400, 400, int(MOST_SAMPLES) + 1
STRETCHES = 2_000  # of each end of a rod that is struck through a law: most impacts have some hundreds
CONTACTS = 64
T = TERMS + 1
TOLERANCE = 0.1 * 1e-9  # of a step, as `solvers.Waves` takes it
DRAWN = {  # what is drawn, by argument: how many numbers
    "jumps": JUMPS,
    "waveTime": POINTS + 2 * JUMPS,
    "wave": POINTS + 2 * JUMPS,
    "forceTime": FORCES + 2 * JUMPS,
    "force": FORCES + 2 * JUMPS,
    "mass": INSTANTS,
    "end": INSTANTS,
    "whole": INSTANTS,
}
DASHPOTS = tuple(OF_KERNELS)  # laws whose damping follows from a restitution


@numba.njit
def _drawn(jumps, wave_time, wave, force_time, force, mass, end, whole):
    return Drawn(
        carray(jumps, (JUMPS,)),
        carray(wave_time, (POINTS + 2 * JUMPS,)),
        carray(wave, (POINTS + 2 * JUMPS,)),
        carray(force_time, (FORCES + 2 * JUMPS,)),
        carray(force, (FORCES + 2 * JUMPS,)),
        carray(mass, (INSTANTS,)),
        carray(end, (INSTANTS,)),
        carray(whole, (INSTANTS,)),
    )


def record_room(nodes: int, stretches: int) -> dict[str, int]:
    """What so many nodes are written into, of so many stretches each."""
    each = nodes * stretches
    return {"start": each + nodes, "values": each * QUANTITIES * NODES, "closed": each, "breaks": each}


def rod(
    beta, reflection, line, rows, coefficients, degrees,
    jumps, wave_time, wave, force_time, force, mass, end, whole, contacts, out,
):  # fmt: skip
    """A rigid mass on a uniform rod: `solvers.numerics.waves.rigid_drawn.answer`."""
    m = carray(line, (2 * (PIECES + 1) + 7 * T + 1 + 2 * MAX_INTERVALS,))
    start, integral, w = m[: PIECES + 1], m[PIECES + 1 : 2 * (PIECES + 1)], m[2 * (PIECES + 1) :]
    halves = w[7 * T + 1 :]
    roots = RootWork(carray(rows, (MAX_INTERVALS, T)), halves[:MAX_INTERVALS], halves[MAX_INTERVALS:], w[5 * T : 6 * T])
    work = Work(w[:T], w[T : 2 * T], w[2 * T : 3 * T], w[3 * T : 4 * T], w[4 * T : 5 * T], w[6 * T : 7 * T + 1], roots)
    waves = carray(coefficients, (PIECES, TERMS)), carray(degrees, (PIECES,))
    sent = Pieces(start, *waves, integral, carray(contacts, (PIECES, 7)), work)
    drawn = _drawn(jumps, wave_time, wave, force_time, force, mass, end, whole)
    return rigid_drawn.answer(beta, reflection, AFTERGLOW, POINTS, sent, drawn, carray(out, (rigid_drawn.COLUMNS,)))


def law(
    beta, reflection, asked, constants, beside, nodes, counts, flags, rows, nothing, pressing, jumps, wave_time, wave,
    force_time, force, mass, end, whole, depths, presses, loading, unloading, contacts, out, start,
    values, closed, breaks,
):  # fmt: skip
    """One that strikes through a contact law: `solvers.numerics.waves.law_drawn.answer`.

    asked: for how long, or 0: until they have parted for good; constants: those of the law in units of T, v and Z v,
    and behind them its number among KINDS, for both ends.
    """
    b, f = carray(beside, (8, 3)), carray(nodes, (8, 2))
    n, yes = carray(counts, (6, 2)), carray(flags, (6, 2))
    chain = Chain(b[0][:1], b[1][:1], b[2][:1], n[0], b[3][:2], b[4][:2], b[5][:2], f[7], 0, 0.0, 0.0)
    law_drawn.place(beta, reflection, chain, b[6])
    r, pulse = carray(rows, (8 + 3 * STAGES, NODES)), carray(nothing, (1, 2 + NODES))
    laws = carray(constants, (2, CONSTANTS + 1))
    of_law = laws, yes[0], yes[1], pulse, b[6]
    record = Record(
        carray(start, (2, STRETCHES + 1)),
        carray(values, (2, STRETCHES, QUANTITIES, NODES)),
        carray(closed, (2, STRETCHES)),
        n[1],
    )
    state = State(
        f[0], f[1], f[2], f[3], f[4], f[5], f[6], yes[2], yes[3], yes[4], n[2], n[3],
        carray(breaks, (2, STRETCHES)), n[4], n[5], yes[5], b[7], b[2][1:2],
    )  # fmt: skip
    for node in range(2):
        number = int(laws[node, CONSTANTS])
        yes[0][node], yes[1][node] = REMEMBERS[number], LOSES[number]
        record.start[node, 0], record.count[node] = 0.0, 0
    rewind(chain, state)
    work = LawWork(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8:], r[8 + STAGES :], r[8 + 2 * STAGES :])
    cycle = (
        carray(depths, (CYCLE,)),
        carray(presses, (CYCLE,)),
        carray(loading, (DEPTHS,)),
        carray(unloading, (DEPTHS,)),
    )
    return law_drawn.answer(
        chain, record, state, work, ANY_LAW, of_law, (TOLERANCE, MAX_ROUND_TRIPS, AFTERGLOW, asked), POINTS,
        carray(pressing, (CONTACTS, 2)), carray(contacts, (CONTACTS, law_drawn.CONTACT_COLUMNS)),
        _drawn(jumps, wave_time, wave, force_time, force, mass, end, whole), cycle,
        carray(out, (law_drawn.COLUMNS,)),
    )  # fmt: skip


def _dashpot_of(number_for: Callable, nominal: Callable) -> Callable:
    """The damping number of a law, and its nominal restitution."""

    @numba.njit(error_model="numpy")
    def found(restitution):
        value = number_for(restitution)
        return value, nominal(value)

    return found


_dashpot = one_of([_dashpot_of(*of) for of in OF_KERNELS.values()])


def dashpot(which, restitution, out):
    """Of a law among DASHPOTS: the damping number that delivers a restitution, and what its usual formula calls it."""
    found = carray(out, (2,))
    found[0], found[1] = _dashpot(int(which), restitution)
    return 0


WAVE_ENTRIES = {
    "rod": Entry(
        rod,
        2,
        {
            "line": 2 * (PIECES + 1) + 7 * T + 1 + 2 * MAX_INTERVALS,
            "rows": MAX_INTERVALS * T,
            "coefficients": PIECES * TERMS,
            "degrees": PIECES,
            **DRAWN,
            "contacts": 7 * PIECES,
            "out": rigid_drawn.COLUMNS,
        },
        {"degrees": INTEGERS},
        {
            "impulse": rigid_figures.IMPULSE,
            "target": rigid_figures.TARGET,
            "compressing": rigid_figures.COMPRESSING,
            "energy": rigid_figures.ROD,
            "contacts": rigid_drawn.CONTACTS,
            "duration": rigid_drawn.SHOWN,
            "wavePoints": rigid_drawn.WAVE_POINTS,
            "forcePoints": rigid_drawn.FORCE_POINTS,
        },
    ),
    "law": Entry(
        law,
        3,
        {
            "constants": 2 * (CONSTANTS + 1),
            "beside": 8 * 3,
            "nodes": 8 * 2,
            "counts": 6 * 2,
            "flags": 6 * 2,
            "rows": (8 + 3 * STAGES) * NODES,
            "nothing": 2 + NODES,
            "pressing": 2 * CONTACTS,
            **DRAWN,
            "depths": CYCLE,
            "presses": CYCLE,
            "loading": DEPTHS,
            "unloading": DEPTHS,
            "contacts": law_drawn.CONTACT_COLUMNS * CONTACTS,
            "out": law_drawn.COLUMNS,
            **record_room(2, STRETCHES),
        },
        {"counts": INTEGERS, "pressing": INTEGERS, "flags": FLAGS, "closed": FLAGS},
        {
            "impulse": law_drawn.IMPULSE_IN,
            "final": law_drawn.FINAL,
            "target": law_drawn.TARGET,
            "apart": law_drawn.APART,
            "compressing": law_drawn.COMPRESSING,
            "energy": law_drawn.ROD,
            "dissipated": law_drawn.DISSIPATED,
            "deepest": law_drawn.DEEPEST,
            "dent": law_drawn.DENT_LEFT,
            "contacts": law_drawn.CONTACTS,
            "duration": law_drawn.SHOWN,
            "wavePoints": law_drawn.WAVE_POINTS,
            "forcePoints": law_drawn.FORCE_POINTS,
        },
    ),
    "dashpot": Entry(dashpot, 2, {"out": 2}, {}, {"number": 0, "nominal": 1}),
}
