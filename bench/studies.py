"""Studies: seconds for 100 000 points, what a second worker brings, what resuming and keeping cost, and memory."""

import resource
import tempfile
import time
from pathlib import Path
from typing import Any

import solvers

from .size import of
from .timing import median, row

MANY = 100_000
FIGURES = ["peak_force", "impactor_velocity", "contacts"]
KINDS = {  # what is measured: scene, points, whether notes are looked for, most seconds of 100 000
    "masses on rods, rigid": ("fixed-rod", MANY, False, "<= 2"),
    "masses on rods, Hertz": ("bronze-rod-steel-ball", 20_000, False, "<= 30"),
    "the same with all figures and notes": ("bronze-rod-steel-ball", 4_000, True, ""),
    "a beam of 20 modes": ("hammer-on-cantilever", 6_000, False, "<= 60"),
    "the same with all figures and notes ": ("hammer-on-cantilever", 700, True, ""),
}


def run(scene: str, points: int, notes: bool, workers: int, **more: Any) -> float:
    """Seconds of a study over the speed."""
    begun = time.perf_counter()
    figures = None if notes else FIGURES
    vary = {"impactor.velocity": f"0.5..3:{points}"}
    solvers.study(scene, vary, figures=figures, notes=notes, workers=workers, **more)
    return time.perf_counter() - begun


def measure() -> dict[str, object]:
    rows = []
    for name, (scene, whole, notes, target) in KINDS.items():
        points = of(whole, 20)
        seconds = median(lambda scene=scene, points=points, notes=notes: run(scene, points, notes, 2), 3)
        rows.append(row(f"100 000 points on 2 workers: {name}", seconds * MANY / points, "s", target))
    points, pairs = of(10_000, 20), []
    for _ in range(of(3, 1)):
        pairs.append([run("bronze-rod-steel-ball", points, False, workers) for workers in (1, 2)])
    gain = sorted(one / two for one, two in pairs)[len(pairs) // 2]
    rows.append(row("1 worker over 2, masses on rods by Hertz", gain, "", ">= 1.8"))
    rows += _kept(points)
    if points > 1_000:
        solvers.study("fixed-rod", {"impactor.velocity": "0.5..3:1000000"}, notes=False, workers=2)
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        rows.append(row("memory after a study of 1e6 points", peak / 1e6, "GB", "<= 1"))
    return dict(rows)


def _kept(points: int) -> list[tuple[str, dict[str, object]]]:
    """With a file beside without, and what it takes to find that all is there."""
    with tempfile.TemporaryDirectory() as folder:
        shares = []
        for number in range(of(3, 1)):
            without = run("bronze-rod-steel-ball", points, False, 2)
            shares.append(run("bronze-rod-steel-ball", points, False, 2, out=Path(folder, f"{number}.nc")) / without)
        again = run("bronze-rod-steel-ball", points, False, 2, out=Path(folder, "0.nc"), resume=True)
    found = [row("with a file, over without", sorted(shares)[len(shares) // 2], "", "<= 1.02")]
    return [*found, row("a study that is there, resumed", 1e3 * again, "ms")]
