"""Rods that strike rods, and rods one behind the other, by exact waves while a slider moves; the server follows."""

import pytest

from .moved import READY, arrays_alike, figures_alike, moved

CHAIN = """() => {
  const { frame } = strikewave.page, { acting, chain, duration, exact, gaps, match, other, prediction } = frame;
  const of = (solution) => {
    const { contacts, cutOff, diagnostics, energy, final, left, peakForce, restitution, targetFinal } = solution;
    const { steps, raw_peak_force } = diagnostics;
    return { contacts, cutOff, energy, final, left, peakForce, restitution, steps, raw_peak_force, targetFinal };
  };
  const { peakIndentation, residualIndentation, stillTouching } = exact;
  const figures = { chain, duration, gaps, match, prediction, exact: of(exact), other: other ? of(other) : null };
  const paths = /^([fg]\\d|(exact|other)(Mass|End|Whole))$/;
  const drawn = Object.entries(frame).filter(([name, values]) => paths.test(name) && values);
  const arrays = Object.fromEntries(drawn.map(([name, values]) => [name, [...values]]));
  const names = [exact.name, other?.name];
  const said = [acting.toSorted(), peakIndentation, residualIndentation, stillTouching, names, frame.rigid];
  return { figures, arrays, said, force: Math.max(...frame.exactForce) };
}"""


@pytest.mark.parametrize(
    "query, name, values",
    [
        ("?scene=two-equal-rods", "speed", [2.0, 0.7]),
        ("?scene=two-unequal-rods", "speed", [1.3]),
        ("?scene=two-unequal-rods", "restitution", [0.3]),
        ("?scene=figure-4.2", "speed", [3.0]),
        ("?scene=figure-4.4&method=modal", "speed", [3.0]),
        ("?scene=figure-4.5", "speed", [3.0]),
        ("?scene=figure-4.8&layout=opening", "speed", [0.4]),
        ("?scene=stepped-rod", "speed", [2.0]),
        ("?scene=split-hopkinson", "speed", [5.0]),
        ("?scene=rod-with-gap", "mass_ratio", [1.0, 0.7]),
        ("?scene=rod-with-gap", "speed", [2.0]),
        ("?scene=rod-with-end-mass", "mass_ratio", [3.0, 0.4]),
        ("?scene=rod-with-end-mass", "restitution", [0.5]),
        ("?scene=semi-infinite-rod", "mass_ratio", [0.6, 4.0]),
        ("?scene=figure-4.1&layout=opening", "mass_ratio", [3.0]),
        ("?scene=figure-3.6", "speed", [3.0, 0.7]),
        ("?scene=figure-4.6", "speed", [3.0]),
    ],
)
def test_it_is_answered_as_the_server_does(show, query, name, values):
    ((before, after),) = moved(show(query), name, values, CHAIN)
    assert before["said"] == after["said"]
    exact, there = before["figures"], after["figures"]
    other, beside = exact.pop("other"), there.pop("other")
    figures_alike(exact, there, 1e-11)
    figures_alike(other, beside, 1e-9)  # chatter enlarges rounding
    arrays_alike(before["arrays"], after["arrays"], 2e-6)
    assert before["force"] == pytest.approx(after["force"], rel=2e-3)  # at the instants that either draws


@pytest.mark.parametrize("name, value", [("law", "hertz"), ("modes", 20)])
def test_what_the_kernel_does_not_know_is_left_to_the_server(open_page, name, value):
    page = open_page("?scene=two-unequal-rods")
    page.wait(READY)
    page.answered(lambda: page.evaluate(f"() => strikewave.page.controls.send('{name}', {value!r})"))
    assert page.header("chosen")[name] == value
    assert page.evaluate("() => strikewave.page.own.count") == 0
