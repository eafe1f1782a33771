"""Points on the host's cluster: the same answers, a share for each visitor, nothing left there, and none needed."""

import asyncio
import json
import threading
from concurrent.futures import Future
from contextlib import asynccontextmanager
from types import SimpleNamespace

import pytest

from app.choices.scene_of import own_choices
from app.jobs import spread as spread_room
from app.jobs.loops import forget, of_loop
from app.jobs.spread import AHEAD, LEAST_ROWS, Spread, points_started
from app.views.whatif import POINTS, whatif_data
from solvers import SceneError

from ...patience import SECONDS
from ..socket_client import run

ROWS = 40


def asked(rows=ROWS, scene="xylophone-bar"):
    values = [[0.5 + 0.01 * row] for row in range(rows)]
    return own_choices(scene) | {POINTS: json.dumps({"id": 1, "names": ["mass_ratio"], "rows": values})}


def ask(question, visitor="somebody", **how):
    how = {"visitor": visitor, "level": 0, "seconds": 10.0, "compiled": True, "stoppable": True} | how
    return points_started(whatif_data, question, **how)


async def until(true):
    async with asyncio.timeout(SECONDS):
        while not true():
            await asyncio.sleep(0.01)


@asynccontextmanager
async def connected(address):
    """A server's loop with this cluster."""
    found = of_loop(Spread)
    found.connect(address)
    try:
        await until(lambda: found._cluster or found._silent)
        yield found
    finally:
        await found.close()
        forget(asyncio.get_running_loop())


class Fake:
    """A cluster whose parts come back when the test says so."""

    address, workers, threads = "tcp://fake:1", 2, 2
    check_there, client = staticmethod(lambda: None), SimpleNamespace(run=lambda call: None)

    def __init__(self):
        self.sent, self.closed = [], 0

    def submit(self, work, question):
        self.sent.append((json.loads(question), Future()))
        return self.sent[-1][1]

    def close(self):
        self.closed += 1

    @property
    def under_way(self):
        return [each for each in self.sent if not each[1].done()]

    def rows(self, number):
        return [row[0] for row in json.loads(self.sent[number][0][POINTS])["rows"]]

    def answer(self, number, count=None, seconds=0.001):
        question, future = self.sent[number]
        rows = [[0, row] for row in self.rows(number)[:count]]
        future.set_result(json.dumps([seconds, {"id": 1, "chosen": question["scene"], "rows": rows, "why": {}}]))


@pytest.fixture
def fake(monkeypatch):
    found = Fake()
    monkeypatch.setattr(spread_room, "cluster_of", lambda address: found)
    monkeypatch.setattr(spread_room, "PATIENCE", SECONDS)
    return found


def found_rows(answer):
    return [row[1] for row in json.loads(answer)["rows"]]


# --- what is sent -----------------------------------------------------------------------------------------------------


def test_parts_come_back_in_any_order_and_the_answer_in_the_order_asked(fake, own, monkeypatch):
    monkeypatch.setattr(spread_room, "SECONDS", SECONDS)  # however busy the machine

    async def main():
        async with connected("local:2"):
            job = ask(asked())
            answered = 0
            while not job.answer.done():
                await until(lambda: fake.under_way or job.answer.done())
                assert len(fake.under_way) <= AHEAD * fake.threads
                if fake.under_way:
                    number = fake.sent.index(fake.under_way[-1])
                    fake.answer(number, max(1, len(fake.rows(number)) - 1))  # and the last row had no time
                    answered += 1
            assert found_rows(job.answer.result()) == [0.5 + 0.01 * row for row in range(ROWS)]
            assert 4 < answered < ROWS and own == [] and not of_loop(Spread)._jobs

    run(main())


def test_when_time_is_over_what_is_found_from_the_first_row_on_is_the_answer(fake, own, monkeypatch):
    async def main():
        async with connected("local:2") as spread:
            job = ask(asked())
            await until(lambda: len(fake.sent) == 4)
            for number in (0, 1, 3):
                fake.answer(number)
            await until(lambda: 3 in job._found)
            spread.look(job)
            assert found_rows(await job.answer) == [0.5, 0.51]
            await until(lambda: not fake.under_way)
            assert own == []

    monkeypatch.setattr(spread_room, "SECONDS", SECONDS)
    run(main())


def test_no_visitor_has_more_than_a_share(fake, own, monkeypatch):
    monkeypatch.setattr(spread_room, "SECONDS", SECONDS)

    async def main():
        async with connected("local:2"):
            jobs = [ask(asked(), visitor=number) for number in range(50)]
            await until(lambda: len(fake.sent) == 4)
            for number in range(50):
                fake.answer(number, seconds=1.0)
                await until(lambda: len(fake.sent) == 5 + number)  # noqa: B023
                assert len(fake.under_way) == AHEAD * fake.threads
            begun = [len(job.under_way) + len(job._found) for job in jobs]
            assert min(begun) == 1, "each has had a part before any has had many"
            for job in jobs:
                job.answer.cancel()
            await until(lambda: not fake.under_way)

    run(main())


@pytest.mark.parametrize("give_up", ["end", "cancel"])
def test_what_is_given_up_is_cancelled_there(fake, own, give_up):
    async def main():
        async with connected("local:2") as spread:
            job = ask(asked())
            await until(lambda: len(fake.sent) == 4)
            job.end() if give_up == "end" else job.answer.cancel()
            await until(lambda: all(future.cancelled() for _, future in fake.sent))
            await until(lambda: not spread._out)
            assert job.answer.cancelled() and len(fake.sent) == 4 and own == []

    run(main())


def test_a_question_that_is_stopped_ends_with_what_it_has(fake, own):
    async def main():
        async with connected("local:2"):
            job = ask(asked())
            await until(lambda: len(fake.sent) == 4)
            fake.answer(0)
            await until(lambda: job._found)
            job.end()
            assert found_rows(await job.answer) == [0.5]

    run(main())


@pytest.mark.parametrize(
    ("question", "how"),
    [
        (asked(LEAST_ROWS - 1), {}),
        (asked(), {"compiled": False}),
        (asked() | {POINTS: "nonsense"}, {}),
        (asked() | {POINTS: asked()[POINTS][:-1] + ', "file": true}'}, {}),
    ],
    ids=["few rows", "to be compiled", "nonsense", "file"],
)
def test_what_gains_nothing_there_stays_here(fake, own, question, how):
    async def main():
        async with connected("local:2"):
            assert await ask(question, **how).answer == "of its own"
            assert own == [question] and fake.sent == []

    run(main())


# --- where it fails ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("after", [0, 1])
@pytest.mark.parametrize(
    "error", [SceneError("cluster", "tcp://fake:1", "a scheduler that stays"), ChildProcessError("killed")]
)
def test_a_part_that_fails_is_found_by_the_page_s_own_workers(fake, own, caplog, after, error):
    async def main():
        async with connected("local:2") as spread:
            job = ask(asked())
            await until(lambda: len(fake.sent) == 4)
            if after:
                fake.answer(0)
                await until(lambda: job._found)
            fake.sent[2][1].set_exception(error)
            found = await job.answer
            assert found_rows(found) == [0.5] if after else found == "of its own"
            lost = isinstance(error, SceneError)
            await until(lambda: fake.closed == lost)
            assert (spread._cluster is None) == lost and len(caplog.records) == lost
            assert await ask(asked()).answer == "of its own", "not tried again at once"

    run(main())


def test_what_does_not_come_in_time_is_found_here_and_the_visitor_s_next_too(fake, own, monkeypatch):
    monkeypatch.setattr(spread_room, "PATIENCE", 0.05)

    async def main():
        async with connected("local:2"):
            assert await ask(asked()).answer == "of its own"
            await until(lambda: not fake.under_way)
            sent = len(fake.sent)
            assert await ask(asked()).answer == "of its own" and len(fake.sent) == sent
            other = ask(asked(), visitor="another")
            await until(lambda: len(fake.sent) > sent)
            other.answer.cancel()

    run(main())


def test_kernels_that_are_compiled_there_are_not_waited_for(fake, own):
    async def main():
        async with connected("local:2"):
            job = ask(asked())
            await until(lambda: len(fake.sent) == 4)
            fake.sent[0][1].set_result("[0.001, null]")
            assert await job.answer == "of its own"

    run(main())


def test_one_that_is_not_there_is_said_once_and_tried_again(fake, own, caplog, monkeypatch):
    tries = []

    def reach(address):
        tries.append(address)
        if len(tries) < 4:
            raise SceneError("cluster", address, "the address of a scheduler")
        return fake

    monkeypatch.setattr(spread_room, "cluster_of", reach)
    monkeypatch.setattr(spread_room, "AGAIN", 0.01)

    async def main():
        async with connected("tcp://nowhere:1") as spread:
            assert await ask(asked()).answer == "of its own"
            await until(lambda: spread._cluster is fake)

    run(main())
    first, second = caplog.records
    assert "tcp://nowhere:1" in first.getMessage() and "there again" in second.getMessage() and len(tries) == 4


def test_without_a_cluster_nothing_is_begun(own):
    async def main():
        before = set(threading.enumerate())
        assert await ask(asked()).answer == "of its own"
        assert not {each.name for each in set(threading.enumerate()) - before} & {"cluster"}
        await of_loop(Spread).close()
        forget(asyncio.get_running_loop())

    run(main())
