"""In place of the processes: the same, on threads, for work that is a function of a test."""

import asyncio
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext

from solvers.jit.compiling import compiled_only

POOL = ThreadPoolExecutor(8)


class ThreadJob:
    level, computed = 0, 0.0

    def __init__(self, work, arguments, compiled, stoppable, report):
        self.begun = time.monotonic()
        self._ended = threading.Event()
        loop = asyncio.get_running_loop()
        more = (self._ended.is_set,) if stoppable else ()
        more += (lambda part: loop.call_soon_threadsafe(report, part),) if report else ()

        def run():
            with compiled_only() if compiled else nullcontext():
                return work(*arguments, *more)

        self.answer = asyncio.ensure_future(loop.run_in_executor(POOL, run))

    def end(self):
        self._ended.set()


def start(work, *arguments, visitor=None, level=0, seconds=0.0, compiled=True, stoppable=False, report=None):
    return ThreadJob(work, arguments, compiled, stoppable, report)
