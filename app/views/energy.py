"""Where the energy is, part by part, over time."""

import json
from typing import Any

import numpy as np

from solvers import Solution
from solvers.accuracy.reference import exact_solution
from solvers.solution.motion import SplitsTarget

from ..choices.request import Request
from ..messages.beam import MS, main_solution
from .figures import INK, blank, cursor, hover, legend, source

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


def energy_data(chosen: dict[str, Any]) -> str:
    """The shares as JSON: `chosen`, `time` in `unit`, and of each part `key`, `name` and `values` [%], or None."""
    found = energy_shares(chosen)
    parts = [
        {"key": key, "name": name, "values": _listed(found[name]) if name in found else None}
        for key, (name, _) in SHARES.items()
    ]
    answer = {"chosen": chosen, "time": _listed(found["time"]), "unit": found["unit"], "parts": parts}
    return json.dumps(answer, allow_nan=False)


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.6g}") for value in values.tolist()]


def energy_shares(chosen: dict[str, Any]) -> dict[str, Any]:
    """Energy of every part against time [T; ms for a beam], as a share of the first energy.

    That of a beam is split into motion and bending, where its method knows both.
    """
    request = Request.of(chosen)
    beam = request.kind == "beam"
    if beam:
        solution, unit = main_solution(request)[0], 1.0 / MS
    else:
        solution, unit = exact_solution(request.scene, request.restitution), request.scene.time_unit
    time = beam_instants(solution) if beam else np.linspace(0.0, solution.duration, INSTANTS)
    energies = solution.motion.energies(time)
    if beam and isinstance(solution.motion, SplitsTarget):
        parts = solution.motion.target_energies(time)
        energies = {key: energies[key] for key in energies if key not in ("target_rigid", "target_vibration")}
        energies |= {f"target_{name}": values for name, values in parts.items()}
    shares = {SHARES[name][0]: 100.0 * values / solution.energy["initial"] for name, values in energies.items()}
    return {"time": time / unit, "unit": "ms" if beam else "T", **shares}


def beam_instants(solution: Solution) -> np.ndarray:
    """Times [s] of the whole impact, and closer together while the bodies touch, when energy goes over."""
    touching = [
        np.linspace(contact.start, contact.end, OF_A_CONTACT)
        for contact in solution.contacts[:CONTACTS]
        if contact.end > contact.start
    ]
    time = np.unique(np.concatenate([np.linspace(0.0, solution.duration, OF_A_BEAM), *touching]))
    return time[time <= solution.duration]


def energy_figure() -> list[Any]:
    """Each part upon the others, in source "shares": `time`, and the lower and upper edge of every part."""
    keys = list(SHARES)
    edges = [f"{key}-{edge}" for key in keys for edge in ("low", "high")]
    data = source("shares", "time", "whole", *keys, *edges)
    plot = blank("energy", "", "time", "share of the first energy, %")
    shown = []
    for key, (name, colour) in SHARES.items():
        area = plot.varea("time", f"{key}-low", f"{key}-high", source=data, fill_color=colour, fill_alpha=0.9, name=key)
        shown.append((name, [area]))
    whole = plot.line("time", "whole", source=data, line_color=INK, line_width=1.0)
    hover(plot, [whole], {"time": "@time{0.000}"}, mode="vline", line_policy="nearest")
    legend(plot, shown)
    cursor(plot, "energy-cursor")
    return [plot]
