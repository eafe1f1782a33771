"""Histories and fields of the exact waves: jumps, ends, derivatives and integrals of one another."""

import math

import numpy as np
import pytest
from pytest import approx

from solvers import Waves
from tests.catalog import RIGID, ROD, SIGMA0_AREA, SUPPORTS, T, contact_table, struck_rod

ROUNDING = 1e-12  # a few hundred operations of 1e-16 each


def test_the_force_jumps_when_the_first_front_returns():
    times, forces = Waves().solve(struck_rod(1.0, "fixed")).motion.force_history()
    assert np.all(np.diff(times) >= 0.0)
    at_return = forces[np.abs(times - T) < 1e-12 * T] / SIGMA0_AREA
    # (4.19), (4.20): e^-2 just before, 2 + e^-2 just after
    assert at_return == approx([math.exp(-2.0), 2.0 + math.exp(-2.0)], abs=ROUNDING)
    at_touch = forces[np.abs(times / T - 2.124623234942172) < 1e-12] / SIGMA0_AREA
    assert at_touch == approx([0.0, 0.30507543511924173], abs=ROUNDING)
    assert forces[times == 0.0] / SIGMA0_AREA == approx([0.0, 1.0], abs=ROUNDING)


def test_before_and_after_a_jump():
    motion = Waves().solve(struck_rod(1.0, "fixed")).motion
    assert motion.force(np.array([T]), after=False)[0] == approx(math.exp(-2.0) * SIGMA0_AREA, rel=ROUNDING)
    assert motion.force(np.array([T]))[0] == approx((2.0 + math.exp(-2.0)) * SIGMA0_AREA, rel=ROUNDING)


FIELD_CASES = [
    pytest.param(struck_rod(beta, support, contact), id=f"{name}-{support}-{beta}")
    for support in SUPPORTS
    for beta in (0.6, 1.0)
    for name, contact in (("rigid", RIGID), ("hertz", contact_table("hertz")))
]


def off_the_fronts(solution, t, x):
    """Where neither the outgoing nor the returning wave is near an event or the return of one (times in T)."""
    events = np.array([[c.start, c.end] for c in solution.contacts]).ravel() / T
    fronts = (events[:, None] + np.arange(-1, 8)).ravel()
    place = 0.5 * x / ROD.length
    ways = np.stack([t[:, None] - place, t[:, None] + place - 1.0])
    return np.abs(ways[..., None] - fronts).min(axis=(0, 3)) > 2e-3


@pytest.mark.parametrize("scene", FIELD_CASES)
def test_fields_meet_the_ends(scene):
    solution = Waves(tolerance=1e-11).solve(scene)
    motion, t = solution.motion, np.random.default_rng(1).uniform(0.0, solution.duration, 300)
    ends = np.array([0.0, ROD.length])
    stress, velocity, displacement = (f(t, ends) for f in (motion.stress, motion.velocity, motion.displacement))
    assert stress.shape == velocity.shape == displacement.shape == (300, 2)
    unit = SIGMA0_AREA / ROD.area
    if scene.target.fixed:
        assert velocity[:, 1] == approx(np.zeros(300), abs=ROUNDING)
        assert displacement[:, 1] == approx(np.zeros(300), abs=ROUNDING * T)
    else:
        assert stress[:, 1] == approx(np.zeros(300), abs=ROUNDING * unit)
    assert stress[:, 0] == approx(motion.force(t) / ROD.area, abs=ROUNDING * unit)
    assert velocity[:, 0] == approx(motion.end_velocity(t), abs=ROUNDING)
    assert displacement[:, 0] == approx(motion.end_position(t), abs=ROUNDING * T)


@pytest.mark.parametrize("scene", FIELD_CASES)
def test_velocity_and_stress_are_derivatives_of_the_displacement(scene):
    solution = Waves(tolerance=1e-11).solve(scene)
    motion, rng = solution.motion, np.random.default_rng(2)
    h = 2.5e-4  # of T and of 2 L: central differences, error h^2 / 6 times third derivatives of less than 100
    t, x = rng.uniform(h, solution.duration / T - h, 60), rng.uniform(0.01, 0.99, 40) * ROD.length
    away = off_the_fronts(solution, t, x)
    assert 0.5 < away.mean() < 1.0
    step, width = h * T, h * 2.0 * ROD.length
    by_time = (motion.displacement(t * T + step, x) - motion.displacement(t * T - step, x)) / (2.0 * step)
    assert np.abs(by_time - motion.velocity(t * T, x))[away].max() < 1e-6
    by_place = (motion.displacement(t * T, x + width) - motion.displacement(t * T, x - width)) / (2.0 * width)
    strain_unit = 1.0 / ROD.wave_speed
    stress = motion.stress(t * T, x) / ROD.material.young
    assert np.abs(by_place + stress)[away].max() < 1e-6 * strain_unit


@pytest.mark.parametrize("scene", FIELD_CASES)
def test_positions_are_integrals_of_velocities_and_impulse_of_force(scene):
    solution = Waves(tolerance=1e-11).solve(scene)
    motion = solution.motion
    edges = np.unique(np.concatenate([[0.0, solution.duration], motion.force_history()[0]]))
    edges = edges[edges <= solution.duration]
    edges = np.unique(np.concatenate([edges[:-1] + k / 4 * np.diff(edges) for k in range(4)] + [edges[-1:]]))
    nodes, weights = np.polynomial.legendre.leggauss(6)
    times = edges[:-1, None] + 0.5 * np.diff(edges)[:, None] * (1.0 + nodes)
    weigh = 0.5 * np.diff(edges)[:, None] * weights

    def integral(history):
        return (weigh * history(times.ravel()).reshape(times.shape)).sum()

    end = np.array([solution.duration])
    # Gauss on 800 pieces per T; where F starts as t^1.5 that leaves 800^-2.5 * 0.05 = 3e-9
    tolerance = ROUNDING if scene.contact.NAME == "rigid" else 3e-9
    assert integral(motion.force) == approx(motion.impulse(end)[0], rel=tolerance)
    assert integral(motion.impactor_velocity) == approx(motion.impactor_position(end)[0], abs=tolerance * T)
    assert integral(motion.end_velocity) == approx(motion.end_position(end)[0], abs=tolerance * T)


def test_the_rod_as_a_whole_moves_at_the_mean_of_its_velocities():
    motion, rng = Waves().solve(struck_rod(1.0, "free")).motion, np.random.default_rng(3)
    for t in rng.uniform(0.1, 1.5, 10):
        # the two fronts cut the rod into pieces on which Gauss with 20 points is exact to rounding
        cuts = {0.0, 1.0} | {abs((2.0 * (t - n) + 1.0) % 2.0 - 1.0) for n in range(3)}
        mean = 0.0
        nodes, weights = np.polynomial.legendre.leggauss(20)
        for low, high in zip(sorted(cuts)[:-1], sorted(cuts)[1:], strict=True):
            x = low + 0.5 * (high - low) * (1.0 + nodes)
            mean += 0.5 * (high - low) * weights @ motion.velocity(np.array([t * T]), x * ROD.length)[0]
        assert mean == approx(motion.rigid_velocity(np.array([t * T]))[0], abs=ROUNDING)
