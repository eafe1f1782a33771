"""Rates and turns: who takes little passes, who takes much waits, and nobody waits for ever."""

import asyncio
from types import SimpleNamespace

import pytest

from app.jobs.fair import HALF_LIFE, MOST, Shares, Stranger
from app.jobs.turns import Rate, Turnstile

from ..socket_client import run


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


def test_shares_fade_and_the_least_served_is_next():
    clock = Clock()
    shares = Shares(clock)
    shares.charge("much", 2.0)
    shares.charge("little", 0.5)
    assert sorted(["much", "little", "new"], key=lambda who: shares.place(who, 0.0)) == ["new", "little", "much"]
    clock.now = HALF_LIFE
    assert shares.used("much") == 1.0
    for number in range(2 * MOST):
        shares.charge(number, 1e-6)
    assert len(shares._used) == MOST


def test_a_stream_of_new_addresses_comes_before_nobody_who_is_in_or_has_waited():
    """Each had used nothing, and came first: answers to all others took up to 12 s."""
    clock = Clock()
    shares = Shares(clock)
    known = Stranger("pages", "known")
    shares.charge("visitor", 0.3)
    shares.charge(known, 0.1)
    for number in range(3 * MOST):
        new = Stranger("pages", f"2001:db8:{number:x}::/48")
        shares.charge(new, 0.004)
        clock.now += 0.004
    fresh = Stranger("pages", "fresh")
    assert shares.place("visitor", 0.0) < shares.place(fresh, 0.0)
    assert shares.place(known, 0.2) < shares.place(fresh, 0.0)


def test_a_rate_gives_its_burst_and_then_so_many_a_second():
    clock = Clock()
    rate = Rate(10.0, 5.0, clock)
    assert [rate.take() for _ in range(5)] == [0.0] * 5
    assert rate.take() == 0.1 and rate.take() == 0.2
    clock.now = 10.0
    assert rate.left == 5.0
    assert [rate.allows() for _ in range(6)] == [True] * 5 + [False]


def test_in_a_round_of_the_loop_so_many_pass_and_the_rest_is_done_between():
    async def main():
        turns, rounds, passed = Turnstile(at_once=3), 0, []

        async def pass_through(who):
            await turns.enter(who)
            passed.append(rounds)

        tasks = [asyncio.ensure_future(pass_through(who)) for who in range(9)]
        while not all(task.done() for task in tasks):
            await asyncio.sleep(0)
            rounds += 1
        assert max(passed.count(each) for each in passed) == 3 and rounds < 12
        await asyncio.sleep(0.01)
        await turns.enter("alone")  # and where nobody waits one passes at once
        assert turns.waiting == 0

    run(main())


def test_what_is_done_is_paid_by_its_own_time_and_not_by_that_of_others(monkeypatch):
    clock = Clock()
    monkeypatch.setattr("app.jobs.turns.time", SimpleNamespace(perf_counter=clock))

    async def main():
        turns, stopped = Turnstile(), asyncio.Event()
        turns._shares = Shares(clock)
        stopped.set()

        async def waits():
            clock.now += 0.02
            asyncio.get_running_loop().call_soon(others)
            await asyncio.sleep(0)
            clock.now += 0.02
            await stopped.wait()
            return "done"

        def others():
            clock.now += 0.4

        async def fails():
            await asyncio.sleep(0)
            raise ValueError("as it must")

        assert await turns.paid("one", waits()) == "done"
        assert turns._shares.used("one") == pytest.approx(0.04)
        with pytest.raises(ValueError, match="as it must"):
            await turns.paid("two", fails())
        stopped.clear()
        task = asyncio.ensure_future(turns.paid("three", waits()))
        for _ in range(5):
            await asyncio.sleep(0)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        assert turns._shares.used("three") == pytest.approx(0.04)

    run(main())


def test_when_time_is_short_who_has_used_least_passes_first():
    async def main():
        turns, order = Turnstile(), []
        turns.charge("flood", 0.2)

        async def pass_through(who):
            await turns.enter(who)
            order.append(who)
            turns.charge(who, 0.01)

        tasks = [asyncio.ensure_future(pass_through("flood")) for _ in range(20)]
        tasks += [asyncio.ensure_future(pass_through(f"honest {k}")) for k in range(5)]
        await asyncio.wait_for(asyncio.gather(*tasks), 10.0)
        assert order[0] == "flood"  # nobody else was there
        assert all(who.startswith("honest") for who in order[1:6]) and len(order) == 25

    run(main())


def test_who_leaves_while_waiting_is_passed_over():
    async def main():
        turns = Turnstile()
        _, gone, stays = (asyncio.ensure_future(turns.enter(who)) for who in ("first", "gone", "stays"))
        await asyncio.sleep(0)
        gone.cancel()
        await asyncio.wait_for(stays, 5.0)
        assert turns.waiting == 0

    run(main())
