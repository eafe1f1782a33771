"""A tolerance or a budget instead of a method: what is chosen keeps to it, says why, and knows its own error."""

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

import solvers
from bench.random_scenes import random_scene
from solvers import Auto, SceneError, SceneNotSupported
from solvers.accuracy.auto import ASKABLE
from solvers.accuracy.cost_model import expected_time
from solvers.accuracy.quantities import Metrics, Reference
from solvers.methods.validity import ended_early
from solvers.methods.waves import method as waves
from solvers.methods.waves.chain import ExactHistory
from solvers.methods.waves.chain_scene import ChainScene
from tests.catalog import bronze_rod, contact_table, struck_rod

MODES = ("modal", "mode-switch", "fe-modal", "fe-nodal", "quasi-static", "rigid")


def true_error(scene, solution, quantity: str) -> float:
    return abs(Reference.of(solvers.Waves(tolerance=1e-11).solve(scene)).errors(Metrics.of(solution))[quantity])


def test_where_waves_are_exact_nothing_else_is_needed():
    solution = solvers.solve(struck_rod(1.0), "auto")
    assert solution.method["name"] == "waves"
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] is True and chosen["tolerance"] == 0.01 and chosen["quantity"] == "rebound"
    assert chosen["estimated_error"] == solution.diagnostics["estimated_error"] <= 1e-14  # rounding: see waves
    assert chosen["why"] in map(str, solution.notes)
    assert len(chosen["tried"]) == 1


@pytest.mark.slow
@settings(max_examples=15, deadline=None)
@given(
    number=st.integers(0, 10_000),
    tolerance=st.sampled_from((0.03, 0.01, 0.003)),
    quantity=st.sampled_from(("rebound", "impulse", "peak-force")),
)
def test_it_keeps_its_word_on_any_scene(number, tolerance, quantity):
    scene = random_scene(np.random.default_rng(number))
    solution = solvers.solve(scene, "auto", tolerance=tolerance, quantity=quantity)
    chosen = solution.diagnostics["chosen"]
    true = true_error(scene, solution, quantity)
    assert chosen["met"] and true <= tolerance
    # the proof is at least a hundred times as sharp as what it proves; below 1e-6 both may be that of the proof
    assert max(chosen["estimated_error"], 1e-6) == approx(max(true, 1e-6), rel=2.0)


@pytest.mark.parametrize("quantity", ["rebound", "impulse", "peak-force", "force-history", "contact-time"])
def test_without_waves_the_estimate_is_near_the_exact_solution(quantity):
    scene = bronze_rod()
    solution = solvers.solve(scene, "auto", quantity=quantity, tolerance=0.01, among=list(MODES))
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] and chosen["proof"]["name"] == "modal"
    true = true_error(scene, solution, quantity)
    assert true <= 0.01
    assert chosen["estimated_error"] == approx(true, rel=0.5)  # the proof is eight times as fine


def test_a_smaller_tolerance_takes_more_modes():
    sizes = []
    for tolerance in (0.03, 1e-3, 1e-5):
        solution = solvers.solve(bronze_rod(), "auto", tolerance=tolerance, among=["modal"])
        assert solution.diagnostics["chosen"]["met"]
        sizes.append(solution.method["modes"])
    assert sizes == sorted(sizes) and sizes[0] < sizes[-1]


def test_the_cheapest_that_is_good_enough_is_chosen_the_same_each_time():
    # an impact so soft that the rod moves as a whole: thesis 3.2, rigid bodies will do
    scene = struck_rod(1.0, "free", contact_table("linear", softness=1e4))
    assert solvers.solve(scene, "auto").method["name"] == "rigid"
    among = ["fe-nodal", "quasi-static", "rigid"]  # exact waves and modes cost no more in so short an impact
    solution = solvers.solve(scene, "auto", quantity="peak-force", among=among)
    assert solution.method["name"] == "quasi-static"  # a rigid body has no force
    tried = solution.diagnostics["chosen"]["tried"]
    good = [row for row in tried if row["estimated_error"] is not None and row["estimated_error"] <= 0.008]
    assert min(good, key=lambda row: row["cost"])["method"] == solution.method


def test_the_error_of_the_rebound_is_known_whatever_is_asked():
    scene = bronze_rod()
    solution = solvers.solve(scene, "auto", quantity="peak-force", tolerance=0.03, among=["modal"])
    assert solution.diagnostics["estimated_error"] == approx(true_error(scene, solution, "rebound"), rel=0.5)


def test_a_force_that_modes_do_not_find_is_not_claimed():
    # rigid contact: truncated modes overshoot each jump, so their peaks agree with each other and are all wrong
    solution = solvers.solve(struck_rod(0.5, "free"), "auto", quantity="peak-force", tolerance=0.03, among=["modal"])
    chosen = solution.diagnostics["chosen"]
    assert not chosen["met"] or "No second method" in " ".join(map(str, solution.notes))
    both = ["modal", "mode-switch"]
    solution = solvers.solve(struck_rod(0.5, "free"), "auto", quantity="peak-force", tolerance=0.03, among=both)
    assert solution.diagnostics["chosen"]["met"] is False


@pytest.mark.slow
def test_methods_that_differ_are_both_named_and_no_resolution_is_foretold():
    solution = solvers.solve(
        solvers.load("fixed-rod"), "auto", quantity="peak-force", tolerance=0.01, among=["modal", "mode-switch"]
    )
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] is False and "what it would take cannot be estimated" in chosen["why"]
    second = next(str(note) for note in solution.notes if str(note).startswith("A second method, 'modal modes="))
    assert "differs from 'mode-switch modes=" in second and "which of them is right" in second


def test_an_estimate_of_a_force_within_a_time_gets_a_note_where_nothing_gives_way():
    rigid, soft = (
        solvers.solve(struck_rod(1.0, "fixed", contact), "auto", quantity="peak-force", budget=0.5, among=["modal"])
        for contact in (None, contact_table("linear", softness=1.0))
    )
    assert "No second method can show" in " ".join(map(str, rigid.notes))
    assert rigid.diagnostics["chosen"]["estimated_error"] is None
    assert "No second method can show" not in " ".join(map(str, soft.notes))
    assert soft.diagnostics["chosen"]["estimated_error"] is not None


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [{}, {"tolerance": 1e-3}])
@pytest.mark.parametrize("budget", [0.1, 0.5, 5.0])  # s; with the last no method is cut short, even here
def test_a_time_for_a_force_that_modes_get_wrong_is_shared_with_a_second_method(budget, tolerance):
    """Modes overshoot each jump of a force, the more of them the surer: they agree with each other on 11 % too much."""
    scene, among = struck_rod(2.0, "free"), ["modal", "fe-modal"]
    solution = solvers.solve(scene, "auto", quantity="peak-force", budget=budget, among=among, **tolerance)
    chosen = solution.diagnostics["chosen"]
    assert {row["method"]["name"] for row in chosen["tried"]} == set(among)
    assert not chosen["met"]
    reported = " ".join(map(str, solution.notes))
    true = true_error(scene, solution, "peak-force")
    assert true > 0.02
    assert chosen["estimated_error"] is None or chosen["estimated_error"] > 0.4 * true
    # which of them came further within the time depends on the machine
    assert any(f"A second method, '{second}=" in reported for second in ("fe-modal elements", "modal modes"))
    assert "which of them is right" in reported


def test_the_least_time_has_a_second_method_too():
    solution = solvers.solve(
        struck_rod(2.0, "free"), "auto", quantity="peak-force", budget=1e-6, among=["modal", "fe-modal"]
    )
    assert [row["label"] for row in solution.diagnostics["chosen"]["tried"]] == ["modal modes=6", "fe-modal elements=6"]
    assert solution.diagnostics["chosen"]["estimated_error"] is None  # two coarse ones may agree by chance
    assert "A second method, 'fe-modal elements=6'" in " ".join(map(str, solution.notes))


def test_what_cannot_be_met_says_what_it_would_take():
    solution = solvers.solve(struck_rod(1.0), "auto", tolerance=1e-7, among=["modal"])
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] is False
    assert "not 1e-05 % as asked for: that would take about" in chosen["why"] and "modes" in chosen["why"]
    # the best that could be done, first order in the modes: more than a thousand of them
    assert chosen["estimated_error"] < 1e-3 and solution.method["modes"] > 1000


def test_an_impossible_budget_is_answered_by_the_quickest():
    solution = solvers.solve(bronze_rod(), "auto", budget=1e-6, among=["modal"])
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] is None
    assert solution.method["modes"] == 6
    assert "1 µs are not enough" in chosen["why"] and "To estimate its error" in chosen["why"]


def test_a_larger_budget_goes_further():
    few, many = (
        solvers.solve(bronze_rod(), "auto", budget=budget, among=["modal"]).method["modes"] for budget in (1e-4, 5.0)
    )
    assert many > few


def test_a_budget_and_a_tolerance_stop_at_the_first():
    solution = solvers.solve(bronze_rod(), "auto", budget=60.0, tolerance=0.01)
    assert solution.diagnostics["chosen"]["met"] is True
    solution = solvers.solve(bronze_rod(), "auto", budget=1e-6, tolerance=1e-9, among=["modal"])
    assert solution.diagnostics["chosen"]["met"] is False


@pytest.mark.parametrize("name", ["spring-mass", "brick-off-centre", "two-balls", "rod-with-gap", "xylophone-bar"])
def test_every_kind_of_scene_has_an_answer(name):
    scene = solvers.load(name)
    solution = solvers.solve(scene, "auto")
    chosen = solution.diagnostics["chosen"]
    assert chosen["why"] and chosen["estimated_error"] is not None and chosen["estimated_error"] < 1e-2
    json.dumps(solution.table(), allow_nan=False)


def test_the_solution_is_that_of_the_method_it_names():
    scene = bronze_rod()
    solution = solvers.solve(scene, "auto", duration=1e-3)
    named, _ = solvers.read_method({key: value for key, value in solution.method.items() if value is not None})
    assert solution.duration == 1e-3
    assert named.solve(scene, 1e-3).impactor_velocity == solution.impactor_velocity


@pytest.mark.parametrize(
    "options, said",
    [
        ({"quantity": "beauty"}, "method.quantity: got 'beauty'; allowed: 'rebound'"),
        ({"among": []}, "method.among"),
        ({"among": "modal"}, "method.among"),
        ({"among": ["magic"]}, "method.among: got 'magic'; allowed: 'waves'"),
        ({"modes": 5}, "method.modes"),
    ],
)
def test_what_cannot_be_asked(options, said):
    with pytest.raises(SceneError, match="^" + said.replace(".", r"\.")):
        solvers.solve(struck_rod(1.0), "auto", **options)


def test_a_scene_that_none_of_the_methods_can_solve_is_refused_with_reasons():
    with pytest.raises(SceneNotSupported, match=r"the contact must be rigid, .* law 'hertz'"):
        solvers.solve(bronze_rod(), "auto", among=["mode-switch"])


def test_a_method_that_was_not_measured_counts_as_modes():
    alone, with_more = (expected_time({"name": "new", "modes": modes}, 500, struck_rod()) for modes in (9, 90))
    assert 0.0 < alone < with_more


def test_a_scene_file_may_ask_for_it():
    scene = struck_rod(1.0).replace({"method": {"name": "auto", "tolerance": 0.001, "quantity": "peak-force"}})
    again = solvers.Scene.from_table(scene.table())
    solution = solvers.solve(again)
    assert solution.diagnostics["chosen"]["tolerance"] == 0.001
    assert Auto.read({"budget": 0.05}).allowed_error is None and Auto.read({}).allowed_error == 0.01


def test_a_step_of_waves_costs_the_same_under_any_law():
    method, steps = {"name": "waves", "tolerance": 1e-9}, 4000
    scenes = (struck_rod(contact=contact_table(law)) for law in ("hertz", "power", "hunt-crossley"))
    times = [expected_time(method, steps, scene) for scene in scenes]
    assert max(times) < 2.0 * min(times)
    assert expected_time(method, steps, struck_rod()) < 0.5 * min(times)  # no equation to solve; figures are read alike


def test_what_costs_more_than_the_answer_is_not_solved():
    scene = struck_rod(1.0, "free", contact_table("linear", softness=1e4))
    tried = solvers.solve(scene, "auto", among=list(MODES)).diagnostics["chosen"]["tried"]
    names = [row["method"]["name"] for row in tried]
    # modes until these agree, then the cheapest, until one will do: closed forms, which cost alike; no elements at all
    assert set(names[names.count("modal") :]) <= {"quasi-static", "rigid"} and names[0] == "modal"
    assert names[-1] == "rigid"


@pytest.mark.parametrize("number", range(3))
def test_a_search_takes_no_more_than_twice_its_proof_and_one_solve(number):
    scene = random_scene(np.random.default_rng(70 + number))
    tried = solvers.solve(scene, "auto", among=list(MODES), tolerance=1e-3).diagnostics["chosen"]["tried"]
    names = [row["method"]["name"] for row in tried]
    climb = names.index("modal") + names.count("modal")
    assert names[:climb] == ["modal"] * climb  # nothing else before the proof
    costs = [row["cost"] for row in tried]
    assert sum(costs[climb:-1]) <= sum(costs[:climb])


def test_a_force_without_limit_is_not_climbed_after():
    beam = solvers.load("table-8.4").replace({"contact": {"law": "rigid"}, "target.theory": "euler-bernoulli"})
    solution = solvers.solve(beam, "auto", quantity="peak-force")
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] is False and chosen["estimated_error"] is None and len(chosen["tried"]) == 4
    assert "starts without bound" in " ".join(map(str, solution.notes))


@pytest.mark.parametrize("quantity", ["peak-force", "force-history", "contact-time"])
def test_what_no_method_predicts_of_an_impact_is_not_claimed(quantity):
    solution = solvers.solve(solvers.load("brick-off-centre"), "auto", quantity=quantity)  # of no duration
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] is False and chosen["estimated_error"] is None
    assert ("not-predicted", quantity) in [(note.code, note.values.get("quantity")) for note in solution.notes]
    assert solution.diagnostics["estimated_error"] <= 1e-12  # of its velocities, which balance to rounding


@pytest.mark.parametrize("tolerance", [0, -0.01, math.nan, math.inf, -math.inf, 1e-20, 2.0, "tight", True])
def test_a_tolerance_that_cannot_be_is_refused_by_one_sentence(tolerance):
    with pytest.raises(SceneError, match=r"^method\.tolerance: got .*; allowed: a number from 1e-09 to 0\.5$"):
        solvers.solve(bronze_rod(), "auto", tolerance=tolerance)


@pytest.mark.parametrize("budget", [0, -1.0, math.nan, math.inf, 1e-9, 1e9, "soon", False])
def test_a_budget_that_cannot_be_is_refused_by_one_sentence(budget):
    with pytest.raises(SceneError, match=r"^method\.budget: got .*; allowed: a number from 1e-06 to 3600 s$"):
        solvers.solve(bronze_rod(), "auto", budget=budget)


def test_the_least_budget_and_tolerance_get_the_best_there_is_and_what_it_would_take():
    solution = solvers.solve(bronze_rod(), "auto", tolerance=1e-9, budget=1e-6, among=["modal"])
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] is False and "not 1e-07 % as asked for" in chosen["why"] and len(chosen["tried"]) == 1
    # no budget, and a tolerance that no number of modes up to 3200 keeps to: given up long before, with its reason
    solution = solvers.solve(struck_rod(1.0), "auto", tolerance=1e-9, among=["modal"])
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] is False and "would take about" in chosen["why"] and chosen["estimated_error"] < 0.01


def test_a_peak_that_one_method_alone_finds_is_not_called_kept():
    solution = solvers.solve(struck_rod(0.5, "free"), "auto", quantity="peak-force", tolerance=0.1, among=["fe-modal"])
    chosen = solution.diagnostics["chosen"]
    assert chosen["met"] is False and "an unknown error in the peak force" in chosen["why"]
    assert "No second method can show" in " ".join(map(str, solution.notes))


@settings(max_examples=6, deadline=None)
@given(
    number=st.integers(0, 10_000),
    beams=st.sampled_from((0.0, 1.0)),
    quantity=st.sampled_from(ASKABLE),
)
def test_what_is_reported_is_of_the_very_solution_returned(number, beams, quantity):
    scene = random_scene(np.random.default_rng(number), beams)
    solution = solvers.solve(scene, "auto", quantity=quantity, tolerance=0.03, among=list(MODES))
    assert_of_this_very_solution(scene, solution, quantity)


def assert_of_this_very_solution(scene, solution, quantity: str):
    """Solved again by the methods it names, nothing of it differs, nor its errors from those reported."""
    chosen = solution.diagnostics["chosen"]
    again = named(solution.method).solve(scene)
    assert again.impactor_velocity == solution.impactor_velocity and again.contacts == solution.contacts
    own = {"wall_time", "compile_time", "estimated_error", "chosen"}
    for key in again.diagnostics.keys() - own:
        assert again.diagnostics[key] == solution.diagnostics[key]
    if chosen["proof"] is not None:
        errors = Reference.of(named(chosen["proof"]).solve(scene)).errors(Metrics.of(again))
        if scene.contact.NAME != "rigid":
            assert chosen["estimated_error"] == abs(errors[quantity])
        assert solution.diagnostics["estimated_error"] == abs(errors["rebound"])


def named(table: dict):
    return solvers.read_method({key: value for key, value in table.items() if value is not None})[0].without_estimate()


def test_solutions_that_end_early_prove_nothing_by_agreeing(monkeypatch):
    # a hard surface that yields, on a thin rod bonded to a thick one: waves that may not take the grid stop midway
    monkeypatch.setattr(waves, "follow", lambda scene, *how: ExactHistory(ChainScene(scene), *how))
    rods = [
        {"length": 0.84, "section": {"radius": 0.00396}, "material": "aluminium"},
        {"length": 1.33, "section": {"radius": 0.0125}, "material": "steel", "joint": "bonded"},
    ]
    scene = solvers.Scene.from_table(
        {
            "impactor": {"mass": 45.8, "velocity": 0.0289},
            "target": {"kind": "rods", "rods": rods, "support": "free"},
            "contact": {"law": "yigit-christoforou", "stiffness": 2.33e14, "yield_indentation": 2.24e-7},
        }
    )
    assert ended_early(solvers.solve(scene, "waves").notes)
    for method in ("auto", solvers.Auto(among=("waves",))):
        chosen = solvers.solve(scene, method)
        if chosen.diagnostics["chosen"]["met"]:
            true = solvers.solve(scene, "fe-nodal", elements=200).impactor_velocity
            assert chosen.impactor_velocity == approx(true, abs=0.01 * scene.speed)
        else:
            assert chosen.diagnostics["chosen"]["estimated_error"] is None
