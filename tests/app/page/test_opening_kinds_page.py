"""The opening of each kind of scene: how much of it its picture has, and what it shows closer."""

import re
from itertools import pairwise

import numpy as np
import pytest
from playwright.sync_api import expect

import solvers

from .test_opening_page import SIZES, opened

DESKS, HANDS = SIZES[:2], SIZES[2:]


@pytest.mark.parametrize("size", DESKS)
def test_every_impact_of_a_mechanism_is_named_or_counted_and_can_be_reached(show, size):
    page = show("?scene=four-bar-moves&layout=opening", size=size)
    page.wait("() => strikewave.page.opening.section.tracks.length")
    impacts = page.header("main")["contacts"]
    names = page.tab.locator(".happens li:not(.more):visible")
    more = page.tab.locator(".happens .more:visible")

    def counted() -> int:
        hidden = [int("".join(filter(str.isdigit, each))) for each in more.all_inner_texts()]
        return names.count() + sum(hidden)

    assert impacts > 10 and counted() == impacts
    last = names.filter(has_text=f"Impact {impacts}")
    while not last.count():
        more.last.get_by_role("button").click()
        assert counted() == impacts
    last.get_by_role("button").click()
    expect(last).to_have_attribute("aria-current", "")
    boxes = [each.bounding_box() for each in page.tab.locator(".happens li:visible").all()]
    low = page.tab.locator(".section").bounding_box()
    assert all(a["y"] + a["height"] <= b["y"] + 1 for a, b in pairwise(boxes))
    assert boxes[-1]["y"] + boxes[-1]["height"] <= low["y"] + low["height"] + 4
    page.evaluate("() => strikewave.page.player.seek(0)")
    expect(names.first).to_contain_text("Impact 1")  # those about the clock are seen


def test_a_phone_names_every_impact(show):
    page = show("?scene=four-bar-moves&layout=opening", size=HANDS[1])
    expect(page.tab.locator(".happens li:visible")).to_have_count(page.header("main")["contacts"])


def test_names_of_curves_end_within_a_phone(open_page):
    page = open_page("?scene=two-balls&layout=opening&language=es", size=HANDS[1])
    opened(page)
    ends, width = page.evaluate("""() => {
      const { box, words } = strikewave.page.opening.section;
      return [words.all.map((word) => word.box[2]), box.width];
    }""")
    assert len(ends) > 5 and max(ends) <= width


def test_impulses_that_take_no_time_are_drawn_as_such(show):
    """By balances there is no force: its track had nothing in it, from 0 to 0."""
    page = show("?scene=spring-mass&layout=opening")
    page.wait("() => strikewave.page.opening.section.tracks.length")
    track = page.evaluate("() => strikewave.page.opening.section.shown.tracks[0]")
    assert track["title"] == "Impulses" and track["range"][0] > 0
    assert len(track["bars"]) == len(page.header("exact")["contacts"])


LINKS = """() => {
  const { mechanism, root } = strikewave.page.view.stage;
  const points = mechanism.placed.flat();
  const [x, y] = [0, 1].map((k) => points.map((point) => point[k]));
  return [Math.min(...x), Math.max(...x), Math.min(...y), Math.max(...y), root.clientWidth, root.clientHeight];
}"""


@pytest.mark.parametrize(("scene", "size"), zip(["four-bar-moves", "four-bar"], DESKS, strict=True))
def test_a_linkage_has_the_height_beside_its_tracks(open_page, scene, size):
    page = open_page(f"?scene={scene}&layout=opening", size=size)
    opened(page)
    page.wait("() => strikewave.page.root.classList.contains('tall')")
    page.wait("() => strikewave.page.view.stage.root.clientHeight > 0.6 * innerHeight")
    left, right, top, bottom, width, height = page.evaluate(LINKS)
    section = page.tab.locator(".section").bounding_box()
    stage = page.tab.locator(".stages").bounding_box()
    assert left > 0 and right < section["x"] - stage["x"] and top > 0 and bottom < height
    assert bottom - top > 0.3 * size[1]
    assert section["y"] + section["height"] == pytest.approx(stage["y"] + stage["height"], abs=1)
    page.tab.locator(".closer").get_by_role("button", name="Numbers").click()
    page.wait("() => !strikewave.page.root.classList.contains('tall')")  # the dock has that room
    assert width > 0


def test_a_flat_linkage_lies_above_its_tracks(show):
    page = show("?scene=slider-crank&layout=opening")
    page.wait("() => strikewave.page.opening.section.tracks.length")
    stage, section = (page.tab.locator(name).bounding_box() for name in (".stages", ".section"))
    assert section["y"] >= stage["y"] + stage["height"] - 1 and section["width"] == pytest.approx(stage["width"])


def test_what_is_dropped_has_its_impacts_closer_where_the_window_is_wide(show):
    exact = solvers.solve(solvers.load("drop-test"))
    for size in SIZES:
        page = show("?scene=drop-test&layout=opening", size=size)
        lens = page.tab.locator(".lens")
        if size in HANDS:
            expect(lens).to_be_hidden()
            continue
        expect(lens).to_be_visible()
        page.evaluate("() => strikewave.page.player.seek(0)")
        lasts = exact.contacts[-1].end * 1e6
        expect(lens).to_contain_text(f"It lasts {lasts:.3g} µs")
        box, names = lens.locator("canvas").bounding_box(), page.tab.locator(".happens li:visible")
        assert box["height"] > 110 and box["width"] > 150
        apart = [each.get_by_role("button").bounding_box() for each in names.all()]
        assert all(each["y"] + each["height"] <= box["y"] or each["x"] + each["width"] <= box["x"] for each in apart)
        drawn = page.evaluate(
            """() => {
              const { canvas } = strikewave.page.views.fall.closer;
              const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
              return data.filter((value, k) => k % 4 === 3 && value > 0).length / (canvas.width * canvas.height);
            }"""
        )
        assert drawn > 0.1


def test_the_impact_that_is_nearest_to_the_clock_is_seen_closer(show):
    page = show("?scene=drop-test&layout=opening")
    lens = page.tab.locator(".lens")
    first, second = page.evaluate("() => strikewave.page.view.fall.bounces.slice(0, 2).map(({ t }) => t)")
    for t, number in ((0.0, 1), (first, 1), (0.45 * first + 0.55 * second, 2), (first, 1), (second, 2)):
        page.evaluate("(t) => strikewave.page.player.seek(t)", t)
        expect(lens.get_by_role("heading")).to_have_text(f"Impact {number}, seen closer")
        expect(lens).to_contain_text("the fall before" if number == 1 else "the flight before")


def test_an_impact_without_time_has_nothing_closer(open_page):
    page = open_page("?scene=bouncing-ball&layout=opening")
    opened(page)
    expect(page.tab.locator(".lens")).to_be_hidden()
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('law', 'hertz')"))
    expect(page.tab.locator(".lens")).to_be_visible()
    page.tab.locator(".closer").get_by_role("button", name="All charts and controls").click()
    expect(page.tab.locator(".lens")).to_be_hidden()


def test_the_seam_of_a_hopkinson_bar_opens_with_the_force_through_its_specimen(show):
    page = show("?scene=split-hopkinson&layout=opening")
    page.wait("() => strikewave.page.opening.section.shown?.seam")
    found = page.evaluate(
        """() => {
          const { page } = strikewave;
          const { seam, drawn: { left, right } } = page.opening.section.shown;
          const { trip } = page.frame;
          return { ...seam, x: [...seam.x], force: [...seam.force], trip, long: right - left };
        }"""
    )
    assert found["right"] - found["left"] == pytest.approx(0.13 * found["long"])
    exact = solvers.solve(solvers.load("split-hopkinson"))
    times = np.linspace(0.0, exact.duration, 4001)
    area = exact.scene.target.rods[1].area
    middle = exact.scene.target.rods[0].length + 0.5 * exact.scene.target.rods[1].length
    force = exact.motion.stress(times, np.array([middle]))[:, 0] * area
    assert max(found["force"]) == pytest.approx(force.max(), rel=0.01)
    x = np.array(found["x"]) * found["trip"]
    smooth = np.abs(np.gradient(force)) < 0.01 * force.max()
    error = np.abs(np.interp(times, x, found["force"]) - force)[smooth]
    assert np.percentile(error, 99) < 0.03 * force.max()  # but where steps of the staircase follow one another


@pytest.mark.parametrize("size", SIZES)
def test_bodies_without_friction_have_the_clock_of_their_impulse(show, size):
    page = show("?scene=percussion-rod&layout=opening", size=size)
    page.wait("() => strikewave.page.opening.section.tracks.length")
    titles, ends = page.evaluate(
        """() => {
          const { tracks } = strikewave.page.opening.section.shown;
          const ends = tracks.map(({ series }) => series.map(({ y }) => [y[0], y.at(-1)]));
          return [tracks.map(({ title }) => title), ends];
        }"""
    )
    assert titles == ["Parting", "Centres", "Spin", "Energy"]
    exact = solvers.solve(solvers.load("percussion-rod"))
    (before, after), *_ = ends[0]
    assert after / before == pytest.approx(-0.6)  # the restitution
    assert ends[1][0] == pytest.approx([3.0, -exact.impactor_velocity[0]])
    assert abs(ends[2][0][1]) == pytest.approx(np.linalg.norm(exact.target_spin))
    assert 1.0 - ends[3][0][1] / ends[3][0][0] == pytest.approx(exact.energy["dissipated"] / exact.energy["initial"])
    names = page.tab.locator(".happens li:visible")
    expect(names).to_have_count(3)
    names.filter(has_text="approach no more").get_by_role("button").click()
    assert page.evaluate("() => strikewave.page.player.t + strikewave.page.player.start") == pytest.approx(
        1.25, abs=1e-6
    )
    expect(page.tab.locator(".player .clock")).to_have_text(re.compile(r"1\.1[23]\sN\ss"))  # 1.8 over 1.6


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("scene", ["four-bar", "fixed-rod", "spinning-ball"])
def test_names_of_tracks_and_sliders_are_whole(show, scene, size):
    page = show(f"?scene={scene}&layout=opening", size=size)
    ends, width, cut = page.evaluate(
        """() => {
          const { root, tracks } = strikewave.page.opening.section;
          const labels = [...strikewave.page.root.querySelectorAll('.left .leading label')];
          const cut = labels.filter((each) => each.scrollWidth > each.clientWidth + 1).map((each) => each.textContent);
          return [tracks.map(({ place: { left, room } }) => left + room), root.clientWidth, cut];
        }"""
    )
    assert max(ends, default=0) <= width and cut == []


def test_the_scale_of_heights_is_within_a_phone(show):
    page = show("?scene=drop-test&layout=opening", size=HANDS[1])
    page.wait("() => strikewave.page.view.stage.words.all.length")
    words = page.evaluate(
        """() => {
          const c = document.createElement('canvas').getContext('2d');
          return strikewave.page.view.stage.words.all.map(({ words, x, align, font }) => {
            c.font = font;
            return [words, align === 'right' ? x - c.measureText(words).width : x];
          });
        }"""
    )
    assert "Impulses" in [each for each, _ in words]
    assert all(left >= 0 for _, left in words)


def test_what_a_scene_is_about_is_in_view_in_the_dock_of_a_phone(open_page):
    page = open_page("", size=HANDS[1])
    page.show_scene("figure-8.18")
    page.wait("() => strikewave.page.opening.docked && strikewave.page.view.stack.root.scrollTop > 0")
    dock = page.tab.locator(".time-views:visible")
    chart = dock.locator(".chart:not(.folded)").bounding_box()
    dock = dock.bounding_box()
    assert chart["y"] + chart["height"] <= dock["y"] + dock["height"] + 1


def test_charts_that_wait_have_their_names_on_one_line(open_page):
    page = open_page("?layout=docks&tab=charts&scene=figure-8.18")
    names = page.tab.locator(".time-views .chart.late.folded h2:visible")
    expect(names).to_have_count(2)
    heads = [
        each.evaluate("(name) => [name.scrollWidth - name.clientWidth, name.clientHeight]") for each in names.all()
    ]
    assert all(cut <= 0 and high < 24 for cut, high in heads)


def test_a_long_title_is_within_its_button_on_a_phone(open_page):
    page = open_page("", size=HANDS[1])
    page.show_scene("figure-7.5")
    button, title = (page.tab.locator(name).bounding_box() for name in (".topbar .scene", ".topbar .scene .title"))
    assert button["y"] <= title["y"] and title["y"] + title["height"] <= button["y"] + button["height"]


def test_the_bar_of_a_phone_grows_with_its_title(open_page):
    page = open_page("?scene=figure-9.8&layout=opening", size=HANDS[1])
    lines = """() => {
      const title = strikewave.page.root.querySelector('.topbar .scene .title');
      const { fontSize, lineHeight } = getComputedStyle(title);
      return [title.clientHeight, title.scrollHeight, parseFloat(lineHeight), parseFloat(fontSize)];
    }"""
    high, whole, line, letters = page.evaluate(lines)
    lines = round(whole / line)
    assert lines >= 2 and high == whole == pytest.approx(lines * line, abs=1) and line > 1.1 * letters  # none is cut
    button, ask = (page.tab.locator(name).bounding_box() for name in (".topbar .scene", ".ask"))
    assert button["y"] >= 0 and button["y"] + button["height"] <= ask["y"]


def test_the_title_of_a_tablet_is_not_cut(open_page):
    page = open_page("?mass_ratio=1.4&layout=opening&language=es", size=HANDS[0])
    button, title = (page.tab.locator(name).bounding_box() for name in (".topbar .scene", ".topbar .scene .title"))
    assert button["y"] <= title["y"] and title["y"] + title["height"] <= button["y"] + button["height"]


@pytest.mark.parametrize("query", ["", "?language=es"])
def test_the_title_that_a_phone_opens_with_takes_two_lines_and_no_more_when_changed(open_page, query):
    page = open_page(query, size=HANDS[1])
    title = page.tab.locator(".topbar .scene .title")
    line = title.evaluate("(title) => parseFloat(getComputedStyle(title).lineHeight)")
    assert title.bounding_box()["height"] < 2.5 * line
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('mass_ratio', 2)"))
    assert title.bounding_box()["height"] < 2.5 * line


def test_events_below_the_rows_are_seen_in_whole_lines(show):
    page = show("?scene=four-bar&layout=opening", size=HANDS[0])
    box = page.tab.locator(".happens").bounding_box()
    lows = {
        low
        for each in page.tab.locator(".happens li:visible").all()
        for low in [each.bounding_box()["y"] + each.bounding_box()["height"]]
    }
    assert len(lows) > 1 and all(low <= box["y"] + box["height"] + 0.5 for low in lows)


@pytest.mark.parametrize(("scene", "size"), [("fixed-rod", DESKS[1]), ("two-balls", HANDS[0]), ("four-bar", HANDS[0])])
def test_sliders_of_the_opening_stand_in_one_line(show, scene, size):
    page = show(f"?scene={scene}&layout=opening", size=size)
    sliders = page.tab.locator(".left .leading :is(select, [type=range]):visible")
    tops = [each.bounding_box()["y"] for each in sliders.all()]
    assert len(tops) > 2 and max(tops) - min(tops) < 1
    ends = page.tab.locator(".left .leading .ends span:visible")
    assert ends.count() == 2 and all(each.bounding_box()["height"] < 20 for each in ends.all())  # one line each
