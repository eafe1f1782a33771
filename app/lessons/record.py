"""A lesson as JSON for the page, which draws it without reading any file."""

from dataclasses import fields, is_dataclass
from typing import Any

from .lesson import Lesson, Node, Part
from .shipped import title_of


def lesson_record(lesson: Lesson) -> dict[str, Any]:
    """Lists, words, numbers, true and false, and null for what is not there.

    Keys are the fields of `Lesson`, `next_title` of the one that follows, if it comes with the program, and, below
    `steps` and `parts`, of the classes of `app.lessons.lesson`; a part has its `kind` beside them. Sentences are lists
    of nodes: `kind`, and of `text`, `nodes`, `target` what is not empty. Times are numbers in T or names of events, a
    span is [from, to]; choices and goals are in SI units, axes, answers and tolerances in the unit beside them.
    """
    return _record(lesson) | {"next_title": title_of(lesson.next, lesson.language)}


def _record(value: Any) -> Any:
    if isinstance(value, Node):
        return {name: each for name in ("kind", "text", "nodes", "target") if (each := _record(getattr(value, name)))}
    if is_dataclass(value):
        kind = {"kind": value.KIND} if isinstance(value, Part) else {}
        return kind | {each.name: _record(getattr(value, each.name)) for each in fields(value) if each.compare}
    if isinstance(value, dict):
        return {key: _record(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_record(each) for each in value]
    return value
