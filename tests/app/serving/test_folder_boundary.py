"""A boundary over the map of a lesson is drawn and judged in the folder without a server."""

import pytest

from app.command.main import main
from app.lessons import shipped
from app.lessons.added import add

from ..lessons.test_boundary import SCENE, SKETCH
from ..lessons.written import HEAD
from .conftest import SECONDS

pytestmark = [pytest.mark.browser, pytest.mark.slow]
THERE = """() => {
  const lesson = window.strikewave?.page.opening.teaching.lesson;
  const map = lesson && !lesson.coming && lesson.below.map;
  return Boolean(map?.view && map.domain && map.jobs.idle && !map.due);
}"""
CONTACTS = "() => [...new Set(strikewave.page.opening.teaching.lesson.below.map.view.contacts)].sort()"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    lessons, place = tmp_path_factory.mktemp("lessons"), tmp_path_factory.mktemp("static") / "impact"
    (lessons / "tried.md").write_text(HEAD + SCENE + SKETCH, "utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(shipped, "ADDED", {})
        patch.setattr("app.lessons.added.ADDED", shipped.ADDED)
        assert add(lessons) == []
        assert main(["export-static", str(place), "--lessons"]) == 0
    return place


def test_it_is_drawn_and_judged_from_the_disk(opened, folder):
    tab = opened("?lesson=tried", script=THERE)
    box = tab.locator(".sketch-plot").bounding_box()
    for k, (x, y) in enumerate([(0.0, 0.74), (0.5, 0.5), (1.0, 0.26)]):
        tab.mouse.move(box["x"] + x * (box["width"] - 1), box["y"] + (1 - y) * (box["height"] - 1), steps=8)
        if k == 0:
            tab.mouse.down()
    tab.mouse.up()
    tab.get_by_role("button", name="Show what happens").click()
    tab.wait_for_function(THERE, timeout=SECONDS)
    assert tab.locator(".lesson-judged b").all_inner_texts() == ["✓", "✓"]
    assert {1, 2} <= set(tab.evaluate(CONTACTS))
    assert [url for url in tab.asked if not url.startswith((f"{folder.as_uri()}/", "data:", "blob:"))] == []
    assert tab.errors == []
