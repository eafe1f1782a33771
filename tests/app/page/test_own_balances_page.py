"""Repeated balances, beside the waves in a rod and of a mass on a spring, while a slider moves; the server follows at
rest."""

import pytest

from .moved import STATE, arrays_alike, figures_alike, moved

BESIDE = """() => {
  const { frame } = strikewave.page, { other, shapes } = frame;
  const { contacts, cutOff, energy, final, left, model, peakForce, restitution, targetFinal } = other;
  const { balances, steps } = other.diagnostics;
  const figures = { contacts, cutOff, energy, final, left, peakForce, restitution, targetFinal, balances, steps };
  const names = ['otherMass', 'otherEnd', 'fieldDisplacement', 'fieldStress', 'fieldVelocity', 'balanceForce'];
  const arrays = Object.fromEntries(names.filter((name) => frame[name]).map((name) => [name, [...frame[name]]]));
  return { figures, arrays, said: [model, frame.acting.toSorted(), shapes.fieldStress] };
}"""


@pytest.mark.parametrize(
    "query, name, values",
    [
        ("?scene=figure-6.3", "mass_ratio", [0.5, 1.7]),
        ("?scene=figure-6.5", "speed", [2.5]),
        ("?scene=table-6.3", "restitution", [0.4]),
        ("?scene=table-6.5&layout=opening", "mass_ratio", [0.8]),
        ("?scene=table-6.1", "restitution", [0.2]),
        ("?scene=spring-mass", "mass_ratio", [0.5, 0.7]),
        ("?scene=figure-4.21", "speed", [3.0]),
        ("?scene=figure-4.22", "restitution", [0.3]),
    ],
)
def test_it_is_answered_as_the_server_does(show, query, name, values):
    (state, there), (before, after) = moved(show(query), name, values, STATE, BESIDE)
    assert before["said"] == after["said"]
    figures_alike(state["figures"], there["figures"], 1e-9)
    figures_alike(before["figures"], after["figures"], 1e-9)
    arrays_alike(before["arrays"], after["arrays"], 2e-4)
