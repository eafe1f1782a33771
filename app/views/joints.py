"""What the joint between two links does to waves, over their frequency, for the page."""

import math
from collections.abc import Hashable
from typing import Any

import numpy as np

from solvers.bodies import Mechanism
from solvers.studies.scattering import INCOMING, OUTGOING, between_bars, joint_scattering
from solvers.text.catalogue import Catalogue

from ..choices.built_in import struck_body
from ..choices.request import Request
from .answering import answering
from .figures import COLOURS, blank, hover, legend, source

FREQUENCIES = 60
ROUNDING = 1e-12  # below which a share, or a frequency, is none
BELOW = 0.1  # of the lowest frequency that `impact joints` takes


def of_joined_links(asked: dict[str, Any]) -> Hashable:
    """The scene and what of its bodies is changed, if links of which waves are known are joined; else None."""
    target = struck_body(asked)
    joined = isinstance(target, Mechanism) and bool(between_bars(target))
    return (asked["scene"], asked["bodies"]) if joined else None


@answering
def joints_data(request: Request) -> dict[str, Any]:
    """`kind` of the joint, its `links` and `bend` [degrees], `frequency` [kHz], and of each kind of
    incoming wave the shares [%] of the power that goes back and on.
    """
    scene = request.scene
    usual = joint_scattering(scene).frequencies
    found = joint_scattering(scene, frequencies=np.geomspace(BELOW * usual[0], usual[-1], FREQUENCIES).tolist())
    shares = {
        name: {out: _listed(100.0 * found.powers[:, row, k]) for k, out in enumerate(OUTGOING)}
        for row, name in enumerate(INCOMING)
    }
    return {
        "kind": found.kind,
        "links": list(found.links),
        "bend": math.degrees(found.bend),
        "frequency": _listed(found.frequencies / (2e3 * math.pi)),
        **shares,
    }


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.6g}") if value > ROUNDING else 0.0 for value in values.tolist()]


def joints_figure(texts: Catalogue) -> list[Any]:
    """One plot for each kind of incoming wave, which source "joints" fills: the columns are `incoming-outgoing`."""
    words, plots, axis = texts.family("joints.out"), texts.family("joints.plot"), texts.text("joints.frequency")
    data = source("joints", "frequency", *(f"{name}-{out}" for name in INCOMING for out in OUTGOING))
    found: list[Any] = []
    for name in INCOMING:
        share = texts.text("joints.share")
        plot = blank(f"joints-{name}", plots[name], axis, share, found[0] if found else None, x_axis_type="log")
        lines = []
        for out, colour, dash in zip(OUTGOING, COLOURS, ("solid", "dashed", "solid", "dashed"), strict=False):
            look = {"line_width": 2, "line_color": colour, "line_dash": dash}
            lines.append((words[out], [plot.line("frequency", f"{name}-{out}", source=data, **look)]))
        tips = {axis: "@frequency{0.000a}"} | {words[out]: f"@{{{name}-{out}}}{{0.00}} %" for out in OUTGOING}
        hover(plot, lines[0][1], tips, mode="vline")
        legend(plot, lines)
        found.append(plot)
    return found
