"""Two bodies that move as wholes, while a slider moves; the server follows at rest."""

import pytest

from .moved import READY, figures_alike, moved

STATE = """() => {
  const { frame } = strikewave.page, { acting, duration, exact, forceUnit, match, other, prediction } = frame;
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
    figures: { exact: figuresOf(exact), other: figuresOf(other), same, prediction },
    acting: acting.toSorted(),
    arrays: Object.fromEntries(names.map((name) => [name, [...frame[name]]])),
  };
}"""


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
        ("?scene=figure-3.3", "mass_ratio", [0.4]),
        ("?scene=figure-7.2", "speed", [0.3]),
        ("?scene=two-balls", "law", ["lankarani-nikravesh"]),
        ("?scene=two-balls&law=hunt-crossley", "restitution", [0.4, 1.0]),
    ],
)
def test_they_are_answered_as_the_server_does(show, query, name, values):
    ((before, after),) = moved(show(query), name, values, STATE)
    assert before["acting"] == after["acting"]
    figures_alike(before["figures"], after["figures"], 1e-11)
    gone = {name for name in after["arrays"] if name.startswith("touch")} if name == "law" else set()
    assert before["arrays"].keys() == after["arrays"].keys() - gone  # of another law it does not know the faces
    for array, found in before["arrays"].items():
        there = after["arrays"][array]
        if len(found) == len(there):  # else the server has thinned it
            assert found == pytest.approx(there, abs=1e-4 * max(1e-9, *map(abs, there))), array  # some of two bytes


@pytest.mark.parametrize("query, value", [("?scene=two-balls", "linear"), ("?scene=figure-3.8", "power")])
def test_other_laws_are_left_to_the_server(open_page, query, value):
    page = open_page(query)
    page.wait(READY)
    page.answered(lambda: page.evaluate("law => strikewave.page.controls.send('law', law)", value))
    assert page.header("chosen")["law"] == value
    assert page.evaluate("() => strikewave.page.own.count") == 0
