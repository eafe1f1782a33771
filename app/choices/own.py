"""Scenes of visitors' own: their name is the text of the scene file, packed, so that no server has to keep any."""

import base64
import binascii
import re
import tomllib
import zlib
from collections.abc import Callable
from functools import lru_cache

from solvers import Scene, SceneError
from solvers.scenes.saved import MARK as SAVED

from ..text.refusals import Refused, reason_of

MARK = "own."  # with which their names begin, see app/static/wire/own.js
LONGEST = 3_000  # letters of a name
LONGEST_TEXT = 20_000  # bytes of the text
AT_LINE = re.compile(r"\bline (\d+)")
LETTERS = re.compile(r"[\w-]*")
MOST_DOTS = 400  # in a line: what reads TOML takes the square of the parts of a key in time and memory

# What else is asked of one before it is taken, by who knows all choices; each raises Refused.
CHECKS: list[Callable[[str], None]] = []


def is_own(name: object) -> bool:
    """Whether it can be the name of one."""
    return isinstance(name, str) and name.startswith(MARK)


@lru_cache(maxsize=64)
def own_scene(name: str) -> Scene:
    """The scene of a name. Raises Refused, by line and key, for one that is none."""
    text = _text_of(name)
    for number, each in enumerate(text.splitlines(), 1):
        if each.count(".") > MOST_DOTS:
            raise Refused("refused.own-line", line=number, most=MOST_DOTS)
    try:
        tables = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        said, at = (str(error).splitlines() or [""])[0][:120], AT_LINE.search(str(error))
        line = int(at[1]) if at else len(text.splitlines())
        raise Refused("refused.own-toml", line=line, why=said.split(" (at ")[0]) from None
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
