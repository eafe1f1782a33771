"""A chain of rods (see `network`) followed until all is over, and what its rods hold meanwhile."""

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ...jit.reference import refer
from .events import NO_PULL
from .laws import STORED
from .network import FAILED, FULL, PARTED, separate, solve
from .parts import ABSORBING, LAW, swings
from .record import (
    DEPTH,
    FORCE,
    OUT_LEFT,
    OUT_RIGHT,
    SPEED,
    TOTAL_LEFT,
    TOTAL_RIGHT,
    highest,
    pushed,
    sample_at,
    square_integral,
)

MILLIONTH = 1e-6  # of v: on a rod without end, where a force fades for ever, less is left to be
LOOKS_LATER = 1.5  # times as late, each time that something is left


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


@inner_kernel
def first_energy(chain):
    """Of rods and masses before the impact."""
    energy = 0.0
    for rod in range(chain.transit.size):
        energy += 0.5 * chain.impedance[rod] * chain.transit[rod] * chain.drift[rod] ** 2
    for node in range(chain.kind.size):
        mass = chain.mass_left[node] + chain.mass_right[node]
        energy += 0.5 * mass * chain.mass_drift[node] ** 2 if mass < np.inf else 0.0
    return energy


@inner_kernel
def _energy_left(chain, record, contact, joint, constants, slopes, t):
    """Share of the energy at first that is still in bodies, rods and contacts."""
    energy, after = 0.0, np.bool_(True)
    for rod in range(chain.transit.size):
        energy += rod_energy(chain, record, rod, t)
    for node in range(chain.kind.size):
        mass = chain.mass_left[node] + chain.mass_right[node]
        if 0.0 < mass < np.inf:
            energy += 0.5 * mass * sample_at(record, node, SPEED, t, after) ** 2
        if chain.kind[node] == LAW and sample_at(record, node, FORCE, t, after) > 0.0:
            depth = sample_at(record, node, DEPTH, t, after)
            deepest = highest(record, node, DEPTH, 0, record.count[node] - 1)
            if node == chain.contact:
                energy += contact(STORED, constants[node], depth, 0.0, deepest, slopes)
            else:
                energy += joint(STORED, constants[node], depth, 0.0, deepest, slopes)
    return energy / first_energy(chain)


@inner_kernel
def _fading(chain, masses):
    """Time by which a mass on one rod without an end has given off all its speed but a millionth."""
    slowest = np.inf
    for rod in range(chain.contact, chain.impedance.size):
        slowest = min(slowest, chain.impedance[rod])
    return 2.0 * chain.impedance.size + 14.0 * masses[-1] / slowest


@kernel
def follow(chain, record, state, work, contact, joint, of_law, until, most, tolerance):
    """Follow a chain up to `until`, or if that is infinite until the impactor has parted for good, at most to `most`.

    The others as `network.solve` takes them; of_law: (constants, remembers, loses, pulse, masses). Before a rod without
    end it is looked at now and then whether anything is left. Returns the status, and whether nothing is.
    """
    chain, record, state, work = refer(chain), refer(record), refer(state), refer(work)
    asked, masses = until < np.inf, of_law[4]
    endless = not asked and chain.kind[-1] == ABSORBING
    wait = np.inf
    if not asked:
        wait = 2.0 * np.pi / np.sqrt(swings(chain, chain.kind.size - 1)) if chain.spring > 0.0 else 0.0
        for lag in chain.transit:
            wait += 4.0 * lag
    limit = min(until, most)
    stop = min(_fading(chain, masses), limit) if endless else limit
    creep = MILLIONTH if endless else NO_PULL
    while True:
        status = solve(chain, record, state, work, contact, joint, *of_law, wait, creep, stop, tolerance)
        if not endless or status in (FULL, FAILED):
            return status, False
        if status == PARTED:  # whether no part will ever catch up with the one before it, however slowly
            for node in range(chain.kind.size):
                state.through[node] = pushed(record, node)
            return status, not separate(chain, masses, state.through, NO_PULL)
        reach = np.inf
        for node in range(chain.kind.size):
            reach = min(reach, state.time[node])
        faded = _energy_left(chain, record, contact, joint, of_law[0], work.slopes, reach) < MILLIONTH**2
        if faded or stop >= limit:
            return status, faded
        stop = min(LOOKS_LATER * stop, limit)
