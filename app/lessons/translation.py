"""A translation and its original: sentences of the one, all else of the other."""

from itertools import zip_longest
from pathlib import Path
from typing import Any

from solvers import SceneError

from .document import Block, Document, Lines, Section, text_of
from .problems import LessonError, Problems, wanted

SENTENCES = (
    "text",
    "say",
    "yes",
    "no",
    "early",
    "late",
    "small",
    "none",
    "high",
    "low",
    "not-yet",
    "more",
    "all",
)  # keys
OF_HEAD = ("title", "title-before", "for")  # which a translation may have
SAME = ("lesson", "version")  # which it repeats


def original_of(name: str, line: int, folder: Path, problems: Problems) -> str | None:
    """The text of the file that a translation names, which must be in the same folder."""
    if Path(name).name != name or not name.endswith(".md") or "\0" in name:
        with problems.refused(line):
            raise SceneError("translates", name, wanted("file-name", example="bounce-twice.md"))
        return None
    try:
        return text_of(folder / name)
    except LessonError as error:
        problems.add(line, "original-unreadable", value=repr(name[:60]), why=error.problems[0].note.table())
        return None


def merged(given: Document, original: Document, problems: Problems) -> tuple[Document, list[str]]:
    """The original with the sentences of a translation, and what it has none for.

    Steps go by their order, fences within one by kind and name, tables and paragraphs by their order.
    """
    missing: list[str] = []
    head = _head(given, original, problems, missing)
    sections = []
    for number, section in enumerate(original.sections):
        if number < len(given.sections):
            sections.append(_section(given.sections[number], section, problems, missing))
        else:
            missing.append(section.title)
            sections.append(section)
    for section in given.sections[len(original.sections) :]:
        problems.add(section.line, "original-lacks", what=section.title or "##")
    return Document(head, sections), missing


def _head(given: Document, original: Document, problems: Problems, missing: list[str]) -> dict[str, tuple[str, int]]:
    for key, (_, line) in given.head.items():
        if key not in (*OF_HEAD, *SAME, "language", "translates"):
            problems.add(line, "sentence-only", key=key[:60])
    if given.head.get("language", ("", 1))[0] == original.head["language"][0]:
        problems.add(given.head.get("language", ("", 1))[1], "same-language", value=original.head["language"][0])
    missing += [key for key in OF_HEAD if key in original.head and key not in given.head]
    kept = {key: (value, 1) for key, (value, _) in original.head.items() if key != "language"}
    return kept | {key: value for key, value in given.head.items() if key in (*OF_HEAD, *SAME, "language")}


def _section(given: Section, original: Section, problems: Problems, missing: list[str]) -> Section:
    own = _keyed(given.blocks)
    blocks = []
    for key, block in _keyed(original.blocks).items():
        said = " ".join(filter(None, (block.fence or block.kind, f"({original.title})")))
        blocks.append(_block(own.pop(key, None), block, said, problems, missing))
    for block in own.values():
        problems.add(block.line, "original-lacks", what=block.fence or block.kind)
    return Section(given.title, given.line, blocks)


def _keyed(blocks: list[Block]) -> dict[tuple[str, str, int], Block]:
    """Those of one kind and name are counted."""
    counts: dict[tuple[str, str], int] = {}
    found = {}
    for block in blocks:
        key = block.kind, block.name
        counts[key] = counts.get(key, 0) + 1
        found[(*key, counts[key])] = block
    return found


def _block(given: Block | None, original: Block, said: str, problems: Problems, missing: list[str]) -> Block:
    if given is None:
        if original.kind == "text" or original.tokens or _has_sentences(original.table):
            missing.append(said)
        return original
    table = _Merge(given.lines, said, problems, missing).of(given.table, original.table)
    if original.tokens and not given.tokens:
        missing.append(said)
    tokens = given.tokens or original.tokens
    if given.tokens and not original.tokens:
        problems.add(given.line, "original-lacks", what=given.fence or given.kind)
    return Block(original.kind, given.line, original.name, tokens, table, given.lines, given.fence)


def _has_sentences(table: dict[str, Any]) -> bool:
    inner = [each for value in table.values() if isinstance(value, list) for each in value if isinstance(each, dict)]
    return any(key in SENTENCES for key in table) or any(map(_has_sentences, inner))


class _Merge:
    """Tables of one fence; `said`: how it is called where a sentence is missing."""

    def __init__(self, lines: Lines, said: str, problems: Problems, missing: list[str]):
        self.lines, self.said, self.problems, self.missing = lines, said, problems, missing

    def of(self, given: dict[str, Any], original: dict[str, Any], key: str = "") -> dict[str, Any]:
        """The original's values, with the translation's sentences."""
        found = dict(original)
        for name, value in given.items():
            full = f"{key}.{name}" if key else name
            if name not in original:
                self.problems.add(self.lines.of(full), "original-lacks", what=full)
            elif name in SENTENCES:
                found[name] = value
            elif not (_are_tables(value) and _are_tables(original[name])):
                self.problems.add(self.lines.of(full), "sentence-only", key=full)
        for name, value in original.items():
            full = f"{key}.{name}" if key else name
            if name in SENTENCES and name not in given:
                self.missing.append(f"{self.said}: {full}")
            elif _are_tables(value):
                found[name] = self._in_order(given.get(name), value, full)
        return found

    def _in_order(self, given: Any, original: list[dict[str, Any]], full: str) -> list[dict[str, Any]]:
        own = given if _are_tables(given) else []
        if len(own) > len(original):
            further = f"{full}[{len(original) + 1}]"
            self.problems.add(self.lines.of(further), "original-lacks", what=further)
        pairs = zip_longest(own[: len(original)], original, fillvalue={})
        return [self.of(one, each, f"{full}[{n}]") for n, (one, each) in enumerate(pairs, 1)]


def _are_tables(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(each, dict) for each in value)
