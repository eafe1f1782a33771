"""Where the energy is, part by part, over time."""

from collections.abc import Hashable
from typing import Any

import numpy as np

from solvers import Solution
from solvers.accuracy.reference import exact_solution
from solvers.notebook.given import books_open, given
from solvers.solution.motion import SplitsTarget
from solvers.text.catalogue import Catalogue

from ..choices.kinds import moves_on
from ..choices.request import Request
from ..messages.transverse import main_solution
from .answering import answering
from .figures import INK, blank, cursor, hover, legend, source

INSTANTS = 161
OF_A_BEAM, OF_A_CONTACT, CONTACTS = 801, 24, 40  # instants of a beam, in each contact besides, of the first so many
COLOURS = {  # of the parts, which have their names in the solution
    "impactor": "#33475b",
    "target_rigid": "#4f9bd8",
    "target_vibration": "#e08a4d",
    "target_kinetic": "#e08a4d",
    "target_strain": "#d8b23c",
    "weight": "#8b95a1",
    "local": "#7c9a54",
    "dissipated": "#a4243b",
}


def of_impacts(asked: dict[str, Any]) -> Hashable:
    """All that was asked; None where a mechanism moves on, whose energies are beside its picture."""
    try:
        return None if moves_on(asked) else tuple(asked.items())
    except ValueError:  # which the visitor sees where it is solved
        return None


@answering
def energy_data(request: Request) -> dict[str, Any]:
    """The shares: `time` in `unit`, `fed` [%], `gap`, and of each part `key` and `values` [%], or None."""
    found = energy_shares(request)
    parts = [{"key": key, "values": _listed(found[key]) if key in found else None} for key in COLOURS]
    return {"time": _listed(found["time"]), **{key: found[key] for key in ("unit", "fed", "gap")}, "parts": parts}


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.6g}") for value in values.tolist()]


def energy_shares(request: Request) -> dict[str, Any]:
    """Energy of every part against time [T; s for a beam], as a share of the first energy and `fed`, what the
    drives have brought in by the end. That of weight counts from the lowest place of what falls, so that it is part of
    the first. `gap`: the share that is unaccounted for, where shares would tell nothing, else None.

    That of a beam is split into motion and bending, where its method knows both.
    """
    beam = not request.exact
    if beam:
        solution, unit = main_solution(request)[0], 1.0
    else:
        solution, unit = exact_solution(request.scene, request.restitution), request.scene.time_unit
    time = beam_instants(solution) if beam else np.linspace(0.0, solution.duration, INSTANTS)
    energies = solution.known_motion.energies(time)
    if beam and isinstance(solution.motion, SplitsTarget):
        parts = solution.motion.target_energies(time)
        energies = {key: energies[key] for key in energies if key not in ("target_rigid", "target_vibration")}
        energies |= {f"target_{name}": values for name, values in parts.items()}
    fed = given(solution.energy)["drives"]
    whole = solution.energy["initial"] + fed
    if "weight" in energies:
        energies["weight"] = energies["weight"] - energies["weight"].min()
        whole += energies["weight"][0]
    shares = {name: 100.0 * values / whole for name, values in energies.items()}
    gap = abs(solution.diagnostics["energy_error"]) if books_open(solution) else None
    return {"time": time / unit, "unit": "s" if beam else "T", "fed": 100.0 * fed / whole, "gap": gap, **shares}


def beam_instants(solution: Solution) -> np.ndarray:
    """Times [s] of the whole impact, and closer together while the bodies touch, when energy goes over."""
    touching = [
        np.linspace(contact.start, contact.end, OF_A_CONTACT)
        for contact in solution.contacts[:CONTACTS]
        if contact.end > contact.start
    ]
    time = np.unique(np.concatenate([np.linspace(0.0, solution.duration, OF_A_BEAM), *touching]))
    return time[time <= solution.duration]


def energy_figure(texts: Catalogue) -> list[Any]:
    """Each part upon the others, in source "shares": `time`, and the lower and upper edge of every part."""
    keys, names = list(COLOURS), texts.family("energy.part")
    edges = [f"{key}-{edge}" for key in keys for edge in ("low", "high")]
    data = source("shares", "time", "whole", *keys, *edges)
    plot = blank("energy", "", texts.text("chart.time"), texts.text("energy.share"))
    shown = []
    for key, colour in COLOURS.items():
        area = plot.varea("time", f"{key}-low", f"{key}-high", source=data, fill_color=colour, fill_alpha=0.9, name=key)
        shown.append((names[key], [area]))
    whole = plot.line("time", "whole", source=data, line_color=INK, line_width=1.0)
    hover(plot, [whole], {texts.text("chart.time"): "@time{0.000}"}, mode="vline", line_policy="nearest")
    legend(plot, shown)
    cursor(plot, "energy-cursor")
    return [plot]
