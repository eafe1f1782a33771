"""Keys that scenes differ by: their units, and what numbers they take."""

import math
from collections.abc import Mapping
from typing import Any

from ..scene import Scene
from ..solve import read_method
from ..validation import SceneError, allowed


def unit_of(scene: Scene, key: str) -> str:
    """Of a key of a scene that takes numbers, as its refusal says; "" where it has none, or none that is known."""
    try:
        scene.replace({key: math.nan})
    except SceneError as refused:
        unit = refused.reason.values.get("unit", "none")
        return "" if unit == "none" else str(unit)
    return ""


def with_values(scene: Scene, changes: Mapping[str, Any]) -> Scene:
    """The scene with other values, whose method exists with its options. Raises SceneError naming the key."""
    changed = scene.replace(changes)
    read_method(changed.method, changed)
    return changed


def takes_whole_numbers(scene: Scene, key: str, value: float) -> bool:
    """Whether the key refuses a fraction and takes the whole number next to it."""
    for tried, refused in ((value, True), (round(value), False)):
        try:
            with_values(scene, {key: tried})
        except SceneError:
            if not refused:
                return False
        else:
            if refused:
                return False
    return True


def value_of(scene: Scene, key: str) -> Any:
    """What a key of the scene holds, as given or as it follows. Raises SceneError if nothing is there."""
    for tables in (scene.given, scene.table()):
        found: Any = tables
        for name in key.split("."):
            if isinstance(found, Mapping):
                found = found.get(name)
            elif isinstance(found, (list, tuple)) and name.isdecimal() and 1 <= int(name) <= len(found):
                found = found[int(name) - 1]
            else:
                found = None
        if found is not None:
            return found
    if key.startswith("method."):
        options = read_method(scene.method, scene)[0].table()
        if options.get(key.removeprefix("method.")) is not None:
            return options[key.removeprefix("method.")]
    try:
        scene.replace({key: math.nan})
    except SceneError as refused:  # what is allowed
        raise SceneError(refused.key, None, refused.reason) from None
    raise SceneError(key, None, allowed("differentiable"))
