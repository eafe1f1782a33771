"""Speed against accuracy: every method that can solve a scene, from coarse to fine, and what each point costs."""

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import date
from typing import Any

from threadpoolctl import threadpool_limits

from .. import validation
from ..bodies import Mechanism
from ..methods.base import SceneNotSupported, no_method
from ..provenance import machine, version
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.solution import Solution
from ..text.notes import Note, Severity
from ..validation import SceneError
from . import calibration, store
from .cost_model import scaled_time
from .measured_code import changed, code_of
from .quantities import QUANTITIES, Metrics, Reference
from .reference import exact_waves
from .refinement import Ladder, label, ladders, ranked, refusals
from .tradeoff_table import Point, ReferenceInfo, TradeOff

MEASUREMENT_SECONDS = 12.0  # for all of it, unless asked otherwise
REPEATS, TIMED = 7, 0.12  # of one point: solves at most, and seconds of them
TIME_GROWTH = 2.5  # of the time from one level to the next, until it is known
REFERENCE_HEAD_START = 4  # levels of the ladder that gives the reference, before all others
MAX_LEVEL_SHARE = 0.15  # share of all the time that one level may take


def tradeoff(
    scene: SceneOrName,
    quantities: Sequence[str] | None = None,
    cancel: Callable[[], bool] | None = None,
    progress: Callable[[TradeOff], None] | None = None,
    *,
    fresh: bool = False,
    seconds: float = MEASUREMENT_SECONDS,
) -> TradeOff:
    """Every method that can solve the scene, a ladder of resolutions each: time against error.

    Times are of a processor, the shortest of several solves: what else runs on the machine counts little.

    `progress` is given the table so far after each point, coarse and cheap ones first. Once `cancel` says True, what is
    known is returned, with `stopped`. A complete table of no less than the usual `seconds` is kept in the user's cache,
    for this scene, machine and code of the methods, and given from there unless `fresh`.
    Cost: about `seconds` of one core, less if nothing is left to refine.
    Raises SceneNotSupported if no method can solve the scene, SceneError for a quantity that does not exist.
    """
    scene = scene_of(scene)
    chosen = tuple(validation.choice("quantity", name, QUANTITIES) for name in quantities or QUANTITIES)
    seconds = validation.number("seconds", seconds, 0.1, 3600.0, "s")
    table = None if fresh else store.measured_here(scene, machine(), _code(scene))
    if table is not None:
        return _narrowed(TradeOff.from_table(table), chosen)
    survey = Survey(scene, seconds)
    with threadpool_limits(1, user_api="blas"):  # else a part of the work is another thread's
        try:
            for _ in survey.points(cancel):
                if progress is not None:
                    progress(_narrowed(survey.found(), chosen))
        finally:
            survey.close()
    found = survey.found()
    if found.stopped is None and seconds >= MEASUREMENT_SECONDS:  # else a hasty one would stand for all later ones
        store.keep(scene, found.table())
    return _narrowed(found, chosen)


def stored_tradeoff(scene: SceneOrName) -> TradeOff | None:
    """The table at once, if there is one: measured on this machine, or one that came with the library, `shipped`.

    Times of the latter are scaled, where this machine has been calibrated (`calibrate`). `changed` names what of its
    code is no longer that which was measured.
    """
    scene = scene_of(scene)
    table, shipped = store.measured_here(scene, machine(), _code(scene)), False
    if table is None:
        table, shipped = store.shipped(scene), True
    if table is None:
        return None
    found = replace(TradeOff.from_table(table), shipped=shipped, changed=changed(table.get("code")))
    return _narrowed(_scaled(found, scene) if shipped else found, tuple(QUANTITIES))


def _code(scene: Scene) -> dict[str, str]:
    """Of what solves the scene, and of what measures it."""
    return code_of((ladder.levels[0].NAME for ladder in ladders(scene)), "errors")


def _scaled(found: TradeOff, scene: Scene) -> TradeOff:
    """With times as this machine would take, as far as that is known."""
    there = found.calibration
    scale = calibration.factors(there)
    if there is None or scale is None:
        return found
    points = []
    for point in found.points:
        factor = scaled_time(point.wall_time, point.method, scene.struck, there) / point.wall_time
        spread = point.spread and (factor * point.spread[0], factor * point.spread[1])
        times = {"wall_time": factor * point.wall_time, "spread": spread, "first_time": factor * point.first_time}
        points.append(replace(point, **times))
    return replace(found, points=points, scale=scale)


def _narrowed(found: TradeOff, quantities: Sequence[str]) -> TradeOff:
    return replace(found, quantities={name: QUANTITIES[name] for name in quantities})


@dataclass
class _Solved:
    """One point before its errors are known."""

    ladder: Ladder
    metrics: Metrics
    solution: Solution | Any  # of the finest of each ladder only, as motions are large
    figures: dict[str, Any]  # fields of the Point


class Survey:
    """The measurement under way: solves in an order that shows the whole field early, stops in time."""

    def __init__(self, scene: Scene, seconds: float):
        self.scene, self._seconds = scene.struck, seconds
        self._ladders, self._refused = ladders(scene), refusals(scene)
        if not self._ladders:
            raise SceneNotSupported("scene", scene.title or "this one", no_method(self._refused))
        self._started = time.thread_time()
        self._solved: list[_Solved] = []
        self._remarks: list[Note] = []
        self._stopped: str | None = "under way"
        self._reference: Reference | Any = None
        self._rated: dict[int, Point] = {}  # by number of the solve, as long as the reference is this one
        self._kind, self._main = self._reference_ladder()
        self._begun, self._compiling = time.thread_time(), 0.0

    def close(self) -> None:
        """What is only needed while solving."""
        if self._stopped == "under way":
            self._stopped = "interrupted"

    def _spent(self) -> float:
        """Seconds of a processor, without what compilers took."""
        return time.thread_time() - self._begun - self._compiling

    def _reference_ladder(self) -> tuple[str, Ladder | None]:
        """How the reference is found, and the ladder whose finest level it is; none if it is known beforehand."""
        exact = exact_waves(self.scene)
        if exact is not None:
            self._reference = Reference.of(exact.solve(self.scene))
            return "exact", None
        best = ranked(self._ladders)
        converging = [ladder for ladder in best if ladder.converges]
        if converging:
            return "converged", converging[0]
        self._reference = Reference.of(best[0].solve(0, self.scene))
        return "closed form", None

    def points(self, cancel: Callable[[], bool] | None) -> Iterator[None]:
        """Solve one point after the other, always the one expected to be quickest; of each ladder one at first."""
        waiting = {id(ladder): (ladder, 0) for ladder in self._ladders}
        while waiting:
            if cancel is not None and cancel():
                self._stopped = "cancelled"
                return
            key = min(waiting, key=lambda key: self._expected(*waiting[key]))
            ladder, level = waiting.pop(key)
            if not (self._worth(ladder, level) and self._solve(ladder, level)):
                continue
            if level + 1 < len(ladder.levels):
                waiting[key] = ladder, level + 1
            yield
        self._stopped = None

    def _expected(self, ladder: Ladder, level: int) -> float:
        """Seconds that a level will take, by those below it; the first ones of the reference come before all else."""
        own = [point.figures["wall_time"] for point in self._solved if point.ladder is ladder]
        if ladder is self._main and level < REFERENCE_HEAD_START:
            return -1.0
        if not own:
            return 0.0
        return own[-1] * (max(TIME_GROWTH, own[-1] / own[-2]) if len(own) > 1 else TIME_GROWTH)

    def _worth(self, ladder: Ladder, level: int) -> bool:
        """Whether there is time for it."""
        expected, left = self._expected(ladder, level), self._seconds - self._spent()
        if level == 0:
            return left > 0.0
        if expected > left or (expected > MAX_LEVEL_SHARE * self._seconds and ladder is not self._main):
            size = ladder.size(level - 1)
            self._remark("not-refined", ladder=ladder.name, resolution=ladder.resolution, size=size, seconds=expected)
            return False
        return True

    def _solve(self, ladder: Ladder, level: int) -> bool:
        """Solve and time one level; whether a finer one may differ from it."""
        begun = time.thread_time()
        try:
            solution = ladder.solve(level, self.scene)
        except SceneError as refusal:
            self._remark("refused-point", method=label(ladder.levels[level].table()), refusal=refusal.note.table())
            return False
        first = time.thread_time() - begun
        coarser = [point for point in self._solved if point.ladder is ladder]
        times = self._timed(ladder, level, [first] if coarser else [])  # what a coarser one needed is compiled
        self._compiling += max(0.0, first - 2.0 * min(times))
        metrics = Metrics.of(solution)
        if coarser and metrics.same(coarser[-1].metrics):
            self._remark("finer-changes-nothing", ladder=ladder.name, resolution=ladder.resolution)
            return False
        if coarser:
            coarser[-1].solution = None
        self._solved.append(_Solved(ladder, metrics, solution, self._figures(ladder, level, solution, first, times)))
        if ladder is self._main or self._reference is None:
            self._reference = Reference(self.scene, solution, metrics)
            self._rated.clear()
        return True

    def _remark(self, code: str, **values: Any) -> None:
        self._remarks.append(Note(code, Severity.REMARK, **values))

    def _timed(self, ladder: Ladder, level: int, times: list[float]) -> list[float]:
        """Of a processor, of warm solves; but one if it is long."""
        while len(times) < REPEATS and (sum(times) < TIMED or not times):
            begun = time.thread_time()
            ladder.solve(level, self.scene)
            times.append(time.thread_time() - begun)
        return times

    def _figures(self, ladder: Ladder, level: int, solution: Solution, first: float, times: list[float]):
        return {
            "method": solution.method,
            "ladder": ladder.name if ladder.resolution is None else f"{ladder.name} by {ladder.resolution}",
            "resolution": ladder.resolution,
            "size": ladder.size(level),
            "wall_time": min(times),
            "spread": (min(times), max(times)) if len(times) > 1 else None,
            "repeats": len(times),
            "first_time": first,
            "estimated_error": solution.diagnostics["estimated_error"],
            "contacts": len(solution.contacts),
            "notes": list(solution.notes),
        }

    def found(self) -> TradeOff:
        """All that is known by now."""
        points, remarks = [], list(self._remarks)
        for ladder in self._ladders:
            own = [self._point(solved) for solved in self._solved if solved.ladder is ladder]
            shown = own[:-1] if ladder is self._main and len(own) > 1 else own  # its finest is the reference itself
            points += shown
            remarks += _stagnant(ladder, shown) + _refined(ladder, shown, self.scene)
        return TradeOff(
            scene=self.scene.table(),
            quantities=dict(QUANTITIES),
            reference=self._reference_info(),
            points=points,
            refused=self._refused,
            remarks=remarks,
            machine=machine(),
            version=version(),
            code=_code(self.scene),
            date=str(date.today()),
            seconds=time.thread_time() - self._started,
            stopped=self._stopped,
        )

    def _point(self, solved: _Solved) -> Point:
        if id(solved) not in self._rated:
            self._rated[id(solved)] = self._rate(solved)
        return self._rated[id(solved)]

    def _rate(self, solved: _Solved) -> Point:
        seen, invented = self._reference.contacts(solved.metrics)
        return Point(
            **solved.figures,
            errors=self._reference.errors(solved.metrics),
            true_contacts=len(self._reference.metrics.contacts),
            true_contacts_found=seen,
            invented_contacts=invented,
        )

    def _reference_info(self) -> ReferenceInfo | None:
        """The reference in words, and how far it can be trusted."""
        if self._reference is None:
            return None
        solution = self._reference.solution
        name, uncertainty = label(solution.method), dict.fromkeys(QUANTITIES)
        if self._kind == "exact":
            own = solution.diagnostics["estimated_error"]
            uncertainty |= {"rebound": own, "impulse": own, "peak-force": own}
            note = Note("reference-exact", Severity.REMARK, error=own)
            return ReferenceInfo("exact", solution.method, uncertainty, note)
        if self._kind == "closed form":
            note = Note("reference-closed-form", Severity.REMARK, method=name)
            return ReferenceInfo("closed form", solution.method, uncertainty, note)
        own = [solved for solved in self._solved if solved.ladder is self._main]
        coarser, other = own[-2:-1], self._finest_of_another()
        differences: list[dict[str, Any]] = [self._reference.errors(solved.metrics) for solved in coarser]
        beside = label(coarser[0].figures["method"]) if coarser else None
        third = label(other[-1].figures["method"]) if other else None
        note = Note("reference-converged", Severity.REMARK, method=name, coarser=beside, other=third)
        if other:
            between = self._reference.errors(other[-1].metrics)
            own = Reference(self.scene, other[-1].solution, other[-1].metrics).errors(other[-2].metrics)
            differences.append({name: _beyond(between[name], own[name]) for name in QUANTITIES})
        for quantity in QUANTITIES:
            known = [abs(each[quantity]) for each in differences if each[quantity] is not None]
            uncertainty[quantity] = max(known, default=None)
        return ReferenceInfo("converged", solution.method, uncertainty, note)

    def _finest_of_another(self) -> list[_Solved]:
        """The two finest of the ladder of another method that comes nearest."""
        found: dict[int, list[_Solved]] = {}
        main = None if self._main is None else self._main.levels[0].NAME
        for solved in self._solved:
            if solved.ladder.converges and main != solved.ladder.levels[0].NAME:
                found.setdefault(id(solved.ladder), []).append(solved)
        pairs = [own[-2:] for own in found.values() if len(own) > 1]
        return min(pairs, key=lambda pair: abs(self._reference.errors(pair[-1].metrics)["rebound"] or 0.0), default=[])


def _beyond(between: float | None, own: float | None) -> float | None:
    """How far two methods differ by more than the coarser of them knows of itself."""
    if between is None or own is None:
        return None
    return abs(between) if abs(between) > abs(own) else 0.0


LIMITS = ("peak-force", "force-history", "resolved-force")  # quantities that need not tend to the true ones
STAGNANT_RATIO = 0.85  # of an error that three refinements do not reach: even order 1/2 would bring 0.35
NOTICEABLE_ERROR = 0.02


def _stagnant(ladder: Ladder, points: list[Point]) -> list[Note]:
    """Which quantities a ladder does not bring nearer to the exact solution: they have no limit, or another one."""
    found = []
    for quantity in LIMITS if len(points) >= 4 else ():
        errors = [abs(error) for point in points if (error := point.errors[quantity]) is not None]
        if len(errors) == len(points) and errors[-1] > max(NOTICEABLE_ERROR, STAGNANT_RATIO * errors[-4]):
            found.append(
                Note(
                    "another-limit",
                    Severity.REMARK,
                    ladder=ladder.name,
                    quantity=quantity,
                    resolution=ladder.resolution,
                    last=100 * errors[-1],
                    finest=points[-1].size,
                    first=100 * errors[0],
                    coarsest=points[0].size,
                )
            )
    return found


def _refined(ladder: Ladder, points: list[Point], scene: Scene) -> list[Note]:
    """Points of links with more modes than the scene gives them."""
    own = ladder.refined and scene.target.known_as(Mechanism).most_modes
    finer = own and any(point.size and point.size > own for point in points)
    return [Note("links-refined", Severity.REMARK, modes=own)] if finer else []
