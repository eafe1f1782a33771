"""Work of many seconds on the slow pool: what is known comes meanwhile, and the visitor may stop it."""

import asyncio
import logging
import threading
from collections.abc import Callable
from functools import partial
from typing import Any

from solvers.jit import NotCompiled

from .compiler import COMPILER
from .runner import COMPILING, SLOW, at_once, said

log = logging.getLogger("strikewave")


class LongRun:
    """Runs `work(asked, cancelled, tell)` and hands what it tells, and its result, to `publish`; one at a time.

    `kernels(asked)` does a little of the same work, so that what is not compiled yet is compiled in another process
    first. `ended` is called when nothing is under way any more.
    """

    def __init__(self, work: Callable, kernels: Callable, publish: Callable, refuse: Callable, wait: Callable):
        self._work, self._kernels, self._publish, self._refuse, self._wait = work, kernels, publish, refuse, wait
        self._cancelled: threading.Event | None = None

    @property
    def busy(self) -> bool:
        return self._cancelled is not None

    def stop(self) -> None:
        """What is under way ends soon, and what it has found by then is kept."""
        if self._cancelled is not None:
            self._cancelled.set()

    async def start(self, asked: Any, ended: Callable[[], Any]) -> None:
        """Do the work, unless some is under way."""
        if self.busy:
            return
        cancelled = self._cancelled = threading.Event()
        try:
            await self._compiled(asked)
            await self._run(asked, cancelled)
        except ValueError as refusal:  # SceneError: the sentence is for the visitor
            await said(self._refuse(str(refusal)))
        except Exception:
            log.exception("a long run failed: %r", asked)
            await said(self._refuse("This could not be worked out. What is shown is as it was before."))
        finally:
            self._cancelled = None
            await said(ended())

    async def _compiled(self, asked: Any) -> None:
        loop = asyncio.get_running_loop()
        try:
            await loop.run_in_executor(SLOW, at_once, self._kernels, asked)
        except NotCompiled:
            await said(self._wait(COMPILING))
            try:
                await COMPILER.ready(self._kernels.__name__, asked)
            finally:
                await said(self._wait(""))

    async def _run(self, asked: Any, cancelled: threading.Event) -> None:
        loop, told = asyncio.get_running_loop(), asyncio.Queue()
        tell = partial(loop.call_soon_threadsafe, told.put_nowait)
        work = loop.run_in_executor(SLOW, self._work, asked, cancelled.is_set, tell)
        work.add_done_callback(lambda _: told.put_nowait(None))
        while (part := await told.get()) is not None:
            await said(self._publish(part))
        await said(self._publish(await work))
