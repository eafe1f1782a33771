"""What may be given: one check per kind of value, one sentence per refusal."""

import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

from .text.notes import Note, Severity

DEEPEST = 20  # tables within tables; no scene goes as deep


class SceneError(ValueError):
    """A value that cannot be used: which key, what it got, what is allowed.

    What is in a list goes by its number, from 1 on, as in `Scene.replace`; `of` is the name of what the key belongs to.
    """

    def __init__(self, key: str, value: object, reason: str | Note, of: str = ""):
        super().__init__()
        self.key, self.value, self.of = key, value, of
        self.reason = reason if isinstance(reason, Note) else allowed("other", allowed=reason)

    def __str__(self) -> str:
        return str(self.note)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self)!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (type(self), self.__dict__)

    @property
    def note(self) -> Note:
        """The same as a note."""
        values = {"key": self.key, "of": self.of or "none", "value": shown(self.value)}
        return Note("refusals.value", Severity.REFUSAL, **values, allowed=self.reason.table())

    @property
    def allowed(self) -> str:
        """What is allowed, in words."""
        return str(self.reason)


def _again(kind: type[SceneError], state: dict[str, Any]) -> SceneError:
    """One that comes from another process."""
    error = kind.__new__(kind)
    error.__dict__.update(state)
    return error


def shown(value: object) -> str:
    """A value as it was given, in few characters."""
    try:
        text = "nothing" if value is None else repr(value)
    except (ValueError, RecursionError):  # an endless whole number, tables within tables without end
        text = "[...]" if isinstance(value, list) else "{...}" if isinstance(value, dict) else "..."
    return text if len(text) <= 60 else text[:57] + "..."


@contextmanager
def naming(name: str) -> Iterator[None]:
    """What is refused meanwhile is said to belong to what has this name."""
    try:
        yield
    except SceneError as error:
        raise type(error)(error.key, error.value, error.reason, error.of or name) from None


def allowed(code: str, **values: Any) -> Note:
    """What may be given, by a code of `solvers/text/en/allowed.toml`."""
    return Note(f"allowed.{code}", Severity.REFUSAL, **values)


def bound_beside(bound: float, refused: object, digits: int = 6) -> float:
    """A bound in as few digits, from so many on, as leave the refused value outside."""
    if not isinstance(refused, (int, float)) or refused == bound:
        return bound
    for more in range(digits, 17):
        rounded = float(f"{bound:.{more}g}")
        if (rounded > refused) == (bound > refused) and rounded != refused:
            return rounded
    return bound


def a_number(low: float, high: float, unit: str = "", inside: str = "nothing", refused: object = None) -> Note:
    """That a number in [low, high] is allowed, and so not the one that is refused; `inside` the rod or the record, if
    those are its bounds."""
    shown = [bound_beside(bound, refused) for bound in (low, high)]
    digits = next(n for n in (6, 15, 17) if n == 17 or all(float(f"{bound:.{n}g}") == bound for bound in shown))
    if digits == 6 or refused is None:
        return allowed("number", low=low, high=high, digits=6, unit=unit or "none", inside=inside)
    return allowed("number", low=shown[0], high=shown[1], digits=digits, unit=unit or "none", inside=inside)


def number(key: str, value: object, low: float, high: float, unit: str = "", inside: str = "nothing") -> float:
    """A finite number in [low, high], Python's or NumPy's."""
    value = plain(value)
    try:
        checked = float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else math.nan
    except OverflowError:
        checked = math.inf
    if not math.isfinite(checked) or not low <= checked <= high:
        raise SceneError(key, value, a_number(low, high, unit, inside, value))
    return checked


def whole_number(key: str, value: object, low: int, high: int) -> int:
    """A whole number in [low, high], Python's or NumPy's."""
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        raise SceneError(key, value, allowed("whole-number", low=low, high=high))
    return value


def choice(key: str, value: object, options: Iterable[str]) -> str:
    """One of a few words."""
    options = tuple(options)
    if not isinstance(value, str) or value not in options:
        raise SceneError(key, value, allowed("choice", options=list(options)))
    return value


def flag(key: str, value: object) -> bool:
    """true or false."""
    value = plain(value)
    if not isinstance(value, bool):
        raise SceneError(key, value, allowed("flag"))
    return value


def text(key: str, value: object, longest: int = 300) -> str:
    """A line of text."""
    if not isinstance(value, str) or len(value) > longest:
        raise SceneError(key, value, allowed("text", longest=longest))
    return value


def table(key: str, value: object, keys: Iterable[str]) -> Mapping[str, Any]:
    """A table with no other keys than these."""
    keys = tuple(keys)
    if not isinstance(value, Mapping):
        raise SceneError(key, value, allowed("table", keys=", ".join(keys)))
    for name in value:
        if name not in keys:
            full = f"{key}.{name}" if key else str(name)
            raise SceneError(full, value[name], allowed("key", keys=", ".join(keys)))
    return value


def required(key: str, given: Mapping[str, Any], name: str, what: Note) -> object:
    """The value of a key that must be there."""
    if name not in given:
        raise SceneError(f"{key}.{name}" if key else name, None, allowed("missing-key", what=what.table()))
    return given[name]


def required_number(key: str, given: Mapping[str, Any], name: str, low: float, high: float, unit: str = "") -> float:
    """A finite number in [low, high] that must be there."""
    value = given[name] if name in given else required(key, given, name, a_number(low, high, unit))
    return number(f"{key}.{name}", value, low, high, unit)


def plain(value: Any, levels: int = DEEPEST) -> Any:
    """Tables within tables and lists, none of them shared, with Python's numbers and lists for NumPy's."""
    if type(value) in (str, float, int):  # most are
        return value
    if isinstance(value, np.floating):  # of an extended one `tolist` makes no number of Python
        return float(value)
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, Mapping) and levels:
        return {key: plain(each, levels - 1) for key, each in value.items()}
    if type(value) in (list, tuple) and levels:
        found = [plain(each, levels - 1) for each in value]
        return found if isinstance(value, list) else tuple(found)
    return value


def entry(table: dict | list, name: str, key: str, value: Any) -> Any:
    """What has this name in a table, an empty one if nothing has, or this number in a list."""
    if isinstance(table, dict):
        return table.setdefault(name, {})
    if not (name.isdecimal() and 1 <= int(name) <= len(table)):
        raise SceneError(key, value, allowed("number-in-list", count=len(table)))
    return table[int(name) - 1]
