"""What the server finds of a map: how much is there, stopped and gone on with by mouse, keys and a finger, and left."""

import pytest
from playwright.sync_api import expect

from .hands import arrow, tap
from .test_page import settled
from .test_whatif_fingers_page import PHONE
from .test_whatif_page import DONE, OPEN, WHATIF, opened

pytestmark = pytest.mark.browser
QUERY, VIEW = "?layout=opening&scene=four-bar", "peak_force,mass_ratio,speed"
POINTS = f"{WHATIF}.points"
ASKED = f"() => {POINTS}.served.id"  # questions so far
COUNT = f"() => {WHATIF}.lattice.count"
AT_WORK = f"() => {WHATIF}?.lattice?.count > 20 && {POINTS}.served.job?.drawn"
QUIET = f"() => {POINTS}.served.idle && !{WHATIF}.due && !{WHATIF}.streaming"
LAST = "() => strikewave.page.model.whatif_points"


def at_work(page):
    """The button that stops the server."""
    page.evaluate(OPEN, VIEW)
    page.wait(AT_WORK)
    button = page.tab.locator(".whatif-work > button")
    expect(button).to_have_text("Stop")
    return button


def test_the_server_is_stopped_and_goes_on(show):
    page = show(QUERY, (1440, 900))
    settled(page)
    button = at_work(page)
    words = page.tab.locator(".whatif-work > span")
    expect(words).to_contain_text("of this view")
    box = page.tab.locator(".whatif-map").bounding_box()
    button.click()
    expect(button).to_have_text("Go on")
    page.wait(QUIET)  # what stands beside the sliders is still found
    asked, count = page.evaluate(ASKED), page.evaluate(COUNT)
    page.frames_pass(40)
    assert [page.evaluate(ASKED), page.evaluate(COUNT)] == [asked, count], "nothing more is asked"
    before = page.evaluate(f"() => {WHATIF}.here('peak_force')")
    arrow(page.tab.locator("#choice-mass_ratio"), 0)
    settled(page)
    page.wait(QUIET)
    assert page.evaluate(f"() => {WHATIF}.here('peak_force')") != before, "the scene goes on"
    assert page.evaluate(COUNT) == count
    expect(button).to_have_text("Go on")
    button.focus()
    page.tab.keyboard.press("Enter")
    expect(button).to_have_text("Stop")
    page.wait(f"() => {WHATIF}.lattice.count > {count}")
    assert page.tab.locator(".whatif-map").bounding_box() == box, "the map stays as large as it was"
    page.tab.keyboard.press("Escape")
    expect(page.tab.locator(".whatif-map")).to_have_count(0)


def test_who_leaves_frees_the_server(show):
    page = show(QUERY, (1280, 720))
    settled(page)
    at_work(page)
    served = page.tab.evaluate_handle(f"() => {POINTS}.served")
    page.tab.locator(".whatif-back").click()
    expect(page.tab.locator(".whatif-map")).to_have_count(0)
    assert page.evaluate(LAST) == ""
    asked = served.evaluate("(served) => [served.id, served.idle]")
    assert asked[1]
    page.frames_pass(40)
    assert served.evaluate("(served) => [served.id, served.idle]") == asked


@pytest.mark.parametrize("mode", ["Curves", "Tolerance"])
def test_curves_and_tolerances_are_stopped_and_another_view_goes_on(show, mode):
    page = show(QUERY, (1440, 900))
    settled(page)
    button = at_work(page)
    page.tab.get_by_role("button", name=mode, exact=True).click()
    page.wait(f"() => {WHATIF}.modes.shown?.jobs.progress?.found > 0 && {POINTS}.served.job?.drawn")
    button.click()
    expect(button).to_have_text("Go on")
    page.wait(QUIET)
    found = page.evaluate(f"() => {WHATIF}.modes.shown.jobs.progress")
    page.frames_pass(40)
    assert page.evaluate(f"() => {WHATIF}.modes.shown.jobs.progress") == found and found["found"] < found["all"]
    page.tab.get_by_role("button", name="Map", exact=True).click()
    expect(button).to_have_text("Stop")
    page.tab.keyboard.press("Escape")


def test_a_finger_stops_it_on_a_phone(open_page):
    page = open_page(QUERY, own=True, **PHONE)
    settled(page)
    button = at_work(page)
    box = button.bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= 390 and box["height"] >= 24
    tap(button)
    expect(button).to_have_text("Go on")
    tap(button)
    expect(button).to_have_text("Stop")


def test_there_is_no_button_where_the_browser_finds_all(show):
    page = opened(show, "?layout=opening&whatif=peak_force,mass_ratio,speed")
    page.wait(DONE)
    expect(page.tab.locator(".whatif-work")).to_be_hidden()
