"""The laboratory as a folder that needs no server: the opening, the scenes that browsers answer by themselves, and the
kernels that do so. Pages from the disk may load neither modules nor data: all of it is in scripts of the common kind.
"""

import gzip
import json
import math
import re
from functools import cache
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from solvers.numerics.waves.chain_drawn import MOST_RODS
from solvers.text.catalogue import SOURCE
from solvers.text.messages import terms_in

from ..choices.choices import SCENES, Choices
from ..choices.scene_of import choices_of
from ..lessons.alone import runs_alone
from ..lessons.record import lesson_record
from ..lessons.shipped import lesson_names, shipped_lesson
from ..messages.encoding import arrays_of, read_header, whole_numbers
from ..messages.solve import solve_frame
from ..page import packed
from ..page.lab import spec_of_choices
from ..page.packed import STATIC
from ..page.picker import gallery
from ..page.picker import lessons as listed
from ..text.asked import asked_in
from ..text.catalogues import LANGUAGES, direction, page
from ..wasm.covered import covered_of
from ..wasm.module import MODULE, named_in, sources
from .pages import LATE, SHEETS
from .still import first_still

HERE = Path(__file__).parent
TEXTS_OF_LESSONS = ("lesson.", "class.")
CYCLE = ("cycleDepth", "cycleLoading", "cycleUnloading", "blowForce", "touchTime", "touchPressure")
REMADE = {  # by kind of message: histories that kernels make anew, or that only a server has of other choices
    "axial": ("f0Time", "f0", "motionTime", "exactMass", "exactEnd", "exactWhole", "exactTime", "exactForce", *CYCLE),
    "beam": (
        *("time", "impactorPath", "struckPath", "impactorRate", "struckRate", "rates", "modalForce", *CYCLE),
        *("referenceImpactorPath", "referenceStruckPath", "referenceTime", "referenceForce"),
        *("staticTime", "staticPath", "halfTime", "halfForce"),
    ),
}
REMADE_BESIDE = ("modalForce", "otherMass", "otherEnd")  # of a rod, where modes are marched as usual
REMADE_STIFF = (
    "fieldForce",
    "otherMass",
    "otherEnd",
    "otherTime",
    "otherForce",
)  # where those left out do not give way
REMADE_SPRING = (  # of one that bends as a spring
    *("otherMass", "otherEnd", "otherTime", "otherForce", "fieldStress", "fieldVelocity", "fieldDisplacement"),
)
AT_THE_DEEPEST = ("blowDepth", "touchRadius")  # that one pair tells how round the faces are
FLOWING = (*AT_THE_DEEPEST, "touchPressure", "touchFlow")  # and this one where they yield
REMADE_COMPACT = ("otherMass", "otherEnd", "otherTime", "otherForce")  # of two bodies that move as wholes
REMADE_CHAIN = tuple(  # of rods one behind the other: what both ends of each send
    f"{way}{number}{of}" for number in range(MOST_RODS) for way in "fg" for of in ("Time", "")
)
REMADE_BALANCE = (*REMADE_SPRING, "balanceTime", "balanceForce")  # of one that is balanced, or a mass on a spring
FIGURES = ("exact", "other", "main", "reference")  # that kernels find anew
DIGITS, EXACT = 4, ("contacts", "notes")  # of them; contacts tell whether a kernel covers an impact
FIRST_LETTER, LETTER = 0x4000, 15  # of a script, as start.js reads it: none stands for more than itself; bits
COARSE = ("shapeRows", "momentRows", "shearRows", "fieldStress", "fieldVelocity", "fieldDisplacement")  # likewise
COARSER, LARGEST = 32, 1023  # times as coarse as two bytes are, and the largest number then
BRIEF = ("otherMass", "otherEnd", "otherTime", "otherForce")  # beside these
POLICY = (
    "default-src 'none'; script-src 'self' file: 'wasm-unsafe-eval'; style-src 'self' file: 'unsafe-inline'; "
    "worker-src blob:; img-src data: blob:; media-src blob:; font-src data:; base-uri 'none'; form-action 'none'"
)  # file: where the page is opened from the disk


class OutOfDate(Exception):
    """The kernels that came with the package are of other sources."""


class NotPacked(Exception):
    """The scripts of the page are not, or those are of other sources."""


class Exported(NamedTuple):
    scenes: int
    of: int  # scenes
    lessons: int
    bytes: int  # of all files


def export(folder: Path, laboratory: str, lessons: bool = False) -> Exported:
    """Write it, in all languages; `laboratory`: the address of one with a server, which it then leads to, or nothing;
    `lessons`: with those that need no server.

    Raises OutOfDate, NotPacked, and OSError for a folder that cannot be written.
    """
    kernels = MODULE.read_bytes()
    if named_in(kernels) != sources():
        raise OutOfDate
    found = packed.pack()
    if not found:
        raise NotPacked
    names = covered_of(SCENES)
    taught = [name for name in lesson_names() if lessons and runs_alone(shipped_lesson(name))]
    of_lessons = sorted(each for each in LATE if each.startswith(("lesson/", "courses/")) and each.endswith(".css"))
    sheets = ["gallery/gallery.css", *(of_lessons if taught else ())]
    whole = "offline/lessons.js" if taught else "offline/scenes.js"
    scripts = [(STATIC / name).read_text("utf-8") for name in (*found.modules[whole], "offline/start.js")]
    files = {
        "index.html": _document().encode(),
        "kernels.js": script("strikewaveKernels", kernels),
        "worker.js": script("strikewaveWorker", found.files["offline/worker.js"]),
        "scenes.js": _scenes(names, laboratory, taught, "\n".join(scripts)),
        "page.js": found.files[whole],
        **{name: found.files[f"offline/{name}"] for name in ("start.js", "widget.js", SHEETS)},
        **{name: found.files[name] for name in sheets},
    }
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    return Exported(len(names), len(SCENES), len(taught), sum(map(len, files.values())))


def _document() -> str:
    """In the source language until start.js runs, which knows that of the visitor; a still has no words."""
    texts = page(SOURCE).texts
    session = {
        each: {"direction": direction(each), "name": said["document.language"], "lost": said["offline.lost"]}
        for each in LANGUAGES
        for said in [page(each).texts]
    }
    no_script = (f'<p lang="{each}">{escape(page(each).texts["document.no-script"])}</p>' for each in LANGUAGES)
    said = {
        "POLICY": escape(POLICY),
        "TITLE": escape(texts["document.title"]),
        "ABOUT": escape(texts["document.about"]),
        "NO-SCRIPT": "".join(no_script),
        "LANGUAGE": SOURCE,
        "DIRECTION": direction(SOURCE),
        "SESSION": escape(json.dumps({"languages": session}, ensure_ascii=False), quote=False),
        "STYLE": packed.content("frame/page.css").decode(),
        "STILL": first_still(),
    }
    text = (HERE / "folder.html").read_text("utf-8")
    for mark, content in said.items():
        text = text.replace(mark, content)
    return text


def _scenes(names: list[str], laboratory: str, taught: list[str], scripts: str) -> bytes:
    """A script with texts, lessons, choices and a message of each scene, packed: a head in JSON, then headers of all
    messages, which are much alike, then their arrays, of which many have the same.
    """
    parts = [_parts_of(name) for name in names]
    pool: dict[bytes, int] = {}
    messages = [[len(header), [pool.setdefault(each, len(pool)) for each in arrays]] for header, arrays in parts]
    spec = spec_of_choices()
    known = {law["name"] for header, _ in parts for law in json.loads(header)["laws"]}
    laws = [name for name in spec["law"]["options"] if name in known]
    headers = b"".join(header for header, _ in parts)
    shown = _gallery(set(names), taught)
    codes = _codes(names, bool(taught), scripts, headers.decode() + json.dumps(shown))
    head = {
        "codes": codes,
        "said": {language: _said(language, codes, taught) for language in LANGUAGES},
        "spec": spec | {"scene": spec["scene"] | {"options": names}, "law": spec["law"] | {"options": laws}},
        "gallery": shown,
        "kernels": sources(),
        "laboratory": laboratory,
        "messages": messages,
        "sizes": [len(each) for each in pool],
    }
    text = json.dumps(head, ensure_ascii=False, separators=(",", ":")).encode()
    return script("strikewavePacked", len(text).to_bytes(4, "little") + text + headers + b"".join(pool))


def _codes(names: list[str], lessons: bool, scripts: str, messages: str) -> list[str]:
    """Of the texts that these scripts ask for or these messages name, in any language, and of the terms in them."""
    asked, beginnings = asked_in(scripts)
    named = set(re.findall(r'"([\w.-]+)"', messages)) | asked
    begun = (*(each for each in beginnings if each != "scene."), *(f"scene.{name}." for name in names))
    left_out = () if lessons else TEXTS_OF_LESSONS
    texts = {code: None for language in LANGUAGES for code in page(language).texts}
    found = [code for code in texts if (code in named or code.startswith(begun)) and not code.startswith(left_out)]
    for code in found:  # which grows
        terms = (terms_in(page(language).texts.get(code, "")) for language in LANGUAGES)
        found += sorted({f"terms.{term}" for term in set().union(*terms)}.difference(found))
    return found


def _said(language: str, codes: list[str], taught: list[str]) -> dict[str, Any]:
    """All words in a language: texts by the codes, null where scenes have their own, and lessons, if there is a
    translation, as records and as the gallery lists them.
    """
    texts = page(language).texts
    return {
        "texts": [texts.get(code) for code in codes],
        "lessons": {name: lesson_record(shipped_lesson(name, language)) for name in taught},
        "listed": [each for each in listed(language) if each["name"] in taught],
    }


def _gallery(names: set[str], taught: list[str]) -> dict[str, Any]:
    """The gallery of these scenes, without the list of lessons; `lacking`: how many of these need a server."""
    whole = gallery()
    cards = [[group, [each for each in all_of if each in names]] for group, all_of in whole["cards"]]
    scenes = [[heading, [each for each in all_of if each[0] in names]] for heading, all_of in whole["scenes"]]
    return {
        "sheet": whole["sheet"],
        "lacking": len(whole["lessons"]) - len(taught),
        "cards": [each for each in cards if each[1]],
        "scenes": [each for each in scenes if each[1]],
        "pictures": {name: picture for name, picture in whole["pictures"].items() if name in names},
    }


def script(name: str, content: bytes) -> bytes:
    """One that carries these bytes, packed: how many, and fifteen bits of them a letter from FIRST_LETTER on.

    Its mark of UTF-16 holds whatever a server says of the encoding. Base 64 would take a quarter more of the disk.
    """
    whole = gzip.compress(content, 9, mtime=0)
    bits = np.unpackbits(np.frombuffer(whole, np.uint8))
    each = np.pad(bits, (0, -bits.size % LETTER)).reshape(-1, LETTER) @ (1 << np.arange(LETTER)[::-1])
    letters = (FIRST_LETTER + each).astype("<u2").tobytes().decode("utf-16-le")
    return f'\ufeffglobalThis.{name} = [{len(whole)}, "{letters}"];\n'.encode("utf-16-le")


def _brief(values: np.ndarray) -> tuple[bytes, list[float]]:
    """In two bytes a number, and their unit: as much as a picture shows."""
    numbers, unit = whole_numbers(values)
    return numbers.tobytes() + b"\0" * (2 * (numbers.size % 2)), [unit]


def _coarse(numbers: bytes) -> bytes:
    """Whole numbers of two bytes, as fine as a picture shows."""
    fine = np.frombuffer(numbers, np.int16).astype(int)
    return (np.rint(fine / COARSER).clip(-LARGEST, LARGEST) * COARSER).astype(np.int16).tobytes()


def _rounded(value: Any) -> Any:
    """With a few digits of every number."""
    if isinstance(value, dict):
        return {name: each if name in EXACT else _rounded(each) for name, each in value.items()}
    if isinstance(value, list):
        return [_rounded(each) for each in value]
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value


@cache
def _parts_of(name: str) -> tuple[bytes, list[bytes]]:
    """Header and arrays of a scene's message, of which those are empty that the kernels of the browser make anew."""
    message = solve_frame(Choices(scene=name, **choices_of(name)).chosen())
    header, at = read_header(message), 4 + int.from_bytes(message[:4], "little")
    remade = REMADE[header["kind"]]
    if header.get("usualSteps"):
        remade += REMADE_BESIDE if header["givesWay"] else REMADE_STIFF
    if header.get("springCarries") is not None:
        remade += REMADE_SPRING
    if header.get("balance"):
        remade += REMADE_BALANCE
    if header.get("compact"):
        remade += REMADE_COMPACT
    if header.get("chain"):
        remade += REMADE_CHAIN
    known, arrays = arrays_of(message), []
    kept = FLOWING if "touchFlow" in known else AT_THE_DEEPEST if "touchRadius" in known else ()
    remade += AT_THE_DEEPEST
    deepest = int(np.argmax(known.get("touchRadius", 0.0)))
    for entry in header["arrays"]:
        name, shape, *unit = entry
        size = (2 if unit else 4) * math.prod(shape)
        size += -size % 4
        if name in remade and name not in kept:
            entry[1] = [0]
        elif name in BRIEF and header.get("chain") and not unit:
            numbers, entry[2:] = _brief(known[name])
            arrays.append(numbers)
        elif name in kept:
            entry[1] = [1]
            arrays.append(message[at + 2 * deepest : at + 2 * deepest + 2] + b"\0\0")
        elif name in COARSE:
            arrays.append(_coarse(message[at : at + size]))
        else:
            arrays.append(message[at : at + size])
        at += size
    figures = FIGURES if not header.get("chain") else FIGURES[:1]  # beside a chain another method stays as it is
    header |= {name: _rounded(header[name]) for name in figures if name in header}
    text = json.dumps(header, separators=(",", ":")).encode()
    return text + b" " * (-len(text) % 4), arrays
