"""What falls on rods by exact waves: against delay equations integrated by themselves, and against many modes."""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Modal, Scene, SceneNotSupported, Waves
from solvers.methods.waves.chain import ExactHistory
from solvers.methods.waves.chain_grid import GridHistory
from solvers.methods.waves.chain_scene import ChainScene
from tests.catalog import T, contact_table, struck_rod

from .test_delay_equation import reference_first_contact, reference_impact_on_a_fixed_rod

SOFT = {"young": 1e7, "density": 1e3, "poisson": 0.3}
ROD = {"kind": "rod", "length": 1.0, "section": {"radius": 0.01}, "material": SOFT}
FIXED = ROD | {"support": "fixed"}
IMPEDANCE, TRANSIT = 1e5 * math.pi * 1e-4, 0.01  # of such a rod
LINEAR = {"law": "linear", "stiffness": 1e5}


def heavy(scene: Scene, fall: float) -> Scene:
    """With a weight that speeds it up by `fall` times its velocity in every round trip."""
    return scene.replace({"impactor.gravity": fall * scene.speed / T})


def dropped(law: dict, target: dict = FIXED, gravity: float = 9.81, height: float = 0.1, **impactor) -> Scene:
    body = impactor or {"mass": 2.0}
    table = {"impactor": body | {"height": height, "gravity": gravity}, "target": target, "contact": law}
    return Scene.from_table(table)


@pytest.mark.slow
@pytest.mark.parametrize("beta", [0.4, 1.0, 3.0])
@pytest.mark.parametrize("fall", [0.01, 0.3, 2.0])
def test_a_mass_on_a_fixed_rod_in_rigid_contact(beta, fall):
    until = 6.0  # some ten contacts; ever slighter ones that follow hang on rounding
    contacts, final = reference_impact_on_a_fixed_rod(beta, fall, until)
    found = Waves().solve(heavy(struck_rod(beta, "fixed"), fall), duration=until * T)
    edges = [(each.start / T, each.end / T) for each in found.contacts]
    if math.isnan(contacts[-1][1]):
        contacts[-1][1] = until
    assert np.array(edges) == approx(np.array(contacts), abs=1e-8)
    last = found.known_motion.impactor_velocity(np.array([until * T]))[0] / found.scene.speed
    assert last == approx(final, abs=1e-8)
    assert abs(found.diagnostics["energy_error"]) < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("law", ["hertz", "linear"])
@pytest.mark.parametrize("fall", [0.1, 1.0])
def test_a_mass_on_a_fixed_rod_with_a_law(law, fall):
    scene = heavy(struck_rod(1.0, "fixed", contact_table(law, softness=1.0)), fall)
    end, velocity, peak = reference_first_contact(scene)
    found = Waves(tolerance=1e-12).solve(scene)
    first = found.contacts[0]
    assert first.end == approx(end, rel=1e-9) and first.peak_force == approx(peak, rel=1e-6)
    assert found.known_motion.impactor_velocity(np.array([end]))[0] == approx(velocity, abs=1e-8 * scene.speed)


def equal_rods(gravity: float, speed: float, transits: float, per: int, law: float = 0.0) -> np.ndarray:
    """Force at middles of steps between two such rods, the second fixed, while faces stay together: what arrives is
    what they sent two transits ago, turned over by the free end and as it was by the fixed one.

    per: steps in a transit; law: stiffness [N/m] of a spring between them, by the trapezium rule; 0: none.
    """
    step, count = TRANSIT / per, int(transits * per)
    force, left, right = np.zeros(count), np.zeros(count), np.zeros(count)
    depth = rate = 0.0
    for k in range(count):
        back = k - 2 * per
        from_left, from_right = (-left[back], right[back]) if back >= 0 else (0.0, 0.0)
        closing = speed + gravity * step * (k + 0.5) + 2.0 * (from_left + from_right) / IMPEDANCE
        give = 2.0 / IMPEDANCE
        force[k] = (depth + 0.5 * step * closing) * law / (1.0 + 0.5 * step * law * give) if law else closing / give
        depth += step * (closing - give * force[k]) if law else rate
        left[k], right[k] = force[k] - from_left, force[k] - from_right
    return force


@pytest.mark.parametrize("gravity", [9.81, 300.0])
@pytest.mark.parametrize("stiffness", [0.0, 1e5])
def test_a_rod_on_a_rod(gravity, stiffness):
    """Rods of one kind: until a wave comes back each sends half of what it closes in by."""
    law = {"law": "linear", "stiffness": stiffness} if stiffness else {"law": "rigid"}
    scene = dropped(law, FIXED, gravity, **ROD)
    found = solvers.solve(scene, "waves", duration=0.035)
    per = 4000 if stiffness else 400
    times = (np.arange(int(3.4 * per)) + 0.5) * TRANSIT / per
    own = equal_rods(gravity, scene.speed, 3.4, per, stiffness)
    assert own.min() >= 0.0
    assert found.known_motion.force(times) == approx(own, abs=(2e-4 if stiffness else 1e-9) * own.max())
    middle = found.known_motion.impactor_velocity(times + 0.5 * TRANSIT / per)
    pushed = np.cumsum(own) * TRANSIT / per
    freely = scene.speed + gravity * (times + 0.5 * TRANSIT / per)
    assert middle == approx(freely - pushed / scene.impactor.mass, abs=2e-4 * scene.speed)
    assert abs(found.diagnostics["energy_error"]) < 1e-10 and abs(found.diagnostics["momentum_error"]) < 1e-10


def test_what_falls_along_a_rod_speeds_up_everywhere():
    """Where no wave has come yet, a rod that falls moves by its weight alone."""
    found = solvers.solve(dropped({"law": "rigid"}, FIXED, 50.0, **ROD), "waves")
    time, x, speed = np.array([0.004]), np.array([-0.9, -0.6]), found.scene.speed
    assert found.known_motion.velocity(time, x)[0] == approx(speed + 0.2, rel=1e-12)
    assert found.known_motion.displacement(time, x)[0] == approx(speed * 0.004 + 25.0 * 0.004**2, rel=1e-12)
    face = found.known_motion.face_velocity(time)[0]
    assert face == approx(found.known_motion.end_velocity(time)[0], rel=1e-12)


@pytest.mark.parametrize("body", [{"mass": 2.0}, ROD], ids=["mass", "rod"])
@pytest.mark.parametrize("law", [LINEAR, {"law": "hertz", "stiffness": 1e6}], ids=["linear", "hertz"])
@pytest.mark.parametrize("gravity", [9.81, 100.0])
def test_as_many_modes_have_it(body, law, gravity):
    scene = dropped(law, FIXED, gravity, **body)
    exact, modes = Waves().solve(scene), Modal(modes=200, estimate=False).solve(scene)
    assert modes.contacts[-1].end == approx(exact.contacts[-1].end, rel=1e-3)
    assert modes.impactor_velocity == approx(exact.impactor_velocity, abs=1e-3 * scene.speed)
    assert modes.peak_force == approx(exact.peak_force, rel=1e-2)
    for share in exact.energy:
        assert modes.energy[share] == approx(exact.energy[share], abs=3e-3 * exact.energy["initial"])
    assert sum(exact.energy.values()) == approx(2.0 * exact.energy["initial"], rel=1e-10)


def test_a_step_in_the_section_on_a_grid_and_exactly():
    thin = {key: ROD[key] for key in ("length", "material")}
    parts = [thin | {"section": {"radius": radius}} for radius in (0.01, 0.006)]
    scene = dropped(LINEAR, {"kind": "rods", "rods": parts, "support": "fixed"}, 20.0)
    found = solvers.solve(scene, "waves")
    grid = GridHistory(ChainScene(scene), math.inf, 20.0)
    assert grid.parted and [each.end for each in grid.contacts] == approx(
        [each.end for each in found.contacts], rel=1e-4
    )
    now = np.array([found.contacts[-1].end / grid.trip])
    there = found.known_motion.impactor_velocity(now * grid.trip)[0] / scene.speed
    assert grid.velocity_as_whole(now)[0] == approx(there, abs=1e-4)
    where = found.known_motion.impactor_position(now * grid.trip)[0] / scene.speed / grid.trip
    assert grid.middle(now)[0] == approx(where, abs=1e-4)


def test_on_a_grid_a_rod_falls_as_exactly():
    given = ChainScene(dropped(LINEAR, FIXED, 100.0, **ROD))
    exact, grid = ExactHistory(given, 3.0, 1e-9), GridHistory(given, 3.0, 3.0)
    t = np.linspace(0.1, 2.9, 15)
    assert grid.middle(t) == approx(exact.middle(t), abs=1e-5)
    assert grid.velocity_as_whole(t) == approx(exact.velocity_as_whole(t), abs=1e-5)


# --- how it ends


def test_within_a_given_duration_it_comes_back():
    scene = dropped({"law": "rigid"}, FIXED, 9.81, 0.02)
    once = solvers.solve(scene, "waves")
    leaves, speed, known = once.contacts[-1].end, -once.impactor_velocity, len(once.contacts)
    again = solvers.solve(scene, "waves", duration=leaves + 2.5 * speed / 9.81)
    moved = again.known_motion.impactor_position
    flown = np.linspace(leaves, again.contacts[known].start, 9)
    since = flown - leaves
    assert moved(flown) == approx(moved(flown[:1]) - speed * since + 4.905 * since**2, abs=1e-12)
    for first, second in zip(once.contacts, again.contacts, strict=False):
        assert second.impulse == approx(first.impulse, rel=1e-12)
    assert once.duration <= leaves + speed / 9.81
    assert again.impactor_velocity != once.impactor_velocity


def test_without_weight_it_is_as_before():
    plain = Scene.from_table({"impactor": {"mass": 2.0, "velocity": 1.0}, "target": FIXED, "contact": LINEAR})
    light = plain.replace({"impactor.gravity": 1e-6})
    found, other = solvers.solve(light, "waves"), solvers.solve(plain, "waves")
    assert found.peak_force == approx(other.peak_force, abs=2.0 * 2.0 * 1e-6)  # twice its weight
    assert found.impactor_velocity == approx(other.impactor_velocity, abs=1e-6)
    assert found.contacts[-1].end == approx(other.contacts[-1].end, rel=1e-6)


def test_with_a_dashpot_it_comes_to_rest():
    law = {"law": "kelvin-voigt", "stiffness": 2e3, "damping": 60.0}
    found = solvers.solve(dropped(law, FIXED, 9.81, 0.01), "waves")
    assert "comes-to-rest" in [note.code for note in found.notes]
    depth = 2.0 * 9.81 * (1.0 / 2e3 + 1.0 / (1e7 * math.pi * 1e-4))
    assert found.known_motion.impactor_position(np.array([found.duration]))[0] == approx(depth, rel=1e-5)


@pytest.mark.parametrize("law", [{"law": "rigid"}, {"law": "hertz", "stiffness": 1e6}], ids=["rigid", "hertz"])
def test_on_a_rod_without_end_it_sinks_on(law):
    found = solvers.solve(dropped(law, ROD | {"support": "anechoic"}, 9.81, 0.01), "waves")
    assert "sinks-on" in [note.code for note in found.notes] and len(found.contacts) == 1
    assert found.impactor_velocity == approx(2.0 * 9.81 / IMPEDANCE, rel=1e-5)
    if law["law"] == "rigid":  # v = m g / Z + (v0 - m g / Z) exp(-Z t / m)
        time, sinks = np.linspace(0.0, 0.2, 7)[1:], 2.0 * 9.81 / IMPEDANCE
        velocity = sinks + (found.scene.speed - sinks) * np.exp(-IMPEDANCE * time / 2.0)
        assert found.known_motion.impactor_velocity(time) == approx(velocity, rel=1e-10)
        assert found.known_motion.force(time) == approx(IMPEDANCE * velocity, rel=1e-10)
    assert abs(found.diagnostics["energy_error"]) < 1e-9


def test_what_it_cannot_leave_it_swings_on():
    law = {"law": "plastic-linear", "stiffness": 1e4, "yield_indentation": 1e-4}
    found = solvers.solve(dropped(law, FIXED, 9.81, 1e-5), "waves")
    assert "never-leaves" in [note.code for note in found.notes] and len(found.contacts) == 1


def test_rods_that_come_apart_are_refused_where_weight_matters():
    part = {key: ROD[key] for key in ("length", "section", "material")}
    loose = {"kind": "rods", "rods": [part, part | {"joint": "touching"}], "support": "fixed"}
    with pytest.raises(SceneNotSupported, match="weight"):
        solvers.solve(dropped({"law": "rigid"}, loose), "waves")
    with pytest.raises(SceneNotSupported):
        solvers.solve(dropped({"law": "rigid"}), "waves", steps=1000)


# --- rods that fall on what is no rod


CHAIN = {"kind": "rods", "rods": [{key: ROD[key] for key in ("length", "section", "material")}] * 2}
STRIKERS = {"rod": ROD, "rods": CHAIN, "rod-with-mass": ROD | {"end_mass": 0.2}}
HELD = {
    "stop": {"kind": "stop"},
    "spring-mass": {"kind": "spring-mass", "mass": 0.5, "stiffness": 2e4},
}


@pytest.mark.parametrize("gravity", [9.81, 200.0])
@pytest.mark.parametrize("target", HELD)
@pytest.mark.parametrize("striker", STRIKERS)
def test_rods_that_fall_on_what_is_held(striker, target, gravity):
    """Against a march of masses on springs in place of the rods, 200 to a rod, by velocity Verlet."""
    scene = dropped(LINEAR, HELD[target], gravity, **STRIKERS[striker])
    found = solvers.solve(scene, "waves", duration=0.05)
    assert abs(found.diagnostics["energy_error"]) < 1e-9 and abs(found.diagnostics["momentum_error"]) < 1e-9
    count = 200 * len(scene.impactor.rods)
    mass, soft = np.full(count, math.pi * 1e-4 * 1e3 / 200), IMPEDANCE / TRANSIT * 200
    mass[-1] += STRIKERS[striker].get("end_mass", 0.0)
    half = 2.0 * soft  # of half a piece, from the first mass to the face
    between = 1.0 / (1.0 / LINEAR["stiffness"] + 1.0 / half)
    own, held = HELD[target].get("mass", math.inf), HELD[target].get("stiffness", 0.0)
    place, speed, moved, moving, step = np.zeros(count), np.full(count, scene.speed), 0.0, 0.0, 1e-5
    pushed = 0.0
    for _ in range(round(0.05 / step)):
        speed_half, moving_half = None, None
        for half_step in (0, 1):
            force = between * max(place[0] - moved, 0.0)
            inner = soft * np.diff(place)
            rate = np.full(count, gravity)
            rate[:-1] += inner / mass[:-1]
            rate[1:] -= inner / mass[1:]
            rate[0] -= force / mass[0]
            other = (force - held * moved) / own
            pushed += 0.5 * step * force
            if half_step == 0:
                speed_half, moving_half = speed + 0.5 * step * rate, moving + 0.5 * step * other
                place, moved = place + step * speed_half, moved + step * moving_half
            else:
                speed, moving = speed_half + 0.5 * step * rate, moving_half + 0.5 * step * other
    motion, end = found.known_motion, np.array([0.05])
    whole = float(mass @ speed / mass.sum())
    assert motion.impactor_velocity(end)[0] == approx(whole, abs=5e-3 * scene.speed)
    assert motion.impulse(end)[0] == approx(pushed, rel=5e-3)


def test_rods_that_fall_and_come_apart_are_refused_where_weight_matters():
    loose = CHAIN | {"rods": [CHAIN["rods"][0], CHAIN["rods"][0] | {"joint": "touching"}]}
    with pytest.raises(SceneNotSupported, match="weight"):
        solvers.solve(dropped({"law": "rigid"}, {"kind": "stop"}, **loose), "waves")
