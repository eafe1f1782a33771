"""`method = "auto"` over 500 random scenes: how often it keeps its word. Run alone: the constants of cost."""

import json
from collections.abc import Iterable
from time import perf_counter, thread_time

import numpy as np
from scipy.optimize import nnls

import solvers
from solvers import Auto, SceneError
from solvers.auto import bare
from solvers.costs import STORED, work_size
from solvers.judging import Truth
from solvers.ladders import ladders
from solvers.machine import machine

from .random_scenes import random_scene
from .timing import row

SCENES, OTHER_SCENES, BEAM_SCENES, COST_SCENES = 500, 200, 60, 12
LONGEST = 0.2  # s of a solve that the constants of cost are fitted to
TOLERANCES = (0.03, 0.01, 0.003, 0.001)
QUANTITIES = ("rebound", "impulse", "peak-force", "force-history")
EXACT = 1e-9  # errors below it are as good as none, estimated or true
WITHOUT_WAVES = tuple(name for name in solvers.METHODS if name != "waves")


def measure() -> dict[str, object]:
    """Run `python -m bench.automatic` before, if a method has become quicker or slower: it renews costs.json."""
    found = judge("all methods", (random_scene(np.random.default_rng(i)) for i in range(SCENES)), None)
    others = (random_scene(np.random.default_rng(i)) for i in range(OTHER_SCENES))
    found |= judge("without waves", others, WITHOUT_WAVES)
    beams = (random_scene(np.random.default_rng(1000 + i), beams=1.0) for i in range(BEAM_SCENES))
    return found | judge("beams", beams, None)


def fit_costs() -> dict[str, object]:
    """Time = a + b steps + c steps size + d size^3 of every method, by relative least squares, stored."""
    rows: dict[str, list[tuple[float, int, int]]] = {name: [] for name in solvers.METHODS}
    for number in range(COST_SCENES):
        scene = random_scene(np.random.default_rng(5000 + number), beams=0.3)
        for ladder in ladders(scene):
            for rung in ladder.rungs:
                taken, solution = _timed(bare(rung), scene)
                rows[rung.NAME].append((taken, solution.diagnostics["steps"], work_size(rung.table())))
                if taken > LONGEST / 4.0:
                    break
    constants, within = {}, []
    for name, measured in rows.items():
        time, steps, size = np.array(measured, float).T
        terms = np.column_stack([np.ones_like(time), steps, steps * size, size**3])
        scale = np.maximum(terms.max(axis=0), 1.0)
        fitted = nnls(terms / scale / time[:, None], np.ones_like(time))[0] / scale
        constants[name] = fitted.tolist()
        within += (np.abs(np.log2(terms @ fitted / time)) <= 1.0).tolist()
    STORED.write_text(json.dumps({"machine": machine(), "seconds": constants}, indent=1) + "\n", encoding="utf-8")
    return dict([row("costs foretold within a factor of two", 100.0 * np.mean(within), "%")])


def _timed(method: solvers.Method, scene: solvers.Scene) -> tuple[float, solvers.Solution]:
    """Shortest of some warm solves, and what they give."""
    method.solve(scene)
    times = []
    while len(times) < 3 and sum(times) < 0.1:
        begun = thread_time()  # what else runs on the machine does not count
        solution = method.solve(scene)
        times.append(thread_time() - begun)
    return min(times), solution


def judge(what: str, scenes: Iterable[solvers.Scene], among: tuple[str, ...] | None) -> dict[str, object]:
    """How often the true error is within the tolerance, and the estimate near the true error."""
    kept, near, unmet, spent, refused, count, trivial = [], [], [], [], 0, 0, 0
    for number, scene in enumerate(scenes):
        wish = Auto(TOLERANCES[number % 4], QUANTITIES[number // 4 % 4], None, among)
        begun = perf_counter()
        try:
            solution = wish.solve(scene)
        except SceneError:
            refused += 1
            continue
        count += 1
        spent.append(perf_counter() - begun)
        truth = exact(scene)
        chosen = solution.diagnostics["chosen"]
        true = truth and truth.judge(solution, wish.quantity)
        if not chosen["met"]:
            unmet.append(number)
        if true is None or chosen["estimated_error"] is None:
            continue
        estimated = max(chosen["estimated_error"], EXACT)
        true = max(true, EXACT)
        trivial += max(true, estimated) == EXACT
        if chosen["met"]:
            kept.append(true <= wish.tolerance)
            near.append(1.0 / 3.0 <= estimated / true <= 3.0)
    figures = [
        (f"{what}: scenes", count, ""),
        (f"{what}: says that the tolerance is met", 100.0 * (1.0 - len(unmet) / count), "%"),
        (f"{what}: then true error within the tolerance", 100.0 * np.mean(kept), "%"),
        (f"{what}: then estimate within a factor 3 of the true error", 100.0 * np.mean(near), "%"),
        (f"{what}: of which the true error is known", len(kept), ""),
        (f"{what}: of these both below 1e-9", 100.0 * trivial / max(1, len(near)), "%"),
        (f"{what}: whole search, median", 1e3 * float(np.median(spent)), "ms"),
        (f"{what}: refused", refused, ""),
    ]
    targets = {2: ">= 95", 3: ">= 90"}
    return dict(row(*figure, targets.get(place, "")) for place, figure in enumerate(figures))


class Exact:
    """The truth of a scene and how uncertain it is."""

    def __init__(self, finest: solvers.Solution, second: solvers.Solution | None):
        self.truth, self.second = Truth.of(finest), second

    def judge(self, solution: solvers.Solution, quantity: str) -> float | None:
        """True error; None where the truth is not known ten times better than that."""
        error = self._error(solution, quantity)
        if error is None or self.second is None:
            return error
        doubt = self._error(self.second, quantity)
        return error if doubt is not None and 10.0 * doubt <= max(error, 1e-7) else None

    def _error(self, solution: solvers.Solution, quantity: str) -> float | None:
        error = self.truth.errors(Truth.of(solution).answer)[quantity]
        return None if error is None else abs(error)


def exact(scene: solvers.Scene) -> Exact:
    """Waves where they run, else 1600 modes beside 800."""
    waves = solvers.Waves(tolerance=1e-11)
    if waves.refusal(scene) is None:
        return Exact(waves.solve(scene), None)
    return Exact(*(bare(solvers.Modal(modes=modes)).solve(scene) for modes in (1600, 800)))


if __name__ == "__main__":
    fit_costs()
