"""What projections make of the nodes of a link as its modes change, for the page."""

import json

from pytest import approx

from app.choices.scene_of import own_choices
from app.page.address import opened_from_address
from app.views.mode_change import mode_change_data, of_struck_nodes
from solvers import load, solve
from tests.app.sentences import sentence
from tests.catalog import SCENES


def test_tables_6_9_to_6_12():
    """The page says what the result says, in its digits; what is rounding is nought."""
    for number in (9, 10, 11, 12):
        found = json.loads(mode_change_data(own_choices(f"table-6.{number}")))
        solved = solve(load(f"table-6.{number}"))
        for name, fields in (("velocities", solved.mode_change), ("coordinates", solved.mode_change_coordinates)):
            for by, parts in fields.items():
                assert found[name][by]["turn"] == approx(parts["turn"], rel=1e-5, abs=1e-12)
        assert found["velocities"]["before"]["along"] == [0.0] * 5
        assert (found["struck"], found["modes"], found["nodes"]) == (4, 12, approx([75.0, 150.0, 225.0, 299.0, 300.0]))
        assert found["lost"] < 1e-6
        assert found["first"] == ("coordinates" if number in (9, 11) else "velocities")


def test_fewer_modes_lose_energy():
    assert json.loads(mode_change_data(own_choices("table-6.10") | {"modes": 3}))["lost"] == approx(0.048, abs=0.001)


def test_a_link_that_is_struck_beside_its_nodes():
    found = json.loads(mode_change_data(own_choices("table-6.10") | {"place": 0.4}))
    assert "Move “Struck at” to a node" in sentence(found["error"])


def test_it_is_asked_of_links_of_elements():
    assert of_struck_nodes(own_choices("table-6.12"))
    for scene in ("figure-6.11", "fixed-rod", "four-bar-moves"):
        assert of_struck_nodes(own_choices(scene)) is None


def test_scenes_are_opened_with_what_they_are_named_after():
    """Unless the address says what is open."""
    for scene, opener in (("table-6.10", "mode_change_shown"), ("figure-5.24", "stretch_shown")):
        assert scene in SCENES
        assert opened_from_address({"scene": [scene.encode()]}) == ({opener: True}, [])
        assert opened_from_address({"scene": [scene.encode()], "panel": [b"needs"]}) == ({"plan_shown": True}, [])
    assert opened_from_address({"scene": [b"fixed-rod"]}) == ({}, [])
