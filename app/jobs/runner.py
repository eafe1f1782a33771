"""Solves off the event loop: at most one per visitor in flight, the newest choices win, nothing queues."""

import asyncio
import inspect
import logging
import os
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from solvers.jit import NotCompiled, compiled_only

from .compiler import COMPILER

POOL = ThreadPoolExecutor(max_workers=max(1, min(4, (os.cpu_count() or 1))), thread_name_prefix="solve")
SLOW = ThreadPoolExecutor(max_workers=1, thread_name_prefix="slow")  # for seconds, while sliders need the other one
COMPILING = "Compiling what this needs, once on this machine: some seconds, up to half a minute …"
PATIENCE = 1.0  # s after which a newer wish ends what is under way, where the work can be stopped
log = logging.getLogger("strikewave")


def at_once(work: Callable, *arguments: Any) -> Any:
    """`work(*arguments)` from kernels that are compiled; NotCompiled is raised if one is not."""
    with compiled_only():
        return work(*arguments)


async def said(told: Any) -> None:
    """Wait for who is told something, where that takes time: for the lock of a document."""
    if inspect.isawaitable(told):
        await told


class Runner:
    """Runs `work(choices)` on a pool and hands the newest result to `publish`, or a sentence to `refuse`.

    What is not compiled yet is compiled in another process first; `wait` is told so in a sentence, and when it is over
    by an empty one. Work that is `stoppable` is called `work(choices, cancelled)`, and asks now and then whether it is
    to end with what it has.
    """

    def __init__(
        self,
        work: Callable,
        publish: Callable,
        refuse: Callable,
        pool: ThreadPoolExecutor = POOL,
        wait: Callable = lambda sentence: None,
        stoppable: bool = False,
    ):
        self._work, self._publish, self._refuse, self._pool, self._wait = work, publish, refuse, pool, wait
        self._stoppable, self._stopped, self._begun = stoppable, False, 0.0
        self.current: Any = None  # the choices that are being answered, or were last
        self._wanted: Any = None
        self._busy = False
        self._newer = asyncio.Event()

    def stop(self) -> None:
        """What is under way ends soon, if it can, and what it has found by then is published; nothing follows."""
        self._stopped, self._wanted = True, None
        self._newer.set()

    def _cancelled(self) -> bool:
        return self._stopped or (self._wanted is not None and time.monotonic() - self._begun > PATIENCE)

    async def want(self, choices: Any) -> None:
        """Ask for a result; while one is being made, only the newest wish is remembered."""
        self._wanted = choices
        self._newer.set()
        if self._busy:
            return
        self._busy = True
        try:
            while self._wanted is not None:
                self.current, self._wanted = self._wanted, None
                self._newer.clear()
                self._stopped, self._begun = False, time.monotonic()
                try:
                    result = await self._solved(self.current)
                except ValueError as refusal:  # SceneError: the sentence is for the visitor
                    await said(self._refuse(str(refusal)))
                except Exception:
                    log.exception("a solve failed: %r", self.current)
                    await said(self._refuse("This could not be solved. The choices before it are still shown."))
                else:
                    if result is not None:
                        await said(self._publish(result))
        finally:
            self._busy = False

    async def _solved(self, choices: Any) -> Any:
        """The result, or None if it had to be compiled first and was no longer wanted meanwhile."""
        loop, given = asyncio.get_running_loop(), (choices, self._cancelled) if self._stoppable else (choices,)
        try:
            return await loop.run_in_executor(self._pool, at_once, self._work, *given)
        except NotCompiled:
            await said(self._wait(COMPILING))
        try:
            compiled = asyncio.ensure_future(COMPILER.ready(self._work.__name__, choices))
            newer = asyncio.ensure_future(self._newer.wait())
            await asyncio.wait((compiled, newer), return_when=asyncio.FIRST_COMPLETED)
            compiled.cancel()
            newer.cancel()
            if self._wanted is not None or self._stopped:
                return None
            return await loop.run_in_executor(self._pool, self._work, *given)
        finally:
            await said(self._wait(""))
