"""Where lessons are found: at the end of one, in the gallery with one's own progress, and in files of one's own."""

import json
import re

import pytest
from playwright.sync_api import expect

from app.lessons.record import lesson_record
from app.lessons.shipped import FOLDER, in_order, lesson_names, shipped_lesson

from .hands import type_into
from .test_access_page import findings
from .test_lesson_page import LATE, LESSON, answered_choice, button, drawn, onwards, ready

ANSWER = "() => strikewave.page.opening.teaching.lesson.progress.answers"


def listed(page):
    page.tab.keyboard.press("g")
    dialog = page.tab.get_by_role("dialog", name="Scenes and lessons")
    expect(dialog).to_be_visible()
    return dialog


def test_the_last_step_leads_to_all_lessons_and_they_say_how_far_one_has_come(open_page):
    page = open_page(LESSON, size=(390, 844))
    ready(page)
    answered_choice(page)
    onwards(page)
    page.tab.goto(f"http://{page.address}/?lesson=what-an-impact-is&step=6")
    page.laid_out()
    ready(page)
    expect(page.tab.get_by_role("link", name="Next lesson: A mass on a rod →")).to_be_in_viewport()
    button(page, "All lessons").click()
    cards = page.tab.locator(".lesson-cards a")
    expect(cards.first).to_be_in_viewport()
    names = [lesson.lesson for lesson in in_order([shipped_lesson(name) for name in lesson_names()])]
    searches = cards.evaluate_all("all => all.map((each) => new URL(each.href).search)")
    left = {"what-an-impact-is": "&step=6", "bounce-twice": "&step=2"}  # where one was
    assert searches == [f"?lesson={name}{left.get(name, '')}" for name in names]
    bounce = cards.nth(names.index("bounce-twice"))
    expect(cards.nth(0)).to_contain_text("step 6 of 6")
    expect(bounce.locator("strong")).to_have_text("Why does it bounce twice?")  # its first question is answered
    expect(bounce).to_contain_text("step 2 of 6")
    page.tab.keyboard.press("Space")  # goes to the search, and not to the clock
    assert page.evaluate("() => strikewave.page.player.playing") is False
    assert findings(page) == []
    type_into(page.tab.get_by_role("searchbox"), "rod", "")
    expect(cards.nth(0)).to_be_hidden()
    page.tab.locator(".card[data-scene=free-rod]").click()  # a scene leads out of the lesson
    page.tab.wait_for_url("**scene=free-rod*")


def dropped(page, text: str, name: str = "mine.md") -> None:
    page.tab.evaluate(
        """([name, text]) => {
          const data = new DataTransfer();
          data.items.add(new File([text], name));
          document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
        }""",
        [name, text],
    )


def test_a_lesson_file_that_is_dropped_runs_and_stays_in_its_tab(open_page):
    page = open_page("?scene=free-rod")
    text = (FOLDER / "bounce-twice.md").read_text("utf-8").replace("What comes next?", "And now?")
    dropped(page, text.replace("mass_ratio = 0.8", "mass_ratio = -1"))
    expect(page.tab.locator(".lesson-file h3")).to_have_text("mine.md: 2 errors")
    expect(page.tab.locator(".problems li").first).to_contain_text("a number from 0.001 to 1000")
    expect(page.tab.locator(".problems li code").first).to_have_text("changes = { mass_ratio = -1 }")
    assert findings(page) == []
    page.tab.keyboard.press("Escape")
    assert page.header("chosen")["scene"] == "free-rod"
    listed(page).locator(".lessons input[type=file]").set_input_files(
        {"name": "mine.md", "mimeType": "text/markdown", "buffer": text.encode()}
    )
    page.tab.wait_for_url("**/?lesson=own*")
    page.laid_out()
    ready(page)
    heading = page.tab.get_by_role("heading", name="They have parted. And now?")
    expect(heading).to_be_visible()
    answered_choice(page)
    onwards(page)
    assert page.tab.url.endswith("?lesson=own&step=2")
    page.tab.reload()
    page.laid_out()
    ready(page)
    button(page, "Back").click()
    ready(page)
    expect(heading).to_be_visible()
    expect(page.tab.locator(".lesson-said")).to_contain_text("Yes:")  # and answers to it stay
    page.tab.goto(f"http://{page.address}/?lesson=own&step=6")
    page.laid_out()
    ready(page)
    page.tab.get_by_role("link", name="For teachers: read codes").click()
    expect(page.tab.get_by_role("heading", name="Codes of a class")).to_be_visible()
    expect(button(page, "Copy its link")).to_have_count(0)  # it has none elsewhere
    page.tab.get_by_role("link", name="To the lesson").click()
    page.tab.wait_for_url("**/?lesson=own*")
    page.tab.goto(f"http://{page.address}/{LESSON}")
    page.laid_out()
    ready(page)
    expect(page.tab.get_by_label("A second contact")).not_to_be_checked()  # another lesson, though of the same name
    page.evaluate("() => sessionStorage.clear()")
    page.tab.goto(f"http://{page.address}/?lesson=own&step=2")
    expect(page.tab.locator(".toast")).to_contain_text("The lesson file is not in this tab any more")
    expect(page.tab.locator(".ask h2")).to_be_visible()


def test_a_file_that_is_no_lesson_is_refused_and_nothing_is_lost(open_page):
    page = open_page("?lesson=bounce-twice&step=2")
    ready(page)
    drawn(page, LATE)
    status = page.tab.locator(".lesson-file [role=status]")
    dropped(page, "a" * 200_001)
    expect(status).to_have_text("This file has 201 kB; allowed: a lesson of up to 200 kB.")
    dropped(page, (FOLDER / "bounce-twice.es.md").read_text("utf-8"))
    expect(page.tab.locator(".problems")).to_contain_text("this file has the sentences of a translation alone")
    page.tab.route("**/lesson", lambda route: route.abort())
    dropped(page, "---")
    expect(status).to_have_text("The file could not be sent: the server is busy, or gone. Try again in a minute.")
    page.tab.keyboard.press("Escape")
    expect(button(page, "Show what happens")).to_be_enabled()
    page.errors.clear()  # the browser notes that nothing was sent


def test_scenes_that_were_not_tried_are_said_once(open_page):
    page = open_page("")
    record = json.dumps(lesson_record(shipped_lesson("bounce-twice")))
    kept = (
        f"() => sessionStorage.setItem('strikewave.own-lesson', JSON.stringify({{ lesson: {record}, whole: false }}))"
    )
    page.evaluate(kept)
    page.tab.goto(f"http://{page.address}/?lesson=own")
    page.laid_out()
    ready(page)
    expect(page.tab.locator(".toast")).to_contain_text("Not all scenes of this lesson were tried")
    page.tab.reload()
    page.laid_out()
    ready(page)
    expect(page.tab.locator(".toast")).to_be_hidden()


def test_a_question_is_tried_again_and_the_first_answer_stays(open_page):
    page = open_page(LESSON, size=(390, 844))
    ready(page)
    page.tab.get_by_label("No more contact").check()
    button(page, "Show what happens").click()
    button(page, "Try again").click()
    page.tab.get_by_label("A second contact").check()
    button(page, "Show what happens").click()
    expect(page.tab.locator(".lesson-choice")).to_contain_text("2 tries")
    expect(page.tab.locator(".lesson-said")).to_contain_text("Yes:")
    kept = {"picked": 0, "last": 1, "done": True, "later": True, "more": 1}
    assert page.evaluate(ANSWER)["next"] == kept
    page.tab.goto(f"http://{page.address}/{LESSON}&step=4")
    page.laid_out()
    ready(page)
    number = page.tab.get_by_label("Your number")
    for written in ("58", "1164", "116.4"):
        type_into(number, f"{written} µs")
        button(page, "Check").click()
        expect(page.tab.locator(".lesson-said")).to_be_in_viewport()
    expect(button(page, "Try again")).to_have_count(0)  # of what is right
    assert page.evaluate(ANSWER)["back"]["first"] == {
        **{"written": "58 µs", "value": 58, "unit": "µs", "said": 0, "done": False},
    }
    onwards(page)
    button(page, "Check").click()
    expect(page.tab.locator(".lesson-said")).to_be_in_viewport(ratio=1)  # below all lines of the order
    onwards(page, "Skip →")
    sums = page.tab.locator(".lesson-sum")
    expect(sums.nth(0)).to_contain_text("No more contact")
    expect(sums.nth(0)).to_contain_text("there is still a wave in the rod")
    expect(sums.nth(0)).to_contain_text("2 tries")
    expect(sums.nth(3)).to_contain_text("58 µs")
    expect(sums.nth(3)).to_contain_text("It has as far to go back")
    expect(sums.nth(3)).to_contain_text("3 tries")
    expect(sums.nth(2)).to_contain_text("not answered")
    expect(sums.nth(4)).to_contain_text("of 6")  # tried, though in vain
    expect(sums.nth(4)).not_to_contain_text("not answered")


def test_the_chart_says_what_is_on_it_and_keys_come_to_it_before_the_ways_on(open_page):
    page = open_page(f"{LESSON}&step=2", size=(390, 844))
    ready(page)
    expect(page.tab.locator(".lesson-name")).to_be_visible()
    plot = page.tab.locator(".sketch-plot")
    expect(plot).to_have_attribute("aria-label", re.compile("^An empty chart to draw on: Contact force, kN, until"))
    page.tab.locator(".lesson h2").focus()
    focused = []
    for _ in range(3):
        page.tab.keyboard.press("Tab")
        focused.append(page.evaluate("() => strikewave.page.root.getRootNode().activeElement.className"))
    assert focused[1] == "sketch-plot"  # behind Type points: there is nothing to undo or to clear
    drawn(page, LATE)
    expect(plot).to_have_attribute("aria-label", re.compile("^A chart with your line on it: .* Arrow right goes on"))
    clear = button(page, "Clear")
    clear.press("Enter")
    expect(clear).to_be_disabled()
    expect(plot).to_be_focused()  # not lost with the tool
    drawn(page, LATE)
    button(page, "Show what happens").click()
    expect(plot).to_have_attribute("aria-label", re.compile(r"^Your line and what happens: Contact force, kN, .*T\.$"))


def test_a_lesson_on_paper_has_all_steps_and_no_answer_but_in_the_key(open_page):
    page = open_page(LESSON)
    ready(page)
    page.evaluate("() => (window.print = () => (window.printed = true))")
    button(page, "Print").click()
    page.tab.locator(".lesson-printing .lesson-main").click()
    page.wait("() => window.printed")
    ready(page)
    page.tab.emulate_media(media="print")
    paper = page.tab.locator(".lesson-print")
    names = ("h2", ".print-still", ".print-chart", ".print-box", ".print-place", ".print-below")
    parts = [paper.locator(each).count() for each in names]
    stills = paper.locator(".print-still").evaluate_all("all => all.map((each) => each.src)")
    wide = paper.locator("img").evaluate_all("all => all.map((each) => each.clientWidth)")
    said, bar = paper.inner_text(), page.tab.locator(".topbar").is_visible()
    page.tab.emulate_media(media="screen")
    assert parts == [5, 4, 1, 3, 6, 0] and not bar  # rows would tell what is to be drawn
    assert len(set(stills)) == 4  # each at the time that its step is about, and once
    assert max(wide) > 600 and "Number them in their order" in said
    assert "How long does the front take?" in said and "Name:" in said and "Date:" in said
    assert "Your value, from 0.34 to 10 (at the start: Mass ratio: 0.8):" in said
    assert not re.search(r"116|Yes: a wave|bounce twice|In your line|All in order|One contact\.|Key", said), said
    assert page.evaluate("() => strikewave.page.opening.teaching.lesson.progress.far") == 0  # nothing was looked at
    page.tab.emulate_media(media="screen")
    assert len(re.findall(rb"/Type\s*/Page\b", page.tab.pdf())) <= 2  # sheets, of five questions


def test_the_dialogue_of_printing_has_a_title_and_ways_out_and_offers_no_key(open_page):
    page = open_page(f"{LESSON}&key")
    ready(page)
    dialogue = page.tab.get_by_role("dialog", name="Print this lesson")
    for leave in (
        lambda: button(page, "Cancel").click(),
        lambda: page.tab.keyboard.press("Escape"),
        lambda: page.tab.mouse.click(5, 5),
    ):
        button(page, "Print").click()
        expect(dialogue).to_be_visible()
        expect(dialogue.locator("input")).to_have_count(0)
        leave()
        expect(dialogue).to_be_hidden()
    page.tab.pdf()  # which fills the paper
    said = page.tab.locator(".lesson-print").text_content()
    assert "Numbers" in said or "Number them" in said
    assert "A second contact" in said and "Yes: a wave" not in said  # the address says nothing of a key any more


def test_the_key_is_on_the_page_of_the_teacher(open_page):
    page = open_page("?class=bounce-twice")
    page.wait("() => window.strikewave && strikewave.page.root.querySelector('.classes')")
    page.evaluate("() => (window.print = () => (window.printed = true))")
    page.wait("() => !strikewave.page.asked")
    page.tab.get_by_role("button", name="Print the key").click()
    page.wait("() => window.printed")
    page.tab.emulate_media(media="print")
    paper = page.tab.locator(".lesson-print")
    key = paper.inner_text()
    assert page.tab.locator(".classes").is_hidden() and paper.locator(".print-chart").count() == 1
    assert (
        "116.4 µs (± 2.3 µs)" in key
        and "It pushes the struck end out once more" in key
        and "A second contact" in key
        and "from 1.02 to 10: One" in key
    )


def test_paper_has_the_charts_that_texts_speak_of_and_leaves_what_was_answered(open_page):
    page = open_page("?lesson=bending&step=2", size=(390, 844), color_scheme="dark")
    ready(page)
    page.evaluate("() => (window.print = () => (window.printed = true))")
    turned = "() => getComputedStyle(document.documentElement).filter"
    assert "invert" in page.evaluate(turned)
    progress = "() => JSON.stringify([strikewave.page.opening.teaching.lesson.progress, {...localStorage}])"
    before = page.evaluate(progress), page.tab.url, page.evaluate("() => history.length")
    button(page, "Print").click()
    page.tab.locator(".lesson-printing .lesson-main").click()
    page.wait("() => window.printed")
    ready(page)
    assert (page.evaluate(progress), page.tab.url, page.evaluate("() => history.length")) == before
    page.tab.emulate_media(media="print")
    assert page.evaluate(turned) == "none"  # paper is white where the page is dark
    page.tab.set_viewport_size({"width": 720, "height": 1040})  # a sheet
    steps = page.tab.locator(".lesson-print section")
    assert [steps.nth(k).locator(".print-below").count() for k in range(7)] == [0, 1, 0, 2, 1, 0, 2]
    assert page.evaluate("() => getComputedStyle(document.documentElement).backgroundColor") == "rgba(0, 0, 0, 0)"
    chart = steps.nth(1).locator(".print-below")
    assert 300 < chart.evaluate("(each) => each.clientWidth") < 420  # half a page, as its letters are on the page
    inks = """(each) => {
      const canvas = Object.assign(document.createElement('canvas'), { width: each.naturalWidth, height: 400 });
      const c = canvas.getContext('2d');
      c.drawImage(each, 0, 0);
      const { data } = c.getImageData(0, 0, canvas.width, canvas.height);
      return new Set(new Uint32Array(data.buffer)).size;
    }"""
    assert chart.evaluate(inks) > 20 and page.tab.locator(".print-key").count() == 0


def test_keys_of_a_presenter_walk_through_a_lesson_before_a_class(open_page):
    page = open_page(f"{LESSON}&projector")
    ready(page)
    step = "() => strikewave.page.opening.teaching.lesson.at"
    for key, at in (("ArrowRight", 1), ("PageDown", 2), ("ArrowLeft", 1), ("PageUp", 0)):
        page.tab.keyboard.press(key)
        ready(page)
        assert page.evaluate(step) == at
    assert page.tab.url.endswith("?lesson=bounce-twice&step=1&projector")
    page.evaluate("() => { const { player } = strikewave.page; player.go(0); player.toggle(); }")
    page.tab.keyboard.press("f")
    assert page.evaluate("() => strikewave.page.player.playing") is False
    letters = "() => parseFloat(strikewave.page.view.stage.canvas.getContext('2d').font.match(/[0-9.]+px/)[0])"
    large = page.evaluate(letters)
    page.tab.get_by_role("button", name="Large, for a projector").click()
    page.tab.wait_for_url("**/?lesson=bounce-twice&step=1")
    page.laid_out()
    ready(page)
    page.tab.keyboard.press("ArrowRight")
    assert page.evaluate(step) == 0
    assert large == pytest.approx(1.3 * page.evaluate(letters))  # words of pictures, too


def pages(page) -> int:
    """How many sheets the browser prints by itself."""
    return len(re.findall(rb"/Type\s*/Page\b", page.tab.pdf(format="A4")))


def test_what_a_phone_prints_by_itself_says_how_all_pictures_are_got(open_page):
    page = open_page(LESSON, size=(390, 844))
    ready(page)
    page.evaluate("() => (window.print = () => (window.printed = true))")
    paper = page.tab.locator(".lesson-print")
    assert pages(page) >= 2
    assert paper.locator("h2").count() == 5 and paper.locator(".print-still").count() == 1
    expect(paper.locator(".print-note")).to_contain_text("use Print, at the top of the lesson")
    button(page, "Print").click()
    page.tab.locator(".lesson-printing .lesson-main").click()
    page.wait("() => window.printed")
    ready(page)
    page.fits(390)
    assert pages(page) >= 2
    assert paper.locator(".print-still").count() == 4  # of five, two are alike
    assert paper.locator(".print-note").count() == 0
