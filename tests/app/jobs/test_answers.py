"""What many ask for is worked out once, and abandoned when the last of them has left."""

import asyncio

import pytest

from app.jobs import answers
from app.jobs.answers import Answers, Kept

from ..socket_client import run


class Jobs:
    """In place of the processes: answers come when the test says so."""

    def __init__(self):
        self.started = []

    def start(self, work, choices, **how):
        job = type("Job", (), {"begun": None, "level": 0, "computed": 0.0})()
        job.answer = asyncio.get_running_loop().create_future()
        self.started.append(job)
        return job


@pytest.fixture
def shared(monkeypatch):
    monkeypatch.setattr(answers, "KEPT", Kept())
    jobs = Jobs()
    monkeypatch.setattr(answers, "of_loop", lambda kind: jobs)
    return jobs


def work(choices):
    raise AssertionError("nobody calls it here")


def test_fifty_who_ask_for_the_same_wait_for_one_solve(shared):
    async def main():
        found = Answers()
        wanted = [found.start(work, {"a": 1}) for _ in range(50)]
        other = found.start(work, {"a": 2})
        assert len(shared.started) == 2
        shared.started[0].answer.set_result(b"frame")
        assert [await each.answer for each in wanted] == [b"frame"] * 50
        assert not other.answer.done()
        assert await found.start(work, {"a": 1}).answer == b"frame" and len(shared.started) == 2  # it is kept
        other.answer.cancel()

    run(main())


def test_the_last_who_leaves_abandons_the_work(shared):
    async def main():
        found = Answers()
        first, second = found.start(work, {"a": 1}), found.start(work, {"a": 1})
        first.answer.cancel()
        await asyncio.sleep(0)
        assert not shared.started[0].answer.cancelled()
        second.answer.cancel()
        await asyncio.sleep(0)
        assert shared.started[0].answer.cancelled()

    run(main())


def test_a_refusal_is_for_all_and_not_kept(shared):
    async def main():
        found = Answers()
        wanted = [found.start(work, {"a": 1}) for _ in range(3)]
        shared.started[0].answer.set_exception(ValueError("speed: got -1"))
        for each in wanted:
            with pytest.raises(ValueError, match="speed"):
                await each.answer
        found.start(work, {"a": 1})
        assert len(shared.started) == 2

    run(main())


def test_the_oldest_answers_make_room(monkeypatch):
    monkeypatch.setattr(answers, "MAX_KEPT", 100)
    kept = Kept()
    for number in range(5):
        kept.keep(work, number, bytes(30))
    assert [kept.known(work, number) is not None for number in range(5)] == [False, False, True, True, True]
    kept.keep(work, 9, {"an": "array"})
    assert kept.known(work, 9) is None
