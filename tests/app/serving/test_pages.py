"""Files of the page: its modules as one; packed for who can read that, plain for others, and the same for both."""

import gzip
import json
import re
import subprocess
import urllib.error
import urllib.request
from pathlib import Path

import pytest

from app.choices.choices import SCENES
from app.messages.gallery.cards import TAUGHT
from app.serving import pages
from app.serving.bundle import bundle, function
from app.serving.libraries import CORE, extension
from app.serving.pages import APART, FIGURES, LIBRARIES, SCRIPTS, STATIC, VERSION, shell, text_of
from solvers.text.catalogue import SOURCE

from ...patience import SECONDS
from ..conftest import Page
from ..socket_client import SocketClient, run

FILES = {f"assets/{VERSION}/{name}": STATIC / name for name in ("page.js", "sheets.css")} | dict(LIBRARIES)
ADDRESSES = {address: text_of(file) for address, file in FILES.items()}
ADDRESSES |= {f"assets/{VERSION}/text/{language}.js": text for language, text in SCRIPTS.items()}


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
    """To bundle the modules at every request took 150 ms of the event loop, for which a class waited 8 s."""
    pages.pack()

    def again(*_, **__):
        raise AssertionError("put together once more")

    for name in ("bundle", "styles", "extension"):
        monkeypatch.setattr(pages, name, again)
    monkeypatch.setattr(Path, "read_bytes", again)
    for file in (*(STATIC / name for name in pages.FILES if Path(name).suffix in pages.PACKED), *FILES.values()):
        assert len(pages._packed(file)) < len(text_of(file))


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
    sheets = text_of(STATIC / "sheets.css").decode()
    assert ":has(" not in sheets and "@import" not in sheets and sheets.count("{") > 500


def test_all_modules_are_one_but_for_those_that_are_fetched_late():
    whole = bundle(STATIC, "page.js")
    beside = {entry: bundle(STATIC, entry, beside=("page.js", *before)) for entry, before in APART.items()}
    named = {path.relative_to(STATIC).as_posix(): path.read_text("utf-8") for path in STATIC.rglob("*.js")}
    known = {"browser/modules.js", "browser/start.js"}  # which the document loads
    known |= {name for name in named if name.startswith("offline/")}  # of a page without a server
    names = {name for name, text in named.items() if "export {};" not in text}  # the others are types alone
    late = {entry: {name for name in names if name.split("/")[0] == entry.split("/")[0]} for entry in APART}
    assert {name for name in names if f"modules['{name}'] = " in whole} == names.difference(known, *late.values())
    for entry, own in late.items():
        assert {name for name in names if f"modules['{name}'] = " in beside[entry]} == own
    assert re.findall(r"^\s*(?://|/\*\*\n).*", whole, re.MULTILINE) == []


@pytest.mark.browser  # needs Node
def test_a_module_is_given_what_it_imports(tmp_path):
    (tmp_path / "b").mkdir()
    (tmp_path / "b/one.js").write_text("export const one = 1;\nexport const two = 2;\n")
    (tmp_path / "b/all.js").write_text("export const three = (await import(`./${'one'}.js`)).two + 1;\n")
    (tmp_path / "a.js").write_text(
        "import * as all from './b/all.js';\nimport {\n  one as first,\n  two,\n} from './b/one.js';\n"
        "/** @import { X } from './x.js' */\nexport function sum() {\n  return first + two + all.three;\n}\n"
    )
    (tmp_path / "try.mjs").write_text(bundle(tmp_path, "a.js") + "console.log(sum());\n")
    done = subprocess.run(["node", tmp_path / "try.mjs"], capture_output=True, text=True, timeout=SECONDS)
    assert done.stdout == "6\n", done.stderr


def test_ends_of_lines_are_left_out_but_of_a_literal_that_spans_some(tmp_path):
    (tmp_path / "a.js").write_text("const a = 'b // c'; // d\n  const e = `http://f`; // it's\n")
    assert "const a = 'b // c';\nconst e = `http://f`; // it's\n" in bundle(tmp_path, "a.js")
    (tmp_path / "a.js").write_text("const a = `b // c\n  d`;\n")
    assert "const a = `b // c\n  d`;\n" in bundle(tmp_path, "a.js")


@pytest.mark.parametrize(
    "text, reason",
    [
        ("import './other.js';\n", "cannot be bundled: import './other.js'"),
        ("export default 1;\n", "cannot be bundled: export default"),
        ("export { a };\n", "cannot be bundled: export { a }"),
        ("const a = import('./other.js');\n", "cannot be bundled"),
        ("import { a } from './other.js';\n", "a.js imports itself"),
    ],
)
def test_what_cannot_be_bundled_is_refused(tmp_path, text, reason):
    (tmp_path / "a.js").write_text(text)
    (tmp_path / "other.js").write_text("import { b } from './a.js';\nexport const a = b;\n")
    with pytest.raises(ValueError, match=reason):
        bundle(tmp_path, "a.js")


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


def test_lines_on_a_disk_are_joined_but_behind_a_comment_and_in_a_literal_that_spans_some(tmp_path):
    (tmp_path / "a.js").write_text("const a = [\n  1,\n  2, // it's one;\n  3,\n];\nexport const b = a;\n")
    (tmp_path / "c.js").write_text("export const c = `d;\n  e`;\n")
    text = function(tmp_path, ["a.js", "c.js"], "run")
    assert "[\n1,2, // it's one;\n3,];const b = a;" in text and "`d;\n  e`" in text


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
