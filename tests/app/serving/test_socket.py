"""A client that is no browser, on a real socket: what it may not do, and what becomes of the page meanwhile."""

import asyncio
import json
import re
import urllib.error
import urllib.request
from contextlib import suppress
from types import SimpleNamespace

import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import WebSocketClosedError, websocket_connect

from app.choices.choices import Choices
from app.jobs.loops import of_loop
from app.jobs.turns import Turnstile
from app.page.lab import VERSION
from app.serving.limits import MAX_CLOSING
from app.serving.sockets import LIMIT, Socket
from tests.app.sentences import refusals

from ...patience import SECONDS
from ..servers import Meter
from ..socket_client import SocketClient, run
from .wires import closed

NAN = {"type": "number", "value": "nan"}
INFINITE = {"type": "number", "value": "+inf"}


async def opened(address: str, query: str = "") -> SocketClient:
    client = await SocketClient(address).open(query)
    await client.changes(0.3)
    return client


def wrong_values():
    for name in Choices.CHOSEN:
        bounds = getattr(Choices.param[name], "bounds", None)
        if bounds is None:
            yield name, "nonsense"
        else:
            for value in (bounds[0] - 1, bounds[1] * 2, -1e300, 10**30, NAN, INFINITE):
                yield name, value


@pytest.mark.slow
def test_every_value_out_of_bounds_is_refused_and_set_back(server):
    async def attack():
        client = await opened(server)
        for name, value in wrong_values():
            await client.set(name, value)
            await client.refusal(name)
        await client.set("mass_ratio", 2.0)  # still at work, and with the old values of all the rest
        await client.answer()
        client.close()

    run(attack())


@pytest.mark.parametrize("value", ["a string", None, [1, 2], {"type": "object", "name": "Div", "id": "p1"}, False])
def test_a_wrong_type_is_refused_without_a_stack_trace(server, value):
    async def attack():
        client = await opened(server)
        await client.set("speed", value)
        await client.refusal("speed")
        assert "Traceback" not in json.dumps({k: v for k, v in client.last.items() if k != "buffers"})
        client.close()

    run(attack())


async def refused(client: SocketClient) -> str:
    """The next sentence that refuses something; nothing is solved before."""
    while True:
        for event in (await client.receive())[1].get("events", []):
            assert event.get("attr") != "frame"
            if event.get("attr") == "refused" and event["new"]:
                return refusals(event["new"])[0]


def test_values_of_bodies_that_cannot_be_are_refused_and_set_back(server):
    lengths = [f"target.length={value}" for value in ("-1", "0", "nan", "1e400", "1_0", "x" * 40)]

    async def attack():
        client = await opened(server)
        for value in [*lengths, "target.length=1 x", "x" * 700, 1.0, NAN, None]:
            await client.set("bodies", value)
            await client.refusal("bodies")
        for value in [*lengths, "impactor.length=1", "target.rods.2", "=", "<b>"]:
            await client.set("body_value", value)
            await refused(client)
        await client.set("bodies", "target.rods.2.length=1")  # which another scene has: refused where it is solved
        assert "no such value" in await refused(client)
        await client.set("body_value", "target.length=0.5")
        await client.answer()
        client.close()

    run(attack(), 60.0)


@pytest.mark.parametrize("name", ["frame", "refused", "waiting", "spec", "visible", "esm"])
def test_what_is_no_choice_cannot_be_changed_for_others(server, name):
    async def attack():
        client = await opened(server)
        await client.set(name, "<script>alert(1)</script>")
        await client.changes(0.2)
        other = await opened(server)
        assert "alert(1)" not in other.html
        await other.set("mass_ratio", 3.0)
        await other.answer()
        client.close()
        other.close()

    run(attack())


def test_a_flood_of_foreign_events_costs_nobody_anything(server, started):
    root = {"kind": "RootAdded", "model": {"type": "object", "name": "Div", "id": "p9"}, "setter": None}

    async def attack():
        client, other = await opened(server), await opened(server)
        meter = Meter(started)
        await client.patch(*[root] * 100)
        await other.set("mass_ratio", 3.0)
        await other.answer()
        assert meter.read() < 15.0  # unguarded it computes for 25 s
        assert (await client.receive())[0] == "ERROR"
        await client.send("PUSH-DOC", {"doc": {}})
        assert (await client.receive())[0] == "ERROR"
        assert (await client.changes(0.3))[1] == []
        client.close()
        other.close()

    run(attack())


@pytest.mark.parametrize(
    "content", ["{", "[]", '{"events": 3}', '{"events": [null, 1, {}]}', '{"events": [{"kind": []}]}']
)
def test_broken_messages_are_refused_and_the_page_stays(server, content):
    async def attack():
        client = await opened(server)
        await client.send("PATCH-DOC", content)
        try:
            _, kinds = await client.changes(0.4)
            assert set(kinds) <= {"ERROR"}
        except ConnectionError:
            pass  # hanging up is an answer too
        other = await opened(server)
        await other.set("modes", 9)
        await other.answer()
        other.close()

    run(attack())


HEADER = '{"msgid": "1", "msgtype": "PATCH-DOC"}'
NESTED = "[" * 9_000
UNREADABLE = {
    "content without end": (HEADER, "{}", NESTED),
    "header without end": (NESTED, "{}", "{}"),
    "no header": ("1", "{}", "{}"),
    "a header of nothing": ("[]", "{}", "{}"),
    "no id": ('{"msgtype": "PATCH-DOC"}', "{}", '{"events": []}'),
    "an odd kind": ('{"msgid": "1", "msgtype": []}', "{}", "{}"),
    "no content": (HEADER, "{}", "null"),
    "buffers": ('{"msgid": "1", "msgtype": "PATCH-DOC", "num_buffers": 1e9}', "{}", '{"events": []}'),
}


@pytest.mark.parametrize("parts", UNREADABLE.values(), ids=UNREADABLE)
def test_what_cannot_be_read_closes_its_socket_without_a_line_in_the_log(server, started, parts):
    """Strangers had lines written at will, and of a message with buffers without end all were kept."""

    async def attack():
        client, before = await opened(server), started.log.read_text()
        with suppress(WebSocketClosedError):  # it may be closed before all has been sent
            for part in parts:
                await client._socket.write_message(part)
        assert await closed(client._socket) == (1008, "serving.unreadable")
        assert started.log.read_text() == before

    run(attack())


@pytest.mark.slow
@pytest.mark.parametrize("frame", [b"\x89\x80", b"\x8a\x80", b"\x00\x80"], ids=["pings", "pongs", "fragments"])
def test_who_floods_with_what_is_no_message_is_closed(server, frame):
    """Five such sockets let others wait for 3 s."""

    async def attack():
        client = await opened(server)
        stream, mask = client._socket.protocol.stream, bytes(4)
        await stream.write(b"\x01\x80" + mask if frame[0] == 0 else b"")  # a message, of which nothing else comes
        flood = asyncio.ensure_future(stream.write((frame + mask) * 20_000))
        assert (await closed(client._socket, 60.0))[0] == 1008
        flood.cancel()

    run(attack())


def test_too_long_a_message_closes_only_its_own_connection(server):
    async def attack():
        client = await opened(server)
        await client.set("law", "x" * 100_000)
        with pytest.raises(ConnectionError):
            await client.changes(20.0)
        other = await opened(server)
        await other.set("modes", 9)
        await other.answer()
        other.close()

    run(attack())


def test_a_page_of_another_site_cannot_connect(server):
    async def attack():
        client = await SocketClient(server).open()
        for origin in ("http://elsewhere.example", "http://[no-address"):
            with pytest.raises(Exception, match="403"):
                await websocket_connect(HTTPRequest(f"ws://{server}/ws", headers={"Origin": origin}))
        client.close()

    run(attack())


@pytest.mark.slow
def test_many_changes_at_once_end_with_the_newest(server):
    async def hurry():
        client = await opened(server)
        for k in range(13):  # a page would wait for the answer to the first: the others are read slowly
            await client.set("mass_ratio", 1.0 + k / 64)
        while b'"mass_ratio":1.1875' not in client.last_frame:
            await client.answer()
        await client.changes(1.0)  # of a machine that is slow a first one is a draft
        assert b'"mass_ratio":1.1875' in client.last_frame  # the newest choice is the last
        client.close()

    run(hurry())


def test_headers_and_paths_are_safe(server):
    with urllib.request.urlopen(f"http://{server}/") as page:
        assert "'unsafe-eval'" not in page.headers["Content-Security-Policy"]
        assert page.headers["X-Content-Type-Options"] == "nosniff"
    assert json.load(urllib.request.urlopen(f"http://{server}/liveness?endpoint=/")) == {"alive": True}
    version = VERSION
    for path in (f"assets/{version}/../lab.py", f"assets/{version}/%2e%2e/lab.py", "admin", "rest/session_info"):
        with pytest.raises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(f"http://{server}/{path}")
        assert refused.value.code in (403, 404)
        assert "Traceback" not in refused.value.read().decode()


def test_a_bad_address_is_answered_with_the_page(server):
    for query in (
        "?mass_ratio=",
        "?mass_ratio=%ff%fe",
        "?modes=1.5",
        "?speed=nan",
        "?law=" + "x" * 5000,
        "?scene=../x",
    ):
        with urllib.request.urlopen(f"http://{server}/{query}") as page:
            assert page.status == 200
            assert "Traceback" not in page.read().decode()


def test_the_document_names_no_version(server):
    async def visit():
        client = await SocketClient(server).open()
        client.close()
        return client.document

    document = run(visit())
    assert "version" not in document and document["roots"]


def test_who_leaves_while_the_socket_opens_leaves_no_trace(server):
    """The server's log is read at the end of all tests: a stack trace in it fails them."""

    async def visit(seconds: float) -> None:
        page = await AsyncHTTPClient().fetch(f"http://{server}/", request_timeout=SECONDS)
        token = re.search(r'"token":\s*"([^"]+)"', page.body.decode()).group(1)
        socket = await websocket_connect(f"ws://{server}/ws", subprotocols=["bokeh", token])
        await asyncio.sleep(seconds)
        socket.close()

    async def visits() -> None:
        for number in range(20):
            await visit(0.002 * number)  # of which some leave before their session has begun
        client = await opened(server)
        await client.set("mass_ratio", 3.0)
        await client.answer()
        client.close()

    run(visits())


@pytest.mark.parametrize("part", ["x", "[]", "null", "[" * 9_000, "1" * 9_000, '{"msgid":[],"msgtype":[]}', b"buffer"])
def test_what_cannot_be_read_closes_the_socket_and_leaves_no_line_in_the_log(server, started, part):
    """A log grew at the will of strangers."""

    async def attack():
        client = await opened(server)
        with suppress(WebSocketClosedError):
            for each in (part, "{}", "{}"):
                await client._socket.write_message(each, isinstance(each, bytes))
        await closed(client._socket)

    before = started.log.read_text()
    run(attack())
    assert started.log.read_text() == before


def test_buffers_are_not_kept(server):
    """A message that announces buffers without end was kept until the machine had no memory: 10 MB a second."""

    async def attack():
        client = await opened(server)
        header = {"msgid": "a", "msgtype": "PATCH-DOC", "num_buffers": 10**9}
        with suppress(WebSocketClosedError):
            for part in (json.dumps(header), "{}", "{}", '{"id": "b"}', b"x" * 1_000):
                await client._socket.write_message(part, isinstance(part, bytes))
        assert (await closed(client._socket))[0] == LIMIT

    run(attack())


def test_who_leaves_before_his_turn_keeps_no_place_in_the_line():
    """Sockets opened and reset at once, by tokens that were hoarded, kept all others out for a minute."""

    async def leave() -> list[bool]:
        turnstile = of_loop(Turnstile)
        others = [asyncio.ensure_future(turnstile.enter(number)) for number in range(20)]
        await asyncio.sleep(0)
        socket = Socket.__new__(Socket)
        socket.address, socket.ws_connection, socket._out = "203.0.113.1", None, False
        opening = asyncio.ensure_future(socket._async_open("token"))
        await asyncio.sleep(0)
        socket.on_close()
        await opening
        return [each.done() for each in others]

    assert not all(run(leave()))


def test_sockets_whose_end_is_not_answered_are_few():
    """Each kept its file for five seconds: 2 000 of them within eight."""
    aborted = []

    async def end():
        for number in range(MAX_CLOSING + 3):
            socket = Socket.__new__(Socket)
            protocol = SimpleNamespace(close=lambda *_: None, _abort=lambda number=number: aborted.append(number))
            socket.ws_connection = protocol
            socket._end("")
        assert aborted == [0, 1, 2]
        while Socket._closing:
            await asyncio.sleep(0.05)

    run(end())
    assert sorted(aborted) == list(range(MAX_CLOSING + 3))
