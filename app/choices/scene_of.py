"""The scene that choices describe, and the choices that a scene asks for."""

from functools import lru_cache
from typing import Any

from solvers import Scene

from ..text.refusals import Refused, reason_of
from .built_in import base_of, body_keys, keyed, named_as_on_the_page
from .choices import SCENES, Choices, accepts, refusal
from .facts import READERS, Facts, facts_of
from .kinds import kind_of
from .opened import opening_of
from .own import is_own, own_scene


def choices_of(name: str, bodies: str = "") -> dict[str, Any]:
    """The values that a built-in scene asks for, each within its bounds; `bodies`: values of these that are changed."""
    if is_own(name) and not bodies:
        return facts_of(name).values | {"bodies": ""}
    return _own_values(name, bodies) | {"bodies": bodies}


def own_choices(name: str, bodies: str = "") -> dict[str, Any]:
    """A value for every choice, as the page opens a built-in scene; an address says only what differs from these."""
    if is_own(name) and not bodies:
        return _USUAL | choices_of(name) | {"scene": name}
    return dict(_all_choices(name, bodies))


def kind_name(name: str) -> str:
    """Of the kind of a scene, as it is in messages."""
    return facts_of(name).kind if is_own(name) else kind_of(SCENES[name]).NAME


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


_USUAL = Choices().chosen()


def _read(name: str) -> Facts:
    """Facts of a scene of a visitor's own."""
    try:
        scene = own_scene(name).struck
        values = _own_values(name, "")
        _check_range(name, values)
    except ValueError as refusal:
        return Facts(name, refused=reason_of(refusal))
    return Facts(name, values=values, kind=kind_of(scene).NAME, views=opening_of(name).views)


def _check_range(name: str, values: dict[str, Any]) -> None:
    """Raises Refused where something is beyond what the page has."""
    acting = acting_choices(_USUAL | values | {"scene": name, "bodies": ""})
    for each, value in _wanted(name, "").items():
        if each in acting and not accepts(each, value):
            raise Refused("refused.own-beyond", why=refusal(each, value).note)


READERS.append(_read)
