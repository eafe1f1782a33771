"""HTML of what a notebook shows: well formed, escaped, with units and warnings."""

from xml.etree import ElementTree

import pytest

import solvers
from solvers.text.catalogue import CHOSEN
from tests.catalog import SCENES, struck_rod

HOSTILE = "<script>alert('&')</script>"


def cells(shown: object) -> list[str]:
    """Texts of the card, which must be well formed."""
    return ["".join(element.itertext()) for element in ElementTree.fromstring(shown._repr_html_()).iter()]


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_has_a_card(name):
    scene = SCENES[name]
    reported = cells(scene)
    assert f"Scene {scene.title}" in reported
    assert scene.contact.NAME in reported
    assert any(text.startswith(scene.target.kind) for text in reported)


def test_a_scene_says_what_strikes_what():
    reported = cells(struck_rod(mass_ratio=2.0))
    assert "mass, 1.0665 kg, velocity 1 m/s" in reported
    assert "mass ratio, target / impactor2" in reported
    assert "speed of approach1 m/s" in reported


@pytest.mark.parametrize("key", ["title", "source", "note"])
def test_what_a_scene_says_is_escaped(key):
    scene = struck_rod().replace({key: HOSTILE})
    assert "<script" not in scene._repr_html_()
    assert HOSTILE in " ".join(cells(scene))
    assert "<script" not in solvers.solve(scene)._repr_html_()


def test_a_solution_shows_figures_accuracy_and_notes():
    solution = solvers.solve(solvers.load("fixed-rod"), method="modal", modes=5)
    reported = cells(solution)
    assert f"impulse{solution.impulse:.6g} N s" in reported
    assert f"{solution.contacts[0].end:.6g} s" in reported
    assert f"impactor leaves at{solution.impactor_velocity:.6g} m/s" in reported
    assert f"energy residual{solution.diagnostics['energy_error']:.6g}" in reported
    error = solution.diagnostics["estimated_error"]
    assert f"estimated error of the velocity{error:.6g} of the impact speed" in reported
    assert solution.notes
    assert set(map(str, solution.notes)) <= set(reported)


@pytest.mark.parametrize("name", ["brick-off-centre", "pressure-bar", "two-balls"])
def test_solutions_without_some_figures_have_cards(name):
    solution = solvers.solve(solvers.load(name))
    reported = cells(solution)
    assert f"impulse{solution.impulse:.6g} N s" in reported
    assert any(text.startswith("impactor leaves at") for text in reported) == (solution.impactor_velocity is not None)


def test_a_tradeoff_shows_the_points_that_nothing_beats():
    found = solvers.tradeoff(solvers.load("two-balls"), ["rebound"], fresh=True, seconds=1.0)
    reported = cells(found)
    assert found.reference.words in " ".join(reported)
    for point in found.front("rebound"):
        assert point.label in reported
    assert {f"{name} cannot{reason}" for name, reason in found.refused.items()} <= set(reported)


def test_a_plan_shows_every_candidate_and_why():
    plan = solvers.plan(solvers.load("fixed-rod"), "peak-force", 0.05)
    reported = cells(plan)
    assert f"why{plan.reason}" in reported
    assert f"chosen{plan.model}" in reported
    assert {candidate.model for candidate in plan.candidates} <= set(reported)


def test_a_plan_beside_what_was_measured_warns():
    plan = solvers.plan(solvers.load("two-balls"), "final-velocities")
    assert not plan.measured
    assert "The scene lies beside what was measured: take the errors as a guess." in cells(plan)


def test_a_stability_map_shows_every_integrator():
    found = solvers.stability(solvers.load("fixed-rod"), grid=(3, 3), modes=3, workers=1)
    reported = cells(found)
    for of in found.maps.values():
        assert of.label in reported
        assert f"{of.failures} of 9" in reported or str(of.reason) in reported
    assert set(map(str, found.notes)) <= set(reported)


def test_cards_are_in_the_language_of_the_process(monkeypatch):
    """Its heads and rows, and its decimal sign; keys of scene files stay as they are typed."""
    scene = struck_rod(mass_ratio=2.0)
    english = {
        "mass ratio, target / impactor",
        "peak force",
        "impactor leaves at",
        "speed of approach",
        "true contacts",
    }
    monkeypatch.setenv(CHOSEN, "es")
    shown = cells(scene) + cells(solvers.solve(scene)) + cells(solvers.compare(scene, ["modal", "rigid"], repeats=1))
    assert {"razón de masas, golpeado / impactor2", "mass; 1,0665 kg; velocidad 1 m/s"} <= {*shown}
    assert [text for text in shown if any(text.startswith(words) for words in english)] == []
