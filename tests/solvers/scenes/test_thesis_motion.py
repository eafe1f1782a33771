"""Numbers of thesis 6.4, 9.5 and 10.3 that its figures show, of which independent values are known."""

import numpy as np
import pytest
from pytest import approx

import solvers

HANGING = {
    "kind": "pendulum", "length": 0.25, "at": 0.76, "section": {"area": 1.92e-4, "second_moment": 4.096e-9},
    "material": {"young": 71e9, "density": 4100.0},
}  # fmt: skip


@pytest.mark.parametrize(
    ("name", "along", "moment"),
    [
        ("table-6.6", 0.12610795411466125, 0.007880049205982731),
        ("figure-6.7", 0.07927242659819012, 0.0031303172103963606),
        ("figure-6.8", 0.052960327346919356, 0.001400012335815104),
    ],
)
def test_sudden_reactions_of_the_turning_bar(name, along, moment):
    """Table 6.6: sums over the impulse, of moments over its arm of 0.3 m."""
    found = solvers.solve(solvers.load(name))
    [joint] = found.reactions
    assert abs(joint["impulse"][1]) / found.impulse == approx(along, rel=1e-9)
    assert abs(joint["moment_impulse"]) / (0.3 * found.impulse) == approx(moment, rel=1e-9)


@pytest.mark.parametrize(("modes", "felt"), [(0, 0.05588), (2, 0.04450), (5, 0.02822), (10, 0.01654), (50, 0.00372)])
def test_mass_that_one_balance_feels(modes, felt):
    """It falls towards nothing as modes are added: a pendulum with pinned-free shapes, struck by 0.11 kg at 1 m/s."""
    bends = {"modes": modes, "shapes": "pinned-free"} if modes else {}
    ball = {"kind": "mass", "mass": 0.11, "velocity": 1.0}
    scene = solvers.Scene.from_table({"impactor": ball, "target": HANGING | bends, "contact": {"law": "rigid"}})
    if modes:
        first = solvers.solve(scene, "balance", modes=modes, restitution=1.0).motion.impulses[1][0]
    else:
        first = solvers.solve(scene, "rigid", restitution=1.0).impulse
    assert first / 2.0 == approx(felt, rel=2e-3)


def test_the_pendulum_that_does_not_bend():
    """Figure 9.2."""
    found = solvers.solve(solvers.load("figure-9.2"))
    time = np.linspace(60e-6, 68e-6, 8001)
    assert found.peak_force == approx(4510.8781, rel=1e-6)
    assert time[found.motion.force(time).argmax()] == approx(63.8345e-6, rel=1e-4)
    assert [(contact.start, contact.end) for contact in found.contacts] == [(0.0, approx(145.6625e-6, rel=1e-4))]


def test_the_contact_of_a_pendulum_that_bends_is_interrupted():
    """Figures 9.11 and 9.14, by pinned-free shapes; by those of the thesis the third maximum is lower."""
    scene = solvers.load("figure-9.11")
    found = solvers.solve(scene)
    first, second = found.contacts[:2]
    assert (first.end, second.start) == approx((245.0e-6, 344.3e-6), rel=2e-3)
    assert (first.peak_force, second.peak_force) == approx((2774.88, 145.46), rel=1e-4)
    clamped = solvers.solve(scene.replace({"impactor.shapes": "clamped-free"}))
    assert [contact.peak_force for contact in clamped.contacts[:2]] == approx([2775.78, 135.44], rel=1e-4)
    converged = solvers.solve(solvers.load("figure-9.14")).contacts[1]
    assert (converged.start, converged.end) == approx((349.65e-6, 384.29e-6), rel=2e-3)
    assert converged.peak_force == approx(93.66, rel=1e-3)


def test_a_pendulum_on_a_stop_by_many_shapes():
    """Figure 10.8."""
    found = solvers.solve(solvers.load("figure-10.8").replace({"impactor.modes": 40}))
    assert found.peak_force == approx(3542.6, rel=2e-4)
    assert found.contacts[-1].end == approx(189.1e-6, rel=1e-3)
    assert -found.swings["impactor"].spin == approx(6.3457, rel=1e-4)


@pytest.mark.parametrize(
    ("modes", "shapes", "peak", "contacts"),
    [
        (10, "pinned-free", 3551.6, 1),
        (10, "clamped-free", 3553.6, 1),
        (3, "pinned-free", 3804.6, 1),
        (3, "clamped-free", 4470.0, 2),
    ],
)
def test_forces_on_the_stop_by_both_kinds_of_shapes(modes, shapes, peak, contacts):
    """Figure 10.10."""
    scene = solvers.load("figure-10.10").replace({"impactor.modes": modes, "impactor.shapes": shapes})
    found = solvers.solve(scene)
    assert found.peak_force == approx(peak, rel=1e-4)
    assert len(found.contacts) == contacts


def test_moments_at_three_places_of_a_pendulum_with_clamped_shapes():
    """Figure 10.12."""
    found = solvers.solve(solvers.load("figure-10.12")).diagnostics
    assert (found["pivot_moment"], found["contact_moment"]) == approx((31.612, 45.200), rel=1e-4)


@pytest.mark.parametrize("name", ["figure-6.1", "figure-6.2"])
def test_bodies_that_fly_and_bend(name):
    """(6.1) and (6.3): what nothing outside pushes keeps its momentum and its moment of momentum; the pin stays closed,
    and the first impulse is that of all the bodies know, (1 + e) v / (1 / m1 + 1 / m2 + shapes)."""
    scene = solvers.load(name)
    found = solvers.solve(scene)
    motion, mechanism = found.motion, scene.target
    links = mechanism.system.links
    felt = mechanism.frozen.modes
    mobility = 1.0 / scene.impactor.mass + 1.0 / felt.rigid_mass + float(felt.at_contact @ felt.at_contact)
    assert found.contacts[0].impulse == approx(1.5 * 3.0 / mobility, rel=1e-9)
    centres, rates = (each.reshape(motion.time.size, -1, 3) for each in (motion.centres, motion.rates))
    place, speed = motion.impactor_places(motion.time), motion.course.speed
    masses, inertias = np.array([link.mass for link in links]), np.array([link.inertia for link in links])

    def cross(a, b):
        return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

    momentum = scene.impactor.mass * speed + masses @ rates[..., :2]
    turning = scene.impactor.mass * cross(place, speed) + cross(centres[..., :2], rates[..., :2]) @ masses
    turning += rates[..., 2] @ inertias
    assert momentum == approx(np.tile(momentum[0], (motion.time.size, 1)), abs=1e-9)
    assert turning == approx(np.full(motion.time.size, turning[0]), abs=1e-8)
    assert motion.widest_gap < 1e-14
    ends = motion.link_points(motion.time)
    bars = [np.hypot(*(ends[link.name][:, 1] - ends[link.name][:, 0]).T) / link.length for link in mechanism.links]
    assert np.ptp(bars[0]) < 0.01  # bent, they hardly shorten


def test_a_rigid_pendulum_by_its_angle():
    """Figure 9.6: 30 modes of the rod come to the waves of figure 9.2, and L_p makes spin of velocity."""
    found, exact = solvers.solve(solvers.load("figure-9.6")), solvers.solve(solvers.load("figure-9.2"))
    assert found.peak_force == approx(exact.peak_force, rel=1e-4)
    assert found.impactor_velocity == approx(exact.impactor_velocity, rel=1e-4)
    assert found.table()["impactor"]["final_spin"] == approx(found.impactor_velocity / 0.19, rel=1e-12)
