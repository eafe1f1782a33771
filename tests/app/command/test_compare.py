"""`impact compare`: a row for every method, or why not."""

import json

import pytest

import solvers
from tests.app.command.calls import KEYS, answer, refusal


@pytest.mark.slow
def test_compare_prints_a_row_for_every_method_or_says_why_not(capsys):
    said = answer(capsys, "compare", "bronze-rod-steel-ball")
    rows = {line.split()[0]: line for line in said.splitlines() if line.startswith("  ") and line.split()}
    assert set(solvers.METHODS) <= set(rows)
    assert " 1/1 " in rows["modal"]
    assert "cannot: " in rows["mode-switch"]


@pytest.mark.slow
def test_compare_in_json_for_scripts(capsys):
    found = json.loads(answer(capsys, "compare", "fixed-rod", "--set", "impactor.mass=1.0665", "--json"))
    assert set(found) == {"exact", "methods"}
    assert set(found["exact"]) == KEYS
    assert found["exact"]["scene"]["impactor"]["mass"] == 1.0665
    assert {row["method"]["name"] for row in found["methods"]} == set(solvers.METHODS)
    exact = found["methods"][0]
    assert exact["method"]["name"] == "waves" and exact["rebound_error"] == 0.0


def test_compare_of_a_prescribed_force_says_how_its_target_moves_on(capsys):
    said = answer(capsys, "compare", "pressure-bar")
    moved = solvers.solve(solvers.load("pressure-bar")).target_velocity
    assert f"its target moves on at          {moved:+.8g} m/s" in said
    assert "impactor leaves" not in said


def test_compare_refuses_what_has_no_exact_solution(capsys):
    assert "method.name: got 'waves'" in refusal(capsys, "compare", "note-rod")
