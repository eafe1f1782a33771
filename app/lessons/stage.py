"""Scene and choices from step to step: what a lesson has changed so far."""

import difflib
import math
from typing import Any

import param

from solvers import LAWS, Scene
from solvers.validation import allowed, shown

from ..choices.built_in import base_of
from ..choices.choices import SCENES, Choices, accepts
from ..choices.kinds import kind_of
from ..choices.opened import possible
from ..choices.scene_of import acting_choices, own_choices
from .events import names_in
from .fields import Fields
from .problems import Problems, wanted

DROP_HEIGHT = "drop_height"  # a slider of lessons, by which the page changes the speed


def known_scene(name: object, line: int, key: str, problems: Problems) -> str | None:
    """The name of a built-in scene; of another word a problem, and None."""
    if isinstance(name, str) and name in SCENES:
        return name
    near = difflib.get_close_matches(str(name)[:60], list(SCENES), n=1)
    problems.add(line, "scene-unknown", key=key, value=shown(name), near=near[0] if near else "none")
    return None


class Stage:
    """The scene that is shown, and what is chosen in it."""

    def __init__(self, scene: str):
        self.scene, self.changes = scene, dict[str, Any]()
        self.map: tuple[str, ...] | None = None  # that is shown: its result and settings, empty for the page's own

    def own(self) -> dict[str, Any]:
        """A value for every choice."""
        return own_choices(self.scene) | self.changes

    def turn_to(self, scene: str) -> None:
        """Another scene, as it is."""
        self.scene, self.changes = scene, {}

    @property
    def kind(self) -> str:
        """Of the scene, by its name in messages."""
        return kind_of(self._base()).NAME

    @property
    def drops(self) -> bool:
        """Whether the scene lets its striker fall on what is held, from a height."""
        base = self._base()
        given = base.given.get("impactor", {})
        return "height" in given and base.target.held and base.impactor.free_mass

    def events(self) -> tuple[str, ...]:
        """Names of those that can happen."""
        return names_in(self._base())

    def _base(self) -> Scene:
        return base_of(self.scene, self.own()["bodies"])

    def acting(self) -> list[str]:
        """Settings that change anything here."""
        try:
            return acting_choices(self.own())
        except ValueError:
            return [*Choices.CHOSEN]

    def numeric(self) -> list[str]:
        """Those of them that a slider can have."""
        return [name for name in self.acting() if isinstance(Choices.param[name], param.Number)]

    def mapped(self) -> list[str]:
        """Those that can be an axis of a map; none of a restitution that is a prediction's alone."""
        law = LAWS[self.own()["law"]]
        predicted = self.kind in ("axial", "beam") and not law.LOSSY
        return [name for name in self.numeric() if not (predicted and name == "restitution")]

    def change(self, fields: Fields) -> dict[str, Any]:
        """Take the settings of a table `changes`."""
        kept = self.settings(fields, "changes")
        self.changes |= kept
        return kept

    def settings(self, fields: Fields, key: str) -> dict[str, Any]:
        """Those of a table that can be here; what cannot is noted."""
        given = fields.take(key)
        if given is None:
            return {}
        if not isinstance(given, dict):
            fields.refuse(key, given, allowed("a-table"))
            return {}
        new = {name: value for name, value in given.items() if name in Choices.CHOSEN and _can_be(name, value)}
        known = [name for name in self._with(new).acting() if name != "scene"]
        for name, value in given.items():
            full = f"{key}.{name}"
            if name not in known:
                fields.refuse(full, value, wanted("choice-here", names=known))
            elif name not in new:
                fields.refuse(full, value, possible(Choices.param[name]))
        return {name: value for name, value in new.items() if name in known}

    def _with(self, changes: dict[str, Any]) -> "Stage":
        found = Stage(self.scene)
        found.changes = self.changes | changes
        return found

    def slider(self, fields: Fields, name: str) -> str | None:
        """A setting that has a slider."""
        value, known = fields.take(name), self.numeric()
        if isinstance(value, str) and value in known:
            return value
        fields.refuse(name, value, wanted("number-choice", names=known))
        return None

    def sliders(self, fields: Fields) -> tuple[str, ...]:
        """Several of them; of what is dropped the height, too, in place of the speed."""
        return fields.names("sliders", [*self.numeric(), *([DROP_HEIGHT] if self.drops else [])]) or ()


def _can_be(name: str, value: Any) -> bool:
    return not (isinstance(value, float) and not math.isfinite(value)) and accepts(name, value)


def bounds_of(name: str) -> tuple[float, float]:
    """Of a setting that is a number."""
    bounds: Any = Choices.param[name].bounds
    return float(bounds[0]), float(bounds[1])


def value_for(fields: Fields, key: str, slider: str) -> float:
    """A value that this slider can have, which must be there."""
    low, high = bounds_of(slider)
    return fields.number(key, low, high)
