"""How the time of the event loop is shared: rates, and turns for all who want some of it."""

import asyncio
import time
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager

from .fair import Shares

LOOP_SHARE, LOOP_BURST = 0.8, 0.3  # of the event loop's time for messages and answers, and seconds of it at once
MAX_CHARGED = 0.05  # s that one turn is charged at most: the rest others did while it waited


class Rate:
    """So many a second, and so many at once."""

    def __init__(self, rate: float, burst: float, clock: Callable[[], float] = time.monotonic):
        self._rate, self._burst, self._clock = rate, burst, clock
        self._left, self._since = burst, clock()

    @property
    def left(self) -> float:
        """How many may come now; less than none if more was taken than there was."""
        now = self._clock()
        self._left, self._since = min(self._burst, self._left + self._rate * (now - self._since)), now
        return self._left

    def take(self, amount: float = 1.0) -> float:
        """Take so many, and say how long [s] to wait until they are there."""
        self._left = self.left - amount
        return max(0.0, -self._left / self._rate)

    def allows(self) -> bool:
        """Take one if there is one."""
        if self.left < 1.0:
            return False
        self._left -= 1.0
        return True


class Turnstile:
    """Shares the time of the event loop: while there is enough all pass, else first who has used least lately."""

    def __init__(self, share: float = LOOP_SHARE, burst: float = LOOP_BURST):
        self._rate, self._share = Rate(share, burst), share
        self._shares = Shares()
        self._usual = 0.002  # s that a turn takes, on the average of the last
        self._waiting: list[tuple[Hashable, asyncio.Future]] = []

    async def enter(self, who: Hashable) -> None:
        """Wait for one's turn."""
        if not self._waiting and self._rate.left > 0.0:
            return
        turn = asyncio.get_running_loop().create_future()
        self._waiting.append((who, turn))
        if len(self._waiting) == 1:
            self._wait()
        await turn

    @property
    def waiting(self) -> int:
        return len(self._waiting)

    def note(self, who: Hashable, seconds: float) -> None:
        """Remember that somebody has had time, which is no reason for the others to wait longer."""
        self._shares.charge(who, seconds)

    def charge(self, who: Hashable, seconds: float) -> None:
        """Let somebody pay for what was done for them."""
        self._rate.take(seconds)
        self._shares.charge(who, seconds)

    @contextmanager
    def pay(self, who: Hashable) -> Iterator[None]:
        """What is done in this context is paid by its computing time."""
        begun = time.thread_time()
        try:
            yield
        finally:
            seconds = min(time.thread_time() - begun, MAX_CHARGED)
            self.charge(who, seconds)
            self._usual += 0.1 * (seconds - self._usual)

    def _wait(self) -> None:
        asyncio.get_running_loop().call_later(max(0.001, -self._rate.left / self._share), self._admit)

    def _admit(self) -> None:
        """As many as there is time for, by what a turn usually takes; each then pays what it really took."""
        self._waiting = [each for each in self._waiting if not each[1].done()]
        left = self._rate.left
        while self._waiting and left > 0.0:
            first = min(self._waiting, key=lambda each: self._shares.used(each[0]))
            self._waiting.remove(first)
            first[1].set_result(None)
            left -= self._usual
        if self._waiting:
            self._wait()
