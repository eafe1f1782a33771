"""Motions of a body and a rigid mass that touch for a while: each stretch of time on the natural modes that it has.

Any units that agree with each other: `rod_phases` counts in round trips, `beam` in SI.
Source: thesis 5.3, 5.5, 9.2; (5.21), (5.22), (5.27).
"""

from typing import NamedTuple

import numpy as np

from ..modes import Modes


class Phase(NamedTuple):
    """From one change of the set of modes to the next; everything at its start, on the modes of that set."""

    touching: bool
    start: float
    displacement: np.ndarray  # (modes,)
    rate: np.ndarray  # (modes,)
    rigid_position: float  # of the free body as a whole, where it is struck; 0 if fixed
    rigid_velocity: float
    mass_position: float
    mass_velocity: float  # as it came here: a phase of contact begins with a jump to the velocity of its modes
    lost: float  # energy lost by truncation and projection up to here
    sent: float = 0.0  # displacement that has left a rod's end as a wave so far, in units of velocity times time
    arrived: float = 0.0


class Contact(NamedTuple):
    start: float
    end: float
    impulse: float  # of the force and of the change of modes that the contact begins with
    peak: float
    times: np.ndarray
    forces: np.ndarray


class Phases:
    """The `phases` of an impact, evaluated at any time (times,).

    together: modes of the body with the mass on it; alone: its own; mass: that of the impactor, m1.
    left_out: share of the energy of the mass that `together` does not hold at the first touch.
    """

    stopped = False  # before the bodies had parted for good

    def __init__(self, together: Modes, alone: Modes, mass: float):
        self.together, self.alone, self.mass = together, alone, mass
        self.fixed = not np.isfinite(alone.rigid_mass)
        self.phases: list[Phase] = []
        at = together.at_contact
        self.left_out = 1.0 - mass * (float(at @ at) + (0.0 if self.fixed else 1.0 / together.rigid_mass))

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
        """Displacement and velocity of the struck place."""
        return self._by_phase(time, after, self._end_in)

    def end_velocity(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Of the struck place."""
        return self.end_motion(time, after)[1]

    def mean_motion(self, time: np.ndarray, after: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """Displacement and velocity of the body's centre of mass."""
        return self._by_phase(time, after, self._mean_in)

    def rigid_motion(self, time: np.ndarray, after: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """The free body as a whole, where it is struck: contact modes balance their momentum by that of the mass."""
        return self._by_phase(time, after, self._rigid_in)

    def force(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Contact force."""
        time = np.asarray(time, float)
        found = np.zeros_like(time)
        numbers = self.phase_numbers(time, after)
        for number in np.unique(numbers).tolist():
            if self.phases[number].touching:
                chosen = numbers == number
                found[chosen] = self._force_in(self.phases[number], time[chosen] - self.phases[number].start, after)
        return found

    def energies(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """Of impactor, body as a whole and its vibration."""
        time = np.asarray(time, float)
        total = np.empty_like(time)
        numbers = self.phase_numbers(time)
        for number in np.unique(numbers).tolist():
            phase, chosen = self.phases[number], numbers == number
            displacement, rate = self.amplitudes(phase, time[chosen] - phase.start)
            total[chosen] = self._energy(phase, displacement, rate)
        impactor = 0.5 * self.mass * self.mass_motion(time)[1] ** 2
        rigid = np.zeros_like(time)
        if not self.fixed:
            rigid = 0.5 * self.alone.rigid_mass * self.rigid_motion(time)[1] ** 2
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
        modes = self.modes_of(phase)
        at, frequencies = modes.at_contact, modes.frequencies
        angle = np.multiply.outer(since, frequencies)
        cosine, sine = np.cos(angle), np.sin(angle)  # not `amplitudes`: their sums alone are wanted
        moved = cosine @ (at * phase.displacement) + sine @ (at * phase.rate / frequencies)
        velocity = cosine @ (at * phase.rate) - sine @ (at * phase.displacement * frequencies)
        return phase.rigid_position + phase.rigid_velocity * since + moved, phase.rigid_velocity + velocity

    def _mass_in(self, phase, since):
        if phase.touching:
            return self._end_in(phase, since)
        return phase.mass_position + phase.mass_velocity * since, np.full_like(since, phase.mass_velocity)

    def _rigid_in(self, phase, since):
        position, velocity = (
            phase.rigid_position + phase.rigid_velocity * since,
            np.full_like(since, phase.rigid_velocity),
        )
        if phase.touching:
            share = self.mass / self.alone.rigid_mass
            for whole, own in zip((position, velocity), self.amplitudes(phase, since), strict=True):
                whole -= share * (own @ self.together.at_contact)
        return position, velocity

    def _mean_in(self, phase, since):
        modes = self.modes_of(phase)
        displacement, rate = self.amplitudes(phase, since)
        position = displacement @ modes.means + modes.rigid_mean * (phase.rigid_position + phase.rigid_velocity * since)
        return position, rate @ modes.means + modes.rigid_mean * phase.rigid_velocity

    def _energy(self, phase, displacement, rate):
        modes = self.modes_of(phase)
        energy = 0.5 * np.sum(rate**2 + (modes.frequencies * displacement) ** 2, axis=-1)
        if not self.fixed:
            energy = energy + 0.5 * modes.rigid_mass * phase.rigid_velocity**2
        return energy if phase.touching else energy + 0.5 * self.mass * phase.mass_velocity**2

    def _series(self, phase):
        """Amplitudes (of cosine, of sine) of the force, one for each contact mode."""
        modes = self.together
        weights = self.mass * modes.at_contact * modes.frequencies**2
        return weights * phase.displacement, weights * phase.rate / modes.frequencies

    def _force_in(self, phase, since, after):
        of_cosine, of_sine = self._series(phase)
        angle = np.multiply.outer(since, self.together.frequencies)
        return np.cos(angle) @ of_cosine + np.sin(angle) @ of_sine
