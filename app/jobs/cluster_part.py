"""On a worker of the host's cluster: some points of the map, found as by a process of the page."""

import json
import os
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

from solvers.jit.compiling import NotCompiled, compiled_only
from solvers.methods.base import never

from ..choices.choices import Choices
from ..views.whatif import EXAMPLE, POINTS, whatif_data

LOOK = 0.2  # s between two looks whether it is still wanted
END_WITHIN = 3.0  # s for a point to end that nobody wants any more
COMPILE_SECONDS = 120.0  # for the kernels of a scene and a point of it
_compiling = threading.Lock()


def ready() -> None:
    """Load what points need, so that the first of them need not wait for it."""
    with suppress(NotCompiled), compiled_only():
        whatif_data(Choices().chosen() | {POINTS: EXAMPLE})


def found_there(asked: str) -> str:
    """JSON of the seconds that it took and the answer; of None while kernels are compiled, as they then are beside."""
    from distributed import get_worker

    begun, asks, answer = time.monotonic(), json.loads(asked), None
    if not _compiling.locked():
        worker = get_worker()
        given_up = _given_up(worker)
        try:
            with _bounded(worker, END_WITHIN, given_up), compiled_only():
                answer = json.loads(whatif_data(asks, given_up))
        except NotCompiled:
            threading.Thread(target=_compile, args=(worker, asks), daemon=True).start()
    return json.dumps([time.monotonic() - begun, answer], allow_nan=False)


def _given_up(worker: Any) -> Callable[[], bool]:
    """Whether the part that runs in this thread has been cancelled, or its client is gone."""
    key = worker.get_current_task()

    def given_up() -> bool:
        task = worker.state.tasks.get(key)
        return task is None or task.state != "executing"

    return given_up


def _compile(worker: Any, asks: dict[str, Any]) -> None:
    if not _compiling.acquire(blocking=False):
        return
    try:
        with _bounded(worker, COMPILE_SECONDS):
            whatif_data(asks, never)
    finally:
        _compiling.release()


@contextmanager
def _bounded(worker: Any, seconds: float, unwanted: Callable[[], bool] = lambda: True) -> Iterator[None]:
    """Work that goes on for so long after it is unwanted ends with its process, where that has nothing else to do and
    its nanny begins another: a kernel cannot be interrupted.
    """
    done = threading.Event()

    def watch() -> None:
        while not done.wait(LOOK):
            if unwanted():
                if not done.wait(seconds) and worker.nanny and worker.state.nthreads == 1:
                    os._exit(1)
                return

    threading.Thread(target=watch, daemon=True).start()
    try:
        yield
    finally:
        done.set()
