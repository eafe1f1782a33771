"""Where the energy went, on the page: what weight has given, and what does not add up."""

import pytest
from playwright.sync_api import expect

from tests.app.page.test_edited_page import typed

SOFT = "?scene=drop-test&layout=laboratory&law=kelvin-voigt&linear_stiffness=1000&restitution=0.2"
WIDTHS = "bar => [...bar.children].map((piece) => piece.getBoundingClientRect().width / bar.clientWidth)"
BOOKS = """name => {
  const { frame, view } = strikewave.page;
  const { diagnostics, notes, ...rest } = frame[name];
  const open = { ...rest, notes, diagnostics: { ...diagnostics, energy_error: 0.13 } };
  view.story.load({ ...frame, [name]: open });
}"""


def test_what_weight_has_given_counts_with_what_there_was(open_page):
    """A ball that a dashpot catches falls on while it touches: shares are of all that was given."""
    page = open_page(SOFT)
    energy = page.tab.locator(".story .energy").first
    expect(energy).to_contain_text("weight has given")
    assert sum(energy.locator(".bar").evaluate(WIDTHS)) == pytest.approx(1.0, abs=0.02)
    typed(page, "speed", "0.5")
    expect(energy).to_contain_text("weight has given")
    page.analysis("Energy over time")
    expect(page.tab.locator(".analysis.energy .help").first).to_contain_text("At the end, after")


@pytest.mark.parametrize("scene, name", [("fixed-rod", "exact"), ("hammer-on-cantilever", "main")])
def test_shares_that_do_not_add_up_are_not_drawn(open_page, scene, name):
    page = open_page(f"?scene={scene}&layout=laboratory")
    energy = page.tab.locator(".story .energy").first
    expect(energy.locator(".bar")).to_have_count(1)
    page.evaluate(BOOKS, name)
    expect(energy).to_have_text("13.0 % of the energy is unaccounted for: shares of the energy are not shown.")
    expect(energy.locator(".bar")).to_have_count(0)
