"""Contact laws, each alone: what they answer, and the force of one step of the modal kernel."""

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pytest import approx
from scipy.integrate import quad, solve_ivp

import solvers
from solvers import Scene
from solvers.contact.elastic import Hertz, Linear
from solvers.contact.viscous import HuntCrossley, damping_for, delivered_restitution
from solvers.jit import kernel
from tests.catalog import LAWS, SCENES, WITH_INDENTATION, contact_table, struck_rod

EPS = np.finfo(float).eps
DEPTHS = st.floats(-12.0, 0.0).map(lambda power: 10.0**power)  # m
SCALES = st.floats(-8.0, 8.0).map(lambda power: 10.0**power)

each_law = pytest.mark.parametrize("law", [LAWS[name] for name in WITH_INDENTATION], ids=WITH_INDENTATION)


def test_the_catalog_knows_every_law():
    assert set(LAWS) == set(solvers.LAWS) == {"rigid", "linear", "hertz", "hunt-crossley"}
    for name, law in LAWS.items():
        assert name == law.NAME


# --- the four questions -----------------------------------------------------------------------------------------------


@each_law
@given(indentation=st.floats(-1.0, 1.0), rate=st.floats(-1e6, 1e6))
def test_force_never_pulls_and_starts_with_the_touch(law, indentation, rate):
    force = law.force(indentation, rate, 0.0)
    assert force >= 0.0 and math.isfinite(force)
    if indentation <= 0.0:
        assert force == 0.0
        assert law.stored(indentation, 0.0) == 0.0
        assert law.slopes(indentation, rate, 0.0)[0] == 0.0
    else:
        assert law.stored(indentation, 0.0) > 0.0 or indentation < 1e-100


def test_forces_as_printed():
    depth, rate = 3e-5, 0.7
    assert Linear(2e8).force(depth, rate, 0.0) == approx(2e8 * 3e-5, rel=1e-15)  # thesis (7.1)
    assert Hertz(7e9).force(depth, rate, 0.0) == approx(7e9 * 3e-5**1.5, rel=1e-15)  # thesis (7.5)
    damped = HuntCrossley(7e9, 0.4).force(depth, rate, 0.0)
    assert damped == approx(7e9 * 3e-5**1.5 * (1.0 + 0.4 * 0.7), rel=1e-15)  # thesis 7.3.1
    assert HuntCrossley(7e9, 2.0).force(depth, -0.7, 0.0) == 0.0  # it lets go before it pulls


@each_law
@given(indentation=DEPTHS, rate=st.floats(-2.0, 2.0))
def test_slopes_are_derivatives_of_the_force(law, indentation, rate):
    if law.NAME == "hunt-crossley":
        assume(abs(1.0 + law.loss * rate) > 1e-3)  # not across the kink where the force has run out
    by_depth, by_rate = law.slopes(indentation, rate, 0.0)
    h = 1e-5  # central differences: h^2 / 24 of the third derivative, which is below 1 in these units, and EPS / h
    difference = law.force(indentation * (1.0 + h), rate, 0.0) - law.force(indentation * (1.0 - h), rate, 0.0)
    assert by_depth == approx(difference / (2.0 * h * indentation), rel=1e-9, abs=1e-300)
    difference = law.force(indentation, rate + h, 0.0) - law.force(indentation, rate - h, 0.0)
    assert by_rate == approx(difference / (2.0 * h), rel=1e-7, abs=1e-9 * law.force(indentation, 0.0, 0.0))


@each_law
@given(indentation=DEPTHS)
def test_work_is_the_integral_of_the_elastic_force(law, indentation):
    # in y^2 = depth the integrand is a polynomial, which quad integrates to rounding
    work, _ = quad(
        lambda y: law.force(y * y, 0.0, 0.0) * 2.0 * y, 0.0, math.sqrt(indentation), epsabs=0.0, epsrel=1e-12
    )
    assert law.stored(indentation, 0.0) == approx(work, rel=1e-12)


@each_law
@given(length=SCALES, speed=SCALES, force=SCALES, indentation=DEPTHS, rate=st.floats(-1.0, 1.0))
def test_a_scaled_law_is_the_same_law_in_other_units(law, length, speed, force, indentation, rate):
    scaled = law.scaled(length, speed, force)
    there = scaled.force(indentation / length, rate / speed, 0.0) * force
    assert there == approx(law.force(indentation, rate, 0.0), rel=1e-12, abs=1e-13 * law.force(indentation, 0.0, 0.0))
    assert scaled.stored(indentation / length, 0.0) * force * length == approx(law.stored(indentation, 0.0), rel=1e-12)


@kernel
def all_answers(law, indentation, rate, start, free, compliance):
    return (
        law.force(indentation, rate, 0.0),
        law.stored(indentation, 0.0),
        law.slopes(indentation, rate, 0.0),
        law.mean_force(start, free, compliance, 1e6, 0.0, 0.0),
    )


@each_law
@given(
    indentation=st.floats(-1e-3, 1e-3),
    rate=st.floats(-3.0, 3.0),
    start=st.floats(-1e-4, 1e-3),
    free=st.floats(-1e-3, 1e-3),
)
def test_compiled_laws_answer_like_plain_python(law, indentation, rate, start, free):
    given_values = law, indentation, rate, start, free, 1e-9
    compiled, plain = all_answers(*given_values), all_answers.py_func(*given_values)
    # compilers may turn powers into products: some last digits, of the largest term where the force factor cancels
    scale = law.force(indentation, 0.0, 0.0)
    assert compiled[0] == approx(plain[0], rel=8 * EPS, abs=8 * EPS * scale)
    assert compiled[1] == approx(plain[1], rel=8 * EPS)
    assert compiled[2] == approx(plain[2], rel=8 * EPS, abs=8 * EPS * (abs(plain[2][0]) + abs(plain[2][1])))
    assert compiled[3] == approx(plain[3], rel=1e-12, abs=1e-12 * (abs(start) + abs(free)))


# --- the force of one step --------------------------------------------------------------------------------------------


@each_law
@settings(max_examples=500)
@given(
    start=st.one_of(
        st.just(0.0), st.floats(-10.0, 2.0).map(lambda p: -(10.0**p)), st.floats(-10.0, 2.0).map(lambda p: 10.0**p)
    ),
    travel=st.one_of(st.floats(-8.0, 3.0).map(lambda p: -(10.0**p)), st.floats(-8.0, 3.0).map(lambda p: 10.0**p)),
    compliance=st.floats(-8.0, 8.0).map(lambda p: 10.0**p),
    damping=st.floats(0.0, 100.0),
    expected=st.one_of(st.just(0.0), st.floats(-8.0, 8.0).map(lambda p: 10.0**p)),
)
def test_mean_force_works_exactly_what_the_contact_takes_up(law, start, travel, compliance, damping, expected):
    """In units in which the stiffness is 1: force * path = stored energy gained + lost, whatever happens."""
    law = law._replace(stiffness=1.0)
    if law.NAME == "hunt-crossley":
        law = law._replace(loss=damping)
    free = start + travel
    force, end, lost = law.mean_force(start, free, compliance, 1.0, expected, max(start, 0.0))
    assert force >= 0.0 and math.isfinite(force)
    if start <= 0.0 and free <= 0.0:
        assert (force, end, lost) == (0.0, free, 0.0)
    before, after = law.stored(start, 0.0), law.stored(end, 0.0)
    # `end` is known to EPS of itself, and the step's equation as well as its terms are; `steep` is its derivative
    deep = max(end, start, 0.0)
    slope, elastic = law.slopes(deep, 0.0, 0.0)[0], law.force(deep, 0.0, 0.0)
    steep = 1.0 + compliance * (slope * (1.0 + damping * abs(end - start)) + damping * elastic)
    length_rounding = 16.0 * EPS * (abs(free) + abs(start) + compliance * force + steep * abs(end))
    assert end == approx(free - compliance * force, abs=length_rounding)
    # of the work: that of the lengths, and the force itself is a length over the compliance
    rounding = (force + elastic) * length_rounding + 64.0 * EPS * (before + after)
    rounding += length_rounding / compliance * abs(end - start)
    assert force * (end - start) == approx(after - before + lost, abs=rounding)
    assert lost >= -rounding  # damping never creates energy
    if law.NAME != "hunt-crossley" or damping == 0.0:
        assert lost == approx(0.0, abs=rounding)
    else:
        assert lost <= before + force * max(end - start, 0.0) + rounding


@each_law
def test_mean_force_of_a_short_step_is_the_force(law):
    # (W(b) - W(a)) / (b - a) = F at the middle + (b - a)^2 / 24 F'', here 1e-12
    start, step = 1e-5, 1e-10
    rate = 1e-6 * start / step
    free = start * (1.0 + 1e-6)
    force, end, _ = law.mean_force(start, free, 1e-30, 1.0 / step, 0.0, 0.0)
    assert end == approx(free, rel=1e-15)
    assert force == approx(law.force(0.5 * (start + free), rate, 0.0), rel=1e-9)


# --- Hertz from the bodies --------------------------------------------------------------------------------------------


def test_hertz_stiffness_of_a_steel_ball_on_the_bronze_rod():
    # 4/3 E* sqrt(R), thesis 3.4.1; Differs: (7.6) prints K for two bodies of one material
    scene = SCENES["bronze-rod-steel-ball"]
    compliance = (1.0 - 0.3**2) / 210e9 + (1.0 - 0.34**2) / 98e9
    assert scene.contact.stiffness == approx(4.0 / 3.0 / compliance * math.sqrt(0.015), rel=1e-14)


# --- Hunt-Crossley and the restitution it delivers --------------------------------------------------------------------


@pytest.mark.parametrize("nominal, delivered", [(0.9, 0.90902), (0.5, 0.66296), (0.1, 0.51583), (0.0, 0.48774)])
def test_the_usual_damping_delivers_less_loss_than_its_name(nominal, delivered):
    # d (1 + e) = ln((1 + d) / (1 - d e)) with the usual d = 3 (1 - e) / 2, thesis 7.3.1; 5 digits
    assert delivered_restitution(1.5 * (1.0 - nominal)) == approx(delivered, abs=5e-6)


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


@pytest.mark.parametrize("restitution", [0.02, 0.2, 0.5, 0.8, 0.95, 1.0])
def test_two_free_bodies_part_with_the_restitution_asked_for(restitution):
    # mu a'' = -F(a, a') with mu = m1 m2 / (m1 + m2), from a' = v until a = 0 again
    scene = struck_rod(1.0, "free", contact_table("hunt-crossley", restitution=restitution), speed=3.0)
    law, reduced = scene.contact, 0.7

    def part(t, y):
        return y[0]

    part.terminal, part.direction = True, -1
    depth = (1.25 * reduced * 9.0 / law.stiffness) ** 0.4
    run = solve_ivp(
        lambda t, y: [y[1], -law.force(y[0], y[1], 0.0) / reduced], (0.0, 1e4 * depth / 3.0), [0.0, 3.0],
        method="DOP853", rtol=1e-12, atol=1e-14 * depth, events=part,
    )  # fmt: skip
    assert run.status == 1
    assert -run.y[1, -1] / 3.0 == approx(restitution, abs=1e-8)


@cache
def hunt_crossley_scene(speed: float) -> Scene:
    table = contact_table("hunt-crossley", restitution=0.4)
    return struck_rod(1.0, "free", table, speed=speed)


def test_the_restitution_asked_for_is_that_of_the_given_speed():
    assert hunt_crossley_scene(2.0).contact.loss == approx(0.5 * hunt_crossley_scene(1.0).contact.loss, rel=1e-12)
