"""Pendulums: equivalence of a rigid one and a mass, reactions of the pivot, what scene files may say."""

import json

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene, SceneError
from tests.catalog import BRONZE_ROD, BRONZE_STIFFNESS, STEEL_BEAM, STEEL_ROD

# Thesis 9.1 and 9.5: the aluminium pendulum, I0 = 0.0041 kg m2, which is that of the uniform bar of 9.5.
RIGID = {"kind": "pendulum", "pivot_distance": 0.19, "mass": 0.1968, "inertia": 0.0041, "spin": 1.93 / 0.19}
BAR = {
    "kind": "pendulum",
    "length": 0.25,
    "section": {"area": 1.92e-4, "second_moment": 4.096e-9},
    "material": {"young": 71e9, "density": 4100.0},
    "at": 0.76,
    "spin": 1.93 / 0.19,
}
MASS = {"kind": "mass", "mass": 0.0041 / 0.19**2, "velocity": 1.93}
FREE_MASS = {"kind": "mass", "mass": 3.9991375999999996}
HERTZ = {"law": "hertz", "stiffness": BRONZE_STIFFNESS}
ELASTOPLASTIC = {"law": "plastic-power", "stiffness": BRONZE_STIFFNESS, "yield_indentation": 1e-5}


def struck(impactor: dict, target: dict, contact: dict | None = None, **method) -> Scene:
    tables = {"impactor": impactor, "target": target, "contact": contact or {"law": "rigid"}}
    return Scene.from_table(tables | ({"method": method} if method else {}))


def test_rigid_pendulum_and_free_mass():
    """(9.3), (9.4) with the values recomputed from the thesis's data."""
    found = solvers.solve(struck(RIGID, FREE_MASS, name="rigid", restitution=0.5)).table()
    assert found["impactor"]["final_spin"] == approx(-4.658178666251983, rel=1e-14)
    assert found["target"]["final_velocity"] == approx(0.07994605341212326, rel=1e-14)
    assert found["impactor"]["effective_mass"] == approx(0.11357340720221608, rel=1e-15)
    assert found["links"]["pendulum"]["final_spin"] == found["impactor"]["final_spin"]
    # moment of momentum about the pivot, and momentum of all of it with the force of the pivot
    assert approx(0.19 * found["impulse"], rel=1e-13) == 0.0041 * (1.93 / 0.19 + 4.658178666251983)
    centre = found["links"]["pendulum"]["final_velocity"][0] / found["impactor"]["final_spin"]
    assert centre == approx(0.125, rel=1e-9)
    gained = 0.1968 * centre * (found["impactor"]["final_spin"] - 1.93 / 0.19)
    assert found["joints"] == [{"impulse": [approx(gained + found["impulse"], rel=1e-12), 0.0], "moment_impulse": 0.0}]


TARGETS = (
    BRONZE_ROD,
    STEEL_ROD,
    {"kind": "rods", "rods": [STEEL_ROD | {"support": None}] * 2},
    STEEL_BEAM,
    FREE_MASS,
    {"kind": "spring-mass", "mass": 1.0, "stiffness": 1e7},
    {"kind": "stop"},
    {"kind": "half-space", "material": "steel"},
)


@pytest.mark.parametrize("contact", [HERTZ, ELASTOPLASTIC], ids=["hertz", "plastic"])
@pytest.mark.parametrize("target", TARGETS, ids=lambda target: target.get("kind", "rod"))
def test_a_rigid_pendulum_strikes_as_its_mass(target, contact):
    """Every target: the pendulum and the mass I0 / L_p^2 at spin * L_p are one problem."""
    target = {k: [{n: v for n, v in rod.items() if n != "support"} for rod in r] if k == "rods" else r
              for k, r in target.items()}  # fmt: skip
    pendulum, mass = (solvers.solve(struck(impactor, target, contact)) for impactor in (RIGID, MASS))
    assert pendulum.impulse == approx(mass.impulse, rel=1e-12)
    assert pendulum.peak_force == approx(mass.peak_force, rel=1e-12)
    assert pendulum.energy == {name: approx(value, rel=1e-11, abs=1e-14) for name, value in mass.energy.items()}
    assert pendulum.restitution == {name: approx(value, rel=1e-11) for name, value in mass.restitution.items()}


def test_no_reaction_at_the_centre_of_percussion():
    """Struck at I0 / (m d), two thirds of a bar, the pivot gives nothing; nearer to the pivot it holds back."""
    reactions = []
    for at in (0.5, 2.0 / 3.0, 1.0):
        found = solvers.solve(struck(BAR | {"at": at}, {"kind": "stop"}, name="rigid"))
        reactions.append(found.table()["joints"][0]["impulse"][0] / found.impulse)
    assert reactions == [approx(0.25), approx(0.0, abs=1e-15), approx(-0.5)]


def test_a_pendulum_that_is_struck():
    """A ball against a hanging bar: the result is that of the pendulum against the ball, seen from the other side."""
    ball = {"kind": "mass", "mass": 0.05, "velocity": 2.0}
    for bar in (BAR, BAR | {"modes": 8}):
        hanging = {name: value for name, value in bar.items() if name != "spin"}
        found = solvers.solve(struck(ball, hanging, HERTZ, name="modal"))
        swings, end = found.table(), found.scene.target
        assert found.energy["target_rigid"] == approx(0.5 * end.inertia * swings["target"]["final_spin"] ** 2)
        assert 0.19 * found.impulse == approx(end.inertia * swings["target"]["final_spin"], rel=1e-12)
        assert abs(found.diagnostics["energy_error"]) < 1e-11
        other = solvers.solve(struck(bar | {"spin": 2.0 / 0.19}, ball | {"velocity": 0.0}, HERTZ, name="modal"))
        assert other.impulse == approx(found.impulse, rel=1e-8)
        assert other.peak_force == approx(found.peak_force, rel=1e-8)
        pivots = [each.table()["joints"][0]["impulse"][0] for each in (found, other)]
        assert pivots[0] == approx(-pivots[1], rel=1e-8)


def test_heavier_and_faster():
    """The keys by which studies and sliders change mass and speed."""
    for impactor in (RIGID, BAR):
        scene = struck(impactor, BRONZE_ROD, HERTZ)
        heavier = scene.with_impactor_mass(2.0 * scene.impactor.mass)
        assert heavier.impactor.mass == approx(2.0 * scene.impactor.mass, rel=1e-14)
        assert heavier.impactor.own_mass == approx(2.0 * scene.impactor.own_mass, rel=1e-14)
        assert heavier.impactor.centre == approx(scene.impactor.centre, rel=1e-9)
        faster = scene.replace({"impactor.spin": scene.impactor.of_velocity(3.0)["spin"]})
        assert faster.speed == approx(3.0, rel=1e-15)


@pytest.mark.parametrize(
    "impactor",
    [RIGID, RIGID | {"centre": 0.1, "radius": 0.02}, BAR, BAR | {"mass": 0.3}, BAR | {"modes": 4},
     BAR | {"modes": 3, "shapes": "clamped-free", "damping": 0.01, "theory": "timoshenko", "radius": 0.01}],
)  # fmt: skip
def test_tables_are_read_back(impactor):
    scene = struck(impactor, BRONZE_ROD, HERTZ)
    assert Scene.from_table(json.loads(json.dumps(scene.table()))) == scene


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"spin": -1.0}, "impactor.spin"),
        ({"spin": None}, "impactor.spin"),
        ({"velocity": 1.0}, "impactor.velocity"),
        ({"inertia": 0.0}, "impactor.inertia"),
        ({"inertia": "much"}, "impactor.inertia"),
        ({"mass": -1.0}, "impactor.mass"),
        ({"pivot_distance": 0.0}, "impactor.pivot_distance"),
        ({"at": 0.5}, "impactor.at"),
        ({"centre": 0.5}, "impactor.centre"),
        ({"length": 0.5}, "impactor.inertia"),
        ({"shapes": "pinned-free"}, "impactor.shapes"),
        ({"modes": 3}, "impactor.inertia"),
    ],
)
def test_refused_rigid(changes, key):
    """A body of this mass whose inertia is smaller than that of its mass in one point cannot be; and the like."""
    given = {name: value for name, value in (RIGID | changes).items() if value is not None}
    if changes == {"modes": 3}:
        del given["mass"]
    with pytest.raises(SceneError) as refused:
        struck(given, BRONZE_ROD, HERTZ)
    assert refused.value.key == key


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"modes": 0}, "impactor.modes"),
        ({"modes": 2.5}, "impactor.modes"),
        ({"shapes": "cantilever"}, "impactor.shapes"),
        ({"at": 0.0}, "impactor.at"),
        ({"at": 0.5, "pivot_distance": 0.1}, "impactor.at"),
        ({"at": None, "pivot_distance": 0.3}, "impactor.pivot_distance"),
        ({"section": {"area": 1e-4}}, "impactor.section.second_moment"),
        ({"length": None}, "impactor.length"),
        ({"mass": 1.0}, "impactor.mass"),
    ],
)
def test_refused_flexible(changes, key):
    given = {name: value for name, value in (BAR | {"modes": 5} | changes).items() if value is not None}
    with pytest.raises(SceneError) as refused:
        struck(given, BRONZE_ROD, HERTZ)
    assert refused.value.key == key


def test_a_stiff_bar_is_rigid():
    """With E to infinity a bar that bends is a rigid one. Error: as its compliance, 1 / E."""
    rigid = solvers.solve(struck(BAR, BRONZE_ROD, HERTZ, name="modal", modes=30))
    errors = []
    for factor in (10.0, 100.0):
        material = {"young": 71e9 * factor, "density": 4100.0}
        bends = solvers.solve(
            struck(BAR | {"modes": 4, "material": material}, BRONZE_ROD, HERTZ, name="modal", modes=30)
        )
        errors.append(abs(bends.peak_force / rigid.peak_force - 1.0))
    assert errors[1] < 0.02
    assert errors[1] == approx(0.1 * errors[0], rel=0.2)


def test_fields_turn_about_the_pivot():
    """Before and after the impact displacement and velocity grow from the pivot, which stays where it is."""
    found = solvers.solve(struck(BAR | {"modes": 6}, BRONZE_ROD, HERTZ, name="modal", modes=30))
    time, x = np.array([0.0, 0.3, 1.0]) * found.duration, -np.linspace(1e-300, 0.25, 6)
    for field in (found.motion.displacement, found.motion.velocity):
        assert np.abs(field(time, x)[:, 0]).max() < 1e-12
    assert found.motion.velocity(time[:1], x)[0] == approx(-x * 1.93 / 0.19, abs=1e-12)


def test_a_pendulum_strikes_a_mechanism():
    """As its mass does; its own vectors lie along the normal of the struck point."""
    bar = {"name": "bar", "from": [0.0, 0.0], "to": [0.25, 0.0], "mass": 0.5}
    hinged = {
        "kind": "mechanism",
        "links": [bar],
        "joints": [{"kind": "revolute", "links": ["ground", "bar"], "at": [0.0, 0.0]}],
        "struck": {"link": "bar", "at": 1.0, "normal": [0.0, -1.0]},
    }
    pendulum, mass = (solvers.solve(struck(impactor, hinged, HERTZ)).table() for impactor in (RIGID, MASS))
    assert pendulum["links"]["bar"]["final_spin"] == approx(mass["links"]["bar"]["final_spin"], rel=1e-9)
    spin = pendulum["impactor"]["final_spin"]
    assert pendulum["links"]["pendulum"]["final_velocity"] == [approx(0.0, abs=1e-15), approx(-0.125 * spin)]
    assert pendulum["joints"][-1]["impulse"][0] == approx(0.0, abs=1e-15)


def test_restitution_depends_on_one_number():
    """Thesis 10.3 on a stop: e = e(Pi), Pi = K_h L^3 sqrt(v L^2 / c_t) / (E I), whatever each of them is."""
    usual = BAR | {"modes": 5}
    thick = usual | {"section": {"area": 1.92e-4, "second_moment": 4.0 * 4.096e-9}, "spin": 2.0 * BAR["spin"]}
    # c_t is doubled, so is v: sqrt(v L^2 / c_t) stays, and K_h must grow with E I
    stiff = {"law": "hertz", "stiffness": 4.0 * BRONZE_STIFFNESS}
    stop = {"kind": "stop"}
    found = [
        solvers.solve(struck(bar, stop, law, name="modal", residual=False)).restitution["newton"]
        for bar, law in ((usual, HERTZ), (thick, stiff), (thick, HERTZ))
    ]
    assert found[1] == approx(found[0], rel=1e-6)
    assert abs(found[2] - found[0]) > 0.05


def test_balances_heed_modes_and_shapes_of_a_pendulum():
    """As they do those of links: what `balance` takes of other bodies, elements, is none of its own."""
    found = {}
    for modes in (3, 5, 10):
        for shapes in ("pinned-free", "clamped-free"):
            bar = BAR | {"modes": modes, "shapes": shapes}
            usual, by_modes = (
                solvers.solve(struck(bar, {"kind": "stop"}, {"law": "rigid"}, name="balance", **given))
                for given in ({}, {"modes": 3})
            )
            assert usual.impulse == by_modes.impulse and usual.diagnostics["estimated_error"] > 0.0
            found[modes, shapes] = usual.impulse
    assert len(set(found.values())) == 6  # as many answers


def test_of_a_pendulum_on_a_stop_its_own_modes_are_varied_whatever_the_method():
    scene = struck(BAR | {"modes": 5}, {"kind": "stop"}, {"law": "rigid"}, name="balance")
    found = solvers.convergence(scene, (3, 5, 10), "balance")
    assert found.kind == "modes" and len(set(found.values["impulse"])) == 3
