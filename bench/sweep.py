"""All mass ratios of a rod and a rigid mass: exact by events, against steps on a grid of times."""

import numpy as np

import solvers
from solvers.jit import kernel
from solvers.numerics import stepped_waves
from solvers.studies import mass_ratio_sweep, spaced, sweep

from .timing import median, row

PER_TRIP, LIMIT = 128, 64 * 128  # 52 round trips are needed at 1/1000


@kernel
def stepped(ratios):
    """Contacts and rebound of every blow by steps."""
    count, rebound = np.zeros(ratios.size, np.int64), np.zeros(ratios.size)
    for i in range(ratios.size):
        contacts = stepped_waves.strike(ratios[i], 1.0, PER_TRIP, LIMIT, False, 16)[4]
        count[i], rebound[i] = contacts.shape[0], contacts[-1, 3]
    return count, rebound


def measure() -> dict[str, object]:
    exact = mass_ratio_sweep("fixed")
    count, rebound = stepped(exact.mass_ratio)
    scene = solvers.load("fixed-rod")
    masses = spaced(0.02133, 2133.0, 50)
    return dict(
        [
            row("sweep of 200 mass ratios, fixed rod, event-exact", 1e3 * median(mass_ratio_sweep), "ms", "<= 20"),
            row("sweep of 200 mass ratios, free rod", 1e3 * median(lambda: mass_ratio_sweep("free")), "ms", "<= 20"),
            row("the same by 128 steps a round trip", 1e3 * median(lambda: stepped(exact.mass_ratio)), "ms"),
            row("its largest error of the rebound", np.abs(rebound - exact.rebound_velocity).max(), "v"),
            row("its wrong numbers of contacts, of 200", int((count != exact.contacts).sum()), ""),
            row("sweep() of a scene, 50 masses", 1e3 * median(lambda: sweep(scene, "impactor.mass", masses), 5), "ms"),
        ]
    )
