"""Harmonic waves that meet a joint of two straight bars in a plane: what goes back, what goes on, and as what.

Along each bar run axial waves and, by Euler and Bernoulli, bending waves; beside a joint there are bending fields that
decay. Two displacements, a rotation, two forces and a moment meet in it: six conditions for six outgoing waves.
Source: thesis 11.3.7 asks for it; Cremer, Heckl and Petersson, Structure-Borne Sound (2005), chapter 6.
"""

from typing import NamedTuple

import numpy as np

RIGID, REVOLUTE, PRISMATIC = "fixed", "revolute", "prismatic"
AXIAL, BENDING = 0, 1  # rows and columns of what comes in and what goes out


class Bar(NamedTuple):
    """A uniform bar without end."""

    axial_stiffness: float  # E A [N]
    bending_stiffness: float  # E I [N m^2]
    mass_per_length: float  # rho A [kg/m]


class Scattered(NamedTuple):
    """Of each wave that comes along the first bar, [axial, bending].

    Amplitudes of displacement over that of the incoming wave, and shares of its power, (frequencies, in, out); out is
    [axial, bending] that goes back along the first bar, then [axial, bending] that goes on along the second.
    """

    amplitudes: np.ndarray  # complex
    powers: np.ndarray


def scatter(
    first: Bar, second: Bar, bend: float, joint: str, frequencies: np.ndarray, axis: tuple[float, float] = (1.0, 0.0)
) -> Scattered:
    """Two bars that meet in a joint without mass; the second goes on turned by `bend` [rad] from the first.

    joint: "fixed", "revolute", or "prismatic", in which the second slides along `axis`, given by its parts along and
    across the first bar. frequencies (frequencies,) [rad/s].
    Error: powers add up to 1 to rounding where the bending wavelength is not many thousand times another length.
    """
    amplitudes, powers = [], []
    for frequency in np.asarray(frequencies, float).tolist():
        found = _amplitudes(first, second, bend, joint, frequency, np.asarray(axis, float))
        weights = np.array([_power(bar, frequency) for bar in (first, second)]).ravel()
        amplitudes.append(found)
        powers.append(np.abs(found) ** 2 * weights / weights[:2, None])
    return Scattered(np.array(amplitudes), np.array(powers))


def _wavenumbers(bar: Bar, frequency: float) -> tuple[float, float]:
    """Of axial and of bending waves [1/m]."""
    axial = frequency * np.sqrt(bar.mass_per_length / bar.axial_stiffness)
    return axial, (bar.mass_per_length * frequency**2 / bar.bending_stiffness) ** 0.25


def _power(bar: Bar, frequency: float) -> tuple[float, float]:
    """That axial and bending waves of amplitude 1 carry [W/m^2]."""
    axial, bending = _wavenumbers(bar, frequency)
    return 0.5 * bar.axial_stiffness * axial * frequency, bar.bending_stiffness * bending**3 * frequency


def _ends(bar: Bar, frequency: float, way: float, along: np.ndarray) -> np.ndarray:
    """At x = 0, for waves exp(i w t - i way k x): displacement (2), rotation, force (2) and moment of the part ahead.

    (6, waves): axial, bending, and the bending field that decays the same way. The force is that of what lies at larger
    x on what lies at smaller.
    """
    axial, bending = _wavenumbers(bar, frequency)
    across = np.array([-along[1], along[0]])
    numbers = -1j * way * bending, -way * bending  # of exp(number x)
    columns = [np.concatenate((along, [0.0], -1j * way * axial * bar.axial_stiffness * along, [0.0]))]
    for number in numbers:
        stiff = bar.bending_stiffness
        columns.append(np.concatenate((across, [number], -stiff * number**3 * across, [stiff * number**2])))
    return np.array(columns).T


def _amplitudes(first: Bar, second: Bar, bend: float, joint: str, frequency: float, axis: np.ndarray) -> np.ndarray:
    """(in, out) of the waves that travel."""
    along = np.array([1.0, 0.0]), np.array([np.cos(bend), np.sin(bend)])
    back, on = _ends(first, frequency, -1.0, along[0]), _ends(second, frequency, 1.0, along[1])
    coming = _ends(first, frequency, 1.0, along[0])[:, :2]
    conditions = [(row, -row) for row in _continuous(joint, axis)]  # of first and second
    conditions += [(row, 0.0 * row) for row in _unloaded(joint, axis)]
    matrix = np.array([np.concatenate((one @ back, other @ on)) for one, other in conditions])
    right = -np.array([one @ coming for one, _ in conditions])
    scales = np.abs(matrix).max(axis=1, keepdims=True)
    found = np.linalg.solve(matrix / scales, right / scales).T
    return found[:, [0, 1, 3, 4]]


def _continuous(joint: str, axis: np.ndarray) -> list[np.ndarray]:
    """Of the six quantities at the joint those that both bars share; forces and moments are, as it has no mass."""
    own = np.eye(6)
    held = [own[3], own[4], own[5]]
    if joint == PRISMATIC:
        return [np.array([-axis[1], axis[0], 0.0, 0.0, 0.0, 0.0]), own[2], *held]
    return [own[0], own[1], *([own[2]] if joint == RIGID else []), *held]


def _unloaded(joint: str, axis: np.ndarray) -> list[np.ndarray]:
    """What the joint does not bear: moments if it turns, forces along its axis if it slides."""
    if joint == REVOLUTE:
        return [np.eye(6)[5]]
    if joint == PRISMATIC:
        return [np.array([0.0, 0.0, 0.0, axis[0], axis[1], 0.0])]
    return []
