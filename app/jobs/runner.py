"""One visitor's answers to the newest choices: at most one is under way, older requests are dropped, nothing queues."""

import asyncio
import inspect
import logging
import time
from collections.abc import Callable, Hashable
from typing import Any

from solvers.jit.compiling import NotCompiled, compiled_only

from ..text.refusals import note, reason_of
from .answers import Answers
from .compiler import COMPILER
from .loops import of_loop
from .workers import MAX_SECONDS, QUICK, Lost, level_after

LONG_AFTER = 1.0  # s after which the visitor is informed that it takes long
MIN_RUN_SECONDS = 1.0  # s after which a newer request ends one under way; sooner, and no drag would be answered
END_WITHIN = 3.0  # s in which work that is to end with what it has must do so
CHECK = 0.1  # s between two looks whether what is under way is still wanted
log = logging.getLogger("strikewave")


def at_once(work: Callable, *arguments: Any) -> Any:
    """`work(*arguments)` from kernels that are compiled; NotCompiled is raised if one is not."""
    with compiled_only():
        return work(*arguments)


async def settled(result: Any) -> None:
    """Wait for a report to be delivered, where that takes time: for the lock of a document."""
    if inspect.isawaitable(result):
        await result


class Runner:
    """Has `work(choices)` done by the workers and hands the newest result to `publish`, or a note to `refuse`.

    `wait` gets a note why an answer takes longer, and None when that is over: what is not compiled yet
    is compiled in another process first. `rest` [s]: how long choices must stand before they are asked about.
    Work that is `stoppable` also takes `cancelled`, and ends with what it has when that is set.
    """

    def __init__(
        self,
        work: Callable,
        publish: Callable,
        refuse: Callable,
        wait: Callable = lambda note: None,
        *,
        visitor: Hashable = None,
        seconds: float = MAX_SECONDS,
        rest: float = 0.0,
        stoppable: bool = False,
        start: Callable | None = None,
    ):
        self._work, self._publish, self._refuse, self._wait = work, publish, refuse, wait
        self._visitor, self._seconds, self._rest, self._stoppable = visitor, seconds, rest, stoppable
        self._start = start
        self._level = QUICK  # where the last of these solves ended, as the next of them will
        self.current: Any = None  # the choices that are being answered, or were last
        self.computed = 0.0  # [s] of computing that the newest answer took; none if it was kept
        self._wanted: Any = None
        self._busy = self._stopped = self._left = False
        self._newer = asyncio.Event()

    def stop(self) -> None:
        """What is under way ends soon, and what it has found by then is published, if it can; nothing follows."""
        self._stopped, self._wanted = True, None
        self._newer.set()

    def leave(self) -> None:
        """Nobody waits for an answer any more: what is under way is abandoned."""
        self._left = True
        self.stop()

    async def want(self, choices: Any) -> None:
        """Ask for a result; while one is being made, only the newest request is remembered."""
        self._wanted, self._left = choices, False
        self._newer.set()
        if self._busy:
            return
        self._busy = True
        try:
            while self._wanted is not None:
                await self._at_rest()
                if self._wanted is not None:
                    await self._answer_newest()
        finally:
            self._busy = False

    async def _at_rest(self) -> None:
        asked = None
        while self._rest and asked is not self._wanted:
            asked = self._wanted
            await asyncio.sleep(self._rest)

    async def _answer_newest(self) -> None:
        self.current, self._wanted = self._wanted, None
        self._newer.clear()
        self._stopped = False
        try:
            result = await self._solved(self.current)
        except ValueError as refusal:  # what cannot be: for the visitor
            await settled(self._refuse(reason_of(refusal)))
        except Exception as error:
            log.error("a solve failed: %r", self.current, exc_info=not isinstance(error, Lost))
            await settled(self._refuse(note("serving.not-solved").table()))
        else:
            if result is not None:
                await settled(self._publish(result))

    async def _solved(self, choices: Any) -> Any:
        """The result, or None if it was no longer wanted."""
        try:
            return await self._done(choices)
        except NotCompiled:
            await settled(self._wait(note("serving.compiling").table()))
        try:
            compiled = asyncio.ensure_future(COMPILER.ready(self._work.__name__, choices))
            newer = asyncio.ensure_future(self._newer.wait())
            await asyncio.wait((compiled, newer), return_when=asyncio.FIRST_COMPLETED)
            compiled.cancel()
            newer.cancel()
            if self._wanted is not None or self._stopped:
                return None
            try:
                return await self._done(choices)
            except NotCompiled:  # the other process could not, or could not keep it
                return await self._done(choices, compiled=False)
        finally:
            await settled(self._wait(None))

    async def _done(self, choices: Any, compiled: bool = True) -> Any:
        start = self._start or of_loop(Answers).start
        how = {"visitor": self._visitor, "level": self._level, "seconds": self._seconds, "compiled": compiled}
        asked, ending, informed = time.monotonic(), None, False
        job: Any = start(self._work, choices, **how, stoppable=self._stoppable)
        try:
            while not job.answer.done():
                await asyncio.wait((job.answer,), timeout=CHECK)
                now = time.monotonic()
                if job.answer.done() or not self._unwanted(job, now - asked):
                    pass
                elif self._stoppable and not self._left and ending is None:
                    ending = now
                    job.end()
                elif ending is None or now - ending > END_WITHIN:
                    job.answer.cancel()
                if not informed and compiled and now - asked > LONG_AFTER and not job.answer.done():
                    informed = True
                    await settled(self._wait(note("serving.longer", seconds=self._seconds).table()))
            if job.answer.cancelled():
                return None
            result = job.answer.result()
        finally:
            job.answer.cancel()
            if informed:
                await settled(self._wait(None))
        self._level, self.computed = level_after(job.computed, job.level), job.computed
        return result

    def _unwanted(self, job: Any, seconds: float) -> bool:
        """Whether it has been stopped, or a newer request waits behind something that has not begun, or takes long."""
        newer = self._wanted is not None and (job.begun is None or seconds > MIN_RUN_SECONDS)
        return self._stopped or newer
