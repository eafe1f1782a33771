"""The page in a real browser: every control is moved, and what is drawn is asserted."""

import math

import pytest
from playwright.sync_api import expect

from solvers import load
from solvers.records.files import load_record

from ..conftest import LABORATORY
from . import hands
from .hands import slide, type_into

FIRST_END, SECOND_START, SECOND_END = (
    1.533833820809153,
    2.124623234942172,
    2.1628427555995704,
)  # thesis (4.25) to (4.35)


def drag(page, name: str, to: float) -> None:
    """Drag a slider with the mouse, to a fraction of its length."""
    hands.drag(page.tab.get_by_role("slider", name=name, exact=True), to)


def settled(page) -> None:
    page.wait("() => { const p = strikewave.page; return !p.asked && !p.telling && !Object.keys(p.waiting).length; }")


def test_the_first_view_shows_the_story_of_the_fixed_rod(open_page):
    page = open_page()
    contacts = page.header("exact")["contacts"]
    assert [c[:2] for c in contacts] == [
        pytest.approx([0.0, FIRST_END], abs=1e-9),
        pytest.approx([SECOND_START, SECOND_END], abs=1e-9),
    ]
    table = page.tab.locator("table.contacts")
    for text in ("1.5338", "2.1246", "2.1628"):
        expect(table).to_contain_text(text)
    story = page.tab.locator("ol.events")
    expect(story).to_contain_text("it rebounds at 0.699 v")
    expect(story).to_contain_text("Contact 2")
    expect(page.tab.locator("p.match")).to_contain_text("e = 0.699")
    expect(page.tab.locator(".story table.figures")).to_contain_text("< 1e-9")


@pytest.mark.parametrize("query", ["", "?layout=laboratory"])
def test_a_page_that_opens_is_drawn_once(open_page, query):
    """Once more where its styles come late; it was up to six times, as each part asked for it."""
    page = open_page(query)
    settled(page)
    page.frames_pass(4)
    assert 1 <= page.evaluate("() => strikewave.page.painted") <= 2


PREDICTED = "Restitution (rigid)"  # where it sets nothing else
SLIDERS = {  # title of each, and where it is drawn to
    "?layout=laboratory": {
        "mass_ratio": ("Mass ratio", 0.2),
        "speed": ("Impact speed", 0.9),
        "restitution": (PREDICTED, 0.3),
        "modes": ("Modes", 0.2),
    },
    "?law=linear": {"linear_stiffness": ("Stiffness", 0.3)},
    "?law=hertz": {"hertz_stiffness": ("Stiffness", 0.8)},
    "?law=hunt-crossley": {"restitution": ("Restitution", 0.5)},
}


@pytest.mark.parametrize("query", SLIDERS)
def test_each_slider_changes_what_is_drawn(show, query):
    page = show(query)
    for name, place in SLIDERS[query].items():
        check_slider(page, name, *place)


def check_slider(page, name: str, label: str, to: float) -> None:
    """A slider that is dragged changes its own choice, no other, and the picture."""
    before, pixels = page.header("chosen"), page.picture()
    page.answered(lambda: drag(page, label, to))
    settled(page)
    after = page.header("chosen")
    assert after[name] != before[name]
    assert {k: v for k, v in after.items() if k != name} == {k: v for k, v in before.items() if k != name}
    page.redrawn(pixels)
    assert after[name] == page.evaluate("name => strikewave.page.model[name]", name)


@pytest.mark.parametrize(
    "label, name, options",
    [
        ("Contact law", "law", ["linear", "hertz", "hunt-crossley"]),
        ("Compare with", "method", ["modal"]),
    ],
)
def test_each_picker_changes_what_is_drawn(open_page, label, name, options):
    page = open_page()
    for option in options:
        pixels = page.picture()
        page.answered(lambda option=option: page.tab.get_by_label(label, exact=True).select_option(option))
        settled(page)
        assert page.header("chosen")[name] == option
        page.redrawn(pixels)
        stiffness = page.tab.get_by_role("slider", name="Stiffness")
        expect(stiffness).to_have_count(0 if page.header("chosen")["law"] == "rigid" else 1)


def test_a_scene_brings_its_own_values(open_page):
    page = open_page()
    page.show_scene("bronze-rod-steel-ball")
    settled(page)
    chosen = page.header("chosen")
    assert chosen["law"] == "hertz"
    assert chosen["speed"] == 2.03
    assert chosen["mass_ratio"] == pytest.approx(8600 * 3.142e-4 * 1.48 / 0.11, rel=1e-11)  # 12 digits are kept
    expect(page.tab.get_by_label("Impact speed, exact value")).to_have_value("2.03")


@pytest.mark.parametrize("scene, keys", [("figure-10.2", True), ("figure-8.22", True), ("figure-9.12", False)])
def test_a_note_that_names_keys_without_a_control_says_where_they_are_set(show, scene, keys):
    page = show(f"?scene={scene}")
    note = page.tab.locator("p.trust", has_text="Source: thesis").last.text_content()
    assert ("impact solve --set KEY=VALUE" in note) == keys
    assert page.errors == []


def test_restitution_moves_the_prediction_in_every_law_and_the_waves_only_where_it_acts(open_page):
    page = open_page("?law=hertz&hertz_stiffness=1e10")
    before = page.header("exact")["final"]
    page.answered(lambda: drag(page, PREDICTED, 0.5))
    settled(page)
    chosen = page.header("chosen")["restitution"]
    assert page.header("prediction")["impactor"] == pytest.approx(-chosen)
    assert page.header("exact")["final"] == before
    expect(page.tab.locator(".field-restitution .help")).to_contain_text("rigid-body prediction")
    page.answered(lambda: page.tab.get_by_label("Contact law", exact=True).select_option("hunt-crossley"))
    settled(page)
    assert abs(page.header("exact")["final"]) < abs(before)
    expect(page.tab.locator(".field-restitution .help")).to_contain_text("two rigid bodies")


def test_play_moves_the_picture_and_sends_nothing(open_page):
    page = open_page()
    frames, pixels, t = page.quiet(), page.picture(), page.evaluate("() => strikewave.page.player.t")
    page.tab.get_by_role("button", name="Play", exact=True).click()
    page.wait("t => strikewave.page.player.t > t + 0.3", t)
    assert page.frames == frames
    page.redrawn(pixels)
    page.tab.get_by_role("button", name="Pause", exact=True).click()
    stopped = page.evaluate("() => strikewave.page.player.t")
    page.frames_pass(12)
    assert page.evaluate("() => strikewave.page.player.t") == stopped
    assert page.frames == frames


def test_scrubbing_moves_one_cursor_in_all_views(open_page):
    page = open_page()
    slide(page.tab.get_by_role("slider", name="Time"), 5000)
    t = page.evaluate("() => strikewave.page.player.t")
    assert t == pytest.approx(0.5 * page.header("duration"))
    # the cursor is the only thing drawn in its colour on the upper canvas of each chart
    columns, expected = page.evaluate(
        """() => {
          const charts = strikewave.page.view.charts.map(({ chart }) => chart)
            .filter(({ box, root }) => box && !root.hidden); // without those that are folded
          const cursor = ({ above, ratio, box }) => {
            const row = above.getContext('2d').getImageData(0, Math.round((box.y + 3) * ratio), above.width, 1).data;
            const hits = [];
            for (let x = 0; x < above.width; x++) if (row[4 * x + 3] > 60) hits.push(x / ratio);
            return hits.reduce((a, b) => a + b, 0) / hits.length;
          };
          return [charts.map(cursor), charts.map((chart) => chart.px(strikewave.page.player.t))];
        }"""
    )
    assert len(expected) == 3
    assert columns == pytest.approx(expected, abs=1.0)
    assert max(expected) - min(expected) < 1.0
    expect(page.tab.locator(".clock").first).to_contain_text(f"{t:.3f} T")


def test_a_click_on_a_chart_sets_the_time_and_a_contact_can_be_looked_at_closely(open_page):
    page = open_page()
    area = page.tab.locator(".chart-area").nth(1)
    box = area.bounding_box()
    area.click(position={"x": 52 + (box["width"] - 62) * 0.25, "y": 40})
    assert page.evaluate("() => strikewave.page.player.t") == pytest.approx(0.25 * page.header("duration"), rel=0.02)
    page.turn_to("Numbers")
    page.tab.get_by_role("button", name="waves 2").click()
    low, high = page.evaluate("() => strikewave.page.axial.axis.view")
    assert low < SECOND_START < SECOND_END < high < SECOND_END + 0.1
    page.tab.get_by_role("button", name="Show the whole impact").click()
    assert page.evaluate("() => strikewave.page.axial.axis.view[0]") == 0


def test_the_browser_rebuilds_the_same_fields_as_the_library(open_page):
    """Fields at three instants, both methods, against the library: float32 histories and the picture's own grid."""
    import numpy as np

    import solvers

    scene = solvers.load("fixed-rod")
    trip, length = scene.target.round_trip_time, scene.target.length
    page = open_page("?modes=30")
    x = np.linspace(0.0, length, 61)
    profile = """([t, what, modal]) => {
      const p = strikewave.page.axial;
      const field = modal ? p.otherField : p.exactField;
      return [...field.profile(t, what, new Float64Array(61))];
    }"""
    exact = solvers.solve(scene)
    for t in (0.3, 1.2, 1.9):
        stress = exact.motion.stress(np.array([t * trip]), x)[0] / (scene.target.impedance / scene.target.area)
        moved = exact.motion.displacement(np.array([t * trip]), x)[0] / trip
        drawn = np.array(page.evaluate(profile, [t, "stress", False]))
        assert np.median(np.abs(drawn - stress)) < 2e-3  # the picture's cells are 4e-4 T wide
        assert page.evaluate(profile, [t, "displacement", False]) == pytest.approx(moved, abs=1e-4)
    page.answered(lambda: page.tab.get_by_label("Compare with", exact=True).select_option("modal"))
    settled(page)
    steps = len(page.evaluate("() => [...strikewave.page.frame.modalForce]"))
    modal = solvers.Modal(modes=30, steps=steps).solve(scene, page.header("duration") * trip)
    for k in (300, 1100, 1500):
        now = np.array([k * modal.motion.step])
        stress = modal.motion.stress(now, x)[0] / (scene.target.impedance / scene.target.area)
        drawn = page.evaluate(profile, [k * modal.motion.step / trip, "stress", True])
        assert drawn == pytest.approx(stress, abs=1e-4)  # float32 forces and checkpoints


def test_dragging_shows_results_on_the_way_and_ends_with_the_newest(open_page):
    page = open_page("?method=balance")  # which the browser does not answer by itself
    page.frames["bytes"] = 0
    moves, solves = page.evaluate(
        """async () => {
          const before = strikewave.frames, { controls } = strikewave.page;
          let moves = 0;
          while (moves < 90 || (strikewave.frames < before + 5 && moves < 4000)) {
            controls.send('mass_ratio', 0.5 + (++moves % 400) / 50);
            await new Promise(requestAnimationFrame);
          }
          return [moves, strikewave.frames - before];
        }"""
    )
    assert solves >= 5  # on the way
    page.wait("(moves) => strikewave.page.frame.chosen.mass_ratio === 0.5 + (moves % 400) / 50", moves)
    total = page.evaluate("() => strikewave.frames") - 1
    assert total <= moves
    assert page.frames["bytes"] / total < 100_000


def test_exact_values_can_be_typed_and_wrong_ones_are_refused_with_a_sentence(open_page):
    page = open_page()
    field = page.tab.get_by_label("Mass ratio, exact value")
    page.answered(lambda: type_into(field, "0.37", "Enter"))
    assert page.header("chosen")["mass_ratio"] == 0.37
    for wrong in ("5000", "-1", "abc", "0"):
        type_into(field, wrong, "Enter")
        told = page.tab.locator(".field-mass_ratio .wrong")
        expect(told).to_contain_text(f"Mass ratio: “{wrong}” is not possible. ")
        expect(told).to_contain_text("0.001 to 1000")
        expect(field).to_have_value(wrong)  # to be mended, not typed anew
    type_into(field, "1,000", "Enter")
    expect(page.tab.locator(".wrong:visible")).to_contain_text("“1,000” can be read in two ways.")
    expect(page.tab.locator(".toast:visible")).to_have_count(0)
    assert page.header("chosen")["mass_ratio"] == 0.37
    page.answered(lambda: drag(page, "Mass ratio", 0.5))
    expect(page.tab.locator(".wrong:visible")).to_have_count(0)


def test_what_was_typed_is_shown_in_the_unit_of_its_field_also_where_nothing_changes(open_page):
    page = open_page("?law=linear&linear_stiffness=1e6")
    stiffness = page.tab.locator(".field-linear_stiffness .number")
    page.answered(lambda: type_into(stiffness, "2 kN/mm", "Enter"))
    expect(stiffness).to_have_value("2e6")
    for same in ("2 kN/mm", "2000 N/mm"):
        type_into(stiffness, same, "Enter")
        expect(stiffness).to_have_value("2e6")
    box = page.tab.locator(".body").nth(1).get_by_role("textbox", name="Length")
    type_into(box, "0.3 m", "Enter")
    expect(box).to_have_value("300")
    assert page.evaluate("() => [...document.querySelectorAll('input[inputmode=decimal]')].length") == 0


def test_the_address_says_what_is_shown(open_page):
    page = open_page("?scene=free-rod&mass_ratio=2.5&modes=20")
    chosen = page.header("chosen")
    assert (chosen["scene"], chosen["mass_ratio"], chosen["modes"]) == ("free-rod", 2.5, 20)
    assert page.header("exact")["final"] == pytest.approx(math.exp(-5.0))
    page.answered(lambda: page.tab.get_by_label("Contact law", exact=True).select_option("hertz"))
    settled(page)
    again = open_page("?" + page.tab.url.split("?")[1])
    assert again.header("chosen") == page.header("chosen")


def test_a_bad_address_is_refused_and_never_becomes_markup(open_page):
    """What is said next, as one sentence is shown at a time, is waited for where links open panels."""
    wrong = "law=<img src=x onerror=document.title='owned'>"
    for query, said in (
        (f"?mass_ratio=1e9&{wrong}&modes=7", "Mass ratio: 1000000000.0 is not possible. Choose a number from 0.001 to"),
        (f"?{wrong}&modes=7", "Contact law: “…” is not possible"),
    ):
        page = open_page(query)
        chosen = page.header("chosen")
        assert (chosen["mass_ratio"], chosen["law"], chosen["modes"]) == (1.0, "rigid", 7)
        toast = page.tab.locator(".toast")
        expect(toast).to_contain_text(said)
        assert ("Contact law" in toast.inner_text()) == ("mass_ratio" not in query)
        assert "img" not in toast.inner_text()
        assert page.tab.title() == "Strikewave: one body strikes another"


@pytest.mark.parametrize(
    "query",
    [
        "?mass_ratio=0.001&modes=200",
        "?mass_ratio=1000&modes=1",
        "?scene=free-rod&mass_ratio=1000",
        "?law=hunt-crossley&restitution=0",
        "?law=linear&linear_stiffness=100000&mass_ratio=0.001&speed=0.01",
        "?law=hertz&hertz_stiffness=1e14&mass_ratio=1000&speed=100",
        "?scene=bronze-rod-steel-ball&law=hertz&hertz_stiffness=1e6&mass_ratio=0.001&method=modal",
    ],
)
def test_extremes_are_drawn(show, query):
    page = show(query)
    assert 0 < page.header("duration") < 1e5
    assert len(set(page.picture())) > 3
    drag(page, "Time", 0.9)
    figures = page.tab.locator(".story table.figures").inner_text()
    assert "NaN" not in figures
    assert "Infinity" not in figures


def test_controls_have_names_and_keys_work(open_page):
    page = open_page()
    for name in ("Mass ratio", "Impact speed", PREDICTED, "Modes", "Time"):
        expect(page.tab.get_by_role("slider", name=name, exact=True)).to_have_count(1)
    title = page.tab.locator("label", has_text=PREDICTED).bounding_box()
    assert title["x"] >= page.tab.locator(".field-restitution").bounding_box()["x"]  # long, and not cut
    modes = page.tab.get_by_role("slider", name="Modes", exact=True)
    modes.focus()
    page.answered(lambda: page.tab.keyboard.press("ArrowRight"))
    assert page.header("chosen")["modes"] == 51
    page.tab.locator("h1").click()
    page.tab.keyboard.press("Space")
    page.wait("() => strikewave.page.player.playing")


@pytest.mark.parametrize("size", [(1440, 900), (1024, 700), (390, 844)])
def test_nothing_sticks_out_sideways(open_page, show, size):
    page = show(LABORATORY, size=size) if size[0] > 400 else open_page(size=size, has_touch=True)
    page.fits(size[0])
    for name in ("Play", "Save"):
        box = page.tab.get_by_role("button", name=name, exact=True).bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= size[0]


def test_energy_over_time_follows_the_clock_silently(open_page):
    page = open_page("?law=hunt-crossley&restitution=0.6")
    page.analysis("Energy over time")
    cursor = "() => strikewave.page.analyses.energy.figure.model('energy-cursor')"
    page.wait(cursor)
    frames = page.quiet()
    page.evaluate("() => strikewave.page.player.go(0.7)")
    assert page.evaluate(f"() => ({cursor})().location") == 0.7
    page.frames_pass(18)
    assert page.frames == frames
    page.answered(lambda: drag(page, "Mass ratio", 0.4))
    page.analysis("Energy over time")
    expect(page.tab.locator(".bk-Figure")).to_have_count(0)


def test_data_can_be_saved(open_page, tmp_path):
    page = open_page()
    with page.tab.expect_download() as download:
        page.take("Histories (CSV)")
    download.value.save_as(tmp_path / "data.csv")
    lines = (tmp_path / "data.csv").read_text().splitlines()
    assert {"# velocity = 1.0", "# length = 0.3", '# law = "rigid"', '# name = "waves"'} < set(lines)
    assert load(tmp_path / "data.csv").table()["target"] == load("fixed-rod").table()["target"]
    rows = [line for line in lines if not line.startswith("#")]
    assert rows[0].startswith("time_s,force_waves_N")
    assert len(rows) == 2002
    saved = load_record(tmp_path / "data.csv")  # which the page takes back, without a question
    assert saved.values[0] == float(rows[1].split(",")[1]) and saved.values.size == 2001
    assert float(rows[1].split(",")[1]) == pytest.approx(36657.741337949345, rel=1e-6)  # sigma_0 A, thesis (4.9)
