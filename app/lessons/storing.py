"""Writes the solved answers of the lessons of the program, kept beside them: `python -m app.lessons.storing`."""

import json

from .answers import STORED
from .lesson import Boundary, Lesson, Number
from .reading import read_in_full
from .shipped import FOLDER, shipped_names

DIGITS = 12  # those behind them are of the machine


def solved_answers(lesson: Lesson) -> dict[str, list | dict]:
    """By question: [answer, answers of mistakes] of those that have a formula, and lines of boundaries."""
    found: dict[str, list | dict] = {}
    for part in (part for step in lesson.steps for part in step.parts):
        if isinstance(part, Number) and part.unsolved:
            found[part.name] = [part.answer, [each.answer for each in part.mistakes]]
        if isinstance(part, Boundary):
            found[part.name] = {"boundary": [*part.truth]}
    return found


def main() -> None:
    """Solve the scenes of all lessons whose answers are solved for."""
    from .checking import tried

    found = {}
    for name in shipped_names():
        lesson, problems, _ = tried(read_in_full(FOLDER / f"{name}.md"), float("inf"))
        problems.settle()
        if answers := solved_answers(lesson):
            found[name] = answers
    rounded = json.loads(json.dumps(found), parse_float=lambda written: float(f"{float(written):.{DIGITS}g}"))
    STORED.write_text(json.dumps(rounded, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
