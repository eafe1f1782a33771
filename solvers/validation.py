"""What may be given: one check per kind of value, one sentence per refusal."""

import math
from collections.abc import Iterable, Mapping
from typing import Any

from .text.notes import Note, Severity


class SceneError(ValueError):
    """A value that cannot be used: which key, what it got, what is allowed."""

    def __init__(self, key: str, value: object, allowed: str | Note):
        self.key, self.value = key, value
        self.reason = allowed if isinstance(allowed, Note) else _allowed("other", allowed=allowed)
        self.allowed = str(self.reason)
        super().__init__(f"{key}: got {shown(value)}; allowed: {allowed}")


def shown(value: object) -> str:
    """A value as it was given, in few characters."""
    try:
        text = "nothing" if value is None else repr(value)
    except (ValueError, RecursionError):  # an endless whole number, tables within tables without end
        text = f"a {type(value).__name__} too long to show"
    return text if len(text) <= 60 else text[:57] + "..."


def refused(error: SceneError) -> Note:
    """The same as a note."""
    values = {"key": error.key, "value": shown(error.value), "allowed": error.reason.table()}
    return Note("refusals.value", Severity.REFUSAL, **values)


def _allowed(code: str, **values: Any) -> Note:
    return Note(f"allowed.{code}", Severity.REFUSAL, **values)


def number(key: str, value: object, low: float, high: float, unit: str = "") -> float:
    """A finite number in [low, high]."""
    try:
        checked = float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else math.nan
    except OverflowError:
        checked = math.inf
    if not math.isfinite(checked) or not low <= checked <= high:
        raise SceneError(key, value, _allowed("number", low=low, high=high, unit=unit or "none"))
    return checked


def whole_number(key: str, value: object, low: int, high: int) -> int:
    """A whole number in [low, high]."""
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        raise SceneError(key, value, _allowed("whole-number", low=low, high=high))
    return value


def choice(key: str, value: object, options: Iterable[str]) -> str:
    """One of a few words."""
    options = tuple(options)
    if not isinstance(value, str) or value not in options:
        raise SceneError(key, value, _allowed("choice", options=list(options)))
    return value


def text(key: str, value: object, longest: int = 300) -> str:
    """A line of text."""
    if not isinstance(value, str) or len(value) > longest:
        raise SceneError(key, value, _allowed("text", longest=longest))
    return value


def table(key: str, value: object, keys: Iterable[str]) -> Mapping[str, Any]:
    """A table with no other keys than these."""
    keys = tuple(keys)
    if not isinstance(value, Mapping):
        raise SceneError(key, value, _allowed("table", keys=", ".join(keys)))
    for name in value:
        if name not in keys:
            full = f"{key}.{name}" if key else str(name)
            raise SceneError(full, value[name], _allowed("key", keys=", ".join(keys)))
    return value


def required(key: str, given: Mapping[str, Any], name: str, allowed: str) -> object:
    """The value of a key that must be there."""
    if name not in given:
        raise SceneError(f"{key}.{name}" if key else name, None, _allowed("missing-key", what=allowed))
    return given[name]
