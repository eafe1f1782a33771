"""Beams under a steady force, held by their supports or by their own inertia; piecewise polynomials, so exact."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..quadrature import gauss
from .dispersion import BeamLine
from .end_conditions import DISPLACEMENT, ENDS, MOMENT, SHEAR, TURN

NODES, WEIGHTS = gauss(6)  # exact up to the eleventh power


class RigidMotion(NamedTuple):
    """How a beam with free motions goes off under a force at one place: shape(x) = start + slope x, 1 at that place."""

    mass: float  # felt at the place [kg], infinite for a held beam
    start: float
    slope: float  # [1/m]

    def shape(self, x: np.ndarray) -> np.ndarray:
        return self.start + self.slope * np.asarray(x, float)


class StaticShape(NamedTuple):
    """A beam under a steady unit force; each of x (x,) [m], per newton.

    Of a beam free to move it is the bent shape while the force accelerates it, less all motion as a whole.
    """

    compliance: float  # deflection where the force acts [m/N]
    deflections: Callable[[np.ndarray], np.ndarray]  # [m/N]
    slopes: Callable[[np.ndarray], np.ndarray]  # y' [1/N]
    moments: Callable[[np.ndarray], np.ndarray]  # E I psi' [m]
    shears: Callable[[np.ndarray], np.ndarray]  # V = M' without rotary inertia [-]


def rigid_motion(line: BeamLine, support: str, place: float) -> RigidMotion:
    """Mass felt and motion as a whole under one force at `place` [m]; a held beam has infinite mass and shape 1."""
    middle, turning = 0.5 * line.length, line.mass * line.length**2 * (1.0 / 12.0 + line.rotary_number)
    if support == "free-free":
        lever = place - middle
        mass = 1.0 / (1.0 / line.mass + lever**2 / turning)
        slope = mass * lever / turning
        return RigidMotion(mass, mass / line.mass - slope * middle, slope)
    if support == "pinned-free" and place > 1e-9 * line.length:  # else struck on the pin, as good as held
        return RigidMotion((turning + line.mass * middle**2) / place**2, 0.0, 1.0 / place)
    return RigidMotion(np.inf, 1.0, 0.0)


def static_compliance(line: BeamLine, support: str, place: float, end_mass: float = 0.0) -> float:
    """Deflection per steady force at `place` [m/N]; of a free or pinned-free beam against its own inertia.

    `end_mass` sits on the free end of a cantilever, where it makes no difference.
    """
    return static_shape(line, support, place).compliance


def overhang_compliance(line: BeamLine, pin: float, place: float) -> float:
    """Deflection per steady force at `place` [m/N] of a beam pinned at x = 0 and at `pin` [m], free beyond."""
    arm = place - pin
    if arm > 0.0:
        return arm**2 * place / (3.0 * line.bending_stiffness) + arm * place / (pin * line.shear_stiffness)
    square = (place * arm) ** 2 / (3.0 * line.bending_stiffness * pin)
    return square - place * arm / (pin * line.shear_stiffness)


def static_shape(line: BeamLine, support: str, place: float, attached_mass: float = 0.0) -> StaticShape:
    """Deflection, moment and shear force under a unit force at `place` [m], on which `attached_mass` [kg] rides.

    The mass matters to beams that are free to move, as its inertia resists the force where it acts.
    """
    bend = _Bend(line, support, place / line.length, attached_mass / line.mass)
    length, unit = line.length, line.length**2 / line.bending_stiffness

    def seen(quantity: int, factor: float) -> Callable[[np.ndarray], np.ndarray]:
        return lambda x: factor * bend.at(np.atleast_1d(np.asarray(x, float)) / length)[quantity]

    return StaticShape(
        unit * length * float(bend.at(np.array([place / length]))[DISPLACEMENT][0]),
        seen(DISPLACEMENT, unit * length),
        lambda x: unit * bend.slope(np.atleast_1d(np.asarray(x, float)) / length),
        seen(MOMENT, length),
        seen(SHEAR, 1.0),
    )


class _Bend:
    """The beam of unit length, mass and bending stiffness; rows displacement, turn, moment, shear force at x (4, x)."""

    def __init__(self, line: BeamLine, support: str, place: float, rider: float):
        self.place, self.shear, self.rotary = place, line.shear_number, line.rotary_number
        rigid = rigid_motion(BeamLine(1.0, 1.0, 1.0, self.rotary), support, place)
        whole = rigid.mass + rider
        self.accelerations = rigid.start / whole, rigid.slope / whole
        self.force = 1.0 if np.isinf(whole) else rigid.mass / whole  # what the rider leaves of it
        self.rider = rider
        self.unknown = self._start(ENDS[support], support)

    def _start(self, ends, support):
        """Displacement, turn, moment and shear force at x = 0, from what vanishes at the ends."""
        rows = []
        for quantities, x, side in zip(ends, (0.0, 1.0), (-1.0, 1.0), strict=True):
            free, loaded = self._free(np.array([x])), self._loaded(np.array([x]), side)
            rows += [(free[q, :, 0], loaded[q, 0]) for q in quantities]
        if support == "free-free":  # the far end is in balance already
            rows = [*rows[:2], *self._along((1.0, 0.0), (0.0, 1.0))]
        elif support == "pinned-free":
            rows = [*rows[:2], rows[3], *self._along((0.0, 1.0))]
        matrix, right = zip(*rows, strict=True)
        return np.linalg.solve(np.array(matrix), -np.array(right))

    def _along(self, *motions):
        """Mass products with the rigid motions start + slope x."""
        before, behind = 0.5 * self.place, 0.5 * (1.0 - self.place)
        x = np.concatenate([before * (1.0 + NODES), self.place + behind * (1.0 + NODES), [self.place]])
        weights = np.concatenate([before * WEIGHTS, behind * WEIGHTS, [self.rider]])
        turn_weights = self.rotary * weights
        turn_weights[-1] = 0.0  # the rider is a point
        free, loaded = self._free(x), self._loaded(x)
        for start, slope in motions:
            moved, turned = weights * (start + slope * x), turn_weights * slope
            yield tuple(field[DISPLACEMENT] @ moved + field[TURN] @ turned for field in (free, loaded))

    def _free(self, x):
        """By unit displacement, turn, moment and shear force at x = 0: (4, 4, x)."""
        one, no = np.ones_like(x), np.zeros_like(x)
        return np.array(
            [
                [one, x, x**2 / 2.0, x**3 / 6.0 - self.shear * x],
                [no, one, x, x**2 / 2.0],
                [no, no, one, x],
                [no, no, no, one],
            ]
        )

    def _loaded(self, x, side=0.0):
        """By the force and the inertia that meets it; `side` of the force for x at its place, else the inner one."""
        force, (move, turn) = self.force, self.accelerations
        behind = np.maximum(x - self.place, 0.0)
        beyond = (x > self.place) | ((x == self.place) & ((side > 0.0) | ((side == 0.0) & (self.place == 0.0))))
        rolled = self.rotary * turn
        return np.array(
            [
                force * (behind**3 / 6.0 - self.shear * behind)
                - move * (x**4 / 24.0 - self.shear * x**2 / 2.0)
                - turn * (x**5 / 120.0 - self.shear * x**3 / 6.0)
                + rolled * x**3 / 6.0,
                force * behind**2 / 2.0 - move * x**3 / 6.0 - turn * x**4 / 24.0 + rolled * x**2 / 2.0,
                force * behind - move * x**2 / 2.0 - turn * x**3 / 6.0 + rolled * x,
                force * beyond - move * x - turn * x**2 / 2.0,
            ]
        )

    def at(self, x):
        return np.einsum("qux,u->qx", self._free(x), self.unknown) + self._loaded(x)

    def slope(self, x):
        """y' = psi - V / (kappa G A)."""
        found = self.at(x)
        return found[TURN] - self.shear * found[SHEAR]
