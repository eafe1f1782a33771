"""Waves in 1000 random chains of rods over 20 round trips of the longest: how, how fast, how exactly, what fails."""

from time import perf_counter

import numpy as np

import solvers
from tests.random_chains import random_chain, wrong_with

from .size import of
from .timing import row

CHAINS = 1000


def measure() -> dict[str, object]:
    seconds, errors, ways, wrong = [], [], [], []
    for number in range(of(CHAINS, 2)):
        scene, duration = random_chain(number)
        begun = perf_counter()
        solution = solvers.solve(scene, duration=duration)
        seconds.append(perf_counter() - begun)
        errors.append(solution.diagnostics["estimated_error"])
        said = " ".join(map(str, solution.notes))
        ways.append("grid" if "on a grid" in said else "looser" if "followed to a tolerance" in said else "exact")
        wrong += [f"{number}: {what}" for what in wrong_with(solution, scene, duration)]
    print(*wrong, sep="\n")
    return dict(
        [
            row("random chains solved", len(seconds), ""),
            row("with something wrong", len(wrong), "", "0"),
            row("exactly as asked", ways.count("exact"), ""),
            row("to a coarser tolerance", ways.count("looser"), ""),
            row("on a grid", ways.count("grid"), ""),
            row("estimated error, median", float(np.median(errors)), "v"),
            row("estimated error, 99 of 100 below", float(np.quantile(errors, 0.99)), "v"),
            row("time, median", float(np.median(seconds)), "s"),
            row("time, largest", max(seconds), "s"),
        ]
    )
