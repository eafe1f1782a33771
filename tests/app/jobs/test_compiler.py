"""Kernels are compiled in another process; the page waits for them with a word, and for nothing else."""

import asyncio
import signal
import threading
import time
from dataclasses import replace
from functools import wraps

import pytest
from playwright.sync_api import expect

from app.choices.choices import Choices
from app.jobs import compiler as compiler_module
from app.jobs import runner
from app.jobs.answers import Answers
from app.jobs.compiler import Compiler, usual, works
from app.jobs.runner import Runner
from app.messages.solve import solve_frame
from app.page import lab, panels
from app.serving import server as page_server
from app.views import mass_ratios
from solvers.jit import cache
from solvers.jit.cache import all_compiled
from solvers.jit.compiling import NotCompiled

from ...patience import SECONDS
from ..conftest import Page
from ..servers import free_port
from ..socket_client import run
from .threads import start

IN_SPACE = Choices(scene="brick-off-centre").chosen()  # which needs no kernel


@pytest.fixture
def compiler(tmp_path, monkeypatch):
    """One with a cache of its own, where nothing usual is left to do."""
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    monkeypatch.setattr(compiler_module, "FOLDER", tmp_path)
    all_compiled().touch()
    compiler = Compiler()
    yield compiler
    compiler.stop()


@pytest.mark.slow
def test_who_asks_twice_is_answered_once_and_a_refusal_is_an_answer(compiler):
    first, second = (compiler.ask("solve_frame", IN_SPACE) for _ in range(2))
    assert first is second
    first.result(SECONDS)
    compiler.ask("solve_frame", {**IN_SPACE, "speed": -1.0}).result(SECONDS)


@pytest.mark.slow
def test_if_the_process_dies_nobody_waits_and_the_next_one_is_served(compiler):
    compiler.ask("solve_frame", IN_SPACE).result(SECONDS)
    compiler._process.kill()
    compiler.ask("solve_frame", Choices().chosen()).result(SECONDS)
    compiler._process.wait(SECONDS)
    compiler.ask("solve_frame", IN_SPACE).result(SECONDS)
    assert compiler._process.poll() is None


@pytest.mark.slow
def test_it_ends_when_nothing_is_asked_and_is_started_again(compiler, monkeypatch):
    """It kept 638 MB for ever."""
    monkeypatch.setattr(compiler_module, "IDLE_SECONDS", 0.5)
    compiler.ask("solve_frame", IN_SPACE).result(SECONDS)
    first = compiler._process
    assert first.wait(SECONDS) == 0
    compiler.ask("solve_frame", IN_SPACE).result(SECONDS)
    assert compiler._process is not first


def test_where_nothing_can_be_kept_nobody_waits_for_it(compiler, monkeypatch):
    """Cache and temporary folder full: it compiled for minutes what was lost at once, and then the worker did."""

    def full(**_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(cache.tempfile, "TemporaryFile", full)
    compiler.start()
    assert compiler.ask("solve_frame", IN_SPACE).done() and compiler._process is None
    monkeypatch.undo()
    assert cache.can_keep()


def test_everything_that_can_be_opened_is_compiled_ahead():
    page = lab.Lab()
    runners = [page._runner, *page._runners.values()]
    kernels = {run._kernels.__name__ for run in page._long.values()}
    assert {runner._work.__name__ for runner in runners} | kernels == set(works())
    asked = list(usual())
    assert asked[0] == ("solve_frame", Choices().chosen())
    assert {name for name, _ in asked} == set(works())
    for name in ("solve_frame", "methods_table"):
        assert {choices["law"] for work, choices in asked if work == name} == set(Choices.param.law.objects)


class Gate:
    """In place of the compiler: what is not compiled is, once the gate is open."""

    def __init__(self, *names: str):
        self.missing, self.opened, self.asked = set(names), threading.Event(), []

    async def ready(self, work, choices):
        self.asked.append(work)
        while not self.opened.is_set():
            await asyncio.sleep(0.01)
        self.missing.discard(work)

    def guard(self, work):
        @wraps(work)
        def guarded(*given):
            if work.__name__ in self.missing:
                raise NotCompiled(work.__name__)
            return work(*given)

        return guarded


def test_newer_choices_do_not_wait_for_what_older_ones_need(monkeypatch):
    gate, shown, reported = Gate(), [], []
    monkeypatch.setattr(runner, "COMPILER", gate)

    def work(choice):
        if choice == "slow law" and not gate.opened.is_set():
            raise NotCompiled(choice)
        return choice

    async def visit():
        visitor = Runner(work, shown.append, shown.append, wait=reported.append, start=start)
        first = asyncio.create_task(visitor.want("slow law"))
        while not reported:
            await asyncio.sleep(0.01)
        assert [note["code"] for note in reported] == ["serving.compiling"]
        await visitor.want("quick law")
        await first
        assert shown == ["quick law"] and reported[1:] == [None]
        gate.opened.set()
        await visitor.want("slow law")

    run(visit())
    assert shown == ["quick law", "slow law"]


@pytest.fixture
def gated_page(browser, monkeypatch):
    """Open the page of a server that has not compiled the works of these names."""
    stop = []

    def open_one(query: str, *names: str) -> tuple[Page, Gate]:
        gate, port, ready = Gate(*names), free_port(), threading.Event()
        monkeypatch.setattr(runner, "COMPILER", gate)
        monkeypatch.setattr(Answers, "start", lambda self, *given, **how: start(*given, **how))

        failed = []

        def serve():
            try:
                asyncio.set_event_loop(asyncio.new_event_loop())
                server = page_server.build(port, "127.0.0.1", [])
                monkeypatch.setattr(lab, "solve_frame", gate.guard(solve_frame))  # after the server's own first page
                guarded = [replace(view, work=gate.guard(view.work)) if view.work else view for view in panels.VIEWS]
                monkeypatch.setattr(panels, "VIEWS", guarded)
                server.start()
                stop.append(lambda: server.io_loop.add_callback(server.io_loop.stop))
            except Exception as error:
                failed.append(error)
                raise
            finally:
                ready.set()
            server.io_loop.start()

        threading.Thread(target=serve, daemon=True).start()
        assert ready.wait(SECONDS) and not failed  # a first compilation
        page = Page(browser, f"127.0.0.1:{port}", query, drawn="solve_frame" not in names)
        stop.append(page.context.close)
        return page, gate

    yield open_one
    for end in reversed(stop):
        end()


@pytest.mark.slow
@pytest.mark.parametrize(
    "button, work, there",
    [
        ("All mass ratios", "ratios_data", "() => strikewave.page.model.ratios"),
        ("Energy over time", "energy_data", "() => strikewave.page.model.energy"),
        ("Compare methods", "methods_table", "() => strikewave.page.model.methods"),
    ],
)
def test_a_view_that_must_be_compiled_says_so_at_once_and_then_appears(gated_page, button, work, there):
    mass_ratios.mass_ratio_data.cache_clear()
    page, gate = gated_page("?layout=laboratory", work)
    sign = page.tab.locator(".waiting")
    expect(sign).to_be_hidden()
    page.analysis(button)
    expect(sign).to_be_visible()
    expect(sign).to_contain_text("Compiling what this needs")
    expect(sign).to_be_in_viewport()
    before = page.evaluate("() => strikewave.frames")
    page.evaluate("() => strikewave.page.send('speed', 2.5)")  # the sliders go on meanwhile
    page.wait("before => strikewave.frames > before", before)
    expect(sign).to_be_visible()
    gate.opened.set()
    page.wait(there, timeout=120_000)
    expect(sign).to_be_hidden()
    assert set(gate.asked) == {work}


@pytest.mark.slow
def test_a_page_whose_first_scene_must_be_compiled_opens_with_a_word(gated_page):
    page, gate = gated_page("?law=linear", "solve_frame")
    sign = page.tab.locator(".waiting")
    expect(sign).to_contain_text("Compiling what this needs")
    assert gate.asked == ["solve_frame"]  # for which the page has not waited: the gate is closed
    gate.opened.set()
    page.wait("() => window.strikewave?.frames > 0", timeout=60_000)
    assert page.header("chosen")["law"] == "linear"
    expect(sign).to_be_hidden()
    assert page.errors == []


@pytest.mark.slow
def test_an_answer_that_takes_long_is_announced(gated_page):
    page, gate = gated_page("")
    gate.missing.add("solve_frame")
    page.evaluate("() => strikewave.page.send('law', 'linear')")
    sign = page.tab.locator(".waiting")
    expect(sign).to_contain_text("Solving")
    expect(sign).to_contain_text("Compiling what this needs")
    gate.opened.set()
    page.wait("() => strikewave.page.frame.chosen.law === 'linear'", timeout=60_000)
    expect(sign).to_be_hidden()


@pytest.mark.slow
def test_a_process_that_hangs_is_replaced_and_nobody_waits_without_end(compiler, monkeypatch, caplog):
    compiler.ask("solve_frame", IN_SPACE).result(SECONDS)
    hanging = compiler._process
    hanging.send_signal(signal.SIGSTOP)
    monkeypatch.setattr("app.jobs.compiler.HANG_SECONDS", 1.5)

    async def wait():
        begun = time.monotonic()
        await compiler.ready("solve_frame", {**IN_SPACE, "speed": 2.0})
        return time.monotonic() - begun

    assert run(wait(), 60.0) > 1.0
    assert hanging.wait(30) == -signal.SIGKILL and "was ended" in caplog.text
    monkeypatch.setattr("app.jobs.compiler.HANG_SECONDS", 60.0)
    compiler.ask("solve_frame", IN_SPACE).result(SECONDS)  # the next one is served by another
    assert compiler._process is not hanging


@pytest.mark.slow
def test_one_that_is_busy_but_says_so_is_left_alone(compiler, monkeypatch):
    compiler.ask("solve_frame", IN_SPACE).result(SECONDS)
    monkeypatch.setattr("app.jobs.compiler.HANG_SECONDS", 5.0)
    compiler.end_if_hanging()  # nobody waits
    assert compiler._process.poll() is None
