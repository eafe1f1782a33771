"""A lesson with a map: seen once its question is answered, its point moved by what the step leaves to students."""

import pytest

from .test_access_page import findings
from .test_lesson_walks import THERE

MAP = "strikewave.page.opening.teaching.lesson.below.map"
DRAWN = f"() => {{ const m = {MAP}; return Boolean(m?.open && m.view && m.domain && m.jobs.idle && !m.due); }}"
CHOSEN = "() => [strikewave.page.frame.chosen.mass_ratio, strikewave.page.frame.chosen.speed]"
POINT = f"() => {MAP}.plane.at"
SIZES = [(1440, 900), (390, 844)]


def answered(page) -> None:
    """Its question, rightly."""
    page.tab.get_by_text("Yes, at any speed").click()
    page.tab.get_by_role("button", name="Show what happens").click()
    page.wait(DRAWN)


@pytest.mark.parametrize("size", SIZES)
def test_the_map_comes_with_the_answer_and_its_point_is_moved(open_page, size):
    page = open_page("?lesson=bounce-twice&step=4&language=en", size=size)
    page.wait(THERE)
    shown = page.tab.locator(".whatif-taught")
    assert shown.count() == 0  # it would say what is asked
    answered(page)
    assert shown.locator("h3").inner_text() == "Contacts over Mass ratio and Impact speed"
    assert page.evaluate(f"() => [{MAP}.result, {MAP}.named.x, {MAP}.named.y]") == ["contacts", "mass_ratio", "speed"]
    found = page.evaluate(f"() => {{ const v = {MAP}.view; return [...new Set(v.contacts)].sort(); }}")
    assert found == [1, 2] and not findings(page)
    over = shown.locator("canvas").last
    over.scroll_into_view_if_needed()
    over.focus()
    over.press("ArrowLeft")
    over.press("ArrowUp")
    page.wait("() => strikewave.page.frame.chosen.mass_ratio < 0.8 && strikewave.page.frame.chosen.speed > 1")
    box = over.bounding_box()
    (x, y), to = page.evaluate(POINT), 0.3 * box["width"]
    if size[0] > 1000:
        page.tab.mouse.move(box["x"] + x, box["y"] + y)
        page.tab.mouse.down()
        page.tab.mouse.move(box["x"] + to, box["y"] + y + 40, steps=6)
        page.tab.mouse.up()
    else:
        page.tab.mouse.click(box["x"] + to, box["y"] + y + 40)
    page.wait("() => strikewave.page.frame.chosen.mass_ratio < 0.5 && strikewave.page.frame.chosen.speed < 1")
    page.wait(DRAWN)
    assert page.evaluate(f"() => {MAP}.here('contacts')") == page.evaluate(
        "() => strikewave.page.frame.exact.contacts.length"
    )


def test_only_what_the_step_leaves_to_students_is_moved(open_page):
    page = open_page("?lesson=bounce-twice&step=4&language=en")
    page.wait(THERE)
    answered(page)
    page.evaluate(f"() => {{ {MAP}.moves = () => ['mass_ratio']; }}")  # as a step with one slider has it
    over = page.tab.locator(".whatif-taught canvas").last
    over.focus()
    over.press("ArrowUp")
    over.press("ArrowLeft")
    page.wait("() => strikewave.page.frame.chosen.mass_ratio < 0.8")
    assert page.evaluate(CHOSEN)[1] == 1.0


def test_the_next_step_has_no_map_and_the_way_back_has_it_again(open_page):
    page = open_page("?lesson=bounce-twice&step=4&language=en")
    page.wait(THERE)
    answered(page)
    page.tab.get_by_role("button", name="Next →").click()
    page.wait(THERE)
    assert page.tab.locator(".whatif-taught").count() == 0
    assert not page.evaluate(f"() => {MAP}.open") and not page.evaluate(f"() => {MAP}.points.own.workers.length")
    page.tab.get_by_role("button", name="Back", exact=False).first.click()
    page.wait(DRAWN)
    assert page.tab.locator(".whatif-taught").is_visible()
