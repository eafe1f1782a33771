"""Files of the page: its modules in a few, or plain; sent packed to who can read that, and the same to all."""

import gzip
import json
import re
import signal
import urllib.error
import urllib.request
from pathlib import Path

import pytest

from app.choices.choices import SCENES
from app.messages.gallery.cards import TAUGHT
from app.page import packed
from app.serving import pages
from app.serving.libraries import CORE, extension
from app.serving.pages import FIGURES, LIBRARIES, SCRIPTS, STATIC, VERSION, shell, text_of
from solvers.text.catalogue import SOURCE

from ...patience import SECONDS
from ..conftest import Page
from ..servers import Server
from ..socket_client import SocketClient, run

FILES = {f"assets/{VERSION}/{name}": STATIC / name for name in ("page.js", "sheets.css")} | dict(LIBRARIES)
ADDRESSES = {address: text_of(file) for address, file in FILES.items()}
ADDRESSES |= {f"assets/{VERSION}/text/{language}.js": text for language, text in SCRIPTS.items()}


class PlainServer(Server):
    MODULE = "tests.app.serving.plain"


def fetched(server: str, address: str, *coding: str):
    headers = {"Accept-Encoding": coding[0]} if coding else {}
    return urllib.request.urlopen(
        urllib.request.Request(f"http://{server}/{address}", headers=headers), timeout=SECONDS
    )


@pytest.mark.parametrize("address", ADDRESSES)
def test_a_file_is_the_same_packed_or_not(server, address):
    plain, packed = fetched(server, address), fetched(server, address, "br, gzip;q=0.8")
    assert plain.headers["Content-Encoding"] is None and packed.headers["Content-Encoding"] == "gzip"
    small, whole = packed.read(), ADDRESSES[address]
    assert plain.read() == gzip.decompress(small) == whole and len(small) < 0.5 * len(whole)
    for answer in (plain, packed):
        assert answer.headers["Vary"] == "Accept-Encoding" and "immutable" in answer.headers["Cache-Control"]
        assert answer.headers.get_content_type().endswith("css" if address.endswith(".css") else "javascript")


def test_what_is_sent_is_put_together_once(monkeypatch):
    """To put modules together at every request took 150 ms of the event loop, for which a class waited 8 s."""
    pages.pack()

    def again(*_, **__):
        raise AssertionError("put together once more")

    for name in ("extension", "content"):
        monkeypatch.setattr(pages, name, again)
    monkeypatch.setattr(Path, "read_bytes", again)
    for file in (*(STATIC / name for name in pages.FILES if Path(name).suffix in pages.PACKED), *FILES.values()):
        assert gzip.decompress(pages._packed(file)) == text_of(file)


def test_of_what_extends_bokeh_the_page_loads_the_models_that_it_has():
    """All of Panel with the widgets and tables below it is 1.4 MB, which took 70 ms of a processor per page."""
    text = extension()
    assert len(text) < 350_000 and 'need("models/reactive_esm").ReactiveESM' in text
    for absent in ("Tabulator", "SlickGrid", "VTKJSPlot", "noUiSlider"):
        assert absent not in text
    known = set(re.findall(r'^"(\w+)": function', text, re.MULTILINE))
    core = set(re.findall(r'"([\w/.]+)":\d+', CORE.read_text("utf-8")))
    asked = {path for path in re.findall(r'\("@bokehjs/([\w/]+)"\)', text) if path not in core and path not in known}
    own = set(json.loads(text[text.rindex("{") : text.rindex("}") + 1]))
    assert asked <= own | {path.removesuffix("/index") for path in core}


def test_no_style_looks_at_what_an_element_contains():
    """`:has` makes a browser look at all of the page anew after every change in it: 33 ms of each answer were that."""
    named = re.findall(r"^@import '(.+)';$", (STATIC / "sheets.css").read_text("utf-8"), re.MULTILINE)
    sheets = "".join((STATIC / name).read_text("utf-8") for name in named)
    assert ":has(" not in sheets and sheets.count("{") > 500


@pytest.mark.browser  # needs Node
def test_the_page_is_packed_of_these_sources():
    """`make test` packs it."""
    found = packed.pack()
    assert found, "make package"
    whole = found.files["page.js"]
    assert len(whole) < 460_000 and len(gzip.compress(whole, 6, mtime=0)) <= 165_000
    assert text_of(STATIC / "page.js") == whole
    worker = "wasm/worker.js"  # which has all that it takes once more: nothing of the page is there
    late = {name for name in pages.LATE if name.endswith(".js")}
    assert {name for name in found.files if name.endswith(".js") and not name.startswith("offline/")} == {
        *("page.js", "browser/modules.js", "browser/start.js"),
        *late,
    }
    named = {path.relative_to(STATIC).as_posix(): path.read_text("utf-8") for path in STATIC.rglob("*.js")}
    apart = {"browser/modules.js", "browser/start.js"}  # which the document loads
    apart |= {name for name in named if name.startswith("offline/")} | {worker}  # of a page without a server
    names = {name for name, text in named.items() if "export {};" not in text}  # the others are types alone
    rooms = {entry: {name for name in names if name.split("/")[0] == entry.split("/")[0]} for entry in late - {worker}}
    assert names & {*found.modules["page.js"]} == names.difference(apart, *rooms.values())
    for entry, own in rooms.items():  # what is there before is not there once more
        assert names & {*found.modules[entry]} == own - {worker}
    assert not re.search(rb"\b(document|window)\.", found.files[worker])  # of which a worker has none


@pytest.mark.parametrize("given", ["none", "of others"])
def test_a_pack_of_other_sources_is_not_sent(monkeypatch, tmp_path, given):
    if given == "of others":
        (tmp_path / packed.ABOUT).write_text(json.dumps({"key": "0", "modules": {}}))
    monkeypatch.setattr(packed, "FOLDER", tmp_path)
    packed.outdated.cache_clear()
    packed.pack.cache_clear()
    try:
        assert packed.pack() is None and packed.outdated() == (given == "of others")
        assert packed.content("page.js") == (STATIC / "page.js").read_bytes()
    finally:
        packed.outdated.cache_clear()
        packed.pack.cache_clear()


def own_files(page) -> set[str]:
    """Names of the program's own files that a page has asked for."""
    named = page.evaluate("() => performance.getEntriesByType('resource').map((each) => new URL(each.name).pathname)")
    return {name.split("/", 3)[-1] for name in named if name.startswith("/assets/")}


@pytest.fixture
def plain_server(tmp_path):
    server = PlainServer(tmp_path / "log")
    server.start()
    yield server.address
    server.end(signal.SIGTERM)
    server.said_no_trace()


@pytest.mark.slow
def test_without_a_pack_the_plain_modules_are_the_page(browser, plain_server):
    """As from a clone on a machine without Node; what is fetched late is there too."""
    page = Page(browser, plain_server, "?lesson=bounce-twice")
    page.wait("() => strikewave.page.own.answers !== null && strikewave.page.opening.teaching.lesson !== null")
    assert {"page.js", "charts/chart.js"} <= own_files(page)  # of the first 250
    assert page.errors == []
    page.close()


@pytest.mark.browser
def test_a_lesson_is_packed_apart(browser, server):
    page = Page(browser, server, "?lesson=bounce-twice")
    page.wait("() => strikewave.page.opening.teaching.lesson !== null")
    scripts = {name for name in own_files(page) if name.endswith(".js")}
    assert scripts - {"wasm/answers.js"} == {
        *("page.js", "lesson/lesson.js", "browser/modules.js", "browser/start.js", f"text/{SOURCE}.js")
    }
    assert page.errors == []
    page.close()


@pytest.mark.parametrize(
    "path", ["", "liveness", "gallery/en", "?mass_ratio=3", LIBRARIES[0][0], f"figures/en/{next(iter(FIGURES))}"]
)
def test_a_head_is_answered_as_the_whole_is_without_its_body(server, path):
    whole = urllib.request.urlopen(f"http://{server}/{path}", timeout=SECONDS)
    head = urllib.request.urlopen(urllib.request.Request(f"http://{server}/{path}", method="HEAD"), timeout=SECONDS)
    assert head.status == 200 and head.read() == b""
    assert head.headers["Content-Type"] == whole.headers["Content-Type"]


def test_the_gallery_is_the_same_packed_or_not_and_asked_for_again_if_it_has_changed(server):
    plain, packed = fetched(server, "gallery/en"), fetched(server, "gallery/en", "gzip")
    whole = plain.read()
    assert gzip.decompress(packed.read()) == whole and packed.headers["Content-Encoding"] == "gzip"
    found = json.loads(whole)
    assert sum(len(scenes) for _, scenes in found["scenes"]) == len(SCENES)
    shown = {name for _, names in found["cards"] for name in names} | set(TAUGHT)
    assert shown == found["pictures"].keys()
    again = urllib.request.Request(f"http://{server}/gallery/en", headers={"If-None-Match": plain.headers["Etag"]})
    with pytest.raises(urllib.error.HTTPError, match="304"):
        urllib.request.urlopen(again, timeout=SECONDS)


def test_the_gallery_names_lessons_in_the_language_that_is_asked_for(server):
    lessons = {language: json.load(fetched(server, f"gallery/{language}"))["lessons"] for language in ("en", "es")}
    titles = {language: {each["name"]: each["title"] for each in found} for language, found in lessons.items()}
    assert titles["es"]["bounce-twice"] != titles["en"]["bounce-twice"]
    with pytest.raises(urllib.error.HTTPError, match="404"):
        fetched(server, "gallery/tlh")


def test_the_page_names_nothing_of_the_gallery():
    """Which is fetched when it is opened."""
    assert "gallery" not in shell(False, SOURCE)


@pytest.mark.parametrize("fields", [1_000, 1_001, 8_000])
def test_a_link_of_many_fields_is_answered_with_the_page(server, fields):
    """Beyond a thousand it was an empty 400."""
    with urllib.request.urlopen(f"http://{server}/?" + "&".join(["mass_ratio=3"] * fields), timeout=SECONDS) as page:
        assert page.status == 200 and b"Strikewave" in page.read()


def test_a_bare_client_fetches_what_a_browser_does(browser, server):
    """Else benches and tests of load see nothing of what scripts, styles and kernels cost."""
    page = Page(browser, server, "")
    page.wait("() => strikewave.page.own.answers !== null")
    named = page.evaluate("() => performance.getEntriesByType('resource').map((each) => new URL(each.name).pathname)")
    page.close()

    async def visit():
        client = await SocketClient(server).open()
        client.close()
        return await client.fetch()

    own = {f"/{path.partition('?')[0]}" for path in run(visit())} - {"/favicon.ico"}
    assert own == {path for path in named if not path.startswith(("/figures/", "/gallery/"))}
