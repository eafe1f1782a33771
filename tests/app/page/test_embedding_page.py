"""The laboratory in a page of somebody else, as docs/embedding.md has it."""

import os
import re
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest
from playwright.sync_api import expect

from ..conftest import Page
from ..servers import ROOT, free_port
from .test_page import drag, settled

EXAMPLE = re.search(r"^```py\n(.*?)^```$", (ROOT / "docs/embedding.md").read_text("utf-8"), re.DOTALL | re.MULTILINE)
TWO = """
import panel as pn

from app.embedding import Lab

labs = [Lab(scene="free-rod", height=700), Lab(scene="fixed-rod", method="modal", modes=20)]
pn.Column(*(pn.bind("Mass ratio {:.2f}".format, lab.param.mass_ratio) for lab in labs), *labs).servable()
"""


class Served:
    """Scripts served by a process of their own."""

    def __init__(self, folder: Path, scripts: dict[str, str], *call: str):
        self.address, self.log = f"127.0.0.1:{(port := free_port())}", folder / "log"
        for name, text in scripts.items():
            (folder / name).write_text(text.replace("port=5007", f"port={port}"), encoding="utf-8")
        with self.log.open("w") as output:
            words = [sys.executable, *(word.format(port=port) for word in call), *scripts]
            environment = {**os.environ, "PYTHONPATH": str(ROOT)}
            self.process = subprocess.Popen(words, stdout=output, stderr=subprocess.STDOUT, cwd=folder, env=environment)
        deadline = time.monotonic() + 120
        while not answers(port):
            assert self.process.poll() is None and time.monotonic() < deadline, self.log.read_text()
            time.sleep(0.1)

    def end(self) -> None:
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(20)
        assert "Traceback" not in self.log.read_text(), self.log.read_text()[-3000:]


@pytest.fixture
def example(tmp_path):
    """That of the docs."""
    served = Served(tmp_path, {"lecture.py": EXAMPLE[1]})
    yield served
    served.end()


@pytest.fixture(scope="module")
def scripts(tmp_path_factory):
    """Two, by Panel's command."""
    fixed = EXAMPLE[1].replace("mass_ratio=2.0", "mass_ratio=2.0, width=700, height=600, sizing_mode='fixed'")
    fixed = re.sub(r"^pn.serve.*", "lecture().servable()", fixed, flags=re.MULTILINE)
    call = ("-m", "panel", "serve", "--plugins", "app.embedding", "--port", "{port}")
    served = Served(tmp_path_factory.mktemp("scripts"), {"fixed.py": fixed, "two.py": TWO}, *call)
    yield served
    served.end()


@pytest.fixture
def opened(browser):
    pages = []

    def open_one(served: Served, path: str = "") -> Page:
        pages.append(Page(browser, served.address, path))
        return pages[-1]

    yield open_one
    for page in pages:
        page.close()


def answers(port: int) -> bool:
    try:
        return bool(urllib.request.urlopen(f"http://127.0.0.1:{port}/liveness", timeout=2).read())
    except OSError:
        return False


def test_the_example_of_the_docs_solves_what_its_sliders_choose(example, opened):
    page = opened(example)
    assert page.header("chosen")["scene"] == "free-rod"
    expect(page.tab.get_by_text("The rod has 2.00 times the mass")).to_be_visible()
    address, pixels = page.tab.url, page.picture()
    page.answered(lambda: drag(page, "Mass ratio", 0.2))
    settled(page)
    chosen = page.header("chosen")["mass_ratio"]
    assert chosen < 1.0
    expect(page.tab.get_by_text(f"The rod has {chosen:.2f} times the mass")).to_be_visible()
    page.redrawn(pixels)
    assert page.tab.url == address
    page.answered(lambda: page.tab.get_by_role("button", name="Undo").click())
    assert page.header("chosen")["mass_ratio"] == 2.0
    page.answered(lambda: page.tab.get_by_role("button", name="Redo").click())
    assert page.header("chosen")["mass_ratio"] == chosen
    assert page.tab.url == address
    assert page.errors == [] and page.foreign == []
    example.end()
    expect(page.tab.get_by_role("status").filter(has_text="There is no connection")).to_be_attached()
    lost = page.tab.get_by_role("alert")
    expect(lost).to_be_hidden()
    page.evaluate("() => strikewave.page.choose('method', 'fe-nodal')")
    expect(lost).to_contain_text("What you have chosen waits")
    expect(lost).not_to_contain_text("comes back")  # which is for the page to do


def test_it_fills_its_place_and_not_the_window(scripts, opened):
    page = opened(scripts, "fixed")
    page.wait("() => strikewave.page.root.dataset.size === 'phone'")
    page.wait("() => strikewave.page.root.getBoundingClientRect().height < innerHeight")  # once its styles are there
    box = page.evaluate("() => strikewave.page.root.getBoundingClientRect()")
    assert (box["width"], box["height"]) == (700, 600)


def test_two_of_them_have_choices_and_keys_of_their_own(scripts, opened):
    page = opened(scripts, "two")
    page.wait("() => strikewave.frames > 1")
    sliders = page.tab.get_by_role("slider", name="Mass ratio", exact=True)
    expect(sliders).to_have_count(2)
    words = page.tab.get_by_text(re.compile(r"^Mass ratio \d"))
    first, second = words.all_text_contents()
    sliders.first.focus()
    page.answered(lambda: page.tab.keyboard.press("ArrowRight"))
    expect(words.first).not_to_have_text(first)
    expect(words.last).to_have_text(second)
    undoing = page.tab.get_by_role("button", name="Undo")
    expect(undoing.first).to_be_enabled()
    expect(undoing.last).to_be_disabled()
    assert page.errors == []
