"""Figures and tables of the thesis, opened as from the gallery: what they are about is there, and drawn."""

import pytest

import solvers
from app.choices.opened import opening_of
from bench.thesis import numbered

from ..conftest import Page

CHAPTERS = range(3, 11)

SEEN = """() => {
  const { page } = strikewave;
  const { analyses, frame, layout, opening, view } = page;
  const { isFinite } = Number;
  const drawn = ({ x, y }) => Array.from(y).filter((value, k) => isFinite(value) && isFinite(x[k])).length;
  const large = ({ clientHeight }) => clientHeight > 60;
  const seen = ({ root, area }) => root.checkVisibility() && !root.classList.contains('folded') && large(area);
  const charts = (view.stack?.charts ?? []).filter(([, chart]) => seen(chart));
  return {
    scene: frame.chosen.scene,
    plan: opening.plan,
    tab: opening.docked ? layout.tabs.selected : null,
    curves: Object.fromEntries(charts.map(([name, chart]) => [name, chart.content.series.map(drawn)])),
    read: [view.gauge?.what, view.cycle?.shown],
    place: view.gauge?.there ? view.gauge.place : null,
    time: (page.player.t + page.player.start) * page.player.trip,
    analyses: analyses.all.filter(({ open, root }) => open && root.checkVisibility()).map(({ name }) => name),
    numbers: [...page.root.querySelectorAll('.tab-panel:not([hidden]) canvas')].filter(large).length,
    picture: opening.section.shown ? opening.section.box.tall : view.stage.canvas.clientHeight,
  };
}"""


def is_seen(found: dict, name: str) -> str:
    """What is missing; nothing once all is there."""
    opening = opening_of(name)
    tab = opening.table()["tab"]
    if found["scene"] != name:
        return "the scene"
    if (found["plan"], found["tab"]) != (("docks", tab) if tab else ("opening", None)):
        return f"the tab {tab}: {found['plan']}, {found['tab']}"
    for chart in opening.table()["charts"]:
        if tab == "charts" and max(found["curves"].get(chart, [0]), default=0) < 2:
            return f"a curve in {chart}: {found['curves']}"
    if opening.read and opening.read not in found["read"]:
        return f"{opening.read}: {found['read']}"
    if opening.place is not None and abs(found["place"] - opening.place) > 1e-9:
        return f"the gauge at {opening.place}: {found['place']}"
    if opening.time is not None and abs(found["time"] - opening.time) > 2e-3 * opening.time + 2e-9:
        return f"the time {opening.time}: {found['time']}"
    if missing := set(opening.views) - set(found["analyses"]):
        return f"analyses {missing}"
    if tab == "numbers" and not found["numbers"]:
        return "a chart in the numbers"
    return "" if found["picture"] > 40 else "the picture"


def chosen(chapter: int) -> list[str]:
    """Of its items, the first of each kind of body that opens each kind of charts, tab and analyses."""
    kinds = {}
    for name in numbered():
        if name.split("-")[1].split(".")[0] == str(chapter):
            opening, body = opening_of(name), type(solvers.load(name).target)
            said = opening.table()["tab"], opening.charts, opening.views, opening.read
            kinds.setdefault((body, *said, opening.place is None, opening.time is None), name)
    return list(kinds.values())


@pytest.fixture(scope="module")
def shared(browser, server, windows):
    """One page, which goes from item to item."""
    page = Page(browser, server, "", windows=windows)
    yield page
    page.close()
    assert [error for error in page.errors if "GL Driver" not in error] == page.foreign == []


@pytest.mark.parametrize("chapter", CHAPTERS)
@pytest.mark.browser
def test_what_an_item_of_the_thesis_is_about_is_seen(shared, chapter):
    page, missing = shared, {}
    for name in chosen(chapter):
        page.show_scene(name)
        for _ in range(40):
            missing[name] = is_seen(page.evaluate(SEEN), name)
            if not missing[name]:
                del missing[name]
                break
            page.frames_pass(3)
    assert not missing


def test_the_dock_that_a_scene_has_opened_closes_with_it_and_that_of_a_hand_stays(open_page):
    page = open_page("")
    page.show_scene("figure-4.12")
    page.wait("() => strikewave.page.opening.plan === 'docks'")
    page.show_scene("free-rod")
    page.wait("() => strikewave.page.opening.plan === 'opening'")
    page.tab.get_by_role("navigation", name="Look closer").get_by_role("button", name="Story").click()
    page.show_scene("figure-4.12")
    page.frames_pass(10)
    assert page.evaluate(SEEN)["tab"] == "story"
    page.show_scene("free-rod")
    page.frames_pass(10)
    assert page.evaluate(SEEN)["plan"] == "docks"


def test_back_and_forward_lead_to_the_dock_as_it_was_seen(open_page):
    """Else what a scene opens by itself would be a step of its own, and those ahead were lost."""
    page = open_page("")
    page.show_scene("figure-4.12")
    page.wait("() => strikewave.page.opening.plan === 'docks' && location.search.includes('tab=charts')")
    page.show_scene("figure-8.20")
    page.wait("() => location.search.includes('tab=analysis')")
    page.show_scene("free-rod")
    page.wait("() => strikewave.page.opening.plan === 'opening' && !location.search.includes('tab=')")
    seen = [("figure-8.20", "analysis"), ("figure-4.12", "charts"), ("fixed-rod", None)]
    ways = [page.tab.go_back] * 3 + [page.tab.go_forward] * 3
    for way, (scene, tab) in zip(ways, [*seen, *seen[1::-1], ("free-rod", None)], strict=True):
        way()
        page.wait("scene => strikewave.page.frame.chosen.scene === scene && !strikewave.page.asked", scene)
        page.frames_pass(20)
        found = page.evaluate(SEEN)
        assert (found["scene"], found["tab"]) == (scene, tab)
    assert page.evaluate("() => strikewave.page.history.top") == 3


@pytest.mark.browser
def test_velocities_of_mass_and_rod_cross_three_times(shared):
    page = shared
    page.show_scene("figure-4.19")
    page.wait("() => strikewave.page.view.gauge.over.content.series.length > 2")
    crossings = page.evaluate("""() => {
      const { page } = strikewave;
      const [face] = page.view.gauge.over.content.series;
      const mean = page.view.gauge.over.content.series.find(({ style }) => style === 'prediction');
      const at = ({ x, y }, t) => {
        const k = Math.max(Array.from(x).findLastIndex((each) => each <= t), 0);
        const n = Math.min(k + 1, x.length - 1);
        return x[n] > x[k] ? y[k] + ((t - x[k]) / (x[n] - x[k])) * (y[n] - y[k]) : y[n];
      };
      const [, end] = page.frame.exact.contacts[0];
      const found = [];
      for (let k = 1; k < 4000; k++) {
        const [a, b] = [(k / 4000) * end, ((k + 1) / 4000) * end].map((t) => at(face, t) - at(mean, t));
        if (a * b < 0) found.push((k / 4000) * end);
      }
      return found;
    }""")
    assert crossings == pytest.approx([0.3466, 0.6172, 1.0921], abs=2e-3)
