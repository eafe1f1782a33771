"""Figures of the blow of a rigid mass on a uniform rod, from the exact waves: of one blow, or of very many."""

import numpy as np

from ...jit import allocating_kernel, kernel
from . import rigid as rigid_waves

# what `figures` gives, in this order
IMPULSE, TARGET, COMPRESSING, ROD = range(4)
FIGURES = 4
# and what `strike_all` gives besides
CONTACTS, PARTING, FINAL, FACE, PEAK, FOLLOWED = range(FIGURES, FIGURES + 6)
COLUMNS = FIGURES + 6


@kernel
def figures(t, beta, reflection, start, coefficients, degrees, integral, contacts, out):
    """Write what is not in the table of contacts, at time t: impulse, in units of Z v T; velocity of the centre of
    mass of the rod; impulse up to the end of compression, NaN if that never comes; energy of the rod, in Z v v T.

    Source: thesis 4.6, (4.29), (4.38), (4.41).
    """
    kappa = 2.0 * beta
    now, half, whole = (
        rigid_waves.total_at(t, kappa, start, coefficients, degrees, integral),
        rigid_waves.total_at(t - 0.5, kappa, start, coefficients, degrees, integral),
        rigid_waves.total_at(t - 1.0, kappa, start, coefficients, degrees, integral),
    )
    out[IMPULSE] = now + reflection * whole
    out[TARGET] = 2.0 * ((now - half) - reflection * (half - whole))
    out[ROD] = rigid_waves.stored_energy(max(0.0, t - 1.0), t, kappa, start, coefficients, degrees)
    common = 0.0 if reflection > 0.0 else 1.0 / (1.0 + beta)
    out[COMPRESSING] = np.nan
    for n in range(contacts.shape[0]):
        if contacts[n, 3] <= common:  # the velocity of the mass only falls
            low, high = contacts[n, 0], contacts[n, 1]
            while True:
                middle = 0.5 * (low + high)
                if middle <= low or middle >= high:
                    break
                sent = rigid_waves.wave_at(middle, False, kappa, start, coefficients, degrees)
                arriving = reflection * rigid_waves.wave_at(middle - 1.0, False, kappa, start, coefficients, degrees)
                if sent - arriving <= common:
                    high = middle
                else:
                    low = middle
            out[COMPRESSING] = rigid_waves.total_at(
                high, kappa, start, coefficients, degrees, integral
            ) + reflection * rigid_waves.total_at(high - 1.0, kappa, start, coefficients, degrees, integral)
            break


@allocating_kernel
def strike_all(beta, reflection, afterglow, pieces, terms, out):
    """Write the figures of every blow, followed until the bodies part for good, at `afterglow` round trips after that.

    beta, reflection (blows,); out (blows, COLUMNS): those of `figures`, the number of contacts, the time T of the last
    parting, velocity of the mass after it and of the struck face just after it in the impact speed, peak stress, and 1
    if the blow was followed to its end within so many `pieces` and `terms` of them, else 0.
    """
    for i in range(beta.size):
        found = rigid_waves.strike(beta[i], reflection[i], rigid_waves.FOREVER, pieces, terms, pieces)
        status, contacts = found[0], found[6]
        last = contacts[contacts.shape[0] - 1]
        out[i, FOLLOWED] = 1.0 if status == rigid_waves.PARTED else 0.0
        if status != rigid_waves.PARTED:
            continue
        figures(last[1] + afterglow, beta[i], reflection[i], found[2], found[3], found[4], found[5], contacts, out[i])
        out[i, CONTACTS], out[i, PARTING], out[i, FINAL], out[i, FACE] = contacts.shape[0], last[1], last[3], last[6]
        out[i, PEAK] = 0.0
        for n in range(contacts.shape[0]):
            out[i, PEAK] = max(out[i, PEAK], contacts[n, 4])
