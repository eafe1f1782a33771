"""Panels that answer questions beside the solution, in a real browser."""

import pytest
from playwright.sync_api import expect

from .test_page import drag, settled

LONG = 60_000  # ms: in a fresh copy kernels are compiled first
TOLD = "name => strikewave.page.analyses[name].root.getAttribute('aria-busy') === 'false'"


def opened(page, label, name):
    page.tab.get_by_role("button", name=label, exact=True).click()
    page.wait(TOLD, name, timeout=LONG)
    return page.tab.locator(f".{name}")


def test_the_plan_follows_the_question_and_can_be_shown(open_page):
    page = open_page()
    panel = opened(page, "What this blow needs", "needs")
    expect(panel.locator(".verdict")).to_contain_text("travelling waves")
    panel.get_by_label("Allowed error, in percent").fill("10")
    panel.get_by_label("Allowed error, in percent").press("Enter")
    expect(panel.locator(".verdict")).to_contain_text("the body bends as at rest")
    page.answered(panel.locator("tr[aria-current]").get_by_role("button", name="show it").click)
    assert page.header("chosen")["method"] == "quasi-static"
    expect(panel.locator("tr[aria-current] button")).to_have_text("shown")
    panel.get_by_label("Allowed error, in percent").fill("0")
    panel.get_by_label("Allowed error, in percent").press("Enter")
    expect(page.tab.locator(".toast")).to_contain_text("from 0.01 to 50")
    expect(panel.get_by_label("Allowed error, in percent")).to_have_value("10")


def test_the_dot_on_the_map_follows_the_sliders(open_page):
    page = open_page()
    opened(page, "What this blow needs", "needs")
    here = "() => strikewave.page.analyses.needs.map.trail.at(-1)"
    page.wait(here)
    before = page.evaluate(here)
    assert before == [0, pytest.approx(1.0)]  # rigid contact, a mass like that of the rod
    pixels = page.picture()
    page.answered(lambda: drag(page, "Mass ratio", 0.7))
    settled(page)
    page.wait(TOLD, "needs")
    after = page.evaluate(here)
    assert after[1] == pytest.approx(page.header("chosen")["mass_ratio"], rel=1e-6)
    assert after != before
    assert page.picture() != pixels


def test_what_a_hostile_client_asks_is_refused(open_page):
    page = open_page()
    opened(page, "What this blow needs", "needs")
    page.evaluate("() => { strikewave.page.model.plan_tolerance = -3; }")
    expect(page.tab.locator(".toast")).to_contain_text("plan_tolerance")
    page.wait("() => strikewave.page.model.plan_tolerance === 0.05")


def test_panels_fit_a_phone(open_page):
    page = open_page(size=(390, 844), has_touch=True)
    opened(page, "What this blow needs", "needs")
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 390
