"""Figures of analyses in a real browser: read, zoomed, saved and clicked there, while the server hears nothing."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

from .test_page import settled

MOST = 200  # modes that the page shows
LONG = 60_000  # ms: in a fresh copy kernels are compiled first
SHOWN = "name => strikewave.page.analyses[name].figure?.views && strikewave.page.analyses[name].answer"
PLACE = """([name, plot, x, y]) => {
  const { figure } = strikewave.page.analyses[name], part = figure.parts.find((each) => each.name === plot);
  const from = part.area.getBoundingClientRect(), [left, top] = figure.placeOf(plot, x, y);
  return [from.left + left, from.top + top];
}"""
RANGE = """([name, range]) => {
  const { start, end } = strikewave.page.analyses[name].figure.model(range);
  return [start, end];
}"""
STILL = """async (name) => {
  const { root } = strikewave.page.analyses[name], { top, height } = root.getBoundingClientRect();
  await new Promise((done) => setTimeout(done, 250));
  const now = root.getBoundingClientRect();
  return now.top === top && now.height === height; // drawn, and the page has scrolled to it
}"""


def shown(page, name):
    page.wait(SHOWN, name, timeout=LONG)
    page.tab.locator(f".analysis.{name} .figure-area").first.scroll_into_view_if_needed()
    page.wait(STILL, name)
    return page.tab.locator(f".analysis.{name}")


def point_of(page, label):
    """Where a point of the trade-off lies on the screen."""
    point = page.evaluate("label => strikewave.page.analyses.tradeoff.points.find((p) => p.label === label)", label)
    return page.evaluate(PLACE, ["tradeoff", "tradeoff", point["time"], point["size"]])


def alone(page):
    """Numbers of modes of the trade-off's points, those first that are farthest from all others: times are measured."""
    found = page.evaluate("() => strikewave.page.analyses.tradeoff.points.filter((p) => p.size).map((p) => p.label)")
    places = np.array([point_of(page, label) for label in found])
    apart = np.hypot(*(places[:, None] - places).T) + np.where(np.eye(len(found)), np.inf, 0.0)
    named = [(-far, int(label.partition("=")[2])) for far, label in zip(apart.min(axis=0), found, strict=True)
             if re.fullmatch(r"modal modes=\d+", label)]  # fmt: skip
    return [modes for _, modes in sorted(named) if modes <= MOST]


def test_a_point_is_read_under_the_pointer_and_a_click_chooses_its_method(open_page):
    page = open_page("?scene=free-rod&panel=tradeoff")
    panel = shown(page, "tradeoff")
    read, chosen, *_ = alone(page)
    x, y = point_of(page, f"modal modes={read}")
    page.tab.mouse.move(x - 3, y)
    page.tab.mouse.move(x, y)
    tip = page.tab.locator(".bk-Tooltip")
    named = f"{read} mode" + "s" * (read > 1)
    expect(tip).to_contain_text(named)
    expect(tip).to_contain_text("ms")
    expect(panel.locator(".point h3")).to_have_text(named)
    page.answered(lambda: page.tab.mouse.click(*point_of(page, f"modal modes={chosen}")))
    settled(page)
    assert (page.header("chosen")["method"], page.header("chosen")["modes"]) == ("modal", chosen)
    left, top = page.evaluate(PLACE, ["tradeoff", "tradeoff", 1e3, 1e-2])  # where nothing lies
    frames = page.quiet()
    page.tab.mouse.click(left, top)
    assert page.quiet() == frames


def test_the_best_are_marked_and_the_chosen_quantity_is_written_at_its_axis(open_page):
    page = open_page("?scene=free-rod&panel=tradeoff")
    panel = shown(page, "tradeoff")
    data = "() => strikewave.page.analyses.tradeoff.figure.model('points').data"
    best = "() => strikewave.page.analyses.tradeoff.points.map((p) => p.best_for.includes('peak-force'))"
    width = [
        size for size, is_best in zip(page.evaluate(data)["diameter"], page.evaluate(best), strict=True) if is_best
    ]
    assert width and min(width) > 10
    assert len(set(zip(page.evaluate(data)["colour"], page.evaluate(data)["marker"], strict=True))) > 4
    axis = "() => strikewave.page.analyses.tradeoff.figure.model('tradeoff-up').axis_label"
    assert page.evaluate(axis) == "error, % of its true value"
    claims = "() => strikewave.page.analyses.tradeoff.figure.model('claims').data.label.length"
    assert page.evaluate(claims) == 0
    panel.get_by_role("button", name="final velocity").click()
    assert page.evaluate(axis) == "error, % of the impact speed"
    assert page.evaluate(claims) > 0  # what methods say of their own error is of the rebound


def test_a_drag_zooms_and_all_is_shown_again_without_a_word_to_the_server(open_page):
    page = open_page("?scene=free-rod&panel=tradeoff")
    panel = shown(page, "tradeoff")
    whole = page.evaluate(RANGE, ["tradeoff", "tradeoff-x"])
    frames = page.quiet()
    page.tab.mouse.move(*page.evaluate(PLACE, ["tradeoff", "tradeoff", 2.0, 20.0]))
    page.tab.mouse.down()
    page.tab.mouse.move(*page.evaluate(PLACE, ["tradeoff", "tradeoff", 100.0, 0.1]), steps=5)
    page.tab.mouse.up()
    page.wait("() => strikewave.page.analyses.tradeoff.figure.model('tradeoff-x').start > 1.5")
    assert page.evaluate(RANGE, ["tradeoff", "tradeoff-x"]) == [
        pytest.approx(2.0, rel=0.1),
        pytest.approx(100.0, rel=0.1),
    ]
    panel.get_by_role("button", name="Show all").click()
    page.wait("whole => strikewave.page.analyses.tradeoff.figure.model('tradeoff-x').end === whole", whole[1])
    assert page.quiet() == frames


def test_a_zoom_in_one_map_is_one_in_all_and_so_is_a_choice(open_page):
    page = open_page("?panel=stability&axis=speed")  # as other tests ask, so that its maps may be there
    page.wait("() => strikewave.page.analyses.stability.known", timeout=2 * LONG)
    shown(page, "stability")
    page.resize(1280, 720)  # where the analysis has the room below the menu, too, and a map is in view at once
    dock = page.tab.locator(".dock.right").bounding_box()
    assert page.tab.locator(".wide").bounding_box()["width"] > 2.5 * dock["width"]
    expect(page.tab.locator(".stability .figure .bk-Canvas").first).to_be_in_viewport(ratio=0.7)
    page.tab.get_by_role("tab", name="Story").click()  # which has as much room as ever
    page.wait("() => strikewave.page.layout.right.clientHeight > 600")
    page.tab.get_by_role("tab", name="Analysis").click()
    page.resize(1440, 900)
    ranges = """() => strikewave.page.analyses.stability.figure.parts
      .map(({ name }) => strikewave.page.analyses.stability.figure.model(name).x_range.id)"""
    assert len(set(page.evaluate(ranges))) == 1
    page.tab.mouse.click(*page.evaluate(PLACE, ["stability", "modal", 2.0, 1.0]))
    said = page.tab.locator(".stability .figure .help")
    for k in range(6):
        expect(said.nth(k)).to_contain_text("A step of")
    here = """(name) => {
      const { figure, known } = strikewave.page.analyses.stability;
      strikewave.page.analyses.stability.load({ ...known, across: { ...known.across, name } });
      return figure.model('here').data.across.length;
    }"""
    assert page.evaluate(here, "speed") == 1
    assert page.evaluate(here, "contact_stiffness") == 0  # among which a rigid contact has no place


def test_a_figure_is_saved_as_a_picture(open_page, tmp_path):
    page = open_page("?panel=energy")
    panel = shown(page, "energy")
    with page.tab.expect_download() as download:
        panel.get_by_role("button", name="Save as SVG").click()
    assert download.value.suggested_filename == "strikewave-energy.svg"
    download.value.save_as(tmp_path / "energy.svg")
    text = (tmp_path / "energy.svg").read_text()
    assert text.startswith("<svg") and "share of the energy, %" in text and "impactor" in text
    with page.tab.expect_download() as download:
        panel.locator(".bk-tool-icon-save").click()
    assert download.value.suggested_filename == "strikewave-energy.png"
    download.value.save_as(tmp_path / "energy.png")
    assert (tmp_path / "energy.png").read_bytes().startswith(b"\x89PNG")


def test_the_numbers_of_a_figure_can_be_read(open_page):
    page = open_page("?panel=energy")
    panel = shown(page, "energy")
    panel.get_by_role("button", name="Show the numbers").click()
    rows = panel.locator(".numbers tbody tr")
    assert rows.count() > 10
    first = [float(cell) for cell in rows.first.locator("td").all_inner_texts()]
    assert first[0] == 0.0 and sum(first[1:]) == pytest.approx(100.0, abs=0.5)


def test_a_closed_panel_gives_its_figure_back(open_page):
    page = open_page()
    documents = page.evaluate("() => Bokeh.documents.length")
    for name, label in (("energy", "Energy over time"), ("ratios", "All mass ratios")):
        for _ in range(2):
            page.analysis(label)
            shown(page, name)
            assert page.evaluate("() => Bokeh.documents.length") == documents + 1
            page.analysis(label)
            expect(page.tab.locator(f".{name} .bk-Figure")).to_have_count(0)
            assert page.evaluate("() => Bokeh.documents.length") == documents


@pytest.mark.parametrize("name", ["energy", "ratios", "tradeoff"])
def test_figures_fit_a_phone(open_page, name):
    page = open_page(f"?panel={name}", size=(390, 844), has_touch=True)
    box = shown(page, name).locator(".figure-area").first.bounding_box()
    assert box["width"] > 300 and box["x"] >= 0 and box["x"] + box["width"] <= 390
    page.fits(390)
