"""The plan and the map of regimes as the page gets them."""

import json

import pytest

from app.choices.choices import Choices, accepts
from app.choices.request import Request
from app.choices.scene_of import choices_of
from app.messages.solutions import method_options
from app.page.questions import accepted
from app.views.plan import page_choices, plan_data, regimes_data
from solvers import METHODS, load, plan
from solvers.text.notes import Note


def asked(scene, question="final-velocities", tolerance=0.05, **changes):
    return Choices(**choices_of(scene) | {"scene": scene} | changes).chosen() | {
        "question": question,
        "plan_tolerance": tolerance,
    }


def planned(*given, **changes):
    return json.loads(plan_data(asked(*given, **changes)))


@pytest.mark.parametrize("scene", ["fixed-rod", "figure-10.2", "xylophone-bar", "figure-9.1", "two-unequal-rods"])
def test_the_page_shows_the_plan_of_the_library(scene):
    found, own = planned(scene), plan(load(scene))
    assert [row["model"] for row in found["candidates"]] == [row.parts for row in own.candidates]
    assert found["candidates"][found["picked"]]["model"] == own.chosen.parts
    assert str(Note.from_table(found["why"])) == own.reason
    assert found["groups"] == pytest.approx(own.groups, rel=1e-9)
    assert found["chosen"] == asked(scene)


def test_a_coarser_question_is_answered_by_a_smaller_model():
    fine, coarse = planned("fixed-rod", tolerance=0.01), planned("fixed-rod", tolerance=0.1)
    assert coarse["picked"] < fine["picked"]


def test_a_model_can_be_shown_where_the_page_has_all_that_it_changes():
    assert page_choices({"method": {"name": "modal", "modes": 5, "steps": None}, "target.theory": "timoshenko"}) == {
        "method": "modal",
        "modes": 5,
        "theory": "timoshenko",
    }
    assert page_choices({"method": {"name": "modal", "modes": 100_000}}) is None  # beyond the slider
    assert page_choices({"method": {"name": "fe-nodal", "elements": 5, "scheme": "central-difference"}}) is None
    assert page_choices({"method": {"name": "waves"}, "impactor.mass": 2.0}) is None


def test_modes_of_a_pendulum_that_strikes_a_stop_are_those_of_the_page():
    """On a rod they are the rod's: there a plan by fewer modes of the pendulum is no choice of the page."""
    rows = {
        (row["model"]["name"], row["model"].get("modes")): row["choices"]
        for row in planned("figure-10.11")["candidates"]
    }
    assert rows["modal", 3] == {"modes": 3, "method": "modal"}
    changes = {"impactor.modes": 3, "method": {"name": "modal", "modes": 3}}
    assert page_choices(changes) is None and page_choices(changes, True) == rows["modal", 3]


def test_what_is_shown_is_what_was_planned():
    scene, question = "xylophone-bar", "peak-force"
    own = plan(load(scene), question).candidates
    for row, candidate in zip(planned(scene, question)["candidates"], own, strict=True):
        choices, method = row["choices"], candidate.changes["method"]
        if method.get("model") == "structural":  # by itself the page takes the contact
            assert choices is None
            continue
        assert choices["method"] == method["name"] and all(accepts(*pair) for pair in choices.items())
        options = method_options(method["name"], Request.of(asked(scene, question) | choices))
        assert METHODS[method["name"]].read(options).table().get("modes") == method.get("modes")


def test_the_map_is_that_of_the_family():
    found = json.loads(regimes_data(asked("fixed-rod", law="hertz")))
    assert (found["family"], found["law"]) == ("fixed-rod", "hertz")
    assert len(found["errors"]) == len(found["models"]) == 3
    assert len(found["errors"][0]) == len(found["ratio"]) and len(found["errors"][0][0]) == len(found["time"])
    for lines in found["contours"].values():
        assert [level for level, *_ in lines] == [0.01, 0.05, 0.2]
    assert json.loads(regimes_data(asked("two-unequal-rods"))) == {}


@pytest.mark.parametrize(
    "name, value",
    [
        ("plan_tolerance", 0.0),
        ("plan_tolerance", -1.0),
        ("plan_tolerance", float("nan")),
        ("plan_tolerance", True),
        ("question", "weather"),
        ("question", 3),
        ("plan_shown", 1),
        ("plan_shown", "yes"),
    ],
)
def test_no_other_question_is_taken(name, value):
    assert not accepted(name, value)


def test_honest_questions_are_taken():
    assert accepted("plan_tolerance", 0.2) and accepted("question", "stresses") and accepted("plan_shown", True)


def test_more_modes_of_links_are_the_slider_of_modes():
    row = next(row for row in planned("four-bar-moves")["candidates"] if row["model"].get("modes") == 5)
    assert row["choices"] == {"method": "modal", "modes": 5}
    assert planned("figure-9.11")["candidates"][2]["choices"] is None  # a rigid pendulum is another body


@pytest.mark.parametrize("mass_ratio, other", [(4.0, "structural-quasi-static"), (0.1, "local-quasi-static")])
def test_a_quasi_static_model_that_the_page_would_not_take_cannot_be_shown(mass_ratio, other):
    rows = planned("fixed-rod", law="hertz", mass_ratio=mass_ratio)["candidates"]
    static = {row["model"]["name"]: row["choices"] for row in rows if "quasi-static" in row["model"]["name"]}
    assert len(static) == 2 and static.pop(other) is None
    assert list(static.values()) == [{"method": "quasi-static"}]
