"""A lesson from its file: every error of the file is found, not only the first."""

import re
from pathlib import Path
from typing import NamedTuple

from .document import QUESTIONS, Block, Document, Lines, Section, document_of, text_of
from .fields import EventUse, Fields, Reading
from .lesson import After, Lesson, Part, Scene, Step, Summary, Text
from .problems import LessonError, Problems, wanted
from .prose import paragraphs
from .questions import Reader, read_choice, read_number, read_order, read_set
from .showing import read_map, read_shown
from .sketch import read_sketch
from .stage import Stage, known_scene
from .translation import merged, original_of

VERSION = 1
MOST_STEPS = 20
NAME = re.compile(r"[a-z0-9][a-z0-9-]{0,59}")
LANGUAGE = re.compile(r"[a-z]{2,3}(-[A-Z]{2})?")
CLOCKS = ("both", "T")  # units of the time that is shown
REQUIRED = ("lesson", "version", "language", "title", "scene")
OPTIONAL = ("title-before", "minutes", "for", "next")
LONGEST_TITLE = 200


class Read(NamedTuple):
    """A lesson, and the events that it names, which `check` looks for."""

    lesson: Lesson
    uses: tuple[EventUse, ...]


def read(path: Path) -> Lesson:
    """The lesson of a file, which may be a translation of another one beside it.

    Raises LessonError with all that is wrong, by line.
    """
    return read_in_full(path).lesson


def read_in_full(path: Path) -> Read:
    """The same with what is still to be checked. Raises LessonError."""
    return read_text(text_of(path), path.parent)


def read_text(text: str, folder: Path | None = None) -> Read:
    """From the text of a file; `folder`: of the original of a translation. Raises LessonError."""
    problems, missing, name = Problems(), list[str](), ""
    document = document_of(text, problems)
    if "translates" in document.head:
        name, _ = document.head["translates"]
        document, missing = _with_original(document, folder, problems)
    return _lesson(document, problems, missing, name)


def _with_original(given: Document, folder: Path | None, problems: Problems) -> tuple[Document, list[str]]:
    """A translation, and what it lacks. Raises LessonError where its original cannot be taken."""
    name, line = given.head["translates"]
    if folder is None:
        problems.add(line, "translation-alone", value=name[:60])
        raise LessonError(problems)
    text = original_of(name, line, folder, problems)
    if text is None:
        raise LessonError(problems)
    original = document_of(text, Problems())
    if "translates" in original.head:
        problems.add(line, "original-is-translation", value=name[:60])
        raise LessonError(problems)
    try:
        read_text(text)
    except LessonError:
        problems.add(line, "original-refused", value=name[:60])
        raise LessonError(problems) from None
    return merged(given, original, problems)


def _lesson(document: Document, problems: Problems, missing: list[str], translates: str) -> Read:
    head = _head(document, problems)
    scene = head["scene"] or "fixed-rod"  # for what follows, where another one was refused
    stage = Stage(scene)
    reading = Reading(problems, stage.events())
    if not document.sections:
        problems.add(1, "no-steps")
    if len(document.sections) > MOST_STEPS:
        problems.add(document.sections[MOST_STEPS].line, "too-many-steps", most=MOST_STEPS)
    steps = []
    for reading.step, section in enumerate(document.sections):
        parts = tuple(_parts(section, reading, stage))
        changes = dict(stage.changes)
        steps.append(Step(title=section.title, line=section.line, scene=stage.scene, choices=changes, parts=parts))
    problems.settle()
    lesson = Lesson(
        lesson=head["lesson"], version=VERSION, language=head["language"], title=head["title"],
        title_before=head["title-before"] or head["title"], scene=scene,
        minutes=int(head["minutes"]) if head["minutes"] else None,
        audience=head["for"], next=head["next"], translates=translates,
        steps=tuple(steps), missing=tuple(missing),
    )  # fmt: skip
    return Read(lesson, tuple(reading.uses))


def _head(document: Document, problems: Problems) -> dict[str, str]:
    """Words by key, "" where there are none."""
    if not document.head:
        return dict.fromkeys((*REQUIRED, *OPTIONAL), "")
    at = Lines(1, {key: line for key, (_, line) in document.head.items()})
    lines = Fields(Reading(problems), {key: value for key, (value, _) in document.head.items()}, at)
    found = {name: str(lines.take(name) or "").strip() for name in (*REQUIRED, *OPTIONAL)}
    lines.take("translates")
    lines.close()
    if not found["version"].isascii() or not found["version"].isdecimal() or found["version"].strip("0") == "":
        lines.refuse("version", found["version"] or None, wanted("version"))
    elif found["version"] != str(VERSION):
        lines.problem("version", "version-later", value=found["version"][:20], most=VERSION)
    for name in ("lesson", "next"):
        if (found[name] or name == "lesson") and not NAME.fullmatch(found[name]):
            lines.refuse(name, found[name] or None, wanted("name", most=60))
    if not LANGUAGE.fullmatch(found["language"]):
        lines.refuse("language", found["language"] or None, wanted("language"))
    minutes = found["minutes"]
    if minutes and not (minutes.isascii() and minutes.isdecimal() and 1 <= len(minutes) <= 3 and int(minutes)):
        lines.refuse("minutes", minutes, wanted("minutes"))
        found["minutes"] = ""
    for name in ("title", "title-before", "for"):
        if len(found[name]) > LONGEST_TITLE or (name == "title" and not found[name]):
            lines.refuse(name, found[name] or None, wanted("sentence", most=LONGEST_TITLE))
    found["scene"] = known_scene(found["scene"] or None, lines.line("scene"), "scene", problems) or ""
    return found


def _parts(section: Section, reading: Reading, stage: Stage) -> list[Part]:
    """Of one step; it has one question, and what is said behind it."""
    found: list[Part] = []
    seen: set[str] = set()
    for block in section.blocks:
        kind = "question" if block.kind in QUESTIONS else block.kind
        if kind in seen and kind != "text":
            code = "second-question" if kind == "question" else "second-part"
            reading.problems.add(block.line, code, fence=block.fence)
        if kind == "after" and "question" not in seen and not section.unread:
            reading.problems.add(block.line, "after-nothing", fence=block.fence)
        if block.name in reading.names:
            reading.problems.add(block.line, "name-twice", name=block.name)
        reading.names |= {block.name} if block.name else set()
        seen.add(kind)
        found.append(_part(block, reading, stage))
    return [each for each in found if not isinstance(each, Text) or each.nodes]


def _part(block: Block, reading: Reading, stage: Stage) -> Part:
    if block.kind == "text":
        return Text(line=block.line, nodes=paragraphs(block.tokens, reading.problems))
    fields = Fields(reading, block.table, block.lines)
    part = READERS[block.kind](fields, stage, block.name, block.line)
    fields.close()
    if isinstance(part, After):
        return After(line=part.line, play=part.play, at=part.at, nodes=paragraphs(block.tokens, reading.problems))
    return part


def _read_scene(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    scene = fields.take("scene")
    if scene is not None:
        scene = known_scene(scene, fields.line("scene"), "scene", fields.reading.problems)
        if scene:
            stage.turn_to(scene)
    changes, show, map_ = stage.change(fields), read_shown(fields, stage), read_map(fields, stage)
    if show:
        stage.map = map_ if "map" in show else None
    sliders, beside = stage.sliders(fields), stage.settings(fields, "beside")
    fields.reading.events = stage.events()
    play, at, time = fields.span("play"), fields.time("at"), fields.choice("time", CLOCKS, CLOCKS[0])
    return Scene(
        line=line, scene=scene, changes=changes, show=show, map=map_, beside=beside, play=play, at=at, time=time,
        sliders=sliders,
    )  # fmt: skip


def _read_after(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    return After(line=line, play=fields.span("play"), at=fields.time("at"))


def _read_summary(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    return Summary(line=line, say=fields.said("say"))


READERS: dict[str, Reader] = {
    "scene": _read_scene,
    "choice": read_choice,
    "number": read_number,
    "order": read_order,
    "set": read_set,
    "sketch": read_sketch,
    "after": _read_after,
    "summary": _read_summary,
}
