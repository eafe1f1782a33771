"""When a rigid link is enough."""

import pytest

import solvers
from solvers import Modal, plan
from solvers.regimes.mechanisms import COUNTS
from tests.solvers.bodies.linkage.mechanisms import four_bar, rotating_bar

HERTZ = {"law": "hertz", "stiffness": 1e9}


def test_the_chosen_model_is_as_good_as_it_says():
    scene = four_bar(20, contact=HERTZ)
    found = plan(scene, "final-velocities", 0.02)
    fine = Modal(modes=40, estimate=False).solve(four_bar(40, contact=HERTZ))
    missed = abs(solvers.solve(found.planned).impactor_velocity - fine.impactor_velocity) / scene.speed
    assert missed <= found.expected_error <= 0.02
    assert found.chosen.modes in COUNTS


def test_rigid_links_are_enough_for_a_soft_contact_and_not_for_a_hard_one():
    still = {"target.drives": [{"joint": 0, "speed": 0.0}], "impactor.velocity": 1.0}
    soft, hard = (rotating_bar(10, contact={"law": "linear", "stiffness": k}, **still) for k in (1e2, 1e9))
    assert plan(soft, "peak-force", 0.05).model == "local-quasi-static"
    assert plan(hard, "peak-force", 0.05).chosen.modes
    for scene in (soft, hard):
        errors = [candidate.expected_error for candidate in plan(scene).candidates if candidate.modes]
        assert errors == sorted(errors, reverse=True)


@pytest.mark.parametrize("question", ["peak-force", "contact-times", "stresses"])
def test_an_impulse_predicts_no_force(question):
    found = plan(four_bar(6, contact=HERTZ), question, 1e-6)
    assert found.candidates[0].expected_error == float("inf")
    assert "nothing here does better" in found.reason or found.expected_error <= 1e-6
