"""The method `multibody`: impacts and the motion between them, against closed forms and against the frozen impact."""

import numpy as np
import pytest
from pytest import approx
from scipy.special import ellipk

import solvers
from solvers import RigidImpulse, Scene, SceneError, SceneNotSupported
from solvers.methods.multibody.method import Multibody
from solvers.text.notes import Severity
from tests.catalog import SCENES
from tests.solvers.bodies.linkage.mechanisms import four_bar


@pytest.mark.parametrize("initial", [False, True])
def test_the_first_impact_is_that_of_the_frozen_mechanism(initial):
    scene = four_bar(0, initial)
    still, moving = RigidImpulse().solve(scene), Multibody().solve(scene, 0.01)
    assert moving.contacts[0].impulse == approx(still.impulse, rel=1e-11)
    for one, other in zip(still.reactions, moving.reactions, strict=True):
        assert other["impulse"] == approx(one["impulse"], abs=1e-10)
        assert other["moment_impulse"] == approx(one["moment_impulse"], abs=1e-10)
    after = moving.motion.link_rates(0.0)
    for name, link in still.links.items():
        assert after[name]["final_spin"] == approx(link["final_spin"], abs=1e-10)
        assert after[name]["final_velocity"] == approx(link["final_velocity"], abs=1e-10)


def test_a_pendulum_swings_with_its_exact_period():
    """Struck so that it swings to 2 rad: T = 4 sqrt(I / m g d) K(sin 1)."""
    scene = SCENES["compound-pendulum"]
    inertia, weight = 1.5 * 0.36 / 3.0, 1.5 * 9.81 * 0.3
    spin = 2.0 * np.sin(1.0) * np.sqrt(weight / inertia)
    impulse = inertia * spin / 0.4
    felt = inertia / 0.16
    scene = scene.replace({"impactor.velocity": impulse / 1.8 * (1.0 / 0.2 + 1.0 / felt)})
    period = 4.0 * np.sqrt(inertia / weight) * ellipk(np.sin(1.0) ** 2)
    found = Multibody(restitution=0.8, steps=400).solve(scene, period)
    angles = found.motion.coordinates(found.motion.time)[:, 2] + 0.5 * np.pi
    assert len(found.contacts) == 1  # the mass has fallen below the bar when that comes back
    assert np.abs(angles).max() == approx(2.0, rel=1e-4)
    assert angles[-1] == approx(0.0, abs=2e-8)
    assert found.diagnostics["energy_drift"] < 1e-9


def test_a_ball_bounces_on_what_stands_still_as_on_a_floor():
    """On a driven crank at rest: flights of 2 v / g, each slower by the restitution."""
    table = {
        "impactor": {"kind": "mass", "mass": 1.0, "velocity": 2.0},
        "target": {
            "kind": "mechanism",
            "gravity": [0.0, -10.0],
            "links": [{"name": "bar", "from": [-1.0, 0.0], "to": [1.0, 0.0], "mass": 1.0}],
            "joints": [{"links": ["ground", "bar"], "at": [0.0, 0.0]}],
            "drives": [{"joint": 0, "speed": 0.0}],
            "struck": {"link": "bar", "at": 0.75, "normal": [0.0, -1.0]},
        },
    }
    found = Multibody(restitution=0.5).solve(Scene.from_table(table), 0.36)
    assert [contact.start for contact in found.contacts] == approx([0.0, 0.2, 0.3, 0.35], abs=1e-13)
    assert [contact.impulse for contact in found.contacts] == approx([3.0, 1.5, 0.75, 0.375], rel=1e-12)
    assert found.energy["dissipated"] == approx(2.0 * (1.0 - 0.25**4), rel=1e-12)
    assert found.reactions[0]["impulse"] == approx([0.0, 5.625], abs=1e-12)
    assert found.reactions[0]["moment_impulse"] == approx(0.5 * 5.625, rel=1e-12)
    # they come to an end at 0.4 s, and the ball rests on the bar
    endless = Multibody(restitution=0.5, steps=1000).solve(Scene.from_table(table), 1.0)
    assert endless.contacts[-1].start == approx(0.4, abs=1e-3) and endless.contacts[-1].end == approx(1.0)
    assert endless.impulse == approx(2.0 + 10.0, rel=1e-6)
    assert abs(endless.impactor_velocity) < 1e-12 and abs(endless.diagnostics["energy_error"]) < 1e-12


def test_what_passes_beside_a_link_does_not_strike_it():
    scene = SCENES["compound-pendulum"].replace({"target.struck.at": 1.0, "target.gravity": [0.0, 0.0]})
    found = Multibody(restitution=1.0).solve(scene.replace({"impactor.mass": 5.0}), 4.0)
    assert len(found.contacts) == 1  # slower than the tip, it meets the line of the bar beyond its end


def test_a_mass_that_falls_past_the_end_of_a_link_is_told():
    """Struck endwise a piston has a face of a hundredth of its length: with weight the mass is not there any more."""
    scene = SCENES["slider-crank"].replace({"impactor.mass": 5.0, "impactor.velocity": 2.0})
    contacts = {}
    for gravity in (0.0, -1.0, -9.81):
        found = Multibody(restitution=0.5).solve(scene.replace({"target.gravity": [0.0, gravity]}), 0.5)
        contacts[gravity] = len(found.contacts)
        told = [note for note in found.notes if note.code == "passes-link"]
        assert len(told) == (gravity < 0.0)
        for note in told:
            assert (note.severity, note.values["link"], note.values["endwise"]) == (Severity.WARNING, "piston", True)
            fallen = 0.5 * abs(gravity) * note.values["time"] ** 2
            assert note.values["apart"] == approx(fallen - 0.01 * 0.02, rel=1e-9)
    assert contacts == {0.0: 3, -1.0: 1, -9.81: 1}


@pytest.mark.parametrize("name", ["double-pendulum", "bouncing-on-piston", "four-bar-moves"])
def test_what_leaves_a_link_is_not_said_to_pass_it(name):
    assert "passes-link" not in [note.code for note in solvers.solve(SCENES[name]).notes]


def test_a_ball_on_a_driven_piston():
    found = solvers.solve(SCENES["bouncing-on-piston"])
    assert len(found.contacts) > 5
    assert found.diagnostics["constraint_error"] < 1e-13  # its angle is some 80 rad
    assert found.diagnostics["energy_drift"] < 1e-7
    times, impulses = found.motion.impulses
    before = found.motion.end_velocity(times, after=False)
    assert np.all(impulses > 0.0) and np.ptp(before) > 0.1  # met in another phase each time
    flights = found.motion.link_points(np.array([0.0, 1.0]), 2)["rod"]
    assert np.hypot(*(flights[:, 0] - flights[:, -1]).T) == approx(np.full(2, 0.06), rel=1e-6)


def test_reactions_over_time_are_the_weight_at_rest():
    scene = SCENES["compound-pendulum"].replace({"impactor.velocity": 1e-6})
    found = Multibody().solve(scene, 0.5)
    assert found.motion.reaction_forces(np.array([0.2]))[0, 0] == approx([0.0, 1.5 * 9.81, 0.0], abs=1e-4)


def test_what_it_cannot_follow_is_refused():
    rod = {"kind": "rod", "length": 0.3, "section": {"area": 1e-4}, "material": "steel", "velocity": 0.0}
    for scene, code in (
        (SCENES["fixed-rod"], "no-mechanism"),
        (four_bar(impactor=rod), "mass-on-mechanism"),
    ):  # fmt: skip
        with pytest.raises(SceneNotSupported) as refused:
            solvers.solve(scene, method="multibody")
        assert refused.value.reason.code == f"refusals.{code}"
    with pytest.raises(SceneError):
        solvers.solve(four_bar(), method="multibody", restitution=2.0)


def test_links_on_springs_swing_as_oscillators_do():
    """A bar on a torsion spring, and a bar on a spring along its guide: struck, each comes back after half a period."""
    bar = {"name": "bar", "from": [0.0, 0.0], "to": [0.3, 0.0], "mass": 1.2}
    turning = {
        "kind": "mechanism",
        "links": [bar],
        "joints": [{"links": ["ground", "bar"], "at": [0.0, 0.0]}],
        "springs": [{"joint": 0, "stiffness": 5.0}],
        "struck": {"link": "bar", "at": 1.0, "normal": [0.0, 1.0]},
    }
    sliding = turning | {
        "joints": [{"kind": "prismatic", "links": ["ground", "bar"], "at": [0.0, 0.0], "axis": [0.0, 1.0]}],
        "springs": [{"joint": 0, "stiffness": 200.0}],
    }
    for target, frequency, place in (
        (turning, np.sqrt(5.0 / (1.2 * 0.09 / 3.0)), 2),
        (sliding, np.sqrt(200.0 / 1.2), 1),
    ):
        scene = Scene.from_table({"impactor": {"mass": 0.05, "velocity": 1.0}, "target": target})
        assert Scene.from_table(scene.table()).target == scene.target
        found = Multibody(steps=200).solve(scene, 0.75 * 2.0 * np.pi / frequency)
        after = found.motion.course.rates[1, place]
        times = found.motion.time[2:]
        moved = found.motion.coordinates(times)[:, place] - found.motion.coordinates(np.zeros(1))[0, place]
        expected = after / frequency * np.sin(frequency * times)
        assert moved == approx(expected, abs=1e-9 * np.abs(expected).max())
        assert found.diagnostics["energy_drift"] < 1e-9 and found.energy["springs"] > 0.0


def test_a_drive_past_a_dead_point_ends_the_solution_and_says_so():
    """The coupler and the rocker are straight, and the crank is driven on."""
    links = [
        {"name": "crank", "from": [0.0, 0.0], "to": [0.0, 0.5], "mass": 1.0},
        {"name": "coupler", "from": [0.0, 0.5], "to": [0.3, 0.5], "mass": 1.0},
        {"name": "rocker", "from": [0.3, 0.5], "to": [0.6, 0.0], "mass": 1.0},
    ]
    places = [["ground", "crank"], ["crank", "coupler"], ["coupler", "rocker"], ["ground", "rocker"]]
    at = [[0.0, 0.0], [0.0, 0.5], [0.3, 0.5], [0.6, 0.0]]
    target = {
        "kind": "mechanism",
        "links": links,
        "joints": [{"links": pair, "at": place} for pair, place in zip(places, at, strict=True)],
        "drives": [{"joint": 0, "speed": 5.0}],
        "struck": {"link": "coupler", "at": 0.5, "normal": [0.0, -1.0]},
    }
    scene = Scene.from_table({"impactor": {"mass": 1.0, "velocity": 5.0}, "target": target})
    found = Multibody().solve(scene, 0.5)
    reach = 0.3 + np.hypot(0.3, 0.5)  # of coupler and rocker, from the crank's end to the ground at 0.6
    turned = 0.5 * np.pi + 5.0 * found.duration
    tip = 0.5 * np.array([np.cos(turned), np.sin(turned)])
    assert np.hypot(*(tip - [0.6, 0.0])) == approx(reach, rel=2e-2)
    assert [note.severity for note in found.notes if note.code == "joints-open"] == [Severity.INVALID]
    assert found.diagnostics["constraint_error"] < 1e-6 and found.diagnostics["estimated_error"] is None
    assert np.isfinite(found.impactor_velocity)


def test_links_that_an_impact_makes_fast_are_followed_in_more_steps():
    def spins(**options):
        found = Multibody(**options).solve(fast, 0.5)
        return found, [link["final_spin"] for link in found.links.values()]

    ends = [[0.0, 0.0], [-0.254, 0.476], [-0.138, 0.375], [-0.045, 0.089]]
    names = ["ground", "a", "b", "c", "ground"]
    target = {
        "kind": "mechanism",
        "gravity": [0.0, -9.81],
        "links": [
            {"name": name, "from": start, "to": end, "mass": mass}
            for name, start, end, mass in zip("abc", ends, ends[1:], [0.43, 1.28, 0.84], strict=False)
        ],
        "joints": [{"links": names[k : k + 2], "at": end} for k, end in enumerate(ends)],
        "struck": {"link": "b", "at": 0.856, "normal": [-0.658, -0.753]},
        "springs": [{"joint": 0, "stiffness": 2.5}],
    }
    law = {"law": "power", "stiffness": 1.7e5, "exponent": 1.47}
    fast = Scene.from_table({"impactor": {"mass": 3.1, "velocity": 9.2}, "target": target, "contact": law})
    found, usual = spins()
    _, finer = spins(steps=40_000)
    assert found.diagnostics["energy_drift"] < 1e-5 and usual == approx(finer, rel=1e-3)
    assert "energy-drifts" not in [note.code for note in found.notes]
    coarse, _ = spins(steps=500)
    assert {"energy-drifts", "joints-open"} & {note.code for note in coarse.notes}
    assert np.isfinite(list(coarse.energy.values())).all()
