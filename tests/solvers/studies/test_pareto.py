"""The best compromises of two figures: known fronts, their ends, jumps, bounds, and what is refused."""

import json
import math
from itertools import pairwise

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import SceneError, pareto
from solvers.studies.front import levels, rounded, solitude
from solvers.text.notes import Severity

MASS, SPEED = 2.0, 3.0
SPRING = solvers.load("fixed-rod").replace(
    {
        "impactor": {"kind": "mass", "mass": MASS, "velocity": SPEED},
        "target": {"kind": "stop"},
        "contact": {"law": "linear", "stiffness": 1e6},
        "method": {},
    }
)
SOFT = {"peak_force": "smallest", "contact_time": "smallest"}


def figures(found: solvers.Pareto) -> np.ndarray:
    """(points, 2) both goals."""
    return np.array([[point.figures[figure] for figure in found.goals] for point in found.points])


@pytest.fixture(scope="module")
def front():
    """F = v √(k m) rises with k, t = π √(m / k) falls, and F t = π m v: the mass is the smallest throughout."""
    vary = {"contact.stiffness": "1e4..1e6:log", "impactor.mass": (1.0, 4.0)}
    return pareto(SPRING, vary, SOFT, points=12, solves=1500)


def test_a_front_that_is_known_is_met_at_each_point(front):
    force, time = figures(front).T
    assert len(front.points) == 12 and (np.diff(force) > 0.0).all() and (np.diff(time) < 0.0).all()
    assert force * time == approx(math.pi * 1.0 * SPEED, rel=1e-5)
    assert [point.values["impactor.mass"] for point in front.points] == approx([1.0] * 12, rel=1e-5)
    stiffness = np.array([point.values["contact.stiffness"] for point in front.points])
    assert force == approx(SPEED * np.sqrt(stiffness * 1.0), rel=1e-5)


def test_its_ends_are_the_best_of_each_figure_alone(front):
    ends = figures(front)[[0, -1]]
    assert ends[0] == approx([SPEED * 1e2, math.pi * 1e-2], rel=1e-6)
    assert ends[1] == approx([SPEED * 1e3, math.pi * 1e-3], rel=1e-6)


def test_it_is_spread_along_the_front(front):
    """No gap is wider than a third of the widest that 11 could have, three times, in either figure."""
    found = figures(front)
    gaps = np.abs(np.diff(found, axis=0)) / np.abs(found[-1] - found[0])
    assert gaps.max() < 3.0 / 11.0


def test_work_to_indent_is_shared_between_force_and_depth():
    """F α = m v² for every spring."""
    found = pareto(
        SPRING,
        {"contact.stiffness": "1e4..1e8:log"},
        {"peak_force": "smallest", "peak_indentation": "smallest"},
        points=9,
        solves=400,
    )
    assert len(found.points) == 9 and np.prod(figures(found), 1) == approx(MASS * SPEED**2, rel=1e-6)


def test_none_of_the_points_beats_another_and_none_of_many_others_does():
    """Rebound against force of a mass on a rod: the front jumps over masses that others beat in both."""
    scene, goals = solvers.load("fixed-rod"), {"newton": "largest", "peak_force": "smallest"}
    found = pareto(scene, {"impactor.mass": (0.5, 3.5)}, goals, solves=800, points=15)
    rebound, force = figures(found).T
    assert len(found.points) == 15 and (np.diff(rebound) > 0.0).all() and (np.diff(force) > 0.0).all()
    masses = np.linspace(0.5, 3.5, 2_001)
    dense = solvers.solve_many(scene, {"impactor.mass": masses}, figures=["newton", "peak_force"])
    for point in found.points:
        one, other = (point.figures[figure] for figure in goals)
        assert not ((dense.newton > one + 1e-4) & (dense.peak_force < other * (1.0 - 1e-4))).any()
    unbeaten = [
        mass
        for mass, one, other in zip(masses, dense.newton, dense.peak_force, strict=True)
        if not ((dense.newton > one) & (dense.peak_force < other)).any()
    ]
    hole = max(pairwise(unbeaten), key=lambda pair: pair[1] - pair[0])
    assert hole[1] - hole[0] > 1.0
    assert all(not hole[0] + 0.01 < point.values["impactor.mass"] < hole[1] - 0.01 for point in found.points)
    over = np.diff([point.values["impactor.mass"] for point in found.points])
    assert (over > hole[1] - hole[0] - 0.01).sum() == 1  # they lie on both sides of it


def test_bounds_are_kept_by_every_point():
    found = pareto(
        SPRING,
        {"contact.stiffness": "1e4..1e8:log"},
        SOFT,
        such_that=["peak_force <= 3e3", "contact_time <= 0.03"],
        points=6,
        solves=400,
    )
    force, time = figures(found).T
    assert (force <= 3e3).all() and (time <= 0.03).all() and len(force) == 6
    assert [force[-1], time[0]] == approx([3e3, 0.03], rel=1e-4)
    assert "with peak_force <= 3000, contact_time <= 0.03" in str(found)


def test_where_no_values_keep_the_bounds_there_are_none():
    vary = {"contact.stiffness": (1e5, 1e6)}
    found = pareto(SPRING, vary, SOFT, such_that="contact_time <= 1e-9", solves=200)
    assert found.points == [] and "No values that were tried keep all bounds" in str(found)


def test_one_point_where_the_figures_agree():
    found = pareto(SPRING, {"impactor.mass": (1.0, 4.0)}, SOFT, solves=200)  # both rise with the mass
    assert [point.values["impactor.mass"] for point in found.points] == approx([1.0], rel=1e-6)
    assert "The one compromise of" in str(found)


def test_words_and_whole_numbers_are_chosen_among():
    vary = {"contact.stiffness": [1e6, 4e6, 9e6], "impactor.mass": [1, 2]}
    found = pareto(SPRING, vary, SOFT, solves=200)
    assert [tuple(point.values.values()) for point in found.points] == [(1e6, 1), (4e6, 1), (9e6, 1)]
    methods = [{"name": "waves"}, {"name": "modal", "modes": 5}]
    found = pareto(
        "fixed-rod", {"method": methods, "impactor.mass": [1, 2]}, {**SOFT, "contact_time": "largest"}, solves=200
    )
    assert found.points and all(point.values["method"] in methods for point in found.points)
    assert json.loads(json.dumps(found.table()))["points"][0]["values"]["method"] in methods


def test_what_is_refused_on_the_way_is_counted():
    found = pareto(SPRING, {"impactor.mass": (-1.0, 1.0)}, {**SOFT, "contact_time": "largest"}, solves=300, points=5)
    assert found.refused > 10 and all(point.values["impactor.mass"] > 0.0 for point in found.points)
    assert found.notes[0].values["refused"] == found.refused


def test_warnings_on_its_solutions_are_counted():
    slender = {"target.length": 1.2, "target.section": {"width": 0.06, "height": 0.01}}
    scene = solvers.load("docs/hammer.toml").replace(slender)
    goals = {"peak_force": "smallest", "impulse": "largest"}
    found = pareto(scene, {"impactor.velocity": (3.0, 6.0)}, goals, solves=200, points=4)
    codes: dict[str, int] = {}
    for point in found.points:
        notes = solvers.solve(scene.replace(point.values)).notes
        for code in {note.code for note in notes if note.severity in (Severity.WARNING, Severity.INVALID)}:
            codes[code] = codes.get(code, 0) + 1
    assert codes and {warning.code: warning.count for warning in found.warnings} == codes


def test_no_number_of_workers_makes_another_answer_and_another_seed_does():
    call = {
        "vary": {"impactor.mass": (0.5, 3.5), "target.length": (0.2, 0.4)},
        "goals": {"newton": "largest", "peak_force": "smallest"},
        "solves": 300,
        "points": 5,
    }
    one, other = (pareto("fixed-rod", workers=count, seed=5, **call) for count in (1, 3))
    assert one.table() == other.table()
    assert pareto("fixed-rod", seed=6, **call).table() != one.table()


def test_cancelled_it_gives_those_by_then():
    found = pareto(SPRING, {"contact.stiffness": (1e4, 1e6)}, SOFT, cancelled=lambda: True)
    assert len(found.points) > 1 and found.solves < 200


def test_an_answer_is_data(front):
    table = json.loads(json.dumps(front.table(), allow_nan=False))
    assert table["goals"] == SOFT and len(table["points"]) == 12 and table["solves"] == front.solves <= 1600
    assert table["points"][0] == front.points[0].table() and table["units"]["contact_time"] == "s"
    assert repr(front) == "<Pareto: 12 compromises of smallest peak_force, smallest contact_time>"


@pytest.mark.parametrize(
    "changes, said",
    [
        ({"goals": {"peak_force": "smallest"}}, "goals: got {'peak_force': 'smallest'}; allowed: two figures"),
        ({"goals": "peak_force"}, "goals: got 'peak_force'; allowed: two figures"),
        ({"goals": SOFT | {"contacts": "largest"}}, "goals: got {"),
        ({"goals": {"peak_force": "smallest", "beauty": "largest"}}, "goals: got 'beauty'; allowed: "),
        ({"goals": SOFT | {"contact_time": "short"}}, "goals.contact_time: got 'short'; allowed: 'smallest'"),
        (
            {"goals": {"peak_force": "smallest", "peak_moment": "largest"}},
            "goals: got 'peak_moment'; allowed: a figure",
        ),
        ({"vary": {}}, "vary: got nothing"),
        ({"vary": {"contact.stiffness": "normal(1e5,1e4)"}}, "contact.stiffness: got 'normal"),
        ({"vary": {"contact.colour": (1.0, 2.0)}}, "vary: got 'contact.colour'; allowed: ranges in which"),
        ({"such_that": ["beauty <= 1"]}, "such_that: got 'beauty'"),
        ({"points": 1}, "points: got 1; allowed: a whole number from 2"),
        ({"solves": 50}, "solves: got 50; allowed: a whole number from 200"),
        ({"seed": -1}, "seed: got -1"),
        ({"workers": 0}, "workers: got 0"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(changes, said):
    call = {"vary": {"contact.stiffness": (1e5, 1e6)}, "goals": SOFT, "solves": 200} | changes
    with pytest.raises(SceneError) as refused:
        pareto(SPRING, **call)
    assert str(refused.value).startswith(said) and "\n" not in str(refused.value)


# --- points that are known ---


def test_levels_and_solitude_of_points_that_are_known():
    aims = np.array([[1.0, 4.0], [2.0, 2.0], [4.0, 1.0], [2.0, 3.0], [5.0, 5.0], [0.0, 0.0], [0.0, 0.0], [9.0, 9.0]])
    over = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.2, 0.1, np.inf])
    assert levels(aims, over).tolist() == [0, 0, 0, 1, 2, 4, 3, 5]
    line = np.array([[0.0, 4.0], [1.0, 3.0], [3.0, 1.0], [4.0, 0.0]])
    assert solitude(line).tolist() == [np.inf, 1.5, 1.5, np.inf]


def test_rounding_keeps_ten_digits_and_what_is_no_number():
    given = np.array([1.23456789012345e7, -1.23456789012345e-7, 0.0, np.nan, np.inf])
    assert rounded(given)[:2] == approx([12345678.90, -1.23456789e-7], rel=1e-14)
    assert rounded(given)[2] == 0.0 and math.isnan(rounded(given)[3]) and math.isinf(rounded(given)[4])
