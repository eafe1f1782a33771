"""Bounces on the page: drawn, followed by sliders, dropped from another height, under other gravity, and linked."""

import re

from playwright.sync_api import expect
from pytest import approx

from .hands import type_into
from .test_page import settled

PANEL = "strikewave.page.analyses.bounces"
FRESH = f"() => {PANEL}.answer && {PANEL}.root.ariaBusy === 'false'"


def test_a_ball_is_dropped_from_any_height_under_any_gravity(open_page):
    page = open_page("?scene=bouncing-ball&panel=bounces&gravity=1.62")
    page.wait(FRESH)
    expect(page.tab.get_by_text("infinitely many bounces in a finite time")).to_be_visible()
    expect(page.tab.get_by_label("Gravity, in metres per second squared")).to_have_value("1.62")
    assert page.evaluate(f"() => {PANEL}.answer.height") == approx(9.80665 / 1.62)
    page.evaluate("() => strikewave.page.model.bounce_gravity = 9.81")
    page.wait(f"() => {PANEL}.answer.gravity === 9.81 && {PANEL}.root.ariaBusy === 'false'")
    height = page.tab.get_by_label("Drop height, in metres")
    page.answered(lambda: type_into(height, "2", "Enter"))
    page.wait(FRESH)
    assert page.header("chosen")["speed"] == approx((2 * 9.81 * 2) ** 0.5)
    assert page.evaluate(f"() => {PANEL}.answer.height") == approx(2.0)
    rows = page.tab.locator(".bounces table.methods tbody tr")
    expect(rows.first).to_contain_text("64")  # % of the energy, after a restitution of 0.8
    assert rows.count() == 13 and "gravity=9.81" in page.evaluate("() => location.search")
    settled(page)
    page.show_scene("free-rod")
    expect(page.tab.locator(".bounces")).to_be_hidden()  # which belonged to the scene that was left
    page.show_scene("slider-crank")
    expect(page.tab.get_by_role("button", name="Bounces", exact=True)).to_be_hidden()


def test_where_nothing_bounces_the_button_says_why(open_page):
    """A raw key once stood there, after a press; the reason is words, before one."""
    page = open_page("?scene=bouncing-ball&panel=bounces")
    button = page.tab.get_by_role("button", name="Bounces", exact=True, include_hidden=True)
    page.wait(FRESH)
    expect(button).to_have_js_property("disabled", False)
    for scene in ("free-rod", "two-equal-rods", "two-balls", "xylophone-bar", "pressure-bar"):
        page.show_scene(scene)
        expect(button).to_have_js_property("disabled", True)
        expect(button).to_have_attribute("title", re.compile("^Only a mass that strikes what is held bounces"))
        expect(page.tab.locator(".bounces")).to_be_hidden()
    page.show_scene("hammer-on-cantilever")
    expect(button).to_have_js_property("disabled", False)


def test_bounces_fit_on_a_phone(open_page):
    page = open_page("?scene=drop-test&panel=bounces", size=(390, 844))
    page.wait(FRESH)
    page.fits(390)
    expect(page.tab.get_by_role("heading", name="Height over time")).to_be_visible()
