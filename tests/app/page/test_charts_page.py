"""What a hand, a wheel and keys do on the charts, in a real browser."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

import solvers

VIEW = "() => strikewave.page.view.axis.view"
DURATION = "() => strikewave.page.frame.duration"
TIME = "() => strikewave.page.player.t"
BEAM = "figure-8.15"
DISPERSION = "() => [...strikewave.page.beam.dispersion.chart.axis.view]"
NUMBER = re.compile(r"[−-]?\d[\d.]*")


class Hand:
    """A mouse over one chart, places as shares of its box."""

    def __init__(self, page, name: str):
        self.page = page
        self.mouse = page.tab.mouse
        self.root = page.tab.locator(
            "section.chart:visible", has=page.tab.get_by_role("heading", name=name, exact=True)
        )
        self.area = self.root.get_by_role("application")
        self.area.scroll_into_view_if_needed()
        page.wait(  # until scrolling has come to rest: a wheel that scrolls the page does not zoom
            """async () => {
              const before = scrollY;
              await new Promise((done) => setTimeout(done, 400));
              return before === scrollY;
            }"""
        )
        page.wait(
            """() => [...(strikewave.page.view.inView?.owed ?? [])].every(({ chart }) => !chart.area.clientWidth)"""
        )

    def at(self, across: float, down: float = 0.5) -> tuple[float, float]:
        box = self.area.bounding_box()
        return box["x"] + 52 + across * (box["width"] - 62), box["y"] + 6 + down * (box["height"] - 26)

    def drag(self, start: float, end: float) -> None:
        self.mouse.move(*self.at(start))
        self.mouse.down()
        for k in range(1, 5):
            self.mouse.move(*self.at(start + (end - start) * k / 4))
        self.mouse.up()

    def wheel(self, across: float, distance: float) -> None:
        self.mouse.move(*self.at(across))
        self.mouse.wheel(0, distance)

    @property
    def tip(self) -> str:
        expect(self.root.locator(".tip")).to_be_visible()
        return self.root.locator(".tip").inner_text()


@pytest.mark.parametrize("scene", ["fixed-rod", BEAM])
def test_the_wheel_zooms_all_charts_about_the_pointer_and_back(anew, scene):
    page = anew(scene)
    hand, duration = Hand(page, "Contact force"), page.evaluate(DURATION)
    pixels = page.picture()
    hand.wheel(0.25, -300)
    page.wait(f"() => ({VIEW})()[0] > 0")
    low, high = page.evaluate(VIEW)
    assert high - low == pytest.approx(duration * np.exp(-0.48), rel=0.01)
    assert (0.25 * duration - low) / (high - low) == pytest.approx(0.25, abs=0.01)
    page.redrawn(pixels)
    shown = """() => strikewave.page.view.charts.map(({ chart }) => chart).filter((chart) => !chart.root.hidden)
      .slice(0, 3).map((chart) => [...chart.x])"""
    drawn = page.evaluate(shown)
    assert drawn == [[low, high]] * 3
    expect(page.tab.get_by_role("button", name="Show the whole impact")).to_be_visible()
    hand.wheel(0.25, 3000)
    page.wait(f"() => !strikewave.page.view.axis.zoomed && ({VIEW})()[1] === ({DURATION})()")
    expect(page.tab.get_by_role("button", name="Show the whole impact")).to_be_hidden()


def test_nothing_moves_under_the_pointer_when_a_chart_is_zoomed(anew):
    page = anew()
    hand = Hand(page, "Contact force")
    before = hand.area.bounding_box()
    hand.wheel(0.5, -300)
    page.wait("() => strikewave.page.view.axis.zoomed")
    assert hand.area.bounding_box() == before


def test_the_wheel_scrolls_the_page_where_there_is_nothing_to_zoom_out(anew):
    page = anew(BEAM, size=(1440, 700))
    page.turn_to("Numbers")
    hand = Hand(page, "Dispersion")
    scrolled = "() => strikewave.page.layout.tabs.panel('numbers').scrollTop"
    before, whole = page.evaluate(scrolled), page.evaluate(DISPERSION)
    hand.wheel(0.5, 60)
    page.wait(f"before => ({scrolled})() > before", before)
    assert page.evaluate(DISPERSION) == whole


def test_a_drag_zooms_into_what_it_passes_and_a_double_click_shows_all(anew):
    page = anew()
    hand, duration, t = Hand(page, "Contact force"), page.evaluate(DURATION), page.evaluate(TIME)
    hand.drag(0.75, 0.5)
    assert page.evaluate(VIEW) == pytest.approx([0.5 * duration, 0.75 * duration], rel=0.01)
    assert page.evaluate(TIME) == t
    page.tab.keyboard.down("Shift")
    hand.drag(0.25, 0.75)  # moves the view half its width to the left
    page.tab.keyboard.up("Shift")
    assert page.evaluate(VIEW) == pytest.approx([0.375 * duration, 0.625 * duration], rel=0.01)
    page.tab.mouse.dblclick(*hand.at(0.5))
    assert page.evaluate(VIEW) == [0, duration]


def test_the_line_of_the_clock_can_be_dragged(anew):
    page = anew()
    hand, duration = Hand(page, "Impactor and struck point"), page.evaluate(DURATION)
    hand.drag(page.evaluate(TIME) / duration, 0.8)
    assert page.evaluate(TIME) == pytest.approx(0.8 * duration, rel=0.01)
    assert page.evaluate(VIEW) == [0, duration]


def test_a_finger_moves_the_clock_and_two_zoom(open_page):
    page = open_page(size=(390, 844), has_touch=True)
    page.turn_to("Charts")
    hand, duration = Hand(page, "Contact force"), page.evaluate(DURATION)
    fingers = page.context.new_cdp_session(page.tab)

    def touch(kind: str, *places: float) -> None:
        points = [dict(zip("xy", hand.at(u), strict=True), id=k) for k, u in enumerate(places)]
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", 0.3)
    touch("touchMove", 0.6)
    touch("touchEnd")
    assert page.evaluate(TIME) == pytest.approx(0.6 * duration, rel=0.02)
    touch("touchStart", 0.4)
    touch("touchStart", 0.4, 0.6)
    touch("touchMove", 0.2, 0.8)
    touch("touchEnd")
    low, high = page.evaluate(VIEW)
    assert high - low == pytest.approx(duration / 3, rel=0.03)
    assert 0.5 * (low + high) == pytest.approx(0.5 * duration, rel=0.03)


def test_a_pointer_reads_the_value_of_every_curve(anew):
    page = anew(modes=20)
    hand, duration = Hand(page, "Contact force"), page.evaluate(DURATION)
    hand.mouse.move(*hand.at(0.2))
    when, exact, modes, raw = hand.tip.splitlines()
    t = float(NUMBER.search(when)[0])
    assert t == pytest.approx(0.2 * duration, rel=0.01)
    scene = solvers.load("fixed-rod")
    force = solvers.solve(scene).motion.force(np.array([t * scene.target.round_trip_time]))[0]
    assert exact.startswith("exact waves") and exact.endswith("kN")
    assert float(NUMBER.search(exact)[0]) == pytest.approx(force / 1e3, rel=2e-3)
    assert modes.startswith("modes") and raw.startswith("raw")
    hand.mouse.move(0, 0)
    expect(hand.root.locator(".tip")).to_be_hidden()


def test_a_pointer_reads_the_colours_of_the_picture(anew):
    page = anew()
    hand = Hand(page, "Where the waves are")
    hand.mouse.move(*hand.at(0.1, 0.1))
    assert "compression" in hand.tip and "MPa" in hand.tip
    pressed = float(NUMBER.search(hand.tip.splitlines()[1])[0])
    scene = solvers.load("fixed-rod")
    t, x = 0.1 * page.evaluate(DURATION) * scene.target.round_trip_time, 0.1 * scene.target.length
    stress = solvers.solve(scene).motion.stress(np.array([t]), np.array([x]))[0, 0]
    assert pressed == pytest.approx(stress / 1e6, rel=0.05)  # of the next row and column
    page.tab.get_by_role("button", name="velocity", exact=True).click()
    hand.mouse.move(*hand.at(0.12, 0.1))
    assert "velocity" in hand.tip and "m/s" in hand.tip


def test_a_pointer_reads_single_modes(anew):
    page = anew(BEAM)
    page.turn_to("Numbers")
    hand = Hand(page, "Dispersion")
    wavenumber, frequency = page.evaluate(
        "() => { const { modeWavenumbers: k, modeFrequencies: w } = strikewave.page.frame; return [k[2], w[2]]; }"
    )
    place = """([x, y]) => { const { chart } = strikewave.page.beam.dispersion;
      const { left, top } = chart.area.getBoundingClientRect();
      return [left + chart.px(x), top + chart.py(y * chart.factor)]; }"""
    hand.mouse.move(*page.evaluate(place, [wavenumber, frequency / (2 * np.pi)]))
    across, up = (float(NUMBER.search(line)[0]) for line in hand.tip.splitlines())
    assert (across, 1e3 * up) == pytest.approx((wavenumber, frequency / (2 * np.pi)), rel=2e-3)


def test_keys_move_the_clock_and_zoom_and_say_what_is_there(anew):
    page = anew()
    hand, duration, t = Hand(page, "Contact force"), page.evaluate(DURATION), page.evaluate(TIME)
    hand.area.focus()
    spoken = hand.root.locator("[aria-live=polite]")
    page.tab.keyboard.press("ArrowRight")
    assert page.evaluate(TIME) == pytest.approx(t + duration / 200)
    expect(spoken).to_contain_text("exact waves")
    page.tab.keyboard.press("Shift+ArrowLeft")
    assert page.evaluate(TIME) == pytest.approx(t - 9 * duration / 200)
    page.tab.keyboard.press("+")
    low, high = page.evaluate(VIEW)
    assert high - low == pytest.approx(0.6 * duration)
    assert low <= page.evaluate(TIME) <= high
    expect(spoken).to_contain_text("shown from")
    for _ in range(4):
        page.tab.keyboard.press("Shift+ArrowRight")
    page.tab.keyboard.press("End")
    page.tab.keyboard.press("Shift+ArrowRight")  # beyond what is in view: the view follows
    assert page.evaluate(VIEW)[1] == pytest.approx(page.evaluate(TIME))
    page.tab.keyboard.press("-")
    assert page.evaluate(VIEW) == [0, pytest.approx(duration)]
    page.tab.keyboard.press("+")
    page.tab.keyboard.press("0")
    assert page.evaluate(VIEW) == [0, duration]


def test_keys_read_points_where_there_is_no_clock(anew):
    page = anew(BEAM)
    page.turn_to("Numbers")
    hand = Hand(page, "Dispersion")
    hand.area.focus()
    page.tab.keyboard.press("ArrowRight")
    first = hand.tip
    page.tab.keyboard.press("ArrowRight")
    expect(hand.root.locator(".tip")).not_to_have_text(first)
    assert "1/m" in hand.root.locator("[aria-live=polite]").inner_text()


@pytest.mark.parametrize("name", ["Where the waves are", "Contact force"])
def test_a_chart_can_be_saved(anew, tmp_path, name):
    page = anew()
    hand = Hand(page, name)
    for kind in ("PNG", "SVG"):
        hand.root.get_by_role("button", name=f"{name}: zoom, numbers, files").click()
        with page.tab.expect_download() as download:
            hand.root.get_by_role("button", name=f"Save as {kind}").click()
        assert download.value.suggested_filename == f"strikewave-{name.lower().replace(' ', '-')}.{kind.lower()}"
        download.value.save_as(tmp_path / kind)
    width = int(hand.area.bounding_box()["width"])
    size = np.frombuffer((tmp_path / "PNG").read_bytes()[16:24], ">u4")
    assert size[0] == 2 * width and size[1] > 200
    text = (tmp_path / "SVG").read_text()
    found = page.evaluate(
        """(text) => {
          const { documentElement: root } = new DOMParser().parseFromString(text, 'image/svg+xml');
          const texts = [...root.querySelectorAll('text')].map((each) => each.textContent);
          return { name: root.nodeName, texts, drawn: root.querySelectorAll('path, image').length };
        }""",
        text,
    )
    assert found["name"] == "svg" and found["drawn"] > 3
    assert {name, "0.5"} <= set(found["texts"])
    assert ("exact waves" in found["texts"]) == (name == "Contact force")


def test_the_numbers_can_be_read_as_a_table(anew):
    page = anew()
    hand = Hand(page, "Contact force")
    table = hand.root.get_by_role("table")
    expect(table.locator("tbody tr")).to_have_count(21)  # also where it is not seen
    assert table.bounding_box()["width"] * hand.root.locator(".numbers").bounding_box()["width"] < 2000
    hand.root.get_by_role("button", name="Contact force: zoom, numbers, files").click()
    hand.root.get_by_role("button", name="Show the numbers").click()
    expect(table.locator("thead")).to_contain_text("exact waves")
    first = table.locator("tbody tr").first.locator("td").all_inner_texts()
    assert first[:2] == ["0.000 T", "36.66 kN"]  # sigma_0 A, thesis (4.9)
    assert hand.root.locator(".numbers").bounding_box()["height"] > 100
    hand.root.get_by_role("button", name="Contact force: zoom, numbers, files").click()
    hand.root.get_by_role("button", name="Hide the numbers").click()
    expect(hand.root.get_by_role("button", name="Hide the numbers")).to_have_count(0)


CUT = """() => [...strikewave.page.root.querySelectorAll('.chart-head')]
  .filter((head) => head.offsetParent)
  .flatMap((head) => [...head.querySelectorAll('h2, .unit, .key, .readout')].filter((each) => {
    const [inner, outer] = [each, head].map((one) => one.getBoundingClientRect());
    return inner.right > outer.right + 0.5 || inner.bottom > outer.bottom + 0.5;
  })).map((each) => each.textContent)"""


@pytest.mark.parametrize("opened", [{"method": "modal"}, {"scene": BEAM}], ids=str)
def test_legends_wrap_instead_of_being_cut(anew, opened):
    page = anew(**opened)
    for width in (1440, 820, 390):
        page.resize(width, 900)
        page.fits(width)
        assert page.evaluate(CUT) == [], width


def test_a_zoomed_picture_of_a_beam_is_computed_anew(anew):
    page = anew(BEAM)
    hand = Hand(page, "How bending runs along")
    drawn = "() => strikewave.page.beam.spaceTime.chart.content.picture.x"
    hand.drag(0.1, 0.2)
    page.wait(f"() => ({drawn})()[0] === ({VIEW})()[0] && ({drawn})()[1] === ({VIEW})()[1]")
    page.tab.mouse.dblclick(*hand.at(0.5))
    page.wait(f"() => ({drawn})()[1] === ({DURATION})()")


def test_motions_forces_and_pictures_of_rods_are_sampled_for_what_is_in_view(anew):
    anew("free-rod")
    page = anew()  # by another message than that which other tests may have looked at closely
    count = """() => { const { axial: { axis, displacements } } = strikewave.page, [low, high] = axis.view;
      return Array.from(displacements.chart.content.series[0].x).filter((t) => t >= low && t <= high).length; }"""
    page.evaluate("() => strikewave.page.zoom(1.99, 2.01)")
    assert page.evaluate(count) < 5
    page.wait("() => strikewave.page.closer.frame === strikewave.page.frame")
    assert page.evaluate(count) > 250
    seen = "() => strikewave.page.axial.spaceTime.chart.content.picture.x"
    page.wait(f"() => ({seen})()[0] > 1.9")
    assert page.evaluate(seen) == page.evaluate("() => strikewave.page.axial.axis.view")


@pytest.mark.parametrize("size", [(1440, 900), (390, 844)])
def test_values_at_the_clock_stand_beside_the_names_of_their_curves(anew, size):
    page = anew(method="modal", size=size)
    page.evaluate("() => strikewave.page.player.go(0.36)")
    if page.evaluate("() => strikewave.page.layout.tabbed"):
        page.turn_to("Charts")
    chart = page.tab.locator(".chart:visible", has_text="Contact force").first
    for name, value in (("exact waves", "17.8"), ("modes", "15.6")):
        key = chart.locator(".key", has_text=name)
        expect(key.locator("output")).to_have_text(value)
        expect(key).to_be_visible()
    page.evaluate("() => strikewave.page.player.go(1.2)")
    expect(chart.locator(".key", has_text="exact waves").locator("output")).not_to_have_text("17.8")
    page.fits(size[0])
