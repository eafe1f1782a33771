"""What several visitors ask for is worked out once: a class that opens one link waits for one solve."""

import asyncio
import json
from collections import OrderedDict
from collections.abc import Callable
from typing import Any

from .loops import of_loop
from .workers import QUICK, Job, Workers

MAX_KEPT = 16_000_000  # bytes of answers; some 200 of the longest


class Wanted:
    """One visitor's request for an answer: as a `Job`, of which there may be one for many."""

    def __init__(self, job: Job | None = None):
        self.answer: asyncio.Future = asyncio.get_running_loop().create_future()
        self._job = job

    @property
    def begun(self) -> float | None:
        return self._job.begun if self._job else None

    @property
    def level(self) -> int:
        return self._job.level if self._job else QUICK

    @property
    def computed(self) -> float:
        return self._job.computed if self._job else 0.0


class Kept:
    """The newest answers; only texts and messages are kept."""

    def __init__(self):
        self._kept: OrderedDict[str, bytes | str] = OrderedDict()
        self._bytes = 0

    def known(self, work: Callable, choices: Any) -> bytes | str | None:
        """The answer, if it is kept."""
        return self._kept.get(_key(work, choices))

    def keep(self, work: Callable, choices: Any, answer: Any) -> None:
        key = _key(work, choices)
        if not isinstance(answer, bytes | str) or key in self._kept:
            return
        self._kept[key] = answer
        self._bytes += len(answer)
        while self._bytes > MAX_KEPT:
            self._bytes -= len(self._kept.popitem(last=False)[1])

    def forget(self, work: Callable) -> None:
        """Drop its answers: they would be others now."""
        for key in [key for key in self._kept if key.startswith(f"{work.__name__} ")]:
            self._bytes -= len(self._kept.pop(key))


KEPT = Kept()


class Answers:
    """Answers that are coming, each for all who wait for it."""

    def __init__(self):
        self._workers = of_loop(Workers)
        self._coming: dict[str, tuple[Job, set[Wanted]]] = {}

    def start(self, work: Callable, choices: Any, **how: Any) -> Wanted | Job:
        """As `Workers.start`; work that can be stopped half-way is each visitor's own."""
        if how.get("stoppable"):
            return self._workers.start(work, choices, **how)
        key = _key(work, choices)
        if (known := KEPT.known(work, choices)) is not None:
            wanted = Wanted()
            wanted.answer.set_result(known)
            return wanted
        if key not in self._coming:
            job = self._workers.start(work, choices, **how)
            self._coming[key] = job, set()
            job.answer.add_done_callback(lambda answer: self._come(key, work, choices, answer))
        job, waiting = self._coming[key]
        wanted = Wanted(job)
        waiting.add(wanted)
        wanted.answer.add_done_callback(lambda _: self._leave(key, wanted))
        return wanted

    def _come(self, key: str, work: Callable, choices: Any, answer: asyncio.Future) -> None:
        _, waiting = self._coming.pop(key)
        if answer.cancelled():
            found = None
        elif (found := answer.exception()) is None:
            KEPT.keep(work, choices, answer.result())
        for wanted in waiting:
            if wanted.answer.done():
                continue
            if answer.cancelled():
                wanted.answer.cancel()
            elif found is not None:
                wanted.answer.set_exception(found)
            else:
                wanted.answer.set_result(answer.result())

    def _leave(self, key: str, wanted: Wanted) -> None:
        """The last who no longer wants it abandons the work."""
        if key in self._coming:
            job, waiting = self._coming[key]
            waiting.discard(wanted)
            if not waiting:
                job.answer.cancel()


def _key(work: Callable, choices: Any) -> str:
    return f"{work.__name__} {json.dumps(choices, sort_keys=True)}"
