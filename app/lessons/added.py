"""Lessons of a server's own folder, which are checked before anybody sees them."""

from pathlib import Path

from .checking import check
from .document import document_of, text_of
from .lesson import Lesson
from .problems import Problem, Problems
from .shipped import ADDED, shipped_names


def add(folder: Path) -> list[tuple[Path, Problem]]:
    """Put the lessons of a folder and their translations behind those of the program, as they are now; none of them
    where anything is wrong, which is the answer, by file and line.

    Raises FileNotFoundError where there is no lesson file, OSError where the folder cannot be read.
    """
    paths = [path for path in folder.iterdir() if _may_be_lesson(path)]
    if not paths:
        raise FileNotFoundError
    found: dict[str, dict[str, Lesson]] = {}
    wrong: list[tuple[Path, Problem]] = []
    for path in sorted(
        paths, key=lambda each: (each.name.count("."), each.name)
    ):  # translations behind their originals
        lesson, problems, _ = check(path)
        if lesson is not None and not problems:
            problems = _misnamed(path, lesson)
            found.setdefault(lesson.lesson, {})[lesson.language] = lesson
        wrong += [(path, each) for each in problems]
    if not wrong:
        ADDED.update(found)
    return wrong


def _may_be_lesson(path: Path) -> bool:
    """A file, as a pipe would be waited for, and none that says what is in the folder."""
    named = path.suffix == ".md" and not path.name.startswith(".") and path.stem.lower() != "readme"
    return named and path.is_file()


def _misnamed(path: Path, lesson: Lesson) -> Problems:
    """The file has the name by which its lesson is opened, and that no other one has."""
    problems = Problems()
    language = f".{lesson.language}" if lesson.translates else ""
    if path.name != (name := f"{lesson.lesson}{language}.md"):
        problems.add(1, "file-elsewhere", value=path.name, name=name)
    if lesson.lesson in shipped_names() and not lesson.translates:
        _, line = document_of(text_of(path), Problems()).head["lesson"]
        problems.add(line, "name-shipped", value=lesson.lesson)
    return problems
