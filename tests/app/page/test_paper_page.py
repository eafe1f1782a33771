"""A lesson on paper: no step is cut where a sheet has room for it, and no analysis lies over another part of it."""

import math
import re

import pytest

from .test_own_lesson_page import LESSON, ready

pytestmark = [pytest.mark.browser, pytest.mark.slow]

WIDE = 794  # pixels of a sheet
TALLER = 1.1  # than the tallest step a sheet is


def test_no_step_is_cut_where_a_sheet_has_room_for_it(open_page):
    page = open_page(LESSON, size=(WIDE, 1123))
    ready(page)
    page.tab.pdf()  # which fills the paper
    page.tab.emulate_media(media="print")
    ends = page.tab.locator(".lesson-print > section").evaluate_all(
        "all => all.map((each) => [each.offsetTop, each.offsetTop + each.offsetHeight])"
    )
    sheet = round(TALLER * max(bottom - top for top, bottom in ends))
    count, begins = 1, 0.0
    for top, bottom in ends:
        if bottom - begins > sheet:
            count, begins = count + 1, top
    assert count > math.ceil(ends[-1][1] / sheet)  # else it could not be told from steps that are cut
    printed = page.tab.pdf(width=f"{WIDE}px", height=f"{sheet}px")
    assert len(re.findall(rb"/Type\s*/Page\b", printed)) == count


def test_figures_of_an_analysis_stand_one_below_the_other_and_end_where_it_does(open_page):
    page = open_page("?lesson=modes-against-waves", size=(1280, 800))
    ready(page)
    figures = page.tab.locator(".lesson-charts .figures")
    figures.locator(".bk-Figure").nth(1).wait_for()
    parts = figures.locator(".figure").all()
    boxes = [part.bounding_box() for part in (figures, *parts)]
    whole, first, second = ((box["y"], box["y"] + box["height"]) for box in boxes)
    assert first[1] <= second[0] + 1 and second[1] <= whole[1] + 1
    assert second[0] - first[0] < 400  # no gap between them


WATCH = """() => {
  globalThis.taken = []; // of each picture that is taken for paper: whether it has a map, and whether all of that
  window.print = () => { globalThis.printed = true; };
  const { prototype } = HTMLCanvasElement;
  const { toDataURL } = prototype;
  prototype.toDataURL = function (...all) {
    const { below } = strikewave.page.opening.teaching.lesson;
    globalThis.taken.push([below.names.includes('map'), Boolean(below.map?.view && below.map.jobs.idle)]);
    return toDataURL.apply(this, all);
  };
}"""


def test_a_map_is_whole_before_it_is_printed(open_page):
    page = open_page("?lesson=heavier-faster-softer", size=(1280, 800))
    ready(page)
    page.evaluate(WATCH)
    page.tab.get_by_role("button", name="Print").first.click()
    page.tab.locator("dialog.lesson-printing .lesson-main").click()
    page.wait("() => globalThis.printed")
    maps = [whole for there, whole in page.evaluate("() => globalThis.taken") if there]
    assert len(maps) >= 2 and all(maps), page.evaluate("() => globalThis.taken")
