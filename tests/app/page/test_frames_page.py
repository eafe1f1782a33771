"""The page in a frame of a course page on another site, by the lines of docs/embedding.md."""

import functools
import http.server
import re
import signal
import threading
import urllib.request

import pytest

from ..conftest import PATIENCE
from ..servers import ROOT, Server, free_port
from .test_class_page import LESSON, reading

DOCS = (ROOT / "docs/embedding.md").read_text("utf-8")
SNIPPET = re.findall(r"^```html\n(.*?)^```$", DOCS, re.DOTALL | re.MULTILINE)[0]
ADDRESS = "https://impact.example.org/"  # of the docs
SHOWN = "() => window.strikewave && (strikewave.page.opening.teaching.lesson?.at ?? -1) >= {step}"
# What the course page is told.
TOLD = "if (window === top) { window.told = []; addEventListener('message', ({ data }) => told.push(data)); }"
# More than a change takes to be measured and told, 150 ms.
FRAMES_PASS = """async () => {
  for (let k = 0; k < 15; k++) await new Promise((done) => requestAnimationFrame(done));
}"""
# What a browser does that blocks what other sites keep.
BLOCKED = """
if (window !== top) {
  const refuse = () => { throw new DOMException('blocked', 'SecurityError'); };
  for (const name of ['localStorage', 'sessionStorage']) Object.defineProperty(window, name, { get: refuse });
  Object.defineProperty(Document.prototype, 'cookie', { get: refuse, set: refuse });
}
"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """A folder, the origin at which it is served, and a server of the page that lets it have frames."""
    folder, port = tmp_path_factory.mktemp("course"), free_port()
    handler = functools.partial(Quiet, directory=str(folder))
    origin = f"http://localhost:{port}"
    page = Server(folder.parent / "log", "--frame-origin", origin, "--frame-origin", "https://*.example.org")
    page.start()
    with http.server.ThreadingHTTPServer(("localhost", port), handler) as served:
        threading.Thread(target=served.serve_forever, daemon=True).start()
        yield folder, origin, page.address
        served.shutdown()
    page.end(signal.SIGTERM)
    page.said_no_trace()


@pytest.fixture
def framed(browser, course):
    """Open a course page with the lines of the docs, and their frame."""
    folder, origin, address = course
    contexts, errors = [], []

    def open_one(query: str = "", width: int = 760, script: str = "", shown: str = SHOWN.format(step=0)):
        lines = SNIPPET.replace(ADDRESS, f"http://{address}/")
        lines = lines.replace(f"lesson={LESSON}", query) if query else lines
        (folder / "index.html").write_text(f"<!DOCTYPE html><body style='margin: 0'><h1>Course</h1>{lines}", "utf-8")
        contexts.append(browser.new_context(viewport={"width": width, "height": 900}, reduced_motion="reduce"))
        tab = contexts[-1].new_page()
        tab.on("pageerror", lambda error: errors.append(str(error)))
        tab.on("console", lambda line: line.type == "error" and errors.append(line.text))
        tab.add_init_script(TOLD + script)
        tab.goto(f"{origin}/index.html")
        inside = tab.frames[1]
        inside.wait_for_function(shown, timeout=PATIENCE)
        return tab, inside

    yield open_one
    for context in contexts:
        assert context.cookies() == []
        context.close()
    assert [error for error in errors if "GL Driver" not in error] == []


def follows(tab, inside) -> int:
    """Wait until the frame is as high as what is in it, and nothing scrolls or is cut off; its height."""
    tab.wait_for_function("() => told.length > 0", timeout=PATIENCE)
    inside.wait_for_function(
        """() => {
          const { root, opening } = strikewave.page;
          const parts = [root, ...(opening.teaching.lesson ? [opening.teaching.lesson.root] : [])];
          return parts.every(({ scrollHeight, clientHeight }) => scrollHeight <= clientHeight);
        }""",
        timeout=PATIENCE,
    )
    for _ in range(20):
        before = tab.evaluate("() => told.length")
        inside.evaluate(FRAMES_PASS)  # in which another height would be told
        told = tab.evaluate("() => told")
        if len(told) == before:
            break
    else:
        pytest.fail(f"its height goes on changing: {told[-5:]}")
    assert told and all(each.keys() == {"strikewave", "height"} and each["strikewave"] == 1 for each in told)
    height = int(tab.locator("iframe").get_attribute("height") or 0)
    assert height == told[-1]["height"]
    return height


def test_the_named_sites_alone_may_have_it_in_a_frame(course, server):
    _, origin, address = course
    with urllib.request.urlopen(f"http://{address}/") as page:
        policy = page.headers["Content-Security-Policy"]
        assert f"frame-ancestors 'self' {origin} https://*.example.org" in policy
        assert page.headers["X-Frame-Options"] is None  # which can name no site


def test_no_other_site_has_it_in_a_frame(browser, course, server):
    folder, origin, _ = course
    (folder / "other.html").write_text(SNIPPET.replace(ADDRESS, f"http://{server}/"))
    tab = browser.new_page()
    refused = []
    tab.on("console", lambda line: refused.append(line.text))
    tab.goto(f"{origin}/other.html")
    tab.wait_for_timeout(500)
    assert not tab.frames[1].evaluate("() => Boolean(document.getElementById('lab'))")
    assert any("frame-ancestors" in line for line in refused)
    tab.close()


@pytest.mark.parametrize("width, steps", [(1200, (1, 3, 5)), (760, (0, 2, 3, 4)), (390, range(6))], ids=str)
def test_the_lines_of_the_docs_follow_its_height(framed, width, steps):
    tab, inside = framed(width=width)
    heights = []
    for step in steps:
        inside.evaluate("(step) => strikewave.page.opening.teaching.lesson.enter(step)", step)
        inside.wait_for_function("() => !strikewave.page.opening.teaching.lesson.coming", timeout=PATIENCE)
        heights.append(follows(tab, inside))
    assert len(set(heights)) > 1 and max(heights) < 4000
    assert inside.evaluate("() => document.documentElement.scrollWidth") <= width


def test_its_height_follows_its_width(framed):
    tab, inside = framed(width=1200)
    wide = follows(tab, inside)
    tab.set_viewport_size({"width": 390, "height": 900})
    tab.wait_for_function("wide => Number(document.querySelector('iframe').height) !== wide", arg=wide)
    follows(tab, inside)
    tab.set_viewport_size({"width": 1200, "height": 900})
    tab.wait_for_function("wide => Number(document.querySelector('iframe').height) === wide", arg=wide)


def test_a_scene_has_a_frame_too(framed):
    scene = "() => window.strikewave?.page.frame.chosen.scene === 'free-rod'"
    tab, inside = framed("scene=free-rod&mass_ratio=4", shown=scene)
    follows(tab, inside)
    assert inside.evaluate("() => strikewave.page.opening.plan") == "opening"
    assert inside.get_by_role("button", name="All charts and controls").count() == 0


def test_it_needs_no_store_and_no_cookie(framed):
    _, inside = framed(script=BLOCKED)
    inside.get_by_role("radio", name="A second contact").check()
    inside.get_by_role("button", name="Show what happens").click()
    inside.get_by_role("button", name="Next →").press("Enter")  # by keys: the frame grows under a pointer
    inside.wait_for_function(SHOWN.format(step=1), timeout=PATIENCE)
    inside.get_by_role("button", name="Back", exact=True).press("Enter")
    inside.wait_for_function("() => strikewave.page.opening.teaching.lesson.question.done", timeout=PATIENCE)


def test_it_leaves_no_steps_in_the_course_and_opens_in_full(framed):
    tab, inside = framed()
    before = tab.evaluate("() => history.length")
    inside.get_by_role("button", name="Skip →").click()
    inside.wait_for_function(SHOWN.format(step=1), timeout=PATIENCE)
    inside.wait_for_function("() => location.search.includes('step=2')", timeout=PATIENCE)
    assert tab.evaluate("() => history.length") == before
    assert inside.evaluate("() => location.search") == f"?embed&lesson={LESSON}&step=2"
    assert inside.get_by_role("button", name="Leave the lesson").count() == 0
    with tab.context.expect_page() as opened:
        inside.get_by_role("link", name="Open in full").click()
    whole = opened.value
    whole.wait_for_function(SHOWN.format(step=1), timeout=PATIENCE)
    assert whole.evaluate("() => location.search") == f"?lesson={LESSON}&step=2"
    assert whole.evaluate("() => window.opener") is None


def test_a_teacher_copies_the_lines_of_the_docs(open_page, server):
    page = open_page(f"?class={LESSON}", drawn=False)
    reading(page)
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.tab.get_by_role("button", name="Copy its frame for a course page").click()
    page.tab.get_by_role("button", name="Copied").wait_for()
    assert page.evaluate("() => navigator.clipboard.readText()") == SNIPPET.replace(ADDRESS, f"http://{server}/")
    page.context.clear_permissions()
