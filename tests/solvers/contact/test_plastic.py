"""Laws that leave a dent: forces and dents as printed, and how they grow."""

import math

import pytest
from pytest import approx

from solvers import LAWS as CLASSES
from solvers.contact import PlasticLinear, PlasticPower, YigitChristoforou
from solvers.contact.duration import exponent_of
from solvers.contact.plastic import FULL_OVER_FIRST_YIELD, hardening_exponent
from tests.catalog import WITH_INDENTATION
from tests.solvers.contact.spheres import STEEL_400, STEEL_GROUND, sphere_scene
from tests.solvers.contact.unit_laws import UNIT_LAWS

PLASTIC = [name for name in WITH_INDENTATION if CLASSES[name].PLASTIC]
each_plastic = pytest.mark.parametrize("law", [UNIT_LAWS[name] for name in PLASTIC], ids=PLASTIC)


def test_plastic_forces_as_printed():
    stiffness, begins, deepest = 3e10, 3e-6, 6e-5
    tangent = 1.5 * stiffness * begins**0.5  # (7.8)
    peak = tangent * (deepest - begins) + stiffness * begins**1.5  # (7.9)
    for law in (YigitChristoforou(stiffness, begins), PlasticLinear(stiffness, begins)):
        assert law.force(2e-6, 0.0, 0.0) == approx(stiffness * 2e-6**1.5, rel=1e-15)
        assert law.force(deepest, 0.0, 2e-6) == approx(peak, rel=1e-14)
    down = 0.95 * deepest
    shifted = stiffness * (down**1.5 - deepest**1.5 + begins**1.5) + tangent * (deepest - begins)  # (7.10)
    assert YigitChristoforou(stiffness, begins).force(down, 0.0, deepest) == approx(shifted, rel=1e-12)
    dent = deepest - (begins**1.5 + tangent / stiffness * (deepest - begins)) ** (2.0 / 3.0)  # (7.15)
    law = PlasticLinear(stiffness, begins)
    assert law.dent(deepest) == approx(dent, rel=1e-14)
    assert law.force(down, 0.0, deepest) == approx(stiffness * (down - dent) ** 1.5, rel=1e-13)


@pytest.mark.parametrize("deepest", [1e-5, 2e-4, 3e-4, 1e-3])
def test_plastic_power_as_printed(deepest):
    # steel sphere of R = 40 mm on steel, 400 MPa: E* = E' / 2
    radius, modulus = 0.04, 210e9 / (1.0 - 0.3**2)
    stiffness = 2.0 / 3.0 * modulus * math.sqrt(radius)  # (7.6)
    begins, full = (1.6 * math.pi * 400e6 / modulus) ** 2 * radius, 3200.0 * radius * (400e6 / modulus) ** 2  # (7.26)
    law = PlasticPower.through(stiffness, begins, full)
    n, first = law.exponent, stiffness * begins**1.5
    assert n * law.plastic_stiffness * begins ** (n - 1.0) == approx(1.5 * stiffness * begins**0.5, rel=1e-12)  # (7.34)
    secant = law.plastic_stiffness * (begins**n - full**n) / (begins - full)
    assert secant == approx(5.5 * first / begins, rel=1e-12)
    peak = law.plastic_stiffness * (deepest**n - begins**n) + first  # (7.33)
    assert law.force(deepest, 0.0, 0.0) == approx(peak, rel=1e-13)
    # (7.25), where Differs: a^2 stops at 2 alpha R, of which the thesis says nothing
    square = (1.0 + min((deepest - begins) / (full - begins), 1.0)) * deepest * radius
    unloading = 2.0 / 3.0 * modulus * math.sqrt(2.0 * modulus * square**1.5 / (3.0 * peak))  # (7.38)
    dent = deepest - (peak / unloading) ** (2.0 / 3.0)  # (7.43)
    assert law.dent(deepest) == approx(dent, rel=1e-11)
    assert dent == approx(deepest - 3.0 * peak / (2.0 * modulus * math.sqrt(square)), rel=1e-11)  # Sneddon's slope
    down = dent + 0.7 * (deepest - dent)
    assert law.force(down, 0.0, deepest) == approx(unloading * (down - dent) ** 1.5, rel=1e-11)  # (7.40)


@each_plastic
@pytest.mark.parametrize("deepest", [1.0 + 1e-9, 1.001, 2.0, 29.0, 31.0, 300.0])
def test_dent_and_loss_grow_with_the_deepest_indentation(law, deepest):
    deeper = deepest * 1.01
    assert 0.0 <= law.dent(deepest) < law.dent(deeper) < deeper
    assert law.mean(deepest, deeper, 1.0, deepest)[1] > 0.0
    assert law.corner(0.5 * deepest, deepest) == deepest
    assert law.corner(0.5, 0.7) == 1.0


@each_plastic
def test_every_plastic_law_begins_as_hertz(law):
    assert exponent_of(law) == 1.5  # also one that hardens by a power of its own


def test_exponent_of_plastic_power_depends_on_the_ratio_alone():
    assert hardening_exponent(FULL_OVER_FIRST_YIELD) == approx(1.3252293303562812, rel=1e-13)
    assert hardening_exponent(3200.0 / (2.72 * math.pi**2)) == approx(1.3300252907766617, rel=1e-12)  # with (7.7)


@pytest.mark.parametrize(
    "radius, strength, dent", [(0.04, 400e6, 4.586110958050409e-05), (0.025, 280e6, 5.2317587054376134e-05)]
)
def test_dent_of_yigit_and_christoforou(radius, strength, dent):
    # Differs: (7.12) as printed gives 5.954e-5 and 5.992e-5 m
    material = STEEL_400 | {"yield": strength}
    law = sphere_scene(
        {"law": "yigit-christoforou"},
        {"radius": radius, "material": material},
        {"kind": "half-space", "material": "steel"},
    ).contact
    assert law.dent(6e-5) == approx(dent, rel=1e-12)


@pytest.mark.parametrize(
    "radius, strength, mismatch", [(0.04, 400e6, 0.5346261218518444), (0.025, 280e6, 0.30400116746022404)]
)
def test_dent_of_plastic_power_against_the_misprint(radius, strength, mismatch):
    # Differs: (7.42) prints alpha_m - alpha_Y for alpha_m - alpha_r; force over what it prints, at 6e-5 m
    material = STEEL_400 | {"yield": strength}
    law = sphere_scene({"law": "plastic-power"}, {"radius": radius, "material": material}, STEEL_GROUND).contact
    depth = 6e-5
    force = law.force(depth, 0.0, depth)
    unloading = force / (depth - law.dent(depth)) ** 1.5
    assert force / (unloading * (depth - law.yield_indentation) ** 1.5) == approx(mismatch, rel=1e-9)


def test_the_softer_body_yields_first():
    soft = STEEL_400 | {"yield": 200e6}
    one = sphere_scene({"law": "plastic-linear"}, target={"kind": "half-space", "material": soft}).contact
    both = sphere_scene({"law": "plastic-linear"}, {"material": soft}, {"kind": "half-space", "material": soft}).contact
    assert one == both
