"""Which model is enough at a point of the map: the smallest within each of some bounds of a figure's error."""

import math
from collections.abc import Callable, Sequence
from typing import Any

from solvers import Modal, QuasiStatic, RigidImpulse, Scene, Solution
from solvers.regimes.candidate import Candidate
from solvers.regimes.solved import COUNTS, mode_counts, reference_of, solved_candidates

from ..text.refusals import Refused

FINEST = 40  # modes where there are no waves: a quarter of the time of those of `solvers.plan`
WHOLE = "rigid-impulse", "local-quasi-static", "rigid-pendulum", "structural-quasi-static"
FEW = [count for count in COUNTS if count < FINEST]
MODELS = len(WHOLE) + len(FEW) + 1
SPEEDS, SHARES = ("impactor_velocity", "target_velocity"), ("newton", "vibration", "dissipated", "contacts")

Found = Callable[[Solution, tuple[str, ...]], dict[str, float | None]]


def models_of(scene: Scene) -> list[dict[str, Any]]:
    """From the smallest up: rigid bodies and springs, so many modes, and last what they are measured by, or more modes
    than were tried; of a scene that has a reference."""
    reference = reference_of(scene, FINEST)
    assert reference is not None
    tried = mode_counts(scene, reference, FINEST)[-1]
    last = {"name": "more-than", "modes": tried} if reference.modes else {"name": "waves"}
    return [*({"name": name} for name in WHOLE), *({"name": "modal", "modes": count} for count in FEW), last]


def shown_as(method: dict[str, Any], scene: Scene) -> int:
    """Where the method of a solution stands among these, from 1; the last, where it is none of them."""
    name, modes, reference = method["name"], method.get("modes"), reference_of(scene, FINEST)
    if name == Modal.NAME and modes and modes < ((reference and reference.modes) or FINEST):
        return len(WHOLE) + sum(count <= modes for count in FEW)
    called = {RigidImpulse.NAME: WHOLE[0], QuasiStatic.NAME: f"{method.get('model')}-{QuasiStatic.NAME}"}.get(name)
    return WHOLE.index(called) + 1 if called in WHOLE else MODELS


def enough(scene: Scene, figure: str, bounds: Sequence[float], found_of: Found) -> list[int]:
    """By bound, which of `models_of` is the smallest whose figure is within it, counted from 1.

    The error of a velocity is a share of the impact speed, of a share or a number of contacts the difference, else
    relative. Raises ValueError, for the visitor, where nothing bends or rings, or no method has all that acts.
    """
    if reference_of(scene, FINEST) is None:
        raise Refused("refused.no-models")

    def missed(found: Solution, true: Solution) -> float:
        mine, exact = (found_of(each, (figure,)).get(figure) for each in (found, true))
        if mine is None or exact is None:
            return 0.0 if mine is exact else math.inf
        size = true.scene.speed if figure in SPEEDS else 1.0 if figure in SHARES else abs(exact)
        return abs(mine - exact) / size if size else math.inf

    candidates, _ = solved_candidates(scene, missed, FINEST)
    return [_smallest(candidates, bound) for bound in bounds]


def _smallest(candidates: Sequence[Candidate], bound: float) -> int:
    """What leaves out vibration is enough only where each number of modes is, too: else it is right by chance."""
    by_chance = any(each.modes and each.expected_error > bound for each in candidates)
    good = [each for each in candidates if each.expected_error <= bound]
    places = [_place(each) for each in good if not (by_chance and each.name in WHOLE)]
    return min(places, default=MODELS)


def _place(candidate: Candidate) -> int:
    """Where it stands among these, from 1; with a number of modes that none of these has, as the next larger one."""
    if candidate.modes:
        return len(WHOLE) + 1 + sum(count < candidate.modes for count in FEW)
    return WHOLE.index(candidate.name) + 1 if candidate.name in WHOLE else MODELS
