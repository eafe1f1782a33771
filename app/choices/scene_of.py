"""The scene that choices describe, and the choices that a scene asks for."""

from functools import lru_cache
from typing import Any

from solvers import Scene

from ..text.refusals import Refused
from .built_in import base_of, body_keys, keyed, named_as_on_the_page
from .choices import Choices, accepts, refusal
from .kinds import kind_of
from .own import CHECKS


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


@named_as_on_the_page()
def chosen_scene(chosen: dict[str, Any]) -> Scene:
    """The scene that these choices describe. Raises ValueError, for the visitor, if there is none."""
    base = base_of(chosen["scene"], chosen["bodies"])
    return kind_of(base).described(base, chosen, choices_of(chosen["scene"], chosen["bodies"]))


@lru_cache(maxsize=1024)
def _all_choices(name: str, bodies: str) -> dict[str, Any]:
    return Choices(scene=name, **choices_of(name, bodies)).chosen()


@lru_cache(maxsize=1024)
def _own_values(name: str, bodies: str) -> dict[str, Any]:
    return {name: value for name, value in _wanted(name, bodies).items() if accepts(name, value)}


def _wanted(name: str, bodies: str) -> dict[str, Any]:
    scene = base_of(name, bodies)
    return kind_of(scene).values(scene) | keyed(name, bodies)


@lru_cache(maxsize=64)
def _within_the_page(name: str) -> None:
    """Raises Refused for a scene of a visitor's own in which something is beyond what the page has."""
    usual = {each: Choices.param[each].default for each in Choices.CHOSEN}
    acting = acting_choices(usual | choices_of(name) | {"scene": name})
    for each, value in _wanted(name, "").items():
        if each in acting and not accepts(each, value):
            raise Refused("refused.own-beyond", why=refusal(each, value).note)


CHECKS.append(_within_the_page)
