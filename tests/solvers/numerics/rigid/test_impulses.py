"""Impulses between rigid bodies: linear algebra, conservation, limits, on many random pairs at once."""

import numpy as np
import pytest
from pytest import approx

from solvers.numerics.rigid.impulses import Bodies, kinetic_energy, point_velocity, principal, residuals, strike

PAIRS = 1000
ROUNDING = 1e-12  # the promise; moments of inertia here differ by less than a thousand times


def rotations(random: np.random.Generator, count: int = PAIRS) -> np.ndarray:
    turned, _ = np.linalg.qr(random.standard_normal((count, 3, 3)))
    return turned * np.linalg.det(turned)[:, None, None]


def in_world(moments: np.ndarray, axes: np.ndarray) -> np.ndarray:
    return (axes * moments[..., None, :]) @ axes.swapaxes(-1, -2)


def random_bodies(random: np.random.Generator, count: int = PAIRS) -> Bodies:
    """Full tensors of real bodies: second moments of three axes, so that no two moments fall short of the third."""
    mass, spread = 10.0 ** random.uniform(-2.0, 2.0, count), random.uniform(0.05, 1.0, (count, 3)) ** 2
    moments = mass[:, None] * (spread.sum(axis=1, keepdims=True) - spread)
    vectors = random.standard_normal((3, count, 3))
    return Bodies(mass, in_world(moments, rotations(random, count)), *vectors)


def random_pairs(seed: int, count: int = PAIRS) -> tuple[Bodies, Bodies, np.ndarray, np.ndarray]:
    """Two bodies, a normal along which they approach, a restitution."""
    random = np.random.default_rng(seed)
    first, second = random_bodies(random, count), random_bodies(random, count)
    normal = random.standard_normal((count, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    approach = np.vecdot(normal, point_velocity(first) - point_velocity(second))
    return first, second, normal * np.sign(approach)[:, None], random.uniform(0.0, 1.0, count)


def miss(found: np.ndarray, expected: np.ndarray, size: np.ndarray | None = None) -> float:
    """The largest difference, relative to the size of what is compared."""
    if found.ndim > 1:
        difference, scale = np.linalg.norm(found - expected, axis=-1), np.linalg.norm(expected, axis=-1)
    else:
        difference, scale = np.abs(found - expected), np.abs(expected)
    return float(np.max(difference / (scale if size is None else size)))


def held(bodies: Bodies) -> np.ndarray:
    """What rounding is measured by: momentum, and angular momentum about points a metre away."""
    return bodies.mass * (1.0 + np.linalg.norm(bodies.velocity, axis=1)) + np.linalg.norm(bodies.inertia, axis=(1, 2))


# --- what the formulas must satisfy -----------------------------------------------------------------------------------


def test_impulse_and_jumps_are_those_of_plain_linear_algebra():
    """The equations of motion and the law of restitution as one system of 13 unknowns per pair."""
    first, second, normal, restitution = random_pairs(1, 200)
    found = strike(first, second, normal, restitution)
    for k in range(200):
        n, system, right = normal[k], np.zeros((13, 13)), np.zeros(13)  # dv1, dw1, dv2, dw2, J
        row = []
        for place, bodies, way in ((0, first, -1.0), (6, second, 1.0)):
            c = bodies.centre[k]
            system[place : place + 3, place : place + 3] = bodies.mass[k] * np.eye(3)
            system[place : place + 3, 12] = -way * n
            system[place + 3 : place + 6, place + 3 : place + 6] = bodies.inertia[k]
            system[place + 3 : place + 6, 12] = way * np.cross(c, n)
            row += [-way * n, -way * np.cross(n, c)]  # n . (dv + c x dw)
        system[12, :12] = np.concatenate(row)
        right[12] = -(1.0 + restitution[k]) * found.approach[k]
        scale = np.sqrt(np.abs(np.diag(system)))
        scale[12] = 1.0
        solved = np.linalg.solve(system / scale[:, None] / scale, right / scale) / scale
        jumps = [
            now - before
            for old, new in ((first, found.first), (second, found.second))
            for now, before in ((new.velocity[k], old.velocity[k]), (new.spin[k], old.spin[k]))
        ]
        assert found.impulse[k] == approx(solved[12], rel=ROUNDING)
        for jump, piece in zip(jumps, np.split(solved[:12], 4), strict=True):
            assert np.linalg.norm(jump - piece) <= 1e-12 * (np.linalg.norm(piece) + 10.0)  # velocities of order 1


def test_effective_mass_as_the_note_prints_it():
    first, second, normal, restitution = random_pairs(2)
    found = strike(first, second, normal, restitution)
    inverse = 1.0 / first.mass + 1.0 / second.mass
    for bodies in (first, second):
        turn = np.linalg.solve(bodies.inertia, np.cross(bodies.centre, normal)[..., None])[..., 0]
        inverse = inverse - np.vecdot(normal, np.cross(bodies.centre, turn))
    assert miss(found.effective_mass, 1.0 / inverse) < ROUNDING


def test_the_touching_points_part_at_the_restitution_times_their_approach():
    first, second, normal, restitution = random_pairs(3)
    found = strike(first, second, normal, restitution)
    parting = np.vecdot(normal, point_velocity(found.second) - point_velocity(found.first))
    assert np.max(np.abs(parting - restitution * found.approach)) < ROUNDING * 20.0  # points move at up to 20 m/s


def test_momentum_and_angular_momentum_about_any_point_are_kept():
    first, second, normal, restitution = random_pairs(4)
    found = strike(first, second, normal, restitution)
    for about in np.random.default_rng(5).uniform(-10.0, 10.0, (5, 3)):
        momentum, angular = residuals((first, second), found, normal, about)
        both = held(first) + held(second)
        assert np.max(np.linalg.norm(momentum, axis=1) / both) < ROUNDING
        assert np.max(np.linalg.norm(angular, axis=1) / both) < 20.0 * ROUNDING  # the point is 10 m away


def test_each_body_keeps_its_angular_momentum_about_the_contact_point():
    first, second, normal, restitution = random_pairs(6)
    found = strike(first, second, normal, restitution)
    for old, new in ((first, found.first), (second, found.second)):
        gained = old.mass[:, None] * np.cross(old.centre, new.velocity - old.velocity)
        gained += (old.inertia @ (new.spin - old.spin)[..., None])[..., 0]
        assert np.max(np.linalg.norm(gained, axis=1) / held(old)) < ROUNDING


def test_the_energy_lost_is_that_of_the_formula():
    first, second, normal, restitution = random_pairs(7)
    found = strike(first, second, normal, restitution)
    before = kinetic_energy(first) + kinetic_energy(second)
    after = kinetic_energy(found.first) + kinetic_energy(found.second)
    assert np.max(np.abs(before - after - found.lost) / before) < ROUNDING
    expected = 0.5 * found.effective_mass * (1.0 - restitution**2) * found.approach**2
    assert miss(found.lost, expected) < ROUNDING


def test_turning_the_world_turns_the_answer():
    first, second, normal, restitution = random_pairs(8)
    found = strike(first, second, normal, restitution)
    turn = rotations(np.random.default_rng(9))

    def turned(vector):
        return (turn @ vector[..., None])[..., 0]

    def seen(bodies):
        inertia = turn @ bodies.inertia @ turn.swapaxes(-1, -2)
        return Bodies(bodies.mass, inertia, turned(bodies.centre), turned(bodies.velocity), turned(bodies.spin))

    other = strike(seen(first), seen(second), turned(normal), restitution)
    assert miss(other.impulse, found.impulse) < ROUNDING
    speeds = 1.0 + np.linalg.norm(found.first.velocity, axis=1) + np.linalg.norm(found.first.spin, axis=1)
    assert miss(other.first.velocity, turned(found.first.velocity), speeds) < ROUNDING
    assert miss(other.first.spin, turned(found.first.spin), speeds) < 10.0 * ROUNDING


def test_naming_the_bodies_the_other_way_round_changes_nothing():
    first, second, normal, restitution = random_pairs(10)
    found, other = strike(first, second, normal, restitution), strike(second, first, -normal, restitution)
    assert miss(other.impulse, found.impulse) < ROUNDING
    assert np.allclose(other.second.velocity, found.first.velocity, rtol=0.0, atol=1e-12)


# --- limits -----------------------------------------------------------------------------------------------------------


def test_bodies_that_part_already_are_left_alone():
    first, second, normal, restitution = random_pairs(11)
    found = strike(first, second, -normal, restitution)
    assert (found.approach < 0.0).all()
    assert not found.impulse.any() and not found.lost.any()
    for old, new in ((first, found.first), (second, found.second)):
        assert (old.velocity == new.velocity).all() and (old.spin == new.spin).all()


def test_one_touch_without_approach_is_no_impact():
    first, second, normal, _ = random_pairs(12, 1)
    same = second._replace(velocity=second.velocity * 0.0, spin=second.spin * 0.0)
    still = first._replace(velocity=first.velocity * 0.0, spin=first.spin * 0.0)
    assert strike(still, same, normal, 1.0).impulse == 0.0


def point_masses(bodies: Bodies) -> Bodies:
    return bodies._replace(inertia=np.zeros_like(bodies.inertia))


def test_point_masses_meet_with_their_reduced_mass():
    first, second, normal, restitution = random_pairs(13)
    first, second = point_masses(first), point_masses(second)
    approach = np.vecdot(normal, first.velocity - second.velocity)
    found = strike(first, second, normal * np.sign(approach)[:, None], restitution)
    assert miss(found.effective_mass, first.mass * second.mass / (first.mass + second.mass)) < ROUNDING
    assert miss(found.impulse, (1.0 + restitution) * found.effective_mass * np.abs(approach)) < ROUNDING
    assert (found.first.spin == first.spin).all()
    momentum, angular = residuals((first, second), found, normal * np.sign(approach)[:, None], np.ones(3))
    assert np.max(np.linalg.norm(momentum, axis=1) / found.impulse) < ROUNDING * 1e3  # masses of up to 1e4 : 1
    assert np.max(np.linalg.norm(angular, axis=1) / found.impulse) < ROUNDING * 1e3


def test_a_wall_is_the_limit_of_an_ever_heavier_body():
    first, second, normal, restitution = random_pairs(14)
    still = second._replace(velocity=np.zeros_like(second.velocity), spin=np.zeros_like(second.spin))
    approach = np.vecdot(normal, point_velocity(first))
    normal = normal * np.sign(approach)[:, None]
    wall = still._replace(mass=np.full(PAIRS, np.inf))
    heavy = still._replace(mass=1e12 * still.mass, inertia=1e12 * still.inertia)
    against_wall, against_heavy = (strike(first, other, normal, restitution) for other in (wall, heavy))
    # the difference is the ratio of the masses, of up to 1e4 : 1e12, times the square of an arm over a radius
    assert miss(against_heavy.impulse, against_wall.impulse) < 1e-5
    assert not against_wall.second.velocity.any() and not against_wall.second.spin.any()
    momentum, _ = residuals((first, wall), against_wall, normal)
    assert np.max(np.linalg.norm(momentum, axis=1) / against_wall.impulse) < ROUNDING * 1e3


def test_a_thin_rod_in_any_direction_turns_across_its_axis_only():
    """The worked example of the note, turned at random: 1/mu = 4/m1 + 1/m2 at the end, 1/m1 + 1/m2 in the middle."""
    random = np.random.default_rng(15)
    length, frames = random.uniform(0.1, 3.0, PAIRS), rotations(random)
    place = random.uniform(-0.5, 0.5, PAIRS)
    place[:2] = 0.5, 0.0
    point = random_bodies(random)
    point = point_masses(point)._replace(centre=np.zeros((PAIRS, 3)), spin=np.zeros((PAIRS, 3)))
    mass = random.uniform(0.1, 10.0, PAIRS)
    moment = mass * length**2 / 12.0
    moments = np.stack([moment, np.zeros(PAIRS), moment], axis=1)
    normal, axis = frames[..., 0], frames[..., 1]
    still = np.zeros((PAIRS, 3))
    rod = Bodies(mass, in_world(moments, frames), -(place * length)[:, None] * axis, still, still)
    found = strike(rod, point._replace(velocity=-3.0 * normal), normal, 0.6)
    expected = 1.0 / (1.0 / mass + 1.0 / point.mass + 12.0 * place**2 / mass)
    assert miss(found.effective_mass, expected) < ROUNDING
    assert found.effective_mass[0] == approx(mass[0] * point.mass[0] / (mass[0] + 4.0 * point.mass[0]), rel=ROUNDING)
    spin = 12.0 * place * found.impulse / (mass * length)
    assert np.max(np.abs(np.vecdot(found.first.spin, frames[..., 2]) - spin) / (1.0 + np.abs(spin))) < ROUNDING
    along = np.abs(np.vecdot(found.first.spin, axis))
    assert np.max(along / (1.0 + np.abs(spin))) < ROUNDING


def test_a_thin_rod_cannot_be_struck_beside_its_axis():
    still = np.zeros(3)
    rod = Bodies(1.0, np.diag([1.0, 0.0, 1.0]), np.array([0.0, -0.5, 0.1]), still, still)
    ball = Bodies(1.0, np.zeros((3, 3)), still, np.array([-1.0, 0.0, 0.0]), still)
    with pytest.raises(ValueError, match="beside an axis"):
        strike(rod, ball, np.array([1.0, 0.0, 0.0]), 1.0)


def test_two_walls_cannot_meet():
    still = np.zeros(3)
    wall = Bodies(np.inf, np.zeros((3, 3)), still, still, still)
    with pytest.raises(ValueError, match="immovable"):
        strike(wall, wall, np.array([1.0, 0.0, 0.0]), 1.0)


def test_the_order_of_solving_and_crossing_matters():
    """Differs: the note prints I^-1 c x J n; (I^-1 c) x n is another vector for all but isotropic tensors."""
    first, second, normal, restitution = random_pairs(16)
    found = strike(first, second, normal, restitution)
    right = np.linalg.solve(first.inertia, (found.impulse[:, None] * np.cross(first.centre, normal))[..., None])[..., 0]
    size = np.linalg.norm(first.spin, axis=1) + np.linalg.norm(right, axis=1)
    assert miss(found.first.spin - first.spin, right, size) < ROUNDING
    misread = np.cross(np.linalg.solve(first.inertia, first.centre[..., None])[..., 0], normal)
    misread *= found.impulse[:, None]
    assert np.median(np.linalg.norm(misread - right, axis=1) / np.linalg.norm(right, axis=1)) > 0.1


def test_principal_moments():
    random = np.random.default_rng(17)
    moments = np.sort(random.uniform(0.5, 1.0, (PAIRS, 3)), axis=1)
    moments[: PAIRS // 2, 0] = 0.0
    found, axes = principal(in_world(moments, rotations(random)))
    assert np.max(np.abs(found - moments)) < 1e-14  # a few roundings of moments below 1
    assert (found[: PAIRS // 2, 0] == 0.0).all()
    assert np.max(np.abs(axes.swapaxes(-1, -2) @ axes - np.eye(3))) < 1e-14
