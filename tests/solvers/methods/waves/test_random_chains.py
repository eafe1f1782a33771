"""Chains of up to 12 rods with any lengths, joints, gaps, laws and ends, over 20 round trips of the longest rod.

A few of the 1000 that `python -m bench --only random` solves.
"""

import pytest

import solvers
from tests.random_chains import random_chain, wrong_with


@pytest.mark.slow
@pytest.mark.parametrize("number", [2, 5, 12, 16, 20, 25])
def test_a_random_chain_is_solved_to_the_end(number):
    scene, duration = random_chain(number)
    assert wrong_with(solvers.solve(scene, duration=duration), scene, duration) == []


def test_a_random_chain_is_the_same_for_the_same_number():
    (scene, duration), (again, as_long) = random_chain(7), random_chain(7)
    assert scene == again
    assert duration == as_long
    assert scene != random_chain(8)[0]
