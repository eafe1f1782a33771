"""The integrator of rigid links: its order, what it conserves, and joints that stay closed."""

import numpy as np
import pytest
from pytest import approx

from solvers.methods.multibody.linkage import centres, rates_of_centres, rigid_linkage
from solvers.numerics.multibody.free import joints_at, step_on
from solvers.numerics.multibody.moving import SINGLE, STAGES, work
from solvers.solve import solve
from tests.catalog import SCENES


def pendulum(periods: float, steps_per_period: int, stages: np.ndarray = STAGES):
    """The double pendulum of the scene, thrown by its impact: states at every step, and the widest gap of joints."""
    scene = SCENES["double-pendulum"]
    linkage, rows = rigid_linkage(scene.target)
    found = solve(scene, duration=1e-5)
    q, v = centres(scene.target), found.motion.course.rates[1].copy()
    count = rows.joint.size
    reactions, room = np.zeros(count), work(count, q.size)
    period = 2.0 * np.pi * np.sqrt(0.4 / 9.81)
    step, states, gap = period / steps_per_period, [], 0.0
    for number in range(int(periods * steps_per_period)):
        step_on(linkage, room, stages, q, v, number * step, step, reactions)
        states.append(np.append(q, v))
        joints_at(linkage, q, 0.0, room.gap, room.jacobian, room.moving)
        gap = max(gap, float(np.abs(room.gap).max()), float(np.abs(room.jacobian @ v).max()))
    return np.array(states), gap


def energy(states: np.ndarray) -> np.ndarray:
    inertia = np.tile([1.0, 1.0, 0.16 / 12.0], 2)
    return 0.5 * states[:, 6:] ** 2 @ inertia + 9.81 * (states[:, 1] + states[:, 4])


@pytest.mark.parametrize(("stages", "order"), [(SINGLE, 2.0), (STAGES, 6.0)])
def test_order(stages, order):
    exact = pendulum(1.0, 800)[0][-1, 2]
    errors = [abs(pendulum(1.0, steps, stages)[0][-1, 2] - exact) for steps in (15, 30, 60)]
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == approx([order, order], abs=0.4)


def test_joints_stay_closed_and_the_energy_does_not_drift():
    """The error of the energy is that of a step, however many there are."""
    states, gap = pendulum(60.0, 120)
    assert gap < 2e-14
    errors = np.abs(energy(states) / energy(states)[0] - 1.0)
    assert errors.max() < 1e-8
    assert errors[-3600:].max() < 2.0 * errors[:3600].max() + 1e-13


@pytest.mark.slow
def test_a_thousand_periods():
    states, gap = pendulum(1000.0, 120)
    assert gap < 1e-13 and np.abs(energy(states) / energy(states)[0] - 1.0).max() < 1e-8


def test_a_driven_slider_crank_moves_as_its_lengths_say():
    scene = SCENES["bouncing-on-piston"]
    linkage, rows = rigid_linkage(scene.target)
    q, v = centres(scene.target), rates_of_centres(scene.target)
    reactions, room = np.zeros(rows.joint.size), work(rows.joint.size, q.size)
    step, steps = 2.0 * np.pi / 40.0 / 100, 150
    for number in range(steps):
        step_on(linkage, room, STAGES, q, v, number * step, step, reactions)
    angle = 40.0 * steps * step
    rod = np.sqrt(0.06**2 - (0.02 * np.cos(angle)) ** 2)
    assert q[2] == approx(angle, rel=1e-14)
    assert q[7] == approx(0.02 * np.sin(angle) + rod, abs=1e-15)
    speed = 40.0 * (0.02 * np.cos(angle) + 0.02**2 * np.sin(angle) * np.cos(angle) / rod)
    assert v[7] == approx(speed, rel=1e-12)
    assert q[8] == approx(0.0, abs=1e-15)
