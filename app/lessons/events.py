"""Events of an impact by their names, as lesson files have them, and when they are."""

import re
from itertools import pairwise

from solvers import Rod, Scene, Solution

from ..choices.space import in_space

FIRST, LAST = -10.0, 1000.0  # [T]
EVENT = re.compile(r"(?:touch|part|wall|back)(?:-[2-9])?|second|stick|reversal")
MOST = 9  # of one kind
IMPACT = 2.0  # of bodies in space, whose impact has no duration: their clock runs so far through its impulse


def is_event(name: object) -> bool:
    """Whether it can be the name of one: a contact begins (`touch`) or ends (`part`), the front is at the far end of a
    rod (`wall`) or at the struck one again (`back`), with -2 to -9 for the later ones; `second` is `back-2`. Of bodies
    in space the contact slides no more (`stick`), or slides back (`reversal`)."""
    return isinstance(name, str) and EVENT.fullmatch(name) is not None


def names_in(scene: Scene) -> tuple[str, ...]:
    """Those that can happen in a scene, as a refusal lists them: the first ones of each kind."""
    if in_space(scene):
        return "touch", "part", "stick", "reversal"
    return "touch", "part", "touch-2", "part-2", *(("wall", "back", "second") if _has_front(scene) else ())


def times_of(solution: Solution) -> dict[str, float]:
    """Times of all that happens [T], by name; of bodies in space by the clock of their impulse."""
    if in_space(solution.scene):
        return _over_impulse(solution)
    unit, found = solution.scene.time_unit, {}
    for number, contact in enumerate(solution.contacts[:MOST], 1):
        found |= {_name("touch", number): contact.start / unit, _name("part", number): contact.end / unit}
    if _has_front(solution.scene):
        for number in range(1, MOST + 1):
            found |= {_name("wall", number): number - 0.5, _name("back", number): float(number)}
        found["second"] = found["back-2"]
    return found


def _has_front(scene: Scene) -> bool:
    """That comes back from the far end."""
    return isinstance(scene.target, Rod) and scene.target.support != "anechoic"


def _over_impulse(solution: Solution) -> dict[str, float]:
    """Nothing of bodies that do not meet."""
    if not solution.contacts or solution.contacts[0].impulse == 0.0:
        return {}
    found, stages = {"touch": 0.0, "part": IMPACT}, solution.sliding or []
    for before, stage in pairwise(stages):
        if stage.kind != "slip":
            found.setdefault(stage.kind, IMPACT * before.until / stages[-1].until)
    return found


def _name(kind: str, number: int) -> str:
    return kind if number == 1 else f"{kind}-{number}"
