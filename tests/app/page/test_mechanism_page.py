"""Mechanisms on the page: links and reactions drawn, rigid links beside, impulses at the joints in numbers."""

import pytest
from playwright.sync_api import expect
from pytest import approx

from .test_page import settled

LONG = 60_000
INK = """() => {
  const { canvas } = strikewave.page.mechanism.stage;
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  return new Set(new Uint32Array(data.buffer)).size;
}"""


def test_a_linkage_is_drawn_with_reactions_and_the_answer_of_rigid_links(anew):
    page = anew("four-bar")
    assert page.evaluate(INK) > 50
    expect(page.tab.get_by_role("heading", name="Reactions at the joints")).to_be_visible()
    expect(page.tab.get_by_role("heading", name="Dispersion")).to_be_hidden()
    expect(page.tab.get_by_text("rigid links, to compare").first).to_be_visible()
    first = page.header("main")["final"]
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('modes', 3)"))
    assert page.header("main")["final"] != first
    assert page.header("reference")["name"] == "rigid-links"
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('place', 0.7)"))
    assert page.header("mechanism")["at"] == 0.7
    page.turn_to("Analysis")
    page.tab.get_by_role("button", name="Which model is enough?").click()
    expect(page.tab.get_by_text("with rigid links it would be")).to_be_visible(timeout=LONG)
    settled(page)


def test_what_drives_give_is_told_beside_what_was_there(anew):
    page = anew("four-bar")
    energy = page.header("main")["energy"]
    given = -energy["drives"]
    assert given > 0.0
    told = page.tab.locator(".tab-panel .energy")
    expect(told).to_contain_text(f"Before the impact {energy['initial']:.3g} J; the drives have given {given:.3g} J")
    expect(told).to_contain_text(f"({100 * energy['impactor'] / (energy['initial'] + given):.1f} %)")
    expect(told).not_to_contain_text("−")
    expect(page.tab.get_by_text("rigid links, to compare, up to").first).to_be_visible()
    page.turn_to("Numbers")
    row = page.tab.locator("tr", has_text="restitution e of the struck points")
    expect(row).to_contain_text(f"{page.header('main')['restitution']['newton_at_contact']:.4g}")


def test_a_run_of_another_kind_of_impact_is_kept_and_not_compared(anew):
    page = anew("four-bar")
    page.evaluate("() => strikewave.page.compare.keep()")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('scene', 'timoshenko-1913-long')"))
    told = page.tab.locator(".tab-panel .compared").first
    expect(told).to_contain_text("another kind of impact")
    expect(told.locator("li")).to_have_count(0)
    laid = page.evaluate(
        "() => strikewave.page.view.stack.charts.flatMap(([, { content }]) => content.series.map(({ name }) => name))"
    )
    assert "A" not in laid
    page.turn_to("Numbers")
    expect(page.tab.locator("table.side-by-side")).to_be_hidden()


def test_links_move_as_the_library_says(anew):
    page = anew("four-bar")
    moved = page.evaluate(
        """() => { const { page } = strikewave, { stage } = page.mechanism; page.player.go(2e-3);
          const read = () => stage.mechanism.placed[2].at(-1);
          const later = read(); page.player.go(0); const first = read();
          return (later[0] - first[0]) / stage.mechanism.scale / stage.mechanism.factor; }"""
    )
    struck = page.evaluate(
        """() => { const { time, struckPath } = strikewave.page.frame; let k = 0;
          while (time[k] < 2e-3) k++; return struckPath[k]; }"""
    )
    assert abs(moved) == approx(abs(struck), rel=0.03)


def test_impulses_at_the_joints_are_told_where_all_is_over_at_once(anew):
    page = anew("slider-crank", size=(390, 844))
    page.fits(390)
    expect(page.tab.get_by_role("heading", name="Reactions at the joints")).to_be_hidden()
    page.turn_to("Numbers")
    table = page.tab.locator("table", has_text="moment, N m s")
    expect(table).to_contain_text("ground – crank")
    assert len(page.header("main")["joints"]) == table.locator("tbody tr").count()


def test_a_mechanism_that_strikes_is_drawn_as_what_is_struck_and_said_to_strike(anew):
    page = anew("trip-hammer")
    heads = page.tab.locator(".body summary b").all_inner_texts()
    assert heads[:2] == ["Body 1, is struck: rod", "Body 2, strikes: mechanism"]
    assert page.header("chosen")["speed"] == approx(2.0) and page.header("mechanism")["at"] == 1.0
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('speed', 3)"))
    settled(page)


def test_waves_at_the_joint_are_shown_beside_the_mechanism(open_page):
    page = open_page("?scene=bent-rods")  # which is named after them, and so is opened with them
    panel = page.tab.locator(".analysis.joints")
    expect(panel.get_by_role("status")).to_contain_text("pin between first and second, which goes on turned by 90°")
    panel.get_by_role("button", name="Show the numbers").first.click()
    expect(panel.get_by_role("columnheader", name="on, bending, %").first).to_be_visible()
    page.analysis("Waves at the joint")
    expect(page.tab.get_by_role("heading", name="How waves run along the link")).to_be_visible()
    expect(page.tab.get_by_role("button", name="moment", exact=True)).to_be_hidden()  # it is struck along its length


def test_tables_of_nodes_are_in_view_where_their_scene_is_opened(open_page):
    """Table 6.9 is of coordinates, 6.10 of velocities: 0.979 of the approach at the node that is struck."""
    page = open_page("?scene=table-6.9")
    panel = page.tab.locator(".mode_change")
    expect(panel.get_by_role("button", name="coordinates")).to_have_attribute("aria-pressed", "true", timeout=LONG)
    expect(panel.locator("tr[aria-current]").first).to_contain_text("3.39e−9")  # m along the link
    panel.get_by_role("button", name="velocities").click()
    struck = panel.locator("tr[aria-current]").first.locator("td")
    assert struck.all_text_contents()[:5] == ["4", "299", "−0.979", "−0.979", "−0.979"]
    expect(panel).to_contain_text("Where the mass is left out of the projection it is 0.02057 m/s.")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('place', 0.4)"))
    expect(panel).to_contain_text("Move “Struck at” to a node", timeout=LONG)
    settled(page)


def test_a_scene_that_is_picked_opens_what_it_is_named_after_and_shuts_it_again(anew):
    page = anew()
    panel = page.tab.locator(".mode_change")
    page.show_scene("table-6.10")
    expect(panel.locator("tr[aria-current]").first).to_be_visible(timeout=LONG)
    expect(page.tab.get_by_role("heading", name="What happens")).to_be_visible()  # the story stays beside it
    page.show_scene("fixed-rod")
    expect(panel).to_be_hidden()
    page.wait("() => !location.search.includes('panel')")


def test_a_joint_that_bears_nothing_has_no_arrow(show):
    """Struck at its centre of percussion: 1e-16 N s is rounding."""
    page = show("?scene=compound-pendulum")
    assert page.evaluate("() => strikewave.page.mechanism.stage.mechanism.largest") == 0


def test_sudden_reactions_stand_beside_all_that_the_joints_give(anew):
    """Of balances the sudden part is a twentieth; by a contact law there is one row, and no such part."""
    page = anew("figure-6.8")
    page.turn_to("Numbers")
    rows = page.tab.locator("tr", has_text="ground – bar")
    expect(rows).to_have_count(2)
    expect(rows.nth(0)).to_contain_text("sudden alone")
    expect(rows.nth(1)).to_contain_text("all to the parting")
    balances = page.header("main")["diagnostics"]["balances"]
    expect(page.tab.locator("tr", has_text="balances of impulse and momentum")).to_contain_text(str(balances))
    page.show_scene("rotating-bar")
    expect(page.tab.locator("tr", has_text="ground – bar")).to_have_count(1)


@pytest.mark.parametrize("scene", ["figure-6.7", "figure-6.8"])
def test_figures_of_displacements_are_opened_with_their_chart(anew, scene):
    shows = "() => strikewave.page.view.stack.shows('moved')"
    for size in [(1440, 900), (1280, 720), (820, 1180)]:
        page = anew("four-bar", size)
        assert size[0] < 1000 or not page.evaluate(shows)
        page.show_scene(scene)
        assert page.evaluate(shows), size


def test_what_strikes_from_above_keeps_off_the_colours(show):
    """On a phone, where they are beside each other; 44 pixels are theirs."""
    page = show("?scene=table-6.6", size=(390, 844))
    top = """() => {
      const { mechanism } = strikewave.page.mechanism.stage;
      return mechanism.middleOf(mechanism.linkage.contact, mechanism.linkage.normal)[1] - mechanism.wide / 2;
    }"""
    assert page.evaluate(top) >= 40


def test_the_delay_of_reactions_is_what_figure_6_9_is_opened_on(open_page):
    """On the first millisecond, as modes change too, until a hand asks for the whole; then of two numbers of modes."""
    page = open_page("?scene=figure-6.9")
    view = "() => strikewave.page.view.axis.view"
    assert page.evaluate("() => strikewave.page.view.stack.shows('reactions')")
    assert page.evaluate(view) == [0, 1e-3] and "view=" not in page.evaluate("() => location.search")
    page.tab.get_by_role("button", name="Compare", exact=True).click()
    page.tab.get_by_role("button", name="8 or 12 modes across?").click()
    page.wait("() => strikewave.page.compare.runs.length === 1 && strikewave.page.frame.main.modes !== null")
    page.wait("() => strikewave.page.frame.chosen.modes === 12 && !strikewave.page.asked")
    assert page.evaluate(view) == [0, 1e-3]
    laid = page.evaluate("() => strikewave.page.view.reactions.chart.laid.map(({ name }) => name)")
    assert laid == ["A"]
    page.tab.get_by_role("button", name="Show the whole impact").click()
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('modes', 8)"))
    assert page.evaluate(view)[1] > 0.01
