"""Free rotation: angular momentum and energy kept, and the known precession of a symmetric top."""

import numpy as np
from pytest import approx

from solvers.numerics.rigid.rotation import rotations
from tests.catalog import observed_order
from tests.solvers.numerics.rigid.test_impulses import random_bodies

AROUND_Z = np.array([0.0, 0.0, 1.0])


def about(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues' rotation."""
    cross = np.cross(np.eye(3), axis)
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def test_a_steady_spin_about_a_principal_axis():
    turned = rotations(np.diag([1.0, 2.0, 2.5]), 3.0 * AROUND_Z, 0.4, 60)
    assert turned[0] == approx(np.eye(3), abs=1e-15)
    assert turned[-1] == approx(about(AROUND_Z, 1.2), abs=1e-14)
    back = rotations(np.diag([1.0, 2.0, 2.5]), 3.0 * AROUND_Z, -0.4, 60)[-1]
    assert back == approx(about(AROUND_Z, -1.2), abs=1e-14)


def test_a_thin_rod_and_a_point_go_on_turning():
    rod = np.diag([1.0, 1.0, 0.0])
    for inertia, spin in ((rod, AROUND_Z), (rod, np.array([1.0, 0.0, 0.0])), (np.zeros((3, 3)), AROUND_Z)):
        assert rotations(inertia, spin, 1.0, 60)[-1] == approx(about(spin, 1.0), abs=1e-14)


def top_after(step: float) -> np.ndarray:
    return rotations(np.diag([1.0, 1.0, 1.8]), np.array([0.5, 0.0, 2.0]), 2.0, round(2.0 / step))[-1]


def test_a_symmetric_top_precesses():
    """About its angular momentum L at |L| / I1, while it turns in itself by (1 / I3 - 1 / I1) L3."""
    momentum = np.array([0.5, 0.0, 3.6])
    size = np.linalg.norm(momentum)
    expected = about(momentum / size, 2.0 * size) @ about(AROUND_Z, 2.0 * 3.6 * (1.0 / 1.8 - 1.0))
    assert top_after(0.002) == approx(expected, abs=7.3 * 0.0073**2 / 12.0)  # 7.3 rad in steps of 0.0073
    steps = [2.0 / n for n in (80, 160, 320, 640)]
    assert observed_order(lambda step: top_after(step)[0, 2], steps) == approx(2.0, abs=0.05)


def test_the_energy_is_kept_and_the_matrices_stay_rotations():
    """The angular momentum is built in; so the energy shows the error."""
    bodies = random_bodies(np.random.default_rng(1), 50)
    momentum = (bodies.inertia @ bodies.spin[..., None])[..., 0]
    for steps, off in ((100, 1e-2), (400, 1e-3)):
        turned = rotations(bodies.inertia, bodies.spin, 0.5, steps)[-1]
        assert np.abs(turned @ turned.swapaxes(-1, -2) - np.eye(3)).max() < 1e-12
        inertia = turned @ bodies.inertia @ turned.swapaxes(-1, -2)
        spin = np.linalg.solve(inertia, momentum[..., None])[..., 0]
        assert np.vecdot(spin, momentum) == approx(np.vecdot(bodies.spin, momentum), rel=off)
    assert np.isfinite(rotations(np.diag([1e-9, 1.0, 3.0]), np.ones(3), 10.0, 20)).all()  # no real body
