"""Views that are opened on demand, in a real browser: all methods, all mass ratios, a measured record."""

import numpy as np
import pytest
from playwright.sync_api import expect

import solvers

from .test_page import drag, settled

LONG = 120_000  # ms: in a fresh copy all kernels of all methods are compiled first
COMPARED = """() => strikewave.page.model.methods
  && strikewave.page.analyses.methods.root.getAttribute('aria-busy') === 'false'"""
MARKED = "() => strikewave.page.analyses.ratios.figure.model('ratio-cursor-rebound')?.location"
RECORD = "strikewave.page.analyses.record"


def opened(page, name):
    page.analysis(name)
    button = page.tab.get_by_role("button", name=name, exact=True)
    expect(button).to_have_attribute("aria-pressed", "true")
    return button


def test_every_method_in_one_table(open_page):
    page = open_page()
    opened(page, "Compare methods")
    page.wait(COMPARED, timeout=LONG)
    table = page.tab.locator("table.methods")
    assert table.locator("tbody tr").count() >= 9
    waves = table.locator("tbody tr").first
    expect(waves).to_contain_text("2 of 2")
    assert waves.locator("td").nth(1).inner_text() == "0"
    rigid = table.locator("tbody tr", has_text="rigid bodies")
    error = float(rigid.locator("td").nth(1).inner_text().replace("−", "-"))
    left = page.header("exact")["final"]
    assert error == pytest.approx(100 * (-1.0 - left), rel=2e-3)  # three digits; an elastic impact against a wall
    page.answered(lambda: drag(page, "Mass ratio", 0.9))
    page.wait(COMPARED, timeout=LONG)
    expect(waves).to_contain_text("1 of 1")


def test_a_name_in_the_table_shows_that_method(open_page):
    page = open_page("?scene=free-rod")
    opened(page, "Compare methods")
    page.wait(COMPARED, timeout=LONG)
    refused = page.tab.locator("table.methods tr.refused").first
    expect(refused).to_contain_text("use exact waves")
    assert refused.locator("button").count() == 0
    name = page.tab.locator("table.methods").get_by_role("button", name="finite elements", exact=True).first
    page.answered(name.click)
    assert page.header("chosen")["method"] == "fe-nodal" == page.header("other")["name"]
    page.wait(COMPARED, timeout=LONG)
    expect(page.tab.locator("table.methods tr[aria-current]").first).to_contain_text("finite elements")


def cursor(page, name):
    return page.evaluate("name => strikewave.page.analyses.ratios.figure.model(name).location", f"ratio-cursor-{name}")


def test_all_mass_ratios_and_where_the_scene_lies(open_page):
    page = open_page()
    button = opened(page, "All mass ratios")
    page.wait(MARKED, timeout=LONG)
    expect(page.tab.get_by_text("lost for good")).to_contain_text("1.0107")
    page.answered(lambda: drag(page, "Mass ratio", 0.8))
    settled(page)
    ratio = page.header("chosen")["mass_ratio"]
    for name in ("rebound", "periods", "contacts"):
        assert cursor(page, name) == pytest.approx(ratio, rel=1e-6)
    page.show_scene("free-rod")
    expect(page.tab.get_by_text("exactly one round trip")).to_be_visible()
    page.answered(lambda: page.tab.get_by_label("Contact law", exact=True).select_option("hertz"))
    expect(button).to_be_disabled()
    expect(button).to_have_attribute(
        "title", "For rigid contact, and a rod that is fixed or free: then the mass ratio says all"
    )
    expect(page.tab.get_by_text("exactly one round trip")).to_be_hidden()


def compared(page):
    page.wait(f"() => {RECORD}.answer && !{RECORD}.asking && !strikewave.page.asked", timeout=LONG)
    return page.evaluate(f"() => {RECORD}.answer")


def test_the_example_lies_on_its_scene_is_moved_by_hand_and_compared_anew(open_page):
    page = open_page()
    opened(page, "Compare with measured data")
    page.tab.get_by_role("button", name="Try the example").click()
    answer = compared(page)
    assert page.header("chosen")["scene"] == "bronze-rod-steel-ball"
    assert answer["scale"] == pytest.approx(1.0, abs=0.02) and answer["residual"] < 0.05
    expect(page.tab.locator(".residual")).to_contain_text(f"{100 * answer['residual']:.3g}"[:4])
    expect(page.tab.locator(".movers")).to_contain_text("−37.0")
    units = page.evaluate("() => Math.max(...strikewave.page.frame.record.force) * strikewave.page.frame.forceUnit")
    assert units == pytest.approx(page.header("exact")["peakForce"], rel=0.02)

    pixels = page.picture()
    remains = f"() => {RECORD}.remains({RECORD}.answer)"
    for name in ("Shift of the record", "Scale of the record"):
        drag(page, name, 0.6)
        assert page.evaluate(remains) > 0.1
        page.redrawn(pixels)
        page.tab.get_by_role("button", name="Automatic").click()
        assert page.evaluate(remains) == answer["residual"]

    page.answered(lambda: drag(page, "Impact speed", 0.6))
    page.wait(f"before => {RECORD}.answer && Math.abs({RECORD}.answer.scale - before) > 0.1", answer["scale"])
    settled(page)
    faster = page.header("chosen")["speed"] / 2.03
    assert faster < compared(page)["scale"] < faster**1.2  # as the impulse grows, and as the peak does (Hertz)


BAD = {
    "at least 8": b"time_us,microstrain\n0,0\n",
    "The record is no text": b"\0\1\2" * 999,
    "at most 2000000 are read": b"1,2\n" * 600_000,
}


def test_a_bad_file_is_refused_and_the_page_lives(open_page):
    page = open_page("?scene=bronze-rod-steel-ball")
    opened(page, "Compare with measured data")
    for said, content in BAD.items():
        file = {"name": "bad.csv", "mimeType": "text/csv", "buffer": content}
        page.tab.locator("input[type=file]").set_input_files(file)
        expect(page.tab.locator(".record-panel .wrong")).to_contain_text(said)
        assert page.evaluate(f"() => {RECORD}.answer") is None
        assert [error for error in page.errors if "status of 4" not in error] == []
        page.errors.clear()  # the browser itself notes that the file was refused
    page.answered(lambda: drag(page, "Impact speed", 0.6))
    page.wait(f"() => !{RECORD}.asking && !strikewave.page.asked")
    page.errors.clear()


def test_saved_data_is_read_back_by_the_panel_that_its_link_opens(open_page, tmp_path):
    page = open_page("?scene=fixed-rod&target.length=0.45&law=hertz&method=modal&panel=record")
    expect(page.tab.locator(".record-panel")).to_be_visible()
    with page.tab.expect_download() as download:
        page.take("Histories (CSV)")
    path = tmp_path / "data.csv"
    download.value.save_as(path)
    scene = solvers.load(path)
    assert scene.target.rods[0].length == 0.45 and scene.contact.NAME == "hertz"
    assert solvers.solve(scene).peak_force == pytest.approx(page.header("exact")["peakForce"], rel=1e-12)
    head = [line for line in path.read_text().splitlines() if line.startswith("#")]
    assert any(line.startswith('# methods = { waves = { name = "waves"') and "modal = {" in line for line in head)
    assert "panel=record" in head[-1] and head[-1].startswith("# link = ")
    page.tab.locator("input[type=file]").set_input_files(path)
    answer = compared(page)
    assert answer["kind"] == "force" and abs(answer["shift"]) < 1e-6 and answer["scale"] == pytest.approx(1.0, abs=1e-3)
    page.tab.locator(".record-panel select").select_option("stress")
    page.wait(f"() => {RECORD}.answer?.kind === 'stress'", timeout=LONG)
    answer = compared(page)
    assert answer["at"] == pytest.approx(0.225) and answer["residual"] < 1e-2
    page.tab.get_by_role("button", name="Close: Compare with measured data").click()
    page.wait("() => !location.search.includes('panel=record')")


def test_the_modes_of_a_rod_and_of_a_beam(open_page):
    """Shapes and the table, of the rod alone and with the mass on it; of a beam by a law the first alone."""
    page = open_page("?scene=fixed-rod&panel=modes")
    panel, drawn = page.tab.locator(".analysis.ringing"), "strikewave.page.analyses.modes.figure.model('shapes')"
    expect(panel.locator("tr[aria-current]")).to_contain_text("4.297 kHz", timeout=LONG)
    assert panel.locator("tbody tr").count() == 8
    expect(panel.get_by_role("status")).to_contain_text("Most of it rings in mode 1, at 4.297 kHz: 61 %")
    page.wait(f"() => {drawn}?.data.y.length === 4", timeout=LONG)
    panel.get_by_role("button", name="first 8").click()
    page.wait(f"() => {drawn}.data.key[7]?.startsWith('8: 64.45')")
    panel.get_by_role("button", name="with the mass on it").click()
    expect(panel.locator("tbody tr").first).to_contain_text("2.353 kHz")
    panel.get_by_role("button", name="Show the numbers").first.click()
    expect(panel.get_by_role("columnheader", name="mode 8").first).to_be_visible()
    page.show_scene("hammer-on-cantilever")
    expect(panel.locator("tr[aria-current]")).to_contain_text("3.58 kHz", timeout=LONG)
    expect(panel.get_by_role("button", name="with the mass on it")).to_be_hidden()
    page.show_scene("figure-8.12")
    expect(panel.get_by_role("columnheader", name="by Euler–Bernoulli")).to_be_visible(timeout=LONG)
    expect(panel.locator("tbody tr").last).to_contain_text("23.63 kHz")
    page.wait("() => strikewave.page.analyses.modes.figure.model('beside').data.y.length === 6")
    scroll = panel.locator(".scroll")
    expect(scroll).not_to_have_attribute("tabindex", "0")
    page.tab.set_viewport_size({"width": 390, "height": 844})
    page.laid_out()
    page.turn_to("Analysis")
    expect(scroll).to_have_attribute("tabindex", "0")  # it is wider than its room, and keys scroll it
    expect(scroll).to_have_accessible_name("The modes, and which of them rings")
    page.show_scene("two-balls")
    expect(panel).to_be_hidden()


def test_a_record_of_force_is_laid_on_a_beam(open_page, tmp_path):
    """By the command it lies so, too: 1 ms late, 2 % too small."""
    solution = solvers.solve("hammer-on-cantilever", modes=20)
    time = np.linspace(0.0, 0.95 * solution.duration, 4_000)
    force = solution.known_motion.force(time) / 1.02
    file = tmp_path / "beam.csv"
    lines = [f"{t + 1e-3:.9g},{f:.9g}" for t, f in zip(time, force, strict=True)]
    file.write_text("\n".join(["time_s,force_N", *lines]) + "\n", encoding="utf-8")
    page = open_page("?scene=hammer-on-cantilever&layout=laboratory&modes=20")
    opened(page, "Compare with measured data")
    page.tab.locator("input[type=file]").set_input_files(file)
    found = compared(page)
    assert found["shift"] == pytest.approx(-1e-3, abs=5e-6) and found["scale"] == pytest.approx(1.02, rel=5e-3)
    assert found["residual"] < 0.05
    expect(page.tab.locator(".record-panel")).to_contain_text("T is the slowest period of the beam")
    page.evaluate("() => strikewave.page.player.go(2e-3)")
    cursor = page.evaluate(f"() => {RECORD}.figure.model('record-cursor').location")
    assert cursor == pytest.approx(2e-3 / found["trip"])
    page.show_scene("four-bar")
    expect(page.tab.get_by_role("button", name="Compare with measured data", exact=True)).to_have_count(0)
