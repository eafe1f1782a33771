"""What a step of a lesson bounds or measures once its scene is there: how far its slider reaches, and its chart."""

import pytest
from playwright.sync_api import expect

from app.lessons.record import lesson_record
from app.lessons.shipped import shipped_lesson

from .hands import arrow, type_into
from .test_access_page import findings
from .test_lesson_page import LATE, LESSON, READY, button, drawn, judged, onwards, ready

UNTIL = "() => strikewave.page.opening.teaching.lesson.question.drawn.until"
ONCE = "() => strikewave.page.opening.teaching.lesson.progress.answers.once"


def mass_ratio(page) -> float:
    return page.header("chosen")["mass_ratio"]


def test_the_slider_of_a_question_reaches_as_far_as_its_range_and_begins_in_it(open_page):
    page = open_page(f"{LESSON}&step=3")
    ready(page)
    slider = page.tab.locator("#choice-mass_ratio")
    for place, end in ((1000, 10), (0, 0.34)):
        page.answered(lambda place=place: arrow(slider, place))
        assert mass_ratio(page) == end
    number = page.tab.get_by_role("textbox", name="Mass ratio, exact value")
    type_into(number, "15.8", "Enter")
    expect(page.tab.locator(".field-mass_ratio .wrong")).to_contain_text("from 0.34 to 10")
    assert findings(page) == []
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('mass_ratio', 15.8)"))
    assert mass_ratio(page) == 10
    assert [each["place"] for each in page.evaluate(ONCE)["found"]] == [10, 0.34]  # as the code gives them
    onwards(page)
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('mass_ratio', 15.8)"))
    assert mass_ratio(page) == 15.8  # no other step is held
    button(page, "Back").click()
    ready(page)
    assert mass_ratio(page) == 10
    page.evaluate("""() => { // where pages before left it
      const { lesson } = strikewave.page.opening.teaching;
      lesson.progress.answers.once.place = 15.8;
      lesson.keep();
    }""")
    page.tab.reload()
    page.laid_out()
    ready(page)
    assert mass_ratio(page) == 10


@pytest.fixture
def changed(open_page):
    """Open a step of a lesson whose record was changed on its way."""
    routed = []

    def opened(change, step: int, **how):
        record = lesson_record(shipped_lesson("bounce-twice"))
        change(record["steps"])
        page = open_page("liveness", drawn=False, **how)
        routed.append(page.tab)
        page.tab.route("**/lessons/bounce-twice*", lambda route: route.fulfill(json=record))
        page.tab.goto(f"http://{page.address}/{LESSON}&step={step}")
        return page

    yield opened
    for tab in routed:
        tab.unroute_all()


def until_the_end(steps) -> None:
    sketch = next(part for part in steps[1]["parts"] if part["kind"] == "sketch")
    sketch["until"] = "part-2"


@pytest.mark.parametrize("step", [1, 2])
def test_a_chart_until_an_event_is_as_long_as_that_of_its_own_scene(changed, step):
    def change(steps) -> None:
        until_the_end(steps)
        steps[0]["choices"] = {"mass_ratio": 2.0}  # where they part at another time

    page = changed(change, step)
    page.wait(READY)
    ready(page)
    if step == 1:
        onwards(page, "Skip →")
    end = page.evaluate(UNTIL)
    assert end == pytest.approx(page.evaluate("() => strikewave.page.frame.exact.contacts[1][1]"))
    expect(page.tab.locator(".lesson-asked .lesson-hint")).to_contain_text("2.2 T")
    drawn(page, [(min(t / end, 1) * 2.6, force) for t, force in LATE])
    button(page, "Show what happens").click()
    before = judged(page)
    page.tab.reload()
    page.laid_out()
    ready(page)
    assert page.evaluate(UNTIL) == end and judged(page) == before


@pytest.mark.parametrize(("size", "step"), [((1440, 900), 1), ((390, 844), 2)])
def test_why_a_scene_is_refused_stays_where_its_picture_would_be(changed, size, step):
    def change(steps) -> None:
        steps[step - 1]["choices"] = {"mass_ratio": -1}

    page = changed(change, 1, size=size)
    if step == 2:
        page.wait(READY)
        ready(page)
        button(page, "Skip →").click()
    why = page.tab.locator(".lesson-refused")
    expect(why).to_contain_text("Mass ratio")
    page.evaluate("() => { strikewave.page.toast.root.hidden = true; }")  # as it is after a while
    expect(why).to_be_visible()
    expect(page.tab.locator(".waiting")).to_be_hidden()
    expect(page.tab.locator(".player")).to_be_hidden()
    assert why.bounding_box() == pytest.approx(page.tab.locator(".stages").bounding_box(), abs=2)
    page.fits(size[0])
    assert findings(page) == []
    onwards(page, "Skip →")
    expect(why).to_have_count(0)
    expect(page.tab.locator(".stages")).to_be_visible()


LINE = """() => strikewave.page.analyses.energy.figure.model('energy-cursor')?.location
  / (1000 * strikewave.page.player.t)"""  # its axis is in ms


LEGEND = """() => {
  const { analyses: { energy: { figure, root } } } = strikewave.page;
  const [{ area }] = figure.parts;
  return area.firstElementChild && area.getBoundingClientRect().bottom - root.getBoundingClientRect().bottom;
}"""


def test_a_plot_below_the_picture_is_seen_with_its_legend_and_its_line_follows_the_clock(open_page):
    page = open_page("?lesson=the-energy-left-ringing&step=3", size=(1280, 720))  # a low screen
    ready(page)
    page.wait(f"() => ({LEGEND})() !== null")
    page.frames_pass(2)
    assert page.evaluate(LEGEND) <= 0
    page.wait(f"() => Math.abs(({LINE})() - 1) < 1e-9")
    page.evaluate("() => strikewave.page.player.go(5e-4)")
    assert page.evaluate(LINE) == pytest.approx(1)
    button(page, "Back").click()
    ready(page)
    onwards(page, "Skip →")
    page.wait(f"() => Math.abs(({LINE})() - 1) < 1e-9")
    page.evaluate("() => strikewave.page.player.go(1e-3)")
    assert page.evaluate(LINE) == pytest.approx(1)
