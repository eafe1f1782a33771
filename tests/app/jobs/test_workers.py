"""Processes that solve: what is long gives way, what is too long is given up, and nobody is held up."""

import asyncio
import logging
import os
import signal
import time
from contextlib import suppress
from pathlib import Path

import pytest

from app.choices.choices import Choices
from app.jobs.workers import LEVELS, LONG, QUICK, SLOW, GivenUp, Level, Lost, Workers, level_after
from app.messages.solve import solve_frame
from solvers.jit.compiling import NotCompiled

from ..socket_client import run
from . import works


def with_workers(test, levels=LEVELS, seconds=280.0):
    async def main():
        workers = Workers(levels)
        try:
            return await test(workers)
        finally:
            workers.stop()

    return run(main(), seconds)


def alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_results_refusals_and_failures_come_back():
    async def test(workers):
        assert await workers.start(works.double, 21).answer == 42
        with pytest.raises(ValueError, match="value: got 7; allowed: others"):
            await workers.start(works.refuse, 7).answer
        with pytest.raises(Lost):
            await workers.start(works.fail, 0).answer
        with pytest.raises(NotCompiled):
            await workers.start(works.not_compiled, 0).answer
        with pytest.raises(Lost):
            await workers.start(works.end, 0).answer
        assert await workers.start(works.double, 4).answer == 8  # the next process is there

    with_workers(test)


def test_a_frame_is_the_same_as_solved_here():
    choices = Choices(mass_ratio=1.25).chosen()

    async def test(workers):
        return await workers.start(solve_frame, choices, compiled=False).answer

    found, here = with_workers(test), solve_frame(choices)
    arrays = [message[4 + int.from_bytes(message[:4], "little") :] for message in (found, here)]
    assert arrays[0] == arrays[1] and len(arrays[0]) > 10_000  # the header also has how long it took


@pytest.mark.slow
def test_a_long_solve_moves_out_of_the_way_and_others_are_answered_meanwhile():
    levels = (LEVELS[QUICK], LEVELS[SLOW]._replace(seconds=0.5), LEVELS[LONG])

    async def test(workers):
        await workers.start(works.double, 0).answer
        long = [workers.start(works.compute, 1.5, visitor=number) for number in range(4)]
        while any(job.level == QUICK for job in long):  # each goes on until it has had its share of computing
            assert await asyncio.wait_for(workers.start(works.double, 21, visitor="quick").answer, 60.0) == 42
        assert not any(job.answer.done() for job in long)
        for number in range(20):
            assert await asyncio.wait_for(workers.start(works.double, number).answer, 60.0) == 2 * number
        for job in long[1:]:
            job.answer.cancel()
        assert await long[0].answer == 1.5

    with_workers(test, levels)


def test_the_first_work_of_a_process_may_take_longer_and_keeps_the_process_among_the_quick():
    levels = (Level(1, 0.3, 0), Level(1, float("inf"), 0))

    async def test(workers):
        ended = []
        for seconds in (0.5, 0.1, 0.5):
            job = workers.start(works.compute, seconds)
            assert await job.answer == seconds
            ended.append(job.level)
        assert ended == [QUICK, QUICK, SLOW]

    with_workers(test, levels)


def test_what_is_long_yields_the_processors():
    async def test(workers):
        nice = [(await workers.start(works.process, 0, level=level).answer)[1] for level in (QUICK, SLOW, LONG)]
        own = os.getpriority(os.PRIO_PROCESS, 0)
        assert own < nice[0] < nice[1] < nice[2]

    with_workers(test)


@pytest.mark.slow
def test_a_solve_is_given_up_after_its_seconds_of_computing_and_just_below_it_is_not():
    async def test(workers):
        assert await workers.start(works.compute, 0.3, seconds=1.0).answer == 0.3
        with pytest.raises(GivenUp, match=r"given up after 0\.5 s of computing"):
            await workers.start(works.compute, 30.0, seconds=0.5).answer
        assert await workers.start(works.double, 1).answer == 2

    with_workers(test)


def test_what_does_not_go_on_is_ended(monkeypatch, caplog):
    monkeypatch.setattr("app.jobs.workers.MAX_WALL", 2.0)

    async def test(workers):
        with pytest.raises(Lost):
            await workers.start(works.sleep, 60.0, level=LONG, seconds=0.3).answer

    with caplog.at_level(logging.ERROR):
        with_workers(test)
    assert "sleep did not go on" in caplog.text


def test_an_answer_that_is_no_longer_wanted_ends_its_process_at_once():
    async def test(workers):
        pid, _ = await workers.start(works.process, 0, level=SLOW).answer
        job = workers.start(works.compute, 60.0, visitor="who leaves", level=SLOW)
        await begun(job)
        job.answer.cancel()
        for _ in range(400):
            if not alive(pid):
                break
            await asyncio.sleep(0.05)
        assert not alive(pid)

    with_workers(test)


def test_a_visitor_has_one_long_solve_at_a_time_and_who_had_least_comes_next():
    levels = (Level(2, 0.05, 0), Level(1, 60.0, 0), Level(1, float("inf"), 0))

    async def test(workers):
        order = []

        def ask(visitor, seconds):
            job = workers.start(works.sleep, seconds, visitor=visitor, level=SLOW)
            job.answer.add_done_callback(lambda _: order.append(visitor))
            return job.answer

        await asyncio.gather(*(ask("greedy", 0.2) for _ in range(4)), ask("modest", 0.2))
        assert order.index("modest") == 1

    with_workers(test, levels)


def test_while_two_seats_are_free_a_visitor_still_has_one():
    async def test(workers):
        begun = time.monotonic()
        await asyncio.gather(*(workers.start(works.sleep, 0.4, visitor="one", level=SLOW).answer for _ in range(2)))
        assert time.monotonic() - begun > 0.8

    with_workers(test)


def test_work_that_can_be_stopped_reports_and_ends_with_what_it_has():
    async def test(workers):
        reported = []
        job = workers.start(works.until_cancelled, 5, stoppable=True, report=reported.append, level=LONG)
        while not reported:
            await asyncio.sleep(0.01)
        job.end()
        assert await job.answer == "some of 5" and reported == ["begun"]
        assert await workers.start(works.double, 3, level=LONG).answer == 6

    with_workers(test)


async def begun(job):
    """The id of the process that does this work, once there is one."""
    while job.worker is None:
        await asyncio.sleep(0.01)
    return job.worker._process.pid


def test_work_of_a_process_that_is_killed_is_done_by_another():
    async def test(workers):
        job = workers.start(works.compute, 0.5, level=LONG)
        os.kill(await begun(job), signal.SIGKILL)
        assert await asyncio.wait_for(job.answer, 60.0) == 0.5

    with_workers(test)


@pytest.mark.skipif(not Path("/proc/self/oom_score_adj").exists(), reason="no Linux")
def test_where_memory_runs_out_a_worker_is_ended_and_not_the_server():
    own = int(Path("/proc/self/oom_score_adj").read_text())

    async def test(workers):
        assert int(await workers.start(Path.read_text, Path("/proc/self/oom_score_adj")).answer) == min(own + 500, 1000)

    with_workers(test)


def test_work_that_loses_its_process_again_and_again_is_given_up():
    async def test(workers):
        job, killed = workers.start(works.compute, 60.0, level=LONG), set()
        while not job.answer.done():
            if job.worker is not None and (pid := job.worker._process.pid) not in killed:
                killed.add(pid)
                os.kill(pid, signal.SIGKILL)
            await asyncio.sleep(0.01)
        with pytest.raises(Lost):
            await job.answer
        assert len(killed) == 2
        assert await workers.start(works.double, 3, level=LONG).answer == 6

    with_workers(test)


def test_work_that_is_to_end_is_not_begun_again():
    async def test(workers):
        job = workers.start(works.until_cancelled, 5, stoppable=True, report=lambda part: None, level=LONG)
        pid = await begun(job)
        os.kill(pid, signal.SIGSTOP)
        job.end()
        os.kill(pid, signal.SIGKILL)
        with pytest.raises(Lost):
            await asyncio.wait_for(job.answer, 60.0)

    with_workers(test)


@pytest.mark.parametrize("level", [QUICK, LONG])
def test_work_of_processes_that_are_stopped_is_done_by_another(level, monkeypatch, caplog):
    """It waited for minutes: what is stopped uses up no computing time."""
    monkeypatch.setattr("app.jobs.workers.STILL_SECONDS", 1.0)

    async def test(workers):
        job = workers.start(works.compute, 0.5, level=level)
        await begun(job)
        for worker in workers._workers:  # also what has nothing to do yet
            os.kill(worker._process.pid, signal.SIGSTOP)
        assert await asyncio.wait_for(job.answer, 90.0) == 0.5

    with caplog.at_level(logging.ERROR):
        with_workers(test)
    assert "compute did not go on" in caplog.text


@pytest.mark.slow
def test_what_computes_or_waits_for_a_processor_is_not_taken_to_hang(monkeypatch, caplog):
    monkeypatch.setattr("app.jobs.workers.STILL_SECONDS", 0.5)
    monkeypatch.setattr("app.jobs.workers.LOOK_SECONDS", 0.05)

    async def test(workers):
        jobs = [workers.start(works.compute, 1.0, visitor=k, level=LONG) for k in range(3)]
        assert await asyncio.gather(*(job.answer for job in jobs)) == [1.0] * 3
        assert [job.tries for job in jobs] == [1] * 3

    with caplog.at_level(logging.ERROR):
        with_workers(test, (*LEVELS[:LONG], Level(3, float("inf"), 0)))
    assert not caplog.text


def test_nothing_is_left_when_the_server_stops():
    async def test(workers):
        jobs = [workers.start(works.sleep, 60.0, visitor=number) for number in range(6)]
        while len(workers._workers) < 2:
            await asyncio.sleep(0.05)
        pids = [worker._process.pid for worker in workers._workers]
        workers.stop()
        for job in jobs:
            with suppress(asyncio.CancelledError, Lost):
                await asyncio.wait_for(job.answer, 1.0)
        for _ in range(400):
            if not any(map(alive, pids)):
                break
            await asyncio.sleep(0.05)
        assert pids and not any(map(alive, pids))

    with_workers(test)


def test_linear_algebra_has_one_thread_there():
    async def test(workers):
        assert await workers.start(works.blas_threads, 0).answer == "1"

    with_workers(test)


def test_work_on_the_border_of_two_levels_stays_where_it_is():
    border = LEVELS[QUICK].seconds
    assert level_after(0.5 * border, QUICK) == QUICK and level_after(0.5 * border, SLOW) == QUICK
    assert level_after(0.9 * border, QUICK) == QUICK and level_after(0.9 * border, SLOW) == SLOW
    assert level_after(1.1 * border, QUICK) == SLOW and level_after(100.0, QUICK) == LONG
