"""Droppers, strikers with ends, spring-masses, moving frames: right within what is told, by a solution of its own."""

import pytest

from tests.random_kinds import FIRST, compared

SEEDS = range(FIRST, FIRST + 8)


@pytest.mark.slow
def test_all_that_meets_along_a_line_is_right_or_says_what_is_not():
    seen = [each for seed in SEEDS for each in compared(seed)]
    assert [each for each in seen if each.silent] == []
    assert {each.method for each in seen} == {"waves", "modal", "fe-modal", "fe-nodal", "quasi-static"}
    assert sum(each.sure for each in seen) > len(seen) / 2  # else nothing would be tested
