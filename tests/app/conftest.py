"""One server and one browser for all tests of the page."""

import os
import shutil
import signal

import pytest
from playwright.sync_api import expect, sync_playwright

from .servers import Server

pytest.register_assert_rewrite("tests.app.page.hands", "tests.app.page.students")  # which say what they have found

LABORATORY = "?layout=laboratory"  # the first scene, with all charts and controls
MEDIA = ("media", "reduced_motion", "color_scheme", "forced_colors", "contrast")  # that a test may emulate
# ms, for a machine that does much else beside, and compiles what no other test has asked for.
PATIENCE = int(os.environ.get("PATIENCE", 100)) * 1000
POLLING = 30  # ms between two looks; at every frame, they would keep the browser drawing
expect.set_options(timeout=PATIENCE)

QUIET = [
    "--no-sandbox",
    "--headless",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


@pytest.fixture(scope="session")
def started(tmp_path_factory):
    """The server for all tests that leave it as it is; at the end its log must hold no stack trace."""
    server = Server(tmp_path_factory.mktemp("server") / "log")
    server.start()
    yield server
    server.end(signal.SIGTERM)
    server.said_no_trace()


@pytest.fixture(scope="session")
def server(started):
    """Address of a running page."""
    return started.address


@pytest.fixture(scope="session")
def server_to_end(tmp_path_factory):
    server = Server(tmp_path_factory.mktemp("own") / "log")
    yield server
    server.said_no_trace()
    server.end()


@pytest.fixture
def own_server(server_to_end):
    """A server that may be tried hard, stopped and killed: it runs when a test begins."""
    if not server_to_end.runs:
        server_to_end.start()
    yield server_to_end
    if server_to_end.runs:
        server_to_end.process.send_signal(signal.SIGCONT)


def chromium() -> str | None:
    """Where Chromium is: its build without windows, if there is one, to which a page costs a third less."""
    return os.environ.get("CHROMIUM") or shutil.which("chromium-headless-shell") or shutil.which("chromium")


@pytest.fixture(scope="session")
def browser():
    with sync_playwright() as playwright:
        launched = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        yield launched
        launched.close()


class Windows:
    """Windows of a browser, used again: a page where another has been costs a third of one in a new window."""

    def __init__(self, browser):
        self.browser = browser
        self.free: dict[str, list] = {}  # windows that nobody uses, by their options and scripts

    def take(self, size, options: dict, script: str = ""):
        """A tab of this size in a context of these options, which runs this script before each page."""
        viewport = {"width": size[0], "height": size[1]}
        free = self.free.get(repr((options, script)))
        if not free:
            tab = self.browser.new_context(viewport=viewport, **options).new_page()
            if script:
                tab.add_init_script(script)
            return tab
        tab = free.pop()
        tab.set_viewport_size(viewport)
        return tab

    def give(self, tab, plain: str, options: dict, script: str = "") -> None:
        """Take away what a page has left behind, and keep the window.

        `plain`: an address of the same site where no page is: that keeps the process.
        """
        tab.emulate_media(**{medium: options.get(medium, "null") for medium in MEDIA})
        tab.mouse.move(0, 0)
        tab.goto(plain)
        tab.evaluate("() => { localStorage.clear(); sessionStorage.clear(); }")
        session = tab.context.new_cdp_session(tab)
        session.send("Page.resetNavigationHistory")
        session.detach()
        self.free.setdefault(repr((options, script)), []).append(tab)


def in_laboratory(query: str) -> str:
    """A link as most tests mean it: to all charts and controls, unless it says what else it leads to."""
    said = any(key in query for key in ("layout=", "lesson=", "class=", "embed", "gallery", "language="))
    return query if said or "=" not in query else f"{query}&layout=laboratory"


class Page:
    """The page in the browser, with what it said and sent; in a window of its own unless there are windows to take."""

    def __init__(
        self,
        browser,
        address: str,
        query: str = LABORATORY,
        size=(1440, 900),
        drawn: bool = True,
        script: str = "",
        windows: Windows | None = None,
        plain: bool = False,  # the link as it stands
        **options,
    ):
        self.options = {"reduced_motion": "reduce"} | options  # nothing moves by itself, unless that is what is tested
        self.windows, self.script = windows, script
        self.address = address
        self.tab = (windows or Windows(browser)).take(size, self.options, script)
        self.context = self.tab.context
        self.errors: list[str] = []
        self.foreign: list[str] = []
        self.frames = {"sent": 0, "received": 0, "bytes": 0}
        self.listeners = {
            "pageerror": lambda error: self.errors.append(str(error)),
            "console": lambda line: line.type == "error" and self.errors.append(line.text),
            "request": lambda request: self._request(request.url, address),
            "websocket": self._socket,
        }
        for name, listener in self.listeners.items():
            self.tab.on(name, listener)
        self.tab.goto(f"http://{address}/{query if plain else in_laboratory(query)}")
        if drawn:
            self.laid_out()

    def close(self) -> None:
        for name, listener in self.listeners.items():
            self.tab.remove_listener(name, listener)
        if self.windows:
            self.windows.give(self.tab, f"http://{self.address}/liveness", self.options, self.script)
        else:
            self.context.close()

    def _request(self, url: str, address: str) -> None:
        if address not in url and not url.startswith(("data:", "blob:")):
            self.foreign.append(url)

    def _socket(self, socket) -> None:
        def received(data):
            self.frames["received"] += 1
            self.frames["bytes"] += len(data)
            if isinstance(data, str) and '"ERROR"' in data:
                self.errors.append(data)

        def sent(data):
            self.frames["sent"] += 1

        socket.on("framereceived", received)
        socket.on("framesent", sent)

    def wait(self, condition: str, argument=None, timeout: int = PATIENCE):
        return self.tab.wait_for_function(condition, arg=argument, timeout=timeout, polling=POLLING)

    def laid_out(self) -> None:
        """Wait until there is a scene, its styles are loaded, and what has a size is drawn."""
        self.wait(
            """() => window.strikewave?.frames > 0
              && [...strikewave.page.root.getRootNode().querySelectorAll('link')].every((link) => link.sheet)"""
        )
        self.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def redrawn(self, pixels: list[int]) -> None:
        """Wait until the picture is another one."""
        for _ in range(100):
            if self.picture() != pixels:
                return
            self.tab.wait_for_timeout(50)
        pytest.fail("the picture is as it was")

    def quiet(self) -> dict[str, int]:
        """Wait until nothing is sent or received any more; what has been by then."""
        while True:
            before = dict(self.frames)
            self.tab.wait_for_timeout(500)
            if self.frames == before:
                return before

    def frames_pass(self, count: int) -> None:
        """Wait until the browser has drawn so many frames, in which what must not happen would happen."""
        self.evaluate(
            """async (count) => {
              for (let k = 0; k < count; k++) await new Promise((done) => requestAnimationFrame(done));
            }""",
            count,
        )

    def resize(self, width: int, height: int) -> None:
        """Change the size of the window, and wait until all is laid out in it."""
        self.tab.set_viewport_size({"width": width, "height": height})
        self.laid_out()

    def fits(self, width: int) -> None:
        """Wait until nothing sticks out sideways."""
        self.wait("width => document.documentElement.scrollWidth <= width", width)

    def evaluate(self, code: str, argument=None):
        return self.tab.evaluate(code, argument)

    def header(self, key: str):
        """A value of the message that is drawn."""
        return self.evaluate("key => strikewave.page.frame[key]", key)

    def answered(self, act) -> None:
        """Do something and wait until its answer is drawn, and said."""
        before = self.evaluate("() => strikewave.frames")
        act()
        self.wait(
            """(before) => {
              const { asked, frame, telling } = strikewave.page;
              return strikewave.frames > before && !asked && !frame.draft && !telling;
            }""",
            before,
        )

    def show_scene(self, name: str) -> None:
        """Choose a scene as the gallery does, and wait until it is drawn."""
        self.answered(lambda: self.evaluate("name => strikewave.page.choose('scene', name)", name))

    def take(self, what: str) -> None:
        """Choose what to take along from the menu in the bar."""
        self.tab.get_by_role("button", name="Save", exact=True).click()
        self.tab.get_by_role("button", name=what, exact=True).click()

    def turn_to(self, name: str) -> None:
        """Choose a tab, where it is not the one that is seen."""
        tab = self.tab.get_by_role("tab", name=name, exact=True)
        if tab.get_attribute("aria-selected") != "true":
            tab.click()

    def analysis(self, label: str) -> None:
        """Open an analysis, or close it."""
        self.turn_to("Analysis")
        self.tab.get_by_role("navigation", name="Analyses").get_by_role("button", name=label, exact=True).click()

    def picture(self) -> list[int]:
        """A hash of the pixels of every canvas."""
        return self.evaluate(
            """() => {
              const canvases = (root) => [...root.querySelectorAll('*')].flatMap((e) =>
                [...(e.tagName === 'CANVAS' ? [e] : []), ...(e.shadowRoot ? canvases(e.shadowRoot) : [])]);
              return canvases(document).map((canvas) => {
                const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
                let hash = 0;
                for (let i = 0; i < data.length; i += 89) hash = (hash * 31 + data[i]) | 0;
                return hash;
              });
            }"""
        )


@pytest.fixture(scope="session")
def windows(browser):
    return Windows(browser)


@pytest.fixture
def open_page(browser, server, windows):
    """Open the page; at the end it must have shown no error and asked nobody else for anything.

    `own`: in a window of its own, which has fetched nothing yet and takes whatever the test puts into it.
    `script`: what the window runs before the page.
    """
    opened: list[Page] = []

    def open_one(query: str = LABORATORY, own: bool = False, **options) -> Page:
        opened.append(Page(browser, server, query, windows=None if own else windows, **options))
        return opened[-1]

    yield open_one
    for page in opened:
        page.close()
        assert [error for error in page.errors if "GL Driver" not in error] == []
        assert page.foreign == []
