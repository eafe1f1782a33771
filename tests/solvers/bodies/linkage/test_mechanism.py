"""Mechanisms as scene files say them: read, written back, and refused with the name of what is wrong."""

import copy

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene, SceneError
from tests.solvers.bodies.linkage.mechanisms import BAR, CRANK, FLAT, STEEL, four_bar, rotating_bar


def refusal(scene: Scene, key: str, value: object) -> SceneError:
    tables = copy.deepcopy(scene.table())
    table, (*path, last) = tables, [int(part) if part.isdigit() else part for part in key.split(".")]
    for name in path:
        table = table[name]
    table[last] = value
    with pytest.raises(SceneError) as refused:
        Scene.from_table(tables)
    return refused.value


def test_what_is_written_is_read_back():
    scene = four_bar(5, **{"target.gravity": [0.0, -9.81], "target.radius": 0.1})
    again = Scene.from_table(scene.table())
    assert again.target == scene.target and again.table() == scene.table()
    assert again.speed == approx(1.00028, rel=1e-12)


def test_what_is_worked_out_of_a_mechanism_serves_every_impact_on_it():
    scene = four_bar(5)
    faster = scene.replace({"impactor.velocity": 2.0})
    assert faster.target is scene.replace({"impactor.velocity": 3.0}).target
    assert scene.replace({"target.struck.at": 0.6, "impactor.velocity": 3.0}).target != faster.target
    for _ in range(2):  # what is refused is refused again
        refusal(scene, "target.joints.2.kind", "fixed")


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_velocity_of_any_point_of_the_struck_link(share):
    scene = four_bar(5)
    there = scene.replace({"target.struck.at": share, "impactor.velocity": 5.0})
    assert scene.target.velocity_at(share) == approx(there.target.velocity, rel=1e-14, abs=1e-15)


def test_mass_and_inertia_of_a_bar_follow_from_its_section_and_material():
    bar = {key: value for key, value in BAR.items() if key != "mass"} | {"material": STEEL}
    scene = four_bar(**{"target.links": [CRANK, four_bar().table()["target"]["links"][1], bar]})
    link = scene.target.links[2]
    assert link.mass == approx(7900.0 * 0.06 * 0.008 * 0.8, rel=1e-14)
    assert link.inertia == approx(link.mass * 0.64 / 12.0, rel=1e-14)


def test_an_impactor_may_stand_still_or_run_away_from_what_overtakes_it():
    assert rotating_bar(**{"impactor.velocity": 0.0}).speed == approx(0.3 * 3.142)
    error = refusal(four_bar(), "impactor.velocity", -2.6)
    assert error.key == "impactor.velocity" and error.reason.code == "allowed.struck-link-approaches"
    assert error.reason.values["link"] == "bar" and error.reason.values["velocity"] == approx(-2.51328)


@pytest.mark.parametrize(
    ("key", "value", "named", "code"),
    [
        ("target.joints.2.at", [0.4, 0.9], "target.joints[3].at", "on-link"),
        ("target.joints.2.at", [0.2, 0.5], "target.joints[3].at", "on-link"),
        ("target.joints.2.links", ["coupler", "rod"], "target.joints[3].links[2]", "choice"),
        ("target.joints.2.links", ["bar", "bar"], "target.joints[3].links", "joined-links"),
        ("target.joints.2.kind", "ball", "target.joints[3].kind", "choice"),
        ("target.joints.2.kind", "prismatic", "target.joints[3].axis", "missing-key"),
        ("target.joints.2.axis", [1.0, 0.0], "target.joints[3].axis", "only-with"),
        ("target.joints.2.kind", "fixed", "target.joints[4]", "joint-locks"),
        ("target.links.0.inertia", 0.0, "target.links[1].inertia", "number"),
        ("target.links.0.inertia", -1.0, "target.links[1].inertia", "number"),
        ("target.links.0.to", [0.0, 0.0], "target.links[1].inertia", "link-inertia"),
        ("target.links.0.name", "ground", "target.links[1].name", "link-name"),
        ("target.links.0.name", "bar", "target.links[3].name", "another-name"),
        ("target.links.0.modes", 3, "target.links[1].section", "flexible-link"),
        ("target.links.0.from", [0.0, float("nan")], "target.links[1].from[2]", "number"),
        ("target.links", [], "target.links", "list"),
        ("target.links", {"name": "bar"}, "target.links", "list"),
        ("target.drives.0.joint", 4, "target.drives[1].joint", "whole-number"),
        ("target.drives.0.speed", "fast", "target.drives[1].speed", "number"),
        ("target.struck.normal", [0.0, 0.0], "target.struck.normal", "direction-in-plane"),
        ("target.struck.link", "rod", "target.struck.link", "choice"),
        ("target.struck.at", 1.1, "target.struck.at", "number"),
        ("target.gravity", 9.81, "target.gravity", "point"),
        ("target.links.2.nodes", [0.4, 0.3, 0.8], "target.links[3].nodes", "nodes"),
        ("target.links.2.nodes", [0.4, 0.7], "target.links[3].nodes", "nodes"),
        ("impactor.kind", "pulse", "impactor.kind", "strikes-mechanism"),
        ("impactor.kind", "body", "impactor.kind", "strikes-mechanism"),
    ],
)
def test_a_refusal_names_the_link_or_the_joint(key, value, named, code):
    error = refusal(four_bar(), key, value)
    assert error.key.startswith(named)
    assert error.reason.code == f"allowed.{code}"


def test_a_refusal_counts_as_keys_do_and_names_the_link():
    """The second of three: `--set target.links.2.modes` is refused by the same number."""
    error = refusal(four_bar(), "target.links.1.mass", "heavy")  # in the table itself from 0 on, as always in Python
    assert (error.key, error.of) == ("target.links[2].mass", "coupler")
    with pytest.raises(SceneError, match=r"^target\.links\[2\]\.modes of 'coupler': got 2\.5; allowed: a whole number"):
        four_bar().replace({"target.links.2.modes": 2.5})


def test_too_many_joints_are_told_from_a_bad_configuration():
    pins = [{"kind": "revolute", "links": ["ground", "bar"], "at": [0.4, y]} for y in (0.0, 0.4)]
    target = {
        "kind": "mechanism",
        "links": [BAR],
        "joints": pins,
        "struck": {"link": "bar", "at": 1.0, "normal": [1, 0]},
    }
    scene = {"impactor": {"kind": "mass", "mass": 1.0, "velocity": 1.0}, "target": target}
    with pytest.raises(SceneError) as refused:
        Scene.from_table(scene)
    assert refused.value.key == "target.joints[2]" and refused.value.reason.code == "allowed.joint-redundant"
    lever = BAR | {"name": "lever", "from": [0.4, 0.8], "to": [0.4, 1.6]}
    flat = [
        {"links": ["ground", "bar"], "at": [0.4, 0.0]},
        {"links": ["bar", "lever"], "at": [0.4, 0.8]},
        {"links": ["lever", "third"], "at": [0.4, 1.6]},
        {"links": ["ground", "third"], "at": [0.4, 2.0]},
    ]  # three links in one line between two pins: a four-bar at its change point
    third = BAR | {"name": "third", "from": [0.4, 1.6], "to": [0.4, 2.0]}
    with pytest.raises(SceneError) as refused:
        Scene.from_table(scene | {"target": target | {"links": [BAR, lever, third], "joints": flat}})
    assert refused.value.key == "target.joints[4]" and refused.value.reason.code == "allowed.joint-singular"


def test_a_second_drive_of_one_freedom_and_a_drive_at_a_dead_point_are_told_apart():
    drives = [{"joint": 0, "speed": -5.236}, {"joint": 3, "speed": 1.0}]
    error = refusal(four_bar(), "target.drives", drives)
    assert error.key == "target.drives[2]" and error.reason.code == "allowed.drive-redundant"
    slider = {
        "kind": "mechanism",
        "links": [
            {"name": "crank", "from": [0.0, 0.0], "to": [0.1, 0.0], "mass": 1.0},
            {"name": "rod", "from": [0.1, 0.0], "to": [0.4, 0.0], "mass": 1.0},
            {"name": "piston", "from": [0.4, 0.0], "to": [0.4, 0.0], "mass": 1.0, "inertia": 1e-3},
        ],
        "joints": [
            {"links": ["ground", "crank"], "at": [0.0, 0.0]},
            {"links": ["crank", "rod"], "at": [0.1, 0.0]},
            {"links": ["rod", "piston"], "at": [0.4, 0.0]},
            {"kind": "prismatic", "links": ["ground", "piston"], "at": [0.4, 0.0], "axis": [2.0, 0.0]},
        ],
        "drives": [{"joint": 3, "speed": 1.0}],
        "struck": {"link": "piston", "at": 0.0, "normal": [-1.0, 0.0]},
    }
    tables = {"impactor": {"kind": "mass", "mass": 1.0, "velocity": 1.0}, "target": slider}
    with pytest.raises(SceneError) as refused:
        Scene.from_table(tables)
    assert refused.value.key == "target.drives[1]" and refused.value.reason.code == "allowed.drive-singular"
    slider["drives"] = [{"joint": 0, "speed": 10.0}]
    scene = Scene.from_table(tables)
    assert scene.target.velocity == approx(0.0, abs=1e-12)  # at the dead point the piston stands still
    assert np.isinf(scene.target.at_rest.mass)


def test_rates_follow_from_the_drives():
    rates = four_bar().target.frozen.rates
    assert rates[[2, 5, 8]] == approx([-5.236, 0.0, -3.1416], abs=1e-12)
    assert four_bar(7).target.frozen.rates[[2, 5, 8]] == approx([-5.236, 0.0, -3.1416], abs=1e-12)
    # thesis 6.4.3: the bar slows down
    assert abs(four_bar().target.frozen.accelerations[8]) == approx(3.2898829712, rel=1e-6)


def test_a_bar_without_a_section_that_bends_is_refused():
    error = refusal(four_bar(3), "target.links.2.section", {"area": FLAT["width"] * FLAT["height"]})
    assert error.key == "target.links[3].section.second_moment"


def test_a_link_that_has_shapes_is_no_thread():
    refused = refusal(rotating_bar(5), "target.links.0.from", [1e6, 0.0])
    assert refused.key == "target.links[1].to" and "'bar'" in str(refused)


def test_a_drive_that_hardly_moves_is_as_good_as_none():
    still, slow = (rotating_bar(5).replace({"target.drives.1.speed": speed}) for speed in (0.0, 1e-300))
    assert solvers.solve(slow, "rigid").impactor_velocity == solvers.solve(still, "rigid").impactor_velocity
    assert slow.target.frozen.jerk == 0.0


def test_a_pendulum_that_bends_strikes_a_mechanism_only_at_rest():
    """Its frame would have to move with the mechanism."""
    pendulum = {
        "kind": "pendulum", "length": 0.4, "section": {"width": 0.02, "height": 0.02}, "material": "steel", "at": 0.9,
        "spin": 2.0,
    }  # fmt: skip
    target = {
        "kind": "mechanism",
        "links": [{"name": "bar", "from": [0.0, 0.0], "to": [0.5, 0.0], "mass": 1.5}],
        "joints": [{"links": ["ground", "bar"], "at": [0.0, 0.0]}],
        "drives": [{"joint": 0, "speed": 0.5}],
        "struck": {"link": "bar", "at": 0.8, "normal": [0.0, -1.0]},
    }
    law = {"law": "linear", "stiffness": 1e8}
    rigid = Scene.from_table({"impactor": pendulum, "target": target, "contact": law})
    assert solvers.solve(rigid).impactor_velocity == approx(-1.12, rel=1e-3)
    bends = rigid.replace({"impactor.modes": 6})
    for method in ("modal", "rigid"):
        with pytest.raises(SceneError, match="only at rest"):
            solvers.solve(bends, method)
    resting = solvers.solve(bends.replace({"target.drives": []}), "modal")
    assert abs(resting.diagnostics["energy_error"]) < 1e-9


@pytest.mark.parametrize("length", [1e-5, 1e-3, 0.01])
def test_a_link_with_shapes_is_no_shorter_than_its_section_is_thick(length):
    """Of a joint of 10 um all frequencies but the highest were lost to rounding, down to zero."""
    scene = solvers.load("bent-rods")
    start, end = (np.array(scene.given["target"]["links"][1][name]) for name in ("from", "to"))
    to = start + (end - start) * length / np.linalg.norm(end - start)
    found = refusal(scene, "target.links.1.to", to.tolist())
    assert found.key == "target.links[2].to" and "a length from 0.03 m: link 'second' has shapes" in str(found)
