"""A point of the map of regimes becomes choices with which the scene lies there."""

import pytest

from app.choices.choices import Choices, accepts
from app.choices.map_point import choices_at
from app.choices.scene_of import choices_of, chosen_scene
from solvers import plan


def asked(scene, point, **changes):
    return Choices(**choices_of(scene) | {"scene": scene} | changes).chosen() | {"map_point": point}


@pytest.mark.parametrize(
    "scene, changes",
    [
        ("fixed-rod", {}),
        ("fixed-rod", {"law": "hertz"}),
        ("bronze-rod-steel-ball", {"speed": 7.0}),
        ("free-rod", {"law": "hunt-crossley", "restitution": 0.5}),
        ("hammer-on-cantilever", {"law": "hertz"}),
    ],
)
@pytest.mark.parametrize("time, ratio", [(0.3, 2.5), (3.0, 0.02)])
def test_the_scene_lies_where_the_visitor_wanted(scene, changes, time, ratio):
    given = asked(scene, f"{time} {ratio}", **changes)
    wanted = choices_at(given)
    assert all(accepts(name, value) for name, value in wanted.items())
    chosen = {name: value for name, value in (given | wanted).items() if name != "map_point"}
    groups = plan(chosen_scene(chosen)).groups
    assert groups["mass_ratio"] == pytest.approx(ratio, rel=1e-3)
    assert groups["contact_time"] == pytest.approx(time, rel=1e-3)


def test_beside_the_map_the_contact_is_rigid():
    assert choices_at(asked("fixed-rod", "0 4", law="hertz")) == {"mass_ratio": 4.0, "law": "rigid"}


def test_beyond_the_sliders_the_nearest_is_chosen():
    wanted = choices_at(asked("fixed-rod", "1e-9 1e9", law="linear"))
    assert wanted == {"mass_ratio": 1e3, "law": "linear", "linear_stiffness": 1e14}
    assert choices_at(asked("fixed-rod", "1e9 1", law="hertz"))["hertz_stiffness"] == 1e6


@pytest.mark.parametrize("point", ["", "1", "1 2 3", "e e", "-1 1", "1 0", "1 1e999"])
def test_what_is_no_point_is_refused(point):
    with pytest.raises(
        ValueError, match=r"Place on the map: got .*; allowed: a contact time, 0 or more, and a mass ratio"
    ):
        choices_at(asked("fixed-rod", point))


def test_a_scene_without_a_map_has_no_points():
    with pytest.raises(ValueError, match="allowed: a scene that lies on a map"):
        choices_at(asked("two-unequal-rods", "1 1"))
