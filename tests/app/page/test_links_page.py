"""Links, undo and redo, reloads: the page comes back as it was, and a bad link breaks nothing."""

import pytest
from playwright.sync_api import expect

from app.choices.choices import SCENES, Choices
from app.choices.scene_of import choices_of, own_choices

from .hands import type_into
from .test_compare_page import KEEP, set_and_wait
from .test_page import settled

SEARCH = "() => decodeURIComponent(location.search)"
OLD = (  # of an earlier version: every choice, whether it acts or not
    "?scene=free-rod&method=modal&mass_ratio=2.5&speed=3&law=hertz&linear_stiffness=13000000000&hertz_stiffness=2e10"
    "&force_at_depth=10000&exponent=1.5&yield_indentation=0.000001&restitution=0.7&modes=20&elements=50&place=1"
    "&support=cantilever&theory=euler-bernoulli&slenderness=10&damping=0"
)


def at_rest(page) -> None:
    """Wait until the address follows; the next change is a step of its own, however soon it comes."""
    settled(page)
    page.wait("() => !strikewave.page.history.resting")
    page.evaluate("() => { strikewave.page.history.pause = 0; }")


def goes_on(page) -> None:
    """The next change belongs to the same step as the last, however long a busy machine takes between them."""
    page.evaluate("() => { strikewave.page.history.pause = 1e6; }")


def step(page, **settings) -> None:
    """A change that is a step of the history."""
    set_and_wait(page, **settings)
    at_rest(page)


def chosen(page, *names: str) -> list:
    return [page.header("chosen")[name] for name in names]


def test_a_link_says_only_what_differs_from_the_scene(open_page):
    page = open_page()
    set_and_wait(page, mass_ratio=2)
    page.wait("() => location.search === '?mass_ratio=2&layout=laboratory'")
    set_and_wait(page, scene="hammer-on-cantilever")
    page.wait("() => location.search === '?scene=hammer-on-cantilever&layout=laboratory'")
    set_and_wait(page, modes=7)
    page.wait("() => location.search === '?scene=hammer-on-cantilever&modes=7&layout=laboratory'")
    set_and_wait(page, modes=choices_of("hammer-on-cantilever")["modes"])
    page.wait("() => location.search === '?scene=hammer-on-cantilever&layout=laboratory'")


def test_an_address_without_choices_is_the_first_scene_as_it_is():
    assert Choices().chosen() == own_choices(next(iter(SCENES)))


@pytest.mark.parametrize("scene", ["stepped-rod", "two-balls", "brick-off-centre", "figure-8.15", "figure-5.6"])
def test_a_short_link_opens_what_it_was_made_of(open_page, scene):
    page = open_page(f"?scene={scene}")
    set_and_wait(page, speed=2.5)
    settled(page)
    search = page.evaluate(SEARCH)
    assert len(search) < 80
    assert open_page(search).header("chosen") == page.header("chosen")


def test_an_old_link_still_opens_and_becomes_short(open_page):
    page = open_page(OLD)
    assert chosen(page, "scene", "mass_ratio", "law", "hertz_stiffness", "modes") == [
        "free-rod",
        2.5,
        "hertz",
        2e10,
        20,
    ]
    page.wait("() => location.search.length < 150 && location.search.includes('hertz_stiffness=')")
    assert "slenderness" not in page.evaluate(SEARCH)


def test_undo_and_redo_go_step_by_step_and_back_stays_on_the_page(open_page):
    page = open_page()
    page.evaluate("() => { window.same = true; }")
    undo, redo = (page.tab.get_by_role("button", name=name) for name in ("Undo (Ctrl+Z)", "Redo (Ctrl+Shift+Z)"))
    expect(undo).to_be_disabled()
    at_rest(page)
    set_and_wait(page, mass_ratio=1.1)
    page.wait("() => location.search === '?mass_ratio=1.1&layout=laboratory'")
    for ratio in (1.2, 1.3, 1.4):  # of one drag
        goes_on(page)
        set_and_wait(page, mass_ratio=ratio)
    at_rest(page)
    step(page, scene="free-rod")
    step(page, law="hertz")
    expect(redo).to_be_disabled()
    page.tab.locator("h1").click()
    page.answered(lambda: page.tab.keyboard.press("Control+z"))
    assert chosen(page, "scene", "law") == ["free-rod", "rigid"]
    page.tab.go_back()
    page.wait("() => strikewave.page.frame.chosen.mass_ratio === 1.4")
    assert chosen(page, "scene", "law") == ["fixed-rod", "rigid"]
    page.wait("() => location.search === '?mass_ratio=1.4&layout=laboratory'")
    page.answered(undo.click)
    assert chosen(page, "scene", "mass_ratio") == ["fixed-rod", 1.0]
    expect(undo).to_be_disabled()
    page.answered(lambda: page.tab.keyboard.press("Control+Shift+Z"))
    page.answered(lambda: page.tab.keyboard.press("Control+y"))
    page.answered(redo.click)
    page.wait("() => strikewave.page.frame.chosen.law === 'hertz' && strikewave.page.frame.chosen.scene === 'free-rod'")
    expect(redo).to_be_disabled()
    expect(page.tab.get_by_label("Contact law", exact=True)).to_have_value("hertz")
    field = page.tab.get_by_label("Impact speed, exact value")
    at_rest(page)
    page.answered(lambda: type_into(field, "36 km/h", "Enter"))
    page.wait("() => location.search.includes('speed=10')")
    page.answered(lambda: field.press("Control+z"))  # in the field itself: field, picture and address agree
    expect(field).to_have_value("1")
    page.wait("() => !location.search.includes('speed=')")
    assert chosen(page, "speed") == [1.0]
    assert page.evaluate("() => window.same")


def test_the_address_is_written_once_a_drag_and_says_where_it_ended(open_page):
    page = open_page()
    at_rest(page)
    written, pauses = page.evaluate(
        """async () => {
          const found = [], { page } = strikewave;
          page.history.pause = 1e6; // it is one drag, however long an answer or what follows it takes
          let pauses = 0; // in which the address may follow, on a machine that is busy
          for (const how of ['pushState', 'replaceState']) {
            const own = window.history[how].bind(window.history);
            window.history[how] = (...given) => {
              found.push(how);
              own(...given);
            };
          }
          for (let k = 1; k <= 12; k++) {
            const { frames } = strikewave, sent = performance.now();
            page.controls.send('speed', 1 + k / 10);
            while (strikewave.frames === frames || page.telling) await new Promise((done) => setTimeout(done, 10));
            if (performance.now() - sent > 200) pauses++;
          }
          const there = () => window.location.search.endsWith('speed=2.2&layout=laboratory');
          while (!there()) await new Promise((done) => setTimeout(done, 10));
          return [found, pauses];
        }"""
    )
    assert written[0] == "pushState" and written.count("pushState") == 1 and len(written) < 8 + pauses
    page.answered(lambda: page.evaluate("() => strikewave.page.history.undo()"))
    assert chosen(page, "speed") == [1]


def test_a_change_after_undo_forgets_what_was_undone(open_page):
    page = open_page()
    at_rest(page)
    step(page, speed=2)
    step(page, speed=3)
    page.answered(lambda: page.evaluate("() => strikewave.page.history.undo()"))
    at_rest(page)
    step(page, speed=5)
    expect(page.tab.get_by_role("button", name="Redo (Ctrl+Shift+Z)")).to_be_disabled()
    page.answered(lambda: page.evaluate("() => strikewave.page.history.undo()"))
    assert chosen(page, "speed") == [2]


def test_what_is_kept_and_removed_is_undone_as_it_was(open_page):
    page = open_page()
    undo, redo = ("() => strikewave.page.history." + name + "()" for name in ("undo", "redo"))
    kept = "letters => strikewave.page.compare.runs.map(({ letter }) => letter).join('') === letters"
    at_rest(page)
    page.evaluate(KEEP)
    step(page, mass_ratio=2)
    page.evaluate(KEEP)
    page.evaluate("() => strikewave.page.compare.remove(strikewave.page.compare.runs[0])")
    page.wait(kept, "B")
    asked = page.quiet()["sent"]
    page.evaluate(undo)
    page.wait(kept, "AB")
    assert page.quiet()["sent"] == asked  # nothing is solved for it
    assert page.evaluate("() => strikewave.page.compare.runs.map(({ frame }) => frame.chosen.mass_ratio)") == [1, 2]
    page.evaluate(undo)
    page.wait(kept, "A")
    page.answered(lambda: page.evaluate(undo))
    assert chosen(page, "mass_ratio") == [1]
    page.evaluate(undo)
    page.wait(kept, "")
    assert "kept=" not in page.evaluate("() => location.search")
    expect(page.tab.get_by_role("button", name="Undo (Ctrl+Z)")).to_be_disabled()
    for letters in ("A", "A", "AB", "B"):
        page.evaluate(redo)
        page.wait(kept, letters)
        page.quiet()
    expect(page.tab.get_by_role("button", name="Redo (Ctrl+Shift+Z)")).to_be_disabled()
    page.tab.reload()  # what the browser remembers of the history is there, the solutions are not
    page.wait(RESTORED)
    page.evaluate(undo)
    page.wait(kept, "AB")
    assert page.evaluate("() => strikewave.page.compare.runs.map(({ frame }) => frame.chosen.mass_ratio)") == [1, 2]


STATE = """() => { const { page } = strikewave, { compare, layout, player } = page;
  return { t: player.t, playing: player.playing, pace: player.pace.value, tab: layout.tabs.selected, view: page.range(),
    what: page.axial.what, kept: compare.runs.map(({ letter, frame }) => [letter, frame.chosen]),
    beside: compare.beside?.letter, locked: compare.locked, chosen: page.frame.chosen }; }"""
RESTORED = (
    "() => window.strikewave?.frames > 0 && !strikewave.page.changes.quiet && strikewave.page.compare.runs.length"
)


def arrange(page) -> dict:
    """A page that shows all that can be restored."""
    set_and_wait(page, mass_ratio=2)
    page.evaluate(KEEP)
    set_and_wait(page, law="hertz")
    page.evaluate(KEEP)
    set_and_wait(page, modes=20)
    page.evaluate(
        """() => { const { page } = strikewave, { compare } = page;
          page.axial.colour('velocity'); page.axial.axis.show([0.5, 1.5]); page.layout.show('numbers');
          page.player.pace.value = '0.5'; page.player.seek(1.25);
          compare.standBeside(compare.runs[1]); compare.lock(true); }"""
    )
    page.wait("() => ['t=1.25', 'locked=true', 'beside=B', 'tab='].every((part) => location.search.includes(part))")
    return page.evaluate(STATE)


def test_a_reload_restores_everything_and_a_link_shows_the_same_to_others(open_page):
    page = open_page()
    before = arrange(page)
    page.tab.reload()
    page.wait(RESTORED)
    page.wait("() => strikewave.page.compare.locked")
    assert page.evaluate(STATE) == before
    other = open_page(page.evaluate(SEARCH))
    other.wait(RESTORED)
    other.wait("() => strikewave.page.compare.locked")
    after = other.evaluate(STATE)
    assert after.pop("view") == pytest.approx(before.pop("view"))
    assert after | {"pace": before["pace"]} == before


def test_a_copied_link_has_the_instant_and_plays_where_the_page_does(open_page):
    page = open_page("?scene=free-rod")
    page.evaluate(
        "() => { navigator.clipboard.writeText = (link) => { window.copied = link; return Promise.resolve(); }; }"
    )
    page.evaluate("() => { strikewave.page.player.seek(0.7); strikewave.page.player.toggle(); }")
    page.tab.get_by_role("button", name="Copy link").click()
    page.wait("() => window.copied")
    link = page.evaluate("() => window.copied")
    assert "scene=free-rod" in link and "playing=true" in link and "t=" in link
    other = open_page("?" + link.split("?")[1])
    other.wait("() => strikewave.page.player.playing && strikewave.page.player.t > 0.6")


def test_links_count_times_of_what_bends_in_milliseconds(open_page):
    page = open_page("?scene=hammer-on-cantilever&t=0.7&view=0.2,1.4")
    times = page.evaluate("() => [strikewave.page.player.t, ...strikewave.page.range()]")
    assert times == pytest.approx([7e-4, 2e-4, 1.4e-3])
    page.wait("() => ['t=0.7', 'view=0.2,1.4'].every((part) => location.search.includes(part))")
    assert page.evaluate("() => strikewave.page.view.force.chart.writtenX(7e-4)") == "0.700 ms"


@pytest.mark.parametrize(
    "query, said",
    [
        ("?t=abc", "cannot be, in t;"),
        ("?t=-1&kept=Z,modes:5", "in kept, t;"),
        ("?kept=A,modes:1e9", "in kept;"),
        ("?kept=A,<img src=x>:1", "in kept;"),
        ("?kept=A,constructor:1", "in kept;"),
        ("?view=2,1&colour=red&beside=C&locked=perhaps&tab=all", "in view, colour, tab, beside, locked;"),
        ("?mass_ratio=1e9&t=abc", "Mass ratio: 1000000000.0 is not possible"),
        ("?law=" + 100_000 * "a", "Contact law: "),
        ("?kept=" + 50_000 * "A,", "in kept;"),
    ],
    ids=lambda text: text[:24],
)
def test_a_bad_link_is_said_once_and_breaks_nothing(open_page, query, said):
    page = open_page(query)
    toast = page.tab.locator(".toast")
    expect(toast).to_contain_text(said)
    assert "<" not in toast.inner_text()
    set_and_wait(page, speed=2)
    assert chosen(page, "scene", "speed") == ["fixed-rod", 2]
    page.wait("() => location.search === '?speed=2&layout=laboratory'")


def test_what_cannot_be_solved_again_is_said_and_the_rest_is_kept(open_page):
    """A place where this support holds the beam."""
    page = open_page("?scene=hammer-on-cantilever&kept=A,place:0;B,modes:5")
    page.wait(RESTORED)
    assert page.evaluate("() => strikewave.page.compare.runs.map(({ letter }) => letter)") == ["B"]
    assert page.header("chosen") == own_choices("hammer-on-cantilever")
