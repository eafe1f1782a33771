"""A lesson with a map: its point is moved by what the step leaves to students, and it gives no answer away."""

import json

import pytest
from playwright.sync_api import expect

from app.lessons.reading import read_text
from app.lessons.record import lesson_record

from ..lessons.written import HEAD
from .test_access_page import findings
from .test_lesson_walks import THERE

MAP = "strikewave.page.opening.teaching.lesson.below.map"
DRAWN = f"() => {{ const m = {MAP}; return Boolean(m?.open && m.view && m.domain && m.jobs.idle && !m.due); }}"
POINT = f"() => {MAP}.plane.at"
SOFT = "?lesson=heavier-faster-softer&step=4&language=en"
ASKS = (
    HEAD
    + """
## Does speed matter?

:::{scene}
changes = { mass_ratio = 0.8 }
show = ["bodies", "map"]
map = ["contacts", "mass_ratio", "speed"]
:::

Does it?

:::{choice} speed
[[option]]
text = "No"
right = true
say = "No."
[[option]]
text = "Yes"
say = "No."
:::
"""
)


@pytest.mark.parametrize("size", [(1440, 900), (390, 844)])
def test_a_stiffness_is_found_on_the_map(open_page, size):
    page = open_page(SOFT, size=size)
    page.wait(THERE)
    page.wait(DRAWN)
    shown = page.tab.locator(".whatif-taught")
    assert shown.locator("h3").inner_text() == "Peak force over Impact speed and Stiffness"
    assert not findings(page)
    said = page.tab.locator(".lesson-said").first
    expect(said).to_contain_text("Not yet")
    over = shown.locator("canvas").last
    over.focus()
    over.press("ArrowDown")
    over.press("ArrowRight")  # nothing, as the step leaves no speed
    page.wait("() => strikewave.page.frame.chosen.hertz_stiffness < 1.68e10")
    over.scroll_into_view_if_needed()
    box = over.bounding_box()
    x, y = page.evaluate(POINT)
    page.tab.mouse.move(box["x"] + x, box["y"] + y)
    page.tab.mouse.down()
    page.tab.mouse.move(box["x"] + x, box["y"] + box["height"] - 70, steps=8)
    page.tab.mouse.up()
    expect(said).to_contain_text("Half the force")
    page.wait(DRAWN)
    stiffness, speed = page.evaluate(
        "() => [strikewave.page.frame.chosen.hertz_stiffness, strikewave.page.frame.chosen.speed]"
    )
    assert 1e9 <= stiffness < 3e9 and speed == 1.0
    assert page.evaluate(f"() => {MAP}.here('peak_force')") == page.evaluate(
        "() => strikewave.page.frame.exact.peakForce"
    )


def test_the_next_step_has_no_map_and_the_way_back_has_it_again(open_page):
    page = open_page(SOFT)
    page.wait(THERE)
    page.wait(DRAWN)
    page.tab.get_by_role("button", name="Skip →").click()
    page.wait(THERE)
    assert page.tab.locator(".whatif-taught").count() == 0
    assert not page.evaluate(f"() => {MAP}.open") and not page.evaluate(f"() => {MAP}.points.own.workers.length")
    page.tab.get_by_role("button", name="Back", exact=True).click()
    page.wait(DRAWN)
    expect(page.tab.locator(".whatif-taught")).to_be_visible()


def test_a_map_that_says_what_is_asked_comes_with_the_answer(open_page):
    page = open_page("?lesson=what-an-impact-is")
    kept = json.dumps({"lesson": lesson_record(read_text(ASKS).lesson), "whole": True})
    page.evaluate("(kept) => sessionStorage.setItem('strikewave.own-lesson', kept)", kept)
    page.tab.goto(f"http://{page.address}/?lesson=own")
    page.laid_out()
    page.wait(THERE)
    assert page.tab.locator(".whatif-taught").count() == 0
    page.tab.get_by_label("No", exact=True).check()
    page.tab.get_by_role("button", name="Show what happens").click()
    page.wait(DRAWN)
    found = page.evaluate(f"() => [...new Set({MAP}.view.contacts)].sort()")
    assert found == [1, 2]
    assert page.evaluate(f"() => [{MAP}.result, {MAP}.named.x, {MAP}.named.y]") == ["contacts", "mass_ratio", "speed"]
