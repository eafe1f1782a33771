"""Figures of the impact of a rigid mass on a uniform rod, from the exact waves: of one impact, or of very many."""

import numpy as np

from ...jit.kernels import kernel
from . import rigid as rigid_waves

# what `figures` gives, in this order
IMPULSE, TARGET, COMPRESSING, ROD = range(4)
FIGURES = 4
# and what `strike_all` gives besides
CONTACTS, PARTING, FINAL, FACE, PEAK, TOUCHING, FOLLOWED = range(FIGURES, FIGURES + 7)
COLUMNS = FIGURES + 7


@kernel
def figures(t, beta, reflection, start, coefficients, degrees, integral, contacts, out):
    """Write what is not in the table of contacts, at time t: impulse, in units of Z v T; velocity of the centre of
    mass of the rod; impulse up to the end of compression, NaN if that never comes; energy of the rod, in Z v v T.

    Source: thesis 4.6, (4.29), (4.38), (4.41).
    """
    kappa = 2.0 * beta
    for k in range(3):
        out[k] = rigid_waves.total_at(t - 0.5 * k, kappa, start, coefficients, degrees, integral)
    now, half, whole = out[0], out[1], out[2]
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
                velocity, sign = 0.0, 1.0
                for k in range(2):  # of the struck end: a loop, as each call is compiled into it anew
                    velocity += sign * rigid_waves.wave_at(
                        middle - k, np.bool_(False), kappa, start, coefficients, degrees
                    )
                    sign = -reflection
                if velocity <= common:
                    high = middle
                else:
                    low = middle
            out[COMPRESSING], sign = 0.0, 1.0
            for k in range(2):
                out[COMPRESSING] += sign * rigid_waves.total_at(high - k, kappa, start, coefficients, degrees, integral)
                sign = reflection
            break


@kernel
def strike_all(beta, reflection, afterglow, sent, out):
    """Write the figures of every impact, followed until the bodies part for good, `afterglow` round trips after that.

    beta, reflection (impacts,); sent: room for one of them; out (impacts, COLUMNS): those of `figures`, the number of
    contacts, the time T of the last parting, velocity of the mass after it and of the struck face just after it in the
    impact speed, peak stress, the time T in contact, and 1 if the impact was followed to its end within so much room,
    else 0.
    """
    for i in range(beta.size):
        status, pieces, count = rigid_waves.strike(beta[i], reflection[i], rigid_waves.FOREVER, sent)
        out[i, FOLLOWED] = 1.0 if status == rigid_waves.PARTED else 0.0
        if status != rigid_waves.PARTED:
            continue
        contacts, last = sent.contacts[:count], sent.contacts[count - 1]
        start, coefficients, degrees = sent.start[: pieces + 1], sent.coefficients[:pieces], sent.degrees[:pieces]
        end, integral = last[1] + afterglow, sent.integral[: pieces + 1]
        figures(end, beta[i], reflection[i], start, coefficients, degrees, integral, contacts, out[i])
        out[i, CONTACTS], out[i, PARTING], out[i, FINAL], out[i, FACE] = count, last[1], last[3], last[6]
        out[i, PEAK], out[i, TOUCHING] = 0.0, 0.0
        for n in range(count):
            out[i, TOUCHING] += contacts[n, 1] - contacts[n, 0]
            out[i, PEAK] = max(out[i, PEAK], contacts[n, 4])
