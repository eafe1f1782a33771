"""Speed against accuracy on the page: the stored table of a scene, or one measured while the visitor looks on."""

import json
import time
from collections.abc import Callable
from typing import Any

from solvers import Scene, TradeOff, stored_tradeoff, tradeoff
from solvers.ladders import ladders
from solvers.machine import machine

from .state import SCENES, Choices, chosen_scene

OFTEN = 0.25  # s between two tables on the way
SECONDS = 12.0  # of one measurement
SHOWN = (  # of every point
    "wall_time", "spread", "errors", "label", "method", "ladder", "contacts", "true_contacts", "true_contacts_found",
    "invented_contacts", "estimated_error", "notes", "best_for",
)  # fmt: skip


def stored_data(asked: dict[str, Any]) -> str:
    """The table that is known of this scene as JSON, `chosen` and what `_shown` says; no points if there is none."""
    answer: dict[str, Any] = {"chosen": asked}
    try:
        found = stored_tradeoff(_scene(asked))
        answer |= {"points": []} if found is None else _shown(found)
    except ValueError as refusal:  # SceneError
        answer["error"] = str(refusal)
    return json.dumps(answer, allow_nan=False)


def tradeoff_data(asked: dict[str, Any], cancelled: Callable[[], bool], tell: Callable[[str], None]) -> str:
    """The table measured anew; `tell` gets it as far as it is known, now and then. Raises SceneError."""
    last = [time.monotonic()]

    def progress(found: TradeOff) -> None:
        if time.monotonic() - last[0] > OFTEN:
            tell(_text(asked, found))
            last[0] = time.monotonic()

    return _text(asked, tradeoff(_scene(asked), cancel=cancelled, progress=progress, fresh=True, seconds=SECONDS))


def tradeoff_kernels(asked: dict[str, Any]) -> None:
    """Solve the coarsest of all that the table tries."""
    scene = chosen_scene(asked)
    for ladder in ladders(scene):
        ladder.rungs[0].solve(scene)


def _scene(asked: dict[str, Any]) -> Scene:
    """The chosen scene; where nothing in it is changed, exactly the built-in one, whose table may come with us."""
    own = Choices.of_scene(asked["scene"])
    same = all(asked[name] == value for name, value in own.items() if name not in ("method", "modes", "elements"))
    return SCENES[asked["scene"]] if same else chosen_scene(asked)


def _text(asked: dict[str, Any], found: TradeOff) -> str:
    return json.dumps({"chosen": asked} | _shown(found), allow_nan=False)


def _shown(found: TradeOff) -> dict[str, Any]:
    table = found.table()
    reference = table["reference"] or {"words": "not known yet", "uncertainty": {}}
    return {
        "points": [{key: row[key] for key in SHOWN} for row in table["points"]],
        "reference": {"words": reference["words"], "uncertainty": reference["uncertainty"]},
        "remarks": table["remarks"],
        "machine": table["machine"],
        "here": table["machine"] == machine(),
        "date": table["date"],
        "seconds": table["seconds"],
        "stopped": table["stopped"],
        "budget": SECONDS,
    }
