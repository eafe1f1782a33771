"""A force prescribed on the end of a rod: the input of a bar test, whatever made it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np

from .. import validation
from ..validation import SceneError, allowed
from .protocol import AnyBody

SHAPES = ("rectangle", "triangle", "half-sine", "trapezoid")
MAX_POINTS = 2_000
SINE_PIECES = 32  # of a half sine, each a polynomial of degree 6 to a solver of waves: they miss 2e-15 of its peak
LEAST_FORCE = 1e-9  # [N]; smaller, and nothing happens


@dataclass(frozen=True)
class Pulse(AnyBody):
    """A compressive force on the struck end, with straight lines between its corners or one half sine; nothing strikes.

    `velocity` is that of the end of a rod without reflections under the largest force, F / Z.
    """

    times: tuple[float, ...]  # [s], from 0
    forces: tuple[float, ...]  # [N]
    velocity: float = 1.0  # [m/s]
    curved: bool = False  # a half sine from the first corner to the last, through the highest
    shaped: Mapping[str, Any] | None = field(default=None, compare=False)  # shape, force and duration, where given so

    KEYS = ("kind", "shape", "force", "duration", "rise", "points")
    kind = "pulse"
    mass = math.inf
    material = None
    length = 0.0

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "Pulse":
        """From the table `[impactor]`: `points = [[t, F], ...]`, or `shape`, `force`, `duration` and for a trapezoid
        `rise`. Raises SceneError naming the key.
        """
        given = validation.table(key, given, cls.KEYS)
        if "points" in given:
            for name in ("shape", "force", "duration", "rise"):
                if name in given:
                    raise SceneError(f"{key}.{name}", given[name], allowed("nothing-beside", other="points"))
            return cls(*_read_points(f"{key}.points", given["points"]))
        shape = validation.choice(f"{key}.shape", given.get("shape", "rectangle"), SHAPES)
        force = validation.required_number(key, given, "force", LEAST_FORCE, 1e15, "N")
        duration = validation.required_number(key, given, "duration", 1e-9, 10.0, "s")
        if "rise" in given and shape != "trapezoid":
            raise SceneError(f"{key}.rise", given["rise"], allowed("only-with", key="shape", value=["trapezoid"]))
        rise = validation.number(f"{key}.rise", given.get("rise", 0.1 * duration), 0.0, 0.5 * duration, "s")
        times, shares = _shape(shape, duration, rise)
        shaped = {"shape": shape, "force": force, "duration": duration}
        shaped |= {"rise": rise} if shape == "trapezoid" else {}
        curved = shape == "half-sine"
        return cls(tuple(times), tuple(force * share for share in shares), curved=curved, shaped=shaped)

    def on(self, impedance: float) -> "Pulse":
        """The same pulse on a rod of this impedance [kg/s]."""
        return replace(self, velocity=max(self.forces) / impedance)

    @property
    def end(self) -> float:
        """When it is over [s]."""
        return self.times[-1]

    @property
    def impulse(self) -> float:
        """All that it pushes [N s]."""
        return float(self.pushed(np.array(self.end)))

    def pushed(self, time: np.ndarray) -> np.ndarray:
        """Its impulse up to these times [N s], by the integral of its shape."""
        if self.curved:
            turned = 0.5 * np.pi * np.clip(time / self.end, 0.0, 1.0)
            return 2.0 / np.pi * max(self.forces) * self.end * np.sin(turned) ** 2
        times, forces = np.array(self.times), np.array(self.forces)
        before = np.concatenate(([0.0], np.cumsum(0.5 * (forces[1:] + forces[:-1]) * np.diff(times))))
        now = np.clip(time, 0.0, self.end)
        at = np.clip(np.searchsorted(times, now, "right") - 1, 0, times.size - 2)
        width, since = times[at + 1] - times[at], now - times[at]
        bend = (forces[at + 1] - forces[at]) / np.where(width > 0.0, width, 1.0)
        return before[at] + since * (forces[at] + 0.5 * bend * since)

    def pieces(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Its smooth pieces: when each begins and ends (pieces, 2) [s], and the force at these places of each, from 0
        to 1, (pieces, places) [N].
        """
        if self.curved:
            whole = np.arange(SINE_PIECES)
            at = (whole[:, None] + places) / SINE_PIECES
            edges = self.end / SINE_PIECES * np.column_stack((whole, whole + 1))
            return edges, max(self.forces) * np.sin(np.pi * np.minimum(at, 1.0 - at))
        corners = np.array([self.times, self.forces])
        left, right = (side[:, np.diff(self.times) > 0.0] for side in (corners[:, :-1], corners[:, 1:]))
        return np.column_stack((left[0], right[0])), left[1][:, None] + np.outer(right[1] - left[1], places)

    def table(self) -> dict[str, Any]:
        if self.shaped is not None:  # as given: digits of a sine hang on the machine's mathematical functions
            return {"kind": self.kind} | dict(self.shaped)
        return {"kind": self.kind, "points": [list(point) for point in zip(self.times, self.forces, strict=True)]}


def _shape(shape: str, duration: float, rise: float) -> tuple[list[float], list[float]]:
    """Corners of a pulse of unit height; a half sine has those of a triangle."""
    if shape == "rectangle":
        return [0.0, duration], [1.0, 1.0]
    if shape in ("triangle", "half-sine"):
        return [0.0, 0.5 * duration, duration], [0.0, 1.0, 0.0]
    return [0.0, rise, duration - rise, duration], [0.0, 1.0, 1.0, 0.0]


def _read_points(key: str, given: object) -> tuple[tuple[float, ...], tuple[float, ...]]:
    pairs = allowed("force-points", most=MAX_POINTS)
    if not isinstance(given, list) or not 2 <= len(given) <= MAX_POINTS:
        raise SceneError(key, given, pairs)
    times, forces = [], []
    for number, point in enumerate(given, 1):
        if not isinstance(point, list) or len(point) != 2:
            raise SceneError(f"{key}[{number}]", point, pairs)
        times.append(validation.number(f"{key}[{number}]", point[0], 0.0, 10.0, "s"))
        forces.append(validation.number(f"{key}[{number}]", point[1], 0.0, 1e15, "N"))
    if times[0] != 0.0 or any(b < a for a, b in pairwise(times)) or times[-1] < 1e-9:
        raise SceneError(key, given, pairs)
    if max(forces) < LEAST_FORCE:
        raise SceneError(key, given, allowed("some-force", least=LEAST_FORCE))
    return tuple(times), tuple(forces)
