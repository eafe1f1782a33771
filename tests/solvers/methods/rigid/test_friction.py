"""The method `rigid` with friction: energy, the three models, and where it jams."""

import json

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene, SceneError
from tests.catalog import SCENES
from tests.solvers.methods.rigid.scenes import BODIES, STRUCK, with_value

RUBBING = [name for name, scene in SCENES.items() if scene.friction]


@pytest.mark.parametrize("model", ["stronge", "poisson", "newton"])
@pytest.mark.parametrize("name", RUBBING)
def test_scenes_with_friction(name, model):
    """The parts of the energy add up, the impulse is on the target, and the other models stand beside it."""
    scene = SCENES[name]
    solution = solvers.solve(scene, model=model)
    written = json.loads(json.dumps(solution.table(), allow_nan=False))
    assert written["method"]["model"] == model
    energy = written["energy"]
    assert sum(energy.values()) == approx(2.0 * energy["initial"], rel=1e-14)
    push = np.array(written["impulse"])
    gained = scene.impactor.mass * (np.array(scene.impactor.velocity) - written["impactor"]["final_velocity"])
    assert push == approx(gained, rel=1e-12, abs=1e-14)
    pressed = push @ scene.normal
    assert np.linalg.norm(push - pressed * np.array(scene.normal)) <= scene.friction * pressed * (1.0 + 1e-12)
    assert written["sliding"][-1]["until"] == approx(pressed, rel=1e-14)
    for part in ("impulse", "impactor", "restitution"):
        assert written["models"][model][part] == written[part]
    assert written["models"]["stronge"]["restitution"]["energetic"] == approx(scene.method["restitution"], rel=1e-12)
    assert written["models"]["poisson"]["restitution"]["poisson"] == approx(scene.method["restitution"], rel=1e-12)
    parts = scene.method["restitution"] if scene.speed else None
    assert written["models"]["newton"]["restitution"]["newton_at_contact"] == (parts and approx(parts))
    assert Scene.from_table(scene.table()) == scene


def test_the_scenes_show_what_their_notes_say():
    """Painlevé's rod jams; the ball turns back at 2/7; the brick's sliding turns by half a circle."""
    rod, ball, brick = (solvers.solve(SCENES[name]) for name in ("painleve-rod", "spinning-ball", "brick-on-floor"))
    (jams,) = rod.notes
    assert jams.code == "friction-jams" and "Painlevé's paradox" in str(jams)
    assert (jams.values["least"], jams.values["friction"]) == approx((4.0 / 3.0, 1.6), rel=1e-12)
    assert [each.kind for each in rod.sliding] == ["slip", "stick"]
    assert rod.sliding[0].until == approx(1.5 / (1.6 * 3.4 - 1.2), rel=1e-12)  # u / (friction t W t - n W t)
    assert not solvers.solve(SCENES["painleve-rod"].replace({"contact.friction": 1.3})).notes
    assert ball.impulse == approx((2.0 / 7.0 * 0.1 * 4.6, -0.54, 0.0), rel=1e-12, abs=1e-15)
    assert ball.impactor_velocity[0] < 0.0
    assert [each.kind for each in brick.sliding] == ["slip"]
    body = brick.scene.impactor
    before, after = (
        np.add(velocity, np.cross(body.centre, spin))[:2]
        for velocity, spin in ((body.velocity, body.spin), (brick.impactor_velocity, brick.impactor_spin))
    )
    assert before @ after < -0.9 * np.linalg.norm(before) * np.linalg.norm(after)


def test_a_rod_that_only_slides_is_thrown_up_above_the_friction_at_which_it_jams():
    """Painlevé's impact without approach; below 4/3 and at rest nothing happens, and a note says from where on."""
    scene = SCENES["painleve-sliding"]
    thrown, slow = solvers.solve(scene), solvers.solve(scene.replace({"impactor.velocity": [-1.5, -1e-9, 0.0]}))
    assert scene.speed == 0.0 and thrown.contacts[0].impulse == approx(-thrown.impulse[1])
    assert thrown.impulse == approx(slow.impulse, rel=1e-8, abs=1e-12)
    assert thrown.impactor_velocity[1] > 0.5 and thrown.energy["impactor"] < thrown.energy["initial"]
    assert [each.kind for each in thrown.sliding] == ["slip", "stick"]
    assert thrown.restitution["newton_at_contact"] is None and thrown.restitution["energetic"] == approx(0.5, rel=1e-12)
    (note,) = thrown.notes
    assert (note.code, note.severity) == ("impact-without-approach", "warning")
    assert note.values["friction"] == approx(4.0 / 3.0, rel=1e-12)
    for friction, rises, codes in (
        (1.33, 0.0, ["no-impact", "slides-on"]),
        (1.6, 1e-9, ["no-impact"]),
    ):
        still = solvers.solve(scene.replace({"contact.friction": friction, "impactor.velocity": [-1.5, rises, 0.0]}))
        assert still.impulse == (0.0, 0.0, 0.0) and [note.code for note in still.notes] == codes
        assert still.impactor_velocity == (-1.5, rises, 0.0)
    rests = solvers.solve(scene.replace({"impactor.velocity": [0.0, 0.0, 0.0]}))
    assert not rests.contacts and [note.code for note in rests.notes] == ["no-impact"]


def test_where_newtons_law_makes_energy_it_says_so():
    scene = SCENES["brick-on-floor"].replace({"method.restitution": 1.0})
    beside, chosen = solvers.solve(scene), solvers.solve(scene, model="newton")
    for solution, severity in ((beside, "remark"), (chosen, "warning")):
        (note,) = solution.notes
        assert (note.code, note.severity) == ("friction-makes-energy", severity)
        assert note.values["energy"] == approx(chosen.energy["impactor"] - chosen.energy["initial"], rel=1e-12)
    assert "model 'stronge'" in str(chosen.notes[0])
    assert beside.energy["impactor"] < beside.energy["initial"]


def slanting(model: str) -> Scene:
    """A ball-like body whose centre stands aside of the floor's normal; its sliding stops during the impact."""
    body = {"kind": "body", "mass": 1.0, "inertia": [1.0 / 12.0] * 3, "centre": [0.3, 0.4, 0.0]}
    return Scene.from_table(
        {
            "impactor": body | {"velocity": [-2.0, -1.0, 0.0], "spin": [0.0, 0.0, 1.0]},
            "target": {"kind": "stop"},
            "contact": {"normal": [0.0, -1.0, 0.0], "friction": 0.9},
            "method": {"name": "rigid", "restitution": 1.0, "model": model},
        }
    )


def test_where_by_poisson_the_normal_force_makes_energy_that_friction_takes_it_says_so():
    """A plane impact in two straight parts: compression and restitution by another give of the bodies."""
    found, strict = (solvers.solve(slanting(model)) for model in ("poisson", "stronge"))
    (note,) = found.notes
    assert (note.code, note.severity) == ("normal-force-makes-energy", "warning")
    assert note.values["share"] == approx(-found.energy["dissipated"] / found.energy["initial"], rel=1e-12)
    assert found.energy["dissipated"] < 0.0 < found.energy["friction"] + found.energy["dissipated"]
    assert strict.energy["dissipated"] == approx(0.0, abs=1e-12) and strict.notes == []


def test_friction_of_nothing_is_no_friction():
    plain = solvers.solve(SCENES["note-rod"])
    for model in ("stronge", "poisson", "newton"):
        found = solvers.solve(SCENES["note-rod"].replace({"contact.friction": 0.0}), model=model)
        assert found.impulse == approx((-plain.impulse, 0.0, 0.0), rel=1e-12, abs=0.0)
        assert found.target_spin == approx(plain.target_spin, rel=1e-12)
        assert found.energy["friction"] == approx(0.0, abs=1e-15)


def test_bodies_with_friction_that_move_apart_do_not_meet():
    found = solvers.solve(SCENES["note-rod-friction"].replace({"impactor.velocity": [3.0, 1.0, 0.0]}))
    assert found.impulse == (0.0, 0.0, 0.0) and found.sliding == [] and found.contacts == []
    assert set(found.restitution.values()) == {None}
    json.dumps(found.table(), allow_nan=False)


def test_friction_may_not_turn_a_needle_about_its_axis():
    """Along its normal the impact would not; across it would, and nothing resists."""
    tables = with_value("target.centre", [0.0, -0.6, 0.0])
    tables["impactor"] |= {"inertia": [0.0, 0.1, 0.1], "centre": [0.3, 0.2, 0.0]}
    tables["contact"]["normal"] = [-1.0, 0.0, 0.0]
    Scene.from_table(tables)
    tables["contact"]["friction"] = 0.3
    with pytest.raises(SceneError) as refused:
        Scene.from_table(tables)
    assert refused.value.key == "impactor.inertia"


def test_bodies_on_an_axis_know_no_friction():
    with pytest.raises(SceneError) as refused:
        Scene.from_table({"impactor": BODIES["sphere"], "target": STRUCK["mass"], "contact": {"friction": 0.3}})
    assert refused.value.key == "contact.friction"
