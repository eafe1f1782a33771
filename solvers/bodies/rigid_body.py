"""Rigid bodies in space, of any inertia."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .. import validation
from ..numerics.rigid import impulses
from ..text.notes import Note
from ..validation import SceneError, allowed
from .lumped import MASS_RANGE, SPEED_RANGE
from .protocol import AnyBody

Vector = tuple[float, float, float]
Tensor = tuple[Vector, Vector, Vector]

MAX_LENGTH = 1e6  # [m]
FASTEST_SPIN = 1e9  # [rad/s]
HEAVIEST_MOMENT = 1e24  # [kg m2]: the heaviest mass at the longest arm
MAX_ASYMMETRY = 1e-9  # of what a file says twice: both halves of a symmetric tensor
FOUR_DIGITS = 1e-3  # of what it says in four digits: the moments of a plate, directions at right angles
NOWHERE = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Body(AnyBody):
    """A rigid body touched at one point, impactor or target. Vectors are in world axes, at the instant of the impact.

    Without inertia it is a point mass, which does not turn; a thin rod has none about its own axis.
    Source: note on rigid-body impulses.
    """

    mass: float  # [kg]
    velocity: Vector  # of the centre of mass [m/s]
    inertia: Tensor = (NOWHERE, NOWHERE, NOWHERE)  # at the centre of mass [kg m2]
    centre: Vector = NOWHERE  # of mass, from the point of impact [m]
    spin: Vector = NOWHERE  # [rad/s]
    principal: tuple[Vector, Tensor] | None = field(default=None, compare=False)  # moments and axes, where given so

    KEYS = ("kind", "mass", "inertia", "axes", "centre", "velocity", "spin")
    kind = "body"
    material = None
    length = 0.0

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "Body":
        given = validation.table(key, given, cls.KEYS)
        mass = validation.required_number(key, given, "mass", *MASS_RANGE, "kg")
        still = {"velocity": NOWHERE} if key == "target" else {}
        velocity = validation.required(key, still | dict(given), "velocity", _three_numbers(SPEED_RANGE[1], "m/s"))
        return cls(
            mass,
            read_vector(f"{key}.velocity", velocity, SPEED_RANGE[1], "m/s"),
            _read_inertia(key, given),
            read_vector(f"{key}.centre", given.get("centre", NOWHERE), MAX_LENGTH, "m"),
            read_vector(f"{key}.spin", given.get("spin", NOWHERE), FASTEST_SPIN, "rad/s"),
            _principal(given) if "axes" in given else None,
        )

    @property
    def is_point(self) -> bool:
        return not np.any(self.inertia)

    def table(self) -> dict[str, Any]:
        if self.principal is None:
            inertia: dict[str, Any] = {"inertia": [list(row) for row in self.inertia]}
        else:  # as given: digits of the tensor hang on the machine's linear algebra
            moments, axes = self.principal
            inertia = {"inertia": list(moments), "axes": [list(row) for row in axes]}
        vectors = {name: list(getattr(self, name)) for name in ("centre", "velocity", "spin")}
        return {"kind": "body", "mass": self.mass} | inertia | vectors


def in_space(body: AnyBody) -> impulses.Bodies:
    """Any body as the impulse kernels take it: one on an axis as a point mass on x, as heavy as an impact feels it."""
    if isinstance(body, Body):
        return impulses.Bodies(*(np.asarray(getattr(body, name)) for name in impulses.Bodies._fields))
    return impulses.Bodies(
        np.array(body.effective_mass), np.zeros((3, 3)), np.zeros(3), np.array([body.velocity, 0.0, 0.0]), np.zeros(3)
    )


def _three_numbers(largest: float, unit: str) -> Note:
    return allowed("three-numbers", largest=largest, unit=unit or "none")


def read_vector(key: str, given: object, largest: float, unit: str = "") -> Vector:
    """Three numbers. Raises SceneError naming the key, or the place in the list."""
    if not isinstance(given, (list, tuple)) or len(given) != 3:
        raise SceneError(key, given, _three_numbers(largest, unit))
    x, y, z = (validation.number(f"{key}[{i}]", value, -largest, largest, unit) for i, value in enumerate(given, 1))
    return x, y, z


def read_normal(key: str, given: object) -> Vector:
    """A direction, made a unit vector; one that is so already stays as it is."""
    vector = np.array(read_vector(key, given, 1e9))
    largest = np.abs(vector).max()
    if largest == 0.0:
        raise SceneError(key, given, allowed("direction"))
    length = float(np.linalg.norm(vector / largest)) * largest
    return tuple((vector if abs(length - 1.0) < 1e-15 else vector / largest / (length / largest)).tolist())


def check_struck(key: str, body: object, normal: Vector, rubbed: bool = False) -> None:
    """Refuses a body struck so that it would turn about an axis about which nothing resists; `rubbed` from any side."""
    ways = np.eye(3) if rubbed else np.array([normal])
    if isinstance(body, Body) and any(impulses.unresisted(in_space(body), way) for way in ways):
        raise SceneError(f"{key}.inertia", [list(row) for row in body.inertia], allowed("inertia-where-it-turns"))


def _read_inertia(key: str, given: Mapping[str, Any]) -> Tensor:
    """The tensor from nine numbers, or from three principal moments about `axes` (rows; x, y and z unless given)."""
    inertia, name = given.get("inertia", NOWHERE), f"{key}.inertia"
    if not isinstance(inertia, (list, tuple)) or len(inertia) != 3:
        raise SceneError(name, inertia, allowed("inertia"))
    if any(isinstance(row, (list, tuple)) for row in inertia):
        if "axes" in given:
            raise SceneError(f"{key}.axes", given["axes"], allowed("axes-of-moments"))
        rows = [read_vector(f"{name}[{i}]", row, HEAVIEST_MOMENT, "kg m2") for i, row in enumerate(inertia, 1)]
        tensor = np.array(rows)
        if np.abs(tensor - tensor.T).max() > MAX_ASYMMETRY * np.abs(tensor).max():
            raise SceneError(name, inertia, allowed("symmetric-tensor"))
    else:
        moments = np.array(read_vector(name, inertia, HEAVIEST_MOMENT, "kg m2"))
        axes = _read_axes(f"{key}.axes", given["axes"]) if "axes" in given else np.eye(3)
        tensor = (axes.T * moments) @ axes
    tensor = 0.5 * (tensor + tensor.T)
    _check_moments(name, inertia, tensor)
    x, y, z = (tuple(row) for row in tensor.tolist())
    return x, y, z


def _principal(given: Mapping[str, Any]) -> tuple[Vector, Tensor]:
    """Principal moments and their axes, checked before, as a file gives them."""
    rows = (given.get("inertia", NOWHERE), *given["axes"])
    moments, first, second, third = ((float(x), float(y), float(z)) for x, y, z in rows)
    return moments, (first, second, third)


def _read_axes(key: str, given: object) -> np.ndarray:
    """Three directions at right angles, as rows."""
    if not isinstance(given, (list, tuple)) or len(given) != 3:
        raise SceneError(key, given, allowed("axes"))
    axes = np.array([read_normal(f"{key}[{i}]", row) for i, row in enumerate(given, 1)])
    if np.abs(axes @ axes.T - np.eye(3)).max() > FOUR_DIGITS:
        raise SceneError(key, given, allowed("right-angles"))
    left, _, right = np.linalg.svd(axes)  # the nearest ones that are so exactly
    return left @ right


def _check_moments(key: str, given: object, tensor: np.ndarray) -> None:
    """No principal moment is negative, or exceeds the sum of the other two: a plate reaches that, no body passes it."""
    low, middle, high = np.linalg.eigvalsh(tensor).tolist()
    found = f"(here {low:.6g}, {middle:.6g} and {high:.6g})"
    if low < -MAX_ASYMMETRY * max(high, -low):
        raise SceneError(key, given, allowed("positive-moments", moments=found))
    if low + middle < high * (1.0 - FOUR_DIGITS):
        raise SceneError(key, given, allowed("moments-of-a-body", moments=found))
