"""What the page asks to be solved: its choices, decoded once where a worker takes them up."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

from solvers import Scene
from solvers.methods.multibody.method import Multibody

from .kinds import kind_of
from .opened import Opening, opening_of
from .scene_of import acting_choices, chosen_scene, own_choices

DRAFT = "draft"  # key, beside the choices, of the share of the resolution that will do while a slider moves
IN_VIEW = (
    "time_in_view"  # key, beside the choices, of the stretch of time that histories are sampled for, "START END" [s]
)
SOLVED = ("method", "modes", "elements", "shapes", "floating_frame", "motion_seconds", "motion_links")  # how it is
LEAST = 4  # modes or elements of a draft, where as many are chosen


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
    share: float = 1.0  # of the modes, elements and steps chosen that it is solved by: less than 1 in a draft
    stretch: tuple[float, float] | None = None  # of time that histories are sampled for [s]; None: all of it

    @classmethod
    def of(cls, chosen: dict[str, Any]) -> "Request":
        """Raises SceneError for choices that describe no scene."""
        share, looked_at = chosen.get(DRAFT, 1.0), chosen.get(IN_VIEW, "")
        chosen = {name: value for name, value in chosen.items() if name not in (DRAFT, IN_VIEW)}
        start, end = map(float, looked_at.split()) if looked_at else (0.0, 0.0)
        own = {name: chosen[name] for name in ("method", "restitution")}
        counts = {name: max(round(share * chosen[name]), min(LEAST, chosen[name])) for name in ("modes", "elements")}
        stretch = (start, end) if end > start else None
        return cls(scene=chosen_scene(chosen), chosen=chosen, share=share, stretch=stretch, **own, **counts)

    @property
    def draft(self) -> bool:
        """Whether it is solved more coarsely than chosen."""
        return self.share < 1.0

    @property
    def kind(self) -> str:
        """Of scene, by its name in messages."""
        return kind_of(self.scene).NAME

    @property
    def exact(self) -> bool:
        """Whether an exact solution is shown."""
        return kind_of(self.scene).EXACT

    @property
    def own(self) -> dict[str, Any]:
        """The choices with which the page opens the scene with these bodies."""
        return own_choices(self.chosen["scene"], self.chosen["bodies"])

    @property
    def changed(self) -> bool:
        """Whether bodies or contact are not those of the scene as it comes, however it is solved."""
        alike = own_choices(self.chosen["scene"], "") | {name: self.chosen[name] for name in SOLVED}
        now, own = self.scene.table(), chosen_scene(alike).table()
        return any(now[part] != own[part] for part in ("impactor", "target", "contact"))

    @property
    def acting(self) -> list[str]:
        """The choices that change anything in this scene."""
        return acting_choices(self.chosen)

    def opening(self, notes: Collection[str] = ()) -> Opening:
        """What it is opened with, what can be tried and what can be asked of it; `notes`: codes of its solution."""
        kind, opened, acting = kind_of(self.scene), opening_of(self.chosen["scene"]), self.acting
        tries = kind.trials(self.scene, self.chosen, opened.trials, notes)
        asks = kind.comparisons(self.scene, self.chosen, self.own)
        return opened._replace(
            trials=tuple(each for each in tries if each.choice in acting and self.chosen[each.choice] != each.value),
            comparisons=(
                *(each for each in asks if each.first != each.second and each.first.keys() <= {*acting}),
                *opened.comparisons,
            ),
        )

    @property
    def method_beside(self) -> str:
        """The method shown beside the exact solution: the chosen one; modes where that is waves, or cannot be."""
        return self.method if self.method not in ("waves", Multibody.NAME) else "modal"
