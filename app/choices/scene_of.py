"""The scene that choices describe, and the choices that a scene asks for."""

from functools import lru_cache
from typing import Any

from solvers import Scene, SceneError
from solvers.validation import shown

from ..text.refusals import Refused
from .built_in import base_of, body_keys, keyed
from .choices import Choices, accepts, title_of
from .kinds import kind_of

SET_BY = {"target.at": "place", "target.struck.at": "place"}  # by key of scene files: the choice, which the page names


def choices_of(name: str, bodies: str = "") -> dict[str, Any]:
    """The values that a built-in scene asks for, each within its bounds; `bodies`: values of these that are changed."""
    return _own_values(name, bodies) | {"bodies": bodies}


def own_choices(name: str, bodies: str = "") -> dict[str, Any]:
    """A value for every choice, as the page opens a built-in scene; an address says only what differs from these."""
    return dict(_all_choices(name, bodies))


def acting_choices(chosen: dict[str, Any]) -> list[str]:
    """The choices that change anything in the chosen scene."""
    base = base_of(chosen["scene"], chosen["bodies"])
    first = ["scene", "bodies"] if body_keys(chosen["scene"]) else ["scene"]
    return first + kind_of(base).acting(base, chosen)


def chosen_scene(chosen: dict[str, Any]) -> Scene:
    """The scene that these choices describe. Raises ValueError with a sentence for the visitor if there is none."""
    base = base_of(chosen["scene"], chosen["bodies"])
    try:
        return kind_of(base).described(base, chosen, choices_of(chosen["scene"], chosen["bodies"]))
    except SceneError as refusal:
        if refusal.key not in SET_BY:
            raise
        given = {"value": shown(refusal.value), "allowed": refusal.reason.table()}
        raise Refused("refusals.value", key=title_of(SET_BY[refusal.key]), **given) from None


@lru_cache(maxsize=1024)
def _all_choices(name: str, bodies: str) -> dict[str, Any]:
    return Choices(scene=name, **choices_of(name, bodies)).chosen()


@lru_cache(maxsize=1024)
def _own_values(name: str, bodies: str) -> dict[str, Any]:
    scene = base_of(name, bodies)
    wanted = kind_of(scene).values(scene) | keyed(name, bodies)
    return {name: value for name, value in wanted.items() if accepts(name, value)}
