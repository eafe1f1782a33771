"""Charts of lessons for a first course: lines without stairs, and nothing said of how a solution was found."""

import numpy as np

from .test_lesson_walks import THERE

CURVE = "() => { const { x, y } = strikewave.page.view.force.exact; return { x: [...x], y: [...y] }; }"


def test_the_force_of_a_contact_that_gives_way_is_a_line_without_stairs(open_page):
    page = open_page("?scene=drop-test&layout=laboratory")
    curve = page.evaluate(CURVE)
    x, y = np.array(curve["x"]), np.array(curve["y"])
    moving = y[:-1] > 0.02 * y.max()
    assert moving.sum() > 50 and (np.diff(x) > 0.0).all()
    assert (np.abs(np.diff(y))[moving] > 0.0).all()  # no stretch of the contact where it stays the same
    sent = page.evaluate("() => Math.max(...strikewave.page.frame.exactForce)")
    assert y.max() == sent
    said = page.evaluate("() => strikewave.page.view.story.events.root.textContent")
    back = 2.0 * abs(page.evaluate("() => strikewave.page.frame.exact.final * strikewave.page.frame.speed")) / 9.80665
    assert (
        f"Its weight brings it back in {1e3 * back:.0f}"[:-1] in said and "for good" not in said
    )  # of three digits two


def test_a_lesson_about_one_solution_does_not_say_how_it_was_found(open_page):
    by = "() => strikewave.page.opening.section.shown?.by"
    page = open_page("?scene=fixed-rod&layout=opening&method=modal")
    page.wait("() => strikewave.page.opening.section.shown")
    method, rebound, peak = (each.replace("\xa0", " ") for each in page.evaluate(by))
    assert "solved by modes" in method
    other, exact = page.evaluate("() => [strikewave.page.frame.other, strikewave.page.frame.exact]")
    assert rebound.endswith(f"{100 * abs(other['final'] - exact['final']):.2g} %")  # its own, not that of exact waves
    assert peak.endswith(f"{100 * abs(other['peakForce'] / exact['peakForce'] - 1):.2g} %")
    page = open_page("?lesson=elastic-and-plastic&step=8&language=en")
    page.wait(THERE)
    page.wait("() => strikewave.page.opening.section.shown")
    assert page.evaluate(by) == []  # although its force of before is beside it
    force = "strikewave.page.opening.section.shown.tracks.find((track) => track.force)"
    assert page.evaluate(f"() => {force}.series.map(({{ cursor }}) => cursor)") == ["now", "at first"]
