"""Newest wins, nothing queues, the loop never waits."""

import asyncio
import threading
import time

from app.jobs.runner import Runner

from ..socket_client import run
from .threads import start


def test_while_one_is_solved_only_the_newest_wish_is_kept():
    done, shown, gate = [], [], threading.Event()

    def work(choice):
        gate.wait(5)
        done.append(choice)
        return choice

    async def hurry():
        runner = Runner(work, shown.append, shown.append, start=start)
        first = asyncio.create_task(runner.want(0))
        await asyncio.sleep(0.05)
        for k in range(1, 50):
            await runner.want(k)
        begun = time.perf_counter()
        await asyncio.sleep(0)
        assert time.perf_counter() - begun < 1.0  # the loop is free while the solve waits
        gate.set()
        await first

    run(hurry())
    assert done == [0, 49]
    assert shown == [0, 49]


def test_a_failure_becomes_a_sentence_and_the_next_wish_is_served():
    shown, refused = [], []

    def work(choice):
        if choice == "bad value":
            raise ValueError("speed: got -1; allowed: more")
        if choice == "bug":
            raise ZeroDivisionError("secret path /etc")
        return choice

    async def visit():
        runner = Runner(work, shown.append, refused.append, start=start)
        for wish in ("bad value", "bug", "good"):
            await runner.want(wish)

    run(visit())
    assert shown == ["good"]
    assert refused[0] == "speed: got -1; allowed: more"
    assert "secret" not in refused[1]
    assert len(refused) == 2


def test_work_that_can_be_stopped_ends_with_what_it_has():
    started, published = threading.Event(), []

    def work(choices, cancelled):
        started.set()
        while not cancelled():
            time.sleep(0.005)
        return f"some of {choices}"

    async def main():
        runner = Runner(work, published.append, published.append, stoppable=True, start=start)
        asked = asyncio.ensure_future(runner.want("one"))
        while not started.is_set():
            await asyncio.sleep(0.005)
        runner.stop()
        await asked

    run(main())
    assert published == ["some of one"]


def test_a_newer_wish_ends_what_takes_long(monkeypatch):
    monkeypatch.setattr("app.jobs.runner.PATIENCE", 0.05)
    published = []

    def work(choices, cancelled):
        while choices == "endless" and not cancelled():
            time.sleep(0.005)
        return choices

    async def main():
        runner = Runner(work, published.append, published.append, stoppable=True, start=start)
        first = asyncio.ensure_future(runner.want("endless"))
        await asyncio.sleep(0.01)
        await runner.want("newer")
        await first

    run(main())
    assert published == ["endless", "newer"]
