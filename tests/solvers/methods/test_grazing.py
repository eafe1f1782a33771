"""Impacts next to one contact more or less say so."""

import pytest

import solvers
from tests.catalog import struck_rod


def notes(mass_ratio: float, support: str = "fixed") -> list[str]:
    found = solvers.solve(struck_rod(mass_ratio, support), "waves")
    return [note for note in found.notes if str(note).startswith("Near grazing")]


def test_mass_ratio_one_is_about_to_lose_its_second_contact():
    (note,) = notes(1.0)
    change = float(str(note).split("the mass ")[1].split(" %")[0])
    assert 0.5 < change < 2.0
    assert "one contact instead of 2" in str(note)
    factor = 1.0 - 0.01 * change if "lighter" in str(note) else 1.0 + 0.01 * change
    beyond = [
        len(solvers.solve(struck_rod(1.0 / (1.0 + part * (factor - 1.0))), "waves").contacts) for part in (0.9, 1.1)
    ]
    assert beyond == [2, 1]


@pytest.mark.parametrize(("mass_ratio", "support"), [(0.8, "fixed"), (2.0, "fixed"), (1.0, "free"), (30.0, "fixed")])
def test_other_impacts_do_not(mass_ratio, support):
    assert not notes(mass_ratio, support)


def test_only_whole_impacts_are_asked():
    scene = struck_rod(1.0)
    assert not solvers.solve(scene, "waves", duration=3.0 * scene.time_unit).notes


def test_a_contact_too_slight_to_be_missed_is_no_false_separation():
    """At this mass ratio exact waves find a second contact with 8e-5 of the impulse."""
    found = solvers.solve(struck_rod(0.008570856326550379), "waves")
    assert len(found.contacts) == 2 and found.contacts[1].impulse < 1e-4 * found.contacts[0].impulse
    assert not [note for note in found.notes if note.code == "contact-broken"]
