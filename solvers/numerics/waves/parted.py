"""Whether the parts of a chain of rods will ever touch again, by the rule of `numerics.parting`.

A rod without end holds what is before it as a dashpot does: while nothing touches, the momentum P of that, at most
sqrt(2 E M), goes into it, and moves its face by P / Z in all.
"""

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ..parting import WATCHED_PERIODS, backwards, reach, swing_and_give
from .energies import first_energy, inside, rod_energy
from .parts import ABSORBING, opens
from .record import IMPULSE, OUT_RIGHT, PLACE, SPEED, TOTAL_RIGHT, integral, sample_at, square_integral

TRANSITS = 4.0  # of the whole chain for which no faces may touch at least: a period of one uniform rod that is fixed


@kernel
def alike(chain):
    """Whether what the impactor leaves behind moves alike in every TRANSITS, or no more: one uniform rod."""
    last = chain.kind.size - 1
    return last == 1 and chain.contact == 0 and not 0.0 < chain.mass_right[last] < np.inf


@inner_kernel
def _endless(chain, end):
    return end == chain.kind.size - 1 and chain.kind[end] == ABSORBING


@inner_kernel
def _masses_beside(chain, begin, end):
    """On the first and on the last end of a part; infinite where it is held, or leads on for ever."""
    near, last = chain.mass_left[begin] if begin < chain.contact else 0.0, chain.kind.size - 1
    if end < last or begin < chain.contact:
        return near, 0.0
    return near, np.inf if chain.kind[end] == ABSORBING or chain.spring > 0.0 else chain.mass_right[end]


@kernel
def of_part(chain, begin, end):
    """Longest period of the rods between two nodes as one body, but for one without end, and how its faces give way."""
    if begin == end:  # a mass without a rod, on a spring perhaps
        give = 1.0 / chain.spring if chain.spring > 0.0 else 0.0
        return 2.0 * np.pi * np.sqrt(give * chain.mass_right[end]) if give > 0.0 else 0.0, give, give
    near, far = _masses_beside(chain, begin, end)
    stop = end - 1 if _endless(chain, end) else end
    return swing_and_give(chain.impedance[begin:stop], chain.transit[begin:stop], near, far)


@kernel
def patience(chain):
    """For how long bodies that move apart are watched at least, and at most unless they are clear of each other."""
    wait = 0.0
    for lag in chain.transit:
        wait += TRANSITS * lag
    if alike(chain):
        return wait, wait
    period = of_part(chain, chain.contact, chain.kind.size - 1)[0]
    if chain.contact > 0:
        period = max(period, of_part(chain, 0, chain.contact)[0])
    return wait, max(wait, WATCHED_PERIODS * period)


@inner_kernel
def _part(chain, record, begin, end, t):
    """What is between two nodes as one body: mass, velocity as a whole, how far its first and last faces reach."""
    near, far = _masses_beside(chain, begin, end)
    stop = end - 1 if _endless(chain, end) else end
    own, momentum, energy, after = near, 0.0, 0.0, np.bool_(True)
    for rod in range(begin, stop):
        mass = chain.impedance[rod] * chain.transit[rod]
        own += mass
        momentum += mass * chain.drift[rod] + inside(chain, record, rod, t)
        energy += rod_energy(chain, record, rod, t)
    for node, beside in ((begin, near), (end, far)):
        if 0.0 < beside < np.inf:
            speed = sample_at(record, node, SPEED, t, after)
            momentum += beside * speed
            energy += 0.5 * beside * speed**2
    if begin == end and chain.spring > 0.0:
        swinging, bent = sample_at(record, end, SPEED, t, after), sample_at(record, end, PLACE, t, after)
        energy += 0.5 * chain.mass_right[end] * swinging**2 + 0.5 * chain.spring * bent**2
    _, first, last = of_part(chain, begin, end)
    if far == np.inf:
        gone = 2.0 * np.sqrt(2.0 * max(energy, 0.0) * own) / chain.impedance[stop] if stop < end else 0.0
        return far, 0.0, reach(energy, first) + gone, 0.0
    speed = momentum / (own + far)
    ringing = energy - 0.5 * (own + far) * speed**2
    return own + far, speed, reach(ringing, first), reach(ringing, last)


@kernel
def mass_and_momentum(chain):
    """Of what is struck, before the impact; its mass is infinite where it is held."""
    last = chain.kind.size - 1
    whole = np.inf if _endless(chain, last) else chain.mass_right[last]
    momentum = whole * chain.mass_drift[last] if 0.0 < whole < np.inf else 0.0
    for rod in range(chain.contact, chain.transit.size):
        mass = chain.impedance[rod] * chain.transit[rod]
        whole += mass
        momentum += mass * chain.drift[rod]
    return whole, momentum


@inner_kernel
def _out_of_reach(chain, record, impactor, t):
    """Whether the impactor, one body, leaves faster than the first of several parts can come after it: see `backwards`.

    impactor: its mass, velocity, place, and how far its face reaches. What laws have lost counts as if it were left.
    """
    (striker, speed, place, ahead), node, last, following = impactor, chain.contact, chain.kind.size - 1, chain.contact
    if chain.spring > 0.0 or node == last:
        return False
    mass = 0.0
    while following < last and (following == node or not opens(chain, following)):
        mass += chain.impedance[following] * chain.transit[following]
        following += 1
    if following == last:
        return False
    whole, momentum = mass_and_momentum(chain)
    momentum += sample_at(record, node, IMPULSE, t, np.bool_(True))
    energy = first_energy(chain) - 0.5 * striker * speed**2
    if _endless(chain, last):
        energy -= square_integral(record, last - 1, OUT_RIGHT, 0.0, t) / chain.impedance[last - 1]
    fastest, free = backwards(energy, momentum, mass, whole)
    passed = integral(record, node, IMPULSE, t) - integral(record, following, IMPULSE, t)
    there = chain.drift[node] * t + passed / mass
    return -speed > fastest and there - place > ahead + reach(free, of_part(chain, node, following)[1])


@kernel
def clear(chain, record, first_mass, t):
    """Whether at a time all parts move apart as wholes, and are further apart than their faces reach, or the impactor
    is out of reach of all that it has struck.

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
    if node == chain.contact and _out_of_reach(chain, record, (first_mass, slower, place, ahead), t):
        return True
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
        elif _endless(chain, following):
            there = sample_at(record, last - 1, TOTAL_RIGHT, t, np.bool_(True)) / chain.impedance[last - 1]
        if speed < slower or chain.gap[node] + there - place <= ahead + back:
            return False
        if not goes_on:
            return True
        slower, place, ahead, node = speed, there, front, following
