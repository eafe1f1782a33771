"""Natural modes of rods: uniform, of several pieces, and with a mass on one end."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..jit.kernels import kernel
from .modes import Modes


@kernel
def uniform_rod(fixed, angles):
    """Write k L of the lowest modes of a uniform rod (modes,), free where it is struck and fixed or free at its other
    end; returns the sum of 1 / (k L)^2 of all modes beyond."""
    shift = 0.5 if fixed else 0.0
    for i in range(angles.size):
        angles[i] = math.pi * (i + 1.0 - shift)
    q, rest = angles.size + 1.0 - shift, 0.0  # sum of 1 / (q + i)^2, from 16 on by Euler and Maclaurin
    while q < 16.0:
        rest += 1.0 / (q * q)
        q += 1.0
    square = 1.0 / (q * q)
    series = square * (
        1.0 / 6.0 - square * (1.0 / 30.0 - square * (1.0 / 42.0 - square * (1.0 / 30.0 - square * 5.0 / 66.0)))
    )
    return (rest + (1.0 + 0.5 / q + series) / q) / (math.pi * math.pi)


def rod_modes(length: float, mass: float, wave_speed: float, fixed: bool, count: int) -> Modes:
    """Modes of a uniform rod, free where it is struck and fixed or free at the far end.

    `count` vibration modes; the rigid-body motion of a free rod comes on top.
    Source: thesis (5.2) with the end conditions of 5.3 and 9.3; residual compliance sum_{i>N} phi_i^2 / omega_i^2.
    """
    angles = np.empty(count)
    rest = uniform_rod(fixed, angles)
    wavenumbers, amplitude = angles / length, np.sqrt(2.0 / mass)
    return Modes(
        frequencies=wave_speed * wavenumbers,
        at_contact=np.full(count, amplitude),
        rigid_mass=np.inf if fixed else mass,
        residual_compliance=2.0 / mass * (length / wave_speed) ** 2 * rest,
        means=amplitude * np.sin(angles) / angles if fixed else None,
        shapes=lambda x: amplitude * np.cos(np.multiply.outer(wavenumbers, x)),
        slopes=lambda x: -amplitude * wavenumbers[:, None] * np.sin(np.multiply.outer(wavenumbers, x)),
        static_shapes=static_rod_shape(length, length**2 / (mass * wave_speed**2), fixed),
        static_slopes=static_rod_slope(length, length**2 / (mass * wave_speed**2), fixed),
    )


def rotating_rod_modes(length: float, mass: float, wave_speed: float, speed: float, count: int) -> Modes:
    """Modes along a uniform rod that turns at `speed` [rad/s] about an axis at its far end, free where it is struck.

    They are those of the rod at rest, as centrifugal force grows with displacement: omega^2 = (c k)^2 - Omega^2.
    Under a steady force F on its end it gives way by F tan(a) / a L / (E A), a = Omega L / c.
    Source: thesis (5.46)-(5.48).
    """
    still = rod_modes(length, mass, wave_speed, True, count)
    frequencies, angle = np.sqrt(still.frequencies**2 - speed**2), speed * length / wave_speed
    unit = length**2 / (mass * wave_speed**2)
    whole = unit * (np.tan(angle) / angle if angle > 0.0 else 1.0)

    def static(x: np.ndarray) -> np.ndarray:
        part = 1.0 - np.asarray(x, float) / length
        return unit * (np.sin(angle * part) / (angle * np.cos(angle)) if angle > 0.0 else part)

    def slope(x: np.ndarray) -> np.ndarray:
        part = 1.0 - np.asarray(x, float) / length
        return -unit / length * np.cos(angle * part) / np.cos(angle)

    left_out = max(float(whole - np.sum((still.at_contact / frequencies) ** 2)), 0.0)
    return replace(
        still, frequencies=frequencies, residual_compliance=left_out, static_shapes=static, static_slopes=slope
    )


def static_rod_shape(length: float, compliance: float, fixed: bool) -> Callable[[np.ndarray], np.ndarray]:
    """Displacement (x,) [m/N] of a rod of compliance L / (E A) under a steady force on its end, fixed at the other.

    Of a free rod, while the force accelerates it, less the motion of its centre of mass.
    """

    def shape(x: np.ndarray) -> np.ndarray:
        place = np.asarray(x, float) / length
        return compliance * (1.0 - place if fixed else 1.0 / 3.0 - place + 0.5 * place**2)

    return shape


def static_rod_slope(length: float, compliance: float, fixed: bool) -> Callable[[np.ndarray], np.ndarray]:
    """Slope (x,) [1/N] of that displacement."""

    def slope(x: np.ndarray) -> np.ndarray:
        place = np.asarray(x, float) / length
        return compliance / length * (0.0 * place - 1.0 if fixed else place - 1.0)

    return slope


def composite_rod_modes(
    length: float, mass: float, wave_speed: float, fixed: bool, count: int, attached_mass: float
) -> Modes:
    """Modes of a uniform rod with a rigid mass on its struck end, fixed or free at the far end.

    Normalised by the mass of both; `rigid_mass` is that of both if they are free; the residual compliance is that of
    the rod under a force on the mass, against the inertia of both if they are free.
    Source: thesis (5.11), z tan z = m2 / m1, and (9.19), with z = omega L / c.
    Differs: (9.19) prints -tan(z) / z = m2 / m1; it is m1 / m2, so that tan z = -(m1 / m2) z.
    Error: `count` of any size, as each root is found near its limit for a light mass, z = (i - 1/2) pi or i pi.
    """
    ratio = mass / attached_mass
    limits = np.pi * (np.arange(1, count + 1) - (0.5 if fixed else 0.0))
    roots = limits - np.arctan(limits / ratio)
    if fixed:
        roots[0] = np.sqrt(ratio / (1.0 + 4.0 * ratio / np.pi**2))
    for _ in range(100):  # Newton on a rising concave function: from below it never overshoots
        change = (roots - limits + np.arctan(roots / ratio)) / (1.0 + ratio / (roots**2 + ratio**2))
        roots = roots - change
        if np.all(np.abs(change) <= 4e-16 * roots):
            break
    wave, slope = (np.sin, np.cos) if fixed else (np.cos, lambda angle: -np.sin(angle))
    half = 0.5 - np.sinc(2.0 * roots / np.pi) * (0.5 if fixed else -0.5)  # mean square of the shape over the length
    amplitudes = 1.0 / np.sqrt(mass * half + attached_mass * wave(roots) ** 2)
    wavenumbers, at_contact = roots / length, amplitudes * wave(roots)
    frequencies = wave_speed * wavenumbers
    whole = length**2 / (mass * wave_speed**2)  # L / (E A)
    if not fixed:
        whole *= (mass / (mass + attached_mass)) ** 2 / 3.0
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=np.inf if fixed else mass + attached_mass,
        residual_compliance=float(max(whole - np.sum((at_contact / frequencies) ** 2), 0.0)),
        shapes=lambda x: amplitudes[:, None] * wave(np.multiply.outer(wavenumbers, length - np.asarray(x, float))),
        slopes=lambda x: (
            -(amplitudes * wavenumbers)[:, None] * slope(np.multiply.outer(wavenumbers, length - np.asarray(x, float)))
        ),
    )


def attached_rod_modes(length: float, mass: float, wave_speed: float, count: int, struck_end: bool) -> Modes:
    """A free rod in a frame fixed to one of its ends, which bends by `count` shapes of a rod clamped there.

    Frame and shapes are coupled by mass, m_i = 2 m / ((2 i - 1) pi); taken apart they are the motion of the mean, which
    no inner force changes, and as many oscillators. So the velocity of the rod as a whole is
    X' + sum 2 / ((2 i - 1) pi) q_i', (10.7), never X' alone: that of the end to which the frame is fixed.
    Error: frequencies and motion converge to those of the free rod with the third power of 1 / count; the stress at the
    end with the frame stays as large as its clamp makes it after the contact, and falls with 1 / count only.
    Source: thesis 10.2, (10.1)-(10.7). Differs: the thesis finds no quiet periods at mid-length; they are there.
    """
    from scipy.linalg import eigh

    odd = 2.0 * np.arange(1, count + 1) - 1.0
    wavenumbers = 0.5 * np.pi * odd / length
    coupling = 2.0 / (np.pi * odd)  # m_i / m
    inertia = mass * (0.5 * np.eye(count) - np.multiply.outer(coupling, coupling))  # about the mean
    squares, vectors = eigh(np.diag(0.5 * mass * (wave_speed * wavenumbers) ** 2), inertia)

    def from_frame(x):
        return np.asarray(x, float) if struck_end else length - np.asarray(x, float)

    def shapes(x):
        return vectors.T @ (np.sin(np.multiply.outer(wavenumbers, from_frame(x))) - coupling[:, None])

    def slopes(x):
        cosine = np.cos(np.multiply.outer(wavenumbers, from_frame(x)))
        return vectors.T @ ((wavenumbers if struck_end else -wavenumbers)[:, None] * cosine)

    frequencies, at_contact = np.sqrt(squares), shapes(np.zeros(1))[:, 0]
    static = static_rod_shape(length, length**2 / (mass * wave_speed**2), False)
    whole = float(static(np.array(0.0)))  # L / (3 E A), against the rod's own inertia
    return Modes(
        frequencies=frequencies,
        at_contact=at_contact,
        rigid_mass=mass,
        residual_compliance=float(max(whole - np.sum((at_contact / frequencies) ** 2), 0.0)),
        shapes=shapes,
        slopes=slopes,
        static_shapes=static,
        static_slopes=static_rod_slope(length, length**2 / (mass * wave_speed**2), False),
    )
