"""All mass ratios of a rod struck by a mass: number of contacts, their times, rebound and restitution."""

import json
from functools import lru_cache
from typing import Any

import numpy as np

from solvers import Rod
from solvers.studies.mass_ratios import mass_ratio_sweep
from solvers.text.catalogue import Catalogue

from ..choices.request import Request
from .figures import COLOURS, blank, cursor, hover, legend, source

CONTACTS = 1, 2  # as many as there are at most
SUPPORTS = "fixed", "free"


@lru_cache(maxsize=2)
def mass_ratio_data(support: str = "fixed") -> dict[str, np.ndarray]:
    """Arrays over 200 mass ratios (rod over mass) from 1/1000 to 1000, rigid contact; worked out once per process.

    `ratio`, `contacts`, `rebound` [v], `restitution`, `restitution_at_contact`, `peak_stress` [v sqrt(E rho)], and of
    every contact that any of them has `start_1`, `end_1`, `start_2` ... [T], NaN where there is none. Do not write to
    them.
    """
    found = mass_ratio_sweep(support)
    data = {
        "ratio": found.mass_ratio,
        "contacts": found.contacts,
        "rebound": found.rebound_velocity,
        "restitution": found.restitution,
        "restitution_at_contact": found.restitution_at_contact,
        "peak_stress": found.peak_stress,
    }
    for number in range(found.periods.shape[1]):
        data[f"start_{number + 1}"] = found.periods[:, number, 0]
        data[f"end_{number + 1}"] = found.periods[:, number, 1]
    for values in data.values():
        values.flags.writeable = False
    return data


def one_rod_support(chosen: dict[str, Any]) -> str | None:
    """How the rod is held, if a rigid mass strikes one uniform rod in rigid contact; else None."""
    try:
        scene = Request.of(chosen).scene
    except ValueError:  # which the visitor sees where it is solved
        return None
    target = scene.target
    plain = scene.impactor.free_mass and not target.end_mass
    if not plain or not isinstance(target, Rod) or not scene.rigid_contact or target.support not in SUPPORTS:
        return None
    return target.support


def ratios_data(chosen: dict[str, Any]) -> str:
    """The data for the support of the chosen scene as JSON, with `chosen` and its `support`."""
    support = one_rod_support(chosen)
    answer: dict[str, Any] = {"chosen": chosen, "support": support}
    if support:
        answer |= {name: _listed(values) for name, values in mass_ratio_data(support).items()}
    return json.dumps(answer, allow_nan=False)


def _listed(values: np.ndarray) -> list[float | None]:
    return [float(f"{value:.6g}") if np.isfinite(value) else None for value in values.tolist()]


def ratios_figure(texts: Catalogue) -> list[Any]:
    """Three plots over one axis, which source "ratios" fills: `low` and `high` are the edges about each ratio."""
    times = [f"{edge}_{number}" for number in CONTACTS for edge in ("start", "end")]
    shared = "low", "high", "ratio", "rebound", "restitution", "contacts"
    words, plots = texts.family("ratios.column"), texts.family("ratios.plot")
    data, axis = source("ratios", *shared, *times), words["ratio"]
    rebound = blank("rebound", plots["rebound"], axis, texts.text("ratios.in-speeds"), x_axis_type="log")
    named = (("rebound", words["mass"]), ("restitution", words["restitution"]))
    lines = [
        (name, [rebound.line("ratio", column, source=data, line_width=2, line_color=colour, line_dash=dash)])
        for (column, name), colour, dash in zip(named, COLOURS, ("solid", "dashed"), strict=False)
    ]
    tips = {axis: "@ratio{0.000a}"} | {name: f"@{column}{{0.000}}" for column, name in named}
    hover(rebound, lines[0][1], tips, mode="vline")
    legend(rebound, lines)
    periods = blank(
        "periods",
        plots["periods"],
        axis,
        texts.text("panel.time-in", unit="T"),
        rebound,
        x_axis_type="log",
        y_axis_type="log",
    )
    bars = []
    for number, colour, hatch in zip(CONTACTS, COLOURS, (" ", "/"), strict=False):
        edges = {"left": "low", "right": "high", "bottom": f"start_{number}", "top": f"end_{number}"}
        look = {"fill_alpha": 0.8, "line_color": colour, "line_width": 0.5, "hatch_pattern": hatch, "hatch_alpha": 0.5}
        bar = periods.quad(**edges, source=data, fill_color=colour, hatch_color="white", **look)
        bars.append((texts.text("ratios.contact", number=number), [bar]))
        start, end = texts.text("ratios.contact-from", number=number), texts.text("ratios.to")
        tips = {axis: "@ratio{0.000a}", start: f"@start_{number}{{0.000}} T", end: f"@end_{number}{{0.000}} T"}
        hover(periods, [bar], tips, name=f"periods-{number}")
    legend(periods, bars)
    count = blank("contacts", plots["contacts"], axis, words["contacts"], rebound, 190, x_axis_type="log")
    count.yaxis.ticker = list(CONTACTS)
    steps = count.step("ratio", "contacts", source=data, mode="center", line_width=2, line_color=COLOURS[0])
    hover(count, [steps], {axis: "@ratio{0.000a}", words["contacts"]: "@contacts"}, mode="vline")
    for plot in (rebound, periods, count):
        cursor(plot, f"ratio-cursor-{plot.name}")
    return [rebound, periods, count]
