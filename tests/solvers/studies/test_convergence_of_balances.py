"""Tables 6.2 to 6.6 and 6.8 of the thesis, whole: repeated balances by elements, restitution, step and modes."""

import numpy as np
import pytest
from pytest import approx

from solvers import Balance, SceneError, convergence
from tests.catalog import SCENES

STEPS = (58.9e-8, 29.5e-8, 9.82e-8, 5.89e-8)
RESTITUTIONS = (1.0, 0.7, 0.3, 0.0)


def of_table(number, **given):
    return convergence(SCENES[f"table-6.{number}"], method="balance", **given)


def test_by_elements():
    """Table 6.2, all that is printed; the exact waves beside, of which it prints the last velocity wrong."""
    found = of_table(2, modes=(5, 10, 20, 40))
    assert (found.kind, found.counts.tolist()) == ("elements", [5, 10, 20, 40])
    assert found.values["balances"][:3].tolist() == [12, 30, 63]
    assert found.values["final_velocity"][:3] == approx([-0.702, -0.715, -0.695], abs=5e-4)
    assert found.values["last_parting"][:3] == approx([1.56e-4, 1.78e-4, 2.54e-4], abs=5e-7)
    assert (found.values["first_parting"][2], found.values["first_velocity"][2]) == approx((1.82e-4, -0.687), abs=5e-4)
    assert found.summary["balances"].code == "diverges"
    jump = found.summary["mean_jump"]
    assert jump.code == "vanishes" and jump.values["share"] == approx(100.0 * found.values["mean_jump"][-1])  # of 1 m/s
    assert found.reference == "waves" and found.reference_values is not None
    assert found.reference_values["final_velocity"] == approx(-0.698876, abs=1e-6)
    assert found.reference_values["last_parting"] == approx(2.5169e-4, abs=1e-8)
    assert "balances" not in found.reference_values


def test_by_restitution():
    """Table 6.3. Nothing is finer: no order, no note that says so."""
    found = of_table(3, restitutions=RESTITUTIONS)
    assert found.kind == "restitution" and found.counts.tolist() == list(RESTITUTIONS)
    assert found.values["balances"].tolist() == [49, 296, 338, 352]
    assert found.values["final_velocity"] == approx([-0.712, -0.741, -0.712, -0.615], abs=1e-3)
    assert found.values["last_parting"] == approx([2.49e-4, 2.46e-4, 2.47e-4, 2.46e-4], abs=1e-6)
    assert set(found.order.values()) == {None}
    assert found.summary["final_velocity"].values["way"] == "neither"
    assert "falls as it grows" in str(found.summary["balances"])


@pytest.mark.parametrize(
    ("number", "balances", "velocities", "lost"),
    [
        (4, [400, 731, 1954, 3117], [-0.42, -0.58, -0.75, -0.73], [74, 52, 24, 16]),
        (5, [365, 680, 1849, 2907], [-0.57, -0.69, -0.73, -0.72], [54, 34, 14, 9]),
    ],
)
def test_by_step(number, balances, velocities, lost):
    """Tables 6.4 and 6.5, with the steps that they were made with: the loss vanishes with the step."""
    found = of_table(number, steps=STEPS)
    assert found.kind == "step" and found.counts.tolist() == list(STEPS)
    assert found.values["balances"].tolist() == balances
    assert found.values["final_velocity"] == approx(velocities, abs=0.01)
    assert found.values["energy_lost_share"] == approx(lost, abs=0.6)
    assert found.summary["energy_lost_share"].code == "vanishes"
    assert "number of steps" in str(found.summary["energy_lost_share"])
    assert found.wall_time < 5.0


def test_by_modes_of_a_turning_bar():
    """Table 6.6: what is well determined, the sudden reactions over the impulse, and the row of rigid bodies (6.24),
    of which the table prints half of the moment."""
    found = of_table(6, modes=(5, 8, 12))
    shares = found.values["joint_impulse"] / found.values["impulse"]
    assert shares == approx([0.1263, 0.0799, 0.0540], rel=0.03)
    jumps = found.values["mean_jump"] * found.values["balances"]
    assert jumps == approx(found.values["final_velocity"] * -1.0 + 0.0574, abs=1e-9)
    # by 12 modes the last contact is chaotic: 12.4 to 16.9 ms, with the last digits of the mass
    assert found.values["last_parting"][:2] == approx([1.2886e-2, 1.3247e-2], rel=1e-3)
    assert (np.diff(found.values["joint_moment_impulse"]) < 0.0).all()
    assert found.reference == "rigid" and found.reference_values is not None
    rigid = found.reference_values
    assert -rigid["final_velocity"] == approx(1.9426, abs=5e-5)
    assert (rigid["joint_impulse"], rigid["joint_moment_impulse"]) == approx((2.276, 0.6828), abs=5e-5)
    assert (rigid["balances"], rigid["mean_jump"]) == approx((1, 2.0))


def test_by_modes_of_a_bar_in_a_four_bar():
    """Table 6.8: below the bound of rigid bars, whatever the number of modes."""
    found = of_table(8, modes=(5, 9, 13))
    assert found.reference_values is not None and -found.reference_values["final_velocity"] == approx(3.5136, abs=5e-5)
    assert -found.values["final_velocity"] == approx([3.254] * 3, abs=0.05)


@pytest.mark.parametrize(
    ("given", "key"),
    [
        ({"steps": (1e-7, 2e-7, 3e-7)}, "steps"),  # rise
        ({"steps": (3e-7, 2e-7)}, "steps"),
        ({"steps": (3e-7, 2e-7, 0.0)}, "method.step"),
        ({"restitutions": (1.1, 0.5, 0.0)}, "method.restitution"),
        ({"restitutions": "1,0"}, "restitutions"),
        ({"restitutions": (1.0, 0.5, 0.0), "modes": (5, 10, 20)}, "restitutions"),
    ],
)
def test_bad_levels_are_refused(given, key):
    with pytest.raises(SceneError) as refused:
        of_table(2, **given)
    assert refused.value.key == key


def test_a_step_that_nothing_has_is_refused():
    with pytest.raises(SceneError, match=r"can vary here: elements, restitution"):
        convergence(SCENES["fixed-rod"], method=Balance(elements=10), steps=STEPS)
    with pytest.raises(SceneError, match="can vary here: modes"):
        convergence(SCENES["fixed-rod"], restitutions=RESTITUTIONS)
