"""The view of convergence: what it varies on the scenes that are named after it, and what a visitor picks."""

import json

import pytest

from app.choices.choices import SCENES
from app.choices.opened import opening_of
from app.choices.scene_of import own_choices
from app.page.address import opened_from_address
from app.page.questions import Questions
from app.views.convergence import convergence_data
from app.views.registry import VIEWS, opened_with


def told(scene, by="own", **choices):
    return json.loads(convergence_data(own_choices(scene) | choices | {"convergence_by": by}))


@pytest.mark.parametrize(
    ("scene", "kind", "balances"),
    [
        ("table-6.2", "elements", [12, 30, 63]),
        ("table-6.3", "restitution", [49, 296, 338, 352]),
        ("table-6.4", "step", [400, 731, 1954, 3117]),
        ("table-6.5", "step", [365, 680, 1849, 2907]),
    ],
)
def test_a_table_of_the_thesis_is_whole(scene, kind, balances):
    """From the choices with which the page opens it."""
    found = told(scene)
    assert found["kind"] == kind and found["values"]["balances"] == balances
    assert found["kinds"] == ["elements", "step", "restitution"] and found["reference"] == "waves"


def test_the_rows_of_a_mechanism_are_those_of_its_modes():
    for scene, counts in (("table-6.6", [5, 8, 12]), ("table-6.8", [5, 9, 13])):
        found = told(scene)
        assert (found["kind"], found["counts"], found["reference"]) == ("modes", counts, "rigid")


def test_what_is_picked_is_varied_where_it_can_be():
    assert told("table-6.4", "restitution")["counts"] == [1.0, 0.7, 0.3, 0.0]
    own = told("table-6.2", "step")
    assert own["counts"] == pytest.approx([1e-6, 5e-7, 2e-7, 1e-7])
    assert told("figure-8.25", "step")["kind"] == "modes"  # which has no steps
    assert told("fixed-rod", "own", method="fe-nodal")["kind"] == "elements"
    assert told("fixed-rod")["method"] == "modal"
    assert "error" in told("split-hopkinson")


def test_openings_name_views_and_what_they_vary():
    names = {view.name for view in VIEWS}
    for opening in map(opening_of, SCENES):
        assert set(opening.views) <= names
        assert bool(opening.varied) == ("convergence" in opening.views) == bool(opening.by)


def test_a_scene_that_is_opened_asks_anew():
    assert opened_with("table-6.4", "table-6.2") == {"convergence_shown": True, "convergence_by": "own"}
    assert opened_with("fixed-rod", "table-6.2") == {"convergence_shown": False}
    opened, refused = opened_from_address({"scene": [b"table-6.4"], "by": [b"restitution"]})
    assert opened == {"convergence_shown": True, "convergence_by": "restitution"} and not refused
    assert Questions.param.convergence_by.default == "own"
