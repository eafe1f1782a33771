"""Work of many seconds: what is known comes meanwhile, and the visitor may stop it."""

import asyncio
import logging
from collections.abc import Callable, Hashable
from contextlib import suppress
from typing import Any

from solvers.jit.compiling import NotCompiled

from ..text.refusals import note, reason_of
from .answers import KEPT
from .compiler import COMPILER
from .loops import of_loop
from .runner import settled
from .workers import LONG, QUICK, Job, Lost, Workers

MAX_RUN_SECONDS = 60.0  # of computing; what a measurement or a map sets itself is less
log = logging.getLogger("strikewave")


class LongRun:
    """Runs `work(asked, cancelled, report)` and hands what it reports, and its result, to `publish`; one at a time.

    `kernels(asked)` does a little of the same work, so that what is not compiled yet is compiled in another process
    first. `ended` is called when nothing is under way any more. A result that is `kept` is given to all who ask for the
    same, unless it was ended early.
    """

    def __init__(
        self,
        work: Callable,
        kernels: Callable,
        publish: Callable,
        refuse: Callable,
        wait: Callable,
        *,
        visitor: Hashable = None,
        kept: bool = False,
        start: Callable | None = None,
    ):
        self._work, self._kernels, self._publish, self._refuse, self._wait = work, kernels, publish, refuse, wait
        self._visitor, self._kept, self._begin = visitor, kept, start
        self._job: Job | None = None
        self._busy = self._stopped = False

    @property
    def busy(self) -> bool:
        return self._busy

    def stop(self) -> None:
        """What is under way ends soon, and what it has found by then is kept."""
        self._stopped = True
        if self._job is not None:
            self._job.end()

    def leave(self) -> None:
        """Nobody looks on any more: what is under way is abandoned."""
        self._stopped = True
        if self._job is not None:
            self._job.answer.cancel()

    async def start(self, asked: Any, ended: Callable[[], Any]) -> None:
        """Do the work, unless some is under way."""
        if self._busy:
            return
        self._busy, self._stopped = True, False
        try:
            with suppress(asyncio.CancelledError):
                known = KEPT.known(self._work, asked) if self._kept else None
                if known is not None:
                    await settled(self._publish(known))
                else:
                    await self._compiled(asked)
                    await self._run(asked)
        except ValueError as refusal:  # what cannot be: for the visitor
            await settled(self._refuse(reason_of(refusal)))
        except Exception as error:
            log.error("a long run failed: %r", asked, exc_info=not isinstance(error, Lost))
            await settled(self._refuse(note("serving.not-worked-out").table()))
        finally:
            self._busy, self._job = False, None
            await settled(ended())

    async def _compiled(self, asked: Any) -> None:
        try:
            await self._do(self._kernels, asked, level=QUICK)
        except NotCompiled:
            await settled(self._wait(note("serving.compiling").table()))
            try:
                await COMPILER.ready(self._kernels.__name__, asked)
            finally:
                await settled(self._wait(None))

    async def _run(self, asked: Any) -> None:
        parts: asyncio.Queue = asyncio.Queue()
        how = {"level": LONG, "compiled": False, "stoppable": True, "report": parts.put_nowait}
        work = asyncio.ensure_future(self._do(self._work, asked, **how))
        work.add_done_callback(lambda _: parts.put_nowait(None))
        while (part := await parts.get()) is not None:
            await settled(self._publish(part))
        result = await work
        if self._kept and not self._stopped:
            KEPT.keep(self._work, asked, result)
        await settled(self._publish(result))

    async def _do(self, work: Callable, asked: Any, **how: Any) -> Any:
        begin = self._begin or of_loop(Workers).start
        self._job = begin(work, asked, visitor=self._visitor, seconds=MAX_RUN_SECONDS, **how)
        if self._stopped:
            self._job.end()
        return await self._job.answer
