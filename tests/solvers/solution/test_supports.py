"""What supports exert, by the fields at the ends of a body: the momentum that they take is what is missing."""

import numpy as np
import pytest
from pytest import approx

from solvers import Modal, load, solve
from solvers.bodies.beams import THEORIES


def test_a_wall_takes_what_the_blow_and_the_rod_do_not_keep():
    """Exact waves: the first front is doubled there, 2 rho c v A."""
    scene = load("fixed-rod")
    found, rod, wall = solve(scene), scene.target, np.array([scene.target.length])
    trip = rod.round_trip_time
    borne = rod.area * found.motion.stress(np.array([0.499, 0.501]) * trip, wall)[:, 0]
    assert borne == approx([0.0, 2.0 * rod.impedance * scene.speed], rel=0.01, abs=1.0)


@pytest.mark.parametrize("theory", THEORIES)
@pytest.mark.parametrize("support, at", [("cantilever", 0.9), ("pinned-pinned", 0.4), ("clamped-clamped", 0.4)])
def test_the_shear_forces_at_the_ends_of_a_beam_are_what_its_supports_push_back_with(support, at, theory):
    """The momentum of the beam grows by F + V(0) - V(L)."""
    scene = load("figure-8.15").replace({"target.support": support, "target.at": at, "target.theory": theory})
    found = Modal(modes=60, estimate=False).solve(scene)
    motion, beam = found.motion, scene.target
    time, x = np.linspace(0.0, found.duration, 4001), np.linspace(0.0, beam.length, 401)
    shear = motion.shear(time, np.array([0.0, beam.length]))
    pushed = np.trapezoid(shear[:, 0] - shear[:, 1], time)
    held = beam.mass * float(np.trapezoid(motion.velocity(time[-1:], x)[0], x)) / beam.length
    given = float(motion.impulse(time[-1:])[0])
    assert given + pushed == approx(held, abs=1e-4 * given)
    assert pushed < 0.0
