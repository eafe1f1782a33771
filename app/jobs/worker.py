"""Inside a worker process: one piece of work after the other, until the server ends the process or is gone."""

import gc
import logging
import os
import signal
from collections.abc import Callable
from contextlib import nullcontext, suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, NamedTuple

from solvers.jit.compiling import NotCompiled, compiled_only

from ..text.refusals import reason_of

SOONER = 500  # of 1000, than the server is a worker ended where memory runs out
DONE, PART, REFUSED, FAILED, NOT_COMPILED = "done", "part", "refused", "failed", "not compiled"
log = logging.getLogger("strikewave")


class Task(NamedTuple):
    """What a worker is sent."""

    work: Callable  # a function of a module
    arguments: tuple
    seconds: float  # of computing time that it may take [s]
    compiled: bool  # whether only with kernels that are in the cache
    stoppable: bool  # whether it also takes `cancelled`, a function that says whether to end with what it has
    reporting: bool  # whether it also takes `report`, which takes what it has found so far


def serve(connection: Connection) -> None:
    """Do each task that comes, and answer it by a pair: what happened, and the result or a note.

    A task that takes more than its `seconds` ends the process by SIGPROF, which is all the answer that the server gets.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server, which ends this process
    for number in (signal.SIGTERM, signal.SIGPROF):
        signal.signal(number, signal.SIG_DFL)
    gc.freeze()  # what was loaded before the fork stays shared
    with suppress(OSError):  # no Linux
        score = Path("/proc/self/oom_score_adj")
        score.write_text(str(min(int(score.read_text()) + SOONER, 1000)))
    while True:
        try:
            task = connection.recv()
            if task is None:  # to end what has ended already
                continue
            signal.setitimer(signal.ITIMER_PROF, task.seconds)
            answer = _answer(task, connection)
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            connection.send(answer)
        except (EOFError, OSError):  # the server is gone
            os._exit(0)


def _answer(task: Task, connection: Connection) -> tuple[str, Any]:
    more = ()
    if task.stoppable:
        more += (_cancelled(connection),)
    if task.reporting:
        more += (lambda part: connection.send((PART, part)),)
    try:
        with compiled_only() if task.compiled else nullcontext():
            return DONE, task.work(*task.arguments, *more)
    except NotCompiled as missing:
        return NOT_COMPILED, str(missing)
    except ValueError as refusal:  # what cannot be: for the visitor
        return REFUSED, reason_of(refusal)
    except Exception:
        log.exception("%s failed: %r", task.work.__qualname__, task.arguments)
        return FAILED, task.work.__qualname__


def _cancelled(connection: Connection) -> Callable[[], bool]:
    ended = False

    def cancelled() -> bool:
        nonlocal ended
        if not ended and connection.poll():
            ended = connection.recv() is None
        return ended

    return cancelled
