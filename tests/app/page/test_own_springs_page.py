"""A rod that bends as a spring beside the waves in it, while a slider moves; the server follows at rest."""

import pytest

from .moved import READY, STATE, arrays_alike, figures_alike, moved

BESIDE = """() => {
  const { frame } = strikewave.page, { fieldDisplacement, fieldStress, fieldVelocity, other, shapes } = frame;
  const { contacts, cutOff, energy, final, left, model, peakForce, peakIndentation, restitution, targetFinal } = other;
  const { initial_impulse, peak_root_force, steps } = other.diagnostics;
  const { sudden, waves, travelling, byLaw, stillTouching, residualIndentation } = other;
  const figures = { contacts, cutOff, energy, final, left, peakForce, peakIndentation, restitution, targetFinal };
  const numbers = { initial_impulse, peak_root_force, steps, residualIndentation };
  const drawn = { otherMass: frame.otherMass, otherEnd: frame.otherEnd, fieldDisplacement, fieldStress, fieldVelocity };
  const arrays = Object.fromEntries(Object.entries(drawn).map(([name, values]) => [name, [...values]]));
  const said = [model, sudden, waves, travelling, byLaw, stillTouching, frame.acting.toSorted(), shapes.fieldStress];
  return { figures: { ...figures, numbers }, arrays, said };
}"""


@pytest.mark.parametrize(
    "query, name, values",
    [
        ("?scene=figure-3.4", "mass_ratio", [0.5, 2.0]),
        ("?scene=figure-3.4", "speed", [2.5]),
        ("?scene=figure-3.5", "mass_ratio", [0.7]),
        ("?scene=figure-5.10&layout=opening", "mass_ratio", [0.2, 0.3]),
        ("?scene=figure-5.8", "restitution", [0.4]),
        ("?scene=figure-3.4&law=hertz", "mass_ratio", [0.6]),
        ("?method=quasi-static", "mass_ratio", [0.4]),
    ],
)
def test_it_is_answered_as_the_server_does(show, query, name, values):
    (state, there), (before, after) = moved(show(query), name, values, STATE, BESIDE)
    assert before["said"] == after["said"]
    figures_alike(state["figures"], there["figures"], 1e-6 if "law" in query else 1e-11)  # the tolerance of a step
    figures_alike(before["figures"], after["figures"], 1e-9 if "law" in query else 1e-11)  # for as long as waves say
    arrays_alike(before["arrays"], after["arrays"], 1e-4)


def test_by_a_law_another_model_may_answer_which_is_left_to_the_server(open_page):
    page = open_page("?method=quasi-static")
    page.wait(READY)
    page.answered(lambda: page.evaluate("() => strikewave.page.controls.send('law', 'hertz')"))
    assert page.header("chosen")["law"] == "hertz"
    assert page.evaluate("() => strikewave.page.own.count") == 0
