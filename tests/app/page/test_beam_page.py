"""A struck beam on the page, in a real browser."""

import numpy as np
import pytest
from playwright.sync_api import expect

import solvers
from app.choices.request import Request
from app.messages.transverse import chosen_method

from .hands import type_into
from .test_page import check_slider, settled

SCENE = "figure-8.15"
STUDIED = "name => strikewave.page.analyses[name].fresh"
ALL_DRAWN = """() => [...strikewave.page.beam.inView.owed].every(({ chart }) => !chart.area.clientWidth)
  && strikewave.page.beam.inView.seen.size"""
CUT_OFF = """() => [...strikewave.page.beam.stack.root.querySelectorAll('.key')]
  .filter((key) => key.getBoundingClientRect().right > innerWidth).map((key) => key.textContent)"""
STAGE_TOP = "() => strikewave.page.beam.stage.root.getBoundingClientRect().top + scrollY"
LONG = 120_000  # ms: in a fresh copy the kernels of the studies are compiled first


def test_a_beam_is_drawn_and_its_story_shown(anew):
    page = anew(SCENE)
    contacts = page.header("main")["contacts"]
    assert contacts > 5
    expect(page.tab.get_by_role("heading", name=f"Why one impact is {contacts} contacts")).to_be_visible()
    expect(page.tab.locator("ol.events")).to_contain_text("thrown ahead")
    expect(page.tab.locator("p.span")).to_contain_text("riding on it this beam swings half a period")
    for name in ("How bending runs along", "Contact force", "Impactor and struck point"):
        expect(page.tab.get_by_role("heading", name=name)).to_be_visible()
    page.turn_to("Numbers")
    for name in ("Contact law", "Dispersion"):
        expect(page.tab.get_by_role("heading", name=name)).to_be_visible()
    assert page.tab.locator("section.stage:visible").count() == 1
    page.wait(ALL_DRAWN)
    page.wait(
        """() => [strikewave.page.beam.stage.canvas,
             ...['spaceTime', 'force', 'motion', 'cycle', 'dispersion'].map(
               (part) => strikewave.page.beam[part].chart.below)].map((canvas) => {
          const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
          return new Set(new Uint32Array(data.buffer)).size;
        }).every((colours) => colours > 20)"""
    )


SLIDERS = {
    "slenderness": ("Length over depth", 0.5),
    "mass_ratio": ("Mass ratio", 0.6),
    "place": ("Struck at", 0.6),
    "damping": ("Modal damping", 0.4),
}


def test_each_slider_of_a_beam_redraws_it(anew):
    page = anew(SCENE)
    for name, place in SLIDERS.items():
        check_slider(page, name, *place)


def test_each_picker_of_a_beam_redraws_it_and_its_link_leads_there(anew, open_page):
    page = anew(SCENE)
    for label, option in (("Support", "free-free"), ("Theory", "euler-bernoulli")):
        pixels = page.picture()
        page.answered(lambda label=label, option=option: page.tab.get_by_label(label, exact=True).select_option(option))
        settled(page)
        assert page.evaluate("name => strikewave.page.frame.beam[name]", label.lower()) == option
        page.redrawn(pixels)
    again = open_page("?" + page.tab.url.split("?")[1])
    assert again.header("chosen") == page.header("chosen")


def test_the_browser_rebuilds_the_fields_of_the_library(anew):
    page = anew(SCENE, damping=0.02)
    chosen = page.header("chosen")
    request = Request.of(chosen)
    scene = request.scene
    solution = chosen_method(request)[0].solve(scene)
    motion, x = solution.motion, np.linspace(0.0, scene.target.length, page.header("places"))
    fields = {
        "deflection": motion.displacement,
        "velocity": motion.velocity,
        "moment": motion.moment,
        "shear": motion.shear,
    }
    for what, field in fields.items():
        largest = np.abs(field(np.linspace(0.0, solution.duration, 400), x)).max()
        for t in (2e-3, 3e-4, 3.1e-3):
            step = page.header("step")
            now = round(t / step) * step
            drawn = page.evaluate("([t, what]) => [...strikewave.page.beam.field.profile(t, what)]", [now, what])
            assert np.abs(np.array(drawn) - field(np.array([now]), x)[0]).max() < 2e-3 * largest, (what, t)


def test_what_is_out_of_sight_is_drawn_when_it_comes_into_view(anew):
    page = anew("hammer-on-cantilever", (1440, 720))
    page.wait("() => strikewave.page.beam.inView.seen.size")
    page.wait(ALL_DRAWN)
    owed = page.evaluate(
        """() => { strikewave.page.take();
             const owed = [...strikewave.page.beam.inView.owed];
             return owed.map(({ chart }) => chart.root.querySelector("h2").textContent); }"""
    )
    assert "Dispersion" in owed and "How bending runs along" not in owed
    page.frames_pass(30)  # also once the page has come to rest: it is behind a tab
    assert page.evaluate("() => strikewave.page.beam.inView.owed.has(strikewave.page.beam.dispersion)")
    page.turn_to("Numbers")
    page.tab.get_by_role("heading", name="Dispersion").scroll_into_view_if_needed()
    page.wait("() => !strikewave.page.beam.inView.owed.has(strikewave.page.beam.dispersion)")


def test_slow_motion_plays_the_first_contacts_and_asks_for_these_alone(open_page):
    page = open_page(f"?scene={SCENE}")
    page.quiet()
    solved, top = page.evaluate("() => strikewave.frames"), page.evaluate(STAGE_TOP)
    page.tab.get_by_role("button", name="Slow motion").click()
    page.wait("() => strikewave.page.player.playing && strikewave.page.player.t > 0")
    assert page.evaluate(STAGE_TOP) == top
    low, high = page.evaluate("() => strikewave.page.beam.axis.view")
    assert low == 0.0 and high < page.header("duration")
    expect(page.tab.locator(".now")).to_contain_text("contact 1 of")
    page.wait("() => strikewave.page.model.time_in_view !== ''")
    page.tab.get_by_role("button", name="Show the whole impact").click()
    assert page.evaluate("() => strikewave.page.beam.axis.view[1]") == page.header("duration")
    asked = [float(each) for each in page.evaluate("() => strikewave.page.model.time_in_view").split()]
    assert asked == pytest.approx([low, high], rel=1e-6)
    assert page.evaluate("() => strikewave.frames") == solved


def test_colours_and_the_half_space_can_be_changed(anew):
    page = anew(SCENE)
    half = page.tab.get_by_role("button", name="on a half-space")
    for act in (
        lambda: page.tab.get_by_role("button", name="shear", exact=True).click(),
        lambda: half.click(),
        lambda: page.tab.get_by_role("button", name="velocity", exact=True).last.click(),
    ):
        pixels = page.picture()
        act()
        page.redrawn(pixels)
    half.click()  # as it was


def test_how_far_to_trust_it(anew):
    page = anew("figure-8.25")
    page.analysis("Sensitivity")
    page.wait(STUDIED, "trust", timeout=LONG)
    table = page.tab.locator(".study-trust table")
    expect(table).to_contain_text("final velocity")
    expect(table.locator("tr.firm").first).to_contain_text("firm")
    assert page.evaluate("() => strikewave.page.beam.band.force.high.length") > 100
    page.analysis("Convergence")
    page.wait(STUDIED, "convergence", timeout=LONG)
    expect(page.tab.locator(".study-convergence table")).to_contain_text("shear force at the support")
    shown = """name => {
      const { figure } = strikewave.page.analyses[name];
      return figure.views && figure.parts.every(({ area }) => area.firstElementChild.offsetHeight > 100);
    }"""
    for name in ("trust", "convergence"):
        page.wait(shown, name)
    band = page.evaluate("() => strikewave.page.analyses.trust.figure.model('bands').data")
    edges = [band[f"force-{edge}"] for edge in ("lowest", "low", "high", "highest")]
    assert all(list(row) == sorted(row) for row in zip(*edges, strict=True)) and max(edges[3]) > 0
    reported = page.evaluate("() => strikewave.page.analyses.convergence.figure.model('differences').data")
    assert {"peak force", "final velocity"} <= set(reported["quantity"]) and 40 not in reported["count"]
    page.show_scene("fixed-rod")
    expect(page.tab.locator(".study-trust")).to_be_hidden()


def test_energy_over_time_of_a_beam(anew):
    page = anew(SCENE)
    page.analysis("Energy over time")
    cursor = "() => strikewave.page.analyses.energy.figure.model('energy-cursor')"
    page.wait(cursor)
    said = page.tab.locator(".analysis.energy .help").first
    expect(said).to_contain_text("At the end, after")
    expect(said).to_contain_text("lost in the contact")
    page.evaluate("() => strikewave.page.player.go(7e-4)")
    assert page.evaluate(f"() => ({cursor})().location") == pytest.approx(0.7)  # ms, as the figure shows them


NOTED = """() => {
  const { frame, view } = strikewave.page;
  const notes = [{ code: 'not-parted', severity: 'warning', values: {} }];
  view.story.load({ ...frame, main: { ...frame.main, notes: [] }, reference: { ...frame.reference, notes } });
  return view.story.warnings.list.textContent;
}"""


def test_of_modes_only_those_chosen_are_warned_of(anew):
    """The others are there to be compared with."""
    assert anew("timoshenko-1913-short").evaluate(NOTED) == ""


def test_a_phone_shows_all_of_it(open_page):
    page = open_page("?scene=hammer-on-cantilever", size=(390, 844), has_touch=True)
    check_phone(page)
    page.turn_to("Controls")
    page.show_scene("timoshenko-1913-long")
    check_phone(page)


def check_phone(page) -> None:
    page.fits(390)
    box = page.tab.get_by_role("button", name="Slow motion").bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= 390
    ratio = page.tab.get_by_label("Mass ratio", exact=True)
    expect(ratio).to_be_visible()
    stage = page.evaluate("() => strikewave.page.view.stage.root.getBoundingClientRect().bottom")
    assert stage <= box["y"] < ratio.bounding_box()["y"]  # what a drag changes is seen with it
    page.turn_to("Charts")
    expect(ratio).to_be_visible()
    assert page.evaluate(CUT_OFF) == []


def test_an_address_that_cannot_be_struck_shows_the_scene_and_says_why(open_page):
    page = open_page(f"?scene={SCENE}&place=0")
    assert page.header("chosen")["place"] == 1.0
    expect(page.tab.locator(".toast")).to_contain_text("Struck at: got 0.0; allowed: a fraction of the length")


def test_the_data_of_a_beam_can_be_saved(anew, tmp_path):
    page = anew(SCENE)
    with page.tab.expect_download() as download:
        page.take("Histories (CSV)")
    download.value.save_as(tmp_path / "data.csv")
    rows = [line for line in (tmp_path / "data.csv").read_text().splitlines() if not line.startswith("#")]
    assert rows[0].startswith("time_s,force_5_modes_N,impactor_m")
    assert len(rows) == 2002


def test_a_support_that_would_hold_the_struck_place_moves_the_impact(open_page):
    page = open_page("?scene=hammer-on-cantilever")
    page.answered(lambda: page.tab.get_by_label("Support", exact=True).select_option("pinned-pinned"))
    settled(page)
    beam = page.evaluate("strikewave.page.frame.beam")
    assert beam["support"] == "pinned-pinned" and beam["place"] == pytest.approx(0.5 * beam["length"])
    expect(page.tab.get_by_label("Struck at, exact value")).to_have_value("0.5")


def test_choices_that_cannot_be_solved_are_set_back(anew):
    page = anew("hammer-on-cantilever")
    place = page.tab.get_by_label("Struck at, exact value")
    type_into(place, "0", "Enter")
    expect(page.tab.locator(".field-place .wrong")).to_contain_text("Struck at: got 0.0; allowed: a fraction")
    expect(page.tab.locator(".toast:visible")).to_have_count(0)
    expect(place).to_have_value("1")
    page.answered(lambda: page.tab.get_by_label("Theory", exact=True).select_option("timoshenko"))
    assert page.header("chosen")["place"] == 1.0


def test_an_impact_beside_the_clamp_is_reported_as_one_on_a_wall(anew):
    page = anew("hammer-on-cantilever", place=0.05)
    story = page.tab.locator(".story:visible")
    expect(story).to_contain_text("from the clamp, which holds it back almost at once")
    expect(story).to_contain_text("turns round as on a wall")
    for false in (
        "pushes on next to nothing",
        "before the beam as a whole can answer",
        "before the struck point can come",
    ):
        expect(story).not_to_contain_text(false)


def test_warnings_name_the_controls(anew):
    page = anew("hammer-on-cantilever", modes=40)
    expect(page.tab.locator(".warnings:visible")).to_contain_text("use Theory: Timoshenko")


def test_it_opens_in_the_first_contact_and_says_what_play_does(open_page):
    page = open_page("?scene=hammer-on-cantilever")
    start, end = page.header("contacts")[0][:2]
    assert start < page.evaluate("() => strikewave.page.player.t") < end
    now = page.tab.locator(".now")
    expect(now).to_contain_text("contact 1 of 5")
    expect(now).to_contain_text("Play")
    page.tab.get_by_role("button", name="Play", exact=True).click()
    expect(now).not_to_contain_text("Play")


def test_a_method_without_waves_says_so(anew):
    page = anew("hammer-on-cantilever", method="rigid")
    expect(page.tab.locator(".story:visible")).to_contain_text("For this method the beam is rigid")
    assert page.evaluate("strikewave.page.beam.stage.factor") < 1e6


def test_how_far_the_beam_gives_way_is_among_the_figures(anew):
    page = anew("hammer-on-cantilever")
    row = page.tab.locator("table.figures tr", has_text="deflection where struck, mm")
    solution = solvers.solve(solvers.load("hammer-on-cantilever"))
    found = float(row.locator("td").nth(1).text_content())
    assert found == pytest.approx(1e3 * solution.peaks["displacement"].value, rel=5e-3)  # it is said by three digits
