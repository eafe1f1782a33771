"""Warnings on many solutions: which there are, and how many solutions have each."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from ..text.notes import Note


@dataclass(frozen=True)
class Noted:
    """A warning on solutions at vertices or points of a result."""

    code: str
    count: int  # of these
    first: Note  # that of the first

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        return {"code": self.code, "count": self.count, "first": str(self.first)}


def noted(each: Iterable[Sequence[Note]]) -> list[Noted]:
    """Of the warnings on solutions, how many have which."""
    found: dict[str, list[Note]] = {}
    for notes in each:
        for note in {note.code: note for note in notes}.values():
            found.setdefault(note.code, []).append(note)
    return [Noted(code, len(notes), notes[0]) for code, notes in sorted(found.items())]
