"""The weight of what falls acts while it touches: by every method that has it, against solutions of its own."""

import math

import numpy as np
import pytest
from pytest import approx
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import solvers
from solvers import Rod, Scene, SceneError, SceneNotSupported
from solvers.bodies.drop import STANDARD_GRAVITY as G

LINEAR = {"law": "linear", "stiffness": 1e4}
LAWS = {
    "linear": LINEAR,
    "hertz": {"law": "hertz", "stiffness": 1e6},
    "power": {"law": "power", "stiffness": 1e5, "exponent": 1.3},
    "kelvin-voigt": {"law": "kelvin-voigt", "stiffness": 1e4, "damping": 5.0},
    "hunt-crossley": {"law": "hunt-crossley", "stiffness": 1e6, "damping": 0.2},
    "lee-wang": {"law": "lee-wang", "stiffness": 1e6, "damping": 0.2},
    "lankarani-nikravesh": {"law": "lankarani-nikravesh", "stiffness": 1e6, "damping": 0.2},
    "plastic-linear": {"law": "plastic-linear", "stiffness": 1e6, "yield_indentation": 0.01},
    "yigit-christoforou": {"law": "yigit-christoforou", "stiffness": 1e6, "yield_indentation": 0.01},
}


def dropped(law: dict, target: dict | None = None, mass: float = 80.0, height: float = 0.1, **more) -> Scene:
    return Scene.from_table(
        {"impactor": {"mass": mass, "height": height} | more, "target": target or {"kind": "stop"}, "contact": law}
    )


def marched(scene: Scene, own: float = 0.0, stiffness: float = 0.0) -> tuple[float, float, float]:
    """Peak force, parting and speed at it by DOP853: the mass, and that which a spring holds (own, stiffness)."""
    law, mass, most = scene.contact, scene.impactor.mass, [0.0]

    def force(depth, rate, deepest):
        return law.force(depth, rate, deepest) if depth > 0.0 else 0.0

    def rates(deepest):
        def of(_, y):
            push = force(y[0] - y[2], y[1] - y[3], deepest)
            other = (push - stiffness * y[2]) / own if own else 0.0
            return [y[1], G - push / mass, y[3], other]

        return of

    def turns(_, y):
        return y[1] - y[3]

    def parts(t, y):
        return force(y[0] - y[2], y[1] - y[3], most[0]) - 1e-13 if t > 1e-6 else 1.0

    turns.terminal, turns.direction, parts.terminal, parts.direction = True, -1.0, True, -1.0
    options = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-13, "max_step": 4e-3, "dense_output": True}
    first = solve_ivp(rates(0.0), (0.0, 5.0), [0.0, scene.speed, 0.0, 0.0], events=turns, **options)
    most[0] = float(first.y[0, -1] - first.y[2, -1])
    start = first.t[-1]
    second = solve_ivp(rates(most[0]), (start, 5.0), first.y[:, -1], events=parts, **options)
    instants = np.linspace(0.0, start, 4001)
    peaks = [force(y[0] - y[2], y[1] - y[3], 0.0) for y in first.sol(instants).T]
    return max(peaks), second.t[-1], float(second.y[1, -1])


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("height", [0.003, 0.1])
def test_a_mass_that_falls_on_a_stop(law, height):
    scene = dropped(LAWS[law], height=height)
    peak, parting, speed = marched(scene)
    found = solvers.solve(scene, "quasi-static")
    assert found.contacts[0].end == approx(parting, rel=2e-6)
    assert found.impactor_velocity == approx(speed, abs=2e-6 * scene.speed)
    assert found.peak_force == approx(peak, rel=2e-5)
    assert abs(found.diagnostics["energy_error"]) < 1e-12 and abs(found.diagnostics["momentum_error"]) < 1e-12
    by_modes = solvers.solve(scene, solvers.Modal(estimate=False))
    rises = [
        0.5 * each.impactor_velocity**2 / G - each.known_motion.impactor_position(each.contacts[0].end)
        for each in (found, by_modes)
    ]
    assert rises[1] == approx(rises[0], abs=1e-3 * height)  # within a step there are several instants of parting
    assert by_modes.peak_force == approx(peak, rel=2e-3)
    assert abs(by_modes.diagnostics["energy_error"]) < 1e-11


def test_the_published_case():
    """W + sqrt(W^2 + k m v^2), and how long it lasts; by a slider of a mechanism, too."""
    found = solvers.solve(dropped(LINEAR))
    weight, swing = 80.0 * G, 2.0 * 1e4 * 80.0 * G * 0.1
    assert found.method["name"] == "quasi-static"
    assert found.peak_force == approx(weight + math.sqrt(weight**2 + swing), rel=1e-12)
    lasts = 2.0 * math.sqrt(80.0 / 1e4) * (math.pi - math.atan(math.sqrt(swing) / weight))
    assert found.contact_time == approx(lasts, rel=1e-10)
    assert found.impactor_velocity == approx(-found.scene.speed, rel=1e-12)
    assert found.energy["weight"] == approx(0.0, abs=1e-9)


@pytest.mark.parametrize("law", ["linear", "kelvin-voigt", "hertz"])
def test_as_a_slider_of_a_mechanism(law):
    scene = dropped(LAWS[law])
    slider = {
        "kind": "mechanism",
        "links": [{"name": "ram", "from": [0.0, 0.0], "to": [0.0, 1.0], "mass": 80.0}],
        "joints": [{"kind": "prismatic", "links": ["ground", "ram"], "at": [0.0, 0.0], "axis": [0.0, 1.0]}],
        "drives": [{"joint": 0, "speed": -scene.speed, "initial": True}],
        "struck": {"link": "ram", "at": 0.0, "normal": [0.0, -1.0]},
        "gravity": [0.0, -G],
    }
    other = Scene.from_table({"impactor": slider, "target": {"kind": "stop"}, "contact": LAWS[law]})
    whole, found = solvers.solve(other, "multibody"), solvers.solve(scene)
    assert found.peak_force == approx(whole.peak_force, rel=2e-4)
    assert found.contact_time == approx(whole.contacts[0].duration, rel=2e-3)  # one looks at faces, one at forces


def test_from_no_height_the_peak_is_twice_the_weight():
    found = solvers.solve(dropped(LINEAR, height=1e-6))
    assert found.peak_force == approx(2.0 * 80.0 * G, rel=1e-4)
    assert found.peak_force > 2.0 * 80.0 * G


@pytest.mark.parametrize("method", ["quasi-static", "modal"])
def test_with_damping_it_comes_to_rest_under_its_weight(method):
    found = solvers.solve(dropped({"law": "kelvin-voigt", "stiffness": 1e4, "damping": 1000.0}), method)
    assert [note.code for note in found.notes] == ["comes-to-rest"]
    assert found.peak_force == approx(1545.942, rel=2e-5)
    end = np.array([found.duration * (1.0 - 1e-9)])
    assert found.known_motion.force(end)[0] == approx(80.0 * G, rel=2e-6)
    assert found.known_motion.impactor_position(end)[0] == approx(80.0 * G / 1e4, rel=2e-6)
    assert len(found.contacts) == 1 and found.restitution["newton"] is None
    assert found.energy["weight"] == approx(-80.0 * G * 80.0 * G / 1e4, rel=1e-5)


def test_what_yields_may_swing_for_ever():
    found = solvers.solve(dropped(LAWS["plastic-linear"], height=1e-6))
    assert [note.code for note in found.notes] == ["never-leaves"] and len(found.contacts) == 1


def test_within_a_given_duration_it_comes_back():
    """Without loss every contact is as the first, a flight 2 v / g apart."""
    scene = dropped(LINEAR)
    found = solvers.solve(scene, duration=2.0)
    lasts, flight = found.contacts[0].duration, 2.0 * scene.speed / G
    assert len(found.contacts) == 3
    for number, contact in enumerate(found.contacts[:-1]):
        assert contact.start == approx(number * (lasts + flight), abs=1e-9)
        assert contact.impulse == approx(found.contacts[0].impulse, rel=1e-9)
    assert abs(found.diagnostics["energy_error"]) < 1e-10


@pytest.mark.parametrize("mass", [0.0, 10.0])
def test_on_a_spring_as_one(mass):
    """(m + m') u'' + k u = m g from the common velocity on; they part where the spring would pull."""
    target = {"kind": "spring-mass", "mass": 10.0, "stiffness": 1e4}
    model = "structural" if mass else "structural-massless"
    scene = dropped({"law": "rigid"}, target)
    found = solvers.solve(scene, "quasi-static", model=model)
    omega, start, sag = math.sqrt(1e4 / (80.0 + mass)), scene.speed * 80.0 / (80.0 + mass), 80.0 * G / 1e4

    def pushes(t):
        u = sag * (1.0 - math.cos(omega * t)) + start / omega * math.sin(omega * t)
        return 80.0 * (G + omega**2 * (u - sag))

    later = next(t for t in np.linspace(0.0, 2.0 * math.pi / omega, 2001) if pushes(t) < 0.0)
    parting = brentq(pushes, later - math.pi / 1000.0 / omega, later)
    assert found.contact_time == approx(parting, rel=1e-9)
    assert found.impactor_velocity == approx(
        sag * omega * math.sin(omega * parting) + start * math.cos(omega * parting), rel=1e-9
    )
    assert abs(found.diagnostics["energy_error"]) < 1e-12 and abs(found.diagnostics["momentum_error"]) < 1e-12


def test_a_mass_that_falls_on_a_mass_on_a_spring():
    scene = dropped({"law": "linear", "stiffness": 1e6}, {"kind": "spring-mass", "mass": 10.0, "stiffness": 1e4})
    peak, parting, _ = marched(scene, 10.0, 1e4)
    found = solvers.solve(scene)
    assert found.method["name"] == "modal"
    assert found.contacts[0].end == approx(parting, rel=5e-4) and found.contacts[0].peak_force == approx(peak, rel=2e-3)
    assert abs(found.diagnostics["energy_error"]) < 1e-11


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_balances_on_a_spring(restitution):
    """Event by event: both move freely, by weight and by the spring, until they meet."""
    scene = dropped({"law": "rigid"}, {"kind": "spring-mass", "mass": 10.0, "stiffness": 1e4})
    found = solvers.solve(scene, "balance", restitution=restitution)
    assert abs(found.diagnostics["energy_error"]) < 1e-12 and abs(found.diagnostics["momentum_error"]) < 1e-12
    if restitution == 0.0:  # as one, until the spring would pull
        whole = solvers.solve(scene, "quasi-static", model="structural")
        assert found.contacts[0].end == approx(whole.contact_time, rel=1e-9)
        assert found.impactor_velocity == approx(whole.impactor_velocity, rel=1e-9)
        return
    omega, speed = math.sqrt(1e4 / 10.0), scene.speed
    common = 80.0 * speed / 90.0
    first, second = common - restitution * speed * 10.0 / 90.0, common + restitution * speed * 80.0 / 90.0

    def gap(t):
        return second / omega * math.sin(omega * t) - first * t - 0.5 * G * t**2

    later = next(t for t in np.linspace(1e-4, 1.0, 10_001) if gap(t) < 0.0)
    assert found.contacts[1].start == approx(brentq(gap, later - 1e-4, later), rel=1e-9)


def test_a_light_blow_never_leaves_a_spring_that_carries_a_mass():
    scene = dropped({"law": "rigid"}, {"kind": "spring-mass", "mass": 10.0, "stiffness": 1e4}, height=1e-5)
    found = solvers.solve(scene, "quasi-static")
    assert "never-leaves" in [note.code for note in found.notes]
    assert len(found.contacts) == 1 and found.contacts[0].end == found.duration


# --- beams and rods


BEAM = {"kind": "beam", "length": 1.2, "section": {"width": 0.06, "height": 0.01}, "material": "steel", "at": 0.5}


@pytest.mark.parametrize(
    "stiffness, peak, leaves, contacts",
    [(3.8e5, 2226.0, -3.149, 2), (4.5e5, 2581.0, None, 2), (7.92e5, 3008.0, -2.764, 3)],
)
def test_a_drop_test_on_a_beam(stiffness, peak, leaves, contacts):
    """Figures by sine modes of the beam and exact oscillators, with weight; without it they are 6 to 30 % off."""
    beam = BEAM | {"support": "pinned-pinned"}
    found = solvers.solve(dropped({"law": "linear", "stiffness": stiffness}, beam, 2.0, 0.75))
    assert found.peak_force == approx(peak, abs=1.0) and len(found.contacts) == contacts
    assert leaves is None or found.impactor_velocity == approx(leaves, abs=1e-3)
    assert abs(found.diagnostics["energy_error"]) < 1e-9


SOFT = {"young": 1e7, "density": 1e3, "poisson": 0.3}
SOFT_ROD = {"kind": "rod", "length": 1.0, "section": {"radius": 0.01}, "material": SOFT}


def modes_of_soft_rod(scene: Scene, count: int = 60) -> tuple[float, float]:
    """Rebound and parting by DOP853: a mass and modes of a fixed rod, those left out as a spring in series."""
    rod, law, mass = scene.target.known_as(Rod), scene.contact, scene.impactor.mass
    omega = (np.arange(count) + 0.5) * math.pi * rod.wave_speed / rod.length
    at = math.sqrt(2.0 / rod.mass)
    rest = rod.length / (rod.material.young * rod.area) - float(np.sum(at**2 / omega**2))
    stiffness = 1.0 / (1.0 / law.stiffness + rest)

    def force(y):
        return stiffness * max(y[0] - at * y[2 : 2 + count].sum(), 0.0)

    def rates(_, y):
        push = force(y)
        q, p = y[2 : 2 + count], y[2 + count :]
        return np.concatenate(([y[1], G - push / mass], p, at * push - omega**2 * q))

    def parts(t, y):
        return y[0] - at * y[2 : 2 + count].sum() if t > 1e-3 else 1.0

    parts.terminal, parts.direction = True, -1.0
    start = np.zeros(2 + 2 * count)
    start[1] = scene.speed
    found = solve_ivp(rates, (0.0, 1.0), start, method="DOP853", rtol=1e-9, atol=1e-12, events=parts)
    return float(found.y[1, -1]), float(found.t[-1])


@pytest.fixture(scope="module")
def soft_rod() -> tuple[Scene, float, float]:
    """And its rebound and parting."""
    scene = dropped({"law": "linear", "stiffness": 1e5}, SOFT_ROD | {"support": "fixed"}, 2.0)
    return scene, *modes_of_soft_rod(scene)


@pytest.mark.parametrize(
    "method, options",
    [
        ("modal", {}),
        ("fe-modal", {}),
        ("fe-nodal", {}),
        ("fe-nodal", {"scheme": "central-difference"}),
        ("fe-nodal", {"status": "frozen"}),
    ],
)
def test_a_mass_that_falls_on_a_soft_rod(method, options, soft_rod):
    """Without weight it would leave after 0.081 s."""
    scene, speed, parting = soft_rod
    found = solvers.solve(scene, method, **options)
    assert found.contacts[-1].end == approx(parting, rel=1e-3)
    assert found.impactor_velocity == approx(speed, abs=2e-3 * scene.speed)
    assert abs(found.diagnostics["momentum_error"]) < 1e-10
    assert abs(found.diagnostics["energy_error"]) < (1e-4 if options else 1e-10)


@pytest.mark.parametrize("method", ["modal", "fe-modal", "fe-nodal"])
def test_weight_acts_along_the_whole_length_of_what_falls(method):
    """A free rod speeds up as one: only the contact sends waves into it, and its centre obeys m v' = m g - F."""
    scene = Scene.from_table(
        {
            "impactor": SOFT_ROD | {"height": 0.1},
            "target": {"kind": "stop"},
            "contact": {"law": "linear", "stiffness": 1e5},
        }
    )
    found = solvers.solve(scene, method)
    motion, time = found.known_motion, np.linspace(0.0, found.duration, 7)
    freely = scene.speed + G * time - motion.impulse(time) / scene.impactor.mass
    assert motion.impactor_velocity(time) == approx(freely, abs=1e-9)
    assert found.impactor_velocity == approx(-1.396, abs=3e-3)
    assert abs(found.diagnostics["energy_error"]) < 1e-10
    middle = motion.displacement(time[:1], np.array([-0.5]))[0, 0]
    assert middle == approx(0.0, abs=1e-12)


@pytest.mark.parametrize("method", ["fe-modal", "fe-nodal"])
def test_on_a_rod_with_a_dashpot_it_comes_to_rest(method):
    law = {"law": "kelvin-voigt", "stiffness": 2e3, "damping": 60.0}
    found = solvers.solve(dropped(law, SOFT_ROD | {"support": "fixed"}, 2.0, 0.01), method, elements=4)
    assert "comes-to-rest" in [note.code for note in found.notes]
    depth = 2.0 * G * (1.0 / 2e3 + 1.0 / (1e7 * math.pi * 1e-4))
    assert found.known_motion.impactor_position(np.array([found.duration]))[0] == approx(depth, rel=1e-4)


def test_gravity_beside_a_velocity_is_the_weight_of_what_is_thrown():
    thrown = Scene.from_table(
        {
            "impactor": {"mass": 80.0, "velocity": dropped(LINEAR).speed, "gravity": G},
            "target": {"kind": "stop"},
            "contact": LINEAR,
        }
    )
    assert solvers.solve(thrown).peak_force == approx(solvers.solve(dropped(LINEAR)).peak_force, rel=1e-14)
    assert Scene.from_table(thrown.table()) == thrown
    lighter = dropped(LINEAR).replace({"impactor.velocity": 2.0})
    assert lighter.gravity == G and lighter.table()["impactor"]["gravity"] == G


def test_what_nothing_holds_falls_as_well():
    falling = dropped(LINEAR, {"kind": "mass", "mass": 10.0})
    plain = Scene.from_table(
        {
            "impactor": {"mass": 80.0, "velocity": falling.speed},
            "target": {"kind": "mass", "mass": 10.0},
            "contact": LINEAR,
        }
    )
    found, other = solvers.solve(falling), solvers.solve(plain)
    assert (found.peak_force, found.impactor_velocity) == (other.peak_force, other.impactor_velocity)
    assert [note.code for note in found.notes] == ["weight-falls-along"]


def test_a_method_without_weight_says_how_much_it_leaves_out_or_refuses():
    rod = {"kind": "rod", "length": 1.0, "section": {"radius": 0.01}, "material": "steel", "support": "fixed"}
    quick, slow = dropped({"law": "rigid"}, rod, 2.0), dropped(LAWS["hertz"])
    left_out = solvers.solve(quick, "mode-switch")
    note = next(note for note in left_out.notes if note.code == "weight-left-out")
    share = G * left_out.contacts[-1].end / quick.speed
    assert note.values["share"] == approx(100.0 * share) and left_out.diagnostics["estimated_error"] >= share
    with pytest.raises(SceneNotSupported, match="weight"):
        solvers.solve(slow, "quasi-static", model="hertz-sine")


def test_what_is_dropped_on_a_mechanism_falls_by_its_gravity():
    bar = solvers.load("trip-hammer").struck.target.table() | {"gravity": [0.0, -9.81]}
    bar |= {"struck": {"link": "arm", "at": 1.0, "normal": [0.0, -1.0]}, "drives": []}
    ball = {"mass": 1.0, "height": 0.1}
    scene = Scene.from_table({"impactor": ball, "target": bar, "contact": {"law": "hertz", "stiffness": 1e9}})
    assert scene.speed == approx(math.sqrt(2.0 * 9.81 * 0.1)) and Scene.from_table(scene.table()) == scene
    for gravity, wrong in (([0.0, -9.81], {"gravity": 5.0}), ([9.81, 0.0], {}), ([0.0, 0.0], {})):
        with pytest.raises(SceneError) as refused:
            Scene.from_table({"impactor": ball | wrong, "target": bar | {"gravity": gravity}})
        assert refused.value.key == ("impactor.gravity" if wrong else "impactor.height")


def test_auto_takes_a_method_with_weight():
    """However exact waves are otherwise."""
    rod = {"kind": "rod", "length": 1.0, "section": {"radius": 0.01}, "material": "steel", "support": "fixed"}
    scene = dropped({"law": "hertz", "stiffness": 1e9}, rod, 2.0, 1.0)
    found = solvers.solve(scene, "auto", tolerance=1e-4)  # a rigid impulse is 1.2e-3 off
    assert "weight-left-out" not in [note.code for note in found.notes]
    assert found.energy["weight"] != 0.0
    assert solvers.solve(scene).method["name"] == "waves"  # so little that a note says all
    slow = scene.replace({"impactor.height": 1e-4})
    assert solvers.usual_method(slow) == "waves" and solvers.solve(slow).energy["weight"] != 0.0
