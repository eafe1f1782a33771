"""The summary of a lesson has the line that was drawn, over what happens."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

from .test_lesson_walks import THERE

LINE = "0 37\n1 5\n1 100\n2 0\n2.6 0"
PLACES = """(name) => {
  const { d } = Object.fromEntries([...strikewave.page.root.querySelector(`.sum-sketch .${name}`).attributes]
    .map((each) => [each.name, each.value]));
  return [...d.matchAll(/[ML](\\S+) (\\S+?)(?=[ML]|$)/g)].map(([, x, y]) => [Number(x), Number(y)]);
}"""


@pytest.mark.browser
def test_the_summary_has_the_line_that_was_drawn_over_what_happens(open_page):
    page = open_page("?lesson=bounce-twice&step=2&language=en")
    page.wait(THERE)
    page.tab.locator(".sketch-tools button").last.press("Enter")
    page.tab.locator(".sketch-points textarea").press_sequentially(LINE)
    page.tab.locator(".sketch-points button").press("Enter")
    page.tab.locator(".lesson-asked .lesson-main").press("Enter")
    page.wait("() => strikewave.page.opening.teaching.lesson.progress.answers.force.done")
    page.tab.locator(".lesson-bar").get_by_role("button", name=re.compile("6")).first.press("Enter")
    page.wait(THERE)
    picture = page.tab.get_by_role("img", name="Contact force, kN")
    expect(picture).to_have_count(1)
    for size in [(1440, 900), (390, 844)]:
        page.resize(*size)
        mine, so = (np.array(page.evaluate(PLACES, name)) for name in ("mine", "so"))
        assert len(mine) > 100 and len(so) == len(mine)
        jumps = mine[np.argmax(-np.diff(mine[:, 1])), 0], so[np.argmax(-np.diff(so[:, 1])), 0]
        assert jumps[0] == pytest.approx(jumps[1], abs=4.0)  # both where the front is back, of a picture 240 wide
        page.fits(size[0])
