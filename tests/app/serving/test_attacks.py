"""Every attack of a stranger on the page, replayed on a real server and in a real browser: none works.

Bounded in number and time, and only against a server of its own on this machine.
"""

import asyncio
import base64
import http.client
import json
import socket
import urllib.error
import urllib.request

import bokeh
import panel
import pytest
import tornado
from bokeh.util.token import generate_jwt_token, get_session_id
from tornado.httpclient import AsyncHTTPClient, HTTPRequest

from app.page.lab import VERSION
from app.serving.guard import REPORTED, SETTABLE, decide
from app.serving.limits import MAX_BODY, MAX_REFUSED

from ...patience import SECONDS
from ..conftest import Page
from ..socket_client import SocketClient, run
from .wires import SCRIPT, closed, with_token


def models(tree):
    """Every model of a document that was pulled, with the properties that it says."""
    if isinstance(tree, dict):
        if tree.get("type") == "object" and "id" in tree:
            yield tree["id"], set(tree.get("attributes", {}))
        tree = list(tree.values())
    if isinstance(tree, list):
        for item in tree:
            yield from models(item)


# --- another visitor's session ----------------------------------------------------------------------------------------


def test_a_session_that_a_link_or_a_header_names_is_nobodys(server):
    async def attack():
        client = AsyncHTTPClient()
        for request in (
            HTTPRequest(f"http://{server}/?bokeh-session-id=evil"),
            HTTPRequest(f"http://{server}/", headers={"Bokeh-Session-Id": "evil"}),
        ):
            page = (await client.fetch(request)).body.decode()
            token = json.loads(page.split('id="session">')[1].split("<")[0])["token"]
            assert get_session_id(token) != "evil"
        invented = generate_jwt_token("evil", signed=False, expiration=300)
        assert await closed(await with_token(server, invented)) == (1008, "serving.out-of-date")
        genuine = await SocketClient(server).open()
        for path in (f"?bokeh-token={genuine.token}", f"?bokeh-session-id={get_session_id(genuine.token)}"):
            page = (await client.fetch(f"http://{server}/{path}")).body.decode()
            assert genuine.token not in page and get_session_id(genuine.token) not in page
        genuine.close()

    run(attack())


@pytest.mark.parametrize(
    "path",
    [
        *("autoload.js", "autoload.js?bokeh-autoload-element=x&bokeh-session-id=evil", "metadata", "ws/metadata"),
        *("components/antigravity/x/_css/y", "components/app.page.lab/Lab/_bundle_path/page.js", "rest/session_info"),
    ],
)
def test_other_ways_in_do_not_exist(server, path):
    with pytest.raises(urllib.error.HTTPError) as refused:
        urllib.request.urlopen(f"http://{server}/{path}")
    assert refused.value.code == 404


def test_a_token_opens_one_socket(server):
    async def attack():
        first = await SocketClient(server).open()
        for _ in range(10):
            code, reason = await closed(await with_token(server, first.token))
            assert code == 1008 and reason == "serving.open-already"
        await first.set("mass_ratio", 1.75)
        await first.answer()
        first.close()
        await asyncio.sleep(0.5)
        again = await SocketClient(server).connect(first.token)  # as a browser does that lost its connection
        await again.set("mass_ratio", 1.8)
        await again.answer()
        again.close()

    run(attack())


@pytest.mark.slow
def test_no_model_and_no_property_of_the_document_can_be_set_but_the_choices(server):
    """Also with analyses open: their figures are the browser's own, so that the document stays as small as it is."""

    async def attack():
        client = await SocketClient(server).open("?panel=energy,ratios")
        await client.changed("energy", "ratios")
        await client.send("PULL-DOC-REQ", {})
        while "doc" not in (await client.receive())[1]:
            pass
        found = list(models(client.last["doc"]))
        assert 0 < len(found) < 20
        own, tried = client.lab["id"], 0
        for model, properties in sorted(found, key=lambda each: each[0] != own):
            wanted = properties | {"esm", "text", "visible", "name", "data", "stylesheets"}
            for name in sorted(wanted - SETTABLE if model == own else wanted):
                change = {"kind": "ModelChanged", "model": {"id": model}, "attr": name, "new": SCRIPT[:90]}
                assert decide("PATCH-DOC", {"events": [change]}, own, SETTABLE).events == [], (model, name)
                if name in REPORTED:
                    continue
                await client.patch(change)  # and on the wire
                kind = "PATCH-DOC"
                while kind == "PATCH-DOC":
                    kind, content = await client.receive()
                assert kind == "ERROR", (model, name)
                assert "Traceback" not in json.dumps({k: v for k, v in content.items() if k != "buffers"})
                tried += 1
        assert 30 < tried < MAX_REFUSED  # every one of them, on the wire
        client.close()

    run(attack())


def test_the_attack_of_a_link_does_not_reach_a_visitors_page(browser, server):
    """A victim opens a link that names a session; the attacker opens a socket to it and sends a script."""
    page = Page(browser, server, "?bokeh-session-id=evil")

    async def attack():
        invented = generate_jwt_token("evil", signed=False, expiration=300)
        await closed(await with_token(server, invented))
        attacker = await SocketClient(server).open("?bokeh-session-id=evil")
        for model, attr in ((attacker.lab["id"], "frame"), ("p1", "esm"), ("p2", "text"), (attacker.lab["id"], "esm")):
            await attacker.patch({"kind": "ModelChanged", "model": {"id": model}, "attr": attr, "new": SCRIPT[:90]})
        await attacker.set("mass_ratio", 5.0)
        await attacker.answer()
        attacker.close()

    run(attack())
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('speed', 2)"))  # what came before is there
    assert page.evaluate("() => window.stolen") is None
    assert page.header("chosen")["mass_ratio"] == 1.0
    assert page.errors == []
    page.context.close()


def test_a_script_that_gets_into_the_page_does_not_run(browser, server):
    page = Page(browser, server)
    ran = page.evaluate(
        """async () => {
          const inline = document.createElement('script');
          inline.textContent = 'window.stolen = 1';
          document.body.append(inline);
          const image = document.createElement('div');
          image.innerHTML = '<img src="x" onerror="window.stolen = 2">';
          const failed = new Promise((done) => image.firstChild.addEventListener('error', () => setTimeout(done)));
          document.body.append(image);
          await failed;  // and what stands in its attribute would have run
          return window.stolen;
        }"""
    )
    assert ran is None
    assert any("Content Security Policy" in error for error in page.errors)
    page.context.close()


def test_headers_name_no_version_and_no_frame_of_others(server):
    with urllib.request.urlopen(f"http://{server}/") as page:
        policy = page.headers["Content-Security-Policy"]
        assert "frame-ancestors 'self'" in policy and "default-src 'none'" in policy
        assert "'unsafe-inline'" not in policy.split("script-src")[1].split(";")[0] and "'unsafe-eval'" not in policy
        assert page.headers["Server"] is None and page.headers["X-Frame-Options"] == "SAMEORIGIN"

    async def ask():
        client = await SocketClient(server).open()
        await client.send("SERVER-INFO-REQ", {})
        kind, content = await client.receive()
        while kind == "PATCH-DOC" or kind == "OK":
            kind, content = await client.receive()
        assert kind == "ERROR" and "version" not in json.dumps(content)
        client.close()

    run(ask())


# --- odd requests -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", ["FOO", "OPTIONS", "PUT", "DELETE", "PATCH", "TRACE", "CONNECT", "HEAD", "GET"])
@pytest.mark.parametrize("path", ["/record", "/", "/ws", f"/assets/{VERSION}/page.js"])
def test_odd_methods_are_answered_in_a_line(server, method, path):
    connection = http.client.HTTPConnection(*server.split(":"), timeout=20)
    connection.request(method, path, body=b"x" if method in ("PUT", "PATCH") else None)
    answer = connection.getresponse()
    assert answer.status in (200, 204, 400, 403, 404, 405, 426)
    assert b"Traceback" not in answer.read()


@pytest.mark.parametrize(
    "path",
    [f"/assets/{VERSION}/%00", f"/assets/{VERSION}/page.js%00", "/static/%00", "/static/js/%00.js", "/%00", "/static/"],
)
def test_odd_paths_are_not_found(server, path):
    connection = http.client.HTTPConnection(*server.split(":"), timeout=20)
    connection.request("GET", path)
    assert connection.getresponse().status in (403, 404)


@pytest.mark.parametrize(
    "path",
    ["extensions/panel/panel.min.js", "extensions/panel/css/loading.css", "js/bokeh.min.js", "js/lib/core/dom.js"],
)
def test_no_files_of_the_libraries_are_served_but_those_of_the_page(server, path):
    for method in ("GET", "HEAD"):
        connection = http.client.HTTPConnection(*server.split(":"), timeout=SECONDS)
        connection.request(method, f"/static/{path}")
        assert connection.getresponse().status == 404


def test_neither_page_nor_document_names_a_version(server):
    async def opened():
        client = await SocketClient(server).open("?panel=energy")
        client.close()
        return client.html + json.dumps(client.document)

    said = run(opened())
    assert {version for version in (panel.__version__, bokeh.__version__, tornado.version) if version in said} == set()
    assert "static/" not in said


def test_a_body_that_is_too_long_is_not_read(server):
    for path, size in (("/", MAX_BODY + 1), ("/", 99_000_000)):
        with socket.create_connection(tuple(server.split(":")), timeout=20) as wire:
            head = f"POST {path} HTTP/1.1\r\nHost: {server}\r\nContent-Length: {size}\r\n\r\n"
            wire.sendall(head.encode() + b"x" * 1000)
            answer = wire.recv(200)
            assert answer == b"" or answer.startswith((b"HTTP/1.1 400", b"HTTP/1.1 405", b"HTTP/1.1 413"))


@pytest.mark.slow
def test_pages_asked_for_from_five_addresses_shut_nobody_out(own_server):
    """Beyond 300 that waited everybody was told that the server is full: 475 connections of five did that."""
    where, wires = ("127.0.0.1", own_server.port), []
    request = f"GET / HTTP/1.1\r\nHost: {own_server.address}\r\n\r\n".encode()
    try:
        for number in range(475):
            source = (f"127.0.0.{2 + number % 5}", 0)
            wires.append(socket.create_connection(where, timeout=60, source_address=source))
        for wire in wires:
            wire.sendall(3 * request)  # who is answered asks again at once
        for _ in range(5):
            assert urllib.request.urlopen(f"http://{own_server.address}/", timeout=60).status == 200
    finally:
        for wire in wires:
            wire.close()


# --- costly choices ---------------------------------------------------------------------------------------------------


def test_tokens_are_not_bombs(server):
    """A token whose payload would unpack to much is refused before it is unpacked."""
    import zlib

    packed = base64.urlsafe_b64encode(zlib.compress(b" " * 10_000_000)).decode().rstrip("=")
    body = base64.urlsafe_b64encode(json.dumps({"session_id": "x", "__bk__zlib_": packed}).encode()).decode()

    async def attack():
        assert (await closed(await with_token(server, body.rstrip("="))))[0] == 1008

    run(attack())
