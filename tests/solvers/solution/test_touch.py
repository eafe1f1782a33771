"""The circle of contact: Hertz's closed forms, and what Tabor's tests measured."""

import math

import numpy as np
from pytest import approx

from solvers import load, solve
from solvers.contact.constants import contact_modulus, contact_radius
from solvers.contact.tabor import force
from solvers.solution.touch import pressing

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


def test_a_contact_pressed_on_slowly_lies_beside_tabors_tests():
    """Thesis figure 7.5: from 1.1 yield strengths to 2.8, and the force (7.28); a^2 from alpha R to 2 alpha R."""
    scene = load("figure-7.5")
    law, radius = scene.contact, contact_radius(scene.impactor, scene.target)
    depth = np.array([0.5, 1.0, 2.0, 50.0]) * law.yield_indentation
    depth = np.append(depth, np.array([1.0, 2.0]) * law.full_indentation)
    found = pressing(scene, depth)
    assert np.isnan(found.tests[[0, -1]]).all() and np.isfinite(found.tests[1:-1]).all()
    assert found.tests[[1, -2]] == approx([1.1, 2.8], rel=0.01)
    modulus, strength = contact_modulus(scene.impactor, scene.target), scene.impactor.material.yield_strength
    ends = law.yield_indentation, law.full_indentation
    assert found.tested[1:-1] == approx(force(depth[1:-1], radius, modulus, strength, *ends), rel=1e-12)
    assert (found.radius / found.elastic)[[0, 1, 4, 5]] ** 2 == approx([1.0, 1.0, 2.0, 2.0], rel=1e-12)
    assert (found.pressure / found.tests)[2:5] == approx([0.949, 1.144, 1.041], abs=1e-3)  # of the power law
    assert found.pressure[:2] == approx([1.6 / 1.5 * 0.5**0.5, 1.6 / 1.5], rel=1e-12)  # Hertz


def test_the_blow_goes_up_along_that_curve():
    """Away from the first instants, at which one step is a large part of the indentation."""
    scene = load("figure-7.5")
    found = solve(scene)
    time = np.linspace(0.1, 0.5, 30) * found.contacts[0].end
    depth = found.motion.impactor_position(time) - found.motion.end_position(time)
    rising = np.diff(depth, prepend=0.0) > 0.0
    touched, slowly = found.touch(time), pressing(scene, depth)
    assert touched.pressure[rising] / touched.strength == approx(slowly.pressure[rising], rel=1e-3)
    assert touched.radius[rising] == approx(slowly.radius[rising], rel=1e-6)
    assert pressing(load("two-balls"), depth) is None and pressing(load("fixed-rod"), depth) is None
