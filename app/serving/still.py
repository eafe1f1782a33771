"""What is seen before any script has run: the frame of the page, with a still of its first scene."""

from html import escape

import numpy as np

from solvers import Solution
from solvers.accuracy.reference import exact_solution
from solvers.text.catalogue import Catalogue

from ..choices.choices import START, Choices
from ..choices.request import Request

REACH = 0.072  # of the rod's length that the largest movement takes, as app/static/axial/stage.js draws it
INSTANT = 0.36  # round trips: the front is under way
SLICES = 120
STOPS = np.array(  # of the colours, as in app/static/charts/styles.js
    [[12, 58, 120], [66, 133, 200], [186, 215, 236], [246, 247, 248], [250, 205, 176], [222, 105, 62], [138, 24, 30]]
)


def first_still(texts: Catalogue | None = None) -> str:
    """The still of the scene that the page opens with, as HTML; without its title where the language is not known."""
    request = Request.of(Choices().chosen())
    exact = exact_solution(request.scene, request.restitution)
    title = escape(texts.texts.get(f"scene.{START}.title") or request.scene.title) if texts else ""
    return bare_frame(title, stage_of(exact))


def bare_frame(title: str = "", stage: str = "") -> str:
    """The frame of the page, with what is to be seen in it."""
    return (
        f"<header><b>Strikewave</b><span>{title}</span></header><aside></aside><main><p>{title}</p>"
        f"<div>{stage}</div></main><aside></aside>"
    )


def stage_of(exact: Solution) -> str:
    """The struck rod, coloured by its stress, and the places of mass and wall: page.css has their sizes."""
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
    x = places / rod.length + REACH / farthest * moved
    drawn = "".join(
        f'<rect x="{x[k]:.4f}" width="{x[k + 1] - x[k] + 0.001:.4f}" height="1" '
        f'fill="{colour(stress[k : k + 2].mean(), np.abs(whole).max())}"/>'
        for k in range(SLICES)
    )
    return f'<svg viewBox="0 0 1 1" preserveAspectRatio="none">{drawn}</svg><b></b><i></i>'


def colour(value: float, largest: float) -> str:
    """Of a stress: tension blue, compression red."""
    place = (1.0 + min(max(value / largest, -1.0), 1.0)) / 2.0 * (len(STOPS) - 1)
    mixed = [np.interp(place, np.arange(len(STOPS)), channel) for channel in STOPS.T]
    return "#" + "".join(f"{round(part):02x}" for part in mixed)
