"""One scale of colours for a whole lesson, and rows that end where the force does."""

import pytest

from .test_lesson_walks import THERE

SCALE = """() => {
  const { field, frame, stage } = strikewave.page.view;
  const out = new Float64Array(241);
  let most = 0;
  for (let k = 0; k <= 200; k++)
    for (const value of field.profile((k / 200) * frame.duration, 'stress', out))
      most = Math.max(most, Math.abs(value));
  return [stage.largest * frame.stressUnit, most * frame.stressUnit];
}"""


AT = "() => strikewave.page.opening.teaching.lesson.at"


def turn(page, way: int = 1) -> None:
    at = page.evaluate(AT)
    page.tab.locator(".lesson-moves button").nth(0 if way < 0 else 1).press("Enter")
    page.wait(THERE)
    assert page.evaluate(AT) == at + way


@pytest.mark.browser
@pytest.mark.parametrize("name", ["mass-on-a-rod", "bounce-twice"])
def test_a_colour_means_the_same_in_all_steps_and_no_stress_is_beyond(open_page, name):
    page = open_page(f"?lesson={name}&step=1&language=en")
    page.wait(THERE)
    steps = page.evaluate("() => strikewave.page.opening.teaching.lesson.record.steps.length")
    ends = []
    for _ in range(steps - 1):
        end, most = page.evaluate(SCALE)
        ends.append(end)
        assert most <= end * (1.0 + 1e-6)
        turn(page)
    assert len(set(ends)) == 1


@pytest.mark.browser
def test_where_one_begins_late_it_keeps_the_scale_that_it_has_had_and_rows_end_soon_after_the_force(open_page):
    page = open_page("?lesson=mass-on-a-rod&step=6&language=en")
    page.wait(THERE)
    start, end = page.evaluate("() => strikewave.page.range()")
    assert start == 0.0 and 2.4 <= end < 3.2
    alone, _ = page.evaluate(SCALE)
    turn(page)
    both, _ = page.evaluate(SCALE)
    assert both > 2.0 * alone
    turn(page, -1)
    assert page.evaluate(SCALE)[0] == pytest.approx(both)
    page.tab.reload()
    page.wait(THERE)
    assert page.evaluate(SCALE)[0] == pytest.approx(both)


@pytest.mark.browser
def test_rows_go_on_to_the_end_where_a_slider_decides_when_the_force_is_over(open_page):
    page = open_page("?lesson=bounce-twice&step=3&language=en")
    page.wait(THERE)
    assert page.evaluate("() => strikewave.page.range()[1] === strikewave.page.frame.duration")


@pytest.mark.browser
def test_colours_that_some_stress_is_beyond_say_so(open_page):
    page = open_page("?lesson=split-hopkinson&step=3&language=en")
    page.wait(THERE)
    assert page.evaluate("() => strikewave.page.view.field.peak('stress') > strikewave.page.view.stage.largest")
