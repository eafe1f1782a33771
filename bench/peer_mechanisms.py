"""Time at equal error on two impacts of moving bodies: a pendulum that bends on a rod, and a slider-crank on a mass.

The pendulum is that of scene figure-9.11, 5 + 30 coordinates, Hertz contact; the slider-crank that of scene
slider-crank, with Hertz contact for its rigid one, so soft that the crank turns meanwhile. Exudyn gets the same
equations, with its own joints and its own contact, so that both converge to one answer: ours, in very short steps. Of
Exudyn only the integration is timed, its model built before; of ours the whole `solve()` with energies and error
estimate, and the integration alone. Times are those of the processor, on one thread.
"""

import importlib.util
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

import solvers
from solvers import Modal, Multibody, Scene, Solution
from solvers.bodies import Mechanism
from solvers.methods.multibody.linkage import rates_of_centres

from .peer_mechanism_models import PendulumFigures, SliderFigures, Solver, exudyn_pendulum, exudyn_slider
from .peers import reached
from .size import of, some
from .timing import processor_times

Figures = PendulumFigures | SliderFigures

ERRORS = (0.01, 0.001, 0.0001)
FEWEST_STEPS = 10  # that our methods take
PENDULUM_DURATION, SLIDER_DURATION = 5e-4, 0.01  # [s]; the last contacts are over at 0.38 and 8.0 ms
CONTACTS = {"soft": 1e6, "metal": 1e10}  # stiffness [N/m^1.5]: 8 and 0.2 ms together, 7 and 0.2 degrees of the crank
REFERENCE_STEPS = 200_000, 5_000  # of the pendulum; of a contact of the slider-crank

PENDULUM_PEERS = {
    "implicit trapezoidal": Solver("TrapezoidalIndex2"),
    "generalised alpha": Solver("GeneralizedAlpha"),
    "velocity Verlet": Solver("VelocityVerlet"),
    "Runge-Kutta 4": Solver("RK44"),
}
SLIDER_PEERS = {  # those that know joints
    f"{name}{added}": Solver(PENDULUM_PEERS[name].name, shortens)
    for name in ("implicit trapezoidal", "generalised alpha")
    for added, shortens in (("", False), (", shorter steps in contact", True))
}


class Works(NamedTuple):
    """What finds the figures, and what of it only integrates."""

    whole: Callable[[], Figures]
    integration: Callable[[], object]


Prepare = Callable[[int], Works]  # by the number of steps


class Tried(NamedTuple):
    """A solver, and the numbers of steps that it tries."""

    prepare: Prepare
    ladder: tuple[int, ...]


@dataclass(frozen=True)
class Run:
    """One solver in so many steps; the error is the largest of those of the figures, each relative to what is right.

    Times of the processor [s], medians of warm repeats: of Exudyn both are those of its integration.
    """

    steps: int
    error: float
    time: float
    integration: float


class Case(NamedTuple):
    """One impact: what is right, and the solvers by their labels."""

    right: Figures
    solvers: dict[str, Tried]


def measure() -> dict[str, object] | None:
    absent = importlib.util.find_spec("exudyn") is None
    if of(absent, False):  # of a small run, what is here
        print("  not installed: exudyn; `make peers` installs and runs it")
        return None
    cases = {"pendulum": pendulum()}
    cases |= {f"slider-crank, {name} contact": slider_crank(stiffness) for name, stiffness in some(CONTACTS).items()}
    found: dict[str, object] = {}
    for name, case in cases.items():
        print(f"  {name + ': ' + _said(case.right)}")
        heads = "".join(f"{f'<= {100 * error:g} %: ms (alone)':>23}{'steps':>6}" for error in ERRORS)
        print(f"  {'':52}{heads}{'finest':>12}")
        entries = {
            label: _entry(label, case.right, tried)
            for label, tried in case.solvers.items()
            if not (absent and label.startswith("Exudyn"))
        }
        found[name] = {"reference": case.right._asdict()} | entries
    return found


def pendulum() -> Case:
    scene = solvers.load("figure-9.11")

    def solve(steps: int, estimate: bool = True) -> Works:
        method = Modal(modes=scene.method["modes"], residual=False, steps=steps, estimate=estimate)

        def whole() -> PendulumFigures:
            found = _all(method.solve(scene, PENDULUM_DURATION))
            return PendulumFigures(found.impactor_velocity, found.target_velocity, found.peak_force)

        return Works(whole, lambda: method._march(scene, PENDULUM_DURATION))

    found = {"modal": Tried(solve, ladder(FEWEST_STEPS, 1600))}
    for name, solver in PENDULUM_PEERS.items():
        prepare = partial(exudyn_pendulum, scene, PENDULUM_DURATION, solver)
        found[f"Exudyn, {name}"] = Tried(_alone(prepare), ladder(FEWEST_STEPS, 1600))
    return Case(solve(REFERENCE_STEPS[0], False).whole(), found)


def slider_crank(stiffness: float) -> Case:
    table = solvers.load("slider-crank").table()
    table["contact"] = {"law": "hertz", "stiffness": stiffness}
    scene = Scene.from_table(table)
    mechanism = scene.target.known_as(Mechanism)
    masses = np.array([link.mass for link in mechanism.system.links])
    before = float(masses @ rates_of_centres(mechanism)[::3])  # momentum of the links along the stroke

    def solve(contact_steps: int, estimate: bool = True) -> Works:
        method = Multibody(contact_steps=contact_steps, steps=FEWEST_STEPS, estimate=estimate)

        def whole() -> SliderFigures:
            found = _all(method.solve(scene, SLIDER_DURATION))
            after = masses @ [link["final_velocity"][0] for link in found.links.values()]
            spin = found.links["crank"]["final_spin"]
            return SliderFigures(found.impactor_velocity, spin, float(after) - before + found.impulse)

        return Works(whole, lambda: method._follow(scene, SLIDER_DURATION))

    found = {"multibody": Tried(solve, ladder(FEWEST_STEPS, 320))}
    for name, solver in SLIDER_PEERS.items():
        prepare = partial(exudyn_slider, scene, SLIDER_DURATION, solver)
        found[f"Exudyn, {name}"] = Tried(_alone(prepare), ladder(2, 2560))
    return Case(solve(REFERENCE_STEPS[1], False).whole(), found)


def _all(found: Solution) -> Solution:
    """With all that is worked out only when it is asked for."""
    _ = found.diagnostics, found.energy, found.restitution, found.notes
    return found


def _alone(prepare: Callable[[int], Callable[[], Figures]]) -> Prepare:
    """Of a peer, of which only the integration is timed."""

    def works(steps: int) -> Works:
        run = prepare(steps)
        return Works(run, run)

    return works


def ladder(fewest: int, most: int) -> tuple[int, ...]:
    """Numbers of steps, each the square root of 2 times the last, in whole numbers."""
    count = int(2.0 * math.log2(most / fewest) + 1e-9) + 1
    return tuple(round(fewest * 2 ** (i / 2)) for i in range(count))


def off_by(found: Figures, right: Figures) -> float:
    """The largest relative error of any figure; infinite where there is no number."""
    errors = np.abs(np.array(found) / np.array(right) - 1.0)
    return float(errors.max()) if np.isfinite(errors).all() else math.inf


def runs(right: Figures, tried: Tried) -> list[Run]:
    """In all its numbers of steps but those at which it gives up or finds no numbers."""
    found = []
    for steps in some(tried.ladder, 2):
        works = tried.prepare(steps)
        try:
            error = off_by(works.whole(), right)
        except ArithmeticError:
            continue
        if not math.isfinite(error):
            continue
        times = processor_times([works.whole] if works.whole is works.integration else works)
        found.append(Run(steps, error, times[0], times[-1]))
    return found


def _entry(label: str, right: Figures, tried: Tried) -> dict[str, object]:
    """All runs of a solver that gave an answer, and for each error the coarsest from which on all are within it."""
    tries = runs(right, tried)
    line, found = f"  {label:52}", {"runs": [asdict(run) for run in tries]}
    for error in ERRORS:
        run = reached(tries, error, lambda run: run.error)
        found[f"within {100 * error:g} %"] = None if run is None else asdict(run)
        times = "" if run is None else f"{1e3 * run.time:.3g} ({1e3 * run.integration:.3g})"
        line += f"{'not reached':>29}" if run is None else f"{times:>23}{run.steps:6d}"
    print(f"{line}{tries[-1].error if tries else math.inf:12.2g}")
    return found


def _said(figures: Figures) -> str:
    return ", ".join(f"{name.replace('_', ' ')} {value:.7g}" for name, value in figures._asdict().items())
