"""A motion known on a grid of times: what finite elements, balances and closed forms give."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np


class ShapeField:
    """Fields as sums of shapes: u(x, t) = sum_i q_i(t) shape_i(x), straight between the instants.

    coordinates, rates (time, shapes); shapes(x), slopes(x) (shapes, x), x [m] from the struck face, slopes those that
    `young` [Pa] turns into stress; moments(x), shears(x) of beams.
    """

    def __init__(
        self,
        time: np.ndarray,
        coordinates: np.ndarray,
        rates: np.ndarray,
        shapes: Callable[[np.ndarray], np.ndarray],
        slopes: Callable[[np.ndarray], np.ndarray],
        young: float,
        moments: Callable[[np.ndarray], np.ndarray] | None = None,
        shears: Callable[[np.ndarray], np.ndarray] | None = None,
    ):
        self._time, self._coordinates, self._rates = time, coordinates, rates
        self._shapes, self._slopes, self._young = shapes, slopes, young
        self._moments, self._shears = moments, shears

    def _at(self, time: np.ndarray, values: np.ndarray) -> np.ndarray:
        time = np.clip(np.asarray(time, float), self._time[0], self._time[-1])
        cell = np.clip(np.searchsorted(self._time, time, "right") - 1, 0, self._time.size - 2)
        width = self._time[cell + 1] - self._time[cell]
        part = ((time - self._time[cell]) / np.where(width > 0.0, width, 1.0))[:, None]
        return values[cell] + part * (values[cell + 1] - values[cell])

    def displacement(self, time: np.ndarray, x: np.ndarray) -> np.ndarray:
        return self._at(time, self._coordinates) @ self._shapes(np.asarray(x, float))

    def velocity(self, time: np.ndarray, x: np.ndarray) -> np.ndarray:
        return self._at(time, self._rates) @ self._shapes(np.asarray(x, float))

    def stress(self, time: np.ndarray, x: np.ndarray) -> np.ndarray:
        """Compression positive [Pa]."""
        return -self._young * (self._at(time, self._coordinates) @ self._slopes(np.asarray(x, float)))

    @staticmethod
    def _of_beam(table: Callable[[np.ndarray], np.ndarray] | None, x: np.ndarray) -> np.ndarray:
        if table is None:
            raise TypeError("only beams have moments and shear forces")
        return table(np.asarray(x, float))

    def moment(self, time: np.ndarray, x: np.ndarray) -> np.ndarray:
        """E I y'' [N m]."""
        return self._at(time, self._coordinates) @ self._of_beam(self._moments, x)

    def shear(self, time: np.ndarray, x: np.ndarray) -> np.ndarray:
        """Slope of the moment [N]."""
        return self._at(time, self._coordinates) @ self._of_beam(self._shears, x)


def given_up(law: Any, stored: np.ndarray, instants: np.ndarray, force: np.ndarray) -> np.ndarray:
    """What of the energy `stored` in a contact, at `instants`, no force will ever give back [J].

    A dashpot may use up the force before the surfaces have come back: what they still hold when they part is lost to
    it. force (steps,) over each step, or its impulse.
    """
    pressed = np.flatnonzero(force > 0.0)
    parted = pressed[-1] + 1 if pressed.size else 0
    if not law.LOSSY or parted >= force.size:
        return np.zeros_like(stored)
    return np.where(instants >= parted, stored, 0.0)


def growth(time: np.ndarray, instants: np.ndarray, total: np.ndarray, width: float) -> np.ndarray:
    """Mean rate at which a history grows over a window of this width about each time, as far as it is known."""
    first = np.maximum(np.asarray(time, float) - 0.5 * width, instants[0])
    last = np.minimum(np.asarray(time, float) + 0.5 * width, instants[-1])
    return (np.interp(last, instants, total) - np.interp(first, instants, total)) / (last - first)


def field_as_a_whole(beam: Any, time: np.ndarray, struck: np.ndarray, rate: np.ndarray) -> ShapeField:
    """Of a beam that does not bend, by the displacement and velocity of the place where it is struck (time,)."""
    shape, drift = beam.modes(1).rigid_shape, np.full(time.size, beam.velocity)

    def shapes(x):
        return np.stack((shape(x), np.ones_like(x)))

    def nothing(x):
        return np.zeros((2, x.size))

    coordinates = np.stack((struck - drift * time, drift * time), axis=1)
    rates = np.stack((rate - drift, drift), axis=1)
    return ShapeField(time, coordinates, rates, shapes, nothing, 0.0, nothing, nothing)


class SampledMotion:
    """Histories on a grid of times [s], straight in between; at a jump the time stands twice.

    Arrays (time,), SI units: contact force, its impulse so far, position and velocity of the impactor, of the struck
    face of the target, mean velocity of the target; energies: every part of the split, (time,) each [J]. `field` gives
    displacement, velocity and stress in the target; without one the target moves as a whole, or, if it has no mean
    velocity, not at all, and carries no stress.
    face_velocity: of the impactor where it strikes, if that is not its own.
    """

    _field: ShapeField | Any = None

    def __init__(
        self,
        *,
        time: np.ndarray,
        force: np.ndarray,
        impulse: np.ndarray,
        impactor_position: np.ndarray,
        impactor_velocity: np.ndarray,
        end_position: np.ndarray,
        end_velocity: np.ndarray,
        rigid_velocity: np.ndarray,
        energies: Mapping[str, np.ndarray],
        field: ShapeField | None = None,
        face_velocity: np.ndarray | None = None,
    ):
        self.time = np.asarray(time, float)
        self._force, self._impulse = force, impulse
        self._impactor_position, self._impactor_velocity = impactor_position, impactor_velocity
        self._end_position, self._end_velocity = end_position, end_velocity
        self._rigid_velocity, self._energies = rigid_velocity, energies
        if field is not None:
            self._field = field
        self._face_velocity = impactor_velocity if face_velocity is None else face_velocity

    def _at(self, time, values, after=True):
        """Straight between the instants; at a jump the value after it, or before it."""
        time = np.clip(np.asarray(time, float), self.time[0], self.time[-1])
        values = np.asarray(values, float)
        cell = np.searchsorted(self.time, time, "right" if after else "left") - 1
        cell = np.clip(cell, 0, self.time.size - 2)
        width = self.time[cell + 1] - self.time[cell]
        part = np.where(width > 0.0, (time - self.time[cell]) / np.where(width > 0.0, width, 1.0), float(after))
        return values[cell] + part * (values[cell + 1] - values[cell])

    def force(self, time, after=True):
        return self._at(time, self._force, after)

    def force_history(self):
        return self.time, self._force

    def impulse(self, time, after=True):
        return self._at(time, self._impulse, after)

    def impactor_position(self, time):
        return self._at(time, self._impactor_position)

    def impactor_velocity(self, time, after=True):
        return self._at(time, self._impactor_velocity, after)

    def face_velocity(self, time, after=True):
        """Of the impactor where it strikes."""
        return self._at(time, self._face_velocity, after)

    def end_position(self, time):
        return self._at(time, self._end_position)

    def end_velocity(self, time, after=True):
        return self._at(time, self._end_velocity, after)

    def rigid_velocity(self, time, after=True):
        return self._at(time, self._rigid_velocity, after)

    @property
    def has_field(self) -> bool:
        """Whether fields know places apart; else they are those of the target as a whole."""
        return self._field is not None

    def _everywhere(self, values: np.ndarray, x: np.ndarray) -> np.ndarray:
        """What moves as a whole, by its struck face (time,); a held body, whose face alone gives way, stays."""
        moves = bool(np.any(self._rigid_velocity))
        return np.repeat(moves * values[:, None], np.size(x), axis=1)

    def displacement(self, time, x):
        if self._field is None:
            return self._everywhere(self.end_position(time), x)
        return self._field.displacement(time, x)

    def velocity(self, time, x):
        if self._field is None:
            return self._everywhere(self.end_velocity(time), x)
        return self._field.velocity(time, x)

    def stress(self, time, x):
        if self._field is None:
            return np.zeros((np.size(time), np.size(x)))
        return self._field.stress(time, x)

    @staticmethod
    def _of_beam(table: Callable[[np.ndarray], np.ndarray] | None, x: np.ndarray) -> np.ndarray:
        if table is None:
            raise TypeError("only beams have moments and shear forces")
        return table(np.asarray(x, float))

    def moment(self, time, x):
        """Of beams: bending moment [N m]."""
        if self._field is None:
            return np.zeros((np.size(time), np.size(x)))
        return self._field.moment(time, x)

    def shear(self, time, x):
        """Of beams: shear force [N]."""
        if self._field is None:
            return np.zeros((np.size(time), np.size(x)))
        return self._field.shear(time, x)

    def energies(self, time):
        return {name: self._at(time, values) for name, values in self._energies.items()}
