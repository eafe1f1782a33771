"""The peak of the force in the small picture of What if … is pulled: another peak force is wanted, and delivered."""

import pytest
from playwright.sync_api import expect

from .hands import type_into
from .test_page import settled
from .test_whatif_fingers_page import MAP, TOP, away, phone, place  # noqa: F401 (a fixture)
from .test_whatif_page import DONE, OPEN, SIZES, WHATIF, opened

QUERY = "?layout=opening&law=hertz&whatif=peak_force,mass_ratio,hertz_stiffness"
HANDLE = ".whatif-pull button"
HERE = f"() => {WHATIF}.here('peak_force')"
WANTED = f"() => {WHATIF}.goal.wanted"
SPEED = "() => strikewave.page.frame.chosen.speed"
SCALE = "() => strikewave.page.opening.section.most"
FOUND = f"() => {WHATIF}.goal.pulling.idle && {WHATIF}.goal.seek.idle"


def middle(page) -> tuple[float, float]:
    box = page.tab.locator(HANDLE).bounding_box()
    assert box
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def delivered(page) -> float:
    """The value that is wanted, once the scene at rest delivers it."""
    page.wait(FOUND)
    settled(page)
    wanted = page.evaluate(WANTED)
    assert page.evaluate(HERE) == pytest.approx(wanted, rel=1e-3)
    return wanted


def test_the_peak_is_pulled_and_what_gives_way_delivers_it_in_one_step(show):
    page = opened(show, QUERY)
    handle, mouse = page.tab.locator(HANDLE), page.tab.mouse
    before, speed, scale = page.evaluate(HERE), page.evaluate(SPEED), page.evaluate(SCALE)
    x, y = middle(page)
    assert handle.evaluate("(each) => getComputedStyle(each).cursor") == "ew-resize"
    mouse.move(x, y)
    mouse.down()
    assert page.evaluate(WANTED) is None, "nothing is wanted before it moves"
    for k in range(1, 13):
        mouse.move(x - k, y)
    page.wait(FOUND)
    assert page.evaluate(SCALE) == scale, "the scale stays under the hand"
    assert middle(page)[0] == pytest.approx(x - 12, abs=0.5)
    said = page.tab.locator(".whatif-pull output")
    expect(said).to_be_visible()
    assert said.text_content() == handle.get_attribute("aria-valuetext")
    mouse.up()
    wanted = delivered(page)
    assert wanted > 1.2 * before and page.evaluate(SPEED) > 1.1 * speed
    assert page.evaluate(SCALE) > 1.2 * scale, "at rest the peak can be read again"
    expect(said).to_be_hidden()
    typed = page.tab.locator(".whatif-goal").get_by_role("textbox")
    assert float(typed.input_value()) == pytest.approx(wanted / 1e3, rel=1e-3)
    expect(page.tab.locator(".whatif-roots button")).to_have_count(1)
    page.tab.get_by_role("button", name="Undo").click()
    page.wait(f"(speed) => ({SPEED})() === speed", speed)
    settled(page)
    assert page.evaluate(HERE) == pytest.approx(before, rel=1e-9)


def test_what_was_chosen_to_give_way_does(show):
    page = opened(show, QUERY)
    goal = page.tab.locator(".whatif-goal")
    type_into(goal.get_by_role("textbox"), "16 kN")
    goal.get_by_role("combobox").select_option("hertz_stiffness")
    page.wait(FOUND)
    speed = page.evaluate(SPEED)
    x, y = middle(page)
    page.tab.mouse.move(x, y)
    page.tab.mouse.down()
    page.tab.mouse.move(x + 6, y, steps=4)
    page.tab.mouse.up()
    assert delivered(page) < 15e3
    chosen = page.evaluate("() => strikewave.page.frame.chosen")
    assert chosen["speed"] == speed and chosen["hertz_stiffness"] < 0.9e10


def test_keys_move_it_by_one_and_by_ten_percent(show):
    page = opened(show, QUERY)
    handle = page.tab.get_by_role("slider", name="Wanted peak force")
    before = page.evaluate(HERE)
    handle.focus()
    for key, factor in (
        ("ArrowUp", 1.01),
        ("ArrowLeft", 1.01**2),
        ("PageUp", 1.1 * 1.01**2),
        ("ArrowRight", 1.1 * 1.01),
    ):
        page.tab.keyboard.press(key)
        assert delivered(page) == pytest.approx(factor * before, rel=2e-3)
    page.tab.keyboard.press("PageDown")
    wanted = delivered(page)
    assert wanted == pytest.approx(before, rel=0.01)
    expect(handle).to_be_focused()
    assert float(handle.get_attribute("aria-valuenow") or 0) == wanted
    assert (handle.get_attribute("aria-valuetext") or "").endswith("kN")


def test_what_cannot_be_had_is_said_and_the_peak_stays(show):
    page = opened(show, QUERY)
    goal = page.tab.locator(".whatif-goal")
    type_into(goal.get_by_role("textbox"), "900 MN")
    page.wait(FOUND)
    before = page.evaluate(HERE)
    page.tab.locator(HANDLE).focus()
    page.tab.keyboard.press("ArrowUp")
    page.wait(FOUND)
    settled(page)
    assert page.evaluate(WANTED) == pytest.approx(909e6) and page.evaluate(HERE) == before
    expect(goal.locator(".whatif-roots")).to_contain_text("none")


def test_it_is_there_only_for_the_peak_force_of_rows(show):
    page = opened(show, QUERY)
    handle = page.tab.locator(HANDLE)
    expect(handle).to_be_visible()
    page.tab.emulate_media(media="print")
    expect(handle).to_be_hidden()
    page.tab.emulate_media(media="screen")
    page.tab.locator(".whatif-sentence select").first.select_option("contact_time")
    page.wait(DONE)
    expect(handle).to_be_hidden()
    page.tab.locator(".whatif-sentence select").first.select_option("peak_force")
    expect(handle).to_be_visible()
    page.tab.keyboard.press("Escape")
    expect(handle).to_have_count(0)
    page = show("?scene=drop-test&layout=opening", SIZES[0])
    settled(page)
    page.evaluate(OPEN, "")
    expect(page.tab.locator(".whatif-tiles [aria-pressed='true']")).to_contain_text("kN")
    expect(page.tab.locator(".page.rowless")).to_have_count(1)
    expect(handle).to_be_hidden()


def test_a_finger_pulls_it_across_and_scrolls_the_page_up_and_down(phone):  # noqa: F811
    page, fingers = phone(MAP)
    handle = page.tab.locator(HANDLE)
    handle.scroll_into_view_if_needed()
    box = handle.bounding_box()
    assert box and min(box["width"], box["height"]) >= 44
    before, top = page.evaluate(HERE), page.evaluate(TOP)
    fingers.go(away(place(handle), dy=150))
    assert page.evaluate(TOP) < top - 50 and page.evaluate(WANTED) is None, "the page scrolls"
    handle.scroll_into_view_if_needed()
    fingers.go(away(place(handle), dx=-30))
    assert delivered(page) > 1.1 * before
    assert page.evaluate("() => strikewave.page.opening.section.pulled") is False
