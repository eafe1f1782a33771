"""What terms of second order in the deflection do to a pendulum in a frame clamped at its pivot, thesis (9.63)."""

import numpy as np
import pytest
from pytest import approx
from scipy.integrate import solve_ivp

import solvers
from solvers.numerics.beams.modes import beam_modes
from tests.catalog import SCENES


def integrated(count: int, wider: bool, shorter: bool) -> float:
    """Largest moment at the pivot of figure 10.11 [N m], by a Runge-Kutta method of eighth order.

    `wider`: a deflection adds to the moment of inertia, as (9.63) has it. `shorter`: it also draws points of the bar
    nearer to the pivot, which takes as much away where the bar just leans; (9.63) leaves that out.
    """
    scene = SCENES["figure-10.11"].replace({"impactor.modes": count})
    bar, stiffness = scene.impactor, scene.contact.stiffness
    modes = beam_modes(bar.line, "cantilever", bar.place, count)
    nodes, weights = np.polynomial.legendre.leggauss(80)
    x, mass = 0.5 * bar.length * (nodes + 1.0), 0.5 * bar.length * bar.line.mass_per_length * weights
    slopes, coupling, at_contact = modes.slopes(x), modes.shapes(x) @ (mass * x), modes.at_contact
    nearer = slopes * (0.5 * mass * (bar.length**2 - x**2)) @ slopes.T
    spread = wider * np.eye(count) - shorter * nearer
    inertia = np.eye(count + 1)
    inertia[0, 0], inertia[0, 1:], inertia[1:, 0] = bar.inertia, coupling, coupling

    def rates(_, state):
        angle, p, spin, rate = state[0], state[1 : count + 1], state[count + 1], state[count + 2 :]
        reach, aside = bar.place * np.cos(angle) - np.sin(angle) * (at_contact @ p), np.cos(angle) * at_contact
        depth = bar.place * np.sin(angle) + aside @ p
        load = -stiffness * max(depth, 0.0) ** 1.5 * np.append(reach, aside)
        load[0] -= 2.0 * spin * (rate @ spread @ p)
        load[1:] += spin**2 * spread @ p - modes.frequencies**2 * p
        now = inertia.copy()
        now[0, 0] += p @ spread @ p
        return np.concatenate(([spin], rate, np.linalg.solve(now, load)))

    start = np.zeros(2 * count + 2)
    start[count + 1] = bar.spin
    instants = np.linspace(0.0, 4e-4, 4001)
    found = solve_ivp(rates, (0.0, 4e-4), start, "DOP853", instants, rtol=1e-9, atol=1e-13)
    return float(np.abs(modes.moments(np.zeros(1))[:, 0] @ found.y[1 : count + 1]).max())


@pytest.mark.parametrize(
    ("count", "alone", "thesis", "whole"), [(5, 3.7578, 3.8899, 3.7150), (10, 0.80487, 0.8814, 0.80469)]
)
def test_fictitious_moment_with_terms_of_second_order(count, alone, thesis, whole):
    """Those of (9.63) are one half, and the other all but cancels it: the moment is nearer to that without any."""
    assert integrated(count, wider=False, shorter=False) == approx(alone, rel=1e-3)
    assert integrated(count, wider=True, shorter=False) == approx(thesis, rel=5e-4)
    assert integrated(count, wider=True, shorter=True) == approx(whole, rel=5e-4)
    found = solvers.solve(SCENES["figure-10.11"].replace({"impactor.modes": count})).diagnostics["pivot_moment"]
    assert found == approx(alone, rel=1e-4) and found == approx(whole, rel=0.012)
    assert abs(found - whole) < 0.35 * abs(thesis - whole)
