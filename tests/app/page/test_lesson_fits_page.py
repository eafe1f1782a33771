"""What a step shows is in view in a window of 720 px, and no words of colours lie on what strikes."""

import pytest

from .test_lesson_walks import THERE

SIZE = (1280, 720)
# All of the first picture and of what stands beside it ends within what is seen of the analysis.
IN_VIEW = """() => {
  const analysis = strikewave.page.root.querySelector('.lesson-charts .analysis');
  const first = [...analysis.querySelectorAll('.figure')].find((each) => each.offsetHeight);
  const found = [first, ...analysis.querySelectorAll('table')].filter((each) => each?.offsetHeight);
  const end = analysis.getBoundingClientRect().bottom;
  return found.length && found.every((each) => each.getBoundingClientRect().bottom <= end + 1);
}"""
# Where the words of colours are, and how near what strikes comes to them at any instant.
NEAR = """() => {
  const { player, view: { stage } } = strikewave.page;
  const { mechanism } = stage;
  const canvas = stage.canvas.getContext('2d');
  const [drawn, fill] = [[], canvas.fillText];
  canvas.fillText = function (words, x, y) {
    if (/compression|MPa/.test(words)) drawn.push([x - this.measureText(words).width, y - 12, x, y + 3]);
    fill.apply(this, arguments);
  };
  let over = 0;
  for (let k = 0; k <= 100; k++) {
    drawn.length = 0;
    player.go((k / 100) * player.duration);
    if (!mechanism.held || drawn.length < 2) continue;
    const { x, y, width } = mechanism.held;
    for (const [left, top, right, bottom] of drawn)
      over += x + width / 2 > left && x - width / 2 < right && y + width / 2 > top && y - width / 2 < bottom;
  }
  delete canvas.fillText;
  return [over, drawn.length];
}"""


def answered(open_page, name: str, step: int):
    """A step of a lesson, with its choice made where it asks for one."""
    page = open_page(f"?lesson={name}&step={step}&language=en", size=SIZE)
    page.wait(THERE)
    if page.tab.locator(".lesson-choice input").count():
        page.tab.locator(".lesson-choice input").first.press("Space")
        page.tab.locator(".lesson-choice .lesson-main").press("Enter")
    return page


@pytest.mark.browser
@pytest.mark.parametrize(
    "name, step", [("the-energy-left-ringing", 1), ("the-energy-left-ringing", 6), ("modes-against-waves", 1)]
)
def test_an_analysis_is_seen_wholly(open_page, name, step):
    page = answered(open_page, name, step)
    page.wait(IN_VIEW)
    page.fits(SIZE[0])


@pytest.mark.browser
@pytest.mark.parametrize("name, step", [("a-link-that-bends", 5), ("a-link-that-bends", 1)])
def test_the_scale_of_colours_is_clear_of_the_mass(open_page, name, step):
    page = answered(open_page, name, step)
    over, drawn = page.evaluate(NEAR)
    assert over == 0 and drawn
