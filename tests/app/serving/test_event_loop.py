"""Nothing that strangers write is computed in the event loop, for which all others wait: whatever they ask, by which
way ever, nothing takes it for longer than LONGEST, of its own thread."""

import asyncio
import json
import urllib.error
import urllib.parse
import urllib.request
from contextlib import suppress

import pytest

from app.lessons.shipped import FOLDER
from app.serving.pages import FIGURES, FILES, LIBRARIES, VERSION
from tests.app import socket_client
from tests.app.lessons.written import HEAD
from tests.app.servers import Server
from tests.app.socket_client import SocketClient, run
from tests.app.strangers import dotted, linkage, named

from . import watched

PATIENT = 240.0  # s
LONGEST = 0.05  # s
TIMES = 2.5  # of what a plain page takes, where that is more: on a machine whose threads share a core, all takes longer
OBJECTS = 2_500  # of a visitor, which are looked through for garbage: 12 ms for 60 visitors on a machine at rest
MECHANISM = "four-bar"
VALUES = {f"target.links.{i}.{key}": "0.012" for i in (1, 2, 3) for key in ("section.width", "section.height")}
MANY = {f"target.links.{i}.{key}": "0.011" for i in range(1, 100) for key in ("length", "mass", "section.radius")} | {
    f"target.joints.{i}.{key}": f"{0.001 * i}" for i in range(1, 100) for key in ("x", "y")
}
SCENES = {
    "20 links of 10 modes": linkage(20, 10),  # within the bounds, and read
    "3 links of 200 modes": linkage(3, 200),
    "20 links of 40 modes": linkage(20, 40),
    "50 links of 200 modes": linkage(50, 200),
    "50 links of 200 modes along": linkage(50, 0, "axial = 200\n"),
    "400 parts": dotted(400, 400),
    "20 parts": dotted(20, 20),
    "6 000 lines": "a\n" * 6_000,
    "deep": "a = " + "[" * 9_000,
}
NAMES = {key: name for key, text in SCENES.items() if len(name := named(text)) <= 3_000}


class Watched(Server):
    """Says in its log what takes its event loop for long."""

    MODULE = watched.__name__


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    server = Watched(tmp_path_factory.mktemp("watched") / "log")
    server.start()
    yield server
    server.end()


@pytest.fixture(scope="module")
def longest(server):
    """Time of the event loop that anything may take [s]."""
    run(visit(server.address, f"?scene={MECHANISM}"))  # what is made once, for the first
    begun = len(server.log.read_text())
    for _ in range(8):
        run(visit(server.address))
    plain = [seconds for seconds, _ in watched.told(server.log.read_text()[begun:])]
    return max(LONGEST, TIMES * max(plain, default=0.0))


@pytest.fixture(autouse=True)
def nothing_takes_long(server, longest):
    before = len(server.log.read_text())
    yield
    said = server.log.read_text()[before:]
    assert server.runs and "Traceback" not in said
    assert [(seconds, doing) for seconds, doing in watched.told(said) if seconds > longest] == []


def get(address, path, **headers):
    with suppress(urllib.error.HTTPError):
        asked = urllib.request.Request(f"http://{address}/{path}", headers=headers)
        with urllib.request.urlopen(asked, timeout=PATIENT) as answer:
            return answer.read()


def post(address, path, content):
    asked = urllib.request.Request(f"http://{address}/{path}", content, {"Origin": f"http://{address}"})
    with suppress(urllib.error.HTTPError), urllib.request.urlopen(asked, timeout=PATIENT) as answer:
        return answer.read()


async def visit(address, query="", **values):
    """Open the page, set these values one after the other, and have each answered or refused; what is shown."""
    client = await SocketClient(address).open(query)
    for name, value in values.items():
        await client.set(name, value)
        answered = False
        while not answered:
            _, content = await client.receive(PATIENT)
            events = content.get("events", [])
            answered = any(each.get("attr") in ("frame", "refused") and each["new"] for each in events)
    client.close()
    return client


WAYS = {  # the largest by each
    "link": ["20 links of 10 modes", "50 links of 200 modes", "20 parts", "6 000 lines", "deep"],
    "socket": ["3 links of 200 modes", "50 links of 200 modes along", "400 parts", "deep"],
    "record": ["20 links of 40 modes", "50 links of 200 modes", "20 parts", "6 000 lines"],
}


@pytest.mark.parametrize("way, key", [(way, key) for way, keys in WAYS.items() for key in keys])
def test_a_scene_is_read_by_a_worker(server, way, key):
    name = NAMES[key]
    if way == "link":
        run(visit(server.address, f"?scene={name}&panel=joints,energy", speed=1.5))
    elif way == "socket":
        run(visit(server.address, "", scene=name, speed=1.5))
    else:
        post(server.address, f"record?scene={name}&kind=force", b"0 1\n1 2\n")


@pytest.mark.parametrize("values", [VALUES, MANY], ids=["values", "many"])
@pytest.mark.parametrize("way", ["link", "record", "socket"])
def test_values_of_bodies_are_read_by_a_worker(server, way, values):
    query = urllib.parse.urlencode({"scene": MECHANISM} | values)
    if way == "link":
        run(visit(server.address, f"?{query}&panel=joints,energy,mode_change", place=0.4))
    elif way == "record":
        post(server.address, f"record?{query}&kind=force", b"0 1\n1 2\n")
    else:
        text = " ".join(f"{key}={value}" for key, value in list(values.items())[:20])
        run(visit(server.address, f"?scene={MECHANISM}&panel=joints,energy", bodies=text, place=0.4))


@pytest.mark.parametrize("coding", ["gzip", "identity"])
def test_files_are_sent_as_they_are_kept(server, coding):
    for name in FILES:
        for _ in range(3):
            assert get(server.address, f"assets/{VERSION}/{name}", **{"Accept-Encoding": coding})


WORDS = "x\nCRITICAL strikewave: FORGED \x1b[31m"
READY = {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": socket_client.READY}
UNKNOWN = [{"type": "object", "name": name, "id": WORDS} for name in ("Div", "Div", WORDS)]


@pytest.mark.parametrize(
    "content",
    [
        {"events": [READY | {"x": UNKNOWN}]},
        {"events": [READY | {"msg_data": socket_client.READY | {"x": UNKNOWN}}]},
        {"events": [READY], "x": UNKNOWN},
        {"events": [{"kind": "ModelChanged", "model": {"id": WORDS}, "attr": WORDS, "new": UNKNOWN}]},
        {"events": UNKNOWN, WORDS: UNKNOWN},
        json.dumps(WORDS),
        WORDS,
    ],
)
def test_no_words_of_strangers_get_into_the_log(server, content):
    """Nor does any of that count as less than a message that is not allowed."""

    async def send():
        client = await SocketClient(server.address).open()
        with suppress(ConnectionError):
            for kind in ("PATCH-DOC", WORDS):
                await client.send(kind, content)
                while (await client.receive())[0] not in ("ERROR", "OK"):
                    pass
        client.close()

    run(send())
    for path in (urllib.parse.quote(WORDS), f"?scene={urllib.parse.quote(WORDS)}", "lessons/%0aFORGED"):
        get(server.address, path, Cookie="FORGED")
    post(server.address, "lesson", WORDS.encode())
    post(server.address, "record?scene=fixed-rod&kind=FORGED", WORDS.encode())
    assert "FORGED" not in server.log.read_text()


def test_other_routes(server):
    for path in (*(name for name, _ in LIBRARIES), "gallery/en", f"assets/{VERSION}/text/en.js", "liveness", ""):
        for coding in ("gzip", "identity"):
            assert get(server.address, path, **{"Accept-Encoding": coding})
    for name in FIGURES:
        assert get(server.address, f"figures/es/{name}")
    for fields in (999, 3_000):
        assert get(server.address, "?" + "&".join(f"target.links.{i % 99 + 1}.length=1" for i in range(fields)))


def test_lessons_of_the_program(server):
    for path in FOLDER.glob("*.md"):
        if path.stem.count(".") == 0:
            assert get(server.address, f"lessons/{path.stem}")


LESSONS = {
    "brackets": HEAD + "## Step\n" + "[" * 150_000,
    "colons": HEAD + "## Step\n" + ":" * 150_000,
    "steps": HEAD + "## Step\n" + ":::{scene}\n:::\n" * 12_000,
    "dots": HEAD + "## Step\n:::{scene}\n" + dotted(400, 400) + ":::\n",
    "costly": HEAD + "## Step\n:::{scene}\nscene = \"bent-rods\"\nchanges = { modes = 200 }\n:::\n" * 20,
}  # fmt: skip


@pytest.mark.parametrize("text", LESSONS.values(), ids=LESSONS)
def test_lessons_of_visitors(server, text):
    post(server.address, "lesson", text.encode())


def test_records(server):
    table = "\n".join(f"{1e-6 * i:.6g} {i % 97}" for i in range(150_000)).encode()
    for content in (table, b"\0" * 1_900_000, b"," * 1_900_000, b"# " + b"x = " * 400_000):
        post(server.address, "record?scene=fixed-rod&kind=force", content)


def test_of_a_visitor_little_is_looked_through_for_garbage(server):
    async def visits(count):
        clients = [await SocketClient(server.address).open() for _ in range(count)]
        begun = len(server.log.read_text())
        await visit(server.address)  # when somebody has left, all is looked through
        while not (found := watched.looked_through(server.log.read_text()[begun:])):
            await asyncio.sleep(0.1)
        for client in clients:
            client.close()
        return found[-1]

    few, many = run(visits(0)), run(visits(20))  # and others who have not been forgotten yet
    assert many > 20 * OBJECTS / 4
    assert many - few < 20 * OBJECTS
