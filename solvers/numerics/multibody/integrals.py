"""Of links with floating frames: integrals of their shapes up to the second order, over the mass and along the link.

Error: to rounding, by Gauss in panels of half a wave.
"""

from collections.abc import Sequence

import numpy as np

from .floating import Frames, Stations
from .shapes import panels
from .system import GROUND, Link


def frames_of(links: Sequence[Link]) -> Frames:
    """What kernels take of the links."""
    most, count = max((link.shapes.frequencies.size for link in links), default=0), len(links)
    masses = np.array([link.mass for link in links])
    halves = np.array([0.5 * link.length for link in links])
    found = Frames(
        start=np.cumsum([0, *(link.size for link in links)]),
        mass=masses,
        moment=masses * halves,
        inertia=np.array([link.inertia for link in links]) + masses * halves**2,
        momentum=np.zeros((count, most + 2, 2)),
        angular=np.zeros((count, most + 2)),
        radial=np.zeros((count, most + 2)),
        square=np.zeros((count, most + 2, most + 2)),
        swelling=np.zeros((count, most + 2, most + 2)),
        crossed=np.zeros((count, most + 2, most + 2)),
        line=np.zeros((count, 2, most, most)),
        stiffness=np.zeros((count, most)),
    )
    for number, link in enumerate(links):
        if link.shapes.frequencies.size:
            _write(found, number, link)
    return found


def _write(found: Frames, number: int, link: Link) -> None:
    """The integrals of a flexible link."""
    shapes, length = link.shapes, link.length
    count = shapes.frequencies.size
    x, weights = panels(shapes.cuts, count)
    weights = weights * link.mass / length
    fields = np.zeros((count + 2, x.size, 2))
    fields[0, :, 0], fields[1, :, 0], fields[2:] = 1.0, x, shapes.displacements(x)
    own, bent = slice(0, count + 2), slice(2, count + 2)
    found.momentum[number, own] = np.einsum("ixk,x->ik", fields, weights)
    found.radial[number, own] = fields[:, :, 0] @ (weights * x)
    found.angular[number, bent] = shapes.angular
    square = np.einsum("ixk,x,jxk->ij", fields, weights, fields, optimize=True)
    crossed = (fields[:, :, 0] * weights) @ fields[:, :, 1].T
    found.swelling[number, own, own], found.square[number, own, own] = square, square
    found.square[number, bent, bent] = np.eye(count)
    found.crossed[number, own, own] = crossed - crossed.T
    found.line[number, :, :count, :count] = _straight_line(link, x, weights)
    found.stiffness[number, :count] = shapes.frequencies**2


def _straight_line(link: Link, x: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """By what a bent link gets shorter: the straight line through H(x) by least squares over the mass, (2, shapes,
    shapes). The integrals of H and of x H are those of the products of the slopes times rho A (L - x) and rho A (L^2 -
    x^2) / 2: the pull of the inertia of all that is farther out."""
    slopes, length = link.shapes.slopes(x), link.length
    first, second = (
        (slopes * (weights * (length - x))) @ slopes.T,
        (slopes * (0.5 * weights * (length**2 - x**2))) @ slopes.T,
    )
    moments = link.mass * np.array([[1.0, 0.5 * length], [0.5 * length, length**2 / 3.0]])
    return np.einsum("kl,lij->kij", np.linalg.inv(moments), np.array([first, second]))


def shortening(link: Link, upto: float) -> np.ndarray:
    """H up to this place [m] of a link, (shapes, shapes) [1/(kg m)]."""
    shapes = link.shapes
    if not shapes.frequencies.size or upto <= 0.0:
        return np.zeros((shapes.frequencies.size,) * 2)
    x, weights = panels(np.unique([*shapes.cuts[shapes.cuts < upto], upto]), shapes.frequencies.size)
    slopes = shapes.slopes(x)
    return (slopes * weights) @ slopes.T


def stations_of(links: Sequence[Link], places: Sequence[tuple[int, np.ndarray]]) -> Stations:
    """Points of the links, or of the ground, by link and place (2,) in the first configuration [m]."""
    most, count = max((link.shapes.frequencies.size for link in links), default=0), len(places)
    found = Stations(
        np.array([link for link, _ in places], np.int64),
        np.zeros((count, 2)),
        np.zeros((count, most, 2)),
        np.zeros((count, most)),
        np.zeros((count, most, most)),
    )
    for number, (at_link, at) in enumerate(places):
        if at_link == GROUND:
            found.own[number] = at
            continue
        link = links[at_link]
        own = slice(0, link.shapes.frequencies.size)
        found.own[number] = link.axes @ (at - link.origin)
        x = np.array([np.clip(found.own[number, 0], 0.0, link.length)])
        found.shapes[number, own] = link.shapes.displacements(x)[:, 0]
        found.turns[number, own] = link.shapes.turns(x)[:, 0]
        found.shortened[number, own, own] = shortening(link, float(x[0]))
    return found
