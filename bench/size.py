"""How much is measured: all of it, or as little as shows that it still runs (`python -m bench --small`)."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TypeVar

T = TypeVar("T")
_small = False


@contextmanager
def small() -> Iterator[None]:
    """Within this, every part measures little: once, of one case of each kind, in short."""
    global _small
    before, _small = _small, True
    try:
        yield
    finally:
        _small = before


def of(whole: T, little: T) -> T:
    """Which of both is measured."""
    return little if _small else whole


def some(cases: Any, count: int = 1) -> Any:
    """All cases of a sequence or of a dictionary, or the first ones of them."""
    if not _small:
        return cases
    return dict(list(cases.items())[:count]) if isinstance(cases, dict) else cases[:count]
