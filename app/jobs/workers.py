"""Processes that solve, so that no solve holds up the page, and none holds up a quicker one for long.

Work begins among the quick. What takes longer than its level allows moves to the next, which gets less of the
processors and has fewer seats; where those are taken it is ended, and begun again once one is free. Of the visitors
who wait, whoever has had least computing time lately comes first. A process can be ended at any time: another is
forked, in some milliseconds, from one that has everything loaded.
"""

import asyncio
import logging
import math
import signal
import time
from collections.abc import Callable, Hashable
from contextlib import suppress
from typing import Any, NamedTuple

from solvers.jit.compiling import NotCompiled
from solvers.numerics.processors import processors

from ..text.refusals import Refused, raised_again
from .fair import Shares
from .processes import Process
from .worker import DONE, NOT_COMPILED, PART, REFUSED, Task

CPUS = processors()
MAX_SECONDS = 10.0  # of computing that an answer to the sliders may take; longer, and others wait too long behind it
WALL_FACTOR = 10.0  # times a level's seconds, by the clock, when work leaves it: it waits for a processor, or hangs
MAX_WALL = 12.0  # times its seconds, by the clock, when it is taken to hang: not running, it uses no computing
COMPILE_SECONDS = 60.0  # of computing besides, where kernels may have to be compiled first
SETTLED = 0.6  # share of a level's seconds below which work comes back to it: else it would be moved down in turns
# Times the seconds of its level for the first work of a process, which loads kernels and scenes for up to 0.1 s too.
# Without it work of 20 ms was moved down with each new process, and none lived long enough to load them.
FIRST = 3.0
STILL_SECONDS = 4.0  # without computing, and without waiting for a processor, after which work is taken to hang
LOOK_SECONDS = 1.0  # between two looks whether it goes on
MAX_TRIES = 2  # of work whose process ended by itself, or did not go on
MAX_FORK_PAUSE = 5.0  # [s] before another is forked in place of one that ended by itself
IDLE_SECONDS = 10.0  # after which a process that is not among the quick, and has nothing to do, is ended
log = logging.getLogger("strikewave")


class Level(NamedTuple):
    seats: int  # processes at once
    seconds: float  # of computing after which work moves to the next level [s]
    # 1 to 19, and the server 0: the larger, the less of a processor that others want too. At 19 it gets a seventieth of
    # what another tenant of the machine gets: two of them, and a second of computing took minutes.
    nice: int


QUICK, SLOW, LONG = range(3)
LEVELS = (
    Level(seats=max(2, CPUS), seconds=0.05, nice=2),
    Level(seats=max(2, CPUS), seconds=3.0, nice=5),
    Level(seats=max(1, CPUS // 2), seconds=math.inf, nice=9),
)


class GivenUp(Refused):
    """Work took more computing time than it may."""

    def __init__(self, seconds: float):
        super().__init__("serving.given-up", seconds=seconds)


class Lost(RuntimeError):
    """Processes ended in the middle of this work, or did not go on with it, as often as it is tried."""


class Job:
    """One piece of work. `answer`: its result, once there is one; to cancel it abandons the work at once."""

    def __init__(self, task: Task, visitor: Hashable, level: int, report: Callable[[Any], None] | None):
        self.task, self.visitor, self.level, self.report = task, visitor, level, report
        self.asked = time.monotonic()
        self.answer: asyncio.Future = asyncio.get_running_loop().create_future()
        self.begun: float | Any = None  # while a process works on it, when that began
        self.computed = 0.0  # [s] of computing, as it was last looked at
        self.worker: Process | Any = None
        self.tries = 0
        self._ending = False

    @property
    def may_be_tried_again(self) -> bool:
        return self.tries < MAX_TRIES and not self._ending

    def end(self) -> None:
        """Have work that is stoppable end soon, with what it has; the answer comes as usual."""
        self._ending = True
        if self.worker is None:
            self.answer.cancel()
        else:
            with suppress(OSError):
                self.worker.connection.send(None)


class Workers:
    """The processes of one event loop."""

    def __init__(self, levels: tuple[Level, ...] = LEVELS):
        self._levels = levels
        self._loop = asyncio.get_running_loop()
        self._workers: list[Process] = []
        self._waiting: list[Job] = []
        self._forking = [0] * len(levels)
        self._shares = Shares()
        self._stopped = False
        self._looking: asyncio.TimerHandle | None = None
        self._looked = 0.0  # when it was last seen whether all go on
        self._deaths = 0  # of processes that ended by themselves, since one answered

    def start(
        self,
        work: Callable,
        *arguments: Any,
        visitor: Hashable = None,
        level: int = QUICK,
        seconds: float = MAX_SECONDS,
        compiled: bool = True,
        stoppable: bool = False,
        report: Callable[[Any], None] | None = None,
    ) -> Job:
        """Have `work`, a function of a module, done with these arguments.

        The answer is its result, or raises ValueError, for the visitor (GivenUp after `seconds` of
        computing), NotCompiled, or Lost.
        """
        if not compiled:
            level, seconds = LONG, seconds + COMPILE_SECONDS
        job = Job(Task(work, arguments, seconds, compiled, stoppable, report is not None), visitor, level, report)
        job.answer.add_done_callback(lambda _: self._leave(job))
        self._waiting.append(job)
        self.fill()
        return job

    def charge(self, visitor: Hashable, seconds: float) -> None:
        """Count so much computing for this visitor, so that others come first."""
        self._shares.charge(visitor, seconds)

    def fill(self) -> None:
        """Give work to every process that has none, and fork those that are missing."""
        for level in range(0 if self._stopped else len(self._levels)):
            idle = [worker for worker in self._workers if worker.level == level and worker.job is None]
            while idle and (job := self._next(level)) is not None:
                self._give(idle.pop(), job)
            while self._seats_left(level) > 0 and self._wants_more(level):
                self._forking[level] += 1
                _keep(self._loop.create_task(self._fork(level)))

    def stop(self) -> None:
        """End all processes, at once."""
        self._stopped = True
        for job in [*self._waiting, *(worker.job for worker in self._workers if worker.job is not None)]:
            job.answer.cancel()
        if self._looking is not None:
            self._looking.cancel()
        for worker in list(self._workers):
            self._end(worker)

    async def close(self) -> None:
        """End all processes, also those that are just being forked."""
        self.stop()
        if forking := [task for task in _TASKS if task.get_loop() is self._loop]:
            await asyncio.wait(forking, timeout=1.0)

    def _able(self, level: int) -> list[Job]:
        """Jobs that wait at this level and may begin; beyond QUICK a visitor has one at a time."""
        busy = self._busy(level)
        return [job for job in self._waiting if job.level == level and not (level > QUICK and job.visitor in busy)]

    def _busy(self, level: int) -> set[Hashable]:
        """Visitors with work running at this level."""
        return {worker.job.visitor for worker in self._workers if worker.job is not None and worker.level == level}

    def _next(self, level: int) -> Job | None:
        now = time.monotonic()
        return min(self._able(level), key=lambda job: self._shares.place(job.visitor, now - job.asked), default=None)

    def _wants_more(self, level: int) -> bool:
        """The quick are always there; of the others there are as many as have work."""
        return level == QUICK or len({job.visitor for job in self._able(level)}) > self._forking[level]

    def _seats_left(self, level: int) -> int:
        taken = sum(worker.level == level for worker in self._workers)
        return self._levels[level].seats - taken - self._forking[level]

    async def _fork(self, level: int) -> None:
        try:
            worker = await self._loop.run_in_executor(None, Process, level)
        except OSError as error:
            log.error("no process could be forked (%s)", error)
            self._loop.call_later(MAX_FORK_PAUSE, self.fill)
            return
        finally:
            self._forking[level] -= 1
        worker.sink(level, self._levels[level].nice)
        self._workers.append(worker)
        if self._stopped:
            self._end(worker)
            return
        self._loop.add_reader(worker.connection.fileno(), self._read, worker)
        self._rest(worker)

    def _give(self, worker: Process, job: Job) -> None:
        self._waiting.remove(job)
        worker.job, job.worker, job.begun, job.computed = job, worker, time.monotonic(), 0.0
        job.tries += 1
        worker.begin()
        if self._looking is None:
            self._look_later()
        with suppress(OSError):  # of a process that has just ended, which its reader will see
            worker.connection.send(job.task)
        self._watch(worker, job)

    def _seconds(self, worker: Process) -> float:
        """Seconds of computing for its work at its level."""
        return self._levels[worker.level].seconds * (1.0 if worker.answered else FIRST)

    def _watch(self, worker: Process, job: Job) -> None:
        seconds = self._seconds(worker)
        if math.isinf(seconds):
            worker.watch(self._loop.call_later(MAX_WALL * job.task.seconds, self._hangs, worker))
        else:
            worker.watch(self._loop.call_later(seconds, self._look, worker))

    def _look(self, worker: Process) -> None:
        """Move work down if it has had the computing of its level; else look again: a busy machine gives it later."""
        seconds = self._seconds(worker)
        left = seconds - worker.computed
        if left <= 0.0 or time.monotonic() - worker.job.begun > WALL_FACTOR * seconds:
            self._move_down(worker)
        else:
            worker.watch(self._loop.call_later(max(left, 0.005), self._look, worker))

    def _move_down(self, worker: Process) -> None:
        """Work that takes longer than its level allows gives up its seat."""
        job, level = worker.job, worker.level + 1
        self._charge(job)
        idle = [other for other in self._workers if other.level == level and other.job is None]
        if job.visitor not in self._busy(level) and (self._seats_left(level) > 0 or idle):
            for other in idle[: 1 - self._seats_left(level)]:
                self._end(other)
            worker.sink(level, self._levels[level].nice)
            job.level = level
            self._watch(worker, job)
        else:
            worker.job = None
            self._end(worker)
            job.level, job.worker, job.begun = level, None, None
            self._waiting.append(job)
        self.fill()

    def _look_later(self) -> None:
        self._looked = time.monotonic()
        self._looking = self._loop.call_later(LOOK_SECONDS, self._look_at_all)

    def _look_at_all(self) -> None:
        """End what has hung for too long: a process that is stopped uses up no computing time."""
        late = time.monotonic() - self._looked > 2.0 * LOOK_SECONDS  # then all stood still, this process too
        self._looking = None
        working = [worker for worker in self._workers if worker.job is not None]
        for worker in working:
            if late:
                worker.renew()
            elif worker.still() > STILL_SECONDS:
                self._hangs(worker)
        if working:
            self._look_later()

    def _hangs(self, worker: Process) -> None:
        log.error("%s did not go on, and its process was ended", worker.job.task.work.__qualname__)
        for idle in [each for each in self._workers if each.job is None and each.stopped]:
            self._end(idle)  # before it is given the work that is tried again
        self._end(worker)
        self.fill()

    def _read(self, worker: Process) -> None:
        """Take what a process says; where it says nothing any more it has ended."""
        try:
            kind, value = worker.connection.recv()
        except (EOFError, OSError):
            self._end(worker, died=True)
            self._deaths += 1
            self._loop.call_later(min(0.01 * 2**self._deaths, MAX_FORK_PAUSE), self.fill)  # backs off
            return
        self._deaths = 0
        job = worker.job
        if job is None:  # its work was abandoned
            return
        if kind == PART:
            if job.report is not None and not job.answer.done():
                job.report(value)
            return
        self._charge(job)
        worker.answered = True
        job.worker = worker.job = None
        if not job.answer.done():
            _settle(job, kind, value)
        self._rest(worker)

    def _rest(self, worker: Process) -> None:
        """A process has nothing to do; beyond QUICK it ends if that lasts."""
        worker.watch(self._loop.call_later(IDLE_SECONDS, self._end, worker) if worker.level > QUICK else None)
        self.fill()

    def _leave(self, job: Job) -> None:
        """Who no longer wants an answer makes room at once."""
        if job in self._waiting:
            self._waiting.remove(job)
        if job.worker is not None:
            self._charge(job)
            worker, job.worker.job, job.worker = job.worker, None, None
            self._end(worker)
            self.fill()

    def _charge(self, job: Job) -> None:
        computed = job.worker.computed
        self._shares.charge(job.visitor, computed - job.computed)
        job.computed = computed

    def _end(self, worker: Process, died: bool = False) -> None:
        """End a process; work that it had is tried again, or gets the reason for an answer."""
        if worker not in self._workers:
            return
        self._workers.remove(worker)
        self._loop.remove_reader(worker.connection.fileno())
        worker.watch(None)
        code = worker.end(died)
        job, worker.job = worker.job, None
        if job is None:
            return
        job.worker = None
        used_up = code == -signal.SIGPROF
        if used_up:
            self._shares.charge(job.visitor, job.task.seconds - job.computed)
        if job.answer.done():
            return
        if used_up:
            job.answer.set_exception(GivenUp(job.task.seconds))
        elif job.may_be_tried_again:
            job.begun = None
            self._waiting.append(job)
        else:
            job.answer.set_exception(Lost(job.task.work.__qualname__))


def level_after(seconds: float, level: int) -> int:
    """Level at which work that took so long begins next: a quicker one only if it would stay there."""
    fits = next(number for number, each in enumerate(LEVELS) if seconds <= each.seconds)
    settles = next(number for number, each in enumerate(LEVELS) if seconds <= SETTLED * each.seconds)
    return settles if fits < level else fits


def _settle(job: Job, kind: str, value: Any) -> None:
    if kind == DONE:
        job.answer.set_result(value)
    else:
        job.answer.set_exception({REFUSED: raised_again, NOT_COMPILED: NotCompiled}.get(kind, Lost)(value))


def _keep(task: asyncio.Task) -> None:
    """Hold a task until it is done: its loop does not."""
    _TASKS.add(task)
    task.add_done_callback(_TASKS.discard)


_TASKS: set[asyncio.Task] = set()
