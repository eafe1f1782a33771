"""The folder without a server in each language: by the browser, the switch or a link, with the same scene."""

import pytest
from playwright.sync_api import expect

from app.command.main import main
from solvers.text.catalogue import SOURCE

from ..page.test_language_page import DRAWN, SAYING, SPOKEN, WRITTEN
from ..test_translations import own
from .conftest import SECONDS, SHOWN

LESSON = "bounce-twice"
TAUGHT = "() => window.strikewave?.page.opening.teaching.lesson"
STATES = {  # a query, and what is done then
    "": ("strikewave.page.help.open()", "strikewave.page.compare.keep()", "strikewave.page.scenes.open()"),
    "?scene=free-rod&law=hertz&tab=numbers&layout=docks": (),
    "?scene=xylophone-bar&tab=story&layout=docks": (),
    "?scene=newtons-cradle&mass_ratio=1e9&elements=5": (),
    f"?lesson={LESSON}": (),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("static") / "impact"
    assert main(["export-static", str(place), "--lessons"]) == 0
    return place


def chosen(tab) -> list:
    return tab.evaluate("() => ['scene', 'mass_ratio', 'law'].map((name) => strikewave.page.frame.chosen[name])")


def test_a_browser_in_spanish_is_shown_no_english(opened):
    english, spanish = (own("page", language) | own("library", language) for language in (SOURCE, "es"))
    english.pop("document.language")  # which the switch says
    bare = {text for text in english.values() if text not in spanish.values() and "{" not in text}
    for query, acts in STATES.items():
        tab = opened(query, locale="es-ES", before=DRAWN)
        tab.wait_for_timeout(500)
        for act in acts:
            tab.evaluate(f"() => {{ {act}; }}")
        assert tab.evaluate("() => [document.documentElement.lang, document.dir]") == ["es", "ltr"]
        assert tab.title() == spanish["document.title"]
        said = {text.replace("\u00a0", " ").strip() for text in tab.evaluate(WRITTEN, SAYING)}
        assert len(said & set(spanish.values())) > 30 and said & bare <= {english["document.about"]}
        assert tab.errors == []


def test_the_switch_shows_the_same_in_the_other_language_and_is_remembered(opened, folder):
    tab = opened("?scene=free-rod&mass_ratio=2.5&law=hertz", locale="es-ES")
    expect(tab.get_by_role("button", name="Español")).to_have_count(0)
    tab.get_by_role("button", name="English").click()
    tab.wait_for_url("**language=en**")
    tab.wait_for_function(SHOWN, timeout=SECONDS)
    assert chosen(tab) == ["free-rod", 2.5, "hertz"]
    expect(tab.get_by_label("Mass ratio, exact value")).to_have_value("2.5")
    tab.goto(f"{folder.as_uri()}/index.html")  # at the next visit
    tab.wait_for_function(SHOWN, timeout=SECONDS)
    assert tab.evaluate(SPOKEN) == SOURCE
    assert tab.errors == []


@pytest.mark.parametrize(
    "query, locale, language",
    [("?language=es", "en-US", "es"), ("?language=EN&x", "es", "en"), ("?language=tlh", "es", "en"), ("", "de", "en")],
)
def test_a_link_goes_before_the_browser_and_what_is_not_known_is_english(opened, query, locale, language):
    assert opened(query, locale=locale).evaluate(SPOKEN) == language


def test_a_lesson_goes_on_in_the_other_language(opened):
    tab = opened(f"?lesson={LESSON}&step=2&language=es", script=TAUGHT)
    assert tab.evaluate("() => strikewave.page.opening.teaching.lesson.record.language") == "es"
    tab.get_by_role("button", name="English").click()
    tab.wait_for_url("**language=en**")
    tab.wait_for_function(TAUGHT, timeout=SECONDS)
    assert tab.evaluate("() => strikewave.page.opening.teaching.lesson.record.language") == SOURCE
    assert tab.evaluate("() => location.search") == f"?lesson={LESSON}&step=2&language=en"


def test_a_frame_that_may_keep_nothing_has_the_switch_too(browser, folder, served):
    frame = f'<iframe sandbox="allow-scripts" src="{folder.name}/index.html" width="900" height="700"></iframe>'
    (folder.parent / "course.html").write_text(frame)
    tab = browser.new_page()
    tab.goto(served.replace(folder.name, "course.html"))
    tab.frames[1].wait_for_function(SHOWN, timeout=SECONDS)
    tab.frames[1].get_by_role("button", name="Español").click()
    tab.frames[1].wait_for_function(f"() => ({SPOKEN})() === 'es' && ({SHOWN})()", timeout=SECONDS)
    tab.close()


def test_what_is_missing_is_said_in_the_language_of_the_browser(opened, folder):
    (folder / "scenes.js").rename(folder / "moved.js")
    try:
        tab = opened(locale="es", script="() => document.querySelector('.closed')")
        assert "falta un archivo de su carpeta" in tab.locator(".closed").inner_text()
    finally:
        (folder / "moved.js").rename(folder / "scenes.js")
