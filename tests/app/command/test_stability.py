"""`impact stability`: maps of integrators."""

import json

import pytest
from pytest import approx

from tests.app.command.calls import answer, refusal


@pytest.mark.slow
def test_stability_draws_a_map_of_each_integrator(capsys):
    found = answer(capsys, "stability", "stiff-contact", "--grid", "4x12")
    for name in ("modal", "newmark", "newmark-frozen", "central-difference", "rk4", "moreau-jean"):
        assert f"\n  {name}: " in found
    assert "2/ω_max, of the modes with the contact spring" in found
    assert "modal: 0 of 48 runs fail" in found and "thesis 8.2" in found
    assert all(len(line) <= 120 for line in found.splitlines())


def test_stability_as_json(capsys):
    found = json.loads(
        answer(
            capsys, "stability", "fixed-rod", "--axes", "step,speed", "--grid", "3x4", "--modes", "5",
            "--integrators", "modal,rk4", "--json",
        )
    )  # fmt: skip
    assert set(found) == {"axes", "modes", "here", "bound", "maps", "notes", "note_codes"}
    assert [axis["name"] for axis in found["axes"]] == ["step", "speed"] and found["modes"] == 5
    modal, rk4 = found["maps"]
    assert modal["ending"] == [[0] * 4] * 3 and modal["failures"] == 0 and modal["worst_energy_error"] < 1e-10
    assert modal["limit"] == [None] * 4 and rk4["limit"] == approx([8.0**0.5] * 4, rel=0.4)


@pytest.mark.parametrize(
    "arguments, named",
    [
        (("--axes", "step"), "axes"),
        (("--axes", "step,colour"), "'contact_stiffness'"),
        (("--grid", "4"), "ROWSxCOLUMNS"),
        (("--grid", "1x4"), "2 to 400"),
        (("--integrators", "leapfrog"), "'rk4'"),
        (("--modes", "many"), "--modes"),
    ],
)
def test_stability_refuses_by_name(capsys, arguments, named):
    assert named in refusal(capsys, "stability", "fixed-rod", *arguments)


def test_stability_of_a_scene_that_has_none(capsys):
    assert "prescribed force" in refusal(capsys, "stability", "pressure-bar")
