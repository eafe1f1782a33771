"""Keys that scenes differ by: their units, what numbers they take, and columns of these."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import validation
from ..scene import Scene
from ..solve import read_method
from ..validation import SceneError, allowed

WIDE = 100.0  # times the lowest value: ranges from there on are spaced by a factor
MOST = 1_000_000  # values of a column


def spaced(low: float, high: float, count: int = 21, spacing: str | None = None) -> np.ndarray:
    """`count` values from `low` to `high`; evenly, or by a constant factor if `spacing` is "log".

    Without `spacing`: "log" where the range is a hundredfold or more.
    """
    validation.whole_number("count", count, 2, MOST)
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise SceneError("range", (low, high), allowed("range"))
    if spacing is None:
        spacing = "log" if low > 0.0 and high / low >= WIDE else "linear"
    validation.choice("spacing", spacing, ("linear", "log"))
    if spacing == "log":
        if low <= 0.0:
            raise SceneError("range", low, allowed("above-zero"))
        return np.geomspace(low, high, count)
    return np.linspace(low, high, count)


def numbers_of(key: str, values: Any) -> np.ndarray:
    """Values as an array. Raises SceneError for words, or rows of unequal length."""
    try:
        return np.asarray(values, float)
    except (TypeError, ValueError):
        raise SceneError(key, values, allowed("list", low=1, high=MOST, of="numbers")) from None


def columns_of(given: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """A column of numbers for each key, all of one length. Raises SceneError."""
    columns = {key: numbers_of(key, values) for key, values in given.items()}
    for key, values in columns.items():
        first = next(iter(columns))
        if values.ndim != 1 or not 1 <= values.size <= MOST:
            reason = allowed("list", low=1, high=MOST, of="numbers")
            raise SceneError(key, f"an array of shape {values.shape}", reason)
        if values.size != columns[first].size:
            reason = allowed("as-many-values", key=first, count=columns[first].size)
            raise SceneError(key, f"{values.size} values", reason)
    if not columns:
        raise SceneError("columns", "nothing", allowed("some-columns"))
    return columns


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
