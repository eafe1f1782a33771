"""Kinds of scene: what each has to choose, which of it acts, and the scene that follows."""

import numpy as np
import pytest

import solvers
from app.choices.choices import SCENES, Choices
from app.choices.kinds import kind_of
from app.choices.request import Request
from app.choices.scene_of import acting_choices, chosen_scene, own_choices

ONE_OF_EACH = {
    "axial": "fixed-rod",
    "beam": "hammer-on-cantilever",
    "mechanism": "four-bar-moves",
    "bodies": "brick-off-centre",
}


def test_there_are_scenes_of_every_kind():
    assert {kind_of(scene).NAME for scene in SCENES.values()} == set(ONE_OF_EACH)
    for kind, scene in ONE_OF_EACH.items():
        request = Request.of(own_choices(scene))
        assert request.kind == kind and request.exact == (kind == "axial")


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_that_nobody_has_changed_is_that_of_its_file(name):
    """To rounding: a mass that is set follows from the mass ratio, of twelve digits, and an end is exactly one."""
    given, opened = SCENES[name], chosen_scene(own_choices(name))
    assert opened.title == given.title and opened.contact == given.contact
    assert opened.speed == pytest.approx(given.speed, rel=1e-8)
    for body in ("impactor", "target"):
        before, after = (getattr(scene, body).mass for scene in (given, opened))
        assert after == pytest.approx(before, rel=1e-9) or not np.isfinite(before)


@pytest.mark.parametrize("name", ONE_OF_EACH.values())
def test_what_acts_changes_the_scene_or_how_it_is_solved(name):
    own = own_choices(name)
    own |= {"place": 0.5} if "support" in acting_choices(own) else {}  # which every support leaves free
    solved = {"method", "modes", "elements", "restitution", "motion_seconds", "motion_links", "restitution_model"}
    for choice in set(acting_choices(own)) - solved - {"scene", "bodies", "tilt_way"}:
        parameter = Choices.param[choice]
        if isinstance(own[choice], str):
            other = next(value for value in parameter.objects if value != own[choice])
        else:
            low, high = parameter.bounds
            other = max(min(own[choice] * 1.1 + 1e-3, high), low) if own[choice] < high else 0.9 * high
        assert chosen_scene(own | {choice: other}) != chosen_scene(own), choice


def test_what_does_not_act_changes_nothing():
    own = own_choices("fixed-rod")
    for choice, value in (("place", 0.3), ("support", "free-free"), ("friction", 1.0), ("hertz_stiffness", 1e9)):
        assert choice not in acting_choices(own)
        assert chosen_scene(own | {choice: value}) == chosen_scene(own)


def test_a_mechanism_that_moves_on_has_a_restitution_only_without_a_law():
    own = own_choices("four-bar-moves")
    assert "restitution" in acting_choices(own) and "motion_seconds" in acting_choices(own)
    assert "restitution" not in acting_choices(own | {"law": "hertz"})
    assert "motion_seconds" not in acting_choices(own | {"method": "modal"})
    assert solvers.load("four-bar-moves").method["name"] == "multibody"
