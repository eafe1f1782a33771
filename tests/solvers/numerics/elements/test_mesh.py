"""Meshes of rods as arrays: matrices, modes, compliance, the limit of an explicit step."""

import numpy as np
import pytest
from pytest import approx
from scipy.linalg import eigh

from solvers.numerics.balances import Bank, joined
from solvers.numerics.elements.banded import full, times
from solvers.numerics.elements.line import highest_frequency, line
from solvers.numerics.elements.mesh import AVERAGED, CONSISTENT, LUMPED, point_mesh, rod_mesh
from solvers.numerics.elements.modes import mesh_modes, without_mass_in_front
from tests.catalog import ROD, observed_order, struck_rod

SHARES = (CONSISTENT, AVERAGED, LUMPED)


@pytest.mark.parametrize("lumping", SHARES)
def test_mass_and_static_stiffness_are_those_of_the_rod(lumping):
    free = struck_rod(support="free").target.mesh(7, lumping)
    assert free.rigid_mass == approx(ROD.mass, rel=1e-14)
    fixed = ROD.mesh(7, lumping)
    assert np.linalg.inv(full(fixed.stiffness))[0, 0] == approx(1.0 / ROD.stiffness, rel=1e-12)
    assert fixed.size == 7 and free.size == 8


def test_matrices_of_6_16():
    mesh = ROD.mesh(3)
    m, k = ROD.mass / 9.0, 3.0 * ROD.stiffness
    assert mesh.mass[0] == approx(m * np.array([1.0, 2.0, 2.0]), rel=1e-14)
    assert mesh.mass[1] == approx(m * np.array([0.5, 0.5, 0.0]), rel=1e-14)
    assert mesh.stiffness[0] == approx(k * np.array([1.0, 2.0, 2.0]), rel=1e-14)
    assert mesh.stiffness[1] == approx(k * np.array([-1.0, -1.0, 0.0]), rel=1e-14)
    assert mesh.neighbour == approx(k, rel=1e-14)


@pytest.mark.parametrize("support", ["fixed", "free"])
@pytest.mark.parametrize("lumping, order", [(CONSISTENT, 2.0), (AVERAGED, 4.0), (LUMPED, 2.0)])
def test_frequencies_tend_to_those_of_the_rod(support, lumping, order):
    rod = struck_rod(support=support).target
    counts = [12, 24, 48, 96]
    third = [mesh_modes(rod.mesh(n, lumping), 3).frequencies[2] for n in counts]
    assert third[-1] == approx(rod.modes(3).frequencies[2], rel=2e-3)
    # errors fall as elements^-order
    assert -observed_order(dict(zip(counts, third, strict=True)).__getitem__, counts) == approx(order, abs=0.2)


@pytest.mark.parametrize("massless", [False, True])
@pytest.mark.parametrize("support", ["fixed", "free"])
def test_modes_kept_and_left_out_make_the_whole_compliance(support, massless):
    rod = struck_rod(support=support).target
    mesh = rod.mesh(30, AVERAGED)
    every, few = mesh_modes(mesh, None, massless), mesh_modes(mesh, 8, massless)
    kept = [float(((modes.at_contact / modes.frequencies) ** 2).sum()) for modes in (every, few)]
    assert kept[0] + every.residual_compliance == approx(kept[1] + few.residual_compliance, rel=1e-10)
    if massless:  # all that is left is the spring of the first element
        assert every.residual_compliance == approx(1.0 / mesh.neighbour, rel=1e-9)
    else:
        assert every.residual_compliance == 0.0
    # L / E A, or for a free rod relative to its motion as a whole L / 3 E A
    whole = 1.0 / rod.stiffness if support == "fixed" else 1.0 / (3.0 * rod.stiffness)
    assert kept[0] + every.residual_compliance == approx(whole, rel=2.0 / 30.0)
    # along the rod they move as the rest of the modes do under a steady force, and a massless face by its own spring
    rest = (every.at_contact / every.frequencies**2)[8:] @ every.shapes(mesh.place)[8:]
    rest[0] += every.residual_compliance
    assert few.left_out("shapes", mesh.place) == approx(rest, abs=1e-9 * whole)


STEEL_RODS = [(0.3, 2.1, 6.3e8), (0.2, 0.6, 4.2e8), (0.25, 1.2, 5.0e8)]  # length, mass, E A / L


@pytest.mark.slow
@pytest.mark.parametrize("lumping", [CONSISTENT, AVERAGED, LUMPED])
@pytest.mark.parametrize("massless", [False, True])
@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("parts, end_mass", [(STEEL_RODS[:1], 0.0), (STEEL_RODS, 0.4)], ids=["rod", "chain"])
def test_modes_of_a_chain_are_those_of_the_dense_problem(parts, end_mass, fixed, massless, lumping):
    mesh = rod_mesh(parts, 90, fixed, end_mass, lumping)
    assert mesh.total_mass == approx(sum(mass for _, mass, _ in parts) + end_mass, rel=1e-12)
    body = without_mass_in_front(mesh) if massless else mesh
    inverses = eigh(full(body.mass), full(body.stiffness) + 1e6 * full(body.mass), eigvals_only=True)
    squares = (1.0 / inverses - 1e6)[::-1]
    for count in (None, 12):
        found = mesh_modes(mesh, count, massless)
        true = squares[body.free.shape[0] :][:count]
        assert found.frequencies**2 == approx(true, rel=1e-9)
        rows = found.shapes(mesh.place)[:, int(massless) : mesh.size]
        rows = rows[:, : body.size]
        assert rows @ times(body.mass, rows).T == approx(np.eye(rows.shape[0]), abs=1e-9)


def test_no_dense_problem_is_solved_for_a_long_chain(monkeypatch):
    """Of 800 elements it took 1 s, a hundred times what was foretold; of 1600 joined to a mass 10 s."""

    def refuse(*given, **options):
        raise AssertionError("O(elements^3)")

    monkeypatch.setattr("scipy.linalg.eigh", refuse)
    mesh = rod_mesh(STEEL_RODS, 900, False, 0.0, AVERAGED)
    assert mesh_modes(mesh, None, True).frequencies.size == mesh.size - 2
    modes = mesh_modes(mesh)
    weights, squares = np.append(1.0, -modes.at_contact), np.append(0.0, modes.frequencies**2)
    assert joined(Bank(np.sqrt(squares), weights, -1)).frequencies.size == squares.size - 1


@pytest.mark.parametrize("elements", [1, 2])
@pytest.mark.parametrize("support", ["fixed", "free"])
def test_the_coarsest_meshes_give_way_as_the_finest_do(support, elements):
    rod = struck_rod(support=support).target
    mesh = rod.mesh(elements, AVERAGED)
    modes = mesh_modes(mesh, None, True)
    static = float((modes.at_contact**2 / modes.frequencies**2).sum()) + modes.residual_compliance
    assert modes.left_out("shapes", np.zeros(1)) == approx(modes.residual_compliance, rel=1e-12)
    if support == "fixed":  # exact: springs in a row
        assert static == approx(1.0 / rod.stiffness, rel=1e-12)


def test_modes_are_orthonormal_and_the_face_stands_where_it_is_struck():
    mesh = ROD.mesh(12)
    modes = mesh_modes(mesh)
    shapes = modes.shapes(mesh.place[:-1])
    assert shapes @ full(mesh.mass) @ shapes.T == approx(np.eye(12), abs=1e-12)
    assert shapes[:, 0] == approx(modes.at_contact, rel=1e-12)
    assert modes.shapes(mesh.place[-1:]) == approx(np.zeros((12, 1)), abs=1e-15)
    middle = 0.5 * (mesh.place[3] + mesh.place[4])
    slope = (modes.shapes(mesh.place[4:5]) - modes.shapes(mesh.place[3:4])) / (mesh.place[4] - mesh.place[3])
    assert modes.slopes(np.array([middle])) == approx(slope, rel=1e-10)


def test_moving_the_mass_of_the_face_keeps_all_of_it():
    rod = struck_rod(support="free").target
    assert mesh_modes(rod.mesh(9, AVERAGED), None, True).rigid_mass == approx(rod.mass, rel=1e-13)


def test_the_highest_frequency_includes_the_contact_spring():
    impactor, rod = point_mesh(ROD.mass), ROD.mesh(40, LUMPED)
    whole = line(impactor, rod)
    element = rod.neighbour
    for stiffness in (0.0, element, 100.0 * element):
        matrix = full(whole.stiffness)
        matrix[:2, :2] += stiffness * np.array([[1.0, -1.0], [-1.0, 1.0]])
        root = 1.0 / np.sqrt(whole.mass[0])
        highest = np.linalg.eigvalsh(root[:, None] * matrix * root)[-1]
        assert highest_frequency(whole, stiffness) == approx(np.sqrt(highest), rel=1e-10)
    bare = highest_frequency(whole, 0.0)
    assert bare == approx(2.0 / rod.transit, rel=1e-2)  # Courant's limit of one element
    assert highest_frequency(whole, 100.0 * element) > 5.0 * bare
