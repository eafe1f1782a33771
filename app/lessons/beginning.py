"""Files to begin with: a lesson of a scene, and a translation of one that is there."""

import json
import re
from pathlib import Path
from typing import Any

from solvers.text.catalogue import SOURCE

from .document import Block, Document, document_of, text_of
from .problems import LessonError, Problems
from .reading import read_text
from .translation import OF_HEAD, SAME, SENTENCES

HERE = Path(__file__).parent
USUAL = "fixed-rod"

NAME = "lesson"  # a key of the head, and what the template has there


def template(name: str, scene: str = USUAL, language: str = SOURCE) -> str:
    """The text of a lesson to begin with, under this name, of a scene; in English where there is none in a language."""
    own = HERE / f"template.{language}.md"
    given = (own if own.is_file() else HERE / "template.md").read_text(encoding="utf-8")
    return given.replace(f"{NAME}: {NAME}", f"{NAME}: {name}", 1).replace("SCENE", scene, 1)


def translation(original: Path, language: str) -> str:
    """The text of a translation to begin with: all sentences of the original, to be written over.

    Raises LessonError where the original cannot be read, or is a translation itself.
    """
    text = text_of(original)
    document = document_of(text, problems := Problems())
    if "translates" in document.head:
        problems.add(document.head["translates"][1], "original-is-translation", value=original.name)
        raise LessonError(problems)
    read_text(text)
    return _written(document, text.splitlines(), original.name, language)


def _written(document: Document, lines: list[str], original: str, language: str) -> str:
    head = {key: value for key, (value, _) in document.head.items() if key in (*SAME, *OF_HEAD)}
    head |= {"language": language, "translates": original}
    order = ("lesson", "version", "language", "translates", *OF_HEAD)
    parts = ["---", *(f"{key}: {_yaml(head[key])}" for key in order if key in head), "---"]
    for section in document.sections:
        parts += ["", f"## {section.title}"]
        for block in section.blocks:
            parts += _block(block, lines)
    return "\n".join(parts) + "\n"


def _yaml(value: str) -> str:
    return json.dumps(value, ensure_ascii=False) if re.search(r": | #|^[^\w¿¡]", value) else value


def _block(block: Block, lines: list[str]) -> list[str]:
    text = _source(block, lines)
    if block.kind == "text":
        return ["", *text]
    table = _sentences(block.table)
    if not table and not text:
        return []
    return ["", f":::{{{block.kind}}} {block.name}".rstrip(), *_toml(table), *text, ":::"]


def _source(block: Block, lines: list[str]) -> list[str]:
    """Of the text of a block, as it stands in the file."""
    spans = [token.map for token in block.tokens if token.map and token.level == 0]
    found: list[str] = []
    for first, last in spans:
        found += [*([""] if found else []), *(line for line in lines[first:last] if not line.startswith("%"))]
    return found


def _sentences(table: dict[str, Any]) -> dict[str, Any]:
    """What a translation has of it; lists of tables stay as long, as they go by their order."""
    found: dict[str, Any] = {}
    for key, value in table.items():
        if key in SENTENCES:
            found[key] = value
        elif isinstance(value, list) and value and all(isinstance(each, dict) for each in value):
            inner = [_sentences(each) for each in value]
            if any(inner):
                found[key] = inner
    return found


def _toml(table: dict[str, Any]) -> list[str]:
    plain = [
        f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in table.items() if isinstance(value, str)
    ]
    lists = [(key, each) for key, value in table.items() if isinstance(value, list) for each in value]
    return [*plain, *(line for key, each in lists for line in (f"[[{key}]]", *_toml(each)))]
