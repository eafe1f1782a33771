"""The best values: known optima, bounds that decide, choices among words, and what is refused."""

import json
import math
import os
import signal
import sys

import pytest
from pytest import approx

import solvers
from solvers import SceneError, optimise
from solvers.studies.study import work

MASS, SPEED = 2.0, 3.0
SPRING = solvers.load("fixed-rod").replace(
    {
        "impactor": {"kind": "mass", "mass": MASS, "velocity": SPEED},
        "target": {"kind": "stop"},
        "contact": {"law": "linear", "stiffness": 1e6},
        "method": {},
    }
)


def test_the_softest_spring_that_is_quick_enough():
    """F = v sqrt(k m) rises with k, t = pi sqrt(m / k) falls: the bound on t decides."""
    longest = 5e-3
    stiffness = MASS * (math.pi / longest) ** 2
    found = optimise(
        SPRING, {"contact.stiffness": "1e4..1e8:log"}, minimise="peak_force", such_that=[f"contact_time <= {longest}"]
    )
    assert found.values == {"contact.stiffness": approx(stiffness, rel=1e-4)}
    assert found.figures["peak_force"] == approx(SPEED * math.sqrt(stiffness * MASS), rel=1e-4)
    assert found.figures["contact_time"] <= longest and found.deciding == [f"contact_time <= {longest:g}"]
    assert found.units == {"contact.stiffness": "N/m", "peak_force": "N", "contact_time": "s", "contacts": ""}
    assert "smallest peak force, with contact_time <= 0.005" in str(found)
    assert json.loads(json.dumps(found.table(), allow_nan=False))["limits"] == ["contact_time <= 0.005"]


def test_without_a_bound_it_is_at_the_end_of_a_range():
    found = optimise(SPRING, {"contact.stiffness": (1e4, 1e6)}, maximise="peak_force", solves=200)
    assert found.values == {"contact.stiffness": approx(1e6, rel=1e-3)} and found.deciding == ["contact.stiffness"]


def test_the_largest_of_many_maxima_is_found():
    """Of a mass on a rod the rebound rises and falls with the mass, and jumps where a contact is gained."""
    scene = solvers.load("fixed-rod")
    masses = [0.5 + 3.0 * k / 2_000 for k in range(2_001)]
    dense = solvers.solve_many(scene, {"impactor.mass": masses}, figures=["newton"]).newton
    found = optimise(scene, {"impactor.mass": (0.5, 3.5)}, maximise="newton", solves=600)
    assert found.figures["newton"] >= float(dense.max()) - 1e-4


def test_words_and_whole_numbers_are_chosen_among():
    vary = {"contact.stiffness": [1e6, 4e6], "impactor.mass": [1, 2, 3]}
    found = optimise(SPRING, vary, minimise="peak_force", solves=80)
    assert found.values == {"contact.stiffness": 1e6, "impactor.mass": 1} and found.deciding == []
    found = optimise(
        "fixed-rod", {"impactor.mass": [1, 2], "method.name": "waves,modal"}, maximise="impulse", solves=60
    )
    assert found.values is not None and found.values["impactor.mass"] == 2


def test_where_no_values_keep_the_bounds_the_nearest_are_said():
    found = optimise(
        SPRING, {"contact.stiffness": (1e5, 1e6)}, minimise="peak_force", such_that="contact_time <= 1e-9", solves=80
    )
    assert found.values is None and "No values that were tried keep all bounds" in str(found)
    assert found.figures["contact_time"] == approx(math.pi * math.sqrt(MASS / 1e6), rel=0.05)


def test_it_is_the_same_again_whoever_solves_it():
    call = {"vary": {"impactor.mass": (0.5, 3.5)}, "maximise": "newton", "solves": 120}
    one, two = (optimise("fixed-rod", workers=count, seed=5, **call) for count in (1, 2))
    assert one.table() == two.table()
    assert optimise("fixed-rod", seed=6, **call).values != one.values


def test_what_is_refused_on_the_way_is_counted():
    found = optimise(SPRING, {"impactor.mass": (-1.0, 1.0)}, minimise="peak_force", solves=100)
    assert found.refused > 10 and found.values["impactor.mass"] > 0.0
    (note,) = (note for note in found.notes if note.code == "optimum-searched")
    assert note.values["refused"] == found.refused


def test_methods_with_options_are_chosen_among():
    methods = [{"name": "waves"}, {"name": "modal", "modes": 5}]
    found = optimise("fixed-rod", {"method": methods, "impactor.mass": [1, 2]}, minimise="peak_force", solves=60)
    assert found.values is not None and found.values["method"] in methods and found.values["impactor.mass"] == 1


def test_no_number_of_workers_makes_another_answer():
    call = {"vary": {"impactor.mass": (0.5, 3.5)}, "maximise": "newton", "solves": 60}
    assert len({repr(optimise("fixed-rod", workers=count, **call).values) for count in (1, 9)}) == 1


@pytest.mark.skipif(sys.platform != "linux", reason="its workers know what is patched here as copies of this process")
def test_a_point_that_ends_its_process_is_left(monkeypatch):
    def figures_of(solution, names):
        if solution.scene.impactor.mass > 1.5:
            os.kill(os.getpid(), signal.SIGKILL)
        return [solution.scene.impactor.mass] * len(names)

    monkeypatch.setattr(work, "figures_of", figures_of)
    found = optimise(SPRING, {"impactor.mass": [1.0, 1.2, 1.4, 1.6]}, maximise="peak_force", solves=50)
    assert found.values == {"impactor.mass": 1.4} and found.refused == 1


def test_cancelled_it_gives_the_best_by_then():
    found = optimise(SPRING, {"impactor.mass": (1.0, 2.0)}, minimise="peak_force", cancelled=lambda: True)
    assert found.solves < 200 and found.values is not None


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"minimise": None}, "either minimise or maximise"),
        ({"maximise": "impulse"}, "either minimise or maximise"),
        ({"minimise": "beauty"}, "'peak_force'"),
        ({"minimise": "peak_deflection"}, "a figure that these impacts have"),
        ({"vary": {}}, "a distribution"),
        ({"vary": {"contact.stiffness": "normal(1e5,1e4)"}}, "between bounds"),
        ({"vary": {"contact.stiffness": "1e5..1e4"}}, "the smaller one first"),
        ({"vary": {"contact.colour": (1.0, 2.0)}}, "no such key"),
        ({"such_that": ["peak_force"]}, "peak_stress<=2e8"),
        ({"such_that": ["peak_force <= much"]}, "peak_stress<=2e8"),
        ({"such_that": ["beauty <= 1"]}, "'peak_force'"),
        ({"such_that": [3]}, "peak_stress<=2e8"),
        ({"solves": 1}, "whole number from 50"),
        ({"seed": -1}, "whole number from 0"),
        ({"vary": {"method.name": ["modal"]}, "method": "waves"}, "nothing beside method.name"),
        ({"workers": 0}, "whole number from 1"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(changes, said):
    call = {"vary": {"contact.stiffness": (1e5, 1e6)}, "minimise": "peak_force", "solves": 60} | changes
    with pytest.raises(SceneError) as refused:
        optimise(SPRING, **call)
    assert said in str(refused.value) and "\n" not in str(refused.value)
