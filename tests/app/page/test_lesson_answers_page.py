"""What is kept of answers that were tried again: the last is shown where it was given, the first in the summary."""

import pytest
from playwright.sync_api import expect

from .hands import type_into
from .test_lesson_page import LESSON, answered_choice, button, in_order, onwards, ready

ANSWERS = "() => strikewave.page.opening.teaching.lesson.progress.answers"


def test_a_choice_keeps_its_last_answer_and_the_summary_says_what_was_right_later(open_page):
    page = open_page(LESSON)
    ready(page)
    page.tab.get_by_label("No more contact").check()
    button(page, "Show what happens").click()
    button(page, "Try again").click()
    answered_choice(page)
    for leave in (page.tab.reload, lambda: (onwards(page), button(page, "Back").click())):
        leave()
        ready(page)
        expect(page.tab.get_by_label("A second contact")).to_be_checked()
        expect(page.tab.locator(".lesson-said")).to_contain_text("✓")
        expect(page.tab.locator(".lesson-choice")).to_contain_text("2 tries")
    assert page.evaluate(ANSWERS)["next"]["picked"] != page.evaluate(ANSWERS)["next"]["last"]
    page.evaluate("() => strikewave.page.opening.teaching.lesson.enter(2)")
    ready(page)
    for ratio in (2, 1.5):
        page.answered(lambda ratio=ratio: page.evaluate(f"() => strikewave.page.choose('mass_ratio', {ratio})"))
    found = page.evaluate(ANSWERS)["once"]["found"]
    onwards(page)
    number = page.tab.get_by_label("Your number")
    for value in ("58", "116.4"):
        page.tab.get_by_label("Unit").select_option("µs")
        type_into(number, value, "Enter")
    onwards(page)
    button(page, "Check").click()
    in_order(page)
    button(page, "Check").click()
    onwards(page)
    choice, _, slider, time, order = page.tab.locator(".lesson-sum").all()
    for part in (choice, time, order):
        expect(part.locator(".lesson-said")).to_contain_text("○")
        expect(part.locator(".lesson-later")).to_have_text("✓ Right later: 2 tries")
    assert [each["place"] for each in found] == [2]
    expect(slider.locator("dd p").first).to_have_text("Mass ratio: 2")
    expect(order.locator("ol li")).to_have_count(6)
    expect(order.locator("ol li").first).to_have_text("Mass and rod touch")


SEEN = """() => {
  const boxOf = (name) => strikewave.page.root.querySelector(name).getBoundingClientRect();
  const [said, moves] = [boxOf('.lesson-said'), boxOf('.lesson-moves')];
  return said.top >= 0 && said.bottom <= moves.top;
}"""


@pytest.mark.parametrize(("lesson", "step"), [("a-ball-with-spin", 4), ("the-energy-left-ringing", 2)])
def test_what_is_said_of_a_choice_is_seen_above_the_bar_of_a_phone(open_page, lesson, step):
    page = open_page(f"?lesson={lesson}&step={step}", size=(390, 844), has_touch=True)
    ready(page)
    page.tab.locator(".lesson-choice input").first.check()
    button(page, "Show what happens").click()
    page.wait(SEEN)
