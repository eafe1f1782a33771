"""Every method that can solve a scene, from coarse to fine."""

from dataclasses import dataclass, fields
from typing import Any

from ..bodies import Mechanism
from ..methods import METHODS
from ..methods.base import Method
from ..scene import Scene
from ..solution.solution import Solution
from ..text.notes import Note
from ..validation import SceneError

LEVELS: dict[str, tuple[float, ...]] = {  # values of each resolution, coarse to fine
    "modes": (6, 12, 25, 50, 100, 200, 400, 800, 1600, 3200),
    "elements": (6, 12, 25, 50, 100, 200, 400, 800, 1600),
    "steps": (25, 50, 100, 200, 400, 800, 1600, 3200, 6400),
    "tolerance": (1e-2, 1e-3, 1e-5, 1e-7, 1e-9),
}
SPATIAL = ("modes", "elements")  # no resolutions where no body rings
LINK_MODES = (1, 2, 3, 5, 8, 12, 20, 30, 45, 60)  # of each link of a mechanism: an impact moves but the lowest
VARIANTS: dict[str, tuple[dict[str, Any], ...]] = {  # of a method, each with a ladder of its own; else the usual one
    "fe-nodal": ({}, {"scheme": "central-difference"}),
    "balance": ({"restitution": 0.0}, {}),
    "quasi-static": ({"model": "structural"}, {"model": "local"}),
}

TRUST = ("waves", "modal", "mode-switch", "fe-modal", "fe-nodal", "quasi-static", "balance", "rigid")


@dataclass(frozen=True)
class Ladder:
    """One method with one option, `resolution`, from coarse to fine; a closed form has no resolution and one level."""

    resolution: str | Any  # None: nothing makes it finer
    levels: tuple[Method, ...]
    refined: Scene | None = None  # of a mechanism with more modes, for levels that have more than the scene

    def solve(self, level: int, scene: Scene, duration: float | None = None) -> Solution:
        """One level, complete; where it has more modes than the links of the scene, of links that have as many."""
        if self.refined is not None and self.size(level) > scene.target.known_as(Mechanism).most_modes:
            scene = self.refined
        return self.levels[level].solve(scene, duration).complete()

    @property
    def name(self) -> str:
        """Of the method, with the options that all levels share and that are not the usual ones."""
        return label(self.levels[0].table(), without=self.resolution)

    @property
    def converges(self) -> bool:
        """Whether a finer level is a better answer to the same question."""
        return self.resolution is not None and not self._assumes

    @property
    def exact(self) -> bool:
        """Whether a method that others of its kind refine needs no refining: waves with every event located."""
        return self.resolution is None and bool(self.levels[0].RESOLUTIONS) and not self._assumes

    @property
    def _assumes(self) -> bool:
        """Whether it assumes how the bodies part, whatever their contact."""
        return "restitution" in {option.name for option in fields(self.levels[0])}

    def size(self, level: int) -> float | Any:
        """The value of the resolution."""
        return None if self.resolution is None else getattr(self.levels[level], self.resolution)


def ladders(scene: Scene) -> list[Ladder]:
    """One for each method and variant that can solve the scene, closed forms first; empty if none can."""
    found: list[Ladder] = []
    scene = scene.struck
    for name, method in METHODS.items():
        for options in _variants(name, scene):
            if "restitution" in options and not _rings(scene) and not scene.rigid_contact:
                continue  # bodies that neither ring nor bounce would stay together, which no contact law has them do
            found += _of(method.read(options), scene)
    return sorted(found, key=lambda ladder: len(ladder.levels))


def _variants(name: str, scene: Scene) -> tuple[dict[str, Any], ...]:
    """Options of a method, each with a ladder of its own; where nothing gives way, the restitution that is given."""
    given = scene.method.get("restitution")
    gives_way = _rings(scene) or not scene.rigid_contact or scene.target.half_swing is not None
    if given is None or gives_way or name not in ("balance", "rigid"):
        return VARIANTS.get(name, ({},))
    return ({"restitution": given},)


def ranked(found: list[Ladder]) -> list[Ladder]:
    """Those first whose finest answer is to be trusted most."""
    places = {name: place for place, name in enumerate(TRUST)}
    return sorted(found, key=lambda ladder: places.get(ladder.levels[0].NAME, len(TRUST)))


def refusals(scene: Scene) -> dict[str, Note]:
    """Why the methods that cannot solve the scene cannot: a note for each."""
    given = {name: method.read({}).refusal(scene) for name, method in METHODS.items()}
    able = {ladder.levels[0].NAME for ladder in ladders(scene)}
    return {name: reason for name, reason in given.items() if reason is not None and name not in able}


def _of(method: Method, scene: Scene) -> list[Ladder]:
    """As it is, if no resolution matters or one makes it coarser than that, and refined by its resolution; nothing of
    one that leaves out weight, as no resolution brings that back."""
    if method.neglects_weight(scene):
        return []
    for resolution in method.RESOLUTIONS:
        if resolution in SPATIAL and not _rings(scene):
            continue
        if isinstance(scene.target, Mechanism) and scene.target.flexible and resolution in SPATIAL:
            if resolution == "modes" and method.refusal(scene) is None:
                return [_of_links(method, scene)]
            continue
        levels = [_allowed(method, resolution, size) for size in LEVELS[resolution]]
        kept = tuple(level for level in levels if level is not None and level.refusal(scene) is None)
        if kept:
            exact = resolution == "steps" and resolution != method.RESOLUTIONS[-1]  # steps beside no steps at all
            closed = [Ladder(None, (method,))] if exact and method.refusal(scene) is None else []
            return [*closed, Ladder(resolution, kept)]
    return [Ladder(None, (method,))] if method.refusal(scene) is None else []


def _of_links(method: Method, scene: Scene) -> Ladder:
    """By the modes of each link, up to more than the links of the scene have."""
    refined = scene.refined
    own, most = (each.target.known_as(Mechanism).most_modes for each in (scene, refined))
    sizes = sorted({own, *(size for size in LINK_MODES if size <= most)})
    levels = (_allowed(method, "modes", size) for size in sizes)
    return Ladder("modes", tuple(level for level in levels if level is not None), refined)


def _rings(scene: Scene) -> bool:
    return any(body.time_unit is not None for body in (scene.impactor, scene.target))


def _allowed(method: Method, resolution: str, size: float) -> Method | None:
    """With another value of the resolution, if the method takes it."""
    options = {key: value for key, value in method.table().items() if key != "name" and value is not None}
    try:
        return method.read(options | {resolution: size})
    except SceneError:
        return None


def label(table: dict[str, Any], without: str | None = None, always: str | None = None) -> str:
    """Name of a method with the options that are not the usual ones, without one of them, or always with one."""
    usual = METHODS[str(table["name"])].read({}).table()
    options = [
        f"{key}={value:g}" if isinstance(value, float) else f"{key}={value}"
        for key, value in table.items()
        if key not in ("name", without) and (key == always or value not in (usual[key], None))
    ]
    return " ".join([str(table["name"]), *options])
