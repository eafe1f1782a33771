"""A mechanism that moves on, on the page: its own clock, by hand and by keys, what it says, and its link."""

from playwright.sync_api import expect
from pytest import approx

from .test_access_page import findings
from .test_page import settled

PANEL = "strikewave.page.analyses.motion"
FRESH = f"() => {PANEL}.answer && {PANEL}.root.ariaBusy === 'false'"
TURNED = f"() => {PANEL}.picture.mechanism.placed[0].at(-1)"


def test_the_mechanism_moves_by_a_clock_of_its_own(open_page):
    page = open_page("?scene=bouncing-on-piston&panel=motion&seconds=0.6")
    page.wait(FRESH)
    assert page.evaluate(f"() => {PANEL}.player.playing") is False  # less motion is wanted: a still
    expect(page.tab.get_by_text("with a restitution of 0.6")).to_be_visible()
    expect(page.tab.get_by_label("Followed for, in seconds")).to_have_value("0.6")
    expect(page.tab.locator(".motion").get_by_role("heading", name="Reactions at the joints")).to_be_visible()
    assert findings(page) == []
    before, clock = page.evaluate(TURNED), page.evaluate("() => strikewave.page.player.t")
    second = page.tab.locator(".motion .tables button").nth(1)
    second.focus()
    second.press("]")  # to the next impact
    assert page.evaluate(f"() => {PANEL}.player.t") == approx(page.evaluate(f"() => {PANEL}.answer.impacts[1][0]"))
    assert page.evaluate(TURNED) != before and page.evaluate("() => strikewave.page.player.t") == clock
    second.click()
    expect(page.tab.locator(".motion .clock")).to_contain_text("ms")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('restitution', 0.3)"))
    page.wait(f"() => {PANEL}.answer.restitution === 0.3 && {PANEL}.root.ariaBusy === 'false'")
    assert "seconds=0.6" in page.evaluate("() => location.search")
    settled(page)
    page.answered(lambda: page.tab.get_by_label("Scene", exact=True).select_option("fixed-rod"))
    expect(page.tab.get_by_role("button", name="Motion after the impact")).to_be_hidden()


def test_it_plays_as_it_opens_and_fits_on_a_phone(open_page):
    page = open_page("?scene=slider-crank&panel=motion", size=(390, 844), reduced_motion="no-preference")
    page.wait(FRESH)
    page.fits(390)
    page.wait(f"() => {PANEL}.player.playing && {PANEL}.player.t > 0")
    page.tab.locator(".motion").get_by_role("button", name="Pause").click()
    assert page.evaluate(f"() => {PANEL}.player.playing") is False
