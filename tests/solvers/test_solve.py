"""The method of a scene that names none: one that can solve it, whatever strikes whatever."""

import itertools
import math

import pytest
from pytest import approx

import solvers
from solvers import METHODS, Modal, Scene, SceneError, SceneNotSupported, Waves, usual_method
from tests.catalog import SCENES, STEEL_ROD, contact_table

ROD = {"kind": "rod"} | STEEL_ROD
BEAM = {"kind": "beam", "length": 0.3, "section": {"width": 0.03, "height": 0.03}, "material": "steel"}
PIECE = {key: ROD[key] for key in ("length", "section", "material")}
MOVING = {"mass": 1.0, "inertia": [0.1, 0.1, 0.1], "kind": "body"}
IMPACTORS = {
    "mass": {"kind": "mass", "mass": 1.0, "radius": 0.02},
    "sphere": {"kind": "sphere", "radius": 0.02},
    "rod": {key: value for key, value in ROD.items() if key != "support"},
    "bonded rods": {"kind": "rods", "rods": [PIECE, PIECE]},
    "touching rods": {"kind": "rods", "rods": [PIECE, PIECE | {"joint": "touching"}]},
    "beam": BEAM | {"support": "free-free", "at": 0.5},
    "pulse": {"kind": "pulse", "force": 1e4, "duration": 1e-4},
    "body": MOVING | {"centre": [0.0, 0.0, 0.05], "velocity": [0.0, 0.0, -1.0]},
}
TARGETS = {
    "fixed rod": ROD,
    "free rod": ROD | {"support": "free"},
    "endless rod": ROD | {"support": "anechoic"},
    "rod with an end mass": ROD | {"support": "free", "end_mass": 0.3},
    "bonded rods": {"kind": "rods", "rods": [PIECE, PIECE]},
    "touching rods": {"kind": "rods", "rods": [PIECE, PIECE | {"joint": "touching"}]},
    "cantilever": BEAM | {"support": "cantilever"},
    "damped beam": BEAM | {"support": "pinned-pinned", "at": 0.4, "damping": 0.01},
    "mass": {"kind": "mass", "mass": 2.0, "radius": 0.03},
    "mass on a spring": {"kind": "spring-mass", "mass": 2.0, "stiffness": 1e7, "radius": 0.03},
    "stop": {"kind": "stop"},
    "half-space": {"kind": "half-space", "material": "steel"},
    "body": MOVING | {"centre": [0.0, 0.0, -0.05]},
}
CHAINS = ("bonded rods", "touching rods")
REFUSED = {("beam", "touching rods"), ("touching rods", "cantilever")}
REFUSED |= {(chain, "damped beam") for chain in CHAINS}  # no method knows both


def scene_of(impactor: str, target: str, law: str) -> Scene:
    given = IMPACTORS[impactor] if impactor in ("pulse", "body") else IMPACTORS[impactor] | {"velocity": 1.0}
    tables = {"impactor": given, "target": TARGETS[target], "contact": contact_table(law)}
    if "body" in (impactor, target):
        tables["contact"] = {"law": law, "normal": [0.0, 0.0, -1.0]}
    return Scene.from_table(tables)


@pytest.mark.parametrize("target", TARGETS)
def test_every_scene_that_can_be_written_down_has_a_method(target):
    found = 0
    for impactor, law in itertools.product(IMPACTORS, solvers.LAWS):
        try:
            scene = scene_of(impactor, target, law)
        except SceneError:
            continue  # no such scene
        found += 1
        if (impactor, target) in REFUSED:
            with pytest.raises(SceneNotSupported, match="no method can solve this scene"):
                solvers.solve(scene)
        else:
            assert METHODS[usual_method(scene)].read({}).refusal(scene) is None, (impactor, law)
    assert found >= (1 if target == "body" else 30)


def test_two_compact_bodies_are_solved_by_the_closed_form_of_their_contact():
    scene = scene_of("mass", "mass", "linear")
    found = solvers.solve(scene)
    assert found.method["name"] == "quasi-static"
    assert found.impactor_velocity == approx(-1.0 / 3.0, rel=1e-9)  # (m1 - m2) / (m1 + m2)
    assert found.contacts[0].end == approx(math.pi * math.sqrt(scene.reduced_mass / scene.contact.stiffness), rel=1e-9)


def test_a_ball_on_a_half_space_takes_the_time_of_hertz():
    scene = Scene.from_table(
        {
            "impactor": IMPACTORS["sphere"] | {"velocity": 1.0},
            "target": TARGETS["half-space"],
            "contact": {"law": "hertz"},
        }
    )
    found = solvers.solve(scene)
    assert found.impactor_velocity == approx(-1.0, rel=1e-9)
    deepest = (1.25 * scene.impactor.mass / scene.contact.stiffness) ** 0.4  # (3.30) at 1 m/s, the half-space held
    assert found.peak_indentation == approx(deepest, rel=1e-9)
    lasts = 2.0 * math.sqrt(math.pi) * math.gamma(1.4) / math.gamma(0.9) * deepest  # 2.94328 alpha / v, errata (3.34)
    assert found.contacts[0].end == approx(lasts, rel=1e-9)


def test_bodies_that_do_not_give_way_bounce_by_their_restitution():
    assert solvers.solve(scene_of("mass", "stop", "rigid")).impactor_velocity == approx(-1.0, rel=1e-12)
    assert solvers.solve(scene_of("mass", "mass", "rigid")).impactor_velocity == approx(-1.0 / 3.0, rel=1e-12)
    swinging = solvers.solve(scene_of("mass", "mass on a spring", "rigid"))
    assert swinging.method["name"] == "balance"
    assert swinging.contacts[0].impulse == approx(2.0 * 2.0 / 3.0, rel=1e-9)  # (1 + e) m1 m2 / (m1 + m2) v


def test_options_without_a_name_belong_to_the_usual_method():
    scene = scene_of("mass", "cantilever", "hertz").replace({"method.modes": 7})
    assert solvers.solve(scene).method["modes"] == 7
    assert solvers.solve(scene, "modal").method["modes"] == 7
    assert solvers.solve(scene, "balance", elements=5).method["modes"] is None


@pytest.mark.slow
@pytest.mark.parametrize("target", ["mass", "mass on a spring", "stop", "half-space"])
def test_a_comparison_of_bodies_without_waves_has_something_to_measure_by(target):
    rows = {row.method["name"]: row for row in solvers.compare(scene_of("mass", target, "rigid"), repeats=1)}
    usual = usual_method(scene_of("mass", target, "rigid"))
    assert rows[usual].reason is None and rows[usual].rebound_error == approx(0.0, abs=1e-12)
    assert "rod" in str(rows["waves"].reason)


def test_the_method_of_the_scene_is_used_unless_asked_otherwise():
    scene = SCENES["fixed-rod"].replace({"method": {"name": "modal", "modes": 5, "duration": 1e-4}})
    solution = solvers.solve(scene)
    assert solution.method["name"] == "modal" and solution.method["modes"] == 5
    assert solution.duration == approx(1e-4, rel=1e-15)
    assert solvers.solve(scene, modes=6).method["modes"] == 6
    assert solvers.solve(scene, "waves").method["name"] == "waves"
    assert solvers.solve(scene, duration=2e-4).duration == approx(2e-4, rel=1e-15)
    assert solvers.solve(scene, Waves()).method["name"] == "waves"
    assert solvers.solve(scene, Modal(modes=3)).method["modes"] == 3


@pytest.mark.parametrize(
    "arguments, key",
    [
        ({"method": "guess"}, "method.name"),
        ({"method": "waves", "modes": 5}, "method.modes"),
        ({"method": "modal", "tolerance": 1e-3}, "method.tolerance"),
        ({"method": "waves", "tolerance": 0.0}, "method.tolerance"),
        ({"method": "waves", "steps": 5}, "method.steps"),
        ({"method": "waves", "steps": 1e3}, "method.steps"),
        ({"duration": -1.0}, "method.duration"),
        ({"duration": 0.0}, "method.duration"),
        ({"duration": math.nan}, "method.duration"),
        ({"duration": math.inf}, "method.duration"),
        ({"duration": "long"}, "method.duration"),
        ({"duration": True}, "method.duration"),
        ({"duration": 1e9}, "method.duration"),
        ({"method": Modal(modes=3), "modes": 5}, "method"),
        ({"velocity": 3.0}, "method.velocity"),
    ],
)
def test_solve_refuses(arguments, key):
    with pytest.raises(SceneError) as refused:
        solvers.solve(SCENES["fixed-rod"], **arguments)
    assert refused.value.key == key


@pytest.mark.parametrize("young", [1e-3, 1.0, 900.0])
@pytest.mark.parametrize("contact", ["rigid", "linear"])
@pytest.mark.parametrize("method", ["waves", "modal", "fe-nodal"])
def test_benchmarks_without_dimensions_are_scenes(young, contact, method):
    """E = 900, rho = 1, L = 10 and the like: the same shares as of steel, of like impedance and stiffness ratios."""

    def solved(young: float, density: float, length: float, speed: float):
        rod = {"kind": "rod", "length": length, "section": {"area": 1.0}, "support": "fixed"}
        rod["material"] = {"young": young, "density": density}
        law = {"law": contact} | ({"stiffness": 3.0 * young / length} if contact == "linear" else {})
        impactor = {"mass": 0.7 * density * length, "velocity": speed}
        scene = solvers.Scene.from_table({"impactor": impactor, "target": rod, "contact": law})
        return solvers.solve(scene, method).impactor_velocity / speed

    speed = 1e-3 * young**0.5
    assert solved(young, 1.0, 10.0, speed) == pytest.approx(solved(210e9, 7900.0, 0.3, 1.0), abs=1e-9)
