"""How a rod stretches as it turns, for the page: along it, and its end by its speed."""

from collections.abc import Hashable
from dataclasses import replace
from typing import Any

import numpy as np

from solvers.bodies import RotatingRod
from solvers.text.catalogue import Catalogue

from ..choices.built_in import struck_body
from ..choices.request import Request
from .answering import answering
from .figures import COLOURS, PICKED, blank, hover, source

PLACES = 41
HEIGHT = 220  # of each plot, so that both are in view
SPEEDS = np.linspace(0.0, 0.8, 49)  # of the critical one, at which the stretch is infinite


def of_turning_rods(asked: dict[str, Any]) -> Hashable:
    """The scene and what of its bodies is changed, if its target turns and is struck along its length; else None."""
    target = struck_body(asked)
    return (asked["scene"], asked["bodies"]) if isinstance(target, RotatingRod) and not target.across else None


@answering
def stretch_data(request: Request) -> dict[str, Any]:
    """`place` along the rod from its axis [mm] and `moved` there [mm]; `speed` [rad/s] and `end`,
    the stretch of its end over the length [%]; `own`, both at its speed, the `critical` one, `half`, what is moved half
    way over that of the end, the strain of the `root` [%].
    """
    rod = request.scene.target.known_as(RotatingRod)
    place = np.linspace(0.0, rod.length, PLACES)
    moved = rod.steady_displacement(place)
    ends = [replace(rod, speed=share * rod.critical_speed).steady_stretch for share in SPEEDS.tolist()]
    return {
        "place": _listed(1e3 * place),
        "moved": _listed(1e3 * moved),
        "speed": _listed(SPEEDS * rod.critical_speed),
        "end": _listed(100.0 * np.array(ends) / rod.length),
        "own": [rod.speed, 100.0 * rod.steady_stretch / rod.length],
        "critical": rod.critical_speed,
        "half": float(moved[PLACES // 2] / moved[-1]) if rod.speed else 11.0 / 16.0,
        "root": 100.0 * rod.root_strain,
    }


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.6g}") for value in values.tolist()]


def stretch_figure(texts: Catalogue) -> list[Any]:
    """Plots "stretch-along" and "stretch-speed", which sources "along", "speeds" and "own" fill."""
    titles = texts.family("stretch.plot")
    words = {name: texts.text(f"stretch.{name}") for name in ("place", "moved", "speed", "end")}
    along = blank("stretch-along", titles["along"], words["place"], words["moved"], height=HEIGHT)
    look = {"line_width": 2, "line_color": COLOURS[0]}
    line = along.line("place", "moved", source=source("along", "place", "moved"), **look)
    hover(along, [line], {words["place"]: "@place{0.0}", words["moved"]: "@moved{0.000}"}, mode="vline")
    speeds = blank("stretch-speed", titles["speed"], words["speed"], words["end"], height=HEIGHT)
    line = speeds.line("speed", "end", source=source("speeds", "speed", "end"), **look)
    speeds.scatter("speed", "end", source=source("own", "speed", "end"), size=9, color=PICKED)
    hover(speeds, [line], {words["speed"]: "@speed{0}", words["end"]: "@end{0.00}"}, mode="vline")
    return [along, speeds]
