"""The circle of contact: Hertz's closed forms, and what Tabor's tests measured."""

import math

import numpy as np
from pytest import approx

from solvers import load, solve
from solvers.contact.constants import contact_modulus, contact_radius

STEEL = {"young": 210e9, "density": 7900.0, "poisson": 0.3, "yield": 500e6}
MATERIALS = ("impactor.material", "target.material")


def test_two_balls_touch_as_hertz_says():
    """a = (3 F R / 4 E*)^(1/3) and p0 = (6 F E*^2 / pi^3 R^2)^(1/3) at every instant."""
    scene = load("two-balls")
    solution = solve(scene)
    radius, modulus = contact_radius(scene.impactor, scene.target), contact_modulus(scene.impactor, scene.target)
    time = np.linspace(0.0, solution.duration, 101)
    found, force = solution.touch(time), solution.motion.force(time)
    assert found.radius == approx((0.75 * force * radius / modulus) ** (1 / 3), rel=2e-4, abs=1e-12)
    assert found.greatest == approx(
        (6.0 * force * modulus**2 / (math.pi**3 * radius**2)) ** (1 / 3), rel=2e-4, abs=1.0
    )  # of one step
    assert not found.radius[-1] and not found.pressure[-1]  # they have parted


def test_a_ball_flows_as_in_tabors_tests():
    """p over the yield strength is 1.07 where flow begins, p0 = 1.6 strengths, (7.26), and 5.5 / 2 times that where it
    is full: a secant stiffness 5.5 times as large, (7.34), on a circle twice as large as alpha R; Tabor found 2.8."""
    scene = load("two-balls").replace(
        {"contact": {"law": "plastic-power"}, "impactor.velocity": 20.0, **dict.fromkeys(MATERIALS, STEEL)}
    )
    solution = solve(scene)
    end = solution.contacts[0].end
    time = np.union1d(np.linspace(0.0, end, 4001), np.linspace(0.0, 0.02 * end, 4001))  # yield comes early
    found = solution.touch(time)
    law, depth = scene.contact, solution.motion.impactor_position(time) - solution.motion.end_position(time)
    most = int(np.argmax(depth))
    begins, full = np.interp([law.yield_indentation, law.full_indentation], depth[:most], found.pressure[:most])
    assert begins / found.strength == approx(1.6 / 1.5, rel=0.01)
    assert depth[most] > law.full_indentation and full / found.strength == approx(2.75 * 1.6 / 1.5, rel=0.01)
    back = found.radius[most:]
    assert (np.diff(back[back > 0.0]) < 0.0).all() and found.greatest is None
    assert found.radius[most + 1] == approx(found.radius[most], rel=1e-2)  # the crater as wide as the contact was
    late = (most + time.size - 1) // 2
    assert solution.touch(time[late]).radius[0] == approx(found.radius[late], rel=1e-3)  # asked for alone


def test_other_laws_and_flat_faces_have_no_circle():
    for name in ("fixed-rod", "stiff-contact"):
        assert solve(load(name)).touch([0.0]) is None
