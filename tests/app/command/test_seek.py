"""The command `impact solve SCENE --find KEY=LOW..HIGH --such-that FIGURE=VALUE`."""

import json

import pytest
from pytest import approx

import solvers
from solvers.text.catalogue import CHOSEN
from tests.app.command.calls import CONTOUR, SOUGHT, answer, refusal

PAD = ("docs/hammer.toml", "--find", "contact.stiffness=2e5..2e7")
ASKED = ("--such-that", "peak_force=3e3")


@pytest.fixture(autouse=True)
def root(monkeypatch):
    monkeypatch.chdir(__file__.rsplit("/tests/", 1)[0])


def test_the_key_for_a_figure_as_a_table_and_in_json(capsys):
    found = json.loads(answer(capsys, "solve", *PAD, *ASKED, "--json"))
    assert set(found) == SOUGHT and (found["key"], found["unit"]) == ("contact.stiffness", "N/m")
    (root,) = found["roots"]
    scene = solvers.load("docs/hammer.toml").replace({"contact.stiffness": root["value"]})
    assert solvers.solve(scene).peak_force == approx(3e3, rel=1e-9)
    assert set(root) == {"value", "slope", "elasticity", "notes", "note_codes"}
    printed = answer(capsys, "solve", *PAD, *ASKED)
    assert f"{root['value']:.10g}" in printed and "one value\n" in printed and "each 1.081 times" in printed


def test_jumps_and_what_is_nearest(capsys):
    call = ("solve", "fixed-rod", "--find", "impactor.mass=1..3:20:log", "--such-that", "contacts=1.5")
    found = json.loads(answer(capsys, *call, "--json"))
    assert found["samples"] == 20 and found["roots"] == []
    assert found["jumps"] == [{"value": approx(2.110416, rel=1e-6), "below": 1.0, "above": 2.0}]
    assert set(found["nearest"]) == {"value", "found"} and found["nearest"]["found"] in (1.0, 2.0)


def test_in_spanish(capsys, monkeypatch):
    monkeypatch.setenv(CHOSEN, "es")
    call = ("solve", "fixed-rod", "--find", "impactor.mass=-1..3", "--such-that", "contacts=1.5")
    printed = answer(capsys, *call)
    assert "ningún valor" in printed and "salto en 2,110416 kg, de 1 a 2" in printed and "se han omitido" in printed


@pytest.mark.parametrize(
    "options, said",
    [
        (PAD[1:], "--find: got 'contact.stiffness=2e5..2e7'; allowed: beside it --such-that FIGURE=VALUE"),
        (ASKED, "--such-that: got 'peak_force=3e3'; allowed: beside it --find KEY=LOW..HIGH"),
        ((*PAD[1:], *ASKED, "--series", "a.csv"), "--series: got 'a.csv'; allowed: nothing beside --find"),
        ((*PAD[1:], *ASKED, "--at", "1"), "--at: got ['1']; allowed: nothing beside --find"),
        ((*PAD[1:], "--such-that", "peak_force"), "--such-that: got 'peak_force'; allowed: FIGURE=VALUE"),
        ((*PAD[1:], "--such-that", "peak_force=nan"), "--such-that peak_force: got nan; allowed: a finite number"),
        ((*PAD[1:], "--such-that", "peak=1"), "--such-that: got 'peak'; allowed: 'contacts', "),
        (("--find", "contact.stiffness", *ASKED), "--find: got 'contact.stiffness'; allowed: KEY=LOW..HIGH"),
        (("--find", "contact.stiffness=2..1", *ASKED), "--find: got (2.0, 1.0); allowed: two finite numbers"),
        (("--find", "contact.stiffness=-2..1:log", *ASKED), "--find: got -2.0; allowed: a number above zero"),
        (("--find", "contact.stiffness=1..2:3", *ASKED), "--find: got 3; allowed: a whole number from 5 to 2000"),
        (("--find", "contact.stif=1..2", *ASKED), "contact.stif: got 1.0; allowed: no such key"),
        (("--find", "method.modes=1..20", *ASKED), "--find: got 'method.modes'; allowed: a key that takes any number"),
    ],
)
def test_bad_words_are_refused_in_a_line(capsys, options, said):
    assert refusal(capsys, "solve", PAD[0], *options).startswith(f"impact: {said}")


# --- over two keys ---

BOTH = (*PAD, "--find", "impactor.velocity=1..4:4", *ASKED)


def test_lines_over_two_keys_as_a_table_and_in_json(capsys):
    found = json.loads(answer(capsys, "solve", *BOTH, "--json"))
    assert set(found) == CONTOUR
    assert [(each["key"], each["samples"]) for each in found["keys"]] == [
        ("contact.stiffness", 25),
        ("impactor.velocity", 4),
    ]
    (line,) = found["lines"]
    for stiffness, speed in line["vertices"][::5]:
        scene = solvers.load("docs/hammer.toml").replace({"contact.stiffness": stiffness, "impactor.velocity": speed})
        assert solvers.solve(scene).peak_force == approx(3e3, rel=1e-9)
    printed = answer(capsys, "solve", *BOTH)
    assert f"line 1, open: {len(line['vertices'])} vertices" in printed and "25 x 4 points" in printed
    assert sum(text.startswith("      ") for text in printed.splitlines()) == 7


def test_lines_in_spanish(capsys, monkeypatch):
    monkeypatch.setenv(CHOSEN, "es")
    call = ("--find", "impactor.mass=-1..3:5", "--find", "target.length=0.4..1:5", "--such-that", "contacts=1.5")
    printed = answer(capsys, "solve", "fixed-rod", *call)
    assert "ninguna línea, un salto" in printed and "salto 1, abierto, de 1 a 2" in printed and "se admite" in printed


@pytest.mark.parametrize(
    "finds, said",
    [
        (("contact.stiffness=1..2", "contact.stiffness=1..3"), "got 'contact.stiffness=1..3'; allowed: another key"),
        (
            ("contact.stiffness=1..2", "impactor.mass=1..2", "target.length=1..2"),
            "got 'target.length=1..2'; allowed: one",
        ),
        (("contact.stiffness=1..2", "impactor.mass"), "got 'impactor.mass'; allowed: KEY=LOW..HIGH"),
        (
            ("contact.stiffness=1..2", "impactor.mass=2..1"),
            "impactor.mass: got (2.0, 1.0); allowed: two finite numbers",
        ),
        (("contact.stiffness=1..2", "impactor.mass=1..2:2"), "got 2; allowed: a whole number from 3 to 500"),
    ],
)
def test_two_keys_that_cannot_be_are_refused_in_a_line(capsys, finds, said):
    options = [word for find in finds for word in ("--find", find)]
    assert refusal(capsys, "solve", PAD[0], *options, *ASKED).split("--find", 1)[1].strip(": ").startswith(said)
