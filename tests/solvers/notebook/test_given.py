"""Shares of the energy: of all that was given, none negative, and none where it does not add up."""

import re

import pytest

from solvers import Scene, solve
from solvers.notebook.given import books_open, given

DROPS = {
    "caught": {"law": "kelvin-voigt", "stiffness": 1e4, "damping": 400.0},
    "dented": {"law": "plastic-linear", "stiffness": 1e6, "yield_indentation": 0.002},
}


def dropped(law: dict) -> Scene:
    return Scene.from_table({"impactor": {"mass": 80.0, "height": 0.1}, "target": {"kind": "stop"}, "contact": law})


def told(text: str) -> list[float]:
    """Percentages of the lines below the head of the energies."""
    after = text.split("energy at the end")[1].splitlines()[1:]
    rows = [re.fullmatch(r"    \S.*?\s+(-?\d+\.\d{5})", line) for line in after]
    return [float(row[1]) for row in rows if row]


@pytest.mark.parametrize("law", DROPS.values(), ids=DROPS)
def test_what_weight_has_given_is_part_of_the_whole(law):
    solution = solve(dropped(law))
    gave = given(solution.energy)
    assert gave["weight"] == pytest.approx(-solution.energy["weight"]) and gave["weight"] > 1e-3 * gave["whole"]
    text = str(solution)
    assert f"weight {gave['weight']:.4g} J" in text
    shares = told(text)
    assert len(shares) >= 4 and min(shares) >= 0.0 and sum(shares) == pytest.approx(100.0, abs=1e-3)


def test_what_drives_have_given_is_part_of_the_whole():
    """Of the energy before the impact alone, the mass would have 1169 % at the end."""
    shares = told(str(solve("rotating-bar")))
    assert min(shares) >= 0.0 and sum(shares) == pytest.approx(100.0, abs=0.1)


def test_shares_of_what_does_not_add_up_are_not_told():
    solution = solve("fixed-rod", "fe-nodal", status="frozen", steps=60)  # which gains and loses by whole steps
    assert books_open(solution)
    text = str(solution)
    assert "energy at the end" not in text and "shares of the energy are not shown" in text
    assert not books_open(solve("fixed-rod"))
