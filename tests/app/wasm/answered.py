"""What a module answers to impacts, by Node and by Firefox."""

import json
import os
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from typing import Any

import numpy as np

from app.wasm.module import MODULE

HERE = Path(__file__).parent
ROOT = Path(__file__).parents[3]
FIREFOX = os.environ.get("FIREFOX") or shutil.which("firefox-esr")
PATIENCE, ENDING = 240, 20  # s: a first start on a busy machine
QUIET = {
    "app.normandy.enabled": False,
    "browser.aboutwelcome.enabled": False,
    "browser.preonboarding.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "network.captive-portal-service.enabled": False,
    "network.connectivity-service.enabled": False,
    "network.proxy.type": 0,
    "services.settings.server": "",
    "toolkit.telemetry.enabled": False,
}  # it asks nobody but the server here

Answers = dict[str, list[Any]]  # by the kind of impact; nothing of one that the module leaves to the server


def by_node(given: Answers, module: Path = MODULE, share: float | None = None) -> Answers:
    """Of impacts, by their kinds; CalledProcessError where Node fails.

    share: of the times that each looks at the clock; then how it is left so, as `answers.mjs` has it.
    """
    module = Path(os.environ.get("MODULE", module))  # one built anew: `make machines`
    command = ["node", HERE / "node.mjs", module, *([] if share is None else [str(share)])]
    done = subprocess.run(command, input=json.dumps(given), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def apart(found: Sequence[float | None], known: Sequence[float] | np.ndarray, rel: float, close: float) -> list:
    """Places and values that differ, as `pytest.approx` has it, which takes long over so many."""
    here, there = np.array(found, float), np.asarray(known)  # None, as JSON has it, is NaN
    assert here.shape == there.shape
    with np.errstate(invalid="ignore"):
        near = np.abs(here - there) <= np.maximum(rel * np.abs(there), close)
    near |= (here == there) | (np.isnan(here) & np.isnan(there))
    return [(int(place), here[place], there[place]) for place in np.flatnonzero(~near)]


def by_firefox(given: Answers, folder: Path) -> Answers:
    """The same, by a page in a Firefox that has this empty folder for its profile."""
    told: Queue[Answers] = Queue()
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Told, given, told))
    Thread(target=server.serve_forever, daemon=True).start()
    try:
        with firefox(f"http://127.0.0.1:{server.server_port}/{HERE.relative_to(ROOT)}/answers.html", folder):
            answers = told.get(timeout=PATIENCE)
    except Empty:
        raise AssertionError(f"Firefox has not answered within {PATIENCE} s: {folder / 'log'}") from None
    finally:
        server.shutdown()
        server.server_close()
    assert isinstance(answers, dict), answers  # else what went wrong
    return answers


@contextmanager
def firefox(address: str, folder: Path) -> Iterator[None]:
    """Without a window, while it shows what is there."""
    assert FIREFOX
    lines = [f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in QUIET.items()]
    (folder / "user.js").write_text("".join(lines), encoding="utf-8")
    command = [FIREFOX, "--headless", "--no-remote", "--profile", folder, address]
    with (folder / "log").open("wb") as log, subprocess.Popen(command, stdout=log, stderr=log) as process:
        try:
            yield
        finally:
            process.terminate()
            try:
                process.wait(ENDING)
            except subprocess.TimeoutExpired:
                process.kill()


class Told(SimpleHTTPRequestHandler):
    """Files of the project, what is asked, and a place for the answers."""

    extensions_map = {".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript"}

    def __init__(self, given: Answers, told: Queue[Answers], *rest: Any):
        self.given, self.told = given, told
        super().__init__(*rest, directory=str(ROOT))

    def do_GET(self) -> None:
        if self.path.endswith("/given"):
            self._say(json.dumps(self.given).encode())
        else:
            super().do_GET()

    def do_POST(self) -> None:
        self.told.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self._say(b"")

    def _say(self, body: bytes) -> None:
        self.send_response(200)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_: Any) -> None:
        """None: of a page that answers, nothing is to be said."""
