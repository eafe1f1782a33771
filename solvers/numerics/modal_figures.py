"""Figures alone of an impact across by its modes, without histories: memory does not grow with the steps.

A window of steps is marched at a time, what contacts and figures need is taken from it, and the next one begins with
its end. Where faces cannot meet for a while, that is one leap however many steps it takes.
"""

import math
from typing import NamedTuple

import numpy as np

from ..jit.clock import check_time
from ..jit.kernels import inner_kernel, kernel
from ..jit.reference import refer
from . import modal_contacts
from .arrays import copy_to
from .flights import Flights, _steps_apart, every_step, set_flights
from .modal_drawn import March, begun, cut, march_on
from .oscillators import carried_to, ringing
from .parting import WATCHED_PERIODS
from .waves.drawn import NO_ROOM, SOLVED
from .waves.laws import STORED

# what a march goes on with, and in the end its figures; times in steps; SEEN: how far the resolved force is known;
# SHOWN: the instant that FINAL and what follows are of, velocities, energies of what is struck and lost, indentation
DONE, FIRST, DEEPEST, PRESSED, PRESSED_UNTIL, PARTED_AT, SEEN, IMPULSE = range(8)
COUNT, START, PARTING, TOUCHING, PEAK, OPEN, RECEIVED, FLYING = range(8, 16)
SHOWN, FINAL, TARGET, STRUCK, LOST, DEPTH, DISSIPATED = range(16, 23)
COLUMNS = 23
BEGUN, ENDED, LEAST = range(3)  # of a contact of rigid faces: times, and the indentation where they open most behind it
CHATTERS = 3


class Windowed(NamedTuple):
    """Room for all of it."""

    march: March  # of as many steps as a window has: whole strides, two at least
    flights: Flights  # (modes,) each
    displacement: np.ndarray  # (modes,), at any instant
    velocity: np.ndarray
    impulses: np.ndarray  # of rigid faces, at the last instants: a power of two of them, and more than a window
    chatter: np.ndarray  # (contacts, CHATTERS) of rigid faces, which may still turn out to be one
    contact: np.ndarray  # (1, columns of contacts)
    known: np.ndarray  # (COLUMNS,)


@inner_kernel
def _between(place, last, impulses):
    """The impulse at any of the last instants, straight between them, up to the last that there is."""
    place = min(max(place, 0.0), float(last))
    k, size = min(int(place), last - 1), impulses.size - 1
    before = impulses[k & size]
    return before + (place - k) * (impulses[(k + 1) & size] - before)


@inner_kernel
def _resolve(known, last, ended, impulses, s):
    """The largest force that the modes resolve, see `modal_contacts.resolve`, at all instants whose time has come."""
    half, step = 0.5 * known.window, known.step
    until = last + 1 if ended else last - int(half / step) - 1
    for k in range(int(s[SEEN]), until):
        rise = _between((k * step + half) / step, last, impulses) - _between((k * step - half) / step, last, impulses)
        s[PEAK] = max(s[PEAK], rise / known.window)
    s[SEEN] = max(s[SEEN], until)


@inner_kernel
def _opens(chatter, k, opening):
    return -chatter[k, LEAST] > opening


@inner_kernel
def _joined(chatter, count, opening):
    """Make one of contacts between which faces open by less; how many are left."""
    left = min(count, 1)
    for k in range(1, count):
        if _opens(chatter, left - 1, opening):
            chatter[left, BEGUN] = chatter[k, BEGUN]
            left += 1
        chatter[left - 1, ENDED], chatter[left - 1, LEAST] = chatter[k, ENDED], chatter[k, LEAST]
    return left


@inner_kernel
def _edge(k, presses, record, room, known, asked, constants):
    """Write the contact of one step of a window, whose start or end that is: of step k, or of the one before. Times are
    those of the window; record: as far as it is known."""
    march, runs = room.march, room.march.runs[:1]
    modal_contacts.gathered(record, known.step, march.deepest, march.impulses)
    runs[0, 0] = k if presses else k - 1
    runs[0, 1] = runs[0, 0] + 1
    modal_contacts.contacts(
        record, march.deepest, march.impulses, runs, known, asked, constants, march.slopes, room.contact
    )


@inner_kernel
def _begins(k, room, known, rigid, s):
    """Take up a contact that begins with step k of the window; whether there is room."""
    start, chatter = room.contact[0, modal_contacts.START] + s[FIRST] * known.step, room.chatter
    if not rigid:
        s[COUNT], s[START] = s[COUNT] + 1.0, start
        s[PEAK] = max(s[PEAK], room.contact[0, modal_contacts.PEAK])
        return True
    count, apart = int(s[COUNT]), (s[FIRST] + k - s[PARTED_AT]) * known.step >= known.window
    if count == 0 or (apart and _opens(chatter, count - 1, s[OPEN] * s[PEAK])):  # PEAK still grows: looked at again
        if count == chatter.shape[0]:
            count = _joined(chatter, count, s[OPEN] * s[PEAK])
        if count == chatter.shape[0]:
            return False
        chatter[count, BEGUN], s[COUNT] = start, count + 1.0
    return True


@inner_kernel
def _ends(k, room, known, rigid, s):
    """End a contact behind which step k of the window comes."""
    end, row = room.contact[0, modal_contacts.END] + s[FIRST] * known.step, room.chatter[int(s[COUNT]) - 1]
    s[PARTED_AT] = s[FIRST] + k
    if rigid:
        row[ENDED], row[LEAST] = end, room.march.record.indentation[k]
    else:
        s[TOUCHING], s[PARTING] = s[TOUCHING] + end - s[START], end


@inner_kernel
def _bent(k, record, compliance):
    """How far the oscillators are from rest at an instant of the window."""
    bent = record.position[k] - record.rigid_position[k] - record.indentation[k]
    return bent - compliance * record.spring_force[k]


@inner_kernel
def _take(begin, end, ended, room, known, asked, of_law, compliance, s):
    """Take what is needed from these steps of the window; whether there is room. ended: none come after them."""
    march, record, (constants, _, rigid) = room.march, room.march.record, of_law
    force, depth = record.contact_force, record.indentation
    for k in range(begin, end + 1 if ended else end):
        presses, pressed = k < end and force[k] > 0.0, s[PRESSED] > 0.0
        if k < end and pressed and not presses:
            presses = modal_contacts.closed(k, k + 1, record, known.step, asked, constants, march.slopes) > k
        if presses != pressed:
            s[PRESSED] = 1.0 if presses else 0.0
            _edge(k, presses, refer(cut(record, min(k + 1, end))), room, known, asked, constants)
            if not presses:
                _ends(k, room, known, rigid, s)
            elif not _begins(k, room, known, rigid, s):
                return False
        if k == end:
            break
        if force[k] > 0.0:
            s[DEEPEST], s[PRESSED_UNTIL] = max(s[DEEPEST], depth[k + 1]), s[FIRST] + k + 1
            s[IMPULSE] += force[k] * known.step
            s[RECEIVED] += force[k] * (_bent(k + 1, record, compliance) - _bent(k, record, compliance))
            if not rigid:
                s[PEAK] = max(s[PEAK], force[k])
        if rigid:
            room.impulses[(int(s[FIRST]) + k + 1) & (room.impulses.size - 1)] = s[IMPULSE]
            if not presses:
                row = room.chatter[int(s[COUNT]) - 1]
                row[LEAST] = min(row[LEAST], depth[k + 1])
    if rigid:
        _resolve(known, int(s[FIRST]) + end, ended, room.impulses, s)
    return True


@inner_kernel
def _show(room, bodies, damping, stride, s):
    """Keep what is seen in the end, if it ends here."""
    record, m = room.march.record, int(s[DONE] - s[FIRST])
    carried_to(m, room.march.bank, record, stride, room.displacement, room.velocity)
    s[SHOWN], s[FINAL], s[TARGET] = s[DONE], record.velocity[m], record.rigid_velocity[m]
    s[STRUCK] = ringing(damping, room.march.bank, room.displacement, room.velocity)
    s[LOST], s[DEPTH] = record.lost[m], record.indentation[m]
    s[DISSIPATED] = s[RECEIVED] - s[STRUCK] if damping[0] > 0.0 else 0.0
    if bodies[1] < np.inf:
        s[STRUCK] += 0.5 * bodies[1] * s[TARGET] ** 2


@inner_kernel
def _move_on(record, stride, s):
    """Begin the window anew with its last stride; before it stands the largest indentation so far."""
    m = int(s[DONE] - s[FIRST])
    for k in range(stride + 1):
        n = m - stride + k
        if k < stride:
            record.contact_force[k] = record.contact_force[n]
        record.indentation[k], record.spring_force[k] = record.indentation[n], record.spring_force[n]
        record.position[k], record.velocity[k] = record.position[n], record.velocity[n]
        record.rigid_position[k], record.rigid_velocity[k] = record.rigid_position[n], record.rigid_velocity[n]
        record.lost[k] = record.lost[n]
    for k in range(2):
        copy_to(record.checkpoint_displacement[k], record.checkpoint_displacement[m // stride - 1 + k])
        copy_to(record.checkpoint_velocity[k], record.checkpoint_velocity[m // stride - 1 + k])
    record.indentation[0] = s[DEEPEST]
    s[FIRST] = s[DONE] - stride


@inner_kernel
def _turn(angle, damping):
    """What some time does to an oscillator, see `oscillators.Bank`; angle: its frequency times the time."""
    turned, shrink = math.sqrt(1.0 - damping * damping) * angle, math.exp(-damping * angle)
    return shrink * math.cos(turned), shrink * math.sin(turned)


@inner_kernel
def _leap(room, damping, residual, step, stride, until, s):
    """From the beginning of a window, with nothing but its last stride before it, fly as far as faces cannot meet.

    Neither can oscillators that are damped bring them closer in a step than by all amplitudes, which shrink.
    """
    record, flights, bank = room.march.record, room.flights, room.march.bank
    q, p = room.march.displacement, room.march.velocity
    gap, spring, lost = -record.indentation[stride], record.spring_force[stride], record.lost[stride]
    ahead = record.position[stride] - record.rigid_position[stride]
    approach = step * (record.velocity[stride] - record.rigid_velocity[stride])
    at, rate = record.checkpoint_displacement[1], record.checkpoint_velocity[1]
    apart = _steps_apart(flights, at, rate, ahead, approach, gap, residual.compliance * abs(spring))
    strides = int(min(apart, until - s[DONE])) // stride
    if strides < 1:
        return
    check_time()
    steps, bent = float(strides * stride), 0.0
    for i in range(q.size):
        cosine, sine = flights.cosine[i], flights.sine[i]
        if strides > 1 or damping[i] > 0.0:
            cosine, sine = _turn(steps * flights.angle[i], damping[i])
        at[i], rate[i] = cosine * at[i] + sine * rate[i], cosine * rate[i] - sine * at[i]
        q[i] = bank.cosine[i] * at[i] + bank.sine[i] * rate[i]
        p[i] = bank.cosine[i] * rate[i] - bank.sine[i] * at[i]
        bent += at[i]
    weight = 1.0 if residual.jumps else 1.0 / (0.5 + residual.settling)  # see `flights.fly`: the same in closed form
    left = (1.0 - weight) ** 2
    if left < 1.0:
        once = residual.compliance * (1.0 - 0.5 * weight) * weight
        lost += once * spring * spring * (1.0 - math.pow(left, steps)) / (1.0 - left)
    spring *= math.pow(1.0 - weight, steps)
    position = record.position[stride] + steps * step * record.velocity[stride]
    rigid_position = record.rigid_position[stride] + steps * step * record.rigid_velocity[stride]
    gap = min(ahead + steps * approach - bent - residual.compliance * spring, 0.0)
    for k in range(1, stride + 1):
        record.contact_force[k - 1] = 0.0
        record.position[k], record.rigid_position[k] = position, rigid_position
        record.indentation[k], record.spring_force[k], record.lost[k] = gap, spring, lost
    s[DONE] += steps
    s[FIRST] = s[DONE] - stride


@inner_kernel
def _flies(room, stride, s):
    """Whether nothing has pressed, or touched, for two steps at a checkpoint: as `oscillators` begins a flight."""
    m, record = int(s[DONE] - s[FIRST]), room.march.record
    if s[FLYING] == 0.0 or m < stride or m % stride > 0:
        return False
    still = record.contact_force[m - 1] == 0.0 and record.contact_force[m - 2] == 0.0
    return still and record.indentation[m - 1] <= 0.0 and record.indentation[m] < 0.0


@inner_kernel
def _to(until, most, glow, law, asked, of_law, residual, bodies, damping, known, stride, room, s):
    """March to an instant, window by window; whether there is room. On the way what is `glow` steps behind the last
    contact is shown, and what is after `most` of them."""
    march, every = room.march, every_step(room.displacement)  # step of a window; flights are taken from its end on
    while s[DONE] < until:
        begin, seen, goal = int(s[DONE] - s[FIRST]), s[PARTED_AT] + glow, min(float(until), s[DONE] + glow)
        if s[DONE] < seen and s[PRESSED] == 0.0:
            goal = min(goal, seen)
        if s[FLYING] > 0.0 and s[PRESSED] == 0.0:
            goal = min(goal, s[FIRST] + begin + stride - begin % stride)
        end = int(min(goal - s[FIRST], float(march.record.contact_force.size)))
        march_on(law, residual, bodies, known.step, stride, march, every, begin, end)
        s[DONE] = s[FIRST] + end
        if not _take(begin, end, s[DONE] == most, room, known, asked, of_law, residual.compliance, s):
            return False
        flies, seen = _flies(room, stride, s), s[PARTED_AT] + glow
        if flies or end == march.record.contact_force.size:
            _move_on(march.record, stride, s)
        if flies:
            _leap(room, damping, residual, known.step, stride, min(float(until), seen if s[DONE] < seen else np.inf), s)
        if s[DONE] == most or (s[DONE] == seen and s[PRESSED] == 0.0):
            _show(room, bodies, damping, stride, s)
    return True


@inner_kernel
def _followed(most, room_for, asked_time, shown, law, asked, of_law, residual, bodies, modes, known, stride, room, s):
    """March so many steps, or as `modal_drawn.followed` does: whether that is done, and whether they have parted for
    good. room_for: how many steps may be taken."""
    period, record, touched = 2.0 * np.pi / modes[0][0], room.march.record, 0.0
    asks, chunk = asked_time > 0.0, float(math.ceil(period / known.step))
    glow = float(most) if asks else float(math.ceil(shown / known.step))
    while s[DONE] < most:
        done, until = s[DONE], float(most) if asks else min(s[DONE] + chunk, float(most))
        if until > room_for or not _to(
            until, most, glow, law, asked, of_law, residual, bodies, modes[2], known, stride, room, s
        ):
            return False, False
        m, parted_at = int(s[DONE] - s[FIRST]), s[PARTED_AT] if s[PRESSED] == 0.0 else until
        if s[PRESSED_UNTIL] > done:
            touched = until
        elif not asks and parted_at + glow <= until and record.rigid_velocity[m] > record.velocity[m]:
            swings = residual.compliance * abs(record.spring_force[m])
            for i in range(modes[0].size):
                swings += np.hypot(room.march.displacement[i], room.march.velocity[i])
            if record.rigid_position[m] - record.position[m] > swings:
                return True, True
            if (until - touched) * known.step >= WATCHED_PERIODS * period:
                return False, False
    return True, False


@inner_kernel
def _settle(room, known, asked, of_law, parted, s):
    """Write the figures of a march that has ended: what of contacts is known in the end alone."""
    (constants, lossy, rigid), pressed = of_law, s[PARTED_AT] == s[SHOWN]
    if lossy and not pressed:  # a dashpot has used up the force before the dent has closed
        s[LOST] += asked(STORED, constants, s[DEPTH], 0.0, s[DEEPEST], room.march.slopes)
    s[DISSIPATED] += s[LOST]
    if not rigid:
        return
    opening, chatter = s[OPEN] * s[PEAK], room.chatter
    count = _joined(chatter, int(s[COUNT]), opening)
    if not parted and not pressed:
        opened, left = -chatter[count - 1, LEAST], (s[SHOWN] - s[PARTED_AT]) * known.step
        if left < known.window or 0.0 < opened <= opening:
            chatter[count - 1, ENDED] = s[SHOWN] * known.step
    s[COUNT], s[PARTING] = count, chatter[count - 1, ENDED]
    for k in range(count):
        s[TOUCHING] += chatter[k, ENDED] - chatter[k, BEGUN]


@kernel
def figures_of_beam(
    law, asked, of_law, bodies, modes, compliance, sudden, longest, asked_time, limits, most_steps, stride, room
):  # fmt: skip
    """Figures alone of what is struck across, into `room.known`: see `modal_drawn.answer_of_beam`. Flights are
    taken at once, unless a contact is rigid; an impact of more than `most_steps` is refused. Returns SOLVED or NO_ROOM,
    and the step."""
    room, frequencies, (constants, _, rigid) = refer(room), modes[0], of_law
    march, s, window = room.march, room.known, 2.0 * np.pi / frequencies[frequencies.size - 1]
    step, most, residual = begun(law, bodies, modes, compliance, sudden, rigid, longest, asked_time, limits[0], march)
    if rigid and window / step > room.impulses.size - march.record.contact_force.size - 4.0:
        return NO_ROOM, step
    gives = 1.0 / constants[0] if rigid else residual.compliance
    # at its edges each contact is looked at by itself: what of rigid faces is chatter is known later
    no, yes = np.bool_(False), np.bool_(True)
    known = modal_contacts.Resolved(step, window, 0.0, yes, no, gives > 0.0, yes)
    for k in range(COLUMNS):
        s[k] = 0.0
    room.impulses[0], s[OPEN] = 0.0, modal_contacts.LEAST_OPENING * gives
    s[FLYING] = 0.0 if rigid else 1.0
    set_flights(frequencies, step, stride, room.flights)
    marched = law, asked, of_law, residual, bodies, modes, known, stride, room, s
    solved, parted = _followed(most, most_steps, asked_time, limits[1] * longest, *marched)
    if not solved or s[COUNT] < 1.0:
        return NO_ROOM, step
    _settle(room, known, asked, of_law, parted, s)
    return SOLVED, step
