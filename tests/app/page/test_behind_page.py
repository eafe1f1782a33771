"""The table behind the map, opened by keys, by mouse and by a finger, and the map's state in words."""

import pytest
from playwright.sync_api import expect

import solvers

from .hands import tap
from .test_access_page import findings
from .test_page import settled
from .test_whatif_fingers_page import MAP, phone  # noqa: F401 (a fixture)
from .test_whatif_page import OPEN, SIZES, WHATIF, opened

pytestmark = pytest.mark.browser
RESTED = f"() => {WHATIF}.jobs.idle && !{WHATIF}.due && {WHATIF}.spoken.said.textContent"
# Heads of columns, then of each row its head and the lines of its cells.
CELLS = """() => {
  const table = strikewave.page.root.querySelector('.whatif-behind table');
  const heads = [...table.querySelectorAll('thead tr:last-child th[scope=col]')].map((each) => each.textContent);
  const rows = [...table.querySelectorAll('tbody tr')].map((row) => [
    row.querySelector('th[scope=row]').textContent,
    ...[...row.querySelectorAll('td')].map((cell) => [...cell.children].map((line) => line.textContent)),
  ]);
  return [table.caption.textContent, heads, rows];
}"""
SCROLLS = "(each) => each.scrollWidth > each.clientWidth"


def table_of(page):
    """The dialog with the table; by mouse."""
    page.tab.get_by_role("button", name="Take along", exact=True).click()
    page.tab.locator(".whatif-along .drop").get_by_role("button", name="As a table").click()
    dialog = page.tab.locator(".whatif-behind")
    expect(dialog).to_be_visible()
    return dialog


def plain(words: str) -> str:
    return " ".join(words.split())


def test_keys_open_the_table_and_escape_leads_back_to_the_map(show):
    page = opened(show, "?layout=opening&whatif=peak_force,mass_ratio,speed")
    keyboard = page.tab.keyboard
    page.tab.locator(".whatif-sentence select").first.focus()
    for _ in range(20):
        keyboard.press("Tab")
        if page.tab.locator(".whatif-along > button").evaluate("(each) => each.matches(':focus')"):
            break
    keyboard.press("Enter")
    item = page.tab.locator(".whatif-along .drop").get_by_role("button", name="As a table")
    for _ in range(4):
        keyboard.press("Tab")
        if item.evaluate("(each) => each.matches(':focus')"):
            break
    keyboard.press("Enter")
    dialog = page.tab.get_by_role("dialog", name="As a table")
    expect(dialog).to_be_visible()
    expect(dialog.get_by_role("status")).to_be_empty()
    caption, heads, rows = page.evaluate(CELLS)
    assert caption == "Peak force over Mass ratio and Impact speed"
    assert 5 <= len(heads) - 1 <= 9 and 4 <= len(rows) <= 7
    row = next(row for row in rows if plain(row[0]) == "1 m/s")
    value, contacts = row[heads.index("10")]
    scene = solvers.load("fixed-rod")
    exact = solvers.solve(scene.replace({"impactor.mass": scene.target.mass / 10.0}), method="waves")
    number, unit = value.split()
    assert float(number) * {"N": 1.0, "kN": 1e3}[unit] == pytest.approx(exact.peak_force, rel=2e-3)
    assert plain(contacts) == "1 contact" and len(exact.contacts) == 1
    keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    expect(page.tab.locator(".whatif-map")).to_be_visible()
    expect(page.tab.locator(".whatif-along > button")).to_be_focused()


def test_the_table_follows_what_is_shown(show):
    page = opened(show, "?layout=opening&law=hertz&whatif=peak_force,mass_ratio,hertz_stiffness")
    dialog = table_of(page)
    before = page.evaluate(CELLS)
    dialog.get_by_title("Close").click()
    page.tab.locator(".whatif-sentence select").first.select_option("newton")
    page.wait(RESTED)
    dialog = table_of(page)
    after = page.evaluate(CELLS)
    assert after[0].startswith("Restitution") and after[1] == before[1] and after[2] != before[2]
    page.tab.mouse.click(4, 4)  # beside it
    expect(dialog).to_be_hidden()


@pytest.mark.parametrize("mode", ["Curves", "Tolerance"])
def test_curves_and_tolerances_have_a_table_of_all_results(show, mode):
    page = show("?layout=opening", (1280, 720))
    settled(page)
    page.evaluate(OPEN, f"{mode.lower()}:peak_force,mass_ratio,speed")
    page.wait(f"() => {WHATIF}.modes.shown?.jobs.shown?.whole && !{WHATIF}.due")
    dialog = table_of(page)
    _, heads, rows = page.evaluate(CELLS)
    if mode == "Curves":
        assert heads[:3] == ["Mass ratio", "Contacts", "Peak force"] and len(rows) == 21
        assert {plain(contacts) for _, [contacts, _], *_ in rows} >= {"1 contact", "2 contacts"}
    else:
        shares = {row[0]: [plain(value) for value, _ in row[4:]] for row in rows}
        inputs = [plain(head) for head in heads[4:]]
        assert inputs == ["Impact speed ±3 %", "Mass ratio ±2 %"]
        assert shares["Peak force"][0] in ("99 %", "> 99 %", "100 %")
        assert "contact" in dialog.locator(".help").last.inner_text()
    assert findings(page) == []
    page.tab.keyboard.press("Escape")
    page.tab.get_by_role("button", name="Map", exact=True).click()


@pytest.mark.parametrize("size", SIZES)
def test_the_table_is_within_the_window_at_every_size(show, size):
    page = opened(show, "?layout=opening&law=hertz&whatif=peak_force,mass_ratio,hertz_stiffness", size)
    dialog = table_of(page)
    box = dialog.bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= size[0] and box["height"] <= size[1]
    assert not dialog.evaluate(SCROLLS)
    area = dialog.locator(".scroll")
    if area.evaluate(SCROLLS):
        expect(area).to_have_attribute("tabindex", "0")
    assert findings(page) == []
    page.tab.keyboard.press("Escape")


def test_a_finger_opens_the_table_and_shuts_it(phone):  # noqa: F811
    page, _ = phone(MAP)
    tap(page.tab.get_by_role("button", name="Take along", exact=True))
    tap(page.tab.locator(".whatif-along .drop").get_by_role("button", name="As a table"))
    dialog = page.tab.locator(".whatif-behind")
    expect(dialog.locator("tbody tr").first).to_be_visible()
    tap(dialog.get_by_title("Close"))
    expect(dialog).to_be_hidden()


def test_the_map_is_said_in_words_and_so_is_a_move_by_keys(show):
    page = opened(show, "?layout=opening&whatif=peak_force,mass_ratio,speed")
    page.wait(f"() => {WHATIF}.spoken.said.textContent.includes('Impact speed')")
    plane = page.tab.locator(".whatif-map canvas").last
    words = plain(page.evaluate(f"() => {WHATIF}.spoken.said.textContent"))
    assert plane.get_attribute("aria-describedby") == page.evaluate(f"() => {WHATIF}.spoken.said.id")
    here = plain(page.tab.locator(".whatif-tiles button[aria-pressed=true] strong").inner_text())
    for said in ("Peak force over Mass ratio from 0.0", f"Mass ratio 1, Impact speed 1 m/s: {here}", "Lowest:"):
        assert said in words, words
    for said in ("Highest:", "1 contact in", "2 contacts in", "Mass ratio from"):
        assert said in words, words
    moved = page.tab.locator(".whatif-map [role=status]")
    expect(moved).to_be_empty()
    plane.focus()
    page.tab.keyboard.press("ArrowUp")
    settled(page)
    expect(moved).to_contain_text("Mass ratio 1, Impact speed 1.")
    speed = page.evaluate("() => strikewave.page.frame.chosen.speed")
    there = plain(page.tab.locator(".whatif-tiles button[aria-pressed=true] strong").inner_text())
    assert speed > 1.0 and there != here
    expect(moved).to_contain_text(f"{there.split()[0]}")
    page.tab.keyboard.press("Control+z")
