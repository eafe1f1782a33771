"""The modes of a target in its motion: closed forms, and the energy that the solution reports."""

import math
from dataclasses import replace

import numpy as np
import pytest
from pytest import approx

from solvers import LAWS, Modal, SceneError, Solution, load, solve


def solved(name: str, modes: int = 12, **target: object) -> Solution:
    scene = load(name)
    return Modal(modes=modes, estimate=False).solve(replace(scene, target=replace(scene.target, **target)))


@pytest.mark.parametrize("name, halves", [("fixed-rod", 1), ("free-rod", 0)])
def test_rods(name, halves):
    """Fixed-free: (2 n - 1) c / (4 L); free: n c / (2 L); shapes cos(k x), masses half of the rod's. Thesis (5.2)."""
    found = solved(name)
    rod, modes, n = found.scene.target, found.target_modes, np.arange(1, 13)
    k = math.pi * (n - 0.5 * halves) / rod.length
    assert modes.frequencies == approx(rod.wave_speed * k / (2.0 * math.pi), rel=1e-12)
    assert modes.masses == approx(0.5 * rod.mass, rel=1e-12) and modes.numbers.tolist() == n.tolist()
    x = np.linspace(0.0, rod.length, 7)
    assert modes.shapes(x) == approx(np.cos(np.multiply.outer(k, x)), abs=1e-12)
    assert found.diagnostics["frequencies"] == approx(modes.frequencies[:8], rel=1e-15)


def test_a_slender_cantilever_and_what_shear_makes_of_it():
    """(beta L)_1 = 1.8751, and a quarter of its mass at the tip, thesis (5.30); Timoshenko's is slower."""
    found = solved("hammer-on-cantilever", theory="euler-bernoulli", at=1.0, end_mass=0.0)
    beam, modes = found.scene.target, found.target_modes
    unit = math.sqrt(beam.line.bending_stiffness / beam.line.mass_per_length) / beam.length**2
    assert 2.0 * math.pi * modes.frequencies[:2] == approx(np.array([1.8751041, 4.6940911]) ** 2 * unit, rel=1e-7)
    assert modes.masses == approx(0.25 * beam.mass, rel=1e-9)
    assert modes.shapes(np.array([0.0, beam.length]))[:, 1] == approx(1.0, abs=1e-12)
    sheared = solved("hammer-on-cantilever", theory="timoshenko", at=1.0, end_mass=0.0)
    assert (sheared.target_modes.frequencies < modes.frequencies).all()


@pytest.mark.parametrize("name", ["fixed-rod", "free-rod", "hammer-on-cantilever", "xylophone-bar", "figure-8.15"])
def test_the_energies_sum_to_the_vibration_that_the_solution_reports(name):
    found = solved(name)
    energies = found.target_modes.energies(found.duration)
    assert energies.sum() == approx(found.energy["target_vibration"], rel=1e-9)
    assert energies.min() >= 0.0


def test_a_mode_at_rest_where_it_is_struck_is_left_out_and_the_others_keep_their_numbers():
    """A free bar struck in its middle."""
    assert solved("xylophone-bar", 6).target_modes.numbers.tolist() == [1, 3, 5]


def test_the_displacements_add_up_to_that_of_the_struck_end():
    """Of a fixed rod, but for what the modes left out give way."""
    found = solved("fixed-rod", 200)
    time = np.linspace(0.0, found.duration, 50)
    moved = found.motion.displacement(time, np.zeros(1))[:, 0]
    assert found.target_modes.displacements(time).sum(axis=1) == approx(moved, abs=0.01 * np.abs(moved).max())


def test_a_rod_and_the_mass_on_it():
    """z tan z = m2 / m1 of a fixed rod, (5.11); tan z = -(m1 / m2) z of a free one, (9.19) as corrected."""
    for name in ("fixed-rod", "free-rod"):
        rod, mass = load(name).target, 0.7 * load(name).target.mass
        z = rod.joined_modes(5, mass).frequencies * rod.length / rod.wave_speed
        off = z * np.tan(z) - rod.mass / mass if rod.fixed else np.tan(z) + mass / rod.mass * z
        assert np.abs(off).max() < 1e-9


def test_other_methods_and_bodies_without_a_length_have_none():
    on_a_spring = replace(load("spring-mass"), contact=LAWS["linear"](1e7))
    for scene, method in ((load("fixed-rod"), "waves"), (on_a_spring, "modal"), (load("bent-rods"), "modal")):
        with pytest.raises(SceneError, match="solved by its modes"):
            _ = solve(scene, method=method).target_modes
