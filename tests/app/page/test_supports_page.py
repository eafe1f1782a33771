"""What supports exert, on the page: the wall of a rod, and the supports of beams."""

import numpy as np
import pytest
from playwright.sync_api import expect

from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.messages.transverse import main_solution

from .test_page import settled

UNFOLD = "() => strikewave.page.view.stack.buttons.at(-1).click()"
DRAWN = "() => strikewave.page.view.supports.chart.content.series.length > 0"
CURVES = """() => strikewave.page.view.supports.chart.content.series.map(({ x, y, name, factor }) =>
  [name, [...x].map((t) => t * strikewave.page.frame.trip), [...y].map((value) => value * factor)])"""


def test_the_wall_of_a_rod_bears_what_the_exact_waves_and_the_other_method_press_there(open_page):
    page = open_page()
    page.evaluate(UNFOLD)
    page.wait(DRAWN)
    expect(page.tab.get_by_role("heading", name="Force at the wall")).to_be_visible()
    (name, time, borne), (other, *_) = page.evaluate(CURVES)
    assert (name, other) == ("exact waves", "modes")
    scene = Request.of(own_choices("fixed-rod")).scene
    front = 2.0 * scene.target.impedance * scene.speed
    assert np.interp([0.49, 0.501], np.array(time) / scene.time_unit, borne) == pytest.approx([0.0, front], rel=0.01)
    page.evaluate("() => { strikewave.page.compare.keep(); }")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('speed', 2)"))
    settled(page)
    names = "() => strikewave.page.view.supports.chart.content.series.map(({ name }) => name)"
    assert page.evaluate(names) == ["exact waves", "modes", "A"]
    page.show_scene("free-rod")
    assert page.evaluate("() => strikewave.page.view.supports.chart.root.hidden")


@pytest.mark.parametrize("name", ["figure-8.18", "figure-8.19"])
def test_a_figure_is_opened_on_the_force_at_its_clamp(open_page, name):
    page = open_page("")
    page.show_scene(name)
    page.wait(DRAWN)
    motion = main_solution(Request.of(own_choices(name)))[0].motion
    for kind, field, sign in (("force", "shear", -1.0), ("moment", "moment", 1.0)):
        page.tab.locator(".time-views .chart:visible").filter(has_text="at the clamp").get_by_role(
            "button", name=kind, exact=True
        ).click()
        ((_, time, found),) = page.evaluate(CURVES)
        known = sign * getattr(motion, field)(np.array(time), np.zeros(1))[:, 0]
        assert np.median(np.abs(found - known)) < 0.01 * np.abs(known).max()


def test_both_supports_of_a_beam_have_a_curve(open_page):
    page = open_page("?scene=figure-8.15&layout=laboratory")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('support', 'pinned-pinned')"))
    page.evaluate(UNFOLD)
    page.wait(DRAWN)
    assert [name.split(",")[0].replace("\u00a0", " ") for name, *_ in page.evaluate(CURVES)] == [
        "pin at 0 m",
        "roller at 300 mm",
    ]
    expect(page.tab.get_by_role("heading", name="Force at the supports")).to_be_visible()
