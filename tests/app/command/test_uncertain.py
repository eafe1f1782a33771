"""`impact uncertain`: its tables, its JSON, and the one line of each refusal."""

import json

import pytest

from .calls import answer, refusal

CALL = ("uncertain", "fixed-rod", "--tolerance", "impactor.mass=5%", "--tolerance", "impactor.velocity=normal(1,0.01)")
FEW = ("--figure", "impulse", "--points", "20", "--workers", "1")


def test_the_tables(capsys):
    said = answer(capsys, *CALL, *FEW)
    assert "32 base samples, 128 solves" in said and "impactor.velocity: normal(1,0.01)" in said
    assert "Note: 32 base samples in place of 20" in said


def test_the_same_as_json(capsys):
    found = json.loads(answer(capsys, *CALL, *FEW, "--seed", "2", "--json"))
    assert (found["samples"], found["kept"], found["seed"]) == (32, 32, 2)
    impulse = found["figures"]["impulse"]
    assert impulse["ranking"] == ["impactor.mass", "impactor.velocity"] and impulse["quantiles"].keys() == {
        *("5", "25", "50", "75", "95")
    }
    assert found["note_codes"][0]["code"] == "samples-rounded-up"


@pytest.mark.parametrize(
    "options, said",
    [
        ((), "--tolerance: got nothing"),
        (("--tolerance", "impactor.mass"), "--tolerance: got 'impactor.mass'"),
        (("--tolerance", "impactor.mass=5%", "--tolerance", "impactor.mass=6%"), "one value for a key"),
        (("--tolerance", "impactor.mass=dice(2)"), "impactor.mass: got 'dice(2)'"),
        (("--tolerance", "impactor.mass=5%", "--points", "some"), "--points: got 'some'"),
        (("--tolerance", "impactor.mass=5%", "--points", "0"), "--points: got 0"),
        (("--tolerance", "impactor.mass=5%", "--figure", "beauty"), "--figure: got 'beauty'"),
        (("--tolerance", "impactor.mass=-2..-1", "--points", "8"), "--tolerance: got {'impactor.mass'"),
    ],
)
def test_each_refusal_is_one_line(capsys, options, said):
    assert said in refusal(capsys, "uncertain", "fixed-rod", *options)
