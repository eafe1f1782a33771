"""What the browser calls: functions of numbers and pointers, as C has them, of which `build` makes one module.

`app/static/wasm/kernels.js` gives the room that they work in, of the sizes that stand here.
"""

from collections.abc import Callable

import numba
from numba import carray, types

from solvers.methods.base import AFTERGLOW
from solvers.numerics.polynomials import MAX_INTERVALS, RootWork
from solvers.numerics.waves import rigid_drawn, rigid_figures
from solvers.numerics.waves.rigid import Pieces, Work
from solvers.numerics.waves.rigid_drawn import COLUMNS, Drawn, answer

PIECES, TERMS = 64, 40  # of the wave sent: most impacts have a dozen
POINTS, INSTANTS, JUMPS, FORCES = 2_400, 301, 400, 1_001
T = TERMS + 1

FLOATS, INTEGERS = types.CPointer(types.float64), types.CPointer(types.int64)
ROOM = {  # in numbers, by argument
    "line": 2 * (PIECES + 1) + 7 * T + 1 + 2 * MAX_INTERVALS,
    "rows": MAX_INTERVALS * T,
    "coefficients": PIECES * TERMS,
    "degrees": PIECES,
    "jumps": JUMPS,
    "waveTime": POINTS + 2 * JUMPS,
    "wave": POINTS + 2 * JUMPS,
    "forceTime": FORCES + 2 * JUMPS,
    "force": FORCES + 2 * JUMPS,
    "mass": INSTANTS,
    "end": INSTANTS,
    "whole": INSTANTS,
    "contacts": 7 * PIECES,
    "out": COLUMNS,
}


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
    drawn = Drawn(
        carray(jumps, (JUMPS,)),
        carray(wave_time, (POINTS + 2 * JUMPS,)),
        carray(wave, (POINTS + 2 * JUMPS,)),
        carray(force_time, (FORCES + 2 * JUMPS,)),
        carray(force, (FORCES + 2 * JUMPS,)),
        carray(mass, (INSTANTS,)),
        carray(end, (INSTANTS,)),
        carray(whole, (INSTANTS,)),
    )
    return answer(beta, reflection, AFTERGLOW, POINTS, sent, drawn, carray(out, (COLUMNS,)))


ENTRIES: dict[str, tuple[Callable, numba.core.typing.Signature]] = {
    "rod": (
        rod,
        types.int32(
            *(2 * [types.float64]), *(INTEGERS if name == "degrees" else FLOATS for name in ROOM),
        ),
    ),
}  # fmt: skip
OUT = {  # places in `out`
    "impulse": rigid_figures.IMPULSE,
    "target": rigid_figures.TARGET,
    "compressing": rigid_figures.COMPRESSING,
    "energy": rigid_figures.ROD,
    "contacts": rigid_drawn.CONTACTS,
    "duration": rigid_drawn.SHOWN,
    "wavePoints": rigid_drawn.WAVE_POINTS,
    "forcePoints": rigid_drawn.FORCE_POINTS,
}


def room() -> str:
    """What the browser code knows of all this: the file `app/static/wasm/room.js`."""
    return (
        "// Sizes of the arrays that kernels work in, and places of figures: written by app/wasm/build.py.\n"
        f"export const ROOM = {_listed(ROOM)};\nexport const OUT = {_listed(OUT)};\n"
    )


def _listed(numbers: dict[str, int]) -> str:
    return "{\n" + "".join(f"  {name}: {number},\n" for name, number in numbers.items()) + "}"
