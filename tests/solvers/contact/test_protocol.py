"""What every contact law answers, each alone: force, slopes, energy, and the work along a path."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pytest import approx
from scipy.integrate import quad

import solvers
from solvers.contact import Hertz, HuntCrossley, KelvinVoigt, LankaraniNikravesh, LeeWang, Linear, Power
from solvers.jit.kernels import kernel
from tests.catalog import LAWS, T
from tests.solvers.contact.unit_laws import DEPTHS, EPS, UNIT_LAWS, each_law, each_unit_law

SCALES = st.floats(-8.0, 8.0).map(lambda power: 10.0**power)


def test_the_catalog_knows_every_law():
    assert set(LAWS) == set(solvers.LAWS) == {"rigid", *UNIT_LAWS}
    for name, law in LAWS.items():
        assert name == law.NAME


# --- force, slopes, stored energy -------------------------------------------------------------------------------------


@each_law
@given(indentation=st.floats(-1.0, 1.0), rate=st.floats(-1e6, 1e6), deepest=st.floats(0.0, 1.0))
def test_force_never_pulls_and_starts_where_the_surfaces_meet(law, indentation, rate, deepest):
    force = law.force(indentation, rate, deepest)
    assert force >= 0.0 and math.isfinite(force)
    if indentation <= law.dent(deepest):
        assert force == 0.0
        assert law.stored(indentation, deepest) == 0.0
        assert law.slopes(indentation, rate, deepest)[0] == 0.0
    assert law.stored(indentation, deepest) >= 0.0
    assert 0.0 <= law.dent(deepest) <= deepest
    assert law.corner(indentation, deepest) > indentation


def test_forces_as_printed():
    depth, rate = 3e-5, 0.7
    assert Linear(2e8).force(depth, rate, 0.0) == approx(2e8 * 3e-5, rel=1e-15)  # thesis (7.1)
    assert Hertz(7e9).force(depth, rate, 0.0) == approx(7e9 * 3e-5**1.5, rel=1e-15)  # thesis (7.5)
    assert Power(7e9, 1.2).force(depth, rate, 0.0) == approx(7e9 * 3e-5**1.2, rel=1e-15)  # thesis (7.4)
    for law in (HuntCrossley(7e9, 0.4), LankaraniNikravesh(7e9, 0.4)):
        assert law.force(depth, rate, 0.0) == approx(7e9 * 3e-5**1.5 * (1.0 + 0.4 * 0.7), rel=1e-15)  # thesis 7.3.1
    assert HuntCrossley(7e9, 2.0).force(depth, -0.7, 0.0) == 0.0  # it lets go before it pulls
    assert KelvinVoigt(7e6, 30.0).force(depth, rate, 0.0) == approx(7e6 * 3e-5 + 30.0 * 0.7, rel=1e-15)
    assert KelvinVoigt(7e6, 30.0).force(0.0, rate, 0.0) == 0.0  # it jumps to C v just after
    # (7.3); Differs: printed with sgn(rate) * rate, which would push while the bodies part
    assert LeeWang(7e9, 1e6).force(depth, rate, 0.0) == approx(7e9 * 3e-5**1.5 + 1e6 * 3e-5 * 0.7, rel=1e-15)
    assert LeeWang(7e9, 1e6).force(depth, -0.1, 0.0) == approx(7e9 * 3e-5**1.5 - 1e6 * 3e-5 * 0.1, rel=1e-15)


@pytest.mark.slow
@each_law
@settings(max_examples=40)
@given(indentation=DEPTHS, rate=st.floats(-2.0, 2.0), deepest=DEPTHS)
def test_slopes_are_derivatives_of_the_force(law, indentation, rate, deepest):
    h = 1e-5  # central differences: h^2 / 24 of the third derivative, which is below 1 in these units, and EPS / h
    kinks = [law.dent(deepest), deepest, getattr(law, "yield_indentation", 0.0)]
    assume(all(abs(indentation - kink) > 1e-3 * kink for kink in kinks))
    assume(indentation > deepest or indentation - law.dent(deepest) > 1e-2 * indentation)
    low, high = indentation * (1.0 - h), indentation * (1.0 + h)
    here = law.force(indentation * (1.0 - h), rate - h, deepest)
    assume(here > 1e-3 * law.force(indentation, abs(rate), deepest))  # not across the kink where the force has run out
    by_depth, by_rate = law.slopes(indentation, rate, deepest)
    difference = (law.force(high, rate, deepest) - law.force(low, rate, deepest)) / (2.0 * h * indentation)
    assert by_depth == approx(difference, rel=1e-6, abs=1e-9 * law.force(indentation, abs(rate), deepest) / indentation)
    difference = (law.force(indentation, rate + h, deepest) - law.force(indentation, rate - h, deepest)) / (2.0 * h)
    assert by_rate == approx(difference, rel=1e-6, abs=1e-9 * law.force(indentation, 2.0, deepest))


@each_law
@given(indentation=DEPTHS, deepest=DEPTHS)
def test_stored_energy_is_the_work_of_unloading(law, indentation, deepest):
    deepest = max(indentation, deepest)
    dent = law.dent(deepest)
    assume(indentation > dent)
    # in y^2 = depth the integrand is a polynomial for most laws, and smooth for the others
    root = math.sqrt(indentation - dent)
    work, _ = quad(
        lambda y: law.force(dent + y * y, 0.0, deepest * (1.0 + 4.0 * EPS)) * 2.0 * y, 0.0, root, epsabs=0.0,
        epsrel=1e-10, limit=200,
    )  # fmt: skip
    # deepest and dent are known to EPS of themselves
    slack = 64.0 * EPS * deepest * law.force(indentation, 0.0, deepest)
    assert law.stored(indentation, deepest) == approx(work, rel=1e-9, abs=slack)


@each_unit_law
@pytest.mark.parametrize("deepest", [0.0, 0.5, 1.0, 3.0, 30.0, 100.0])
def test_continuous_across_branches(law, deepest):
    kinks = {law.dent(deepest), deepest, 1.0, 30.0}
    for kink in kinks:
        below, above = law.force(kink * (1.0 - 1e-13), 0.0, deepest), law.force(kink * (1.0 + 1e-13), 0.0, deepest)
        assert above == approx(below, rel=1e-11, abs=1e-11 * law.force(max(deepest, 1.0), 0.0, 0.0))


@pytest.mark.slow
@each_law
@settings(max_examples=40)
@given(length=SCALES, speed=SCALES, force=SCALES, indentation=DEPTHS, rate=st.floats(-1.0, 1.0), deepest=DEPTHS)
def test_a_scaled_law_is_the_same_law_in_other_units(law, length, speed, force, indentation, rate, deepest):
    scaled = law.scaled(length, speed, force)
    assume(abs(indentation - law.dent(deepest)) > 1e-3 * indentation)
    there = scaled.force(indentation / length, rate / speed, deepest / length) * force
    largest = law.force(max(indentation, deepest), abs(rate), 0.0)
    assert there == approx(law.force(indentation, rate, deepest), rel=1e-10, abs=1e-13 * largest)
    stored = scaled.stored(indentation / length, deepest / length) * force * length
    assert stored == approx(law.stored(indentation, deepest), rel=1e-10, abs=1e-13 * largest * deepest)


# --- the path from one indentation to another -------------------------------------------------------------------------


def mean_by_quadrature(law, start, end, rate, deepest):
    """Of the force along the straight path, split where its formula changes."""
    closing = (end - start) * rate
    inner = [law.dent(deepest), deepest, 1.0, 30.0, 0.0]
    if closing < 0.0 and law.LOSSY:  # where the dashpot outweighs the spring
        inner += [0.7 * -closing, (0.7 * -closing) ** 2.0]
    low, high = min(start, end), max(start, end)
    cuts = [low, *sorted(x for x in inner if low < x < high), high]
    rising = end > start

    def force(a):
        return law.force(a, closing, deepest if rising else max(deepest, start * (1.0 + 4.0 * EPS)))

    total = 0.0
    for left, right in pairwise(cuts):
        # in y^2 = a - left, as the force may start with a root
        total += quad(lambda y, x=left: force(x + y * y) * 2.0 * y, 0.0, math.sqrt(right - left), epsrel=1e-12)[0]
    return total / (high - low)


@pytest.mark.slow
@each_unit_law
@settings(max_examples=60)
@given(
    start=st.floats(-3.0, 60.0),
    travel=st.one_of(st.floats(0.1, 60.0), st.floats(-60.0, -0.1)),
    deepest=st.floats(0.0, 60.0),
    rate=st.floats(0.0, 2.0),
)
def test_mean_is_that_of_the_force_along_the_path(law, start, travel, deepest, rate):
    deepest, end = max(deepest, start), start + travel
    mean, lost = law.mean(start, end, rate, deepest)
    scale = law.force(max(start, end, deepest), abs(travel) * rate, deepest)
    assert mean == approx(mean_by_quadrature(law, start, end, rate, deepest), rel=1e-7, abs=1e-8 * scale)
    before, after = law.stored(start, deepest), law.stored(end, max(end, deepest))
    assert mean * travel == approx(after - before + lost, abs=1e-12 * (scale * abs(travel) + before + after))
    assert lost >= -4.0 * EPS * max(before, after)
    if not (law.LOSSY or law.PLASTIC):
        assert lost == 0.0
    if law.PLASTIC and max(start, end) <= deepest:
        assert lost == 0.0  # unloading and reloading are elastic


@each_unit_law
@pytest.mark.parametrize("relative", [1e-3, 1e-8, 1e-15, 0.0, -1e-15, -1e-8, -1e-3])
def test_mean_over_a_short_path_is_the_force(law, relative):
    for start, deepest in ((0.3, 0.3), (3.0, 3.0), (2.99, 3.0), (50.0, 50.0)):
        end = start * (1.0 + relative)
        mean, _ = law.mean(start, end, 0.0, deepest)
        middle = 0.5 * (start + end)
        # F'' (b - a)^2 / 24 and, where yielding sets in at `deepest`, the kink; 16 EPS of F', as the ends are rounded
        inside = law.force(middle, 0.0, deepest if relative > 0.0 else max(deepest, start) * (1.0 + EPS))
        assert mean == approx(inside, rel=relative**2 + 100.0 * EPS)


@kernel
def wandered(law, marks, rates):
    """Work and loss along straight paths between these indentations, and how deep they went."""
    work, lost, deepest, at, least = 0.0, 0.0, 0.0, marks[0], 0.0
    for k in range(marks.size - 1):
        mean, loss = law.mean(at, marks[k + 1], rates[k], deepest)
        work += mean * (marks[k + 1] - at)
        lost += loss
        at = marks[k + 1]
        deepest = max(deepest, at)
        # what the contact has been given less what it has lost is what it can still give
        least = min(least, lost)
    return work, lost, deepest, least


@pytest.mark.slow
@each_unit_law
def test_no_energy_from_random_paths(law):
    # 1e5 steps of loading, unloading, parting and meeting again, a few of them deeper than ever before
    random = np.random.default_rng(7)
    marks = np.abs(random.standard_normal(100_001)) ** 3 * random.choice([1.0, 1.0, 1.0, -1.0], 100_001)
    marks[0], marks[-1] = -1.0, -1.0
    work, lost, deepest, least = wandered(law, marks, random.uniform(0.0, 1.0, 100_000))
    assert deepest > 30.0
    assert least >= -1e-13
    largest = law.stored(deepest, deepest)
    # it ends open: all that it was given and did not lose, it gave back; EPS of the largest at each step
    assert work == approx(lost, rel=1e-10, abs=1e-11 * largest)
    assert lost > 0.1 * largest if law.LOSSY or law.PLASTIC else lost == 0.0


@each_unit_law
@pytest.mark.parametrize("top", [0.8, 5.0, 60.0])
def test_area_of_the_loop_is_what_is_lost(law, top):
    """F(alpha) drawn point by point at a steady rate, loaded, unloaded, reloaded: its area against the losses."""
    rate = 0.4
    legs = ((0.0, top), (top, 0.2 * top), (0.2 * top, top), (top, 0.0))
    marks = np.concatenate([np.linspace(*leg, steps) for leg, steps in zip(legs, (200, 157, 90, 300), strict=True)])
    marks = marks[np.append(True, np.diff(marks) != 0.0)]
    lost = wandered(law, marks, rate / np.abs(np.diff(marks)))[1]
    deepest, area = 0.0, 0.0
    for start, end in legs:
        area += mean_by_quadrature(law, start, end, rate / abs(end - start), deepest) * (end - start)
        deepest = top
    largest = law.stored(top, 0.0)
    assert lost == approx(area, abs=1e-10 * largest)
    if law.LOSSY or (law.PLASTIC and top > 1.0):
        assert lost > 1e-3 * largest


# --- limits -----------------------------------------------------------------------------------------------------------


def test_units_of_the_catalog():
    assert LAWS["plastic-power"].yield_indentation == 0.02 * T
