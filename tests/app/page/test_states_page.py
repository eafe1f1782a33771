"""What did not fit in states that bench.states takes pictures of: menus, refusals, kept solutions, other schemes."""

import pytest
from playwright.sync_api import expect

from ..fitting import DRAWN, INSTANTS
from .test_fit_page import SAID_ON_STAGE

PHONE = (390, 844)
KEEP = """() => { const { compare, frame } = strikewave.page; compare.keep(); return compare.runs.length; }"""
LINES = """(selector) => [...strikewave.page.root.querySelectorAll(selector)].map((e) => {
  const range = document.createRange();
  range.selectNodeContents(e);
  return new Set([...range.getClientRects()].map(({ bottom }) => Math.round(bottom))).size;
})"""


def kept(page, *ratios: float) -> None:
    """Solutions with these mass ratios."""
    for ratio in ratios:
        page.answered(lambda ratio=ratio: page.evaluate(f"() => strikewave.page.choose('mass_ratio', {ratio})"))
        page.evaluate(KEEP)


def test_a_narrow_plot_has_its_title_above_its_tools_and_what_is_scrolled_away_is_not_above_its_head(anew):
    page = anew(size=PHONE, panel="ratios")
    figure = page.tab.locator(".ratios .figure").first
    expect(figure.locator(".bk-Toolbar").first).to_be_visible()
    [title, tools] = [figure.locator(part).first.bounding_box() for part in ("h2", ".bk-Toolbar")]
    assert title["height"] > 10 and title["y"] + title["height"] <= tools["y"]
    assert page.evaluate("() => strikewave.page.analyses.ratios.figure.model('rebound').title.visible") is False
    page.resize(820, 1180)
    page.wait("() => strikewave.page.analyses.ratios.figure.views")
    above = """() => {
      const { root } = strikewave.page.analyses.ratios, wide = root.parentElement;
      wide.scrollTop = 300;
      const { left, top } = root.querySelector('.panel-head').getBoundingClientRect();
      return wide.scrollTop > 100 && root.contains(root.getRootNode().elementFromPoint(left + 40, top - 4));
    }"""
    assert page.evaluate(above) is False


def test_a_caption_is_read_whole_beside_the_way_back_from_a_zoom(open_page):
    page = open_page("?scene=hammer-on-cantilever&layout=opening", size=PHONE)
    page.evaluate("() => strikewave.page.view.axis.show([3e-4, 3.4e-4])")
    expect(page.tab.get_by_role("button", name="Show the whole impact")).to_be_visible()
    caption = page.tab.locator(".caption")
    page.wait("() => { const { root: c } = strikewave.page.caption; return c.scrollHeight <= c.clientHeight + 1; }")
    assert caption.bounding_box()["width"] > 200
    sizes = page.evaluate(
        """() => {
          const { caption, player, story } = strikewave.page;
          return story.events.events.map(([t]) => {
            player.go(t);
            const { fontSize, lineHeight } = getComputedStyle(caption.root);
            return `${fontSize}/${lineHeight}`;
          });
        }"""
    )
    assert len(sizes) > 5 and len(set(sizes)) == 1  # one for all that is said of an impact


def test_what_a_chart_says_under_a_pointer_is_in_the_window(anew):
    page = anew(size=PHONE)
    page.turn_to("Charts")
    box = page.tab.locator(".time-views canvas:visible").first.bounding_box()
    for share in (0.2, 0.45, 0.5, 0.55, 0.9):
        page.tab.mouse.move(box["x"] + share * box["width"], box["y"] + 0.4 * box["height"])
        tip = page.tab.locator(".time-views .tip:visible").first
        expect(tip).to_be_visible()
        edges = tip.bounding_box()
        assert edges["x"] >= 0 and edges["x"] + edges["width"] <= PHONE[0]


def test_heads_of_a_table_are_words_on_a_phone(anew):
    page = anew("bouncing-ball", PHONE, panel="bounces")
    expect(page.tab.locator(".bounces tbody tr").first).to_be_attached()
    assert max(page.evaluate(LINES, ".bounces th")) <= 2


def test_an_analysis_says_its_name_once(anew):
    page = anew(size=PHONE, panel="energy")
    page.wait("() => strikewave.page.analyses.energy.figure.views")
    page.laid_out()
    assert page.tab.locator(".energy h2:not(.unseen)").count() == 1


def test_a_menu_and_figures_of_kept_solutions_end_in_the_window_and_have_their_units_beside_them(anew):
    page = anew(size=(1280, 720))
    kept(page, 0.4, 0.8)
    page.tab.locator(".more-pins").click()
    box = page.tab.locator(".pins .menu").bounding_box()
    assert box["y"] + box["height"] <= 720
    page.tab.keyboard.press("Escape")
    kept(page, 1.2, 1.6)
    page.turn_to("Numbers")
    assert set(page.evaluate(LINES, ".side-by-side small")) <= {0, 1}


@pytest.mark.parametrize("scene", ["hammer-on-cantilever", "xylophone-bar"])
def test_a_striker_is_seen_whole_or_said_to_be_beyond(anew, scene):
    page = anew(scene, PHONE)
    cut = """() => {
      const { player, view: { stage } } = strikewave.page, found = [];
      for (let k = 0; k <= 60; k++) {
        player.go((k / 60) * player.duration);
        if (!stage.hit.flew && stage.hit.y < stage.hit.size - 0.5) found.push(k);
      }
      return found;
    }"""
    assert page.evaluate(cut) == []


def test_ends_of_diagrams_are_in_their_titles_and_answers_for_other_modes_are_awaited(open_page):
    """Where diagrams are low, and where an answer depends on how many modes there are."""
    page = open_page("?scene=table-6.10", size=(1280, 720))
    assert [words for words in page.evaluate(SAID_ON_STAGE, 0.1) if words.startswith("M") and "(±" in words]
    fresh = """(name) => {
      const { analyses, frame } = strikewave.page;
      return analyses[name].fresh({ chosen: { ...frame.chosen, modes: frame.chosen.modes - 1 } });
    }"""
    assert [page.evaluate(fresh, name) for name in ("mode_change", "energy")] == [False, True]


def test_what_a_ball_touches_is_a_ball(anew):
    assert "The ball touches the other ball." in anew("two-balls").tab.locator(".caption").inner_text()


def test_words_in_a_small_space_lie_on_no_others(open_page):
    page = open_page("?scene=brick-off-centre&speed=2&kept=A,speed:0.8&beside=A", size=PHONE)
    page.wait("() => strikewave.page.compare.beside")
    page.laid_out()
    assert page.evaluate(DRAWN, [*INSTANTS, 0.9]) == []


def test_a_scene_opens_its_analysis_each_time_it_is_come_back_to(open_page):
    page = open_page(size=PHONE)
    for scene in ("table-6.10", "fixed-rod", "table-6.10"):
        page.turn_to("Controls")
        page.answered(lambda scene=scene: page.evaluate(f"() => strikewave.page.controls.send('scene', '{scene}')"))
    page.wait("() => strikewave.page.layout.tabs.selected === 'analysis'")


def test_a_dark_scheme_of_high_contrast_has_the_scene_and_the_pictures_on_its_own_ground(open_page):
    page = open_page(forced_colors="active", color_scheme="dark")
    colours = """() => ['.topbar .scene', '.stages canvas'].map((each) => {
      const { backgroundColor, filter } = getComputedStyle(strikewave.page.root.querySelector(each));
      const dark = backgroundColor.match(/\\d+/g)?.slice(0, 3).every((part) => Number(part) < 60);
      return [dark, filter.startsWith('invert')];
    })"""
    [[dark, _], [_, turned]] = page.evaluate(colours)
    assert dark and turned


def test_an_impulse_is_written_beside_a_long_rod(anew):
    page = anew("percussion-rod")
    on_rod = """() => {
      const { stage } = strikewave.page.view, { fillText } = CanvasRenderingContext2D.prototype;
      let box = null;
      CanvasRenderingContext2D.prototype.fillText = function (text, x, ...rest) {
        const { actualBoundingBoxLeft: left, actualBoundingBoxRight: right } = this.measureText(text);
        if (text.startsWith('J =')) box = [x - left, x + right];
        return fillText.call(this, text, x, ...rest);
      };
      stage.draw(0);
      CanvasRenderingContext2D.prototype.fillText = fillText;
      return box[0] < stage.x && box[1] > stage.x;
    }"""
    assert page.evaluate(on_rod) is False
