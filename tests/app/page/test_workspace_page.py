"""The page as a workspace: what is where at each size, its clock, its first minute, and whether the picture is true."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

import solvers
from app.serving.still import INSTANT, colour, first_still
from app.text.catalogues import page as texts_of
from solvers.text.catalogue import SOURCE

from ..conftest import LABORATORY
from .hands import drag, type_into
from .test_page import settled

DESKS, HANDS = [(1280, 720), (1440, 900), (1920, 1080)], [(390, 844), (820, 1180)]  # sizes of windows
SIZES = {
    "?layout=opening": DESKS + HANDS,
    "?scene=hammer-on-cantilever": [DESKS[0], *HANDS],
    "?scene=brick-off-centre": DESKS + HANDS[:1],
}
IN_VIEW = """() => {
  const { page } = strikewave, seen = (element) => {
    const { top, bottom, left, right } = element.getBoundingClientRect();
    return top >= 0 && left >= 0 && bottom <= innerHeight && right <= innerWidth && bottom > top;
  };
  const said = page.root.dataset.size === 'phone' ? [] : [page.caption.root]; // there its events are in a tab
  return [page.view.stage.root, page.player.root, ...said].every(seen);
}"""
CHARTS = """() => strikewave.page.view.stack.charts.filter(([, { root }]) => !root.hidden).map(([, { area, root }]) => {
  const { bottom } = root.getBoundingClientRect();
  return bottom <= innerHeight ? area.clientHeight : -1;
})"""
WIDE = ["Which model is enough?", "Cost vs. accuracy", "Energy over time", "Stability"]
BESIDE = ["Choose method by error", "Compare with measured data"]
T = "() => strikewave.page.player.t"


def whole(page) -> bool:
    """Whether all of the page is in the window, at either end."""
    return page.evaluate(
        "() => { const { scrollHeight: h, scrollWidth: w } = document.documentElement; "
        "return h <= innerHeight && w <= innerWidth; }"
    )


@pytest.mark.parametrize("query", SIZES)
def test_stage_and_clock_are_in_view_at_every_size(show, query):
    for size in SIZES[query]:
        page = show(query, size=size)
        page.wait(IN_VIEW)
        assert whole(page)


@pytest.mark.parametrize("size, names", [((1440, 900), "Story Numbers Analysis"), ((390, 844), "Controls Charts")])
def test_tabs_stand_in_the_order_of_use(show, size, names):
    page = show(LABORATORY, size=size)
    assert page.tab.get_by_role("tab").all_inner_texts()[: len(names.split())] == names.split()


STRETCHED = """() => {
  const canvases = (root) => [...root.querySelectorAll('*')].flatMap((element) => [
    ...(element.tagName === 'CANVAS' ? [element] : []),
    ...(element.shadowRoot ? canvases(element.shadowRoot) : []),
  ]);
  const seen = canvases(document).filter((canvas) => canvas.getClientRects().length);
  return seen.filter((canvas) => {
    const { width, height } = canvas.getBoundingClientRect();
    return Math.abs(canvas.height - height) > 2 || Math.abs(canvas.width - width) > 2;
  }).length;
}"""


def test_no_chart_is_stretched_where_another_scene_hides_some(anew):
    page = anew()
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('scene', 'two-balls')"))
    page.wait(f"() => ({STRETCHED})() === 0")


@pytest.mark.parametrize("size, open_", [((1440, 900), 3), ((1280, 720), 2)])
def test_the_charts_share_the_room_that_there_is(open_page, size, open_):
    page = open_page(size=size)
    heights = page.evaluate(CHARTS)
    assert len(heights) == 6 and min(heights) >= 0  # a folded one has no height
    assert heights[3:] == [0, 0, 0]  # a place, an instant and the wall wait for who asks for them
    assert sum(height > 80 for height in heights) == open_
    page.tab.get_by_role("button", name="Fold: Contact force").click()
    page.wait(f"() => ({CHARTS})()[1] === 0 && ({CHARTS})()[2] > 80")  # which may have been folded for want of room
    page.tab.get_by_role("button", name="Unfold: Contact force").click()
    page.wait(f"() => ({CHARTS})()[1] > 80")
    assert sum(height > 80 for height in page.evaluate(CHARTS)) == open_


def test_what_is_opened_is_seen_and_the_stage_stays(anew):
    page = anew(size=(1280, 720))
    panel, charts = page.tab.locator("section.analysis:visible"), page.tab.locator(".charts")
    close = page.tab.get_by_role("button", name=re.compile("^Close: "))
    for label in WIDE + BESIDE:
        page.analysis(label)
        expect(panel).to_have_count(1)
        box = panel.bounding_box()
        assert 0 <= box["y"] < 500 and box["x"] >= 0, label
        page.wait(IN_VIEW)
        assert whole(page), label
        expect(charts).to_be_hidden() if label in WIDE else expect(charts).to_be_visible()
        page.analysis("Choose method by error" if label != "Choose method by error" else "Energy over time")
        close.first.click()
        page.wait(IN_VIEW)
        while panel.count():
            close.first.click()


def test_a_panel_can_be_widened_and_closed_where_it_is(anew):
    page = anew()
    page.analysis("Choose method by error")
    panel = page.tab.locator("section.auto")
    narrow = panel.bounding_box()["width"]
    panel.get_by_role("button", name=re.compile("^Wider")).click()
    page.wait("narrow => document.querySelector('div') && strikewave.page.layout.wide.clientWidth > narrow", narrow)
    assert panel.bounding_box()["width"] > 1.8 * narrow
    panel.get_by_role("button", name=re.compile("^Close")).click()
    expect(panel).to_be_hidden()
    expect(page.tab.locator(".charts")).to_be_visible()
    expect(page.tab.get_by_role("tab", name="Analysis")).to_be_visible()


def test_docks_are_moved_and_folded_and_the_browser_remembers(open_page):
    page = open_page()
    left = "() => strikewave.page.layout.left.clientWidth"
    before = page.evaluate(left)
    grip = page.tab.get_by_role("separator", name="Width of the controls")
    grip.focus()
    grip.press("ArrowRight")
    assert page.evaluate(left) == before + 24
    page.tab.get_by_role("button", name="Story, numbers and analysis").click()
    expect(page.tab.get_by_role("tab", name="Story")).to_be_hidden()
    page.tab.reload()
    page.laid_out()
    assert page.evaluate(left) == before + 24
    expect(page.tab.get_by_role("tab", name="Story")).to_be_hidden()


def test_a_browser_that_keeps_nothing_shows_the_page_all_the_same(open_page):
    page = open_page(
        own=True,
        script="""for (const name of ['localStorage', 'sessionStorage'])
             Object.defineProperty(window, name, { get() { throw new DOMException('no', 'SecurityError'); } });""",
    )
    page.tab.get_by_role("button", name="Controls", exact=True).click()
    expect(page.tab.get_by_role("slider", name="Mass ratio", exact=True)).to_be_hidden()
    assert page.errors == []


# --- the clock --------------------------------------------------------------------------------------------------------


def test_who_wants_no_motion_gets_none_jumps_to_events_and_takes_small_steps(open_page):
    page = open_page()
    t = page.evaluate(T)
    page.frames_pass(30)
    assert page.evaluate(T) == t and not page.evaluate("() => strikewave.page.player.playing")
    page.evaluate("() => strikewave.page.player.go(0.2)")
    page.tab.locator("h1").click()
    page.tab.keyboard.press("]")
    assert page.evaluate(T) == pytest.approx(0.5, abs=1e-3)
    expect(page.tab.locator(".caption")).to_contain_text("meets the fixed end")
    page.tab.keyboard.press("]")
    page.tab.keyboard.press("[")
    assert page.evaluate(T) == pytest.approx(0.5, abs=1e-3)
    page.tab.get_by_role("button", name="Step forward").click()
    step = page.evaluate(T) - 0.5
    assert 0 < step < 0.02
    page.evaluate("() => strikewave.page.axial.axis.show([0.4, 0.6])")
    before = page.evaluate(T)
    page.tab.keyboard.press(",")
    assert before - page.evaluate(T) == pytest.approx(0.2 / 250, rel=1e-3)  # of what is in view


def test_what_is_in_view_is_looped(open_page):
    page = open_page()
    page.evaluate("() => { strikewave.page.axial.axis.show([0.4, 0.5]); strikewave.page.player.go(0.45); }")
    page.evaluate("() => { strikewave.page.player.pace.value = '1'; strikewave.page.player.toggle(); }")
    page.wait("() => strikewave.page.player.t < 0.44")
    assert page.evaluate(T) >= 0.4
    bar = page.tab.get_by_role("slider", name="Time, of what is in view")  # the time bar spans it, too
    drag(bar, 0.5)
    assert page.evaluate("() => strikewave.page.player.bar") == pytest.approx([0.4, 0.5])
    page.evaluate("() => strikewave.page.player.loop()")
    page.wait("() => !strikewave.page.player.playing")  # at the end of the bar, which is what plays
    assert page.evaluate(T) == pytest.approx(0.5)


def test_the_pace_can_be_a_share_of_real_time(show):
    page = show("?scene=hammer-on-cantilever")
    page.tab.get_by_label("Pace").first.select_option("1/20000")
    per_second = page.evaluate("() => { const { player: p } = strikewave.page; return p.perSecond * p.pace.speed; }")
    assert per_second * page.header("trip") == pytest.approx(1 / 20_000)


# --- the first minute -------------------------------------------------------------------------------------------------


def test_the_page_moves_by_itself_and_waits_where_a_caption_speaks(open_page):
    page = open_page(reduced_motion="no-preference")
    page.wait("() => strikewave.page.player.t > 0.05")
    page.wait("() => strikewave.page.player.waits > performance.now() + 1000")
    assert page.evaluate(T) == pytest.approx(0.5, abs=1e-3)
    expect(page.tab.locator(".caption")).to_contain_text("meets the fixed end")
    page.wait("() => strikewave.page.player.t > 0.55")
    page.evaluate("() => strikewave.page.player.go(strikewave.page.player.duration - 0.01)")
    page.wait("() => strikewave.page.player.playing && strikewave.page.player.t < 0.5")


def test_the_page_itself_holds_a_still_of_the_first_scene(open_page):
    page = open_page("", drawn=False)
    text = page.context.request.get(page.tab.url).text()
    assert first_still(texts_of(SOURCE)) in text
    page.laid_out()
    expect(page.tab.locator("#still")).to_have_count(0)


def test_the_still_shows_what_the_library_says():
    exact = solvers.solve(solvers.load("fixed-rod"))
    rod = exact.scene.target
    stress = first_still(texts_of(SOURCE))
    fills = re.findall(r'fill="(#\w{6})"/>', stress)[:120]
    front = sum(fill != colour(0.0, 1.0) for fill in fills) / 120
    assert front == pytest.approx(2 * INSTANT, abs=1 / 120)  # how far the front has run
    places = (np.arange(120) + 0.5) / 120 * rod.length
    now = np.array([INSTANT * rod.round_trip_time])
    values = exact.motion.stress(now, places)[0]
    red = [int(fill[3:5], 16) for fill in fills]  # the stronger the compression, the less green
    assert np.corrcoef(red, values)[0, 1] < -0.95  # colours are linear piece by piece


def test_symbols_explain_themselves_to_pointer_and_keyboard(anew):
    page = anew()
    tip = page.tab.get_by_role("tooltip")
    page.tab.locator(".symbols .term", has_text="T").first.hover()
    expect(tip).to_contain_text("T: round trip")
    expect(tip).to_contain_text("source thesis (4.10)")
    page.tab.get_by_text("Mass ratio", exact=True).hover()
    expect(tip).to_contain_text("the striker is heavier")
    page.tab.get_by_role("slider", name="Impact speed", exact=True).focus()
    page.tab.keyboard.press("Tab")
    page.tab.keyboard.press("Shift+Tab")
    page.tab.keyboard.press("Escape")
    expect(tip).to_be_hidden()


def test_what_a_field_explains_of_itself_is_no_bar_to_the_next_slider(anew):
    page = anew()
    field = page.tab.get_by_label("Mass ratio, exact value")
    field.click()
    tip = page.tab.get_by_role("tooltip")
    expect(tip).to_be_visible()
    dock = page.tab.locator(".controls").bounding_box()
    assert tip.bounding_box()["x"] >= dock["x"] + dock["width"]  # beside the controls, and not on them
    page.answered(lambda: type_into(field, "2", "Enter"))
    expect(tip).to_be_hidden()
    slider = page.tab.get_by_role("slider", name="Impact speed", exact=True).bounding_box()
    page.tab.mouse.move(slider["x"] + 0.5 * slider["width"], slider["y"] + 0.5 * slider["height"])
    page.tab.mouse.down()
    page.answered(
        lambda: page.tab.mouse.move(slider["x"] + 0.8 * slider["width"], slider["y"] + 0.5 * slider["height"])
    )
    page.tab.mouse.up()


def test_a_scene_is_the_same_wherever_one_comes_from(anew):
    page = anew(modes=7, restitution=0.3)
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('scene', 'free-rod')"))
    chosen, own = page.header("chosen"), page.header("own")
    assert (chosen["modes"], chosen["restitution"]) == (own["modes"], own["restitution"])
    page.wait("() => location.search === '?scene=free-rod&layout=laboratory'")


@pytest.mark.parametrize(("scene", "hidden"), [("split-hopkinson", True), ("semi-infinite-rod", False)])
def test_what_does_not_act_on_a_chain_is_not_shown(show, scene, hidden):
    page = show(f"?scene={scene}")
    expect(page.tab.get_by_role("slider", name="Modes", exact=True)).to_be_hidden()
    beside = page.tab.get_by_label("Compare with", exact=True)
    expect(beside).to_be_visible(visible=not hidden)
    if not hidden:
        assert beside.evaluate("each => each.selectedOptions[0].textContent") == "Nothing (exact waves alone)"


@pytest.mark.parametrize("query", ["?layout=opening", "?scene=hammer-on-cantilever", "?scene=two-equal-rods"])
def test_the_striker_is_pulled_back_for_speed(show, query):
    page = show(query)
    place = page.evaluate(
        """() => { const { canvas, striker } = strikewave.page.view.stage, from = canvas.getBoundingClientRect();
                   const { x, y, way } = striker.drawn; return [from.left + x, from.top + y, ...way]; }"""
    )
    before = page.header("chosen")["speed"]
    x, y, across, down = place
    page.tab.mouse.move(x, y)
    page.tab.mouse.down()
    page.answered(lambda: page.tab.mouse.move(x - 70 * across, y - 70 * down, steps=3))
    page.tab.mouse.up()
    settled(page)
    assert page.header("chosen")["speed"] == pytest.approx(2 * before, rel=0.01)
    expect(page.tab.get_by_label("Impact speed, exact value")).to_have_value(f"{2 * before:g}")


def test_the_corner_of_the_striker_sets_its_mass(anew):
    page = anew()
    x, y, size = page.evaluate(
        """() => { const { canvas, striker } = strikewave.page.view.stage, from = canvas.getBoundingClientRect();
                   const { x, y, width } = striker.drawn; return [from.left + x, from.top + y, width]; }"""
    )
    page.tab.mouse.move(x - size / 2, y - size / 2)
    page.tab.mouse.down()
    page.answered(lambda: page.tab.mouse.move(x - size / 2 - 6, y - size / 2, steps=2))
    page.tab.mouse.up()
    settled(page)
    assert page.header("chosen")["mass_ratio"] == pytest.approx((size / (size + 6)) ** 6, rel=0.01)


# --- the picture ------------------------------------------------------------------------------------------------------

DEEPEST = """() => {
  const { page } = strikewave, { stage, frame, field } = page.axial;
  let deepest = 0, when = 0;
  for (let k = 0; k <= 400; k++) {
    const t = k / 400 * frame.duration, depth = field.mass(t) - field.end(t);
    if (depth > deepest) [deepest, when] = [depth, t];
  }
  page.player.go(when);
  const { x, y, width } = stage.striker.drawn;
  const face = x + width / 2, overlap = deepest * stage.scale, ratio = devicePixelRatio;
  const c = stage.canvas.getContext('2d');
  const colour = (at) => [...c.getImageData(Math.round(at * ratio), Math.round((y - 8) * ratio), 1, 1).data];
  const meet = face - overlap / 2, metres = deepest * frame.speed * frame.trip, { radius } = frame.impactor;
  return { overlap, width, inside: colour(meet - 5), beyond: colour(meet + 5), metres, factor: stage.factor, radius };
}"""


@pytest.mark.parametrize("scene", ["two-balls", "sphere-on-half-space"])
def test_compact_bodies_press_each_other_in_and_never_lie_in_one_another(show, scene):
    page = show(f"?scene={scene}")
    drawn = page.evaluate(DEEPEST)
    assert 0 < drawn["overlap"] < 0.2 * drawn["width"]
    assert max(drawn["inside"][:3]) < 130  # the dark striker
    assert drawn["beyond"][2] > 190  # and beyond the middle of the indentation the struck body
    # what is stated: movement over the ball's own scale
    own = drawn["width"] / (2 * drawn["radius"])
    assert drawn["overlap"] / drawn["metres"] / own == pytest.approx(drawn["factor"], rel=1e-6)


def test_two_balls_are_balls(show):
    page = show("?scene=two-balls")
    assert page.header("target")["shape"] == "ball"
    sizes = page.evaluate("() => [strikewave.page.axial.stage.striker.drawn.width]")
    assert sizes[0] > 20
    assert page.header("target")["radius"] / page.header("impactor")["radius"] == pytest.approx(1.5)


def test_a_unit_stands_beside_its_number_however_narrow_the_column_is(show):
    """As where a scroll bar takes of its width, which the browser of the tests has none of."""
    page = show(LABORATORY)
    apart = page.evaluate(
        """() => {
          const { root } = strikewave.page.controls, found = [];
          const heads = [...root.querySelectorAll('.field-head')].filter((head) => head.checkVisibility());
          for (let width = 200; width <= 400; width += 5) {
            root.style.width = `${width}px`;
            for (const head of heads) {
              const [number, unit] = ['.number', '.unit'].map((each) => head.querySelector(each));
              if (unit.offsetWidth && unit.offsetTop > number.offsetTop + 10) found.push([width, head.textContent]);
            }
          }
          return [heads.length, found];
        }"""
    )
    assert apart[0] > 3 and apart[1] == []
