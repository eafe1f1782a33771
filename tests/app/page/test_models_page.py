"""Which model is enough, over the axes of the map, as the server solves it by each."""

import csv

import pytest
from playwright.sync_api import expect

import solvers
from app.command.main import main

from .test_along_page import CODES, READY, saved, take
from .test_page import settled
from .test_whatif_fingers_page import PHONE, Fingers
from .test_whatif_page import OPEN, WHATIF

pytestmark = pytest.mark.browser
MODELS = f"{WHATIF}.modes.models"
SEEN = f"() => {MODELS}.view && !{MODELS}.view.coarse && {MODELS}.jobs.own.places"
NAMED = f"() => {MODELS}.jobs.own.places.map((place) => {MODELS}.name(place))"
HAMMER, ROD = "?layout=opening&scene=hammer-on-cantilever", "?layout=opening&law=hertz"
OF_HAMMER = "models:peak_force,mass_ratio,stiffness,,within:0.01"
OF_ROD = "models:peak_force,mass_ratio,hertz_stiffness,,within:0.01"
THERE = "(view) => view.index.filter((at, k) => at >= 0 && view.seen(k % view.nx, Math.floor(k / view.nx))).length"
SMALL = (390, 844)  # the fewest points


def open_models(page, said: str, ready: str = SEEN):
    settled(page)
    page.evaluate(OPEN, said)
    page.wait(ready)
    return page.tab.locator(".whatif-models")


def test_the_scene_s_smallest_models_are_those_of_the_plan(show):
    page = show(HAMMER, SMALL)
    view = open_models(page, OF_HAMMER)
    plan = solvers.plan("hammer-on-cantilever", "peak-force", solve=True)
    names = page.tab.evaluate(NAMED)
    for bound, name in zip((0.1, 0.05, 0.01, 0.001), names, strict=True):
        smallest = next(each for each in plan.candidates if each.modes and each.expected_error <= bound)
        assert name == f"{smallest.modes} modes"
    expect(view.locator(".whatif-models-said")).to_contain_text(f"10 %: {names[0]}")
    assert view.locator("li").count() > 1  # the map has several, by colour


def test_the_bound_is_a_word_of_the_title_and_part_of_the_link(show):
    page = show(HAMMER, SMALL)
    open_models(page, OF_HAMMER)
    bound = page.tab.get_by_label("Allowed error", exact=True)
    expect(bound).to_have_value("0.01")
    before = page.tab.evaluate(f"() => [...{MODELS}.view.contacts].join()")
    bound.focus()
    page.tab.keyboard.press("ArrowUp")
    expect(bound).to_have_value("0.05")
    page.wait("() => decodeURIComponent(location.search).includes('within:0.05')")
    page.wait(f"() => [...{MODELS}.view.contacts].join() !== '{before}'")
    bound.press("1")  # 1 %, as it is typed
    page.wait("() => decodeURIComponent(location.search).includes('within:0.01')")


def test_what_is_shown_is_hatched_where_it_is_not_enough(show):
    """Five modes are not, of the hammer: it is said, and more modes mend it."""
    page = show(HAMMER + "&modes=5", SMALL)
    view = open_models(page, OF_HAMMER)
    expect(view.locator(".whatif-models-said")).to_contain_text("What is shown is not, within 1 %: hatched.")
    assert page.tab.evaluate(f"() => {MODELS}.plane.regions.weak({MODELS}.jobs.own.places[2])")
    show(HAMMER + "&modes=30", SMALL)
    view = open_models(page, OF_HAMMER)
    expect(view.locator(".whatif-models-said")).not_to_contain_text("hatched")


def test_the_point_is_moved_by_a_finger_and_by_keys(open_page):
    page = open_page(ROD, **PHONE)
    view = open_models(page, OF_ROD)
    over = view.locator(".whatif-models-map canvas").last
    box = over.bounding_box()
    place = (box["x"] + 0.8 * box["width"], box["y"] + 0.5 * box["height"])
    Fingers(page).go((place, place))
    page.wait("() => strikewave.page.frame.chosen.mass_ratio > 2")
    ratio = page.tab.evaluate("() => strikewave.page.frame.chosen.mass_ratio")
    over.focus()
    page.tab.keyboard.press("Shift+ArrowLeft")
    page.wait(f"() => strikewave.page.frame.chosen.mass_ratio < {ratio}")


def test_where_nothing_rings_it_says_so(show):
    page = show("?layout=opening&scene=two-balls", SMALL)
    view = open_models(page, "models:peak_force", f"() => {MODELS}")
    expect(view.locator(".whatif-models-said")).to_contain_text("Nothing bends or rings here")


def test_its_table_and_its_command_are_taken_along(show, tmp_path, capsys, monkeypatch):
    page = show(ROD, (1280, 720))
    open_models(page, OF_ROD)
    page.wait(f"() => ({THERE})({MODELS}.view) > 20")
    assert saved(page, "CSV", tmp_path / "models.csv").endswith("models.csv")
    lines = (tmp_path / "models.csv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    assert len(rows) > 20 and {"model_within_0.01", "mass_ratio"} <= set(rows[0])
    take(page, "Command and Python")
    page.wait(READY)
    command, python, scene = page.tab.evaluate(CODES)
    assert command.split()[:2] == ["impact", "plan"] and "solve=True" in python
    (tmp_path / command.split()[2]).write_text(scene, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert main(command.split()[1:]) == 0
    name = page.tab.evaluate(NAMED)[2]
    assert f"modal, {name.split()[0]} modes" in capsys.readouterr().out.split("->")[1].splitlines()[0]
