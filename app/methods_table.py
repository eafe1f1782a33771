"""One blow by every method, for the table below the page: what each misses, and what it costs."""

import json
from typing import Any

from solvers import Row, Scene, compare

from .frames import exact_solution, method_options
from .state import chosen_scene


def methods_table(chosen: dict[str, Any]) -> str:
    """The comparison for these choices as JSON: `chosen` and `rows`, or `error`, a sentence why there is none."""
    answer: dict[str, Any] = {"chosen": chosen}
    try:
        answer["rows"] = [_shown(row) for row in compare(_with_method(chosen), repeats=1)]
    except ValueError as refusal:  # SceneError: no exact solution to measure by
        answer["error"] = str(refusal)
    return json.dumps(answer, allow_nan=False)


def _with_method(chosen: dict[str, Any]) -> Scene:
    """The chosen scene, naming the method beside the exact one with its options as they are set on the page."""
    name = chosen["method"] if chosen["method"] != "waves" else "modal"
    scene = chosen_scene(chosen)
    options = method_options(name, scene, chosen, exact_solution(scene, chosen["restitution"]))
    return scene.replace({"method": {"name": name, **options}})


def _shown(row: Row) -> dict[str, Any]:
    return {key: value for key, value in row.table().items() if key != "method"} | {
        "name": row.method["name"],
        "label": row.label,
    }
