"""The spectrum on the page: of what a visitor chooses, as the library has it."""

import numpy as np
import pytest

from app.choices.request import Request
from app.choices.scene_of import own_choices
from app.messages.transverse import main_solution

CURVE = """() => { const { series, unit } = strikewave.page.analyses.spectrum.chart.own;
  return { unit, x: [...series[0].x], y: [...series[0].y], uprights: series.filter(({ path }) => path).length }; }"""


def test_the_tip_of_a_cantilever_rings_in_its_modes(open_page):
    page = open_page("?layout=laboratory&scene=hammer-on-cantilever&panel=spectrum&where=1")
    page.wait("() => strikewave.page.analyses.spectrum.chart.own.series.length > 0")
    assert page.evaluate(CURVE)["unit"] == "N s"
    page.tab.get_by_label("Of what", exact=True).select_option("displacement")
    page.wait("() => strikewave.page.analyses.spectrum.chart.own.unit === 'm'")
    page.wait("() => location.search.includes('of=displacement')")
    solution = main_solution(Request.of(own_choices("hammer-on-cantilever")))[0]
    shown = page.evaluate(CURVE)
    known = solution.spectrum("displacement", solution.scene.target.length, "hann", shown["x"])
    assert np.array(shown["y"]) == pytest.approx(known.amplitude, rel=1e-3, abs=1e-4 * known.amplitude.max())
    assert shown["uprights"] == (known.modes < shown["x"][-1]).sum()


def test_of_a_mechanism_it_is_there_where_links_bend(open_page):
    page = open_page("?layout=laboratory&scene=rotating-bar&panel=spectrum&of=bending_moment&where=0")
    page.wait("() => strikewave.page.analyses.spectrum.chart.own.series.length > 1")  # natural frequencies, too
    page.show_scene("slider-crank")
    assert page.evaluate("() => strikewave.page.analyses.spectrum.root.hidden")
