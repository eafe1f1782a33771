"""Blows next to one contact more or less say so."""

import pytest

import solvers
from tests.catalog import struck_rod


def notes(mass_ratio: float, support: str = "fixed") -> list[str]:
    found = solvers.solve(struck_rod(mass_ratio, support), "waves")
    return [note for note in found.notes if note.startswith("Near grazing")]


def test_mass_ratio_one_is_about_to_lose_its_second_contact():
    (note,) = notes(1.0)
    change = float(note.split("the mass ")[1].split(" %")[0])
    assert 0.5 < change < 2.0
    assert "one contact instead of 2" in note
    factor = 1.0 - 0.01 * change if "lighter" in note else 1.0 + 0.01 * change
    beyond = [
        len(solvers.solve(struck_rod(1.0 / (1.0 + part * (factor - 1.0))), "waves").contacts) for part in (0.9, 1.1)
    ]
    assert beyond == [2, 1]


@pytest.mark.parametrize(("mass_ratio", "support"), [(0.8, "fixed"), (2.0, "fixed"), (1.0, "free"), (30.0, "fixed")])
def test_other_blows_do_not(mass_ratio, support):
    assert not notes(mass_ratio, support)


def test_only_whole_blows_are_asked():
    scene = struck_rod(1.0)
    assert not solvers.solve(scene, "waves", duration=3.0 * scene.time_unit).notes
