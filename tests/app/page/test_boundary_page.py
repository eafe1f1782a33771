"""A boundary is drawn over the map of a lesson: by mouse, keys and finger; nothing of the map is seen before."""

import numpy as np
import pytest
from playwright.sync_api import expect

from app.lessons.judging import exact_boundary
from app.lessons.lesson import Boundary
from app.lessons.shipped import shipped_lesson

from .hands import tap
from .test_access_page import findings
from .test_lesson_map_page import DRAWN, MAP
from .test_lesson_page import button, judged
from .test_lesson_walks import THERE, Finger

STEP = "?lesson=heavier-faster-softer&step=7&language=en"
(BORDER,) = [part for part in shipped_lesson("heavier-faster-softer").steps[6].parts if isinstance(part, Boundary)]
TRUTH = exact_boundary(BORDER)
ROUGH = [(0.0, 0.72), (0.3, 0.63), (0.5, 0.5), (0.8, 0.39), (1.0, 0.22)]
WRONG = [(0.0, 0.3), (0.5, 0.5), (1.0, 0.8)]
# Colours of the middle of both halves of the map: what differs there, is seen.
COLOURS = """() => {
  const { base, plot } = strikewave.page.opening.teaching.lesson.below.map.plane;
  const share = base.width / base.clientWidth;
  const at = (x, y) => [...base.getContext('2d').getImageData(
    share * (plot.x + x * plot.w), share * (plot.y + y * plot.h), 1, 1).data].join();
  return [at(0.8, 0.25), at(0.3, 0.8)];
}"""
ANSWER = "() => strikewave.page.opening.teaching.lesson.progress.answers.border"
CONTACTS = f"""(places) => {{ // of the points of the map that are nearest to these shares
  const {{ axes: {{ x0, x1, y0, y1 }}, contacts, first, nx, steps }} = {MAP}.view;
  return places.map(([x, y]) => {{
    const [i, j] = [(x0 + x * (x1 - x0)) / steps[0], (y0 + y * (y1 - y0)) / steps[1]].map(Math.round);
    return contacts[(j - first[1]) * nx + i - first[0]];
  }});
}}"""


def opened(open_page, size=(1440, 900), **how):
    page = open_page(STEP, size=size, **how)
    page.wait(THERE)
    page.wait(DRAWN)
    page.frames_pass(3)
    return page


def at(page, x, y):
    """Pixels of shares of what is shown."""
    box = page.tab.locator(".sketch-plot").bounding_box()
    return box["x"] + x * (box["width"] - 1), box["y"] + (1 - y) * (box["height"] - 1)


def drawn(page, line):
    page.tab.mouse.move(*at(page, *line[0]))
    page.tab.mouse.down()
    for point in line[1:]:
        page.tab.mouse.move(*at(page, *point), steps=10)
    page.tab.mouse.up()


def test_a_rough_line_by_mouse_is_right_and_the_map_shows_its_colours_behind_it(open_page):
    page = opened(open_page)
    above, below = page.evaluate(COLOURS)
    assert above == below and not findings(page)
    shown = button(page, "Show what happens")
    expect(shown).to_be_disabled()
    undo, clear = button(page, "Undo"), button(page, "Clear")
    expect(undo).to_be_disabled()
    expect(clear).to_be_disabled()
    drawn(page, ROUGH)
    expect(undo).to_be_enabled()
    expect(clear).to_be_enabled()
    assert page.evaluate(COLOURS) == [above, below]
    shown.click()
    page.frames_pass(3)
    above, below = page.evaluate(COLOURS)
    assert above != below
    assert judged(page) == ["✓", "✓"] and not findings(page)
    expect(page.tab.locator(".sketch-plot")).to_be_hidden()
    expect(page.tab.locator(".lesson-after")).to_contain_text("is the same")
    answer = page.evaluate(ANSWER)
    assert np.array(answer["line"], float) == pytest.approx(
        np.interp(np.linspace(0, 1, 101), *np.transpose(ROUGH)), abs=0.02
    )
    assert answer["so"] == pytest.approx(TRUTH, abs=2e-4)


def test_the_true_boundary_is_that_of_the_map(open_page):
    page = opened(open_page)
    across = np.linspace(0.05, 0.95, 13)
    truth = np.interp(across, np.linspace(0.0, 1.0, TRUTH.size), TRUTH)
    below, above = (page.evaluate(CONTACTS, np.stack([across, truth + off], axis=1).tolist()) for off in (-0.03, 0.03))
    assert (below, above) == ([1] * 13, [2] * 13)


def test_a_wrong_line_is_said_to_be_wrong_and_the_truth_is_shown(open_page):
    page = opened(open_page)
    drawn(page, WRONG)
    button(page, "Show what happens").click()
    assert judged(page) == ["○", "○"]
    said = page.tab.locator(".lesson-judged li").last
    expect(said).to_contain_text(
        "At 10 m/s your line is at 3.99·10¹¹ N/m¹·⁵, too high: the second contact begins at 3.22"
    )
    page.tab.reload()
    page.laid_out()
    page.wait(THERE)
    page.wait(DRAWN)
    expect(page.tab.locator(".lesson-judged li").last).to_contain_text("too high")
    above, below = page.evaluate(COLOURS)
    assert above != below


def test_a_line_that_leaves_an_end_out_is_not_taken(open_page):
    page = opened(open_page)
    shown = button(page, "Show what happens")
    drawn(page, [(0.5, 0.5), (1.0, 0.25)])
    expect(shown).to_be_disabled()
    expect(page.tab.locator(".lesson-hint")).to_have_text("Draw on the map, all the way from 0.1 m/s to 10 m/s.")
    drawn(page, [(0.02, 0.75), (0.5, 0.5)])
    expect(shown).to_be_enabled()
    button(page, "Undo").click()
    expect(shown).to_be_disabled()


def test_keys_alone_draw_it(open_page):
    page = opened(open_page)
    page.tab.locator(".sketch-plot").focus()
    keys = page.tab.keyboard
    for _ in range(6):
        keys.press("ArrowUp")  # of 24 steps, from the point that is given
    for k in range(10):
        keys.press("ArrowRight")
        keys.press("ArrowDown")
        if k % 5 == 4:
            keys.press("ArrowDown")
    line = page.evaluate(ANSWER)["line"]
    assert line[0] == pytest.approx(0.754, abs=0.01) and line[-1] == pytest.approx(0.254, abs=0.01)
    assert "10 m/s" in page.tab.locator(".lesson-spoken").inner_text()
    button(page, "Show what happens").press("Enter")
    assert judged(page) == ["✓", "✓"]


def test_typed_points_are_values_of_both_settings(open_page):
    page = opened(open_page)
    button(page, "Type points").press("Enter")
    area = page.tab.locator(".sketch-points textarea")
    area.focus()
    page.tab.keyboard.type("0.1 3.2e11\n1 1e11\n10 3.2E+10")
    button(page, "Draw them").press("Enter")
    line = page.evaluate(ANSWER)["line"]
    assert [line[k] for k in (0, 50, 100)] == pytest.approx([0.7526, 0.5, 0.2526], abs=1e-3)
    button(page, "Show what happens").press("Enter")
    assert judged(page) == ["✓", "✓"]


def test_a_finger_draws_it_on_a_phone_and_the_page_stays(open_page):
    page = opened(open_page, size=(390, 844), has_touch=True)
    plot = page.tab.locator(".sketch-plot")
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    finger = Finger(page, None)
    finger.stroke([at(page, *point) for point in ROUGH])
    assert plot.bounding_box() == box
    tap(button(page, "Show what happens"))
    page.wait("() => strikewave.page.opening.teaching.lesson.question.done")
    assert judged(page) == ["✓", "✓"]
    page.fits(390)
    expect(page.tab.locator(".whatif-taught")).to_be_visible()


def test_the_step_after_it_and_the_way_back_keep_the_line(open_page):
    page = opened(open_page)
    drawn(page, ROUGH)
    button(page, "Skip →").click()
    page.wait(THERE)
    assert page.tab.locator(".sketch-plot").count() == 0
    button(page, "Back").click()
    page.wait(THERE)
    page.wait(DRAWN)
    above, below = page.evaluate(COLOURS)
    assert above == below
    expect(button(page, "Show what happens")).to_be_enabled()
