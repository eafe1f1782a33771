"""Heads of saved histories: the scene that they are of, as the comment lines of a table, and read back from them."""

import json
import math
from collections.abc import Mapping
from itertools import takewhile
from pathlib import Path
from typing import Any

from ..scene import Scene

MARK = "saved"  # the table of what is no part of the scene
LONGEST = 100_000  # letters of a head that are read


def saved_head(
    scene: Scene, method: Mapping[str, Any], duration: float, methods: Mapping[str, Mapping[str, Any]] | None = None
) -> str:
    """The scene in TOML, solved by this method for so long [s]; then table `saved`, with the methods of several
    columns by their names in these."""
    tables = scene.table() | {"method": {**method, "duration": duration}}
    tables[MARK] = {"methods": dict(methods)} if methods else {}
    return as_toml(tables)


def commented(head: str) -> str:
    """Each line behind a #, as readers of tables skip it."""
    return "".join(f"# {line}\n" for line in head.splitlines())


def head_of(path: Path) -> str:
    """The TOML text in the first lines of a saved table."""
    with path.open(encoding="utf-8-sig") as file:
        lines = takewhile(lambda line: line.startswith("#"), file.read(LONGEST).splitlines())
        return "\n".join(line[1:].strip() for line in lines)


def as_toml(tables: Mapping[str, Any]) -> str:
    """Tables of numbers, words, lists and tables; what is None is left out."""
    plain = [_line(key, value) for key, value in tables.items() if not isinstance(value, Mapping)]
    for key, table in tables.items():
        if isinstance(table, Mapping):
            plain += [f"[{_key(key)}]", *(_line(*item) for item in table.items() if item[1] is not None)]
    return "\n".join(plain)


def _line(key: str, value: Any) -> str:
    return f"{_key(key)} = {_value(value)}"


def _key(key: str) -> str:
    return key if key.replace("-", "").replace("_", "").isalnum() and key.isascii() else _word(key)


def _word(word: str) -> str:
    return json.dumps(word, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any) -> str:
    if isinstance(value, str):
        return _word(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(_line(*item) for item in value.items() if item[1] is not None) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int) or math.isinf(value):
        return str(value)
    return repr(float(value))
