"""Nothing overlaps, is cut, or is beyond the edge: words of the page and words on its pictures, at every size."""

import re
from itertools import pairwise
from math import hypot

import pytest
from playwright.sync_api import expect

from ..conftest import LABORATORY, Page
from ..fitting import DRAWN, INSTANTS, LARGE, UNREACHED, WRITTEN, lettered
from .hands import type_into


def fits(page) -> None:
    assert page.evaluate(DRAWN, INSTANTS) == []
    assert page.evaluate(WRITTEN) == []


@pytest.mark.parametrize(
    "size, scene",
    [
        ((1280, 720), "hammer-on-cantilever"),
        ((820, 1180), "bent-rods"),
        ((820, 1180), "semi-infinite-rod"),
        ((390, 844), "brick-on-floor"),
        ((390, 844), "spinning-ball"),
        ((1280, 720), "bouncing-on-piston"),
    ],
    ids=str,
)
def test_no_words_are_cut_or_lie_on_others(anew, size, scene):
    fits(anew(scene, size, panel="joints" if scene == "bent-rods" else ""))


SIZES = [(1920, 1080), (1440, 900), (1280, 720), (820, 1180), (390, 844)]


def fits_from(page, first: int) -> None:
    """In a window of one size, which then has the others."""
    for k in range(len(SIZES)):
        page.resize(*SIZES[(first + k) % len(SIZES)])
        fits(page)


@pytest.mark.parametrize("first, query", enumerate(["?layout=laboratory&language=es", "?panel=methods&language=es"]))
def test_the_laboratory_and_an_analysis_have_their_room_in_spanish(open_page, first, query):
    fits_from(open_page(query, size=SIZES[first]), first)


@pytest.fixture(scope="module")
def spanish(browser, server, windows):
    """The opening, which has the window as each test needs it."""
    page = Page(browser, server, "?language=es", windows=windows)
    yield page
    page.close()
    assert [error for error in page.errors if "GL Driver" not in error] == []
    assert page.foreign == []


IN_SPANISH = [
    "fixed-rod",
    "hammer-on-cantilever",
    "four-bar-moves",
    "brick-on-floor",
    "bouncing-ball",
    "newtons-cradle",
    "compound-pendulum",
]


@pytest.mark.parametrize("first, scene", enumerate(IN_SPANISH))
def test_what_is_said_in_spanish_has_its_room(spanish, first, scene):
    spanish.resize(*SIZES[first % len(SIZES)])
    if spanish.header("chosen")["scene"] != scene:
        spanish.show_scene(scene)
    fits_from(spanish, first)


SAID_ON_STAGE = """(share) => {
  const context = CanvasRenderingContext2D.prototype, { fillText } = context, said = [];
  context.fillText = function (text, ...place) { said.push(text); return fillText.call(this, text, ...place); };
  strikewave.page.player.go(share * strikewave.page.player.duration);
  context.fillText = fillText;
  return said;
}"""
EDGES = """(instants) => {
  const { page } = strikewave, context = CanvasRenderingContext2D.prototype, { strokeRect } = context;
  let [least, most] = [Infinity, -Infinity];
  context.strokeRect = function (x, y, width, height) {
    if (page.view.stage.canvas === this.canvas) [least, most] = [Math.min(least, x), Math.max(most, x + width)];
    return strokeRect.call(this, x, y, width, height);
  };
  for (const share of instants) page.player.go(share * page.player.duration);
  context.strokeRect = strokeRect;
  return [least, page.view.stage.root.clientWidth - most];
}"""


def test_no_front_is_named_before_it_has_set_out(anew):
    """At the touch it would tell a lesson's answer: what moves first."""
    page = anew()
    assert "front" not in page.evaluate(SAID_ON_STAGE, 0) and "front" in page.evaluate(SAID_ON_STAGE, 0.1)


@pytest.mark.parametrize("scene", ["split-hopkinson", "stepped-rod", "semi-infinite-rod"])
def test_rods_that_fly_off_stay_in_the_picture(anew, scene):
    page = anew(scene)
    assert min(page.evaluate(EDGES, INSTANTS)) > 0


DISCS = """(share) => {
  const { page } = strikewave, context = CanvasRenderingContext2D.prototype, { arc } = context, found = [];
  context.arc = function (x, y, radius, ...rest) {
    if (page.view.stage.canvas === this.canvas && radius > 10) found.push([x, y, radius]);
    return arc.call(this, x, y, radius, ...rest);
  };
  page.player.go(share * page.player.duration);
  context.arc = arc;
  return found;
}"""


def test_balls_of_a_cradle_stay_apart_and_all_their_forces_are_shown(anew):
    page = anew("newtons-cradle")
    for share in INSTANTS:
        balls = page.evaluate(DISCS, share)
        assert len(balls) == 5
        for (x, y, radius), (next_x, next_y, next_radius) in pairwise(balls):
            assert hypot(next_x - x, next_y - y) > 0.995 * (radius + next_radius)
    series = "(chart) => strikewave.page.view[chart].chart.own.series.length"
    assert [page.evaluate(series, chart) for chart in ("force", "displacements")] == [4, 5]
    said = page.evaluate(SAID_ON_STAGE, 1)
    assert "0.99" in said and [words for words in said if "movement drawn" in words]


def test_of_a_striker_that_has_flown_off_a_beam_it_is_said_how_far(anew):
    page = anew("hammer-on-cantilever")
    said = page.evaluate(SAID_ON_STAGE, 1)
    assert [words for words in said if re.fullmatch(r"mass: [\d.]+\smm beyond", words)]
    assert not [words for words in page.evaluate(SAID_ON_STAGE, 0) if "beyond" in words]


@pytest.mark.parametrize("first, query", enumerate(["", LABORATORY]))
def test_large_letters_have_their_room(open_page, first, query):
    """On the page of a rod, and then on that of a beam."""
    sizes = [SIZES[2:][(first + k) % 3] for k in range(3)]
    page = open_page(query, script=LARGE, size=sizes[0])
    assert page.evaluate("() => getComputedStyle(document.documentElement).fontSize") == "24px"
    check_large(page, sizes)
    page.resize(*sizes[2])
    page.show_scene("hammer-on-cantilever")
    check_large(page, sizes[2:] + sizes[:2])


def check_large(page, sizes) -> None:
    for size in sizes:
        page.resize(*size)
        fits(page)
        page.evaluate("() => strikewave.page.player.go(0.4 * strikewave.page.player.duration)")  # which has much to say
        caption = page.tab.locator(".caption")
        assert caption.evaluate("element => element.scrollHeight - element.clientHeight") <= 1
        clock = page.tab.locator(".pinned .clock")
        assert clock.evaluate("element => element.scrollWidth - element.clientWidth") <= 0


# The force in the window, in pixels of its plot, and those of the room for controls.
FORCE_AND_CONTROLS = """async () => {
  const { page } = strikewave, { chart } = page.view.force, { choices, tabbed } = page.layout;
  const room = choices.parentElement.getBoundingClientRect();
  if (tabbed) page.layout.show('charts');
  for (let k = 0; k < 3; k++) await new Promise((done) => requestAnimationFrame(done)); // as they find their room
  if (tabbed) chart.area.scrollIntoView();
  const { bottom, top } = chart.area.getBoundingClientRect();
  if (tabbed) page.layout.show('controls');
  return [Math.min(bottom, innerHeight) - Math.max(top, 0), room.height, room.width];
}"""


@pytest.mark.parametrize(
    "pixels, sizes",
    [(32, [(1440, 900), (1920, 1080), (1280, 720), (390, 844)]), (16, [(720, 450), (960, 540), (640, 360)])],
    ids=["letters of 32 px", "zoom of 200 %"],
)
def test_the_force_and_the_controls_are_there_however_large_letters_are(open_page, pixels, sizes):
    page = open_page(script=lettered(pixels), size=sizes[-1])
    for size in sizes:
        page.resize(*size)
        [force, *room] = page.evaluate(FORCE_AND_CONTROLS)
        assert force > 40 and min(room) > 200
        assert page.evaluate(WRITTEN) == []
    assert page.evaluate(UNREACHED) == []


def test_charts_that_a_scene_brings_are_folded_where_there_is_no_room_for_them(open_page):
    """After one of rigid links, which has no waves to show."""
    page = open_page("?scene=figure-6.6", size=(1280, 720))
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('scene', 'figure-6.10')"))
    page.wait(
        """() => strikewave.page.view.stack.charts.every(([, { area, root }]) =>
          root.hidden || root.classList.contains('folded') || area.clientHeight > 60)"""
    )


def test_the_clock_has_the_room_that_there_is(anew):
    page = anew(size=(1280, 720))
    track, player = (page.tab.locator(each).bounding_box()["width"] for each in (".pinned .track", ".pinned .player"))
    assert track > 0.25 * player


@pytest.mark.parametrize("size", [(1440, 900), (820, 1180), (390, 844)], ids=str)
def test_the_longest_title_is_read_whole(anew, size):
    page = anew("figure-7.1", size)
    shown = page.tab.locator(".field-scene .title")
    expect(shown).to_have_text(re.compile("^Figure 7.1: .* what the contact does$"))
    [box, own] = shown.evaluate("""element => {
      const range = document.createRange();
      range.selectNodeContents(element);
      return [element, range].map((each) => each.getBoundingClientRect()).map(({ top, bottom }) => [top, bottom]);
    }""")
    assert box[0] - 1 <= own[0] and own[1] <= box[1] + 1


def test_a_scene_whose_settings_are_changed_says_so(anew):
    """Its method is none of them; another scene, or the way back, has its own name again."""
    page = anew()
    shown, name = page.tab.locator(".field-scene .title"), "Steel rod fixed at the far end, struck by its own mass"
    expect(shown).to_have_text(name)
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('modes', 20)"))
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('mass_ratio', 2)"))
    expect(shown).to_have_text(f"{name} (changed)")
    page.turn_to("Numbers")
    expect(page.tab.locator("p.trust:visible").first).to_contain_text(f"Changed from the scene “{name}”: Mass ratio 2.")
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('scene', 'free-rod')"))
    expect(shown).not_to_contain_text("(changed)")


LABELS = """() => {
  const { page } = strikewave, { stage } = page.view;
  const context = CanvasRenderingContext2D.prototype, { fillText } = context, said = {};
  context.fillText = function (text, x, y) {
    const box = this.measureText(text), lines = [y - box.actualBoundingBoxAscent, y + box.actualBoundingBoxDescent];
    if (this.canvas === stage.canvas)
      said[text] = [x - box.actualBoundingBoxLeft, x + box.actualBoundingBoxRight, ...lines];
    return fillText.call(this, text, x, y);
  };
  page.player.go(-page.frame.duration);
  context.fillText = fillText;
  const rings = [[stage.x, stage.y], stage.hands.tip];
  return Object.entries(said).filter(([, [left, right, top, bottom]]) =>
    rings.some(([x, y]) => x > left - 4 && x < right + 4 && y > top - 4 && y < bottom + 4)).map(([text]) => text);
}"""


@pytest.mark.parametrize("scene", ["note-rod-friction", "percussion-rod"])
def test_words_beside_bodies_in_space_lie_on_no_handle(anew, scene):
    assert anew(scene, (390, 844)).evaluate(LABELS) == []


def test_what_is_wrong_with_a_value_is_seen_on_a_phone_in_the_unit_of_its_field(open_page):
    page = open_page(size=(390, 844))
    length = page.tab.locator(".body").nth(1).get_by_role("textbox", name="Length")
    length.evaluate("element => element.scrollIntoView({ block: 'end' })")
    type_into(length, "3 µm", "Enter")
    wrong = page.tab.locator(".wrong:visible")
    expect(wrong).to_be_in_viewport(ratio=1)
    expect(wrong).to_have_text("“3 µm” is not possible. Allowed: 0.01 mm to 1e7 mm.")
    expect(length).to_be_focused()
    assert length.evaluate("element => getComputedStyle(element).outlineStyle") == "solid"


def test_a_chain_has_no_rule_of_thumb(anew):
    """Which would go by a contact time that is known of one rod alone."""
    page = anew("split-hopkinson", panel="needs")
    expect(page.tab.locator(".analysis table.plan tr").first).to_be_visible()
    expect(page.tab.locator(".analysis:visible")).not_to_contain_text("Rule of thumb")


SAID = """(name) => {
  const context = CanvasRenderingContext2D.prototype, { fillText } = context, said = [];
  context.fillText = function (text, ...place) { said.push(text); return fillText.call(this, text, ...place); };
  strikewave.page.view[name].draw();
  context.fillText = fillText;
  return said;
}"""


def test_a_panel_that_has_nothing_says_why_and_draws_nothing(open_page):
    page = open_page("?scene=double-pendulum&panel=stability,convergence")
    for name in ("stability", "convergence"):
        page.wait("name => strikewave.page.analyses[name].root.textContent.includes('allowed:')", name)
    assert page.evaluate("() => strikewave.page.analyses.convergence.figure.root.hidden")
    expect(page.tab.locator(".toast")).to_be_hidden()


def test_where_the_waves_of_a_shorter_impact_end_is_said(anew):
    page = anew(mass_ratio=0.2)
    page.evaluate("() => strikewave.page.compare.keep()")
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('mass_ratio', 1.5)"))
    assert "the present run has ended" in page.evaluate(SAID, "spaceTime")


def test_a_method_that_knows_no_waves_says_so_where_they_would_be(anew):
    """And draws both rods rigid, each by its own motion."""
    page = anew("two-unequal-rods", method="rigid")
    assert "rigid bodies: no waves, so that the bodies are drawn rigid" in page.evaluate(SAID, "spaceTime")
    moved = page.evaluate("() => [...strikewave.page.view.field.profile(1, 'displacement', new Float64Array(31))]")
    mass, end = page.evaluate("() => [strikewave.page.view.field.mass(1), strikewave.page.view.field.end(1)]")
    assert (moved[0], moved[-1]) == (mass, end) and mass < 0 < end
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('scene', 'hammer-on-cantilever')"))
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('method', 'rigid')"))
    assert "no velocity by this method" in page.evaluate(SAID, "spaceTime")


CUT_CELLS = """(table) => [...strikewave.page.root.querySelectorAll(`${table} td`)]
  .filter(({ clientWidth, scrollWidth }) => scrollWidth > clientWidth).map(({ textContent }) => textContent)"""


def test_figures_of_a_convergence_lie_beside_one_another_on_a_phone(anew):
    beam = ("hammer-on-cantilever", CUT_CELLS, ".study-convergence")
    for scene, found, argument in (("table-6.6", WRITTEN, None), beam):
        page = anew(scene, (390, 844), panel="convergence")
        page.wait("() => strikewave.page.analyses.convergence.fresh")
        page.wait("() => strikewave.page.root.querySelectorAll('.study-convergence tbody tr').length > 2")
        assert page.evaluate(found, argument) == []
