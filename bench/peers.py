"""Time at equal error: what a user would otherwise take, beside our own methods, on one impact.

Steel rod fixed at one end, struck by its own mass (scene fixed-rod, rigid contact): two contacts, the second one 0.04 T
long. A peer that knows no rigid contact presses on a penalty spring as stiff as the neighbouring element, E A over the
element's length. All run over 2.5 T, on one thread. Of a peer only the integration is timed, its model built before; of
our own methods the whole `solve()` with contacts, energies and error estimate.
"""

import importlib.util
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields
from functools import partial
from typing import Any

import numpy as np

import solvers
from solvers import SceneError, Solution
from solvers.accuracy.comparison import VARIANTS, force_error

from . import peer_models
from .peer_models import Problem, Record
from .size import of, some
from .timing import median

Prepare = Callable[[Problem, int], peer_models.Run]

OPTIONAL = {"scikit-fem": "skfem", "exudyn": "exudyn", "elwaspatid": "elwaspatid"}
COURANTS = (1.0, 2.0, 4.0, 8.0)  # steps of the implicit peers, in transit times of an element: the best one counts


def _any_step(prepare: Callable[[Problem, int, float], peer_models.Run]) -> dict[str, Prepare]:
    return {f"Courant {courant:g}": partial(prepare, courant=courant) for courant in COURANTS}


PEERS: dict[str, dict[str, Prepare]] = {
    "SciPy solve_ivp, DOP853": {"": peer_models.solve_ivp_elements},
    "scikit-fem, Newmark": _any_step(peer_models.scikit_fem_newmark),
    "Exudyn, implicit trapezoidal": _any_step(peer_models.exudyn_trapezoidal),
    "Exudyn, velocity Verlet": {"": peer_models.exudyn_verlet},
    "elwaspatid, WP2": {"": peer_models.elwaspatid_bars},
}
ERRORS = (0.01, 0.003)  # of the rebound, in impact speeds
RESOLUTIONS = tuple(round(25 * 2 ** (i / 2)) for i in range(13))  # 25, 35, 50, ... 1600
KINDS = ("elements", "modes", "steps")  # what the resolution of a method of ours is called, the first that it has
LONGEST = 30.0  # [s] of one warm solve, of peers and ours alike: what takes longer, and all finer, is left out
REPEATS, SLOW, SLOW_REPEATS = 5, 1.0, 2  # timed solves; of those slower than that [s]
TRIPS = 2.5


@dataclass(frozen=True)
class Run:
    """One solver at one resolution; errors are found minus exact."""

    resolution: int | None  # None: it needs none
    rebound_error: float  # in impact speeds
    force_error: float  # relative, in the L2 norm over 2.5 T
    contacts: int  # stretches of force
    time: float  # [s] median of warm repeats


def missing() -> list[str]:
    """Optional peers that are not installed."""
    return [name for name, module in OPTIONAL.items() if importlib.util.find_spec(module) is None]


def measure() -> dict[str, object] | None:
    if of(missing(), []):  # of a small run, those that are here
        print(f"  not installed: {', '.join(missing())}; `make peers` installs and runs them")
        return None
    scene = solvers.load("fixed-rod")
    exact = solvers.solve(scene)
    problem = Problem.of(scene, TRIPS * scene.time_unit)
    print(_header())
    found = {}
    here = {name: each for name, each in PEERS.items() if name.partition(",")[0].lower() not in missing()}
    for name, settings in here.items():
        ladders = {setting: _peer_runs(problem, exact, prepare) for setting, prepare in some(settings).items()}
        found[name] = _entry(name, ladders, "elements")
    for label, table, kind in _own(scene):
        found[label] = _entry(label, {"": _own_runs(scene, exact, table, kind)}, kind)
    return found


def _own(scene: solvers.Scene) -> list[tuple[str, dict[str, object], str | None]]:
    """Label, options and name of the resolution of all of ours that can solve the scene; the exact one has none."""
    found: list[tuple[str, dict[str, object], str | None]] = [("waves", {"name": "waves"}, None)]
    for table in [{"name": name} for name in solvers.METHODS] + list(VARIANTS):
        options = [option.name for option in fields(solvers.METHODS[table["name"]])]
        kind = next((kind for kind in KINDS if kind in options), None)
        if kind is None or table.keys() & set(KINDS):
            continue
        if solvers.read_method(table | {kind: RESOLUTIONS[0]})[0].refusal(scene) is None:
            found.append((" ".join([f"{value}" for value in table.values()] + ["by", kind]), table, kind))
    return sorted(found, key=lambda entry: list(solvers.METHODS).index(entry[1]["name"]))


def _peer_runs(problem: Problem, exact: Solution, prepare: Prepare) -> list[Run]:
    runs: list[Run] = []
    for elements in some(RESOLUTIONS, 2):
        work = prepare(problem, elements)
        work()  # what is compiled or cached at the first call
        record, spent = _timed(work)
        if spent is None:
            break
        runs.append(_run(elements, exact, problem.duration, record, spent))
    return runs


def _own_runs(scene: solvers.Scene, exact: Solution, table: dict[str, object], kind: str | None) -> list[Run]:
    runs: list[Run] = []
    duration = TRIPS * scene.time_unit
    for resolution in (None,) if kind is None else some(RESOLUTIONS, 2):
        try:
            method, _ = solvers.read_method(table if kind is None else table | {kind: resolution})
            method.solve(scene, duration)
        except SceneError:  # finer than the method goes
            break
        found, spent = _timed(lambda method=method: method.solve(scene, duration))
        if spent is None:
            break
        runs.append(
            Run(
                resolution,
                (found.impactor_velocity - exact.impactor_velocity) / scene.speed,
                force_error(exact, duration, found.motion.force),
                found.diagnostics.get("raw_contacts", len(found.contacts)),
                spent,
            )
        )
    return runs


def _run(elements: int, exact: Solution, duration: float, record: Record, spent: float) -> Run:
    pressing = np.concatenate(([False], record.force > 0.0))
    return Run(
        elements,
        (record.velocity - exact.impactor_velocity) / exact.scene.speed,
        force_error(exact, duration, lambda at: np.interp(at, record.time, record.force)),
        int((pressing[1:] & ~pressing[:-1]).sum()),
        spent,
    )


def _timed(work: Callable[[], Any]) -> tuple[Any, float | None]:
    """What it gives and its median time [s]; None if it is too slow."""
    begun = time.perf_counter()
    found = work()
    once = time.perf_counter() - begun
    if once > LONGEST:
        return found, None
    return found, median(work, REPEATS if once < SLOW else SLOW_REPEATS)


def reached(runs: list[Any], error: float, off_by: Callable[[Any], float] = lambda run: run.rebound_error) -> Any:
    """The coarsest run from which on every finer one stays within the error, or None: a chance hit does not count."""
    good = None
    for run in reversed(runs):
        if not abs(off_by(run)) <= error:
            break
        good = run
    return good


def _entry(name: str, ladders: dict[str, list[Run]], kind: str | None) -> dict[str, object]:
    """All runs of a solver by its settings, and for each error the quickest that reaches it."""
    line = f"  {name:40}"
    found: dict[str, object] = {"resolution": kind}
    found["runs"] = {setting: [asdict(run) for run in runs] for setting, runs in ladders.items()}
    for error in ERRORS:
        reaching = [(run, setting) for setting, runs in ladders.items() if (run := reached(runs, error))]
        run, setting = min(reaching, key=lambda pair: pair[0].time, default=(None, ""))
        found[f"within {100 * error:g} %"] = None if run is None else asdict(run) | {"setting": setting}
        if run is None:
            line += f"{'not reached':>52}"
        else:
            at = "" if run.resolution is None else f"{run.resolution} {kind}"
            line += f"{1e3 * run.time:9.3g}{at:>14}{setting:>12}{100 * run.force_error:8.1f}{run.contacts:9d}"
    finest = min((runs[-1] for runs in ladders.values()), key=lambda run: abs(run.rebound_error))
    print(f"{line}{100 * finest.rebound_error:+12.3f}{finest.resolution or '':>9}")
    return found


def _header() -> str:
    columns = "".join(
        f"{f'<= {100 * error:g} %: ms':>13}{'at':>10}{'step':>12}{'L2 %':>8}{'contacts':>9}" for error in ERRORS
    )
    return f"  {'':40}{columns}{'finest: %':>12}{'at':>9}"
