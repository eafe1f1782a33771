"""Mechanisms: when rigid links are enough, by time against error and by a tolerance."""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Auto, Modal, RigidImpulse, plan, tradeoff
from solvers.accuracy import tradeoff as measuring
from solvers.accuracy.quantities import Metrics, Reference
from solvers.accuracy.refinement import ladders
from tests.catalog import SCENES

FOUR_BAR, BENT = SCENES["four-bar"], SCENES["bent-rods"]


def true_errors(scene, solution) -> dict:
    """Against links of more modes than any shown."""
    fine = scene.refined
    most = fine.target.most_modes
    return Reference.of(Modal(modes=most, estimate=False).solve(fine)).errors(Metrics.of(solution))


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        patch.setattr(measuring, "TIMED", 0.0)
        yield tradeoff(FOUR_BAR, fresh=True, seconds=100.0)


@pytest.mark.slow
def test_time_against_error_from_rigid_links_to_many_modes(table):
    """Against links of 20 modes; the errors of the rigid link and of few modes are those that `plan` finds."""
    errors = {point.label: point.errors for point in table.points}
    assert table.reference.kind == "converged" and table.reference.method["modes"] == 20
    assert {"rigid", "quasi-static model=local", "balance", "modal modes=1", "modal modes=12"} <= set(errors)
    assert "modal modes=20" not in errors and table.stopped is None
    sizes = [abs(errors[f"modal modes={count}"]["rebound"]) for count in (1, 5, 8, 12)]
    assert np.all(np.diff(sizes) < 0.0) and sizes[-1] < 1e-4
    candidates = plan(FOUR_BAR, "final-velocities").candidates
    expected = {each.name: each.expected_error for each in candidates if each.modes is None}
    assert expected["rigid-impulse"] == approx(abs(errors["rigid"]["rebound"]), rel=1e-5)  # in speeds of the fine links
    assert table.front("rebound")[-1].label == "modal modes=12"
    assert errors["rigid"]["peak-force"] is None and errors["quasi-static model=local"]["peak-force"] > 1.0


def test_what_cannot_solve_it_says_why(table):
    assert set(table.refused) == {"waves", "mode-switch", "fe-nodal", "fe-modal"}
    assert [note.code for note in table.remarks if note.code == "links-refined"] == []


@pytest.mark.parametrize("tolerance, rigid", [(0.05, True), (0.005, False)])
def test_auto_takes_a_rigid_link_where_it_is_enough(tolerance, rigid):
    solution = solvers.solve(BENT, "auto", tolerance=tolerance)
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] and (solution.method["name"] in ("rigid", "quasi-static")) == rigid
    true = abs(true_errors(BENT, solution)["rebound"])
    assert true <= tolerance
    assert chosen["estimated_error"] == approx(true, rel=0.2, abs=2e-4)
    assert set(solution.table()["links"]) == {link.name for link in BENT.target.links}  # in the laboratory


def test_auto_gives_links_more_modes_than_the_scene_where_it_takes_more():
    """Two modes are wrong by 8 % of the speed, 8 by 0.01 %."""
    scene = SCENES["rotating-bar"].with_modes(2)
    assert abs(true_errors(SCENES["rotating-bar"], Modal(modes=2, estimate=False).solve(scene))["rebound"]) > 0.05
    solution = solvers.solve(scene, "auto", tolerance=0.02)
    assert solution.diagnostics["chosen"]["met"]
    assert solution.scene.target.most_modes >= solution.method["modes"] > 2
    assert abs(true_errors(SCENES["rotating-bar"], solution)["rebound"]) <= 0.02


def test_the_longer_the_contact_the_nearer_are_links_to_rigid_ones():
    """A softer contact outlasts their vibrations; in the limit the impulse of rigid bodies is all."""
    law, errors = BENT.table()["contact"], []
    for softer in (1.0, 1e-1, 1e-2, 1e-3):
        scene = BENT.replace({"contact": law | {"stiffness": softer * law["stiffness"]}})
        errors.append(abs(true_errors(scene, RigidImpulse().solve(scene))["rebound"]))
    assert errors[0] > 0.03 and np.all(np.diff(errors) < 0.0) and errors[-1] < 1e-5


def test_where_nothing_gives_way_the_restitution_is_the_one_that_is_given():
    for name in ("compound-pendulum", "note-rod", "figure-3.1"):
        scene = SCENES[name]
        found = [ladder.levels[0].restitution for ladder in ladders(scene)]
        assert found and set(found) == {scene.method["restitution"]}
    without = SCENES["compound-pendulum"].replace({"method": {}})
    assert {ladder.levels[0].restitution for ladder in ladders(without)} == {0.0, 1.0}
    assert Auto().refusal(SCENES["slider-crank"]) is None
