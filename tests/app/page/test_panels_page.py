"""Panels that answer questions beside the solution, in a real browser."""

import pytest
from playwright.sync_api import expect

from .hands import type_into
from .test_page import drag, settled

LONG = 60_000  # ms: in a fresh copy kernels are compiled first
SHOWN = "name => strikewave.page.analyses[name].root.getAttribute('aria-busy') === 'false'"


def opened(page, label, name):
    page.analysis(label)
    page.wait(SHOWN, name, timeout=LONG)
    return page.tab.locator(f".{name}")


def test_the_plan_follows_the_question_and_can_be_shown(open_page):
    page = open_page()
    panel = opened(page, "Which model is enough?", "needs")
    expect(panel.locator(".verdict")).to_contain_text("travelling waves")
    expect(panel.locator("thead")).to_contain_text("largest error around here")
    type_into(panel.get_by_label("Allowed error, in percent"), "10", "Enter")
    expect(panel.locator(".verdict")).to_contain_text("quasi-static structure")
    page.answered(panel.locator("tr[aria-current]").get_by_role("button", name="show it").click)
    assert page.header("chosen")["method"] == "quasi-static"
    expect(panel.locator("tr[aria-current] button")).to_have_text("shown")
    type_into(panel.get_by_label("Allowed error, in percent"), "0", "Enter")
    expect(panel.locator(".wrong:visible")).to_contain_text("from 0.01 to 50")
    expect(panel.get_by_label("Allowed error, in percent")).to_have_value("0")


def test_what_the_library_says_is_in_the_words_of_the_page(open_page):
    page = open_page("?method=modal&panel=needs")
    page.wait(SHOWN, "needs", timeout=LONG)
    expect(page.tab.locator(".needs")).to_contain_text("that of quasi-static structure would be")
    expect(page.tab.locator(".warnings")).to_contain_text("shortest kept period (2.35 µs)")


def test_the_dot_on_the_map_follows_the_sliders(open_page):
    page = open_page()
    opened(page, "Which model is enough?", "needs")
    here = "() => strikewave.page.analyses.needs.map.trail.at(-1)"
    page.wait(here)
    before = page.evaluate(here)
    assert before == [0, pytest.approx(1.0)]  # rigid contact, a mass like that of the rod
    pixels = page.picture()
    page.answered(lambda: drag(page, "Mass ratio", 0.7))
    settled(page)
    page.wait(SHOWN, "needs")
    after = page.evaluate(here)
    assert after[1] == pytest.approx(page.header("chosen")["mass_ratio"], rel=1e-6)
    assert after != before
    page.redrawn(pixels)


def map_of(page):
    """The area of the map of regimes, drawn, and where it is on the screen."""
    opened(page, "Which model is enough?", "needs")
    page.wait("() => strikewave.page.analyses.needs.map.chart.box && strikewave.page.analyses.needs.map.trail.length")
    area = page.tab.locator(".regimes").get_by_role("application")
    area.scroll_into_view_if_needed()
    page.wait(
        """async () => {
          const { area } = strikewave.page.analyses.needs.map.chart, { top } = area.getBoundingClientRect();
          await new Promise((done) => setTimeout(done, 200));
          return area.getBoundingClientRect().top === top; // the page has scrolled to it
        }"""
    )
    return area


def lies_at(page, time, ratio):
    """Wait until the scene that is drawn lies there, within a twentieth."""
    page.wait(
        """([time, ratio]) => {
          const { page } = strikewave, [t, r] = page.analyses.needs.map.trail.at(-1);
          const near = (a, b) => Math.abs(Math.log(a / b)) < 0.05;
          return near(t, time) && near(r, ratio) && near(page.frame.chosen.mass_ratio, ratio);
        }""",
        [time, ratio],
        timeout=LONG,
    )


def test_a_drag_on_the_map_moves_the_sliders(open_page):
    page = open_page()
    area = map_of(page)
    place = """([time, ratio]) => {
      const { chart } = strikewave.page.analyses.needs.map, from = chart.area.getBoundingClientRect();
      return [from.left + chart.px(time), from.top + chart.py(ratio)];
    }"""
    page.tab.mouse.move(*page.evaluate(place, [1.0, 1.0]))
    page.tab.mouse.down()
    for k in range(5):
        page.tab.mouse.move(*page.evaluate(place, [1.0 + k / 4, 1.0 + k]))
    page.tab.mouse.up()
    lies_at(page, 2.0, 5.0)
    settled(page)
    expect(page.tab.get_by_label("Contact law", exact=True)).to_have_value("linear")
    expect(page.tab.get_by_role("slider", name="Stiffness", exact=True)).to_be_visible()
    box = area.bounding_box()
    page.tab.mouse.move(0, 0)
    expect(page.tab.locator(".regimes .readout")).to_have_text("")
    assert area.bounding_box() == box  # the readout has a line of its own
    page.tab.mouse.click(box["x"] + 60, box["y"] + box["height"] / 2)  # in the strip of rigid contacts
    expect(page.tab.get_by_label("Contact law", exact=True)).to_have_value("rigid", timeout=LONG)


def test_the_keys_aim_on_the_map_and_enter_goes_there(open_page):
    page = open_page("?law=hertz")
    area = map_of(page)
    time, ratio = page.evaluate("() => strikewave.page.analyses.needs.map.trail.at(-1)")
    area.focus()
    for key in ("ArrowUp", "ArrowUp", "ArrowRight", "Enter"):
        area.press(key)
    lies_at(page, time * 10**0.1, ratio * 10**0.2)
    settled(page)
    expect(page.tab.get_by_label("Contact law", exact=True)).to_have_value("hertz")


def test_what_a_hostile_client_asks_is_refused(open_page):
    page = open_page()
    opened(page, "Which model is enough?", "needs")
    page.evaluate("() => { strikewave.page.model.map_point = '1 -2'; }")
    expect(page.tab.locator(".toast")).to_contain_text("Place on the map: got '1 -2'; allowed: a contact time")
    page.wait("() => strikewave.page.model.map_point === ''")
    page.evaluate("() => { strikewave.page.model.map_point = '<b>'; }")
    expect(page.tab.locator(".toast")).to_contain_text("Place on the map: '<b>' is not possible. Write numbers.")
    page.evaluate("() => { strikewave.page.model.plan_tolerance = -3; }")
    expect(page.tab.locator(".toast")).to_contain_text("Allowed error: -3 is not possible")
    page.wait("() => strikewave.page.model.plan_tolerance === 0.05")


def test_panels_fit_a_phone(open_page):
    page = open_page(size=(390, 844), has_touch=True)
    for label, name in (
        ("Which model is enough?", "needs"),
        ("Cost vs. accuracy", "tradeoff"),
        ("Choose method by error", "tolerance"),
    ):
        page.analysis(label)
        page.wait(SHOWN, name, timeout=LONG)
        page.fits(390)


def test_speed_against_accuracy(open_page):
    page = open_page("?scene=free-rod")
    panel = opened(page, "Cost vs. accuracy", "tradeoff")
    expect(panel.locator(".help").first).to_contain_text("exact: travelling waves")
    assert page.evaluate("() => strikewave.page.analyses.tradeoff.points.length") > 30
    area = panel.get_by_role("application")
    area.focus()
    label = panel.locator(".point h3").inner_text()
    area.press("ArrowRight")
    expect(panel.locator(".point h3")).not_to_have_text(label)
    expect(panel.locator(".point")).to_contain_text("Contacts found")
    area.evaluate("(element) => element.blur()")
    page.evaluate(
        """() => {
          const view = strikewave.page.analyses.tradeoff;
          view.picked = view.points.find((p) => p.label === 'modal modes=25');
          view.mark();
        }"""
    )
    page.answered(lambda: area.press("Enter"))
    settled(page)
    assert (page.header("chosen")["method"], page.header("chosen")["modes"]) == ("modal", 25)


def test_what_a_table_of_a_beam_is_measured_against_is_said_in_words(open_page):
    panel = opened(open_page("?scene=hammer-on-cantilever"), "Cost vs. accuracy", "tradeoff")
    expect(panel.locator(".help").first).to_contain_text("converged: 3200 modes, compared with 1600 modes")


def test_a_measurement_can_be_started_and_stopped(open_page):
    page = open_page("?scene=sphere-on-half-space&speed=1.3")
    panel = opened(page, "Cost vs. accuracy", "tradeoff")
    panel.get_by_role("button", name="Measure").click()
    page.wait(
        """() => {
          const { page } = strikewave, found = page.analyses.tradeoff.answer;
          return !page.model.tradeoff_running || (found.stopped === 'under way' && found.points.length > 1);
        }""",
        timeout=LONG,
    )
    if page.evaluate("() => strikewave.page.model.tradeoff_running"):
        panel.get_by_role("button", name="Cancel").click()
    page.wait("() => !strikewave.page.model.tradeoff_running", timeout=LONG)
    assert page.evaluate("() => strikewave.page.analyses.tradeoff.points.length") > 1
    expect(panel.get_by_role("button", name="Measure again")).to_be_visible()


def test_a_tolerance_chooses_the_method(open_page):
    page = open_page("?scene=free-rod")
    page.tab.get_by_label("Compare with", exact=True).select_option("auto")
    panel = page.tab.locator(".auto")
    page.wait(SHOWN, "tolerance", timeout=LONG)
    expect(panel.locator(".verdict")).to_contain_text("exact waves")
    panel.get_by_label("exact waves may be chosen").uncheck()
    page.wait("() => strikewave.page.analyses.tolerance.answer?.chosen.auto_waves === false", timeout=LONG)
    found = page.evaluate("() => strikewave.page.analyses.tolerance.answer")
    assert found["true"] <= 0.01 and found["met"]
    page.wait("method => strikewave.page.frame.chosen.method === method", found["choices"]["method"])
    expect(page.tab.get_by_label("Compare with", exact=True)).to_have_value("auto")
    expect(panel.locator(".proof")).to_contain_text("true")
    page.answered(lambda: page.tab.get_by_label("Compare with", exact=True).select_option("waves"))
    assert page.header("chosen")["method"] == "waves"


def test_a_computing_time_chooses_the_method_and_an_impossible_one_says_so(open_page):
    page = open_page("?scene=bronze-rod-steel-ball")
    opened(page, "Choose method by error", "tolerance")
    panel = page.tab.locator(".auto")
    panel.get_by_label("exact waves may be chosen").uncheck()
    panel.get_by_label("Keep to").select_option("time")
    type_into(panel.get_by_label("within, in milliseconds"), "0.1", "Enter")
    expect(panel).to_contain_text("100 µs are not enough", timeout=LONG)
    expect(panel.locator(".verdict")).to_contain_text("True error, against the exact waves")
    type_into(panel.get_by_label("within, in milliseconds"), "0", "Enter")
    expect(panel.locator(".wrong:visible")).to_contain_text("from 0.1 to 6000 ms")


def test_a_long_search_can_be_cancelled(open_page):
    page = open_page("?scene=fixed-rod")
    opened(page, "Choose method by error", "tolerance")
    panel = page.tab.locator(".auto")
    panel.get_by_label("exact waves may be chosen").uncheck()
    type_into(panel.get_by_label("within, in percent"), "0.0001", "Enter")
    panel.get_by_role("button", name="Cancel").click(timeout=LONG)
    expect(panel.get_by_role("button", name="Work it out")).to_be_visible(timeout=LONG)
    expect(panel.locator(".verdict")).to_contain_text("Cancelled", timeout=LONG)
    page.answered(lambda: drag(page, "Mass ratio", 0.4))


def test_maps_of_stability_over_another_axis(open_page):
    page = open_page()
    page.analysis("Stability")
    panel = page.tab.locator(".stability")
    panel.get_by_label("Step against").select_option("speed")  # while the maps over stiffness are under way
    page.wait("() => strikewave.page.analyses.stability.known?.across.name === 'speed'", timeout=2 * LONG)
    expect(panel.locator(".figure").first).to_contain_text("None of")
    expect(panel.locator(".figure", has_text="frozen")).to_contain_text("runs fail")
    expect(panel.get_by_role("button", name="Work it out again")).to_be_visible()
    page.wait("() => strikewave.page.analyses.stability.figure.views")
    area = panel.get_by_role("application")
    area.focus()
    area.press("ArrowUp")
    said = panel.locator(".figure", has_text="central").locator(".help")
    expect(said).to_contain_text("m/s: parts after")
    expect(panel.locator(".figure").first.locator(".help")).to_contain_text("m/s: parts after")  # in all maps at once
    first = said.inner_text()
    for _ in range(20):
        area.press("ArrowUp")
    expect(said).not_to_have_text(first)
    expect(said).to_contain_text("grows without bound after")
    expect(said).to_contain_text("Theory allows")


def test_a_link_opens_panels_with_their_questions(open_page):
    page = open_page(
        "?scene=free-rod&panel=tolerance,needs&quantity=peak-force&tolerance=0.02&waves=false&question=stresses"
    )
    panel = page.tab.locator(".auto")
    expect(panel.locator(".verdict")).to_contain_text("in the peak force", timeout=LONG)
    expect(panel.locator("tbody tr").first).to_contain_text("6 modes")
    expect(panel.locator("table")).not_to_contain_text("=")
    expect(panel.get_by_label("within, in percent")).to_have_value("2")
    expect(page.tab.locator(".needs").get_by_label("Question")).to_have_value("stresses")
    panel.get_by_label("Quantity").select_option("impulse")
    page.wait("() => location.search.includes('quantity=impulse')")
    page.wait(SHOWN, "tolerance", timeout=LONG)
    panel.get_by_label("Keep to").select_option("time")
    page.wait("() => location.search.includes('budget=0.05') && !location.search.includes('tolerance=')")
    again = open_page("?" + page.tab.url.split("?")[1])
    expect(again.tab.locator(".auto").get_by_label("Keep to")).to_have_value("time")
    expect(again.tab.locator(".auto").get_by_label("Quantity")).to_have_value("impulse")
    again.wait(SHOWN, "tolerance", timeout=LONG)
    again.analysis("Choose method by error")
    again.wait("() => location.search.includes('panel=needs') && !location.search.includes('quantity')")


def test_a_link_works_out_the_stability_it_names(open_page):
    page = open_page("?panel=stability,energy&axis=speed")
    expect(page.tab.locator(".stability").get_by_label("Step against")).to_have_value("speed")
    page.wait("() => strikewave.page.analyses.stability.known?.across.name === 'speed'", timeout=2 * LONG)
    page.wait("() => strikewave.page.analyses.energy.figure.model('energy-cursor')", timeout=LONG)


def test_a_bad_link_is_reported_and_otherwise_ignored(open_page):
    page = open_page("?panel=needs&axis=<b>")
    expect(page.tab.locator(".toast")).to_contain_text("Step against: “…” is not possible")
    page = open_page("?panel=needs,weather&tolerance=7&error=0.1")
    toast = page.tab.locator(".toast")
    expect(toast).to_contain_text("Analysis: 'weather' is not possible. Choose one of energy, needs")
    expect(toast).to_contain_text("Error: 7.0 is not possible. Choose a number from 10⁻⁶ to 0.5", timeout=15_000)
    expect(page.tab.locator(".needs").get_by_label("Allowed error, in percent")).to_have_value("10")
    page.wait("() => location.search === '?panel=needs&question=final-velocities&error=0.1&layout=laboratory'")
