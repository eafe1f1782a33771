"""Two compact bodies: closed forms, path integrals and the work of the law."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

from solvers.contact.plastic import PlasticLinear, PlasticPower, YigitChristoforou
from solvers.numerics.collisions import duration_of_power, path_collision, power_collision, sine_collision
from tests.solvers.numerics.plain_laws import MASS, SPEED, STIFFNESS, Power


def test_hertz_in_universal_numbers():
    """Reference case of thesis 3.4: 2.94328 and 5/4, where the sine has pi / 1.068 and 1.14."""
    exact = power_collision(STIFFNESS, 1.5, MASS, SPEED, 1_000)
    deepest, unit = exact.indentation.max(), MASS * SPEED**2
    assert deepest == approx((1.25 * unit / STIFFNESS) ** 0.4, rel=1e-14)  # (3.33), r = K / mu
    assert exact.time[-1] * SPEED / deepest == approx(2.943275184, rel=1e-9)
    assert exact.force.max() * deepest / unit == approx(1.25, rel=1e-14)
    sine = sine_collision(STIFFNESS, MASS, SPEED, 1_000)
    assert sine.time[-1] * SPEED / deepest == approx(2.941566155046623, rel=1e-14)
    assert sine.force.max() * deepest / unit == approx(1.14, rel=1e-14)
    assert sine.impulse[-1] / exact.impulse[-1] == approx(1.14 / 1.068, rel=1e-12)  # 6.7 % too much


@pytest.mark.parametrize("exponent", [1.0, 1.2, 1.5, 2.0, 3.0])
def test_closed_form_is_the_path_integral(exponent):
    exact = power_collision(STIFFNESS, exponent, MASS, SPEED, 2_000)
    found = path_collision(Power(STIFFNESS, exponent), MASS, SPEED)
    assert found.time[-1] == approx(exact.time[-1], rel=1e-12)
    assert found.indentation.max() == approx(exact.indentation.max(), rel=1e-12)
    assert found.rate[-1] == approx(-SPEED, rel=1e-12)
    # the closed form is drawn at 2000 instants, straight in between
    assert np.interp(found.time, exact.time, exact.indentation) == approx(found.indentation, abs=2e-6 * found.time[-1])
    assert np.diff(exact.impulse).min() >= 0.0 and exact.force[0] == exact.force[-1] == 0.0


def test_linear_law_is_a_half_sine():
    exact = power_collision(4e6, 1.0, 1.0, 3.0, 400)
    assert duration_of_power(1.0) == approx(math.pi, rel=1e-15)
    assert exact.force == approx(3.0 * math.sqrt(4e6) * np.sin(2e3 * exact.time), abs=1e-8)


@given(st.floats(0.1, 8.0), st.floats(1e-6, 1e-4))
@settings(max_examples=15)
def test_plastic_restitution_by_work_integrals(speed, yields):
    law = PlasticLinear(2e10, yields)
    found = path_collision(law, MASS, speed)
    deepest = found.indentation.max()
    energy = 0.5 * MASS * speed**2
    elastic = 0.4 * law.stiffness * min(deepest, yields) ** 2.5
    beyond = max(deepest - yields, 0.0)
    slope = 1.5 * law.stiffness * math.sqrt(yields)
    assert elastic + law.stiffness * yields**1.5 * beyond + 0.5 * slope * beyond**2 == approx(energy, rel=1e-11)
    assert -found.rate[-1] == approx(math.sqrt(2.0 * law.stored(deepest, deepest) / MASS), rel=1e-11)
    assert found.lost[-1] == approx(energy - law.stored(deepest, deepest), abs=1e-11 * energy)
    assert np.diff(found.lost).min() >= -1e-12 * energy and np.diff(found.time).min() > 0.0


PLASTIC_LAWS = [
    PlasticLinear(1e9, 1e-7),
    PlasticPower.through(1e9, 1e-7, 1.266e-5),
    PlasticPower.through(1e10, 1e-6, 1e-4),
    YigitChristoforou(1e9, 1e-7),
]


@pytest.mark.parametrize("energy", [1e-9, 1e-5, 1e-3, 0.1, 1e3])
@pytest.mark.parametrize("law", PLASTIC_LAWS, ids=lambda law: law.NAME)
def test_work_of_loading_is_that_of_the_law_to_rounding(law, energy):
    """From less than yield to 1e6 times it; cells that were too wide for a power left 1e-8 to 3e-7."""
    speed = math.sqrt(2.0 * energy / MASS)
    found = path_collision(law, MASS, speed)
    rising = slice(1, int(np.argmax(found.indentation)) + 1)
    work = [depth * law.mean(0.0, depth, 0.0, 0.0)[0] for depth in found.indentation[rising].tolist()]
    assert found.rate[0] == approx(speed, rel=1e-12)
    assert np.array(work) + 0.5 * MASS * found.rate[rising] ** 2 == approx(energy, rel=1e-12)
