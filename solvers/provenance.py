"""What wall times are worth: the machine they were measured on, the state of the library, and a clock that leaves out
what compilers took.
"""

import os
import platform
import threading
import time
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from numba.core import event

from .jit.cache import sources_key


class _Compiling(event.Listener, threading.local):
    """Seconds for which this thread has held the lock of Numba's compiler, or waited for it.

    It is held while a kernel is compiled, and while one is loaded from the cache; then also for what that calls.
    """

    depth, since, seconds = 0, 0.0, 0.0

    def on_start(self, lock):
        if self.depth == 0:
            self.since = time.perf_counter()
        self.depth += 1

    def on_end(self, lock):
        self.depth -= 1
        if self.depth == 0:
            self.seconds += time.perf_counter() - self.since


_compiling = _Compiling()
event.register("numba:compiler_lock", _compiling)


def compiled() -> float:
    """Seconds that this thread has spent until now on compiling kernels, or on loading compiled ones."""
    return _compiling.seconds


def clock() -> float:
    """Seconds, of which only differences count: as they pass for this thread while nothing is compiled."""
    return time.perf_counter() - _compiling.seconds


def machine() -> dict[str, Any]:
    """Processor, cores and Python, as results name them."""
    model = platform.processor() or platform.machine() or "unknown"
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
        model = next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), model)
    except OSError:
        pass  # not Linux: what Python knows must do
    return {"processor": model, "cores": os.cpu_count(), "python": platform.python_version()}


@cache
def release() -> str:
    """Of the library: the number of its release."""
    try:
        return metadata.version("strikewave")
    except metadata.PackageNotFoundError:  # run from its sources, not installed
        return "0"


def version() -> str:
    """Of the library, with the state of its sources: measured once, valid for these only."""
    return f"{release()}+{sources_key()}"
