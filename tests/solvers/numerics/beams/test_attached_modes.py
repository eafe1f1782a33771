"""Natural modes of a beam on which a point mass rides: between those of the beam alone, and orthogonal with it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

from solvers.numerics.beams.modes import attached_beam_modes, beam_modes, static_shape
from tests.solvers.numerics.beams.test_modes import LENGTH, LINES, SLENDER, SUPPORTS, quadrature

RIDER = 2.133  # [kg], as heavy as the beam of the thesis
COUNT = 30


def mass_products(line, modes, place, rider, end_mass=0.0, others=None):
    """Mass product of the modes with themselves, or with `others`: of the beam, its end mass and the rider."""
    others = modes if others is None else others
    ends = np.array([place, line.length])
    at, at_others = modes.shapes(ends), others.shapes(ends)
    found = np.multiply.outer(at[:, 0], rider * at_others[:, 0]) + np.multiply.outer(
        at[:, 1], end_mass * at_others[:, 1]
    )
    for start, end in ((0.0, place), (place, line.length)):
        if end > start:
            x, weights = quadrature(start, end, 30)
            pairs = [(m.shapes(x), m.slopes(x) + m.shears(x) / line.shear_stiffness) for m in (modes, others)]
            (first, first_turn), (second, second_turn) = pairs
            found = found + line.mass_per_length * (first * weights) @ second.T
            found = found + line.rotary_inertia * (first_turn * weights) @ second_turn.T
    return found


@pytest.mark.slow
@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support", SUPPORTS)
@settings(max_examples=6, deadline=None)
@given(at=st.floats(0.0, 1.0), ratio=st.floats(-4.0, 4.0))
def test_orthonormal_and_between_the_modes_of_the_beam_alone(theory, support, at, ratio):
    line, place, rider = LINES[theory], at * LENGTH, SLENDER.mass * 10.0**ratio
    modes = attached_beam_modes(line, support, place, COUNT, rider)
    bare = beam_modes(line, support, place, COUNT)
    assert mass_products(line, modes, place, rider) == approx(np.eye(COUNT), abs=1e-8)
    assert np.all(modes.frequencies <= bare.frequencies * (1.0 + 1e-14))
    assert np.all(modes.frequencies[1:] >= bare.frequencies[:-1] * (1.0 - 1e-14))
    assert modes.residual_compliance >= 0.0


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("at", [1.0, 1.0 - 1e-13])
def test_at_the_tip_it_is_the_cantilever_with_an_end_mass(theory, at):
    """At the tip it is found as that, a hair before it as a mass anywhere."""
    line = LINES[theory]
    modes = attached_beam_modes(line, "cantilever", at * LENGTH, COUNT, RIDER)
    expected = beam_modes(line, "cantilever", LENGTH, COUNT, RIDER)
    assert modes.frequencies == approx(expected.frequencies, rel=1e-12)
    x = np.linspace(0.0, LENGTH, 9) * (1.0 - 1e-12)  # on the inner side of the rider
    for seen in ("shapes", "slopes", "moments", "shears"):
        found, wanted = np.abs(getattr(modes, seen)(x)), np.abs(getattr(expected, seen)(x))
        assert found == approx(wanted, abs=1e-9 * float(wanted.max()))
    own = beam_modes(line, "cantilever", LENGTH, COUNT, RIDER).means * (line.mass + RIDER)
    signs = np.sign(modes.at_contact * expected.at_contact)
    assert modes.means * line.mass == approx(signs * (own - RIDER * expected.at_contact), abs=1e-11)
    assert modes.residual_compliance == approx(expected.residual_compliance, rel=2e-2)


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("at", [0.5, 0.37])
def test_the_rider_pulls_by_its_inertia(theory, support, at):
    line, place = LINES[theory], at * LENGTH
    modes = attached_beam_modes(line, support, place, COUNT, RIDER)
    near = 1e-9 * LENGTH
    jump = np.subtract(*modes.shears(np.array([place + near, place - near])).T)
    inertia = RIDER * modes.frequencies**2 * modes.at_contact
    assert jump == approx(inertia, abs=1e-6 * float(np.abs(inertia).max()))  # V rises on 2 near by 1e-9 L m omega^2
    for seen in (modes.shapes, modes.slopes, modes.moments):
        values = seen(np.array([place - near, place + near]))
        assert values[:, 0] == approx(values[:, 1], abs=1e-6 * float(np.abs(values).max())) or seen is modes.slopes


def test_a_node_at_the_rider_stays_as_it_is():
    modes = attached_beam_modes(SLENDER, "pinned-pinned", 0.5 * LENGTH, 20, RIDER)
    bare = beam_modes(SLENDER, "pinned-pinned", 0.5 * LENGTH, 20)
    assert modes.frequencies[1::2] == approx(bare.frequencies[1::2], rel=1e-14)
    assert np.all(modes.frequencies[::2] < bare.frequencies[::2] * (1.0 - 1e-3))
    assert np.abs(modes.at_contact[1::2]).max() < 1e-12


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support", ["free-free", "pinned-free"])
@pytest.mark.parametrize("at", [0.5, 0.9])
def test_free_motions_of_beam_and_rider(theory, support, at):
    line, place = LINES[theory], at * LENGTH
    modes = attached_beam_modes(line, support, place, COUNT, RIDER)
    bare = beam_modes(line, support, place, COUNT)
    assert modes.rigid_mass == approx(bare.rigid_mass + RIDER, rel=1e-14)
    x, weights = quadrature(0.0, LENGTH, 30)
    turns = modes.slopes(x) + modes.shears(x) / line.shear_stiffness
    start, end = modes.rigid_shape(np.array([0.0, LENGTH]))
    rigid_turn = np.full_like(x, (end - start) / LENGTH)
    product = line.mass_per_length * modes.shapes(x) @ (weights * modes.rigid_shape(x))
    product += line.rotary_inertia * turns @ (weights * rigid_turn) + RIDER * modes.at_contact
    own = line.mass_per_length * weights @ modes.rigid_shape(x) ** 2 + line.rotary_inertia * LENGTH * rigid_turn[0] ** 2
    assert product == approx(np.zeros(COUNT), abs=3e-3 * np.sqrt(line.mass))  # the shear force jumps inside a panel
    assert own + RIDER == approx(modes.rigid_mass, rel=1e-12)


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support", SUPPORTS)
def test_all_modes_together_give_the_static_compliance(theory, support):
    line, place = LINES[theory], 0.8 * LENGTH
    modes = attached_beam_modes(line, support, place, 60, 0.3)
    static = static_shape(line, support, place, 0.3).compliance
    # phi falls like 1 / (rider k) or 1 / (rider omega), so little is left out
    assert float(np.sum((modes.at_contact / modes.frequencies) ** 2)) == approx(static, rel=1e-4)


@pytest.mark.parametrize("theory", LINES)
def test_without_a_rider_it_is_the_beam_alone(theory):
    line, place = LINES[theory], 0.4 * LENGTH
    bare = beam_modes(line, "clamped-clamped", place, COUNT)
    for rider in (0.0, 1e-13 * line.mass):
        modes = attached_beam_modes(line, "clamped-clamped", place, COUNT, rider)
        assert modes.frequencies == approx(bare.frequencies, rel=1e-12)
        assert np.abs(modes.at_contact) == approx(np.abs(bare.at_contact), abs=1e-10)


def test_first_separation_of_the_thesis():
    """Thesis 5.5 on ten modes: 67 us, 0.87 m/s, and 0.92 m/s projected on the beam alone."""
    together = beam_modes(SLENDER, "cantilever", LENGTH, 10, RIDER)
    alone = beam_modes(SLENDER, "cantilever", LENGTH, 10)
    shares = RIDER * together.at_contact**2

    def force(time):
        return float(RIDER * shares @ (together.frequencies * np.sin(together.frequencies * time)))

    low, high = 60e-6, 70e-6
    assert min(force(time) for time in np.linspace(1e-7, low, 200)) > 0.0 > force(high)
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if force(middle) > 0.0 else (low, middle)
    assert low == approx(67.17055630837957e-6, rel=1e-9)  # printed 67 us
    velocity = shares @ np.cos(together.frequencies * low)
    assert velocity == approx(0.866525, abs=1e-6)
    rates = RIDER * together.at_contact * np.cos(together.frequencies * low)
    projected = mass_products(SLENDER, alone, LENGTH, 0.0, others=together) @ rates
    assert projected @ alone.at_contact == approx(0.916711, abs=1e-6)
