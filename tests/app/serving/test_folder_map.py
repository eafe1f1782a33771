"""Workers of a laboratory in a folder: from the disk, where nothing is fetched, and in a frame without an origin."""

from pathlib import Path

import numpy as np
import pytest

import solvers
from app.command.main import main
from solvers.scenes.library import scene_of

from .conftest import SECONDS

pytestmark = [pytest.mark.browser, pytest.mark.slow]
# The columns of impacts at these speeds, or null where there are no workers.
MAPPED = """async (rows) => {
  const { door } = strikewave.page.opening;
  await door.open();
  const Pool = door.whatif.points.own.constructor;
  door.close();
  const found = Promise.withResolvers();
  const done = (values) => found.resolve(values && [...values]);
  let waiting = { chosen: {}, names: ['speed'], rows: new Float64Array(rows), done };
  const pool = new Pool(() => {
    const next = waiting;
    waiting = null;
    return next;
  });
  if (!(await pool.prepare())) return null;
  pool.scene(strikewave.page.frame);
  pool.feed();
  const values = await found.promise;
  pool.leave();
  return values;
}"""
SPEEDS = [0.5, 1.0, 3.0]


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("static") / "impact"
    assert main(["export-static", str(place)]) == 0
    return place


def peaks_known() -> list[float]:
    scene = scene_of("fixed-rod")
    return [solvers.solve(scene.replace({"impactor.velocity": speed})).peak_force for speed in SPEEDS]


@pytest.mark.parametrize("where", ["disk", "server"])
def test_they_find_what_the_library_finds(served, opened, folder, where):
    tab = opened(base=folder.as_uri() if where == "disk" else served)
    found = np.array(tab.evaluate(MAPPED, SPEEDS), float).reshape(len(SPEEDS), -1)
    assert found[:, 0].tolist() == [0.0] * len(SPEEDS)
    assert found[:, 4] == pytest.approx(peaks_known(), rel=1e-9)
    assert tab.errors == []


def test_they_work_in_a_frame_that_may_only_run_scripts(browser, folder, served):
    frame = f'<iframe sandbox="allow-scripts" src="{folder.name}/index.html" width="900" height="700"></iframe>'
    (folder.parent / "course.html").write_text(frame)
    tab = browser.new_page()
    tab.goto(served.replace(folder.name, "course.html"))
    inside = tab.frames[1]
    inside.wait_for_function("() => window.strikewave?.frames > 0", timeout=SECONDS)
    found = np.array(inside.evaluate(MAPPED, SPEEDS), float).reshape(len(SPEEDS), -1)
    assert found[:, 4] == pytest.approx(peaks_known(), rel=1e-9)
    tab.close()


def test_without_their_script_there_are_none(opened):
    tab = opened(before="Object.defineProperty(globalThis, 'strikewaveWorker', { get() {}, set() {} });")
    assert tab.evaluate(MAPPED, SPEEDS) is None
