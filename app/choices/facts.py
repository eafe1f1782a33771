"""What the page must know of a scene of a visitor's own, without having the scene.

To read one takes up to seconds and megabytes. A server has a worker do it, and has these; whoever has no event loop to
keep free reads where it is asked.
"""

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any
from weakref import WeakValueDictionary

from ..text.refusals import Refused

MOST = 64  # that are kept, of some kB each, for who reads where it is asked


@dataclass(frozen=True, eq=False)
class Facts:
    """Of a scene by its name."""

    name: str
    refused: dict[str, Any] | None = None  # why it cannot be, as a note
    values: dict[str, Any] = field(default_factory=dict)  # the choices that it asks for
    kind: str = ""  # of scene, by its name in messages
    views: tuple[str, ...] = ()  # that it is opened with

    def check(self) -> None:
        """Raises Refused where it cannot be."""
        if self.refused is not None:
            raise Refused(self.refused["code"], **self.refused["values"])


READERS: list[Callable[[str], Facts]] = []  # the one that reads, of who knows all choices
_KNOWN: WeakValueDictionary[str, Facts] = WeakValueDictionary()  # while anybody has them
_KEPT: OrderedDict[str, Facts] = OrderedDict()


def known_facts(name: str) -> Facts | None:
    """Those that somebody has."""
    return _KNOWN.get(name)


def keep(facts: Facts) -> Facts:
    """Of another process; the same that are known of this name. They are known while who calls this has them."""
    return _KNOWN.setdefault(facts.name, facts)


def facts_of(name: str) -> Facts:
    """Those that are known, or read now."""
    if (found := _KNOWN.get(name)) is None:
        found = _KEPT[name] = keep(READERS[0](name))
        while len(_KEPT) > MOST:
            _KEPT.popitem(last=False)
    return found
