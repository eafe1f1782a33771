"""Two compact bodies as a picture needs them, in one call: marched through their law, and by its closed form or path.

As in `waves.drawn`, so that it can be compiled ahead of time for where there is no Python. Times are written in the
time unit of the impact, velocities in its speed, displacements and forces in what follows with the reduced mass.
"""

from typing import NamedTuple

import numpy as np

from ..jit.kernels import inner_kernel, kernel
from ..jit.reference import refer
from . import modal_contacts, modal_drawn
from .balance_histories import between
from .closed_collisions import Collision, follow_power, follow_sine
from .damped_path import follow_damped
from .flights import every_step
from .modal_steps import usual_step
from .oscillators import residual_spring, set_bank
from .path_collision import follow_path, instants, stretches
from .waves.drawn import BEYOND, NO_ROOM, SOLVED, instant
from .waves.laws import DENT

# what `answer` writes into `out`: TRIP, the time unit, in the unit of its arguments; then of the march, and behind
# BESIDE of the closed form
TRIP, DURATION, STEPS, IMPULSE, FINAL, TARGET, APART, COMPRESSING = range(8)
LOCAL, DISSIPATED, DEEPEST, DENT_LEFT, CONTACTS, TOUCHES, HIGHEST = range(8, 15)
BESIDE = 15  # IMPULSE and so on of that, and how many instants it has
PUSHED, LEFT, GONE, PARTED, HELD, LOST, DEPTH, DENTED, END, PEAK, POINTS = range(BESIDE, BESIDE + 11)
COLUMNS = BESIDE + 11
# what stands beside: a power of the indentation, the half sine, work integrals, the path of a law with damping
POWER, SINE, PATH, DAMPED = range(4)
WEAK = 1e-30  # amplitude of the one oscillator that a march cannot do without


class Drawn(NamedTuple):
    """What is drawn of the march, and of what stands beside at its own instants and one at the very end."""

    impactor: np.ndarray  # (instants,), displacement at even times; and of the struck face
    face: np.ndarray
    force_time: np.ndarray  # (2 steps,)
    force: np.ndarray
    other_impactor: np.ndarray  # (instants,)
    other_face: np.ndarray
    other_time: np.ndarray  # (course + 1,)
    other_force: np.ndarray
    apart: np.ndarray  # (course + 1,), how far both have come together


class Sort(NamedTuple):
    """What stands beside."""

    kind: int  # POWER and so on
    exponent: float
    stiffness: float
    even: int  # instants of a closed form


class Path(NamedTuple):
    """Room for work integrals, and for a damped path."""

    cell: np.ndarray  # (path_steps.ROWS, STAGES) of either
    edges: np.ndarray  # (path_collision.STRETCHES + 1,)


@inner_kernel
def _figures(masses, contacts, trip, beside, out):
    """In units of the impact what `modal_drawn` has written in those of its arguments."""
    reduced, count = 1.0 / (1.0 / masses[0] + 1.0 / masses[1]), int(beside[modal_drawn.CONTACTS])
    out[IMPULSE], out[COMPRESSING] = beside[modal_drawn.IMPULSE] / reduced, beside[modal_drawn.COMPRESSING] / reduced
    out[FINAL], out[TARGET], out[APART] = (
        beside[modal_drawn.FINAL], beside[modal_drawn.TARGET], beside[modal_drawn.APART]
    )  # fmt: skip
    out[LOCAL], out[DISSIPATED] = beside[modal_drawn.LOCAL] / reduced, beside[modal_drawn.DISSIPATED] / reduced
    out[DEEPEST], out[CONTACTS] = beside[modal_drawn.DEEPEST] / trip, count
    out[DENT_LEFT] = beside[modal_drawn.DENT_LEFT] / trip
    out[TOUCHES], out[HIGHEST] = beside[modal_drawn.TOUCHES], beside[modal_drawn.HIGHEST] * trip / reduced
    for k in range(count):
        contacts[k, modal_contacts.START] /= trip
        contacts[k, modal_contacts.END] /= trip
        contacts[k, modal_contacts.IMPULSE] /= reduced
        contacts[k, modal_contacts.PEAK] *= trip / reduced


@inner_kernel
def _histories(record, step, trip, reduced, drawn):
    steps = record.contact_force.size
    for k in range(drawn.impactor.size):
        t = instant(k, drawn.impactor.size, step * steps)
        moved = modal_contacts.between(t, step, record.position)
        drawn.impactor[k] = moved / trip
        drawn.face[k] = (moved - modal_contacts.between(t, step, record.indentation)) / trip
    for k in range(steps):
        for n in range(2):
            drawn.force_time[2 * k + n] = (k + n) * step / trip
            drawn.force[2 * k + n] = record.contact_force[k] * trip / reduced


@inner_kernel
def _cut(course, size):
    """The first instants alone."""
    return Collision(
        course.time[:size], course.indentation[:size], course.rate[:size], course.force[:size], course.impulse[:size],
        course.stored[:size], course.lost[:size],
    )  # fmt: skip


@inner_kernel
def _followed(law, reduced, trip, sort, path, course):
    """Follow the contact by itself; law: `asked`, constants and room for slopes. At how many instants; -1: no room."""
    asked, constants, slopes = law
    if sort.kind == DAMPED:
        return follow_damped(asked, constants, slopes, reduced, 1.0, trip, path.cell, course)
    if sort.kind == PATH:
        count = stretches(asked, constants, slopes, 0.5 * reduced, path.cell, path.edges)
        if count < 1 or instants(count) > course.time.size:
            return -1
        found = _cut(course, instants(count))
        follow_path(asked, constants, slopes, reduced, 1.0, path.cell, path.edges[: count + 1], found)
        return instants(count)
    if sort.kind == SINE:
        follow_sine(sort.stiffness, reduced, 1.0, _cut(course, sort.even))
    else:
        follow_power(sort.stiffness, sort.exponent, reduced, 1.0, _cut(course, sort.even))
    return sort.even


@inner_kernel
def _beside(masses, trip, duration, course, drawn, out):
    """What stands beside, and free flight after it, about the common centre of mass; see `Drawn`."""
    reduced, last = 1.0 / (1.0 / masses[0] + 1.0 / masses[1]), course.time.size - 1
    parting, leaving = course.time[last], course.rate[last]
    end = max(duration, parting * (1.0 + 1e-9))
    out[PEAK] = out[DEPTH] = 0.0
    for k in range(course.time.size):
        drawn.other_time[k], drawn.other_force[k] = course.time[k] / trip, course.force[k] * trip / reduced
        drawn.apart[k] = course.indentation[k] / trip
        out[PEAK], out[DEPTH] = max(out[PEAK], drawn.other_force[k]), max(out[DEPTH], drawn.apart[k])
    drawn.other_force[last] = 0.0
    drawn.other_time[last + 1], drawn.other_force[last + 1] = end / trip, 0.0
    drawn.apart[last + 1] = (course.indentation[last] + leaving * (end - parting)) / trip
    share = 1.0 / (1.0 + masses[1] / masses[0])  # of what is struck in the approach
    time, apart = drawn.other_time[: last + 2], drawn.apart[: last + 2]
    for k in range(drawn.other_impactor.size):
        t = instant(k, drawn.other_impactor.size, duration / trip)
        gone = between(time, apart, t)
        drawn.other_impactor[k] = share * t + (1.0 - share) * gone
        drawn.other_face[k] = share * t - share * gone
    pushed = course.impulse[last]
    out[PUSHED], out[LEFT], out[GONE] = pushed / reduced, 1.0 - pushed / masses[0], pushed / masses[1]
    out[PARTED], out[END], out[POINTS] = out[GONE] - out[LEFT], parting / trip, last + 2
    out[HELD], out[LOST] = course.stored[last] / reduced, course.lost[last] / reduced


@kernel
def answer(
    law, asked, of_law, sort, masses, trip, sudden, limits, modes, room, contacts, cycle, path, course, drawn,
    figures, out,
):  # fmt: skip
    """March an impact at a speed of one of a mass on one at rest, follow it by itself, and write what is drawn.

    law: with `mean` and `unloading`; asked: `waves.laws.law_function`; of_law: its constants, and whether it is lossy;
    sort, path: `Sort` and `Path`; masses: of both, or infinity; trip: the time unit; sudden, limits: as in
    `modal_drawn.answer_of_beam`; room: `modal_drawn.March` of one oscillator, which stays still; cycle:
    `modal_drawn.Bent`, of which the depths are written; course: `Collision`, room for it; figures:
    `modal_drawn.COLUMNS`; out (COLUMNS,). Returns SOLVED or NO_ROOM.
    """
    kept, reduced, stride = refer(room), 1.0 / (1.0 / masses[0] + 1.0 / masses[1]), room.record.contact_force.size
    frequencies, at_contact, damping = modes
    frequencies[0], at_contact[0], damping[0] = 2.0 * np.pi / trip, WEAK, 0.0
    no, yes = np.bool_(False), np.bool_(True)
    step = usual_step(law, 0.0, reduced, 1.0, trip, 0.0, reduced, 0.0, 0.0, no)
    residual = residual_spring(0.0, step, trip, sudden[0], sudden[1])
    set_bank(frequencies, at_contact, frequencies, damping, step, kept.bank)
    modal_drawn.at_rest(kept.record, kept.displacement, kept.velocity)
    bodies, most = (masses[0], masses[1], masses[1], 1.0), int(np.ceil(limits[0] * trip / step))
    seen, of_it = limits[1] * trip, (asked, of_law[0])
    every = every_step(kept.displacement)
    steps, parted = modal_drawn.followed(law, of_it, residual, bodies, modes, step, stride, kept, every, most, seen, no)
    if steps < 1:
        return NO_ROOM
    record, (constants, lossy) = refer(modal_drawn.cut(kept.record, steps)), of_law
    status = modal_drawn.figures(
        asked, (constants, lossy, no), residual, bodies, modes, step, stride, record, kept, yes, parted, contacts,
        figures,
    )  # fmt: skip
    if status != SOLVED or not parted or figures[modal_drawn.CONTACTS] > 1.0:  # they touch once: more is rounding
        return NO_ROOM
    until = min(step * steps, BEYOND * contacts[int(figures[modal_drawn.CONTACTS]) - 1, modal_contacts.END])
    deepest = figures[modal_drawn.DEEPEST]
    modal_drawn.cycle_of(record, step, law, asked, constants, kept.slopes, until, deepest, cycle)
    out[TRIP], out[DURATION], out[STEPS] = trip, step * steps / trip, steps
    _histories(record, step, trip, reduced, drawn)
    _figures(masses, contacts, trip, figures, out)
    size = _followed((asked, constants, kept.slopes), reduced, trip, sort, path, course)
    if size < 1:
        return NO_ROOM
    _beside(masses, trip, step * steps, _cut(course, size), drawn, out)
    out[DENTED] = asked(DENT, constants, 0.0, 0.0, out[DEPTH] * trip, kept.slopes) / trip
    return SOLVED
