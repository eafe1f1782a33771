"""What a browser fetches: the page, which is the same for all but for its token, and the files that belong to it."""

import gzip
import json
import os
import re
from functools import cache
from hashlib import sha256
from html import escape
from pathlib import Path
from typing import Any

from tornado.web import HTTPError, RequestHandler, StaticFileHandler

from ..jobs.fair import Stranger
from ..jobs.loops import of_loop
from ..jobs.turns import Turnstile
from ..page import packed
from ..page.lab import VERSION
from ..page.packed import STATIC, content
from ..page.picker import gallery
from ..text.catalogues import LANGUAGES, direction, page, script
from ..views.figures import drawn
from ..views.registry import FIGURES, PANELS
from .door import FULL
from .language import ASKED, language_of
from .libraries import CORE, PANEL, extension
from .limits import MAX_PAGES_OF_ONE
from .once import made_once
from .still import bare_frame, first_still

# of the page, in this order: address, and the file there
LIBRARIES = (("libraries/bokeh.min.js", CORE), ("libraries/panel.min.js", PANEL))
SHEETS = "sheets.css"
PANELS_SCRIPT = f"globalThis.strikewavePanels = {json.dumps(PANELS)};\n"  # which app/static/panels/panels.js loads
SCRIPTS = {language: (script(language) + PANELS_SCRIPT).encode() for language in LANGUAGES}  # made, found in no file
TEXTS = {language: (text, gzip.compress(text, 6, mtime=0)) for language, text in SCRIPTS.items()}
FOR_EVER = "public, max-age=31536000, immutable"  # the version is in the address
# what is sent packed, by its ending
PACKED = {".js": "text/javascript; charset=utf-8", ".css": "text/css; charset=utf-8", ".wasm": "application/wasm"}
OF_THE_DOCUMENT = {"frame/page.css", "browser/modules.js", "browser/start.js"}  # which it loads itself, in page.html
OF_ANOTHER_PAGE = {"frame/embedded.css"}  # which a laboratory there loads beside
# of what is fetched when it is wanted
ROOMS = ("gallery", "courses", "lesson", "classes", "sharing", "take", "wasm", "whatif")
LATE = {
    "gallery/gallery.js",
    "courses/courses.js",
    "lesson/lesson.js",
    "classes/classes.js",
    "sharing/class_link.js",
    "take/files.js",
    "wasm/answers.js",
    "wasm/worker.js",
    "whatif/entry.js",
    "gallery/gallery.css",
    "courses/courses.css",
    "classes/classes.css",
    "sharing/class_link.css",
    "lesson/lesson.css",
    "lesson/print.css",
    "lesson/questions.css",
    "wasm/kernels.wasm",
}
PLAIN = {  # modules and sheets that a page fetches that is not packed
    file.relative_to(STATIC).as_posix()
    for file in (() if packed.pack() else STATIC.rglob("*"))
    if file.suffix in (".js", ".css") and not file.is_relative_to(STATIC / "offline")
}
FILES = {"page.js", SHEETS, "example-record.csv", *OF_THE_DOCUMENT, *OF_ANOTHER_PAGE, *LATE, *PLAIN}
POLICY = (
    "default-src 'none'; script-src 'self' blob: 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; connect-src 'self' {sockets}; font-src 'self' data:; object-src 'none'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors {frames}"
)  # blob: Panel makes a module of its own code; wasm: our kernels; styles: Bokeh writes them into every shadow root
PAGES = "pages"  # what strangers ask for who fetch the page
PAGE_SECONDS = 0.004  # of the event loop that a fetched page takes, reading the request included; measured 2 to 3 ms


def documentation() -> str:
    """Where these pages of documentation are served, if that is set: the help links to them."""
    return os.environ.get("IMPACT_DOCUMENTATION", "")


@cache
def shell(first: bool, language: str) -> str:
    """The page in a language, but for its session; with a still of the scene if it is the first one, which the first
    call solves.
    """
    links = [
        (kind, name)
        for kind, ending in (('preload" as="style', ".css"), ("modulepreload", ".js"))
        for name in sorted(FILES - OF_THE_DOCUMENT - OF_ANOTHER_PAGE - LATE)
        if name.endswith(ending) and not name.startswith(tuple(f"{room}/" for room in ROOMS))
    ]
    preloads = [f'<link rel="{kind}" href="assets/{VERSION}/{name}">' for kind, name in links]
    versions = [sha256(text_of(file)).hexdigest()[:16] for _, file in LIBRARIES]
    scripts = [
        f'<script src="{address}?v={version}" defer></script>'
        for (address, _), version in zip(LIBRARIES, versions, strict=True)
    ]
    text = (Path(__file__).parent / "page.html").read_text(encoding="utf-8")
    for mark, code in (("TITLE", "document.title"), ("ABOUT", "document.about"), ("NO-SCRIPT", "document.no-script")):
        text = text.replace(mark, escape(page(language).texts[code]))
    text = text.replace("VERSION", VERSION).replace("LANGUAGE", language).replace("DIRECTION", direction(language))
    text = text.replace("PRELOADS", "\n    ".join(preloads)).replace("SCRIPTS", "\n    ".join(scripts))
    return text.replace("STYLE", content("frame/page.css").decode()).replace(
        "STILL", first_still(page(language)) if first else bare_frame()
    )


class Page(RequestHandler):
    """GET of the page. Makes no document and solves nothing: that begins with the socket."""

    def initialize(self, **_: Any) -> None:
        settings = self.application.settings
        self._door, self._address = settings["door"], settings["addresses"].of(self.request)

    async def get(self) -> None:
        language = language_of(self.request)
        self.set_header("Cache-Control", "no-store")  # each page has a session of its own
        turnstile, visitor = of_loop(Turnstile), Stranger(PAGES, self._address)
        busy = turnstile.waiting_of(visitor) >= MAX_PAGES_OF_ONE
        if not busy:
            await turnstile.enter(visitor)
        turnstile.charge(visitor, PAGE_SECONDS)
        if busy or self._door.full(self._address):
            self.set_status(503)
            self.set_header("Retry-After", "20")
            head = '<!DOCTYPE html><title>Strikewave</title><meta http-equiv="refresh" content="20">'
            self.write(f"{head}<p>{page(language).text(FULL)}</p>")
            return
        session = {"token": self._door.issue(self.request.query_arguments), "documentation": documentation()}
        first = not self.request.query_arguments.keys() - {ASKED}
        self.write(shell(first, language).replace("SESSION", escape(json.dumps(session), quote=False)))

    head = get  # of which no body is sent


@cache
def text_of(file: Path) -> bytes:
    """A script or a style as it is sent."""
    if file == PANEL:
        return extension().encode()
    return content(file.relative_to(STATIC).as_posix()) if file.is_relative_to(STATIC) else file.read_bytes()


@cache
def _packed(file: Path) -> bytes:
    return gzip.compress(text_of(file), 6, mtime=0)


def pack() -> None:
    """Before anybody waits for it: takes a fifth of a second, and leaves a quarter of the bytes."""
    for file in (*(STATIC / name for name in FILES if Path(name).suffix in PACKED), *(file for _, file in LIBRARIES)):
        _packed(file)


def _send(handler: RequestHandler, ending: str, whole: bytes, packed: bytes) -> None:
    """A script, a style or kernels, packed for who can read that."""
    handler.set_header("Content-Type", PACKED[ending])
    handler.set_header("Cache-Control", FOR_EVER)
    handler.set_header("Vary", "Accept-Encoding")
    unpacks = "gzip" in handler.request.headers.get("Accept-Encoding", "")
    if unpacks:
        handler.set_header("Content-Encoding", "gzip")
    handler.write(packed if unpacks else whole)


def _send_file(handler: RequestHandler, file: Path) -> None:
    _send(handler, file.suffix, text_of(file), _packed(file))


class Library(RequestHandler):
    """A script of Bokeh or Panel, which the page names with a version of its own."""

    def get(self, name: str) -> None:
        _send_file(self, dict(LIBRARIES)[name])

    head = get  # of which no body is sent


class Asset(StaticFileHandler):
    """A file of ours, by its name; there are no others."""

    async def get(self, path: str, include_body: bool = True) -> None:
        if path in FILES and Path(path).suffix in PACKED and include_body:
            _send_file(self, STATIC / path)
        else:
            await super().get(path, include_body)

    def compute_etag(self) -> str | None:
        return None  # a file has one version at its address

    def validate_absolute_path(self, root: str, absolute_path: str) -> str | None:
        if self.path.replace("\\", "/") not in FILES:
            raise HTTPError(404)
        return super().validate_absolute_path(root, absolute_path)

    def set_extra_headers(self, path: str) -> None:
        self.set_header("Cache-Control", FOR_EVER)


class Texts(RequestHandler):
    """The catalogue of a language, which is in no file."""

    def get(self, language: str) -> None:
        _send(self, ".js", *TEXTS[language])

    head = get


class Figure(RequestHandler):
    """What the figure of a view looks like; a browser keeps it, and asks whether it is still the same."""

    async def get(self, language: str, name: str) -> None:
        if name not in FIGURES or language not in LANGUAGES:
            raise HTTPError(404)
        self.set_header("Cache-Control", "no-cache")
        self.set_header("Content-Type", "application/json")
        self.write(await made_once(figure_text, name, language))

    head = get


class Gallery(RequestHandler):
    """Pictures of scenes and the list of all; a browser keeps it, and asks whether it is still the same."""

    async def get(self, language: str) -> None:
        if language not in LANGUAGES:
            raise HTTPError(404)
        self.set_header("Cache-Control", "no-cache")
        self.set_header("Content-Type", "application/json")
        self.set_header("Vary", "Accept-Encoding")
        packed = "gzip" in self.request.headers.get("Accept-Encoding", "")
        if packed:
            self.set_header("Content-Encoding", "gzip")
        known = await made_once(gallery_packed, language)
        self.write(known if packed else gzip.decompress(known))

    head = get


def gallery_packed(language: str) -> bytes:
    """The gallery as JSON, packed: the same for all who read the language."""
    return gzip.compress(json.dumps(gallery(language), ensure_ascii=False, separators=(",", ":")).encode(), 9, mtime=0)


def figure_text(name: str, language: str) -> str:
    """The figure of a view as JSON, drawn when it is first asked for: in a tenth of a second, the same for all.

    All of them at the start were half of what a server took to start.
    """
    return drawn(FIGURES[name], page(language))


class Alive(RequestHandler):
    """Answers as soon as the server serves, which is after the first page is ready."""

    def get(self) -> None:
        self.write({"alive": True})

    head = get  # of which no body is sent


def set_headers(handler: RequestHandler) -> None:
    """What every answer carries; nothing of it names a version."""
    host = handler.request.host
    sockets = f"ws://{host} wss://{host}" if re.fullmatch(r"[\w.:\[\]-]{1,260}", host) else ""
    others = handler.application.settings.get("frames", ())
    policy = POLICY.format(sockets=sockets, frames=" ".join(("'self'", *others)))
    handler.set_header("Content-Security-Policy", policy)
    handler.set_header("X-Content-Type-Options", "nosniff")
    if not others:  # which this older header cannot name
        handler.set_header("X-Frame-Options", "SAMEORIGIN")
    handler.set_header("Referrer-Policy", "same-origin")
    handler.set_header("Cross-Origin-Opener-Policy", "same-origin")
    handler.clear_header("Server")
