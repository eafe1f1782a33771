"""What of a mechanism can be chosen on the page, and the scene with it.

A joint is moved together with all ends of links that lie there; a free end of a link stays as far from its joints as it
was, and a link with one free end can be made longer there.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from solvers import Scene
from solvers.bodies import Mechanism
from solvers.bodies.linkage.links import GROUND

from .own import check_modes
from .part import Part, in_table

PLACED = ("length", "x", "y")  # quantities that no table of a scene file has as one number
TOGETHER = 1e-9  # [m] within which two points of a scene file are one
ENDS = ("from", "to")
Table = Mapping[str, Any]


def on_mechanism(scene: Scene) -> bool:
    """Whether what is struck is a link of a mechanism."""
    return isinstance(scene.target, Mechanism)


def mechanism_values(scene: Scene) -> dict[str, Any]:
    """As the scene has them: where along the struck link it is struck, and the modes of the link that has most."""
    mechanism = scene.target.known_as(Mechanism)
    modes = max(link.modes for link in mechanism.links)
    return {"place": mechanism.struck.at} | ({"modes": modes} if modes else {})


def mechanism_changes(base: Scene, chosen: dict[str, Any]) -> dict[str, Any]:
    """The keys of the scene struck at the chosen place and speed of approach, with so many modes of links that bend.

    Raises SceneError for a place that cannot be struck, Refused for more modes than there may be of all links.
    """
    target = base.target.table()
    target["links"] = [link | {"modes": chosen["modes"]} if link.get("modes") else link for link in target["links"]]
    target["struck"] |= {"at": chosen["place"]}
    check_modes({"target": target})
    velocity = base.target.known_as(Mechanism).velocity_at(chosen["place"])
    return {"target": target, "impactor.velocity": velocity + chosen["speed"]}


def mechanism_parts(scene: Scene, target: Table) -> list[Part]:
    """Its links and joints; of joints at one point only the first. `target`: its table in the scene file."""
    mechanism = scene.target.known_as(Mechanism)
    parts = []
    for number, (link, table) in enumerate(zip(mechanism.links, target["links"], strict=True), 1):
        free = len(_free_ends(target, table)) == 1 and "nodes" not in table
        known = {**table, "length": link.length} if free else table
        parts.append(Part(f"target.links.{number}", link, known, in_table(known, "mass" not in table), link.name))
    points = _points(target)
    if len(points) < 2 or any("nodes" in table for table in target["links"]):
        return parts  # it would be elsewhere, and all the same; or its lengths are those of elements
    for at in points:
        number = next(i for i, joint in enumerate(mechanism.joints) if _same(joint.at, at))
        placed = {"x": at[0], "y": at[1]}
        name = _names(target, at)
        parts.append(Part(f"target.joints.{number + 1}", mechanism.joints[number], placed, [*placed], name))
    return parts


def _points(target: Table, link: str | None = None) -> list[Sequence[float]]:
    """Where joints are, each point once: all, or those of a link."""
    found: list[Sequence[float]] = []
    for joint in target.get("joints", ()):
        if link in (None, *joint["links"]) and not any(_same(joint["at"], point) for point in found):
            found.append(joint["at"])
    return found


def _names(target: Table, at: Sequence[float]) -> str:
    """Of all links that are joined there, the ground first."""
    joined = [name for joint in target["joints"] if _same(joint["at"], at) for name in joint["links"]]
    return " – ".join(sorted(dict.fromkeys(joined), key=lambda name: name != GROUND))


def _free_ends(target: Table, link: Table) -> list[str]:
    joints = [joint["at"] for joint in target.get("joints", ()) if link["name"] in joint["links"]]
    return [end for end in ENDS if not any(_same(link[end], at) for at in joints)]


def _same(point: Sequence[float] | np.ndarray, other: Sequence[float] | np.ndarray) -> bool:
    return math.dist(point, other) <= TOGETHER


def move(target: dict[str, Any], key: str, quantity: str, value: float) -> None:
    """Set the length of a link, or where a joint is, in the table of a mechanism [m]."""
    _, group, number = key.split(".")
    given = target[group][int(number) - 1]
    if group == "links":
        (free,) = _free_ends(target, given)
        held, old = given["to" if free == "from" else "from"], given[free]
        length = math.dist(held, old)
        given[free] = [at + value * ((end - at) / length) for at, end in zip(held, old, strict=True)]
        return
    old = np.array(given["at"])
    new = np.array([value, old[1]] if quantity == "x" else [old[0], value])
    ends = {(i, end): _led(target, link, end, old, new) for i, link in enumerate(target["links"]) for end in ENDS}
    for (i, end), at in ends.items():
        target["links"][i][end] = at
    for joint in target["joints"]:
        if _same(joint["at"], old):
            joint["at"] = new.tolist()


def _led(target: Table, link: Table, end: str, old: np.ndarray, new: np.ndarray) -> list[float]:
    """Where an end of a link is after a joint was moved: with it; or as far from it, or from the next, as it was."""
    at, points = np.array(link[end]), _points(target, link["name"])
    if _same(at, old):
        return new.tolist()
    others = [np.array(point) for point in points if not _same(point, old)]
    if len(others) == len(points) or len(others) > 1 or any(_same(at, point) for point in others):
        return at.tolist()
    if not others:
        return (at + new - old).tolist()
    (hinge,) = others
    before, after = old - hinge, new - hinge
    along = (at - hinge) @ before / np.hypot(*before)
    return (hinge + along * after / (np.hypot(*after) or 1.0)).tolist()
