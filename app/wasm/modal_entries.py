"""An impact by modes, for the browser: along a rod, and across what bends."""

import numba
import numpy as np
from numba import carray

from solvers.methods.base import AFTERGLOW, MAX_ROUND_TRIPS
from solvers.numerics import modal_drawn
from solvers.numerics.law_functions import CONSTANTS, any_stepped
from solvers.numerics.modal_steps import MOST_DRAWN, steps_drawn
from solvers.numerics.oscillators import Bank, Record, residual_spring
from solvers.numerics.rods import uniform_rod
from solvers.numerics.waves.drawn import NO_ROOM

from .entry import ANY_LAW, INSTANTS, INTEGERS, JUMPING, KINDS, LOSES, REMEMBERS, SPRING, Entry

CONTACTS, MODES, STEPS = 64, 400, int(MOST_DRAWN)
STRIDE = 512  # steps from one checkpoint to the next, at which the clock is asked
BEAM_CONTACTS, BEAM_MODES, BEAM_STEPS = 250, 48, 400_000
BEAM_INSTANTS, BEAM_CYCLE, BEAM_DEPTHS, LISTED, GROUPS = 500, 530, 60, 60, 10_000
AnyStepped = any_stepped(KINDS)


@numba.njit
def march_room(modes, steps, checkpoints, saved, saved_rates, oscillators, slopes, histories, runs):
    """Room for so many steps of so many oscillators."""
    n = steps + 1
    h, w = carray(histories, (10, n)), carray(oscillators, (10, modes))
    record = Record(
        h[0][:steps], h[1], h[2], h[3], h[4], h[5], h[6], h[7],
        carray(saved, (checkpoints, modes)), carray(saved_rates, (checkpoints, modes)),
    )  # fmt: skip
    bank = Bank(w[0], w[1], w[2], w[3], w[4], w[5], w[6], w[7])
    return modal_drawn.March(
        record,
        bank,
        w[8],
        w[9],
        h[8],
        h[9],
        carray(runs, (steps // 2 + 1, 2)),
        carray(slopes, (2,)),
    )


@numba.njit
def law_of(constants, compliance):
    """The law for a march, its number, and whether it stands for a rigid contact: by the spring of modes left out."""
    rigid = constants[CONSTANTS] < 0.0
    if rigid:
        constants[0], constants[CONSTANTS] = 1.0 / compliance, SPRING
    c, number = constants, int(constants[CONSTANTS])
    return AnyStepped(number, c[0], c[1], c[2], c[3], c[4], c[5]), number, rigid


def modes(
    beta, reflection, count, touching, duration, given, constants, shapes, oscillators, saved, saved_rates, slopes,
    histories, runs, contacts, mass, end, out,
):  # fmt: skip
    """A mass on a uniform rod by its lowest modes: `solvers.numerics.modal_drawn.answer`, in units T, v and Z v.

    touching: until the last parting by waves; given: or 0: its own modes, and those left out give way; 1: they do not;
    2: so, and frequencies and amplitudes stand in `shapes`; constants: those of the law and its number among KINDS;
    negative: rigid.
    """
    n, fixed = int(count), reflection > 0.0
    if n > MODES:
        return NO_ROOM
    frequencies, at_contact, damping = carray(shapes, (3, n))
    own, rest = damping, uniform_rod(fixed, damping)  # k L, which is half of omega T
    steps = steps_drawn(np.pi / own[n - 1], touching, duration)
    for i in range(n):
        if given < 2.0:
            frequencies[i], at_contact[i] = 2.0 * own[i], 2.0
        damping[i] = 0.0
    period, compliance = 2.0 * np.pi / frequencies[n - 1], 0.0 if given > 0.0 else rest
    room = march_room(n, steps, steps // STRIDE + 1, saved, saved_rates, oscillators, slopes, histories, runs)
    c, step = carray(constants, (CONSTANTS + 1,)), duration / steps
    law, number, rigid = law_of(c, compliance)
    spring = residual_spring(0.0 if rigid else compliance, step, period, JUMPING[number], REMEMBERS[number])
    whole, known = np.inf if fixed else 0.5, (frequencies, at_contact, damping)
    return modal_drawn.answer(
        law, ANY_LAW, (c, LOSES[number], rigid), spring, (0.5 / beta, whole, whole, 1.0), known,
        step, STRIDE, room, carray(contacts, (CONTACTS, modal_drawn.CONTACT_COLUMNS)),
        (carray(mass, (INSTANTS,)), carray(end, (INSTANTS,))), carray(out, (modal_drawn.COLUMNS,)),
    )  # fmt: skip


def beam(
    mass, rigid_mass, whole, mean, count, compliance, longest, duration, constants, shapes, oscillators, saved,
    saved_rates, slopes, histories, runs, contacts, drawn, rates, force, cycle, law_cycle, out,
):  # fmt: skip
    """A mass across what bends, by its modes: `solvers.numerics.modal_drawn.answer_of_beam`, in s, kg and v.

    shapes: frequencies, amplitudes where it is struck and damping ratios; duration: 0: as long as is usual.
    """
    n = int(count)
    if n > BEAM_MODES:
        return NO_ROOM
    frequencies, at_contact, damping = carray(shapes, (3, n))
    room = march_room(n, BEAM_STEPS, BEAM_STEPS // STRIDE + 1, saved, saved_rates, oscillators, slopes, histories, runs)
    c, d = carray(constants, (CONSTANTS + 1,)), carray(drawn, (5, BEAM_INSTANTS))
    law, number, rigid = law_of(c, compliance)
    path, curve = carray(cycle, (3, BEAM_CYCLE)), carray(law_cycle, (2, BEAM_DEPTHS))
    bent = modal_drawn.Bent(
        d[0], d[1], d[2], d[3], d[4], carray(rates, (LISTED, 4)), carray(force, (GROUPS,)), path[0], path[1], path[2],
        curve[0], curve[1],
    )  # fmt: skip
    return modal_drawn.answer_of_beam(
        law, ANY_LAW, (c, LOSES[number], rigid), (mass, rigid_mass, whole, mean), (frequencies, at_contact, damping),
        compliance, (JUMPING[number], REMEMBERS[number]), longest, duration, (MAX_ROUND_TRIPS, AFTERGLOW),
        STRIDE, room, carray(contacts, (BEAM_CONTACTS, modal_drawn.CONTACT_COLUMNS)),
        bent, carray(out, (modal_drawn.COLUMNS,)),
    )  # fmt: skip


FIGURES = {
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
}


def room_of(modes: int, steps: int, checkpoints: int) -> dict[str, int]:
    """What a march works in, and its law; of the histories the first row is the force over each step."""
    return {
        "constants": CONSTANTS + 1,
        "shapes": 3 * modes,
        "oscillators": 10 * modes,
        "saved": checkpoints * modes,
        "savedRates": checkpoints * modes,
        "slopes": 2,
        "histories": 10 * (steps + 1),
        "runs": 2 * (steps // 2 + 1),
    }


MODAL_ENTRIES = {
    "modes": Entry(
        modes,
        6,
        {
            **room_of(MODES, STEPS, STEPS // STRIDE + 1),
            "contacts": modal_drawn.CONTACT_COLUMNS * CONTACTS,
            "mass": INSTANTS,
            "end": INSTANTS,
            "out": modal_drawn.COLUMNS,
        },
        {"runs": INTEGERS},
        FIGURES,
    ),
    "beam": Entry(
        beam,
        8,
        {
            **room_of(BEAM_MODES, BEAM_STEPS, BEAM_STEPS // STRIDE + 1),
            "contacts": modal_drawn.CONTACT_COLUMNS * BEAM_CONTACTS,
            "drawn": 5 * BEAM_INSTANTS,
            "rates": 4 * LISTED,
            "force": GROUPS,
            "cycle": 3 * BEAM_CYCLE,
            "lawCycle": 2 * BEAM_DEPTHS,
            "out": modal_drawn.COLUMNS,
        },
        {"runs": INTEGERS},
        FIGURES | {"step": modal_drawn.STEP, "duration": modal_drawn.DURATION, "half": modal_drawn.HALF},
    ),
}
