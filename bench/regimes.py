"""Maps of stability, and the sweeps and plans of regimes."""

import multiprocessing
import os
import resource
import time
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import solvers
from solvers import plan, regime_map, stability

from .measure_regimes import ROD_AXES, models_row
from .size import of, some
from .timing import median, row

SCENES = 10_000


def measure() -> dict[str, object]:
    scene = solvers.load("fixed-rod")
    grid = of((40, 41), (4, 5))
    found = stability(scene, grid=grid)
    worst = max(each.worst_energy_error for each in found.maps.values() if each.integrator == "modal")
    times, cores = some(ROD_AXES[1], 2), of(os.cpu_count() or 1, 1)
    tasks = [("fixed-rod", "hertz", ratio, times) for ratio in np.geomspace(0.02, 500.0, of(12, 2))]
    with ProcessPoolExecutor(cores, mp_context=multiprocessing.get_context("spawn")) as pool:
        list(pool.map(models_row, tasks[:cores]))  # imports and kernels
        begun = time.perf_counter()
        list(pool.map(models_row, tasks))
        seconds = (time.perf_counter() - begun) / (len(tasks) * times.size) * SCENES
    largest = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024.0
    return dict(
        [
            row(
                "stability map, 40 x 41, six integrators, 20 modes",
                median(lambda: stability(scene, grid=grid), 3),
                "s",
                "<= 5",
            ),
            row("its energy error, kernel of modal, every step and stiffness", worst, "", "<= 1e-10"),
            row("its failures, kernel of modal", found.maps["modal"].failures, "", "0"),
            row("regime sweep, 10 000 scenes, at the pace of 600", seconds, "s", "<= 60"),
            row("memory of its largest process", largest, "MB"),
            row("plan of a scene", 1e3 * median(lambda: plan(scene)), "ms"),
            row("map of a family with its contours", 1e3 * median(lambda: regime_map("peak-force", "free-rod")), "ms"),
        ]
    )
