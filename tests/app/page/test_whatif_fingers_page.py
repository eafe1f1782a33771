"""Fingers on a phone: the page scrolls under them, a tap and a pull set what they are on, two zoom the map."""

import pytest
from playwright.sync_api import expect

from .hands import tap
from .test_page import settled
from .test_whatif_page import DONE, MIDDLE, OPEN, WHATIF

PHONE = {"size": (390, 844), "has_touch": True, "is_mobile": True, "device_scale_factor": 2}
CHOSEN = "() => [strikewave.page.frame.chosen.mass_ratio, strikewave.page.frame.chosen.hertz_stiffness]"
RANGES = f"() => [{WHATIF}.x, {WHATIF}.y].map((axis) => {WHATIF}.range(axis))"
TOP = "() => strikewave.page.root.scrollTop"
QUERY = "?layout=opening&law=hertz"
MAP = "peak_force,mass_ratio,hertz_stiffness"


class Fingers:
    """Fingers on the glass of a page: each is a list of places that it goes along."""

    def __init__(self, page):
        self.page = page
        self.session = page.context.new_cdp_session(page.tab)

    def _touch(self, kind: str, places) -> None:
        points = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(places)]
        self.session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        self.page.frames_pass(1)

    def go(self, *ways) -> None:
        """One or two fingers, each from a place to another, at once."""
        self._touch("touchStart", [start for start, _ in ways[:1]])
        if len(ways) > 1:
            self._touch("touchStart", [start for start, _ in ways])
        for k in range(1, 11):
            self._touch("touchMove", [[a + (b - a) * k / 10 for a, b in zip(*way, strict=True)] for way in ways])
        self._touch("touchEnd", [])
        self.page.frames_pass(20)


@pytest.fixture
def phone(open_page):
    def opened(said: str = ""):
        page = open_page(QUERY, own=True, **PHONE)
        settled(page)
        if said:
            page.evaluate(OPEN, said)
            page.wait(DONE if said == MAP else f"() => {WHATIF}.modes.shown?.jobs.shown?.whole")
        return page, Fingers(page)

    return opened


def place(locator, u: float = 0.5, v: float = 0.5) -> list[float]:
    """A place in what is seen there, as shares of its width and height."""
    box = locator.bounding_box()
    assert box
    return [box["x"] + u * box["width"], box["y"] + v * box["height"]]


def away(start, dx: float = 0.0, dy: float = 0.0):
    return start, [start[0] + dx, start[1] + dy]


def test_a_swipe_that_begins_on_a_slider_scrolls_and_leaves_it_alone(phone):
    page, fingers = phone()
    slider = page.tab.locator("#choice-mass_ratio")
    slider.scroll_into_view_if_needed()
    before, top, shown = page.evaluate(CHOSEN), page.evaluate(TOP), slider.input_value()
    fingers.go(away(place(slider, 0.9), dy=-160))
    assert page.evaluate(TOP) > top + 50
    assert page.evaluate(CHOSEN) == before and slider.input_value() == shown
    fingers.go(away(place(slider, 0.9)))
    settled(page)
    tapped = page.evaluate(CHOSEN)[0]
    assert tapped > 5 * before[0]
    fingers.go(away(place(slider, 0.9), dx=-120, dy=5))
    settled(page)
    assert before[0] < page.evaluate(CHOSEN)[0] < 0.2 * tapped


def test_the_page_scrolls_from_the_map_and_a_tap_or_a_drag_moves_the_point(phone):
    page, fingers = phone(MAP)
    plot = page.tab.locator(".whatif-map canvas").last
    before, ranges = page.evaluate(CHOSEN), page.evaluate(RANGES)
    fingers.go(away(place(plot, 0.8, 0.7), dy=-150))
    top = page.evaluate(TOP)
    assert top > 50 and page.evaluate(CHOSEN) == before
    fingers.go(away(place(plot, 0.8, 0.4), dy=200))
    assert page.evaluate(TOP) == 0 and page.evaluate(CHOSEN) == before and page.evaluate(RANGES) == ranges
    fingers.go(away(place(plot, 0.8, 0.7)))
    settled(page)
    right, below = page.evaluate(CHOSEN)
    assert right > 2 * before[0] and below < 0.5 * before[1]
    x, y = page.evaluate(MIDDLE)
    corner = place(plot, 0, 0)
    fingers.go(away([corner[0] + x, corner[1] + y], dx=-4, dy=-120))
    settled(page)
    assert page.evaluate(TOP) == 0, "the point is dragged, the page stays"
    moved = page.evaluate(CHOSEN)
    assert moved[1] > 3 * below and 0.5 * right < moved[0] < right
    assert page.evaluate(MIDDLE) == pytest.approx([x - 4, y - 120], abs=2)


def test_two_fingers_zoom_about_their_middle_and_move_no_point(phone):
    page, fingers = phone(MAP)
    plot = page.tab.locator(".whatif-map canvas").last
    before, (across, up) = page.evaluate(CHOSEN), page.evaluate(RANGES)
    share = f"([px, py]) => {WHATIF}.plane.share(px, py)"
    a, b, corner = place(plot, 0.5, 0.4), place(plot, 0.7, 0.5), place(plot, 0, 0)
    middle = page.evaluate(share, [(p + q) / 2 - r for p, q, r in zip(a, b, corner, strict=True)])
    fingers.go(away(a, -39, -20), away(b, 39, 20))
    page.wait(DONE)
    closer, higher = page.evaluate(RANGES)
    wide = (b[0] - a[0], b[1] - a[1])
    by = ((wide[0] + 78) ** 2 + (wide[1] + 40) ** 2) ** 0.5 / (wide[0] ** 2 + wide[1] ** 2) ** 0.5
    for (low, high), (least, most), at in zip((closer, higher), (across, up), middle, strict=True):
        assert (most - least) / (high - low) == pytest.approx(by, rel=0.02)
        assert low + at * (high - low) == pytest.approx(least + at * (most - least), abs=0.02 * (most - least))
    assert page.evaluate(CHOSEN) == before and page.evaluate(TOP) == 0


def test_the_page_scrolls_from_curves_too(phone):
    page, fingers = phone("curves:peak_force,mass_ratio,speed")
    curves = page.tab.locator(".whatif-curves canvas")
    before = page.evaluate(CHOSEN)
    fingers.go(away(place(curves, 0.9, 0.8), dy=-150))
    assert page.evaluate(TOP) > 50 and page.evaluate(CHOSEN) == before
    fingers.go(away(place(curves, 0.9, 0.5)))
    settled(page)
    assert page.evaluate(CHOSEN)[0] > 2 * before[0]


def test_the_map_begins_at_its_title_and_the_picture_comes_back_where_it_was(phone):
    page, _ = phone()
    page.tab.locator(".to-map").scroll_into_view_if_needed()
    top = page.evaluate(TOP)
    tap(page.tab.locator(".to-map"))
    page.wait(DONE)
    title = page.tab.locator(".whatif-sentence").bounding_box()
    assert page.evaluate(TOP) == 0 and title and 0 < title["y"] < 200
    tap(page.tab.get_by_role("button", name="Picture", exact=True))
    expect(page.tab.locator(".whatif-map")).to_have_count(0)
    assert top > 100 and page.evaluate(TOP) == top
