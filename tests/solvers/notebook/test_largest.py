"""How far a beam gives way and how it is stressed: as a spring under a heavy body, and as fine sampling finds it."""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene
from solvers.notebook.largest import peak_bending_stress, peak_deflection

LENGTH, WIDTH, YOUNG, SPEED = 1.2, 0.03, 210e9, 0.1
SECOND_MOMENT = WIDTH**4 / 12.0
STIFFNESS = {  # of a beam where it is struck, by EI / L^3; moment there or at the clamp, by F L
    "pinned-pinned": (48.0, 0.25, 0.5),
    "clamped-clamped": (192.0, 0.125, None),
    "cantilever": (3.0, 1.0, 0.0),
}


CONTACT = 30.0  # stiffness of the contact over that of the beam


def heavy(support: str, stiffness: float) -> Scene:
    """A body twenty thousand times as heavy as the beam, so slow that the beam follows as a spring."""
    place = 1.0 if support == "cantilever" else 0.5
    mass = 2e4 * 7900.0 * LENGTH * WIDTH**2
    target = {"kind": "beam", "length": LENGTH, "section": {"width": WIDTH, "height": WIDTH}, "material": "steel"}
    return Scene.from_table({
        "impactor": {"kind": "mass", "mass": mass, "velocity": SPEED},
        "target": target | {"support": support, "at": place},
        "contact": {"law": "linear", "stiffness": CONTACT * stiffness},
        "method": {"name": "modal", "modes": 20},
    })  # fmt: skip


@pytest.mark.parametrize("support", STIFFNESS)
def test_under_a_heavy_body_a_beam_is_a_spring(support):
    factor, lever, place = STIFFNESS[support]
    stiffness = factor * YOUNG * SECOND_MOMENT / LENGTH**3
    together = stiffness / (1.0 + 1.0 / CONTACT)
    scene = heavy(support, stiffness)
    solution = solvers.solve(scene)
    deflection, stress = peak_deflection(solution), peak_bending_stress(solution)
    expected = SPEED * math.sqrt(scene.impactor.mass * together) / stiffness
    struck = LENGTH if support == "cantilever" else LENGTH / 2
    assert deflection.value == approx(expected, rel=5e-3) and deflection.x == approx(struck, rel=1e-2)
    bending = stiffness * expected * lever * LENGTH * 0.5 * WIDTH / SECOND_MOMENT
    assert abs(stress.value) == approx(bending, rel=0.01)  # it rings by the square root of its share of the mass, 0.5 %
    assert place is None or stress.x == approx(place * LENGTH, abs=0.02)
    quarter = 0.5 * math.pi * math.sqrt(scene.impactor.mass / together)
    assert deflection.time == approx(quarter, rel=0.02)


@pytest.mark.parametrize("name", ["hammer-on-cantilever", "figure-5.2", "figure-5.20", "xylophone-bar"])
def test_as_fine_sampling_finds_it(name):
    solution = solvers.solve(solvers.load(name))
    length = solution.scene.target.length
    times, places = np.linspace(0.0, solution.duration, 6_001), np.linspace(0.0, length, 241)
    found = [(peak_bending_stress(solution), solution.known_motion.stress)]
    if solution.scene.target.held:
        found.append((peak_deflection(solution), solution.known_motion.displacement))
    else:
        assert peak_deflection(solution) is None  # it goes off as a whole
    for largest, field in found:
        assert abs(largest.value) >= np.abs(field(times, places)).max() * (1.0 - 2e-3)
        there = field(np.array([largest.time]), np.array([largest.x]))[0, 0]
        assert there == approx(largest.value, rel=1e-9)


@pytest.mark.parametrize("name", ["fixed-rod", "four-bar", "brick-off-centre", "newtons-cradle"])
def test_of_what_does_not_bend_there_is_none(name):
    solution = solvers.solve(solvers.load(name))
    assert peak_deflection(solution) is None and peak_bending_stress(solution) is None


def test_the_report_says_both(capsys):
    said = str(solvers.solve(solvers.load("hammer-on-cantilever")))
    assert "largest deflection   1.3147 mm   (at 0.4 m, after 0.00234 s)" in said
    assert "stress by bending    118.93 MPa   (at 0 m, after 0.002823 s)" in said
