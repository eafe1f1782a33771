"""The modal kernel: exact oscillators, and a contact force whose work is exact.

M q'' + K q = -w F in mass-normalised modes is a bank of oscillators that see only one force. Over a step the force is
constant and every oscillator advances exactly, so no mode limits the step. The force is the discrete gradient of the
contact's work, so that total energy is kept to rounding at any step, stiffness and number of modes.
Error: second order in the step. Same family as the energy-stable collision schemes of Chatziioannou and van Walstijn
(2015).
"""

import math
from typing import NamedTuple

import numpy as np
from numba.extending import register_jitable

from ..jit.clock import check_time
from ..jit.kernels import allocating_kernel, inner_kernel, inner_summing_kernel, kernel
from ..jit.reference import refer
from .arrays import copy_to, largest
from .flights import Flights, fly


class Bank(NamedTuple):
    """One step of every oscillator, for arrays (modes,) holding at_contact * q and at_contact * q' / omega.

    Damped, by a fraction zeta of the critical: at_contact * (q' + zeta omega q) / omega_d instead of the latter, with
    omega_d = sqrt(1 - zeta^2) omega; so the pair still only turns, and shrinks.
    cosine, sine turn the pair by omega * step; kick_* is what a unit force adds within the step; turned_kick_* the
    same after one more turn, so that a single pass kicks, turns and sums; energy is what 1 m of it holds [J/m2].
    """

    cosine: np.ndarray
    sine: np.ndarray
    kick_displacement: np.ndarray
    kick_velocity: np.ndarray
    turned_kick_displacement: np.ndarray
    turned_kick_velocity: np.ndarray
    energy: np.ndarray
    excess: np.ndarray  # cosine^2 + sine^2 - 1, by rounding: undone now and then, as it would add up over 1e5 steps


@inner_kernel
def _turn(angle, softness, damping):
    """What some time does to an oscillator, by itself (cosine, sine) and by a constant unit force (kicks).

    angle: omega * time; softness (at_contact / omega)^2 [m/N]; damping ratio below 1.
    """
    if damping == 0.0:
        sine = math.sin(angle)
        return math.cos(angle), sine, softness * (2.0 * math.sin(0.5 * angle) ** 2), softness * sine
    root = math.sqrt(1.0 - damping * damping)
    lag, shrink = damping / root, math.exp(-damping * angle)
    sine = math.sin(root * angle)
    half = 2.0 * math.sin(0.5 * root * angle) ** 2  # 1 - cos, which cancels for low modes
    fade = -math.expm1(-damping * angle)
    return (
        shrink * math.cos(root * angle),
        shrink * sine,
        softness * (fade + shrink * (half - lag * sine)),
        softness * (shrink * sine + lag * (fade + shrink * half)),
    )


@inner_kernel
def _square(value):
    """A square as a sum of two doubles (Dekker)."""
    scaled = 134217729.0 * value
    high = scaled - (scaled - value)
    low = value - high
    product = value * value
    return product, ((high * high - product) + 2.0 * high * low) + low * low


@kernel
def set_bank(frequencies, at_contact, turning, damping, step, bank):
    """Write the bank of oscillators (modes,); see `oscillator_bank`."""
    bank = refer(bank)
    for i in range(frequencies.size):
        softness = (at_contact[i] / frequencies[i]) ** 2
        cosine, sine, kick, velocity_kick = _turn(turning[i] * step, softness, damping[i])
        bank.cosine[i], bank.sine[i] = cosine, sine
        bank.kick_displacement[i], bank.kick_velocity[i] = kick, velocity_kick
        bank.turned_kick_displacement[i] = cosine * kick + sine * velocity_kick
        bank.turned_kick_velocity[i] = cosine * velocity_kick - sine * kick
        bank.energy[i], bank.excess[i] = 0.5 / softness, 0.0
        if damping[i] == 0.0:
            c2, c_rest = _square(cosine)
            s2, s_rest = _square(sine)
            bank.excess[i] = ((max(c2, s2) - 1.0) + min(c2, s2)) + (c_rest + s_rest)


def oscillator_bank(
    frequencies: np.ndarray,
    at_contact: np.ndarray,
    step: float,
    turning: np.ndarray | None = None,
    damping: np.ndarray | None = None,
) -> Bank:
    """`turning` [rad/s]: frequencies at which the step turns the oscillators, where it is not exact.

    `damping` (modes,): of each oscillator, as a fraction of the critical.
    """
    bank = Bank(*np.empty((len(Bank._fields), frequencies.size)))
    damping = np.zeros(frequencies.size) if damping is None else damping
    set_bank(frequencies, at_contact, frequencies if turning is None else turning, damping, step, bank)
    return bank


@kernel
def turned(frequencies, at_contact, damping, time, force, displacement, velocity):
    """Carry oscillators, (instants, modes) as in `Bank`, on by a time and with a constant force, (instants,) each."""
    for k in range(time.size):
        for i in range(frequencies.size):
            softness = (at_contact[i] / frequencies[i]) ** 2
            cosine, sine, kick, velocity_kick = _turn(frequencies[i] * time[k], softness, damping[i])
            q, p = displacement[k, i], velocity[k, i]
            displacement[k, i] = cosine * q + sine * p + kick * force[k]
            velocity[k, i] = cosine * p - sine * q + velocity_kick * force[k]


class Record(NamedTuple):
    """What a march writes. contact_force (steps,) is constant over each step; the rest (steps + 1,) is at the instants.

    checkpoints_* (steps // stride + 1, modes): the oscillators at every stride-th instant, before the next step.
    """

    contact_force: np.ndarray  # [N]
    indentation: np.ndarray  # [m], negative: the gap
    position: np.ndarray  # of the impactor [m]
    velocity: np.ndarray  # of the impactor [m/s]
    rigid_position: np.ndarray  # of a free target [m]
    rigid_velocity: np.ndarray
    spring_force: np.ndarray  # in the spring of the modes left out [N]
    lost: np.ndarray  # energy dissipated by the law so far [J]
    checkpoint_displacement: np.ndarray
    checkpoint_velocity: np.ndarray


class Residual(NamedTuple):
    """The modes left out, as one more oscillator of infinite frequency, by the trapezoidal rule.

    While the contact force is F its own force goes from f to 2 F - f; by what it once was out it rings on. `settling`
    is a weight beyond a half of the new force in F, by which the ringing dies away; where a law's force may jump at
    first touch (`jumps`), the oscillator follows at once for two steps, f = F. What either costs counts as lost;
    elastic laws need neither.
    """

    compliance: float  # static, of all modes left out [m/N]
    settling: float = 0.0
    jumps: bool = False


@register_jitable
def residual_spring(compliance, step, period, jumps, plastic):
    """That of modes of this compliance beyond one of this period, under a law whose force may jump or that yields."""
    settling = min(0.5, step / period) if compliance > 0.0 and (jumps or plastic) else 0.0
    return Residual(compliance, settling, jumps)


@register_jitable
def _aligned(bank, displacement, velocity):
    """Copies of what turns oscillators, and of these: arrays made in a kernel are aligned to vector registers, which
    takes off a fifth of the time of 40 modes."""
    turning = bank.cosine.copy(), bank.sine.copy()
    kicks = bank.turned_kick_displacement.copy(), bank.turned_kick_velocity.copy()
    return (*turning, *kicks, displacement.copy(), velocity.copy())


@allocating_kernel
def march(law, residual, mass, rigid_mass, fall, surge, step, bank, displacement, velocity, stride, begin, end, record):
    """Advance from instant `begin` to `end`; displacement and velocity (modes,) are turned already for `begin`.

    mass, rigid_mass [kg]: of impactor and target where they move freely as a whole, or infinity; fall + surge t
    [m/s2]: by which the impactor accelerates towards the target without a touch. The bank holds the oscillators of
    both bodies.
    """
    bank, record = refer(bank), refer(record)
    own = _aligned(bank, displacement, velocity)
    none = own[4][:0]
    every = Flights(none, none, none)  # step is marched
    march_in_place(law, residual, mass, rigid_mass, fall, surge, step, bank, *own, stride, begin, end, record, every)
    copy_to(displacement, own[4])
    copy_to(velocity, own[5])


@allocating_kernel
def march_for_figures(
    law, residual, mass, rigid_mass, step, bank, displacement, velocity, stride, begin, end, record, flights
):
    """The same without weight, for what has to be known of contacts and of the end: `flights` are taken at once. In
    them the record lacks the positions, and between checkpoints the gap is nearly what it is."""
    bank, record, flights = refer(bank), refer(record), refer(flights)
    own = _aligned(bank, displacement, velocity)
    march_in_place(law, residual, mass, rigid_mass, 0.0, 0.0, step, bank, *own, stride, begin, end, record, flights)
    copy_to(displacement, own[4])
    copy_to(velocity, own[5])


@inner_kernel
def _check_in(bank, record, row, stride, force, q, p):
    """Keep the oscillators at a checkpoint, and take from them what the steps up to it have added in excess."""
    check_time()
    for i in range(q.size):
        correction = -0.5 * stride * bank.excess[i]
        q[i] += correction * q[i]
        p[i] += correction * p[i]
        record.checkpoint_displacement[row, i] = q[i] + bank.kick_displacement[i] * force
        record.checkpoint_velocity[row, i] = p[i] + bank.kick_velocity[i] * force


# The bank's own arrays, or copies of them, are given besides; q and p are left turned one step on, as for the next.
@inner_summing_kernel
def march_in_place(
    law, residual, mass, rigid_mass, fall, surge, step, bank,
    cosine, sine, q_kick, p_kick, q, p, stride, begin, end, record, flights,
):  # fmt: skip
    gain, rigid_gain, rate = step / mass, step / rigid_mass, 1.0 / step
    stiff = 0.5 * step * (gain + rigid_gain) + bank.kick_displacement.sum()  # a step's compliance without the residual
    x, v = record.position[begin], record.velocity[begin]
    rigid_x, rigid_v = record.rigid_position[begin], record.rigid_velocity[begin]
    indentation, lost, spring = record.indentation[begin], record.lost[begin], record.spring_force[begin]
    deepest = max(largest(record.indentation, begin + 1), 0.0)
    memory, usual = law.unloading(deepest), 1.0 / (0.5 + residual.settling)
    touched = begin == 0 or record.indentation[begin - 1] <= 0.0
    bending, force, force_before = q.sum(), 0.0, 0.0
    forces, indentations, springs, losses = record.contact_force, record.indentation, record.spring_force, record.lost
    k, checkpoint = begin, begin + stride - begin % stride
    while k < end:
        sped_up = step * (fall + surge * step * (k + 0.5))
        free = (x - rigid_x) + step * (v + 0.5 * sped_up - rigid_v) - bending
        expected, at_rest = force + force - force_before, force == 0.0
        force_before, apart = force, indentation <= 0.0
        inverse = 1.0 if residual.jumps and (apart or touched) else usual  # of the weight of the new force
        free += residual.compliance * (inverse - 1.0) * spring
        compliance = stiff + residual.compliance * inverse
        force, indentation, loss, memory = law.mean_force(
            indentation, free, compliance, rate, expected, deepest, memory
        )
        change = inverse * (force - spring)
        loss += residual.compliance * (1.0 - 0.5 * inverse) * change * (force - spring)
        spring += change
        touched = apart
        deepest = max(deepest, indentation)
        lost += loss
        x += step * (v + 0.5 * sped_up - 0.5 * gain * force)
        v += sped_up - gain * force
        rigid_x += step * (rigid_v + 0.5 * rigid_gain * force)
        rigid_v += rigid_gain * force
        forces[k] = force
        k += 1
        indentations[k], springs[k], losses[k] = indentation, spring, lost
        record.position[k], record.velocity[k] = x, v
        record.rigid_position[k], record.rigid_velocity[k] = rigid_x, rigid_v
        if k == checkpoint:
            _check_in(bank, record, k // stride, stride, force, q, p)
            if flights.angle.size > 0 and at_rest and force == 0.0 and apart and indentation < 0.0:
                k = fly(flights, q, p, record, k, end, stride, step, residual.compliance, inverse)
                x, rigid_x, spring, lost = record.position[k], record.rigid_position[k], springs[k], losses[k]
            checkpoint = k + stride
        bending = 0.0
        if force != 0.0:
            for i in range(q.size):
                turned = cosine[i] * q[i] + sine[i] * p[i] + q_kick[i] * force
                p[i] = cosine[i] * p[i] - sine[i] * q[i] + p_kick[i] * force
                q[i] = turned
                bending += turned
        else:
            for i in range(q.size):
                turned = cosine[i] * q[i] + sine[i] * p[i]
                p[i] = cosine[i] * p[i] - sine[i] * q[i]
                q[i] = turned
                bending += turned


@inner_kernel
def ringing(damping, bank, q, p):
    """Energy of all oscillators [J]."""
    total = 0.0
    for i in range(q.size):
        rate = math.sqrt(1.0 - damping[i] ** 2) * p[i] - damping[i] * q[i]
        total += bank.energy[i] * (q[i] * q[i] + rate * rate)
    return total


@inner_kernel
def carried_to(cell, bank, record, stride, q, p):
    """Write the oscillators (modes,) at an instant of a march, from what is saved of every stride-th."""
    saved = cell // stride
    copy_to(q, record.checkpoint_displacement[saved])
    copy_to(p, record.checkpoint_velocity[saved])
    _advance(bank, q, p, record.contact_force, saved * stride, cell)


@inner_kernel
def rate_at(time, step, frequencies, at_contact, damping, bank, record, stride, q, p):
    """Velocity of the struck face by all oscillators [m/s] at any time of a march; q, p (modes,): room."""
    cell = min(max(int(time / step + 1e-9), 0), record.contact_force.size - 1)
    carried_to(cell, bank, record, stride, q, p)
    total, later, push = 0.0, time - cell * step, record.contact_force[cell]
    for i in range(frequencies.size):
        softness = (at_contact[i] / frequencies[i]) ** 2
        cosine, sine, kick, velocity_kick = _turn(frequencies[i] * later, softness, damping[i])
        displacement = cosine * q[i] + sine * p[i] + kick * push
        velocity = cosine * p[i] - sine * q[i] + velocity_kick * push
        total += frequencies[i] * (math.sqrt(1.0 - damping[i] ** 2) * velocity - damping[i] * displacement)
    return total


@inner_kernel
def _advance(bank, displacement, velocity, force, begin, end):
    """Carry the oscillators (modes,) from one instant to another, in place."""
    for k in range(begin, end):
        for i in range(displacement.size):
            q, p = displacement[i], velocity[i]
            displacement[i] = bank.cosine[i] * q + bank.sine[i] * p + bank.kick_displacement[i] * force[k]
            velocity[i] = bank.cosine[i] * p - bank.sine[i] * q + bank.kick_velocity[i] * force[k]


@kernel
def carried(bank, saved_displacement, saved_velocity, stride, force, cells, displacement, velocity):
    """Writes the oscillators at these instants (rows,), before the next step, as (rows, modes) each: carried through
    the steps before from what is saved of every stride-th instant, or from the row before where that is nearer."""
    bank = refer(bank)
    for row in range(cells.size):
        cell = cells[row]
        saved = cell // stride
        begin, q, p = saved * stride, displacement[row], velocity[row]
        if row > 0 and begin <= cells[row - 1] <= cell:
            begin = cells[row - 1]
            copy_to(q, displacement[row - 1])
            copy_to(p, velocity[row - 1])
        else:
            copy_to(q, saved_displacement[saved])
            copy_to(p, saved_velocity[saved])
        _advance(bank, q, p, force, begin, cell)
