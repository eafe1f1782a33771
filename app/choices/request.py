"""What the page asks to be solved: its choices, decoded once where a worker takes them up."""

from dataclasses import dataclass
from typing import Any

from solvers import Scene

from .scene_of import acting_choices, chosen_scene, kind_of, own_choices


@dataclass(frozen=True)
class Request:
    """A scene, and how it is to be solved.

    Made by the worker, not by the server: to build a scene takes 1 to 20 ms, for which all other visitors would wait.
    """

    scene: Scene
    method: str  # name
    modes: int
    elements: int
    restitution: float  # of methods that take it
    chosen: dict[str, Any]  # the choices as the page has them, which every answer repeats

    @classmethod
    def of(cls, chosen: dict[str, Any]) -> "Request":
        """Raises SceneError for choices that describe no scene."""
        own = {name: chosen[name] for name in ("method", "modes", "elements", "restitution")}
        return cls(scene=chosen_scene(chosen), chosen=chosen, **own)

    @property
    def kind(self) -> str:
        """Of scene, see `kind_of`."""
        return kind_of(self.scene)

    @property
    def own(self) -> dict[str, Any]:
        """The choices with which the page opens the scene."""
        return own_choices(self.chosen["scene"])

    @property
    def acting(self) -> list[str]:
        """The choices that change anything in this scene."""
        return acting_choices(self.chosen)

    @property
    def method_beside(self) -> str:
        """The method shown beside the exact solution: the chosen one, or modes where that is waves."""
        return self.method if self.method != "waves" else "modal"
