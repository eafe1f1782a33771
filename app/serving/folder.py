"""The laboratory as a folder that needs no server: the opening, the scenes that browsers answer by themselves, and the
kernels that do so. Pages from the disk may load neither modules nor data: all of it is in scripts of the common kind.
"""

import gzip
import json
import math
from base64 import b64encode
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

from ..choices.choices import SCENES, Choices
from ..choices.scene_of import choices_of
from ..messages.encoding import read_header
from ..messages.solve import solve_frame
from ..page.lab import STATIC, spec_of_choices
from ..page.picker import gallery
from ..text.catalogues import page
from ..wasm.covered import covered_of
from ..wasm.module import MODULE, named_in, sources
from .bundle import function
from .pages import SHEETS, text_of
from .still import first_still

HERE = Path(__file__).parent
# of which those before the last come late where there is a server
ENTRIES = ("gallery/gallery.js", "take/files.js", "offline/page.js")
REMADE = (
    *("f0Time", "f0", "motionTime", "exactMass", "exactEnd", "exactWhole", "exactTime", "exactForce"),
    *("cycleDepth", "cycleLoading", "cycleUnloading", "blowForce", "touchTime", "touchPressure"),
)
REMADE_BESIDE = ("modalForce", "otherMass", "otherEnd")  # where modes are marched as usual
POLICY = (
    "default-src 'none'; script-src 'self' file: 'wasm-unsafe-eval'; style-src 'self' file: 'unsafe-inline'; "
    "img-src data: blob:; media-src blob:; font-src data:; base-uri 'none'; form-action 'none'"
)  # file: where the page is opened from the disk


class OutOfDate(Exception):
    """The kernels that came with the package are of other sources."""


class Exported(NamedTuple):
    scenes: int
    of: int  # scenes
    bytes: int  # of all files


def export(folder: Path, laboratory: str, language: str) -> Exported:
    """Write it; `laboratory`: the address of one with a server, which it then leads to, or nothing.

    Raises OutOfDate, and OSError for a folder that cannot be written.
    """
    kernels = MODULE.read_bytes()
    if named_in(kernels) != sources():
        raise OutOfDate
    names = covered_of(SCENES)
    files = {
        "index.html": _document(language).encode(),
        "kernels.js": script("strikewaveKernels", kernels).encode(),
        "scenes.js": _scenes(names, laboratory, language).encode(),
        "page.js": function(STATIC, ENTRIES, "strikewavePage").encode(),
        "start.js": text_of(STATIC / "offline/start.js"),
        SHEETS: text_of(STATIC / SHEETS),
        "gallery/gallery.css": text_of(STATIC / "gallery/gallery.css"),
    }
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    return Exported(len(names), len(SCENES), sum(map(len, files.values())))


def _document(language: str) -> str:
    texts = page(language).texts
    session = json.dumps({"lost": texts["offline.lost"]})
    said = {
        "POLICY": escape(POLICY),
        "TITLE": escape(texts["document.title"]),
        "ABOUT": escape(texts["document.about"]),
        "NO-SCRIPT": escape(texts["document.no-script"]),
        "LANGUAGE": language,
        "SESSION": escape(session, quote=False),
        "STYLE": (STATIC / "shell/page.css").read_text("utf-8"),
        "STILL": first_still(page(language)),
    }
    text = (HERE / "folder.html").read_text("utf-8")
    for mark, content in said.items():
        text = text.replace(mark, content)
    return text


def _scenes(names: list[str], laboratory: str, language: str) -> str:
    """A script with texts, choices and a message of each scene, packed: a header in JSON, and the messages after it."""
    messages = [_without_remade(solve_frame(Choices(scene=name, **choices_of(name)).chosen())) for name in names]
    spec = spec_of_choices()
    known = {law["name"] for message in messages for law in read_header(message)["laws"]}
    laws = [name for name in spec["law"]["options"] if name in known]
    head = {
        "texts": {"language": language, "texts": page(language).texts},
        "spec": spec | {"scene": spec["scene"] | {"options": names}, "law": spec["law"] | {"options": laws}},
        "gallery": _gallery(set(names)),
        "kernels": sources(),
        "laboratory": laboratory,
        "sizes": [len(message) for message in messages],
    }
    text = json.dumps(head, ensure_ascii=False, separators=(",", ":")).encode()
    return script("strikewavePacked", len(text).to_bytes(4, "little") + text + b"".join(messages))


def script(name: str, content: bytes) -> str:
    """One that carries these bytes, packed."""
    return f'globalThis.{name} = "{b64encode(gzip.compress(content, 9, mtime=0)).decode()}";\n'


def _gallery(names: set[str]) -> dict[str, Any]:
    """The gallery of these scenes alone."""
    whole = gallery()
    cards = [[group, [each for each in all_of if each in names]] for group, all_of in whole["cards"]]
    scenes = [[heading, [each for each in all_of if each[0] in names]] for heading, all_of in whole["scenes"]]
    return whole | {
        "cards": [each for each in cards if each[1]],
        "scenes": [each for each in scenes if each[1]],
        "pictures": {name: picture for name, picture in whole["pictures"].items() if name in names},
    }


def _without_remade(message: bytes) -> bytes:
    """A message whose histories are empty where the kernels of the browser make them anew."""
    header, at = read_header(message), 4 + int.from_bytes(message[:4], "little")
    kept, remade = [], REMADE + (REMADE_BESIDE if header["usualSteps"] else ())
    for entry in header["arrays"]:
        _, shape, *unit = entry
        size = (2 if unit else 4) * math.prod(shape)
        size += -size % 4
        if entry[0] in remade:
            entry[1] = [0]
        else:
            kept.append(message[at : at + size])
        at += size
    text = json.dumps(header, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return len(text).to_bytes(4, "little") + text + b"".join(kept)
