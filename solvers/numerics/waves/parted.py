"""Whether the parts of a chain of rods will ever touch again, by the rule of `numerics.parting`."""

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ..parting import WATCHED_PERIODS, reach, swing_and_give
from .energies import inside, rod_energy
from .parts import ABSORBING, opens
from .record import IMPULSE, PLACE, SPEED, integral, sample_at

TRANSITS = 4.0  # of the whole chain for which no faces may touch at least: a period of one uniform rod that is fixed


@kernel
def alike(chain):
    """Whether what the impactor leaves behind moves alike in every TRANSITS: a uniform rod, free or fixed."""
    last = chain.kind.size - 1
    return last == 1 and chain.contact == 0 and not 0.0 < chain.mass_right[last] < np.inf


@inner_kernel
def _masses_beside(chain, begin, end):
    """On the first and on the last end of a part; infinite where it is held, or leads on for ever."""
    near, last = chain.mass_left[begin] if begin < chain.contact else 0.0, chain.kind.size - 1
    if end < last or begin < chain.contact:
        return near, 0.0
    return near, np.inf if chain.kind[end] == ABSORBING or chain.spring > 0.0 else chain.mass_right[end]


@inner_kernel
def _of_part(chain, begin, end):
    """Longest period of the rods between two nodes, as one body, and the compliances of its faces."""
    if begin == end:  # a mass without a rod, on a spring perhaps
        give = 1.0 / chain.spring if chain.spring > 0.0 else 0.0
        return 2.0 * np.pi * np.sqrt(give * chain.mass_right[end]) if give > 0.0 else 0.0, give, give
    near, far = _masses_beside(chain, begin, end)
    return swing_and_give(chain.impedance[begin:end], chain.transit[begin:end], near, far)


@kernel
def patience(chain):
    """For how long bodies that move apart are watched at least, and at most unless they are clear of each other."""
    wait = 0.0
    for lag in chain.transit:
        wait += TRANSITS * lag
    if alike(chain):
        return wait, wait
    period = _of_part(chain, chain.contact, chain.kind.size - 1)[0]
    if chain.contact > 0:
        period = max(period, _of_part(chain, 0, chain.contact)[0])
    return wait, max(wait, WATCHED_PERIODS * period)


@inner_kernel
def _part(chain, record, begin, end, t):
    """What is between two nodes as one body: mass, velocity as a whole, how far its first and last faces reach."""
    near, far = _masses_beside(chain, begin, end)
    mass, momentum, energy, after = near + far, 0.0, 0.0, np.bool_(True)
    for rod in range(begin, end):
        own = chain.impedance[rod] * chain.transit[rod]
        mass += own
        momentum += own * chain.drift[rod] + inside(chain, record, rod, t)
        energy += rod_energy(chain, record, rod, t)
    for node, beside in ((begin, near), (end, far)):
        if 0.0 < beside < np.inf:
            speed = sample_at(record, node, SPEED, t, after)
            momentum += beside * speed
            energy += 0.5 * beside * speed**2
    if begin == end and chain.spring > 0.0:
        swinging, bent = sample_at(record, end, SPEED, t, after), sample_at(record, end, PLACE, t, after)
        energy += 0.5 * chain.mass_right[end] * swinging**2 + 0.5 * chain.spring * bent**2
    speed = momentum / mass if mass < np.inf else 0.0
    ringing = energy - (0.5 * mass * speed**2 if mass < np.inf else 0.0)
    _, first, last = _of_part(chain, begin, end)
    return mass, speed, reach(ringing, first), reach(ringing, last)


@kernel
def clear(chain, record, first_mass, t):
    """Whether at a time all parts move apart as wholes, and are further apart than their faces reach.

    first_mass: of the first part. Parts lie between joints that can open.
    """
    node, last, after = 0, chain.kind.size - 1, np.bool_(True)
    while node < chain.contact and not opens(chain, node):
        node += 1
    drift, passed = chain.drift[0] if node > 0 else chain.mass_drift[0], integral(record, node, IMPULSE, t)
    slower, ahead = drift - sample_at(record, node, IMPULSE, t, after) / first_mass, 0.0
    place = drift * t - passed / first_mass
    if node > 0:
        ahead = _part(chain, record, 0, node, t)[3]
    while True:
        following = node + 1 if node < last else last
        while following < last and not opens(chain, following):
            following += 1
        mass, speed, back, front = _part(chain, record, node, following, t)
        goes_on = following > node and opens(chain, following)
        there = 0.0
        if mass < np.inf:
            there = (chain.drift[node] if node < last else chain.mass_drift[node]) * t + passed / mass
        passed = integral(record, following, IMPULSE, t) if goes_on else 0.0
        if mass < np.inf:
            there -= passed / mass
        if speed < slower or chain.gap[node] + there - place <= ahead + back:
            return False
        if not goes_on:
            return True
        slower, place, ahead, node = speed, there, front, following
