"""Laws that damp: restitution asked for and delivered."""

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pytest import approx
from scipy.integrate import solve_ivp

from solvers import LAWS as CLASSES
from solvers import Scene
from solvers.contact import KelvinVoigt
from solvers.contact.damping import damping_for, delivered_restitution
from tests.catalog import WITH_INDENTATION, contact_table, struck_rod
from tests.solvers.contact.spheres import sphere_scene

VISCOUS = [name for name in WITH_INDENTATION if CLASSES[name].LOSSY]
each_viscous = pytest.mark.parametrize("name", VISCOUS)


@pytest.mark.parametrize(
    "nominal, hunt_crossley, lankarani_nikravesh",
    [(0.9, 0.90902, 0.91318), (0.5, 0.66296, 0.72524), (0.1, 0.51583, 0.66527), (0.0, 0.48774, 0.66296)],
)
def test_nominal_restitutions_deliver_less_loss_than_their_name(nominal, hunt_crossley, lankarani_nikravesh):
    # d (1 + e) = ln((1 + d) / (1 - d e)) with d = 3 (1 - e) / 2 and d = 3 (1 - e^2) / 4, thesis 7.3.1; 5 digits
    for name, delivered in (("hunt-crossley", hunt_crossley), ("lankarani-nikravesh", lankarani_nikravesh)):
        scene = sphere_scene({"law": name, "nominal_restitution": nominal})
        mass, speed = scene.reduced_mass, scene.speed
        assert scene.contact.delivered(mass, speed) == approx(delivered, abs=5e-6)
        assert scene.contact.nominal(mass, speed) == approx(nominal, abs=1e-8)


@given(restitution=st.floats(0.01, 1.0))
def test_damping_for_inverts_delivered_restitution(restitution):
    # next to 1 both are series to first order in d < 1.5e-4: they leave out 4/9 d^2 < 1.1e-8
    tolerance = 1.1e-8 if restitution > 1.0 - 2e-4 else 1e-11
    assert delivered_restitution(damping_for(restitution)) == approx(restitution, abs=tolerance)


@given(damping=st.floats(-8.0, 2.0).map(lambda p: 10.0**p))
def test_delivered_restitution_solves_its_equation(damping):
    e = delivered_restitution(damping)
    assert 0.0 < e < 1.0
    if damping >= 1e-2 and damping * e < 1.0 - 1e-6:
        assert damping * (1.0 + e) == approx(math.log((1.0 + damping) / (1.0 - damping * e)), rel=1e-9)
    # e = 1 - 2/3 d + 4/9 d^2 - ..., both series of the equation
    assert 1.0 - 2.0 / 3.0 * damping - 1e-15 <= e <= 1.0 - 2.0 / 3.0 * damping + 4.0 / 9.0 * damping**2 + 1e-11


@pytest.mark.parametrize("zeta", [1e-3, 0.1, 0.5, 0.999999, 1.0, 1.000001, 3.0])
def test_kelvin_voigt_parts_where_its_force_is_zero(zeta):
    # x'' + 2 zeta x' + x = 0, x(0) = 0, x'(0) = 1 in closed form, until 2 zeta x' + x = 0
    root = np.sqrt(complex(zeta * zeta - 1.0)) if zeta != 1.0 else 1e-9
    rates = np.array([-zeta + root, -zeta - root])
    turned = np.log((2.0 * zeta * rates[1] + 1.0) / (2.0 * zeta * rates[0] + 1.0))
    time = (turned + (2j * np.pi if turned.imag < 0.0 else 0.0)) / (rates[0] - rates[1])
    velocity = (rates[0] * np.exp(rates[0] * time) - rates[1] * np.exp(rates[1] * time)) / (rates[0] - rates[1])
    law = KelvinVoigt(1.0, 2.0 * zeta)
    assert law.delivered(1.0, 1.0) == approx(-velocity.real, rel=1e-6)  # the closed form cancels next to zeta = 1
    if 0.0 < zeta < 1.0:
        shown = math.exp(-zeta / math.sqrt(1.0 - zeta**2) * (math.pi - 2.0 * math.asin(zeta)))
        assert law.delivered(1.0, 1.0) == approx(shown, rel=1e-9)
        assert law.nominal(1.0, 1.0) == approx(math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta**2)), rel=1e-12)


@each_viscous
@pytest.mark.parametrize("restitution", [0.02, 0.2, 0.5, 0.8, 0.95, 1.0])
def test_two_free_bodies_part_with_the_restitution_asked_for(name, restitution):
    # mu a'' = -F(a, a') with mu = m1 m2 / (m1 + m2), from a' = v until they press no more
    scene = struck_rod(2.0, "free", contact_table(name, restitution=restitution), speed=3.0)
    law, reduced = scene.contact, scene.reduced_mass
    assert reduced == approx(scene.target.mass / 3.0, rel=1e-14)  # m2 = 2 m1
    assert law.delivered(reduced, 3.0) == approx(restitution, abs=1e-9)
    depth = (
        3.0 * math.sqrt(reduced / law.stiffness)
        if name == "kelvin-voigt"
        else (1.25 * reduced * 9.0 / law.stiffness) ** 0.4
    )

    def press(t, y):  # from 1e-9 of the depth on, as some forces jump at the touch
        return law.force(y[0], y[1], 0.0) - 1e-14 * law.force(depth, 3.0, 0.0)

    press.terminal, press.direction = True, -1
    run = solve_ivp(
        lambda t, y: [y[1], -law.force(y[0], y[1], 0.0) / reduced], (0.0, 1e4 * depth / 3.0), [1e-10 * depth, 3.0],
        method="DOP853", rtol=1e-12, atol=1e-14 * depth, events=press,
    )  # fmt: skip
    assert run.status == 1
    assert -run.y[1, -1] / 3.0 == approx(restitution, abs=1e-8)


@each_viscous
def test_nominal_and_delivered_agree_next_to_one(name):
    scene = struck_rod(1.0, "free", contact_table(name, restitution=0.999))
    # both leave out the second order of 1 - e, but Kelvin and Voigt's, whose pull it is that differs: 4 zeta^2
    assert scene.contact.nominal(scene.reduced_mass, scene.speed) == approx(0.999, abs=5e-6)


@each_viscous
@pytest.mark.parametrize("nominal", [0.0, 0.3, 1.0])
def test_nominal_restitution_is_reported_back(name, nominal):
    table = contact_table(name)
    del table["restitution"]
    scene = struck_rod(1.0, "free", table | {"nominal_restitution": nominal})
    assert scene.contact.nominal(scene.reduced_mass, scene.speed) == approx(nominal, abs=1e-7)
    assert scene.contact.delivered(scene.reduced_mass, scene.speed) >= 0.1 * nominal


@cache
def hunt_crossley_scene(speed: float) -> Scene:
    table = contact_table("hunt-crossley", restitution=0.4)
    return struck_rod(1.0, "free", table, speed=speed)


def test_the_restitution_asked_for_is_that_of_the_given_speed():
    slow, fast = hunt_crossley_scene(1.0).contact, hunt_crossley_scene(2.0).contact
    assert fast.damping == approx(0.5 * slow.damping, rel=1e-12)


def test_restitution_is_that_of_the_approach():
    moving = {"kind": "mass", "mass": 1.0, "velocity": -1.0, "radius": 0.1, "material": "steel"}
    scene = sphere_scene({"law": "lee-wang", "restitution": 0.6}, target=moving)
    assert scene.speed == 2.0
    assert scene.contact.delivered(scene.reduced_mass, 2.0) == approx(0.6, abs=1e-9)
