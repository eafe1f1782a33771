"""A lesson file as it is written: the values of its head, and steps of text and fences, before anything is decided."""

import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import yaml
from markdown_it.token import Token

from .problems import LessonError, Problems
from .prose import COMMENT, fence_of, markdown, paragraphs, plain

LARGEST = 200_000  # bytes of a file
LARGEST_HEAD = 10_000  # characters
MOST_DOTS = 400  # in a line of TOML: its reader takes the square of the parts of a key in time and memory
FENCE = re.compile(r"\{([a-z-]{1,40})\}(?: +([a-z][a-z0-9-]{0,39}))? *")
KIND = re.compile(r"\{([a-z-]{1,40})\}")
HEADER = re.compile(r"[ \t]*(\[{1,2})[ \t]*([\w-]+)[ \t]*\]")
ASSIGNED = re.compile(r"[ \t]*([\w-]+)[ \t]*=")
AT_LINE = re.compile(r"\bline (\d+)")
HINTS = {  # of a line of TOML that cannot be read, by what is usual in it
    "comma": re.compile(r"=\s*[-+]?\d+,\d+\s*(?:#.*)?$"),
    "flag": re.compile(r"=\s*(?:yes|no|on|off|true|false)\s*(?:#.*)?$", re.IGNORECASE),
    "quotes": re.compile(r"=\s*(?:[^\W\d]|[“”„«»‘’])"),
    "backslash": re.compile(r'=\s*"[^"]*\\'),
}
QUESTIONS = ("choice", "number", "order", "set", "sketch")
NAMELESS = ("scene", "after", "summary")
EXAMPLE = ":::{choice} first"


class Lines(NamedTuple):
    """Of the keys of a fence, `first` that of the fence itself."""

    first: int
    known: dict[str, int]

    def of(self, key: str) -> int:
        """The line of a key such as `judge[2].yes`, of what it is in, or of the fence."""
        while key and key not in self.known:
            key = key[: max(key.rfind("."), key.rfind("["), 0)]
        return self.known.get(key, self.first)


@dataclass
class Block:
    """Text (`kind` "text") by its tokens, or a fence by its table; `nodes`: text behind the table."""

    kind: str
    line: int
    name: str = ""
    tokens: list[Token] = field(default_factory=list)
    table: dict[str, Any] = field(default_factory=dict)
    lines: Lines = field(default_factory=lambda: Lines(1, {}))
    fence: str = ""


@dataclass
class Section:
    """A step."""

    title: str
    line: int
    blocks: list[Block] = field(default_factory=list)
    unread: bool = False  # a fence of it


@dataclass
class Document:
    """A head by its keys, (value, line) each, and its steps."""

    head: dict[str, tuple[str, int]]
    sections: list[Section]


def text_of(path: Path) -> str:
    """What is in a lesson file. Raises LessonError where it is none, or too large."""
    problems = Problems()
    try:
        with path.open("rb") as file:
            given = file.read(LARGEST + 1)
        if len(given) > LARGEST:
            problems.add(1, "too-large", size=-(-path.stat().st_size // 1000), most=LARGEST // 1000)
            raise LessonError(problems)
        return decoded(given)
    except OSError as error:
        problems.add(1, "no-file", why=error.strerror or type(error).__name__)
    raise LessonError(problems)


def decoded(given: bytes) -> str:
    """The text of a file. Raises LessonError where it is none."""
    try:
        return given.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        problems = Problems()
        problems.add(given[: error.start].count(b"\n") + 1, "not-text")
        raise LessonError(problems) from None


def document_of(text: str, problems: Problems) -> Document:
    """The parts of a text; what is no part of a lesson is noted."""
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    if len(text.encode("utf-8", "replace")) > LARGEST:
        problems.add(1, "too-large", size=-(-len(text) // 1000), most=LARGEST // 1000)
        return Document({}, [])
    tokens = markdown().parse(text) if text.strip() else []
    head: dict[str, tuple[str, int]] = {}
    if tokens and tokens[0].type == "front_matter":
        head = _head(tokens.pop(0).content, problems)
    else:
        problems.add(1, "head-missing")
    return Document(head, _sections(tokens, text.split("\n"), problems))


def _head(written: str, problems: Problems) -> dict[str, tuple[str, int]]:
    """Values as they are written: YAML makes false of the language `no`, and dates of titles."""
    found: dict[str, tuple[str, int]] = {}
    if len(written) > LARGEST_HEAD:
        problems.add(1, "head-too-large", size=len(written), most=LARGEST_HEAD)
        return found
    try:
        root = yaml.compose(written, Loader=yaml.SafeLoader)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        mark = getattr(error, "problem_mark", None)
        why = str(getattr(error, "problem", None) or type(error).__name__)[:120]
        problems.add(2 + (mark.line if mark else 0), "head-yaml", why=why)
        return found
    if not isinstance(root, yaml.MappingNode):
        problems.add(1, "head-missing")
        return found
    for key, value in root.value:
        line = key.start_mark.line + 2
        if not (isinstance(key, yaml.ScalarNode) and isinstance(value, yaml.ScalarNode)):
            problems.add(line, "head-yaml", why=str(getattr(key, "value", ""))[:60])
        elif key.value in found:
            problems.add(line, "key-twice", key=key.value[:60])
        else:
            found[key.value] = value.value, line
    return found


def _sections(tokens: list[Token], lines: list[str], problems: Problems) -> list[Section]:
    found: list[Section] = []
    kept: list[Token] = []  # of text

    def flush() -> None:
        if kept:
            first = kept[0]
            block = Block("text", first.map[0] + 1 if first.map else 1, tokens=[*kept])
            found[-1].blocks.append(block)
            kept.clear()

    title_of = None
    for token in tokens:
        line = token.map[0] + 1 if token.map else 1
        if token.level == 0 and token.type == "heading_open" and token.markup == "##":
            if found:
                flush()
            kept.clear()
            found.append(Section("", line))
            title_of = found[-1]
        elif title_of is not None:
            if token.type == "inline":
                title_of.title = plain(paragraphs([token], problems)).strip()
            elif token.type == "heading_close":
                if not title_of.title:
                    problems.add(title_of.line, "step-untitled")
                title_of = None
        elif token.type == COMMENT:
            continue
        elif not found:
            if token.level == 0 and token.nesting >= 0:
                problems.add(line, "before-steps")
        elif token.type == "colon_fence" and token.level == 0:
            flush()
            block = _fence(token, lines, problems)
            found[-1].blocks += [block] if block else []
            found[-1].unread |= block is None
        else:
            kept.append(token)
    if found:
        flush()
    return found


def _fence(token: Token, lines: list[str], problems: Problems) -> Block | None:
    start, end = token.map or [0, 1]
    said, line = fence_of(token), start + 1
    inside = [n for n, each in enumerate(lines[start + 1 : end - 1], start + 2) if each.startswith(":::")]
    closed = end - 1 > start and set(lines[end - 1].strip()) == {":"} and len(lines[end - 1].strip()) >= 3
    if inside or not closed:
        problems.add(line, "fence-unclosed", fence=said, marker=token.markup[:60])
        return None
    matched = FENCE.fullmatch(token.info.strip())
    kind = matched or KIND.match(token.info.strip())
    if not kind or kind[1] not in (*QUESTIONS, *NAMELESS):
        code = "fence-unknown" if kind else "fence-form"
        problems.add(line, code, fence=said, kinds=[*NAMELESS, *QUESTIONS], example=EXAMPLE)
        return None
    named = matched[2] if matched else None
    if kind[1] in QUESTIONS and not named:
        problems.add(line, "fence-name", fence=said, example=EXAMPLE)
    if kind[1] in NAMELESS and (named or not matched):
        problems.add(line, "fence-without-name", fence=said)
    block = Block(kind[1], line, named or "", lines=Lines(line, {}), fence=said)
    return _filled(block, token.content, problems)


def _filled(block: Block, content: str, problems: Problems) -> Block | None:
    """The table of a fence. Behind an answer text may follow it, or stand alone."""
    table, _, rest = content, "", ""
    if block.kind == "after":
        table, _, rest = content.partition("\n\n") if ASSIGNED.match(content) else ("", "", content)
        before = content[: len(content) - len(rest)].count("\n") + block.line
        block.tokens = markdown().parse(rest)
        for token in block.tokens:
            if token.map:
                token.map = [token.map[0] + before, token.map[1] + before]
    for number, line in enumerate(table.split("\n"), block.line + 1):
        if line.count(".") > MOST_DOTS:
            problems.add(number, "toml-points", most=MOST_DOTS)
            return None
    try:
        block.table = tomllib.loads(table)
    except (ValueError, RecursionError) as error:
        said = (str(error).splitlines() or [type(error).__name__])[0]
        at = AT_LINE.search(said)
        line = block.line + (int(at[1]) if at else max(len(table.rstrip().split("\n")), 1))
        written = (table.split("\n")[line - block.line - 1 :] or [""])[0]
        problems.add(line, "toml", why=said.split(" (at ")[0][:120], hint=_hint(said, written))
        return None
    block.lines = Lines(block.line, _key_lines(table, block.line))
    return block


def _hint(said: str, line: str) -> str:
    """What is wrong with a line of TOML, as far as it is usual."""
    if "overwrite" in said:
        return "twice"
    return next((hint for hint, form in HINTS.items() if form.search(line)), "none")


def _key_lines(table: str, first: int) -> dict[str, int]:
    """Lines of the keys of a table, those of a list of tables by their number from 1 on."""
    found: dict[str, int] = {}
    inside, counts = "", dict[str, int]()
    for number, line in enumerate(table.split("\n"), first + 1):
        if header := HEADER.match(line):
            name = header[2]
            if header[1] == "[[":
                counts[name] = counts.get(name, 0) + 1
                found.setdefault(name, number)
                name = f"{name}[{counts[name]}]"
            inside = f"{name}."
            found[name] = number
        elif assigned := ASSIGNED.match(line):
            found.setdefault(inside + assigned[1], number)
    return found
