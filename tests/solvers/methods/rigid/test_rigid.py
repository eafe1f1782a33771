"""The method `rigid`: bodies in space and on an axis, from scene files to results."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

import solvers
from solvers import RigidImpulse, Scene, SceneNotSupported
from tests.catalog import RIGID, SCENES, STEEL_BEAM, STEEL_ROD_MASS, T, struck_beam, struck_rod
from tests.solvers.methods.rigid.scenes import BODIES, STRUCK, with_value
from tests.solvers.numerics.rigid.test_impulses import in_world, random_bodies, rotations

IN_SPACE = [name for name, scene in SCENES.items() if scene.normal is not None]


# --- bodies in space --------------------------------------------------------------------------------------------------


def test_the_rod_of_the_note():
    """mu = m1 m2 / (m1 + 4 m2) = 0.25 kg, w1z = 6 J / (m1 l), v1x = -J / m1 for a normal from the rod to the mass."""
    solution = solvers.solve(SCENES["note-rod"])
    impulse = (1.0 + 0.6) * 0.25 * 3.0
    assert solution.effective_mass == approx(0.25, rel=1e-15)
    assert solution.impulse == approx(impulse, rel=1e-15)
    assert solution.target_velocity == approx((-impulse / 2.0, 0.0, 0.0), rel=1e-15)
    assert solution.target_spin == approx((0.0, 0.0, 6.0 * impulse / (2.0 * 1.2)), rel=1e-14)
    assert solution.impactor_velocity == approx((-3.0 + impulse / 0.5, 0.0, 0.0), rel=1e-14)
    assert solution.impactor_spin == (0.0, 0.0, 0.0)
    assert solution.energy["dissipated"] == approx(0.5 * 0.25 * (1.0 - 0.36) * 9.0, rel=1e-14)
    assert solution.restitution["poisson"] == solution.restitution["newton_at_contact"] == 0.6
    assert solution.restitution["newton"] == approx(0.0, abs=1e-15)  # the centres of mass end up moving alike


def test_the_far_end_of_a_rod_struck_at_its_centre_of_percussion_stands_still():
    solution = solvers.solve(SCENES["percussion-rod"])
    far = np.array(solution.target_velocity) + np.cross(solution.target_spin, [0.0, -0.6, 0.0])
    assert np.abs(far).max() < 1e-15
    assert abs(solution.target_spin[2]) > 1.0


@pytest.mark.parametrize("name", IN_SPACE)
def test_built_in_scenes_in_space(name):
    solution = solvers.solve(SCENES[name])
    assert solution.method["name"] == "rigid"
    for error in ("energy_error", "momentum_error", "angular_momentum_error"):
        assert abs(solution.diagnostics[error]) < 1e-15
    written = json.loads(json.dumps(solution.table(), allow_nan=False))
    for part in ("impactor", "target"):
        assert set(written[part]) == {"final_velocity", "final_spin"}
        assert len(written[part]["final_velocity"]) == len(written[part]["final_spin"]) == 3
    assert written["effective_mass"] == solution.effective_mass
    pressed = np.dot(solution.impulse, solution.scene.normal) if solution.sliding else solution.impulse
    assert written["contacts"] == [{"start": 0.0, "end": 0.0, "impulse": approx(pressed), "peak_force": None}]
    assert Scene.from_table(written["scene"]) == SCENES[name]


@given(seed=st.integers(0, 2**32 - 1), restitution=st.floats(0.0, 1.0))
@settings(max_examples=25)
def test_scenes_of_random_bodies(seed, restitution):
    """A scene gives what linear algebra gives, is written back without loss, and keeps momentum and energy."""
    first, second = (random_bodies(np.random.default_rng(seed + k), 1) for k in (0, 1))
    normal = np.random.default_rng(seed + 2).standard_normal(3)

    def table(bodies):
        values = zip(bodies._fields, bodies, strict=True)
        return {"kind": "body"} | {name: value[0].tolist() for name, value in values}

    tables = {
        "impactor": table(first),
        "target": table(second),
        "contact": {"law": "rigid", "normal": (7.0 * normal).tolist()},
        "method": {"restitution": restitution},
    }
    scene = Scene.from_table(tables)
    assert Scene.from_table(scene.table()) == scene
    assert Scene.from_table(scene.table()).table() == scene.table()
    solution = solvers.solve(scene)
    unit = normal / np.linalg.norm(normal)
    approach = (
        unit
        @ (
            first.velocity
            + np.cross(first.spin, -first.centre)
            - second.velocity
            - np.cross(second.spin, -second.centre)
        ).ravel()
    )
    assert scene.speed == approx(approach, abs=1e-12)
    inverse = 0.0
    for bodies in (first, second):
        lever = np.cross(bodies.centre[0], unit)
        inverse += 1.0 / bodies.mass[0] + lever @ np.linalg.solve(bodies.inertia[0], lever)
    assert solution.effective_mass == approx(1.0 / inverse, rel=1e-12)
    assert solution.impulse == approx(max(0.0, (1.0 + restitution) * approach / inverse), rel=1e-12, abs=1e-11)
    for error in ("energy_error", "momentum_error", "angular_momentum_error"):
        assert abs(solution.diagnostics[error]) < 1e-12


def test_bodies_that_move_apart_do_not_meet():
    scene = Scene.from_table(with_value("impactor.velocity", [3.0, 1.0, 0.0]))
    solution = solvers.solve(scene)
    assert (solution.impulse, solution.contacts, solution.peak_force) == (0.0, [], 0.0)
    assert solution.impactor_velocity == (3.0, 1.0, 0.0)
    assert solution.target_spin == (0.0, 0.0, 0.0)
    assert set(solution.restitution.values()) == {None}
    assert solution.energy["dissipated"] == 0.0
    assert list(map(str, solution.notes)) == ["The bodies move apart: no impact."]


def test_bodies_at_rest():
    solution = solvers.solve(Scene.from_table(with_value("impactor.velocity", [0.0, 0.0, 0.0])))
    assert solution.impulse == 0.0 and solution.energy["initial"] == 0.0
    json.dumps(solution.table(), allow_nan=False)


def test_against_a_stop():
    """A body dropped on its corner: mu^-1 = 1/m + (c x n)^T I^-1 (c x n)."""
    cube = 0.2**2 / 6.0
    tables = {
        "impactor": {
            "kind": "body", "mass": 1.0, "inertia": [cube, cube, cube], "centre": [0.1, 0.0, 0.1],
            "velocity": [0.0, 0.0, -2.0],
        },
        "target": {"kind": "stop"},
        "contact": {"normal": [0.0, 0.0, -1.0]},
    }  # fmt: skip
    scene = Scene.from_table(tables)
    assert Scene.from_table(scene.table()) == scene
    solution = solvers.solve(scene, restitution=0.25)
    assert solution.effective_mass == approx(1.0 / (1.0 + 0.1**2 / cube), rel=1e-14)
    assert solution.target_velocity == solution.target_spin == (0.0, 0.0, 0.0)
    corner = np.array(solution.impactor_velocity) + np.cross(solution.impactor_spin, [-0.1, 0.0, -0.1])
    assert corner[2] == approx(0.25 * 2.0, rel=1e-14)
    assert abs(solution.diagnostics["energy_error"]) < 1e-15


def test_three_principal_moments_with_axes_are_a_tensor():
    moments, axes = np.array([0.3, 0.4, 0.5]), rotations(np.random.default_rng(3), 1)[0]
    given = with_value("target.inertia", moments.tolist())
    given["target"]["axes"] = (2.0 * axes.T).tolist()  # as rows, of any length
    assert np.allclose(Scene.from_table(given).target.inertia, in_world(moments, axes), rtol=0.0, atol=1e-15)
    plain = Scene.from_table(with_value("target.inertia", moments.tolist())).target
    assert np.array_equal(plain.inertia, np.diag(moments))


def test_the_normal_is_made_a_unit_vector():
    for length in (1e-9, 0.3, 1e9):
        scene = Scene.from_table(with_value("contact.normal", [-0.6 * length, 0.0, 0.8 * length]))
        assert scene.normal == approx((-0.6, 0.0, 0.8), rel=1e-15)


def test_a_point_mass_does_not_turn_and_says_so_when_struck_beside():
    tables = with_value("target.centre", [0.0, -0.6, 0.0])
    del tables["target"]["inertia"]
    solution = solvers.solve(Scene.from_table(tables))
    assert solution.effective_mass == approx(0.4, rel=1e-15)  # 2 * 0.5 / 2.5
    assert solution.target_spin == (0.0, 0.0, 0.0)
    assert len(solution.notes) == 1 and "Give its inertia" in str(solution.notes[0])
    assert solvers.solve(SCENES["note-rod"]).notes == []
    on_line = with_value("target.centre", [-0.6, 0.0, 0.0])
    del on_line["target"]["inertia"]
    assert solvers.solve(Scene.from_table(on_line)).notes == []


def test_replace_changes_vectors():
    scene = SCENES["note-rod"].replace({"target.centre": [0.0, 0.0, 0.0], "method.restitution": 0.0})
    assert solvers.solve(scene).effective_mass == approx(0.4, rel=1e-15)
    assert solvers.solve(scene).method == {"name": "rigid", "restitution": 0.0}


def test_other_methods_leave_bodies_in_space_alone():
    for name in set(solvers.METHODS) - {"rigid"}:
        with pytest.raises(SceneNotSupported, match="use 'rigid'"):
            solvers.solve(SCENES["note-rod"], name)


# --- on an axis -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("support", ["fixed", "free", "anechoic"])
def test_a_mass_against_a_rod_that_moves_as_a_whole(support, restitution):
    """(9.1); a rod that is held counts as immovable."""
    scene = struck_rod(2.0, support, speed=3.0)
    solution = RigidImpulse(restitution).solve(scene)
    m1, m2 = scene.impactor.mass, scene.target.mass
    if support == "free":
        reduced = m1 * m2 / (m1 + m2)
        after = 3.0 * (m1 - restitution * m2) / (m1 + m2), 3.0 * (1.0 + restitution) * m1 / (m1 + m2)
    else:
        reduced, after = m1, (-3.0 * restitution, 0.0)
    assert solution.effective_mass == approx(reduced, rel=1e-14)
    assert solution.impulse == approx((1.0 + restitution) * reduced * 3.0, rel=1e-14)
    assert (solution.impactor_velocity, solution.target_velocity) == approx(after, abs=1e-14)
    assert solution.energy["dissipated"] == approx(0.5 * reduced * (1.0 - restitution**2) * 9.0, rel=1e-14)
    assert solution.restitution["newton"] == approx(restitution, abs=1e-15)
    assert abs(solution.diagnostics["energy_error"]) < 1e-15
    assert isinstance(solution.table()["impactor"]["final_velocity"], float)


@pytest.mark.parametrize("impactor", BODIES)
@pytest.mark.parametrize("target", STRUCK)
def test_any_bodies_on_an_axis(impactor, target):
    scene = Scene.from_table({"impactor": BODIES[impactor], "target": STRUCK[target]})
    solution = solvers.solve(scene, "rigid", restitution=0.5)
    parting = solution.target_velocity - solution.impactor_velocity
    assert parting == approx(0.5 * scene.speed, rel=1e-13)
    assert abs(solution.diagnostics["momentum_error"]) < 1e-15
    assert abs(solution.diagnostics["energy_error"]) < 1e-14


def test_the_motion_on_an_axis_is_straight_with_a_jump():
    scene = struck_rod(1.0, "free")
    motion = solvers.solve(scene, "rigid", restitution=0.5, duration=2.0 * T).motion
    times = np.array([0.0, T])
    assert motion.impactor_velocity(times, after=False) == approx([1.0, 0.25], rel=1e-14)
    assert motion.impactor_velocity(times) == approx([0.25, 0.25], rel=1e-14)
    assert motion.rigid_velocity(times, after=False) == approx([0.0, 0.75], rel=1e-14)
    assert motion.impactor_position(times) == approx([0.0, 0.25 * T], rel=1e-14)
    assert motion.end_position(times) == approx([0.0, 0.75 * T], rel=1e-14)
    energies = motion.energies(np.array([T]))
    assert sum(value[0] for value in energies.values()) == approx(scene.initial_energy, rel=1e-14)


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
@pytest.mark.parametrize(
    "beam, share",
    [
        ({"support": "free-free"}, 1.0),
        ({"support": "free-free", "at": 0.9}, 1.0 / 2.92),  # 1 / (1 / m + d^2 / J), J = m L^2 / 12
        ({"support": "free-free", "at": 0.0, "velocity": -2.0}, 0.25),
        ({"support": "pinned-free", "at": 0.5}, 4.0 / 3.0),  # J / x^2, J = m L^2 / 3
    ],
)
def test_a_beam_is_felt_where_it_is_struck(beam, share, restitution):
    scene = struck_beam(1.0, RIGID, **beam)
    found, mass, before = RigidImpulse(restitution).solve(scene), STEEL_ROD_MASS, scene.target.velocity
    reduced = mass * share / (1.0 + share)
    assert found.effective_mass == approx(reduced, rel=1e-12)
    assert found.impulse == approx((1.0 + restitution) * reduced * scene.speed, rel=1e-12)
    assert found.impactor_velocity == approx(1.0 - found.impulse / mass, rel=1e-12)
    struck = before + found.impulse / (mass * share)
    if scene.target.held:  # half as fast in its middle as at its end, whatever the pin takes of the momentum
        assert found.target_velocity == approx(0.5 / beam["at"] * struck, rel=1e-12)
        assert found.restitution["newton"] is None
    else:
        assert found.target_velocity == approx(before + found.impulse / mass, rel=1e-12)
    field = found.motion.velocity(np.array([found.duration]), np.array([0.15, scene.target.place]))[0]
    assert field == approx([found.target_velocity, struck], rel=1e-12)
    assert found.restitution["newton_at_contact"] == restitution
    assert found.energy["dissipated"] == approx(0.5 * reduced * (1.0 - restitution**2) * scene.speed**2, rel=1e-12)
    assert abs(found.diagnostics["energy_error"]) < 1e-14
    assert abs(found.diagnostics["momentum_error"]) < 1e-14
    assert "'modal' can show" in str(found.notes[0])


@pytest.mark.parametrize("support", ["cantilever", "pinned-pinned", "clamped-clamped"])
def test_a_beam_that_is_held_counts_as_immovable(support):
    found = RigidImpulse(0.5).solve(struck_beam(1.0, RIGID, support=support))
    assert (found.impactor_velocity, found.target_velocity) == approx((-0.5, 0.0), rel=1e-14)


def test_a_beam_may_strike_another():
    table = {"impactor": STEEL_BEAM | {"velocity": 1.0, "at": 0.9}, "target": STEEL_BEAM | {"support": "free-free"}}
    found = RigidImpulse().solve(Scene.from_table(table))
    reduced = STEEL_ROD_MASS / (1.0 + 2.92)
    assert found.effective_mass == approx(reduced, rel=1e-12)
    assert found.impactor_velocity == approx(1.0 - 2.0 * reduced / STEEL_ROD_MASS, rel=1e-12)
    face = found.motion.face_velocity(np.array([found.duration]))[0]
    assert face == approx(1.0 - 2.0 * 2.92 * reduced / STEEL_ROD_MASS)
    assert abs(found.diagnostics["energy_error"]) < 1e-14


def test_what_does_not_move_as_a_whole_is_refused():
    spring = {"kind": "spring-mass", "mass": 1.0, "stiffness": 1e6}
    rods = STRUCK["rods"] | {"rods": [STRUCK["rods"]["rods"][0], STRUCK["rods"]["rods"][1] | {"joint": "touching"}]}
    for target, said in ((spring, "swings back"), (rods, "bonded")):
        scene = Scene.from_table({"impactor": BODIES["sphere"], "target": target})
        with pytest.raises(SceneNotSupported, match=said):
            solvers.solve(scene, "rigid")
