"""Figures of many impacts around the chosen one, for the page's map of what would be otherwise."""

import json
import logging
import math
import re
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import param

from solvers import Solution
from solvers.accuracy.reference import exact_solution
from solvers.jit.compiling import NotCompiled
from solvers.methods.base import never
from solvers.studies.figures import figures_of

from ..choices.bodies import is_key, split
from ..choices.body_value import with_body_value
from ..choices.choices import Choices, accepts, refusal
from ..choices.part import RANGES
from ..choices.request import Request
from ..messages.mechanism.frame import mechanism_solution
from ..messages.space import space_solution
from ..messages.transverse import main_solution
from ..text.refusals import SOME_TEXT, Refused, note, reason_of
from .whatif_models import enough, models_of, shown_as
from .whatif_scene import scene_file

POINTS = "whatif_points"  # key, beside the choices, of what is asked
MOST_NAMES, MOST_ROWS, MOST_BOUNDS = 8, 256, 6
LONGEST = 16_000  # letters of a question: with what a socket adds to it, within app.serving.limits.MAX_MESSAGE
SECONDS = 0.4  # of work after which an answer goes out with the rows found so far
EXAMPLE = '{"id": 0, "names": ["speed"], "rows": [[1.0]]}'
COLUMNS = (
    *("status", "contacts", "impactor_velocity", "target_velocity", "peak_force", "contact_time", "newton"),
    *("vibration", "dissipated", "peak_indentation", "peak_stress"),
)  # of an answer; vibration and dissipated as shares of the energy before, all else in SI units
FOUND, FAILED = 0, 1  # status of a row
Names = tuple[str, ...]
Values = dict[str, Any]  # by name
FREE: Names = ("contacts", "peak_force", "contact_time", "newton", "dissipated", "peak_indentation")  # of any solution
PARTS = {"vibration": "target_vibration", "dissipated": "dissipated"}  # of the energy
VELOCITIES: Names = ("impactor_velocity", "target_velocity")
STRESS = "peak_stress"  # costs as much again, or more: null unless it is asked for
_NUMBERED = re.compile(r'\{"id": ?(\d{1,9})[,}]')
_NAME = re.compile(r"[\w.]{1,60}", re.ASCII)  # which may be repeated to who has written it
log = logging.getLogger("strikewave")


class Points(NamedTuple):
    """What is asked."""

    names: list[str]  # of choices that are numbers, and keys of values of bodies
    rows: list[list[float]]  # values for these, SI units
    others: dict[str, Any]  # choices that are otherwise than the server has them by now
    figures: Names  # of those that any solution gives
    file: bool  # whether the scene file of the first is asked for, and the keys that the others vary; not their figures
    models: tuple[str, list[float]] | None  # the figure and bounds of its error for which the smallest models are asked


def id_of(text: str) -> int | None:
    """The number of a question, by which its answer is known; it stands first in it."""
    found = _NUMBERED.match(text)
    return int(found[1]) if found else None


def read_points(text: str) -> Points:
    """Raises ValueError, for the visitor, for what is no question, or too long a one."""
    try:
        given = json.loads(text, parse_int=float, parse_constant=float)
    except (ValueError, RecursionError):
        given = None
    asked: dict[str, Any] = given if isinstance(given, dict) else {}
    names, rows, others = (asked.get(key, usual) for key, usual in (("names", None), ("rows", None), ("set", {})))
    named = _listed(names, MOST_NAMES, lambda name: isinstance(name, str)) and len(set(names)) == len(names)
    if not (named and _listed(rows, MOST_ROWS, lambda row: _is_row(row, len(names))) and isinstance(others, dict)):
        raise Refused("refused.points", names=MOST_NAMES, rows=MOST_ROWS)
    for name in names:
        _check_name(name)
    figures = (*FREE, STRESS) if asked.get("stress") is True else FREE
    set_otherwise = {name: _choice(name, value) for name, value in others.items()}
    return Points(names, rows, set_otherwise, figures, asked.get("file") is True, _models(asked.get("models")))


def _models(asked: Any) -> tuple[str, list[float]] | None:
    if asked is None:
        return None
    given = asked if isinstance(asked, dict) else {}
    figure, bounds = given.get("figure"), given.get("bounds")
    some = _listed(bounds, MOST_BOUNDS, lambda bound: type(bound) is float and 0.0 < bound <= 1.0)
    if figure not in COLUMNS[1:] or not some or bounds is None:
        raise Refused("refused.points-models", figures=list(COLUMNS[1:]), bounds=MOST_BOUNDS)
    return figure, bounds


def _listed(values: Any, most: int, each: Callable[[Any], bool]) -> bool:
    return isinstance(values, list) and 0 < len(values) <= most and all(map(each, values))


def _is_row(row: Any, size: int) -> bool:
    return isinstance(row, list) and len(row) == size and all(type(v) is float and math.isfinite(v) for v in row)


def _check_name(name: str) -> None:
    choice = name in Choices.CHOSEN and isinstance(Choices.param[name], param.Number)
    if not choice and not (is_key(name) and split(name)[1] in RANGES):
        raise Refused("refused.points-name", name=name if _NAME.fullmatch(name) else SOME_TEXT)


def _choice(name: str, value: Any) -> Any:
    """A value that this choice may have."""
    if name not in Choices.CHOSEN or name == "scene":
        raise Refused("refused.points-name", name=name if _NAME.fullmatch(name) else SOME_TEXT)
    if isinstance(value, float) and isinstance(Choices.param[name], param.Integer) and value.is_integer():
        value = int(value)
    if not accepts(name, value):
        raise refusal(name, value if isinstance(value, int | float | str) else SOME_TEXT)
    return value


def whatif_data(asked: dict[str, Any], cancelled: Callable[[], bool] = never) -> str:
    """Figures at the points that are asked, as JSON: `chosen`, the choices, `id` of the question, `rows` in the order
    asked, a value for each of `COLUMNS`, as many as are found in time, and `why`, by the number of a row a note why
    there are none; or `error`, a note why nothing is found. Where the file is asked for, what `scene_file` says.
    """
    text, chosen = asked[POINTS], {name: asked[name] for name in Choices.CHOSEN}
    try:
        points = read_points(text)
    except ValueError as reason:
        return json.dumps({"chosen": chosen, "id": id_of(text), "error": reason_of(reason)}, allow_nan=False)
    chosen |= points.others
    if points.file:
        return json.dumps({"chosen": chosen, "id": id_of(text)} | _file(chosen, points), allow_nan=False)
    until, rows, why, moved, more = time.monotonic() + SECONDS, [], {}, {}, {}
    for number, values in enumerate(points.rows):
        if rows and (cancelled() or time.monotonic() > until):
            break
        try:
            given = dict(zip(points.names, values, strict=True))
            request = Request.of(_with(chosen, given, moved))
            rows.append(_answer(request, points))
            if points.models and not more:
                shown = shown_as(_solution(request, FREE).method, request.scene)
                more = {"models": models_of(request.scene), "shown": shown}
        except NotCompiled:
            raise
        except ValueError as reason:
            why[number] = reason_of(reason)
        except Exception:  # the others are to be found all the same
            failed = note("serving.not-solved").table()
            if failed not in why.values():  # one of them says enough
                log.exception("a point failed: %r %r of %r", points.names, values, chosen)
            why[number] = failed
        if number in why:
            rows.append([FAILED, *[None] * (len(COLUMNS) - 1)])
    return json.dumps({"chosen": chosen, "id": id_of(text), "rows": rows, "why": why} | more, allow_nan=False)


def _answer(request: Request, points: Points) -> list[float | None]:
    if points.models:
        found = enough(request.scene, *points.models, figures_found)
        return [FOUND, *found, *[None] * (len(COLUMNS) - 1 - len(found))]
    found = figures_found(_solution(request, points.figures), (*points.figures, *PARTS, *VELOCITIES))
    return [FOUND, *(found.get(name) for name in COLUMNS[1:])]


def _file(chosen: Values, points: Points) -> dict[str, Any]:
    moved: dict[tuple, Values] = {}
    found: list[Request | None] = []
    for values in points.rows:
        try:
            found.append(Request.of(_with(chosen, dict(zip(points.names, values, strict=True)), moved)))
        except ValueError as reason:
            if not found:
                return {"error": reason_of(reason)}
            found.append(None)
    return scene_file(found)


def _with(chosen: Values, given: Values, moved: dict[tuple, Values]) -> Values:
    """The choices at a point: values of bodies as they are typed, which move what follows, then what is chosen.

    `moved`: by these values, the choices of points that have the same, as a whole line of the map does.
    """
    typed = tuple((name, value) for name, value in given.items() if name not in Choices.CHOSEN)
    if typed not in moved:
        found = chosen
        for name, value in typed:
            found = found | with_body_value(found | {"body_value": f"{name}={value!r}"})
        moved[typed] = found
    return moved[typed] | {name: _choice(name, value) for name, value in given.items() if name in Choices.CHOSEN}


def _solution(request: Request, figures: Names) -> Solution:
    """That of which the page shows these figures."""
    if request.exact:
        return exact_solution(request.scene, request.restitution)
    if request.kind == "bodies":
        return space_solution(request)
    return (mechanism_solution if request.kind == "mechanism" else main_solution)(request, figures)[0]


def figures_found(solution: Solution, names: Names) -> dict[str, float | None]:
    """By column those that exist: velocities along the normal, shares of the energy before."""
    return {name: _number(_figure_found(solution, name)) for name in names}


def _figure_found(solution: Solution, name: str) -> float | None:
    if name in PARTS:
        initial = solution.energy["initial"]
        return solution.energy[PARTS[name]] / initial if initial else None
    if name in VELOCITIES:
        velocity, normal = getattr(solution, name), solution.scene.normal  # along which one in space is given
        return velocity if normal is None or velocity is None else float(np.dot(velocity, normal))
    return figures_of(solution, (name,))[0]


def _number(value: float | None) -> float | None:
    return float(value) if value is not None and math.isfinite(value) else None
