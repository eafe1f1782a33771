"""Points of the map, asked by the page itself: found beside all that it shows, which stays as it is."""

import pytest

from .test_page import settled

# Points over these names at these rows, with what else is chosen by now.
FIND = """async ([names, rows, more]) => {
  const script = document.querySelector('link[rel=modulepreload][href$="/page.js"]').href;
  const { page } = strikewave;
  const { door } = page.opening;
  await door.open();
  const Served = door.whatif.points.served.constructor;
  door.close();
  const { COLUMNS } = await import(script.replace('page.js', 'wasm/answers.js'));
  const { frame } = page;
  const chosen = { ...frame.chosen, ...more };
  const before = [location.href, history.length, page.waiter.root?.textContent, page.frame];
  const found = await new Promise((done) => {
    const jobs = [{ chosen, names, rows: Float64Array.from(rows.flat()), done: (...all) => done(all) }];
    const served = new Served(page, () => jobs.shift() ?? null);
    served.scene(frame);
    served.feed();
  });
  const [values, , why] = found;
  const after = [location.href, history.length, page.waiter.root?.textContent, page.frame];
  const points = rows.map((_, k) =>
    Object.fromEntries(COLUMNS.map((name, c) => [name, values[k * COLUMNS.length + c]])));
  return { points, why: [...why], same: before.every((each, k) => each === after[k]), main: frame.main ?? null };
}"""


def test_points_are_those_of_the_picture_and_leave_it_alone(open_page):
    page = open_page("?scene=xylophone-bar&panel=energy")
    settled(page)
    chosen = page.header("chosen")
    rows = [[chosen["mass_ratio"], chosen["speed"]], [1e9, 1.0], *([0.5 + 0.1 * k, 1.0] for k in range(40))]
    found = page.evaluate(FIND, [["mass_ratio", "speed"], rows, {}])
    first, main = found["points"][0], found["main"]
    assert first["status"] == 0 and first["contacts"] == main["contacts"]
    assert first["impactor_velocity"] == pytest.approx(main["final"], rel=1e-9)
    assert first["peak_force"] == pytest.approx(main["peakForce"], rel=1e-9)
    assert first["newton"] == pytest.approx(main["restitution"]["newton"], rel=1e-9)
    [(number, why)] = found["why"]
    assert number == 1 and found["points"][1]["status"] == 1 and "Choose" in why
    assert [point["status"] for point in found["points"][2:]] == [0] * 40
    assert found["same"], "neither address nor history, notice nor picture"
    assert page.evaluate("() => strikewave.page.model.refused") == ""
    longer = page.evaluate(FIND, [["target.length"], [[0.2], [0.3]], {"law": "rigid"}])
    assert longer["points"][0]["impactor_velocity"] != longer["points"][1]["impactor_velocity"]
