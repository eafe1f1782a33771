"""Tables of repeated balances, whole on the page: opened with their scenes, by what a visitor picks."""

import pytest
from playwright.sync_api import expect

SIZES = [(1440, 900), (390, 844)]
INSIDE = """() => {
  const root = strikewave.page.analyses.convergence.root.getBoundingClientRect();
  const cells = [...strikewave.page.root.querySelectorAll('.study-convergence :is(td, th)')];
  return cells.filter((cell) => cell.getBoundingClientRect().right > root.right + 1).length;
}"""


@pytest.mark.parametrize("size", SIZES)
def test_a_table_stands_beside_the_sliders_and_follows_what_is_picked(open_page, size):
    page = open_page("?scene=table-6.4", size=size)
    table = page.tab.locator(".study-convergence table")
    head = table.locator("thead")
    expect(head).to_contain_text("589 ns")
    expect(head).to_contain_text("exact waves")
    for said in ("balances", "3117", "74.12", "−0.4201", "energy lost, %"):
        expect(table).to_contain_text(said)
    assert page.evaluate(INSIDE) == 0
    page.tab.get_by_role("button", name="restitution", exact=True).click()
    expect(head).to_contain_text("e = 0.7")
    expect(page.tab.locator(".study-convergence .figures")).to_be_hidden()
    expect(page.tab.locator(".study-convergence")).to_have_attribute("aria-busy", "false")
    page.wait("() => location.search.includes('by=restitution')")
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('scene', 'table-6.2')"))
    expect(head).to_contain_text("10 elements")
