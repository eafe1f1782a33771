"""Dispersion of bending waves in both theories, and the speeds they must not exceed."""

import numpy as np
import pytest
from pytest import approx

from solvers.numerics.beams.modes import (
    BeamLine,
    beam_modes,
    dispersion,
    group_speeds,
    modes_below,
    phase_speeds,
    speed_limit,
)
from tests.solvers.numerics.beams.test_modes import (
    CASES,
    COEFFICIENT,
    DENSITY,
    LINES,
    SHEAR_MODULUS,
    SLENDER,
    THICK,
    YOUNG,
)

BAR_SPEED = np.sqrt(YOUNG / DENSITY)
SHEAR_SPEED = np.sqrt(COEFFICIENT * SHEAR_MODULUS / DENSITY)
WAVENUMBERS = np.geomspace(1e-2, 1e5, 36)  # from waves a thousand beams long to such as no beam theory knows


def test_slender_beams_follow_the_square_of_the_wavenumber():
    lower, upper = dispersion(SLENDER, WAVENUMBERS)
    assert lower == approx(WAVENUMBERS**2 * np.sqrt(SLENDER.bending_stiffness / SLENDER.mass_per_length), rel=1e-14)
    assert np.all(np.isinf(upper))


def test_both_waves_satisfy_the_equation_of_timoshenko():
    line, k2 = THICK, WAVENUMBERS**2
    for frequency in dispersion(line, WAVENUMBERS):
        inertia, rotary = line.mass_per_length * frequency**2, line.rotary_inertia * frequency**2
        stiff, bending = line.shear_stiffness, line.bending_stiffness
        left = (stiff + bending * k2 - rotary) * (stiff * k2 - inertia) - stiff**2 * k2
        terms = (stiff + bending * k2 + rotary) * (stiff * k2 + inertia)
        assert np.all(np.abs(left) <= 1e-15 * terms)


def test_speeds_of_short_and_long_waves():
    lower, upper = phase_speeds(THICK, np.array([1e-3, 1e7]))
    assert lower[1] == approx(SHEAR_SPEED, rel=1e-8)
    assert upper[1] == approx(BAR_SPEED, rel=1e-8)
    assert lower[0] == approx(phase_speeds(SLENDER, np.array([1e-3]))[0][0], rel=1e-7)
    assert dispersion(THICK, np.zeros(1))[1] == approx(THICK.cut_off, rel=1e-15)


@pytest.mark.parametrize("theory", LINES)
def test_group_speed_is_the_slope_of_the_dispersion_curve(theory):
    line, k = LINES[theory], WAVENUMBERS
    after, before = (dispersion(line, k * (1.0 + change)) for change in (1e-5, -1e-5))
    for branch, speed in enumerate(group_speeds(line, k)):
        if np.isfinite(speed).all():
            slope = (after[branch] - before[branch]) / (2e-5 * k)
            # rounding of the frequency over the step, and its square
            assert np.all(np.abs(speed - slope) <= 1e-9 * speed + 1e-10 * after[branch] / k)


def test_energy_never_outruns_the_material():
    lower, upper = group_speeds(THICK, WAVENUMBERS)
    assert np.all(lower < BAR_SPEED) and np.all(upper < BAR_SPEED)
    assert np.all(phase_speeds(THICK, WAVENUMBERS)[0] < BAR_SPEED)
    assert speed_limit(THICK, BAR_SPEED) == np.inf
    assert group_speeds(SLENDER, WAVENUMBERS)[0] == approx(2.0 * phase_speeds(SLENDER, WAVENUMBERS)[0], rel=1e-14)


def test_modes_beyond_the_speed_of_the_material():
    limit = speed_limit(SLENDER, BAR_SPEED)
    wavenumber = np.sqrt(limit * np.sqrt(SLENDER.mass_per_length / SLENDER.bending_stiffness))
    assert phase_speeds(SLENDER, np.array([wavenumber]))[0][0] == approx(BAR_SPEED, rel=1e-14)
    # k r = 1 with the radius of gyration r: z = sqrt(12) L / h = 34.6, and z = (n - 1/2) pi gives eleven modes
    assert modes_below(SLENDER, "cantilever", limit) == 11


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support, mass", CASES)
def test_modes_are_counted_as_they_are_found(theory, support, mass):
    line = LINES[theory]
    frequencies = beam_modes(line, support, 0.2, 300, mass).frequencies
    for n in (0, 1, 12, 13, 14, 113, 298):
        middle = 0.5 * (frequencies[n] + frequencies[n + 1])
        assert modes_below(line, support, middle, mass) == n + 1


def test_no_digit_is_lost_where_both_waves_are_alike():
    line, k = BeamLine(1.0, 1.0, 1.0, rotary_inertia=1e-4, shear_stiffness=1e4), np.array([1e-6, 1.0, 1e6])
    lower, upper = dispersion(line, k)
    assert lower * upper == approx(1e4 * k**2, rel=1e-14)  # product of the roots of the quadratic
