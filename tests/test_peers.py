"""Comparison with other programs: what can be checked where they are not installed, and their models where they are."""

import importlib.util
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

import solvers
from bench import peer_mechanisms
from bench.peer_mechanism_models import Bank
from bench.peer_mechanisms import CONTACTS, PENDULUM_DURATION, SLIDER_DURATION, Run, Tried, Works, ladder, off_by, runs
from bench.peers import reached

CRANK, ROD, PISTON, MASS = 0.6, 0.8, 0.4, 0.5  # of the scene slider-crank [kg]
RADIUS, LENGTH = 0.05, math.hypot(0.0833333333333333 - 0.03, 0.04)  # of crank and rod [m]


@pytest.fixture(scope="module")
def pendulum():
    return peer_mechanisms.pendulum()


@pytest.fixture(scope="module")
def slider_crank():
    return peer_mechanisms.slider_crank(CONTACTS["soft"])


def test_coordinates_of_the_place_of_contact_keep_frequencies_and_mobility():
    modes = solvers.load("figure-9.11").impactor.modes(0)
    bank = Bank.of(modes)
    frequencies = np.sqrt(np.abs(eigh(bank.stiffness, bank.mass, eigvals_only=True)))
    np.testing.assert_allclose(frequencies[1:], modes.frequencies, rtol=1e-9)
    mobility = 1.0 / modes.rigid_mass + modes.at_contact @ modes.at_contact
    assert np.linalg.inv(bank.mass)[0, 0] == pytest.approx(mobility, rel=1e-10)
    assert bank.whole[0] == pytest.approx(1.0)  # all of it moves as its place of contact does


def test_pendulum_as_a_peer_gets_it_is_that_of_modal(pendulum):
    """The matrices that Exudyn integrates, by SciPy."""
    scene = solvers.load("figure-9.11")
    banks = [Bank.of(scene.impactor.modes(0)), Bank.of(scene.target.modes(30))]
    rates = [
        np.linalg.solve(bank.mass, np.column_stack((bank.stiffness, np.eye(bank.whole.size)[0]))) for bank in banks
    ]
    split, size = banks[0].whole.size, sum(bank.whole.size for bank in banks)

    def force(state):
        return scene.contact.stiffness * np.maximum(state[0] - state[split], 0.0) ** 1.5

    def slope(_, state):
        pushed = force(state)
        first = -rates[0][:, :-1] @ state[:split] - rates[0][:, -1] * pushed
        second = -rates[1][:, :-1] @ state[split:size] + rates[1][:, -1] * pushed
        return np.concatenate((state[size:], first, second))

    start = np.zeros(2 * size)
    start[size] = scene.impactor.velocity
    times = np.linspace(0.0, PENDULUM_DURATION, 20_001)
    found = solve_ivp(slope, times[[0, -1]], start, "DOP853", times, rtol=1e-9, atol=1e-14)
    last = found.y[size:, -1]
    velocities = banks[0].whole @ last[:split], banks[1].whole @ last[split:]
    assert off_by((*velocities, force(found.y).max()), pendulum.right) < 2e-6


def test_slider_crank_is_that_of_its_one_angle(slider_crank):
    """Lagrange's equation of the crank's angle and the mass, by SciPy."""

    inertia = np.array([PISTON, ROD, ROD, ROD * LENGTH**2 / 12.0])
    near = 1e-4  # [rad], for derivatives by the angle, right to 1e-8

    def places(angle):
        """Of the piston, the middle of the rod, along and across the stroke [m], and the rod's angle [rad]."""
        fall = math.asin(RADIUS * math.sin(angle) / LENGTH)
        along, reach = RADIUS * math.cos(angle), LENGTH * math.cos(fall)
        return np.array([along + reach, along + 0.5 * reach, 0.5 * RADIUS * math.sin(angle), fall])

    def slopes(angle):
        """By the angle: first and second."""
        before, here, after = (places(angle + by) for by in (-near, 0.0, near))
        return (after - before) / (2.0 * near), (after - 2.0 * here + before) / near**2

    def momentum(angle, spin):
        """Of the links along the stroke [N s]."""
        return (np.array([PISTON, ROD]) @ slopes(angle)[0][:2] - 0.5 * CRANK * RADIUS * math.sin(angle)) * spin

    first = math.atan2(4.0, 3.0)
    touching = places(first)[0]

    def rates(_, state):
        angle, at, spin, speed = state
        slope, bend = slopes(angle)
        force = CONTACTS["soft"] * max(places(angle)[0] - touching - at, 0.0) ** 1.5
        pull = -(inertia @ (slope * bend)) * spin**2 - force * slope[0]
        return [spin, speed, pull / (CRANK * RADIUS**2 / 3.0 + inertia @ slope**2), force / MASS]

    start = [first, 0.0, -20.0, 0.0]
    found = solve_ivp(rates, (0.0, SLIDER_DURATION), start, "DOP853", rtol=1e-10, atol=1e-13)
    angle, _, spin, speed = found.y[:, -1]
    pin = momentum(angle, spin) - momentum(first, -20.0) + MASS * speed
    assert off_by((-speed, spin, pin), slider_crank.right) < 2e-6


@pytest.mark.parametrize("name", ["pendulum", "slider_crank"])
def test_our_side_runs_and_converges_by_second_order(name, request):
    case = request.getfixturevalue(name)
    tried = next(iter(case.solvers.values()))
    coarse, fine = runs(case.right, Tried(tried.prepare, (40, 320)))
    assert fine.error < 1e-3
    assert math.log(coarse.error / fine.error, 8.0) == pytest.approx(2.0, abs=0.35)
    assert 0.0 < fine.integration <= fine.time


def test_numbers_of_steps_at_which_a_solver_gives_up_are_left_out(pendulum):
    def stops():
        raise ArithmeticError

    def prepare(steps):
        found = stops if steps == 14 else lambda: pendulum.right
        return Works(found, found)

    assert [(run.steps, run.error) for run in runs(pendulum.right, Tried(prepare, (10, 14, 20)))] == [(10, 0), (20, 0)]
    assert reached([], 0.01, lambda each: each.error) is None


def test_a_chance_hit_does_not_count():
    tries = [Run(steps, error, 1.0, 1.0) for steps, error in ((10, 1e-4), (20, 0.5), (40, 5e-3), (80, math.nan))]
    assert reached(tries, 0.01, lambda each: each.error) is None
    assert reached(tries[:-1], 0.01, lambda each: each.error).steps == 40


def test_steps_are_tried_up_to_the_most():
    assert ladder(10, 80) == (10, 14, 20, 28, 40, 57, 80)


def test_a_missing_peer_is_said(monkeypatch, capsys):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    assert peer_mechanisms.measure() is None
    assert "not installed: exudyn" in capsys.readouterr().out


@pytest.mark.skipif(importlib.util.find_spec("exudyn") is None, reason="an optional peer")
@pytest.mark.parametrize("name", ["pendulum", "slider_crank"])
def test_exudyn_finds_the_same(name, request):
    case = request.getfixturevalue(name)
    for label, tried in case.solvers.items():
        if label.startswith("Exudyn"):
            assert off_by(tried.prepare(1000).whole(), case.right) < 1e-4, label
