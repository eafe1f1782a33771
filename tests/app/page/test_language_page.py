"""No word of the page stands outside its catalogues: in a language whose words are all in brackets, none is bare."""

import json
import subprocess
import sys
import time
import urllib.request

import pytest

import solvers
from app.page import picker
from app.text import catalogues
from app.text.catalogues import language_for
from solvers.bodies import Mechanism
from solvers.text.catalogue import SOURCE

from ..conftest import Page
from ..pseudo import BARE, LANGUAGE
from ..servers import ROOT, free_port

pytestmark = [pytest.mark.browser, pytest.mark.slow]

NAMED = {"Strikewave", "GPa", "MPa", "kPa", "kHz", "rad", "SVG", "PNG", "CSV", "Python", "mm²", "mm⁴", "cm²", "cm⁴"}
DRAWN = """(() => {
  globalThis.drawnWords = new Set();
  const own = CanvasRenderingContext2D.prototype.fillText;
  CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
    drawnWords.add(text);
    return own.call(this, text, ...rest);
  };
})();"""
WRITTEN = """(attributes) => {
  const found = new Set(drawnWords);
  const walk = (node) => {
    const silent = ['STYLE', 'SCRIPT'].includes(node.parentElement?.tagName);
    if (node.nodeType === Node.TEXT_NODE && !silent) found.add(node.nodeValue);
    if (node.nodeType === Node.ELEMENT_NODE)
      for (const name of attributes) if (node.hasAttribute(name)) found.add(node.getAttribute(name));
    if (node.shadowRoot) walk(node.shadowRoot);
    for (const child of node.childNodes) walk(child);
  };
  walk(document.documentElement);
  return [...found];
}"""
SAYING = ["title", "aria-label", "aria-valuetext", "aria-description", "placeholder", "alt", "content"]
REFUSED = "?mass_ratio=2 kg&speed=99999&t=never&panel=weather&target.length=9e9"
STATES = {  # a query, and what is done then
    "": ("strikewave.page.help.toggle?.()", "strikewave.page.compare.keep()", "strikewave.page.scenes.open()"),
    REFUSED: (),
    "?scene=free-rod&law=hertz&panel=needs": (),
    "?panel=tradeoff&method=modal": (),
    "?panel=methods": (),
    "?scene=four-bar-moves": ("strikewave.page.layout.tabs.select('numbers')",),
    "?scene=bent-rods&panel=joints,stability": (),
    "?scene=brick-off-centre": ("strikewave.page.layout.tabs.select('numbers')",),
    "?scene=newtons-cradle&panel=energy": (),
    "?scene=figure-5.24&panel=stretch": (),
    "?scene=table-6.4&panel=convergence": (),
}


@pytest.fixture(scope="module")
def bracketed(tmp_path_factory):
    """Address of a server that knows the language."""
    port, log = free_port(), tmp_path_factory.mktemp("bracketed") / "log"
    with log.open("w") as output:
        call = [sys.executable, "-m", "tests.app.pseudo", "serve", "--port", str(port)]
        process = subprocess.Popen(call, cwd=ROOT, stdout=output, stderr=subprocess.STDOUT)
    try:
        while True:
            assert process.poll() is None, log.read_text()
            try:
                urllib.request.urlopen(f"http://127.0.0.1:{port}/liveness", timeout=2).read()
                break
            except OSError:
                time.sleep(0.1)
        yield f"127.0.0.1:{port}"
    finally:
        process.terminate()
        process.wait(20)


def names() -> set[str]:
    """Proper names: of links in scene files, of lessons, and of what this machine is."""
    mechanisms = (solvers.load(name).target for name in solvers.scene_names())
    links = {link.name for body in mechanisms if isinstance(body, Mechanism) for link in body.links}
    processor = json.dumps(solvers.stored_tradeoff(solvers.load("fixed-rod")).table()["machine"])
    titles = [title for _, title in picker.lessons()]
    return NAMED | {word for text in (*links, *titles, processor) for word in BARE.findall(text)}


def test_no_word_of_the_page_is_outside_its_catalogues(browser, bracketed):
    known, bare = names(), {}
    for query, acts in STATES.items():
        page = Page(browser, bracketed, drawn=False, locale=LANGUAGE)
        page.context.add_init_script(DRAWN)
        page.tab.goto(f"http://{bracketed}/{query}")
        page.laid_out()
        for act in acts:
            page.evaluate(f"() => {{ {act}; }}")
        page.quiet()
        assert page.evaluate("() => document.documentElement.lang") == LANGUAGE
        for text in page.evaluate(WRITTEN, SAYING):
            bare |= {word: (query, text) for word in BARE.findall(text) if word not in known}
        page.close()
    assert bare == {}


def test_who_reads_another_language_gets_that_of_the_source(browser, bracketed):
    page = Page(browser, bracketed, locale="de-AT")
    assert page.evaluate("() => document.documentElement.lang") == SOURCE
    page.close()


@pytest.mark.parametrize("accepted", ["", "de, fr;q=0.5", "*", "x" * 5_000, ",".join(["a-b"] * 900), "en;q", "\x00"])
def test_whatever_a_browser_accepts_there_is_a_language(accepted):
    assert language_for(accepted) == SOURCE


def test_languages_are_known_however_they_are_spelled(monkeypatch):
    monkeypatch.setattr(catalogues, "LANGUAGES", ("en", "pt-BR", "es"))
    found = [language_for(each) for each in ("PT-br", "es-CL,es;q=0.9,en;q=0.8", "EN-us", "pt-PT", "ES")]
    assert found == ["pt-BR", "es", "en", "en", "es"]
