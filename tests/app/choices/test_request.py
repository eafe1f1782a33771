"""What is asked to be solved is decoded once from the choices."""

from dataclasses import FrozenInstanceError

import pytest

from app.choices.choices import Choices
from app.choices.request import Request
from app.choices.scene_of import choices_of
from app.text.refusals import Refused


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
