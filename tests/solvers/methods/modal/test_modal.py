"""Modal superposition: the limits it tends to, its contact times, conservation, and what its fields are made of.

Tolerances: 1e-11 and below are rounding, summed over up to 1e5 steps; the rest says where it comes from.
"""

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pytest import approx

import solvers
from solvers import Modal, SceneError, Waves
from tests.catalog import (
    ROD,
    SCENES,
    SIGMA0_AREA,
    SUPPORTS,
    WITH_INDENTATION,
    T,
    bronze_rod,
    contact_table,
    struck_rod,
)

EXACT_FIXED = -0.6988755819961635  # v+ / v for equal masses, thesis (4.37) to 16 digits


@cache
def fixed_rod(modes: int):
    return Modal(modes=modes).solve(SCENES["fixed-rod"])


# --- what it tends to -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("modes, percent", [(20, 1.05), (50, 0.45), (100, 0.16)])
def test_rigid_contact_on_the_fixed_rod(modes, percent):
    # against 3.6 % and a missed second contact with the stiffness of the neighbouring element, thesis table 8.2
    solution = fixed_rod(modes)
    assert abs(solution.impactor_velocity / EXACT_FIXED - 1.0) < percent / 100.0
    assert len(solution.contacts) == 2
    # as sharp as the shortest kept period, which is all these modes resolve
    first, second = solution.contacts
    for found, exact in ((first.end, 1.533833820809153), (second.start, 2.124623234942172)):  # (4.25), (4.31)
        assert found / T == approx(exact, abs=solution.diagnostics["resolved_time"] / T)


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("beta", [0.3, 3.0])
def test_rigid_contact_tends_to_the_exact_waves(beta, support):
    scene = struck_rod(beta, support)
    exact = Waves().solve(scene, 6.0 * T).impactor_velocity
    misses = [abs(Modal(modes=n).solve(scene, 6.0 * T).impactor_velocity - exact) for n in (25, 100, 400)]
    assert misses[2] < 0.25 * misses[0]  # 1 / modes would be a sixteenth
    assert misses[2] < 2e-3


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("softness", [0.3, 3.0])
@pytest.mark.parametrize("law", ["linear", "hertz"])
def test_elastic_laws_agree_with_the_waves_within_the_estimated_error(law, softness, support):
    scene = struck_rod(1.0, support, contact_table(law, softness))
    exact = Waves().solve(scene, 6.0 * T)
    modal = Modal(modes=60).solve(scene, 6.0 * T)
    miss = abs(modal.impactor_velocity - exact.impactor_velocity)
    assert miss <= max(modal.diagnostics["estimated_error"], 1e-9)  # 1e-9: the tolerance of the waves
    assert miss < 1e-3
    assert len(modal.contacts) == len(exact.contacts)
    # the force still rings at the last kept mode: 1 / modes of sigma_0 A
    assert modal.peak_force == approx(exact.peak_force, abs=SIGMA0_AREA / 60)


def test_hertz_on_the_free_bronze_rod_with_and_without_the_modes_left_out():
    # 30 free modes alone give -1.00892, as thesis 10.2 prints (-1.009); their residual compliance brings -1.0193,
    # and all modes -1.01936
    solution = Modal(modes=30).solve(bronze_rod())
    assert solution.impactor_velocity == approx(-1.0193, abs=1e-4)
    assert abs(solution.impactor_velocity - -1.00892) > 1e-2
    assert solution.target_velocity == approx(0.2 * (2.03 + 1.0193) / 3.99914, abs=1e-5)  # momentum


def test_one_mode_is_enough_to_run():
    for support in SUPPORTS:
        for law in solvers.LAWS:
            solution = Modal(modes=1).solve(struck_rod(1.0, support, contact_table(law)))
            assert -1.0 < solution.impactor_velocity < 1.0
            assert abs(solution.diagnostics["energy_error"]) < 1e-11


@pytest.mark.parametrize("support, rebound", [("free", (1.0 - 0.5) / (1.0 + 0.5)), ("fixed", -1.0)])
def test_a_soft_spring_leaves_no_vibration(support, rebound):
    # K -> 0: an elastic impact between two rigid bodies, (3.10), the fixed rod a wall; neglected: EA/L softness^-1
    softness = 1e6
    solution = Modal(modes=5).solve(struck_rod(0.5, support, contact_table("linear", softness)))
    assert solution.impactor_velocity == approx(rebound, abs=10.0 / softness)
    assert solution.energy["target_vibration"] < 10.0 / softness * solution.energy["initial"]


# --- contact times ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", WITH_INDENTATION)
def test_contact_times_are_located_inside_the_steps(law):
    scene = struck_rod(1.0, "free", contact_table(law, softness=3.0, restitution=0.6))

    def end(step):
        return Modal(modes=3, steps=round(6.0 * T / step)).solve(scene, 6.0 * T).contacts[0].end / T

    finest = end(6.0 * T / 64_000)
    for n in (1000, 2000, 4000):
        # second order with a factor of some 10, where the step would be 6 / n
        assert abs(end(6.0 * T / n) - finest) < 10.0 * (6.0 / n) ** 2


# --- what must be conserved -------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("law", solvers.LAWS)
@settings(max_examples=50)
@given(
    modes=st.integers(1, 1000),
    steps=st.floats(1.0, 5.0).map(lambda power: round(10.0**power)),
    stiffness=st.floats(-6.0, 6.0).map(lambda power: 10.0**power),
    mass_ratio=st.floats(-2.0, 2.0).map(lambda power: 10.0**power),
    restitution=st.sampled_from([0.01, 0.3, 0.6, 0.9, 1.0]),
)
def test_energy_and_momentum_at_any_resolution(law, support, modes, steps, stiffness, mass_ratio, restitution):
    assume(modes * steps <= 2_000_000)
    scene = struck_rod(mass_ratio, support, contact_table(law, 1.0 / stiffness, restitution))
    solution = Modal(modes=modes, steps=steps).solve(scene, 8.0 * T)
    assert abs(solution.diagnostics["energy_error"]) <= 1e-11
    assert abs(solution.diagnostics["momentum_error"]) <= 1e-11
    initial = solution.energy["initial"]
    for name, value in solution.energy.items():
        assert value >= -1e-11 * initial, name
    if not (scene.contact.LOSSY or scene.contact.PLASTIC):
        assert solution.energy["dissipated"] == 0.0
    assert solution.motion.record.contact_force.min() >= 0.0
    assert np.all(np.diff(solution.motion.record.lost) >= -1e-15 * initial)
    assert solution.diagnostics["raw_contacts"] >= len(solution.contacts) >= 1


@pytest.mark.parametrize("law", solvers.LAWS)
@pytest.mark.parametrize("support", SUPPORTS)
def test_energy_is_kept_at_every_instant(law, support):
    solution = Modal(modes=20, steps=3000).solve(struck_rod(0.7, support, contact_table(law)), 4.0 * T)
    parts = solution.motion.energies(np.linspace(0.0, solution.duration, 100))
    assert sum(parts.values()) / solution.energy["initial"] == approx(np.ones(100), abs=1e-12)


def test_a_million_steps_do_not_drift():
    solution = Modal(modes=20, steps=1_000_000).solve(struck_rod(1.0, "fixed"), 200.0 * T)
    assert abs(solution.diagnostics["energy_error"]) <= 1e-11


@pytest.mark.parametrize("method", [Modal(modes=12, steps=900)])
@given(length=st.floats(-2.0, 2.0), density=st.floats(-2.0, 2.0), young=st.floats(-4.0, 1.5))
@settings(max_examples=20)
def test_units_of_mass_length_and_time_leave_the_result_unchanged(method, length, density, young):
    metre, kilogram = 10.0**length, 10.0 ** (density + 3.0 * length)
    second = math.sqrt(kilogram / metre / 10.0**young)
    plain = struck_rod(1.0, "free", contact_table("hertz"))
    scaled = solvers.Scene.from_table(
        {
            "impactor": {"mass": plain.impactor.mass * kilogram, "velocity": metre / second},
            "target": {
                "length": ROD.length * metre,
                "section": {"area": ROD.area * metre**2},
                "material": {
                    "young": ROD.material.young * 10.0**young,
                    "density": ROD.material.density * 10.0**density,
                },
                "support": "free",
            },
            "contact": {
                "law": "hertz",
                "stiffness": plain.contact.stiffness * kilogram / second**2 / math.sqrt(metre),
            },
        }
    )
    one = method.solve(plain, 5.0 * T)
    other = method.solve(scaled, 5.0 * T * second)
    assert other.impactor_velocity * second / metre == approx(one.impactor_velocity, abs=1e-11)
    assert other.contacts[0].end / second == approx(one.contacts[0].end, rel=1e-10)


# --- histories and fields ---------------------------------------------------------------------------------------------


def test_resolved_force_is_the_mean_over_the_shortest_kept_period():
    solution = fixed_rod(50)
    motion, period = solution.motion, solution.diagnostics["resolved_time"]
    assert period == approx(T / 49.5, rel=1e-12)  # the 50th mode of the fixed rod: (50 - 1/2) pi c / L
    time = np.linspace(period, solution.duration - period, 40)
    edges, forces = motion.force_history()
    # the integral of a piecewise constant history, by brute force
    fine = np.linspace(-0.5, 0.5, 40_001)
    middles = 0.5 * (fine[1:] + fine[:-1])
    means = [np.mean(motion.force(t + period * middles)) for t in time]
    # two ends of the interval fall inside a brute-force cell each
    assert motion.resolved_force(time) == approx(np.array(means), abs=forces.max() * 4.0 / 40_000)
    assert edges[0] == 0.0


def test_resolved_force_is_much_nearer_to_the_exact_solution_than_the_raw_one():
    exact = Waves().solve(SCENES["fixed-rod"]).motion
    time = (np.arange(4000) + 0.5) / 4000 * 1.5 * T  # within the first contact
    true = exact.force(time)
    misses = []
    for modes in (20, 50, 100):
        motion = fixed_rod(modes).motion
        raw, resolved = (
            math.sqrt(np.mean((force - true) ** 2) / np.mean(true**2))
            for force in (motion.force(time), motion.resolved_force(time))
        )
        assert resolved < raw / 3.0
        misses.append(resolved)
    # what is left is the smeared jump: its width is a period, its square root counts
    assert misses[0] > misses[1] > misses[2]
    assert misses[2] < 0.15


def amplitudes_from_the_forces(solution):
    """q (instants, modes) and q' of every mode, from the recorded forces by its own convolution."""
    record, step = solution.motion.record, solution.motion.step
    modes = solution.scene.target.modes(solution.method["modes"])
    instants = np.arange(record.contact_force.size + 1) * step
    q, p = np.zeros((2, instants.size, modes.frequencies.size))
    for i, (omega, phi) in enumerate(zip(modes.frequencies, modes.at_contact, strict=True)):
        for k, force in enumerate(record.contact_force):
            # a force constant over one step, then free oscillation
            after = instants[k + 1 :] - instants[k]
            push = phi * force / omega**2
            q[k + 1 :, i] += push * (np.cos(omega * (after - step)) - np.cos(omega * after))
            p[k + 1 :, i] -= push * omega * (np.sin(omega * (after - step)) - np.sin(omega * after))
    return modes, instants, q, p


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("law", ["rigid", "hertz"])
def test_fields_are_sums_of_modes(law, support):
    solution = Modal(modes=6, steps=400).solve(struck_rod(1.0, support, contact_table(law)), 3.0 * T)
    motion, x = solution.motion, np.linspace(0.0, ROD.length, 11)
    modes, instants, q, p = amplitudes_from_the_forces(solution)
    # thesis (5.2): cos(k x) from the struck, free end; normalised by the mass
    halves = np.arange(1, 7) - (0.5 if support == "fixed" else 0.0)
    wavenumbers = np.pi * halves / ROD.length
    shapes = math.sqrt(2.0 / ROD.mass) * np.cos(np.outer(wavenumbers, x))
    slopes = -math.sqrt(2.0 / ROD.mass) * wavenumbers[:, None] * np.sin(np.outer(wavenumbers, x))
    impulses = np.concatenate([[0.0], np.cumsum(motion.record.contact_force)]) * motion.step
    rigid_velocity = np.zeros(401) if support == "fixed" else impulses / ROD.mass
    rigid_place = np.concatenate([[0.0], np.cumsum(0.5 * (rigid_velocity[1:] + rigid_velocity[:-1]))]) * motion.step
    # what the modes left out add: all of them together bend the rod as a steady force does
    along = x / ROD.length
    steady = (1.0 - along if support == "fixed" else 1.0 / 3.0 - along + 0.5 * along**2) / ROD.stiffness
    beside = steady - (modes.at_contact / modes.frequencies**2) @ shapes
    assert beside[0] == approx(modes.residual_compliance, rel=1e-9)
    spring = motion.record.spring_force
    if law == "rigid":
        spring = np.maximum(motion.record.indentation, 0.0) / modes.residual_compliance
    moved = rigid_place[:, None] + q @ shapes + np.outer(spring, beside)
    assert motion.displacement(instants, x) == approx(moved, abs=1e-11 * T)
    assert motion.velocity(instants, x) == approx(rigid_velocity[:, None] + p @ shapes, abs=1e-10)
    stress_unit = SIGMA0_AREA / ROD.area
    assert motion.stress(instants, x) == approx(-ROD.material.young * q @ slopes, abs=1e-10 * stress_unit)
    assert motion.end_velocity(instants) == approx(motion.velocity(instants, x)[:, 0], abs=1e-10)
    assert motion.end_position(instants) == approx(moved[:, 0], abs=1e-11 * T)


def test_fields_between_instants_and_from_checkpoints():
    """The same field whether it is read at an instant, just beside it, or rebuilt from far checkpoints."""
    solution = Modal(modes=300, steps=20_000).solve(struck_rod(1.0, "free", contact_table("hertz")), 5.0 * T)
    motion = solution.motion
    assert motion.stride > 1
    x = np.linspace(0.0, ROD.length, 5)
    instants = np.array([7, 5003, 12_345]) * motion.step
    at, beside = motion.velocity(instants, x), motion.velocity(instants + 1e-9 * motion.step, x)
    assert beside == approx(at, abs=1e-6)
    alone = np.vstack([motion.velocity(instants[k : k + 1], x) for k in range(3)])
    assert at == approx(alone, abs=1e-13)


@pytest.mark.parametrize("support", SUPPORTS)
def test_fields_meet_the_far_end(support):
    solution = Modal(modes=15).solve(struck_rod(1.0, support, contact_table("hertz")))
    t = np.random.default_rng(4).uniform(0.0, solution.duration, 100)
    far = np.array([ROD.length])
    if support == "fixed":
        assert solution.motion.velocity(t, far) == approx(np.zeros((100, 1)), abs=1e-12)
    else:
        assert solution.motion.stress(t, far) == approx(np.zeros((100, 1)), abs=1e-12 * SIGMA0_AREA / ROD.area)


def test_force_history_is_constant_over_each_step():
    motion = Modal(modes=4, steps=50).solve(struck_rod(1.0, "fixed"), T).motion
    times, forces = motion.force_history()
    assert times.size == forces.size == 100
    assert np.trapezoid(forces, times) == approx(motion.impulse(np.array([T]))[0], rel=1e-13)


# --- other bodies -----------------------------------------------------------------------------------------------------

BAR = {"kind": "rod", "length": 0.3, "section": {"area": 9e-4}, "material": "steel"}  # the steel rod again
BALL = {"kind": "sphere", "radius": 0.02, "material": "steel"}


def between(impactor: dict, target: dict, contact: dict) -> solvers.Scene:
    return solvers.Scene.from_table({"impactor": impactor, "target": target, "contact": contact})


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


# --- contacts and chatter ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("beta", [0.036, 0.1414, 0.5, 2.0, 5.88, 12.7])
def test_as_many_contacts_as_there_are(beta, support):
    """On heavy rods the force fades long before the bodies part, and chatter opens gaps of many periods."""
    scene = struck_rod(beta, support)
    found, exact = Modal(modes=50, estimate=False).solve(scene), Waves().solve(scene)
    assert len(found.contacts) == len(exact.contacts)
    raw = found.diagnostics["raw_contacts"]
    assert raw >= len(found.contacts)
    assert any("chatter" in str(note) for note in found.notes) == (raw > len(found.contacts))


def test_an_impact_too_short_for_the_modes_is_said():
    short = Modal(modes=20, estimate=False).solve(struck_rod(15.0, "free"))
    (note,) = (note for note in short.notes if "too short" in str(note))
    assert "150 modes" in str(note)  # T / 30 against 5 T / 20
    resolved = Modal(modes=46, estimate=False).solve(struck_rod(15.0, "free"))
    assert not any("too short" in str(note) for note in resolved.notes)
    assert len(resolved.contacts) == 1


def test_still_in_contact_does_not_hang_on_chatter():
    # the fixed rod is in contact until 1.534 T, and the raw force of 50 modes comes and goes
    scene = struck_rod(1.0, "fixed")
    for until in np.linspace(0.4, 1.45, 22):
        found = Modal(modes=50, estimate=False).solve(scene, until * T)
        assert "still in contact" in str(found.notes[0])
        assert found.contacts[-1].end == approx(until * T, rel=1e-12)
        assert found.restitution["newton"] is None
    found = Modal(modes=50, estimate=False).solve(scene, 1.7 * T)
    assert found.contacts[-1].end / T == approx(1.534, abs=0.02)
    assert not any("still" in str(note) for note in found.notes)


def test_rigid_contact_gives_no_velocity_of_the_struck_face():
    # it chatters with the last kept modes and does not converge
    assert fixed_rod(50).restitution["newton_at_contact"] is None
    soft = Modal(modes=50).solve(struck_rod(1.0, "free", contact_table("hertz", 3.0)))
    exact = Waves().solve(soft.scene)
    assert soft.restitution["newton_at_contact"] == approx(exact.restitution["newton_at_contact"], abs=1e-4)


def test_mean_velocity_of_a_held_rod():
    found = fixed_rod(50).motion
    exact = Waves().solve(SCENES["fixed-rod"]).motion
    time = np.linspace(0.05, 2.0, 40) * T
    assert found.rigid_velocity(time) == approx(exact.rigid_velocity(time), abs=0.02)
    x = (np.arange(2000) + 0.5) / 2000 * ROD.length
    assert found.rigid_velocity(time) == approx(found.velocity(time, x).mean(axis=1), abs=1e-4)  # 50 modes, midpoints


@pytest.mark.parametrize("softness", [0.3, 3.0])
def test_damping_acts_on_the_whole_force(softness):
    # with the elastic part alone on the modes left out the error was 1 / modes: 1.3e-3 and 3.3e-4 here
    scene = struck_rod(1.0, "free", contact_table("hunt-crossley", softness))
    exact = Waves().solve(scene, 6.0 * T).impactor_velocity
    found = Modal(modes=20, steps=40_000, estimate=False).solve(scene, 6.0 * T)
    assert found.impactor_velocity == approx(exact, abs=1e-6)


def test_limits_of_the_law_are_noted():
    hard = {"young": 210e9, "density": 7900.0, "yield": 300e6}
    target = {"kind": "half-space", "material": hard}
    elastic = Modal().solve(between(BALL | {"velocity": 1.0}, target, {"law": "hertz"}))
    assert any("first yield" in str(note) for note in elastic.notes)
    plastic = Modal().solve(between(BALL | {"velocity": 1.0}, target, {"law": "plastic-power"}))
    assert plastic.notes == []


# --- options ----------------------------------------------------------------------------------------------------------


def test_steps_and_duration_are_kept():
    solution = Modal(modes=7, steps=321).solve(struck_rod(1.0, "fixed"), 3.0 * T)
    assert solution.diagnostics["steps"] == 321
    assert solution.duration == approx(3.0 * T, rel=1e-15)
    assert solution.method == {"name": "modal", "modes": 7, "steps": 321, "frame": "mean-axis", "residual": True}


def test_steps_without_a_duration_go_over_the_whole_impact():
    unasked = Modal(modes=10).solve(struck_rod(1.0, "fixed"))
    solution = Modal(modes=10, steps=2000).solve(struck_rod(1.0, "fixed"))
    assert solution.diagnostics["steps"] == 2000
    assert solution.duration == approx(unasked.duration, rel=1e-12)


@pytest.mark.parametrize(
    "options, key",
    [
        ({"modes": 0}, "method.modes"),
        ({"modes": 10_001}, "method.modes"),
        ({"modes": 2.5}, "method.modes"),
        ({"modes": True}, "method.modes"),
        ({"steps": 9}, "method.steps"),
        ({"steps": 10**400}, "method.steps"),
        ({"tolerance": 1e-9}, "method.tolerance"),
        ({"duration": 1.0}, "method.duration"),
    ],
)
def test_bad_options_are_refused(options, key):
    with pytest.raises(SceneError) as refused:
        Modal.read(options)
    assert refused.value.key == key


@pytest.mark.parametrize("method", ["modal", "fe-nodal", "fe-modal"])
def test_a_number_of_steps_is_no_limit_that_cuts_an_impact_short(method):
    solution = solvers.solve(bronze_rod(), method, steps=4000)
    assert not [note for note in solution.notes if "limit" in str(note)]
