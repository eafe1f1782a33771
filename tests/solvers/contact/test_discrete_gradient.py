"""The force of one step of the modal kernel, for every contact law."""

import math

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pytest import approx

from solvers.jit.kernels import kernel
from tests.solvers.contact.unit_laws import EPS, each_law, each_unit_law


@kernel
def all_answers(law, indentation, rate, deepest, start, free, compliance):
    return (
        law.force(indentation, rate, deepest),
        law.stored(indentation, deepest),
        law.dent(deepest),
        law.corner(indentation, deepest),
        law.slopes(indentation, rate, deepest),
        law.mean(start, free, 1e3, max(start, deepest)),
        law.mean_force(start, free, compliance, 1e3, 0.0, max(start, deepest), law.unloading(max(start, deepest))),
    )


@pytest.mark.slow
@each_unit_law
@settings(max_examples=40)
@given(
    indentation=st.floats(-1.0, 60.0),
    rate=st.floats(-3.0, 3.0),
    deepest=st.floats(0.0, 60.0),
    start=st.floats(-1.0, 60.0),
    free=st.floats(-60.0, 60.0),
)
def test_compiled_laws_answer_like_plain_python(law, indentation, rate, deepest, start, free):
    assume(abs(indentation - law.dent(deepest)) > 1e-6)
    given_values = law, indentation, rate, deepest, start, free, 0.3
    compiled, plain = all_answers(*given_values), all_answers.py_func(*given_values)
    # compilers may turn powers into products: some last digits, of the largest term where others cancel
    deep = max(indentation, deepest, start, free, 1.0)
    scale = 64.0 * EPS * (law.force(deep, abs(rate), 0.0) + law.force(deep, 1e3 * abs(free - start), 0.0))
    assert compiled[0] == approx(plain[0], rel=64 * EPS, abs=scale)
    assert compiled[1] == approx(plain[1], rel=64 * EPS, abs=scale * deep)
    assert compiled[2:4] == approx(plain[2:4], rel=1e-12)
    assert compiled[4] == approx(plain[4], rel=1e-9, abs=scale)
    assert compiled[5] == approx(plain[5], rel=1e-12, abs=scale * deep)
    assert compiled[6][:2] == approx(plain[6][:2], rel=1e-10, abs=1e-10 * (abs(start) + abs(free)))


@pytest.mark.slow
@each_unit_law
@settings(max_examples=100)
@given(
    start=st.one_of(
        st.just(0.0), st.floats(-10.0, 2.0).map(lambda p: -(10.0**p)), st.floats(-10.0, 2.0).map(lambda p: 10.0**p)
    ),
    travel=st.one_of(st.floats(-8.0, 3.0).map(lambda p: -(10.0**p)), st.floats(-8.0, 3.0).map(lambda p: 10.0**p)),
    compliance=st.floats(-8.0, 8.0).map(lambda p: 10.0**p),
    damping=st.floats(0.0, 100.0),
    deepest=st.floats(0.0, 100.0),
    expected=st.one_of(st.just(0.0), st.floats(-8.0, 8.0).map(lambda p: 10.0**p)),
)
def test_mean_force_works_exactly_what_the_contact_takes_up(law, start, travel, compliance, damping, deepest, expected):
    """In units in which the stiffness is 1: force * path = stored energy gained + lost, whatever happens."""
    if law.LOSSY:
        law = law._replace(damping=damping)
    free, deepest = start + travel, max(start, deepest)
    force, end, lost, memory = law.mean_force(start, free, compliance, 1.0, expected, deepest, law.unloading(deepest))
    assert force >= 0.0 and math.isfinite(force)
    assert memory == approx(law.unloading(max(end, deepest)), rel=1e-12)
    dent = law.dent(deepest)
    if start <= dent and free <= dent:
        assert (force, end, lost) == (0.0, free, 0.0)
    before, after = law.stored(start, deepest), law.stored(end, max(end, deepest))
    # `end` is known to EPS of itself, and the step's equation as well as its terms are; `steep` is its derivative
    deep, fast = max(end, start, 0.0), abs(end - start)
    slope, by_rate = law.slopes(deep, fast, deepest)
    elastic = law.force(deep, 0.0, deepest)
    steep = 1.0 + compliance * (slope + by_rate)
    length_rounding = 16.0 * EPS * (abs(free) + abs(start) + compliance * force + steep * (abs(end) + deepest))
    assert end == approx(free - compliance * force, abs=length_rounding)
    # of the work: that of the lengths, and the force itself is a length over the compliance
    rounding = (force + elastic) * length_rounding + 64.0 * EPS * (before + after)
    rounding += length_rounding / compliance * fast
    assert force * (end - start) == approx(after - before + lost, abs=rounding)
    assert lost >= -rounding  # damping never creates energy
    if not (law.LOSSY or law.PLASTIC):
        assert lost == 0.0
    else:
        assert lost <= before + force * max(end - start, 0.0) + rounding


@each_law
def test_mean_force_of_a_short_step_is_the_force(law):
    # (W(b) - W(a)) / (b - a) = F at the middle + (b - a)^2 / 24 F'', here 1e-12
    start, step = 1e-5, 1e-10
    rate = 1e-6 * start / step
    free = start * (1.0 + 1e-6)
    force, end, *_ = law.mean_force(start, free, 1e-30, 1.0 / step, 0.0, start, law.unloading(start))
    assert end == approx(free, rel=1e-15)
    assert force == approx(law.force(0.5 * (start + free), rate, 0.0), rel=1e-9)
