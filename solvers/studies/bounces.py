"""A dropped body that bounces: impact after impact, up to its rest."""

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from .. import validation
from ..bodies import Mechanism
from ..bodies.drop import GRAVITY_RANGE, HEIGHT_RANGE, STANDARD_GRAVITY, height_and_gravity
from ..bodies.lumped import SPEED_RANGE
from ..methods.base import Method, SceneNotSupported, never
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.solution import Solution, apparent_time
from ..solution.summary import touching
from ..solve import solve
from ..text.notes import Note, Severity, coded
from ..validation import allowed

MAX_BOUNCES = 10_000
USUAL_BOUNCES = 200
USUAL_CUT = 1e-6  # of the first height


@dataclass(frozen=True)
class Bounce:
    """One impact and the flight after it."""

    time: float  # of the touch, from the release on [s]
    speed: float  # of the touch [m/s]
    rebound: float  # of the parting [m/s]; 0 or less: it stays
    restitution: float  # rebound over speed
    contact_time: float | None  # from first touch to last parting [s]; None: no duration
    height: float  # that it rises to [m]
    peak_force: float | None  # [N]


@dataclass(frozen=True)
class Bounces:
    """All impacts of a dropped body; what follows the last one is the sum of a geometric series."""

    scene: Scene
    method: dict[str, Any]
    height: float  # of the release [m]
    gravity: float  # [m/s2]
    cut: float  # height below which no impact is solved any more, as a part of the first
    bounces: list[Bounce]
    ended: str  # by: cut, contact (its weight is left out, and matters), stays, count
    rest_time: float | None  # from the release to rest [s]; None: it never rests
    path: float | None  # way up and down to rest [m]
    notes: list[Note] = field(default_factory=list)

    def table(self) -> dict[str, Any]:
        """As plain tables."""
        plain = {name: getattr(self, name) for name in ("height", "gravity", "cut", "ended", "rest_time", "path")}
        bounces = {"bounces": [asdict(bounce) for bounce in self.bounces]}
        return {"scene": self.scene.table(), "method": self.method} | plain | bounces | coded(self.notes)


def bounces(
    scene: SceneOrName,
    method: str | Method | None = None,
    cut: float = USUAL_CUT,
    count: int = USUAL_BOUNCES,
    gravity: float | None = None,
    cancelled: Callable[[], bool] = never,
    solved: Callable[[Solution], Any] | None = None,
) -> Bounces:
    """The impacts of a body that falls on what is held, each solved for its speed, with free flights between them.

    Its weight acts on it throughout: how high it rises depends on how far it comes down, and a loss that is large
    enough keeps it from leaving at all. A scene with a velocity is taken as dropped from v^2 / (2 g). Bounces come ever
    faster and never end (Zeno): below the height `cut`, as a part of the first, they are summed up with the last
    restitution e, 2 v / (g (1 - e)) in time and v^2 / (g (1 - e^2)) in way, v being the last rebound. It ends before
    that where the body never leaves, where weight matters to a method that leaves it out, or after `count` impacts.
    Each is solved until the bodies part for good, whatever duration the scene names. `solved` is given the solution of
    each. Assumes: the struck body has come to rest by the next impact, and has not yielded where that falls; no air.
    Raises SceneError for an impactor that is no mass, a target that is not held, or a mechanism, which moves on (see
    `Multibody`); and for values out of range.
    """
    scene = scene_of(scene)
    moves = isinstance(scene.target, Mechanism) or not scene.target.held
    if not scene.impactor.free_mass or moves or scene.normal is not None:
        raise SceneNotSupported("target.kind", scene.target.kind, allowed("bouncing"))
    cut = validation.number("cut", cut, 1e-15, 1.0)
    count = validation.whole_number("bounces", count, 1, MAX_BOUNCES)
    height, known = _dropped_from(scene)
    gravity = known if gravity is None else validation.number("gravity", gravity, *GRAVITY_RANGE, "m/s2")
    if "height" not in scene.given.get("impactor", ()):
        height = 0.5 * scene.impactor.velocity**2 / gravity
    time, speed = math.sqrt(2.0 * height / gravity), math.sqrt(2.0 * gravity * height)
    found, ended, used = [], "count", {}
    undated = {"method": {name: value for name, value in scene.method.items() if name != "duration"}}
    while not found or (len(found) < count and not cancelled()):
        falling = scene.replace({"impactor.velocity": speed, "impactor.gravity": gravity} | undated)
        try:
            solution = solve(falling, method)
        except SceneNotSupported as refused:
            if not found or refused.reason.code != "refusals.weight":
                raise
            ended = "contact"
            break
        if solved is not None:
            solved(solution)
        used, lasted = solution.method, apparent_time(solution.contacts)
        rebound, rises = _leaves(solution, gravity)
        found.append(Bounce(time, speed, rebound, rebound / speed, lasted, rises, solution.peak_force))
        if rebound < SPEED_RANGE[0] or rises <= 0.0:
            ended = "stays"
        elif rises < max(cut * height, HEIGHT_RANGE[0]):
            ended = "cut"
        else:
            speed = math.sqrt(2.0 * gravity * rises)
            time += (lasted or 0.0) + (rebound + speed) / gravity
            continue
        break
    rest, path = _to_rest(height, gravity, found, ended)
    return Bounces(scene, used, height, gravity, cut, found, ended, rest, path, _notes(scene, found, ended))


def _leaves(solution: Solution, gravity: float) -> tuple[float, float]:
    """With which speed [m/s], and to which height above where the next impact begins [m]; nothing of what stays.

    It may leave before it is back there, as where damping has used up the force, or a rod is still bent.
    """
    if solution.contacts and touching(solution.contacts, solution.duration):
        return 0.0, 0.0
    rebound, rises = -float(solution.impactor_velocity), 0.0
    if rebound > 0.0:
        parting = solution.contacts[-1].end
        below = float(solution.known_motion.impactor_position(np.array([parting]))[0])
        below -= solution.residual_indentation or 0.0
        rises = max(0.5 * rebound**2 / gravity - below, 0.0)
    return rebound, rises


def _dropped_from(scene: Scene) -> tuple[float, float]:
    """Height [m] and gravity [m/s2], as the scene has them."""
    given = scene.given.get("impactor", {})
    return height_and_gravity(given) if "height" in given else (math.nan, STANDARD_GRAVITY)


def _to_rest(height: float, gravity: float, found: list[Bounce], ended: str) -> tuple[float | None, float | None]:
    """Time [s] and way [m] from the release to rest, with the bounces that were cut off; None if it never rests."""
    last = found[-1]
    restitution = max(last.restitution, 0.0)
    if ended == "count" or restitution >= 1.0:
        return None, None
    way = height + 2.0 * sum(bounce.height for bounce in found[:-1])
    rebound = max(last.rebound, 0.0)
    time = last.time + (last.contact_time or 0.0)
    return time + 2.0 * rebound / gravity / (1.0 - restitution), way + rebound**2 / gravity / (1.0 - restitution**2)


def _notes(scene: Scene, found: list[Bounce], ended: str) -> list[Note]:
    notes = []
    if scene.target.time_unit is not None and len(found) > 1:
        notes.append(Note("bounces-on-rest", Severity.WARNING))
    if scene.contact.PLASTIC and len(found) > 1:
        notes.append(Note("bounces-on-fresh-spots", Severity.WARNING))
    if ended == "contact":
        notes.append(Note("weight-matters", Severity.REMARK, bounces=len(found) + 1))
    if ended == "count":
        notes.append(Note("bounces-go-on", Severity.REMARK, bounces=len(found), elastic=found[-1].restitution >= 1.0))
    return notes
