"""How flexible links of a mechanism move and bend, as amounts of shapes, from which the browser makes their fields."""

from typing import Any, NamedTuple

import numpy as np

from solvers.bodies import Mechanism

from ..encoding import whole_numbers

PLACES = 31  # along each link
MOST_AMOUNTS = 7_500  # numbers in all, of which the instants are as many as leave room for
MOST_INSTANTS = 1_200


class Fields(NamedTuple):
    """Of each shape along a link, (shapes, places), for one unit: displacement [m], bending moment [N m], shear [N]."""

    shape: np.ndarray
    moment: np.ndarray
    shear: np.ndarray


def places_along(mechanism: Mechanism, number: int) -> np.ndarray:
    """[m]"""
    return np.linspace(0.0, mechanism.system.links[number].length, PLACES)


def instants_for(shapes: int, most: int = MOST_AMOUNTS) -> int:
    """The number of instants for links of so many shapes."""
    return int(min(MOST_INSTANTS, most / max(shapes, 1)))


def link_arrays(number: int, amounts: np.ndarray, fields: Fields, ever: np.ndarray) -> dict[str, Any]:
    """Amounts (instants, shapes) and fields of a link, each shape over what it is at most of what it `ever` is."""
    most = np.maximum(np.abs(ever).max(axis=0, initial=0.0), 1e-300)
    found: dict[str, Any] = {f"amountsOf{number}": whole_numbers(amounts / most)}
    for name, table in zip(Fields._fields, fields, strict=True):
        rows = table * most[:, None]
        scale = np.maximum(np.abs(rows).max(axis=1, initial=0.0), 1e-300)
        found |= {f"{name}Of{number}": whole_numbers(rows / scale[:, None]), f"{name}ScaleOf{number}": scale}
    return found


def across(mechanism: Mechanism, number: int) -> Fields:
    """Of a link's own bending, from the line through its joints, to the left of its way."""
    link, x = mechanism.system.links[number], places_along(mechanism, number)
    bends = slice(link.shapes.bending.frequencies.size)  # axial shapes come after these
    return Fields(
        link.shapes.displacements(x)[bends, :, 1] @ between_joints(mechanism, number),
        link.shapes.carried("moments", x)[bends],
        link.shapes.carried("shears", x)[bends],
    )


def along_normal(mechanism: Mechanism, number: int) -> Fields:
    """Of all coordinates of a link where it stands, as a whole and of its shapes: what moves along the normal."""
    link, x = mechanism.system.links[number], places_along(mechanism, number)
    whole = np.zeros((3, PLACES))
    moments, shears = (np.concatenate((whole, link.shapes.carried(name, x))) for name in ("moments", "shears"))
    return Fields((np.array(mechanism.struck.normal) @ link.points(x)).T, moments, shears)


def between_joints(mechanism: Mechanism, number: int) -> np.ndarray:
    """What takes from a deflection along a link (places,) the straight line through its first and last joint, or the
    movement of its only one: (places, places), from the right."""
    link = mechanism.links[number]
    shares = [
        float((np.array(joint.at) - link.start) @ link.along) / link.length
        for joint in mechanism.joints
        if link.name in joint.links
    ]
    x = np.linspace(0.0, 1.0, PLACES)
    if not shares:
        return np.eye(PLACES)
    first, last = min(shares), max(shares)
    if last - first < 1e-9:
        return np.eye(PLACES) - np.outer(_weights(x, first), np.ones(PLACES))
    part = (x - first) / (last - first)
    return np.eye(PLACES) - np.outer(_weights(x, first), 1.0 - part) - np.outer(_weights(x, last), part)


def _weights(x: np.ndarray, share: float) -> np.ndarray:
    """Those of the value at a share of the length, straight between the places."""
    return np.array([np.interp(share, x, unit) for unit in np.eye(x.size)])
