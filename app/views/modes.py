"""The modes of the target for the page: shapes, frequencies, masses, and which of them rings after the impact."""

from collections.abc import Hashable
from dataclasses import replace
from typing import Any

import numpy as np

from solvers import Beam, Modal, Rod, Solution
from solvers.bodies import RotatingRod
from solvers.bodies.beams import THEORIES
from solvers.solution.solution import apparent_time
from solvers.solution.target_modes import TargetModes, largest_of, unit_shapes
from solvers.text.catalogue import Catalogue

from ..choices.request import Request
from ..messages.solutions import method_options
from ..text.refusals import Refused
from .answering import answering
from .figures import blank, cursor, hover, legend, source

MOST = 8  # modes that are shown
PLACES, INSTANTS = 101, 601
HEIGHT = 240  # of each plot, so that both are in view
BY_OTHERS = ("method", "elements", "motion_seconds", "motion_links")  # of which nothing here depends


def of_modes(asked: dict[str, Any]) -> Hashable:
    """All that was asked but the method, as modes are shown whatever solves the impact, and what that alone takes."""
    return tuple((name, value) for name, value in asked.items() if name not in BY_OTHERS)


@answering
def modes_data(request: Request) -> dict[str, Any]:
    """Of the target alone, and while the mass stays on it, `sets` by "alone" and "together": `number`, `frequency`
    [Hz], modal `mass` at the struck place [kg] and `shape` of every mode at `place` [mm]; the second is None where it
    is not known. `beside`, the `frequency` and `shape` of each alone by the other `theory` of a beam, or None.
    `struck` [mm]; how many modes are `kept`; `contact`, from the first touch to the last parting [s] or
    None; of those alone the `share` of the vibration that each has after it [%] and `amplitude` [µm] (modes, time)
    where its shape is largest, at `time` in `unit`; `ringing`, the vibration of the target over the first energy [%].
    """
    target, method = request.scene.target, Modal.read(method_options(Modal.NAME, request))
    why = method.refusal(request.scene)
    if why and target.length:
        raise Refused(why.code, **why.values)
    if not isinstance(target, Rod | Beam | RotatingRod):
        raise Refused("modes.no-shapes")
    solution = method.without_estimate().solve(request.scene)
    modes, x = solution.target_modes, np.linspace(0.0, target.length, PLACES)
    unit, seconds = (request.scene.time_unit, "T") if request.exact else (1.0, "s")
    time = np.linspace(0.0, solution.duration, INSTANTS)
    energies = modes.energies(solution.contacts[-1].end)[0]
    whole = float(energies.sum())
    return {
        "place": _listed(1e3 * x),
        "struck": 1e3 * (0.0 if isinstance(target, Rod) else target.place),
        "sets": {"alone": _alone(modes, x), "together": _together(request, solution, x)},
        "beside": _beside(solution, x),
        "kept": int(modes.frequencies.size),
        "contact": apparent_time(solution.contacts),
        "share": _listed(100.0 * energies[:MOST] / (whole or 1.0)),
        "ringing": 100.0 * whole / solution.energy["initial"],
        "time": _listed(time / unit),
        "unit": seconds,
        "amplitude": [_listed(each) for each in 1e6 * modes.displacements(time).T[:MOST]],
    }


def _alone(modes: TargetModes, x: np.ndarray) -> dict[str, Any]:
    return {
        "number": modes.numbers[:MOST].tolist(),
        "frequency": _listed(modes.frequencies[:MOST]),
        "mass": _listed(modes.masses[:MOST]),
        "shape": [_listed(shape) for shape in modes.shapes(x)[:MOST]],
    }


def _beside(solution: Solution, x: np.ndarray) -> dict[str, Any] | None:
    """The same modes by the other theory of bending; None of what is no beam, and in a frame whose shapes are others.

    Source: thesis figure 8.12, table 8.3.
    """
    beam, own = solution.scene.target, solution.target_modes
    if not isinstance(beam, Beam) or solution.method["frame"] != Modal.frame:
        return None
    theory = next(name for name in THEORIES if name != beam.theory)
    rows = own.numbers[:MOST] - 1
    found = replace(beam, theory=theory).modes(int(rows.max()) + 1)
    shapes = (found.shapes(x) / np.abs(largest_of(found, beam.length))[:, None])[rows]
    shapes *= np.sign(np.sum(shapes * own.shapes(x)[:MOST], axis=1))[:, None]
    return {
        "theory": theory,
        "frequency": _listed(found.frequencies[rows] / (2.0 * np.pi)),
        "shape": [_listed(shape) for shape in shapes],
    }


def _together(request: Request, solution: Solution, x: np.ndarray) -> dict[str, Any] | None:
    """Of target and impactor while they touch; of one rigid mass on what is struck without a law that gives way."""
    impactor, target = request.scene.impactor, request.scene.target
    if not (impactor.free_mass and request.scene.rigid_contact and isinstance(target, Rod | Beam)):
        return None
    found = target.joined_modes(min(MOST, solution.method["modes"]), impactor.mass)
    return {
        "number": list(range(1, found.frequencies.size + 1)),
        "frequency": _listed(found.frequencies / (2.0 * np.pi)),
        "mass": _listed(found.at_contact**-2.0),
        "shape": [_listed(shape) for shape in unit_shapes(found, target.length, x)],
    }


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.6g}") for value in values.tolist()]


def modes_figure(texts: Catalogue) -> list[Any]:
    """Plots "modes-shapes" and "modes-amplitudes": a line for each mode, in sources of these names; of shapes also one
    in source "beside"."""
    titles = texts.family("modes.plot")
    place, time = texts.text("modes.place"), texts.text("chart.time")
    plots = []
    for name, across, up in (("shapes", place, "modes.shape"), ("amplitudes", time, "modes.amplitude")):
        plot = blank(f"modes-{name}", titles[name], across, texts.text(up), height=HEIGHT)
        lines = source(name, "x", "y", "colour", "key", "mode")
        look = {"line_width": 1.8, "line_color": {"field": "colour"}}
        drawn = [plot.multi_line("x", "y", source=lines, **look)]
        if name == "shapes":
            beside = source("beside", "x", "y", "colour", "key", "mode")
            drawn.append(plot.multi_line("x", "y", source=beside, line_dash="dashed", **look))
        hover(plot, drawn, {texts.text("modes.number"): "@mode", across: "$x{0.000}", texts.text(up): "$y{0.000}"})
        legend(plot, [({"field": "key"}, [each]) for each in drawn])
        cursor(plot, f"modes-{name}-cursor")
        plots.append(plot)
    return plots
