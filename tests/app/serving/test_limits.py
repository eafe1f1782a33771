"""How much a visitor may take, on a real server: floods are closed, costly choices leave others their answers.

Bounded in number and time, and only against a server of its own on this machine.
"""

import asyncio
import re
import signal
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from playwright.sync_api import expect
from tornado.httpclient import AsyncHTTPClient

from app.serving.limits import HASTE_BURST, MAX_REFUSED, OVER_PAUSE

from ...patience import SECONDS
from ..conftest import Page
from ..servers import Meter
from ..socket_client import SocketClient, run
from .wires import SCRIPT, closed, with_token

# --- floods -----------------------------------------------------------------------------------------------------------


async def flood(server):
    """A socket that does not wait is slowed, told why and closed."""
    client = await SocketClient(server).open()
    sent = 0
    try:
        for k in range(6_000):
            await asyncio.wait_for(client.set("mass_ratio", 1.0 + k / 6_000), 5.0)
            sent += 1
    except (OSError, TimeoutError, ConnectionError, Exception):
        pass
    said = None
    try:
        while True:
            _, content = await client.receive(20.0)
            for event in content.get("events", []):
                if event.get("attr") == "disconnected":
                    said = event["new"]
    except ConnectionError as error:
        assert "1008" in str(error)
    assert said == "serving.too-much"
    assert sent > HASTE_BURST
    assert (await closed(await with_token(server, client.token)))[0] == 1008  # nor does it come back


@pytest.mark.slow
def test_a_page_that_sends_as_soon_as_it_is_answered_is_never_slowed(server):
    async def drag():
        client, seconds = await SocketClient(server).open(), []
        for k in range(1, 101):
            begun = time.monotonic()
            await client.set("mass_ratio", 1.0 + k / 256)
            while f'"mass_ratio":{1.0 + k / 256}'.encode() not in client.last_frame:
                await client.answer()
            seconds.append(time.monotonic() - begun)
        # Each of three parts would wait for that: who is slowed has no quick answer, who is only on a busy machine has.
        assert all(min(seconds[k : k + 10]) < OVER_PAUSE for k in range(0, 100, 10)), seconds
        client.close()

    run(drag())


@pytest.mark.slow
def test_refusals_without_end_close_the_socket_and_just_fewer_do_not(server):
    async def attack(count):
        client = await SocketClient(server).open()
        for _ in range(count):
            await client.set("esm", SCRIPT[:90])
            await asyncio.sleep(0.002)
        try:
            await client.set("mass_ratio", 1.0 + count / 1000)
            await client.answer()
            client.close()
            return True
        except Exception:
            return False

    assert run(attack(MAX_REFUSED - 10)) and not run(attack(MAX_REFUSED + 10))


@pytest.mark.slow
def test_who_comes_after_a_flood_from_his_address_gets_in(server):
    """Sockets that were opened and closed meanwhile kept their places in the line: 200 of them, for minutes."""

    async def attack():
        client = await SocketClient(server).open()
        for _ in range(MAX_REFUSED + 10):
            await client.set("esm", SCRIPT[:90])
        assert (await closed(client._socket))[0] == 1008
        page = await AsyncHTTPClient().fetch(f"http://{server}/", request_timeout=SECONDS)
        token = re.search(r'"token":\s*"([^"]+)"', page.body.decode()).group(1)
        for _ in range(100):
            (await with_token(server, token)).close()
        honest = await asyncio.wait_for(SocketClient(server).open(), 60.0)
        await honest.set("mass_ratio", 3.0)
        await honest.answer()
        honest.close()

    run(attack(), 200)


@pytest.mark.slow
def test_a_fetched_page_solves_nothing_and_makes_no_document(started):
    async def fetch():
        client, meter = AsyncHTTPClient(), Meter(started)
        for k in range(10):
            queries = (f"http://{started.address}/?mass_ratio={1 + k / 100 + i / 1000}&modes=200" for i in range(10))
            pages = await asyncio.gather(*(client.fetch(query, request_timeout=SECONDS) for query in queries))
            assert {page.code for page in pages} <= {200}
        return meter.read()

    assert run(fetch()) < 3.0  # each took a solve before: 37 ms of computing and a document


# --- costly choices ---------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_nothing_goes_on_for_who_has_left(own_server):
    async def leave():
        client = await SocketClient(own_server.address).open()
        for name, value in (("method", "mode-switch"), ("modes", 200), ("mass_ratio", 0.00123)):
            await client.set(name, value)
        meter = Meter(own_server, solves=True)
        while max(meter.used.values(), default=0.0) < 1.0:  # it is under way
            await asyncio.sleep(0.1)
            meter.read()
        solver = max(meter.used, key=meter.used.__getitem__)  # others may compute for the server itself
        client.close()
        seconds = [meter.used[solver]]
        while len(seconds) < 30 or seconds[-1] > seconds[-30]:  # until it computes no more
            await asyncio.sleep(0.1)
            meter.read()
            seconds.append(meter.used[solver])
        return seconds[-1] - seconds[0]

    assert run(leave()) < 2.0  # the solve would go on for 10 s, and is given up then


@pytest.mark.slow
def test_two_visitors_on_the_costliest_choices_leave_the_others_their_answers(own_server):
    address = own_server.address

    async def costly(number):
        client = await SocketClient(address).open()
        await client.set("method", "mode-switch")
        await client.set("modes", 200)
        for k in range(200):
            await client.set("mass_ratio", 0.001 + 1e-5 * (k + 500 * number))
            await client.changes(0.4)

    async def attack():
        honest = await SocketClient(address).open()
        await honest.changes(1.0)
        others = [asyncio.ensure_future(costly(number)) for number in range(2)]
        meter = Meter(own_server, solves=True)
        while meter.read() < 2.0:
            await asyncio.sleep(0.1)
        seconds = []
        for k in range(15):
            meter = Meter(own_server)
            await honest.set("mass_ratio", 1.1 + k / 64)
            await asyncio.wait_for(honest.answer(), 60.0)
            seconds.append(meter.read())
        for task in others:
            task.cancel()
        await asyncio.gather(*others, return_exceptions=True)
        return sorted(seconds)

    seconds = run(attack(), 200)
    # Of computing until an honest visitor has his answer: it was 10 s; `python -m bench --only visitors` measures it.
    assert seconds[len(seconds) // 2] < 5.0
    meter = Meter(own_server)
    own_server.process.send_signal(signal.SIGTERM)
    while own_server.runs:
        meter.read()
        time.sleep(0.05)
    assert own_server.process.returncode == 0
    assert meter.read() < 8.0  # it waited for the solves, 13 s


def test_what_takes_too_long_is_given_up_with_a_sentence(browser, server):
    """The choices before it are still shown, and the page says what the limit did."""
    page = Page(browser, server)
    page.evaluate(
        """() => { const { page } = strikewave;
          page.send('modes', 200); page.send('method', 'mode-switch'); page.send('mass_ratio', 0.001); }"""
    )
    page.wait("() => /serving.longer/.test(strikewave.page.model.waiting)", timeout=180_000)
    given_up = "/serving.given-up.*: 10/.test(strikewave.page.model.refused)"
    page.wait(f"() => {given_up} || strikewave.page.frame.chosen.mass_ratio === 0.001", timeout=180_000)
    page.context.close()


def test_who_floods_is_turned_out_and_a_page_says_why_and_offers_the_way_back(browser, server):
    """A socket and a page at once, as each takes seconds."""
    with ThreadPoolExecutor(1) as beside:
        flooded = beside.submit(asyncio.run, asyncio.wait_for(flood(server), 120))
        page = Page(browser, server)
        flood_by_page(page)
        flooded.result()


def flood_by_page(page) -> None:
    page.evaluate(
        """async () => {
          const { model } = strikewave.page;
          for (let k = 0; k < 9000; k++) {
            model.mass_ratio = 1 + k / 9000;
            if (model.disconnected) break;
            if (k % 10 === 0) await new Promise((done) => setTimeout(done, 20));
          }
        }"""
    )
    notice = page.tab.get_by_role("alert")
    expect(notice).to_contain_text("Too much came from this page at once: it was disconnected.")
    expect(notice).to_be_in_viewport()
    page.evaluate("() => { strikewave.page.player.toggle(); }")  # what is shown still plays
    before = page.evaluate("() => strikewave.page.painted")
    page.wait("before => strikewave.page.painted > before + 5", before)
    notice.get_by_role("button", name="Reload").click()
    page.laid_out()
    expect(page.tab.get_by_role("alert")).to_be_hidden()
    page.context.close()


def test_a_page_for_which_there_is_no_room_says_so(browser, server):
    context = browser.new_context()
    tab = context.new_page()
    tab.add_init_script("window.WebSocket = class { constructor() { setTimeout(() => this.onerror?.(), 50); } }")
    tab.goto(f"http://{server}/")
    expect(tab.get_by_text("The page could not be opened")).to_be_visible()
    context.close()
