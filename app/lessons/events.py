"""Events of an impact by their names, as lesson files have them, and when they are."""

import re

from solvers import Rod, Solution

FIRST, LAST = -10.0, 1000.0  # [T]
EVENT = re.compile(r"(?:touch|part|wall|back)(?:-[2-9])?|second")
NAMES = ("touch", "part", "touch-2", "part-2", "wall", "back", "second")  # as a refusal lists them
MOST = 9  # of one kind


def is_event(name: object) -> bool:
    """Whether it can be the name of one: a contact begins (`touch`) or ends (`part`), the front is at the far end of a
    rod (`wall`) or at the struck one again (`back`), with -2 to -9 for the later ones; `second` is `back-2`."""
    return isinstance(name, str) and EVENT.fullmatch(name) is not None


def times_of(solution: Solution) -> dict[str, float]:
    """Times of all that happens [T], by name."""
    unit, found = solution.scene.time_unit, {}
    for number, contact in enumerate(solution.contacts[:MOST], 1):
        found |= {_name("touch", number): contact.start / unit, _name("part", number): contact.end / unit}
    target = solution.scene.target
    if isinstance(target, Rod) and target.support != "anechoic":
        for number in range(1, MOST + 1):
            found |= {_name("wall", number): number - 0.5, _name("back", number): float(number)}
        found["second"] = found["back-2"]
    return found


def _name(kind: str, number: int) -> str:
    return kind if number == 1 else f"{kind}-{number}"
