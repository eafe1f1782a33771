"""Motions of a rod and a rigid mass that touch for a while: each stretch of time on the natural modes that it has.

Units: round trip T = 2 L / c = 1, impact speed 1, mass of the impactor 1; the rod's mass is then `beta`, its length
1/2, its impedance 2 beta. See `mode_switch` for how the stretches are found.
Source: thesis 5.3, 9.2; (5.21), (5.22), (5.27). Differs: (5.28) prints (C sin kx + D cos kx) sin wt; it is
sin kx (C sin wt + D cos wt).
"""

from typing import NamedTuple

import numpy as np

from .modes import Modes, composite_rod_modes, rod_modes

LENGTH = 0.5  # of the rod: half a round trip at wave speed 1
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


class Phases:
    """The `phases` of a blow, evaluated at any time; arrays of times in units of T.

    smoothing: what the contact force is. "none": the truncated series, which overshoots each jump and falls below zero
    too early (Gibbs); "lanczos": the series averaged over the shortest kept period; "delay": F = Z (v + 2 a) from the
    velocities of the mass and of the wave that arrives, which is known from the series of v a round trip ago; that
    series converges two orders faster than that of the force and needs no averaging.
    """

    def __init__(self, beta: float, fixed: bool, modes: int, smoothing: str = "delay"):
        self.beta, self.fixed, self.smoothing = beta, fixed, smoothing
        self.impedance = 2.0 * beta
        self.reflection = 1.0 if fixed else -1.0
        self.together = composite_rod_modes(LENGTH, beta, 1.0, fixed, modes, 1.0)
        self.alone = rod_modes(LENGTH, beta, 1.0, fixed, modes)
        self.overlap = overlap_integrals(self.together, self.alone, beta)
        self.phases: list[Phase] = []
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


def overlap_integrals(together: Modes, alone: Modes, beta: float) -> np.ndarray:
    """Integrals over the rod of density times a shape of both bodies times one of the rod, (together, alone).

    By parts, from phi'' = -k^2 phi and what holds at the ends: -m1 k^2 phi(0) psi(0) / (k^2 - kappa^2). The difference
    of wavenumbers is (i - j) pi - arctan(z / beta) in z = k L, which keeps its digits for a light mass.
    """
    roots = LENGTH * together.frequencies
    number = np.arange(roots.size)
    difference = np.pi * np.subtract.outer(number, number) - np.arctan(roots / beta)[:, None]
    total = np.add.outer(roots, LENGTH * alone.frequencies)
    return -np.multiply.outer(roots**2 * together.at_contact, alone.at_contact) / (difference * total)
