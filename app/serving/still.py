"""What is seen before any script has run: the frame of the page, with a still of its first scene."""

from html import escape

import numpy as np

from solvers import Solution
from solvers.accuracy.reference import exact_solution
from solvers.text.catalogue import Catalogue

from ..choices.choices import START, Choices
from ..choices.request import Request

WIDTH, HEIGHT = 780, 188  # of the stage in a common window, in its own units; it is scaled to the true ones
LEFT, RIGHT, MIDDLE, TALL, MASS = (
    164,
    750,
    88,
    56,
    52,
)  # where rod and mass are, as app/static/axial/stage.js draws them
REACH = 0.16  # of the rod's length that the largest movement takes
INSTANT = 0.36  # round trips: the front is under way
SLICES = 120
STOPS = np.array(  # of the colours, as in app/static/charts/styles.js
    [[12, 58, 120], [66, 133, 200], [186, 215, 236], [246, 247, 248], [250, 205, 176], [222, 105, 62], [138, 24, 30]]
)


def first_still(texts: Catalogue) -> str:
    """The still of the scene that the page opens with, as HTML."""
    request = Request.of(Choices().chosen())
    exact = exact_solution(request.scene, request.restitution)
    title = escape(texts.texts.get(f"scene.{START}.title") or request.scene.title)
    return bare_frame(title, stage_of(exact))


def bare_frame(title: str = "", stage: str = "") -> str:
    """The frame of the page, with what is to be seen in it."""
    return (
        f"<header><b>Strikewave</b><span>{title}</span></header><aside></aside><main><p>{title}</p>"
        f"<div>{stage}</div><i></i><div></div></main><aside></aside>"
    )


def stage_of(exact: Solution) -> str:
    """The struck rod, coloured by its stress, and the mass, as a picture."""
    rod = exact.scene.target
    now = np.array([INSTANT * exact.scene.time_unit])
    places = np.linspace(0.0, rod.length, SLICES + 1)
    stress = exact.known_motion.stress(now, places)[0]
    whole = exact.known_motion.stress(np.linspace(0.0, exact.duration, 80), places)
    moved = exact.known_motion.displacement(now, places)[0]
    times = np.linspace(0.0, exact.duration, 200)
    farthest = max(
        np.abs(exact.known_motion.impactor_position(times)).max(), np.abs(exact.known_motion.end_position(times)).max()
    )
    scale = REACH * (RIGHT - LEFT) / farthest  # units of the picture in a metre of movement
    x = LEFT + (RIGHT - LEFT) * places / rod.length + scale * moved
    face = LEFT + scale * exact.known_motion.impactor_position(now)[0]
    drawn = [
        _box(
            x[k], MIDDLE - TALL / 2, x[k + 1] - x[k] + 0.7, TALL, colour(stress[k : k + 2].mean(), np.abs(whole).max())
        )
        for k in range(SLICES)
    ]
    drawn += [
        f'<rect x="{x[0]:.1f}" y="{MIDDLE - TALL / 2}" width="{x[-1] - x[0]:.1f}" height="{TALL}" fill="none" '
        'stroke="#4a5968"/>',
        f'<rect x="{face - MASS:.1f}" y="{MIDDLE - MASS / 2}" width="{MASS}" height="{MASS}" rx="5" fill="#3d4b59"/>',
    ]
    if rod.held:
        drawn.append(_box(x[-1], MIDDLE - TALL * 0.95, 5.0, 1.9 * TALL, "#55636f"))
    return _picture(WIDTH, HEIGHT, "".join(drawn))


def colour(value: float, largest: float) -> str:
    """Of a stress: tension blue, compression red."""
    place = (1.0 + min(max(value / largest, -1.0), 1.0)) / 2.0 * (len(STOPS) - 1)
    mixed = [np.interp(place, np.arange(len(STOPS)), channel) for channel in STOPS.T]
    return "#" + "".join(f"{round(part):02x}" for part in mixed)


def _box(x: float, y: float, width: float, height: float, fill: str) -> str:
    return f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" fill="{fill}"/>'


def _picture(width: int, height: int, drawn: str) -> str:
    return f'<svg viewBox="0 0 {width} {height}" preserveAspectRatio="xMidYMid meet">{drawn}</svg>'
