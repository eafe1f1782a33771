"""Newest wins, nothing queues, the loop never waits."""

import asyncio
import threading
import time
from types import SimpleNamespace

from app.jobs.runner import Runner
from tests.app.sentences import sentence

from ..socket_client import run
from .threads import start


def test_while_one_is_solved_only_the_newest_wish_is_kept():
    done, shown, begun, gate = [], [], threading.Event(), threading.Event()

    def work(choice):
        begun.set()
        assert gate.wait(60)
        done.append(choice)
        return choice

    async def hurry():
        runner = Runner(work, shown.append, shown.append, start=start)
        first = asyncio.create_task(runner.want(0))
        while not begun.is_set():
            await asyncio.sleep(0.005)
        for k in range(1, 50):
            await runner.want(k)
        await asyncio.sleep(0)
        assert done == []  # the loop is free while the solve waits
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
        for request in ("bad value", "bug", "good"):
            await runner.want(request)

    run(visit())
    assert shown == ["good"]
    assert sentence(refused[0]) == "speed: got -1; allowed: more"
    assert "secret" not in sentence(refused[1])
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
    monkeypatch.setattr("app.jobs.runner.MIN_RUN_SECONDS", 0.05)
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


def test_choices_are_asked_about_when_they_rest(monkeypatch):
    done, pauses = [], []

    async def drag():
        runner = Runner(lambda choice: done.append(choice), done.append, done.append, rest=0.2, start=start)

        async def rest(seconds):
            """Another choice comes meanwhile, nine times."""
            pauses.append(seconds)
            if len(pauses) < 10:
                await runner.want(len(pauses))
            await asyncio.sleep(0)

        monkeypatch.setattr("app.jobs.runner.asyncio", SimpleNamespace(**vars(asyncio) | {"sleep": rest}))
        await runner.want(0)

    run(drag())
    assert done == [9] and pauses == 10 * [0.2]


class Waiting:
    """A job that no process has begun."""

    begun, level, computed = None, 0, 0.0

    def __init__(self):
        self.answer = asyncio.get_running_loop().create_future()


def test_a_newer_wish_takes_the_place_of_one_that_still_waits():
    jobs = []

    async def main():
        def begin(work, choices, **how):
            jobs.append(Waiting())
            return jobs[-1]

        shown = []
        runner = Runner(print, shown.append, shown.append, start=begin)
        first = asyncio.ensure_future(runner.want("old"))
        while not jobs:
            await asyncio.sleep(0.005)
        await runner.want("new")
        while len(jobs) < 2:
            await asyncio.sleep(0.02)
        jobs[1].answer.set_result("answer to the new")
        await first
        assert jobs[0].answer.cancelled() and shown == ["answer to the new"]

    run(main(), 60.0)


def test_what_nobody_waits_for_is_abandoned_and_who_comes_back_is_answered():
    jobs, shown = [], []

    async def main():
        def begin(work, choices, **how):
            jobs.append(Waiting())
            jobs[-1].begun = time.monotonic()
            return jobs[-1]

        runner = Runner(print, shown.append, shown.append, start=begin)
        first = asyncio.ensure_future(runner.want("one"))
        while not jobs:
            await asyncio.sleep(0.005)
        runner.leave()
        await asyncio.wait_for(first, 5.0)
        assert jobs[0].answer.cancelled() and shown == []
        again = asyncio.ensure_future(runner.want("two"))
        while len(jobs) < 2:
            await asyncio.sleep(0.005)
        jobs[1].answer.set_result("two is answered")
        await again

    run(main(), 60.0)
    assert shown == ["two is answered"]


def test_who_waits_long_sees_how_long_at_most(monkeypatch):
    monkeypatch.setattr("app.jobs.runner.LONG_AFTER", 0.1)
    reported = []

    async def main():
        runner = Runner(
            lambda choice: time.sleep(0.5), reported.append, reported.append, reported.append, seconds=7.0, start=start
        )
        await runner.want("slow")

    run(main())
    assert "given up after 7 s of computing" in sentence(reported[0]) and reported[-1] is None
