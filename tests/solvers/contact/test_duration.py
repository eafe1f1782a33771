"""How long two compact bodies touch."""

import math

from pytest import approx

from solvers.contact import Hertz, KelvinVoigt, Linear
from solvers.contact.duration import contact_time


def test_laws_of_the_same_constants_have_times_of_their_own():
    """Tuples of the same numbers are equal, whatever law they belong to."""
    half_period = math.pi * math.sqrt(1.5 / 1e9)
    assert contact_time(Hertz(1e9), 1.5, 2.0) > 2.0 * half_period
    assert contact_time(Linear(1e9), 1.5, 2.0) == approx(half_period, rel=1e-12)
    assert contact_time(KelvinVoigt(1e9, 0.0), 1.5, 2.0) == approx(half_period, rel=1e-12)
