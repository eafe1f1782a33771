"""Timoshenko modes: every one of them, below and above the cut-off, against values computed by other ways."""

import numpy as np
import pytest
from numpy.polynomial import legendre
from pytest import approx
from scipy.linalg import eigh, null_space

from solvers.numerics.beams.modes import BeamLine, beam_modes, modes_below
from tests.solvers.numerics.beams.beam_frequencies import TIMOSHENKO
from tests.solvers.numerics.beams.test_modes import CASES, ENDS, LENGTH, SLENDER, SUPPORTS, THICK

LENGTHS = [(1.0, 60, 40, 2e-9), (0.25, 60, 36, 2e-9), (4.0, 160, 120, 1e-6)]  # by the polynomials' resolution


@pytest.mark.parametrize("case", TIMOSHENKO)
def test_twenty_frequencies_to_twelve_digits(case):
    support, end_mass = ("cantilever", THICK.mass) if "own mass" in case else (case, 0.0)
    frequencies = beam_modes(THICK, support, 0.2, 20, end_mass).frequencies / THICK.frequency_unit
    assert frequencies == approx(np.array(TIMOSHENKO[case]), rel=1e-12)


def ritz(line, support, end_mass, terms):
    """Frequencies of the beam, motions as a whole first, with Legendre polynomials for displacement and turn.

    From below in the flexibility, shifted by a stiffness of one to the mass, so that the lowest keep their digits.
    """
    x, weights = legendre.leggauss(terms + 2)
    sizes = np.sqrt(np.arange(terms) + 0.5)
    shapes = legendre.legvander(x, terms - 1) * sizes
    slopes = 2.0 * np.stack([legendre.legval(x, legendre.legder(row)) for row in np.eye(terms)], axis=1) * sizes
    weights, nothing = 0.5 * weights[:, None], np.zeros_like(shapes)
    sheared, bent = np.hstack([slopes, -shapes]), np.hstack([nothing, slopes])
    moved, turned = np.hstack([shapes, nothing]), np.hstack([nothing, shapes])
    stiffness = (weights * sheared).T @ sheared / line.shear_number + (weights * bent).T @ bent
    mass = (weights * moved).T @ moved + line.rotary_number * (weights * turned).T @ turned
    at_ends = legendre.legvander(np.array([-1.0, 1.0]), terms - 1) * sizes
    mass[:terms, :terms] += end_mass / line.mass * np.multiply.outer(at_ends[1], at_ends[1])
    held = [np.concatenate([row * (q == 0), row * (q == 1)]) for row, end in zip(at_ends, ENDS[support], strict=True)
            for q in end if q < 2]  # fmt: skip
    free = null_space(np.array(held)) if held else np.eye(2 * terms)
    mass, stiffness = free.T @ mass @ free, free.T @ stiffness @ free
    flexibility = eigh(mass, stiffness + mass, eigvals_only=True)[::-1]
    return line.frequency_unit * np.sqrt(np.maximum(1.0 / flexibility - 1.0, 0.0))


@pytest.mark.slow
@pytest.mark.parametrize("support, mass", CASES)
@pytest.mark.parametrize(
    "length, terms, count, error", [(1.0, 60, 40, 2e-9), (0.25, 60, 36, 2e-9), (4.0, 160, 120, 1e-6)]
)
def test_no_mode_is_missed_and_none_found_twice(support, mass, length, terms, count, error):
    line = THICK._replace(length=length * LENGTH)
    expected = ritz(line, support, mass, terms)
    whole = {"free-free": 2, "pinned-free": 1}.get(support, 0)
    found = beam_modes(line, support, 0.01, count, mass).frequencies
    assert expected[whole : whole + count] == approx(found, rel=error)


def test_pinned_ends_have_two_spectra_and_pure_shear():
    """At the cut-off all sections turn alike and nothing moves across, so no impact moves it: n starts at 0."""
    modes = beam_modes(THICK, "pinned-pinned", 0.1, 40)
    shear = int(np.argmin(np.abs(modes.frequencies - THICK.cut_off)))
    assert modes.frequencies[shear] == approx(THICK.cut_off, rel=1e-15)
    x = np.linspace(0.0, LENGTH, 7)
    assert np.abs(modes.shapes(x)[shear]).max() < 1e-12 / np.sqrt(THICK.mass)
    turns = modes.slopes(x)[shear] + modes.shears(x)[shear] / THICK.shear_stiffness
    assert np.abs(turns) == approx(np.full(7, 1.0 / np.sqrt(THICK.rotary_inertia * LENGTH)), rel=1e-12)
    assert modes_below(THICK, "pinned-pinned", THICK.cut_off * (1.0 + 1e-9)) == shear + 1
    assert modes_below(THICK, "pinned-pinned", THICK.cut_off * (1.0 - 1e-9)) == shear


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("slenderness", [1e3, 1e5])
def test_slender_beams_tend_to_euler_and_bernoulli(support, slenderness):
    gyration = LENGTH / slenderness
    line = SLENDER._replace(
        rotary_inertia=SLENDER.mass_per_length * gyration**2,
        shear_stiffness=SLENDER.bending_stiffness / (3.12 * gyration**2),
    )
    found, expected = (beam_modes(beam, support, 0.7 * LENGTH, 30) for beam in (line, SLENDER))
    z2 = expected.frequencies / SLENDER.frequency_unit
    # frequencies fall by (1 + E / kappa G) (k r)^2 / 2 along the beam, and by several times that with its ends
    assert np.all(np.abs(found.frequencies / expected.frequencies - 1.0) <= 15.0 * z2 / slenderness**2 + 1e-13)
    assert np.abs(found.at_contact) == approx(np.abs(expected.at_contact), abs=30.0 * 100.0**2 / slenderness**2 + 1e-11)


@pytest.mark.parametrize("support", SUPPORTS)
def test_five_hundred_modes_of_a_line_hardly_a_beam(support):
    line = BeamLine(0.05, THICK.bending_stiffness, THICK.mass_per_length, THICK.rotary_inertia, THICK.shear_stiffness)
    modes = beam_modes(line, support, 0.02, 500)
    assert np.all(np.isfinite(modes.at_contact)) and np.all(np.diff(modes.frequencies) >= 0.0)
    assert modes_below(line, support, modes.frequencies[-1] * (1.0 + 1e-12)) == 500
    assert np.all(np.isfinite(modes.shapes(np.linspace(0.0, 0.05, 50))))


@pytest.mark.parametrize("offset", [0.0, 1e-14, 1e-10, 1e-6])
def test_shapes_keep_their_digits_at_the_cut_off(offset):
    """A length is chosen so that a mode lies at the cut-off, where one of the wavenumbers vanishes."""
    low, high = 0.02, 0.1
    for _ in range(60):
        middle = 0.5 * (low + high)
        above = modes_below(THICK._replace(length=middle), "cantilever", THICK.cut_off) < 3
        low, high = (middle, high) if above else (low, middle)
    line = THICK._replace(length=low * (1.0 + offset))
    modes = beam_modes(line, "cantilever", low, 6)
    assert np.abs(modes.frequencies / line.cut_off - 1.0).min() < 1e-12 + 4.0 * offset
    nodes, weights = legendre.leggauss(40)
    x, weights = 0.5 * line.length * (1.0 + nodes), 0.5 * line.length * weights
    shapes, turns = modes.shapes(x), modes.slopes(x) + modes.shears(x) / line.shear_stiffness
    mass = line.mass_per_length * (shapes * weights) @ shapes.T + line.rotary_inertia * (turns * weights) @ turns.T
    assert mass == approx(np.eye(6), abs=1e-11)
