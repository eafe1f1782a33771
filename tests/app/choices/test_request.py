"""What is asked to be solved is decoded once from the choices."""

from dataclasses import FrozenInstanceError

import pytest

from app.choices.choices import SCENES, Choices, accepts
from app.choices.request import Request
from app.choices.scene_of import choices_of
from app.text.catalogues import page
from app.text.refusals import Refused
from solvers.text.catalogue import SOURCE


def request(scene, **more):
    return Request.of(Choices(**choices_of(scene) | {"scene": scene} | more).chosen())


def test_a_request_says_what_the_choices_say():
    made = request("fixed-rod", speed=3.0, mass_ratio=2.0, method="fe-nodal", elements=12, modes=7, restitution=0.3)
    assert made.scene.speed == 3.0 and made.scene.mass_ratio == pytest.approx(2.0)
    assert (made.method, made.modes, made.elements, made.restitution) == ("fe-nodal", 7, 12, 0.3)
    assert made.chosen["speed"] == 3.0 and "elements" in made.acting and "modes" not in made.acting


@pytest.mark.parametrize(
    "scene, kind", [("fixed-rod", "axial"), ("hammer-on-cantilever", "beam"), ("brick-off-centre", "bodies")]
)
def test_a_request_knows_how_it_is_drawn(scene, kind):
    assert request(scene).kind == kind


def test_beside_waves_modes_are_shown():
    assert request("fixed-rod", method="waves").method_beside == "modal"
    assert request("fixed-rod", method="balance").method_beside == "balance"


def test_a_request_does_not_change_and_is_not_made_of_what_cannot_be():
    made = request("hammer-on-cantilever")
    with pytest.raises(FrozenInstanceError):
        made.method = "waves"
    with pytest.raises(Refused, match="Struck at: got"):
        Request.of(made.chosen | {"place": 0.0})


@pytest.mark.parametrize(
    "scene, more, tries",
    [
        ("fixed-rod", {}, "faster heavier free losing softer"),
        ("fixed-rod", {"speed": 100.0, "mass_ratio": 1e-3, "law": "hertz"}, "free losing"),  # as far as sliders reach
        ("fixed-rod", {"speed": 60.0, "law": "kelvin-voigt"}, "heavier free"),  # it gives way; 100 m/s at most
        ("hammer-on-cantilever", {}, "middle few faster heavier"),
        ("hammer-on-cantilever", {"place": 0.5, "modes": 4}, "faster heavier"),
        ("four-bar-moves", {"method": "modal"}, "moves middle faster heavier"),
        ("four-bar-moves", {"method": "multibody"}, "rigid middle faster heavier"),
        ("brick-off-centre", {}, "faster elastic centre"),
    ],
)
def test_only_what_acts_and_changes_something_can_be_tried(scene, more, tries):
    made = request(scene, **more)
    trials = made.opening().trials
    assert " ".join(trial.say for trial in trials) == tries
    for _, choice, value in trials:
        assert accepts(choice, value) and value != made.chosen[choice]


def test_a_body_that_jams_is_not_to_be_hit_in_its_centre():
    made = request("painleve-rod")
    assert "centre" in [trial.say for trial in made.opening().trials]
    assert "centre" not in [trial.say for trial in made.opening(["friction-jams"]).trials]


@pytest.mark.parametrize(
    "scene, more, asked",
    [
        ("fixed-rod", {}, "modes law hammer constant speed support quarter"),
        ("fixed-rod", {"speed": 100.0, "mass_ratio": 1e-3}, "modes law constant support quarter"),
        ("hammer-on-cantilever", {}, "modes law hammer constant speed theory"),
        ("brick-off-centre", {}, "speed restitution off-centre"),
    ],
)
def test_only_what_acts_and_changes_something_is_asked(scene, more, asked):
    texts = page(SOURCE).texts
    questions = [each.question for each in request(scene, **more).opening().comparisons]
    assert " ".join(questions) == asked and all(f"compare.question.{each}" in texts for each in questions)


def test_modes_of_a_frame_are_asked_for_in_three_steps():
    framed = request("free-rod", method="modal", floating_frame="attached")
    clamped = framed.opening().table()["compare"][0]
    assert (clamped["question"], clamped["between"], clamped["second"]) == ("clamped", ({"modes": 10},), {"modes": 30})


@pytest.mark.parametrize(
    "scene, more",
    [
        ("fixed-rod", {"mass_ratio": 2.0}),
        ("hammer-on-cantilever", {"bodies": "target.section.width=0.05"}),
        ("two-balls", {"speed": 2.0}),
        ("four-bar", {"speed": 2.0}),
        ("brick-off-centre", {"friction": 0.4}),
        ("split-hopkinson", {"bodies": "target.rods.2.length=0.1"}),
    ],
)
def test_an_impact_is_changed_by_its_bodies_and_contact_not_by_how_it_is_solved(scene, more):
    assert not request(scene).changed and not request(scene, modes=7, elements=12).changed
    assert request(scene, **more).changed


def test_no_scene_is_changed_as_it_comes():
    assert [name for name in SCENES if request(name).changed] == []
