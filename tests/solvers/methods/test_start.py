"""What is assumed of a mechanism before the impact where its drives leave it open, and that it is said."""

import pytest
from pytest import approx

import solvers
from solvers import Scene
from tests.catalog import SCENES

HANGING = {  # two bars of 1 kg and 0.4 m, the lower one struck at its end
    "impactor": {"kind": "mass", "mass": 0.5, "velocity": 4.0},
    "target": {
        "kind": "mechanism",
        "links": [
            {"name": "upper", "from": [0.0, 0.0], "to": [0.0, -0.4], "mass": 1.0},
            {"name": "lower", "from": [0.0, -0.4], "to": [0.0, -0.8], "mass": 1.0},
        ],
        "joints": [
            {"kind": "revolute", "links": ["ground", "upper"], "at": [0.0, 0.0]},
            {"kind": "revolute", "links": ["upper", "lower"], "at": [0.0, -0.4]},
        ],
        "drives": [{"joint": 0, "speed": 2.0, "initial": True}],
        "struck": {"link": "lower", "at": 1.0, "normal": [1.0, 0.0]},
    },
    "method": {"name": "rigid", "restitution": 0.0},
}
AT_REST = [*HANGING["target"]["drives"], {"joint": 1, "speed": 0.0, "initial": True}]


def said(scene: Scene, method: str | None = None) -> list:
    solution = solvers.solve(scene) if method is None else solvers.solve(scene, method, duration=1e-3)
    return [note for note in solution.notes if note.code == "start-open"]


@pytest.mark.parametrize("method", ["rigid", "multibody"])
def test_a_joint_that_no_drive_settles_is_named_with_what_is_assumed(method):
    """The lower bar starts at -3 rad/s, by the least kinetic energy: the impulse is twice what it would be at rest."""
    scene = Scene.from_table(HANGING)
    (note,) = said(scene, method)
    assert note.severity == "warning" and note.values["rate"] == approx(-3.0 - 2.0, rel=1e-12)
    assert note.values | {"rate": 0.0} == {
        "settled": 1, "freedoms": 2, "joint": 1, "links": ["upper", "lower"], "slides": False, "rate": 0.0,
        "count": 1, "joints": ["1"],
    }  # fmt: skip
    assert solvers.solve(scene).impulse == approx(0.811, abs=5e-4)


def test_the_drive_that_the_note_asks_for_settles_it():
    scene = Scene.from_table(HANGING).replace({"target.drives": AT_REST})
    assert said(scene) == [] and solvers.solve(scene).impulse == approx(0.442, abs=5e-4)


def test_a_slide_is_told_by_its_speed():
    """A carriage on rails with a bar on it that a drive turns: the carriage yields to it."""
    table = HANGING["target"] | {
        "joints": [
            {"kind": "prismatic", "links": ["ground", "upper"], "at": [0.0, 0.0], "axis": [1.0, 0.0]},
            {"kind": "revolute", "links": ["upper", "lower"], "at": [0.0, -0.4]},
        ],
        "drives": [{"joint": 1, "speed": 2.0, "initial": True}],
    }
    (note,) = said(Scene.from_table(HANGING | {"target": table}))
    assert note.values["slides"] and note.values["joints"] == ["0"]
    # a carriage of mass m and a bar of mass m with its centre 0.2 m below: momentum along the rails is zero
    assert abs(note.values["rate"]) == approx(0.2 * 2.0 / 2.0, rel=1e-12)


def test_links_in_flight_have_no_joint_to_settle():
    table = HANGING["target"] | {"joints": [HANGING["target"]["joints"][1]], "drives": AT_REST[:1]}
    (note,) = said(Scene.from_table(HANGING | {"target": table}))
    assert note.values == {"settled": 1, "freedoms": 4, "count": 0} and str(note).endswith("least kinetic energy.")


def test_what_stands_still_or_is_settled_needs_no_word():
    still = HANGING["target"] | {"drives": [{"joint": 0, "speed": 0.0}]}
    assert said(Scene.from_table(HANGING | {"target": still})) == []
    for name in ("four-bar", "slider-crank", "double-pendulum", "trip-hammer", "rotating-bar"):
        assert SCENES[name].struck.target.open_start is None, name
