"""The vibration modes of a target in its motion: shapes, frequencies, masses, how far and how strongly each rings."""

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..numerics.modes import Modes
from .motion import ShowsModes

PLACES = 2001  # at which the largest of a shape is looked for


class TargetModes:
    """The kept modes of a target that its impact can move, and what they do in it; SI units, arrays (modes,) in the
    order of their frequencies.

    Shapes are 1 where they are largest, and not negative where the target is struck. A modal coordinate is then the
    displacement of that place by this mode.
    Assumes: u = sum phi_i(x) q_i(t), q_i'' + 2 zeta omega_i q_i' + omega_i^2 q_i = phi_i(x1) F.
    Error: the largest value of a shape to (k L / PLACES)^2 / 8 with its wavenumber k: 2e-4 at the twentieth.
    Source: thesis 5.2, (5.2), and 5.5.
    """

    def __init__(self, motion: ShowsModes, length: float):
        self._motion, self._modes, self.length = motion, motion.target_modes, length

    @cached_property
    def numbers(self) -> np.ndarray:
        """From 1 on, of each among all vibration modes of the target: one that rests where it is struck is left out."""
        return numbers_of(self._modes)

    @property
    def frequencies(self) -> np.ndarray:
        """[Hz]"""
        return self._modes.frequencies / (2.0 * np.pi)

    @property
    def masses(self) -> np.ndarray:
        """Modal masses as the struck place feels them, 1 / phi_i(x1)^2 [kg]: the smaller, the more it takes part."""
        return self._modes.at_contact**-2.0

    @cached_property
    def _largest(self) -> np.ndarray:
        return largest_of(self._modes, self.length)

    def shapes(self, x: ArrayLike) -> np.ndarray:
        """(modes, x), at places [m] from the struck end of a rod, from the first support of a beam."""
        return unit_shapes(self._modes, self.length, x)

    def displacements(self, time: ArrayLike) -> np.ndarray:
        """What each gives the place where its shape is largest (time, modes) [m], at times [s]."""
        return self._motion.target_state(np.atleast_1d(np.asarray(time, float))).coordinates * self._largest

    def energies(self, time: ArrayLike) -> np.ndarray:
        """Kinetic and strain energy of each (time, modes) [J]; their sum is the part `target_vibration` of all."""
        state = self._motion.target_state(np.atleast_1d(np.asarray(time, float)))
        return 0.5 * (state.rates**2 + (self._modes.frequencies * state.coordinates) ** 2)


def numbers_of(modes: Modes) -> np.ndarray:
    """From 1 on, of each among all vibration modes of its body."""
    return np.arange(1, modes.frequencies.size + 1) if modes.numbers is None else modes.numbers


def largest_of(modes: Modes, length: float) -> np.ndarray:
    """The largest value of each mass-normalised shape (modes,) [kg^-1/2], by its sign where the body is struck."""
    values = modes.shapes(np.linspace(0.0, length, PLACES))
    return np.abs(values).max(axis=1) * np.where(modes.at_contact < 0.0, -1.0, 1.0)


def unit_shapes(modes: Modes, length: float, x: ArrayLike) -> np.ndarray:
    """Shapes (modes, x) that are 1 where they are largest, and not negative where the body is struck."""
    return modes.shapes(np.asarray(x, float)) / largest_of(modes, length)[:, None]
