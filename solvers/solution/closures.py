"""How a solution is pickled: its motion holds functions made inside others, such as the shapes of modes, which `pickle`
does not take. They are written as where they stand in the library and what they hold; no code is written.
"""

import io
import pickle
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from types import CellType, CodeType, FunctionType
from typing import Any

from ..validation import SceneError, allowed

PACKAGE = __name__.split(".")[0]


def written(known: object) -> bytes:
    """As `read` takes it."""
    room = io.BytesIO()
    _Pickler(room, pickle.HIGHEST_PROTOCOL).dump(known)
    return room.getvalue()


def read(known: bytes) -> Any:
    """What was written. Raises SceneError where that was by other code."""
    return pickle.loads(known)


class _Pickler(pickle.Pickler):
    def reducer_override(self, obj: Any) -> Any:
        if isinstance(obj, FunctionType) and "<locals>" in obj.__qualname__ and obj.__module__.startswith(PACKAGE):
            number = _codes(obj.__module__).index(obj.__code__)
            cells = [_held(cell) for cell in obj.__closure__ or ()]
            held = (obj.__defaults__, obj.__kwdefaults__, cells)
            return _made, (obj.__module__, number, obj.__qualname__), held, None, None, _filled
        return NotImplemented


def _held(cell: CellType) -> tuple[Any, ...]:
    try:
        return (cell.cell_contents,)
    except ValueError:  # nothing yet
        return ()


def _made(module: str, number: int, name: str) -> FunctionType:
    """The function that stands there, still without what it holds: it may hold itself."""
    codes = _codes(module)
    if number >= len(codes) or codes[number].co_qualname != name:
        raise SceneError("solution", f"{module}.{name}", allowed("same-version"))
    code = codes[number]
    cells = tuple(CellType() for _ in code.co_freevars)
    made = FunctionType(code, vars(import_module(module)), code.co_name, None, cells)
    made.__qualname__ = name
    return made


def _filled(function: FunctionType, held: tuple[Any, ...]) -> None:
    function.__defaults__, function.__kwdefaults__, cells = held
    for cell, content in zip(function.__closure__ or (), cells, strict=True):
        if content:
            cell.cell_contents = content[0]


@cache
def _codes(module: str) -> list[CodeType]:
    """All code in the file of a module, in the order in which it stands."""
    found = find_spec(module)
    assert found is not None and found.loader is not None
    whole = found.loader.get_code(module)  # type: ignore[attr-defined]
    return list(_within(whole))


def _within(code: CodeType) -> Iterator[CodeType]:
    yield code
    for part in code.co_consts:
        if isinstance(part, CodeType):
            yield from _within(part)
