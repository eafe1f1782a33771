"""Lessons of all kinds of scenes on the page: what is shown below the picture, what stands beside it, and when."""

import pytest
from playwright.sync_api import expect

from app.lessons.checking import check
from app.lessons.record import lesson_record

from .test_access_page import findings
from .test_lesson_page import READY, button, onwards, ready

CHOICE = """\
:::{choice} parts
[[option]]
text = "Once"
right = true
say = "It is so."
[[option]]
text = "Twice"
say = "It is not."
:::
"""
BEAM = (
    """\
## How often?
:::{scene}
show = ["bodies", "force", "indentation"]
play = [-0.1, "part"]
beside = { modes = 3 }
:::
A sphere falls on a beam.
"""
    + CHOICE
    + """
:::{after}
at = "touch-3"
:::
## Three modes
:::{scene}
show = ["bodies", "rows"]
at = "part-2"
beside = { speed = 0.02 }
:::
Twice as fast.
## Energy
:::{scene}
show = ["bodies", "energy"]
:::
Where it is.
## How fast?
:::{scene}
show = ["bodies", "force"]
:::
:::{set} fast
slider = "speed"
start = 0.01
range = [0.01, 0.1]
goal = "peak_force > 50"
not-yet = "Not yet: the last begins at {start}."
[[found]]
say = "So it is."
:::
"""
)
BALL = (
    """\
## Will it slide?
:::{scene}
show = ["bodies", "course"]
play = [-1, "stick"]
:::
A ball.
"""
    + CHOICE
    + """
## Friction
:::{scene}
show = ["bodies", "rows"]
:::
:::{set} rub
slider = "friction"
start = 0.05
range = [0, 1]
goal = "sticks = 1"
not-yet = "Not yet."
[[found]]
range = [0.35, 1]
say = "It sticks."
:::
"""
)
LINKS = """\
## Pins
:::{scene}
show = ["bodies", "rows"]
at = "part-2"
beside = { modes = 2 }
:::
A mass strikes a four-bar.
## Their forces
:::{scene}
show = ["bodies", "force", "reactions"]
:::
Forces.
"""
RODS = """\
## A chain
:::{scene}
show = ["bodies", "rows"]
at = "touch-2"
:::
Two bars and a specimen.
## Modes
:::{scene}
scene = "fixed-rod"
show = ["bodies", "force"]
at = "part"
beside = { method = "modal", modes = 20 }
:::
Modes beside waves.
"""
SETTLED = "() => !strikewave.page.changes.quiet && strikewave.page.opening.teaching.lesson.second.run"
CHARTS = "() => [...document.querySelectorAll('.lesson-charts > *')].map((each) => each.className.split(' ').at(-1))"
BESIDE = """() => {
  const { besides, tracks, shown } = strikewave.page.opening.section;
  const forces = shown.forces ?? tracks.find(({ track }) => track.force).track.series;
  return [besides.length, ...forces.map(({ cursor }) => cursor)];
}"""


@pytest.fixture
def taught(open_page, tmp_path):
    """Open a lesson of these steps, about this scene."""
    routed = []

    def opened(scene: str, text: str, **how):
        file = tmp_path / "tried.md"
        head = f"---\nlesson: tried\nversion: 1\nlanguage: en\ntitle: Tried\nscene: {scene}\n---\n"
        file.write_text(head + text, encoding="utf-8")
        found = check(file)
        assert found.problems == () and found.lesson
        page = open_page("liveness", drawn=False, **how)
        routed.append(page.tab)
        record = lesson_record(found.lesson)
        page.tab.route("**/lessons/tried*", lambda route: route.fulfill(json=record))
        page.tab.goto(f"http://{page.address}/?lesson=tried")
        page.wait(READY)
        ready(page)
        return page

    yield opened
    for tab in routed:
        tab.unroute_all()


def test_a_beam_has_charts_and_a_second_solution_behind_the_answer(taught):
    page = taught("timoshenko-1913-long", BEAM)
    page.wait(SETTLED)
    assert page.evaluate(CHARTS) == [] and page.evaluate("() => strikewave.page.compare.runs.length") == 0
    touch, part = page.evaluate("() => strikewave.page.frame.contacts[0].slice(0, 2)")
    assert page.evaluate("() => strikewave.page.player.limit") == pytest.approx(part - touch, rel=1e-6)
    page.tab.get_by_label("Once").check()
    button(page, "Show what happens").click()
    force, law = page.tab.locator(".lesson-charts .chart").all()
    expect(force.locator(".legend")).to_contain_text("3 modes")
    expect(law.locator(".legend")).to_contain_text("3 modes")
    third = page.evaluate("() => strikewave.page.frame.contacts[2][0]")
    assert page.evaluate("() => strikewave.page.player.t") == pytest.approx(third, rel=1e-6)
    onwards(page)
    page.wait(SETTLED)
    page.wait("() => strikewave.page.opening.section.besides.length")
    assert page.evaluate(CHARTS) == []
    assert page.evaluate(BESIDE) == [1, "0.01 m/s", "0.02 m/s"]
    onwards(page)
    expect(page.tab.locator(".lesson-charts .energy")).to_contain_text("Nothing is lost in the contact")
    assert page.evaluate("() => [strikewave.page.compare.runs.length, strikewave.page.model.energy_shown]") == [0, True]
    onwards(page)
    expect(page.tab.locator(".lesson-said").first).to_contain_text("the last begins at 2.")
    expect(page.tab.locator(".lesson-charts .chart")).to_have_count(1)
    assert page.evaluate("() => strikewave.page.model.energy_shown") is False
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('speed', 0.05)"))
    expect(page.tab.locator(".lesson-said").first).to_contain_text("So it is.")


LEFT = """() => {
  const { changes, opening: { teaching: { lesson } } } = strikewave.page;
  const look = () => (changes.quiet ? [lesson.enter(2), window.left = true] : setTimeout(look, 1));
  lesson.enter(1);
  look();
}"""


def test_a_step_may_be_left_while_what_is_beside_it_is_solved(taught):
    """As a presenter's remote does, or the browser's Back: the page waits for what nobody wants any more."""
    page = taught("timoshenko-1913-long", BEAM)
    page.wait(SETTLED)
    page.evaluate(LEFT)
    page.wait("() => window.left")
    ready(page)
    expect(page.tab.get_by_role("heading", name="Energy", exact=True)).to_be_visible()
    assert page.evaluate("() => [strikewave.page.changes.quiet, strikewave.page.root.inert]") == [False, False]
    assert page.header("chosen")["speed"] == page.evaluate("() => strikewave.page.changes.latest.chosen.speed") == 0.01


def test_a_ball_with_spin_has_the_clock_of_its_impulse(taught):
    page = taught("spinning-ball", BALL)
    stick = page.evaluate("() => strikewave.page.opening.teaching.lesson.events.stick")
    assert 0.9 < stick < 1.1
    reach = page.evaluate("() => { const { player } = strikewave.page; return player.limit + player.start; }")
    assert reach == pytest.approx(stick)
    page.tab.get_by_label("Once").check()
    button(page, "Show what happens").click()
    expect(page.tab.locator(".lesson-charts .chart")).to_contain_text("sticks")
    onwards(page)
    expect(page.tab.locator(".section")).to_be_visible()
    expect(page.tab.locator(".lesson-said")).to_contain_text("Not yet.")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('friction', 0.5)"))
    expect(page.tab.locator(".lesson-said")).to_contain_text("It sticks.")


def test_a_linkage_and_a_chain_have_rows_and_charts_one_below_the_other_on_a_phone(taught):
    page = taught("four-bar", LINKS)
    page.wait(SETTLED)
    assert not page.evaluate("() => strikewave.page.view.stage.diagrams")  # of which the lesson does not speak
    page.wait("() => strikewave.page.opening.section.besides.length")
    assert page.evaluate(BESIDE) == [1, "12 modes", "2 modes"]
    second = page.evaluate("() => strikewave.page.frame.contacts[1][1]")
    assert page.evaluate("() => strikewave.page.player.t") == pytest.approx(second, rel=1e-6)
    onwards(page)
    expect(page.tab.locator(".lesson-charts .chart")).to_have_count(2)
    page.resize(390, 844)
    page.fits(390)
    first, second = (each.bounding_box() for each in page.tab.locator(".lesson-charts .chart").all())
    assert second["y"] >= first["y"] + first["height"] and first["height"] > 200
    assert findings(page) == []
    button(page, "Back").click()
    ready(page)
    page.fits(390)
    page = taught("split-hopkinson", RODS)
    expect(page.tab.locator(".section")).to_be_visible()
    onwards(page)
    page.wait(SETTLED)
    legend = page.tab.locator(".lesson-charts .legend")
    expect(legend).to_contain_text("20 modes")
    expect(legend).not_to_contain_text("50 modes")  # which the page has beside exact waves otherwise


LAID = """() => [...strikewave.page.root.querySelectorAll('.lesson-row, .lesson-charts table')]
  .some((each) => each.checkVisibility())"""
HIDDEN = """() => [...strikewave.page.root.querySelectorAll('.lesson-charts .scroll')]
  .some(({ clientWidth, scrollWidth }) => scrollWidth > clientWidth)"""


@pytest.mark.parametrize(
    "lesson, step, language",
    [("a-ball-with-spin", 3, "es"), ("the-energy-left-ringing", 6, "es"), ("the-energy-left-ringing", 6, "en")],
)
def test_no_rule_of_access_is_broken_where_a_phone_is_full(open_page, lesson, step, language):
    """A button half behind the moves; a table that no key scrolls, whose last column is out of sight."""
    page = open_page(f"?lesson={lesson}&step={step}&language={language}", size=(390, 844), has_touch=True)
    ready(page)
    page.wait(LAID)
    page.frames_pass(2)
    assert findings(page) == []
    assert not page.evaluate(HIDDEN)


ARCS = """() => {
  const found = [];
  const context = strikewave.page.view.stage.canvas.getContext('2d');
  const { arc } = context;
  context.arc = function (x, y, radius, ...rest) {
    found.push(radius);
    return arc.call(this, x, y, radius, ...rest);
  };
  strikewave.page.redraw();
  strikewave.page.player.go(strikewave.page.player.t);
  delete context.arc;
  return [...new Set(found.map((radius) => Number(radius.toFixed(3))))].sort((a, b) => a - b);
}"""


def test_balls_are_as_large_as_their_masses(open_page):
    page = open_page("?lesson=what-an-impact-is&step=4")
    ready(page)
    for ratio in (3.0, 1.0):
        radii = page.evaluate(ARCS)
        assert max(radii) / min(radii) == pytest.approx(ratio ** (1 / 3), rel=1e-3)
        if ratio > 1.0:
            onwards(page, "Skip →")
