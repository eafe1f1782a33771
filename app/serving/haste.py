"""Whether a page waits for its answers: it sets a choice again when it has one, or after 2.5 s without."""

import time
from collections.abc import Callable, Iterable

from ..jobs.turns import Rate
from .limits import UNANSWERED_BURST, UNANSWERED_RATE


class Haste:
    """Of one socket. What a slow link has held up, and delivers at once, is no haste: it was sent in good time."""

    def __init__(self, clock: Callable[[], float] = time.monotonic):
        self._clock = clock
        self._set: dict[str, float] = {}  # when each choice was set last
        self._again: dict[str, Rate] = {}  # of each, how often it may be set without an answer

    def seen(self, names: Iterable[str], answered: float) -> int:
        """How many of these choices, set now, are set more often than a page would; the last answer came then."""
        hasty, now = 0, self._clock()
        for name in names:
            if answered < self._set.get(name, answered):
                again = self._again.setdefault(name, Rate(UNANSWERED_RATE, UNANSWERED_BURST, self._clock))
                hasty += not again.allows()
            self._set[name] = now
        return hasty
