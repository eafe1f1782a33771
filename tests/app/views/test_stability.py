"""What the page says of maps of stability."""

import numpy as np

from app.views.stability import _one
from solvers.stability.maps import Map


def test_runs_that_fail_and_those_that_chatter_are_counted_apart():
    ending = np.array([[0, 0, 1, 2, 3, 3]])
    numbers = np.ones(ending.shape)
    each = Map("modal", "", "", ending, 0.1 * numbers, np.array([[0, 4, 1, 5, 6, 0]]), numbers, numbers, numbers, None)
    told = _one(each)
    assert (told["failures"], told["chattering"], told["count"]) == (3, 2, 6)
