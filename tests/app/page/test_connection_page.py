"""The page when its server goes and comes back, with a real server that is killed."""

import signal

import pytest
from playwright.sync_api import expect

from ..conftest import Page
from .moved import READY

TICKS = 30  # of 100 ms, within which a loss is said: by a timer of the page, which a busy machine slows with all else
BACK = 60_000  # ms for a server to start on a busy machine, and the page to find it
LOST = "The connection to the server is lost"


def said(page, words: str) -> None:
    """Wait until a loss is said, and soon: `watch` was called before."""
    expect(page.tab.get_by_role("alert").filter(has_text=words)).to_be_visible()
    assert page.evaluate("() => window.ticks") <= TICKS


def watch(page) -> None:
    """Count the ticks until something is said."""
    page.evaluate(
        """() => {
          const alert = strikewave.page.root.getRootNode().querySelector('.connection');
          window.ticks = 0;
          const timer = setInterval(() => (alert.hidden ? window.ticks++ : clearInterval(timer)), 100);
        }"""
    )


@pytest.fixture
def open_on(browser, own_server):
    opened: list[Page] = []

    def open_one(query: str = "", **options) -> Page:
        opened.append(Page(browser, own_server.address, query, **options))
        return opened[-1]

    yield open_one
    for page in opened:
        page.context.close()
        refused = "net::ERR", "Failed to fetch", "503"  # no server; none yet, while one that is begun gets ready
        assert [error for error in page.errors if not any(word in error for word in refused)] == []


@pytest.mark.slow
def test_a_lost_server_is_said_playback_goes_on_and_the_page_comes_back(own_server, open_on):
    page = open_on("?scene=free-rod&mass_ratio=2.5")
    page.turn_to("Numbers")
    page.evaluate("() => { strikewave.page.player.go(0.4); strikewave.page.axial.axis.show([0.25, 0.75]); }")
    page.evaluate("() => { strikewave.page.player.pace.value = '0.1'; strikewave.page.player.toggle(); }")
    page.evaluate("() => { window.same = true; }")
    watch(page)
    own_server.end()
    said(page, LOST)
    t = page.evaluate("() => strikewave.page.player.t")
    page.wait("t => strikewave.page.player.t !== t", t)
    page.evaluate("() => strikewave.page.choose('speed', 3)")  # which nobody takes now
    own_server.start()
    page.wait("() => !window.same && window.strikewave?.page.frame.chosen.speed === 3", timeout=BACK)
    assert page.header("chosen")["scene"] == "free-rod"
    assert page.header("chosen")["mass_ratio"] == 2.5
    assert page.evaluate("() => strikewave.page.player.playing")
    assert page.evaluate("() => strikewave.page.player.pace.value") == "0.1"
    assert page.evaluate("() => strikewave.page.layout.tabs.selected") == "numbers"
    expect(page.tab.get_by_role("alert").filter(has_text=LOST)).to_be_hidden()


SHOWN = "() => strikewave.page.frame.chosen.mass_ratio"


@pytest.mark.slow
def test_a_server_that_goes_while_a_slider_is_dragged(own_server, open_on):
    """The drag is answered on; nothing is said to be solved that is not; what is chosen last is there in the end."""
    page = open_on()
    page.wait(READY)
    box = page.tab.get_by_role("slider", name="Mass ratio").bounding_box()
    y, first = box["y"] + box["height"] / 2, box["x"] + box["width"] / 2
    page.tab.mouse.move(first, y)
    page.tab.mouse.down()
    page.tab.mouse.move(first + 20, y, steps=10)
    own_server.end()
    expect(page.tab.get_by_role("alert")).to_contain_text("Sliders go on")
    before = page.evaluate(SHOWN)
    page.tab.mouse.move(first + 40, y, steps=10)
    page.wait(f"before => ({SHOWN})() > before", before)
    page.tab.mouse.up()
    page.tab.wait_for_timeout(600)  # until the hand has rested, and what is awaited would be said
    expect(page.tab.get_by_text("Solving")).to_be_hidden()
    expect(page.tab.get_by_role("alert")).to_contain_text("Sliders go on")
    last = page.evaluate(SHOWN)
    page.evaluate("() => strikewave.page.choose('method', 'fe-nodal')")  # which the server alone knows
    expect(page.tab.get_by_role("alert")).to_contain_text("waits until it is back")
    own_server.start()
    page.wait("() => window.strikewave?.page.frame.chosen.method === 'fe-nodal'", timeout=BACK)
    assert page.evaluate(SHOWN) == last
    expect(page.tab.get_by_role("alert")).to_be_hidden()


@pytest.mark.slow
def test_a_server_that_hangs_is_noticed_by_who_waits_for_it(own_server, open_on):
    page = open_on()
    own_server.process.send_signal(signal.SIGSTOP)
    watch(page)
    page.evaluate("() => strikewave.page.choose('speed', 2)")
    said(page, LOST)
    own_server.process.send_signal(signal.SIGCONT)
    page.wait("() => window.strikewave?.page.frame.chosen.speed === 2", timeout=BACK)
    expect(page.tab.get_by_role("alert").filter(has_text=LOST)).to_be_hidden()


TAKE_SOCKET = """() => {
  const { send } = WebSocket.prototype;
  WebSocket.prototype.send = function (...parts) { window.socket = this; return send.apply(this, parts); };
}"""


def test_a_session_that_has_ended_is_replaced_by_another_with_the_same_state(open_page):
    page = open_page("?scene=free-rod&mass_ratio=0.5")
    page.evaluate(TAKE_SOCKET)
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('speed', 2)"))
    page.wait("() => location.search.includes('speed=2')")
    watch(page)
    page.evaluate("() => { window.same = true; strikewave.page.player.go(0.7); socket.close(); }")
    said(page, "connection")
    page.wait("() => !window.same && window.strikewave?.frames > 0", timeout=BACK)
    page.wait("() => strikewave.page.player.t === 0.7")
    chosen = page.header("chosen")
    assert (chosen["scene"], chosen["mass_ratio"], chosen["speed"]) == ("free-rod", 0.5, 2)
