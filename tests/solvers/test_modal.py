"""Modal superposition: the limits it tends to, its order in the step, conservation, and what its fields are made of.

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
    # as sharp as the shortest kept period, which is all these modes can tell
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
    # K -> 0: an elastic blow between two rigid bodies, (3.10), the fixed rod being a wall; neglected: EA/L softness^-1
    softness = 1e6
    solution = Modal(modes=5).solve(struck_rod(0.5, support, contact_table("linear", softness)))
    assert solution.impactor_velocity == approx(rebound, abs=10.0 / softness)
    assert solution.energy["target_vibration"] < 10.0 / softness * solution.energy["initial"]


# --- order in the step ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("support", SUPPORTS)
@pytest.mark.parametrize("law", solvers.LAWS)
def test_second_order_in_the_step_for_every_law(law, support):
    # few modes, and a step well below their shortest period: the method's own error and nothing else
    scene = struck_rod(1.0, support, contact_table(law, softness=3.0, restitution=0.6))
    duration = (0.9 if law == "rigid" else 6.0) * T  # rigid: within the first stretch of pressure, not across chatter

    def velocity(steps):
        return Modal(modes=3, steps=steps, estimate=False).solve(scene, duration).impactor_velocity

    # where a law yields or starts with a jump, the error depends on where in a step that happens: hence many near steps
    finest, counts = velocity(1_000_000), (2000, 8000, 32_000)
    misses = [math.sqrt(np.mean([(velocity(n + n * k // 50) - finest) ** 2 for k in range(8)])) for n in counts]
    order = np.polyfit(-np.log(counts), np.log(misses), 1)[0]
    assert order == approx(2.0, abs=0.3)


@pytest.mark.parametrize("law", ["linear", "hertz", "power", "hunt-crossley"])
def test_contact_times_are_located_inside_the_steps(law):
    scene = struck_rod(1.0, "free", contact_table(law, softness=3.0, restitution=0.6))

    def end(step):
        return Modal(modes=3, steps=round(6.0 * T / step)).solve(scene, 6.0 * T).contacts[0].end / T

    finest = end(6.0 * T / 64_000)
    for n in (1000, 2000, 4000):
        # second order with a factor of some 10, where the step would be 6 / n
        assert abs(end(6.0 * T / n) - finest) < 10.0 * (6.0 / n) ** 2


# --- what must be conserved -------------------------------------------------------------------------------------------


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


def test_resolved_force_is_much_nearer_to_the_truth_than_the_raw_one():
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
    assert motion.displacement(instants, x) == approx(rigid_place[:, None] + q @ shapes, abs=1e-11 * T)
    assert motion.velocity(instants, x) == approx(rigid_velocity[:, None] + p @ shapes, abs=1e-10)
    stress_unit = SIGMA0_AREA / ROD.area
    assert motion.stress(instants, x) == approx(-ROD.material.young * q @ slopes, abs=1e-10 * stress_unit)
    assert motion.end_velocity(instants) == approx(motion.velocity(instants, x)[:, 0], abs=1e-10)
    if law != "rigid":
        # beside the modes, the struck end gives way by the residual compliance
        surface = motion.displacement(instants, x)[:, 0] + modes.residual_compliance * motion.record.spring_force
        assert motion.end_position(instants) == approx(surface, abs=1e-11 * T)


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


# --- options ----------------------------------------------------------------------------------------------------------


def test_steps_and_duration_are_kept():
    solution = Modal(modes=7, steps=321).solve(struck_rod(1.0, "fixed"), 3.0 * T)
    assert solution.diagnostics["steps"] == 321
    assert solution.duration == approx(3.0 * T, rel=1e-15)
    assert solution.method == {"name": "modal", "modes": 7, "steps": 321, "frame": "mean-axis", "residual": True}


def test_steps_without_a_duration_go_over_the_whole_blow():
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
