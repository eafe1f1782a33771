"""The exact method does not hang on which of the two bodies strikes: every scene against its mirror."""

import math
from typing import Any

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene

ROD = {"kind": "rod", "length": 1.0, "section": {"radius": 0.01}, "material": "steel"}
SPEED = 5.0  # m/s


def scene(impactor: dict, target: dict, contact: dict | None = None, speed: float = SPEED, drift: float = 0.0) -> Scene:
    """Of bodies without their velocities; `drift` [m/s]: of the target, and with it of all."""
    moving = {"velocity": drift} if drift else {}
    tables = {"impactor": impactor | {"velocity": speed + drift}, "target": target | moving}
    return Scene.from_table(tables | {"contact": contact or {"law": "rigid"}})


def outcome(solution: Any, swapped: bool = False, drift: float = 0.0) -> dict[str, Any]:
    """What cannot hang on who strikes: velocities as those of the impactor and the target of the scene not swapped."""
    first, second = solution.impactor_velocity - drift, solution.target_velocity - drift
    if swapped:
        first, second = SPEED - second, SPEED - first
    return {
        "impulse": solution.impulse,
        "peak": solution.peak_force,
        "edges": [edge for contact in solution.contacts for edge in (contact.start, contact.end)],
        "velocities": [first, second],
    }


def same(one: dict[str, Any], other: dict[str, Any], share: float) -> None:
    assert len(one["edges"]) == len(other["edges"])
    assert other["impulse"] == approx(one["impulse"], rel=share)
    assert other["peak"] == approx(one["peak"], rel=share)
    assert other["edges"] == approx(one["edges"], rel=share, abs=share * one["edges"][-1])
    assert other["velocities"] == approx(one["velocities"], abs=share * SPEED)


def test_a_mass_behind_a_rod_that_strikes_pushes_on():
    """Two equal rods, one with 1 kg at its far end: it still has m v e^(-Z t / m) after the first round trip."""
    solution = solvers.solve(scene(ROD | {"end_mass": 1.0}, ROD | {"support": "free"}))
    rod = solution.scene.target
    trip, impedance = rod.round_trip_time, rod.impedance
    impulse = 0.5 * impedance * SPEED * trip + 0.5 * 1.0 * SPEED * (1.0 - math.log(2.0))
    assert solution.impulse == approx(impulse, rel=1e-9)
    assert solution.contacts[0].end == approx(trip + math.log(2.0) / impedance, rel=1e-9)
    assert solution.impactor_velocity == approx(SPEED - impulse / (rod.mass + 1.0), rel=1e-9)
    assert solution.target_velocity == approx(impulse / rod.mass, rel=1e-9)
    assert abs(solution.diagnostics["energy_error"]) < 1e-12


@pytest.mark.parametrize("contact", [None, {"law": "hertz", "stiffness": 1e10}], ids=["rigid", "hertz"])
@pytest.mark.parametrize("ends", [(1.0, 0.0), (0.0, 0.3), (2.0, 0.5)])
def test_the_end_of_a_body_counts_on_either_side(ends, contact):
    bodies = [ROD | {"length": length, "end_mass": mass or None} for length, mass in zip((1.0, 0.7), ends, strict=True)]
    bodies = [{key: value for key, value in body.items() if value is not None} for body in bodies]
    one, other = (scene(impactor, target | {"support": "free"}, contact) for impactor, target in (bodies, bodies[::-1]))
    same(outcome(solvers.solve(one)), outcome(solvers.solve(other), swapped=True), 1e-8)


def test_a_mass_on_a_drop_weight_comes_back_from_a_column():
    tup = {"kind": "rod", "length": 0.3, "section": {"radius": 0.03}, "material": "steel", "end_mass": 50.0}
    column = {"kind": "rod", "length": 2.0, "section": {"radius": 0.1}, "material": "concrete", "support": "fixed"}
    tables = {"impactor": tup | {"velocity": 4.4287, "radius": 0.1}, "target": column, "contact": {"law": "hertz"}}
    exact, meshed = (solvers.solve(Scene.from_table(tables), method=name) for name in ("waves", "fe-modal"))
    assert meshed.impactor_velocity == approx(exact.impactor_velocity, rel=1e-4)  # of 100 elements, second order
    assert meshed.peak_force == approx(exact.peak_force, rel=1e-4)
    assert exact.impactor_velocity < 0.0


WALLS = {"stop": {"kind": "stop"}, "half-space": {"kind": "half-space", "material": "steel"}}
SECTIONS = [
    {"length": 0.4, "section": {"radius": 0.008}, "material": "steel"},
    {"length": 0.38, "section": {"radius": 0.012}, "material": "bronze"},
    {"length": 0.11, "section": {"radius": 0.01}, "material": "steel"},
]
CHAIN = {"kind": "rods", "rods": SECTIONS}
APART = {"kind": "rods", "rods": [SECTIONS[0], SECTIONS[1] | {"joint": "touching", "gap": 1e-4}, SECTIONS[2]]}
SPRUNG = {"law": "linear", "stiffness": 4e8}
JOINTED = {"kind": "rods", "rods": [SECTIONS[0], SECTIONS[1] | {"joint": "touching", "contact": SPRUNG}]}
BODIES = {
    "mass": {"kind": "mass", "mass": 0.7},
    "rod": ROD,
    "ended": ROD | {"end_mass": 0.6},
    "chain": CHAIN | {"end_mass": 0.3},
    "apart": APART,
    "jointed": JOINTED,
}
LAWS = {
    "rigid": {"law": "rigid"},
    "hertz": {"law": "hertz", "stiffness": 1e10},
    "plastic": {"law": "plastic-power", "stiffness": 1e10, "yield_indentation": 2e-5},
    "damped": {"law": "hunt-crossley", "stiffness": 1e10, "damping": 0.3},
}
PAIRS = [(one, other) for one in BODIES for other in BODIES if (one, other) != ("mass", "mass")]


def free(body: dict) -> dict:
    return body | ({"support": "free"} if body["kind"] in ("rod", "rods") else {})


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("one, other", PAIRS)
def test_a_scene_and_its_mirror_have_one_outcome(one, other, law):
    bodies, contact = [free(BODIES[one]), free(BODIES[other])], LAWS[law]
    plain, mirrored = (scene(*pair, contact) for pair in (bodies, bodies[::-1]))
    assert {solvers.usual_method(plain), solvers.usual_method(mirrored)} == {"waves"}
    solved, exchanged = solvers.solve(plain), solvers.solve(mirrored)
    share = 1e-7 + 10.0 * sum(each.diagnostics["estimated_error"] for each in (solved, exchanged))
    same(outcome(solved), outcome(exchanged, swapped=True), share)


@pytest.mark.parametrize("one", BODIES)
@pytest.mark.parametrize("other", ["mass", "chain"])
def test_all_that_moves_alike_changes_nothing(one, other):
    if (one, other) == ("mass", "mass"):
        return
    bodies = free(BODIES[one]), free(BODIES[other])
    still, moved = (solvers.solve(scene(*bodies, drift=drift), method="waves") for drift in (0.0, 3.0))
    same(outcome(still), outcome(moved, drift=3.0), 1e-8)


@pytest.mark.parametrize("wall", WALLS)
@pytest.mark.parametrize("one", [name for name in BODIES if name != "mass"])
def test_what_strikes_a_wall_is_what_strikes_a_mass_without_end(one, wall):
    """Beside a mass of 1e8 of its own a hundred-millionth of its speed is missing."""
    bodies = free(BODIES[one]), WALLS[wall]
    held = solvers.solve(scene(*bodies))
    heavy = solvers.solve(scene(bodies[0], {"kind": "mass", "mass": 1e8 * held.scene.impactor.mass}))
    same(outcome(held), outcome(heavy), 1e-7)
    assert held.method["name"] == "waves"


SPRUNG_MASS = {"kind": "spring-mass", "mass": 0.5, "stiffness": 3e7}


def test_a_rod_drives_a_mass_on_a_spring_as_a_dashpot_would():
    """Until its own wave is back: m u'' + Z u' + k u = Z v from rest."""
    solution = solvers.solve(scene(ROD, SPRUNG_MASS))
    rod, body = solution.scene.impactor, solution.scene.target
    decay = 0.5 * rod.impedance / body.mass
    frequency = complex(body.frequency**2 - decay**2, 0.0) ** 0.5  # imaginary: overdamped
    times = np.linspace(0.01, 0.95, 17) * rod.round_trip_time
    speed = rod.impedance * SPEED / body.mass * (np.exp(-decay * times) * np.sin(frequency * times) / frequency).real
    assert solution.known_motion.force(times) == approx(rod.impedance * (SPEED - speed), rel=1e-9)
    assert solution.known_motion.end_velocity(times) == approx(speed, rel=1e-9)
    assert solution.method["name"] == "waves" and abs(solution.diagnostics["energy_error"]) < 1e-9


@pytest.mark.parametrize("one", ["rod", "ended", "chain"])
def test_a_mass_on_a_spring_is_struck_again_as_often_as_elements_say(one):
    law = {"law": "linear", "stiffness": 1e6}
    tables = {"kind": "spring-mass", "mass": 0.85, "stiffness": 3e4}
    exact = solvers.solve(scene(free(BODIES[one]), tables, law), method="waves")
    meshed = solvers.solve(scene(free(BODIES[one]), tables, law), method="fe-modal", duration=exact.duration)
    assert len(exact.contacts) >= 2
    same(outcome(exact), outcome(meshed), 1e-4)  # of 100 elements, second order


def test_joints_of_a_striker_may_open_before_a_mass_on_a_spring():
    solution = solvers.solve(scene(APART, SPRUNG_MASS, {"law": "hertz", "stiffness": 1e9}))
    assert solution.method["name"] == "waves" and solution.impactor_velocity < 0.0
    assert abs(solution.diagnostics["energy_error"]) < 1e-8


def test_a_rod_on_a_stop_is_pressed_by_v_times_root_e_rho():
    """By what its weight adds to v in a round trip, too."""
    tables = {"kind": "rod", "length": 0.1, "section": {"area": 0.001}, "material": "steel", "height": 1.0}
    solution = solvers.solve(Scene.from_table({"impactor": tables, "target": {"kind": "stop"}}))
    rod = solution.scene.impactor
    gained = solution.scene.gravity * rod.round_trip_time
    assert solution.peak_force == approx(rod.impedance * (rod.velocity + gained), rel=1e-12)
    assert solution.peak_force == approx(180.400e3, rel=1e-5)
    assert [(contact.start, contact.end) for contact in solution.contacts] == [(0.0, approx(rod.round_trip_time))]


@pytest.mark.parametrize("front, back, forces", [(0.008, 0.012, (49.94e3, 73.36e3)), (0.012, 0.008, (75.5e3, 51.7e3))])
def test_a_stepped_piston_presses_in_two_steps(front, back, forces):
    """On an endless rod; the second step is the first with what the change of section turns back."""
    sections = [
        {"length": length, "section": {"radius": radius}, "material": "steel"}
        for length, radius in ((0.4, front), (0.38, back))
    ]
    anvil = {"kind": "rod", "length": 3.0, "section": {"radius": 0.01}, "material": "steel", "support": "anechoic"}
    solution = solvers.solve(scene({"kind": "rods", "rods": sections}, anvil, speed=10.0))
    assert solution.method["name"] == "waves"
    trip = solution.scene.impactor.rods[0].round_trip_time
    one, two, three = (body.impedance for body in (solution.scene.target, *solution.scene.impactor.rods))
    first = 10.0 * one * two / (one + two)
    # what is left of the speed of the front behind the wave meets the back, which still has all of its own
    arriving = first / two
    sent = arriving * two * (three - two) / (two + three)
    second = first + 2.0 * sent * one / (one + two)
    found = [float(solution.known_motion.force(share * trip)) for share in (0.5, 1.2)]
    assert found == approx([first, second], rel=1e-12) and found == approx(forces, rel=1e-3)


def test_a_striker_of_sections_is_refused_where_it_cannot_be():
    for changes, key in (
        ({"support": "fixed"}, "impactor.support"),
        ({"rods": []}, "impactor.rods"),
        ({"rods": [SECTIONS[0] | {"gap": 1.0}]}, "impactor.rods[1]"),
        (
            {"rods": [SECTIONS[0], SECTIONS[1] | {"joint": "touching", "contact": {"law": "none"}}]},
            "impactor.rods[2].contact.law",
        ),
    ):
        with pytest.raises(solvers.SceneError) as refused:
            scene(CHAIN | changes, ROD)
        assert refused.value.key == key
