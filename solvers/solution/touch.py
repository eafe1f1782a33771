"""The circle on which two smooth bodies touch during an impact, and what they press on each other there."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..contact import Hertz, PlasticPower, tabor
from ..contact.constants import contact_modulus, contact_radius, yield_strength
from ..contact.plastic import crater

EARLIER = 2_001  # instants before the first that is asked for, among which is the deepest


class Touch(NamedTuple):
    """At instants (time,); nought while the bodies are apart. Source: thesis 3.4.1 and 7.3.5, (7.25).

    By Hertz a^2 = alpha R, and the pressure in the middle is 1.5 times its mean. As the contact flows, a^2 grows to
    2 alpha R where flow is full, by Tabor's tests, and falls with Hertz's law of the crater on the way back.
    """

    law: str
    radius: np.ndarray  # a [m]
    pressure: np.ndarray  # mean, F / (pi a^2) [Pa]
    strength: float | None  # yield strength of the softer body [Pa]

    @property
    def greatest(self) -> np.ndarray | None:
        """p0, in the middle [Pa]; None of a law that flows, which flattens it."""
        return 1.5 * self.pressure if self.law == Hertz.NAME else None


def touch(solution: Any, time: ArrayLike) -> Touch | None:
    """See `Solution.touch`."""
    scene, motion = solution.scene.struck, solution.known_motion
    law, radius = scene.contact, contact_radius(scene.impactor, scene.target)
    if not isinstance(law, Hertz | PlasticPower) or radius is None:
        return None
    time = np.atleast_1d(np.asarray(time, float))
    depth = np.maximum(motion.impactor_position(time) - motion.end_position(time), 0.0)
    square, force = radius * depth, motion.force(time)
    if isinstance(law, PlasticPower):
        before = np.linspace(0.0, time[0], EARLIER)
        earlier = motion.impactor_position(before) - motion.end_position(before)
        deepest = np.maximum(np.maximum.accumulate(depth), earlier.max())
        square = radius * np.array(
            [_flattened(law, *each) for each in zip(depth.tolist(), deepest.tolist(), strict=True)]
        )
    pressed = (square > 0.0) & (force > 0.0)
    pressure = np.where(pressed, force / (np.pi * np.where(pressed, square, 1.0)), 0.0)
    return Touch(
        law.NAME, np.sqrt(np.where(pressed, square, 0.0)), pressure, yield_strength(scene.impactor, scene.target)
    )


def _flattened(law: PlasticPower, depth: float, deepest: float) -> float:
    """a^2 / R [m] at an indentation, `deepest` being the largest so far."""
    if depth >= deepest:
        full = (depth - law.yield_indentation) / (law.full_indentation - law.yield_indentation)
        return (1.0 + min(max(full, 0.0), 1.0)) * depth
    dent, stiffness = crater(law, deepest)
    return (stiffness / law.stiffness) ** 2 * max(depth - dent, 0.0)


class Pressing(NamedTuple):
    """A contact that flows as it is pressed on slowly, at indentations (depths,). Source: thesis figures 7.5 to 7.8."""

    indentation: np.ndarray  # alpha [m]
    elastic: np.ndarray  # radius by Hertz, sqrt(alpha R) [m]; where flow is full sqrt(2) times that, (7.24)
    radius: np.ndarray  # a, (7.25) [m]
    pressure: np.ndarray  # mean, F / (pi a^2), by the law, over the yield strength
    tests: np.ndarray  # the same by Tabor's tests, (7.17); NaN before first and beyond full flow
    tested: np.ndarray  # their force, (7.28) [N]; NaN likewise


def pressing(scene: Any, indentation: ArrayLike) -> Pressing | None:
    """At indentations (depths,) [m]; None by other laws, without a yield strength, or if both faces are flat.

    Differs: the power law that is to follow the tests, (7.33), has 5 % less at twice the first yield, 14 % more at
    fifty times, 4 % more at full flow.
    """
    law, radius = scene.contact, contact_radius(scene.impactor, scene.target)
    strength, modulus = yield_strength(scene.impactor, scene.target), contact_modulus(scene.impactor, scene.target)
    if not isinstance(law, PlasticPower) or radius is None or strength is None or modulus is None:
        return None
    depth = np.atleast_1d(np.asarray(indentation, float))
    square = radius * np.array([_flattened(law, each, each) for each in depth.tolist()])
    force = np.array([law.force(each, 0.0, 0.0) for each in depth.tolist()])
    area = np.pi * np.where(square > 0.0, square, 1.0)
    width = np.sqrt(square) * 2.0 * modulus / (radius * strength)
    tests = tabor.pressure(np.where((width >= tabor.FIRST) & (width <= tabor.FULL * (1.0 + 1e-9)), width, np.nan))
    return Pressing(
        depth, np.sqrt(radius * depth), np.sqrt(square), force / (area * strength), tests, tests * strength * area
    )
