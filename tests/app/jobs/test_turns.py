"""Rates and turns: who takes little passes, who takes much waits, and nobody waits for ever."""

import asyncio
import time

from app.jobs.fair import HALF_LIFE, Shares
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
    assert shares.least(["much", "little", "new"]) == "new" and shares.least(["much", "little"]) == "little"
    clock.now = HALF_LIFE
    assert shares.used("much") == 1.0
    for number in range(2_000):
        shares.charge(number, 1e-6)
    assert len(shares._used) < 1_500  # who used nothing worth counting is forgotten


def test_a_rate_gives_its_burst_and_then_so_many_a_second():
    clock = Clock()
    rate = Rate(10.0, 5.0, clock)
    assert [rate.take() for _ in range(5)] == [0.0] * 5
    assert rate.take() == 0.1 and rate.take() == 0.2
    clock.now = 10.0
    assert rate.left == 5.0
    assert [rate.allows() for _ in range(6)] == [True] * 5 + [False]


def test_while_there_is_time_nobody_waits():
    async def main():
        turns = Turnstile()
        begun = time.monotonic()
        for number in range(20):
            await turns.enter(number % 3)
            with turns.pay(number % 3):
                pass
        assert time.monotonic() - begun < 1.0

    run(main())


def test_when_time_is_short_who_has_used_least_passes_first():
    async def main():
        turns, order = Turnstile(share=2.0, burst=0.01), []
        turns.charge("flood", 0.2)

        async def pass_through(who):
            await turns.enter(who)
            order.append(who)
            turns.charge(who, 0.01)

        tasks = [asyncio.ensure_future(pass_through("flood")) for _ in range(20)]
        await asyncio.sleep(0)
        tasks += [asyncio.ensure_future(pass_through(f"honest {k}")) for k in range(5)]
        await asyncio.wait_for(asyncio.gather(*tasks), 10.0)
        assert all(who.startswith("honest") for who in order[:5]) and len(order) == 25

    run(main())


def test_who_leaves_while_waiting_is_passed_over():
    async def main():
        turns = Turnstile(share=2.0, burst=0.01)
        turns.charge("all", 0.1)
        gone, stays = (asyncio.ensure_future(turns.enter(who)) for who in ("gone", "stays"))
        await asyncio.sleep(0)
        gone.cancel()
        await asyncio.wait_for(stays, 5.0)
        assert turns.waiting == 0

    run(main())
