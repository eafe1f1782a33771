"""What a server has one of belongs to its event loop, so that several servers in one process do not share it."""

import asyncio
from typing import Any, TypeVar

Kind = TypeVar("Kind")
_OWNED: dict[asyncio.AbstractEventLoop, dict[type, Any]] = {}


def of_loop(kind: type[Kind]) -> Kind:
    """The one of its kind that belongs to the running event loop, made when it is first wanted."""
    owned = _OWNED.setdefault(asyncio.get_running_loop(), {})
    if kind not in owned:
        owned[kind] = kind()
    return owned[kind]


def forget(loop: asyncio.AbstractEventLoop) -> None:
    """The loop has ended, and what belongs to it."""
    _OWNED.pop(loop, None)
