"""Spectra of a solution, against closed forms of its histories."""

import math

import numpy as np
import pytest
from pytest import approx

from solvers import Modal, SceneError, load, solve


def test_at_no_frequency_the_force_is_its_impulse():
    solution = solve(load("fixed-rod"))
    found = solution.spectrum()
    assert found.unit == "N" and found.place is None and found.modes.size == 0
    assert found.density[0] == approx(solution.impulse, rel=1e-3)  # the force is straight between its samples
    assert found.frequency[-1] == approx(100.0 / solution.duration)


def test_a_rod_that_strikes_an_equal_one_pushes_by_a_rectangle():
    """Z v / 2 for 2 L / c: |F(f)| = Z v T / 2 |sinc(f T)|."""
    scene = load("two-equal-rods")
    solution = solve(scene)
    length = scene.target.rods[0].round_trip_time
    frequency = np.linspace(0.0, 7.0, 50) / length
    known = solution.peak_force * length * np.abs(np.sinc(frequency * length))
    assert solution.spectrum(frequency=frequency).density == approx(known, abs=1e-9 * solution.peak_force * length)


def test_two_masses_and_a_spring_push_by_half_a_sine():
    """F0 sin(w t) for half a period: |F| = 2 w F0 |cos(pi W / 2 w)| / |w^2 - W^2| at W = 2 pi f, F0 pi / 2 w at w."""
    scene = load("two-balls").replace({"contact": {"law": "linear", "stiffness": 1e8}})
    solution, w = solve(scene), math.sqrt(1e8 / scene.reduced_mass)
    ratio = np.array([0.0, 0.5, 1.0, 1.5, 3.0, 4.2])
    shares = [math.pi / 4 if r == 1.0 else abs(math.cos(0.5 * math.pi * r) / (1.0 - r * r)) for r in ratio]
    found = solution.spectrum(frequency=ratio * w / (2.0 * math.pi)).density
    force = scene.speed * math.sqrt(1e8 * scene.reduced_mass)
    assert found == approx(
        2.0 * force / w * np.array(shares), abs=2e-6 * force / w
    )  # of 500 samples: (pi / 500)^2 / 12


def test_what_rings_is_as_high_as_it_is_at_the_frequencies_of_its_modes():
    """The far end of a free rod, 60 times as long as the contact: each mode by its amplitude after that."""
    scene = load("free-rod")
    solution = Modal(modes=8, estimate=False).solve(scene, 60.0 * scene.time_unit)
    modes, length = solution.target_modes, scene.target.length
    found = solution.spectrum("velocity", length, "hann", modes.frequencies)
    assert found.modes == approx(modes.frequencies) and found.unit == "m/s" and found.place == length
    rings = np.abs(modes.displacements(np.linspace(solution.contacts[-1].end, solution.duration, 20_001))).max(axis=0)
    speeds = 2.0 * math.pi * modes.frequencies * rings
    assert found.amplitude == approx(speeds, rel=0.02)  # one sixtieth of the time it is pushed; 16 samples a period
    between = 0.5 * (modes.frequencies[1:] + modes.frequencies[:-1])
    assert (solution.spectrum("velocity", length, "hann", between).amplitude < 1e-3 * scene.speed).all()


def test_what_is_not_there_is_refused():
    solution = solve(load("fixed-rod"))
    for given, key in (
        ({"what": "colour"}, "what"),
        ({"what": "bending_moment"}, "what"),
        ({"window": "flat"}, "window"),
        ({"what": "stress", "place": -1.0}, "place"),
        ({"frequency": [1e12]}, "frequency"),
        ({"frequency": [-1.0]}, "frequency"),
    ):
        with pytest.raises(SceneError) as refused:
            solution.spectrum(**given)
        assert refused.value.key == key
