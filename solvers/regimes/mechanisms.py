"""When a rigid link is enough: a mechanism solved with rigid links, and with so many modes of each."""

from dataclasses import replace

from ..bodies import Mechanism
from ..contact.protocol import Damped
from ..methods import METHODS, Modal
from ..scene import Scene
from .candidate import Candidate
from .models import errors, figures

COUNTS = (1, 2, 3, 5, 8, 12, 20, 40)  # modes of each link that bends
STRESSES = 3  # number of that question


def mechanism_candidates(scene: Scene, question: int) -> tuple[list[Candidate], int]:
    """Models from the smallest up, with the error of each in the answer to a question, and the modes of the reference.

    The reference is `scene.refined`.
    """
    fine = scene.refined
    finest = fine.target.known_as(Mechanism).most_modes
    true = figures(Modal(modes=finest, estimate=False).solve(fine), question == STRESSES)
    found: list[Candidate] = []
    for name, table, modes in _models(scene, scene.target.known_as(Mechanism).most_modes):
        method = METHODS[table["name"]].read({key: value for key, value in table.items() if key != "name"})
        missed = errors(figures(method.without_estimate().solve(scene), question == STRESSES), true)
        found.append(Candidate(name, {"method": table}, float(missed[question]), modes=modes))
    return [_not_by_chance(each, found[k:]) for k, each in enumerate(found)], finest


def _not_by_chance(candidate: Candidate, finer: list[Candidate]) -> Candidate:
    """Few modes may be right by chance: no error is less than that of more of them."""
    if candidate.modes is None:
        return candidate
    return replace(candidate, expected_error=max(each.expected_error for each in finer))


def _models(scene: Scene, most: int) -> list[tuple[str, dict, int | None]]:
    impulse: dict = {"name": "rigid"}
    if isinstance(scene.contact, Damped):
        impulse["restitution"] = scene.contact.delivered(scene.reduced_mass, scene.speed)
    found: list[tuple[str, dict, int | None]] = [("rigid-impulse", impulse, None)]
    if not scene.rigid_contact:
        found.append(("local-quasi-static", {"name": "quasi-static", "model": "local"}, None))
    counts = [count for count in COUNTS if count < most] + [most]
    return found + [("modal", {"name": "modal", "modes": count}, count) for count in counts]
