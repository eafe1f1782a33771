"""Honest pages on bad links are never taken for hasty ones, and who does not wait for answers is."""

import random

import pytest

from app.serving.haste import Haste
from app.serving.limits import UNANSWERED_BURST

PATIENCE = 2.5  # s, as in app/static/wire/changes.js


class Clock:
    now = 1_000.0

    def __call__(self):
        return self.now


def hasty(arrivals, answered=lambda time: 0.0, names=("mass_ratio",)):
    """How many of the changes that arrive at these times are taken for hasty ones."""
    clock = Clock()
    haste, found = Haste(clock), 0
    for time in arrivals:
        clock.now = time
        found += haste.seen(names, answered(time))
    return found


@pytest.mark.parametrize("stall", [0.0, 0.5, 2.0, 4.0, 9.0])
def test_a_page_whose_answers_do_not_come_is_not_hasty_on_a_link_that_stands_still_at_times(stall):
    """All that was sent while it stood still comes at once. Two such bunches after the other closed the socket."""
    sent = [1_000.0 + PATIENCE * k for k in range(200)]
    arrivals = [stall * -(-time // stall) if stall else time for time in sent]
    assert hasty(arrivals) == 0


def test_a_page_that_is_answered_late_is_not_hasty_on_a_link_that_delays_each_message_otherwise():
    chance, arrivals, last = random.Random(1), [], 0.0
    for k in range(500):
        last = max(last, 1_000.0 + PATIENCE * k + 3.0 * chance.random())  # they come in order
        arrivals.append(last)
    assert hasty(arrivals) == 0


def test_who_waits_for_each_answer_may_be_as_quick_as_the_server():
    assert hasty([1_000.0 + 0.01 * k for k in range(1_000)], answered=lambda time: time - 0.005) == 0


def test_who_is_always_one_change_ahead_is_hasty():
    """Which no page is: it sends one change, and the next when that is answered."""
    assert hasty([1_000.0 + 0.5 * k for k in range(100)], answered=lambda time: time - 0.6) > 60


def test_a_flood_is_seen_after_a_few():
    assert hasty([1_000.0 + 0.001 * k for k in range(100)]) == 99 - UNANSWERED_BURST


def test_each_choice_is_counted_on_its_own():
    names = [f"choice {k}" for k in range(50)]
    assert hasty([1_000.0 + PATIENCE * k for k in range(50)], names=names) == 0
