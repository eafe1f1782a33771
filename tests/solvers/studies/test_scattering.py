"""Joints of mechanisms and the waves that meet them, in Python and as a command."""

import json

import numpy as np
import pytest
from pytest import approx

import solvers
from app.command.main import main
from solvers import SceneError
from tests.catalog import SCENES

BENT = SCENES["bent-rods"]


def test_unless_one_is_named_it_is_the_first_of_which_waves_are_known():
    tables = solvers.load("bent-rods").table()
    target = tables["target"]
    start = target["links"][0]["from"]
    crank = {"name": "crank", "from": [start[0] - 0.1, start[1]], "to": start, "mass": 1.0}
    joint = {"kind": "revolute", "links": ["crank", "first"], "at": start}  # which has no section
    target |= {"links": [crank, *target["links"]], "joints": [joint, *target["joints"]]}
    assert solvers.joint_scattering(solvers.Scene.from_table(tables)).links == ("first", "second")


def test_a_scene_knows_its_joint():
    found = solvers.joint_scattering(BENT)
    assert (found.joint, found.kind, found.links) == (0, "revolute", ("first", "second"))
    assert found.bend == approx(np.pi / 2)
    assert found.power_error < 1e-12
    assert found.powers[:, 0, 1] == approx(np.zeros(found.frequencies.size), abs=1e-20)  # no moment, no bending back


def test_bend_and_side_follow_from_the_points():
    """Links may begin or end at the joint: what counts is where they lead."""
    tables = BENT.table()
    first, second = tables["target"]["links"]
    first["from"], first["to"] = first["to"], first["from"]
    tables["target"]["struck"]["at"] = 1.0
    second["to"] = [0.6, 0.0]
    tables["target"]["joints"][0]["kind"] = "fixed"
    straight = solvers.joint_scattering(solvers.Scene.from_table(tables), frequencies=[1e3])
    assert straight.bend == approx(0.0, abs=1e-12)
    assert straight.powers[0] == approx(np.array([[0, 0, 1, 0], [0, 0, 0, 1]]), abs=1e-12)
    tables["target"]["joints"][0] |= {"kind": "prismatic", "axis": [1.0, 0.0]}
    sliding = solvers.joint_scattering(solvers.Scene.from_table(tables), frequencies=[1e3])
    assert sliding.powers[0] == approx(np.array([[1, 0, 0, 0], [0, 0, 0, 1]]), abs=1e-12)


def test_the_command(capsys):
    assert main(["joints", "bent-rods", "--frequencies", "1e3,1e4", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["frequencies"] == [1e3, 1e4]
    assert sum(found["axial"]["powers"][name][1] for name in found["axial"]["powers"]) == approx(1.0, abs=1e-12)
    real, imaginary = found["axial"]["amplitudes"]["reflected_axial"][0]
    assert real**2 + imaginary**2 == approx(found["axial"]["powers"]["reflected_axial"][0], rel=1e-12)
    assert main(["joints", "bent-rods"]) == 0
    assert "revolute" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "key"),
    [
        (["fixed-rod"], "target.kind"),
        (["bent-rods", "--joint", "3"], "--joint"),
        (["bent-rods", "--joint", "x"], "--joint"),
        (["bent-rods", "--frequencies", "1,-2"], "--frequencies"),
        (["bent-rods", "--frequencies", "fast"], "--frequencies"),
        (["rotating-bar"], "target.joints"),
    ],
)
def test_refused(capsys, arguments, key):
    assert main(["joints", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith(f"impact: {key}: ") and err.count("\n") == 1


def test_links_need_a_section_and_the_joint_their_end():
    tables = BENT.table()
    link = tables["target"]["links"][1]
    for name in ("modes", "axial", "shapes", "theory", "section"):
        del link[name]
    with pytest.raises(SceneError) as refused:
        solvers.joint_scattering(solvers.Scene.from_table(tables))
    assert refused.value.key == "target.links[2].section"
    tables = BENT.table()
    tables["target"]["links"][1]["from"] = [0.3, -0.1]
    with pytest.raises(SceneError) as refused:
        solvers.joint_scattering(solvers.Scene.from_table(tables))
    assert refused.value.key == "target.joints[1].at"
