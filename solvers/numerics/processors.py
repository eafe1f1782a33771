"""Many solves side by side, one on each processor."""

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager

from threadpoolctl import threadpool_limits


@contextmanager
def all_processors(workers: int | None = None) -> Iterator[ThreadPoolExecutor]:
    """Threads, as many as there are processors unless `workers` says otherwise; kernels run side by side on them.

    Linear algebra uses one thread each meanwhile: with its own on top, twice the work is done for the same result. What
    has not begun when this context is left, also by an interrupt, never does.
    """
    with threadpool_limits(1, user_api="blas"):
        pool = ThreadPoolExecutor(workers or os.cpu_count() or 1, thread_name_prefix="solve")
        try:
            yield pool
        finally:
            pool.shutdown(wait=True, cancel_futures=True)
