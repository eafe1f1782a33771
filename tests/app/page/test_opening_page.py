"""The opening: one large picture, one question, a few sliders; everything else one click away."""

import numpy as np
import pytest
from playwright.sync_api import expect

import solvers
from app.choices.request import Request
from app.messages.transverse import chosen_method

from .test_compare_page import set_and_wait
from .test_page import settled

SIZES = [(1440, 900), (1280, 720), (820, 1180), (390, 844)]
NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
SAMPLES = 40
MODE = "() => strikewave.page.root.dataset.mode"
BOXES = """() => Object.fromEntries(['.stages', '.section', '.ask', '.caption', '.player', '.foremost', '.closer'].map(
  (name) => [name, strikewave.page.root.querySelector(name).getBoundingClientRect().toJSON()]))"""


@pytest.fixture
def again(pages, show):
    """The opening of a scene, whatever has been moved there; another one takes it back to what it begins with."""

    def shown(scene: str = "fixed-rod", size=SIZES[0]):
        page = show(pages.queries.get("opening", "?layout=opening"), size)
        pages.queries["opening"] = "?again&layout=opening"  # no link: the next one is followed
        if page.header("chosen")["scene"] == scene:
            page.show_scene("free-rod" if scene == "fixed-rod" else "fixed-rod")
        page.show_scene(scene)
        page.wait("() => !strikewave.page.frame.draft")
        settled(page)
        return page

    return shown


def opened(page) -> None:
    page.wait("() => strikewave.page.root.querySelector('.happens li, .ask h2')?.textContent")


def test_picture_and_rows_have_half_of_the_window_and_the_question_is_in_view(again):
    page = again(size=SIZES[-1])
    for size in reversed(SIZES):
        page.resize(*size)
        check_room(page, size)


def check_room(page, size) -> None:
    boxes = page.evaluate(BOXES)
    width, height = size
    assert boxes[".stages"]["height"] + boxes[".section"]["height"] >= 0.45 * height
    for name in (".stages", ".section", ".ask", ".caption", ".player", ".foremost"):
        assert boxes[name]["left"] >= 0 and boxes[name]["right"] <= width + 0.5, size
        assert boxes[name]["top"] >= 0 and boxes[name]["bottom"] <= height + 0.5, name
    expect(page.tab.locator(".ask h2")).to_have_text("One impact. Why three peaks of force?")
    below = [boxes[name] for name in (".player", ".foremost")]
    assert all(box["top"] >= boxes[".section"]["bottom"] - 0.5 for box in below)


def test_the_rows_show_the_stress_that_the_library_says(show):
    page = show("?layout=opening")
    found = page.evaluate(
        """() => {
          const { ends, stretch } = strikewave.page.opening.section;
          return { ends: [...ends], stretch, unit: strikewave.page.frame.stressUnit };
        }"""
    )
    exact = solvers.solve(solvers.load("fixed-rod"))
    start, end = found["stretch"]
    rows = len(found["ends"])
    times = (start + (np.arange(rows) + 0.5) / rows * (end - start)) * exact.scene.time_unit
    stress = exact.motion.stress(times, np.array([0.0]))[:, 0]
    smooth = np.abs(np.gradient(stress)) < 0.02 * np.abs(stress).max()  # beside the jumps, which a row averages
    assert smooth.sum() > 0.9 * rows
    error = np.abs(np.array(found["ends"]) * found["unit"] - stress)[smooth]
    assert error.max() < 0.02 * np.abs(stress).max()


@pytest.mark.parametrize("scene", ["xylophone-bar", "figure-8.15"])
def test_the_rows_of_a_beam_show_the_bending_moment_that_the_library_says(show, scene):
    page = show(f"?scene={scene}&place=0.5&layout=opening")
    found = page.evaluate(
        """() => {
          const { ends, shown: { drawn }, stretch } = strikewave.page.opening.section;
          const { left, long, struck } = strikewave.page.beam.stage;
          return { ends: [...ends], stretch, drawn, left, long, struck };
        }"""
    )
    right = found["left"] + found["long"]
    assert found["drawn"] == {"left": found["left"], "right": right, "rest": found["struck"]}
    request = Request.of(page.header("chosen"))
    solution = chosen_method(request)[0].solve(request.scene)
    start, end = found["stretch"]
    rows = len(found["ends"])
    within = (np.arange(SAMPLES) + 0.5) / SAMPLES  # of the time of a row, which it averages
    times = start + (np.arange(rows)[:, None] + within) / rows * (end - start)
    place = np.array([request.scene.target.place])
    moment = solution.motion.moment(times.ravel(), place)[:, 0].reshape(rows, SAMPLES).mean(axis=1)
    error = np.abs(np.array(found["ends"]) - moment)
    assert error.max() < 0.03 * np.abs(moment).max()


def test_every_contact_of_a_hammer_is_seen_beside_the_rows(show):
    page = show("?scene=hammer-on-cantilever&layout=opening")
    names = page.tab.locator(".happens li:visible")
    expect(names).to_have_count(8)
    for number in range(2, 6):
        expect(names.filter(has_text=f"Contact {number}")).to_have_count(1)
    pushed = page.evaluate(
        """() => {
          const { section } = strikewave.page.opening;
          const ratio = section.below.width / section.root.clientWidth;
          const context = section.below.getContext('2d');
          return strikewave.page.frame.contacts.map(([from, to]) => {
            const [top, high] = [section.y(from) * ratio, Math.max((section.y(to) - section.y(from)) * ratio, 2)];
            const wide = 12 * ratio; // beside the line of no force
            const { data } = context.getImageData((section.box.base - 20) * ratio, top, wide, high);
            return data.some((value, k) => k % 4 === 0 && value < 100);
          });
        }"""
    )
    assert pushed == [True] * 5


def test_the_rows_follow_a_slider(again):
    page = again()
    state = "() => (({ ends, most, words }) => [[...ends], most, words.all])(strikewave.page.opening.section)"
    ends, _, words = page.evaluate(state)
    set_and_wait(page, mass_ratio=0.3)
    settled(page)
    others, most, said = page.evaluate(state)
    assert ends != others and words != said
    peak = max(page.evaluate("() => [...strikewave.page.frame.exactForce]")) * page.header("forceUnit")
    assert 0.2 < peak / most < 0.75  # the scale goes with it
    heaviest = next(each["words"] for each in said if each["words"].endswith("kN"))
    assert float(heaviest.split()[0]) == pytest.approx(peak / 1e3, rel=5e-3)


def test_an_old_link_has_its_question_and_sliders_in_the_picture(open_page):
    page = open_page("?scene=free-rod&mass_ratio=2&layout=laboratory")
    assert page.evaluate(MODE) == "desk"
    settled(page)
    page.wait("() => location.search === '?scene=free-rod&mass_ratio=2&layout=laboratory'")
    page.tab.locator(".folder.left").click()
    page.tab.get_by_role("button", name="← Picture", exact=True).click()
    expect(page.tab.locator(".ask h2")).to_contain_text("Nothing holds the rod.")
    expect(page.tab.locator(".leading:visible")).to_have_count(4)
    assert page.tab.locator(".closer button").count() > 3
    set_and_wait(page, scene="fixed-rod")
    expect(page.tab.locator(".ask h2")).to_contain_text("peaks of force?")


def test_a_scene_without_rows_gives_its_room_to_the_picture_and_takes_it_back(again):
    page = again("bouncing-ball")
    for scene in ("rigid-pendulum", "percussion-rod", "free-rod", "bouncing-ball", "four-bar"):
        set_and_wait(page, scene=scene)
        bare = page.evaluate("() => strikewave.page.root.classList.contains('bare')")
        assert bare == (scene == "bouncing-ball"), scene


# Where it has come to is answered by the server, too, once it rests: after that nothing else is offered.
WALKED = """(said) => {
  const { asked, changes, opening, telling, waiting } = strikewave.page;
  const rests = !asked && !changes.resting && !telling && !Object.keys(waiting).length;
  return rests && !opening.walking && opening.change.textContent !== said;
}"""


def test_what_is_offered_is_done_and_the_next_is_offered(again):
    page = again()
    offers = [page.header("opens")["trials"]]
    change = page.tab.locator(".what-if")
    for _ in range(4):
        if change.inner_text() == "What if nothing held the far end? →":
            break
        said = change.inner_text()
        change.click()
        page.wait(WALKED, said)
    page.answered(change.click)
    assert page.header("chosen")["scene"] == "free-rod" and len(offers[0]) > 2


def test_a_slider_that_walks_stops_for_another_scene(again):
    page = again()
    page.tab.get_by_role("button", name="What if it were").click()
    page.evaluate("() => strikewave.page.controls.send('scene', 'two-unequal-rods')")
    page.tab.wait_for_timeout(1200)
    settled(page)
    assert page.header("chosen")["scene"] == "two-unequal-rods"
    assert page.header("chosen")["mass_ratio"] == page.header("own")["mass_ratio"]


def closer(page, name: str) -> None:
    page.tab.locator(".closer").get_by_role("button", name=name, exact=True).click()


def test_the_laboratory_is_one_click_away_is_remembered_and_back_leads_to_the_picture(open_page):
    page = open_page("")
    opened(page)
    settled(page)
    assert page.evaluate(MODE) == "lead"
    closer(page, "All charts and controls")
    page.wait("() => location.search === '?layout=laboratory'")
    page.tab.go_back()
    page.wait(f"() => ({MODE})() === 'lead'")
    page.tab.go_forward()
    page.wait(f"() => ({MODE})() === 'desk'")
    page.tab.goto(page.tab.url.split("?")[0])  # it is remembered
    page.laid_out()
    assert page.evaluate(MODE) == "desk"
    page.tab.get_by_role("button", name="← Picture", exact=True).click()
    assert page.evaluate(MODE) == "lead"


def test_all_else_slides_in_beside_a_picture_that_stays(open_page):
    page = open_page("", size=SIZES[-1])
    for size in reversed(SIZES):
        page.resize(*size)
        check_docks(page, size)


def check_docks(page, size) -> None:
    chart = "() => strikewave.page.view.force.chart.area.clientHeight"
    for tab in ("Charts", "Numbers", "Controls", "Analysis", "Story"):
        closer(page, tab)
        expect(page.tab.get_by_role("tab", name=tab, exact=True)).to_have_attribute("aria-selected", "true")
        page.wait("(tab) => location.search === `?tab=${tab.toLowerCase()}&layout=docks`", tab)
        boxes = page.evaluate(BOXES)
        dock = page.tab.locator(".dock.right").bounding_box()
        assert boxes[".stages"]["height"] > (100 if size[0] < 720 else 190), tab
        beside = dock["x"] >= boxes[".stages"]["right"] - 1
        assert dock["width"] >= 320 and dock["height"] > 250 and (beside or dock["y"] >= boxes[".stages"]["bottom"] - 1)
        if tab == "Charts":
            page.wait(f"() => ({chart})() > 80")
        if tab == "Controls":
            expect(page.tab.locator(".dock.right").get_by_label("Friction", exact=True)).to_have_count(1)
        page.tab.keyboard.press("Escape")
        expect(page.tab.locator(".dock.right")).to_be_hidden()
        assert page.tab.locator(".ask h2").evaluate("element => element === element.getRootNode().activeElement")


def test_an_analysis_opens_beside_the_picture_in_a_link_and_back_closes_the_dock(open_page):
    page = open_page("")
    opened(page)
    settled(page)
    closer(page, "Analysis")
    page.tab.get_by_role("button", name="Energy over time", exact=True).click()
    expect(page.tab.locator(".analysis:visible")).to_have_count(1)
    page.wait("() => location.search === '?panel=energy&tab=analysis&layout=docks'")
    page.tab.reload()
    page.laid_out()
    expect(page.tab.locator(".dock.right .analysis:visible")).to_have_count(1)
    page.tab.go_back()
    expect(page.tab.locator(".dock.right")).to_be_hidden()
    assert page.evaluate(MODE) == "lead"


@pytest.mark.parametrize("scene", ["fixed-rod", "hammer-on-cantilever", "two-balls", "four-bar", "brick-on-floor"])
def test_a_link_to_a_scene_opens_its_picture(open_page, scene):
    page = open_page(f"?scene={scene}&speed=1.7", plain=True)
    assert page.evaluate(MODE) == "lead"
    expect(page.tab.locator(".dock.right")).to_be_hidden()
    expect(page.tab.locator(".ask h2")).not_to_be_empty()
    settled(page)
    said = f"?scene={scene}&speed=1.7".replace("scene=fixed-rod&", "")  # the first scene is not said
    page.wait("(said) => location.search === said", said)


def test_a_link_that_names_an_analysis_opens_it_beside_the_picture(open_page):
    page = open_page("?scene=two-balls&panel=energy", plain=True)
    assert page.evaluate(MODE) == "lead"
    expect(page.tab.locator(".dock.right .analysis:visible")).to_have_count(1)


def test_the_question_counts_the_pushes_and_the_change_moves_the_slider(again):
    page = again()
    page.tab.get_by_role("button", name="What if it were").click()
    page.wait("() => strikewave.page.frame.chosen.mass_ratio === 0.25 && !strikewave.page.asked")
    (until, *_), *others = [contact[1:] for contact in page.header("exact")["contacts"]]
    pushes = int(np.ceil(until)) + len(others)  # the front comes back every T
    assert pushes > 3
    expect(page.tab.locator(".ask h2")).to_have_text(f"One impact. Why {NUMBERS[pushes]} peaks of force?")


def test_a_hand_on_the_rows_sets_the_clock(show):
    page = show("?layout=opening")
    box = page.tab.locator(".section").bounding_box()
    place, top, tall = page.evaluate(
        """() => { const { section } = strikewave.page.opening;
                   return [section.y(1.25), section.box.top, section.box.tall]; }"""
    )
    page.tab.mouse.move(box["x"] + 500, box["y"] + place)
    page.tab.mouse.down()
    page.tab.mouse.up()
    start, end = page.evaluate("() => strikewave.page.opening.section.stretch")
    pixel = (end - start) / tall
    assert top > 0 and page.evaluate("() => strikewave.page.player.t") == pytest.approx(1.25, abs=1.5 * pixel)


def test_events_stand_at_their_time(show):
    page = show("?layout=opening")
    names = page.tab.locator(".happens li:visible")
    expect(names.first).to_contain_text("They touch")
    expect(names.last).to_contain_text("They part for good")
    tops = page.evaluate("() => strikewave.page.opening.happens.names.map((name) => parseFloat(name.style.top))")
    assert tops == sorted(tops) and len(tops) == 6
    names.nth(2).get_by_role("button").click()
    assert page.evaluate("() => strikewave.page.player.t") == pytest.approx(1.0, abs=1e-2)


@pytest.mark.parametrize(
    ("scene", "rows", "charts", "question"),
    [
        ("free-rod", 1, 0, "Nothing holds the rod."),
        ("hammer-on-cantilever", 1, 0, "One swing of a hammer. Why five contacts?"),
        ("four-bar", 1, 0, "One link is struck."),
        ("figure-6.2", 1, 0, "It moves on."),
        ("newtons-cradle", 1, 0, "One ball strikes."),
        ("newtons-cradle&speed=2", 1, 0, "One ball comes, one leaves."),
        ("figure-7.4", 1, 0, "Two bodies meet."),
        ("figure-10.8", 1, 0, "One swing, one contact."),
        ("split-hopkinson", 1, 0, "Two gauges on two bars."),
        ("brick-on-floor", 1, 0, "A brick lands on a corner."),
        ("brick-off-centre", 1, 0, "Two bodies meet in a point."),
        ("bouncing-ball", 0, 0, "Infinitely many bounces."),
    ],
)
def test_every_kind_has_its_question_and_its_picture(show, scene, rows, charts, question):
    page = show(f"?scene={scene}&layout=opening")
    expect(page.tab.locator(".ask h2")).to_contain_text(question)
    expect(page.tab.locator(".strip .chart:visible")).to_have_count(charts)
    expect(page.tab.locator(".section:visible")).to_have_count(rows)
    assert 2 <= page.tab.locator(".leading:visible").count() <= 4


def test_a_scene_of_one_instant_stands_there(open_page):
    page = open_page("?scene=figure-8.7", reduced_motion="no-preference")
    for scene, instant in (("figure-8.7", 2e-5), ("figure-5.14", 6.7e-5)):
        if page.header("chosen")["scene"] != scene:
            page.show_scene(scene)
        settled(page)
        now = page.evaluate("() => strikewave.page.player.t * strikewave.page.player.trip")
        assert now == pytest.approx(instant), scene
        assert not page.evaluate("() => strikewave.page.player.playing")


def test_a_ball_of_the_cradle_leaves_with_the_speed_that_is_said(again):
    page = again("newtons-cradle")
    said = page.evaluate("() => strikewave.page.opening.section.shown.feet.all.map(({ words }) => words)")
    speeds = solvers.solve(solvers.load("newtons-cradle"))
    expected = [speeds.impactor_velocity, *speeds.ball_velocities]
    assert [float(words.replace("−", "-")) for words in said] == pytest.approx(expected, rel=0.06)  # two digits
    set_and_wait(page, mass_ratio=40)
    settled(page)
    expect(page.tab.locator(".ask h2")).to_contain_text("turn back?")


def test_a_dropped_ball_has_the_clock_of_its_fall_in_the_opening_alone(open_page):
    page = open_page("?scene=bouncing-ball&layout=opening")
    opened(page)
    page.tab.locator(".happens").get_by_role("button", name="At rest").click()
    assert page.evaluate("() => strikewave.page.player.t") == pytest.approx(4.064, abs=1e-2)
    page.tab.locator(".closer").get_by_role("button", name="All charts and controls").click()
    assert page.evaluate("() => strikewave.page.player.duration") == page.header("duration")
    assert page.evaluate("() => strikewave.page.root.dataset.kind") == "axial"
    page.tab.get_by_role("button", name="← Picture", exact=True).click()
    assert page.evaluate("() => strikewave.page.player.duration") > 4.0


def test_the_clock_of_bodies_in_space_goes_through_the_impact(show):
    page = show("?scene=spinning-ball&layout=opening")
    names = page.tab.locator(".happens li:visible")
    expect(names).to_have_count(4)
    names.filter(has_text="grips").get_by_role("button").click()
    expect(page.tab.locator(".player .clock")).to_have_text("0.263 N s")
    assert page.evaluate("() => strikewave.page.space.stage.time") == 0  # bodies stand where they meet


@pytest.mark.parametrize("scene", ["four-bar-moves", "figure-9.11", "sphere-on-half-space"])
def test_tracks_lie_beside_one_another_within_the_picture(open_page, scene):
    page = open_page(f"?scene={scene}&layout=opening", size=SIZES[0])
    for size in SIZES:
        page.resize(*size)
        places, width = page.evaluate(
            """() => {
              const { root, tracks } = strikewave.page.opening.section;
              return [tracks.map(({ place: { left, right } }) => [left, right]), root.clientWidth];
            }"""
        )
        assert places or (scene == "figure-9.11" and size[0] < 560)  # there the rod has all of the room
        ends = [0, *(end for place in places for end in place), width]
        assert ends == sorted(ends)


def test_events_are_named_on_a_tablet_and_a_phone(show):
    for size in SIZES[2:]:
        page = show("?layout=opening", size=size)
        expect(page.tab.locator(".happens li:visible").first).to_contain_text("They touch")
