"""While a slider moves: answers of fewer modes and elements where those chosen take long; at rest, of those chosen.

How long they take is what the newest answer took on this machine: no stored cost comes into it.
"""

import asyncio
import math
import time
from collections.abc import Callable, Coroutine
from typing import Any

import param

from ..choices.choices import Choices
from ..choices.request import DRAFT
from ..messages.encoding import read_header
from .begin import begin

QUICK_SECONDS = 0.015  # longest answer that feels immediate
MOVING_SECONDS = 0.6  # longest pause of a moving slider: from a change, or its answer, to the next
IN_A_ROW = 3  # changes of one choice, of which the last is taken for a movement
REST_SECONDS = 0.3  # without a change, after which it is at rest
SHARES = (0.5, 0.25, 0.125)  # of modes, elements and steps that a draft may keep


def draft_share(seconds: float) -> float:
    """The share of modes, elements and steps with which a solve of so many seconds is quick; 1 if it is as it is.

    Assumes: time grows with each of them at least in proportion.
    """
    if seconds <= QUICK_SECONDS:
        return 1.0
    return next((share for share in SHARES if seconds * share <= QUICK_SECONDS), SHARES[-1])


def solve_seconds(message: bytes) -> float:
    """Time of the solves that a message holds [s]."""
    header = read_header(message)
    solutions = [header.get(name) for name in ("exact", "other", "main", "reference")]
    return sum(each["diagnostics"]["wall_time"] for each in solutions if each)


class Drafts:
    """Says what is to be solved for the choices while a slider moves; a part of `app.page.lab.Lab`.

    No message says that a hand holds a slider: that is seen from one choice that changes again and again.
    """

    # What the laboratory gives
    frame: Any
    answered_at: float
    computed: Callable[[], float]
    chosen: Callable[[], dict[str, Any]]
    solve_wanted: Callable[[dict[str, Any]], Coroutine]

    def watch_moves(self) -> None:
        """Begin with no slider moving."""
        self._slider, self._moved_at, self._in_a_row = "", -math.inf, 0
        self._share = 1.0
        self._coarse = self._resting = False  # whether the last wish was a draft; whether rest is waited for
        self._moves = 0

    def wish(self, *names: str) -> dict[str, Any]:
        """What is to be solved after these choices have changed: as they are, or as a draft."""
        self._moves += 1
        self._coarse = self._moving(names) and self._share < 1.0
        if not self._coarse:
            return self.chosen()
        if not self._resting:
            self._resting = True
            begin(self._refine_at_rest)
        return self.chosen() | {DRAFT: self._share}

    def _moving(self, names: tuple[str, ...]) -> bool:
        """Whether one slider is still moving; sets the share for the next solve from the time of the last."""
        now, name = time.monotonic(), names[0] if len(names) == 1 else ""
        same = name == self._slider and now - max(self._moved_at, self.answered_at) < MOVING_SECONDS
        self._slider, self._moved_at = name, now
        self._in_a_row = self._in_a_row + 1 if same else 1
        if self._in_a_row == 1:
            self._share = 1.0
        enough = self._in_a_row >= IN_A_ROW or self._moves_on(name)
        if enough and self.frame and (share := self._share * draft_share(self._seconds())) < self._share:
            self._share = max(share, SHARES[-1])
        return bool(name) and enough

    def _seconds(self) -> float:
        """Computing time of the newest answer [s]; of a draft, only its solves: coarser ones pack no faster."""
        solves = solve_seconds(self.frame)
        return solves if self._share < 1.0 else max(solves, self.computed())

    def _moves_on(self, name: str) -> bool:
        """Whether this is a number of a mechanism that moves on: even its first two answers may take seconds."""
        number = name in Choices.CHOSEN and isinstance(Choices.param[name], param.Number)
        return number and bool(self.frame) and read_header(self.frame).get("moving") is not None

    async def _refine_at_rest(self) -> None:
        moves = None
        while self._coarse and moves != self._moves:
            moves = self._moves
            await asyncio.sleep(REST_SECONDS)
        self._resting = False
        if self._coarse:
            self._coarse = False
            await self.solve_wanted(self.chosen())
