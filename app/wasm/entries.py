"""What the browser calls: functions of numbers and pointers, as C has them, of which `build` makes one module.

`app/static/wasm/kernels.js` gives the room that they work in, of the sizes that stand here.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numba
import numpy as np
from numba import carray, types

from solvers.contact import LAWS, Linear, Rigid
from solvers.contact.damping import OF_KERNELS
from solvers.methods.base import AFTERGLOW, MAX_ROUND_TRIPS
from solvers.numerics import modal_drawn
from solvers.numerics.law_functions import CONSTANTS, any_stepped
from solvers.numerics.oscillators import Bank, residual_spring
from solvers.numerics.oscillators import Record as ModalRecord
from solvers.numerics.polynomials import MAX_INTERVALS, RootWork
from solvers.numerics.rods import uniform_rod
from solvers.numerics.waves import law_drawn, rigid_drawn, rigid_figures
from solvers.numerics.waves.collocation import STAGES
from solvers.numerics.waves.drawn import MOST_SAMPLES, NO_ROOM, Drawn
from solvers.numerics.waves.laws import Work as LawWork
from solvers.numerics.waves.laws import any_law
from solvers.numerics.waves.nodes import State, rewind
from solvers.numerics.waves.parts import Chain
from solvers.numerics.waves.record import POINTS as NODES
from solvers.numerics.waves.record import QUANTITIES, Record
from solvers.numerics.waves.rigid import Pieces, Work

PIECES, TERMS = 64, 40  # of the wave sent: most impacts have a dozen
POINTS, INSTANTS, JUMPS, FORCES = 2_400, 301, 400, int(MOST_SAMPLES) + 1
STRETCHES = 2_000  # of each end of a rod that is struck through a law: most impacts have some hundreds
CONTACTS, DEPTHS, CYCLE = 64, 60, 300
MODES, STEPS, CHECKPOINTS = 400, int(modal_drawn.MOST_STEPS), 17
T = TERMS + 1
TOLERANCE = 0.1 * 1e-9  # of a step, as `solvers.Waves` takes it
KINDS = [kind for kind in LAWS.values() if kind is not Rigid]
REMEMBERS, LOSES = np.array([kind.PLASTIC for kind in KINDS]), np.array([kind.LOSSY for kind in KINDS])
JUMPING, SPRING = np.array([kind.JUMPS for kind in KINDS]), KINDS.index(Linear)

ON_A_LINE = 80  # of letters of a list: longer ones have one for each of theirs
FLOATS, INTEGERS, FLAGS = (types.CPointer(kind) for kind in (types.float64, types.int64, types.boolean))
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


class Entry(NamedTuple):
    """One function: how many numbers it takes, and then how much room by argument, in numbers of eight bytes."""

    function: Callable
    numbers: int
    room: dict[str, int]
    kinds: dict[str, Any]  # of pointer, where they are not of numbers
    out: dict[str, int]  # places in `out`

    @property
    def signature(self) -> numba.core.typing.Signature:
        pointers = (self.kinds.get(name, FLOATS) for name in self.room)
        return types.int32(*self.numbers * [types.float64], *pointers)


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


_any_law = any_law(KINDS)


def law(
    beta, reflection, constants, beside, nodes, counts, flags, start, values, closed, breaks, rows, nothing, pressing,
    jumps, wave_time, wave, force_time, force, mass, end, whole, depths, presses, loading, unloading, contacts, out,
):  # fmt: skip
    """One that strikes through a contact law: `solvers.numerics.waves.law_drawn.answer`.

    constants: those of the law in units of T, v and Z v, and behind them its number among KINDS, for both ends.
    """
    b, f = carray(beside, (8, 3)), carray(nodes, (8, 2))
    n, yes = carray(counts, (6, 2)), carray(flags, (6, 2))
    chain = Chain(b[0][:1], b[1][:1], b[2][:1], n[0], b[3][:2], b[4][:2], b[5][:2], f[7], 0)
    law_drawn.place(beta, reflection, chain, b[6])
    r, pulse = carray(rows, (8 + STAGES, NODES)), carray(nothing, (1, 2 + NODES))
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
    work = LawWork(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8:])
    cycle = (
        carray(depths, (CYCLE,)),
        carray(presses, (CYCLE,)),
        carray(loading, (DEPTHS,)),
        carray(unloading, (DEPTHS,)),
    )
    return law_drawn.answer(
        chain, record, state, work, _any_law, of_law, TOLERANCE, MAX_ROUND_TRIPS, AFTERGLOW, POINTS,
        carray(pressing, (CONTACTS, 2)), carray(contacts, (CONTACTS, law_drawn.CONTACT_COLUMNS)),
        _drawn(jumps, wave_time, wave, force_time, force, mass, end, whole), cycle,
        carray(out, (law_drawn.COLUMNS,)),
    )  # fmt: skip


_AnyStepped = any_stepped(KINDS)


def modes(
    beta, reflection, count, touching, duration, constants, shapes, oscillators, histories, saved, saved_rates, runs,
    contacts, mass, end, out,
):  # fmt: skip
    """A mass on a uniform rod by its lowest modes: `solvers.numerics.modal_drawn.answer`, in units T, v and Z v.

    touching: until the last parting by waves; constants: those of the law and its number among KINDS; negative: rigid,
    by the spring of the modes left out.
    """
    n, fixed = int(count), reflection > 0.0
    if n > MODES:
        return NO_ROOM
    s, w = carray(shapes, (5, MODES)), carray(oscillators, (8, MODES))
    frequencies, at_contact, damping = s[0][:n], s[1][:n], s[2][:n]
    compliance = uniform_rod(fixed, frequencies)  # k L, which is half of omega T
    for i in range(n):
        frequencies[i], at_contact[i], damping[i] = 2.0 * frequencies[i], 2.0, 0.0
    period = 2.0 * np.pi / frequencies[n - 1]
    last = modal_drawn.steps_drawn(period, touching, duration)
    h = carray(histories, (10, STEPS + 1))
    stride = last // (CHECKPOINTS - 1) + 1
    record = ModalRecord(
        h[0][:last], h[1][: last + 1], h[2][: last + 1], h[3][: last + 1], h[4][: last + 1], h[5][: last + 1],
        h[6][: last + 1], h[7][: last + 1],
        carray(saved, (CHECKPOINTS, n)), carray(saved_rates, (CHECKPOINTS, n)),
    )  # fmt: skip
    bank = Bank(w[0][:n], w[1][:n], w[2][:n], w[3][:n], w[4][:n], w[5][:n], w[6][:n], w[7][:n])
    room = modal_drawn.March(
        record, bank, s[3][:n], s[4][:n], h[8][: last + 1], h[9][: last + 1], carray(runs, (STEPS // 2 + 1, 2))
    )
    c, step = carray(constants, (CONSTANTS + 1,)), duration / last
    number, rigid = int(c[CONSTANTS]), c[CONSTANTS] < 0.0
    if rigid:
        c[0], number = 1.0 / compliance, SPRING
    law = _AnyStepped(number, c[0], c[1], c[2], c[3], c[4], c[5])
    c[CONSTANTS] = number
    spring = residual_spring(0.0 if rigid else compliance, step, period, JUMPING[number], REMEMBERS[number])
    of_law = c, not rigid and LOSES[number], rigid
    return modal_drawn.answer(
        law, _any_law, of_law, spring, 0.5 / beta, np.inf if fixed else 0.5, (frequencies, at_contact, damping),
        step, stride, room, carray(contacts, (CONTACTS, modal_drawn.CONTACT_COLUMNS)),
        (carray(mass, (INSTANTS,)), carray(end, (INSTANTS,))), carray(out, (modal_drawn.COLUMNS,)),
    )  # fmt: skip


def _dashpot_of(number: int) -> Callable:
    """The damping number of the laws from this one on, and its nominal restitution."""
    number_for, nominal = OF_KERNELS[DASHPOTS[number]]
    others = _dashpot_of(number + 1) if number + 1 < len(DASHPOTS) else None

    @numba.njit(error_model="numpy")
    def found(which, restitution):
        if others is None or which == number:
            value = number_for(restitution)
            return value, nominal(value)
        return others(which, restitution)

    return found


_dashpot = _dashpot_of(0)


def dashpot(which, restitution, out):
    """Of a law among DASHPOTS: the damping number that delivers a restitution, and what its usual formula calls it."""
    found = carray(out, (2,))
    found[0], found[1] = _dashpot(which, restitution)
    return 0


ENTRIES = {
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
        2,
        {
            "constants": 2 * (CONSTANTS + 1),
            "beside": 8 * 3,
            "nodes": 8 * 2,
            "counts": 6 * 2,
            "flags": 6 * 2,
            "start": 2 * (STRETCHES + 1),
            "values": 2 * STRETCHES * QUANTITIES * NODES,
            "closed": 2 * STRETCHES,
            "breaks": 2 * STRETCHES,
            "rows": (8 + STAGES) * NODES,
            "nothing": 2 + NODES,
            "pressing": 2 * CONTACTS,
            **DRAWN,
            "depths": CYCLE,
            "presses": CYCLE,
            "loading": DEPTHS,
            "unloading": DEPTHS,
            "contacts": law_drawn.CONTACT_COLUMNS * CONTACTS,
            "out": law_drawn.COLUMNS,
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
    "modes": Entry(
        modes,
        5,
        {
            "constants": CONSTANTS + 1,
            "shapes": 5 * MODES,
            "oscillators": 8 * MODES,
            "histories": 10 * (STEPS + 1),  # of which the first is the force over each step
            "saved": CHECKPOINTS * MODES,
            "savedRates": CHECKPOINTS * MODES,
            "runs": 2 * (STEPS // 2 + 1),
            "contacts": modal_drawn.CONTACT_COLUMNS * CONTACTS,
            "mass": INSTANTS,
            "end": INSTANTS,
            "out": modal_drawn.COLUMNS,
        },
        {"runs": INTEGERS},
        {
            "impulse": modal_drawn.IMPULSE,
            "final": modal_drawn.FINAL,
            "target": modal_drawn.TARGET,
            "apart": modal_drawn.APART,
            "compressing": modal_drawn.COMPRESSING,
            "energy": modal_drawn.STRUCK,
            "local": modal_drawn.LOCAL,
            "dissipated": modal_drawn.DISSIPATED,
            "deepest": modal_drawn.DEEPEST,
            "dent": modal_drawn.DENT_LEFT,
            "steps": modal_drawn.STEPS,
            "window": modal_drawn.WINDOW,
            "touches": modal_drawn.TOUCHES,
            "highest": modal_drawn.HIGHEST,
            "contacts": modal_drawn.CONTACTS,
        },
    ),
    "dashpot": Entry(dashpot, 2, {"out": 2}, {}, {"number": 0, "nominal": 1}),
}


def room() -> str:
    """What the browser code knows of all this: the file `app/static/wasm/room.js`."""
    return (
        "// Sizes of the arrays that kernels work in, and places of figures: written by app/wasm/build.py.\n"
        f"export const ROOM = {_listed({name: entry.room for name, entry in ENTRIES.items()})};\n"
        f"export const OUT = {_listed({name: entry.out for name, entry in ENTRIES.items()})};\n"
        f"export const LAWS = {_names([kind.NAME for kind in KINDS])};\n"
        f"export const DASHPOTS = {_names(DASHPOTS)};\n"
    )


def _names(names: Sequence[str]) -> str:
    quoted = [f"'{name}'" for name in names]
    line = f"[{', '.join(quoted)}]"
    return line if len(line) < ON_A_LINE else "[\n" + "".join(f"  {each},\n" for each in quoted) + "]"


def _listed(tables: dict[str, dict[str, int]]) -> str:
    inside = "".join(
        f"  {name}: {{\n" + "".join(f"    {each}: {number},\n" for each, number in table.items()) + "  },\n"
        for name, table in tables.items()
    )
    return "{\n" + inside + "}"
