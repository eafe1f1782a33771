"""What an address opens and asks: bounds that hold, nothing echoed that is more than a word."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.page.address import ASKED, PANELS, from_address, opened_from_address
from app.page.questions import Questions


def read(**given):
    return opened_from_address({key: [text.encode()] for key, text in given.items()})


def test_a_question_and_its_panel_are_taken():
    kept, refused = read(
        panel="tolerance,stability", quantity="peak-force", tolerance="0.01", axis="modes", waves="false"
    )
    assert refused == []
    assert kept == {
        "auto_shown": True,
        "stability_shown": True,
        "auto_quantity": "peak-force",
        "auto_tolerance": 0.01,
        "auto_within": "tolerance",
        "stability_axis": "modes",
        "auto_waves": False,
    }


def test_older_links_to_the_panel_of_motion_show_it_on_the_stage():
    query = {"scene": "four-bar", "panel": "motion,energy", "seconds": "0.02", "links": "rigid"}
    kept, refused = from_address({key: [text.encode()] for key, text in query.items()})
    assert refused == [] and read(**query) == ({"energy_shown": True}, [])
    assert (kept["method"], kept["motion_seconds"], kept["motion_links"]) == ("multibody", 0.02, "rigid")


def test_no_panel_is_open_where_none_is_named():
    assert read(panel="") == ({}, [])


def test_a_budget_is_kept_to_rather_than_a_tolerance():
    kept, _ = read(budget="0.05", tolerance="0.01")
    assert (kept["auto_within"], kept["auto_budget"]) == ("time", 0.05)


@pytest.mark.parametrize(
    "key, value, reported",
    [
        ("panel", "weather", "Analysis: 'weather' is not possible. Choose one of energy, needs,"),
        ("panel", "needs,<b>", "Analysis: “…” is not possible."),
        ("tolerance", "0", "Error: 0.0 is not possible. Choose a number from 1e-06 to 0.5."),
        ("tolerance", "much", "Error: 'much' is not possible. Choose a number from"),
        ("budget", "1e9", "Computing time, s: 1000000000.0 is not possible. Choose a number from 0.0001 to 6"),
        ("axis", "<b>", "Step against: “…” is not possible. Choose one of contact_stiffness, mass_ratio, modes"),
        ("axis", "step", "Step against: 'step' is not possible. Choose one of contact_stiffness, mass_ratio, modes"),
        ("waves", "1", "Exact waves: '1' is not possible. Choose true or false."),
    ],
)
def test_what_is_not_allowed_is_reported_with_its_key_and_left_out(key, value, reported):
    kept, refused = read(**{key: value})
    assert len(refused) == 1 and str(refused[0]).startswith(reported)
    assert set(kept) <= {"plan_shown"}


@given(st.dictionaries(st.sampled_from(["panel", *ASKED]), st.lists(st.binary(max_size=99), min_size=1, max_size=2)))
def test_no_address_breaks_anything_or_is_echoed(arguments):
    kept, refused = opened_from_address(arguments)
    Questions(**{name: value for name, value in kept.items() if name in Questions.param})
    for sentence in map(str, refused):
        assert "<" not in sentence and "\n" not in sentence


def test_what_an_address_names_is_there_to_be_set():
    for name in PANELS.values():
        assert name in Questions.ASKED
    for name, panel, _ in ASKED.values():
        assert name in Questions.param and panel in PANELS
