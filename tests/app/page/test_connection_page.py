"""The page when its server goes and comes back, with a real server that is killed."""

import signal

import pytest
from playwright.sync_api import expect

from solvers.scenes.library import SCENES

from ..conftest import Page
from ..strangers import named
from .moved import READY

TICKS = 30  # of 100 ms, within which a loss is noticed: by a timer of the page, which a busy machine slows
BACK = 60_000  # ms for a server to start on a busy machine, and the page to find it
LOST = "The connection to the server is lost"
SHOWN = "() => strikewave.page.frame.chosen.mass_ratio"


def soon(page) -> None:
    """A loss has been noticed by now, and soon: `watch` was called before."""
    assert page.evaluate("() => window.ticks") <= TICKS


def watch(page) -> None:
    """Count the ticks until a loss is noticed."""
    page.evaluate(
        """() => {
          const { connection } = strikewave.page;
          window.ticks = 0;
          const timer = setInterval(() => (connection.lost ? clearInterval(timer) : window.ticks++), 100);
        }"""
    )


def quiet(page) -> None:
    """Wait until a loss is known, which is said in a line above all else."""
    said = page.tab.get_by_role("status").filter(has_text="There is no connection")
    expect(said).to_be_in_viewport(ratio=1)
    below = page.evaluate("() => strikewave.page.root.querySelector('.topbar').getBoundingClientRect().top")
    box = said.bounding_box()
    assert 16.0 < box["height"] <= below + 0.5  # it is read, and lies on nothing
    assert said.evaluate("(it) => it.scrollHeight <= it.clientHeight && it.scrollWidth <= it.clientWidth")
    expect(page.tab.get_by_role("alert")).to_be_hidden()


def waits(page, words: str) -> None:
    """Wait until it is said what waits for the server."""
    expect(page.tab.get_by_role("alert").filter(has_text=LOST)).to_contain_text(words)


@pytest.fixture
def open_on(browser, own_server):
    opened: list[Page] = []

    def open_one(query: str = "", **options) -> Page:
        opened.append(Page(browser, own_server.address, query, **options))
        return opened[-1]

    yield open_one
    for page in opened:
        page.context.close()
        # no server, or none yet, while one that is begun gets ready
        refused = "net::ERR", "Failed to fetch", "503", "not connected"
        assert [error for error in page.errors if not any(word in error for word in refused)] == []


@pytest.mark.slow
def test_a_server_that_hangs_is_noticed_by_who_waits_for_it(own_server, open_on):
    page = open_on()
    page.wait(READY)
    own_server.process.send_signal(signal.SIGSTOP)
    watch(page)
    page.evaluate("() => strikewave.page.choose('method', 'fe-nodal')")
    waits(page, "What you have chosen waits")
    soon(page)
    own_server.process.send_signal(signal.SIGCONT)
    page.wait("() => window.strikewave?.page.frame.chosen.method === 'fe-nodal'", timeout=BACK)
    expect(page.tab.get_by_role("alert")).to_be_hidden()


# What pages go through while their server is there, then without it, and once it is back: a yield each between.


def plays(page):
    """Playback goes on, and the page comes back."""
    page.wait(READY)
    page.turn_to("Numbers")
    page.evaluate("() => { strikewave.page.player.go(0.4); strikewave.page.axial.axis.show([0.25, 0.75]); }")
    page.evaluate("() => { strikewave.page.player.pace.value = '0.1'; strikewave.page.player.toggle(); }")
    page.evaluate("() => { window.same = true; }")
    yield
    quiet(page)
    soon(page)
    t = page.evaluate("() => strikewave.page.player.t")
    page.wait("t => strikewave.page.player.t !== t", t)
    page.evaluate("() => strikewave.page.choose('speed', 3)")
    page.wait("() => strikewave.page.frame.chosen.speed === 3")
    quiet(page)
    yield
    page.wait("() => !window.same && window.strikewave?.page.frame.chosen.speed === 3", timeout=BACK)
    assert page.header("chosen")["scene"] == "free-rod"
    assert page.header("chosen")["mass_ratio"] == 2.5
    assert page.evaluate("() => strikewave.page.player.playing")
    assert page.evaluate("() => strikewave.page.player.pace.value") == "0.1"
    assert page.evaluate("() => strikewave.page.layout.tabs.selected") == "numbers"
    expect(page.tab.get_by_role("alert")).to_be_hidden()


def drags(page):
    """The drag is answered on; nothing is said to be solved that is not; what is chosen last is there in the end."""
    page.wait(READY)
    box = page.tab.get_by_role("slider", name="Mass ratio").bounding_box()
    y, first = box["y"] + box["height"] / 2, box["x"] + box["width"] / 2
    page.tab.mouse.move(first, y)
    page.tab.mouse.down()
    page.tab.mouse.move(first + 20, y, steps=10)
    yield
    quiet(page)
    before = page.evaluate(SHOWN)
    page.tab.mouse.move(first + 40, y, steps=10)
    page.wait(f"before => ({SHOWN})() > before", before)
    page.tab.mouse.up()
    page.tab.wait_for_timeout(600)  # until the hand has rested, and what is awaited would be said
    expect(page.tab.get_by_text("Solving")).to_be_hidden()
    quiet(page)
    expect(page.tab.get_by_text("Warnings come from the server")).to_be_attached()
    expect(page.tab.get_by_text("Masses and sizes come from the server")).to_be_visible()
    expect(page.tab.locator(".body-list")).to_be_hidden()
    last = page.evaluate(SHOWN)
    page.evaluate("() => strikewave.page.choose('method', 'fe-nodal')")  # which the server alone knows
    waits(page, "What you have chosen waits")
    page.evaluate("() => { window.same = true; }")
    page.tab.mouse.move(first + 40, y)
    page.tab.mouse.down()
    yield
    asked = page.evaluate("() => strikewave.page.connection.timer")
    page.wait("asked => window.same && strikewave.page.connection.timer !== asked", asked)  # it would have come back
    page.tab.mouse.up()
    page.wait("() => window.strikewave?.page.frame.chosen.method === 'fe-nodal'", timeout=BACK)
    assert page.evaluate(SHOWN) == last
    expect(page.tab.get_by_role("alert")).to_be_hidden()
    expect(page.tab.locator(".body-list")).to_be_visible()


ANALYSIS = "() => { const { analyses } = strikewave.page; analyses.open(analyses.byName.get('modes')); }"


def tells_what_waits(page):
    page.wait(READY)
    yield
    quiet(page)
    page.tab.locator("button.scene").click()
    waits(page, "The scenes can be fetched")
    page.evaluate("() => strikewave.page.choose('mass_ratio', 0.7)")
    page.wait(f"() => ({SHOWN})() === 0.7")
    page.tab.locator("button.take").click()
    page.tab.get_by_text("Histories (CSV)").click()
    waits(page, "That can be saved")
    page.tab.get_by_role("button", name="Analysis").click()
    page.evaluate(ANALYSIS)
    waits(page, "The analysis waits")
    page.tab.get_by_role("tab", name="Story").click()
    page.evaluate("() => { strikewave.page.connection.missed.until = 0; }")
    quiet(page)
    page.evaluate("() => strikewave.page.compare.keep()")
    waits(page, "What you keep waits")
    page.evaluate("() => strikewave.page.bodies.set('target.length', 0.6)")
    waits(page, "The value that you have set waits")
    page.evaluate("() => strikewave.page.choose('scene', 'bronze-rod-steel-ball')")
    waits(page, "The other scene waits")
    expect(page.tab.get_by_role("button", name="Reload")).to_be_hidden()  # by which the page would be gone
    yield
    page.wait("() => window.strikewave?.page.frame.chosen.scene === 'bronze-rod-steel-ball'", timeout=BACK)
    expect(page.tab.get_by_role("alert")).to_be_hidden()


def analyses(page):
    """An analysis that waited is answered."""
    page.wait(READY)
    yield
    quiet(page)
    page.evaluate("() => strikewave.page.choose('mass_ratio', 0.7)")
    page.wait(f"() => ({SHOWN})() === 0.7")
    page.tab.get_by_role("button", name="Analysis").click()
    page.evaluate(ANALYSIS)
    waits(page, "The analysis waits")
    page.evaluate("() => { window.same = true; }")
    yield
    page.wait(f"() => !window.same && window.strikewave && ({SHOWN})() === 0.7", timeout=BACK)
    page.wait("() => strikewave.page.analyses.byName.get('modes').root.ariaBusy === 'false'")
    expect(page.tab.get_by_role("alert")).to_be_hidden()


def answers_nothing(page):
    """Where the browser answers nothing the loss is said at once."""
    yield
    waits(page, "What you choose waits")
    soon(page)
    yield


OWN = named((SCENES / "four-bar.toml").read_text("utf-8"))


def has_a_scene_of_its_own(page):
    """It is in the link, whole."""
    page.tab.get_by_role("slider", name="Mass ratio").first.press("ArrowRight")
    page.wait("() => strikewave.page.frame.chosen.mass_ratio > 0.5")
    page.evaluate("() => { window.same = true; }")
    yield
    quiet(page)
    yield
    page.wait("name => !window.same && window.strikewave?.page.frame?.chosen.scene === name", OWN, timeout=BACK)
    assert page.header("chosen")["mass_ratio"] > 0.5


WALKS = [
    (has_a_scene_of_its_own, f"?scene={OWN}&mass_ratio=0.5&layout=laboratory", ""),
    (plays, "?scene=free-rod&mass_ratio=2.5", ""),
    (tells_what_waits, "?scene=free-rod&layout=opening", ""),
    (analyses, "", ""),
    (answers_nothing, "", "delete globalThis.WebAssembly;"),
    (drags, "?layout=laboratory", ""),
]


@pytest.mark.slow
def test_pages_go_on_without_their_server_and_come_back_with_it(own_server, open_on):
    """All of them at once, as a server takes seconds to start."""
    pages = [open_on(query, script=script) for _, query, script in WALKS]
    walks = [walk(page) for (walk, *_), page in zip(WALKS, pages, strict=True)]
    for each in walks:
        next(each)
    for page in pages:
        watch(page)
    own_server.end()
    for each in walks:
        next(each)
    for page in pages:
        page.evaluate("() => { strikewave.page.connection.pause = 300; }")  # looks for it as often as at first
    own_server.start()
    for each in walks:
        next(each, None)


TAKE_SOCKET = """() => {
  const { send } = WebSocket.prototype;
  WebSocket.prototype.send = function (...parts) { window.socket = this; return send.apply(this, parts); };
}"""


def test_a_session_that_has_ended_is_replaced_by_another_with_the_same_state(open_page):
    page = open_page("?scene=free-rod&mass_ratio=0.5")
    page.evaluate(TAKE_SOCKET)
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('speed', 2)"))
    page.wait("() => location.search.includes('speed=2')")
    page.evaluate("() => { window.same = true; strikewave.page.player.go(0.7); socket.close(); }")
    page.wait("() => !window.same && window.strikewave?.frames > 0", timeout=BACK)
    page.wait("() => strikewave.page.player.t === 0.7")
    chosen = page.header("chosen")
    assert (chosen["scene"], chosen["mass_ratio"], chosen["speed"]) == ("free-rod", 0.5, 2)
