"""The widget of a folder without a server, as MyST has it: its module is copied elsewhere, and its model only gets."""

from pathlib import Path

import pytest

from app.command.main import main

from .conftest import PLAIN, SECONDS

SRC = "impact/index.html?scene=free-rod&mass_ratio=4"
WIDGET = """async (values) => {
  const { default: widget } = await import('/copied/widget.mjs');
  const off = () => { throw new Error('not there'); };
  const model = { get: (name) => values[name], set: off, on: off, off, save_changes: off };
  const root = document.getElementById('here').attachShadow({ mode: 'open' });
  window.remove = await widget.render({ model, el: root.appendChild(document.createElement('div')) });
}"""
COUNTED = """() => {
  window.listening = new Set();
  const { addEventListener: add, removeEventListener: drop } = window;
  window.addEventListener = (kind, each) => {
    if (kind === 'message') listening.add(each);
    add.call(window, kind, each);
  };
  window.removeEventListener = (kind, each) => {
    listening.delete(each);
    drop.call(window, kind, each);
  };
}"""
HEIGHT = "document.getElementById('here').shadowRoot.querySelector('iframe').getBoundingClientRect().height"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("static") / "impact"
    assert main(["export-static", str(place)]) == 0
    (place.parent / "copied").mkdir()
    (place / "widget.js").rename(place.parent / "copied/widget.mjs")
    (place.parent / "page.html").write_text("<!DOCTYPE html><div id='here'></div><iframe id='other'></iframe>")
    return place


@pytest.fixture
def tab(windows, folder, served):
    options = {"reduced_motion": "reduce"}
    page = windows.take((1280, 720), options)
    page.goto(served.replace(folder.name, "page.html"))
    yield page
    windows.give(page, f"{served}/{PLAIN}", options)


def shown(tab, **values):
    tab.evaluate(WIDGET, values)
    inside = tab.locator("#here iframe").element_handle().content_frame()
    inside.wait_for_function("() => window.strikewave?.frames > 0", timeout=SECONDS)
    return inside


def test_it_shows_what_its_address_asks_for_and_answers_a_slider(tab):
    inside = shown(tab, src=SRC, title="A mass strikes a rod")
    chosen = inside.evaluate("() => strikewave.page.frame.chosen")
    assert (chosen["scene"], chosen["mass_ratio"]) == ("free-rod", 4)
    assert tab.get_by_title("A mass strikes a rod").count() == 1
    assert inside.get_by_role("link", name="Open in full").count() == 1  # embedded
    inside.get_by_role("slider", name="Mass ratio").press("ArrowRight")
    inside.wait_for_function("() => strikewave.page.frame.chosen.mass_ratio > 4", timeout=SECONDS)


def test_it_is_as_high_as_its_own_frame_says(tab):
    inside = shown(tab, src=SRC)
    tab.set_viewport_size({"width": 390, "height": 844})
    tab.wait_for_function(f"() => Math.abs({HEIGHT} - 720) > 1", timeout=SECONDS)
    inside.wait_for_function("() => strikewave.page.root.scrollHeight <= innerHeight", timeout=SECONDS)
    before = tab.evaluate(HEIGHT)
    tab.evaluate("() => { window.heard = 0; addEventListener('message', () => { heard += 1; }); }")
    say = "(said) => parent.postMessage(said, '*')"
    tab.locator("#other").element_handle().content_frame().evaluate(say, {"strikewave": 1, "height": 99})
    for said in ({"strikewave": 2, "height": 99}, {"strikewave": 1, "height": "none"}, {"strikewave": 1}, None):
        inside.evaluate(say, said)
    tab.wait_for_function("() => heard >= 5", timeout=SECONDS)
    assert tab.evaluate(HEIGHT) == before
    inside.evaluate(say, {"strikewave": 1, "height": 1e9})
    tab.wait_for_function(f"() => {HEIGHT} === 4000", timeout=SECONDS)


def test_it_goes_with_frame_and_listener(tab):
    tab.evaluate(COUNTED)
    shown(tab, src=SRC)
    assert tab.evaluate("() => listening.size") == 1
    tab.evaluate("() => window.remove()")
    assert tab.evaluate(
        "() => [listening.size, document.querySelector('#here').shadowRoot.firstChild.childElementCount]"
    ) == [0, 0]
    assert [frame for frame in tab.frames if "index.html" in frame.url] == []


HARMFUL = ("javascript:parent.stolen=1", "data:text/html,x", "JAVASCRIPT:1", "blob:x")
NONE = [(None, "undefined"), ("", '""'), (7, "7"), ("http://", '"http://"'), *((src, f'"{src}"') for src in HARMFUL)]


def test_an_address_that_is_none_is_refused_in_one_line(tab):
    for src, got in NONE:
        values = {"error": "Invalid JSON5/JSON supplied."} if src is None else {"src": src}
        said = tab.evaluate(f"(values) => ({WIDGET})(values).catch(({{ message }}) => message)", values)
        assert said == f"src: got {got}; allowed: an address of the laboratory, such as Copy link gives"
        assert tab.locator("#here iframe").count() == 0
        tab.reload()
