"""Who has had how much lately: whoever has had least comes next."""

import time
from collections.abc import Callable, Hashable, Iterable
from typing import TypeVar

Key = TypeVar("Key", bound=Hashable)

HALF_LIFE = 5.0  # [s] in which what was had counts half; shorter: a flood is forgotten while it lasts
FORGOTTEN = 1e-4  # [s] of use that is no longer remembered


class Shares:
    """Seconds that each of many has used of something, the older the less they count."""

    def __init__(self, clock: Callable[[], float] = time.monotonic):
        self._clock = clock
        self._used: dict[Hashable, tuple[float, float]] = {}  # seconds, and when they were last added up

    def used(self, key: Hashable) -> float:
        """Seconds that `key` has used, as they count now."""
        seconds, since = self._used.get(key, (0.0, 0.0))
        return seconds * 0.5 ** ((self._clock() - since) / HALF_LIFE) if seconds else 0.0

    def charge(self, key: Hashable, seconds: float) -> None:
        self._used[key] = self.used(key) + seconds, self._clock()
        if len(self._used) > 1_000:
            self._used = {each: value for each, value in self._used.items() if self.used(each) > FORGOTTEN}

    def least(self, keys: Iterable[Key]) -> Key:
        """The one that has used least; of equals the first."""
        return min(keys, key=self.used)
