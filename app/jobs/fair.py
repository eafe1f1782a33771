"""Who has had how much lately: whoever has had least comes next."""

import time
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import NamedTuple

HALF_LIFE = 5.0  # [s] in which what was had counts half; shorter: a flood is forgotten while it lasts
MOST = 1_000  # of whom it is remembered, those charged last


class Stranger(NamedTuple):
    """Known by an address alone, which may cost nothing: all who ask the same have together what one visitor has."""

    asks: str
    address: str


class Shares:
    """Seconds that each of many has used of something, the older the less they count."""

    def __init__(self, clock: Callable[[], float] = time.monotonic):
        self._clock = clock
        self._used: OrderedDict[Hashable, tuple[float, float]] = OrderedDict()  # seconds, and when they were added up

    def used(self, key: Hashable) -> float:
        """Seconds that `key` has used, as they count now."""
        seconds, since = self._used.get(key, (0.0, 0.0))
        return seconds * 0.5 ** ((self._clock() - since) / HALF_LIFE) if seconds else 0.0

    def place(self, key: Hashable, waited: float) -> tuple[float, float]:
        """In a line, the least first. A second waited makes up for one used: of strangers the new ones come last."""
        if isinstance(key, Stranger):
            return self.used(key.asks), self.used(key) - waited
        return self.used(key), -waited

    def charge(self, key: Hashable, seconds: float) -> None:
        for each in (key, key.asks) if isinstance(key, Stranger) else (key,):
            self._used[each] = self.used(each) + seconds, self._clock()
            self._used.move_to_end(each)
        while len(self._used) > MOST:
            self._used.popitem(last=False)
