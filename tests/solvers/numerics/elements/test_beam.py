"""Meshes of beams as arrays: exact under static loads, of fourth order in frequency, without shear locking."""

import math
from typing import NamedTuple

import numpy as np
import pytest
from pytest import approx

from solvers.numerics.elements.banded import full, times
from solvers.numerics.elements.beam import HELD, Element, beam_mesh
from solvers.numerics.elements.line import line as both
from solvers.numerics.elements.mesh import point_mesh
from solvers.numerics.elements.modes import mesh_modes
from tests.catalog import observed_order


class BeamLine(NamedTuple):
    length: float
    bending_stiffness: float
    mass_per_length: float
    rotary_inertia: float
    shear_stiffness: float


# thesis 8.3: 0.3 m of 3 cm x 3 cm, E 210 GPa, rho 7900, nu 0.3
EULER = BeamLine(0.3, 14175.0, 7.11, 0.0, math.inf)
DEPTH = 0.03


def timoshenko(slenderness: float = 10.0) -> BeamLine:
    """The same length, bending stiffness and mass, with shear and rotary inertia of a depth of L / slenderness."""
    depth = EULER.length / slenderness
    kappa_g_over_e = 10.0 * 1.3 / (12.0 + 11.0 * 0.3) / 2.6
    return EULER._replace(
        rotary_inertia=EULER.mass_per_length * depth**2 / 12.0,
        shear_stiffness=kappa_g_over_e * 12.0 / depth**2 * EULER.bending_stiffness,
    )


LINES = [EULER, timoshenko()]
THEORIES = pytest.mark.parametrize("line", LINES, ids=["euler-bernoulli", "timoshenko"])

# under 1 N at a = place: bending part of y(a) E I / L^3 and shear part of y(a) kappa G A / L
STATIC = [
    ("cantilever", 1.0, 1.0 / 3.0, 1.0),
    ("cantilever", 0.4, 0.4**3 / 3.0, 0.4),
    ("pinned-pinned", 0.5, 1.0 / 48.0, 0.25),
    ("pinned-pinned", 0.3, (0.3 * 0.7) ** 2 / 3.0, 0.3 * 0.7),
    ("clamped-clamped", 0.5, 1.0 / 192.0, 0.25),
]


@THEORIES
@pytest.mark.parametrize("support, at, bending, shear", STATIC)
@pytest.mark.parametrize("elements", [2, 7])
def test_static_deflection_is_exact_at_the_struck_node(line, support, at, bending, shear, elements):
    mesh = beam_mesh(line, support, at * line.length, elements)
    load = np.eye(mesh.size)[mesh.struck]
    bent = np.linalg.solve(full(mesh.stiffness), load)
    exact = bending * line.length**3 / line.bending_stiffness + shear * line.length / line.shear_stiffness
    assert bent[mesh.struck] == approx(exact, rel=1e-10)
    # the unit force is the jump of the shear force, and the slope of the moment
    near = np.array([1.0 - 1e-9, 1.0 + 1e-9]) * mesh.place[np.searchsorted(mesh.place, at * line.length - 1e-9)]
    before, behind = bent @ mesh.shears(near) if at < 1.0 else (float((bent @ mesh.shears(near[:1]))[0]), 0.0)
    assert behind - before == approx(1.0, rel=1e-8)
    x = np.linspace(0.01, 0.99 * at, 5) * line.length
    step = 1e-6 * line.length
    slope = (bent @ mesh.moments(x + step) - bent @ mesh.moments(x - step)) / (2.0 * step)
    assert slope == approx(bent @ mesh.shears(x), rel=1e-6)
    displaced = (bent @ mesh.shapes(x + step) - bent @ mesh.shapes(x - step)) / (2.0 * step)
    assert displaced == approx(bent @ mesh.slopes(x), rel=1e-6, abs=1e-9 * abs(bent[mesh.struck]))


@THEORIES
@pytest.mark.parametrize("support", HELD)
def test_moments_and_shear_forces_of_modes_are_in_balance_with_inertia(line, support):
    """V' = -m y'' = m omega^2 y and M' = V + (rotary) psi'', from end to end and without jumps at the nodes."""
    mesh = beam_mesh(line, support, 0.6 * line.length, 9)
    modes = mesh_modes(mesh, 5)
    squares = modes.frequencies[:, None] ** 2
    x = (np.linspace(0.0, 1.0, 40)[1:-1] + 1e-3) * line.length
    step = 1e-6 * line.length
    change = (modes.shears(x + step) - modes.shears(x - step)) / (2.0 * step)
    carried = line.mass_per_length * squares * modes.shapes(x)
    assert change == approx(carried, abs=1e-6 * np.abs(carried).max())
    if not line.rotary_inertia:
        change = (modes.moments(x + step) - modes.moments(x - step)) / (2.0 * step)
        assert change == approx(modes.shears(x), abs=1e-6 * np.abs(change).max())
    nodes = mesh.place[1:-1]
    for field in (modes.shears, modes.moments):
        beside = field(nodes - 1e-12), field(nodes + 1e-12)
        assert beside[0] == approx(beside[1], abs=1e-8 * np.abs(beside[1]).max())
        ends = {"free-free": [0, -1], "cantilever": [-1], "pinned-free": [-1]}.get(support, [])
        assert field(mesh.place[ends]) == approx(0.0, abs=1e-8 * np.abs(beside[1]).max())


def test_the_hermite_element_of_the_textbooks():
    length, mass = 0.5, 3.0
    element = Element(np.array([length]), np.zeros(1))
    found = 420.0 / mass * element.mass(mass / length, 0.0)[0]
    own = [[156, 22 * length], [22 * length, 4 * length**2]]
    other = [[54, -13 * length], [13 * length, -3 * length**2]]
    assert found[:2, :2] == approx(np.array(own), rel=1e-13)
    assert found[:2, 2:] == approx(np.array(other), rel=1e-13)
    stiffness = length**3 * element.stiffness(1.0)[0]
    assert stiffness[0] == approx(np.array([12.0, 6 * length, -12.0, 6 * length]))
    assert stiffness[1] == approx(np.array([6 * length, 4 * length**2, -6 * length, 2 * length**2]))


def test_neighbour_and_mass_of_thesis_8_3():
    mesh = beam_mesh(EULER, "cantilever", EULER.length, 15)
    assert mesh.neighbour == approx(1.771875e9, rel=1e-12)  # E I / l^3
    assert mesh.total_mass == approx(2.133, rel=1e-12)
    assert mesh.size == 30
    assert beam_mesh(EULER, "cantilever", EULER.length, 15, 1.5).total_mass == approx(3.633, rel=1e-12)


# k L of the lowest modes: textbooks
ROOTS = {
    "cantilever": (1.8751040687119611, 4.694091132974174, 7.854757438237613),
    "pinned-pinned": (math.pi, 2.0 * math.pi, 3.0 * math.pi),
    "clamped-clamped": (4.730040744862704, 7.853204624095838, 10.995607838001671),
    "free-free": (4.730040744862704, 7.853204624095838, 10.995607838001671),
    "pinned-free": (3.9266023120479188, 7.068582745628732, 10.21017612281303),
}
UNIT = math.sqrt(EULER.bending_stiffness / EULER.mass_per_length) / EULER.length**2


@pytest.mark.parametrize("support", HELD)
def test_frequencies_are_of_fourth_order(support):
    exact = ROOTS[support][2] ** 2 * UNIT
    counts = [10, 20, 40]
    third = [mesh_modes(beam_mesh(EULER, support, 0.5 * EULER.length, n), 3).frequencies[2] for n in counts]
    # (k l)^4 / 1440, the first term of the dispersion of the consistent element
    assert third[-1] / exact - 1.0 == approx((ROOTS[support][2] / counts[-1]) ** 4 / 1440.0, rel=0.03)
    assert -observed_order(dict(zip(counts, third, strict=True)).__getitem__, counts) == approx(4.0, abs=0.15)
    lowest = mesh_modes(beam_mesh(EULER, support, 0.5 * EULER.length, 300), 3).frequencies
    assert lowest == approx(np.square(ROOTS[support]) * UNIT, rel=1e-6)  # rounding grows with elements^4


@pytest.mark.parametrize("support", HELD)
@pytest.mark.parametrize("slenderness", [10.0, 1e3, 1e5])
def test_no_shear_locking(support, slenderness):
    slender = mesh_modes(beam_mesh(timoshenko(slenderness), support, 0.5 * EULER.length, 20), 3).frequencies
    # shear and rotary inertia lower a frequency by about (1 + E / kappa G) (k L / slenderness)^2 / 24
    bare, wave = mesh_modes(beam_mesh(EULER, support, 0.5 * EULER.length, 20), 3).frequencies, ROOTS[support][2]
    lowered = (1.0 + 2.6 / 0.85) * (wave / slenderness) ** 2 / 24.0
    assert np.all(slender < bare * (1.0 + 1e-8))
    assert slender == approx(bare, rel=3.0 * lowered + 1e-8)


def test_timoshenko_frequencies_tend_to_the_exact_ones():
    # the characteristic equation of the cantilever of 8.3 with kappa = 5 / 6 and nu = 0.3
    exact = [1730.632651997779, 10372.278915640025, 27280.677212934363, 49486.273722382306]
    shears = timoshenko()._replace(shear_stiffness=5.0 / 6.0 * 210e9 / 2.6 * 9e-4)
    errors = [mesh_modes(beam_mesh(shears, "cantilever", 0.3, n), 4).frequencies / exact - 1.0 for n in (20, 40)]
    assert np.all(np.abs(errors[1]) < [2e-6, 5e-5, 3e-4, 1e-3])
    assert errors[0] / errors[1] == approx(
        4.0, rel=0.1
    )  # of second order where shear counts, as it is constant in each


@THEORIES
@pytest.mark.parametrize("support", HELD)
def test_modes_kept_and_left_out_make_the_whole_compliance(line, support):
    mesh = beam_mesh(line, support, 0.7 * line.length, 12)
    whole = []
    for count in (None, 4, 9):
        modes = mesh_modes(mesh, count)
        whole.append(float(((modes.at_contact / modes.frequencies) ** 2).sum()) + modes.residual_compliance)
    assert whole[1:] == approx(whole[:1] * 2, rel=1e-8)
    nodes = modes.shapes(mesh.place), modes.slopes(mesh.place)
    assert modes.at_contact == approx(modes.shapes(np.array([0.7 * line.length]))[:, 0], rel=1e-9)
    if line is EULER:  # where slopes are rotations, nodes hold all unknowns
        rows = np.dstack(nodes).reshape(9, -1)
        count = rows.shape[1]
        first, last = HELD[support]
        kept = np.setdiff1d(np.arange(count), [*first, *(count - 2 + end for end in last)])
        assert rows[:, kept] @ times(mesh.mass, rows[:, kept]).T == approx(np.eye(9), abs=1e-8)


@THEORIES
@pytest.mark.parametrize("support", HELD)
def test_few_modes_of_many_elements_are_those_found_all_at_once(line, support):
    mesh = beam_mesh(line, support, 0.7 * line.length, 60)
    few, all_of_them = mesh_modes(mesh, 5), mesh_modes(mesh, 30)
    x = np.linspace(0.0, line.length, 50)
    assert few.frequencies == approx(all_of_them.frequencies[:5], rel=1e-7)
    assert few.shapes(x) == approx(all_of_them.shapes(x)[:5], abs=1e-6)
    assert few.rigid_mass == all_of_them.rigid_mass


def test_what_an_impact_feels_of_the_motion_as_a_whole():
    mass, length = 2.133, EULER.length
    for at, felt in ((0.5, mass), (1.0, mass / 4.0), (0.25, 1.0 / (1.0 / mass + 0.25**2 * 12.0 / mass))):
        assert beam_mesh(EULER, "free-free", at * length, 8).rigid_mass == approx(felt, rel=1e-10)
    for at in (0.3, 1.0):
        pinned = beam_mesh(EULER, "pinned-free", at * length, 9)
        assert pinned.rigid_mass == approx(mass / (3.0 * at**2), rel=1e-10)
        assert pinned.whole @ pinned.shapes(np.array([0.5 * length])) == approx(0.5 / at, rel=1e-10)
    assert beam_mesh(EULER, "cantilever", length, 8).rigid_mass == math.inf


def test_bodies_in_one_line_need_not_be_alike():
    beam = beam_mesh(EULER, "clamped-clamped", 0.5 * EULER.length, 6)
    both_bodies = both(point_mesh(2.0), beam)
    assert both_bodies.other == 1 + beam.struck
    assert full(both_bodies.mass)[0, 0] == 2.0
    assert full(both_bodies.stiffness)[1:, 1:] == approx(full(beam.stiffness))
