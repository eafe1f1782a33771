"""An impact by modes as a picture needs it, in one call: figures, contacts, and the forces that move the modes.

As in `waves.drawn`, so that it can be compiled ahead of time for where there is no Python.
"""

from typing import NamedTuple

import numpy as np
from numba.extending import register_jitable

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from ..jit.reference import refer
from . import modal_contacts
from .flights import every_step
from .modal_steps import LEAST_STEPS, usual_step
from .modes import half_period
from .oscillators import Bank, Record, carried_to, march_in_place, rate_at, residual_spring, ringing, set_bank
from .parting import WATCHED_PERIODS
from .waves.drawn import BEYOND, NO_ROOM, SOLVED, instant
from .waves.laws import DENT, FORCE, STORED

# what `answer` writes into `out`, in the units of its arguments; energies of what is struck and of the contact; WINDOW:
# shortest kept period; TOUCHES: contacts with all chatter, HIGHEST: the largest force of these
IMPULSE, FINAL, TARGET, APART, COMPRESSING, STRUCK, LOCAL, DISSIPATED, DEEPEST, DENT_LEFT = range(10)
STEPS, WINDOW, TOUCHES, HIGHEST, CONTACTS = range(10, 15)
STEP, DURATION, HALF = range(15, 18)  # of a beam: of the forces that are drawn, of all, half a period with the mass
COLUMNS = 18
LEFT = modal_contacts.COLUMNS  # column of its contacts: velocity of the impactor at the end
CONTACT_COLUMNS = LEFT + 1
EARLY = 0.15  # share of instants that are evenly spread; the others are closer together at first


class March(NamedTuple):
    """Room for a march and for what is made of it."""

    record: Record
    bank: Bank
    displacement: np.ndarray  # (modes,)
    velocity: np.ndarray
    deepest: np.ndarray  # (steps + 1,)
    impulses: np.ndarray
    runs: np.ndarray  # (steps // 2 + 1, 2) of integers
    slopes: np.ndarray  # (2,), for a law


class Bent(NamedTuple):
    """What is drawn of an impact across, closer together at first."""

    time: np.ndarray  # (instants,)
    impactor: np.ndarray  # (instants,), displacement; and of the struck place
    struck: np.ndarray
    impactor_rate: np.ndarray  # velocity; and of the struck place
    struck_rate: np.ndarray
    rates: np.ndarray  # (listed, 4): both as a contact begins and as it ends
    force: np.ndarray  # (groups,), the mean over so many steps that there is room for all
    depths: np.ndarray  # (cycle,), indentation of the impact at even times, and the force
    presses: np.ndarray
    widths: np.ndarray  # (cycle,), square of the radius of contact over that of the faces, of a law whose crater widens
    loading: np.ndarray  # (depths,), force by the law at even depths, and on the way back
    unloading: np.ndarray


@register_jitable
def early_instant(k, even, last):
    """The k-th of so many times, closer together at first."""
    share = k / (even - 1.0)
    return last * (EARLY * share + (1.0 - EARLY) * share * share)


@inner_kernel
def at_rest(record, q, p):
    """Bodies that are about to touch at a speed of one."""
    record.indentation[0] = record.position[0] = record.rigid_position[0] = record.rigid_velocity[0] = 0.0
    record.spring_force[0] = record.lost[0] = 0.0
    record.velocity[0] = 1.0
    for i in range(q.size):
        q[i] = p[i] = record.checkpoint_displacement[0, i] = record.checkpoint_velocity[0, i] = 0.0


@inner_kernel
def _together(record, rigid):
    """Of a rigid contact, which has no indentation: while they touch the struck face goes with the impactor."""
    if rigid:
        for k in range(record.indentation.size):
            record.indentation[k] = min(record.indentation[k], 0.0)


@inner_kernel
def cut(record, steps):
    """The first steps alone."""
    n = steps + 1
    return Record(
        record.contact_force[:steps], record.indentation[:n], record.position[:n], record.velocity[:n],
        record.rigid_position[:n], record.rigid_velocity[:n], record.spring_force[:n], record.lost[:n],
        record.checkpoint_displacement, record.checkpoint_velocity,
    )  # fmt: skip


@inner_kernel
def _damped(record, compliance, ringing_still):
    """What the oscillators have lost: the work that the contact force has done on them, less what they still have."""
    received, before = 0.0, 0.0
    for k in range(record.contact_force.size):
        bent = record.position[k + 1] - record.rigid_position[k + 1] - record.indentation[k + 1]
        bent -= compliance * record.spring_force[k + 1]
        received, before = received + record.contact_force[k] * (bent - before), bent
    return received - ringing_still


@inner_kernel
def figures(asked, of_law, residual, bodies, modes, step, stride, record, room, every_gap, parted, contacts, out):
    """Write contacts and figures of a march that has ended: see `answer`. Returns SOLVED, or NO_ROOM."""
    bank, q, p = room.bank, room.displacement, room.velocity
    (constants, lossy, rigid), (frequencies, at_contact, damping), force = of_law, modes, record.contact_force
    (mass, rigid_mass, whole, mean), last = bodies, force.size
    deepest, impulses = room.deepest[: last + 1], room.impulses[: last + 1]
    modal_contacts.gathered(record, step, deepest, impulses)
    out[WINDOW], slopes = 2.0 * np.pi / frequencies[frequencies.size - 1], room.slopes
    compliance = 1.0 / constants[0] if rigid else residual.compliance
    opening = 0.0 if every_gap else modal_contacts.least_opening(compliance, step, out[WINDOW], force, impulses)
    known = modal_contacts.Resolved(step, out[WINDOW], opening, every_gap, rigid, compliance > 0.0, parted)
    check_time()  # between passes over all steps, each of which takes a small part of what the march has taken
    touches = modal_contacts.touches(record, step, deepest, asked, constants, slopes, room.runs)
    runs = room.runs[:touches]
    count = modal_contacts.contacts(record, deepest, impulses, runs, known, asked, constants, slopes, contacts)
    if count < 1:
        return NO_ROOM
    check_time()
    for k in range(count):
        contacts[k, LEFT] = modal_contacts.between(contacts[k, modal_contacts.END], step, record.velocity)
    out[TOUCHES], out[CONTACTS], out[STEPS] = touches, count, last
    out[IMPULSE], out[FINAL] = impulses[last], record.velocity[last]
    out[TARGET] = mean * record.rigid_velocity[last]
    common = mass / (mass + whole)
    out[COMPRESSING] = mass * (1.0 - common) if out[FINAL] <= common else np.nan
    carried_to(last, bank, record, stride, q, p)
    still = ringing(damping, bank, q, p)
    out[STRUCK] = still + (0.5 * rigid_mass * record.rigid_velocity[last] ** 2 if rigid_mass < np.inf else 0.0)
    out[DEEPEST] = deepest[last]
    out[DENT_LEFT] = asked(DENT, constants, 0.0, 0.0, out[DEEPEST], slopes)
    stored = asked(STORED, constants, record.indentation[last], 0.0, out[DEEPEST], slopes)
    given_up = stored if lossy and runs[touches - 1, 1] < last else 0.0  # a dashpot has used up the force before
    out[LOCAL] = stored - given_up + 0.5 * residual.compliance * record.spring_force[last] ** 2
    damped = _damped(record, residual.compliance, still) if damping[0] > 0.0 else 0.0
    out[DISSIPATED] = record.lost[last] + given_up + damped
    check_time()
    out[HIGHEST] = 0.0
    for k in range(last):
        out[HIGHEST] = max(out[HIGHEST], force[k])
    parted_at = contacts[count - 1, modal_contacts.END]
    out[APART] = modal_contacts.between(parted_at, step, record.rigid_velocity)
    out[APART] -= modal_contacts.between(parted_at, step, record.velocity)
    out[APART] += rate_at(parted_at, step, frequencies, at_contact, damping, bank, record, stride, q, p)
    return SOLVED


@inner_kernel
def march_on(law, residual, bodies, step, stride, room, flights, begin, end):
    """March from one instant to another; flights: which are taken at once."""
    record, bank = room.record, room.bank
    turning = bank.cosine, bank.sine, bank.turned_kick_displacement, bank.turned_kick_velocity
    oscillators, masses = (room.displacement, room.velocity), (bodies[0], bodies[1])
    march_in_place(
        law, residual, *masses, 0.0, 0.0, step, bank, *turning, *oscillators, stride, begin, end, record, flights
    )


@kernel
def answer(law, asked, of_law, residual, bodies, modes, step, stride, room, contacts, drawn, out):
    """March an impact at a speed of one on what is at rest, and write what is drawn of it.

    law: with `mean_force` and `unloading`; asked: `waves.laws.law_function`; of_law: its constants, whether it is lossy
    and whether it stands for a rigid contact; residual: `oscillators.Residual`; bodies: mass of the impactor; of the
    target as far as it moves as a whole at once, and altogether, or infinity; its mean velocity over that of the struck
    place; modes: frequencies, amplitudes where it is struck and damping ratios, (modes,) each; stride: steps between
    checkpoints; room: `March`, of as many steps as are marched; contacts (room, CONTACT_COLUMNS); drawn: positions of
    the impactor and of the struck face at even times; out (COLUMNS,). Returns SOLVED, or NO_ROOM.
    """
    kept = refer(room)
    set_bank(modes[0], modes[1], modes[0], modes[2], step, kept.bank)
    at_rest(kept.record, kept.displacement, kept.velocity)
    every = every_step(kept.displacement)
    march_on(law, residual, bodies, step, stride, kept, every, 0, kept.record.contact_force.size)
    no = np.bool_(False)
    status = figures(asked, of_law, residual, bodies, modes, step, stride, kept.record, kept, no, no, contacts, out)
    _together(kept.record, of_law[2])
    for k in range(drawn[0].size):
        t = instant(k, drawn[0].size, step * kept.record.contact_force.size)
        drawn[0][k] = modal_contacts.between(t, step, kept.record.position)
        drawn[1][k] = drawn[0][k] - modal_contacts.between(t, step, kept.record.indentation)
    return status


@inner_kernel
def followed(law, of_law, residual, bodies, modes, step, stride, room, every, most, afterglow, rings):
    """March whole periods of the target until both have parted for good, see `parting`; how many steps are to be seen,
    -1: no room, or they may touch again. As `Modal` does; of_law: `asked` and its constants; every: step is marched;
    rings: whether any body does.
    """
    record, chunk, done, touched = room.record, int(np.ceil(2.0 * np.pi / modes[0][0] / step)), 0, 0
    while done < most:
        until = min(done + chunk, most)
        if until > record.contact_force.size:
            return -1, np.bool_(False)
        march_on(law, residual, bodies, step, stride, room, every, done, until)
        last = until
        while last > 0 and record.contact_force[last - 1] == 0.0:
            last -= 1
        apart = last <= done
        last = modal_contacts.closed(last, until, record, step, of_law[0], of_law[1], room.slopes)
        if not apart:
            touched = until
        elif last + int(np.ceil(afterglow / step)) <= until and record.rigid_velocity[until] > record.velocity[until]:
            swings = residual.compliance * abs(record.spring_force[until])
            for i in range(room.displacement.size):
                swings += np.hypot(room.displacement[i], room.velocity[i])
            if not rings or record.rigid_position[until] - record.position[until] > swings:
                return last + int(np.ceil(afterglow / step)), np.bool_(True)
            if (until - touched) * step >= WATCHED_PERIODS * 2.0 * np.pi / modes[0][0]:
                return -1, np.bool_(False)
        done = until
    return done, np.bool_(False)


@inner_kernel
def _struck_rate(t, step, record):
    """Velocity of the struck place over a step of the march."""
    k = min(max(int(t / step), 0), record.contact_force.size - 1)
    ahead = record.position[k + 1] - record.indentation[k + 1]
    return (ahead - (record.position[k] - record.indentation[k])) / step


@inner_kernel
def _histories(record, step, contacts, count, drawn):
    """What is drawn over time: see `Bent`."""
    steps, even = record.contact_force.size, drawn.time.size
    last = step * steps
    for k in range(even):
        t = early_instant(k, even, last)
        drawn.time[k], drawn.impactor[k] = t, modal_contacts.between(t, step, record.position)
        drawn.struck[k] = drawn.impactor[k] - modal_contacts.between(t, step, record.indentation)
        drawn.impactor_rate[k] = modal_contacts.between(t, step, record.velocity)
        drawn.struck_rate[k] = _struck_rate(t, step, record)
    for k in range(min(count, drawn.rates.shape[0])):
        for n in range(2):
            t = min(contacts[k, n], last)  # START, END
            drawn.rates[k, 2 * n] = modal_contacts.between(t, step, record.velocity)
            drawn.rates[k, 2 * n + 1] = _struck_rate(t, step, record)
    group = -(-steps // drawn.force.size)
    for k in range(-(-steps // group)):
        drawn.force[k] = 0.0
        for n in range(k * group, min((k + 1) * group, steps)):
            drawn.force[k] += record.contact_force[n] / group
    return group


@inner_kernel
def cycle_of(record, step, law, asked, constants, slopes, until, deepest, drawn):
    """The law slowly to the greatest indentation and back, at even depths, and what the impact did, at even times."""
    last, top = record.contact_force.size - 1, 0.0
    for k in range(drawn.depths.size):  # a force is constant over each step: given in the middle
        cell = min(int(instant(k, drawn.depths.size, until) / step), last)
        drawn.depths[k] = 0.5 * (record.indentation[cell] + record.indentation[cell + 1])
        pressed = drawn.depths[k] > asked(DENT, constants, 0.0, 0.0, 0.0, slopes)
        drawn.presses[k] = record.contact_force[cell] if pressed else 0.0
        top = max(top, drawn.depths[k])
        dent, stiffness = law.unloading(top)
        drawn.widths[k] = (stiffness / constants[0]) ** 2 * max(drawn.depths[k] - dent, 0.0)
    for k in range(drawn.loading.size):
        depth = instant(k, drawn.loading.size, deepest)
        drawn.loading[k] = asked(FORCE, constants, depth, 0.0, 0.0, slopes)
        drawn.unloading[k] = asked(FORCE, constants, depth, 0.0, deepest, slopes)


@inner_kernel
def begun(law, bodies, modes, compliance, sudden, rigid, longest, asked_time, periods, march):
    """Begin a march of what is struck across: its step, how many there are at most, and the modes left out."""
    (frequencies, at_contact, damping), (mass, rigid_mass, whole, _), give = modes, bodies, 0.0
    for i in range(frequencies.size):
        give += (at_contact[i] / frequencies[i]) ** 2
    series = 0.0 if rigid else compliance
    reduced, felt = 1.0 / (1.0 / mass + 1.0 / rigid_mass), 1.0 / (1.0 / mass + 1.0 / whole)
    highest, yes = frequencies[frequencies.size - 1], np.bool_(True)
    step = usual_step(law, series, reduced, 1.0, longest, longest, felt, give, highest, yes)
    most = int(np.ceil(periods * longest / step))
    if asked_time > 0.0:
        most = max(LEAST_STEPS, int(np.ceil(asked_time / step)))
        step = asked_time / most
    set_bank(frequencies, at_contact, frequencies, damping, step, march.bank)
    at_rest(march.record, march.displacement, march.velocity)
    return step, most, residual_spring(series, step, 2.0 * np.pi / highest, sudden[0], sudden[1])


@inner_kernel
def _of_beam(
    law, asked, of_law, bodies, modes, compliance, sudden, longest, asked_time, limits, stride, kept, contacts, out
):  # fmt: skip
    """March an impact across and write its figures; whether it is SOLVED, its step and how many there are."""
    (constants, _, rigid), every, parted = of_law, every_step(kept.displacement), np.bool_(False)
    step, most, residual = begun(law, bodies, modes, compliance, sudden, rigid, longest, asked_time, limits[0], kept)
    if asked_time > 0.0 and most > kept.record.contact_force.size:
        return NO_ROOM, step, most
    if asked_time > 0.0:
        march_on(law, residual, bodies, step, stride, kept, every, 0, most)
    else:
        shown, of_it, yes = limits[1] * longest, (asked, constants), np.bool_(True)
        most, parted = followed(law, of_it, residual, bodies, modes, step, stride, kept, every, most, shown, yes)
        if most < 1:
            return NO_ROOM, step, most
    record = refer(cut(kept.record, most))
    status = figures(
        asked, of_law, residual, bodies, modes, step, stride, record, kept, not rigid, parted, contacts, out
    )
    out[DURATION] = step * most
    return status, step, most


@kernel
def answer_of_beam(
    law, asked, of_law, bodies, modes, compliance, sudden, longest, asked_time, limits, stride, room, contacts, drawn,
    out,
):  # fmt: skip
    """The same of what is struck across, for a time that is asked for or, if that is 0, for as long as is usual.

    compliance: of the modes left out; sudden: whether the force may jump, and whether the law yields; longest: slowest
    period; limits: periods that are marched at most, and shown after the last parting; room: as many steps as there is
    room for; drawn: `Bent`.
    """
    kept, (frequencies, at_contact, _), (constants, _, rigid) = refer(room), modes, of_law
    impact = law, asked, of_law, bodies, modes, compliance, sudden, longest, asked_time, limits
    status, step, most = _of_beam(*impact, stride, kept, contacts, out)
    if status != SOLVED:
        return status
    record = refer(cut(kept.record, most))
    count, slopes = int(out[CONTACTS]), kept.slopes
    check_time()
    _together(record, rigid)
    out[STEP] = step * _histories(record, step, contacts, count, drawn)
    until = min(step * most, BEYOND * contacts[count - 1, modal_contacts.END])
    cycle_of(record, step, law, asked, constants, slopes, until, out[DEEPEST], drawn)
    out[HALF] = half_period(frequencies, at_contact, compliance, 1.0 / bodies[0] + 1.0 / bodies[1])
    return SOLVED
