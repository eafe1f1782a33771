"""A rigid mass against a rod, no local compliance: modes of both while they touch, of the rod alone while apart.

Between two changes of the set every mode moves by itself, so that nothing is stepped: only the instants of parting and
of touching again are searched for. At each change displacements and velocities are projected with the mass inner
product of the new set; its integrals have closed forms. Units, and the sources: see `rod_phases`.
"""

from collections.abc import Callable

import numpy as np

from .phases import Contact, Phase
from .rod_phases import RodPhases

# Of the shortest period kept, at which signs are looked at to find roots. With fewer, two roots within one sample are
# missed, and with them a contact; see `test_mode_switch.py`.
SAMPLES_PER_PERIOD = 16
MAX_PHASES = 400  # changes of modes; an impact of more chatters, which is said
# Of what the modes left out move the mass: a mean pull below it is none. Smaller, Gibbs' ripples end contacts falsely;
# larger, real partings are missed; see `test_mode_switch.py`.
LEAST_PULL = 0.05
SECTIONS, ROUNDS = 16, 15  # of the search for a change of sign: to 2^-60 of a sample


class SwitchedModes(RodPhases):
    """The whole impact: `solve` fills `phases` and `contacts`, and says whether the bodies `parted` for good."""

    def __init__(self, beta: float, fixed: bool, modes: int, smoothing: str = "delay"):
        super().__init__(beta, fixed, modes, smoothing)
        self.contacts: list[Contact] = []
        self.parted = False
        self._step = 1.0 / (SAMPLES_PER_PERIOD * modes)
        self._per_trip = SAMPLES_PER_PERIOD * modes
        self._turns: dict[bool, tuple[np.ndarray, np.ndarray]] = {}

    def solve(self, limit: float) -> None:
        """Follow the impact until the bodies part for good, or to `limit`."""
        at = self.together.at_contact
        rigid_velocity = 0.0 if self.fixed else 1.0 / (1.0 + self.beta)
        nothing = np.zeros_like(at)
        first = Phase(True, 0.0, nothing, at.copy(), 0.0, rigid_velocity, 0.0, 1.0, 0.0)
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
        floor = -LEAST_PULL * self.left_out * self.impedance if self.smoothing != "none" else 0.0
        ahead = SAMPLES_PER_PERIOD if self.smoothing != "none" else 0
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
                    since = _crossing(lambda t: self._force_in(phase, t, True), low, high)
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
        impulse = phase.mass_velocity - self._mass_in(phase, np.array([since]))[1][0]
        self.contacts.append(
            Contact(phase.start, phase.start + since, impulse, forces.max(), phase.start + times, forces)
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
        samples = np.arange(period * self._per_trip + SAMPLES_PER_PERIOD + 1) * self._step
        mismatch = abs(self._end_in(phase, np.zeros(1))[0][0] - phase.mass_position)
        floor = 0.0 if self.smoothing == "delay" else -mismatch
        receding = phase.mass_velocity <= phase.rigid_velocity
        begin = 0.0
        while phase.start + begin < limit:
            gap = self._gap(phase, begin + samples)
            mean = np.convolve(gap, np.ones(SAMPLES_PER_PERIOD) / SAMPLES_PER_PERIOD, "valid")[
                : period * self._per_trip
            ]
            closed = np.flatnonzero((gap[: mean.size] < 0.0) & (mean <= floor))
            closed = closed[closed > 0] if begin == 0.0 else closed
            if closed.size:
                high = float(begin + samples[closed[0]])
                low = max(high - self._step, 0.0)
                return phase.start + _crossing(lambda t: self._gap(phase, t), low, high)
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
            position, velocity, phase.lost, sent, arrived,
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
            phase.lost, phase.sent - (arrived - phase.arrived), arrived,
        )  # fmt: skip
        # where the mass is by its series, so that the waves sent start without a jump
        new = new._replace(mass_position=float(self._end_in(new, np.zeros(1))[0][0]))
        return self._with_loss(new, self._energy(phase, displacement, rate))

    def _with_loss(self, phase: Phase, before: float) -> Phase:
        return phase._replace(lost=phase.lost + float(before - self._energy(phase, phase.displacement, phase.rate)))


def _mean_ahead(force: np.ndarray, following: np.ndarray, samples: int) -> np.ndarray:
    """Mean over the next `samples` steps from each sample of one round trip, given the one that follows."""
    if samples == 0:
        return force
    both = np.concatenate((0.5 * (force[1:] + force[:-1]), 0.5 * (following[1:] + following[:-1])))
    total = np.concatenate(([0.0], np.cumsum(both)))
    return (total[samples : samples + force.size] - total[: force.size]) / samples


def _crossing(values: Callable[[np.ndarray], np.ndarray], low: float, high: float) -> float:
    """Where a function that is positive at `low` and negative at `high` first changes sign, be it by a jump.

    By SECTIONS parts at a time, as the function takes many instants in hardly more time than one.
    """
    for _ in range(ROUNDS):
        inside = low + (high - low) * np.arange(1, SECTIONS) / SECTIONS
        inside = inside[(inside > low) & (inside < high)]
        if not inside.size:
            break
        negative = np.flatnonzero(values(inside) < 0.0)
        first = negative[0] if negative.size else inside.size
        edges = [low, *inside.tolist(), high]
        low, high = edges[first], edges[first + 1]
    return high
