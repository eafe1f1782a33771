"""When a rigid link or pendulum is enough: the scene solved so, and with so many modes of what bends."""

from dataclasses import dataclass, replace
from typing import Any

from ..bodies import FlexiblePendulum, Mechanism, RotatingRod
from ..bodies.pendulum import BENDING_KEYS
from ..contact.protocol import Damped
from ..methods import METHODS, Modal, Waves
from ..scene import Scene
from .candidate import Candidate
from .models import errors, figures

COUNTS = (1, 2, 3, 5, 8, 12, 20, 40)  # modes of each body that bends or rings
FINEST = 80  # modes, of what is no link, by which the error of fewer is measured
STRESSES = 3  # number of that question


def is_solved(scene: Scene) -> bool:
    """Whether its plan is found so: no sweep covers so many shapes of it, and each solve takes milliseconds."""
    links = isinstance(scene.target, Mechanism) and scene.target.flexible
    return links or isinstance(scene.impactor, FlexiblePendulum) or isinstance(scene.target, RotatingRod)


@dataclass(frozen=True)
class _Model:
    name: str
    changes: dict[str, Any]
    modes: int | None = None


def solved_candidates(scene: Scene, question: int) -> tuple[list[Candidate], int]:
    """Models from the smallest up, with the error of each in the answer to a question, and the modes of the reference:
    of links `scene.refined`, else FINEST."""
    fine, finest = _reference(scene)
    true = figures(Modal(modes=finest, estimate=False).solve(fine), question == STRESSES)
    found: list[Candidate] = []
    for model in _models(scene, finest):
        table = model.changes["method"]
        method = METHODS[table["name"]].read({key: value for key, value in table.items() if key != "name"})
        rest = {key: value for key, value in model.changes.items() if key != "method"}
        changed = scene.replace(rest) if rest else scene
        if method.refusal(changed) is None:
            missed = errors(figures(method.without_estimate().solve(changed), question == STRESSES), true)
            found.append(Candidate(model.name, model.changes, float(missed[question]), modes=model.modes))
    return [_not_by_chance(each, found[k:]) for k, each in enumerate(found)], finest


def _not_by_chance(candidate: Candidate, finer: list[Candidate]) -> Candidate:
    """Few modes may be right by chance: no error is less than that of more of them."""
    if candidate.modes is None:
        return candidate
    return replace(candidate, expected_error=max(each.expected_error for each in finer))


def _reference(scene: Scene) -> tuple[Scene, int]:
    if isinstance(scene.target, Mechanism):
        fine = scene.refined
        return fine, fine.target.known_as(Mechanism).most_modes
    if isinstance(scene.impactor, FlexiblePendulum):
        return scene.replace({"impactor.modes": FINEST}), FINEST
    return scene, FINEST


def _models(scene: Scene, finest: int) -> list[_Model]:
    impulse: dict = {"name": "rigid"}
    if isinstance(scene.contact, Damped):
        impulse["restitution"] = scene.contact.delivered(scene.reduced_mass, scene.speed)
    found = [_Model("rigid-impulse", {"method": impulse})]
    if not scene.rigid_contact:
        found.append(_Model("local-quasi-static", {"method": {"name": "quasi-static", "model": "local"}}))
    bends = isinstance(scene.impactor, FlexiblePendulum)
    if bends and scene.target.rods:
        rigid = {key: value for key, value in scene.impactor.table().items() if key not in ("modes", *BENDING_KEYS)}
        found.append(_Model("rigid-pendulum", {"impactor": rigid, "method": {"name": Waves.NAME}}))
    known = scene.target.most_modes if isinstance(scene.target, Mechanism) else 0
    for count in sorted({known, finest // 2} | {count for count in COUNTS if count < finest // 2}):
        if count:
            own = _own_modes(scene, count) if count > known else {}
            found.append(_Model("modal", own | {"method": {"name": "modal", "modes": count}}, count))
    return found


def _own_modes(scene: Scene, count: int) -> dict[str, Any]:
    """What gives bodies that say themselves how many modes they have so many; for fewer the method's number does."""
    if isinstance(scene.impactor, FlexiblePendulum):
        return {"impactor.modes": count}
    if not isinstance(scene.target, Mechanism):
        return {}
    return {f"target.links.{n}.modes": count for n, link in enumerate(scene.target.links, 1) if link.modes}
