"""Bodies in space on the page: friction, the model of restitution, how the contact slides, and what a hand can turn."""

import pytest
from pytest import approx

SIZES = [(1440, 900), (1280, 720), (390, 844)]
STAGE = (
    "() => { const { left, top } = strikewave.page.space.stage.canvas.getBoundingClientRect(); return [left, top]; }"
)
SLIDES = "() => strikewave.page.space.charts.map(({ chart }) => !chart.root.hidden && chart.area.clientHeight > 40)"


def drag(page, start: list[float], by: tuple[float, float]) -> None:
    left, top = page.evaluate(STAGE)
    x, y = left + start[0], top + start[1]
    page.tab.mouse.move(x, y)
    page.tab.mouse.down()
    page.tab.mouse.move(x + by[0], y + by[1], steps=3)
    page.tab.mouse.up()


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_sliding_is_drawn_where_there_is_friction(open_page, size):
    page = open_page("?scene=brick-on-floor", size=size)
    assert page.header("sliding")[0]["kind"] == "slip"
    page.fits(size[0])
    if size[0] > 1000:
        assert any(page.evaluate(SLIDES))
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('friction', 1.5)"))
    assert [each["kind"] for each in page.header("sliding")] == ["slip", "stick"]
    said = "({ caption, story }) => [caption, story].map(({ root }) => root.textContent).join()"  # on a phone in a tab
    page.wait(f"() => ({said})(strikewave.page).includes('stick from there on')")


def test_without_friction_there_is_nothing_to_slide(open_page):
    page = open_page("?scene=note-rod")
    assert page.header("sliding") == [] and page.evaluate(SLIDES) == [False, False]
    assert "restitution_model" not in page.header("acting")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('friction', 0.5)"))
    assert "restitution_model" in page.header("acting")
    page.wait("() => strikewave.page.controls.fields.restitution_model.root.offsetHeight > 0")


CONE = """(t) => {
  const { page } = strikewave;
  page.player.seek(t - page.player.start);
  const { canvas, hands, long, x, y } = page.space.stage;
  const { data, width, height } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const per = width / canvas.clientWidth;
  let [left, right, top] = [Infinity, -Infinity, Infinity];
  for (let row = Math.round((y - 2 * long) * per); row < (y - 8) * per; row++)
    for (let k = Math.round((x - 2 * long) * per); k < (x + 2 * long) * per; k++) {
      const [red, green, blue] = data.subarray(4 * (row * width + k));
      if (red < 190 || green > 80 || blue > 120) continue; // the impulse
      [left, right, top] = [Math.min(left, k), Math.max(right, k), Math.min(top, row)];
    }
  return [y - top / per, left / per - x, right / per - x];
}"""


@pytest.mark.parametrize("size", SIZES[:2], ids=str)  # on a phone it is as large as the letters beside it
def test_the_impulse_grows_in_the_cone_of_friction_through_the_impact(open_page, size):
    """A ball with backspin: half way along the cone, then straight up; seen in the picture, and said."""
    page = open_page("?scene=spinning-ball&layout=opening", size=size)
    page.wait("() => strikewave.page.opening.section.tracks.length")
    (high, left, _), (higher, *_), (highest, at_last, _) = (page.evaluate(CONE, t) for t in (0.6, 1.0, 2.0))
    assert 0 < high < higher < highest
    assert -left == approx(0.5 * high, abs=0.15 * high + 4)  # mu, but for the head of the arrow
    assert -at_last < 0.36 * highest  # inside
    assert "cone of friction, 26.6°" in page.evaluate("() => strikewave.page.story.units.textContent")
    page.fits(size[0])


def test_without_friction_there_is_no_cone(open_page):
    page = open_page("?scene=percussion-rod&layout=opening")
    assert "cone" not in page.evaluate("() => strikewave.page.story.units.textContent")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('friction', 0.5)"))
    page.wait("() => strikewave.page.story.units.textContent.includes('cone of friction, 26.6°')")


def test_a_model_that_makes_energy_is_warned_of(open_page):
    page = open_page("?scene=brick-on-floor&restitution=1&restitution_model=newton")
    (note,) = page.header("notes")
    assert (note["code"], note["severity"]) == ("friction-makes-energy", "warning")


def test_a_hand_turns_the_picture_leans_the_normal_and_moves_the_contact(open_page):
    page = open_page("?scene=brick-on-floor")
    page.evaluate("() => strikewave.page.player.go(0.2)")
    drag(page, [60, 300], (100, -40))  # where nothing is
    assert page.evaluate("() => strikewave.page.space.stage.turned") == approx([-0.8, -0.32])
    page.evaluate("() => strikewave.page.space.look('side')")
    tip = page.evaluate("() => strikewave.page.space.stage.hands.tip")
    reach = page.evaluate("() => strikewave.page.space.stage.hands.reach")
    page.answered(lambda: drag(page, tip, (reach, 0)))
    page.wait("() => strikewave.page.frame.chosen.tilt > 40")
    page.quiet()
    assert page.header("chosen")["tilt"] == approx(45.0, abs=1.5)
    across, normal = page.header("across"), page.header("normal")
    assert sum(a * n for a, n in zip(across, normal, strict=True)) == approx(0.5**0.5, abs=0.03)
    point = page.evaluate("() => [strikewave.page.space.stage.x, strikewave.page.space.stage.y]")
    page.answered(lambda: drag(page, point, (20, 15)))
    page.wait("() => strikewave.page.frame.chosen.place > 0.05")


def test_a_rod_that_only_slides_is_thrown_up_where_friction_jams(open_page):
    """No speed of approach to set; below 4/3 it slides on, and the page says why."""
    page = open_page("?scene=painleve-sliding")
    assert "speed" not in page.header("acting") and "friction" in page.header("acting")
    assert [each["kind"] for each in page.header("sliding")] == ["slip", "stick"]
    assert page.header("bodies")["impactor"]["after"]["velocity"][1] == approx(0.554046, abs=1e-6)
    assert any(page.evaluate(SLIDES))
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('friction', 1.3)"))
    assert page.header("sliding") == [] and page.evaluate(SLIDES) == [False, False]
    assert [note["code"] for note in page.header("notes")] == ["no-impact", "slides-on"]


def test_where_friction_jams_it_says_so_and_offers_nothing_that_misfits(open_page):
    page = open_page("?scene=painleve-rod")
    (note,) = page.header("notes")
    assert note["code"] == "friction-jams"
    said = [trial[0] for trial in page.header("opens")["trials"]]
    assert "elastic" in said and "centre" not in said
