"""The chart of the contact law: what else it draws of a contact that flows."""

import numpy as np
from pytest import approx

SERIES = """() => strikewave.page.view.cycle.chart.content.series.map(({ name, x, y }) => [name, [...x], [...y]])"""
NOW = "() => { const { now } = strikewave.page.view.cycle.chart; return [now.x, now.y]; }"
SHOWN = "() => strikewave.page.view.cycle.shown"


def test_figure_7_5_opens_on_the_pressure_and_a_point_runs_along_it(open_page):
    page = open_page("")
    page.show_scene("figure-7.5")
    assert page.evaluate(SHOWN) == "pressure"
    names, depths, pressures = zip(*page.evaluate(SERIES), strict=True)
    assert names == ("this impact", "quasi-static loading", "Tabor's tests")
    assert (pressures[2][0], pressures[2][-1]) == approx((1.1, 2.8), rel=0.01)
    peak = int(np.argmax(depths[0]))
    law = np.interp(depths[0][: peak + 1], depths[1], pressures[1])
    assert np.median(np.abs(law - pressures[0][: peak + 1])) < 0.02  # it goes up along the law
    start, end = page.evaluate("() => strikewave.page.frame.exact.contacts[0].slice(0, 2)")
    for share in (0.3, 0.5, 0.8):
        page.evaluate("t => strikewave.page.player.go(t)", start + share * (end - start))
        x, y = page.evaluate(NOW)
        assert np.hypot((np.array(depths[0]) - x) / max(depths[0]), (np.array(pressures[0]) - y) / 3.0).min() < 0.02


def test_the_radius_lies_between_both_formulas_and_the_switch_is_pressed(open_page):
    page = open_page("?scene=figure-7.7&layout=laboratory&tab=numbers")
    assert page.evaluate(SHOWN) == "radius"
    _, law, elastic, full = page.evaluate(SERIES)
    assert (elastic[0], full[0]) == ("a² = αR", "a² = 2αR")
    a, low, high = (np.array(each[2]) for each in (law, elastic, full))
    assert (a >= low * (1.0 - 1e-6)).all() and (a <= high * (1.0 + 1e-6)).all() and a[-1] == approx(high[-1])
    page.tab.locator(".cycle:visible").get_by_role("button", name="force", exact=True).click()
    assert page.evaluate(SHOWN) == "force"
    assert [name for name, *_ in page.evaluate(SERIES)][-1] == "Tabor's tests"


def test_other_laws_have_the_force_alone(open_page):
    page = open_page("?scene=figure-7.5")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('law', 'hertz')"))
    assert page.evaluate(SHOWN) == "force"
    assert page.evaluate("() => strikewave.page.view.cycle.switch.root.hidden")
