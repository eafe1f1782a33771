"""Modes of whatever strikes whatever: two rods, masses, springs, half-spaces, and what they cannot do."""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Modal, SceneError
from tests.catalog import ROD, SIGMA0_AREA, WITH_INDENTATION, T, contact_table, struck_rod
from tests.solvers.methods.modal.pairs import BALL, BAR, between


@pytest.mark.parametrize("law", [law for law in WITH_INDENTATION if solvers.LAWS[law].LOSSY])
def test_what_a_spent_dashpot_still_holds_is_lost(law):
    """At restitution 0.02 the bodies part long before their surfaces are back: 0.5 to 1.3 % stayed in the contact."""
    constants = {"stiffness": 1e9, "restitution": 0.02}
    scene = between({"mass": 1.0, "velocity": 1.0}, {"kind": "mass", "mass": 2.0}, {"law": law} | constants)
    found = Modal(estimate=False).solve(scene)
    whole = 0.5 * scene.reduced_mass * scene.speed**2
    # the restitution itself is second order in the step, 1e-5 of the speed
    assert found.energy["dissipated"] == approx((1.0 - 0.02**2) * whole, rel=1e-5)
    assert found.energy["local"] == 0.0 and abs(found.diagnostics["energy_error"]) < 1e-13
    lost = found.motion.energies(np.linspace(0.0, found.duration, 500))["dissipated"]
    assert np.diff(lost).min() >= -1e-15 * whole


@pytest.mark.parametrize("method", ["modal", "fe-nodal", "fe-modal"])
def test_rods_part_from_a_spent_dashpot_with_nothing_in_it(method):
    law = {"law": "lee-wang", "stiffness": 2e10, "restitution": 0.1}
    found = solvers.solve(struck_rod(1.0, "free", law), method)
    # 1.1e-4 of the energy when it was left where it was; the rest is the residual spring's
    assert found.energy["local"] < 1e-6 * found.energy["initial"]
    assert abs(found.diagnostics["energy_error"]) < 1e-10


@pytest.mark.parametrize("law", WITH_INDENTATION)
def test_bodies_without_waves_part_with_the_restitution_of_the_law(law):
    scene = between(
        {"mass": 1.0, "velocity": 1.0},
        {"kind": "mass", "mass": 2.0, "velocity": -0.5},
        {"law": law} | solvers.LAWS[law].EXAMPLE,
    )
    found = Modal().solve(scene)
    assert abs(found.diagnostics["energy_error"]) < 1e-13
    assert abs(found.diagnostics["momentum_error"]) < 1e-13
    assert len(found.contacts) == found.diagnostics["raw_contacts"] == 1
    assert found.diagnostics["resolved_time"] == 0.0
    if scene.contact.LOSSY:
        delivered = scene.contact.delivered(scene.reduced_mass, scene.speed)
        # second order in some 400 steps of a contact
        assert found.restitution["newton"] == approx(delivered, abs=5e-5)
    elif scene.contact.PLASTIC:
        # what is stored at the deepest point is given back; that itself is second order
        deepest = found.peak_indentation
        back = scene.contact.stored(deepest, deepest) / (0.5 * scene.reduced_mass * scene.speed**2)
        assert found.restitution["newton"] == approx(math.sqrt(back), abs=2e-4)
        assert found.residual_indentation == scene.contact.dent(deepest) > 0.0
    else:
        assert found.restitution["newton"] == approx(1.0, abs=1e-12)
    if not scene.contact.PLASTIC:
        assert found.residual_indentation == 0.0


STRONG = [
    ({"law": law} | more, restitution)
    for law, more in (
        ("kelvin-voigt", {}),
        ("hunt-crossley", {}),
        ("lankarani-nikravesh", {}),
        ("lee-wang", {"exponent": 1.0}),
        ("lee-wang", {"exponent": 1.5}),
    )
    for restitution in (0.01, 0.02, 0.03)
]


@pytest.mark.parametrize(("law", "restitution"), STRONG)
@pytest.mark.parametrize("steps", [None, 30_000])
def test_strong_damping_lets_compact_bodies_touch_once(law, restitution, steps):
    """The dent closes at the very rate at which the force is zero; beside the law's own integral."""
    contact = law | {"stiffness": 1e9, "restitution": restitution}
    scene = between({"mass": 1.0, "velocity": 1.0}, {"kind": "mass", "mass": 3.0}, contact)
    exact = solvers.solve(scene, "quasi-static")
    found = Modal(steps=steps).solve(scene)
    (known,), (contact,) = exact.contacts, found.contacts
    assert found.diagnostics["raw_contacts"] == 1 and not found.notes
    # a step of some 200 for the end; the peak is second order in them, but for a jump, which is no matter of steps
    coarse = steps is None
    assert contact.end == approx(known.end, rel=2e-3 if coarse else 1e-4)
    sure = 1e-12 if law["law"] == "kelvin-voigt" else 1e-2 if coarse else 1e-3
    assert found.peak_force == approx(exact.peak_force, rel=sure)


def test_a_force_that_jumps_is_known_at_every_touch():
    """Not the mean of the first step: C v at the first, and what the faces' rate makes of it at the second."""
    contact = {"law": "kelvin-voigt", "stiffness": 1e9, "restitution": 0.2}
    scene = between({"mass": 1.0, "velocity": 1.0}, {"kind": "spring-mass", "mass": 0.3, "stiffness": 1e6}, contact)
    found = Modal(estimate=False).solve(scene)
    first, second = found.contacts
    assert first.peak_force == approx(scene.contact.damping * scene.speed, rel=1e-12)
    motion = found.known_motion
    before = second.start - motion.step * np.array([2.0, 4.0])
    last, earlier = motion.impactor_velocity(before) - motion.end_velocity(before)
    rate = 2.0 * last - earlier  # on to the touch
    assert second.peak_force == approx(scene.contact.damping * rate, rel=1e-4)


def test_hertz_on_a_half_space_in_closed_form():
    found = Modal(steps=20_000).solve(
        between(BALL | {"velocity": 1.0}, {"kind": "half-space", "material": "steel"}, {"law": "hertz"})
    )
    mass, stiffness = found.scene.impactor.mass, found.scene.contact.stiffness
    depth = (1.25 * mass / stiffness) ** 0.4  # (3.31)
    assert found.peak_indentation == approx(depth, rel=1e-6)
    assert found.peak_force == approx(stiffness * depth**1.5, rel=1e-4)  # constant over a step
    assert found.contacts[0].end == approx(2.9432750 * depth, rel=1e-5)  # (3.33)


def test_a_mass_on_a_spring_is_one_exact_mode():
    """Against the two exact oscillators of mass, stiff spring and mass on a spring, until they part."""
    k, stiff = 1e6, 2e7
    scene = between(
        {"mass": 1.0, "velocity": 1.0},
        {"kind": "spring-mass", "mass": 1.5, "stiffness": k},
        {"law": "linear", "stiffness": stiff},
    )
    found = Modal(steps=40_000).solve(scene, 2e-3)
    matrix = np.array([[stiff, -stiff], [-stiff / 1.5, (stiff + k) / 1.5]])
    squares, shapes = np.linalg.eig(matrix)
    omega = np.sqrt(squares)
    rates = np.linalg.solve(shapes, [1.0, 0.0])

    def state(t):
        return shapes @ (rates * np.sin(omega * t) / omega), shapes @ (rates * np.cos(omega * t))

    parting = found.contacts[0].end
    (x, u), (v, w) = state(parting)
    assert x - u == approx(0.0, abs=1e-6 * found.peak_indentation)
    at = np.array([parting])
    assert found.motion.impactor_velocity(at)[0] == approx(v, abs=1e-6)
    assert found.motion.end_velocity(at)[0] == approx(w, abs=1e-6)
    assert found.motion.rigid_velocity(at)[0] == approx(w, abs=1e-6)
    assert found.motion.displacement(at, np.zeros(1))[0, 0] == approx(found.motion.end_position(at)[0], abs=1e-12)
    assert len(found.contacts) == 1


def test_two_equal_rods_exchange_their_speed():
    # thesis 4.3: in contact for one round trip, and the struck rod goes on alone
    found = Modal(modes=50).solve(between(BAR | {"velocity": 1.0}, BAR | {"support": "free"}, {"law": "rigid"}))
    assert found.impactor_velocity == approx(0.0, abs=2e-3)  # 1 / modes
    assert found.target_velocity == approx(1.0, abs=2e-3)
    assert len(found.contacts) == 1
    assert found.contacts[0].end == approx(T, abs=found.diagnostics["resolved_time"])
    assert found.peak_force == approx(0.5 * SIGMA0_AREA, rel=0.15)  # half the speed, plus the overshoot of two fronts
    # half-way all of it stands under the same pressure, which has run equally far into both
    x = np.linspace(-0.14, 0.14, 14)  # kept modes carry none through the struck faces
    stress = found.motion.stress(np.array([0.5 * T]), x)[0]
    assert stress == approx(stress[::-1], abs=1e-6 * stress.max())
    assert stress == approx(np.full(14, 0.5 * SIGMA0_AREA / ROD.area), rel=0.15)
    assert found.energy["impactor"] == approx(0.0, abs=2e-3 * found.energy["initial"])


def test_a_rod_against_a_stop_mirrors_two_equal_rods():
    law = {"law": "hertz", "stiffness": 2e10}
    pair = Modal(modes=30, steps=4000).solve(
        between(BAR | {"velocity": 1.0}, BAR | {"support": "free", "velocity": -1.0}, law), 4.0 * T
    )
    # in the frame of the contact each rod meets a wall with half the indentation: K (2 a)^1.5 = 2^1.5 K a^1.5
    wall = law | {"stiffness": 2e10 * 2.0**1.5}
    stop = Modal(modes=30, steps=4000).solve(between(BAR | {"velocity": 1.0}, {"kind": "stop"}, wall), 4.0 * T)
    assert stop.impactor_velocity == approx(pair.impactor_velocity, abs=1e-11)
    assert pair.target_velocity == approx(-pair.impactor_velocity, abs=1e-11)
    assert stop.contacts[0].end == approx(pair.contacts[0].end, rel=1e-9)


@pytest.mark.parametrize("law", ["hertz", "kelvin-voigt", "plastic-power"])
def test_the_same_impact_seen_from_either_body(law):
    """A rod that strikes a mass is a mass that strikes a rod."""
    contact = contact_table(law, softness=2.0) | ({"damping": 3e4} if law == "kelvin-voigt" else {})
    contact.pop("restitution", None)
    one = Modal(modes=20, steps=3000).solve(
        between(BAR | {"velocity": 1.0}, {"kind": "mass", "mass": 1.0}, contact), 5.0 * T
    )
    other = Modal(modes=20, steps=3000).solve(
        between({"mass": 1.0, "velocity": 1.0}, BAR | {"support": "free"}, contact), 5.0 * T
    )
    assert 1.0 - one.impactor_velocity == approx(other.target_velocity, abs=1e-11)
    assert 1.0 - one.target_velocity == approx(other.impactor_velocity, abs=1e-11)
    assert one.restitution["newton_at_contact"] == approx(other.restitution["newton_at_contact"], abs=1e-9)
    # all the energy of the rod counts as the impactor's
    parts = one.motion.energies(np.linspace(0.0, one.duration, 30))
    assert sum(parts.values()) / one.energy["initial"] == approx(np.ones(30), abs=1e-12)
    x, t = np.linspace(0.0, 0.3, 7), np.linspace(0.1, 5.0, 9) * T
    mirrored = one.motion.velocity(t, -np.maximum(x, 1e-300))
    assert 1.0 - mirrored == approx(other.motion.velocity(t, x), abs=1e-9)
    stress = other.motion.stress(t, x)
    assert one.motion.stress(t, -np.maximum(x, 1e-300)) == approx(stress, abs=1e-9 * np.abs(stress).max())


def test_a_moving_target_changes_nothing_but_the_velocities():
    law = contact_table("hunt-crossley", softness=2.0)
    still = Modal(modes=20).solve(between({"mass": 2.0, "velocity": 1.7}, BAR | {"support": "free"}, law))
    moving = Modal(modes=20).solve(
        between({"mass": 2.0, "velocity": 1.0}, BAR | {"support": "free", "velocity": -0.7}, law)
    )
    assert moving.impactor_velocity + 0.7 == approx(still.impactor_velocity, abs=1e-11)
    assert moving.target_velocity + 0.7 == approx(still.target_velocity, abs=1e-11)
    assert moving.contacts[0].end == approx(still.contacts[0].end, rel=1e-10)


@pytest.mark.parametrize(
    "impactor, target, words",
    [
        ({"mass": 1.0}, {"kind": "rods", "rods": [{k: BAR[k] for k in ("length", "section", "material")}]}, "chain"),
        ({"mass": 1.0}, BAR | {"support": "anechoic"}, "'waves'"),
        ({"mass": 1.0}, BAR | {"support": "free", "end_mass": 1.0}, "'waves'"),
        ({"mass": 1.0}, {"kind": "stop"}, "use 'rigid'"),
        ({"mass": 1.0}, {"kind": "spring-mass", "mass": 1.0, "stiffness": 1e6}, "use 'rigid'"),
    ],
)
def test_what_modes_cannot_do_is_said(impactor, target, words):
    with pytest.raises(SceneError, match=words):
        Modal().solve(between(impactor | {"velocity": 1.0}, target, {"law": "rigid"}))


def test_limits_of_the_law_are_noted():
    hard = {"young": 210e9, "density": 7900.0, "yield": 300e6}
    target = {"kind": "half-space", "material": hard}
    elastic = Modal().solve(between(BALL | {"velocity": 1.0}, target, {"law": "hertz"}))
    assert any("first yield" in str(note) for note in elastic.notes)
    plastic = Modal().solve(between(BALL | {"velocity": 1.0}, target, {"law": "plastic-power"}))
    assert plastic.notes == []
