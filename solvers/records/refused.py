"""Why a record cannot be used: one plain sentence, which says where it fails and what would do."""

from typing import Any

from ..text.notes import Note, Severity
from ..validation import SceneError


class RecordError(SceneError):
    """A record that cannot be used, by a code of `record.refused`; `value` is what it got."""

    def __init__(self, code: str, value: object, /, **values: Any):
        sentence = Note(f"record.refused.{code}", Severity.REFUSAL, **values)
        super().__init__("record", value, sentence)

    @property
    def note(self) -> Note:
        """The same as a note."""
        return self.reason
