"""Motions of a rod and a rigid mass that touch for a while, and the waves at the rod's struck end.

Units: round trip T = 2 L / c = 1, impact speed 1, mass of the impactor 1; the rod's mass is then `beta`, its length
1/2, its impedance 2 beta. See `rod` for how the stretches of time are found.
Source: thesis 5.3, 9.2; (5.21), (5.22), (5.27). Differs: (5.28) prints (C sin kx + D cos kx) sin wt; it is
sin kx (C sin wt + D cos wt).
"""

import numpy as np

from ..modes import Modes
from ..rods import composite_rod_modes, rod_modes
from .phases import Phases

LENGTH = 0.5  # of the rod: half a round trip at wave speed 1
SMOOTHINGS = ("delay", "lanczos", "none")


class RodPhases(Phases):
    """The `phases` of an impact on a rod, evaluated at any time; arrays of times in units of T.

    smoothing: what the contact force is. "none": the truncated series, which overshoots each jump and falls below zero
    too early (Gibbs); "lanczos": the series averaged over the shortest kept period; "delay": F = Z (v + 2 a) from the
    velocities of the mass and of the wave that arrives, which is known from the series of v a round trip ago; that
    series converges two orders faster than that of the force and needs no averaging.
    """

    def __init__(self, beta: float, fixed: bool, modes: int, smoothing: str = "delay"):
        together = composite_rod_modes(LENGTH, beta, 1.0, fixed, modes, 1.0)
        super().__init__(together, rod_modes(LENGTH, beta, 1.0, fixed, modes), 1.0)
        self.beta, self.smoothing = beta, smoothing
        self.impedance = 2.0 * beta
        self.reflection = 1.0 if fixed else -1.0
        self.overlap = overlap_integrals(self.together, self.alone, beta)

    def end_velocity(self, time: np.ndarray, after: bool = True) -> np.ndarray:
        """Of the struck end: by the series, or, if apart and the wave that arrives is known, -2 a, with its jumps."""
        velocity = self.end_motion(time, after)[1]
        if self.smoothing == "delay":
            apart = np.array([not phase.touching for phase in self.phases])[self.phase_numbers(time, after)]
            velocity[apart] = -2.0 * self.arriving(np.asarray(time, float)[apart], after)
        return velocity

    def _mean_in(self, phase, since):
        modes = self.modes_of(phase)
        slopes = modes.slopes(np.array([0.0, LENGTH]))
        mean = (slopes[:, 0] - slopes[:, 1]) / (modes.frequencies**2 * LENGTH)  # as phi'' = -omega^2 phi
        displacement, rate = self.amplitudes(phase, since)
        rigid = phase.rigid_position + phase.rigid_velocity * since
        return rigid + displacement @ mean, phase.rigid_velocity + rate @ mean

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
        """By which smoothing it may be."""
        of_cosine, of_sine = super()._series(phase)
        if self.smoothing != "lanczos":
            return of_cosine, of_sine
        soft = np.sinc(self.together.frequencies / self.together.frequencies[-1])
        return soft * of_cosine, soft * of_sine

    def _force_in(self, phase, since, after):
        if self.smoothing != "delay":
            return super()._force_in(phase, since, after)
        velocity = self._mass_in(phase, since)[1]
        return self.impedance * (velocity + 2.0 * self.arriving(phase.start + since, after))


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
