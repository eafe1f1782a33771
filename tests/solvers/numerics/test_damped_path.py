"""Two compact bodies pressed together by a law with damping."""

import math

import numpy as np
import pytest
from pytest import approx
from scipy.integrate import quad
from scipy.optimize import brentq

from solvers.contact import HuntCrossley, KelvinVoigt, LeeWang
from solvers.contact.damping import LEAST_RESTITUTION, damping_for
from solvers.contact.duration import contact_time
from solvers.numerics import damped_path, path_steps
from solvers.numerics.closed_collisions import Collision
from solvers.numerics.collisions import damped_collision, power_collision
from solvers.numerics.law_functions import constants_of
from solvers.numerics.waves.laws import law_function

STIFFNESS = 1e9


def follow(law, mass: float = 0.7, speed: float = 3.0) -> Collision:
    return damped_collision(law, mass, speed, contact_time(law, mass, speed))


@pytest.mark.parametrize("exponent", [1.0, 1.1, 1.5, 2.2, 3.0])
def test_without_damping_it_is_a_power_of_the_indentation(exponent):
    found, known = follow(LeeWang(STIFFNESS, 0.0, exponent)), power_collision(STIFFNESS, exponent, 0.7, 3.0, 100)
    assert found.time[-1] == approx(known.time[-1], rel=1e-12) and found.rate[-1] == approx(-3.0, rel=1e-13)
    assert found.indentation.max() == approx(known.indentation.max(), rel=1e-13)
    assert found.force.max() == approx(known.force.max(), rel=1e-12) and found.lost.max() < 1e-12 * 3.15


@pytest.mark.parametrize("number", [1e-6, 0.1, 1.0, 10.0])
def test_hunt_crossley_loses_its_first_integral(number):
    """0.4 K a^(5/2) and m (c w - ln(1 + c w)) / c^2 are one sum at all rates w: from v to rest, and to the parting."""
    mass, speed, damping = 0.7, 3.0, number / 3.0
    found = follow(HuntCrossley(STIFFNESS, damping), mass, speed)
    used = mass * (number - math.log1p(number)) / damping**2
    assert found.indentation.max() == approx((2.5 * used / STIFFNESS) ** 0.4, rel=1e-9 if number < 1e-3 else 1e-12)
    left = found.rate[-1] * damping
    assert mass * (left - math.log1p(left)) / damping**2 == approx(used, rel=1e-8 if number < 1e-3 else 1e-10)


@pytest.mark.parametrize("zeta", [1e-3, 0.2, 1.0, 3.0])
def test_kelvin_voigt_presses_at_once_and_parts_without_a_force(zeta):
    mass, speed, damping = 0.7, 3.0, 2.0 * zeta * math.sqrt(STIFFNESS * 0.7)
    law = KelvinVoigt(STIFFNESS, damping)
    found = follow(law, mass, speed)
    assert found.force[0] == approx(damping * speed, rel=1e-12)
    assert found.indentation[-1] == approx(-damping / STIFFNESS * found.rate[-1], rel=1e-9)
    assert -found.rate[-1] / speed == approx(law.delivered(mass, speed), rel=1e-11)


@pytest.mark.parametrize("restitution", [LEAST_RESTITUTION, 0.03, 0.3, 1.0])
@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_every_instant_keeps_the_energy_and_none_is_needed_twice(restitution, mass):
    speed = 0.01
    law = HuntCrossley(STIFFNESS, damping_for(restitution) / speed)
    found = follow(law, mass, speed)
    assert np.all(np.diff(found.time) > 0.0) and np.all(np.diff(found.lost) > -1e-12 * mass * speed**2)
    assert found.time.size < damped_path.USUAL
    assert found.indentation[-1] >= 0.0 and found.force[-1] == 0.0 and np.all(found.force[1:-1] > 0.0)


@pytest.mark.parametrize("restitution", [LEAST_RESTITUTION, 0.02, 0.04, 0.3])
def test_hunt_crossley_touches_until_the_indentation_is_none(restitution):
    """However faintly it presses then: m w dw / K a^(3/2) (1 + c w) is -da, and da / w the time."""
    mass, speed = 0.7, 3.0
    number = damping_for(restitution)
    law = HuntCrossley(STIFFNESS, number / speed)
    found = follow(law, mass, speed)

    def opening(depth):  # the rate [1/damping] of the way back, by the first integral
        left = number - math.log1p(number) - 0.4 * STIFFNESS * depth**2.5 * law.damping**2 / mass
        return math.expm1(brentq(lambda q: math.expm1(q) - q - left, -2.0 - left, 0.0, xtol=1e-14))

    deepest = found.indentation.max()
    # in a = a_max sin(u)^2 neither end is singular
    back, _ = quad(
        lambda u: -2.0 * deepest * math.sin(u) * math.cos(u) * law.damping / opening(deepest * math.sin(u) ** 2),
        0.0, 0.5 * math.pi, epsabs=0.0, epsrel=1e-9,
    )  # fmt: skip
    assert found.time[-1] - found.time[found.indentation.argmax()] == approx(back, rel=1e-6)
    assert found.indentation[-1] == approx(0.0, abs=1e-15 * deepest) and np.all(np.diff(found.time) > 0.0)


@pytest.mark.parametrize(
    "law", [HuntCrossley(STIFFNESS, 0.3), LeeWang(STIFFNESS, 1e5, 1.5), KelvinVoigt(STIFFNESS, 9e3)]
)
def test_the_largest_force_is_an_instant(law):
    """Between any two others none is larger: a path at twice as many instants has the same."""
    found = follow(law)
    k = int(found.force.argmax())
    force = [law.force(a, w, a) for a, w in zip(found.indentation, found.rate, strict=True)]
    slopes = law.slopes(found.indentation[k], found.rate[k], 0.0)
    growth = slopes[0] * found.rate[k] - slopes[1] * found.force[k] / 0.7
    assert 0 < k < int(found.indentation.argmax()) and force[k] == approx(found.force[k], rel=1e-12)
    assert abs(growth) < 1e-10 * slopes[0] * found.rate[0]


def test_where_there_is_no_room_it_says_so():
    law, found = HuntCrossley(STIFFNESS, 0.1), Collision.of(50)
    cell = np.empty((path_steps.ROWS, path_steps.STAGES))
    ask, constants = law_function(HuntCrossley), constants_of([law])[0]
    assert damped_path.follow_damped(ask, constants, np.empty(2), 1.0, 1.0, 1e-4, cell, found) == -1
