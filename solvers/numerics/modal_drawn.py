"""An impact by modes as a picture needs it, in one call: figures, contacts, and the forces that move the modes.

As in `waves.drawn`, so that it can be compiled ahead of time for where there is no Python.
"""

from typing import NamedTuple

import numpy as np

from ..jit.kernels import inner_kernel, kernel
from ..jit.reference import refer
from . import modal_contacts
from .oscillators import STEPS_PER_PERIOD, Bank, Record, march_in_place, rate_at, ringing, set_bank
from .waves.drawn import NO_ROOM, SOLVED, instant
from .waves.laws import DENT, STORED

# what `answer` writes into `out`, in the units of its arguments; energies of what is struck and of the contact; WINDOW:
# shortest kept period; TOUCHES: contacts with all chatter, HIGHEST: the largest force of these
IMPULSE, FINAL, TARGET, APART, COMPRESSING, STRUCK, LOCAL, DISSIPATED, DEEPEST, DENT_LEFT = range(10)
STEPS, WINDOW, TOUCHES, HIGHEST, CONTACTS = range(10, 15)
COLUMNS = 15
STEPS_OF_TOUCH, LEAST_STEPS, MOST_STEPS = 500.0, 1_000.0, 10_000.0  # of the time in which they touch; of all
LEFT = modal_contacts.COLUMNS  # column of its contacts: velocity of the impactor at the end
CONTACT_COLUMNS = LEFT + 1


@kernel
def steps_drawn(period, touching, duration):
    """In how many steps modes are marched for a picture: shortest kept period, time until the last parting, and all."""
    steps = max(STEPS_PER_PERIOD * duration / period, STEPS_OF_TOUCH * duration / touching, LEAST_STEPS)
    return int(min(steps, MOST_STEPS) + 1e-6)  # as many whatever rounding makes of it


class March(NamedTuple):
    """Room for a march and for what is made of it."""

    record: Record
    bank: Bank
    displacement: np.ndarray  # (modes,)
    velocity: np.ndarray
    deepest: np.ndarray  # (steps + 1,)
    impulses: np.ndarray
    runs: np.ndarray  # (steps // 2 + 1, 2) of integers


@inner_kernel
def _at_rest(record, q, p):
    """Bodies that are about to touch at a speed of one."""
    record.indentation[0] = record.position[0] = record.rigid_position[0] = record.rigid_velocity[0] = 0.0
    record.spring_force[0] = record.lost[0] = 0.0
    record.velocity[0] = 1.0
    for i in range(q.size):
        q[i] = p[i] = record.checkpoint_displacement[0, i] = record.checkpoint_velocity[0, i] = 0.0


@inner_kernel
def _motions(record, step, rigid, mass, end):
    """Positions of the impactor and of the struck face at even times; in rigid contact they go together."""
    last = step * record.contact_force.size
    if rigid:
        for k in range(record.indentation.size):
            record.indentation[k] = min(record.indentation[k], 0.0)
    for k in range(mass.size):
        t = instant(k, mass.size, last)
        mass[k] = modal_contacts.between(t, step, record.position)
        end[k] = mass[k] - modal_contacts.between(t, step, record.indentation)


@kernel
def answer(
    law, asked, of_law, residual, mass, rigid_mass, modes, step, stride, room, contacts, drawn, out,
):  # fmt: skip
    """March an impact at a speed of one on what is at rest, and write what is drawn of it.

    law: with `mean_force` and `unloading`; asked: `waves.laws.law_function`; of_law: its constants, whether it is lossy
    and whether it stands for a rigid contact; residual: `oscillators.Residual`; mass, rigid_mass: of the impactor, and
    of the target as far as it moves as a whole, or infinity; modes: frequencies, amplitudes where it is struck and
    damping ratios, (modes,) each; stride: steps between checkpoints; room: `March`, of as many steps as are marched;
    contacts (room, CONTACT_COLUMNS); drawn: positions of the impactor and of the struck face at even times; out
    (COLUMNS,). Returns SOLVED, or NO_ROOM.
    """
    room = refer(room)
    record, bank, q, p = room.record, room.bank, room.displacement, room.velocity
    (constants, lossy, rigid), (frequencies, at_contact, damping), force = of_law, modes, record.contact_force
    set_bank(frequencies, at_contact, frequencies, damping, step, bank)
    _at_rest(record, q, p)
    march_in_place(
        law, residual, mass, rigid_mass, 0.0, 0.0, step, bank, bank.cosine, bank.sine,
        bank.turned_kick_displacement, bank.turned_kick_velocity, q, p, stride, 0, force.size, record,
    )  # fmt: skip
    modal_contacts.gathered(record, step, room.deepest, room.impulses)
    out[WINDOW], slopes = 2.0 * np.pi / frequencies[frequencies.size - 1], contacts[contacts.shape[0] - 1, :2]
    compliance = 1.0 / constants[0] if rigid else residual.compliance
    opening = modal_contacts.least_opening(compliance, step, out[WINDOW], force, room.impulses)
    known = modal_contacts.Resolved(step, out[WINDOW], opening, np.bool_(False), rigid, np.bool_(False))
    touches = modal_contacts.touches(force, room.runs)
    runs, table = room.runs[:touches], contacts[: contacts.shape[0] - 1]
    count = modal_contacts.contacts(record, room.deepest, room.impulses, runs, known, asked, constants, slopes, table)
    if count < 1:
        return NO_ROOM
    for k in range(count):
        contacts[k, LEFT] = modal_contacts.between(contacts[k, modal_contacts.END], step, record.velocity)
    out[TOUCHES], out[CONTACTS], out[STEPS], last = touches, count, force.size, force.size
    out[IMPULSE], out[FINAL], out[TARGET] = room.impulses[last], record.velocity[last], record.rigid_velocity[last]
    common = mass / (mass + rigid_mass)
    out[COMPRESSING] = mass * (1.0 - common) if out[FINAL] <= common else np.nan
    out[STRUCK] = ringing(frequencies, damping, bank, q, p)
    out[STRUCK] += 0.5 * rigid_mass * out[TARGET] ** 2 if rigid_mass < np.inf else 0.0
    out[DEEPEST] = room.deepest[last]
    out[DENT_LEFT] = asked(DENT, constants, 0.0, 0.0, out[DEEPEST], slopes)
    stored = asked(STORED, constants, record.indentation[last], 0.0, out[DEEPEST], slopes)
    given_up = stored if lossy and runs[touches - 1, 1] < last else 0.0  # a dashpot has used up the force before
    out[LOCAL] = stored - given_up + 0.5 * residual.compliance * record.spring_force[last] ** 2
    out[DISSIPATED] = record.lost[last] + given_up
    out[HIGHEST] = 0.0
    for k in range(last):
        out[HIGHEST] = max(out[HIGHEST], force[k])
    parted = contacts[count - 1, modal_contacts.END]
    out[APART] = modal_contacts.between(parted, step, record.rigid_velocity)
    out[APART] -= modal_contacts.between(parted, step, record.velocity)
    out[APART] += rate_at(parted, step, frequencies, at_contact, damping, bank, record, stride, q, p)
    _motions(record, step, rigid, *drawn)
    return SOLVED
