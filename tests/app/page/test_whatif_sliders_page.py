"""Sliders below the map: those of both axes, and what 1 % more of each does."""

import re

import pytest
from playwright.sync_api import expect

import solvers

from .hands import drag, type_into
from .test_page import settled
from .test_whatif_page import DONE, SIZES, WHATIF, opened

MAP = "?layout=opening&law=hertz&whatif=peak_force,mass_ratio,hertz_stiffness"


def sliders(page) -> list[str]:
    every = page.tab.locator(".left .controls input[type='range']").all()
    return [str(each.get_attribute("id")).removeprefix("choice-") for each in every if each.is_visible()]


@pytest.mark.parametrize(("size", "language"), zip(SIZES, ["en", "en", "es", "es"], strict=True))
def test_both_axes_have_a_slider_that_says_what_1_percent_does(open_page, size, language):
    page = open_page(f"{MAP}&language={language}", size=size, plain=True)
    page.wait(DONE)
    assert sliders(page) == ["mass_ratio", "hertz_stiffness", "modes"]
    page.wait(f"() => {WHATIF}.gains.gains.size > 1")
    said = page.tab.locator(".field-mass_ratio .whatif-role span")
    more = {"en": "more", "es": "más"}[language]
    expect(said).to_have_text(re.compile(rf"^1.% {more}: −0[.,]6\d.%$"))
    for name in ("mass_ratio", "hertz_stiffness"):
        row = page.tab.locator(f".field-{name} .whatif-role")
        box, inner = row.bounding_box(), row.locator("span").bounding_box()
        assert box and inner and inner["x"] > box["x"] + 50
        assert inner["x"] + inner["width"] <= min(box["x"] + box["width"], size[0]) + 0.5
    unit = page.tab.locator(".field-hertz_stiffness .unit")
    expect(unit).to_have_text(re.compile("^N/m"))
    expect(unit).to_be_visible(visible=size[0] != 820)  # there is no room


def test_the_slider_of_an_axis_moves_the_point_and_goes_with_the_map(show):
    page = opened(show, MAP)
    before = page.header("chosen")["hertz_stiffness"]
    drag(page.tab.locator("#choice-hertz_stiffness"), 0.8)
    settled(page)
    page.wait(DONE)
    after = page.evaluate("() => strikewave.page.frame.chosen.hertz_stiffness")
    assert after > 5 * before
    scene = solvers.load("fixed-rod").replace({"contact": {"law": "hertz", "stiffness": after}})
    exact = solvers.solve(scene, method="waves").peak_force
    assert page.evaluate(f"() => {WHATIF}.here('peak_force')") == pytest.approx(exact, rel=1e-6)
    page.tab.locator(".whatif-sentence select").nth(2).select_option("speed")
    page.wait(DONE)
    assert sliders(page) == ["mass_ratio", "speed", "hertz_stiffness"]  # for how stiff the contact is, modes give way
    page.tab.keyboard.press("Escape")
    expect(page.tab.locator(".whatif-map")).to_have_count(0)
    assert sliders(page) == ["mass_ratio", "restitution", "modes"]
    assert page.tab.locator(".whatif-role").count() == 0


def test_what_gives_way_has_a_slider(show):
    page = opened(show, MAP)
    assert "speed" not in sliders(page)
    type_into(page.tab.locator(".whatif-goal").get_by_role("textbox"), "20 kN")
    expect(page.tab.locator(".whatif-goal select")).to_have_value("speed")
    expect(page.tab.locator("#choice-speed")).to_be_visible()
