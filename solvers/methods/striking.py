"""Mechanisms that strike: solved as struck, the other way round, and said as they are."""

from copy import copy
from typing import Any

import numpy as np

from ..numerics.multibody.mesh import ModeChange
from ..scene import Scene
from ..solution.motion import Balances, ChangesModes, MovesFace, ResolvesForce
from ..solution.solution import Later, Solution
from ..text.notes import Note
from .mechanisms import MechanismMotion

OTHER = {"impactor": "target", "target": "impactor"}


class StrikingMotion:
    """The motion of an impact in which a mechanism strikes, from that in which it is struck along the same line.

    The mechanism is the impactor, and what is felt along the normal counts the other way. Fields are those of the body
    that it strikes; what is known of links and joints is the same.
    """

    def __init__(self, scene: Scene, struck: Any):
        self.scene, self.struck = scene, struck

    # --- what does not depend on which of the two strikes

    def force(self, time, after=True):
        return self.struck.force(time, after)

    def force_history(self):
        return self.struck.force_history()

    def resolved_force(self, time):
        """The force, averaged where its method says over what."""
        seen = self.struck
        return seen.resolved_force(time) if isinstance(seen, ResolvesForce) else seen.force(time)

    def impulse(self, time, after=True):
        return self.struck.impulse(time, after)

    def coordinates(self, time) -> np.ndarray:
        return self.struck.coordinates(time)

    def link_points(self, time, parts: int = 1, magnified: float = 1.0) -> dict[str, np.ndarray]:
        return self.struck.link_points(time, parts, magnified)

    def link_rates(self, time: float) -> dict[str, dict[str, Any]]:
        return self.struck.link_rates(time)

    def reaction_forces(self, time) -> np.ndarray:
        return self.struck.reaction_forces(time)

    def reactions(self, until: float) -> list[dict[str, Any]]:
        return self.struck.reactions(until)

    def mode_change(self) -> ModeChange | None:
        return self.struck.mode_change() if isinstance(self.struck, ChangesModes) else None

    # --- along the normal

    def impactor_position(self, time):
        """Of the place that strikes."""
        return 0.0 - self.struck.end_position(time)

    def impactor_velocity(self, time, after=True):
        """Of the centre of all masses."""
        return 0.0 - self.struck.rigid_velocity(time, after)

    def face_velocity(self, time, after=True):
        """Of the place that strikes."""
        return 0.0 - self.struck.end_velocity(time, after)

    def end_position(self, time):
        """Of the struck face."""
        return self.displacement(time, np.zeros(1))[:, 0]

    def end_velocity(self, time, after=True):
        seen = self.struck
        found = seen.face_velocity if isinstance(seen, MovesFace) else seen.impactor_velocity
        return 0.0 - found(time, after)

    def rigid_velocity(self, time, after=True):
        return 0.0 - self.struck.impactor_velocity(time, after)

    # --- fields of what is struck, x from its struck end

    def displacement(self, time, x):
        return 0.0 - self._of_struck(time, x, "displacement", "impactor_position", "carried")

    def velocity(self, time, x):
        return 0.0 - self._of_struck(time, x, "velocity", "impactor_velocity", "speed")

    def stress(self, time, x):
        if not self.scene.target.rods:
            return np.zeros((np.size(time), np.size(x)))
        return self.struck.relative.stress(time, _beyond(x))

    def _of_struck(self, time, x, field: str, whole: str, frame: str) -> np.ndarray:
        """Along the normal of the mechanism, (time, x): of a rod as it was solved, seen from the struck point."""
        time, x = np.atleast_1d(np.asarray(time, float)), np.atleast_1d(np.asarray(x, float))
        if not self.scene.target.rods or not isinstance(self.struck, MechanismMotion):
            return np.repeat(getattr(self.struck, whole)(time)[:, None], x.size, axis=1)
        return getattr(self.struck.relative, field)(time, _beyond(x)) + getattr(self.struck, frame)(time)[:, None]

    # --- energy

    def energies(self, time):
        """Parts of the energy [J]: all of the mechanism is in "impactor"."""
        velocity = self.rigid_velocity(np.atleast_1d(np.asarray(time, float)))
        return _said(self.struck.energies(time), self.scene, velocity)


class BalancedStrikingMotion(StrikingMotion):
    """The same, made of impulses without duration."""

    @property
    def impulses(self) -> tuple[np.ndarray, np.ndarray]:
        """Times [s] and impulses [N s] of the balances."""
        return self.struck.impulses


def _beyond(x: Any) -> np.ndarray:
    """Places of a rod that is struck as those of one that strikes, which lies where x is negative."""
    return np.minimum(-np.atleast_1d(np.asarray(x, float)), -1e-300)


def _said(parts: dict[str, Any], scene: Scene, velocity: Any) -> dict[str, Any]:
    """Parts of an energy with the mechanism as the impactor; what a struck rod has beyond its mean motion rings."""
    given = dict(parts)
    whole = given.pop("impactor")
    rigid = 0.0 * whole if scene.target.held else 0.5 * scene.target.mass * velocity**2
    mechanism = given.pop("target_rigid") + given.pop("target_vibration", 0.0)
    ringing = whole - rigid if scene.target.rods else 0.0 * whole
    return {"impactor": mechanism, "target_rigid": whole - ringing, "target_vibration": ringing} | given


def _exchanged(note: Note) -> Note:
    """The note, with what it says of the one body said of the other."""
    other = OTHER.get(note.values.get("body", ""))
    return note if other is None else Note(note.code, note.severity, **note.values | {"body": other})


def as_striking(solution: Solution, scene: Scene) -> Solution:
    """The solution of the scene in which a mechanism strikes from that of `scene.struck`."""
    struck = solution.known_motion
    kind = BalancedStrikingMotion if isinstance(struck, Balances) else StrikingMotion
    motion, found = kind(scene, struck), copy(solution)

    def energy(_: Solution) -> dict[str, float]:
        parts = {name: value for name, value in solution.energy.items() if name != "initial"}
        return {"initial": solution.energy["initial"]} | _said(parts, scene, solution.impactor_velocity)

    for name, value in {
        "scene": scene,
        "motion": motion,
        "impulse": Later(lambda _: solution.impulse),
        "impactor_velocity": Later(lambda _: 0.0 - solution.target_velocity),
        "target_velocity": Later(lambda _: 0.0 - solution.impactor_velocity),
        "restitution": Later(lambda _: solution.restitution),
        "energy": Later(energy),
        "diagnostics": Later(lambda _: solution.diagnostics),
        "notes": Later(lambda _: [_exchanged(note) for note in solution.notes]),
    }.items():
        object.__setattr__(found, name, value)
    return found
