"""Who solves the points of a study: a crew, of which any process may be killed, such as those of this machine."""

import multiprocessing
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from typing import Any, Protocol

from threadpoolctl import threadpool_limits

from ...text.notes import Note, Severity
from .design import Design
from .parts import InPieces, Receipt
from .work import Part, Span, Work, crashed, joined

SECONDS = 0.5  # that a part is to take
LARGEST = 20_000  # points of a part
GROWTH = 8  # from a part to the next, at most
AHEAD = 2  # parts for each worker that are under way
LOOK = 0.2  # s between looks at whether it is cancelled
PARENT = 1.0  # s between looks at whether there still is one


class Crew(Protocol):
    """Processes that solve parts, wherever they are."""

    @property
    def broken(self) -> tuple[type[BaseException], ...]:
        """What a part raises whose process has ended."""
        ...

    @property
    def workers(self) -> int:
        """How many parts are solved side by side."""
        ...

    def submit(self, work: Callable[..., Any], rows: Any) -> "Future[Any]":
        """Begin one part: of `work`, or whatever is called with `rows`, which another process can load."""
        ...

    def renew(self) -> None:
        """After some have ended: others in their place, and nothing under way."""
        ...

    def alone(self, work: Work, rows: list) -> Part | None:
        """One part while nothing else is under way; None if its process ends before it is done."""
        ...

    def close(self) -> None:
        """Nothing is solved any more, nor is there anybody who would."""
        ...


class Processes:
    """As many as are asked for; those that come after some have ended are new ones."""

    broken = (BrokenProcessPool,)

    def __init__(self, workers: int):
        self.workers = workers
        self.pool: Executor = self._new(workers)

    def _new(self, workers: int) -> Executor:
        # A copy of this process is there at once, and asks nothing of the script that calls.
        context = multiprocessing.get_context("fork" if sys.platform == "linux" else None)
        return ProcessPoolExecutor(workers, context, _begin, (os.getpid(),))

    def submit(self, work: Callable[..., Any], rows: Any) -> "Future[Any]":
        """Begin one part."""
        return self.pool.submit(work, rows)

    def renew(self) -> None:
        """Others in place of those that have ended."""
        self.pool.shutdown(wait=False, cancel_futures=True)
        self.pool = self._new(self.workers)

    def alone(self, work: Work, rows: list) -> Part | None:
        """In a process of its own; None if that ends before it is done."""
        with self._new(1) as pool:
            try:
                return pool.submit(work, rows).result()
            except BrokenProcessPool:
                return None

    def close(self) -> None:
        self.pool.shutdown(wait=True, cancel_futures=True)


class Here:
    """In this process, where it may have no others: as one of a pool has not."""

    broken: tuple[type[BaseException], ...] = ()
    workers = 1

    def submit(self, work: Callable[..., Any], rows: Any) -> "Future[Any]":
        """It is done at once."""
        done: Future[Any] = Future()
        done.set_result(work(rows))
        return done

    def renew(self) -> None:
        """None has ended."""

    def alone(self, work: Work, rows: list) -> Part | None:
        return work(rows)

    def close(self) -> None:
        """None is there."""


def crew_of(workers: int) -> Crew:
    """Processes, unless this one may have none."""
    return Here() if multiprocessing.current_process().daemon else Processes(workers)


def _begin(parent: int) -> None:
    """Of a worker: interrupts are heard by the one that began it, and without that one there is nothing to do."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threadpool_limits(1, user_api="blas")

    def look() -> None:
        while os.getppid() == parent:
            time.sleep(PARENT)
        os._exit(1)

    threading.Thread(target=look, daemon=True).start()


class Spans:
    """What is left to do, in pieces of about the size that is asked for, cut as `form` says."""

    def __init__(self, left: Iterable[Span], form: InPieces | None = None):
        self.left, self.form = list(left)[::-1], form or InPieces()

    def take(self, size: int) -> Span | None:
        """The next, of so many points as it may have."""
        if not self.left:
            return None
        start, stop = self.left.pop()
        end = self.form.end_of(start, size)
        if stop > end:
            self.left.append((end, stop))
            stop = end
        return start, stop

    def give_back(self, span: Span) -> None:
        """It is taken next."""
        self.left.append(span)


def solved(
    work: Work, design: Design, left: Iterable[Span], crew: Crew, cancelled: Callable[[], bool], form: InPieces
) -> Iterator[tuple[Span, Part | Receipt]]:
    """Each part as it is done. The first is one point, alone: what must be compiled is compiled once.

    Once it is cancelled, what has not begun is not solved, nor what a cluster can leave off.
    """
    spans, size, running = Spans(left, form), 1, {}
    most = 1
    while True:
        while len(running) < most and not cancelled():
            span = spans.take(size)
            if span is None:
                break
            running[crew.submit(*form.task(work, design, span))] = span
        if cancelled():
            running = {future: span for future, span in running.items() if not future.cancel()}
        if not running:
            return
        done, _ = wait(running, LOOK, FIRST_COMPLETED)
        for future in done:
            try:
                part = future.result()
            except crew.broken:
                suspects = [span for future, span in running.items() if _ended(future, crew)]
                for span in set(running.values()).difference(suspects):
                    spans.give_back(span)
                running = {}
                crew.renew()
                for span in suspects:
                    yield span, with_care(work, design.rows(*span), crew)
                break
            span, most = running.pop(future), AHEAD * crew.workers
            size = max(1, min(int(SECONDS * part.size / max(part.seconds, 1e-6)), GROWTH * part.size, LARGEST))
            yield span, part


def _ended(future: "Future[Part]", crew: Crew) -> bool:
    """Whether its process has, as far as is known."""
    return future.done() and not future.cancelled() and isinstance(future.exception(), crew.broken)


def with_care(work: Work, rows: list, crew: Crew) -> Part:
    """A part of which a process may have ended: smaller and smaller, until the point is known at which it does."""
    part = crew.alone(work, rows)
    if part is not None:
        return part
    if len(rows) == 1:
        return crashed(work.figures, str(Note("refusals.crashed", Severity.REFUSAL)))
    middle = len(rows) // 2
    return joined([with_care(work, half, crew) for half in (rows[:middle], rows[middle:])])
