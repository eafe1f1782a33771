"""Hertz stiffness from the radii and materials of the two bodies."""

import math

from pytest import approx

from tests.catalog import SCENES
from tests.solvers.contact.spheres import sphere_scene


def test_hertz_stiffness_of_a_steel_ball_on_the_bronze_rod():
    # 4/3 E* sqrt(R), thesis 3.4.1; Differs: (7.6) prints K for two bodies of one material
    scene = SCENES["bronze-rod-steel-ball"]
    compliance = (1.0 - 0.3**2) / 210e9 + (1.0 - 0.34**2) / 98e9
    assert scene.contact.stiffness == approx(4.0 / 3.0 / compliance * math.sqrt(0.015), rel=1e-14)


def test_hertz_from_two_radii_and_two_materials():
    modulus = 210e9 / (1.0 - 0.3**2)
    same = sphere_scene({"law": "hertz"}).contact
    assert same.stiffness == approx(2.0 / 3.0 * modulus * math.sqrt(0.04), rel=1e-14)  # (7.6)
    rigid = sphere_scene({"law": "hertz"}, target={"kind": "stop"}).contact
    assert rigid.stiffness == approx(4.0 / 3.0 * modulus * math.sqrt(0.04), rel=1e-14)
    ball = {"kind": "mass", "mass": 1.0, "radius": 0.06, "material": "steel"}
    two = sphere_scene({"law": "hertz"}, target=ball).contact
    assert two.stiffness == approx(2.0 / 3.0 * modulus * math.sqrt(0.024), rel=1e-14)  # 1/R = 1/40 + 1/60
    hollow = sphere_scene({"law": "hertz"}, {"kind": "mass", "mass": 1.0}, {"kind": "stop", "radius": 0.01}).contact
    assert hollow.stiffness == approx(4.0 / 3.0 * modulus * math.sqrt(0.008), rel=1e-14)
