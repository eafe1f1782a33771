"""Free rotation: angular momentum and energy kept, and the known precession of a symmetric top."""

import numpy as np
from pytest import approx

from solvers.numerics.free_rotation import rotations
from tests.catalog import observed_order
from tests.solvers.test_impulses import random_bodies

AROUND_Z = np.array([0.0, 0.0, 1.0])


def about(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues' rotation."""
    cross = np.cross(np.eye(3), axis)
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def test_a_steady_spin_about_a_principal_axis():
    turned = rotations(np.diag([1.0, 2.0, 2.5]), 3.0 * AROUND_Z, 0.4, 60)
    assert turned[0] == approx(np.eye(3), abs=1e-15)
    assert turned[-1] == approx(about(AROUND_Z, 1.2), abs=1.2 * 0.02**4 / 60)
    back = rotations(np.diag([1.0, 2.0, 2.5]), 3.0 * AROUND_Z, -0.4, 60)[-1]
    assert back == approx(about(AROUND_Z, -1.2), abs=1.2 * 0.02**4 / 60)


def test_a_thin_rod_and_a_point_go_on_turning():
    rod = np.diag([1.0, 1.0, 0.0])
    for inertia, spin in ((rod, AROUND_Z), (rod, np.array([1.0, 0.0, 0.0])), (np.zeros((3, 3)), AROUND_Z)):
        assert rotations(inertia, spin, 1.0, 60)[-1] == approx(about(spin, 1.0), abs=1e-8)


def top_after(step: float) -> np.ndarray:
    return rotations(np.diag([1.0, 1.0, 1.8]), np.array([0.5, 0.0, 2.0]), 2.0, round(2.0 / step))[-1]


def test_a_symmetric_top_precesses():
    """About its angular momentum L at |L| / I1, while it turns in itself by (1 / I3 - 1 / I1) L3."""
    momentum = np.array([0.5, 0.0, 3.6])
    size = np.linalg.norm(momentum)
    expected = about(momentum / size, 2.0 * size) @ about(AROUND_Z, 2.0 * 3.6 * (1.0 / 1.8 - 1.0))
    assert top_after(0.002) == approx(expected, abs=1e-9)
    steps = [2.0 / n for n in (40, 80, 160, 320)]
    assert observed_order(lambda step: top_after(step)[0, 0], steps) == approx(4.0, abs=0.2)


def test_angular_momentum_and_energy_are_kept():
    bodies = random_bodies(np.random.default_rng(1), 50)
    turned = rotations(bodies.inertia, bodies.spin, 0.5, 400)[-1]
    inertia = turned @ bodies.inertia @ turned.swapaxes(-1, -2)
    momentum = (bodies.inertia @ bodies.spin[..., None])[..., 0]
    spin = np.linalg.solve(inertia, momentum[..., None])[..., 0]
    energy = np.vecdot(spin, momentum)
    assert energy == approx(np.vecdot(bodies.spin, momentum), rel=1e-6)  # up to 0.01 rad a step, unlike moments
    assert np.abs(turned @ turned.swapaxes(-1, -2) - np.eye(3)).max() < 1e-6
