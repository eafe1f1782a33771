"""A scene that a hand has changed is shown as it has become: its time, its clock, its words, not those it came with."""

import pytest
from playwright.sync_api import expect

DROP = (  # a mass of 2 kg from 0.75 m on a simply supported strip of steel, behind a pad
    "?scene=hammer-on-cantilever&target.length=1.2&target.section.width=0.06&target.section.height=0.01"
    "&impactor.mass=2&speed=3.835&support=pinned-pinned&place=0.5&law=linear&linear_stiffness=380000"
)
VIEW = "() => strikewave.page.view.axis.view"
PLAYER = """() => {
  const { player, range, view } = { ...strikewave.page, range: strikewave.page.range() };
  const { bar, scrub, start, t } = player;
  return { bar, range, t, share: Number(scrub.value) / Number(scrub.max) };
}"""


def typed(page, name: str, value: str) -> None:
    """A number, typed into the field of a control and left by Tab."""
    field = page.tab.locator(f".field-{name} input[type=text], .field-{name} input[type=number]").first
    field.click()
    field.press("ControlOrMeta+a")
    field.press_sequentially(value)
    page.answered(lambda: field.press("Tab"))


def test_the_whole_impact_of_a_changed_scene_is_in_view(open_page):
    page = open_page(f"{DROP}&layout=laboratory")
    assert page.evaluate(VIEW) == [0, page.header("duration")]
    contacts = page.evaluate("() => strikewave.page.frame.contacts.map(([, end]) => end)")
    assert len(contacts) == 3 and 0.04 < contacts[-1] < page.evaluate(VIEW)[1]
    expect(page.tab.get_by_role("button", name="Show the whole impact")).to_be_hidden()


@pytest.mark.parametrize("scene", ["hammer-on-cantilever", "figure-6.9"])
def test_what_a_scene_is_opened_on_is_left_once_it_is_changed(open_page, scene):
    page = open_page(f"?scene={scene}&layout=laboratory")
    until = page.evaluate("() => strikewave.page.frame.opens.until")
    before = page.evaluate("() => strikewave.page.frame.chosen.speed")
    assert page.evaluate(VIEW)[1] == pytest.approx(until / page.evaluate("() => strikewave.page.frame.trip"))
    typed(page, "speed", f"{1.5 * before:g}")
    assert page.evaluate(VIEW) == [0, page.header("duration")]
    typed(page, "speed", f"{before:g}")
    assert page.evaluate(VIEW)[1] < page.header("duration")


@pytest.mark.parametrize("scene", ["fixed-rod", "four-bar"])
def test_a_stretch_that_a_hand_has_chosen_stays_in_view(open_page, scene):
    page = open_page(f"?scene={scene}&layout=laboratory")
    end = page.evaluate(VIEW)[1]
    chosen = [0.25 * end, 0.5 * end]
    page.evaluate("stretch => strikewave.page.view.axis.show(stretch)", chosen)
    typed(page, "speed", f"{1.3 * page.evaluate('() => strikewave.page.frame.chosen.speed'):g}")
    assert page.evaluate(VIEW) == pytest.approx(chosen)


@pytest.mark.parametrize("loops", [True, False])
def test_the_bar_of_the_clock_spans_what_plays(open_page, loops):
    """The clock ends, or begins again, where its bar ends; from beyond, the bar is all there is."""
    page = open_page("?scene=hammer-on-cantilever&layout=laboratory")
    end = page.evaluate(VIEW)[1]
    assert end < page.header("duration")
    if not loops:
        page.tab.keyboard.press("l")
    page.evaluate("end => strikewave.page.player.seek(0.98 * end)", end)
    page.evaluate("() => { strikewave.seen = []; strikewave.page.player.pace.speed = 3; }")
    watch = f"""() => {{
      const look = () => {{ strikewave.seen.push(({PLAYER})()); requestAnimationFrame(look); }};
      look();
    }}"""
    page.evaluate(watch)
    page.tab.keyboard.press(" ")
    again = "(end) => strikewave.seen.some(({ t }, k, all) => k && t < 0.9 * end && all[k - 1].t === end)"
    page.wait(again if loops else "(end) => !strikewave.page.player.playing && strikewave.page.player.t === end", end)
    assert max(each["t"] for each in page.evaluate("() => strikewave.seen")) == end
    if loops:
        page.tab.keyboard.press(" ")
    page.evaluate("() => strikewave.page.player.jump(1)")
    page.evaluate("() => strikewave.page.player.seek(strikewave.page.player.duration * 0.9)")
    found = page.evaluate(PLAYER)
    assert found["bar"] == [0, page.header("duration")] and found["share"] == pytest.approx(0.9, abs=1e-3)
    page.evaluate("() => { strikewave.seen.length = 0; }")
    page.tab.keyboard.press(" ")
    page.wait("(t) => strikewave.page.player.t > t", found["t"])
    for each in page.evaluate("() => strikewave.seen"):
        low, high = each["bar"]
        assert each["share"] == pytest.approx((each["t"] - low) / (high - low), abs=2e-3)


@pytest.mark.parametrize("layout", ["laboratory&tab=numbers&panel=code", "opening"])
def test_nothing_is_said_of_the_scene_as_it_came(open_page, layout):
    page = open_page(f"{DROP}&layout={layout}")
    own = page.evaluate("() => [strikewave.page.frame.title, strikewave.page.frame.note, strikewave.page.frame.source]")
    assert all(own)
    page.wait("() => strikewave.page.story.numbers.textContent.includes('Stiffness')")
    said = page.evaluate("""() => {
      const { analyses, controls, root, story } = strikewave.page;
      const shown = [...root.querySelectorAll('.closer, .topbar, .ask, .code-part pre')].map((e) => e.textContent);
      return [...shown, story.root.textContent, story.numbers.textContent].join('\\n');
    }""")
    assert not [each for each in (*own, "five contacts", "Thesis 8.4", "3.7 %") if each in said]
    expect(page.tab.locator(".field-scene .title")).to_have_text("Hammer on the end of a cantilever (changed)")
    assert "Changed from the scene “Hammer on the end of a cantilever”: " in said
    if "code" in layout:
        head = said.split("[impactor]")[0]
        assert 'title = "Hammer on the end of a cantilever (changed)"' in head and "note = " not in head


STATIC = "() => strikewave.page.view.motion.chart.content.series.map(({ name }) => name)"


def test_the_quasi_static_line_is_named_by_its_model_and_absent_where_it_says_nothing(open_page):
    page = open_page(f"{DROP}&layout=laboratory")  # the contact is all that gives way there: the beam stands still
    assert not [name for name in page.evaluate(STATIC) if "static" in name]
    assert page.evaluate("() => strikewave.page.view.stage.predicts") is False
    typed(page, "mass_ratio", "0.2")  # and here the beam, too
    page.wait("() => strikewave.page.frame.chosen.mass_ratio === 0.2 && !strikewave.page.asked")
    page.wait("() => strikewave.page.frame.staticModel && !strikewave.page.own.made.has(strikewave.page.frame)")
    assert page.evaluate("() => strikewave.page.frame.staticModel").startswith("structural")
    assert "quasi-static structure" in page.evaluate(STATIC)


def test_the_scale_of_colours_says_where_it_ends_before_the_largest(open_page):
    page = open_page(f"{DROP}&layout=opening")
    end, most = page.evaluate("""() => {
      const { stage, field } = strikewave.page.view;
      return [stage.usual.moment, field.largest.moment].map((value) => value * stage.stressUnit);
    }""")
    assert end < 0.8 * most
    drawn = """() => {
      const found = [], { fillText } = CanvasRenderingContext2D.prototype;
      CanvasRenderingContext2D.prototype.fillText = function (words, ...at) {
        found.push(words);
        fillText.call(this, words, ...at);
      };
      strikewave.page.redraw();
      CanvasRenderingContext2D.prototype.fillText = fillText;
      return found;
    }"""
    assert f"± {end:.3g} MPa" in [words.replace("\u00a0", " ") for words in page.evaluate(drawn)]
    assert page.evaluate("() => strikewave.page.view.stage.beyond")  # its ends are pointed


@pytest.mark.parametrize("layout", ["laboratory", "docks"])
def test_the_table_of_a_sensitivity_is_seen_whole_in_a_dock_of_usual_width(open_page, layout):
    page = open_page(f"{DROP}&layout={layout}&panel=trust")
    page.wait("() => strikewave.page.analyses.trust.table.rows.length > 3")
    sizes = "() => { const { parentElement: { clientWidth, scrollWidth } } = strikewave.page.analyses.trust.table; "
    page.wait(f"{sizes} return clientWidth > 200 && scrollWidth <= clientWidth; }}")
