"""Designs: what is kept as letters on the map, compared in words, as a table, and on the way from one to another."""

import csv
import io
import re
from pathlib import Path

import pytest
from playwright.sync_api import expect

import solvers

from .hands import tap, type_into
from .test_page import settled
from .test_whatif_page import SIZES, WHATIF, opened

MAP = "?layout=opening&law=hertz&whatif=peak_force,mass_ratio,hertz_stiffness"
KEPT = "() => strikewave.page.compare.runs.map(({ letter }) => letter).join('')"
RESTS = "() => !strikewave.page.own.made.has(strikewave.page.frame) && !strikewave.page.asked"
AS_AT_FIRST = """() => new Promise((done) => {
  strikewave.page.compare.clear();
  strikewave.page.goTo({ scene: 'fixed-rod', law: 'hertz' }, done);
}).then(() => null)"""
CHOSEN = "() => strikewave.page.frame.chosen"
FIGURES = ("contacts", "impactor_velocity", "peak_force", "contact_time", "newton", "peak_indentation")


@pytest.fixture
def mapped(show):
    """A map where nothing is kept, and none is left to those who follow."""
    pages = []

    def shown(query: str = MAP, size=SIZES[0]):
        page = opened(show, query, size)
        pages.append(page)
        page.evaluate(AS_AT_FIRST)
        settled(page)
        return page

    yield shown
    for page in pages:
        page.evaluate("() => { strikewave.page.compare.clear(); strikewave.page.history.pause = 700; }")


def choose(page, **choices: float) -> None:
    for name, value in choices.items():
        page.evaluate("([name, value]) => strikewave.page.choose(name, value)", [name, value])
    settled(page)
    page.wait(RESTS)


def keep(page) -> None:
    """By its key, as the map has the focus."""
    before = len(page.evaluate(KEPT))
    page.tab.locator(".whatif-map canvas").last.focus()
    page.tab.keyboard.press("k")
    page.wait(f"() => strikewave.page.compare.runs.length === {before + 1}")
    expect(page.tab.locator(".whatif-kept li")).to_have_count(before + 1)


def two(page) -> None:
    """A as the scene is, B with less mass on a stiffer contact."""
    keep(page)
    choose(page, mass_ratio=4.0, hertz_stiffness=1e11)
    keep(page)


def spot(page, letter: str) -> tuple[float, float]:
    """Where a letter stands on the screen."""
    x, y = page.evaluate(f"(name) => {WHATIF}.plane.letters.spots.find(([each]) => each === name)[1]", letter)
    box = page.tab.locator(".whatif-map").bounding_box()
    return box["x"] + x, box["y"] + y


def test_what_is_kept_stands_on_the_map_and_is_gone_back_to(mapped):
    page = mapped()
    two(page)
    choose(page, mass_ratio=2.0)
    page.wait(f"() => {WHATIF}.plane.letters.spots.length === 2")
    rows = page.tab.locator(".whatif-kept li")
    expect(rows.first).to_contain_text("Mass ratio 1, Stiffness 1e10")
    said = page.tab.locator(".whatif-kept p[aria-live]")
    expect(said).to_contain_text(re.compile(r"^Against B: peak force .* instead of .*%\smore"))
    page.evaluate("() => { strikewave.page.history.pause = 0; }")  # each click is a step, however soon
    page.tab.mouse.click(*spot(page, "A"))
    page.wait("() => strikewave.page.frame.chosen.hertz_stiffness === 1e10")
    assert page.evaluate(CHOSEN)["mass_ratio"] == 1.0
    expect(said).to_contain_text("A has the same settings")
    rows.nth(1).get_by_role("button", name="B: go back to these settings").click()
    page.wait("() => strikewave.page.frame.chosen.mass_ratio === 4")
    assert page.evaluate(CHOSEN)["hertz_stiffness"] == 1e11
    page.tab.locator(".whatif-map canvas").last.focus()
    page.tab.keyboard.press("Control+z")
    page.wait("() => strikewave.page.frame.chosen.mass_ratio === 1")
    page.tab.get_by_role("button", name="Remove A").click()
    expect(rows).to_have_count(1)
    page.wait("() => new URLSearchParams(location.search).get('kept')?.startsWith('B,mass_ratio:4')")


def test_another_law_is_hollow_and_out_of_view_is_at_the_edge(mapped):
    page = mapped()
    keep(page)
    choose(page, mass_ratio=900.0)
    keep(page)
    choose(page, mass_ratio=1.0, law="rigid")
    keep(page)
    choose(page, law="hertz")
    hollow = page.evaluate(f"() => {WHATIF}.designs.shown.kept.map(({{ letter, hollow }}) => [letter, hollow])")
    assert sorted(hollow) == [["A", False], ["B", False], ["C", True]]
    page.wait(f"() => {WHATIF}.plane.letters.spots.length === 3")
    plot = page.evaluate(f"() => {WHATIF}.plane.plot")
    box = page.tab.locator(".whatif-map").bounding_box()
    right = box["x"] + plot["x"] + plot["w"]
    assert right - 40 < spot(page, "B")[0] < right
    page.tab.get_by_role("combobox", name="To", exact=True).select_option("C")
    expect(page.tab.locator(".whatif-kept")).to_contain_text(
        "Nothing lies between A and C: they differ in Contact law."
    )
    expect(page.tab.get_by_role("slider", name="From A to C")).to_be_disabled()


def test_a_ninth_is_refused_in_a_sentence(mapped):
    page = mapped()
    for number in range(8):
        choose(page, mass_ratio=1.0 + 0.25 * number)
        keep(page)
    choose(page, mass_ratio=0.5)
    page.tab.get_by_role("button", name="Keep", exact=True).click()
    expect(page.tab.locator(".toast")).to_contain_text("Eight solutions are kept already")
    assert page.evaluate(KEPT) == "ABCDEFGH"


def test_the_table_has_the_inputs_and_figures_of_the_library(mapped, tmp_path):
    page = mapped()
    two(page)
    page.tab.locator("#choice-mass_ratio").focus()
    page.tab.keyboard.press("ArrowRight")
    with page.tab.expect_download() as saved:
        page.tab.get_by_role("button", name="Table (CSV)").click()
    assert saved.value.suggested_filename == "strikewave-fixed-rod-designs.csv"
    saved.value.save_as(tmp_path / "designs.csv")
    lines = Path(tmp_path / "designs.csv").read_text("utf-8").splitlines()
    assert lines[0].startswith("# link = ") and "kept=A,law:hertz;B," in lines[0]
    rows = list(csv.DictReader(io.StringIO("\n".join(lines[1:]))))
    assert [row["design"] for row in rows] == ["A", "B", "Now"]
    chosen = page.evaluate(CHOSEN)
    assert chosen["mass_ratio"] > 4.0
    bare = [{name.split(" [")[0]: value for name, value in row.items()} for row in rows]
    for row, ratio, stiffness in zip(bare, (1.0, 4.0, chosen["mass_ratio"]), (1e10, 1e11, 1e11), strict=True):
        scene = solvers.load(row["scene"])
        assert float(row["impactor.mass"]) == pytest.approx(scene.target.mass / ratio, rel=1e-12)
        assert float(row["contact.stiffness"]) == stiffness
        numbers = ("impactor.mass", "impactor.velocity", "target.length")
        given = {name: float(row[name]) for name in numbers}
        contact = {"law": row["contact.law"], "stiffness": float(row["contact.stiffness"])}
        exact = solvers.solve(scene.replace({**given, "contact": contact}), method=row["method.name"])
        energy = exact.energy
        found = {name: float(row[name]) for name in FIGURES}
        assert found["contacts"] == len(exact.contacts)
        assert found["peak_force"] == pytest.approx(exact.peak_force, rel=1e-7)
        assert found["impactor_velocity"] == pytest.approx(exact.impactor_velocity, rel=1e-7)
        assert found["peak_indentation"] == pytest.approx(exact.peak_indentation, rel=1e-6)
        assert float(row["vibration"]) == pytest.approx(energy["target_vibration"] / energy["initial"], abs=1e-7)
        assert float(row["peak_stress"]) > 0.999 * exact.peak_force / float(row["target.section.area"])
    assert "contact.stiffness [N/m^1.5]" in rows[0] and "target.section.area [m²]" in rows[0]


def test_arrows_take_the_scene_from_one_design_to_another(mapped):
    page = mapped()
    two(page)
    way = page.tab.get_by_role("slider", name="From A to B")
    expect(way).to_have_value("100")
    way.focus()
    for _ in range(25):
        way.press("ArrowLeft")
    expect(way).to_have_value("75")
    page.wait(RESTS)
    chosen = page.evaluate(CHOSEN)
    assert chosen["mass_ratio"] == pytest.approx(4.0**0.75, rel=1e-9)
    assert chosen["hertz_stiffness"] == pytest.approx(1e10 * 10.0**0.75, rel=1e-9)
    scene = solvers.load("fixed-rod").replace({"contact": {"law": "hertz", "stiffness": chosen["hertz_stiffness"]}})
    exact = solvers.solve(scene.replace({"impactor.mass": scene.target.mass / chosen["mass_ratio"]}), method="waves")
    assert page.evaluate(f"() => {WHATIF}.here('peak_force')") == pytest.approx(exact.peak_force, rel=1e-7)
    way.press("Home")
    page.wait("() => strikewave.page.frame.chosen.hertz_stiffness === 1e10")
    for _ in range(26):  # one step of undo, or several where the machine was busy between the keys
        if page.evaluate(CHOSEN)["mass_ratio"] == 4:
            break
        page.tab.keyboard.press("Control+z")
        page.wait("() => !strikewave.page.asked && !Object.keys(strikewave.page.waiting).length")
    page.wait("() => strikewave.page.frame.chosen.mass_ratio === 4")


def test_values_of_bodies_morph_by_the_server(mapped):
    page = mapped("?layout=opening&law=hertz&whatif=peak_force,target.length,speed")
    keep(page)
    page.evaluate("() => strikewave.page.bodies.set('target.length', 0.6)")
    page.wait("() => strikewave.page.frame.chosen.bodies.includes('0.6') && !strikewave.page.asked")
    before = page.evaluate(CHOSEN)
    keep(page)
    way = page.tab.get_by_role("slider", name="From A to B")
    way.focus()
    way.press("PageDown")
    page.wait("() => !strikewave.page.changes.goal && strikewave.page.frame.chosen.bodies !== 'target.length=0.6'")
    chosen = page.evaluate(CHOSEN)
    length = float(chosen["bodies"].split("target.length=")[1].split()[0])
    assert length == pytest.approx(0.3 * 2.0**0.9, rel=1e-9)
    ratio = before["mass_ratio"]  # of B; A has 1
    assert chosen["mass_ratio"] == pytest.approx(ratio**0.9, rel=1e-6)


def test_designs_come_with_a_link_and_stay_when_the_map_is_left(open_page):
    page = open_page(MAP + "&kept=A,law:hertz;B,law:hertz,mass_ratio:4")
    rows = page.tab.locator(".whatif-kept li")
    expect(rows).to_have_count(2)
    page.wait(f"() => {WHATIF}.plane.letters.spots.length === 2")
    page.tab.locator(".whatif-map canvas").last.focus()
    page.tab.keyboard.press("Escape")
    expect(rows).to_have_count(0)
    page.tab.keyboard.press("w")
    expect(rows).to_have_count(2)
    expect(rows.nth(1)).to_contain_text("Mass ratio 4")


@pytest.mark.parametrize("size", SIZES)
def test_map_and_comparison_are_seen_at_every_size(mapped, size):
    page = mapped(MAP, size)
    two(page)
    choose(page, mass_ratio=2.0)
    width, height = size
    keeps = page.tab.get_by_role("button", name="Keep", exact=True).bounding_box()
    plot = page.tab.locator(".whatif-map").bounding_box()
    assert keeps["x"] + keeps["width"] <= width and keeps["y"] + keeps["height"] <= plot["y"] + 1
    assert plot["height"] >= 0.2 * height and plot["y"] + plot["height"] < height
    page.fits(width)
    tiles = page.tab.locator(".whatif-tiles button").first
    assert tiles.bounding_box()["height"] > 30
    for part in (page.tab.locator(".whatif-morph"), page.tab.locator(".whatif-kept li").last):
        part.scroll_into_view_if_needed()
        box = part.bounding_box()
        assert box["x"] >= 0 and box["x"] + box["width"] <= width and box["y"] + box["height"] <= height + 0.5
    remove = page.tab.get_by_role("button", name="Remove B")
    (tap if width < 500 and page.tab.evaluate("() => 'ontouchstart' in window") else lambda each: each.click())(remove)
    expect(page.tab.locator(".whatif-kept li")).to_have_count(1)


def test_a_wanted_value_leaves_the_designs_within_reach(mapped):
    page = mapped(MAP, (1280, 720))
    two(page)
    type_into(page.tab.locator(".whatif-goal").get_by_role("textbox"), "20 kN")
    row = page.tab.locator(".whatif-kept li").last
    row.scroll_into_view_if_needed()
    box = row.bounding_box()
    assert box["y"] + box["height"] <= 720
    page.tab.get_by_role("button", name="Nothing wanted").click()
