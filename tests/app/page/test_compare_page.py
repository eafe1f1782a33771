"""Solutions that are kept: overlaid, told beside the one that is shown, and drawn beside it."""

import re

import numpy as np
import pytest
from playwright.sync_api import TimeoutError as TooLate
from playwright.sync_api import expect

import solvers
from app.choices.choices import Choices
from app.choices.scene_of import choices_of, chosen_scene

from .test_page import settled

KEEP = "() => { strikewave.page.compare.keep(); return strikewave.page.compare.runs.length; }"
LAID = """() => strikewave.page.view.stack.charts.map(([, { content }]) =>
  content.series.map(({ name }) => name).filter((name) => /^[A-H]/.test(name ?? '')))"""
MAX_KEPT = 100_000  # bytes
WIDE, PHONE = (1440, 900), (390, 844)


def ask(page, question: str) -> None:
    """Two clicks: a ready-made comparison, answered. The list closes where a page that is laid out takes the focus,
    as may happen on a busy machine: then it is opened again."""
    for patience in (5_000, 5_000, 30_000):
        page.tab.get_by_role("button", name="Compare", exact=True).click()
        try:
            page.tab.get_by_role("button", name=question).click(timeout=patience)
            break
        except TooLate:
            if patience > 5_000:
                raise
    page.wait("() => strikewave.page.compare.runs.length && !strikewave.page.changes.goal && !strikewave.page.asked")


def set_and_wait(page, **settings) -> None:
    for name, value in settings.items():
        page.answered(
            lambda name=name, value=value: page.evaluate(f"() => strikewave.page.choose('{name}', {value!r})")
        )


def peak_force(scene: str, **changed) -> float:
    chosen = Choices(**({"scene": scene} | choices_of(scene) | changed)).chosen()
    return solvers.solve(chosen_scene(chosen)).peak_force


@pytest.mark.parametrize(
    "scene, question, name, first, second, size, other",
    [
        ("fixed-rod", "5 or 100 modes?", "modes", 5, 100, WIDE, PHONE),
        ("fixed-rod", "Hertz or rigid?", "law", "rigid", "hertz", PHONE, WIDE),
        ("fixed-rod", "Does a heavier hammer hit harder?", "mass_ratio", 1, 0.25, WIDE, PHONE),
        ("hammer-on-cantilever", "5 or 100 modes?", "modes", 5, 100, PHONE, WIDE),
        ("stepped-rod", "Hertz or rigid?", "law", "rigid", "hertz", WIDE, PHONE),
        ("figure-10.4", "Clamped or free modes?", "floating_frame", "mean-axis", "attached", WIDE, PHONE),
        ("figure-10.12", "Pinned or clamped shapes?", "shapes", "pinned-free", "clamped-free", WIDE, PHONE),
        (
            "figure-9.11",
            "Does it matter that the pendulum bends?",
            "scene",
            "figure-9.2",
            "figure-9.11",
            PHONE,
            WIDE,
        ),
        ("brick-off-centre", "With and without loss?", "restitution", 1, 0, PHONE, WIDE),
    ],
)
def test_a_question_is_answered_in_two_clicks(anew, scene, question, name, first, second, size, other):
    page = anew(scene, size)
    ask(page, question)
    assert page.evaluate("() => strikewave.page.compare.runs[0].frame.chosen")[name] == first
    assert page.header("chosen")[name] == second
    told = page.tab.locator(".tab-panel .compared").first
    expect(told).to_be_visible()
    expect(told.locator("li").first).to_contain_text("instead of")
    page.fits(size[0])
    page.resize(*other)
    page.fits(other[0])


def test_what_is_being_solved_for_a_question_is_not_called_the_same(anew):
    """Where the first setting is what is shown, and the second has yet to be compiled."""
    page = anew()
    said = page.evaluate(
        """() => {
          const { compare } = strikewave.page;
          compare.ask({ question: 'law', first: { law: 'rigid' }, between: [], second: { law: 'hertz' } });
          return [compare.summary.root.textContent, compare.bar.row.textContent];
        }"""
    )
    for words in said:
        assert "Hertz: being solved" in words and "same" not in words
    expect(page.tab.locator(".compared:visible")).to_contain_text("instead of")
    expect(page.tab.locator(".runs")).not_to_contain_text("being solved")


def test_on_a_phone_a_kept_run_can_be_removed(anew):
    page = anew(size=PHONE)
    ask(page, "Is restitution a constant?")
    expect(page.tab.locator(".tab-panel .teaches").first).to_contain_text("Restitution e is the speed at which")
    box = page.tab.get_by_role("button", name="Remove A").bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= 390
    page.fits(390)


def test_a_heavier_hammer_hits_harder_and_the_percentage_is_right(anew):
    page = anew()
    ask(page, "Does a heavier hammer hit harder?")
    change = peak_force("fixed-rod", mass_ratio=0.25) / peak_force("fixed-rod") - 1.0
    first = page.tab.locator(".compared li").first
    expect(first).to_contain_text(re.compile(rf"^peak force .*\skN instead of .*\skN: {100 * change:.0f}\s%\smore$"))
    page.turn_to("Numbers")
    row = page.tab.locator(".compared tr", has_text="peak force")
    back = 1.0 / (1.0 + change) - 1.0
    expect(row).to_contain_text(f"−{-100 * back:.0f} %")


def test_keeping_sends_nothing_and_keeps_no_more_than_it_must(anew):
    page = anew("hammer-on-cantilever")
    for count, ratio in enumerate((1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0), start=1):
        set_and_wait(page, mass_ratio=ratio)
        before = page.quiet()
        assert page.evaluate(KEEP) == count
        assert page.quiet() == before
    assert max(page.evaluate("() => strikewave.page.compare.runs.map(({ bytes }) => bytes.byteLength)")) <= MAX_KEPT
    expect(page.tab.get_by_role("button", name="Keep", exact=True)).to_be_disabled()
    set_and_wait(page, mass_ratio=16.0)
    assert page.evaluate(KEEP) == 8
    expect(page.tab.locator(".toast")).to_contain_text("remove one first")
    names = page.evaluate(LAID)
    assert {*"ABCDEFGH"} <= {*names[1]} and {*"ABCDEFGH"} <= {*names[2]}
    page.tab.get_by_role("button", name="Remove B").click()
    assert page.evaluate(KEEP) == 8  # in its place
    assert page.evaluate("() => strikewave.page.compare.runs.map(({ letter }) => letter).join('')") == "ABCDEFGH"


def test_the_same_solution_is_kept_once(anew):
    page = anew()
    assert page.evaluate(KEEP) == 1
    page.tab.keyboard.press("k")
    expect(page.tab.locator(".toast")).to_contain_text("already, as A")
    assert page.evaluate("() => strikewave.page.compare.runs.length") == 1


def test_overlays_have_the_units_of_the_chart(anew):
    """A kept rod over a chain with a round trip, an impedance and a duration of its own."""
    page = anew()
    page.evaluate(KEEP)
    set_and_wait(page, scene="stepped-rod")
    kept = page.evaluate(
        """() => { const { compare, frame, view } = strikewave.page, { frame: old } = compare.runs[0];
          const [laid] = view.force.chart.laid, top = (y) => y.reduce((a, b) => Math.max(a, b));
          return { end: laid.x.at(-1) * frame.trip, most: top(laid.y), trip: old.trip, duration: old.duration,
            expected: top(old.exactForce) * old.forceUnit, whole: view.axis.whole[1], now: frame.duration } }"""
    )
    assert kept["end"] == pytest.approx(kept["duration"] * kept["trip"], rel=1e-5)
    assert kept["most"] == pytest.approx(kept["expected"], rel=1e-6)
    assert kept["whole"] >= kept["now"]


def test_two_pictures_run_by_one_clock_in_one_scale(anew):
    page = anew()
    page.evaluate(KEEP)
    set_and_wait(page, speed=2.0)
    page.tab.get_by_role("button", name="show it beside in the picture").click()
    second = page.tab.locator(".beside .stage canvas")
    expect(second).to_be_visible()
    page.frames_pass(3)  # in which both are drawn at their sizes
    ends = page.evaluate(
        """() => { const { compare: { second: { stage: b } }, axial: { stage: a } } = strikewave.page;
          const ends = [a, b].map(({ largest, frame }) => largest * frame.stressUnit);
          return [...ends, a.reach, b.reach, a.factor, b.factor]; }"""
    )
    assert ends[0] == pytest.approx(ends[1]) and ends[2] == ends[3] and ends[4] == ends[5]
    before = page.picture()
    page.evaluate("() => strikewave.page.player.seek(1.2)")
    after = page.picture()
    assert sum(a != b for a, b in zip(before, after, strict=True)) >= 2
    page.tab.get_by_role("button", name="show it beside in the picture").click()
    expect(second).to_be_hidden()


@pytest.mark.parametrize("scene", ["hammer-on-cantilever", "brick-off-centre", "two-balls"])
def test_other_scenes_are_drawn_beside(anew, scene):
    page = anew(scene)
    page.evaluate(KEEP)
    set_and_wait(page, speed=2.0)
    page.evaluate("() => strikewave.page.compare.standBeside(strikewave.page.compare.runs[0])")
    expect(page.tab.locator(".beside .stage canvas")).to_be_visible()
    page.turn_to("Numbers")
    expect(page.tab.locator(".compared table").last).to_contain_text("%")


def test_locked_axes_tell_speeds_apart(anew):
    """Unlocked, the force at twice the speed is the same picture with other numbers."""
    page = anew()
    range_ = "() => { const { chart } = strikewave.page.axial.force; return chart.y.map((y) => y / chart.factor); }"
    ends = "() => { const { stage } = strikewave.page.axial; return stage.largest * stage.frame.stressUnit; }"
    before, colours = page.evaluate(range_), page.evaluate(ends)
    page.tab.get_by_role("button", name="Compare", exact=True).click()
    page.tab.get_by_role("button", name="Lock axes and colours").click()
    set_and_wait(page, speed=0.5)
    assert np.allclose(page.evaluate(range_), before, rtol=1e-12)
    assert page.evaluate(ends) == pytest.approx(colours)
    page.tab.get_by_role("button", name="Locked").click()
    settled(page)
    assert page.evaluate(range_)[1] == pytest.approx(0.5 * before[1])


def test_going_back_to_a_kept_solution_sets_its_sliders(anew):
    page = anew()
    page.evaluate(KEEP)
    set_and_wait(page, scene="free-rod")
    set_and_wait(page, mass_ratio=3.0)
    page.tab.get_by_role("button", name="A: go back to these settings").click()
    page.wait("() => strikewave.page.frame.chosen.scene === 'fixed-rod' && !strikewave.page.changes.goal")
    assert page.header("chosen")["mass_ratio"] == 1.0
    expect(page.tab.get_by_label("Mass ratio, exact value")).to_have_value("1")


def test_going_back_to_another_support_takes_the_struck_place_with_it(anew):
    """Which the support now chosen does not allow, as they are set one by one."""
    page = anew("hammer-on-cantilever")
    page.evaluate("() => strikewave.page.compare.keep()")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('support', 'pinned-pinned')"))
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('place', 0.3)"))
    page.evaluate("() => { strikewave.page.toast.root.hidden = true; }")
    page.answered(lambda: page.tab.get_by_role("button", name="A: go back to these settings").click())
    page.wait("() => strikewave.page.frame.chosen.support === 'cantilever' && !strikewave.page.changes.goal")
    assert page.header("chosen")["place"] == 1.0
    assert page.evaluate("() => strikewave.page.toast.root.hidden")


def test_eight_kept_leave_stage_clock_and_buttons_in_view(anew):
    page = anew()
    for ratio in (0.5, 0.25, 2.0, 4.0, 3.0, 0.125, 0.75, 8.0):
        set_and_wait(page, mass_ratio=ratio)
        page.evaluate(KEEP)
    set_and_wait(page, law="hertz")
    page.evaluate("() => strikewave.page.compare.standBeside(strikewave.page.compare.runs[1])")
    overflow = (
        "() => { const { scrollWidth, clientWidth } = strikewave.page.player.root; return scrollWidth - clientWidth; }"
    )
    for size in (WIDE, (1280, 720), (820, 1180), PHONE):
        page.resize(*size)
        page.fits(size[0])
        for name in ("Play", "Compare"):
            box = page.tab.get_by_role("button", name=name, exact=True).bounding_box()
            assert box["x"] >= 0 and box["x"] + box["width"] <= size[0] and box["y"] + box["height"] <= size[1], size
        assert page.evaluate(overflow) <= 0, size
