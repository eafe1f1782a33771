"""Two bodies that move as wholes, while a slider moves; the server follows at rest."""

import pytest

from .test_own_answers_page import AT_REST, READY, flat

STATE = """() => {
  const { frame, own } = strikewave.page, { acting, duration, exact, forceUnit, match, other, prediction } = frame;
  const figuresOf = ({ contacts, cutOff, energy, final, left, peakForce, peakIndentation, ...more }) => {
    const { residualIndentation, restitution, targetFinal, stillTouching, diagnostics } = more;
    const { raw_contacts, raw_peak_force, delivered_restitution, steps } = diagnostics;
    const figures = { contacts, cutOff, energy, final, left, peakForce, peakIndentation, restitution, targetFinal };
    const numbers = [raw_contacts, raw_peak_force, delivered_restitution, steps, residualIndentation, stillTouching];
    return { ...figures, numbers };
  };
  const { damps, exponent, nominal, rigid, speed, stressUnit, trip, yields } = frame;
  const same = [damps, duration, exponent, forceUnit, match, nominal, rigid, speed, stressUnit, trip, yields];
  const drawn = 'motionTime exactMass exactEnd exactTime exactForce otherMass otherEnd otherTime otherForce'.split(' ');
  const cycle = 'cycleDepth cycleLoading cycleUnloading blowDepth blowForce touchRadius'.split(' ');
  const names = [...drawn, ...cycle, 'touchPressure', 'touchFlow'].filter((name) => frame[name]);
  return {
    own: own.made.has(frame),
    figures: { exact: figuresOf(exact), other: figuresOf(other), same, prediction },
    acting: acting.toSorted(),
    arrays: Object.fromEntries(names.map((name) => [name, [...frame[name]]])),
  };
}"""
MOVE = """async ([name, values]) => {
  const { page } = strikewave, { own } = page, seen = [];
  for (const value of values) {
    const before = own.count;
    Object.assign(own, { slow: 0, resumes: 0 }).answers.kernels.longest = Infinity; // however busy the machine is
    page.controls.send(name, value);
    for (let k = 0; own.count === before && k < 100; k++) await new Promise((done) => requestAnimationFrame(done));
    seen.push([own.made.has(page.frame), page.frame.chosen[name]]);
  }
  return [seen, (STATE)()];
}""".replace("STATE", STATE)


@pytest.mark.parametrize(
    "query, name, values",
    [
        ("?scene=two-balls&layout=opening", "mass_ratio", [1.0, 0.3]),
        ("?scene=two-balls&layout=opening", "speed", [2.0, 3.0]),
        ("?scene=two-balls", "hertz_stiffness", [3e9]),
        ("?scene=figure-3.2", "law", ["power"]),
        ("?scene=figure-3.7", "restitution", [0.3]),
        ("?scene=figure-3.8", "speed", [0.4]),
        ("?scene=figure-3.8", "hertz_stiffness", [3e9]),
        ("?scene=two-balls", "law", ["plastic-power"]),
        ("?scene=sphere-on-half-space", "speed", [2.0]),
        ("?scene=figure-7.3", "law", ["plastic-linear"]),
        ("?scene=figure-7.4", "speed", [0.2]),
        ("?scene=figure-7.5", "speed", [0.02, 3.0]),
        ("?scene=table-7.1", "hertz_stiffness", [3e9]),
    ],
)
def test_they_are_answered_as_the_server_does(open_page, query, name, values):
    page = open_page(query)
    page.wait(READY)
    seen, before = page.evaluate(MOVE, [name, values])
    assert seen == [[True, value] for value in values]
    page.wait(AT_REST, [name, values[-1]])
    after = page.evaluate(STATE)
    assert before["own"] and not after["own"] and before["acting"] == after["acting"]
    assert flat(before["figures"]) == pytest.approx(flat(after["figures"]), rel=1e-11, abs=1e-11, nan_ok=True)
    gone = {name for name in after["arrays"] if name.startswith("touch")} if name == "law" else set()
    assert before["arrays"].keys() == after["arrays"].keys() - gone  # of another law it does not know the faces
    for array, found in before["arrays"].items():
        there = after["arrays"][array]
        if len(found) == len(there):  # else the server has thinned it
            assert found == pytest.approx(there, abs=1e-4 * max(1e-9, *map(abs, there))), (
                array
            )  # of two bytes, some of them


@pytest.mark.parametrize("query, value", [("?scene=two-balls", "linear"), ("?scene=figure-3.8", "power")])
def test_other_laws_are_left_to_the_server(open_page, query, value):
    page = open_page(query)
    page.wait(READY)
    page.answered(lambda: page.evaluate("law => strikewave.page.controls.send('law', law)", value))
    assert page.header("chosen")["law"] == value
    assert page.evaluate("() => strikewave.page.own.count") == 0
