"""What the plot over all mass ratios needs: number of contacts, their times, rebound and restitution."""

from functools import lru_cache
from typing import Any

import numpy as np

from solvers import SceneError
from solvers.studies import mass_ratio_sweep

from .state import chosen_scene

EARLIEST = 0.5  # [T] where the logarithmic axis of time begins; contact 1 begins at 0
TOLD = {
    "fixed": (
        "A light rod throws the mass back with almost all its speed, a heavy one with 2/e of it, yet the way between "
        "is not monotone: each time a returning wave pushes the mass away earlier, a second contact appears or is "
        "lost. It is lost for good at m₂/m₁ = 1.0107; below 0.5785 it is gone again, until 0.327, and so on."
    ),
    "free": (
        "One contact, of exactly one round trip, for every mass ratio: the wave that comes back from the free end "
        "pulls the rod away. The mass keeps exp(−2 m₂/m₁) of its speed, so that restitution falls steadily."
    ),
}
COLOURS = ("#0b4f8a", "#d9730d", "#2e7d4f")  # of contacts 1, 2, ...


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
        scene = chosen_scene(chosen)
    except SceneError:  # of which the visitor is told where it is solved
        return None
    target = scene.target
    plain = scene.impactor.kind in ("mass", "sphere") and target.kind == "rod" and not target.end_mass
    if not plain or scene.contact.NAME != "rigid" or target.support not in TOLD:
        return None
    return target.support


def ratios_for(chosen: dict[str, Any]) -> dict[str, Any]:
    """The data for the support of the chosen scene."""
    import holoviews  # noqa: F401  # a second of loading, which the event loop must not spend

    support = one_rod_support(chosen)
    return {"support": support, **(mass_ratio_data(support) if support else {})}


def ratios_view(pipe: Any) -> Any:
    """A pane that shows what `pipe`, a stream of `ratios_for`, says; the page moves its cursors itself."""
    import holoviews as hv
    import panel as pn

    hv.extension("bokeh")
    hv.renderer("bokeh").webgl = False
    look = {
        "logx": True,
        "xlim": (1e-3, 1e3),
        "responsive": True,
        "framewise": True,
        "toolbar": "above",
        "default_tools": ["save", "xwheel_zoom", "xpan", "reset"],
        "active_tools": [],
        "xlabel": "mass ratio m₂/m₁",
    }
    keys = {  # above: beside the picture they would leave a phone none
        "legend_position": "top",
        "legend_cols": 2,
        "legend_offset": (0, 18),
        "legend_opts": {"border_line_alpha": 0.0, "padding": 0, "spacing": 0, "label_text_font_size": "11px"},
    }
    rebound = (hv.DynamicMap(_rebound, streams=[pipe]) * _cursor("rebound")).opts(
        title="How the bodies part", ylabel="in impact speeds", ylim=(-1.05, 1.1), height=260, **look,
        **keys,
    )  # fmt: skip
    periods = (hv.DynamicMap(_periods, streams=[pipe]) * _cursor("periods")).opts(
        title="When they touch", ylabel="time in T", ylim=(EARLIEST, 100.0), logy=True, height=260,
        **look, **keys,
    )  # fmt: skip
    contacts = (hv.DynamicMap(_contacts, streams=[pipe]) * _cursor("contacts")).opts(
        title="Number of contacts", ylabel="", ylim=(0.5, 2.5), yticks=[1, 2], height=130, **look
    )
    figures = [pn.pane.HoloViews(figure, sizing_mode="stretch_width") for figure in (rebound, periods, contacts)]
    told = pn.pane.HTML(_told(pipe.data), sizing_mode="stretch_width", margin=(0, 10))
    pipe.add_subscriber(lambda data: told.param.update(object=_told(data)))
    return pn.Column(*figures, told, sizing_mode="stretch_width", margin=(0, 14, 14, 14))


def _told(data: dict[str, Any]) -> str:
    held = {"fixed": "The far end is fixed.", "free": "The rod is free."}
    return f"<p>{held[data['support']]} {TOLD[data['support']]}</p>" if data["support"] else ""


def _cursor(name: str) -> Any:
    import holoviews as hv

    def named(plot, element):
        plot.handles["glyph"].name = f"ratio-cursor-{name}"
        plot.handles["glyph"].level = "overlay"

    return hv.VLine(1.0).opts(color="#c81e4a", line_width=1.5, hooks=[named])


def _rebound(data: dict[str, Any]) -> Any:
    import holoviews as hv

    empty = np.empty(0)
    ratio, curves = data.get("ratio", empty), (("rebound", "velocity of the mass"), ("restitution", "restitution e"))
    drawn = [
        hv.Curve((ratio, data.get(key, empty)), "ratio", "rebound", label=label).opts(color=colour, line_width=2)
        for (key, label), colour in zip(curves, COLOURS, strict=False)
    ]
    return hv.Overlay(drawn)


def _periods(data: dict[str, Any]) -> Any:
    """A bar for every contact of every ratio, as wide as the ratios are apart."""
    import holoviews as hv

    ratio, drawn = data.get("ratio", np.empty(0)), []
    half = np.sqrt(ratio[1] / ratio[0]) if ratio.size else 1.0
    for number, colour in enumerate(COLOURS[:2], 1):
        start, end = (data.get(f"{edge}_{number}", np.full(ratio.size, np.nan)) for edge in ("start", "end"))
        there = ~np.isnan(end)
        bars = (ratio[there] / half, np.maximum(start[there], EARLIEST), ratio[there] * half, end[there])
        drawn.append(
            hv.Rectangles(bars, ["low", "start", "high", "end"], label=f"contact {number}").opts(
                color=colour, line_color=colour, line_width=0.5, fill_alpha=0.8
            )
        )
    return hv.Overlay(drawn)


def _contacts(data: dict[str, Any]) -> Any:
    import holoviews as hv

    empty = np.empty(0)
    steps = hv.Curve((data.get("ratio", empty), data.get("contacts", empty)), "ratio", "contacts")
    return steps.opts(interpolation="steps-mid", color=COLOURS[0], line_width=2)
