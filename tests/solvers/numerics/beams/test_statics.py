"""Beams under a steady force: against text books, their modes, and the balance of forces."""

import numpy as np
import pytest
from pytest import approx

from solvers.numerics.beams.modes import attached_beam_modes, beam_modes, static_compliance, static_shape
from solvers.numerics.beams.statics import rigid_motion
from tests.solvers.numerics.beams.test_modes import LENGTH, LINES, SLENDER, SUPPORTS, quadrature

INSIDE = np.array([0.1, 0.35, 0.5, 0.77, 0.93]) * LENGTH


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("at", [0.0, 0.29, 1.0])
def test_deflection_is_that_of_all_modes(theory, support, at):
    line, place = LINES[theory], at * LENGTH
    static, modes = static_shape(line, support, place), beam_modes(line, support, place, 300)
    shares = modes.at_contact / modes.frequencies**2
    # the terms left out, |phi phi| / omega^2 <= 8 / (m omega^2), of half a wave more each
    left_out = 300.0 * 8.0 / (line.mass * modes.frequencies[-1] ** 2)
    assert static.deflections(INSIDE) == approx(shares @ modes.shapes(INSIDE), abs=left_out)
    assert static.compliance == approx(float(static.deflections(np.array([place]))[0]), rel=1e-15)
    assert static.compliance == static_compliance(line, support, place)


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support", SUPPORTS)
def test_where_it_gives_way_is_mutual(theory, support):
    here, there = 0.3 * LENGTH, 0.8 * LENGTH
    line = LINES[theory]
    one = static_shape(line, support, here).deflections(np.array([there]))[0]
    other = static_shape(line, support, there).deflections(np.array([here]))[0]
    assert one == approx(other, rel=1e-12)


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support", SUPPORTS)
def test_forces_balance_along_the_beam(theory, support):
    line, place, step = LINES[theory], 0.6 * LENGTH, 1e-5 * LENGTH
    static, rigid = static_shape(line, support, place), rigid_motion(line, support, place)

    def derivative(function, x):
        return (function(x + step) - function(x - step)) / (2.0 * step)

    acceleration = rigid.shape(INSIDE) / rigid.mass
    turning = rigid.slope / rigid.mass
    assert derivative(static.shears, INSIDE) == approx(-line.mass_per_length * acceleration, abs=1e-8 / LENGTH)
    # by rotary inertia the moment rises a little faster than the shear force says
    rise = static.shears(INSIDE) + line.rotary_inertia * turning
    assert derivative(static.moments, INSIDE) == approx(rise, abs=1e-8)
    assert derivative(static.deflections, INSIDE) == approx(
        static.slopes(INSIDE), abs=1e-7 * static.compliance / LENGTH
    )
    sheared = derivative(static.shears, INSIDE) / line.shear_stiffness
    bend = line.bending_stiffness * (derivative(static.slopes, INSIDE) + sheared)
    assert bend == approx(static.moments(INSIDE), abs=1e-7 * LENGTH)
    before, after = static.shears(np.array([place, place + 1e-9]))
    assert after - before == approx(1.0, abs=1e-7)


def test_a_cantilever_bends_by_the_lever_and_carries_the_force_to_its_clamp():
    static = static_shape(SLENDER, "cantilever", 0.8 * LENGTH)
    assert static.moments(np.zeros(1)) == approx(0.8 * LENGTH, rel=1e-14)  # y'' > 0: bent away from the force's side
    assert static.shears(np.array([0.0, 0.8, 0.9]) * LENGTH) == approx([-1.0, -1.0, 0.0], abs=1e-14)


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support", ["free-free", "pinned-free"])
@pytest.mark.parametrize("rider", [0.0, 1.7])
def test_a_free_beam_is_bent_by_its_own_inertia(theory, support, rider):
    line, place = LINES[theory], 0.9 * LENGTH
    static = static_shape(line, support, place, rider)
    ends = np.array([0.0, LENGTH])
    assert static.moments(ends) == approx(np.zeros(2), abs=1e-14 * LENGTH)
    assert static.shears(ends)[1] == approx(0.0, abs=1e-14)
    modes = attached_beam_modes(line, support, place, 100, rider) if rider else beam_modes(line, support, place, 100)
    kept = float(np.sum((modes.at_contact / modes.frequencies) ** 2))
    assert static.compliance - kept == approx(modes.residual_compliance, abs=1e-12 * static.compliance)
    assert kept == approx(static.compliance, rel=2e-2)  # by shear the terms fall like 1 / n^2 only
    x, weights = quadrature(0.0, LENGTH)
    motions = [(1.0, 0.0), (-place, 1.0)] if support == "free-free" else [(0.0, 1.0)]
    turns = static.slopes(x) + static.shears(x) / line.shear_stiffness
    for start, slope in motions:  # nothing of the motion as a whole is left in it
        along = line.mass_per_length * (weights * static.deflections(x)) @ (start + slope * x)
        along += line.rotary_inertia * slope * weights @ turns + rider * static.compliance * (start + slope * place)
        assert along == approx(0.0, abs=1e-6 * line.mass * LENGTH * static.compliance)
