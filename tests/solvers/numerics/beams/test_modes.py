"""Natural modes of beams: frequencies, ends, orthogonality, integrals, and the compliance of those left out."""

import numpy as np
import pytest
from pytest import approx

from solvers.numerics.beams.modes import BeamLine, beam_modes, modes_below
from solvers.numerics.beams.statics import ENDS, static_compliance

SUPPORTS = list(ENDS)
LENGTH, SIDE, YOUNG, DENSITY = 0.3, 0.03, 210e9, 7900.0  # the beam of the thesis, 5.5 and 8.3
SHEAR_MODULUS, COEFFICIENT = YOUNG / 2.6, 5.0 / 6.0
AREA, INERTIA = SIDE**2, SIDE**4 / 12.0
SLENDER = BeamLine(LENGTH, YOUNG * INERTIA, DENSITY * AREA)
THICK = BeamLine(LENGTH, YOUNG * INERTIA, DENSITY * AREA, DENSITY * INERTIA, COEFFICIENT * SHEAR_MODULUS * AREA)
LINES = {"Euler-Bernoulli": SLENDER, "Timoshenko": THICK}
CASES = [(support, 0.0) for support in SUPPORTS] + [("cantilever", 2.133)]


def characteristic(support, z, mass_ratio):
    """Text-book characteristic functions, (5.37), (5.41) of the thesis; in long doubles, cosh reaches z = 11000."""
    cos, sin, cosh, sinh = np.cos(z), np.sin(z), np.cosh(z), np.sinh(z)
    if support == "cantilever":
        return 1.0 + cos * cosh + mass_ratio * z * (cos * sinh - sin * cosh)
    if support == "pinned-pinned":
        return sin
    return sin * cosh - cos * sinh if support == "pinned-free" else cos * cosh - 1.0


def first_bracket(support, n):
    """Ends of an interval of z that holds the n-th frequency alone."""
    low = {"cantilever": n - 1.0, "pinned-pinned": n - 0.5, "pinned-free": n}.get(support, n)
    return np.pi * low, np.pi * (low + 1.0)


@pytest.mark.parametrize("support, mass", [*CASES, ("cantilever", 1e-3), ("cantilever", 1e3)])
def test_frequencies_of_slender_beams_to_twelve_digits(support, mass):
    n = np.arange(1, 201)
    modes = beam_modes(SLENDER, support, 0.2, 200, mass)
    z = np.sqrt(modes.frequencies.astype(np.longdouble) / SLENDER.frequency_unit)
    low, high = first_bracket(support, n)
    assert np.all((low < z) & (z < high))
    signs = [np.sign(characteristic(support, z * (1.0 + change), mass / SLENDER.mass)) for change in (-4e-13, 4e-13)]
    assert np.all(signs[0] * signs[1] == -1.0)


def test_frequencies_of_the_beam_of_the_thesis():
    # table 8.3 computed anew for the printed density; its headings are exchanged, and it used another density
    slender = [1744.3554092821275, 10931.688748895502, 30609.045035752228, 59981.51178347311, 99153.73678241904]
    thick = [1730.6327, 10372.2789, 27280.6772, 49486.2737, 75331.5880, 103531.6243]
    assert beam_modes(SLENDER, "cantilever", LENGTH, 5).frequencies == approx(np.array(slender), rel=1e-13)
    modes = beam_modes(THICK, "cantilever", LENGTH, 14)
    assert modes.frequencies[:6] == approx(np.array(thick), abs=5e-5)
    assert THICK.cut_off == approx(337045.22, abs=5e-3)
    assert np.sum(modes.frequencies < THICK.cut_off) == 13
    assert modes.frequencies[13] == approx(341039.8, abs=0.05)


def quadrature(start, end, panels=48):
    """Points and weights of Gauss's rule, 16 points to each panel: six to the shortest wave of 120 modes' products."""
    nodes, weights = np.polynomial.legendre.leggauss(16)
    cuts, half = np.linspace(start, end, panels, endpoint=False), 0.5 * (end - start) / panels
    return np.add.outer(cuts, half * (1.0 + nodes)).ravel(), np.tile(half * weights, panels)


def products(line, modes, end_mass):
    """Mass and, over the frequencies, stiffness products of the modes, and their means, by quadrature."""
    x, weights = quadrature(0.0, line.length)
    shapes, moments, shears = modes.shapes(x), modes.moments(x), modes.shears(x)
    turns = modes.slopes(x) + shears / line.shear_stiffness
    end = modes.shapes(np.array([line.length]))[:, 0]
    mass = line.mass_per_length * (shapes * weights) @ shapes.T + line.rotary_inertia * (turns * weights) @ turns.T
    mass += end_mass * np.multiply.outer(end, end)
    stiffness = (moments * weights) @ moments.T / line.bending_stiffness
    stiffness += (shears * weights) @ shears.T / line.shear_stiffness
    mean = (line.mass_per_length * shapes @ weights + end_mass * end) / (line.mass + end_mass)
    return mass, stiffness / np.multiply.outer(modes.frequencies, modes.frequencies), mean


@pytest.mark.slow
@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support, mass", CASES)
@pytest.mark.parametrize("count, error", [(20, 1e-12), (120, 1e-11)])
def test_modes_are_orthonormal_in_mass_and_orthogonal_in_stiffness(theory, support, mass, count, error):
    line = LINES[theory]
    modes = beam_modes(line, support, 0.2, count, mass)
    in_mass, in_stiffness, mean = products(line, modes, mass)
    assert np.abs(in_mass - np.eye(count)).max() <= error
    assert np.abs(in_stiffness - np.eye(count)).max() <= error
    assert modes.means == approx(mean, abs=1e-12 / np.sqrt(line.mass))


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support, mass", CASES)
@pytest.mark.parametrize("count, error", [(20, 1e-12), (500, 2e-11)])
def test_modes_meet_the_ends(theory, support, mass, count, error):
    line = LINES[theory]
    modes = beam_modes(line, support, 0.2, count, mass)
    ends, squares = np.array([0.0, line.length]), modes.frequencies**2
    shears = modes.shears(ends)
    turns = modes.slopes(ends) + shears / line.shear_stiffness
    shears[:, 1] += mass * squares * modes.shapes(ends)[:, 1]
    # rounding is measured by what a mode of unit mass may have at the most of each, times the root of the beam's mass
    k = np.sqrt(modes.frequencies / line.frequency_unit) / line.length
    turn = np.minimum(k, np.sqrt(line.mass_per_length / line.rotary_inertia)) if line.rotary_inertia else k
    moment = modes.frequencies * np.sqrt(line.bending_stiffness * line.mass_per_length)
    shear = np.minimum(k * moment, modes.frequencies * np.sqrt(line.shear_stiffness * line.mass_per_length))
    shear += mass * squares
    for at, conditions in enumerate(ENDS[support]):
        for number, values, scale in (
            (0, modes.shapes(ends), np.ones_like(k)),
            (1, turns, turn),
            (2, modes.moments(ends), moment),
            (3, shears, shear),
        ):
            if number in conditions:
                assert np.all(np.abs(values[:, at]) <= error * scale / np.sqrt(line.mass))


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support, mass", CASES)
def test_slope_moment_and_shear_are_what_the_shape_says(theory, support, mass):
    line = LINES[theory]
    modes = beam_modes(line, support, 0.2, 16, mass)
    x, h = np.linspace(0.05, 0.95, 11) * line.length, 1e-6 * line.length

    def derivative(function):
        return (function(x + h) - function(x - h)) / (2.0 * h)

    def turn(at):
        return modes.slopes(at) + modes.shears(at) / line.shear_stiffness

    inertia = modes.frequencies[:, None] ** 2
    for found, expected in (
        (modes.slopes(x), derivative(modes.shapes)),
        (modes.moments(x), line.bending_stiffness * derivative(turn)),
        (modes.shears(x), derivative(modes.moments) + line.rotary_inertia * inertia * turn(x)),
        (line.mass_per_length * inertia * modes.shapes(x), derivative(modes.shears)),
    ):
        scale = np.abs(expected).max(axis=1, keepdims=True)
        assert found == approx(expected, abs=3e-8 * float(scale.max()))  # rounding over h, and h^2 k^2 / 6


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("support, mass", CASES)
@pytest.mark.parametrize("at", [0.13, 0.5, 1.0])
def test_all_modes_together_give_the_static_compliance(theory, support, mass, at):
    line = LINES[theory]
    modes = beam_modes(line, support, at * line.length, 400, mass)
    static = static_compliance(line, support, at * line.length, mass)
    terms = (modes.at_contact / modes.frequencies) ** 2
    # what is left out: 2 / (m omega^2) on the average, 8 at a free end, of roots about pi apart in z = k L, or in
    # Timoshenko theory pi apart in omega L / c for the slower wave and for the faster one
    z = np.pi * 399.0
    if line is SLENDER:
        left_out = 8.0 / (line.mass * line.frequency_unit**2 * 3.0 * np.pi * z**3)
    else:
        left_out = 16.0 * line.length / (line.shear_stiffness * np.pi**2 * 100.0)
    assert static == approx(float(np.sum(terms)), abs=left_out + 1e-13 * static)
    assert 0.0 <= modes.residual_compliance <= left_out


@pytest.mark.parametrize(
    "support, compliance, shear",
    [
        ("cantilever", 1.0 / 3.0, 1.0),
        ("pinned-pinned", 1.0 / 48.0, 0.25),
        ("clamped-clamped", 1.0 / 192.0, 0.25),
    ],
)
@pytest.mark.parametrize("theory", LINES)
def test_static_compliance_of_text_books(theory, support, compliance, shear):
    line = LINES[theory]
    place = line.length if support == "cantilever" else 0.5 * line.length
    expected = compliance * line.length**3 / line.bending_stiffness + shear * line.length / line.shear_stiffness
    assert static_compliance(line, support, place) == approx(expected, rel=1e-13)


@pytest.mark.parametrize("support, mass", [*CASES, ("cantilever", 213.3)])
@pytest.mark.parametrize("at", [0.31, 0.5, 1.0])
def test_the_compliance_left_out_keeps_its_digits(support, mass, at):
    """The sum of what the next modes give way, up to some that give way less; from a difference it would be noise."""
    place = at * LENGTH
    few, many = (beam_modes(SLENDER, support, place, count, mass) for count in (100, 2000))
    terms = (many.at_contact / many.frequencies) ** 2
    expected = float(np.sum(terms[100:])) + many.residual_compliance
    assert few.residual_compliance == approx(expected, rel=1e-6)
    average = float(np.mean(terms[1900:] * np.arange(1900, 2000) ** 4)) / (3.0 * 2000.0**3)
    assert many.residual_compliance == approx(average, rel=0.1)  # an integral in place of the sum


@pytest.mark.parametrize("theory", LINES)
@pytest.mark.parametrize("at", [0.2, 0.5, 1.0])
def test_motion_as_a_whole(theory, at):
    line = LINES[theory]
    turning = line.mass * line.length**2 / 12.0 + line.rotary_inertia * line.length
    lever = (at - 0.5) * line.length
    modes = beam_modes(line, "free-free", at * line.length, 3)
    assert modes.rigid_mass == approx(1.0 / (1.0 / line.mass + lever**2 / turning), rel=1e-14)
    ends = np.array([0.0, line.length])
    assert modes.rigid_mass * (1.0 / line.mass + lever * (ends - 0.5 * line.length) / turning) == approx(
        modes.rigid_shape(ends), rel=1e-13
    )
    assert modes.rigid_mean == approx(modes.rigid_mass / line.mass, rel=1e-13)  # momentum of a unit impulse
    pinned = beam_modes(line, "pinned-free", at * line.length, 3)
    about_pin = turning + line.mass * (0.5 * line.length) ** 2
    assert pinned.rigid_mass == approx(about_pin / (at * line.length) ** 2, rel=1e-14)
    assert pinned.rigid_shape(ends) == approx([0.0, 1.0 / at], rel=1e-14)
    assert beam_modes(line, "cantilever", 0.1, 3).rigid_mass == np.inf


@pytest.mark.slow
@pytest.mark.parametrize("support, ratio", [*CASES[:-1], *(("cantilever", ratio) for ratio in (1e-9, 1.0, 1e6))])
@pytest.mark.parametrize(
    "line",
    [
        SLENDER._replace(length=1e4),
        THICK._replace(length=0.1 * SIDE),
        THICK._replace(shear_stiffness=1e3),
        SLENDER._replace(shear_stiffness=1e7),  # shear without rotary inertia, and the other way round
        SLENDER._replace(rotary_inertia=1e-3),
        BeamLine(1e-6, 1e-20, 1e-9, 1e-22, 1e-8),
    ],
)
def test_any_beam(line, support, ratio):
    mass = ratio * line.mass
    assert beam_modes(line, support, 0.0, 0, mass).frequencies.size == 0
    modes = beam_modes(line, support, 0.4 * line.length, 40, mass)
    assert products(line, modes, mass)[0] == approx(np.eye(40), abs=1e-10)
    counts = [modes_below(line, support, frequency * (1.0 + 1e-9), mass) for frequency in modes.frequencies]
    assert counts == list(range(1, 41))
    assert modes.residual_compliance >= 0.0
