"""Words of the map and of tolerances: none is cut, and inputs have the names of their bodies."""

import pytest
from playwright.sync_api import expect

from .hands import type_into
from .test_page import settled
from .test_whatif_page import OPEN, WHATIF, opened

PARTS = f"() => {WHATIF}.modes.tolerance.inputs.map(({{ part }}) => part)"
NEEDS = """() => {
  const root = strikewave.page.root.getRootNode();
  return [...root.querySelectorAll('.whatif-tiles strong')].filter((each) => each.scrollWidth > each.clientWidth)
    .map((each) => each.textContent);
}"""
# How wide the chosen words of the choices in the title are, and how much room they have.
CHOSEN = """() => {
  const root = strikewave.page.root.getRootNode();
  return [...root.querySelectorAll('.whatif-sentence select')].map((select) => {
    const c = document.createElement('canvas').getContext('2d');
    c.font = getComputedStyle(select).font;
    return [select.selectedOptions[0].textContent, c.measureText(select.selectedOptions[0].textContent).width,
      select.getBoundingClientRect().width];
  });
}"""


def test_every_tolerance_is_set_at_once_and_inputs_are_named_with_their_body(show):
    page = show("?scene=bouncing-on-piston&layout=opening", (1440, 900))
    settled(page)
    page.evaluate(OPEN, "tolerance:")
    page.wait(f"() => {WHATIF}.modes.tolerance.rows.size > 8")
    names = page.tab.locator(".whatif-inputs .name").all_text_contents()
    assert len(set(names)) == len(names) and {"Mass, Link: crank", "Mass, Link: rod", "Mass, Link: piston"} < set(names)
    assert len(set(page.evaluate(PARTS))) > 2
    every = page.tab.locator(".whatif-every")
    type_into(every.get_by_role("textbox"), "12,5,3")
    expect(every.get_by_role("alert")).to_contain_text("12,5,3")
    every.get_by_role("button").click()
    assert len(set(page.evaluate(PARTS))) > 2
    type_into(every.get_by_role("textbox"), "10")
    assert len(set(page.evaluate(PARTS))) > 2, "only the button sets them"
    every.get_by_role("button").click()
    assert set(page.evaluate(PARTS)) == {0.1}
    type_into(every.get_by_role("textbox"), "5", leave="Enter")
    assert set(page.evaluate(PARTS)) == {0.05}
    assert {each.input_value() for each in page.tab.locator(".whatif-inputs input").all()} == {"5"}


@pytest.mark.parametrize("size", [(1440, 900), (1280, 720), (390, 844)])
def test_no_value_and_no_name_is_cut(show, size):
    page = opened(show, "?layout=opening&whatif=impactor_velocity,mass_ratio,speed", size)
    assert page.evaluate(NEEDS) == []
    for words, wide, room in page.evaluate(CHOSEN):
        assert room >= wide + 1, words  # else the edge of its last letter is cut
