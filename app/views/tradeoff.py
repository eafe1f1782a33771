"""Speed against accuracy on the page: the stored table of a scene, or one measured while the visitor looks on."""

import json
import time
from collections.abc import Callable
from typing import Any

import param

from solvers import METHODS, Scene, TradeOff, Waves, stored_tradeoff, tradeoff
from solvers.accuracy.calibration import calibrate, known
from solvers.accuracy.refinement import ladders
from solvers.provenance import machine
from solvers.text.catalogue import Catalogue

from ..choices.choices import SCENES
from ..choices.questions import Question
from ..choices.request import Request
from ..choices.scene_of import choices_of
from .answering import answering
from .figures import INK, PICKED, blank, hover, legend, source

PROGRESS_SECONDS = 0.25  # s between two tables on the way
MEASUREMENT_SECONDS = 12.0  # of one measurement
SCALED = "tradeoff_scaled"
QUESTIONS = {
    SCALED: Question(param.Boolean(default=False, doc="whether this machine is to be calibrated, if it is not"))
}
SHOWN = (  # of every point
    "wall_time", "spread", "errors", "label", "method", "ladder", "contacts", "true_contacts", "true_contacts_found",
    "invented_contacts", "estimated_error", "note_codes", "best_for",
)  # fmt: skip


@answering
def stored_data(request: Request) -> dict[str, Any]:
    """The table that is known of this scene, as `_shown` says it; no points if there is none.

    Its times are scaled to this machine if that has been calibrated, which takes a second and may be asked for.
    """
    if request.chosen.get(SCALED) and known() is None:
        calibrate()
    found = stored_tradeoff(_scene(request.chosen))
    return {"points": []} if found is None else _shown(found)


def tradeoff_data(asked: dict[str, Any], cancelled: Callable[[], bool], report: Callable[[str], None]) -> str:
    """The table measured anew; `report` gets it as far as it is known, now and then. Raises SceneError."""
    last = [time.monotonic()]

    def progress(found: TradeOff) -> None:
        if time.monotonic() - last[0] > PROGRESS_SECONDS:
            report(_text(asked, found))
            last[0] = time.monotonic()

    return _text(
        asked, tradeoff(_scene(asked), cancel=cancelled, progress=progress, fresh=True, seconds=MEASUREMENT_SECONDS)
    )


def tradeoff_kernels(asked: dict[str, Any]) -> None:
    """Solve the coarsest of all that the table tries."""
    scene = Request.of(asked).scene
    for ladder in ladders(scene):
        ladder.levels[0].solve(scene)


def _scene(asked: dict[str, Any]) -> Scene:
    """The chosen scene; where nothing in it is changed, exactly the built-in one, whose table may come with us."""
    own = choices_of(asked["scene"])
    same = all(asked[name] == value for name, value in own.items() if name not in ("method", "modes", "elements"))
    return SCENES[asked["scene"]] if same else Request.of(asked).scene


def _text(asked: dict[str, Any], found: TradeOff) -> str:
    return json.dumps({"chosen": asked} | _shown(found), allow_nan=False)


def _shown(found: TradeOff) -> dict[str, Any]:
    table = found.table()
    reference = table["reference"] or {"note": None, "uncertainty": {}}
    return {
        "points": [
            {key: row[key] for key in SHOWN}
            | {"exact": row["method"]["name"] == Waves.NAME, "rank": list(METHODS).index(row["method"]["name"])}
            for row in table["points"]
        ],
        "reference": {"note": reference["note"], "uncertainty": reference["uncertainty"]},
        "remarks": table["remark_codes"],
        "machine": table["machine"],
        "shipped": found.shipped,
        "scaled": found.scale is not None,
        "scalable": found.shipped and found.calibration is not None,
        "elsewhere": table["machine"] != machine(),
        "changed": bool(found.changed),
        "date": table["date"],
        "seconds": table["seconds"],
        "stopped": table["stopped"],
        "budget": MEASUREMENT_SECONDS,
    }


def tradeoff_figure(texts: Catalogue) -> list[Any]:
    """Time against error of every point; steps join what nothing beats, with and without the exact waves.

    Colour and marker of a point are those of its method. What a method says of its own error is an open triangle, below
    or above the point that was measured.
    """
    from bokeh.models import BoxAnnotation

    words, columns = texts.family("tradeoff.plot"), texts.family("tradeoff.column")
    plot = blank("tradeoff", "", words["time"], words["error"], height=380, x_axis_type="log", y_axis_type="log")
    unknown = {"fill_color": "#647382", "fill_alpha": 0.13, "line_alpha": 0.0, "level": "underlay"}
    plot.add_layout(BoxAnnotation(name="tradeoff-unknown", **unknown))
    ladders = source("ladders", "times", "sizes", "colour")
    plot.multi_line("times", "sizes", source=ladders, line_color={"field": "colour"}, line_alpha=0.28, line_width=1.5)
    steps = {}
    for name, dash in (("front", "solid"), ("rest", "dashed")):
        line = source(name, "time", "size")
        steps[name] = plot.step("time", "size", source=line, mode="after", line_color=INK, line_width=2, line_dash=dash)
    own = source("claims", "time", "size", "claim", "colour", "label", "claimed")
    link = {"line_color": {"field": "colour"}, "line_dash": "dotted"}
    plot.segment("time", "size", "time", "claim", source=own, line_alpha=0.6, **link)
    hollow = {"marker": "inverted_triangle", "size": 8, "fill_color": "white", "line_color": {"field": "colour"}}
    claims = plot.scatter("time", "claim", source=own, **hollow)
    dots = _dots(plot)
    tips = {columns[name]: f"@{name}" for name in ("solve", "error", "contacts")}
    hover(plot, [dots], {"": "@label"} | tips)
    hover(plot, [claims], {"": "@label", words["claimed"]: "@claimed"}, name="tradeoff-claims")
    joined = [(words[name], [line]) for name, line in steps.items()]
    legend(plot, [({"field": "method"}, [dots]), *joined, (words["own"], [claims])])
    return [plot]


def _dots(plot: Any) -> Any:
    """The points; what is read and what is chosen has a red edge."""
    said = "label", "method", "solve", "error", "contacts"
    points = source("points", "time", "size", "colour", "marker", "diameter", "edge", "width", *said)
    columns = {
        "marker": "marker",
        "size": "diameter",
        "fill_color": "colour",
        "line_color": "edge",
        "line_width": "width",
    }
    fields = {name: {"field": column} for name, column in columns.items()}
    marks = {"selection_line_color": PICKED, "selection_line_width": 3, "hover_line_color": PICKED}
    dots = plot.scatter("time", "size", source=points, **fields, **marks)
    dots.nonselection_glyph = None  # the others stay as they are
    return dots
