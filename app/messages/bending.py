"""How flexible links of a mechanism bend, as amounts of their shapes, from which the browser makes their fields."""

from typing import Any

import numpy as np

from solvers.bodies import Mechanism

from .encoding import whole_numbers

PLACES = 31  # along each link
MOST_AMOUNTS = 7_500  # numbers in all, of which the instants are as many as leave room for
MOST_INSTANTS = 1_200


def instants_for(mechanism: Mechanism, numbers: list[int]) -> int:
    """At how many instants these links are told of."""
    shapes = sum(mechanism.links[number].modes for number in numbers)
    return int(min(MOST_INSTANTS, MOST_AMOUNTS / max(shapes, 1)))


def shapes_told(mechanism: Mechanism, number: int, straight: np.ndarray | None = None) -> dict[str, Any]:
    """Deflection, bending moment and shear force along a link by its shapes, each over its scale.

    straight (places, places): what takes from a deflection the part that is none.
    """
    link = mechanism.system.links[number]
    x = np.linspace(0.0, link.length, PLACES)
    across = link.shapes.displacements(x)[:, :, 1]
    found = {}
    tables = {
        "shape": across if straight is None else across @ straight,
        "moment": link.shapes.carried("moments", x),
        "shear": link.shapes.carried("shears", x),
    }
    bends = slice(mechanism.links[number].modes)  # axial shapes come after these
    for name, table in tables.items():
        scale = np.maximum(np.abs(table[bends]).max(axis=1, initial=0.0), 1e-300)
        found |= {
            f"{name}Of{number}": whole_numbers(table[bends] / scale[:, None]),
            f"{name}ScaleOf{number}": scale,
        }
    return found


def amounts_told(mechanism: Mechanism, number: int, coordinates: np.ndarray) -> dict[str, Any]:
    """Amounts of its shapes (bend instants, shapes) [m kg^1/2], of all coordinates (instants, size)."""
    start = int(mechanism.system.offsets[number]) + 3
    return {f"amountsOf{number}": whole_numbers(coordinates[:, start : start + mechanism.links[number].modes])}


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
