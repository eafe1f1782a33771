"""A rigid mass against a beam, no local compliance: modes of both while they touch, of the beam alone while apart.

Between two changes of the set every mode moves by itself, so that only the instants of parting and of touching again
are searched for. At each change displacements and velocities are projected with the mass inner product of the new set:
an equation for both sets, f K c = w_c^2 (f M c + m1 f(a) c(a)) = w_f^2 f M c, gives the integrals in closed form for
every support and theory. SI units.
Source: thesis 5.5, (5.29)-(5.43). Differs: (5.38) should read E = 2 v R (sin + sinh)(cos + cosh) / (w (R^2 + (m2 / m1)
(sin + sinh)^2)); the rates in (5.42) and (5.43) are to be divided by w, not multiplied; the denominator of F in (5.43)
is that of the contact modes. None of them is used here as printed.
"""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import allocating_kernel, inner_kernel, kernel
from ..arrays import add_to, copy_to, dot, multiply, multiply_by
from ..free_motion import exact_turn, rise_in, rises, step_back, step_on, sum_after, turn_by
from ..modes import Modes
from ..parting import WATCHED_PERIODS
from .phases import Contact, Phase, Phases

# Of the shortest period kept, at which signs are looked at to find roots. With fewer, contacts are missed; see
# `test_mode_switch_beams.py`.
SAMPLES_PER_PERIOD = 16
MAX_PHASES = 4_000  # changes of modes; more are chatter, which is said
MAX_SAMPLED_NUMBERS = 1_000_000_000  # samples times modes: some seconds; a longer impact is stopped, which is said
MAX_FORCE_SAMPLES = 20_000  # kept of each contact; fewer, and drawn forces lose their peaks
# Relative difference of squared frequencies below which a mode with the mass and one without are the same, to rounding:
# such a mode is at rest where the mass sits.
SAME_MODE = 3e-8
PLACES_PER_MODE = 4  # at which two shapes are compared; below 2 different shapes may look the same


class Bank(NamedTuple):
    """See `free_motion`."""

    frequencies: np.ndarray
    closing: np.ndarray


class Sets(NamedTuple):
    """Both sets of modes, each with the motion as a whole in front if there is one; m1 [kg].

    pull: of the faces per unit of each coordinate of the contact set; gap: overlap of the faces while apart, whose
    first coordinate is the position of the mass; overlap (contact modes, free modes): integrals of mass times shapes.
    """

    mass: float
    at: np.ndarray  # contact shapes at the struck place
    pull: Bank
    gap: Bank
    overlap: np.ndarray


class Record(NamedTuple):
    """At the start of each phase, contact and flight by turns, (phases,) and (phases, modes)."""

    start: np.ndarray
    displacement: np.ndarray
    rate: np.ndarray
    position: np.ndarray  # of the mass
    velocity: np.ndarray
    lost: np.ndarray  # energy lost by truncation and projection up to here


class SwitchedBeam(Phases):
    """The whole impact: `solve` fills `phases` and `contacts`, and says whether the bodies `parted` for good, or
    whether it had to be `stopped` before, as there are limits to phases and steps.
    """

    smoothing = "none"

    def __init__(self, together: Modes, alone: Modes, mass: float, speed: float, length: float):
        super().__init__(together, alone, mass)
        self.speed = speed
        self.contacts: list[Contact] = []
        self.parted = self.stopped = False
        self.sets = _sets(together, alone, mass, length)

    def solve(self, limit: float) -> None:
        """Follow the impact until the bodies part for good, or to `limit` [s]."""
        sets, modes = self.sets, self.sets.at.size
        steps = [2.0 * np.pi / float(bank.frequencies[-1]) / SAMPLES_PER_PERIOD for bank in (sets.pull, sets.gap)]
        turns = [exact_turn(bank.frequencies, step) for bank, step in zip((sets.pull, sets.gap), steps, strict=True)]
        lowest = float(self.alone.frequencies[0])
        record = Record(
            *(np.zeros(shape) for shape in (MAX_PHASES, *2 * [(MAX_PHASES, modes)], *3 * [MAX_PHASES]))
        )  # fmt: skip
        patience = WATCHED_PERIODS * 2.0 * np.pi / lowest
        longest = MAX_SAMPLED_NUMBERS / modes * min(steps)
        count, reached, self.parted = _switch(sets, *turns, *steps, self.speed, min(limit, longest), patience, record)
        self.stopped = reached < limit and not self.parted
        free = 0 if self.fixed else 1
        for number in range(count):
            touching = number % 2 == 0
            at = sets.at[0] if touching else -sets.gap.closing[1]
            q, p = record.displacement[number], record.rate[number]
            whole = (at * float(q[0]), at * float(p[0])) if free else (0.0, 0.0)
            motion = (float(part[number]) for part in (record.position, record.velocity, record.lost))
            self.phases.append(Phase(touching, float(record.start[number]), q[free:], p[free:], *whole, *motion))
        ends = [phase.start for phase in self.phases[1:]] + [reached]
        for phase, end in zip(self.phases[::2], ends[::2], strict=True):
            self.contacts.append(self._contact(phase, end, steps[0]))

    def _contact(self, phase: Phase, end: float, step: float) -> Contact:
        """Its force on instants as close as the search looked, and the highest there is between them."""
        frequencies, longest = self.together.frequencies, end - phase.start
        steps = 1 + int(longest / step)
        stride = 1 + steps // MAX_FORCE_SAMPLES
        forces = np.empty(2 + steps // stride)
        step = longest / (stride * (forces.size - 1))
        turn = exact_turn(frequencies, step)
        weights = self.mass * frequencies**2 * self.together.at_contact
        peak = _pushes(Bank(frequencies, weights), turn, step, stride, phase.displacement, phase.rate, forces)
        impulse = self.mass * (phase.mass_velocity - float(self._mass_in(phase, np.array([longest]))[1][0]))
        return Contact(phase.start, end, impulse, peak, np.linspace(phase.start, end, forces.size), forces)


def _sets(together: Modes, alone: Modes, mass: float, length: float) -> Sets:
    fixed = not np.isfinite(alone.rigid_mass)
    frequencies = [np.append([] if fixed else 0.0, modes.frequencies) for modes in (together, alone)]
    at, free_at = (
        np.append([] if fixed else modes.rigid_mass**-0.5, modes.at_contact) for modes in (together, alone)
    )  # fmt: skip
    vibrating = slice(0 if fixed else 1, None)
    overlap = np.empty((at.size, free_at.size))
    if not fixed:  # the same motion as a whole in both; contact modes balance their momentum by that of the mass
        overlap[0, 0] = np.sqrt(alone.rigid_mass / together.rigid_mass)
        overlap[0, 1:] = 0.0
        overlap[1:, 0] = -mass * at[1:] * free_at[0]
    overlap[vibrating, vibrating] = overlap_integrals(together, alone, mass, length)
    pull = Bank(frequencies[0], -mass * frequencies[0] ** 2 * at)
    return Sets(mass, at, pull, Bank(np.append(0.0, frequencies[1]), np.append(1.0, -free_at)), overlap)


def overlap_integrals(together: Modes, alone: Modes, mass: float, length: float) -> np.ndarray:
    """Integrals over the beam of its mass times a shape of both bodies times one of its own, (together, alone).

    m1 w_c^2 c(a) f(a) / (w_f^2 - w_c^2), with the rotary inertia in it where the theory has one. A mode struck at its
    node is the same in both sets, and the quotient has no digits left: there, that the own shapes are complete,
    1 - m1 c(a)^2 = sum of squares over f, gives the integral up to its sign.
    """
    squares, own = together.frequencies[:, None] ** 2, alone.frequencies[None, :] ** 2
    product = np.multiply.outer(together.at_contact, alone.at_contact)
    alike = np.abs(own - squares) <= SAME_MODE * squares
    found = np.where(alike, 0.0, mass * squares * product / np.where(alike, 1.0, own - squares))
    if alike.any():
        x = (
            length
            * (np.arange(PLACES_PER_MODE * alone.frequencies.size) + 0.5)
            / (PLACES_PER_MODE * alone.frequencies.size)
        )
        one, other = np.nonzero(alike)
        whole = 1.0 - mass * together.at_contact**2 - np.sum(found**2, axis=1)
        if np.isfinite(alone.rigid_mass):
            whole -= (mass * together.at_contact) ** 2 / alone.rigid_mass
        sign = np.sign(np.sum(together.shapes(x)[one] * alone.shapes(x)[other], axis=1))
        found[one, other] = sign * np.sqrt(np.maximum(whole[one], 0.0))
    return found


@allocating_kernel
def _pushes(bank, turn, step, stride, q, p, forces):
    """Fills `forces` at every `stride`-th step from zero on; returns the peak, by Newton from the highest step."""
    q1, p1 = np.empty(q.size), np.empty(q.size)
    copy_to(q1, q)
    copy_to(p1, p)
    peak = dot(bank.closing, q)
    forces[0], highest, steps = peak, 0, stride * (forces.size - 1)
    for i in range(1, steps + 1):
        force = step_on(turn, bank.closing, q1, p1)[0]
        if i % stride == 0:
            forces[i // stride] = force
        if force > peak:
            peak, highest = force, i
    place, low, high = highest * step, max(highest - 1, 0) * step, min(highest + 1, steps) * step
    for _ in range(4):
        copy_to(q1, q)
        copy_to(p1, p)
        turn_by(bank, place, q1, p1)
        peak = max(peak, dot(bank.closing, q1))
        slope, bend = dot(bank.closing, p1), 0.0
        for i in range(q.size):
            bend -= bank.closing[i] * bank.frequencies[i] ** 2 * q1[i]
        if bend < 0.0:
            place = min(max(place - slope / bend, low), high)
    return peak


@kernel
def _energy(frequencies, q, p):
    total = 0.0
    for i in range(p.size):
        total += p[i] ** 2 + (frequencies[i] * q[i]) ** 2
    return 0.5 * total


@allocating_kernel
def _pressed(sets, turn, step, q, p, longest):
    """From (q, p), in place, until the faces would pull after they have pressed more than they pulled.

    Returns the duration, or -1 if it is over `longest`. A projection leaves a force that is not zero, so that a contact
    may begin with a pull; thesis 5.5 lets no contact end whose impulse is not positive.
    """
    bank, first = sets.pull, dot(sets.at, p)
    q1, p1 = np.empty(q.size), np.empty(q.size)
    pull, rate = sum_after(bank, 0.0, q, p)
    elapsed = 0.0
    while elapsed < longest:
        before, rate_before = pull, rate
        pull, rate = step_on(turn, bank.closing, q, p)
        high = rises(before, rate_before, pull, rate, step) if before < 0.0 else 0.0
        if high > 0.0:
            step_back(turn, q, p)
            into = rise_in(bank, q, p, 0.0, high, 0.0, 0.0, 0.0)
            copy_to(q1, q)
            copy_to(p1, p)
            turn_by(bank, into, q1, p1)
            if dot(sets.at, p1) < first:
                copy_to(q, q1)
                copy_to(p, p1)
                return elapsed + into
            step_on(turn, bank.closing, q, p)
        elapsed += step
    return -1.0


@inner_kernel
def _reach(sets, q, p):
    """How far the struck place can ever swing from where the beam as a whole has it."""
    reach = 0.0
    for i in range(1, q.size):
        omega = sets.gap.frequencies[i]
        if omega > 0.0:
            reach += abs(sets.gap.closing[i]) * np.hypot(q[i], p[i] / omega)
    return reach


@inner_kernel
def _flown(sets, turn, step, q, p, longest, patience):
    """From (q, p), in place, until the faces touch. Returns the duration; -1: over `longest`; -2: never.

    The projection leaves the faces a little apart or overlapping: who overlaps touches as soon as the overlap grows.
    """
    bank, modes = sets.gap, q.size
    overlap, rate = sum_after(bank, 0.0, q, p)
    if overlap >= 0.0 and rate >= 0.0:
        return 0.0
    free = modes > 1 and bank.frequencies[1] == 0.0
    reach, elapsed = _reach(sets, q, p), 0.0
    closing = p[0] + (bank.closing[1] * p[1] if free else 0.0)
    while elapsed < longest:
        if closing < 0.0:
            ahead = q[0] + (bank.closing[1] * q[1] if free else 0.0)
            if ahead < -reach or elapsed > patience:
                return -2.0
        before, rate_before = overlap, rate
        overlap, rate = step_on(turn, bank.closing, q, p)
        high = rises(before, rate_before, overlap, rate, step) if before < 0.0 else 0.0
        turned = before >= 0.0 and overlap >= 0.0 and rate >= 0.0
        if high > 0.0 or turned:
            step_back(turn, q, p)
            into = rise_in(bank, q, p, 0.0, high, 0.0, 0.0, 0.0) if high > 0.0 else _turning(bank, q, p, step)
            turn_by(bank, into, q, p)
            return elapsed + into
        elapsed += step
    return -1.0


@inner_kernel
def _turning(bank, q, p, step):
    """Where the falling sum starts to rise, by halving."""
    low, high = 0.0, step
    for _ in range(60):
        middle = 0.5 * (low + high)
        if sum_after(bank, middle, q, p)[1] >= 0.0:
            high = middle
        else:
            low = middle
    return high


@kernel
def _write(record, count, time, q, p, position, velocity, lost):
    record.start[count], record.position[count], record.velocity[count] = time, position, velocity
    record.lost[count] = lost
    copy_to(record.displacement[count], q)
    copy_to(record.rate[count], p)


@allocating_kernel
def _switch(sets, turn, own_turn, step, own_step, speed, limit, patience, record):
    """Contact and flight by turns, up to `limit` [s]. Returns the number of phases, the time reached, and if parted."""
    modes = sets.at.size
    q, p = np.zeros(modes), np.zeros(modes)
    add_to(p, sets.mass * speed, sets.at)
    flight, flight_rate = np.zeros(modes + 1), np.zeros(modes + 1)
    own_frequencies = sets.gap.frequencies[1:]
    lost = 0.5 * sets.mass * speed * speed - _energy(sets.pull.frequencies, q, p)
    _write(record, 0, 0.0, q, p, 0.0, speed, lost)
    count, time = 1, 0.0
    while True:
        elapsed = _pressed(sets, turn, step, q, p, limit - time)
        if elapsed < 0.0 or time + elapsed > limit:
            return count, limit, False
        time += elapsed
        lost += _energy(sets.pull.frequencies, q, p)
        flight[0], flight_rate[0] = dot(sets.at, q), dot(sets.at, p)
        multiply_by(flight[1:], q, sets.overlap)
        multiply_by(flight_rate[1:], p, sets.overlap)
        lost -= _energy(own_frequencies, flight[1:], flight_rate[1:]) + 0.5 * sets.mass * flight_rate[0] ** 2
        _write(record, count, time, flight[1:], flight_rate[1:], flight[0], flight_rate[0], lost)
        count += 1
        if count == record.start.size:
            return count, time, False
        elapsed = _flown(sets, own_turn, own_step, flight, flight_rate, limit - time, patience)
        if elapsed < 0.0 or time + elapsed > limit:
            return count, limit, elapsed < -1.5
        time += elapsed
        lost += _energy(own_frequencies, flight[1:], flight_rate[1:]) + 0.5 * sets.mass * flight_rate[0] ** 2
        multiply(q, sets.overlap, flight[1:])
        add_to(q, sets.mass * flight[0], sets.at)
        multiply(p, sets.overlap, flight_rate[1:])
        add_to(p, sets.mass * flight_rate[0], sets.at)
        lost -= _energy(sets.pull.frequencies, q, p)
        _write(record, count, time, q, p, flight[0], flight_rate[0], lost)
        count += 1
