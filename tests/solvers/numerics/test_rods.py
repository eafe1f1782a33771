"""Natural modes of the rod: boundary conditions, orthogonality, and the compliance of those left out."""

import math

import numpy as np
import pytest
from pytest import approx

from tests.catalog import ROD, SUPPORTS, struck_rod

COUNT = 12


@pytest.mark.parametrize("support", SUPPORTS)
def test_modes_meet_the_ends(support):
    modes = struck_rod(1.0, support).target.modes(COUNT)
    ends = np.array([0.0, ROD.length])
    shapes, slopes = modes.shapes(ends), modes.slopes(ends)
    assert shapes[:, 0] == approx(modes.at_contact, rel=1e-14)
    steepest = modes.at_contact * modes.frequencies / ROD.wave_speed
    assert slopes[:, 0] == approx(np.zeros(COUNT), abs=0.0)  # no stress on the struck face
    if support == "fixed":
        assert shapes[:, 1] == approx(np.zeros(COUNT), abs=1e-13 * modes.at_contact[0])
    else:
        assert np.abs(slopes[:, 1] / steepest) == approx(np.zeros(COUNT), abs=1e-13)


def test_frequencies_of_the_fixed_and_free_rod():
    # thesis (5.21): (i - 1/2) pi c / L fixed at the far end; i pi c / L free, the rigid-body motion aside
    unit, i = math.pi * ROD.wave_speed / ROD.length, np.arange(1, COUNT + 1)
    assert struck_rod(1.0, "fixed").target.modes(COUNT).frequencies == approx((i - 0.5) * unit, rel=1e-15)
    assert struck_rod(1.0, "free").target.modes(COUNT).frequencies == approx(i * unit, rel=1e-15)


@pytest.mark.parametrize("support", SUPPORTS)
def test_modes_are_orthonormal_in_mass_and_orthogonal_in_stiffness(support):
    modes = struck_rod(1.0, support).target.modes(COUNT)
    nodes, weights = np.polynomial.legendre.leggauss(60)  # exact to rounding for these cosines
    x, weights = 0.5 * ROD.length * (1.0 + nodes), 0.5 * ROD.length * weights
    shapes, slopes = modes.shapes(x), modes.slopes(x)
    mass = ROD.mass / ROD.length * (shapes * weights) @ shapes.T  # thesis (5.14)
    assert mass == approx(np.eye(COUNT), abs=1e-12)
    stiffness = ROD.material.young * ROD.area * (slopes * weights) @ slopes.T
    assert stiffness / modes.frequencies[-1] ** 2 == approx(
        np.diag((modes.frequencies / modes.frequencies[-1]) ** 2), abs=1e-12
    )


@pytest.mark.parametrize("support", SUPPORTS)
def test_the_slope_is_the_derivative_of_the_shape(support):
    modes = struck_rod(1.0, support).target.modes(COUNT)
    x, h = np.linspace(0.1, 0.9, 7) * ROD.length, 1e-6 * ROD.length
    difference = (modes.shapes(x + h) - modes.shapes(x - h)) / (2.0 * h)
    # h^2 k^3 / 6 with k L = 12 pi, and rounding / h
    assert difference == approx(modes.slopes(x), abs=1e-8 * float(np.abs(modes.slopes(x)).max()))


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("count", [1, 2, 30, 1000])
def test_what_the_modes_left_out_give_way(support, count):
    rod = struck_rod(1.0, support).target
    modes = rod.modes(count)
    kept = float(np.sum((modes.at_contact / modes.frequencies) ** 2))
    # under a slow load the fixed rod gives L / (E A); the free one, beside its rigid motion, a third of that, as
    # sum 2 / (pi i)^2 = 1 / 3
    static = (1.0 if support == "fixed" else 1.0 / 3.0) / rod.stiffness
    # the residual is what 1 / count of a sum leaves: the rounding of the sum counts for it
    assert modes.residual_compliance == approx(static - kept, abs=1e-15 * static * max(count, 10))
    # along the rod it is the sum of their shapes; what 20 000 leave is 2 / (20 000 pi^2) of L / E A
    x, many = np.linspace(0.0, rod.length, 7), rod.modes(20_000)
    rest = (many.at_contact / many.frequencies**2)[count:] @ many.shapes(x)[count:]
    assert modes.left_out("shapes", x) == approx(rest, abs=1.1e-5 / rod.stiffness)
    assert modes.left_out("shapes", x[:1]) == approx(modes.residual_compliance, rel=1e-9)


@pytest.mark.parametrize("support, rigid_mass", [("fixed", math.inf), ("free", ROD.mass)])
def test_the_mass_that_moves_as_a_whole(support, rigid_mass):
    modes = struck_rod(1.0, support).target.modes(4)
    assert modes.rigid_mass == rigid_mass
    assert modes.shortest_period == approx(2.0 * math.pi / modes.frequencies.max(), rel=1e-15)
