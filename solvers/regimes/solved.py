"""Which model is enough, by solving the scene with each: with so many modes of what bends or rings, and with fewer."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from ..accuracy.reference import exact_waves
from ..bodies import FlexiblePendulum, Mechanism, RotatingRod
from ..bodies.pendulum import BENDING_KEYS
from ..contact.protocol import Damped
from ..methods import METHODS, Modal, Waves
from ..methods.base import Method
from ..scene import Scene
from ..solution.solution import Solution
from .candidate import Candidate

COUNTS = (1, 2, 3, 5, 8, 12, 20, 40)  # modes of each body that bends or rings
FINEST = 80  # modes, of what is no link, by which the error of fewer is measured

Missed = Callable[[Solution, Solution], float]  # error of the first beside the true one; infinity: no answer


def is_solved(scene: Scene) -> bool:
    """Whether its plan is found so: no sweep covers so many shapes of it, and each solve takes milliseconds."""
    links = isinstance(scene.target, Mechanism) and scene.target.flexible
    return links or isinstance(scene.impactor, FlexiblePendulum) or isinstance(scene.target, RotatingRod)


@dataclass(frozen=True)
class Reference:
    """What the models of a scene are measured by: exact waves where they can solve it, else many modes."""

    scene: Scene  # with as many modes
    method: Method
    modes: int | None  # None: waves


@dataclass(frozen=True)
class _Model:
    name: str
    changes: dict[str, Any]
    modes: int | None = None


def solved_candidates(scene: Scene, missed: Missed, finest: int = FINEST) -> tuple[list[Candidate], Reference]:
    """Models from the smallest up, each with the error that `missed` finds in it, and what they are measured by.

    finest: modes of that where neither waves nor links say. The scene has a reference, see `reference_of`.
    """
    reference = reference_of(scene, finest)
    assert reference is not None
    true = reference.method.solve(reference.scene)
    found = [
        Candidate(model.name, model.changes, missed(method.solve(changed), true), modes=model.modes)
        for model, changed, method in _models(scene, reference, finest)
    ]
    return [_not_by_chance(each, found[k:]) for k, each in enumerate(found)], reference


def _not_by_chance(candidate: Candidate, finer: list[Candidate]) -> Candidate:
    """Few modes may be right by chance: no error is less than that of more of them."""
    if candidate.modes is None:
        return candidate
    return replace(candidate, expected_error=max(each.expected_error for each in finer if each.modes))


def reference_of(scene: Scene, finest: int = FINEST) -> Reference | None:
    """None where nothing bends or rings, and where neither waves nor modes can solve it with all that acts in it."""
    if isinstance(scene.target, Mechanism):
        fine = scene.refined
        return _by_modes(fine, fine.target.known_as(Mechanism).most_modes)
    if isinstance(scene.impactor, FlexiblePendulum):
        return _by_modes(scene.replace({"impactor.modes": finest}), finest)
    if all(body.time_unit is None for body in (scene.impactor, scene.target)):
        return None
    waves = None if is_solved(scene) else exact_waves(scene)
    return _by_modes(scene, finest) if waves is None else Reference(scene, waves, None)


def _by_modes(scene: Scene, modes: int) -> Reference | None:
    method = Modal(modes=modes, estimate=False)
    return Reference(scene, method, modes) if _can(method, scene) else None


def _can(method: Method, scene: Scene) -> bool:
    return method.refusal(scene) is None and not method.neglects_weight(scene)


def _models(scene: Scene, reference: Reference, finest: int) -> Iterator[tuple[_Model, Scene, Method]]:
    """Those that can solve the scene, from the smallest up: what each changes, and what is to be solved by what."""
    for model in _all_models(scene, reference, finest):
        table = model.changes["method"]
        method = METHODS[table["name"]].read({key: value for key, value in table.items() if key != "name"})
        rest = {key: value for key, value in model.changes.items() if key != "method"}
        changed = scene.replace(rest) if rest else scene
        if _can(method, changed):
            yield model, changed, method.without_estimate()


def _all_models(scene: Scene, reference: Reference, finest: int) -> Iterator[_Model]:
    impulse: dict = {"name": "rigid"}
    if isinstance(scene.contact, Damped):
        impulse["restitution"] = scene.contact.delivered(scene.reduced_mass, scene.speed)
    yield _Model("rigid-impulse", {"method": impulse})
    if not scene.rigid_contact:
        yield _Model("local-quasi-static", {"method": {"name": "quasi-static", "model": "local"}})
    if isinstance(scene.impactor, FlexiblePendulum) and scene.target.rods:
        rigid = {key: value for key, value in scene.impactor.table().items() if key not in ("modes", *BENDING_KEYS)}
        yield _Model("rigid-pendulum", {"impactor": rigid, "method": {"name": Waves.NAME}})
    if not is_solved(scene):
        yield _Model("structural-quasi-static", {"method": {"name": "quasi-static", "model": "structural"}})
    for count in mode_counts(scene, reference, finest):
        own = _own_modes(scene, count) if count > _known(scene) else {}
        yield _Model("modal", own | {"method": {"name": "modal", "modes": count}}, count)
    if reference.modes is None:
        yield _Model(Waves.NAME, {"method": {"name": Waves.NAME}})


def mode_counts(scene: Scene, reference: Reference, finest: int = FINEST) -> list[int]:
    """Numbers of modes that are tried, ascending: up to half of those of the reference, and as many as links have."""
    most = finest if reference.modes is None else reference.modes
    return sorted(({_known(scene), most // 2} | {count for count in COUNTS if count < most // 2}) - {0})


def _known(scene: Scene) -> int:
    return scene.target.most_modes if isinstance(scene.target, Mechanism) else 0


def _own_modes(scene: Scene, count: int) -> dict[str, Any]:
    """What gives bodies that say themselves how many modes they have so many; for fewer the method's number does."""
    if isinstance(scene.impactor, FlexiblePendulum):
        return {"impactor.modes": count}
    if not isinstance(scene.target, Mechanism):
        return {}
    return {f"target.links.{n}.modes": count for n, link in enumerate(scene.target.links, 1) if link.modes}
