"""Views that need no live answer, made when they are first asked for: HoloViews figures under the laboratory."""

from typing import Any

import numpy as np

from solvers import Solution

from .frames import exact_solution
from .state import chosen_scene, on_beam

INSTANTS = 161
OF_A_BEAM, OF_A_CONTACT, CONTACTS = 801, 24, 40  # instants of a beam, in each contact besides, of the first so many
SHARES = {  # name in the solution: what the reader calls it, and its colour
    "impactor": ("impactor", "#33475b"),
    "target_rigid": ("target as a whole", "#4f9bd8"),
    "target_vibration": ("waves in it", "#e08a4d"),
    "target_kinetic": ("beam moving", "#e08a4d"),
    "target_strain": ("beam bent", "#d8b23c"),
    "local": ("stored in the contact", "#7c9a54"),
    "dissipated": ("lost in the contact", "#a4243b"),
}


def energy_shares(chosen: dict[str, Any]) -> dict[str, np.ndarray]:
    """Energy of every part against time [T; ms for a beam], as a share of the first energy.

    That of a beam is told apart into motion and bending, where its method knows both.
    """
    scene = chosen_scene(chosen)
    if on_beam(scene):
        from .beam_frame import MS, main_solution

        solution, unit = main_solution(scene, chosen)[0], 1.0 / MS
    else:
        solution, unit = exact_solution(scene, chosen["restitution"]), scene.time_unit
    time = beam_instants(solution) if on_beam(scene) else np.linspace(0.0, solution.duration, INSTANTS)
    energies = solution.motion.energies(time)
    if on_beam(scene) and hasattr(solution.motion, "target_energies"):
        parts = solution.motion.target_energies(time)
        energies = {key: energies[key] for key in energies if key not in ("target_rigid", "target_vibration")}
        energies |= {f"target_{name}": values for name, values in parts.items()}
    shares = {SHARES[name][0]: 100.0 * values / solution.energy["initial"] for name, values in energies.items()}
    return {"time": time / unit, "unit": "ms" if on_beam(scene) else "T", **shares}


def beam_instants(solution: Solution) -> np.ndarray:
    """Times [s] of the whole blow, and closer together while the bodies touch, when energy goes over."""
    touching = [
        np.linspace(contact.start, contact.end, OF_A_CONTACT)
        for contact in solution.contacts[:CONTACTS]
        if contact.end > contact.start
    ]
    time = np.unique(np.concatenate([np.linspace(0.0, solution.duration, OF_A_BEAM), *touching]))
    return time[time <= solution.duration]


def energy_view(pipe: Any) -> Any:
    """A pane that shows what `pipe`, a stream of `energy_shares`, says."""
    import holoviews as hv
    import panel as pn

    hv.extension("bokeh")
    hv.renderer("bokeh").webgl = False

    def name_cursor(plot, element):
        plot.handles["glyph"].name = "energy-cursor"
        plot.handles["glyph"].level = "overlay"

    def stack(data):
        shown = [(name, colour) for name, colour in SHARES.values() if name in data]
        areas = [hv.Area((data["time"], data[name]), "time", "share", label=name) for name, _ in shown]
        colours = hv.Cycle([colour for _, colour in shown])
        return hv.Area.stack(hv.Overlay(areas)).opts(
            hv.opts.Area(color=colours, line_width=0, fill_alpha=0.9, framewise=True)
        )

    cursor = hv.VLine(0.0).opts(color="#c81e4a", line_width=1.5, hooks=[name_cursor])
    figure = (hv.DynamicMap(stack, streams=[pipe]) * cursor).opts(
        title="Where the energy is",
        xlabel="time, as above",
        ylabel="share of the first energy, %",
        height=300,
        responsive=True,
        ylim=(0, 102),
        toolbar="above",
        default_tools=["save", "xwheel_zoom", "xpan", "reset"],
        active_tools=[],
        framewise=True,
        legend_position="top",  # beside the picture it would leave a phone none
        legend_cols=2,
        legend_offset=(0, 18),
        legend_opts={"border_line_alpha": 0.0, "padding": 0, "spacing": 0, "label_text_font_size": "11px"},
    )
    return pn.pane.HoloViews(figure, sizing_mode="stretch_width", margin=(0, 14, 14, 14))
