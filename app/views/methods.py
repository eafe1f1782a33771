"""One impact by every method, for the table below the page: what each misses, and what it costs."""

from typing import Any

from solvers import Row, Scene, Solution, compare
from solvers.accuracy.reference import exact_solution

from ..choices.request import Request
from ..messages.solutions import method_options
from .answering import answering


@answering
def methods_table(request: Request) -> dict[str, Any]:
    """The comparison for these choices: `rows`. Raises SceneError where there is no exact solution to measure by."""
    exact = exact_solution(request.scene, request.restitution)  # as long as this the page shows each method beside it
    rows = compare(_with_method(request, exact), repeats=1, duration=exact.duration)
    return {"rows": [_shown(row) for row in rows]}


def _with_method(request: Request, exact: Solution) -> Scene:
    """The chosen scene, naming the method beside the exact one with its options as they are set on the page."""
    name = request.method_beside
    options = method_options(name, request, exact)
    return request.scene.replace({"method": {"name": name, **options}})


def _shown(row: Row) -> dict[str, Any]:
    return {key: value for key, value in row.table().items() if key != "method"} | {
        "reason": row.reason and row.reason.table(),
        "name": row.method["name"],
        "label": row.label,
        "model": row.method.get("model"),
    }
