"""What a gauge reads: over time, on the scenes opened with it and where a hand moves it, and along the body."""

import numpy as np
import pytest
from playwright.sync_api import expect

import solvers
from app.choices.opened import opening_of
from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.messages.solutions import beside
from app.messages.transverse import main_solution
from solvers.accuracy.reference import exact_solution

from .hands import type_into
from .test_page import settled

STACK = "() => strikewave.page.view.stack.shows('stress')"
CURVES = """() => strikewave.page.view.gauge.over.content.series.map(({ x, y, factor }) =>
  [[...x].map((t) => t * strikewave.page.frame.trip), [...y].map((value) => value * factor)])"""
PLACE = "(place) => strikewave.page.view.gaugeAt(place)"
FIRST = """() => {
  const { page } = strikewave, { gauge, stack } = page.view;
  for (const name of Object.keys(stack.folded)) delete stack.folded[name];
  stack.arrange();
  page.redraw();
  gauge.asked = null;
  gauge.read(gauge.first);
}"""
TITLE = "History at a place"
OPENED = [name for name in solvers.scene_names() if opening_of(name).charts == ("stress",)]


@pytest.fixture
def gauged(anew):
    """A scene as it opens, with its own place and charts and what is read there."""

    def shown(scene: str = "fixed-rod"):
        page = anew(scene)
        page.evaluate(FIRST)
        return page

    return shown


def test_nine_figures_tell_it():
    figures = ("4.8", "4.19", "9.12", "9.13", "9.14", "10.4", "10.5", "10.6", "10.7")
    assert sorted(OPENED) == sorted(f"figure-{number}" for number in figures)


def test_figure_10_6_compares_numbers_of_clamped_modes(gauged):
    """Ready made: two are kept, the third is shown, all in the chart of the place."""
    page = gauged("figure-10.6")
    page.tab.get_by_role("button", name="Compare", exact=True).click()
    page.tab.get_by_role("button", name="5, 10 or 30 clamped modes?").click()
    page.wait("() => strikewave.page.compare.runs.length === 2 && strikewave.page.frame.modes === 30")
    kept = page.evaluate("() => strikewave.page.compare.runs.map(({ frame }) => frame.modes)")
    assert kept == [5, 10] and page.evaluate(STACK)
    page.wait("() => strikewave.page.view.gauge.kept().length === 2")


@pytest.mark.parametrize("name", ["figure-9.13", "figure-9.14", "figure-10.5", "figure-10.6"])
def test_a_figure_is_opened_on_its_place_and_tells_what_the_solvers_do(gauged, name):
    """Against the fields of the solutions themselves, of which the browser has other numbers."""
    page = gauged(name)
    assert page.evaluate(STACK)
    request = Request.of(own_choices(name))
    exact = exact_solution(request.scene, request.restitution)
    place = np.array([opening_of(name).place])
    found = page.evaluate(CURVES)
    assert len(found) == 2
    for solution, (time, stress) in zip((exact, beside(request, exact)), found, strict=True):
        time, stress = np.array(time), np.array(stress)
        steady = np.append(np.diff(time) > 1e-9, False) & np.insert(np.diff(time) > 1e-9, 0, False)  # no jump there
        known = solution.motion.stress(time[steady], place)[:, 0]
        assert np.abs(stress[steady] - known).max() < 0.02 * np.abs(known).max()


def test_the_place_is_set_by_hand_and_kept_in_the_address(open_page):
    page = open_page()
    assert not page.evaluate(STACK)  # on scenes that are not named after it, it waits
    shortened(page, 0.015, 0.15)
    assert "gauge" not in page.tab.url
    page.tab.get_by_role("button", name=f"Unfold: {TITLE}").click()
    field = page.tab.get_by_label("Place of the gauge, in millimetres from the first end").and_(
        page.tab.locator(":visible")
    )
    expect(field).to_have_value("150")
    type_into(field, "300", "Enter")
    page.wait("() => strikewave.page.view.gauge.place === 0.3")
    page.wait("() => location.search.includes('gauge=0.3')")
    type_into(field, "400", "Enter")
    expect(page.tab.locator(".wrong:visible")).to_contain_text("from 0 to 300 mm")
    expect(field).to_have_value("400")


def test_a_place_of_a_link_is_as_it_was_once_a_rod_has_been_short_for_a_while(open_page):
    page = open_page("?gauge=0.1")
    assert page.evaluate("() => strikewave.page.view.gauge.place") == 0.1
    shortened(page, 0.03, 0.1)


def shortened(page, short: float, then: float) -> None:
    """Where the gauge is on a rod of a tenth of its length, and on the whole again."""
    length = page.tab.locator(".body").nth(1).get_by_role("textbox", name="Length")
    for written, place in (("30", short), ("300", then)):
        page.answered(lambda written=written: type_into(length, written, "Enter"))
        page.wait(f"() => strikewave.page.view.gauge.place === {place}")


def test_what_is_kept_is_laid_over(gauged):
    page = gauged("figure-9.13")
    page.evaluate("() => { strikewave.page.compare.keep(); }")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('speed', 4)"))
    settled(page)
    names = "() => strikewave.page.view.gauge.over.content.series.map(({ name }) => name)"
    assert page.evaluate(names) == ["exact waves", "modes", "A"]


def test_saved_data_has_the_stress_at_the_place(gauged):
    """Of both solutions, as the chart tells it; times are those of all other columns."""
    page = gauged("figure-9.13")
    saved = page.evaluate("() => strikewave.page.view.rows(200)")
    names, told = saved["names"], np.array(saved["values"], float)
    assert names[-2:] == ["compression_waves_at_1000_mm_Pa", "compression_modal_at_1000_mm_Pa"]
    request = Request.of(own_choices("figure-9.13"))
    known = exact_solution(request.scene, request.restitution).motion.stress(told[:, 0], np.array([1.0]))[:, 0]
    assert np.median(np.abs(told[:, -2] - known)) < 0.01 * np.abs(known).max()


@pytest.mark.parametrize("scene", ["fixed-rod", "stepped-rod"])
def test_strain_is_the_stress_over_the_modulus(gauged, scene):
    page = gauged(scene)
    page.wait("() => strikewave.page.view.gauge.there")
    page.evaluate(PLACE, 0.1)
    page.evaluate("() => strikewave.page.view.gauge.read('strain')")
    saved = page.evaluate("() => strikewave.page.view.rows(200)")
    names, told = saved["names"], np.array(saved["values"], float)
    column = next(k for k, name in enumerate(names) if name.endswith("_at_100_mm_um_per_m"))
    solution = solvers.solve(scene, duration=told[-1, 0])
    young = solution.scene.target.rods[0].material.young  # of all of them
    known = 1e6 * solution.motion.stress(told[:, 0], np.array([0.1]))[:, 0] / young
    assert np.median(np.abs(told[:, column] - known)) < 1e-3 * np.abs(known).max()
    assert np.abs(known).max() > 10.0


@pytest.mark.parametrize("language", ["en", "es"])
def test_what_can_be_read_fits_on_a_phone(language, open_page):
    page = open_page(f"?layout=docks&tab=charts&language={language}", size=(390, 844))
    page.wait("() => strikewave.page.view.gauge.there")
    page.evaluate(UNFOLD)
    page.wait("() => strikewave.page.view.gauge.seen")
    page.fits(390)
    switch = page.tab.locator(".segments.small:visible").first
    edges = "(root) => [...root.querySelectorAll('button')].map((b) => b.getBoundingClientRect().right)"
    assert max(switch.evaluate(edges)) <= 390


def test_rods_of_two_materials_have_no_one_strain_to_read(gauged):
    page = gauged("split-hopkinson")
    page.wait("() => strikewave.page.view.gauge.there")
    shown = "() => [...strikewave.page.view.gauge.switches[0].root.querySelectorAll('button')].map((b) => b.hidden)"
    assert page.evaluate(shown) == [False, True, False, False, False]  # a specimen of aluminium between steel


ALONG = """() => strikewave.page.view.gauge.along.content.series.map(({ x, y, factor, name }) =>
  ({ name, x: [...x].map((place) => place / 1000), y: [...y].map((value) => value * factor) }))"""
UNFOLD = """() => { const { stack } = strikewave.page.view;
  Object.assign(stack.folded, { along: false, stress: false, moved: true, waves: true });
  stack.arrange();
  strikewave.page.redraw(); }"""


def open_along(page):
    page.evaluate(UNFOLD)
    page.wait("() => strikewave.page.view.gauge.along.content.series.length > 0")


def test_the_front_is_a_step_along_the_rod_and_the_rest_is_what_the_solver_says(gauged):
    """Exact waves at the instant of the clock; the two waves add up to the stress."""
    page = gauged("fixed-rod")
    open_along(page)
    page.evaluate("() => strikewave.page.player.seek(0.3)")
    page.wait("() => strikewave.page.view.gauge.t === 0.3")
    stress = page.evaluate(ALONG)[0]
    x, y = np.array(stress["x"]), np.array(stress["y"])
    scene = Request.of(own_choices("fixed-rod")).scene
    step = int(np.argmax(np.abs(np.diff(y))))
    assert x[step] == pytest.approx(0.6 * 0.3, rel=1e-6) and x[step + 1] == x[step]  # 0.3 T on its way of 0.5 T
    assert y[step] == pytest.approx(scene.target.impedance * scene.speed / scene.target.area, rel=1e-4)
    assert y[step + 1 :] == pytest.approx(0.0)
    page.evaluate("() => strikewave.page.view.gauge.read('waves')")
    page.wait("() => location.search.includes('read=waves')")
    places = np.array([0.01, 0.1, 0.179, 0.181, 0.25])
    right, left = (np.interp(places, each["x"], each["y"]) for each in page.evaluate(ALONG)[:2])
    assert right == pytest.approx(np.interp(places, x, y), abs=1e-6 * y.max()) and not left.any()


def test_the_place_is_dragged_along_the_body(gauged):
    page = gauged("fixed-rod")
    open_along(page)
    area = page.tab.locator(".time-views .chart:visible").filter(has_text="Along the body").locator(".chart-area")
    frame = page.evaluate("() => strikewave.page.view.gauge.along.frame")
    box = area.bounding_box()
    middle, height = box["x"] + frame["x"] + 0.5 * frame["w"], box["y"] + 0.5 * box["height"]
    page.tab.mouse.move(middle, height)
    page.tab.mouse.down()
    page.tab.mouse.move(middle + 0.25 * frame["w"], height)
    page.tab.mouse.up()
    assert page.evaluate("() => strikewave.page.view.gauge.place") == pytest.approx(0.225, abs=0.002)
    page.wait("() => location.search.includes('gauge=0.22')")


def test_a_beam_is_read_along_it_and_at_any_place(gauged):
    name = "hammer-on-cantilever"
    page = gauged(name)
    open_along(page)
    page.evaluate(PLACE, 0.1)
    request = Request.of(own_choices(name))
    motion = main_solution(request)[0].motion
    t = page.evaluate(
        "() => (strikewave.page.player.seek(0.3 * strikewave.page.frame.duration), strikewave.page.player.t)"
    )
    for what, told in (("moment", motion.moment), ("velocity", motion.velocity), ("deflection", motion.displacement)):
        page.evaluate("(what) => strikewave.page.view.gauge.read(what)", what)
        along = page.evaluate(ALONG)[0]
        known = told(np.array([t]), np.array(along["x"]))[0]
        assert np.abs(along["y"] - known).max() < 0.02 * np.abs(known).max()
        time, values = (np.array(each) for each in page.evaluate(CURVES)[0])
        known = told(time, np.array([0.1]))[:, 0]
        assert np.median(np.abs(values - known)) < 0.02 * np.abs(known).max()


def test_what_a_gauge_reads_is_in_the_link_where_it_is_not_what_the_scene_asks_for(gauged):
    page = gauged("figure-4.19")
    assert page.evaluate("() => strikewave.page.view.gauge.what") == "velocity"
    page.evaluate("() => strikewave.page.view.gauge.read('stress')")
    page.wait("() => location.search.includes('read=stress')")


def test_a_quantity_of_another_kind_is_not_read(gauged):
    """A visitor's own scene may ask for anything."""
    page = gauged("free-rod")
    page.evaluate("() => { strikewave.page.frame.opens.read = 'moment'; strikewave.page.view.gauge.body = undefined; }")
    page.evaluate("() => strikewave.page.view.load(strikewave.page.frame)")
    assert page.evaluate("() => strikewave.page.view.gauge.what") == "stress"
