"""What a step of a lesson bounds or measures once its scene is there: how far its slider reaches, and its chart."""

from playwright.sync_api import expect

from .test_access_page import findings
from .test_lesson_page import LESSON, button, onwards, ready

ONCE = "() => strikewave.page.opening.teaching.lesson.progress.answers.once"


def mass_ratio(page) -> float:
    return page.header("chosen")["mass_ratio"]


def test_the_slider_of_a_question_reaches_as_far_as_its_range(open_page):
    page = open_page(f"{LESSON}&step=3")
    ready(page)
    slider = page.tab.locator("#choice-mass_ratio")
    for place, end in (("1000", 10), ("0", 0.34)):
        page.answered(lambda place=place: slider.fill(place))
        assert mass_ratio(page) == end
    number = page.tab.get_by_role("textbox", name="Mass ratio, exact value")
    number.fill("15.8")
    number.press("Enter")
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


def test_where_a_slider_was_left_beyond_its_range_it_begins_at_its_end(open_page):
    """As pages before did."""
    page = open_page(f"{LESSON}&step=3")
    ready(page)
    page.evaluate("""() => {
      const { lesson } = strikewave.page.opening.teaching;
      lesson.progress.answers.once.place = 15.8;
      lesson.keep();
    }""")
    page.tab.reload()
    page.laid_out()
    ready(page)
    assert mass_ratio(page) == 10
