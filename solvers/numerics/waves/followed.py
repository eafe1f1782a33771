"""A chain of rods (see `network`) followed until all is over, and what its rods hold meanwhile."""

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ...jit.reference import refer
from .energies import first_energy, rod_energy
from .events import NO_PULL
from .laws import STORED
from .network import PARTED, STOPPED, separate, solve
from .parted import alike, clear, patience
from .parts import ABSORBING, LAW
from .record import DEPTH, FORCE, SPEED, highest, pushed, sample_at

MILLIONTH = 1e-6  # of v: on a rod without end, where a force fades for ever, less is left to be
LOOKS_LATER = 1.5  # times as late, each time that something is left
LOOKS_AGAIN = 0.25  # of the time for which bodies have been apart: so much later, whether they are clear of each other


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


@inner_kernel
def _reached(state):
    """The time that all nodes have come to."""
    reach = np.inf
    for t in state.time:
        reach = min(reach, t)
    return reach


@inner_kernel
def _to_parting(chain, record, state, work, contact, joint, of_law, limit, tolerance):
    """Until the impactor has parted for good, at most to `limit`: see `numerics.parting`. Before a rod without end it
    is looked at now and then whether anything is left. Returns as `follow` does.
    """
    (wait, longest), doubtful, masses = patience(chain), False, of_law[4]
    endless = chain.kind[-1] == ABSORBING
    stop, creep = (min(_fading(chain, masses), limit), MILLIONTH) if endless else (limit, NO_PULL)
    while True:
        status = solve(chain, record, state, work, contact, joint, *of_law, wait, creep, stop, tolerance)
        if status == PARTED:
            for node in range(chain.kind.size):  # whether no part will ever catch up with the one before it
                state.through[node] = pushed(record, node)
            comes = endless and not separate(chain, masses, state.through, NO_PULL)
            if comes or alike(chain) or clear(chain, record, masses[-1], _reached(state)):
                return status, comes, False
            apart = state.time[chain.contact] - state.parting[0]
            if apart >= longest:
                return status, False, True
            again, doubtful = min(state.time[chain.contact] + LOOKS_AGAIN * apart, stop), True
            status = solve(chain, record, state, work, contact, joint, *of_law, np.inf, creep, again, tolerance)
            if status == STOPPED and again < stop:
                continue
        if status != STOPPED:
            return status, False, doubtful and state.parting[0] < np.inf
        faded = False
        if endless:
            left = _energy_left(chain, record, contact, joint, of_law[0], work.slopes, _reached(state))
            faded = left < MILLIONTH**2
        if faded or stop >= limit:
            return status, faded, False
        stop = min(LOOKS_LATER * stop, limit)


@kernel
def follow(chain, record, state, work, contact, joint, of_law, until, most, tolerance):
    """Follow a chain up to `until`, or if that is infinite until the impactor has parted for good, at most to `most`.

    The others as `network.solve` takes them; of_law: (constants, remembers, loses, pulse, masses). Returns the status,
    before a rod without end whether nothing is left, and whether who has parted may touch again.
    """
    chain, record, state, work = refer(chain), refer(record), refer(state), refer(work)
    limit = min(until, most)
    if until < np.inf:
        status = solve(chain, record, state, work, contact, joint, *of_law, np.inf, NO_PULL, limit, tolerance)
        return status, False, False
    return _to_parting(chain, record, state, work, contact, joint, of_law, limit, tolerance)
