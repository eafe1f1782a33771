"""What of a mechanism can be chosen on the page, and the scene with it."""

from typing import Any

from solvers import Scene
from solvers.bodies import Mechanism


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

    Raises SceneError for a place that cannot be struck.
    """
    target = base.target.table()
    target["links"] = [link | {"modes": chosen["modes"]} if link.get("modes") else link for link in target["links"]]
    target["struck"] |= {"at": chosen["place"]}
    velocity = Mechanism.read("target", target).velocity
    return {"target": target, "impactor.velocity": velocity + chosen["speed"]}
