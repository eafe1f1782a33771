"""Impacts on mechanisms: rigid closed forms of thesis 6.4, beams that they contain, balances of momentum at joints."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import METHODS, Balance, Modal, QuasiStatic, RigidImpulse, Scene, SceneError
from solvers.methods.modal.motion import last_touch
from tests.catalog import SCENES
from tests.solvers.bodies.linkage.mechanisms import FLAT, STEEL, closes, four_bar, rotating_bar

HERTZ = {"law": "hertz", "stiffness": 1e9}


def test_rotating_bar_without_flexibility():
    """(6.24): 1.943 m/s, 2.276 kg m/s and 0.683 kg m2/s; table 6.6 prints half of the last."""
    found = solvers.solve(rotating_bar())
    assert found.method["name"] == "rigid"
    assert found.impactor_velocity == approx(-1.9426, rel=1e-13)
    assert found.reactions[0]["impulse"] == approx([0.0, 2.276], abs=1e-13)
    assert found.reactions[0]["moment_impulse"] == approx(0.6828, rel=1e-13)
    assert found.energy["drives"] == approx(-0.6828 * 3.142, rel=1e-13)
    assert abs(found.diagnostics["energy_error"]) < 1e-13


def test_four_bar_without_flexibility():
    """Thesis 6.4.3, printed 3.511; and with a crank that nothing holds at its speed."""
    found = solvers.solve(four_bar())
    assert found.impactor_velocity == approx(-3.51356, rel=1e-12)
    free = solvers.solve(four_bar(initial=True))
    assert free.impactor_velocity == approx(-2.598535, rel=1e-6)
    assert free.impulse == approx(2.315447, rel=1e-6)
    assert free.energy["drives"] == approx(0.0, abs=1e-12)
    spins = [free.links[name]["final_spin"] for name in ("crank", "coupler", "bar")]
    assert np.isfinite(spins).all() and abs(spins[2]) < 3.1416


def test_the_rigid_answer_is_that_of_the_bars_alone_whatever_bends():
    stiff, bent = (RigidImpulse().solve(four_bar(modes)) for modes in (0, 7))
    assert bent.impactor_velocity == approx(stiff.impactor_velocity, rel=1e-12)
    for one, other in zip(stiff.reactions, bent.reactions, strict=True):
        assert one["impulse"] == approx(other["impulse"], abs=1e-11)
        assert one["moment_impulse"] == approx(other["moment_impulse"], abs=1e-11)


@pytest.mark.parametrize("name", ["four-bar", "table-6.7", "slider-crank", "double-pendulum"])
def test_one_balance_of_rigid_links_is_one_impulse(name):
    """Velocities are those right after it, and not those of some time later, as the mechanism turns on."""
    scene = SCENES[name].struck
    scene = replace(scene, target=scene.target.with_rigid_links, contact=SCENES["table-6.7"].contact, given={})
    impulse, balances = (method(restitution=0.6).solve(scene) for method in (RigidImpulse, Balance))
    for link, one in impulse.links.items():
        assert balances.links[link]["final_spin"] == approx(one["final_spin"], rel=1e-11, abs=1e-11)
        assert balances.links[link]["final_velocity"] == approx(one["final_velocity"], rel=1e-11, abs=1e-11)
    assert balances.impactor_velocity == approx(impulse.impactor_velocity, rel=1e-12)
    assert balances.target_velocity == approx(impulse.target_velocity, rel=1e-11)


@pytest.mark.parametrize("restitution", [0.0, 0.6, 1.0])
def test_restitution_and_energy_of_one_balance(restitution):
    scene = four_bar(initial=True)
    found = RigidImpulse(restitution=restitution).solve(scene)
    mass = scene.target.at_rest.mass
    reduced = 1.0 / (1.0 / 2.133 + 1.0 / mass)
    assert found.impulse == approx((1.0 + restitution) * reduced * scene.speed, rel=1e-12)
    assert found.energy["dissipated"] == approx(0.5 * reduced * (1.0 - restitution**2) * scene.speed**2, rel=1e-12)
    assert abs(found.diagnostics["energy_error"]) < 1e-12


@pytest.mark.parametrize(("modes", "share"), [(5, -0.12610795411466), (8, 0.07927242659819), (12, 0.05296032734688)])
def test_sudden_reaction_of_a_clamp_is_what_its_modes_leave_out(modes, share):
    """Table 6.6, sum of P over the momentum given: 1 - sum phi_i(L) int phi_i dm, whatever the balances."""
    found = Balance().solve(rotating_bar(modes))
    assert found.reactions[0]["impulse"][1] / found.impulse == approx(share, rel=1e-10)


@pytest.mark.parametrize(("modes", "velocity", "balances"), [(5, -1.783, 20), (8, -1.796, 39), (12, -1.723, 61)])
def test_rotating_bar_by_balances(modes, velocity, balances):
    """As the cantilever of the same bar, seen from its tip. Table 6.6 prints 1.874, 1.786, 1.736: chaotic."""
    found = Balance().solve(rotating_bar(modes))
    beam = {"kind": "beam", "length": 0.3, "section": FLAT, "material": STEEL | {"density": 1.138 / 0.3 / 4.8e-4}}
    alone = Scene.from_table({"impactor": {"kind": "mass", "mass": 1.138, "velocity": 1.0}, "target": beam})
    same = Balance(modes=modes, estimate=False).solve(alone)
    times, impulses = (values[:4] for values in found.motion.impulses)
    assert impulses == approx(same.motion.impulses[1][:4], rel=1e-9)
    assert times == approx(same.motion.impulses[0][:4], rel=1e-9, abs=1e-15)
    assert found.impactor_velocity == approx(velocity, rel=0.05)
    assert balances / 2 < found.diagnostics["balances"] < 2 * balances  # of 12 modes 61 or 77, by processor
    assert abs(found.diagnostics["energy_error"]) < 1e-11


@pytest.mark.parametrize(
    ("method", "rounding"),
    [
        (Balance(), 1e-11),
        (Balance(restitution=0.3), 1e-4),  # while the faces stick their force is taken as steady between instants
        (Modal(estimate=False), 1e-9),
    ],
)
def test_weight_and_inertia_of_the_mechanism_act_during_the_impact(method, rounding):
    """The bar slows down by itself, faster and faster, and all fall: what the drive takes up balances the energy."""
    law = {"contact": HERTZ} if method.NAME == "modal" else {}
    scene = four_bar(6, initial=True, **law, **{"target.gravity": [30.0, -9.81]})
    found = method.solve(scene)
    assert found.motion.acceleration != 0.0 and found.motion.jerk != 0.0 and found.motion.weight == approx(-30.0)
    assert closes(found, rounding)
    assert abs(found.diagnostics["momentum_error"]) < 1e-11


def test_table_6_8():
    """Printed 3.271, 3.287, 3.318, chaotic; recomputed 3.254 +- 0.013, and 3.2405 with five modes, over 26.83 ms."""
    five = Balance().solve(four_bar(5))
    assert -five.motion.impactor_velocity(np.array([five.contacts[-1].end]))[0] == approx(3.2405, rel=0.004)
    assert five.contacts[-1].end == approx(26.83e-3, rel=0.005)
    masses = 2.133 * (1.0 + 1e-6 * np.arange(12))
    rebounds = [Balance().solve(four_bar(9, **{"impactor.mass": mass})).impactor_velocity for mass in masses]
    assert -np.mean(rebounds) == approx(3.254, abs=0.03)


def test_the_struck_point_slows_down_as_the_four_bar_turns():
    """By a finite difference of exact kinematics: the bar's angle follows from the lengths of crank and coupler."""
    frozen = four_bar().target.frozen

    def angle(time):
        pin = 0.3 * np.array([np.sin(5.236 * time), np.cos(5.236 * time)]) - [0.4, 0.0]
        reach = np.hypot(*pin)
        inner = np.arccos((reach**2 + 0.25 - 0.2) / reach)
        return np.arctan2(pin[0], pin[1]) + inner

    step = 1e-3
    angles = np.array([angle(step * k) for k in range(-3, 4)])
    third = angles @ [1.0, -8.0, 13.0, 0.0, -13.0, 8.0, -1.0] / (8.0 * step**3)
    second = angles @ [2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0] / (180.0 * step**2)
    assert frozen.acceleration == approx(-0.8 * second, rel=1e-6)
    assert frozen.jerk == approx(-0.8 * third, rel=1e-4)


def momentum(scene: Scene, links: dict) -> np.ndarray:
    """Linear momentum of all links (2,) and angular momentum about the origin."""
    found = np.zeros(3)
    for link in scene.target.links:
        velocity, centre = np.array(links[link.name]["final_velocity"]), link.centre
        found[:2] += link.mass * velocity
        spin = links[link.name]["final_spin"]
        found[2] += link.inertia * spin + link.mass * (centre[0] * velocity[1] - centre[1] * velocity[0])
    return found


@pytest.mark.parametrize("method", [RigidImpulse(restitution=0.5), Balance(), Modal(estimate=False)])
@pytest.mark.parametrize("initial", [False, True])
def test_joints_and_contact_give_the_momentum_that_the_links_gain(method, initial):
    """Linear and angular, of every link vibrating or not: what ground, drive and impactor have given them."""
    law = {} if method.NAME != "modal" else {"contact": HERTZ}
    scene = four_bar(6, initial, **law)
    found = method.solve(scene)
    until = found.contacts[-1].end
    before = found.motion.of_links(found.motion.before(until))
    gained = momentum(scene, found.motion.link_rates(until)) - momentum(scene, before)
    given = found.impulse * np.array([-1.0, 0.0, 0.8])  # on the tip, 0.8 m up, towards -x
    for joint, reaction in zip(scene.target.joints, found.reactions, strict=True):
        if joint.links[0] != "ground":
            continue
        push = np.array(reaction.get("impulse_to_parting", reaction["impulse"]))
        turn = reaction.get("moment_impulse_to_parting", reaction["moment_impulse"])
        given[:2] += push
        given[2] += turn + joint.at[0] * push[1] - joint.at[1] * push[0]
    assert gained == approx(given, abs=1e-7 * found.impulse)  # histories are straight within a step


@pytest.mark.parametrize(
    ("shapes", "support"),
    [("clamped-free", "cantilever"), ("pinned-free", "pinned-free"), ("mean-axis", "free-free")],
)
@pytest.mark.parametrize("theory", ["euler-bernoulli", "timoshenko"])
def test_one_link_is_the_beam_on_such_a_support(shapes, support, theory):
    """Thrown by its drive or not: the same impact, as the same closing speed is all that counts."""
    link = {"name": "bar", "from": [0.1, 0.2], "to": [0.1, 0.5], "section": FLAT, "material": "steel", "modes": 8}
    target = {
        "kind": "mechanism",
        "links": [link | {"shapes": shapes, "theory": theory}],
        "struck": {"link": "bar", "at": 0.9, "normal": [2.0, 0.0]},
    }
    if support != "free-free":
        target["joints"] = [{"links": ["ground", "bar"], "at": [0.1, 0.2]}]
        target["drives"] = [{"joint": 0, "speed": 2.0, "initial": support == "pinned-free"}]
    speed = 1.0 - (0.9 * 0.3 * 2.0 if support != "free-free" else 0.0)
    impactor = {"kind": "mass", "mass": 0.4, "velocity": speed}
    found = Modal(estimate=False).solve(Scene.from_table({"impactor": impactor, "target": target, "contact": HERTZ}))
    beam = {"kind": "beam", "length": 0.3, "section": FLAT, "material": "steel", "support": support, "at": 0.9}
    same = Modal(modes=8, estimate=False).solve(
        Scene.from_table(
            {"impactor": impactor | {"velocity": 1.0}, "target": beam | {"theory": theory}, "contact": HERTZ}
        )
    )
    assert found.peak_force == approx(same.peak_force, rel=1e-6)
    assert found.impactor_velocity - speed + 1.0 == approx(same.impactor_velocity, abs=1e-7)
    assert abs(found.diagnostics["energy_error"]) < 1e-10


def test_shapes_of_another_kind_tend_to_the_same_impact():
    """A pinned bar by the shapes of a clamped or a free one: constraints act on the shapes, too."""
    peaks = {}
    for shapes in ("pinned-free", "clamped-free", "mean-axis"):
        scene = rotating_bar(24, contact=HERTZ)
        bar = scene.table()["target"]["links"][0] | {"shapes": shapes}
        scene = scene.replace({"target.links": [bar], "target.drives": [{"joint": 0, "speed": 3.142, "initial": True}]})
        peaks[shapes] = Modal(estimate=False).solve(scene).peak_force
    assert peaks["mean-axis"] == approx(peaks["pinned-free"], rel=1e-3)
    assert peaks["clamped-free"] == approx(peaks["pinned-free"], rel=1e-3)


def test_fixed_links_are_one_bar():
    """Two halves joined rigidly, each with shapes of its own, vibrate as the whole: first order, as no shape of a
    clamped half has a moment at its free end."""
    bar = {"kind": "beam", "length": 0.3, "section": FLAT, "material": STEEL}
    alone = Scene.from_table({"impactor": {"velocity": 1.0, "mass": 1.0}, "target": bar}).target.modes(4)
    errors = [two_halves(modes).frequencies[:4] / alone.frequencies - 1.0 for modes in (10, 20, 40)]
    assert np.abs(errors[2]).max() < 0.006
    assert errors[0][[0, 1, 3]] / errors[1][[0, 1, 3]] == approx(2.0, rel=0.1)
    assert errors[1][[0, 1, 3]] / errors[2][[0, 1, 3]] == approx(2.0, rel=0.1)


def two_halves(modes: int):
    half = {"section": FLAT, "material": STEEL, "modes": modes, "shapes": "clamped-free"}
    links = [
        half | {"name": "inner", "from": [0.0, 0.0], "to": [0.15, 0.0]},
        half | {"name": "outer", "from": [0.15, 0.0], "to": [0.3, 0.0]},
    ]
    joints = [
        {"links": ["ground", "inner"], "at": [0.0, 0.0]},
        {"kind": "fixed", "links": ["inner", "outer"], "at": [0.15, 0.0]},
    ]
    scene = rotating_bar().replace(
        {
            "target.links": links,
            "target.joints": joints,
            "target.struck": {"link": "outer", "at": 1.0, "normal": [0, -1]},
        }
    )
    return scene.target.frozen.modes


def test_links_are_drawn_where_the_motion_has_them():
    found = Balance().solve(rotating_bar(5))
    times = found.motion.impulses[0][:7]  # between them histories are straight
    points = found.motion.link_points(times, 10)["bar"]
    assert points.shape == (7, 11, 2)
    assert points[:, 0] == approx(np.zeros((7, 2)), abs=1e-15)
    tip = -found.motion.end_position(times)  # along -y
    turned = found.motion.coordinates(times)[:, 2]
    assert points[:, -1, 1] == approx(0.3 * np.sin(turned) + (tip - 0.3 * turned) * np.cos(turned), abs=1e-9)


def test_reaction_forces_over_time_add_up_to_their_impulses():
    scene = rotating_bar(6, contact=HERTZ)
    found = Modal(estimate=False).solve(scene)
    until = found.contacts[-1].end
    times = np.linspace(0.0, until, 40_001)
    forces = found.motion.reaction_forces(0.5 * (times[1:] + times[:-1]))[:, 0]
    impulse = forces.sum(axis=0) * (times[1] - times[0])
    assert impulse[:2] == approx(found.reactions[0]["impulse"], abs=2e-3 * found.impulse)
    assert impulse[2] == approx(found.reactions[0]["moment_impulse"], abs=2e-3 * 0.3 * found.impulse)


@pytest.mark.parametrize("modes", [0, 4])
@pytest.mark.parametrize("law", [{}, HERTZ])
def test_every_method_solves_it_or_says_why_not(modes, law):
    scene = four_bar(modes, **({"contact": law} if law else {}))
    for method in (each.read({}) for each in METHODS.values()):
        if method.refusal(scene) is None:
            assert closes(method.solve(scene), 1e-9)


def test_fewer_modes_than_the_scene_gives_its_links_are_those_of_a_scene_that_gives_fewer():
    scene, fewer = (four_bar(modes, contact=HERTZ) for modes in (9, 4))
    found, expected = Modal(modes=4).solve(scene), Modal().solve(fewer)
    assert found.impactor_velocity == expected.impactor_velocity
    assert found.energy == expected.energy
    assert Modal(modes=9).solve(scene).impactor_velocity == Modal().solve(scene).impactor_velocity
    many = four_bar(60, contact=HERTZ)
    assert solvers.solve(many).method["modes"] == 60


@pytest.mark.parametrize(("modes", "said"), [(8, 1), (5, 0), (3, 0), (None, 0)])
def test_more_modes_than_links_have_are_said_to_change_nothing(modes, said):
    found = solvers.solve(solvers.load("table-6.6"), Balance(**({} if modes is None else {"modes": modes})))
    assert [note.code for note in found.notes].count("links-keep-modes") == said


def test_links_that_are_held_to_be_rigid_are_so_quasi_statically():
    bending, stiff = (QuasiStatic().solve(four_bar(modes, contact=HERTZ)) for modes in (5, 0))
    assert bending.impactor_velocity == stiff.impactor_velocity
    assert bending.peak_force == stiff.peak_force


def test_a_rigid_link_on_flexible_ones_is_struck_by_balances():
    """Nothing gives way at once where it is struck, so that no modes of a rigid contact can begin; found as a crash."""
    crank = {"name": "crank", "from": [0.0, 0.0], "to": [0.0, 0.3], "mass": 2.133, "section": FLAT, "material": STEEL}
    scene = four_bar(0)
    links = [crank | {"modes": 4}, *scene.table()["target"]["links"][1:]]
    scene = scene.replace({"target.links": links})
    assert Modal().refusal(scene).code == "refusals.nothing-gives-way"
    found = solvers.solve(scene)
    assert found.method["name"] == "balance" and closes(found, 1e-10)
    assert Modal().refusal(scene.replace({"contact": HERTZ})) is None


@pytest.mark.parametrize(
    "impactor",
    [
        {
            "kind": "rod",
            "length": 0.2,
            "section": {"width": 0.03, "height": 0.03},
            "material": "steel",
            "velocity": -1.5,
        },
        {"kind": "pendulum", "mass": 1.0, "inertia": 0.1, "pivot_distance": 0.4, "centre": 0.2, "spin": 1.0},
        {"kind": "sphere", "radius": 0.03, "velocity": 0.0},
    ],
    ids=lambda table: table["kind"],
)
def test_whatever_strikes_it_energy_and_momentum_are_kept(impactor):
    for method, law in ((Balance(estimate=False), {"law": "rigid"}), (Modal(estimate=False), HERTZ)):
        tables = four_bar(5).table() | {"impactor": impactor, "contact": law}
        found = method.solve(Scene.from_table(tables))
        assert closes(found, 1e-10)
        assert abs(found.diagnostics["momentum_error"]) < 1e-11


def test_what_is_drawn_away_before_any_force_acts_is_refused():
    with pytest.raises(SceneError, match="drawn away before any force acts"):
        last_touch(rotating_bar(3), None, SimpleNamespace(contact_force=np.zeros(5)), 1e-6, 5)
