"""Waves along a uniform beam that bends: what a harmonic motion is made of, and how fast it travels.

At one frequency the motion is that of two potentials, u'' = -alpha u and w'' = beta w, in both theories:
y = u' + w', psi = gamma_b w - gamma_a u, M = E I psi', V = rho A omega^2 (u + w). beta changes its sign at the cut-off,
above which the second potential travels too; as y and psi stay linear in w there, nothing is singular at the cut-off.
Source: thesis 5.5, (8.10)-(8.12); Huang (1961).
"""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel


class BeamLine(NamedTuple):
    """A uniform straight beam; the last two make the difference between the theories."""

    length: float  # [m]
    bending_stiffness: float  # E I [N m^2]
    mass_per_length: float  # rho A [kg/m]
    rotary_inertia: float = 0.0  # rho I [kg m]; 0 in Euler-Bernoulli theory
    shear_stiffness: float = np.inf  # kappa G A [N]; infinite in Euler-Bernoulli theory

    @property
    def mass(self) -> float:
        """Of the beam [kg]."""
        return self.mass_per_length * self.length

    @property
    def shear_number(self) -> float:
        """E I / (kappa G A L^2): how much more a short beam gives way by shear; 0 in Euler-Bernoulli theory."""
        return self.bending_stiffness / (self.shear_stiffness * self.length**2)

    @property
    def rotary_number(self) -> float:
        """rho I / (rho A L^2): squared radius of gyration over squared length; 0 in Euler-Bernoulli theory."""
        return self.rotary_inertia / (self.mass_per_length * self.length**2)

    @property
    def frequency_unit(self) -> float:
        """sqrt(E I / (rho A L^4)) [rad/s]; a frequency in it is the square of z = k L of the Euler-Bernoulli beam."""
        return float(np.sqrt(self.bending_stiffness / self.mass_per_length)) / self.length**2

    @property
    def cut_off(self) -> float:
        """sqrt(kappa G A / (rho I)) [rad/s], above which both waves travel; infinite in Euler-Bernoulli theory."""
        return float(np.sqrt(self.shear_stiffness / self.rotary_inertia)) if self.rotary_inertia > 0.0 else np.inf


def wave_numbers(square, shear, rotary):
    """alpha, beta, gamma_a, gamma_b at the frequency whose square is `square` in squared frequency units; length 1.

    gamma_a gamma_b = square and gamma_a + gamma_b = alpha + beta; written without differences of near numbers, except
    beta at the cut-off, where it has to vanish.
    """
    bent, turned = shear * square, rotary * square
    root = np.sqrt((bent - turned) ** 2 + 4.0 * square)
    if shear >= rotary:
        gamma_b = 0.5 * (bent - turned + root)
        gamma_a = square / gamma_b
    else:
        gamma_a = 0.5 * (turned - bent + root)
        gamma_b = square / gamma_a
    alpha = gamma_a + bent
    return alpha, (square - bent * turned) / alpha, gamma_a, gamma_b


wave_numbers_kernel = inner_kernel(wave_numbers)


def dispersion(line: BeamLine, wavenumber: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angular frequencies [rad/s] of the two waves of this wavenumber [1/m], the lower one and the upper one.

    Euler-Bernoulli: k^2 sqrt(E I / rho A), without bound in speed, and infinity. Timoshenko: the lower starts like
    that and its speed tends to sqrt(kappa G / rho); the upper starts at the cut-off and tends to sqrt(E / rho).
    """
    k = np.asarray(wavenumber, float) * line.length
    middle, _ = _middle_and_root(line, k)
    return line.frequency_unit * k**2 / np.sqrt(middle), line.frequency_unit * _upper(line, middle)


def phase_speeds(line: BeamLine, wavenumber: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """omega / k [m/s] of the lower and the upper wave; the upper is infinite where k is 0."""
    k = np.asarray(wavenumber, float) * line.length
    middle, _ = _middle_and_root(line, k)
    with np.errstate(divide="ignore"):
        upper = _upper(line, middle) / k
    return line.frequency_unit * line.length * k / np.sqrt(middle), line.frequency_unit * line.length * upper


def group_speeds(line: BeamLine, wavenumber: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """d omega / d k [m/s], at which energy travels, of the lower and the upper wave.

    Twice the phase speed in Euler-Bernoulli theory; never above sqrt(E / rho) in Timoshenko's.
    """
    k = np.asarray(wavenumber, float) * line.length
    middle, root = _middle_and_root(line, k)
    both = line.shear_number + line.rotary_number
    lower = k * (2.0 - k**2 * both / middle) * np.sqrt(middle) / root
    top = _upper(line, middle)
    upper = k * (top * both - 2.0 * k**2 / top) / root if line.rotary_number > 0.0 else top
    return line.frequency_unit * line.length * lower, line.frequency_unit * line.length * upper


def speed_limit(line: BeamLine, bar_speed: float) -> float:
    """Frequency [rad/s] from which bending waves outrun `bar_speed` = sqrt(E / rho) [m/s], the fastest of the material.

    Of an Euler-Bernoulli beam, whose phase speed grows without bound: modes above have no meaning. Infinite in
    Timoshenko theory, in which no energy travels faster.
    Source: thesis 8.4.1.
    """
    if line.rotary_number > 0.0:
        return np.inf
    return bar_speed**2 / (line.frequency_unit * line.length**2)


def _middle_and_root(line, k):
    """Of the quadratic for the squared frequencies, shear rotary square^2 - (...) square + k^4 = 0: k^4 over the lower
    one, and the root; a sum of what is positive."""
    shear, rotary, k2 = line.shear_number, line.rotary_number, k**2
    root = np.sqrt(1.0 + 2.0 * k2 * (shear + rotary) + (k2 * (shear - rotary)) ** 2)
    return 0.5 * (1.0 + k2 * (shear + rotary) + root), root


def _upper(line, middle):
    both = line.shear_number * line.rotary_number
    return np.sqrt(middle / both) if both > 0.0 else np.full_like(middle, np.inf)
