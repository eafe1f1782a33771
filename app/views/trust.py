"""How far to trust an impact on a beam: the same many times with tiny changes, and with more and more modes."""

import json
from typing import Any

import numpy as np

from solvers import Balance, Mechanism, Modal, ensemble
from solvers.studies.convergence import convergence

from ..choices.request import Request
from ..messages.beam import MS, method_at_impact
from ..text.catalogues import page
from .figures import COLOURS, blank, cursor, hover, legend, source

RUNS = 200
COUNTS = (3, 5, 10, 20, 40)  # of modes, or of elements where finite elements are chosen
COUNTED = ("modal", "mode-switch", "fe-nodal", "fe-modal")
MOST_POINTS = 400  # of a band
BANDS = {"force": "N", "displacement": "m", "velocity": "m/s"}  # names in the answer, and units


def trust_data(chosen: dict[str, Any]) -> str:
    """The ensemble for these choices as JSON: `chosen`, bands over time [ms], table and words; or `error`."""
    answer: dict[str, Any] = {"chosen": chosen}
    try:
        answer |= _ensemble(Request.of(chosen))
    except ValueError as refusal:  # SceneError
        answer["error"] = str(refusal)
    return json.dumps(answer, allow_nan=False)


def _ensemble(request: Request) -> dict[str, Any]:
    found = ensemble(request.scene, method=method_at_impact(request), runs=RUNS)
    rows = np.unique(np.linspace(0, found.time.size - 1, MOST_POINTS).round().astype(int))

    def band(given: Any) -> dict[str, list[float]]:
        return {name: _listed(getattr(given, name)[rows]) for name in ("lowest", "low", "high", "highest")}

    table = found.table()
    return {
        "time": _listed(MS * found.time[rows]),
        "force": band(found.force),
        "displacement": band(found.struck_position),
        "velocity": band(found.impactor_velocity),
        "runs": RUNS,
        "key": found.key,
        "largest": float(np.abs(found.perturbations).max()),
        "spread": table["spread"],
        "ill": found.ill_conditioned,
        "summary": found.summary.table(),
        "notes": [note.table() for note in found.notes],
        "took": found.wall_time,
    }


def convergence_data(chosen: dict[str, Any]) -> str:
    """The impact with more and more modes as JSON: `chosen` and the table of the study, or `error`, a sentence."""
    answer: dict[str, Any] = {"chosen": chosen}
    try:
        request = Request.of(chosen)
        scene, method = request.scene, method_at_impact(request)
        counted = (*COUNTED, Balance.NAME) if isinstance(scene.target, Mechanism) else COUNTED
        answer |= convergence(scene, COUNTS, method if method.NAME in counted else Modal()).table()
    except ValueError as refusal:  # SceneError
        answer["error"] = str(refusal)
    return json.dumps(answer, allow_nan=False)


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.5g}") for value in values.tolist()]


def trust_figure() -> list[Any]:
    """Bands over time of what 200 impacts do, in source "bands": of each quantity all of them, and 90 % of them."""
    edges = "lowest", "low", "high", "highest"
    bands = source("bands", "time", *(f"{name}-{edge}" for name in BANDS for edge in edges))
    plots: list[Any] = []
    words, names = page().family("trust"), page().family("trust.edge")
    time = page().text("panel.time-in", unit="ms")
    for (name, unit), colour in zip(BANDS.items(), COLOURS, strict=False):
        label = page().text(f"trust.axis.{name}", unit=unit)
        plot = blank(f"trust-{name}", words[f"band.{name}"], time, label, plots[0] if plots else None, 230)
        columns = {edge: f"{name}-{edge}" for edge in edges}
        every = plot.varea(
            "time", columns["lowest"], columns["highest"], source=bands, fill_color=colour, fill_alpha=0.2
        )
        most = plot.varea("time", columns["low"], columns["high"], source=bands, fill_color=colour, fill_alpha=0.45)
        lines = [
            plot.line("time", columns[edge], source=bands, line_color=colour, line_width=0.8, line_dash=dash)
            for edge, dash in zip(edges, ("dotted", "solid", "solid", "dotted"), strict=True)
        ]
        read = {names[edge]: f"@{{{column}}}{{0.000a}}" for edge, column in columns.items()}
        tips = {page().text("chart.time"): "@time{0.0000} ms"} | read
        hover(plot, lines[:1], tips, mode="vline")
        legend(plot, [(words["most"], [most]), (words["every"], [every])])
        cursor(plot, f"trust-cursor-{name}")
        plots.append(plot)
    return plots


def convergence_figure() -> list[Any]:
    """How far each quantity is from its value with the most modes, in sources "lines" and "differences"."""
    axes = {"x_axis_type": "log", "y_axis_type": "log"}
    from bokeh.models import FixedTicker

    words = page().family("convergence")
    plot = blank(
        "convergence", "", page().text("convergence.axis", kind="modes"), words["difference"], height=340, **axes
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
