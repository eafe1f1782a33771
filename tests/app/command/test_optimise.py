"""The command `impact optimise`: the best values, or the best compromises of two figures."""

import json

import pytest
from pytest import approx

import solvers
from solvers.text.catalogue import CHOSEN
from tests.app.command.calls import COMPROMISES, answer, refusal

VARY = ("fixed-rod", "--vary", "impactor.mass=0.5..3.5")
TWO = ("--minimise", "peak_force", "--maximise", "newton", "--solves", "300", "--points", "6")


def test_one_goal_is_what_optimise_finds(capsys):
    found = json.loads(answer(capsys, "optimise", *VARY, "--maximise", "newton", "--solves", "100", "--json"))
    alone = solvers.optimise("fixed-rod", {"impactor.mass": (0.5, 3.5)}, maximise="newton", solves=100)
    assert found["values"] == alone.values and found["largest"]


def test_two_goals_give_compromises_as_a_table_and_in_json(capsys):
    found = json.loads(answer(capsys, "optimise", *VARY, *TWO, "--json"))
    assert set(found) == COMPROMISES and found["goals"] == {"peak_force": "smallest", "newton": "largest"}
    assert len(found["points"]) == 6
    for point in found["points"]:
        solution = solvers.solve(solvers.load("fixed-rod").replace(point["values"]))
        assert [solution.peak_force, solution.restitution["newton"]] == approx(
            [point["figures"]["peak_force"], point["figures"]["newton"]], rel=1e-9
        )
    printed = answer(capsys, "optimise", *VARY, *TWO)
    assert "best compromises of smallest peak force and largest restitution by velocities" in printed
    assert "impactor.mass [kg]" in printed and f"The 6 compromises of {found['solves']} impacts" in printed


def test_the_first_goal_that_is_named_leads(capsys):
    turned = ("--maximise", "newton", "--minimise", "peak_force", "--solves", "200", "--points", "3", "--json")
    assert list(json.loads(answer(capsys, "optimise", *VARY, *turned))["goals"]) == ["newton", "peak_force"]


def test_in_spanish(capsys, monkeypatch):
    monkeypatch.setenv(CHOSEN, "es")
    assert "mejores compromisos" in answer(capsys, "optimise", *VARY, *TWO)


@pytest.mark.parametrize(
    "options, said",
    [
        (("--minimise", "impulse", "--maximise", "impulse"), "--maximise: got 'impulse'; allowed: another figure"),
        ((*TWO, "--maximise", "impulse"), "--maximise: got 'impulse'; allowed: one goal, or two"),
        (("--minimise", "peak_force", "--points", "3"), "--points: got '3'; allowed: beside it two goals"),
        ((), "--minimise: got nothing; allowed: either minimise or maximise"),
        ((*TWO, "--such-that", "beauty<=1"), "--such-that: got 'beauty'; allowed: "),
        (("--minimise", "impulse", "--maximise", "beauty"), "--maximise: got 'beauty'; allowed: "),
        (("--maximise", "beauty"), "--maximise: got 'beauty'; allowed: "),
        (("--minimise", "impulse", "--maximise", "newton", "--points", "1"), "--points: got 1; allowed: a whole"),
        (("--minimise", "impulse", "--maximise", "newton", "--solves", "9"), "--solves: got 9; allowed: a whole"),
        (("--minimise", "impulse", "--maximise", "newton", "--seed", "x"), "--seed: got 'x'; allowed: a whole"),
        (("--minimise", "impulse", "--maximise", "peak_moment", "--solves", "200"), "--maximise: got 'peak_moment'"),
    ],
)
def test_bad_words_are_refused_in_a_line(capsys, options, said):
    assert refusal(capsys, "optimise", *VARY, *options).startswith(f"impact: {said}")
