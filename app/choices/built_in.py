"""Built-in scenes with other values of their bodies, before all other choices."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import lru_cache
from typing import Any

import param

from solvers import Scene, SceneError
from solvers.bodies import AnyBody
from solvers.validation import shown

from ..text.refusals import Refused
from .bodies import is_key, parts_of, read_values, title_of_value, with_values
from .choices import SCENES, SOLVED_BY, Choices, title_of
from .own import KEPT, is_own

# by key of scene files: the choice that sets it
SET_BY = {"target.at": "place", "target.struck.at": "place"} | {key: name for name, key in Choices.KEYS.items()}


@contextmanager
def named_as_on_the_page() -> Iterator[None]:
    """What is refused by a key of scene files is refused by what the page calls it, if it has a name there."""
    try:
        yield
    except SceneError as refusal:
        key = refusal.key
        if key not in SET_BY and not is_key(key):
            raise
        called = title_of(SET_BY[key]) if key in SET_BY else title_of_value(key)
        given = {"value": shown(refusal.value), "allowed": refusal.reason.table()}
        raise Refused("refused.value", key=called, **given) from None


def base_of(name: str, bodies: str = "") -> Scene:
    """Raises ValueError, for the visitor. Of those that visitors make, which may take MB each, few are kept."""
    return _of_visitor(name, bodies) if bodies or is_own(name) else SCENES[name]


@lru_cache(maxsize=2 * KEPT)
@named_as_on_the_page()
def _of_visitor(name: str, bodies: str) -> Scene:
    return with_values(SCENES[name], read_values(bodies))


def struck_body(chosen: Mapping[str, Any]) -> AnyBody | None:
    """The target of the chosen scene; None where there is no such scene, which the visitor sees where it is solved."""
    try:
        return base_of(chosen["scene"], chosen["bodies"]).target
    except ValueError:
        return None


@lru_cache(maxsize=512)
def body_keys(name: str) -> tuple[str, ...]:
    """All values of its bodies that can be set in a built-in scene."""
    return tuple(f"{part.key}.{quantity}" for part in parts_of(SCENES[name]) for quantity in part.quantities)


@lru_cache(maxsize=1024)
def keyed(name: str, bodies: str) -> dict[str, Any]:
    """The choices that are a value in the table of one of a scene's bodies, and this value."""
    scene, found = base_of(name, bodies), {}
    for choice, key in Choices.KEYS.items():
        body, _, quantity = key.partition(".")
        if quantity in getattr(scene, body).KEYS and _takes(scene, key, _extreme(choice)):
            found[choice] = getattr(getattr(scene, body), quantity)
    return found


@lru_cache(maxsize=512)
def able_methods(name: str, bodies: str) -> frozenset[str]:
    """Those that can solve it."""
    scene = base_of(name, bodies)
    return frozenset(method for method, kind in SOLVED_BY.items() if kind().refusal(scene) is None)


def _extreme(choice: str) -> Any:
    """The last value that a choice can have."""
    parameter = Choices.param[choice]
    return parameter.objects[-1] if isinstance(parameter, param.Selector) else parameter.bounds[1]


def _takes(scene: Scene, key: str, value: Any) -> bool:
    """Whether a scene may have this value: some keys are only for some supports."""
    try:
        scene.replace({key: value})
    except SceneError:
        return False
    return True
