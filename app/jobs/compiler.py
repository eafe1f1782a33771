"""Compile kernels in a process of their own, so that the page answers meanwhile.

Numba compiles under one lock for all threads, for seconds at a time. The server therefore only loads kernels from the
cache; what is not there yet this process compiles, by doing the same work once: first what visitors wait for, then,
while nobody does, all that they usually ask for.
"""

import asyncio
import json
import logging
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import suppress
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from solvers.jit.cache import FOLDER, all_compiled, can_keep
from solvers.jit.shortcuts import shorten
from solvers.methods.multibody.method import Multibody

from ..choices.beam import on_beam
from ..choices.body_value import with_body_value
from ..choices.choices import SCENES, START, Choices
from ..choices.kinds import kind_of
from ..choices.scene_of import own_choices
from ..messages.solve import solve_frame
from ..views.registry import VIEWS, View
from ..views.whatif import EXAMPLE, POINTS, whatif_data

IDLE_SECONDS = 10.0  # after which the process ends if nothing is asked: it has 0.6 GB
HANG_SECONDS = 60.0  # without a word while somebody waits: the longest single compilation takes some 15 s
MOVING = "slider-crank", "four-bar-moves"  # mechanisms that move on, of rigid and of flexible links
log = logging.getLogger("strikewave")


class Compiler:
    """The process, started when it is first needed, and who waits for it."""

    def __init__(self):
        self._process: subprocess.Popen | None = None
        self._heard = 0.0  # when it last gave a sign of life, or somebody began to wait
        self._waiting: dict[str, Future] = {}
        self._lock = threading.Lock()

    def start(self) -> None:
        """Begin with what visitors usually ask for."""
        if can_keep():
            with self._lock:
                self._running()

    def stop(self) -> None:
        """End the process, if there is one."""
        with self._lock:
            if self._process is not None:
                self._process.kill()
                self._process.wait()

    def ask(self, work: str, choices: dict[str, Any]) -> Future:
        """Have the kernels of this work compiled; the answer comes when they are, or when the process has died; at once
        where they cannot be kept, so that who asks compiles them without having waited."""
        if not can_keep():
            answer: Future = Future()
            answer.set_result(None)
            return answer
        line = json.dumps([work, choices])
        with self._lock:
            if line in self._waiting:
                return self._waiting[line]
            process, future = self._running(), Future()
            assert process.stdin is not None
            if not self._waiting:
                self._heard = time.monotonic()
            try:
                process.stdin.write(line + "\n")
                process.stdin.flush()
                self._waiting[line] = future
            except OSError:  # it has just died
                future.set_result(None)
            return future

    async def ready(self, work: str, choices: dict[str, Any]) -> None:
        """Wait for the answer; who no longer wants it may leave. A process that hangs is ended, which answers all."""
        answer = asyncio.wrap_future(self.ask(work, choices))
        while not answer.done():
            await asyncio.wait((answer,), timeout=HANG_SECONDS / 60.0)
            self.end_if_hanging()

    def end_if_hanging(self) -> None:
        """End the process if it has said nothing for too long; the next who asks starts another."""
        with self._lock:
            if self._waiting and self._process is not None and time.monotonic() - self._heard > HANG_SECONDS:
                log.error("the compiling process said nothing for %g s and was ended", HANG_SECONDS)
                self._heard = time.monotonic()
                self._process.kill()

    def _running(self) -> subprocess.Popen:
        if self._process is None or self._process.poll() is not None:
            self._process = subprocess.Popen(
                [sys.executable, "-m", __name__, str(IDLE_SECONDS)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                text=True,
                cwd=Path(__file__).parents[2],
                env=os.environ | {"NUMBA_CACHE_DIR": str(FOLDER)},
            )
            threading.Thread(target=self._listen, args=(self._process,), name="compiler", daemon=True).start()
        return self._process

    def _listen(self, process: subprocess.Popen) -> None:
        assert process.stdout is not None
        for line in process.stdout:
            self._heard = time.monotonic()
            self._answer([line.strip()])
        process.wait()
        with self._lock:
            lost = list(self._waiting) if self._process is process else []
        self._answer(lost)

    def _answer(self, lines: list[str]) -> None:
        with self._lock:
            answered = [self._waiting.pop(line) for line in lines if line in self._waiting]
        for future in answered:
            future.set_result(None)


COMPILER = Compiler()


def works() -> dict[str, Callable]:
    """What the page asks for, by name."""
    asked = (work for view in VIEWS for work in view.compiled)
    return {work.__name__: work for work in (solve_frame, with_body_value, whatif_data, *asked)}


Piece = tuple[str, dict[str, Any]]  # name of a work, and the choices that it is asked with


def usual() -> Iterator[Piece]:
    """What visitors usually ask for, what most of them ask for first."""
    begun, late = [view for view in VIEWS if not (view.late or view.scenes)], [view for view in VIEWS if view.late]
    beam = next(name for name, scene in SCENES.items() if on_beam(scene))
    for scene in (START, beam):
        yield from _pieces(scene, begun)
    yield with_body_value.__name__, Choices().chosen() | {"body_value": "impactor"}
    for scene in (START, beam):
        yield whatif_data.__name__, own_choices(scene) | {POINTS: EXAMPLE}
    rubs = next(name for name, scene in SCENES.items() if scene.friction)
    yield from _pieces(rubs, [])
    laws = [law for law in Choices.param.law.objects if law != Choices().law]
    asked = [solve_frame, *(work for view in VIEWS if view.every_law for work in view.compiled)]
    for work in asked:
        for law in laws:
            yield work.__name__, Choices(law=law, modes=5).chosen()
    for scene in MOVING:
        yield solve_frame.__name__, own_choices(scene) | {"method": Multibody.NAME}
    for view in VIEWS:
        for scene in view.scenes:
            yield from _asked(scene, [view])
    for view in late:
        for work in view.compiled:
            yield work.__name__, Choices().chosen() | view.examples


def _pieces(scene: str, views: list[View]) -> Iterator[Piece]:
    """A scene as it says itself, and all that these views make of it."""
    yield solve_frame.__name__, own_choices(scene)
    yield from _asked(scene, [view for view in views if kind_of(SCENES[scene]).NAME in view.compiled_kinds])


def _asked(scene: str, views: list[View]) -> Iterator[Piece]:
    chosen = own_choices(scene)
    for view in views:
        yield from ((work.__name__, chosen | view.examples) for work in view.compiled)


def compile_usual(between: Callable[[], None] = lambda: None) -> None:
    """Have every usual kernel in the cache; `between` is called before each piece of work."""
    do = works()
    for name, choices in usual():
        between()
        do[name](choices)
    with suppress(OSError):  # on a full disk, where they could not be kept either
        all_compiled().touch()


def compile_at_once(processes: int) -> None:
    """The same by several processes; a law's kernels are one task, so that two of them compile little twice."""
    apart = {work.__name__ for view in VIEWS if view.late or view.every_law or view.scenes for work in view.compiled}
    tasks: dict[str, list[Piece]] = {}
    for name, choices in usual():
        simple = choices.get("law", "rigid") == "rigid"
        alone = name if name in apart else Multibody.NAME if choices["method"] == Multibody.NAME else ""
        tasks.setdefault(alone if simple else choices["law"], []).append((name, choices))
    with ProcessPoolExecutor(processes, get_context("spawn")) as pool:
        list(pool.map(_compile, tasks.values()))
    with suppress(OSError):
        all_compiled().touch()


def _compile(pieces: list[Piece]) -> None:
    shorten()
    do = works()
    for name, choices in pieces:
        do[name](choices)


def main(idle: float) -> None:
    """Answer each line of standard input, a piece of work, by the same line when it is done; end with the input, or
    when nothing has come for `idle` seconds."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server, which ends this process
    shorten()
    requests: queue.SimpleQueue[str] = queue.SimpleQueue()
    threading.Thread(target=_receive, args=(requests,), daemon=True).start()
    do = works()

    def serve(line: str) -> None:
        name, choices = json.loads(line)
        with suppress(Exception):  # who asked for it gets the error where it is solved
            do[name](choices)
        print(line, flush=True)

    def serve_all() -> None:
        print(flush=True)  # a sign of life
        while not requests.empty():
            serve(requests.get())

    if not all_compiled().exists():
        compile_usual(serve_all)
    with suppress(queue.Empty):
        while True:
            serve(requests.get(timeout=idle))
    os._exit(0)  # whoever has just asked is answered as if it had died


def _receive(requests: queue.SimpleQueue) -> None:
    for line in sys.stdin:
        requests.put(line.strip())
    os._exit(0)  # at once, even while it compiles


if __name__ == "__main__":
    main(float(sys.argv[1]))
