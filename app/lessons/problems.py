"""What is wrong with a lesson file: all of it, each with its line."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

from solvers import SceneError
from solvers.text.catalogue import SOURCE, spoken
from solvers.text.notes import Note, Severity

from ..text.catalogues import lessons


def on_one_line(words: str) -> str:
    """What comes from a file may have any letters in it."""
    return " ".join("".join(letter if letter.isprintable() else " " for letter in words).split())


class Problem(NamedTuple):
    """One thing that cannot be; `line` counts from 1."""

    line: int
    note: Note

    def said(self, language: str = SOURCE) -> str:
        """Its sentence, on one line, in letters that a terminal can show."""
        return on_one_line(lessons(language).text(self.note.code, **self.note.values))

    def table(self) -> dict[str, Any]:
        """For JSON: line, code, values, and the sentence in the language of this process."""
        found = self.note.table()
        return {"line": self.line, "code": found["code"], "values": found["values"], "sentence": self.said(spoken())}


class LessonError(ValueError):
    """A lesson file that cannot be taken; `problems` are in the order of their lines."""

    def __init__(self, problems: list[Problem]):
        super().__init__()
        self.problems = tuple(sorted(problems, key=lambda each: each.line))

    def __str__(self) -> str:
        return "\n".join(f"{each.line}: {each.said(spoken())}" for each in self.problems)


class Problems(list[Problem]):
    """Those found so far."""

    def add(self, line: int, code: str, **values: Any) -> None:
        """A sentence of `app/text/*/lessons`, by the rest of its code."""
        self.append(Problem(line, Note(f"lesson.{code}", Severity.REFUSAL, **values)))

    @contextmanager
    def refused(self, line: int) -> Iterator[None]:
        """What is refused meanwhile, by key, value and what is allowed, is a problem of this line."""
        try:
            yield
        except SceneError as refusal:
            self.append(Problem(line, refusal.note))

    def settle(self) -> None:
        """Raises LessonError if there are any."""
        if self:
            raise LessonError(self)


def wanted(code: str, **values: Any) -> Note:
    """What may be given, for the end of a refusal."""
    return Note(f"lesson.wanted.{code}", Severity.REFUSAL, **values)
