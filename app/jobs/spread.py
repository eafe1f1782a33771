"""Points of the map on the host's cluster, where there is one: small parts of each question, in turn among visitors.

All that waits for the cluster is done by a thread of its own, so that the event loop never does. Where the cluster does
not answer, or not in time, the page's own workers do.
"""

import asyncio
import json
import logging
import math
import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Hashable
from contextlib import suppress
from importlib import import_module
from queue import SimpleQueue
from typing import Any

from solvers import SceneError
from solvers.studies.study.cluster import Cluster, cluster_of

from ..views.whatif import SECONDS
from ..views.whatif_parts import Parts
from .answers import Answers
from .cluster_part import found_there, ready
from .fair import Shares
from .loops import of_loop
from .workers import QUICK

LEAST_ROWS = 4  # of a question that is worth the way there
PART_SECONDS = 0.1  # that a part is to take
MOST_ROWS = 32  # of a part
MOST_VISITORS = 1_000  # of whom it is remembered how long a row took
AHEAD = 2  # parts for each worker that are under way, of all visitors together
PATIENCE = 5.0  # s for the first rows; then the page's own workers find them
AGAIN = 30.0  # s until the cluster is tried again, after it was not reached, lost, or too slow for a visitor
LOOK_SECONDS = 1.0  # between two looks whether it is there
CLOSE_SECONDS = 2.5  # for the cluster to be left when the server stops
log = logging.getLogger("strikewave")


class Spread:
    """Of one event loop: who is asked, what is under way there, and what waits for it."""

    def __init__(self):
        self._loop = asyncio.get_running_loop()
        self._address, self._cluster, self._stopped = "", None, False
        self._thread: SimpleQueue[Callable[[], Any] | None] = SimpleQueue()
        self._shares = Shares()
        self._jobs: list[SpreadJob] = []
        self._out: set[Sent] = set()
        self._slow: dict[Hashable, float] = {}  # visitors for whom it was too slow, and until when it is not asked
        self._paces: OrderedDict[Hashable, float] = OrderedDict()  # of visitors, s that a row took last
        self._silent = False  # what is wrong stands in the log

    def connect(self, address: str) -> None:
        """Have this cluster find points from now on, as soon as it answers; until then nothing changes."""
        _hush()
        self._address = address
        threading.Thread(target=self._work, name="cluster", daemon=True).start()
        self._reach()

    def start(self, work: Callable, asked: dict[str, Any], **how: Any) -> Any:
        """As `Answers.start`, for `whatif_data`."""
        parts = self._parts(asked, how)
        if parts is None:
            return of_loop(Answers).start(work, asked, **how)
        job = SpreadJob(self, parts, lambda: of_loop(Answers).start(work, asked, **how), how.get("visitor"))
        job.pace = self._paces.get(job.visitor, math.inf)
        self._jobs.append(job)
        self.fill()
        return job

    def _parts(self, asked: dict[str, Any], how: dict[str, Any]) -> Parts | None:
        visitor = how.get("visitor")
        if self._cluster is None or not self._cluster.threads or not how.get("compiled", True):
            return None
        if self._slow.get(visitor, 0.0) > time.monotonic():
            return None
        with suppress(ValueError):  # which the page's own workers say
            parts = Parts(asked)
            return parts if parts.divides and len(parts.rows) >= LEAST_ROWS else None
        return None

    async def close(self) -> None:
        """Leave the cluster: what was begun here ends, and nothing of it stays elsewhere."""
        self._stopped = True
        for job in list(self._jobs):
            job.answer.cancel()
        if self._address:
            left: asyncio.Future = self._loop.create_future()
            cluster, self._cluster = self._cluster, None
            self.do(lambda: (_close(cluster), self.tell(lambda: left.done() or left.set_result(None))))
            self._thread.put(None)
            await asyncio.wait((left,), timeout=CLOSE_SECONDS)

    # --- the thread ---------------------------------------------------------------------------------------------------

    def do(self, action: Callable[[], Any]) -> None:
        """In the thread, after all that was given to it before."""
        self._thread.put(action)

    def tell(self, action: Callable[[], Any]) -> None:
        """From another thread, in the event loop."""
        with suppress(RuntimeError):  # it has ended
            self._loop.call_soon_threadsafe(action)

    def _work(self) -> None:
        while (action := self._thread.get()) is not None:
            action()

    def _reach(self) -> None:
        def reach() -> None:
            cluster = None
            try:
                cluster = cluster_of(self._address)
                cluster.client.run(ready)
                _ = cluster.workers
            except Exception as error:
                _close(cluster)
                self.tell(lambda why=error: self._not_there(why))
            else:
                self.tell(lambda: self._there(cluster))

        if not self._stopped:
            self.do(reach)

    def _there(self, cluster: Cluster) -> None:
        if self._stopped:
            self.do(lambda: _close(cluster))
            return
        if self._silent:
            log.warning("the cluster %s is there again", self._address)
        self._cluster, self._silent = cluster, False
        self._watch(cluster)

    def _watch(self, cluster: Cluster) -> None:
        """Look now and then whether it is there: of parts that were on their way when it went nothing is heard."""

        def look() -> None:
            try:
                cluster.check_there()
                _ = cluster.workers  # counts its threads anew
            except SceneError as error:
                self.tell(lambda why=error: self._lose(cluster, why))
            else:
                self.tell(self.fill)

        if cluster is self._cluster and not self._stopped:
            self.do(look)
            self._loop.call_later(LOOK_SECONDS, self._watch, cluster)

    def _not_there(self, why: BaseException) -> None:
        if not self._silent:
            log.warning("points of the map are found without the cluster, tried again every %g s (%s)", AGAIN, why)
        self._silent = True
        self._loop.call_later(AGAIN, self._reach)

    # --- turns --------------------------------------------------------------------------------------------------------

    def fill(self) -> None:
        """Send parts as long as there is room, each of who has had least of the cluster lately."""
        now = time.monotonic()
        while self._cluster is not None and len(self._out) < AHEAD * self._cluster.threads:
            able = [job for job in self._jobs if job.wants(now)]
            if not able:
                return
            job = min(able, key=lambda job: (len(job.under_way), *self._shares.place(job.visitor, now - job.asked)))
            start, stop = job.take(self._cluster.threads)
            sent = Sent(self, self._cluster, job, start, job.parts.part(start, stop))
            job.under_way[sent] = stop
            self._out.add(sent)

    def came(self, sent: "Sent", answer: str | None, error: BaseException | None) -> None:
        """What has come of a part."""
        self._out.discard(sent)
        job = sent.job
        stop = job.under_way.pop(sent, None)
        if isinstance(error, SceneError):
            self._lose(sent.cluster, error)
        elif answer is None:
            if stop is not None and not sent.dropped:  # it has ended its worker
                self._leave_out(job)
        else:
            seconds, found = json.loads(answer)
            self._shares.charge(job.visitor, seconds)
            if stop is not None:
                job.found(sent.start, stop, seconds, found)
                self._paces[job.visitor] = job.pace
                self._paces.move_to_end(job.visitor)
                if len(self._paces) > MOST_VISITORS:
                    self._paces.popitem(last=False)
        self.fill()

    def leave(self, job: "SpreadJob") -> None:
        """Nothing of it goes on there."""
        if job in self._jobs:
            self._jobs.remove(job)
        for sent in job.under_way:
            sent.drop()
        job.under_way.clear()
        self.fill()

    def look(self, job: "SpreadJob") -> None:
        """At a job that has not been answered in time."""
        if job in self._jobs and not job.finish():
            self._leave_out(job)

    def _leave_out(self, job: "SpreadJob") -> None:
        now = time.monotonic()
        self._slow = {who: until for who, until in self._slow.items() if until > now} | {job.visitor: now + AGAIN}
        job.finish() or job.by_own()

    def _lose(self, cluster: Cluster, why: BaseException) -> None:
        if cluster is not self._cluster:
            return
        self._cluster = None
        self._out.clear()
        self._not_there(why)
        self.do(lambda: _close(cluster))
        for job in list(self._jobs):
            job.finish() or job.by_own()


def points_started(work: Callable, asked: dict[str, Any], **how: Any) -> Any:
    """Begin a question of points, wherever they are found; as `Answers.start`."""
    return of_loop(Spread).start(work, asked, **how)


def _hush() -> None:
    """Of what Dask logs nothing can be acted on: what is to be known is said here, in a line."""
    import_module("distributed")  # which sets up its loggers
    for name in [name for name in logging.root.manager.loggerDict if name.partition(".")[0] == "distributed"]:
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)


def _close(cluster: Cluster | None) -> None:
    if cluster is not None:
        with suppress(Exception):  # of a cluster that is gone
            cluster.close()


class Sent:
    """A part on its way there and back."""

    def __init__(self, spread: Spread, cluster: Cluster, job: "SpreadJob", start: int, asked: str):
        self._spread, self.cluster, self.job, self.start, self._asked = spread, cluster, job, start, asked
        self._future: Any = None
        self.dropped = False
        spread.do(self._send)

    def _send(self) -> None:
        if self.dropped:
            self._came(None, None)
            return
        try:
            self.cluster.check_there()
            self._future = self.cluster.submit(found_there, self._asked)
        except Exception as error:
            why = error if isinstance(error, SceneError) else SceneError("cluster", self.cluster.address, str(error))
            self._came(None, why)
        else:
            self._future.add_done_callback(self._done)

    def _done(self, future: Any) -> None:
        error = None if future.cancelled() else future.exception()
        self._came(None if future.cancelled() or error else future.result(), error)

    def _came(self, answer: str | None, error: BaseException | None) -> None:
        self._spread.tell(lambda: self._spread.came(self, answer, error))

    def drop(self) -> None:
        """Nobody wants it any more."""
        self.dropped = True
        self._spread.do(lambda: self._future and self._future.cancel())


class SpreadJob:
    """A question on the cluster, as `Job` is one in the page's own processes, which take it over where that fails."""

    def __init__(self, spread: Spread, parts: Parts, own: Callable[[], Any], visitor: Hashable):
        self._spread, self.parts, self._begin_own, self.visitor = spread, parts, own, visitor
        self.answer: asyncio.Future = asyncio.get_running_loop().create_future()
        self.asked, self._begun = time.monotonic(), math.inf
        self.under_way: dict[Sent, int] = {}  # and where each stops
        self._left = [(0, len(parts.rows))]  # spans, the first last
        self._found: dict[int, dict[str, Any]] = {}  # answers by their first row
        self.pace = math.inf  # s that a row takes
        self._own: Any = None
        self._timers = [self.answer.get_loop().call_later(PATIENCE, spread.look, self)]
        self.answer.add_done_callback(lambda _: self._leave())

    @property
    def begun(self) -> float | None:
        return self._own.begun if self._own else self._begun if self._begun < math.inf else None

    @property
    def level(self) -> int:
        return self._own.level if self._own else QUICK

    @property
    def computed(self) -> float:
        return self._own.computed if self._own else 0.0

    def end(self) -> None:
        """With what there is by now."""
        if self._own:
            self._own.end()
        elif not self.finish():
            self.answer.cancel()

    def wants(self, now: float) -> bool:
        """Whether another part is to be sent; once its time is over only the first is, without which is no answer."""
        return bool(self._left) and (now < self._begun + SECONDS or self._left[-1][0] == 0)

    def take(self, workers: int) -> tuple[int, int]:
        """Rows of its next part: few enough for all workers to have some."""
        if self._begun == math.inf:
            self._begun = time.monotonic()
            self._timers.append(self.answer.get_loop().call_later(2.0 * SECONDS, self.finish))
        start, stop = self._left.pop()
        share = math.ceil(sum(b - a for a, b in [*self._left, (start, stop)]) / workers)
        middle = start + max(1, min(share, MOST_ROWS, int(PART_SECONDS / self.pace), stop - start))
        if middle < stop:
            self._left.append((middle, stop))
        return start, middle

    def found(self, start: int, stop: int, seconds: float, answer: dict[str, Any] | None) -> None:
        """A part has come back; rows that it had no time for are left."""
        if answer is None or "rows" not in answer:  # kernels are compiled there
            self.finish() or self.by_own()
            return
        count = len(answer["rows"])
        self._found[start], self.pace = answer, max(seconds / count, 1e-6)
        if start + count < stop:
            self._left.append((start + count, stop))
            self._left.sort(reverse=True)
        now = time.monotonic()
        if now > self._begun + 2.0 * SECONDS or not (self.under_way or self.wants(now)):
            self.finish()

    def finish(self) -> bool:
        """With the rows that are found from the first on, if there are any."""
        if self._own or self.answer.done():
            return self.answer.done()
        answers, row = [], 0
        while row in self._found:
            answers.append(self._found[row])
            row += len(self._found[row]["rows"])
        if answers:
            self.answer.set_result(self.parts.joined(answers))
            self._spread.leave(self)  # at once: its seat is another's
        return bool(answers)

    def by_own(self) -> None:
        """Have the page's own workers find it."""
        if self._own or self.answer.done():
            return
        self._spread.leave(self)
        self._own = self._begin_own()
        self._own.answer.add_done_callback(self._taken)

    def _taken(self, own: asyncio.Future) -> None:
        if self.answer.done():
            if not own.cancelled():
                own.exception()  # seen
        elif own.cancelled():
            self.answer.cancel()
        elif error := own.exception():
            self.answer.set_exception(error)
        else:
            self.answer.set_result(own.result())

    def _leave(self) -> None:
        for timer in self._timers:
            timer.cancel()
        self._spread.leave(self)
        if self._own:
            self._own.answer.cancel()
