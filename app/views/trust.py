"""How far to trust an impact on a beam: the same many times with tiny changes."""

from typing import Any

import numpy as np

from solvers import ensemble
from solvers.text.catalogue import Catalogue

from ..choices.request import Request
from ..messages.transverse import method_at_impact
from .answering import answering
from .figures import COLOURS, blank, cursor, hover, legend, source

RUNS = 200
MOST_POINTS = 400  # of a band
BANDS = {"force": "N", "displacement": "m", "velocity": "m/s"}  # names in the answer, and units


@answering
def trust_data(request: Request) -> dict[str, Any]:
    """The ensemble for these choices: bands over time [s], table and words."""
    found = ensemble(request.scene, method=method_at_impact(request), runs=RUNS)
    rows = np.unique(np.linspace(0, found.time.size - 1, MOST_POINTS).round().astype(int))

    def band(given: Any) -> dict[str, list[float]]:
        return {name: _listed(getattr(given, name)[rows]) for name in ("lowest", "low", "high", "highest")}

    table = found.table()
    return {
        "time": _listed(found.time[rows]),
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


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.5g}") for value in values.tolist()]


def trust_figure(texts: Catalogue) -> list[Any]:
    """Bands over time of what 200 impacts do, in source "bands": of each quantity all of them, and 90 % of them."""
    edges = "lowest", "low", "high", "highest"
    bands = source("bands", "time", "when", *(f"{name}-{edge}" for name in BANDS for edge in edges))
    plots: list[Any] = []
    words, names = texts.family("trust"), texts.family("trust.edge")
    for (name, unit), colour in zip(BANDS.items(), COLOURS, strict=False):
        label = texts.text(f"trust.axis.{name}", unit=unit)
        plot = blank(f"trust-{name}", words[f"band.{name}"], "", label, plots[0] if plots else None, 230)
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
        tips = {texts.text("chart.time"): "@when"} | read
        hover(plot, lines[:1], tips, mode="vline")
        legend(plot, [(words["most"], [most]), (words["every"], [every])])
        cursor(plot, f"trust-cursor-{name}")
        plots.append(plot)
    return plots
