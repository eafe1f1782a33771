"""Waves that meet a joint of two bars: closed forms, power, reciprocity, limits."""

import numpy as np
import pytest
from pytest import approx

from solvers.numerics.waves.scattering import AXIAL, BENDING, Bar, scatter

STEEL = Bar(210e9 * 9e-4, 210e9 * 6.75e-8, 7.11)  # 3 x 3 cm
THICK = Bar(4.0 * STEEL.axial_stiffness, 16.0 * STEEL.bending_stiffness, 4.0 * STEEL.mass_per_length)  # 6 x 6 cm
FREQUENCIES = np.array([1.0, 1e2, 1e4, 1e5])  # rad/s
JOINTS = ("fixed", "revolute", "prismatic")
GONE_ON = 2  # column of the first wave that goes on


@pytest.mark.parametrize("joint", JOINTS)
@pytest.mark.parametrize("bend", [0.0, 0.3, np.pi / 2, -2.5])
@pytest.mark.parametrize("second", [STEEL, THICK], ids=["alike", "thick"])
def test_power(joint, bend, second):
    """None is lost, whatever comes in, and no share is negative."""
    found = scatter(STEEL, second, bend, joint, FREQUENCIES, (0.6, 0.8))
    assert found.powers.sum(axis=2) == approx(np.ones((4, 2)), abs=1e-12)
    assert (found.powers >= 0.0).all()


@pytest.mark.parametrize("joint", JOINTS)
def test_reciprocity(joint):
    """As much of the power of an axial wave becomes bending as the other way round, also from the other bar."""
    bend, axis = 0.7, np.array([0.6, 0.8])
    there = scatter(STEEL, THICK, bend, joint, FREQUENCIES, (0.6, 0.8)).powers
    assert there[:, AXIAL, BENDING] == approx(there[:, BENDING, AXIAL], rel=1e-10)
    # seen from the second bar, which then runs towards the joint: turned by pi - bend the other way round
    along = -np.array([np.cos(bend), np.sin(bend)])
    across = np.array([-along[1], along[0]])
    back = scatter(THICK, STEEL, -bend, joint, FREQUENCIES, (float(axis @ along), float(axis @ across))).powers
    assert there[:, :, GONE_ON:] == approx(np.swapaxes(back[:, :, GONE_ON:], 1, 2), rel=1e-9, abs=1e-15)


def test_bars_in_line():
    """One bar with a fixed joint; with a pin half of the bending power goes on, of axial waves all."""
    whole = scatter(STEEL, STEEL, 0.0, "fixed", FREQUENCIES).powers
    assert whole == approx(np.broadcast_to([[0, 0, 1, 0], [0, 0, 0, 1]], whole.shape), abs=1e-12)
    pinned = scatter(STEEL, STEEL, 0.0, "revolute", FREQUENCIES).powers
    assert pinned == approx(np.broadcast_to([[0, 0, 1, 0], [0, 0.5, 0, 0.5]], whole.shape), abs=1e-12)
    sliding = scatter(STEEL, STEEL, 0.0, "prismatic", FREQUENCIES).powers
    assert sliding == approx(np.broadcast_to([[1, 0, 0, 0], [0, 0, 0, 1]], whole.shape), abs=1e-12)


def test_change_of_section():
    """Axial waves by the impedances, r = (Z1 - Z2) / (Z1 + Z2); bending by Cremer's chi and psi."""
    found = scatter(STEEL, THICK, 0.0, "fixed", FREQUENCIES)
    assert found.amplitudes[:, AXIAL, 0] == approx(np.full(4, -0.6), abs=1e-12)
    assert found.amplitudes[:, AXIAL, GONE_ON] == approx(np.full(4, 0.4), abs=1e-12)
    chi = (THICK.mass_per_length * STEEL.bending_stiffness / STEEL.mass_per_length / THICK.bending_stiffness) ** 0.25
    psi = (THICK.bending_stiffness * THICK.mass_per_length / STEEL.bending_stiffness / STEEL.mass_per_length) ** 0.5
    passed = 2.0 * np.sqrt(chi * psi) * (1.0 + chi) * (1.0 + psi)
    passed /= chi * (1.0 + psi) ** 2 + 2.0 * psi * (1.0 + chi**2)
    assert found.powers[:, BENDING, GONE_ON + BENDING] == approx(np.full(4, passed**2), rel=1e-10)


def test_a_pin_at_a_right_angle():
    """One bar's ends move along the other: displacement and force are shared, nothing else. By hand, with impedances.

    The first is pushed by E A i k a (1 - r), the second across resists by its driving-point impedance at a free end.
    """
    found = scatter(STEEL, STEEL, np.pi / 2, "revolute", FREQUENCIES)
    along = np.sqrt(STEEL.axial_stiffness * STEEL.mass_per_length)
    bending = (STEEL.mass_per_length * FREQUENCIES**2 / STEEL.bending_stiffness) ** 0.25
    across = (
        STEEL.bending_stiffness * bending**3 / FREQUENCIES * 0.5 * (1.0 + 1.0j)
    )  # force over velocity of a free end
    reflected = (along - across) / (along + across)
    assert found.amplitudes[:, AXIAL, 0] == approx(reflected, rel=1e-10)
    assert found.powers[:, AXIAL, [1, 2]] == approx(np.zeros((4, 2)), abs=1e-20)


def test_nothing_behind_the_joint():
    """A second bar that weighs next to nothing leaves a free end; one that is as heavy as a wall, a fixed one."""
    light = Bar(*(1e-9 * part for part in STEEL))
    heavy = Bar(*(1e9 * part for part in STEEL))
    free, held = (scatter(STEEL, other, 0.4, "fixed", FREQUENCIES[:3]).amplitudes for other in (light, heavy))
    assert free[:, AXIAL, AXIAL] == approx(np.ones(3), abs=1e-6)
    assert held[:, AXIAL, AXIAL] == approx(-np.ones(3), abs=1e-6)
    assert free[:, BENDING, BENDING] == approx(np.full(3, -1.0j), abs=1e-6)
    assert held[:, BENDING, BENDING] == approx(np.full(3, -1.0j), abs=1e-6)
