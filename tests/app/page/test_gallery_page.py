"""The gallery: scenes as moving pictures, all of them by chapter, a search, and scenes of the visitor's own."""

import hashlib
import re
from itertools import product

import pytest
from playwright.sync_api import expect

from app.choices.choices import SCENES
from app.messages.gallery.cards import SCENES_SHOWN
from solvers.scenes.library import SCENES as FOLDER

from .hands import paste_into, type_into
from .test_page import settled

ROD = (FOLDER / "free-rod.toml").read_text("utf-8").split("[view]")[0].replace("Steel rod", "My rod")
DROP = """([name, text]) => {
  const data = new DataTransfer();
  data.items.add(new File([text], name));
  document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
}"""
SEEN = """() => [...strikewave.page.scenes.gallery.body.querySelectorAll('button[data-scene]')]
  .filter((each) => each.checkVisibility()).map((each) => each.dataset.scene)"""
FOCUSED = "() => strikewave.page.root.getRootNode().activeElement.dataset.scene"
CARD = ".card[data-scene=newtons-cradle]"
PIXELS = f"""() => {{
  const canvas = strikewave.page.root.querySelector('{CARD} canvas');
  return canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.join();
}}"""


def gallery(page):
    return page.tab.get_by_role("dialog", name="Scenes and lessons")


def opened(page) -> None:
    page.tab.get_by_role("button", name=re.compile("^Scene: ")).click()
    expect(gallery(page)).to_be_visible()


@pytest.mark.parametrize("query", ["", "?layout=laboratory"])
def test_a_scene_is_chosen_by_its_picture_and_nothing_is_fetched_before(open_page, query):
    page = open_page("liveness", own=True, drawn=False)
    fetched = []
    page.tab.on("request", lambda request: fetched.append(request.url))
    page.tab.goto(f"http://{page.address}/{query}")
    page.laid_out()
    assert not [address for address in fetched if "gallery" in address]
    opened(page)
    assert len([address for address in fetched if "gallery" in address]) == 3  # script, style, and what is in it
    scene = page.header("chosen")["scene"]
    expect(page.tab.locator("button.card")).to_have_count(len(SCENES_SHOWN))
    expect(page.tab.locator(".gallery [aria-current=true]").first).to_have_attribute("data-scene", scene)
    page.answered(lambda: page.tab.locator(CARD).click())
    expect(gallery(page)).to_be_hidden()
    assert page.header("chosen")["scene"] == "newtons-cradle"
    expect(page.tab.locator(".field-scene .title")).to_contain_text("Newton's cradle")


def test_lessons_are_named_where_the_page_opens_and_lie_on_nothing(open_page):
    page = open_page("")
    button = page.tab.get_by_role("button", name="Lessons", exact=True)
    for size in [(390, 844), (820, 1180), (1280, 720)]:
        page.resize(*size)
        words = page.evaluate(
            """() => {
              const range = document.createRange();
              range.selectNodeContents(strikewave.page.root.querySelector('.ask h2'));
              return [...range.getClientRects()].map(({ left, top, right, bottom }) => [left, top, right, bottom]);
            }"""
        )
        box = button.bounding_box()
        right, bottom = box["x"] + box["width"], box["y"] + box["height"]
        assert right <= size[0] and words
        assert not any(box["x"] < x1 and right > x0 and box["y"] < y1 and bottom > y0 for x0, y0, x1, y1 in words)
        button.click()
        expect(gallery(page).get_by_role("heading", name="Lessons", exact=True)).to_be_visible()
        expect(page.tab.locator(".lesson-cards a").first).to_be_in_viewport()
        gallery(page).get_by_role("button", name="Close scenes and lessons").click()


def test_the_scene_stays_until_one_is_chosen(open_page):
    page = open_page("?scene=free-rod")
    page.tab.keyboard.press("g")
    expect(gallery(page)).to_be_visible()
    page.tab.keyboard.press("Space")  # goes to the search, and not to the clock
    assert page.evaluate("() => strikewave.page.player.playing") is False
    page.tab.keyboard.press("Escape")
    expect(gallery(page)).to_be_hidden()
    assert page.header("chosen")["scene"] == "free-rod"


def test_all_scenes_are_found_by_words_and_keys(open_page):
    page = open_page("?gallery=")
    expect(gallery(page)).to_be_visible()
    assert page.evaluate("() => strikewave.page.opening.plan") == "opening"  # it lies over what is seen without it
    search, count = (
        page.tab.get_by_role("searchbox", name="Search scenes and lessons"),
        page.tab.locator(".gallery .count"),
    )
    expect(search).to_be_focused()
    expect(count).to_have_text(f"{len(SCENES)} scenes")
    page.evaluate("() => strikewave.page.root.querySelectorAll('.gallery details').forEach((e) => (e.open = true))")
    assert set(page.evaluate(SEEN)) == set(SCENES)
    type_into(search, "7.6", "")
    expect(count).to_have_text(f"1 of {len(SCENES)} scenes")
    assert page.evaluate(SEEN) == ["figure-7.6"]
    page.wait("() => location.search.includes('gallery=7.6')")
    type_into(search, "xylophone", "")
    cards = page.evaluate(SEEN)[:2]
    assert cards == ["xylophone-bar", "xylophone-bar-node"]
    for key, scene in (("ArrowDown", cards[0]), ("ArrowRight", cards[1]), ("ArrowLeft", cards[0])):
        page.tab.keyboard.press(key)
        assert page.evaluate(FOCUSED) == scene
    page.tab.keyboard.press("ArrowUp")
    expect(search).to_be_focused()
    page.answered(lambda: page.tab.keyboard.press("Enter"))
    assert page.header("chosen")["scene"] == cards[0]
    page.wait("() => !location.search.includes('gallery')")
    page.tab.keyboard.press("Space")  # plays it, and does not open the gallery again
    page.wait("() => strikewave.page.player.playing")
    expect(gallery(page)).to_be_hidden()


def test_pictures_move_under_a_pointer_and_never_where_nothing_is_to_move(open_page):
    for motion, moves in (("no-preference", True), ("reduce", False)):
        page = open_page("?layout=laboratory", reduced_motion=motion)
        opened(page)
        still = page.evaluate(PIXELS)
        page.tab.locator(CARD).hover()
        if moves:
            page.wait(f"(still) => ({PIXELS})() !== still", still)
            page.tab.mouse.move(2, 2)
        else:
            page.frames_pass(20)
        page.wait(f"(still) => ({PIXELS})() === still", still)


def test_cards_are_whole_and_large_enough_to_touch(open_page):
    page = open_page("?layout=laboratory")
    for letters, size in product(("100%", "200%"), [(390, 844), (820, 1180), (1280, 720)]):
        page.resize(*size)
        page.evaluate("size => (document.documentElement.style.fontSize = size)", letters)
        opened(page)
        boxes = page.evaluate(
            """() => {
              const { body } = strikewave.page.scenes.gallery;
              const all = [...body.querySelectorAll('button')].filter((each) => each.checkVisibility());
              return { over: body.scrollWidth - body.clientWidth, cut: all.filter((each) =>
                each.scrollWidth > each.clientWidth + 1).length,
                low: Math.min(...all.map((each) => each.getBoundingClientRect().height)) };
            }"""
        )
        assert boxes["over"] <= 0 and boxes["cut"] == 0 and boxes["low"] >= 24, (letters, size, boxes)
        gallery(page).get_by_role("button", name="Close scenes and lessons").click()


def test_a_scene_file_dropped_on_the_page_is_solved_kept_and_shared_by_its_link(open_page):
    page = open_page("", own=True)
    page.answered(lambda: page.evaluate(DROP, ["mine.toml", ROD]))
    settled(page)
    assert page.header("title").startswith("My rod")
    expect(page.tab.locator(".field-scene .title")).to_contain_text("My rod")
    page.wait("() => location.search.includes('scene=own.')")
    again = open_page("?" + page.tab.url.split("?")[1])
    assert again.header("title") == page.header("title")
    page.tab.reload()
    page.laid_out()
    opened(page)
    kept = gallery(page).get_by_role("listitem").filter(has_text="My rod").first
    expect(kept).to_be_visible()
    kept.get_by_role("button", name="Edit").click()
    field = page.tab.get_by_label("A scene file")
    expect(field).to_have_value(ROD)
    paste_into(field, ROD.replace("My rod", "Another rod"))
    page.answered(lambda: gallery(page).get_by_role("button", name="Solve it").click())
    expect(gallery(page)).to_be_hidden()
    opened(page)
    expect(page.tab.locator(".own li")).to_have_count(2)
    page.tab.get_by_role("button", name="Remove: My rod").click()
    expect(page.tab.locator(".own li")).to_have_count(1)


def test_a_scene_file_that_cannot_be_is_refused_by_line_and_key_and_the_page_goes_on(open_page):
    page = open_page("", own=True)
    wrong = ROD.replace("length = 0.3", "length = -1")
    assert wrong != ROD
    line = wrong[: wrong.index("length = -1")].count("\n") + 1
    page.evaluate(DROP, ["mine.toml", wrong])
    expect(page.tab.get_by_role("alert").filter(visible=True)).to_contain_text(f"Line {line}: target.length: got -1")
    assert page.header("chosen")["scene"] == "fixed-rod"
    paste_into(page.tab.get_by_label("A scene file"), ROD)
    page.answered(lambda: gallery(page).get_by_role("button", name="Solve it").click())
    assert page.header("title").startswith("My rod")
    page.evaluate(DROP, ["notes.txt", ROD])
    expect(page.tab.get_by_role("status").filter(has_text="toml")).to_be_visible()


def test_a_long_scene_of_fewer_balls_follows_one_of_more(open_page):
    page = open_page("?scene=newtons-cradle&layout=opening", own=True)
    settled(page)
    cradle = (FOLDER / "newtons-cradle.toml").read_text("utf-8")
    noise = "".join(hashlib.sha256(bytes([k])).hexdigest() for k in range(20))  # which cannot be packed well
    fewer = cradle.replace("{ radius = 0.02 }, { radius = 0.02 }, ", "", 1) + f"\n# {noise}\n"
    page.answered(lambda: page.evaluate(DROP, ["balls.toml", fewer]))
    settled(page)
    assert len(page.evaluate("() => strikewave.page.frame.chosen.scene")) > 900
    assert page.evaluate("() => strikewave.page.frame.target.row.length") == 2
    expect(page.tab.locator(".ask h2")).to_contain_text("?")
    page.wait("() => strikewave.page.opening.section.shown")


def test_a_press_beside_it_closes_it_but_ends_no_writing(open_page):
    page = open_page()
    opened(page)
    page.tab.mouse.click(3, 300)
    expect(gallery(page)).to_be_hidden()
    opened(page)
    page.tab.get_by_role("button", name="Change this scene as text").click()
    page.tab.mouse.click(3, 300)
    page.frames_pass(3)
    expect(gallery(page)).to_be_visible()


def test_a_search_that_finds_nothing_says_so(open_page):
    page = open_page("?gallery")
    search = page.tab.get_by_role("searchbox", name="Search scenes and lessons")
    type_into(search, "qwertz", "")
    said = page.tab.get_by_text("No scene and no lesson has “qwertz” in it.")
    expect(said).to_be_visible()
    type_into(search, "xylophone", "")
    expect(said).to_be_hidden()
    type_into(search, "", "")
    expect(page.tab.locator(".gallery-body .help").first).to_be_hidden()
