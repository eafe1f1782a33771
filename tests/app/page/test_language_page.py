"""No word of the page stands outside its catalogues: in a language whose words are all in brackets, none is bare."""

import json
import re
import subprocess
import sys
import time
import urllib.request
from itertools import pairwise

import pytest
from playwright.sync_api import expect

import solvers
from app.page import picker
from app.serving.language import KEPT
from app.text import catalogues
from app.text.catalogues import LANGUAGES, language_for
from solvers.bodies import Mechanism
from solvers.text.catalogue import SOURCE

from ...patience import SECONDS
from ..conftest import Page
from ..pseudo import BARE, LANGUAGE
from ..servers import ROOT, free_port
from ..test_translations import own
from .hands import type_into

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
SPOKEN = "() => document.documentElement.lang"
REFUSED = "?mass_ratio=2 kg&speed=99999&t=never&panel=weather&target.length=9e9"
STATES = {  # a query, and what is done then
    "": ("strikewave.page.help.toggle?.()", "strikewave.page.compare.keep()", "strikewave.page.scenes.open()"),
    REFUSED: (),
    "?scene=free-rod&law=hertz&panel=needs": (),
    "?panel=tradeoff,methods&method=modal": (),
    "?scene=four-bar-moves": ("strikewave.page.layout.tabs.select('numbers')",),
    "?scene=bent-rods&panel=joints,stability": (),
    "?scene=brick-off-centre": ("strikewave.page.layout.tabs.select('numbers')",),
    "?scene=newtons-cradle&panel=energy": (),
    "?scene=figure-5.24&panel=stretch": (),
    "?scene=table-6.4&panel=convergence": (),
}
SPANISH = 4  # of these, with all that is opened from the bar, a refusal, a law and analyses


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
    titles = [each[key] for each in picker.lessons(SOURCE) for key in ("title", "before", "audience")]
    languages = [catalogues.page(each).texts["document.language"] for each in LANGUAGES]
    return NAMED | {word for text in (*links, *titles, *languages, processor) for word in BARE.findall(text)}


def test_no_word_of_the_page_is_outside_its_catalogues(browser, windows, bracketed):
    known, bare = names(), {}
    for query, acts in STATES.items():
        page = Page(browser, bracketed, query, script=DRAWN, windows=windows, locale=LANGUAGE)
        for act in acts:
            page.evaluate(f"() => {{ {act}; }}")
        page.quiet()
        assert page.evaluate(SPOKEN) == LANGUAGE
        for text in page.evaluate(WRITTEN, SAYING):
            bare |= {word: (query, text) for word in BARE.findall(text) if word not in known}
        page.close()
    assert bare == {}


def test_who_reads_another_language_gets_that_of_the_source(browser, bracketed):
    page = Page(browser, bracketed, locale="de-AT")
    assert page.evaluate(SPOKEN) == SOURCE
    page.close()


POINT = re.compile(r"[−±+<>~ ]*\d+\.\d")  # at the begin of ticks, cells, fields and options; sentences are filled alike


def test_nothing_of_the_page_is_left_in_english_on_the_spanish_one(open_page):
    """Of what it says itself; and numbers have a comma. That no word is bare is seen above, in all states."""
    spanish, source = own("page", "es"), own("page", SOURCE)
    source.pop("document.language")  # which the switch says
    english = {text for text in source.values() if text not in spanish.values() and "{" not in text}
    fixed = set(spanish.values())
    found, points = {}, {}
    for query, acts in list(STATES.items())[:SPANISH]:
        page = open_page(query, script=DRAWN, locale="es-CO")
        for act in acts:
            page.evaluate(f"() => {{ {act}; }}")
        page.quiet()
        assert page.evaluate("() => [document.documentElement.lang, document.dir]") == ["es", "ltr"]
        said = {text.replace("\u00a0", " ").strip() for text in page.evaluate(WRITTEN, SAYING)}
        assert len(said & fixed) > 30
        found |= {text: query for text in said & english}
        points |= {text: query for text in said if POINT.match(text)}
        page.close()
    assert found == {} and points == {}


def test_the_switch_shows_the_same_in_the_other_language_and_is_remembered(open_page):
    page = open_page("?scene=free-rod&mass_ratio=2.5&method=modal&modes=20", own=True)
    expect(page.tab.get_by_role("button", name="English")).to_have_count(0)
    page.tab.get_by_role("button", name="Español").click()
    page.tab.wait_for_url("**language=es**")
    page.laid_out()
    assert page.evaluate(SPOKEN) == "es"
    assert [page.header("chosen")[name] for name in ("scene", "mass_ratio", "modes")] == ["free-rod", 2.5, 20]
    expect(page.tab.get_by_label("Razón de masas, valor exacto")).to_have_value("2,5")
    page.show_scene("fixed-rod")
    page.wait("() => !location.search.includes('scene') && location.search.includes('language=es')")
    page.tab.goto(f"http://{page.address}/")  # at the next visit
    page.laid_out()
    assert page.evaluate(SPOKEN) == "es"
    assert page.evaluate("() => strikewave.page.opening.plan") == "opening"
    page.wait("() => !strikewave.page.history.resting")
    assert page.evaluate("() => location.search") == ""
    page.tab.get_by_role("button", name="English").click()
    page.tab.wait_for_url("**language=en**")
    page.laid_out()
    assert page.evaluate(SPOKEN) == SOURCE
    assert page.evaluate("() => strikewave.page.opening.plan") == "opening"


def test_the_switch_is_seen_at_the_top(open_page):
    page = open_page("")
    for size in [(1440, 900), (390, 844)]:
        page.resize(*size)
        box = page.tab.get_by_role("button", name="Español").bounding_box()
        assert box["y"] < 60 and box["x"] + box["width"] <= size[0] and box["height"] >= 28


def test_a_link_that_names_no_known_language_is_shown_in_english(open_page):
    page = open_page("?language=tlh&scene=free-rod", locale="es")
    assert page.evaluate(SPOKEN) == SOURCE
    assert page.header("chosen")["scene"] == "free-rod"


def test_a_language_alone_leaves_the_first_visit_as_it_is(open_page):
    page = open_page("?language=es")
    assert page.evaluate(SPOKEN) == "es"
    assert page.evaluate("() => strikewave.page.opening.plan") == "opening"


def test_a_lesson_is_in_the_language_of_the_page_and_links_to_the_next_keep_it(open_page):
    page = open_page("?lesson=bounce-twice&language=es")
    page.wait("() => strikewave.page.opening.teaching.lesson")
    assert page.evaluate("() => strikewave.page.opening.teaching.lesson.record.language") == "es"
    page.evaluate("() => strikewave.page.history.write()")
    assert page.evaluate("() => location.search") == "?lesson=bounce-twice&step=1&language=es"


def test_a_lesson_goes_on_in_the_other_language_and_is_left_in_it(open_page):
    page = open_page("?lesson=mass-on-a-rod&step=2&language=es", own=True, size=(820, 1180))
    page.wait("() => strikewave.page.opening.teaching.lesson?.at === 1")
    boxes = [each.bounding_box() for each in page.tab.locator(".topbar button:visible").all()]
    ends = sorted((box["x"], box["x"] + box["width"]) for box in boxes)
    assert all(end <= start for (_, end), (start, _) in pairwise(ends))  # none lies over another
    page.tab.get_by_role("button", name="English").click()
    page.wait("() => window.strikewave?.page.opening.teaching.lesson?.record.language === 'en'")
    assert page.evaluate("() => location.search") == "?lesson=mass-on-a-rod&step=2&language=en"
    page.tab.get_by_role("button", name="Leave the lesson").click()
    page.wait("() => window.strikewave && !strikewave.page.opening.teaching.on")
    assert page.evaluate("() => location.search.includes('language=en')")


def test_numbers_are_typed_with_a_comma_or_a_point(open_page):
    page = open_page("?language=es&layout=laboratory")
    field = page.tab.get_by_label("Razón de masas, valor exacto")
    for given, value in (("0,5", 0.5), ("0.25", 0.25)):
        page.answered(lambda given=given: type_into(field, given, "Enter"))
        assert page.header("chosen")["mass_ratio"] == value
        expect(field).to_have_value(str(value).replace(".", ","))


@pytest.mark.parametrize(
    "query, accepted, kept, language",
    [
        ("", "es-MX,en;q=0.5", "", "es"),
        ("", "en", "es", "es"),
        ("?language=en", "es", "es", "en"),
        ("?language=ES", "en", "en", "es"),
        ("?language=tlh", "es", "es", "en"),
        ("?language=", "es", "", "es"),
        ("?language=%FF%00&language=es", "en", "", "es"),
        ("", "es", "../../etc", "en"),
        ("?language=" + "es," * 3_000, "de", "", "es"),
    ],
)
def test_the_address_goes_before_the_switch_and_that_before_the_browser(server, query, accepted, kept, language):
    headers = {"Accept-Language": accepted} | ({"Cookie": f"{KEPT}={kept}"} if kept else {})
    asked = urllib.request.Request(f"http://{server}/{query}", headers=headers)
    text = urllib.request.urlopen(asked, timeout=SECONDS).read().decode()
    assert f'<html lang="{language}" dir="ltr">' in text and f"/text/{language}.js" in text


@pytest.mark.parametrize("accepted", ["", "de, fr;q=0.5", "*", "x" * 5_000, ",".join(["a-b"] * 900), "en;q", "\x00"])
def test_whatever_a_browser_accepts_there_is_a_language(accepted):
    assert language_for(accepted) == SOURCE


def test_languages_are_known_however_they_are_spelled(monkeypatch):
    monkeypatch.setattr(catalogues, "LANGUAGES", ("en", "pt-BR", "es"))
    found = [language_for(each) for each in ("PT-br", "es-CL,es;q=0.9,en;q=0.8", "EN-us", "pt-PT", "ES")]
    assert found == ["pt-BR", "es", "en", "en", "es"]
