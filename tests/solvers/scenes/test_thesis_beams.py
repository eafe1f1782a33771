"""Figures 5.12 to 5.20 of the thesis, a mass on the tip of a cantilever: scenes of their names, and what is printed."""

import numpy as np
import pytest
from pytest import approx

import solvers
from tests.catalog import SCENES, STEEL_ROD_MASS


def at(time: float) -> np.ndarray:
    return np.array([time])


@pytest.mark.parametrize("number", range(13, 21))
def test_scenes_show_what_their_figure_shows(number):
    """As long as the figure needs: the first contact, until they meet again, contact 11, or the whole impact."""
    contacts = solvers.solve(SCENES[f"figure-5.{number}"]).contacts
    assert len(contacts) == {13: 1, 14: 1, 15: 1, 16: 3, 17: 2, 18: 2, 19: 49, 20: 12}[number]


def test_figure_5_13():
    """Printed: 67 us."""
    found = solvers.solve(SCENES["figure-5.13"])
    assert found.contacts[0].end == approx(67e-6, abs=0.5e-6)
    time = np.linspace(0.0, found.contacts[0].end, 200)
    assert found.motion.force(time)[1:-1].min() > 0.0
    assert found.motion.force(time[[0, -1]]) == approx(0.0, abs=1e-6 * found.peak_force)


def test_figures_5_14_and_5_15():
    """Displacements of both sets agree, velocities but for the tip: printed 0.87 and 0.92 m/s."""
    found = solvers.solve(SCENES["figure-5.14"])
    end, x = found.contacts[0].end, np.linspace(0.0, 0.3, 31)
    course = found.motion.course
    (before, after), since = course.phases[:2], at(end)
    touching = course.amplitudes(before, since)[0] @ course.together.shapes(x)
    apart = course.amplitudes(after, np.zeros(1))[0] @ course.alone.shapes(x)
    assert np.abs(touching - apart).max() < 2e-4 * np.abs(touching).max()
    assert (touching - apart)[0, -1] == approx(-8.83e-9, rel=0.01)
    touching = course.amplitudes(before, since)[1] @ course.together.shapes(x)
    apart = course.amplitudes(after, np.zeros(1))[1] @ course.alone.shapes(x)
    assert (touching[0, -1], apart[0, -1]) == approx((0.87, 0.92), abs=5e-3)
    assert np.abs(touching - apart)[0, x < 0.27].max() < 0.02


def test_figures_5_16_to_5_18():
    """Printed: they meet again at 77.8 us. The modes of both start slower than the mass that comes."""
    found = solvers.solve(SCENES["figure-5.17"])
    again = found.contacts[1].start
    assert again == approx(77.8e-6, abs=0.05e-6)
    apart = np.linspace(found.contacts[0].end, again, 50)[5:-1]
    assert np.all(found.motion.end_position(apart) > found.motion.impactor_position(apart))
    coming, kept = (found.motion.impactor_velocity(at(again), after=after)[0] for after in (False, True))
    assert coming == approx(0.8665250191467467, rel=1e-9)
    assert found.motion.end_velocity(at(again), after=False)[0] < kept < coming
    losses = np.array(found.diagnostics["projection_losses"]) / found.energy["initial"]
    assert np.diff(losses)[:2] == approx([0.0001258, 0.0029108], rel=1e-3)


def test_figure_5_19():
    """Printed: about 4 ms, half the period of beam and mass, and 66 contacts, which are ill-conditioned."""
    found = solvers.solve(SCENES["figure-5.19"])
    assert found.contacts[-1].end == approx(4.165e-3, abs=0.3e-3)
    half = np.pi / found.motion.course.together.frequencies[0]
    assert half == approx(0.004066248925977478, rel=1e-12)
    assert found.contacts[-1].end == approx(half, rel=0.1)
    assert 2 * len(found.contacts) == found.diagnostics["steps"] != 122
    deepest = found.motion.end_position(np.linspace(0.0, 4e-3, 2001)).max()
    assert deepest == approx(0.00116373782025236, rel=0.12)  # (8.14), from the energy of the mass alone


def test_figure_5_20():
    """Contact 11 starts with a pull and ends at the second zero of the force, having pushed more than pulled."""
    found = solvers.solve(SCENES["figure-5.20"])
    contact = found.contacts[10]
    time = np.linspace(contact.start, contact.end, 400)[:-1]
    force = found.motion.force(time)
    assert force[0] == approx(-301.0, abs=1.0)
    assert np.count_nonzero(np.diff(np.sign(force))) == 1
    before, after, end = (
        float(found.motion.impactor_velocity(at(instant))[0])
        for instant in (contact.start - 1e-9, contact.start, contact.end)
    )
    pressed = np.trapezoid(force, time)
    assert pressed == approx(STEEL_ROD_MASS * (after - end), rel=1e-3) and pressed > 0.0
    assert before - after > 0.0  # what the change of modes takes at once
    assert contact.impulse == approx(STEEL_ROD_MASS * (before - end), rel=1e-9)
