"""Two compact bodies pressed together by a law with damping."""

import math

import numpy as np
import pytest
from pytest import approx

from solvers.contact import HuntCrossley, KelvinVoigt, LeeWang
from solvers.contact.damping import LEAST_RESTITUTION, damping_for
from solvers.contact.duration import contact_time
from solvers.numerics import damped_path
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


def test_where_there_is_no_room_it_says_so():
    law, found = HuntCrossley(STIFFNESS, 0.1), Collision.of(50)
    cell = np.empty((damped_path.ROWS, damped_path.STAGES))
    ask, constants = law_function(HuntCrossley), constants_of([law])[0]
    assert damped_path.follow_damped(ask, constants, np.empty(2), 1.0, 1.0, 1e-4, cell, found) == -1
