"""What is the same for all who ask and takes up to 0.3 s to make: made once, by a thread beside the event loop."""

import asyncio
from collections.abc import Callable, Hashable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

_THREAD = ThreadPoolExecutor(1, "once")
_MADE: dict[tuple[Callable, tuple[Hashable, ...]], Any] = {}


async def made_once(make: Callable, *arguments: Hashable) -> Any:
    """`make(*arguments)`, of few arguments that there are. What it raises is raised, and nothing kept then."""
    key = make, arguments
    if key not in _MADE:
        _MADE[key] = await asyncio.get_running_loop().run_in_executor(_THREAD, make, *arguments)
    return _MADE[key]
