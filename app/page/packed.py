"""The files of the page: as pack.js has packed them, as long as that is of these sources; else the plain modules."""

import json
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

STATIC = Path(__file__).parents[1] / "static"
FOLDER = STATIC.with_name("packed")
ABOUT = "packed.json"  # written last


class Pack(NamedTuple):
    modules: dict[str, list[str]]  # that are in a script, by its name
    files: dict[str, bytes]  # by name


def key() -> str:
    """Of all sources, as pack.js makes it."""
    files = {file.relative_to(STATIC).as_posix(): file for file in STATIC.rglob("*") if file.suffix in (".js", ".css")}
    whole = sha256()
    for name in sorted(files):
        whole.update(f"{name}\0".encode() + files[name].read_bytes())
    return whole.hexdigest()


@cache
def pack() -> Pack | None:
    """None where there is none, or it is of other sources."""
    if not outdated() and (FOLDER / ABOUT).is_file():
        files = (file for file in FOLDER.rglob("*") if file.suffix in (".js", ".css"))
        known = json.loads((FOLDER / ABOUT).read_text("utf-8"))["modules"]
        return Pack(known, {file.relative_to(FOLDER).as_posix(): file.read_bytes() for file in sorted(files)})
    return None


@cache
def outdated() -> bool:
    """Whether there is one of other sources."""
    about = FOLDER / ABOUT
    return about.is_file() and json.loads(about.read_text("utf-8"))["key"] != key()


def content(name: str) -> bytes:
    """Of a file of the page, by its name in the folder of all modules."""
    found = pack()
    return found.files[name] if found and name in found.files else (STATIC / name).read_bytes()
