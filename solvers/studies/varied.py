"""Units of the values that scenes differ by."""

import math

from ..scene import Scene
from ..validation import SceneError


def unit_of(scene: Scene, key: str) -> str:
    """Of a key of a scene that takes numbers, as its refusal says; "" where it has none, or none that is known."""
    try:
        scene.replace({key: math.nan})
    except SceneError as refused:
        unit = refused.reason.values.get("unit", "none")
        return "" if unit == "none" else str(unit)
    return ""
