"""A sweep of 10 000 scenes as it is, on all cores: only if asked for, python -m bench --only regime-sweep."""

import multiprocessing
import os
import resource
import time
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from .measure_regimes import ROD_AXES, models_row
from .size import of, some
from .timing import row

FEW, MANY = 1_000, 10_000
LITTLE = 2, 4  # scenes of a small run, at two times


def measured_row(task: tuple) -> tuple[int, float]:
    """Of one mass ratio: how many scenes, and the most memory that its process has held so far [MB]."""
    return models_row(task).shape[0], resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def sweep(scenes: int) -> tuple[float, float]:
    """Seconds of a sweep of so many on all cores, kernels loaded, and the memory of its largest process [MB]."""
    times = some(ROD_AXES[1], 2)
    tasks = [("fixed-rod", "hertz", ratio, times) for ratio in np.geomspace(0.02, 500.0, scenes // times.size)]
    cores = of(os.cpu_count() or 1, 1)
    with ProcessPoolExecutor(cores, mp_context=multiprocessing.get_context("spawn")) as pool:
        list(pool.map(measured_row, tasks[: 2 * cores]))
        begun = time.perf_counter()
        done = list(pool.map(measured_row, tasks))
        seconds = time.perf_counter() - begun
    assert sum(count for count, _ in done) == scenes
    return seconds, max(memory for _, memory in done)


def measure() -> dict[str, object]:
    fewer, more = of((FEW, MANY), LITTLE)
    (_, few), (seconds, many) = sweep(fewer), sweep(more)
    return dict(
        [
            row(f"regime sweep, {more} scenes, {os.cpu_count()} cores", seconds, "s", "<= 60"),
            row(f"memory of its largest process after {fewer} scenes", few, "MB"),
            row(f"the same after {more}", many, "MB", "flat"),
        ]
    )
