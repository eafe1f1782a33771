"""A rigid mass against a rod, no local compliance: modes of both while they touch, of the rod alone while apart.

Between two changes of the set every mode moves by itself, so that nothing is stepped: only the instants of parting and
of touching again are searched for. Units: round trip T = 2 L / c = 1, impact speed 1, mass of the impactor 1; the rod's
mass is then `beta`, its length 1/2, its impedance 2 beta.

At each change displacements and velocities are projected with the mass inner product of the new set; its integrals have
closed forms, as shapes of both sets obey phi'' = -k^2 phi.
Source: thesis 5.3, 9.2; (5.21), (5.22), (5.27). Differs: (5.28) prints (C sin kx + D cos kx) sin wt; it is
sin kx (C sin wt + D cos wt).
"""

from typing import NamedTuple

import numpy as np

from .modes import Modes, composite_rod_modes, rod_modes

LENGTH = 0.5  # of the rod: half a round trip at wave speed 1
SAMPLES = 16  # of each shortest period, where roots are searched for
MAX_PHASES = 400
RESOLVED = 0.05  # of what the modes left out move the mass: a mean pull below it is none

SMOOTHINGS = ("delay", "lanczos", "none")


class Phase(NamedTuple):
    """From one change of the set of modes to the next; everything at its start, on the modes of that set."""

    touching: bool
    start: float
    displacement: np.ndarray  # (modes,)
    rate: np.ndarray  # (modes,)
    rigid_position: float  # of the free body's mean; 0 if fixed
    rigid_velocity: float
    mass_position: float
    mass_velocity: float
    sent: float  # displacement that has left the struck end as a wave so far, in units of velocity times time
    arrived: float
    lost: float  # energy lost by truncation and projection up to here


class Contact(NamedTuple):
    start: float
    end: float
    impulse: float
    peak: float
    times: np.ndarray
    forces: np.ndarray


class SwitchedModes:
    """The whole blow. `solve` fills `phases` and `contacts`; the rest evaluates them at any time.

    smoothing: which contact force tells when the bodies part. "none": the truncated series, which falls below zero too
    early (Gibbs); "lanczos": the series averaged over the shortest kept period; "delay": F = Z (v + 2 a), impedance,
    velocity of the mass and of the wave that arrives, known from the series of v a round trip ago; that one converges
    two orders faster than the series of the force and needs no averaging.
    """

    def __init__(self, beta: float, fixed: bool, modes: int, smoothing: str = "delay"):
        self.beta, self.fixed, self.smoothing = beta, fixed, smoothing
        self.impedance = 2.0 * beta
        self.reflection = 1.0 if fixed else -1.0
        self.together = composite_rod_modes(LENGTH, beta, 1.0, fixed, modes, 1.0)
        self.alone = rod_modes(LENGTH, beta, 1.0, fixed, modes)
        self.overlap = _overlap(self.together, self.alone, beta)
        self.phases: list[Phase] = []
        self.contacts: list[Contact] = []
        self.parted = False
        self._step = 1.0 / (SAMPLES * modes)
        self._per_trip = SAMPLES * modes
        self._turns: dict[bool, tuple[np.ndarray, np.ndarray]] = {}
        at = self.together.at_contact
        self.left_out = 1.0 - float(at @ at) - (0.0 if fixed else 1.0 / (1.0 + beta))

    # -- evaluation ---------------------------------------------------------------------------------------------------

    def modes_of(self, phase: Phase) -> Modes:
        return self.together if phase.touching else self.alone

    def phase_numbers(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        starts = np.array([phase.start for phase in self.phases])
        return np.clip(np.searchsorted(starts, time, "right" if after else "left") - 1, 0, len(self.phases) - 1)

    def amplitudes(self, phase: Phase, since: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Modal displacements and rates (time, modes), `since` the start of the phase."""
        frequencies = self.modes_of(phase).frequencies
        angle = np.multiply.outer(since, frequencies)
        cosine, sine = np.cos(angle), np.sin(angle)
        return (
            cosine * phase.displacement + sine * (phase.rate / frequencies),
            cosine * phase.rate - sine * (phase.displacement * frequencies),
        )

    def mass_motion(self, time: np.ndarray, after: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """Position and velocity of the impactor."""
        return self._by_phase(time, after, self._mass_in)

    def end_motion(self, time: np.ndarray, after: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """Displacement and velocity of the struck end."""
        return self._by_phase(time, after, self._end_in)

    def end_velocity(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Of the struck end: by the series, or, if apart and the wave that arrives is known, -2 a, with its jumps."""
        velocity = self.end_motion(time, after)[1]
        if self.smoothing == "delay":
            apart = np.array([not phase.touching for phase in self.phases])[self.phase_numbers(time, after)]
            velocity[apart] = -2.0 * self.arriving(np.asarray(time, float)[apart], after)
        return velocity

    def mean_motion(self, time: np.ndarray, after: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """Mean displacement and velocity of the rod; the velocity is (4.29)."""
        return self._by_phase(time, after, self._mean_in)

    def force(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Contact force in units of m1 v / T."""
        time = np.asarray(time, float)
        found = np.zeros_like(time)
        numbers = self.phase_numbers(time, after)
        for number in np.unique(numbers).tolist():
            if self.phases[number].touching:
                chosen = numbers == number
                found[chosen] = self._force_in(self.phases[number], time[chosen] - self.phases[number].start, after)
        return found

    def energies(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """Of impactor, rod as a whole and rod's vibration, in units of m1 v^2."""
        time = np.asarray(time, float)
        total = np.empty_like(time)
        numbers = self.phase_numbers(time)
        for number in np.unique(numbers).tolist():
            phase, chosen = self.phases[number], numbers == number
            displacement, rate = self.amplitudes(phase, time[chosen] - phase.start)
            total[chosen] = self._energy(phase, displacement, rate)
        impactor = 0.5 * self.mass_motion(time)[1] ** 2
        rigid = np.zeros_like(time) if self.fixed else 0.5 * self.beta * self.mean_motion(time)[1] ** 2
        return {"impactor": impactor, "target_rigid": rigid, "target_vibration": total - impactor - rigid}

    def _by_phase(self, time, after, motion):
        time = np.asarray(time, float)
        position, velocity = np.empty_like(time), np.empty_like(time)
        numbers = self.phase_numbers(time, after)
        for number in np.unique(numbers).tolist():
            chosen = numbers == number
            phase = self.phases[number]
            position[chosen], velocity[chosen] = motion(phase, time[chosen] - phase.start)
        return position, velocity

    def _end_in(self, phase, since):
        displacement, rate = self.amplitudes(phase, since)
        at = self.modes_of(phase).at_contact
        return phase.rigid_position + phase.rigid_velocity * since + displacement @ at, phase.rigid_velocity + rate @ at

    def _mass_in(self, phase, since):
        if phase.touching:
            return self._end_in(phase, since)
        return phase.mass_position + phase.mass_velocity * since, np.full_like(since, phase.mass_velocity)

    def _mean_in(self, phase, since):
        modes = self.modes_of(phase)
        slopes = modes.slopes(np.array([0.0, LENGTH]))
        mean = (slopes[:, 0] - slopes[:, 1]) / (modes.frequencies**2 * LENGTH)  # as phi'' = -omega^2 phi
        displacement, rate = self.amplitudes(phase, since)
        rigid = phase.rigid_position + phase.rigid_velocity * since
        return rigid + displacement @ mean, phase.rigid_velocity + rate @ mean

    def _energy(self, phase, displacement, rate):
        modes = self.modes_of(phase)
        energy = 0.5 * np.sum(rate**2 + (modes.frequencies * displacement) ** 2, axis=-1)
        if not self.fixed:
            energy = energy + 0.5 * modes.rigid_mass * phase.rigid_velocity**2
        return energy if phase.touching else energy + 0.5 * phase.mass_velocity**2

    # -- waves at the struck end, from the motion of the mass ---------------------------------------------------------

    def sent_wave(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Velocity of the wave that leaves the struck end: v + a while touching, -a while apart; a arrives."""
        return self._recur(time, after, self._mass_velocity_or_none)

    def arriving(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Velocity of the wave that arrives at the struck end: what left it a round trip ago."""
        return self.reflection * self.sent_wave(np.asarray(time, float) - 1.0, after)

    def arrived(self, time: np.ndarray) -> np.ndarray:
        """Integral of `arriving` from the first touch."""
        return self.reflection * self._recur(np.asarray(time, float) - 1.0, True, self._sent_in)

    def _recur(self, time, after, leaving):
        """Follow what leaves the struck end back through all round trips, the oldest first."""
        time = np.asarray(time, float)
        sent = np.zeros_like(time)
        for trips in range(int(np.floor(np.max(time, initial=-1.0))), -1, -1):
            earlier = time - trips
            begun = earlier > 0.0 if not after else earlier >= 0.0
            arriving, sent = self.reflection * sent[begun], np.zeros_like(time)
            sent[begun] = leaving(earlier[begun], arriving, after)
        return sent

    def _mass_velocity_or_none(self, time, arriving, after):
        leaving = -arriving
        numbers = self.phase_numbers(time, after)
        for number in np.unique(numbers).tolist():
            phase, chosen = self.phases[number], numbers == number
            if phase.touching:
                leaving[chosen] = self._mass_in(phase, time[chosen] - phase.start)[1] + arriving[chosen]
        return leaving

    def _sent_in(self, time, arrived, after):
        sent = np.empty_like(time)
        numbers = self.phase_numbers(time, after)
        for number in np.unique(numbers).tolist():
            phase, chosen = self.phases[number], numbers == number
            more = arrived[chosen] - phase.arrived
            if phase.touching:
                moved = self._mass_in(phase, time[chosen] - phase.start)[0] - phase.mass_position
                sent[chosen] = phase.sent + moved + more
            else:
                sent[chosen] = phase.sent - more
        return sent

    # -- the course of events -----------------------------------------------------------------------------------------

    def solve(self, limit: float) -> None:
        """Follow the blow until the bodies part for good, or to `limit`."""
        at = self.together.at_contact
        rigid_velocity = 0.0 if self.fixed else 1.0 / (1.0 + self.beta)
        nothing = np.zeros_like(at)
        first = Phase(True, 0.0, nothing, at.copy(), 0.0, rigid_velocity, 0.0, 1.0, 0.0, 0.0, 0.0)
        self.phases.append(first._replace(lost=0.5 - float(self._energy(first, nothing, at))))
        while len(self.phases) < MAX_PHASES:
            end = self._parting(self.phases[-1], limit)
            if end >= limit:
                return
            self.phases.append(self._released(self.phases[-1], end))
            start = self._touching_again(self.phases[-1], limit)
            if start is None:
                self.parted = True
                return
            if start >= limit:
                return
            self.phases.append(self._caught(self.phases[-1], start))

    def _windows(self, phase, number, amplitudes):
        """Sum of the two amplitudes (modes,) turned through the samples of one round trip, the `number`-th."""
        frequencies = self.modes_of(phase).frequencies
        if phase.touching not in self._turns:
            angle = np.multiply.outer(np.arange(self._per_trip + 1) * self._step, frequencies)
            self._turns[phase.touching] = np.cos(angle), np.sin(angle)
        cosine, sine = self._turns[phase.touching]
        c, s = np.cos(number * frequencies), np.sin(number * frequencies)
        of_cosine, of_sine = amplitudes
        return cosine @ (c * of_cosine + s * of_sine) + sine @ (c * of_sine - s * of_cosine)

    def _series(self, phase):
        """Amplitudes (of cosine, of sine) of the force, by which smoothing it may be."""
        modes = self.together
        weights = modes.at_contact * modes.frequencies**2
        if self.smoothing == "lanczos":
            weights = weights * np.sinc(modes.frequencies / modes.frequencies[-1])
        return weights * phase.displacement, weights * phase.rate / modes.frequencies

    def _force_in(self, phase, since, after):
        if self.smoothing == "delay":
            velocity = self._mass_in(phase, since)[1]
            return self.impedance * (velocity + 2.0 * self.arriving(phase.start + since, after))
        of_cosine, of_sine = self._series(phase)
        angle = np.multiply.outer(since, self.together.frequencies)
        return np.cos(angle) @ of_cosine + np.sin(angle) @ of_sine

    def _sampled_force(self, phase):
        """Force on the samples of one round trip after the other; at both ends of each the value inside it."""
        if self.smoothing != "delay":
            number = 0
            while True:
                yield self._windows(phase, number, self._series(phase))
                number += 1
        at, frequencies = self.together.at_contact, self.together.frequencies
        amplitudes = at * phase.rate, -at * frequencies * phase.displacement
        samples = phase.start + np.arange(self._per_trip + 1) * self._step
        arriving = self.arriving(samples)
        arriving[-1:] = self.arriving(samples[-1:], after=False)
        number = 0
        while True:
            velocity = phase.rigid_velocity + self._windows(phase, number, amplitudes)
            yield self.impedance * (velocity + 2.0 * arriving)
            arriving = self.reflection * (velocity + arriving)
            number += 1

    def _parting(self, phase: Phase, limit: float) -> float:
        """When the contact force falls below zero, and stays there in the mean over the shortest kept period.

        Records the contact up to there, or to `limit`.
        """
        floor = -RESOLVED * self.left_out * self.impedance if self.smoothing != "none" else 0.0
        ahead = SAMPLES if self.smoothing != "none" else 0
        sampled = self._sampled_force(phase)
        force, times, forces, number = next(sampled), [], [], 0
        while True:
            following = next(sampled)
            mean = _mean_ahead(force, following, ahead)
            below = np.flatnonzero((force < 0.0) & (mean <= floor))
            below = below[below > 0] if number == 0 else below
            times.append(number + np.arange(force.size) * self._step)
            forces.append(force)
            if below.size:
                since = number + below[0] * self._step
                if below[0]:
                    low, high = since - self._step, since
                    since = _bisect(lambda t: self._force_in(phase, np.array([t]), True)[0], low, high)
                break
            if phase.start + number + 1.0 >= limit:
                since = np.inf
                break
            force = following
            number += 1
        since = min(since, limit - phase.start)
        times, forces = np.concatenate(times), np.concatenate(forces)
        kept = times < since
        times, forces = np.append(times[kept], since), np.append(forces[kept], max(forces[kept][-1], 0.0))
        before, after = (self._mass_in(phase, np.array([t]))[1][0] for t in (0.0, since))
        self.contacts.append(
            Contact(phase.start, phase.start + since, before - after, forces.max(), phase.start + times, forces)
        )
        return phase.start + since

    def _gap(self, phase: Phase, since: np.ndarray) -> np.ndarray:
        """From the mass to the struck end, counted from the parting, where both series differ a little."""
        if self.smoothing == "delay":
            more = self.arrived(phase.start + since) - phase.arrived
            return -(phase.mass_velocity * since + 2.0 * more)
        end = self._end_in(phase, since)[0] - self._end_in(phase, np.zeros(1))[0]
        return end - phase.mass_velocity * since

    def _touching_again(self, phase: Phase, limit: float) -> float | None:
        """When the gap closes; None if one period of the free rod has passed and the mass does not come closer."""
        period = 2 if self.fixed else 1
        samples = np.arange(period * self._per_trip + SAMPLES + 1) * self._step
        mismatch = abs(self._end_in(phase, np.zeros(1))[0][0] - phase.mass_position)
        floor = 0.0 if self.smoothing == "delay" else -mismatch
        receding = phase.mass_velocity <= phase.rigid_velocity
        begin = 0.0
        while phase.start + begin < limit:
            gap = self._gap(phase, begin + samples)
            mean = np.convolve(gap, np.ones(SAMPLES) / SAMPLES, "valid")[: period * self._per_trip]
            closed = np.flatnonzero((gap[: mean.size] < 0.0) & (mean <= floor))
            closed = closed[closed > 0] if begin == 0.0 else closed
            if closed.size:
                high = begin + samples[closed[0]]
                low = max(high - self._step, 0.0)
                return phase.start + _bisect(lambda t: self._gap(phase, np.array([t]))[0], low, high)
            if receding:
                return None
            begin += period
        return limit

    def _released(self, phase: Phase, time: float) -> Phase:
        """The rod's own modes, from what the modes of both hold at `time`; the mass flies on by itself."""
        since = np.array([time - phase.start])
        (displacement,), (rate,) = self.amplitudes(phase, since)
        at = self.together.at_contact
        (position,), (velocity,) = self._mass_in(phase, since)
        rigid_position = phase.rigid_position + phase.rigid_velocity * since[0]
        rigid_velocity = phase.rigid_velocity
        if not self.fixed:  # the composite's shapes have momentum in the rod, against that of the mass
            rigid_position -= (displacement @ at) / self.beta
            rigid_velocity -= (rate @ at) / self.beta
        arrived = float(self.arrived(np.array([time]))[0])
        sent = phase.sent + position - phase.mass_position + arrived - phase.arrived
        new = Phase(
            False, time, displacement @ self.overlap, rate @ self.overlap, rigid_position, rigid_velocity,
            position, velocity, sent, arrived, phase.lost,
        )  # fmt: skip
        return self._with_loss(new, self._energy(phase, displacement, rate))

    def _caught(self, phase: Phase, time: float) -> Phase:
        """The modes of both, from those of the rod and the mass that touches it at `time`."""
        since = np.array([time - phase.start])
        (displacement,), (rate,) = self.amplitudes(phase, since)
        at = self.together.at_contact
        position = phase.mass_position + phase.mass_velocity * since[0]
        velocity = phase.mass_velocity
        rod_position = phase.rigid_position + phase.rigid_velocity * since[0]
        rigid_position = rigid_velocity = 0.0
        if not self.fixed:
            rigid_position = (position + self.beta * rod_position) / (1.0 + self.beta)
            rigid_velocity = (velocity + self.beta * phase.rigid_velocity) / (1.0 + self.beta)
        arrived = float(self.arrived(np.array([time]))[0])
        new = Phase(
            True, time,
            self.overlap @ displacement + at * (position - rod_position),
            self.overlap @ rate + at * (velocity - phase.rigid_velocity),
            rigid_position, rigid_velocity, position, velocity,
            phase.sent - (arrived - phase.arrived), arrived, phase.lost,
        )  # fmt: skip
        # where the mass is by its series, so that the waves sent start without a jump
        new = new._replace(mass_position=float(self._end_in(new, np.zeros(1))[0][0]))
        return self._with_loss(new, self._energy(phase, displacement, rate))

    def _with_loss(self, phase: Phase, before: float) -> Phase:
        return phase._replace(lost=phase.lost + float(before - self._energy(phase, phase.displacement, phase.rate)))


def _overlap(together: Modes, alone: Modes, beta: float) -> np.ndarray:
    """Integrals over the rod of density times a shape of both bodies times one of the rod, (together, alone).

    By parts, from phi'' = -k^2 phi and what holds at the ends: -m1 k^2 phi(0) psi(0) / (k^2 - kappa^2). The difference
    of wavenumbers is (i - j) pi - arctan(z / beta) in z = k L, which keeps its digits for a light mass.
    """
    roots = LENGTH * together.frequencies
    number = np.arange(roots.size)
    difference = np.pi * np.subtract.outer(number, number) - np.arctan(roots / beta)[:, None]
    total = np.add.outer(roots, LENGTH * alone.frequencies)
    return -np.multiply.outer(roots**2 * together.at_contact, alone.at_contact) / (difference * total)


def _mean_ahead(force: np.ndarray, following: np.ndarray, samples: int) -> np.ndarray:
    """Mean over the next `samples` steps from each sample of one round trip, given the one that follows."""
    if samples == 0:
        return force
    both = np.concatenate((0.5 * (force[1:] + force[:-1]), 0.5 * (following[1:] + following[:-1])))
    total = np.concatenate(([0.0], np.cumsum(both)))
    return (total[samples : samples + force.size] - total[: force.size]) / samples


def _bisect(value, low: float, high: float) -> float:
    """Where a function that is positive at `low` and negative at `high` changes sign, be it by a jump."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        low, high = (low, middle) if value(middle) < 0.0 else (middle, high)
    return high
