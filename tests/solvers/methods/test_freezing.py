"""Mechanisms that keep their configuration while they are struck: where their energy is, and what that leaves out."""

import numpy as np
import pytest
from pytest import approx
from scipy.integrate import solve_ivp

from solvers import Modal, RigidImpulse, Scene
from solvers.methods.multibody.method import Multibody
from tests.solvers.bodies.linkage.mechanisms import closes, four_bar

HERTZ = {"law": "hertz", "stiffness": 1e9}


@pytest.mark.parametrize("driven", [False, True])
def test_the_energy_in_links_is_that_of_their_velocities(driven):
    """By gravity and by drives alike, what the shares say is what moves: 1/2 m v^2 + 1/2 I w^2 of every link."""
    tables = four_bar(0, initial=not driven, contact=HERTZ, **{"target.gravity": [3.0, -9.81]}).table()
    for method in (Modal(estimate=False), Multibody(estimate=False)):
        found = method.solve(Scene.from_table(tables), duration=5e-3)
        moved = 0.0
        for link in found.scene.target.links:
            swift = found.links[link.name]
            moved += 0.5 * link.mass * float(np.dot(swift["final_velocity"], swift["final_velocity"]))
            moved += 0.5 * link.inertia * swift["final_spin"] ** 2
        assert found.energy["target_rigid"] == approx(moved, rel=1e-9)
        assert closes(found, 1e-6)


def test_what_falls_while_it_is_struck_has_the_energy_of_its_fall():
    """A ram of 2 kg struck upwards by 1 kg, for 0.2 s; found with the drives paying for the fall."""
    ram = {"name": "ram", "from": [0.0, 0.0], "to": [0.0, -0.1], "mass": 2.0}
    joint = {"kind": "prismatic", "links": ["ground", "ram"], "at": [0.0, -0.05], "axis": [0.0, 1.0]}
    target = {"kind": "mechanism", "links": [ram], "joints": [joint], "gravity": [0.0, -9.80665]}
    target["struck"] = {"link": "ram", "at": 0.0, "normal": [0.0, -1.0]}
    tables = {"impactor": {"mass": 1.0, "velocity": 1.0}, "target": target}
    found = Modal().solve(Scene.from_table(tables | {"contact": {"law": "linear", "stiffness": 1e3}}), 0.2)
    swift, impulse = 2.0 / 3.0 + 9.80665 * 0.2, 4.0 / 3.0  # both fall as much, so that the collision is as without
    assert found.impulse == approx(impulse, rel=1e-9)
    assert found.energy["target_rigid"] == approx(swift**2, rel=1e-6) and found.energy["drives"] == 0.0
    assert found.energy["weight"] == approx(0.5 * (1.0 / 3.0 - 9.80665 * 0.2) ** 2 * -1.0 + 0.5 - swift**2, rel=1e-6)


def test_links_that_turn_too_far_are_said_to_be_off():
    """Solved as it stands at first for as long as the crank takes for half a turn."""
    for duration, late in ((0.03, False), (0.6, True)):
        found = Modal(estimate=False).solve("four-bar-moves", duration=duration)
        (note,) = [note for note in found.notes if note.code == "configuration-frozen"]
        assert note.values["late"] is late
        assert closes(found, 0.0)
    assert note.severity == "warning" and note.values["whole"] == 100.0


def on_spring(swings: float, kind: str) -> tuple[Scene, float, float]:
    """A bar that a mass strikes by a linear law, joined to the ground by a spring on which it swings by so many radians
    [rad] in the time of contact; what is felt of it where it is struck [kg], and the stiffness there [N/m]."""
    bar = {"name": "bar", "from": [0.0, 0.0], "to": [0.6, 0.0], "mass": 1.5}
    felt, arm = (1.5 * 0.36 / 3.0 / 0.16, 0.4) if kind == "revolute" else (1.5, 1.0)
    lasts = np.pi * np.sqrt(1.0 / (1.0 / 0.5 + 1.0 / felt) / 1e6)
    stiffness = felt * (swings / lasts) ** 2
    joint = {"kind": kind, "links": ["ground", "bar"], "at": [0.0, 0.0]}
    target = {
        "kind": "mechanism",
        "links": [bar],
        "joints": [joint | ({"axis": [0.0, 1.0]} if kind == "prismatic" else {})],
        "springs": [{"joint": 0, "stiffness": stiffness * arm**2}],
        "struck": {"link": "bar", "at": 0.4 / 0.6, "normal": [0.0, 1.0]},
    }
    given = {
        "impactor": {"mass": 0.5, "velocity": 2.0},
        "target": target,
        "contact": {"law": "linear", "stiffness": 1e6},
    }
    return Scene.from_table(given), felt, stiffness


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_what_springs_would_change_is_said_and_is_as_much(kind):
    """Against both bodies with the spring, integrated: the velocity of the struck point is off by what the note says,
    to first order in the stiffness, which goes with (w t)^2; the contact makes a tenth of it good."""
    said, found = [], []
    for swings in (0.05, 0.1, 0.2):
        scene, felt, stiffness = on_spring(swings, kind)
        solution = Modal(estimate=False).solve(scene)
        (note,) = [note for note in solution.notes if note.code == "springs-left-out"]
        end = solution.contacts[-1].end

        def rates(_, state, felt=felt, stiffness=stiffness):
            x, y, v, w = state
            push = 1e6 * max(x - y, 0.0)
            return [v, w, -push / 0.5, (push - stiffness * y) / felt]

        state = solve_ivp(rates, (0.0, end), [0.0, 0.0, 2.0, 0.0], rtol=1e-11, atol=1e-14).y[:, -1]
        struck = float(solution.motion.end_velocity(np.array([end]))[0])
        said.append(note.values["error"] / 100.0)
        found.append((struck - state[3]) / scene.speed)
        assert note.severity == ("remark" if said[-1] <= 0.01 else "warning")
        assert said[-1] == approx((0.25 - 1.0 / np.pi**2) * swings**2 * struck / scene.speed, rel=1e-3)
    assert np.diff(np.log2(said)) == approx([2.0, 2.0], abs=0.01)
    assert np.all(np.array(found) < said) and found == approx(said, rel=0.12)


def test_springs_that_are_held_or_not_there_are_no_note():
    scene = on_spring(0.1, "revolute")[0]
    for changes in ({"target.springs": []}, {"target.drives": [{"joint": 0, "speed": 0.0}]}):
        found = Modal(estimate=False).solve(scene.replace(changes))
        assert not [note for note in found.notes if note.code == "springs-left-out"]
    assert not [note for note in RigidImpulse().solve(scene).notes if note.code == "springs-left-out"]
