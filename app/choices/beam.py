"""What of a beam can be chosen on the page, and the scene with another one."""

from typing import Any

from solvers import Bending, Scene
from solvers.bodies.beams import USUAL_PLACES, free_places

BEAM_CHOICES = {  # name: how it is read from a beam
    "place": lambda beam: beam.at,
    "support": lambda beam: beam.support,
    "theory": lambda beam: beam.theory,
    "slenderness": lambda beam: float(f"{beam.slenderness:.12g}"),
}


def on_beam(scene: Scene) -> bool:
    """Whether what is struck is a beam."""
    return isinstance(scene.target, Bending)


def free_place(support: str, place: float) -> float:
    """This place along a beam, or the usual one where this support would hold it."""
    first, last = free_places(support)
    return place if first <= place <= last else USUAL_PLACES.get(support, 0.5)


def other_beam(base: Scene, chosen: dict[str, Any]) -> Scene:
    """The scene with these choices of its beam; what another support does not allow is left out.

    Raises SceneError for a place where the beam is held.
    """
    if not chosen:
        return base
    beam = base.target.known_as(Bending)
    target = beam.table()
    if "slenderness" in chosen:
        target["length"] = 2.0 * beam.half_depth * chosen["slenderness"]
    target |= {"at" if name == "place" else name: chosen[name] for name in chosen if name != "slenderness"}
    if target["support"] != "cantilever":
        target.pop("end_mass", None)
    if target["support"] != "free-free":
        target.pop("velocity", None)
    return base.replace({"target": target})
