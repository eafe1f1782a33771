"""Cost against work: what a solve takes over a ladder of steps, modes, elements and rods, and the power it grows by."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

import solvers
from solvers import FeNodal, Modal, Scene, Waves

from .size import some
from .timing import processor_times, row

UPPER = 3  # levels of a ladder by which its exponent is fitted: below, what every solve costs still shows
TARGET = "1.0 +- 0.15"
HERTZ = {"law": "hertz", "stiffness": 1e10}
ROD = {"length": 0.3, "section": {"width": 0.03, "height": 0.03}, "material": "steel"}
CHAINS = (1, 2, 3, 6, 12)  # rods, at most 12
LOOSE = Waves(tolerance=1e-6)  # so that the room for the shortest chain's history is enough, and no solve begins anew
MANY_TRIPS = 60.0  # of one rod: after a fifth of them waves run in all rods of the longest chain


def chain(rods: int) -> Scene:
    """A light mass on rods end to end, each second one thinner, so that waves are split at every joint."""
    parts = [ROD | {"section": {"width": 0.03, "height": 0.03 - 0.005 * (k % 2)}} for k in range(rods)]
    return Scene.from_table(
        {
            "impactor": {"mass": 0.2, "velocity": 1.0},
            "target": {"kind": "rods", "rods": parts, "support": "free"},
            "contact": HERTZ,
        }
    )


def ladders() -> dict[str, tuple[str, Sequence[int], Callable[[int], object]]]:
    """Of each kind of work: its unit, the levels, and the solve on a level."""
    scene = solvers.load("fixed-rod")
    soft, duration = scene.replace({"contact": HERTZ}), 3.0 * scene.target.round_trip_time
    quick = {"estimate": False}  # which would be a second solve, of half the size
    return {
        "modal, 100 modes: steps": (
            "step",
            [2000 * 4**k for k in range(6)],
            lambda n: Modal(modes=100, steps=n, **quick).solve(soft, duration),
        ),
        "modal, 20 000 steps: modes": (
            "mode",
            [12 * 2**k for k in range(9)],
            lambda n: Modal(modes=n, steps=20_000, **quick).solve(soft, duration),
        ),
        "fe-nodal, 100 elements: steps": (
            "step",
            [500 * 4**k for k in range(6)],
            lambda n: FeNodal(elements=100, steps=n, **quick).solve(soft, duration),
        ),
        "fe-nodal, 4000 steps: elements": (
            "element",
            [12 * 2**k for k in range(8)],
            lambda n: FeNodal(elements=n, steps=4000, **quick).solve(soft, duration),
        ),
        "waves, stepped: steps": (
            "step",
            [900 * 4**k for k in range(6)],
            lambda n: Waves(steps=n).solve(scene, duration),
        ),
    }


def measure() -> dict[str, object]:
    rows = []
    for name, (unit, every, solve) in ladders().items():
        levels = some(every, UPPER)
        times = processor_times([partial(solve, n) for n in levels])
        rows += [row(f"{name}: {n}", 1e3 * spent, "ms") for n, spent in zip(levels, times, strict=True)]
        rows += _fitted(name, unit, np.array(levels, float), np.array(times), TARGET)
    return dict(rows + _chains())


def _chains() -> list:
    """Every end and joint steps by its own clock, so that it costs what happens there, not that it is there."""
    counts = some(CHAINS, UPPER)
    scenes = [chain(rods) for rods in counts]
    duration = MANY_TRIPS * scenes[0].time_unit
    times = np.array(processor_times([partial(LOOSE.solve, scene, duration) for scene in scenes]))
    steps = np.array([LOOSE.solve(scene, duration).diagnostics["steps"] for scene in scenes])
    name = "waves in a chain"
    rows = [row(f"{name}: {rods} rods", 1e3 * spent, "ms") for rods, spent in zip(counts, times, strict=True)]
    rows += _fitted(f"{name}: rods", "rod", np.array(counts, float), times, "<= 1.15")
    over_steps = float(np.polyfit(np.log(steps), np.log(times), 1)[0])
    return [
        *rows,
        row(f"{name}: exponent over the steps of its ends and joints", over_steps, "", TARGET),
        row(f"{name}: per step of an end or joint", 1e6 * float(np.median(times / steps)), "us"),
    ]


def _fitted(name: str, unit: str, counts: np.ndarray, times: np.ndarray, target: str) -> list:
    """The exponent where the work outweighs what every solve costs, and how much that is."""
    exponent = float(np.polyfit(np.log(counts[-UPPER:]), np.log(times[-UPPER:]), 1)[0])
    each = float((times[-1] - times[-2]) / (counts[-1] - counts[-2]))
    apart = max(float(times[0] - each * counts[0]), 0.0)
    return [
        row(f"{name}: exponent, of the last {UPPER}", exponent, "", target),
        row(f"{name}: one more {unit}", 1e6 * each, "us"),
        row(f"{name}: besides, on the first", 1e3 * apart, "ms"),
        row(f"{name}: as much as that cost", apart / each, f"{unit}s"),
    ]
