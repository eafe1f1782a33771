"""Newest wins, nothing queues, the loop never waits."""

import asyncio
import threading
import time

from app.runner import Runner

from .socket_client import run


def test_while_one_is_solved_only_the_newest_wish_is_kept():
    done, shown, gate = [], [], threading.Event()

    def work(choice):
        gate.wait(5)
        done.append(choice)
        return choice

    async def hurry():
        runner = Runner(work, shown.append, shown.append)
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
        runner = Runner(work, shown.append, refused.append)
        for wish in ("bad value", "bug", "good"):
            await runner.want(wish)

    run(visit())
    assert shown == ["good"]
    assert refused[0] == "speed: got -1; allowed: more"
    assert "secret" not in refused[1]
    assert len(refused) == 2
