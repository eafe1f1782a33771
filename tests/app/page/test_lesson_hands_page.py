"""A lesson in hands: two taps lose no answer, a drag is judged where it ends, dead controls say why."""

import pytest
from playwright.sync_api import expect

from .hands import drag, tap
from .test_lesson_page import LESSON, answered_choice, button, ready

FOUND = "() => strikewave.page.opening.teaching.lesson.progress.answers.onward.found"
DONE = "() => strikewave.page.opening.teaching.lesson.progress.answers.next?.done ?? false"


def test_answers_are_forgotten_after_a_question_that_is_seen_and_come_back(open_page):
    page = open_page(LESSON, has_touch=True)
    ready(page)
    answered_choice(page)
    forget = page.tab.locator(".lesson-forget")
    for size in [(1440, 900), (390, 844)]:
        page.resize(*size)
        tap(forget)
        expect(forget.locator(".lesson-word")).to_be_visible()
        expect(forget).to_have_text("⟲Forget all answers?")
        page.fits(size[0])
        page.tab.get_by_role("heading", level=2).first.click()  # anything else
        expect(forget).to_have_accessible_name("Start again")
        assert page.evaluate(DONE)
        tap(forget)
        tap(forget)
        ready(page)
        assert not page.evaluate(DONE)
        expect(forget.locator(".lesson-word")).to_be_visible()
        expect(forget).to_have_accessible_name("Undo: bring the answers back")
        tap(forget)
        ready(page)
        assert page.evaluate(DONE)
        expect(page.tab.get_by_label("A second contact")).to_be_checked()


def test_equal_masses_do_not_go_on_and_a_drag_counts_where_it_ends(open_page):
    page = open_page("?lesson=what-an-impact-is&step=4")
    ready(page)
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('mass_ratio', 1)"))
    expect(page.tab.locator(".lesson-said").first).to_contain_text("Not yet")
    expect(button(page, "Skip →")).to_be_visible()
    slider = page.tab.locator("#choice-mass_ratio")
    page.answered(lambda: drag(slider, 0.2))
    expect(button(page, "Next →")).to_be_visible()
    (found,) = page.evaluate(FOUND)
    assert found["place"] == page.header("chosen")["mass_ratio"] == pytest.approx(0.1 * 100**0.2, rel=0.05)


def test_a_clock_that_may_not_run_says_so_and_the_lesson_begins_at_its_heading(open_page):
    page = open_page("?lesson=the-energy-left-ringing&step=2")
    ready(page)
    focused = "() => strikewave.page.root.getRootNode().activeElement?.tagName"
    assert page.evaluate(focused) == "H2"
    for play in page.tab.locator(".player .play, .player .scrub").all():
        if page.evaluate("() => strikewave.page.player.limit") <= 0:
            expect(play).to_be_disabled()
            expect(page.tab.locator(".player .why")).to_have_text("Answer first")
    page.tab.locator(".lesson-choice input").first.check()
    button(page, "Show what happens").click()
    expect(page.tab.locator(".player .play")).to_be_enabled()
    expect(page.tab.locator(".player .why")).to_be_hidden()
