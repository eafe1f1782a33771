"""The command `impact ensemble`: promised keys, a line for every figure, and one line for everything it refuses."""

import json

import pytest
from pytest import approx

from tests.app.command.calls import answer, refusal
from tests.app.command.interrupted import interrupted


def test_an_ensemble_has_the_promised_keys(capsys):
    found = json.loads(answer(capsys, "ensemble", "fixed-rod", "--runs", "12", "--spread", "1e-3", "--json"))
    assert {"key", "method", "perturbations", "final_velocity", "contacts", "time", "force", "spread", "told"} < set(
        found
    )
    assert found["key"] == "impactor.mass" and len(found["final_velocity"]) == 12
    assert max(map(abs, found["perturbations"])) <= 1e-3
    assert set(found["force"]) == {"lowest", "low", "median", "high", "highest"}
    assert {len(values) for values in found["force"].values()} == {len(found["time"])}
    assert found["ill_conditioned"] is False
    assert {row["verdict"] for row in found["spread"]} == {"firm"}


def test_the_table_has_a_line_for_every_figure(capsys):
    reported = answer(
        capsys, "ensemble", "fixed-rod", "--runs", "10", "--set", "method.name=modal", "--key", "target.length"
    )
    assert "10 runs by modal, target.length changed" in reported
    for name in ("first parting [s]", "final velocity [m/s]", "contacts ", "peak force [N]"):
        (line,) = [line for line in reported.splitlines() if line.startswith(f"  {name}")]
        assert line.split()[-1] in ("firm", "loose", "trusted")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--runs", "1"], "--runs: got 1"),
        (["--runs", "many"], "--runs: got 'many'"),
        (["--spread", "nan"], "--spread: got nan"),
        (["--spread", "-1e-3"], "--spread: got -0.001"),
        (["--seed", "1.5"], "--seed: got '1.5'"),
        (["--key", "target.support"], "--key: got 'target.support'"),
        (["--key", "target.at.what"], "--key: got 'target.at.what'"),
        (["--set", "method.name=guess"], "method.name: got 'guess'"),
        (["--nothing"], "--nothing"),
    ],
)
def test_bad_input_is_refused_in_one_line(capsys, arguments, said):
    assert said in refusal(capsys, "ensemble", "fixed-rod", *arguments)


def test_bodies_in_space_are_refused(capsys):
    assert "two bodies that meet on an axis" in refusal(capsys, "ensemble", "brick-off-centre")


@pytest.mark.slow
def test_an_interrupt_keeps_the_runs_that_are_done():
    changes = ("--set", "method.name=modal", "--set", "method.modes=400", "--set", "method.steps=10000")
    code, out, err = interrupted("ensemble", "fixed-rod", *changes, "--runs", "2000", "--json")
    found = json.loads(out)
    runs = len(found["perturbations"])
    assert code == 130 and 10 <= runs < 2_000 and err == ""
    assert f"Stopped after {runs} of 2000 runs." in found["notes"]
    assert min(found["perturbations"]) < 0.0 < max(found["perturbations"])  # not only one end of the changes


def test_convergence_has_the_promised_keys(capsys):
    found = json.loads(answer(capsys, "convergence", "bronze-rod-steel-ball", "--modes", "3,6,12", "--json"))
    keys = {
        "method",
        "kind",
        "counts",
        "units",
        "values",
        "differences",
        "order",
        "told",
        "summary",
        "summary_codes",
        "wall_time",
    }
    assert set(found) == keys
    assert found["counts"] == [3, 6, 12] and (found["method"], found["kind"]) == ("modal", "modes")
    assert len(found["values"]["final_velocity"]) == len(found["differences"]["final_velocity"]) == 3


def test_convergence_of_the_elements_that_the_scene_names(capsys):
    words = ("--set", "method.name=fe-nodal", "--modes", "5,10,20")
    reported = answer(capsys, "convergence", "bronze-rod-steel-ball", *words)
    assert "by fe-nodal" in reported and "  elements" in reported and "final velocity: " in reported
    rows = [line for line in reported.splitlines() if "by fe-nodal" not in line]  # which says how long it took
    asked_by_name = answer(capsys, "convergence", "bronze-rod-steel-ball", *words[:2], "--elements", "5,10,20")
    assert [line for line in asked_by_name.splitlines() if "by fe-nodal" not in line] == rows
    unasked = answer(capsys, "convergence", "bronze-rod-steel-ball", "--elements", "5,10,20")
    assert [line for line in unasked.splitlines() if "by fe-nodal" not in line] == rows


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--modes", "3,5"], "--modes: got [3, 5]"),
        (["--modes", "3,x,7"], "--modes: got 'x'"),
        (["--modes", "10,5,3"], "--modes: got [10, 5, 3]"),
        (["--modes", ""], "--modes: got ''"),
        (["--elements", "10,5,3"], "--elements: got [10, 5, 3]"),
        (["--elements", "3,5,9", "--modes", "3,5,9"], "--elements: got [3, 5, 9]; allowed: one list"),
        (["--set", "method.name=guess"], "method.name: got 'guess'"),
    ],
)
def test_bad_counts_are_refused_in_one_line(capsys, arguments, said):
    assert said in refusal(capsys, "convergence", "fixed-rod", *arguments)


def test_convergence_of_what_modes_cannot_solve_is_refused(capsys):
    assert "method.name" in refusal(capsys, "convergence", "split-hopkinson")


def test_derivatives_print_as_a_table_and_as_json(capsys):
    found = json.loads(
        answer(capsys, "gradient", "fixed-rod", "--of", "peak_force", "--to", "impactor.velocity", "--json")
    )
    assert found["elasticity"]["peak_force"]["impactor.velocity"] == approx(1.0)
    printed = answer(capsys, "gradient", "fixed-rod", "--of", "peak_force", "impulse", "--to", "impactor.mass")
    assert "impulse" in printed.splitlines()[5]
    assert "--of: got 'weight'" in refusal(capsys, "gradient", "fixed-rod", "--of", "weight")
    assert "--to: got 'method.modes'" in refusal(capsys, "gradient", "fixed-rod", "--to", "method.modes")
