"""Scenes of visitors' own: their name is the text of the scene file, packed, so that no server has to keep any."""

import base64
import binascii
import re
import tomllib
import zlib
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import Any

from solvers import Scene, SceneError
from solvers.scenes.link import LONGEST
from solvers.scenes.link import OWN as MARK
from solvers.scenes.saved import MARK as SAVED

from ..text.refusals import Refused, reason_of

LONGEST_TEXT = 20_000  # bytes of the text
AT_LINE = re.compile(r"\bline (\d+)")
LETTERS = re.compile(r"[\w-]*")
# Of a key, with those of the table that it stands in: what reads TOML takes their square in time and memory.
MOST_PARTS = 20
_PART = r"""(?:[\w-]+|"[^"]*"|'[^']*')"""
PART, DOTTED = re.compile(_PART), re.compile(rf"{_PART}(?:[ \t]*\.[ \t]*{_PART})*")
# Of all links together, nodes of finite elements included: a mechanism takes their square in time and memory, and is
# assembled several times to read it. Three links may have all that there can be; built-in scenes have fewer.
MOST_MODES = 600
KEPT = 4  # scenes that a process keeps, of up to 16 MB each


def is_own(name: object) -> bool:
    """Whether it can be the name of one."""
    return isinstance(name, str) and name.startswith(MARK)


@lru_cache(maxsize=KEPT)
def own_scene(name: str) -> Scene:
    """The scene of a name. Raises Refused, by line and key, for one that is none.

    Not for the event loop of a server, which has `app.choices.facts`.
    """
    text = _text_of(name)
    _check_keys(text)
    try:
        tables = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        said, at = (str(error).splitlines() or [""])[0][:120], AT_LINE.search(str(error))
        line = int(at[1]) if at else len(text.splitlines())
        raise Refused("refused.own-toml", line=line, why=said.split(" (at ")[0]) from None
    check_modes(tables)
    try:
        return Scene.from_table({key: table for key, table in tables.items() if key != SAVED})
    except SceneError as refusal:
        raise Refused("refused.own-scene", line=line_of(text, refusal.key), why=reason_of(refusal)) from None


def _text_of(name: str) -> str:
    """The text of the scene file. Raises Refused where the name was cut short, or is too long."""
    packed = name.removeprefix(MARK)
    try:
        if len(name) > LONGEST or not LETTERS.fullmatch(packed):
            raise ValueError
        unpack = zlib.decompressobj(-zlib.MAX_WBITS)
        text = unpack.decompress(base64.urlsafe_b64decode(packed + "=" * (-len(packed) % 4)), LONGEST_TEXT)
        if not unpack.eof:
            raise ValueError
        return text.decode("utf-8-sig")
    except (ValueError, zlib.error, binascii.Error):
        raise Refused("refused.own-cut") from None


def _check_keys(text: str) -> None:
    """Raises Refused for a key of too many parts, before anything reads it."""
    table = 0
    for number, line in enumerate(text.splitlines(), 1):
        parts = max((len(PART.findall(found[0])) for found in DOTTED.finditer(line)), default=1)
        header = line.lstrip().startswith("[")
        if (parts if header else table + parts) > MOST_PARTS:
            raise Refused("refused.own-line", line=number, most=MOST_PARTS)
        table = parts if header else table


def check_modes(tables: Mapping[str, Any]) -> None:
    """Raises Refused for tables of a scene whose links have too many modes together, before they are assembled."""
    if sum(_modes_in(tables)) > MOST_MODES:
        raise Refused("refused.modes", most=MOST_MODES)


def _modes_in(tables: Mapping[str, Any]) -> Iterator[int]:
    """Numbers of modes that tables ask for, whatever else they are."""
    for body in ("impactor", "target"):
        links = tables[body].get("links") if isinstance(tables.get(body), dict) else None
        for link in filter(lambda each: isinstance(each, dict), links if isinstance(links, (list, tuple)) else ()):
            yield from (max(link[key], 0) for key in ("modes", "axial") if isinstance(link.get(key), int))
            yield 3 * len(link["nodes"]) if isinstance(link.get("nodes"), list) else 0


def line_of(text: str, key: str) -> int:
    """The line, from 1 on, in which a key of a scene file stands, or the table in which it is missing; 0: in none."""
    words, numbers = re.findall(r"[a-z_][\w-]*", key), re.findall(r"\[(\d+)\]", key)
    found, table, inside = [], [], 0
    for number, line in enumerate(text.splitlines(), 1):
        if header := re.match(r"\s*\[+\s*([\w.-]+)\s*\]", line):
            table = header[1].split(".")
            inside = inside or number * (table[0] in words[:1])
        elif assigned := re.match(r"\s*([\w-]+)\s*=", line):
            path = [*table, assigned[1]]
            found += [number] * (path == words[: len(path)])
    which = int(numbers[0]) if numbers else 1  # of those in a list of tables
    return found[min(which, len(found)) - 1] if found else inside
