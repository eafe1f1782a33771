"""What is to be said of a result: a code, how grave it is, and the values of the sentence."""

from collections.abc import Mapping
from enum import StrEnum
from typing import Any

from .catalogue import library, spoken


class Severity(StrEnum):
    """What a note means for who uses the result."""

    REMARK = "remark"  # how it was found; nothing is wrong
    WARNING = "warning"  # some figure, or the model, is uncertain
    INVALID = "invalid"  # the figures that it names are not to be trusted at all
    REFUSAL = "refusal"  # there is no result: why not


class Note:
    """A note is data: programs decide by `code` and `severity`; `str(note)` is its sentence.

    The code is that of a text in `solvers/text/*/`, and `values` are what its gaps take: numbers and words of scene
    files, in SI units, as JSON keeps them.
    """

    __slots__ = ("code", "severity", "values")
    code: str
    severity: Severity
    values: dict[str, Any]

    def __init__(self, code: str, severity: Severity, /, **values: Any):
        plain = {name: value.item() if hasattr(value, "item") else value for name, value in values.items()}
        for name, value in (("code", code), ("severity", severity), ("values", plain)):
            object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a note does not change")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("a note does not change")

    def __reduce__(self) -> tuple[Any, ...]:
        return Note.from_table, (self.table(),)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Note) and self.table() == other.table()

    def __hash__(self) -> int:
        return hash(self.code)

    def __str__(self) -> str:
        return library(spoken()).text(self.code, **self.values)

    def __repr__(self) -> str:
        return f"Note({self.code!r}, {self.severity}, {self.values})"

    def table(self) -> dict[str, Any]:
        """For JSON."""
        return {"code": self.code, "severity": str(self.severity), "values": self.values}

    @classmethod
    def from_table(cls, table: Mapping[str, Any]) -> "Note":
        """The same from what `table` gave."""
        return cls(table["code"], Severity(table["severity"]), **table["values"])


def coded(notes: list[Note]) -> dict[str, list[Any]]:
    """For JSON: the sentences, and beside them what they were made of."""
    return {"notes": [str(note) for note in notes], "note_codes": [note.table() for note in notes]}
