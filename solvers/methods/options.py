"""Options of methods: a field of a method says by `option` what a scene file may give it, and what is allowed."""

from collections.abc import Callable, Iterable
from dataclasses import Field, field, fields
from typing import Any, TypeVar

from .. import validation

Reader = Callable[[str, object], Any]
Default = TypeVar("Default")


def option(default: Default, read: Reader) -> Default:
    """A field that a scene file may give; `read(key, value)` returns the value or raises SceneError."""
    found: Any = field(default=default, metadata={"read": read})
    return found


def whole(low: int, high: int) -> Reader:
    """A whole number in [low, high]."""
    return lambda key, value: validation.whole_number(key, value, low, high)


def real(low: float, high: float, unit: str = "") -> Reader:
    """A number in [low, high]."""
    return lambda key, value: validation.number(key, value, low, high, unit)


def word(options: Iterable[str]) -> Reader:
    """One of a few words."""
    options = tuple(options)
    return lambda key, value: validation.choice(key, value, options)


def options_of(method: Any) -> dict[str, Field]:
    """By name, the fields of a method (or of its class) that a scene file may give."""
    return {each.name: each for each in fields(method) if "read" in each.metadata}
