"""Estimates of the error against the true one: random impacts, and impacts in which every mesh fails alike."""

import pytest

import solvers
from tests.catalog import struck_rod
from tests.random_estimates import FIRST, KINDS, SCENES, SHARE, rated

COUNTS = {"fe-nodal": 12, "fe-modal": 12, "balance": 60, "fe-nodal on beams": 4, "fe-modal on beams": 30}


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_true_errors_are_within_twice_the_estimates(kind):
    """Of balances, which knew half the elements only, 13 to 23 % were not; the worst was 100 times its estimate."""
    beyond = FIRST + SCENES  # seeds that the benchmark does not use
    found = list(rated(kind, range(beyond, beyond + COUNTS[kind])))
    assert len(found) > 0.5 * COUNTS[kind]
    missed = [impact for impact in found if not impact.owned]
    assert len(missed) <= max(1, round((1.0 - SHARE) * len(found)))


# impacts on a rod so heavy that no wave leaves the struck node before they are over: 2.6 to 11 times the estimate
SHORT = [
    ("linear", {"stiffness": 1e11}, 134.0, 7),
    ("linear", {"stiffness": 3e8}, 866.0, 13),
    ("linear", {"stiffness": 1e11}, 866.0, 30),
    ("kelvin-voigt", {"stiffness": 3e9, "restitution": 0.8}, 134.0, 13),
    ("kelvin-voigt", {"stiffness": 1e11, "restitution": 0.8}, 866.0, 7),
    ("plastic-power", {"stiffness": 1e14, "yield_indentation": 1e-8}, 866.0, 7),
    ("plastic-power", {"stiffness": 3e11, "yield_indentation": 1e-8}, 866.0, 13),
]


@pytest.mark.parametrize("method", ["fe-nodal", "fe-modal"])
@pytest.mark.parametrize("law, constants, ratio, elements", SHORT)
def test_impacts_shorter_than_a_mesh_can_resolve_are_owned_to(law, constants, ratio, elements, method):
    scene = struck_rod(ratio, "free", {"law": law} | constants)
    found = solvers.solve(scene, method, elements=elements)
    true = solvers.solve(scene, "waves", duration=found.duration).impactor_velocity
    assert abs(found.impactor_velocity - true) < 2.0 * found.diagnostics["estimated_error"]
