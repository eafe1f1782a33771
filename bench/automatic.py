"""`method = "auto"` over 500 random scenes: how often it keeps its word; and the constants of cost.

The scenes are of seeds that nothing was developed with. Whoever looks into one of them, to mend what it shows, moves
FIRST on.
"""

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from datetime import date
from time import thread_time
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares, nnls
from threadpoolctl import threadpool_limits

import solvers
from solvers import Auto
from solvers.accuracy import calibration
from solvers.accuracy.cost_model import STORED, expected_of, kinds, stored_costs, work_size
from solvers.accuracy.measured_code import code_of
from solvers.accuracy.quantities import Reference
from solvers.accuracy.refinement import ladders
from solvers.accuracy.three_solves import measured
from solvers.provenance import machine

from .random_scenes import random_scene
from .size import of, some
from .timing import row

FIRST, OTHER_FIRST, BEAM_FIRST = 90_000, 90_500, 90_700  # seeds
SCENES, OTHER_SCENES, BEAM_SCENES = 500, 100, 60
COST_FIRST, COST_SCENES, COST_OTHER_FIRST, COST_OTHER_SCENES = 5000, 32, 6000, 8  # fitted to; and to see how it fits
COST_BEAMS = 0.4  # share of them
CLOSED_SCENES = 300  # more, of which only closed forms are solved: one level each
LONGEST, LITTLE = 0.4, 0.01  # s of a solve that the constants of cost are fitted to; of a small run
TOLERANCES = (0.1, 0.03, 0.01, 0.003, 0.001, 1e-4)
QUANTITIES = ("rebound", "impulse", "peak-force", "force-history", "contact-time")
ELEMENTS, FINER, MOST_STEPS, LITTLE_STEPS = (
    400,
    8,
    400_000,
    20_000,
)  # of the reference on beams; times the steps of half the elements
EXACT = 1e-9  # errors below it are as good as none, estimated or true
WITHOUT_WAVES = tuple(name for name in solvers.METHODS if name != "waves")


def measure() -> dict[str, object]:
    """Run `make tables` before, if a method has become quicker or slower: it renews costs.json."""
    found = rate("all methods", _scenes(FIRST, of(SCENES, 2)), None)
    found |= rate("without waves", _scenes(OTHER_FIRST, of(OTHER_SCENES, 1)), WITHOUT_WAVES)
    return found | rate("beams", _scenes(BEAM_FIRST, of(BEAM_SCENES, 1), beams=1.0), None)


def _scenes(first: int, count: int, beams: float = 0.0) -> Iterable[solvers.Scene]:
    return (random_scene(np.random.default_rng(first + number), beams) for number in range(count))


class Cost(NamedTuple):
    """Of one solve, without its estimate of the error."""

    kinds: tuple[str, ...]
    seconds: float
    steps: int
    size: int


def costs_of(scenes: Iterable[solvers.Scene], closed: bool = False) -> Iterator[Cost]:
    """Every ladder of each scene, up to where a solve takes long; or only `closed` forms, of one level."""
    with threadpool_limits(1, user_api="blas"):
        for scene in scenes:
            for ladder in ladders(scene):
                if closed and len(ladder.levels) > 1:
                    continue
                for level in ladder.levels:
                    taken, solution = _timed(level.without_estimate(), scene)
                    table = level.table()
                    yield Cost(kinds(table, scene), taken, solution.diagnostics["steps"], work_size(table))
                    if taken > of(LONGEST, LITTLE) / 4.0:
                        break


def fit_costs() -> dict[str, object]:
    """Time = a + b steps + c steps size + d size^3 of every kind of solve, by relative least squares, stored."""
    rows: dict[str, list[tuple[float, int, int]]] = {}
    before = measured()
    for number, scene in enumerate(_scenes(COST_FIRST, COST_SCENES + CLOSED_SCENES, COST_BEAMS)):
        for cost in costs_of([scene], closed=number >= COST_SCENES):
            for kind in cost.kinds:
                rows.setdefault(kind, []).append(cost[1:])
        if number < COST_SCENES:
            print(f"  costs: {number + 1} of {COST_SCENES} scenes", flush=True)
    constants, within = {}, []
    for kind, solves in rows.items():
        time, steps, size = np.array(solves, float).T
        terms = np.column_stack([np.ones_like(time), steps, steps * size, size**3])
        scale = np.maximum(terms.max(axis=0), 1.0)
        fitted = _fitted(terms / scale, time) / scale
        constants[kind] = [float(f"{constant:.3e}") for constant in fitted]
        if kind.count(" ") > 1:  # else it stands in for those that are not known
            within += (np.abs(np.log2(terms @ fitted / time)) <= 1.0).tolist()
    after = measured()
    stored = {
        "machine": machine(),
        "date": str(date.today()),
        "calibration": {kind: min(before[kind], after[kind]) for kind in before},
        "code": code_of(solvers.METHODS, "costs"),
        "seconds": constants,
    }
    beside = STORED.with_suffix(".part")
    beside.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")
    beside.replace(STORED)
    stored_costs.cache_clear()
    return dict([row("costs foretold within a factor of two", 100.0 * np.mean(within), "%")])


def _fitted(terms: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Constants, none negative, by which sums of the terms are off by factors as small as can be."""
    start = nnls(terms / time[:, None], np.ones_like(time))[0]
    least = 1e-6 * max(start.max(), time.min())  # where one has no place in it
    found = least_squares(lambda each: np.log(terms @ each / time), np.maximum(start, least), bounds=(0.0, np.inf))
    return np.where(found.x > least, found.x, 0.0)


def costs_foretold(every: int = 1) -> dict[str, object]:
    """How near the stored constants are on this machine, calibrated, on scenes that they were not fitted to."""
    calibration.calibrate(of(calibration.SECONDS, 0.02))
    known = stored_costs()["seconds"]
    off = []
    for cost in costs_of(some(list(_scenes(COST_OTHER_FIRST, COST_OTHER_SCENES, COST_BEAMS))[::every])):
        if cost.kinds[0] in known:
            off.append(cost.seconds / expected_of(cost.kinds, cost.steps, cost.size))
    shares = [100.0 * float(np.mean(np.abs(np.log(off)) <= np.log(factor))) for factor in (2.0, 2.5)]
    return dict(
        [
            row("solves foretold by constants of cost, other scenes", len(off), ""),
            row("now over foretold: median", float(np.median(off)), "x"),
            row("within a factor 2", shares[0], "%"),
            row("within a factor 2.5", shares[1], "%", ">= 95"),
            row("worst", float(np.exp(np.max(np.abs(np.log(off))))), "x"),
        ]
    )


def _timed(method: solvers.Method, scene: solvers.Scene) -> tuple[float, solvers.Solution]:
    """Shortest of some warm solves, and what they give."""
    method.solve(scene)
    times = []
    while len(times) < of(3, 1) and sum(times) < 0.1:
        begun = thread_time()  # what else runs on the machine does not count
        solution = method.solve(scene).complete()
        times.append(thread_time() - begun)
    return min(times), solution


def rate(what: str, scenes: Iterable[solvers.Scene], among: tuple[str, ...] | None) -> dict[str, object]:
    """How often the true error is within the tolerance, and the estimate near the true error.

    Of those that say that they keep to it, and of all: what misses, or says no more than that it cannot, counts there.
    """
    outcomes = [outcome for outcome in (_outcome(*each, among) for each in enumerate(scenes)) if outcome is not None]
    met = [outcome for outcome in outcomes if outcome.met]
    for outcome in outcomes:
        if outcome.wrong:
            print(f"    {what}, number {outcome.number}: {outcome}")
    near = [outcome for outcome in outcomes if outcome.near is not None]
    searches = np.array([outcome.times for outcome in outcomes])
    times, shares = searches[:, 0], searches[:, :1] / searches[:, 1:]
    return dict(
        [
            row(f"{what}: scenes", len(outcomes), ""),
            row(f"{what}: says that the tolerance is met", _share([v.met for v in outcomes]), "%"),
            row(f"{what}: then true error within the tolerance", _share([v.kept for v in met]), "%", ">= 95"),
            row(f"{what}: then estimate within a factor 3", _share([v.near for v in met]), "%", ">= 90"),
            row(f"{what}: true error within the tolerance, of all", _share([v.kept for v in outcomes]), "%", ">= 95"),
            row(f"{what}: estimate within a factor 3, of all", _share([v.near for v in outcomes]), "%", ">= 90"),
            row(f"{what}: judged, of all: tolerance", sum(v.kept is not None for v in outcomes), ""),
            row(f"{what}: judged, of all: estimate", len(near), ""),
            row(f"{what}: of these both below 1e-9", _share([v.trivial for v in near]), "%"),
            row(f"{what}: whole search, median", 1e3 * float(np.median(times)), "ms"),
            row(f"{what}: whole search, longest", 1e3 * float(times.max()), "ms"),
            row(f"{what}: search over the solve it ends with, median", float(np.median(shares[:, 0])), "x"),
            row(f"{what}: search over the solve it ends with, worst", float(shares[:, 0].max()), "x"),
            row(f"{what}: search over its costliest solve, median", float(np.median(shares[:, 1])), "x"),
            row(f"{what}: search over its costliest solve, worst", float(shares[:, 1].max()), "x"),
        ]
    )


@dataclass(frozen=True)
class Outcome:
    """On one scene. None: not known, as the reference is not known well enough, or no such thing has been claimed."""

    number: int
    asked: str
    met: bool
    kept: bool | None
    near: bool | None
    estimated: float | None
    true: float | None
    times: tuple[float, float, float] = field(repr=False)  # search, the solve it ends with, its costliest [s]

    @property
    def wrong(self) -> bool:
        return (self.met and self.kept is False) or self.near is False

    @property
    def trivial(self) -> bool:
        return max(self.true, self.estimated) <= EXACT


def _outcome(number: int, scene: solvers.Scene, among: tuple[str, ...] | None) -> Outcome | None:
    quantity = QUANTITIES[number // len(TOLERANCES) % len(QUANTITIES)]
    auto = Auto(TOLERANCES[number % len(TOLERANCES)], quantity, None, among)
    if auto.refusal(scene) is not None:
        return None
    auto.solve(scene)  # compiled
    begun = thread_time()
    solution = auto.solve(scene)
    spent = thread_time() - begun
    chosen, reference = solution.diagnostics["chosen"], exact(scene)
    costliest = max(chosen["tried"], key=lambda row: row["cost"])["method"]
    times = tuple(_timed(_named(method), scene)[0] for method in (solution.method, costliest))
    estimated, (true, uncertainty) = chosen["estimated_error"], reference.true_error(solution, quantity)
    kept = near = None
    if true is not None and abs(true - auto.tolerance) > uncertainty:
        kept = true <= auto.tolerance
    if true is not None and estimated is not None and 10.0 * uncertainty <= max(true, EXACT):
        near = 1.0 / 3.0 <= max(estimated, EXACT) / max(true, EXACT) <= 3.0
    asked = f"{quantity} to {auto.tolerance:g}, {scene.contact.NAME}, {solution.method}"
    return Outcome(number, asked, bool(chosen["met"]), kept, near, estimated, true, (spent, *times))


def _named(table: dict[str, object]) -> solvers.Method:
    return solvers.read_method({key: value for key, value in table.items() if value is not None})[0].without_estimate()


def _share(flags: Iterable[bool | None]) -> float:
    """Of those that are known [%]."""
    known = [one for one in flags if one is not None]
    return 100.0 * float(np.mean(known)) if known else float("nan")


class Exact:
    """The reference of a scene and how uncertain it is."""

    def __init__(self, finest: solvers.Solution, second: solvers.Solution | None):
        self.reference, self.second = Reference.of(finest), second

    def true_error(self, solution: solvers.Solution, quantity: str) -> tuple[float | None, float]:
        """True error, None if there is no such thing; and by how much the reference may be wrong."""
        uncertainty = 0.0 if self.second is None else self._error(self.second, quantity)
        return self._error(solution, quantity), np.inf if uncertainty is None else uncertainty

    def _error(self, solution: solvers.Solution, quantity: str) -> float | None:
        error = self.reference.errors(Reference.of(solution).metrics)[quantity]
        return None if error is None else abs(error)


def exact(scene: solvers.Scene) -> Exact:
    """Waves where they run. Else finite elements node by node, which share neither modes nor integration with what is
    mostly chosen and proved, and which are believed as far as 1600 modes agree with them.
    """
    waves = solvers.Waves(tolerance=1e-11)
    if waves.refusal(scene) is None:
        return Exact(waves.solve(scene), None)
    steps = FINER * solvers.FeNodal(elements=ELEMENTS // 2, estimate=False).solve(scene).diagnostics["steps"]
    elements = solvers.FeNodal(elements=ELEMENTS, steps=min(steps, of(MOST_STEPS, LITTLE_STEPS)), estimate=False)
    return Exact(elements.solve(scene), solvers.Modal(modes=1600, estimate=False).solve(scene))
