"""What the rods of a chain hold, by the waves in them."""

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from .record import OUT_LEFT, OUT_RIGHT, TOTAL_LEFT, TOTAL_RIGHT, sample_at, square_integral


@inner_kernel
def inside(chain, record, rod, t):
    """Momentum that the waves in a rod carry, (4.29)."""
    lag, after = chain.transit[rod], np.bool_(True)
    right = sample_at(record, rod, TOTAL_RIGHT, t, after) - sample_at(record, rod, TOTAL_RIGHT, t - lag, after)
    left = sample_at(record, rod + 1, TOTAL_LEFT, t, after) - sample_at(record, rod + 1, TOTAL_LEFT, t - lag, after)
    return right - left


@inner_kernel
def rod_energy(chain, record, rod, t):
    """Kinetic and strain energy of a rod, without what is fixed to its end, at a time."""
    lag, z, drift = chain.transit[rod], chain.impedance[rod], chain.drift[rod]
    held = square_integral(record, rod, OUT_RIGHT, max(t - lag, 0.0), t)
    held += square_integral(record, rod + 1, OUT_LEFT, max(t - lag, 0.0), t)
    return 0.5 * z * lag * drift**2 + drift * inside(chain, record, rod, t) + held / z


@kernel
def first_energy(chain):
    """Of rods and masses before the impact."""
    energy = 0.0
    for rod in range(chain.transit.size):
        energy += 0.5 * chain.impedance[rod] * chain.transit[rod] * chain.drift[rod] ** 2
    for node in range(chain.kind.size):
        mass = chain.mass_left[node] + chain.mass_right[node]
        energy += 0.5 * mass * chain.mass_drift[node] ** 2 if mass < np.inf else 0.0
    return energy
