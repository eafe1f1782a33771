"""A measured record sent to the page over HTTP: compared, or refused in a sentence."""

import asyncio
import json
import socket
import urllib.error
import urllib.request
from collections import namedtuple
from typing import Any
from urllib.parse import urlencode

import numpy as np
import pytest
from pytest import approx
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.httpserver import HTTPServer
from tornado.testing import bind_unused_port
from tornado.web import Application

from app.serving import uploads
from app.serving.addresses import Addresses, network_of
from app.serving.uploads import WORKED_ON_OF_ONE, MeasuredRecord, first_to_go
from app.views.record import MAX_POINTS
from solvers.records.files import MAX_BYTES
from tests.app.sentences import sentence

from ...patience import SECONDS
from .. import example_record
from ..socket_client import run

MANY = 20  # records of one address at once
Held = namedtuple("Held", "address bytes")
QUERY = {"scene": "bronze-rod-steel-ball", "kind": "strain", "at": "1.0"}
GOOD = example_record.FILE.read_bytes()
PEAK = 5582.0  # [N], of the scene itself, tests/app/messages/test_axial.py


def post(address, content, origin=None, **query):
    """Status and answer."""
    headers = {"Origin": f"http://{address}" if origin is None else origin}
    url = f"http://{address}/record?{urlencode({k: v for k, v in (QUERY | query).items() if v is not None})}"
    try:
        with urllib.request.urlopen(urllib.request.Request(url, content, headers), timeout=SECONDS) as answer:
            return answer.status, json.load(answer)
    except urllib.error.HTTPError as refused:
        answer = json.load(refused)
        return refused.code, answer | {"error": sentence(answer["error"])}


def test_the_example_is_what_its_header_says():
    header = GOOD.decode().splitlines()[0]
    assert "Synthetic" in header
    assert len({file.read_bytes() for file in example_record.FILES}) == 1
    rows = np.loadtxt(example_record.FILE, delimiter=",", skiprows=3)
    made = example_record.example()
    assert rows[:, 0] == approx(made[:, 0])
    bit = np.diff(np.unique(made[:, 1])).min()
    assert np.abs(rows[:, 1] - made[:, 1]).max() < 1.5 * bit  # a value on the edge may round either way


def test_a_record_is_compared_and_predicts_of_the_force(server):
    status, answer = post(server, GOOD)
    assert status == 200 and answer["kind"] == "strain"
    assert [note["code"] for note in answer["notes"]] == ["pressure-large"]  # a steel ball on bronze
    assert answer["shift"] == approx(-example_record.LATE, abs=0.2e-6)
    assert answer["scale"] == approx(1.0, abs=5e-3)
    assert answer["residual"] < 0.02  # noise of 0.003 of the peak, in a record that is quiet for half of the time
    for history in (answer["time"], answer["computed"]["time"], answer["recovered"]["time"]):
        assert 100 < len(history) <= MAX_POINTS and np.all(np.diff(history) > 0.0)
    assert max(answer["recovered"]["force"]) == approx(PEAK, rel=0.01)
    measured = np.interp(answer["computed"]["time"], answer["time"], answer["values"])
    reported = np.array(answer["computed"]["model"])
    assert np.linalg.norm(measured - reported) < 0.03 * np.linalg.norm(reported)


def test_another_speed_shows_as_another_scale(server):
    _, answer = post(server, GOOD, speed="4.06")
    assert answer["scale"] == approx(2.15, abs=0.15)  # between impulse, as speed, and peak, as speed^(6/5)


def test_a_record_of_force_is_its_own_force(server):
    time = np.linspace(0.0, 1.1e-4, 300)
    rows = "\n".join(f"{1e6 * t:.4f},{PEAK * np.sin(np.pi * t / 1.15e-4):.4f}" for t in time)
    _, answer = post(server, f"time_us,force_N\n{rows}\n".encode(), kind="", at="")
    assert answer["kind"] == "force" and answer["recovered"]["force"] == answer["values"]


def rows(*pairs):
    return ("time_us,microstrain\n" + "\n".join(f"{t},{v}" for t, v in pairs) + "\n").encode()


BAD_FILES = {
    "nothing": (b"", "The record has no rows of numbers; at least 8 are needed."),
    "one line": (rows((0, 0)), "The record has one row of numbers; at least 8 are needed."),
    "not a number": (rows(*((t, "nan" if t == 9 else t % 5) for t in range(20))), "finite"),
    "a hole": (rows(*((t + (500 if t > 9 else 0), t % 5) for t in range(20))), "gap"),
    "wrong unit": (GOOD.replace(b"time_us", b"time_s"), "unit"),
    "binary": (bytes(range(256)) * 40, "text"),
    "constant": (rows(*((t, 1) for t in range(200))), "values that change"),
}


@pytest.mark.parametrize("content, said", BAD_FILES.values(), ids=BAD_FILES)
def test_bad_files_are_refused_in_a_sentence(server, content, said):
    status, answer = post(server, content)
    assert status == 400 and set(answer) == {"error"}
    assert "record" in answer["error"] and "\n" not in answer["error"]
    assert said in answer["error"], answer["error"]


@pytest.mark.parametrize(
    "query, said",
    [
        ({"speed": "1e9"}, "Impact speed: 1000000000.0 is not possible."),
        ({"law": "<script>"}, "Contact law: “…” is not possible"),
        ({"scene": "nowhere"}, "Scene: 'nowhere' is none of the"),
        ({"at": "9"}, "“9” is not possible. Give its distance from the struck end in metres, from 0 to 1.48."),
        ({"at": ""}, "Where does the gauge sit? Give its distance"),
        ({"at": "nan"}, "“nan” is not possible."),
        ({"kind": "colour"}, "kind: got 'colour'"),
        ({"sign": "2"}, "sign: got '2'"),
        ({"scene": "note-rod"}, "A record cannot be compared with bodies in space"),
    ],
    ids=str,
)
def test_wrong_queries_are_refused_in_a_sentence(server, query, said):
    status, answer = post(server, GOOD, **query)
    assert status == 400 and said in answer["error"], answer


def test_what_is_too_large_is_not_kept(server):
    status, answer = post(server, b"1,2\n" * 2_500_000)
    assert status == 413 and "10000000 bytes" in answer["error"] and str(MAX_BYTES) in answer["error"]
    assert post(server, GOOD)[0] == 200


def test_a_body_that_does_not_say_its_size_is_cut(server):
    host, port = server.split(":")
    with socket.create_connection((host, int(port)), timeout=20) as wire:
        head = (
            f"POST /record HTTP/1.1\r\nHost: {server}\r\nOrigin: http://{server}\r\nTransfer-Encoding: chunked\r\n\r\n"
        )
        wire.sendall(head.encode())
        for _ in range(25):
            wire.sendall(b"186a0\r\n" + b"7" * 100_000 + b"\r\n")
        wire.sendall(b"0\r\n\r\n")
        assert wire.recv(100).startswith(b"HTTP/1.1 413")


def test_a_size_that_is_no_size_is_refused(server):
    head = (
        f"POST /record HTTP/1.1\r\nHost: {server}\r\nOrigin: http://{server}\r\nContent-Length: {'0' * 5_000}1\r\n\r\n"
    )
    with socket.create_connection(tuple(server.split(":")), timeout=20) as wire:
        wire.sendall(head.encode())
        assert wire.recv(100).startswith(b"HTTP/1.1 400")


@pytest.mark.parametrize("origin", ["", "http://elsewhere.example", "null", "http://[no-address"])
def test_other_pages_may_not_send_records(server, origin):
    status, answer = post(server, GOOD, origin=origin)
    assert status == 403 and "this page" in answer["error"]


def test_uploads_that_trickle_keep_nobody_out_and_nobody_is_cut_for_them(server):
    host, port = server.split(":")
    head = (
        f"POST /record?{urlencode(QUERY)} HTTP/1.1\r\nHost: {server}\r\nOrigin: http://{server}\r\n"
        f"Content-Length: {len(GOOD)}\r\n\r\n"
    )
    with socket.create_connection((host, int(port)), timeout=60) as honest:
        honest.sendall(head.encode() + GOOD[:-1_000])
        waiting = [socket.create_connection((host, int(port)), timeout=20) for _ in range(60)]
        for wire in waiting:
            wire.sendall(head.encode() + b"1")
        assert post(server, GOOD)[0] == 200
        honest.sendall(GOOD[-1_000:])
        assert honest.recv(100).startswith(b"HTTP/1.1 200")
        for wire in waiting:
            wire.close()


def test_of_many_uploads_the_largest_of_the_address_that_holds_most_goes_first():
    sizes = {"modest": (1_900, 10), "greedy": (700, 900, 800)}
    held: Any = {Held(who, size): size for who, given in sizes.items() for size in given}
    assert (gone := first_to_go(held)).address == "greedy" and held[gone] == 900


class Slow:
    """The handler in this process, where a comparison for these addresses takes until it is let end."""

    def __init__(self, monkeypatch, *addresses):
        self._end = asyncio.Event()

        async def answered(content, arguments, address):
            if address in addresses:
                await self._end.wait()
            return "{}"

        monkeypatch.setattr(uploads, "_answered", answered)
        application = Application([("/record", MeasuredRecord)], addresses=Addresses([network_of("127.0.0.1")]))
        setattr(application, "websocket_origins", {"here:80"})  # noqa: B010  as Bokeh does
        self._server = HTTPServer(application)
        wire, self._port = bind_unused_port()
        self._server.add_socket(wire)

    async def sent(self, address, content=b"1"):
        """The status that is answered to somebody there."""
        headers = {"Origin": "http://here:80", "X-Forwarded-For": address}
        request = HTTPRequest(
            f"http://127.0.0.1:{self._port}/record", "POST", headers, content, request_timeout=SECONDS
        )
        return (await AsyncHTTPClient(max_clients=100, force_instance=True).fetch(request, raise_error=False)).code

    async def end(self, *sent):
        self._end.set()
        codes = await asyncio.gather(*sent)
        self._server.stop()
        return codes


def test_costly_comparisons_of_three_addresses_leave_room_for_others(monkeypatch):
    """24 of them closed it for all."""

    async def compared():
        addresses = [f"203.0.113.{k}" for k in range(1, 4)]
        slow = Slow(monkeypatch, *addresses)
        costly = [asyncio.ensure_future(slow.sent(address)) for address in addresses for _ in range(MANY)]
        while sum(task.done() for task in costly) < 3 * (MANY - WORKED_ON_OF_ONE):
            await asyncio.sleep(0.01)
        assert [await slow.sent("203.0.113.9") for _ in range(3)] == [200] * 3
        return await slow.end(*costly)

    codes = run(compared())
    assert codes.count(200) == 3 * WORKED_ON_OF_ONE and codes.count(429) == 3 * (MANY - WORKED_ON_OF_ONE)


def test_a_record_that_makes_room_while_it_is_compared_is_refused_once(monkeypatch, caplog):
    """It was answered again, and strangers could have traces written."""

    async def compared():
        slow = Slow(monkeypatch, "203.0.113.1")
        monkeypatch.setattr(uploads, "MAX_HELD", 1_000)
        large = asyncio.ensure_future(slow.sent("203.0.113.1", b"1" * 900))
        while not MeasuredRecord._working:
            await asyncio.sleep(0.01)
        assert await slow.sent("203.0.113.2", b"1" * 200) == 200
        return await slow.end(large)

    assert run(compared()) == [429]
    assert not caplog.records or all(record.name == "tornado.access" for record in caplog.records)
    assert not MeasuredRecord._working and not MeasuredRecord._held
