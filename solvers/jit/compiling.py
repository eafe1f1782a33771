"""Who has kernels compiled, and who only takes those that are."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager


class NotCompiled(Exception):
    """A kernel is wanted that is not in the cache yet, by who would rather have it compiled elsewhere."""


_thread = threading.local()


@contextmanager
def compiled_only() -> Iterator[None]:
    """Within this context, and this thread, kernels are loaded from the cache; one that is not there: NotCompiled.

    Numba compiles under one lock for all threads, for seconds: a server must not.
    """
    _thread.only_compiled = True
    try:
        yield
    finally:
        _thread.only_compiled = False


def refuse(function: Callable) -> None:
    """Asked before a kernel of the library is compiled.

    Raises:
        NotCompiled: this thread is within `compiled_only()`.
    """
    if getattr(_thread, "only_compiled", False):
        raise NotCompiled(function.__qualname__)
