"""Scenes of beams beyond the thesis: converged values, and what their notes say."""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Modal, contact_times
from tests.catalog import SCENES

# By 160 modes in 400 000 steps and more: contact periods [s], largest force of each [N], rebound [m/s]
CONVERGED = {
    "timoshenko-1913-short": ([(0.0, 156.416e-6)], [4.976694], -3.0232194e-3),
    "timoshenko-1913-long": (
        [(0.0, 434.583e-6), (1337.024e-6, 1782.301e-6), (2798.603e-6, 3222.031e-6)],
        [9.00709, 10.29670, 5.60400],
        -9.7126912e-3,
    ),
    "xylophone-bar": ([(0.0, 471.442e-6)], [188.8123], -0.61518853),
    "xylophone-bar-node": ([(0.0, 478.483e-6)], [187.6430], -0.63031204),
    "hammer-on-cantilever": (
        [(0.0, 358.11e-6), (447.48e-6, 512.22e-6), (904.31e-6, 1025.13e-6), (3987.77e-6, 4203.63e-6),
         (6421.18e-6, 6507.49e-6)],
        [2975.23, 1532.32, 1449.45, 3339.73, 3436.1],
        -0.726162,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CONVERGED)
def test_the_modes_that_the_scene_names_are_enough(name):
    found = solvers.solve(SCENES[name])
    periods, forces, rebound = CONVERGED[name]
    assert [c.start for c in found.contacts] == approx([start for start, _ in periods], rel=1e-5, abs=1e-12)
    assert [c.end for c in found.contacts] == approx([end for _, end in periods], rel=1e-5)
    assert [c.peak_force for c in found.contacts] == approx(forces, rel=2e-4)
    assert found.impactor_velocity == approx(rebound, rel=1e-5)
    assert abs(found.diagnostics["energy_error"]) < 1e-11
    assert found.notes == []


def ringing_shares(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Share of each mode in the energy that rings on after the contact, and their frequencies [Hz]."""
    found = solvers.solve(SCENES[name])
    bodies, duration = found.scene.target, found.duration
    modes = bodies.modes(6)
    places = np.linspace(0.0, bodies.length, 2001)
    weights = np.full(places.size, bodies.mass / (places.size - 1))
    weights[[0, -1]] *= 0.5
    # the velocity is a sum of the modes; their parts by their products with the shapes, over a slow period
    instants = np.linspace(found.contacts[-1].end, duration, 400)
    parts = found.motion.velocity(instants, places) @ (weights * modes.shapes(places)).T
    shares = np.max(parts**2, axis=0)
    return shares / shares.sum(), modes.frequencies / (2.0 * np.pi)


def test_in_the_middle_the_fundamental_of_the_bar_rings_and_at_its_node_it_does_not():
    middle, frequencies = ringing_shares("xylophone-bar")
    node, _ = ringing_shares("xylophone-bar-node")
    assert frequencies[:2] == approx([750.53, 2068.87], rel=1e-5)
    assert middle[0] > 0.99 and middle[1] < 1e-6
    assert node[0] < 1e-6 and node[1] > 0.98


def test_the_period_of_the_short_beam_is_a_millisecond_and_of_the_long_one_four():
    assert SCENES["timoshenko-1913-short"].target.time_unit == approx(1e-3, rel=2e-3)
    assert SCENES["timoshenko-1913-long"].target.time_unit == approx(4e-3, rel=2e-3)


def test_what_the_notes_say_of_shear():
    for name, number, change in (("timoshenko-1913-short", 0, -0.009), ("timoshenko-1913-long", 1, 0.124)):
        peaks = [
            solvers.solve(SCENES[name].replace({"target.theory": theory}), Modal(20, estimate=False)).contacts[number]
            for theory in ("euler-bernoulli", "timoshenko")
        ]
        assert peaks[1].peak_force / peaks[0].peak_force - 1.0 == approx(change, abs=1e-3)


@pytest.mark.parametrize(
    ("name", "swings", "share"), [("timoshenko-1913-long", 0.90, 0.40), ("hammer-on-cantilever", 0.94, 0.13)]
)
def test_what_the_notes_say_of_contact_times(name, swings, share):
    found = contact_times(solvers.solve(SCENES[name]))
    assert found.apparent / found.half_period == approx(swings, abs=0.006)
    assert found.real / found.apparent == approx(share, abs=0.006)
    assert "as if stuck to each other" in str(found.summary)
