"""Repeated balances, beside the waves in a rod and of a mass on a spring, while a slider moves; the server follows at
rest."""

import pytest

from .test_own_answers_page import AT_REST, MOVE, READY, STATE, flat

BESIDE = """() => {
  const { frame, own } = strikewave.page, { other, shapes } = frame;
  const { contacts, cutOff, energy, final, left, model, peakForce, restitution, targetFinal } = other;
  const { balances, steps } = other.diagnostics;
  const figures = { contacts, cutOff, energy, final, left, peakForce, restitution, targetFinal, balances, steps };
  const names = ['otherMass', 'otherEnd', 'fieldDisplacement', 'fieldStress', 'fieldVelocity', 'balanceForce'];
  const arrays = Object.fromEntries(names.filter((name) => frame[name]).map((name) => [name, [...frame[name]]]));
  return { own: own.made.has(frame), figures, arrays, said: [model, frame.acting.toSorted(), shapes.fieldStress] };
}"""
NO_WAVES = ("{ f0, exactMass,", "{ f0: f0 ?? [], exactMass,")
STATE_OF_ANY = STATE.replace(*NO_WAVES)
MOVE_BOTH = MOVE.replace("()];", f"(), ({BESIDE})()];").replace(*NO_WAVES)


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
def test_it_is_answered_as_the_server_does(open_page, query, name, values):
    page = open_page(query)
    page.wait(READY)
    seen, state, before = page.evaluate(MOVE_BOTH, [name, values])
    assert [[made, value] for made, value, _ in seen] == [[True, value] for value in values]
    page.wait(AT_REST, [name, values[-1]])
    after, there = page.evaluate(BESIDE), page.evaluate(STATE_OF_ANY)
    assert before["own"] and not after["own"] and before["said"] == after["said"]
    assert flat(state["figures"]) == pytest.approx(flat(there["figures"]), rel=1e-9, abs=1e-9, nan_ok=True)
    assert flat(before["figures"]) == pytest.approx(flat(after["figures"]), rel=1e-9, abs=1e-9, nan_ok=True)
    assert before["arrays"].keys() == after["arrays"].keys()
    for array, found in before["arrays"].items():
        large = max(map(abs, found))
        assert found == pytest.approx(after["arrays"][array], abs=2e-4 * large), array  # of two bytes, some of them
