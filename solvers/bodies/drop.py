"""Bodies that are dropped, or fly under gravity: a height in place of a velocity, and the weight of what falls."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import validation
from ..validation import SceneError, allowed
from .linkage.mechanism import Mechanism
from .protocol import AnyBody

STANDARD_GRAVITY = 9.80665  # [m/s2]
HEIGHT_RANGE = (1e-12, 1e6)  # [m]
GRAVITY_RANGE = (1e-6, 1e6)  # [m/s2]
KEYS = ("height", "gravity")
DROPPED = ("mass", "sphere", "rod", "rods", "beam")  # kinds that fall on an axis


def fallen(given: Mapping[str, Any], kind: str) -> Mapping[str, Any]:
    """The table of an impactor without `height` and `gravity`, with the `velocity` that it has after its fall,
    sqrt(2 g h), where a height is given. Nothing resists the fall. Raises SceneError naming the key.
    """
    if not any(key in given for key in KEYS):
        return given
    if kind not in DROPPED:
        key = next(key for key in KEYS if key in given)
        raise SceneError(f"impactor.{key}", given[key], allowed("dropped", kinds=list(DROPPED)))
    if "height" not in given:
        read_gravity(given)
        return {key: value for key, value in given.items() if key not in KEYS}
    if "velocity" in given:
        raise SceneError("impactor.velocity", given["velocity"], allowed("height-or-velocity"))
    height, gravity = height_and_gravity(given)
    rest = {key: value for key, value in given.items() if key not in KEYS}
    return rest | {"velocity": math.sqrt(2.0 * gravity * height)}


def height_and_gravity(given: Mapping[str, Any]) -> tuple[float, float]:
    """Of a dropped impactor, [m] and [m/s2]."""
    height = validation.required_number("impactor", given, "height", *HEIGHT_RANGE, "m")
    return height, read_gravity(given)


def read_gravity(given: object) -> float:
    """Of the table of an impactor, along the axis towards the target [m/s2]; zero where it says neither key."""
    if not isinstance(given, Mapping) or not any(key in given for key in KEYS):
        return 0.0
    return validation.number("impactor.gravity", given.get("gravity", STANDARD_GRAVITY), *GRAVITY_RANGE, "m/s2")


def with_gravity(given: Mapping[str, Any], target: AnyBody) -> Mapping[str, Any]:
    """The tables; what is dropped on a mechanism falls by the gravity of that, which is said of the impactor, too.

    Raises SceneError where the mechanism has none along the normal, or the impactor another.
    """
    impactor: Any = given["impactor"]
    if not isinstance(target, Mechanism) or not isinstance(impactor, Mapping) or impactor.get("kind") == Mechanism.kind:
        return given
    key = next((key for key in ("gravity", "height") if key in impactor), None)
    if key is None:
        return given
    along = float(target.frozen.normal @ np.array(target.gravity))
    own = dict(impactor) | ({"gravity": along} if "gravity" not in impactor and along > 0.0 else {})
    if not math.isclose(read_gravity(own), along, rel_tol=1e-9):
        raise SceneError(f"impactor.{key}", impactor[key], allowed("gravity-of-mechanism", along=along))
    return {**given, "impactor": own}
