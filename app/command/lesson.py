"""The command `impact lesson`: checks lesson files, prints them for paper, and writes one to begin with."""

import argparse
import json
import re
from pathlib import Path

from solvers import SceneError, scene_names
from solvers.text.catalogue import spoken

from .words import text

NAME = re.compile(r"[a-z0-9][a-z0-9-]{0,59}")
USUAL = "lesson.md"  # the file that is written


def add_commands(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=type(parser))
    check = commands.add_parser("check", help=text("help.lesson.check"))
    check.add_argument("files", nargs="+", metavar="FILE", help=text("help.lesson.files"))
    check.add_argument("--json", action="store_true", help=text("help.json"))
    check.set_defaults(run=lambda options: print_check(options.files, options.json))
    paper = commands.add_parser("print", help=text("help.lesson.print"))
    paper.add_argument("file", metavar="FILE", help=text("help.lesson.one"))
    paper.add_argument("--key", action="store_true", help=text("help.lesson.key"))
    paper.set_defaults(run=lambda options: print_paper(options.file, options.key))
    new = commands.add_parser("new", help=text("help.lesson.new"))
    new.add_argument("file", nargs="?", default=USUAL, metavar="FILE", help=text("help.lesson.file", usual=USUAL))
    new.add_argument("--scene", default="", metavar="SCENE", help=text("help.lesson.scene"))
    new.add_argument("--translation", default="", metavar="LANGUAGE", help=text("help.lesson.translation"))
    new.set_defaults(run=lambda options: write_new(options.file, options.scene, options.translation))


def print_check(files: list[str], as_json: bool) -> int:
    """Print all that is wrong with each file, by line; 1 if anything is."""
    from ..lessons.checking import check
    from ..lessons.problems import on_one_line

    found = {file: check(Path(file)) for file in files}
    if as_json:
        table = [
            {"file": file, "errors": [each.table() for each in one.problems], "missing": list(one.missing)}
            for file, one in found.items()
        ]
        print(json.dumps(table, indent=1, allow_nan=False, ensure_ascii=False))
    else:
        for file, one in found.items():
            for problem in one.problems:
                print(f"{file}:{problem.line}: {problem.said(spoken())}")
            for part in one.missing:
                print(f"{file}: {text('lesson.missing', part=on_one_line(part))}")
            if one.lesson is not None and not one.problems:
                print(f"{file}: {text('lesson.right', steps=len(one.lesson.steps))}")
    return int(any(one.problems for one in found.values()))


def print_paper(file: str, key: bool) -> int:
    """Print a lesson with room for answers, or its key; what is wrong with it in its place, and 1."""
    from ..lessons.checking import check
    from ..lessons.paper import Paper

    found = check(Path(file))
    if found.lesson is None or found.problems:
        return print_check([file], as_json=False)
    paper = Paper(found.lesson)
    print(paper.key() if key else paper.handout(), end="")
    return 0


def write_new(file: str, scene: str = "", language: str = "") -> int:
    """Write the file to begin with, named after itself; one that is there stays as it is.

    With a language, the translation of the lesson FILE into it, beside that.
    """
    from ..lessons.beginning import USUAL as USUAL_SCENE
    from ..lessons.beginning import template

    if language:
        return write_translation(file, scene, language)
    if scene and scene not in scene_names():
        raise SceneError("--scene", scene, text("wanted.built-in"))
    path = Path(file)
    name = path.stem if NAME.fullmatch(path.stem) else Path(USUAL).stem
    return _write(path, template(name, scene or USUAL_SCENE, spoken()))


def write_translation(file: str, scene: str, language: str) -> int:
    """Of a lesson that can be read; what is wrong with it in its place, and 1."""
    from ..lessons.beginning import translation
    from ..lessons.problems import LessonError
    from ..lessons.reading import LANGUAGE

    if scene:
        raise SceneError("--scene", scene, text("wanted.of-original"))
    if not LANGUAGE.fullmatch(language):
        raise SceneError("--translation", language, text("wanted.language"))
    path = Path(file)
    try:
        written = translation(path, language)
    except LessonError as error:
        for problem in error.problems:
            print(f"{file}:{problem.line}: {problem.said(spoken())}")
        return 1
    return _write(path.with_suffix(f".{language}{path.suffix}"), written)


def _write(path: Path, words: str) -> int:
    try:
        with path.open("x", encoding="utf-8") as made:
            made.write(words)
    except FileExistsError:
        raise SceneError("FILE", str(path), text("wanted.new-file")) from None
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise SceneError("FILE", str(path), text("wanted.writable", why=why)) from None
    print(text("lesson.written", file=str(path)))
    return 0
