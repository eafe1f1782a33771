"""What may be given: one check per kind of value, one sentence per refusal."""

import math
from collections.abc import Iterable, Mapping


class SceneError(ValueError):
    """A value that cannot be used: which key, what it got, what is allowed."""

    def __init__(self, key: str, value: object, allowed: str):
        self.key, self.value, self.allowed = key, value, allowed
        super().__init__(f"{key}: got {_shown(value)}; allowed: {allowed}")


def _shown(value: object) -> str:
    try:
        text = "nothing" if value is None else repr(value)
    except (ValueError, RecursionError):  # an endless whole number, tables within tables without end
        text = f"a {type(value).__name__} too long to show"
    return text if len(text) <= 60 else text[:57] + "..."


def number(key: str, value: object, low: float, high: float, unit: str = "") -> float:
    """A finite number in [low, high]."""
    allowed = f"a number from {low:g} to {high:g}" + (f" {unit}" if unit else "")
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise SceneError(key, value, allowed)
    try:
        checked = float(value)
    except OverflowError:
        raise SceneError(key, value, allowed) from None
    if not math.isfinite(checked) or not low <= checked <= high:
        raise SceneError(key, value, allowed)
    return checked


def whole_number(key: str, value: object, low: int, high: int) -> int:
    """A whole number in [low, high]."""
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        raise SceneError(key, value, f"a whole number from {low} to {high}")
    return value


def choice(key: str, value: object, options: Iterable[str]) -> str:
    """One of a few words."""
    options = tuple(options)
    if not isinstance(value, str) or value not in options:
        raise SceneError(key, value, ", ".join(repr(option) for option in options))
    return value


def text(key: str, value: object, longest: int = 300) -> str:
    """A line of text."""
    if not isinstance(value, str) or len(value) > longest:
        raise SceneError(key, value, f"text of at most {longest} characters")
    return value


def table(key: str, value: object, keys: Iterable[str]) -> Mapping[str, object]:
    """A table with no other keys than these."""
    keys = tuple(keys)
    if not isinstance(value, Mapping):
        raise SceneError(key, value, "a table with " + ", ".join(keys))
    for name in value:
        if name not in keys:
            full = f"{key}.{name}" if key else str(name)
            raise SceneError(full, value[name], "no such key; the keys are " + ", ".join(keys))
    return value


def required(key: str, given: Mapping[str, object], name: str, allowed: str) -> object:
    """The value of a key that must be there."""
    if name not in given:
        raise SceneError(f"{key}.{name}" if key else name, None, f"{allowed} (the key is missing)")
    return given[name]
