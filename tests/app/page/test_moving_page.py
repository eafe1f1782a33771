"""A mechanism that moves on, on the stage: by the page's clock, its impacts, what it bears, how long, and its link."""

from playwright.sync_api import expect
from pytest import approx

from .test_access_page import findings
from .test_page import settled

STAGE = "strikewave.page.mechanism.stage"
TURNED = f"() => {STAGE}.mechanism.placed[0].at(-1)"


def test_the_links_go_far_on_the_stage_by_the_clock_of_the_page(open_page):
    page = open_page("?scene=bouncing-on-piston&panel=motion&seconds=0.6")  # as older links say it
    assert page.header("main")["name"] == "multibody" and page.header("duration") == approx(0.6)
    for name in ("Reactions at the joints", "Energy"):
        expect(page.tab.get_by_role("heading", name=name, exact=True)).to_be_visible()
    expect(page.tab.get_by_role("heading", name="Contact force")).to_be_hidden()
    assert findings(page) == []
    first = page.evaluate(TURNED)
    for _ in range(2):  # to the second impact
        page.tab.locator("body").press("]")
    second = page.evaluate("() => strikewave.page.frame.contacts[1][0]")
    assert page.evaluate("() => strikewave.page.player.t") == approx(second, rel=1e-4)
    assert page.evaluate(TURNED) != first
    gap = page.evaluate(
        f"""() => {{ const {{ mechanism }} = {STAGE}, {{ held, placed, linkage }} = mechanism;
          const face = placed[linkage.struck][0][1] - 0.5 * mechanism.thick(linkage.struck);
          return face - held.y - held.height / 2; }}"""
    )
    assert abs(gap) < 3  # pixels between mass and piston as they meet
    assert page.tab.locator(".ticks i").count() == page.header("main")["contacts"]
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('motion_seconds', 0.3)"))
    assert page.header("duration") == approx(0.3)
    settled(page)
    assert "motion_seconds=0.3" in page.evaluate("() => location.search")
    page.turn_to("Numbers")
    expect(page.tab.get_by_role("columnheader", name="at ground – crank")).to_be_visible()


def test_a_link_that_bends_is_drawn_bent_larger_and_the_mass_meets_it_there(open_page):
    page = open_page("?scene=four-bar-moves&motion_seconds=0.06")
    page.evaluate("() => strikewave.page.player.go(strikewave.page.frame.contacts[4][0])")
    shown = page.evaluate(f"() => ({{ factor: {STAGE}.mechanism.factor, words: {STAGE}.mechanism.scaleWords }})")
    assert shown["factor"] > 1 and f"bending drawn × {shown['factor']:g}" in shown["words"]
    apart = page.evaluate(
        f"""() => {{ const {{ mechanism }} = {STAGE}, {{ held, placed, linkage }} = mechanism;
          const [x, y] = placed[linkage.struck].at(-1);
          return Math.hypot(held.x - x, held.y - y) - (held.width + mechanism.thick(linkage.struck)) / 2 - 1; }}"""
    )
    assert abs(apart) < 3  # pixels, of a bar that is struck at its tip
    expect(page.tab.get_by_role("button", name="velocity", exact=True)).to_be_hidden()
    expect(page.tab.get_by_label("Links that bend")).to_be_visible()
    said = page.tab.get_by_text("The solve took")
    for seconds in (0.05, 0.25):  # as it may take for longer
        page.evaluate(
            """took => { const { frame, mechanism } = strikewave.page; frame.main.diagnostics.wall_time = took;
            mechanism.story.load(frame); }""",
            seconds,
        )
        expect(said).to_have_count(int(seconds > 0.1))
    steps = page.header("main")["diagnostics"]["steps"]
    expect(said).to_contain_text(
        f"The solve took 250 ms: it takes {steps} steps, short enough for the fastest vibration"
    )
    page.answered(lambda: page.tab.get_by_label("Method", exact=True).select_option("modal"))
    expect(page.tab.get_by_label("Links that bend")).to_be_hidden()
    expect(page.tab.get_by_role("heading", name="Contact force")).to_be_visible()


def test_it_plays_as_it_opens_and_fits_on_a_phone(open_page):
    page = open_page("?scene=slider-crank&method=multibody", size=(390, 844), reduced_motion="no-preference")
    page.fits(390)
    page.wait("() => strikewave.page.player.playing && strikewave.page.player.t > 0")


def test_moments_at_joints_and_pivots_have_their_charts(open_page):
    page = open_page("?scene=rotating-bar")
    chart = "strikewave.page.mechanism.reactions.chart"
    assert page.evaluate(f"() => {chart}.content.series.map(({{ name }}) => name)") == ["ground – bar", "rigid links"]
    page.tab.get_by_role("button", name="Unfold: Reactions at the joints").click()
    page.tab.locator(".chart:not(.late)").get_by_role("button", name="moment", exact=True).last.click()
    assert page.evaluate(f"() => {chart}.content.unit") == "N m"
    page.show_scene("figure-10.11")
    expect(page.tab.get_by_role("heading", name="Bending moments")).to_be_visible()
    page.show_scene("fixed-rod")
    expect(page.tab.get_by_role("heading", name="Bending moments")).to_be_hidden()


def test_links_beside_the_struck_one_show_their_waves(open_page):
    page = open_page("?scene=bent-rods")
    coloured = page.evaluate(
        """() => { const { stage } = strikewave.page.mechanism, { mechanism } = stage;
          strikewave.page.player.go(3e-4);
          const ratio = stage.canvas.width / stage.canvas.clientWidth, c = stage.canvas.getContext('2d');
          return [0.3, 0.5, 0.7].map((share) => { const [x, y] = mechanism.along(1, share);
            const [r, , b] = c.getImageData(x * ratio, y * ratio, 1, 1).data; return Math.abs(r - b); }); }"""
    )
    assert max(coloured) > 40  # grey links have next to none


def test_no_name_lies_under_the_mass(open_page):
    page = open_page("?scene=bouncing-on-piston", size=(390, 844))
    under, read = page.evaluate(
        f"""() => {{ const {{ mechanism: {{ stage }}, player }} = strikewave.page, {{ mechanism }} = stage;
          const context = CanvasRenderingContext2D.prototype, {{ fillText }} = context;
          const names = mechanism.linkage.links.map(({{ name }}) => name), under = new Set(), read = new Set();
          let written = [];
          context.fillText = function (text, x, y) {{
            const {{ width }} = this.measureText(text);
            if (this.canvas === stage.canvas && names.includes(text)) written.push([text, x, y, width]);
            return fillText.call(this, text, x, y); }};
          for (let k = 0; k <= 100; k++) {{
            written = [];
            player.go((k / 100) * player.duration);
            const {{ held }} = {STAGE}.mechanism;
            for (const [text, x, y, width] of written) {{
              read.add(text);
              const apart = held && [Math.abs(x - held.x) - held.width / 2, Math.abs(y - held.y) - held.height / 2];
              if (apart && apart[0] < width / 2 && apart[1] < 5) under.add(text); }} }}
          context.fillText = fillText;
          return [[...under], [...read]]; }}"""
    )
    assert under == [] and sorted(read) == ["crank", "piston", "rod"]


def test_a_stretch_in_view_is_sampled_for_it_so_that_an_impact_is_seen(open_page):
    page = open_page("?scene=four-bar-moves")
    impact = page.evaluate("() => strikewave.page.frame.contacts[2][0]")
    counts = """() => { const { frame, mechanism: { axis: { view: [low, high] } } } = strikewave.page;
      const within = (time) => Array.from(time).filter((t) => t >= low && t <= high).length;
      return ['time', 'reactionTime', 'energyTime'].map((name) => within(frame[name])); }"""
    page.evaluate(f"() => strikewave.page.zoom({impact - 1e-3}, {impact + 1e-3})")
    before = page.evaluate(counts)
    page.wait("() => strikewave.page.closer.part")
    after = page.evaluate(counts)
    assert before[1] <= 3 and before[2] <= 3 and after[1] > 10 and after[2] > 10 and after[0] > 400
    page.evaluate("() => strikewave.page.mechanism.motion.switch.root.querySelector('[data-kind=velocity]').click()")
    shown = page.evaluate("""() => { const { series } = strikewave.page.mechanism.motion.chart.content;
      return series.slice(0, 2).map(({ x, y }) => [Array.from(x), Array.from(y)]); }""")
    rates = page.evaluate("() => Array.from(strikewave.page.frame.rates.subarray(8, 12))")
    for body, (time, velocity) in enumerate(shown):
        at = next(k for k in range(len(time)) if time[k] == time[k + 1] == approx(impact, rel=1e-6))
        assert velocity[at : at + 2] == approx([rates[body], rates[2 + body]], rel=1e-5)
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('restitution', 0.6)"))  # another answer
    page.evaluate(f"() => strikewave.page.zoom({impact - 1e-3}, {impact + 1e-3})")  # the same is asked of it
    page.wait("() => strikewave.page.closer.frame === strikewave.page.frame")
    assert page.evaluate(counts)[1] > 10
    page.evaluate("() => strikewave.page.zoom()")
    assert page.evaluate("() => strikewave.page.frame.reactionTime.length") < 400
