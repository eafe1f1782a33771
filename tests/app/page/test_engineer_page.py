"""The answer to an engineer: how large the force is, when and for how long, whatever lies between the two."""

import math

import pytest
from playwright.sync_api import expect
from pytest import approx

import solvers
from app.choices.choices import Choices
from app.choices.scene_of import choices_of, chosen_scene

HAMMER = "?scene=fixed-rod&target.length=0.5&mass_ratio=1.7775&law=linear&linear_stiffness="
PEAK = "() => strikewave.page.axial.force.peak.root.textContent.replaceAll('\\u00a0', ' ')"


@pytest.mark.parametrize("stiffness", [1e6, 1e3])
def test_peak_and_contact_time_of_a_hammer_on_a_cushion_are_in_view_and_the_curve_is_whole(open_page, stiffness):
    page = open_page(f"{HAMMER}{int(stiffness)}")
    chosen = {"bodies": "target.length=0.5", "law": "linear", "linear_stiffness": stiffness}
    own = choices_of("fixed-rod") | {"scene": "fixed-rod"}
    solution = solvers.solve(chosen_scene(Choices(**(own | chosen | {"mass_ratio": 1.7775})).chosen()))
    assert solution.scene.impactor.mass == approx(2.0)
    assert solution.peak_force == approx(math.sqrt(2.0 * stiffness), rel=0.01)  # one swing of the mass on the cushion
    said = page.evaluate(PEAK)
    size = f"{solution.peak_force:.4g} N" if stiffness < 1e4 else f"{solution.peak_force / 1e3:.4g} kN"
    end = solution.contacts[0].end / solution.scene.time_unit
    assert said.startswith(f"peak {size} at ") and said.endswith(f" T · in contact {end:.4g} T")
    view = page.evaluate("() => strikewave.page.axial.axis.view")
    force = page.evaluate("() => Array.from(strikewave.page.axial.force.exact.y)")
    assert view[1] >= end and force[-1] == approx(0.0, abs=1e-3 * max(force))
    assert page.tab.locator(".peak:visible").bounding_box()["y"] < 900


def test_one_click_on_the_unit_writes_all_times_in_seconds_and_is_remembered(open_page):
    page = open_page(f"{HAMMER}1e6")
    trips = page.evaluate(PEAK)
    page.tab.locator(".unit-of-time:visible").first.click()
    page.wait(f"() => ({PEAK})().endsWith(' ms')")
    units = "() => strikewave.page.axial.charts.filter(({ chart }) => chart.box).map(({ chart }) => chart.xUnit)"
    page.wait(f"() => ({units})().every((unit) => unit === 'ms')")
    trip = page.evaluate("() => strikewave.page.frame.trip")
    before, after = (float(said.split("in contact ")[1].split()[0]) for said in (trips, page.evaluate(PEAK)))
    assert after == approx(1e3 * trip * before, rel=1e-3)
    assert page.evaluate("() => strikewave.page.player.clock.textContent").endswith(" ms")
    page.wait("() => strikewave.page.axial.story.table.querySelector('.units').textContent.startsWith('msms')")
    kept = page.evaluate("() => localStorage.getItem('strikewave.seconds')")
    assert kept == "true"
    page.tab.locator(".unit-of-time:visible").first.click()
    page.wait(f"() => ({PEAK})().endsWith(' T')")


@pytest.mark.parametrize("name, modulus", [("rubber", 2.2e6), ("wood", 2.2e9)])
def test_a_cushion_is_a_spring_of_its_modulus_area_and_thickness(open_page, name, modulus):
    page = open_page("?scene=fixed-rod")
    page.answered(lambda: page.tab.get_by_role("button", name=f"{name}, 10 mm").click())
    page.wait("() => strikewave.page.frame.chosen.law === 'linear' && !strikewave.page.asked")
    stiffness = page.evaluate("() => strikewave.page.frame.chosen.linear_stiffness")
    assert stiffness == approx(modulus * 0.03**2 / 0.01, rel=1e-5)
    expect(page.tab.locator(".cushions .help")).to_contain_text("k = E A / h")  # once the words follow
    expect(page.tab.get_by_role("button", name=f"{name}, 10 mm")).to_have_attribute("aria-pressed", "true")


def test_a_soft_run_beside_a_hard_one_is_seen_whole(open_page):
    page = open_page(f"{HAMMER}1e4")
    end = page.evaluate("() => strikewave.page.frame.duration")
    page.evaluate("() => strikewave.page.compare.keep()")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('law', 'rigid')"))
    assert page.evaluate("() => strikewave.page.frame.duration") < end / 10
    assert page.evaluate("() => strikewave.page.axial.axis.view[1]") == approx(end)
