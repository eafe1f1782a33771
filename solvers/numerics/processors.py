"""Many solves side by side, one on each processor."""

import math
import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from pathlib import Path

from threadpoolctl import threadpool_limits

from ..validation import SceneError, allowed

WORKERS = "IMPACT_WORKERS"  # variable that says how many there are to be
MOST = 1_000
CGROUPS = Path("/sys/fs/cgroup")


@contextmanager
def all_processors(workers: int | None = None) -> Iterator[ThreadPoolExecutor]:
    """Threads, as many as there are processors unless `workers` says otherwise; kernels run side by side on them.

    Linear algebra uses one thread each meanwhile: with its own on top, twice the work is done for the same result. What
    has not begun when this context is left, also by an interrupt, never does.
    """
    with threadpool_limits(1, user_api="blas"):
        pool = ThreadPoolExecutor(workers or processors(), thread_name_prefix="solve")
        try:
            yield pool
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


def processors() -> int:
    """How many processes or threads can work side by side: IMPACT_WORKERS if that is set, else the processors that
    this process may use, of which a container may have a share (`cpu.max` of its control group).

    Raises SceneError for another IMPACT_WORKERS than a whole number from 1 to 1000.
    """
    wanted = os.environ.get(WORKERS, "").strip()
    if wanted:
        if not wanted.isascii() or not wanted.isdecimal() or not 1 <= int(wanted[:9]) <= MOST:
            raise SceneError(WORKERS, wanted, allowed("whole-number", low=1, high=MOST))
        return int(wanted[:9])
    there = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return max(1, math.ceil(min(there, _quota())))


def _quota(groups: Path | None = None, own: Path = Path("/proc/self/cgroup")) -> float:
    """Processors that the control groups (version 2) of this process leave it."""
    root, found = groups or CGROUPS, math.inf
    with suppress(OSError, ValueError, StopIteration):
        lines = own.read_text().splitlines()
        name = next(line.removeprefix("0::/") for line in lines if line.startswith("0::/"))
        for folder in (root / name, *(root / name).parents):
            if not folder.is_relative_to(root):
                break
            with suppress(OSError, ValueError):  # none there, or no quota
                most, period = (folder / "cpu.max").read_text().split()
                found = min(found, float(most) / float(period))
    return found
