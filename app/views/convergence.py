"""An impact at several resolutions, for the page: by modes, elements, steps or restitution of balances."""

from collections.abc import Sequence
from typing import Any

import param

from solvers import METHODS, Balance, Modal
from solvers.methods.base import Method
from solvers.studies.convergence import convergence
from solvers.studies.levels import GIVEN, RESTITUTIONS, STEPS, VALUES, kinds_of
from solvers.text.catalogue import Catalogue

from ..choices.opened import opening_of
from ..choices.questions import Question
from ..choices.request import Request
from ..messages.solutions import method_options
from ..messages.transverse import method_at_impact
from .answering import answering
from .figures import blank, hover, legend, source

COUNTS = (3, 5, 10, 20, 40)  # of modes, or of elements where finite elements are chosen
COUNTED = ("modal", "mode-switch", "fe-nodal", "fe-modal", Balance.NAME)
OWN = "own"  # what the scene is about, or the number of modes or elements
QUESTIONS = {
    "convergence_by": Question(
        param.Selector(default=OWN, objects=[OWN, "modes", "elements", *VALUES], doc="what is varied"), "by"
    )
}


@answering
def convergence_data(request: Request) -> dict[str, Any]:
    """The table of the study, and the `kinds` that can be varied."""
    method = _method_of(request)
    kinds = kinds_of(request.scene, method)
    kind, values = _varied(request.chosen, kinds, method)
    given: dict[str, Any] = {GIVEN.get(kind, "modes"): values}
    return convergence(request.scene, method=method, **given).table() | {"kinds": kinds}


def _method_of(request: Request) -> Method:
    """The chosen one if it has levels; else modes, as many as are compared."""
    if not request.exact:
        method = method_at_impact(request)
        return method if method.NAME in COUNTED else Modal()
    name = request.method_beside
    return METHODS[name].read(method_options(name, request)) if name in COUNTED else Modal()


def _varied(asked: dict[str, Any], kinds: list[str], method: Method) -> tuple[str, Sequence[float]]:
    """What is varied, and its values: those of the scene where it is about them."""
    opening = opening_of(asked["scene"])
    wanted = [asked["convergence_by"], opening.varied]
    kind = next((each for each in wanted if each in kinds), kinds[0])
    if kind == opening.varied:
        return kind, opening.by
    if kind == "step":
        return kind, [part * getattr(method, kind) for part in STEPS]
    return kind, RESTITUTIONS if kind == "restitution" else COUNTS


def convergence_figure(texts: Catalogue) -> list[Any]:
    """How far each quantity is from its value with the most modes, in sources "lines" and "differences"."""
    axes = {"x_axis_type": "log", "y_axis_type": "log"}
    from bokeh.models import FixedTicker

    words = texts.family("convergence")
    plot = blank(
        "convergence", "", texts.text("convergence.axis", kind="modes"), words["difference"], height=340, **axes
    )
    plot.xaxis.ticker = FixedTicker(name="convergence-counts")
    lines = source("lines", "counts", "sizes", "colour")
    plot.multi_line("counts", "sizes", source=lines, line_color={"field": "colour"}, line_width=1.5)
    points = source("differences", "count", "size", "colour", "marker", "diameter", "quantity", "value")
    look = {
        "fill_color": {"field": "colour"},
        "line_color": "white",
        "marker": {"field": "marker"},
        "size": {"field": "diameter"},
    }
    dots = plot.scatter("count", "size", source=points, **look)
    hover(
        plot,
        [dots],
        {
            "": "@quantity",
            words["number"]: "@count",
            words["value"]: "@value",
            words["apart"]: "@size{0.0[000]} %",
        },
    )
    legend(plot, [({"field": "quantity"}, [dots])])
    return [plot]
