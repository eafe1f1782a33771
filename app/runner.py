"""Solves off the event loop: at most one per visitor in flight, the newest choices win, nothing queues."""

import asyncio
import logging
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

POOL = ThreadPoolExecutor(max_workers=max(1, min(4, (os.cpu_count() or 1))), thread_name_prefix="solve")
SLOW = ThreadPoolExecutor(max_workers=1, thread_name_prefix="slow")  # for seconds, while sliders need the other one
log = logging.getLogger("strikewave")


class Runner:
    """Runs `work(choices)` on a pool and hands the newest result to `publish`, or a sentence to `refuse`."""

    def __init__(self, work: Callable, publish: Callable, refuse: Callable, pool: ThreadPoolExecutor = POOL):
        self._work, self._publish, self._refuse, self._pool = work, publish, refuse, pool
        self._wanted: Any = None
        self._busy = False

    async def want(self, choices: Any) -> None:
        """Ask for a result; while one is being made, only the newest wish is remembered."""
        self._wanted = choices
        if self._busy:
            return
        self._busy = True
        try:
            while self._wanted is not None:
                current, self._wanted = self._wanted, None
                try:
                    result = await asyncio.get_running_loop().run_in_executor(self._pool, self._work, current)
                except ValueError as refusal:  # SceneError: the sentence is for the visitor
                    self._refuse(str(refusal))
                except Exception:
                    log.exception("a solve failed: %r", current)
                    self._refuse("This could not be solved. The choices before it are still shown.")
                else:
                    self._publish(result)
        finally:
            self._busy = False
