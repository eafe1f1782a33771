"""The command `impact sweep`."""

import json
import re
from pathlib import Path

import pytest
from pytest import approx

import solvers
from tests.app.command.calls import answer, refusal
from tests.app.command.interrupted import interrupted

ROOT = Path(__file__).parents[3]


def rows(capsys, *arguments):
    return json.loads(answer(capsys, "sweep", *arguments, "--json"))


def test_rows_have_exactly_the_promised_keys(capsys):
    found = rows(capsys, "fixed-rod", "--vary", "impactor.mass=0.5..2:3")
    assert [row["value"] for row in found] == [0.5, 1.25, 2.0]
    for row in found:
        assert set(row) == {
            "value", "contacts", "impulse", "peak_force", "contact_time", "peak_indentation", "impactor", "restitution",
            "energy_error", "estimated_error",
        }  # fmt: skip
        assert set(row["restitution"]) == {"newton", "poisson", "newton_at_contact"}
    alone = solvers.solve(solvers.load("fixed-rod").replace({"impactor.mass": 1.25}))
    assert found[1]["impactor"] == {"final_velocity": alone.impactor_velocity}


@pytest.mark.parametrize(
    "vary, values",
    [
        ("impactor.velocity=1..3:3", [1.0, 2.0, 3.0]),
        ("impactor.velocity=.5..50.:3", [0.5, 5.0, 50.0]),  # a hundredfold: by a constant factor
        ("impactor.velocity=1..4:3:log", [1.0, 2.0, 4.0]),
        ("impactor.velocity=1..101:3:linear", [1.0, 51.0, 101.0]),
        (" impactor.velocity =1..2:2", [1.0, 2.0]),
        ("impactor.velocity=1e0..2E+0:2", [1.0, 2.0]),
        ("target.velocity=-1..0.5:3:linear", [-1.0, -0.25, 0.5]),
    ],
)
def test_ranges(capsys, vary, values):
    scene = ["free-rod"]
    if vary.startswith("target"):
        scene += ["--set", 'target={kind="mass", mass=1.0}', "--set", 'contact={law="linear", stiffness=1e8}']
        scene += ["--set", "method.name=quasi-static"]
    found = rows(capsys, *scene, "--vary", vary)
    assert [row["value"] for row in found] == approx(values)


def test_twenty_one_values_unless_said_otherwise(capsys):
    assert len(rows(capsys, "free-rod", "--vary", "impactor.mass=1..2")) == 21


def test_the_table_has_a_line_for_each_value(capsys):
    lines = answer(capsys, "sweep", "fixed-rod", "--vary", "impactor.mass=1..2.133:2").splitlines()
    assert len(lines) == 3
    assert lines[0].split()[0] == "impactor.mass"
    assert lines[2].split()[:2] == ["2.133", "2"]
    assert "-0.698876" in lines[2]  # (4.37)
    assert len({len(line) for line in lines}) == 1


def test_bodies_in_space_leave_with_vectors(capsys):
    found = rows(capsys, "note-rod", "--vary", "method.restitution=0..1:3")
    assert all(len(row["impactor"]["final_velocity"]) == 3 for row in found)
    text = answer(capsys, "sweep", "note-rod", "--vary", "method.restitution=0..1:3")
    assert "(" in text and "  -  " in text  # an impact of no duration has no peak force


@pytest.mark.parametrize(
    "vary, said",
    [
        ("impactor.mass", "--vary: got 'impactor.mass'"),
        ("impactor.mass=1", "KEY=LOW..HIGH"),
        ("impactor.mass=1..", "KEY=LOW..HIGH"),
        ("impactor.mass=a..b", "KEY=LOW..HIGH"),
        ("impactor.mass=1..2:x", "KEY=LOW..HIGH"),
        ("=1..2", "KEY=LOW..HIGH"),
        ("impactor.mass=nan..2", "KEY=LOW..HIGH"),
        ("impactor.mass=1..1e999", "--vary range"),
        ("impactor.mass=2..1", "--vary range: got (2.0, 1.0)"),
        ("impactor.mass=1..2:1", "--vary count: got 1"),
        ("impactor.mass=1..2:9999999", "--vary count: got 9999999"),
        ("impactor.mass=-1..2:3:log", "--vary range: got -1.0"),
        ("impactor.mass=-1..2:4", "impactor.mass: got -1.0"),
        ("target.colour=1..2", "target.colour: got 1"),
        ("title=1..2", "title: got 1"),
        ("method.modes=1..2", "method.modes"),
        ("contact.law=1..2", "contact.law: got 1"),
    ],
)
def test_bad_ranges_are_refused_in_one_line(capsys, vary, said):
    assert said in refusal(capsys, "sweep", "fixed-rod", "--vary", vary)


def test_a_method_that_cannot_solve_the_scene_says_so(capsys):
    changes = ("--set", "contact.law=hertz", "--set", "contact.stiffness=1e9", "--set", "method.name=mode-switch")
    assert "method.name: got 'mode-switch'" in refusal(
        capsys, "sweep", "fixed-rod", *changes, "--vary", "impactor.mass=1..2"
    )
    refusal(capsys, "sweep", "fixed-rod")
    refusal(capsys, "sweep", "no-such-scene", "--vary", "impactor.mass=1..2")


@pytest.mark.parametrize(
    "words",
    [
        ("sweep", "fixed-rod", "--vary", "impactor.mass=1..2", "--vary", "target.length=1..2"),
        ("sweep", "fixed-rod", "--vary", "impactor.mass=1..2", "--vary=impactor.mass=1..2"),
        ("solve", "fixed-rod", "--series", "a.csv", "--series", "b.csv"),
        ("record", "x.csv", "--scene", "fixed-rod", "--sign", "1", "--sign", "-1"),
        ("tradeoff", "fixed-rod", "--quantity", "rebound", "--quantity", "impulse"),
    ],
)  # fmt: skip
def test_an_option_that_takes_one_value_is_not_given_twice(capsys, words):
    """argparse would keep the last one."""
    assert re.search(r"--\w+ is given twice, as \S+ and as \S+: it takes one value", refusal(capsys, *words))


@pytest.mark.slow
def test_an_interrupt_keeps_what_is_solved():
    changes = ("--set", "method.name=modal", "--set", "method.modes=400", "--set", "method.steps=10000")
    code, out, err = interrupted("sweep", "fixed-rod", *changes, "--vary", "impactor.mass=1..2:2000", "--json")
    rows = json.loads(out)
    assert code == 130 and 10 < len(rows) < 2_000
    assert [row["value"] for row in rows] == sorted(row["value"] for row in rows)
    assert err == f"impact: stopped after {len(rows)} of at most 2000 values\n"
