"""All mass ratios of a rod and a rigid mass: exact by events, against steps on a grid of times."""

import numpy as np

import solvers
from solvers.jit.kernels import allocating_kernel
from solvers.numerics.waves import stepped as stepped_waves
from solvers.studies.mass_ratios import mass_ratio_sweep
from solvers.studies.sweep import spaced, sweep

from .size import of
from .timing import median, row

MANY = 100_000
PER_TRIP, LIMIT = 128, 64 * 128  # 52 round trips are needed at 1/1000


@allocating_kernel
def stepped(ratios):
    """Contacts and rebound of every impact by steps."""
    count, rebound = np.zeros(ratios.size, np.int64), np.zeros(ratios.size)
    for i in range(ratios.size):
        contacts = stepped_waves.strike(ratios[i], 1.0, PER_TRIP, LIMIT, False, 16)[4]
        count[i], rebound[i] = contacts.shape[0], contacts[-1, 3]
    return count, rebound


def measure() -> dict[str, object]:
    impacts = of(MANY, 2_000)
    exact = mass_ratio_sweep("fixed")
    count, rebound = stepped(exact.mass_ratio)
    scene = solvers.load("fixed-rod")
    many = spaced(0.2133, 21.33, impacts)

    def hundred() -> None:
        for _ in range(100):
            solvers.solve(scene)

    one_core = median(lambda: solvers.solve_many(scene, {"impactor.mass": many}, workers=1), 3)
    return dict(
        [
            row("sweep of 200 mass ratios, fixed rod, event-exact", 1e3 * median(mass_ratio_sweep), "ms", "<= 20"),
            row("sweep of 200 mass ratios, free rod", 1e3 * median(lambda: mass_ratio_sweep("free")), "ms", "<= 20"),
            row("the same by 128 steps a round trip", 1e3 * median(lambda: stepped(exact.mass_ratio)), "ms"),
            row("its largest error of the rebound", np.abs(rebound - exact.rebound_velocity).max(), "v"),
            row("its wrong numbers of contacts, of 200", int((count != exact.contacts).sum()), ""),
            row("whole solve() by waves, a mass on a rod", 10.0 * median(hundred), "ms", "<= 0.1"),
            row(
                "the same with all its figures and notes read", 1e3 * median(lambda: solvers.solve(scene).table()), "ms"
            ),
            row("solve_many() of such scenes, one core", 1e6 * one_core / impacts, "us each", "<= 25"),
            row(f"sweep() of {impacts} masses", median(lambda: sweep(scene, "impactor.mass", many), 3), "s", "<= 4"),
        ]
    )
