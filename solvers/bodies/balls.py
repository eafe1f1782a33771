"""A row of balls at rest, one behind the other, of which the first is struck: Newton's cradle."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .. import validation
from ..text.notes import Note, Severity
from ..validation import SceneError, allowed
from .lumped import RigidMass
from .material import LENGTH_RANGE, Material
from .protocol import Lumped

MOST_BALLS = 30


@dataclass(frozen=True)
class Balls(Lumped):
    """Free balls on the axis of the impact, each of which moves as a whole; between them the contact law of the scene.

    `gaps` [m]: what is free before each ball but the first, which the impactor touches.
    """

    balls: tuple[RigidMass, ...]
    gaps: tuple[float, ...]  # one less than balls

    KEYS = ("kind", "balls")
    BALL_KEYS = ("radius", "mass", "material", "gap")
    kind = "balls"
    velocity = 0.0
    bonded = False

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "Balls":
        given = validation.table(key, given, cls.KEYS)
        parts = validation.required(key, given, "balls", allowed("balls", most=MOST_BALLS))
        if not isinstance(parts, (list, tuple)) or not 1 <= len(parts) <= MOST_BALLS:
            raise SceneError(f"{key}.balls", parts, allowed("balls", most=MOST_BALLS))
        balls, gaps = [], []
        for number, part in enumerate(parts, 1):
            name = f"{key}.balls[{number}]"
            part = validation.table(name, part, cls.BALL_KEYS)
            if number == 1 and "gap" in part:
                raise SceneError(f"{name}.gap", part["gap"], allowed("first-ball"))
            gaps.append(validation.number(f"{name}.gap", part.get("gap", 0.0), 0.0, LENGTH_RANGE[1], "m"))
            ball = {"kind": "sphere"} | {each: value for each, value in part.items() if each != "gap"}
            balls.append(RigidMass.read(name, ball))
        return cls(tuple(balls), tuple(gaps[1:]))

    @property
    def mass(self) -> float:
        return sum(ball.mass for ball in self.balls)

    @property
    def radius(self) -> float | None:
        return self.balls[0].radius

    @property
    def material(self) -> Material:
        return self.balls[0].material

    @property
    def no_modes(self) -> Note:
        return Note("refusals.row-of-balls", Severity.REFUSAL)

    def table(self) -> dict[str, Any]:
        parts = [{"radius": ball.radius, "mass": ball.mass, "material": ball.material.table()} for ball in self.balls]
        for part, gap in zip(parts[1:], self.gaps, strict=True):
            if gap:
                part["gap"] = gap
        return {"kind": "balls", "balls": parts}
