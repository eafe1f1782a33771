"""What the browser answers by itself while a slider moves, by the library's own kernels; the server follows at rest."""

import pytest
from playwright.sync_api import expect

from .moved import AT_REST, CHOOSE, READY, STATE, arrays_alike, by_itself, figures_alike, flat, moved

BESIDE = """() => {
  const { frame } = strikewave.page, { fieldForce, modalForce, modes, other, otherEnd, otherMass, step } = frame;
  const { contacts, cutOff, energy, final, left, name, peakForce, peakIndentation, restitution, targetFinal } = other;
  const { raw_contacts, raw_peak_force, resolved_time, steps } = other.diagnostics;
  const figures = { contacts, cutOff, energy, final, left, peakForce, peakIndentation, restitution, targetFinal };
  const numbers = { modes, raw_contacts, raw_peak_force, resolved_time, step, steps };
  const force = modalForce ? { modalForce: [...modalForce] } : { fieldForce: [...fieldForce] };
  const arrays = { ...force, otherEnd: [...otherEnd], otherMass: [...otherMass] };
  return { name, figures: { ...figures, numbers }, arrays };
}"""
CYCLE = """() => {
  const drawn = 'blowDepth blowForce cycleDepth cycleLoading cycleUnloading touchRadius touchPressure'.split(' ');
  const { frame } = strikewave.page;
  return Object.fromEntries(drawn.flatMap((name) => (name in frame ? [[name, [...frame[name]]]] : [])));
}"""
BARS = "?scene=four-bar{}&layout=laboratory"
ARRIVED = """(search) => {
  const { asked, history } = strikewave.page;
  return location.search === search && !asked && !history.going;
}"""


@pytest.mark.parametrize(
    "name, values", [("mass_ratio", [0.9, 0.8, 0.7, 3.0]), ("speed", [1.5, 2.5]), ("restitution", [0.4])]
)
@pytest.mark.parametrize("query", ["?layout=opening", "?layout=laboratory", "?scene=free-rod"])
def test_what_the_browser_shows_is_what_the_server_answers(show, query, name, values):
    page = show(query)
    page.wait(READY)
    sent = page.quiet()["sent"]
    ((before, after),) = moved(page, name, values, STATE)
    figures_alike(before["figures"], after["figures"], 1e-12)
    for array, found in before["arrays"].items():
        assert found == pytest.approx(after["arrays"][array], abs=1e-6), array  # which the message has in 4 bytes
    assert before["force"] == pytest.approx(after["force"], rel=2e-3)  # at the instants that either draws
    assert page.quiet()["sent"] - sent <= 3  # whatever moved


@pytest.mark.parametrize(
    "query, name, values",
    [
        ("?layout=opening&law=hertz", "mass_ratio", [0.9, 0.5, 2.0]),
        ("?scene=bronze-rod-steel-ball", "speed", [1.5, 0.3]),
        ("?scene=free-rod&law=plastic-linear", "mass_ratio", [0.6]),
        ("?law=kelvin-voigt", "mass_ratio", [0.8]),
        ("?scene=free-rod&law=lee-wang", "mass_ratio", [0.3]),
        ("?law=hunt-crossley", "speed", [3.0]),
        ("?law=hunt-crossley", "restitution", [0.35, 1.0]),
        ("?scene=free-rod&law=kelvin-voigt", "restitution", [0.005, 0.6]),
        ("?layout=opening", "law", ["hertz", "linear", "kelvin-voigt"]),
        ("?scene=bronze-rod-steel-ball", "law", ["rigid"]),
        ("?law=hertz", "hertz_stiffness", [3e9]),
        ("?scene=figure-9.13", "speed", [0.5]),
        ("?scene=figure-10.3", "mass_ratio", [2.0]),
    ],
)
def test_contact_laws_are_answered_alike(show, query, name, values):
    """Up to the tolerance of a step: the server solves with constants that differ in the last bit."""
    (before, after), (cycle, there) = moved(show(query), name, values, STATE, CYCLE)
    figures_alike(before["figures"], after["figures"], 1e-6)
    for array, found in before["arrays"].items():
        assert found == pytest.approx(after["arrays"][array], abs=1e-6), array
    assert sorted(cycle) == sorted(there)
    for array, found in there.items():
        assert cycle[array] == pytest.approx(found, rel=1e-3, abs=1e-3 * max(found)), array


def test_another_restitution_of_a_damped_contact_is_left_to_the_server(open_page):
    page = open_page("?law=lee-wang")
    page.wait(READY)
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('restitution', 0.35)"))
    assert page.header("chosen")["restitution"] == 0.35
    assert page.evaluate("() => strikewave.page.own.count") == 0


@pytest.mark.parametrize(
    "query, name, values",
    [
        ("?layout=opening", "modes", [20, 80]),
        ("?layout=opening", "mass_ratio", [0.9, 0.5]),
        ("?scene=free-rod&method=modal", "modes", [10]),
        ("?method=modal", "modes", [3]),
        ("?scene=bronze-rod-steel-ball", "speed", [4.0]),
        ("?law=hertz", "modes", [200]),
        ("?scene=free-rod&law=plastic-power", "modes", [30]),
        ("?law=kelvin-voigt", "restitution", [0.3]),
        ("?scene=figure-9.5", "speed", [0.7]),
        ("?scene=figure-9.13", "modes", [20]),
        ("?scene=figure-10.1", "mass_ratio", [5.0]),
        ("?scene=figure-10.3", "speed", [2.0]),
        ("?scene=figure-10.6", "modes", [7, 60]),
    ],
)
def test_the_method_beside_by_modes_is_answered_alike(show, query, name, values):
    """Up to rounding that chatter has made larger; a law's constants here and there differ in the last bit."""
    ((before, after),) = moved(show(query), name, values, BESIDE)
    assert before["name"] == after["name"] == "modal"
    figures_alike(before["figures"], after["figures"], 1e-6)
    for array, found in before["arrays"].items():
        close = 2e-5 if array == "fieldForce" else 1e-6  # which the message has in two bytes
        assert found == pytest.approx(after["arrays"][array], abs=close * max(map(abs, found))), array


BENT = """() => {
  const { frame } = strikewave.page, { contacts, duration, law, main, smoothing, span, step } = frame;
  const { diagnostics, energy, final, impulse, peakForce, peakIndentation, residualIndentation } = main;
  const { restitution, targetFinal } = main;
  const { raw_contacts, raw_peak_force, resolved_time, steps, momentum_error } = diagnostics;
  const figures = { energy, final, impulse, peakForce, peakIndentation, residualIndentation, restitution, targetFinal };
  const known = { raw_contacts, raw_peak_force, resolved_time, steps, momentum_error, real: span.real };
  const both = { contacts, duration, smoothing, step, apparent: span.apparent };
  const drawn = 'time impactorPath struckPath impactorRate struckRate modalForce rates blowDepth blowForce'.split(' ');
  const cycle = ['cycleDepth', 'cycleLoading', 'cycleUnloading'];
  const arrays = [...drawn, ...cycle].filter((name) => name in frame && frame[name]);
  const all = Object.fromEntries(arrays.map((name) => [name, [...frame[name]]]));
  return { law, figures: { ...figures, known, both }, arrays: all };
}"""


@pytest.mark.parametrize(
    "query, name, values",
    [
        ("?scene=figure-8.25&layout=opening", "mass_ratio", [3.0, 5.0]),
        ("?scene=figure-8.25&layout=opening", "speed", [2.0]),
        ("?scene=xylophone-bar&layout=opening", "hertz_stiffness", [3e8]),
        ("?scene=xylophone-bar-node&layout=opening", "mass_ratio", [5.0]),
        ("?scene=figure-5.1&layout=opening", "speed", [0.5]),
        ("?scene=figure-8.20&layout=opening", "law", ["hertz", "plastic-power"]),
        ("?scene=timoshenko-1913-long&law=hunt-crossley&layout=opening", "restitution", [0.4]),
    ],
)
def test_what_is_struck_across_is_answered_alike(show, query, name, values):
    """Up to rounding, which many contacts have made larger."""
    ((before, after),) = moved(show(query), name, values, BENT)
    assert before["law"] == after["law"]
    assert flat(before["figures"]) == pytest.approx(flat(after["figures"]), rel=1e-6, abs=1e-9, nan_ok=True)
    arrays_alike(before["arrays"], after["arrays"], 1e-4)


def test_what_acts_and_what_is_said_of_a_beam_follow_the_law_and_the_mass(open_page):
    page = open_page("?scene=xylophone-bar&layout=opening")
    said = "() => [strikewave.page.frame.acting.toSorted(), strikewave.page.frame.span.half]"
    for name, value, restores in (("law", "hunt-crossley", True), ("law", "hertz", False), ("mass_ratio", 2.0, False)):
        ((before, (acting, half)),) = moved(page, name, [value], said)
        assert before[0] == acting and ("restitution" in acting) == restores
        assert before[1] == pytest.approx(half, rel=1e-3)


def test_a_rigid_contact_with_modes_that_stand_for_all_is_left_to_the_server(open_page):
    page = open_page("?scene=figure-8.11&law=rigid&layout=opening")
    page.wait(READY)
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('law', 'hertz')"))
    assert page.evaluate("() => strikewave.page.own.count") == 0


def test_modes_of_another_frame_are_left_to_the_server(open_page):
    page = open_page("?scene=free-rod&floating_frame=attached")
    page.wait(READY)
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('modes', 20)"))
    assert page.header("chosen")["modes"] == 20
    assert page.evaluate("() => strikewave.page.own.count") == 0


def test_after_an_answer_that_takes_too_long_the_server_answers_for_a_while(open_page):
    page = open_page()
    page.wait(READY)
    page.evaluate("() => { strikewave.page.own.answers.longest = -1; }")
    for value in (0.8, 0.7):
        page.answered(lambda value=value: page.evaluate("v => strikewave.page.controls.send('mass_ratio', v)", value))
        page.wait(AT_REST, ["mass_ratio", value])
    assert page.evaluate("() => strikewave.page.own.count") == 0
    page.evaluate("() => { strikewave.page.own.answers.longest = Infinity; }")
    page.wait("() => performance.now() > strikewave.page.own.resumes")
    page.evaluate("() => strikewave.page.controls.send('mass_ratio', 0.6)")
    page.wait("() => strikewave.page.own.count > 0")


def test_an_answer_is_practised_before_any_is_asked_for(open_page):
    page = open_page("?scene=hammer-on-cantilever")
    page.wait("() => strikewave.page.own.answers?.rest > 0")  # of an answer, until memory is given back
    assert page.evaluate("() => strikewave.page.own.count") == 0
    assert not page.evaluate("() => strikewave.page.own.made.has(strikewave.page.frame)")


def test_it_goes_on_without_a_server(open_page):
    page = open_page()
    page.wait(READY)
    page.evaluate("() => { strikewave.page.changes.server.lost = () => true; }")
    one, other = (by_itself(page, "mass_ratio", [value], STATE) for value in (0.5, 0.6))
    assert one != other


@pytest.mark.parametrize("query", ["?method=balance", "?scene=figure-5.12", "?scene=newtons-cradle"])
def test_what_it_cannot_the_server_answers(open_page, query):
    page = open_page(query)
    page.wait(READY)
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('speed', 1.7)"))
    assert page.header("chosen")["speed"] == 1.7
    assert page.evaluate("() => strikewave.page.own.count") == 0


def test_without_webassembly_the_server_answers_alone(open_page):
    page = open_page(own=True, script="delete globalThis.WebAssembly;")
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('mass_ratio', 0.7)"))
    assert page.header("chosen")["mass_ratio"] == 0.7
    assert page.evaluate("() => strikewave.page.own.answers") is None


def test_a_hand_that_comes_back_finds_what_the_server_has_answered(open_page):
    page = open_page()
    page.wait(READY)
    was = page.evaluate("() => strikewave.page.frame.chosen.mass_ratio")
    page.evaluate(
        """(was) => {
          const { controls } = strikewave.page;
          controls.send('mass_ratio', 0.9);
          requestAnimationFrame(() => requestAnimationFrame(() => controls.send('mass_ratio', was)));
        }""",
        was,
    )
    page.wait("() => strikewave.page.own.count > 0")
    page.wait(AT_REST, ["mass_ratio", was])
    assert page.evaluate("() => strikewave.page.frame.exact.notes.length") > 0  # of which the browser knows none


def test_words_follow_while_a_slider_is_dragged(open_page):
    page = open_page()
    page.wait(READY)
    said = page.evaluate(
        """async () => {
          const { page } = strikewave, seen = new Set(), begun = performance.now();
          for (let k = 0; performance.now() - begun < 800; k++) {
            page.controls.send('mass_ratio', 0.6 + 0.002 * k);
            await new Promise(requestAnimationFrame);
            seen.add(page.saidAt);
          }
          return seen.size;
        }"""
    )
    assert said >= 3


def test_undo_at_once_takes_the_slider_back(open_page):
    page = open_page("?layout=opening")
    page.wait(READY)
    slider = page.tab.get_by_role("slider", name="Modes")
    before = slider.input_value()
    slider.focus()
    for _ in range(3):
        page.tab.keyboard.press("ArrowLeft")
    page.wait("() => strikewave.page.frame.chosen.modes === 47")
    page.tab.keyboard.press("Control+z")
    page.wait("() => strikewave.page.frame.chosen.modes === 50")
    assert slider.input_value() == before


def test_undo_while_the_server_has_not_answered_goes_back_by_one(open_page):
    page = open_page()
    page.wait(READY)
    by_itself(page, "mass_ratio", [0.9, 0.8])
    page.wait(AT_REST, ["mass_ratio", 0.8])
    page.tab.wait_for_timeout(1200)  # another move then is a step of its own
    by_itself(page, "mass_ratio", [0.5])
    page.tab.get_by_role("button", name="Undo").click()
    page.wait(AT_REST, ["mass_ratio", 0.8])


def test_undo_goes_back_by_one_as_soon_as_the_server_has_answered(open_page):
    page = open_page()
    page.wait(READY)
    page.answered(lambda: page.evaluate(CHOOSE, ["mass_ratio", 0.8]))
    page.tab.wait_for_timeout(1200)  # another move then is a step of its own
    page.evaluate(
        """async () => {
          const { page } = strikewave;
          page.own.answers = null;
          page.choose('mass_ratio', 0.5);
          while (page.frame.chosen.mass_ratio !== 0.5) await new Promise(requestAnimationFrame);
          page.history.undo(); // before anything is said of the answer
        }"""
    )
    page.wait(AT_REST, ["mass_ratio", 0.8])


def test_undo_twice_at_once_goes_back_by_two(open_page):
    page = open_page(BARS.format(""))
    places = [page.evaluate("() => location.search")]
    for value in (1.5, 2.0):
        page.answered(lambda value=value: page.evaluate(CHOOSE, ["speed", value]))
        places.append(page.evaluate("() => location.search"))
        page.tab.wait_for_timeout(1200)
    page.evaluate("() => { const { history } = strikewave.page; history.undo(); history.undo(); }")
    page.wait(ARRIVED, places[0])
    for place in places[1:]:
        page.evaluate("() => strikewave.page.history.redo()")
        page.wait(ARRIVED, place)
    assert places == [BARS.format(chosen) for chosen in ("", "&speed=1.5", "&speed=2")]


def test_two_controls_moved_at_once_are_two_steps(open_page):
    page = open_page(BARS.format(""))
    page.tab.wait_for_timeout(800)
    # However slow the answers are: the first is a step of its own, the second goes on with it.
    for pause, choice in ((0, ["speed", 1.5]), (1e6, ["speed", 2.0]), (1e6, ["mass_ratio", 2.0])):
        page.evaluate("(pause) => { strikewave.page.history.pause = pause; }", pause)
        page.answered(lambda choice=choice: page.evaluate(CHOOSE, choice))
    page.evaluate("() => strikewave.page.history.undo()")
    page.wait(ARRIVED, BARS.format("&speed=2"))
    page.evaluate("() => strikewave.page.history.undo()")
    page.wait(ARRIVED, BARS.format(""))


def test_a_drag_is_one_step_however_long_it_rests(open_page):
    page = open_page(BARS.format(""))
    before = page.evaluate("() => location.search")
    page.tab.wait_for_timeout(800)
    mouse, box = page.tab.mouse, page.tab.get_by_role("slider", name="Mass ratio").bounding_box()
    y = box["y"] + box["height"] / 2
    mouse.move(box["x"] + 0.5 * box["width"], y)
    mouse.down()
    for share in (0.6, 0.8, 0.7):
        page.answered(lambda share=share: mouse.move(box["x"] + share * box["width"], y))
        page.tab.wait_for_timeout(1200)
    mouse.up()
    page.wait("(before) => location.search !== before && !strikewave.page.asked", before)
    page.evaluate("() => strikewave.page.history.undo()")
    page.wait(ARRIVED, before)
    expect(page.tab.get_by_role("button", name="Undo")).to_be_disabled()


def test_histories_are_saved_once_the_server_has_solved_them(open_page):
    page = open_page()
    page.wait(READY)
    page.evaluate("() => { strikewave.page.changes.server.lost = () => true; }")
    by_itself(page, "mass_ratio", [0.5])
    page.take("Histories (CSV)")
    assert page.tab.get_by_text("The server has not solved this yet").is_visible()


def test_where_none_is_found_those_of_the_server_are_shown_while_a_slider_moves(open_page):
    page = open_page("?scene=hammer-on-cantilever")
    page.wait(READY)
    shown = page.evaluate(
        """async () => {
          const { page } = strikewave, { own } = page, shown = new Set();
          own.answers.answer = () => null;
          for (let k = 0; k < 400 && shown.size < 4; k++) {
            page.controls.send('speed', 1 + 0.002 * k);
            await new Promise((done) => requestAnimationFrame(done));
            shown.add(page.frame.chosen.speed);
          }
          return shown.size;
        }"""
    )
    assert shown == 4
