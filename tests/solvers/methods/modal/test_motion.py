"""The motion that modes leave: resolved force, and fields as sums of modes.

Tolerances: 1e-11 and below are rounding, summed over up to 1e5 steps; the rest says where it comes from.
"""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Modal, Waves
from tests.catalog import ROD, SCENES, SIGMA0_AREA, SUPPORTS, T, contact_table, struck_rod
from tests.solvers.methods.modal.fixed_rod import fixed_rod


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
    steady = (0.0 * along - 1.0 if support == "fixed" else along - 1.0) / (ROD.stiffness * ROD.length)
    beside = steady - (modes.at_contact / modes.frequencies**2) @ slopes
    strain = q @ slopes + np.outer(motion.smoothed_force(instants), beside)
    assert motion.stress(instants, x) == approx(-ROD.material.young * strain, abs=1e-10 * stress_unit)
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
    times = np.random.default_rng(5).uniform(0.0, motion.duration, 60)  # in any order, and twice the same
    times = np.concatenate((times, np.sort(times), times[:1] + np.arange(5) * motion.step))
    alone = np.vstack([motion.amplitudes(times[k : k + 1]) for k in range(times.size)])
    assert np.array_equal(np.stack(motion.amplitudes(times), axis=1).reshape(alone.shape), alone)


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


def test_mean_velocity_of_a_held_rod():
    found = fixed_rod(50).motion
    exact = Waves().solve(SCENES["fixed-rod"]).motion
    time = np.linspace(0.05, 2.0, 40) * T
    assert found.rigid_velocity(time) == approx(exact.rigid_velocity(time), abs=0.02)
    x = (np.arange(2000) + 0.5) / 2000 * ROD.length
    assert found.rigid_velocity(time) == approx(found.velocity(time, x).mean(axis=1), abs=1e-4)  # 50 modes, midpoints


def test_the_energy_is_read_without_the_estimate_of_the_error(monkeypatch):
    """It takes other solves, which once made reading an energy cost twice the impact."""
    estimated = solvers.solve("fixed-rod", "modal").diagnostics["estimated_error"]
    monkeypatch.setattr(solvers.Modal, "_estimated_error", lambda *_: 1.0)
    solution = solvers.solve("fixed-rod", "modal")
    solution.refine("diagnostics", lambda *_: pytest.fail("worked out"))
    assert solution.energy["initial"] > 0.0 and solution.impulse > 0.0 and solution.restitution["newton"] is not None
    assert solvers.solve("fixed-rod", "modal").diagnostics["estimated_error"] == 1.0 > estimated
