"""What the page cannot take or answer, as a note: the browser says it in the language of its visitor."""

from collections.abc import Mapping
from typing import Any

from solvers import SceneError
from solvers.text.catalogue import SOURCE, spoken
from solvers.text.notes import Note, Severity

from .catalogues import page

SOME_TEXT = "refused.some-text"  # said in place of a value that is more than a word


class Refused(ValueError):
    """A code of `app/text/*/page`, and values for its sentence; `str` is that sentence for who runs this process."""

    def __init__(self, code: str, /, **values: Any):
        super().__init__(code)
        self.note = note(code, **values)

    def __str__(self) -> str:
        return said(self.note.table(), spoken())


def said(note: Mapping[str, Any], language: str) -> str:
    """The sentence of a note, as it stands in JSON, with the page's names for things."""
    return page(language).text(note["code"], **note["values"])


def note(code: str, /, **values: Any) -> Note:
    """A sentence of the page by its code."""
    return Note(code, Severity.REFUSAL, **values)


def reason_of(error: ValueError) -> dict[str, Any]:
    """Why something cannot be, for JSON, from whatever was raised to say so."""
    known = isinstance(error, Refused | SceneError)
    return (error.note if known else note("refused.other", why=str(error))).table()


def raised_again(reason: dict[str, Any]) -> Refused:
    """What another process gave as the reason, to be raised in this one."""
    return Refused(reason["code"], **reason["values"])


def code_or(code: str, otherwise: str) -> str:
    """A code, if it has a text; what stands instead of it, if not."""
    return code if code in page(SOURCE).texts else otherwise
