"""Lessons on the page: a walk through one, by pointer and by keys; nothing of the answer is there before."""

import re

import pytest
from playwright.sync_api import expect

from .hands import slide, type_into
from .test_access_page import findings

LESSON = "?lesson=bounce-twice"
READY = """() => {
  if (!window.strikewave) return false;
  const { asked, opening: { teaching: { lesson } }, telling } = strikewave.page;
  return Boolean(lesson) && !lesson.coming && !asked && !telling;
}"""
UNTIL, HIGH = 2.6, 120.0  # of the chart [T], [kN]
LINE = [(0, 36), (0.5, 20), (0.98, 9), (1.0, 78), (1.4, 25), (1.69, 0), (2.02, 0), (2.04, 50), (2.2, 0), (2.6, 0)]
LATE = [(0, 36), (0.98, 9), (1.0, 78), (2.2, 0), (2.6, 0)]
AHEAD = re.compile(r"80[.,]7|1\.69|2\.03|2\.20|second contact", re.IGNORECASE)  # what is only to be seen behind it
CANVASES = """() => [...strikewave.page.root.querySelectorAll('canvas')]
  .filter((each) => each.checkVisibility()).length"""
ORDER = "() => strikewave.page.opening.teaching.lesson.question.answer.order"


def button(page, name: str):
    return page.tab.get_by_role("button", name=name, exact=True)


def ready(page) -> None:
    page.wait(READY)
    page.frames_pass(2)


def onwards(page, name: str = "Next →") -> None:
    button(page, name).click()
    ready(page)


def answered_choice(page) -> None:
    page.tab.get_by_label("A second contact").check()
    button(page, "Show what happens").click()


def drawn(page, line) -> None:
    """Draw with the pointer."""
    box = page.tab.locator(".sketch-plot").bounding_box()

    def at(t, force):
        return box["x"] + t / UNTIL * (box["width"] - 1), box["y"] + (1 - force / HIGH) * (box["height"] - 1)

    page.tab.mouse.move(*at(*line[0]))
    page.tab.mouse.down()
    for point in line[1:]:
        page.tab.mouse.move(*at(*point), steps=5)
    page.tab.mouse.up()


def typed(page, keys: str) -> None:
    for key in keys.split():
        name, _, times = key.partition("*")
        for _ in range(int(times or 1)):
            page.tab.keyboard.press(name)


def judged(page) -> list[str]:
    return page.tab.locator(".lesson-judged b").all_inner_texts()


def in_order(page) -> None:
    for wanted in range(len(page.evaluate(ORDER))):
        while (place := page.evaluate(ORDER).index(wanted)) > wanted:
            page.tab.locator(".lesson-lines li").nth(place).get_by_role("button", name="Move up").click()


def seen(page) -> str:
    return page.tab.locator(".page").inner_text() + " ".join(
        page.evaluate(
            """() => [...strikewave.page.root.querySelectorAll('[aria-label], [title]')]
              .filter((each) => each.checkVisibility()).flatMap((each) => [each.ariaLabel ?? '', each.title ?? ''])"""
        )
    )


def test_a_lesson_is_walked_through_with_a_pointer(open_page):
    page = open_page(LESSON)
    ready(page)
    expect(page.tab.get_by_role("heading", name="They have parted. What comes next?")).to_be_visible()
    expect(page.tab.locator(".lesson-name")).to_have_text("Lesson: What comes after the bounce?")
    answered_choice(page)
    expect(page.tab.locator(".lesson-said")).to_contain_text("Yes:")
    expect(page.tab.locator(".lesson-name")).to_have_text("Lesson: Why does it bounce twice?")
    onwards(page)
    expect(button(page, "Show what happens")).to_be_disabled()
    drawn(page, LINE)
    button(page, "Show what happens").click()
    assert judged(page) == ["✓"] * 5
    button(page, "Lay it beside the picture").click()
    expect(page.tab.locator(".section")).to_be_visible()
    expect(page.tab.locator(".lesson-after")).to_contain_text("Each row shows the rod at one time")
    onwards(page)
    expect(page.tab.locator(".lesson-said")).to_contain_text("the second lasts from 2.03 T to 2.2 T")
    slider = page.tab.locator("#choice-mass_ratio")
    expect(slider).to_be_visible()
    page.answered(lambda: slide(slider, 800))
    expect(page.tab.locator(".lesson-said").first).to_contain_text("A light mass leaves")
    page.answered(lambda: slide(slider, 80))
    expect(page.tab.locator(".lesson-more")).to_contain_text("on either side")
    onwards(page)
    expect(page.tab.locator(".clock")).not_to_contain_text("µs")
    number = page.tab.get_by_label("Your number")
    page.tab.get_by_label("Unit").select_option("µs")
    type_into(number, "58", "Enter")
    expect(page.tab.locator(".lesson-said")).to_contain_text("the front is at the wall")
    type_into(number, "0,1164 ms")
    button(page, "Check").click()
    expect(page.tab.locator(".lesson-said")).to_contain_text("This time is T")
    expect(page.tab.locator(".lesson-number")).to_contain_text("2 tries")
    expect(page.tab.locator(".clock")).to_contain_text("µs")
    onwards(page)
    button(page, "Check").click()
    expect(page.tab.locator(".lesson-said")).to_contain_text("of 6 are in their place")
    handles, before = page.tab.locator(".lesson-handle"), page.evaluate(ORDER)
    handles.first.drag_to(handles.nth(2))
    assert page.evaluate(ORDER) == [*before[1:3], before[0], *before[3:]]
    expect(page.tab.locator(".lesson-spoken")).to_have_text("Mass and rod touch: place 3 of 6")
    in_order(page)
    button(page, "Check").click()
    expect(page.tab.locator(".lesson-said")).to_contain_text("All in order")
    assert page.tab.locator(".lesson-lines em").all_inner_texts()[:3] == ["0 T", "0.5 T", "1 T"]
    onwards(page)
    expect(page.tab.locator(".lesson-sum")).to_have_count(5)
    expect(page.tab.locator(".lesson-sum").nth(3)).to_contain_text("116.4")
    expect(button(page, "Next →")).to_have_count(0)
    expect(button(page, "All lessons")).to_be_in_viewport()  # no lesson follows
    assert page.tab.url.endswith("?lesson=bounce-twice&step=6")
    page.tab.go_back()
    ready(page)
    expect(page.tab.get_by_role("heading", name="What follows what?")).to_be_visible()


def test_nothing_of_the_answer_is_there_before(open_page):
    page = open_page(LESSON)
    ready(page)
    reached = page.evaluate("() => { strikewave.page.player.seek(3); return strikewave.page.player.t; }")
    assert reached == pytest.approx(1.85)
    page.tab.keyboard.press("]")
    assert page.evaluate("() => strikewave.page.player.t") <= 1.85
    assert not AHEAD.search(seen(page).replace("A second contact", ""))  # which is one of three to choose from
    onwards(page, "Skip →")
    assert page.evaluate("() => { strikewave.page.player.seek(3); return strikewave.page.player.t; }") == 0
    assert page.evaluate("() => strikewave.page.opening.teaching.lesson.question.curve.x.length") == 0
    visible = (
        "() => [...strikewave.page.root.querySelectorAll('canvas')].filter((each) => each.checkVisibility()).length"
    )
    assert page.evaluate(visible) == 2  # bodies, and the empty chart
    before = page.picture()
    page.evaluate("() => strikewave.page.redraw()")
    page.frames_pass(3)
    assert page.picture() == before and not AHEAD.search(seen(page))
    steps = page.tab.locator(".lesson-steps button")
    assert steps.evaluate_all("all => all.map((each) => each.ariaLabel)")[2:4] == ["Step 3", "Step 4"]


def test_a_phone_has_all_of_it_and_keys_draw_too(open_page):
    page = open_page(LESSON, size=(390, 844))
    ready(page)
    found = {"choice": findings(page)}
    expect(button(page, "Skip →")).to_be_in_viewport()
    answered_choice(page)
    found["said"] = findings(page)
    onwards(page)
    page.fits(390)
    page.tab.locator(".sketch-plot").focus()
    typed(page, "ArrowRight*9 ArrowDown*5 ArrowRight Enter ArrowUp*14 ArrowRight*7 ArrowDown*16")
    expect(page.tab.locator(".lesson-spoken")).to_have_text("1.7 T, 1.7 kN")
    typed(page, "ArrowDown End")
    found["sketch"] = findings(page)
    expect(button(page, "Show what happens")).to_be_in_viewport()
    button(page, "Show what happens").click()
    assert judged(page) == ["✓", "✓", "✓", "○", "✓"]
    found["judged"] = findings(page)
    button(page, "Lay it beside the picture").click()
    for step in ("set", "number", "order", "summary"):
        button(page, "Next →").or_(button(page, "Skip →")).click()
        ready(page)
        page.fits(390)
        found[step] = findings(page)
    assert {step: broken for step, broken in found.items() if broken} == {}


def test_no_rule_of_access_is_broken_on_a_desk(open_page):
    page = open_page(LESSON)
    found = {}
    for step in range(1, 7):
        ready(page)
        found[step] = findings(page)
        if step < 6:
            page.tab.locator(".lesson-moves button:visible").last.click()
    assert {step: broken for step, broken in found.items() if broken} == {}


@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_points_are_typed_what_is_none_is_named_and_strokes_are_taken_back(open_page, size):
    page = open_page(f"{LESSON}&step=2", size=size)
    ready(page)
    button(page, "Type points").click()
    type_into(page.tab.get_by_label("A line for each point"), "0 37\nhello\n1 x")
    button(page, "Draw them").click()
    expect(page.tab.locator(".sketch .wrong")).to_have_text("Not two numbers: hello; 1 x")
    assert button(page, "Show what happens").is_disabled()
    type_into(page.tab.get_by_label("A line for each point"), "0 36\n0,99 8\n1 80\n2.2 0\n2.6 0")
    button(page, "Draw them").click()
    expect(button(page, "Show what happens")).to_be_enabled()
    drawn(page, [(0.2, 100), (0.6, 100)])
    button(page, "Undo").click()
    button(page, "Show what happens").click()
    assert judged(page) == ["✓", "✓", "○", "○", "✓"]
    expect(page.tab.locator(".lesson-judged")).to_contain_text("In your line they part at 2.16 T, too late.")


def test_answers_stay_until_one_starts_again(open_page):
    page = open_page(LESSON)
    ready(page)
    answered_choice(page)
    onwards(page)
    drawn(page, LATE)
    button(page, "Show what happens").click()
    before = judged(page)
    page.tab.reload()
    ready(page)
    assert judged(page) == before == ["✓", "✓", "○", "○", "✓"]
    button(page, "Back").click()
    ready(page)
    expect(page.tab.get_by_label("A second contact")).to_be_checked()
    page.tab.get_by_role("button", name="Start again").click()
    page.tab.get_by_role("button", name="Forget all answers?").click()
    ready(page)
    expect(button(page, "Show what happens")).to_be_disabled()
    onwards(page, "Skip →")
    assert page.evaluate("() => strikewave.page.opening.teaching.lesson.question.drawn.begun") is False


def test_a_line_stays_when_the_window_turns(open_page):
    page = open_page(f"{LESSON}&step=2", size=(820, 1180))
    ready(page)
    drawn(page, LATE)
    page.resize(1180, 820)
    button(page, "Show what happens").click()
    assert judged(page) == ["✓", "✓", "○", "○", "✓"]


def test_the_truth_unrolls_with_its_sentences(open_page):
    page = open_page(f"{LESSON}&step=2", reduced_motion="no-preference")
    ready(page)
    drawn(page, LATE)
    button(page, "Show what happens").click()
    assert page.tab.locator(".lesson-judged .later").count() >= 3
    page.evaluate("() => strikewave.page.player.seek(2.6)")
    expect(page.tab.locator(".lesson-judged .later")).to_have_count(0)


def test_the_other_lesson_is_walked_through(open_page):
    page = open_page("?lesson=what-an-impact-is")
    ready(page)
    page.tab.get_by_label("Neither").check()
    button(page, "Show what happens").click()
    onwards(page)
    type_into(page.tab.get_by_label("Your number"), "0.447")
    button(page, "Check").click()
    expect(page.tab.locator(".lesson-said")).to_contain_text("Right")
    onwards(page)
    onwards(page, "Skip →")
    expect(page.tab.locator(".lesson-said")).to_contain_text("the velocity of the first ball is −0.5 m/s")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('mass_ratio', 0.5)"))
    expect(page.tab.locator(".lesson-said")).to_contain_text("It goes on")
    before, now = page.evaluate("() => [strikewave.page.opening.section.first[0].trip, strikewave.page.frame.trip]")
    assert before < now  # the force of before lies beside that of now, by its own clock
    onwards(page)
    onwards(page, "Skip →")
    page.tab.get_by_role("link", name="Next lesson: A mass on a rod").click()
    ready(page)
    expect(page.tab.get_by_role("heading", name="What moves first?")).to_be_visible()


def test_a_lesson_that_is_not_there_is_refused_in_a_sentence(open_page):
    page = open_page("?lesson=none-such")
    expect(page.tab.locator(".toast")).to_have_text(
        "There is no lesson called none-such; the page goes on without one."
    )
    expect(page.tab.locator(".ask h2")).to_be_visible()
    assert page.evaluate("() => strikewave.page.player.limit") == float("inf")
    page.errors.clear()  # the browser notes that there was nothing


def test_lessons_are_fetched_where_one_is_asked_for_and_listed_in_the_gallery(open_page):
    page = open_page("liveness", own=True, drawn=False)
    fetched = []
    page.tab.on("request", lambda request: fetched.append(request.url))
    page.tab.goto(f"http://{page.address}/")
    page.laid_out()
    page.tab.keyboard.press("g")
    gallery = page.tab.get_by_role("dialog", name="Scenes and lessons")
    link = gallery.get_by_role("link", name="What comes after the bounce?")
    expect(link).to_be_visible()
    assert not [address for address in fetched if "lesson" in address]
    link.click()
    ready(page)
    assert len([address for address in fetched if "lesson" in address.split("?")[0]]) == 5  # script, styles, sentences


def test_back_leads_from_a_lesson_to_where_one_was(open_page):
    page = open_page("?lesson=what-an-impact-is&step=2")
    ready(page)
    before = page.evaluate("() => [history.length, location.search]")
    page.tab.goto(f"http://{page.address}/?lesson=bounce-twice")
    page.laid_out()
    ready(page)
    assert page.evaluate("() => history.length") == before[0] + 1
    page.tab.go_back()
    page.laid_out()
    ready(page)
    assert page.evaluate("() => location.search") == before[1]


WAITS = "() => strikewave.page.waiter.soon('test', 'Solving …')"
COVERED = """() => {
  const both = [strikewave.page.waiter.root, strikewave.page.root.querySelector('.lesson h2')];
  const [a, b] = both.map((each) => each.getBoundingClientRect());
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}"""


def test_what_is_waited_for_does_not_stand_over_the_question(open_page):
    """Where the caption was before the lesson came, its heading is now."""
    page = open_page(LESSON)
    ready(page)
    page.evaluate(WAITS)
    for size in [(1440, 900), (820, 1180), (390, 844)]:
        page.resize(*size)
        expect(page.tab.locator(".waiting")).to_be_visible()
        assert not page.evaluate(COVERED)


class Held:
    """What the server says, held back from when it is told to until it is let go."""

    def __init__(self, tab):
        self.holds = False
        self.kept = []
        tab.route_web_socket(re.compile("/ws"), self._between)

    def _between(self, browser):
        server = browser.connect_to_server()
        server.on_message(lambda said: self.kept.append((browser, said)) if self.holds else browser.send(said))

    def let_go(self) -> None:
        self.holds = False
        for browser, said in self.kept:
            browser.send(said)
        self.kept.clear()


def test_the_picture_of_another_step_does_not_stand_beside_a_question(open_page):
    page = open_page("liveness", own=True, drawn=False, size=(390, 844))
    held = Held(page.tab)

    def fetched(route):  # the page has its first picture by then, which is not that of the lesson
        held.holds = True
        route.continue_()

    page.tab.route("**/lessons/centre-of-percussion*", fetched)
    page.tab.goto(f"http://{page.address}/?lesson=centre-of-percussion&step=4")
    for heading in ("Let the lower end stand still", "What does the pin do?"):
        expect(page.tab.get_by_role("heading", name=heading)).to_be_visible()
        expect(page.tab.locator(".waiting")).to_have_text("Solving …")
        stages, waiting, asked = (page.tab.locator(each) for each in (".stages", ".waiting", ".lesson-asked"))
        for part in (stages, page.tab.locator(".player")):
            expect(part).to_be_hidden()
        assert asked.evaluate("(root) => root.inert")
        above, below = stages.bounding_box(), waiting.bounding_box()
        assert above == pytest.approx(below)  # where the picture will be
        page.tab.keyboard.press("Space")
        assert page.evaluate("() => strikewave.page.player.t") == 0
        held.let_go()
        ready(page)
        expect(waiting).to_be_hidden()
        expect(stages).to_be_visible()
        assert not asked.evaluate("(root) => root.inert")
        if heading.startswith("Let"):
            page.resize(1440, 900)
            held.holds = True
            button(page, "Skip →").click()
