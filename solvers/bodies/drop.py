"""Bodies that are dropped: a height in a scene file in place of a velocity."""

import math
from collections.abc import Mapping
from typing import Any

from .. import validation
from ..validation import SceneError, allowed

STANDARD_GRAVITY = 9.80665  # [m/s2]
HEIGHT_RANGE = (1e-12, 1e6)  # [m]
GRAVITY_RANGE = (1e-6, 1e6)  # [m/s2]
KEYS = ("height", "gravity")
DROPPED = ("mass", "sphere", "rod", "rods", "beam")  # kinds that fall on an axis


def fallen(given: Mapping[str, Any], kind: str) -> Mapping[str, Any]:
    """The table of an impactor with the `velocity` that it has after its fall, sqrt(2 g h), in place of its `height`.

    Nothing resists it; while it touches, its weight is left out. Raises SceneError naming the key.
    """
    if not any(key in given for key in KEYS):
        return given
    if kind not in DROPPED:
        key = next(key for key in KEYS if key in given)
        raise SceneError(f"impactor.{key}", given[key], allowed("dropped", kinds=list(DROPPED)))
    if "velocity" in given:
        raise SceneError("impactor.velocity", given["velocity"], allowed("height-or-velocity"))
    height, gravity = height_and_gravity(given)
    rest = {key: value for key, value in given.items() if key not in KEYS}
    return rest | {"velocity": math.sqrt(2.0 * gravity * height)}


def height_and_gravity(given: Mapping[str, Any]) -> tuple[float, float]:
    """Of a dropped impactor, [m] and [m/s2]."""
    height = validation.required_number("impactor", given, "height", *HEIGHT_RANGE, "m")
    gravity = validation.number("impactor.gravity", given.get("gravity", STANDARD_GRAVITY), *GRAVITY_RANGE, "m/s2")
    return height, gravity
