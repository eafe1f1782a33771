"""A process that solves, as the server sees it; it is forked from one that has loaded all that it needs."""

import asyncio
import multiprocessing
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing import forkserver
from pathlib import Path
from types import ModuleType
from typing import Any

from solvers.jit.cache import FOLDER

from .worker import serve

BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
PRELOADED = ["app.page.reading", "app.jobs.preload"]  # what reads of strangers, what solves
ALIVE_SECONDS = 1e-3  # [s] of computing, which a process that works has had in a second even on a busy machine
AT_WORK = "RD"  # states of a process that has a processor, waits for one, or for a disk


class Process:
    """A process that solves."""

    def __init__(self, level: int):
        ours, theirs = forks().Pipe()
        self.connection, self.level = ours, level
        self.job: Any = None  # of app.jobs.workers, while it has one
        self.answered = False  # whether it has done any work
        self._timer: asyncio.TimerHandle | None = None
        self._since = 0.0
        self._seen, self._active = 0.0, 0.0  # seconds of computing, and when there were that many
        self._process = forks().Process(target=serve, args=(theirs,), daemon=True)
        with _without_main():
            self._process.start()
        theirs.close()

    def sink(self, level: int, nice: int) -> None:
        """To a level that gets less of the processors: nicer than the server by so much."""
        self.level = level
        if nice:
            own = os.getpriority(os.PRIO_PROCESS, 0)
            with suppress(OSError):  # it has just ended
                os.setpriority(os.PRIO_PROCESS, self._process.pid, own + nice)

    def begin(self) -> None:
        """From now on its computing counts."""
        self._since = self._clock()
        self._seen, self._active = 0.0, time.monotonic()

    @property
    def computed(self) -> float:
        """Seconds of computing since then."""
        return self._clock() - self._since

    def still(self) -> float:
        """Seconds for which it has neither computed nor waited for a processor or a disk, as seen by these calls."""
        now, computed = time.monotonic(), self.computed
        if computed > self._seen + ALIVE_SECONDS or self._state() in AT_WORK:
            self._seen, self._active = computed, now
        return now - self._active

    def renew(self) -> None:
        """Count from now: nobody has looked for a while."""
        self._active = time.monotonic()

    @property
    def stopped(self) -> bool:
        """Whether somebody has stopped it, by a signal or a debugger."""
        return self._state() in ("T", "t")

    def _state(self) -> str:
        if sys.platform != "linux":
            return "R"
        try:
            return Path(f"/proc/{self._process.pid}/stat").read_text().rpartition(")")[2].split()[0]
        except (OSError, IndexError):  # it has just ended, which its reader will see
            return "R"

    def _clock(self) -> float:
        if sys.platform != "linux":
            return time.monotonic()
        try:
            return time.clock_gettime(~self._process.pid << 3 | 2)  # as clock_getcpuclockid() makes it
        except OSError:  # it has just ended
            return self._since

    def watch(self, timer: asyncio.TimerHandle | None) -> None:
        """One timer at a time."""
        if self._timer is not None:
            self._timer.cancel()
        self._timer = timer

    def end(self, died: bool) -> int | None:
        """Kill it, unless it has ended; the exit code as it was before."""
        self.connection.close()
        self._process.join(0.5 if died else 0.0)
        code = self._process.exitcode
        if code is None:
            self._process.kill()
        return code


@contextmanager
def _without_main() -> Iterator[None]:
    """A process that is started meanwhile does not run the script of this one: it has all that it needs, and a script
    that serves would serve once more."""
    main = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


def prepare() -> None:
    """Start the process that workers are forked from, which loads what they need while this one does other things."""
    forks()
    forkserver.ensure_running()


def forks() -> Any:
    """What processes are made by: forked from one that has loaded all they need, and nothing else."""
    context = multiprocessing.get_context("forkserver")
    if not _PREPARED:
        os.environ.setdefault("NUMBA_CACHE_DIR", str(FOLDER))
        for library in BLAS_THREADS:  # one each: there are as many processes as processors
            os.environ.setdefault(library, "1")
        context.set_forkserver_preload(PRELOADED)
        _PREPARED.append(True)
    return context


_PREPARED: list[bool] = []
