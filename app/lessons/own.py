"""A lesson of a visitor's own, as the server reads it for the page: the text is checked, answered, and not kept."""

import json

from .answers import solves, unsolved
from .checking import tried
from .document import decoded
from .problems import LessonError, Problem
from .reading import Read, read_text
from .record import lesson_record

MOST_PROBLEMS = 60  # that are listed; who has more begins with these
LONGEST = 400  # letters of a sentence
TRY_SECONDS = 8.0  # of computing for the scenes of all steps


def read_own(content: bytes, language: str) -> str:
    """JSON: `lesson`, as the page draws it, or `problems`, each [line, sentence], and how many there are, `count`."""
    try:
        return _json({"lesson": lesson_record(_read(content).lesson)})
    except LessonError as error:
        return _refusal(error.problems, language)


def try_own(content: bytes, language: str) -> str:
    """The same of the scenes of a lesson that can be read: `problems`, or `whole`, whether all of them were tried; the
    `lesson` again where answers were solved for. One whose answers could not be is refused.
    """
    found = _read(content)
    lesson, problems, whole = tried(found, TRY_SECONDS)
    for part in unsolved(lesson) if not problems else ():
        problems.add(part.line, "answer-untried", name=part.name, seconds=TRY_SECONDS)
    if problems:
        return _refusal(LessonError(problems).problems, language)
    return _json({"whole": whole} | ({"lesson": lesson_record(lesson)} if solves(lesson) else {}))


def _read(content: bytes) -> Read:
    return read_text(decoded(content))


def _refusal(problems: tuple[Problem, ...], language: str) -> str:
    said = [[each.line, each.said(language)[:LONGEST]] for each in problems[:MOST_PROBLEMS]]
    return _json({"problems": said, "count": len(problems)})


def _json(found: dict) -> str:
    return json.dumps(found, separators=(",", ":"))  # in ASCII: half of a letter is no UTF-8
