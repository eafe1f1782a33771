"""Mechanisms that strike: the same impacts as those in which they are struck, closed forms, fields, balances."""

import copy
import json

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Modal, RigidImpulse, Scene, SceneError
from tests.catalog import SCENES

HAMMER = SCENES["trip-hammer"]
ARM = HAMMER.table()["impactor"]


def arm(**changes) -> dict:
    """The bar of the trip hammer, 3.5 kg and 0.5 m, its head at 2 m/s; rigid unless it is given modes."""
    table = copy.deepcopy(ARM) | changes
    for link in table["links"]:
        for key in ("modes", "shapes", "theory"):
            link.pop(key, None)
    table.pop("gravity", None)
    return table


def striking(target: dict, impactor: dict | None = None, **contact) -> Scene:
    contact = contact or {"law": "rigid"}
    return Scene.from_table({"impactor": arm() if impactor is None else impactor, "target": target, "contact": contact})


def other_way(scene: Scene) -> Scene:
    """Written by hand as the target that is struck along the line from the other side."""
    table = scene.table()
    mechanism, body = copy.deepcopy(table["impactor"]), dict(table["target"])
    mechanism["struck"]["normal"] = [0.0 - each for each in mechanism["struck"]["normal"]]
    body["velocity"] = 0.0 - body.get("velocity", 0.0)
    return Scene.from_table(table | {"impactor": body, "target": mechanism})


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_a_swinging_bar_is_a_third_of_its_mass(restitution):
    """(9.4): J = (1 + e) m M / (m + M) v, M = I0 / L^2 = m_bar / 3; the pivot gives half of J the same way."""
    mass = 0.9
    scene = striking({"kind": "mass", "mass": mass, "velocity": 0.5})
    bar = scene.impactor.links[0].mass
    felt = bar / 3.0
    found = RigidImpulse(restitution).solve(scene)
    impulse = (1.0 + restitution) * mass * felt / (mass + felt) * 1.5
    assert (found.impulse, scene.speed) == (approx(impulse, rel=1e-13), approx(1.5, rel=1e-14))
    assert found.target_velocity == approx(0.5 + impulse / mass, rel=1e-13)
    head = 2.0 - impulse / felt
    assert found.impactor_velocity == approx(0.5 * head, rel=1e-12)  # of the middle of the bar
    assert found.links["arm"]["final_spin"] == approx(-head / 0.5, rel=1e-12)
    assert found.reactions[0]["impulse"] == approx([0.0, 0.5 * impulse], abs=1e-12)
    energy = found.energy
    assert energy["impactor"] == approx(0.5 * felt * head**2, rel=1e-12)
    assert energy["target_rigid"] == approx(0.5 * mass * found.target_velocity**2, rel=1e-12)
    lost = 0.5 * (1.0 - restitution**2) * mass * felt / (mass + felt) * 1.5**2
    assert energy["dissipated"] == approx(lost, abs=1e-13) and sum(energy.values()) == approx(2.0 * energy["initial"])


@pytest.mark.parametrize("method", ["modal", "balance", "rigid", "quasi-static", "auto"])
@pytest.mark.parametrize("target", ["mass", "rod"])
def test_it_is_the_impact_in_which_the_mechanism_is_struck(method, target):
    """By every method, with signs and names as in the scene; it is written and read as given."""
    scene = HAMMER if target == "rod" else HAMMER.replace({"target": {"kind": "mass", "mass": 0.9, "radius": 0.03}})
    assert Scene.from_table(scene.table()) == scene and scene.table()["impactor"]["kind"] == "mechanism"
    assert Scene.from_table(scene.struck.table()).target == scene.struck.target  # of a rod at rest, too
    assert scene.struck.struck is scene.struck and scene.struck.speed == approx(scene.speed, rel=1e-15)
    found, same = (solvers.solve(each, method) for each in (scene, other_way(scene)))
    assert found.scene is scene and found.contacts == same.contacts and found.impulse == same.impulse
    assert (found.impactor_velocity, found.target_velocity) == (-same.target_velocity, -same.impactor_velocity)
    assert found.reactions == same.reactions and found.links == same.links
    written, beside = (json.loads(json.dumps(each.table(), allow_nan=False)) for each in (found, same))
    assert written["target"]["final_velocity"] == -beside["impactor"]["final_velocity"]
    assert sum(written["energy"].values()) == approx(sum(beside["energy"].values()), rel=1e-12)
    assert written["energy"]["impactor"] == approx(
        beside["energy"]["target_rigid"] + beside["energy"]["target_vibration"], rel=1e-12
    )
    assert [note.code for note in found.notes] == [note.code for note in same.notes]
    assert abs(written["diagnostics"]["energy_error"]) < 1e-6


def test_histories_and_fields_are_those_of_what_is_struck():
    """The mean of the field of a rod is its mean velocity, from the impulse and its weight; energies add up."""
    found = Modal(estimate=False).solve(HAMMER)
    motion, end = found.motion, found.contacts[-1].end
    time, x = np.linspace(0.0, end, 4_001), np.linspace(0.0, 0.3, 401)
    some = time[::400]
    mean = np.trapezoid(motion.velocity(some, x), x, axis=1) / 0.3
    assert mean == approx(motion.rigid_velocity(some), abs=1e-12)
    weight = 9.81 * HAMMER.target.mass * some
    assert HAMMER.target.mass * motion.rigid_velocity(some) == approx(motion.impulse(some) + weight, abs=1e-9)
    middle = motion.displacement(time, x[200:201])[:, 0]
    speeds = motion.velocity(time, x[200:201])[:, 0]
    assert np.diff(middle) == approx(0.5 * np.diff(time) * (speeds[1:] + speeds[:-1]), abs=2e-9)
    assert np.abs(motion.stress(time, np.array([0.3]))).max() < 1e-6  # a free end
    assert motion.stress(some, x).max() > 1e6
    parts = motion.energies(some)
    assert np.sum(list(parts.values()), axis=0) == approx(found.energy["initial"], rel=1e-6)
    assert parts["target_vibration"].min() >= -1e-9 and parts["target_vibration"].max() > 0.01
    assert motion.face_velocity(np.zeros(1))[0] == approx(2.0, rel=1e-12)
    assert set(found.dataset().data_vars) > {"impactor_velocity", "end_velocity", "stress"}


def test_energy_and_momentum_as_it_moves_on():
    """By `multibody`, from a rigid arm to a mass: the first impulse is that of `rigid`, energy is kept."""
    scene = striking({"kind": "mass", "mass": 1.0})
    found = solvers.solve(scene, "multibody", restitution=0.7)
    assert found.contacts[0].impulse == approx(RigidImpulse(0.7).solve(scene).impulse, rel=1e-9)
    assert abs(found.diagnostics["energy_error"]) < 1e-9
    assert found.target_velocity > 0.0 and set(found.links) == {"arm"}


@pytest.mark.parametrize("method", ["rigid", "modal", "quasi-static"])
def test_a_stop_gives_all_back_and_is_the_limit_of_heavy_masses(method):
    """J = (1 + e) M v; the stop takes up nothing, and the pivot gives half of J; masses are off by M / m."""
    law = {"law": "linear", "stiffness": 1e7}
    scene = striking({"kind": "stop"}, **law)
    found, felt = solvers.solve(scene, method), scene.impactor.links[0].mass / 3.0
    assert Scene.from_table(scene.table()) == scene
    assert found.impulse == approx(4.0 * felt, rel=1e-7)  # the steps of `modal`
    assert found.links["arm"]["final_spin"] == approx(4.0, rel=1e-7)
    assert (found.target_velocity, found.energy["target_rigid"]) == (approx(0.0, abs=1e-12), 0.0)
    assert found.energy["impactor"] == approx(found.energy["initial"], rel=1e-7)
    assert found.reactions[0]["impulse"] == approx([0.0, 0.5 * found.impulse], rel=1e-6, abs=1e-9)
    for error in ("energy_error", "momentum_error"):
        assert abs(found.diagnostics[error]) < 1e-9
    for mass in (1e3, 1e6):
        heavy = solvers.solve(striking({"kind": "mass", "mass": mass}, **law), method)
        assert heavy.impulse / found.impulse - 1.0 == approx(-felt / (mass + felt), rel=1e-2)


def test_a_bar_that_bends_on_a_stop():
    """By its modes energy is kept, its momentum as a whole is the impulse, and errors are those of the bar, not of what
    stands still; the stop does not fall."""
    scene = HAMMER.replace({"target": {"kind": "stop"}, "contact": {"law": "linear", "stiffness": 1e7}})
    found = solvers.solve(scene)
    assert found.target_velocity == approx(0.0, abs=1e-9) and found.diagnostics["estimated_error"] > 1e-12
    time = np.linspace(0.0, found.duration, 50)
    assert np.abs(found.motion.end_position(time)).max() < 1e-9
    assert abs(found.diagnostics["energy_error"]) < 1e-9 and abs(found.diagnostics["momentum_error"]) < 1e-9
    errors = {
        point.label: point.errors["rebound"] for point in solvers.tradeoff(scene, fresh=True, seconds=60.0).points
    }
    assert abs(errors["modal modes=1"]) > 10.0 * abs(errors["modal modes=12"]) > 0.0
    for asked in (lambda: solvers.solve(scene, "balance"), lambda: solvers.stability(scene, ["modal"], grid=(2, 2))):
        with pytest.raises(SceneError, match="free to move"):
            asked()


def test_a_rod_that_is_held_stands_still_at_its_far_end():
    rod = HAMMER.table()["target"] | {"support": "fixed"}
    found = solvers.solve(striking(rod, law="hertz", stiffness=2e10), "modal")
    time = np.linspace(0.0, found.duration, 200)
    far, struck = found.motion.displacement(time, np.array([0.3, 0.0])).T
    assert np.abs(far).max() < 1e-3 * np.abs(struck).max() and np.abs(struck).max() > 1e-6
    assert found.energy["target_vibration"] > 0.01 and found.energy["target_rigid"] == 0.0
    assert abs(found.diagnostics["energy_error"]) < 1e-9 and found.target_velocity == approx(0.0, abs=1e-12)
    assert solvers.solve(found.scene, "auto", tolerance=0.2).diagnostics["chosen"]["met"] is True


def test_a_trade_off_and_a_plan_are_those_of_the_mechanism():
    scene = HAMMER.replace({"target": {"kind": "mass", "mass": 2.0, "radius": 0.05}})
    for question in ("final-velocities", "peak-force"):
        one, other = (solvers.plan(each, question) for each in (scene, other_way(scene)))
        assert one.chosen == other.chosen
    assert solvers.stored_tradeoff(HAMMER).points == solvers.stored_tradeoff(HAMMER.struck).points


@pytest.mark.slow
@pytest.mark.parametrize("target", [{"kind": "mass", "mass": 2.0, "radius": 0.05}, None])
def test_studies_know_it(target):
    """An ensemble changes what it strikes; a map of stability is that of the impact seen the other way round."""
    scene = HAMMER if target is None else HAMMER.replace({"target": target})
    found = solvers.ensemble(scene, runs=10)
    assert found.key == ("target.length" if target is None else "target.mass")
    assert np.isfinite(found.impulse).all() and np.ptp(found.impulse) > 0.0
    maps = [
        solvers.stability(each, ["modal"], ("step", "contact_stiffness"), (2, 2)).maps["modal"]
        for each in (scene, other_way(scene))
    ]
    assert np.array_equal(maps[0].energy_error, maps[1].energy_error) and np.abs(maps[0].energy_error).max() < 1e-9


@pytest.mark.parametrize(
    "changes, key, allowed",
    [
        ({"target": {"kind": "spring-mass", "mass": 1.0, "stiffness": 1e6}}, "target.kind", "'mass', 'stop'"),
        ({"target": ARM}, "target.kind", "'mass', 'stop'"),
        ({"target.support": "anechoic"}, "target.support", "'free' or 'fixed'"),
        ({"target": {"kind": "stop"}, "impactor.drives": [{"joint": 0, "speed": -4.0}]}, "impactor.drives", "for ever"),
        ({"target.velocity": 2.5}, "impactor.struck", "faster than the target"),
        ({"impactor.struck": {"link": "arm", "at": 1.0, "normal": [0.0, 1.0]}}, "impactor.struck", "turn the normal"),
        ({"impactor.struck": {"link": "arm", "at": 1.0, "normal": [0, 0]}}, "impactor.struck.normal", "not both zero"),
        ({"impactor.velocity": 1.0}, "impactor.velocity", "no such key"),
        ({"impactor.height": 1.0}, "impactor.height", "no such key"),
        ({"impactor.joints": [ARM["joints"][0]] * 2}, "impactor.joints[2]", "over-constrained"),
    ],
)
def test_what_cannot_be_is_refused_by_its_own_key(changes, key, allowed):
    with pytest.raises(SceneError) as refused:
        HAMMER.replace(changes)
    assert refused.value.key == key and allowed in refused.value.allowed
