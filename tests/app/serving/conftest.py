"""The folder without a server, of the fixture `folder` of a file, opened and served."""

import functools
import http.server
import threading

import pytest

SECONDS = 60_000  # ms for a page
DESK = {"width": 1280, "height": 720}
POLLING = 0.02  # s between two looks at whether a server is to stop
PLAIN = "sheets.css"  # of every folder: where no page is
SHOWN = "() => window.strikewave?.frames > 0"


class Quiet(http.server.SimpleHTTPRequestHandler):
    extensions_map = {".html": "text/html", ".css": "text/css", ".js": "text/javascript; charset=utf-8"}  # of all

    def log_message(self, *_):
        pass


@pytest.fixture
def opened(windows, folder):
    """Open the folder from the disk, or at another address, with what the page asked for and what went wrong; `before`:
    a script that runs first."""
    used = []

    def open_one(query: str = "", base: str = "", script: str = SHOWN, before: str = "", viewport=DESK, **options):
        options = {"reduced_motion": "reduce"} | options
        base = base or folder.as_uri()
        tab = windows.take(tuple(viewport.values()), options, before)
        tab.asked, tab.errors = [], []
        listeners = {
            "request": lambda request: tab.asked.append(request.url),
            "pageerror": lambda error: tab.errors.append(str(error)),
            "console": lambda line: line.type == "error" and tab.errors.append(line.text),
        }
        for name, listener in listeners.items():
            tab.on(name, listener)
        used.append((tab, listeners, (f"{base}/{PLAIN}", options, before)))
        tab.goto(f"{base}/index.html{query}")
        tab.wait_for_function(script, timeout=SECONDS)
        return tab

    yield open_one
    for tab, listeners, free in used:
        for name, listener in listeners.items():
            tab.remove_listener(name, listener)
        windows.give(tab, *free)


@pytest.fixture
def served(folder):
    """Address of a server of files."""
    handler = functools.partial(Quiet, directory=folder.parent)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, args=(POLLING,), daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}/{folder.name}"
        server.shutdown()


def choose(tab, name: str, value) -> None:
    """As a control does, until it is answered or refused."""
    tab.evaluate("([name, value]) => strikewave.page.choose(name, value)", [name, value])
    tab.wait_for_function("() => !strikewave.page.asked", timeout=SECONDS)
