"""The built-in fixed rod by some numbers of modes, each solved once."""

from functools import cache

from solvers import Modal
from tests.catalog import SCENES


@cache
def fixed_rod(modes: int):
    return Modal(modes=modes).solve(SCENES["fixed-rod"])
