"""When two bodies have parted for good: one rule for every method.

Apart, each body moves on as a whole and rings. With E the energy of its ringing and C the static compliance of its
struck face, against its inertia if nothing holds it, that face never comes further than

    |u| <= sqrt(2 E C)

from where the motion as a whole has it: modes of amplitudes a_i there and compliances c_i, which add up to C, hold the
energies a_i^2 / (2 c_i). So bodies that move apart as wholes never touch again once they are further apart than both
faces reach. Until then they are watched, for WATCHED_PERIODS of the slowest that swings at most; they might still touch
later, which is said. What moves alike in every period, a uniform rod that a mass has struck, is watched for one.

Where the joints of a body can open, its parts are bodies of their own; or else what strikes leaves faster than its
first part can ever come after it, with all energy and momentum that the body has.

The slowest period of rods one behind the other is no longer than Dunkerley has it,

    1 / w_1^2 <= sum over all modes of 1 / w_i^2 = integral of m(s) (1 - m(s) / M) ds / (E A),

m(s) being the mass between the struck end and s, M all of it, infinite where the far end is held.
"""

import numpy as np

from ..jit.kernels import kernel

# Slowest periods for which bodies that move apart slowly are watched for another touch. Fewer, and a late one is
# missed; more cost time only.
WATCHED_PERIODS = 20.0


@kernel
def reach(energy, compliance):
    """How far a face may come from where the motion of its body as a whole has it."""
    return np.sqrt(2.0 * max(energy, 0.0) * compliance)


@kernel
def backwards(energy, momentum, part, whole):
    """How fast a part of a body, of mass `part` of `whole`, can come back at most while all of it has this energy and
    momentum, and the energy that is left beside its motion as a whole. `whole` is infinite where it is held.
    """
    if whole == np.inf:
        return np.sqrt(2.0 * max(energy, 0.0) / part), energy
    speed = momentum / whole
    free = max(energy - 0.5 * whole * speed**2, 0.0)
    return np.sqrt(2.0 * free * max(whole - part, 0.0) / (whole * part)) - speed, free


@kernel
def swing_and_give(impedance, transit, near, far):
    """Longest period that rods one behind the other can have, and the compliances of their first and last faces.

    impedance, transit (rods,): rho c A and the time that a wave takes; near, far: rigid masses on both ends, `far`
    infinite where the last end is held. Any consistent units.
    """
    whole, behind = near + far, far
    for i in range(transit.size):
        whole += impedance[i] * transit[i]
        behind += impedance[i] * transit[i]
    square, first, last, before = 0.0, 0.0, 0.0, near
    for i in range(transit.size):
        mass, soft = impedance[i] * transit[i], transit[i] / impedance[i]
        if whole == np.inf:
            square += soft * (before + 0.5 * mass)
            first += soft
        else:  # means over the rod of the product of the masses on both sides of a place, and of their squares
            behind = max(behind - mass, 0.0)
            square += soft * (before * behind + 0.5 * mass * (before + behind) + mass * mass / 6.0) / whole
            first += soft * (behind * behind + behind * mass + mass * mass / 3.0) / whole**2
            last += soft * (before * before + before * mass + mass * mass / 3.0) / whole**2
        before += mass
    return 2.0 * np.pi * np.sqrt(square), first, last
