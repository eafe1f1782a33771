"""A contact law from outside of this library is looked at before kernels are compiled for it."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from numbers import Real
from types import FunctionType
from typing import Any

import numba
from numba.core.errors import NumbaError

from ..text.notes import Note
from ..validation import SceneError, allowed

MOST_CONSTANTS = 6  # as many as kernels have room for
SAYS = ("NAME", "EXPONENT", "VARIED", "KEYS", "LOSSY", "PLASTIC", "JUMPS", "read", "table", "limits", "scaled")
DAMPED, YIELDING = ("damping", "delivered", "nominal"), ("yield_indentation",)
# Of each function that kernels call, arguments as they may come, constants being 1, and how many values it returns.
ANSWERS: dict[str, tuple[tuple[Any, ...], int]] = {
    "force": ((0.5, 0.1, 0.5), 1),
    "slopes": ((0.5, 0.1, 0.5), 2),
    "stored": ((0.5, 0.5), 1),
    "dent": ((0.5,), 1),
    "corner": ((0.5, 0.5), 1),
    "mean": ((0.4, 0.5, 0.1, 0.5), 2),
    "unloading": ((0.5,), 2),
    "mean_force": ((0.4, 0.5, 0.1, 0.2, 0.3, 0.5, (0.0, 0.0)), 4),
}


def check_law(kind: Any, key: str = "contact.law") -> None:
    """Raises SceneError if a class of contact laws lacks something, or a function of it returns something else."""
    reason = None if _ours(kind) else _lacking(kind)
    if reason is not None:
        raise SceneError(key, getattr(kind, "NAME", kind.__name__), reason)


@contextmanager
def compiling(laws: tuple[Any, ...]) -> Iterator[None]:
    """What Numba cannot compile of laws from outside is said in one sentence. Raises SceneError."""
    try:
        yield
    except NumbaError as error:
        for law in laws:
            for name, function in _functions(type(law)):
                why = _uncompiled(law, name, function)
                if why is not None:
                    reason = allowed("law-compiles", law=type(law).__name__, name=name, why=why)
                    raise SceneError("contact.law", law.NAME, reason) from error
        raise


def _ours(kind: Any) -> bool:
    module = getattr(kind, "__module__", None) or ""  # what `exec` made has none
    return module.startswith(f"{__name__.partition('.')[0]}.")


@lru_cache
def _lacking(kind: Any) -> Note | None:
    """What a class of contact laws lacks, or does wrong first."""
    law, constants = kind.__name__, getattr(kind, "_fields", ())  # of a NamedTuple
    if not 1 <= len(constants) <= MOST_CONSTANTS:
        return allowed("law-tuple", law=law, most=MOST_CONSTANTS)
    more = (DAMPED if getattr(kind, "LOSSY", False) else ()) + (YIELDING if getattr(kind, "PLASTIC", False) else ())
    missing = [name for name in (*SAYS, "stiffness", *ANSWERS, *more) if not hasattr(kind, name)]
    if missing:
        return allowed("law-members", law=law, missing=missing)
    one = kind(*[1.0] * len(constants))
    return next(filter(None, (_wrong(one, name, function) for name, function in _functions(kind))), None)


def _functions(kind: Any) -> Iterator[tuple[str, FunctionType]]:
    """Those that kernels call, as far as they are plain Python from outside."""
    for name in ANSWERS:
        function = getattr(kind, name, None)
        if isinstance(function, FunctionType) and not _ours(function):
            yield name, function


def _wrong(law: Any, name: str, function: FunctionType) -> Note | None:
    """Whether a function takes what kernels give it, and returns as many values as they take."""
    arguments, count = ANSWERS[name]
    try:
        found = function(law, *arguments)
    except (TypeError, AttributeError, NameError) as error:
        return allowed("law-fails", law=type(law).__name__, name=name, why=_first_line(str(error)))
    except Exception:  # with constants like these it may
        return None
    values = found if isinstance(found, tuple) else (found,)
    numbers = values[:3] if name == "mean_force" else values  # besides them its memory
    right = isinstance(found, tuple) == (count > 1) and len(values) == count
    if right and all(isinstance(each, Real) for each in numbers):
        return None
    return allowed("law-answer", law=type(law).__name__, name=name, count=count, found=_first_line(repr(found)))


def _uncompiled(law: Any, name: str, function: FunctionType) -> str | None:
    """Why Numba cannot compile a function by itself; None if it can."""
    try:
        numba.njit(function).compile(tuple(map(numba.typeof, (law, *ANSWERS[name][0]))))
    except NumbaError as error:
        lines = [line.strip() for line in str(error).splitlines()]
        return next((line for line in lines if line and not line.startswith("Failed in ")), type(error).__name__)
    return None


def _first_line(text: str) -> str:
    return (text.splitlines() or [""])[0][:100]
