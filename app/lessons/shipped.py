"""Lessons that come with the program, and those of a server's own folder behind them."""

from pathlib import Path

from solvers.text.catalogue import SOURCE

from .answers import stored, with_answers
from .lesson import Lesson
from .reading import read

FOLDER = Path(__file__).parent / "library"
ADDED: dict[str, dict[str, Lesson]] = {}  # by name and language, the original first; see `added`


def lesson_files() -> list[Path]:
    """Those of the program, translations too."""
    return sorted(FOLDER.glob("*.md"))


def lesson_names() -> list[str]:
    """Without their translations."""
    return [*shipped_names(), *ADDED]


def lesson_languages() -> set[str]:
    """In which there is any."""
    shipped = {path.name.split(".")[1] for path in lesson_files() if path.name.count(".") == 2}
    return {SOURCE, *shipped}.union(*ADDED.values())


def shipped_names() -> list[str]:
    """Of the program alone."""
    return [path.stem for path in lesson_files() if "." not in path.stem]


def shipped_lesson(name: str, language: str = SOURCE) -> Lesson:
    """In this language, or as its original where there is no translation. Raises KeyError for another name."""
    if name in ADDED:
        return ADDED[name].get(language) or next(iter(ADDED[name].values()))
    if name not in shipped_names():
        raise KeyError(name)
    translated = FOLDER / f"{name}.{language}.md"
    found = read(translated if translated in lesson_files() else FOLDER / f"{name}.md")
    return with_answers(found, stored().get(name, {}))


def title_of(name: str, language: str) -> str:
    """Of one of them, as it stands until the first answer; "" for another name."""
    return shipped_lesson(name, language).title_before if name in lesson_names() else ""


def listed(language: str) -> list[Lesson]:
    """All in this language if there is a translation, as they follow each other, those of the program first."""
    return [
        each for names in (shipped_names(), ADDED) for each in in_order([shipped_lesson(n, language) for n in names])
    ]


def in_order(given: list[Lesson]) -> list[Lesson]:
    """Each with those behind it that follow by `next`; the longest such course first, courses of a length by name."""
    by_name = {each.lesson: each for each in given}
    following = {each.next for each in given if each.next != each.lesson}

    def course(name: str) -> list[str]:
        found: list[str] = []
        while name in by_name and name not in found:
            found.append(name)
            name = by_name[name].next
        return found

    courses = sorted((course(name) for name in by_name if name not in following), key=lambda each: (-len(each), each))
    names = dict.fromkeys(name for each in courses for name in each)
    return [by_name[name] for name in (*names, *(name for name in by_name if name not in names))]
