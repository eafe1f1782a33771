"""Modes are compared with more of them."""

import pytest

import solvers
from solvers.accuracy.reference import modes_beside


@pytest.mark.parametrize("modes, beside", [(5, 40), (40, 80), (50, 100)])
def test_an_impact_by_modes_is_compared_with_more_of_them(modes, beside):
    scene = solvers.load("hammer-on-cantilever")
    shown = solvers.solve(scene, solvers.Modal(modes=modes, steps=2000, estimate=False))
    other = modes_beside(scene, shown)
    assert other is not None and other.method["modes"] == beside > modes
