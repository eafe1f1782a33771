"""How the time of the event loop is shared: rates, and turns for all who want some of it."""

import asyncio
import time
from collections.abc import Callable, Coroutine, Generator, Hashable, Iterator
from contextlib import contextmanager
from typing import Any, Generic, TypeVar

from .fair import Shares

Result = TypeVar("Result")


class Rate:
    """`rate` a second, and `burst` at once."""

    def __init__(self, rate: float, burst: float, clock: Callable[[], float] = time.monotonic):
        self._rate, self._burst, self._clock = rate, burst, clock
        self._left, self._since = burst, clock()

    @property
    def left(self) -> float:
        """How many may come now; negative if more were taken than there were."""
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


class _Timed(Generic[Result]):
    """Awaits a coroutine and adds up the time of the thread that its own steps take."""

    def __init__(self, doing: Coroutine[Any, Any, Result]):
        self._doing, self.seconds = doing, 0.0

    def __await__(self) -> Generator[Any, Any, Result]:
        step: Any = self._doing.send
        value: Any = None
        while True:
            begun = time.perf_counter()
            try:
                waits_for = step(value)
            except StopIteration as end:
                return end.value
            finally:
                self.seconds += time.perf_counter() - begun
            try:
                step, value = self._doing.send, (yield waits_for)
            except BaseException as error:  # it is cancelled, or what it waits for failed
                step, value = self._doing.throw, error


class Turnstile:
    """Shares the time of the event loop: `at_once` pass in each round, whoever has used least lately first.

    Between two rounds the loop does all else that is ready, so that nobody waits for more than a few turns of others,
    and none of the loop's time is left unused while somebody waits.
    """

    def __init__(self, at_once: int = 1):
        self._at_once = self._free = at_once
        self._shares = Shares()
        self._waiting: list[tuple[Hashable, asyncio.Future, float]] = []  # and since when
        self._next_round = False  # whether it is under way

    async def enter(self, who: Hashable) -> None:
        """Wait for one's turn."""
        loop = asyncio.get_running_loop()
        if not self._next_round:
            self._next_round = True
            loop.call_soon(self._begin_round)
        if self._free and not self._waiting:
            self._free -= 1
            return
        turn = loop.create_future()
        self._waiting.append((who, turn, time.monotonic()))
        await turn

    @property
    def waiting(self) -> int:
        return len(self._waiting)

    def waiting_of(self, who: Hashable) -> int:
        return sum(each[0] == who for each in self._waiting)

    def charge(self, who: Hashable, seconds: float) -> None:
        """Remember that somebody has had so much time."""
        self._shares.charge(who, seconds)

    @contextmanager
    def pay(self, who: Hashable) -> Iterator[None]:
        """Charge `who` for the time that the body of this context takes, which must not wait for anything."""
        begun = time.perf_counter()
        try:
            yield
        finally:
            self.charge(who, time.perf_counter() - begun)

    async def paid(self, who: Hashable, doing: Coroutine[Any, Any, Result]) -> Result:
        """Await a coroutine; charge `who` for its own time, not for what others do as it waits."""
        timed = _Timed(doing)
        try:
            return await timed
        finally:
            self.charge(who, timed.seconds)

    def _begin_round(self) -> None:
        self._waiting = [each for each in self._waiting if not each[1].done()]
        self._free = self._at_once
        self._next_round = bool(self._waiting)
        if not self._waiting:
            return
        now = time.monotonic()
        for _ in range(min(self._free, len(self._waiting))):
            first = min(self._waiting, key=lambda each: self._shares.place(each[0], now - each[2]))
            self._waiting.remove(first)
            first[1].set_result(None)
            self._free -= 1
        asyncio.get_running_loop().call_soon(self._begin_round)
