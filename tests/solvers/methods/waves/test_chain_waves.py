"""Chains of rods whose waves are many or late: nothing is lost, nothing given up, and what is less exact says so."""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene
from solvers.contact import HuntCrossley
from solvers.methods.validity import ended_early
from solvers.methods.waves import chain as wave_chain
from solvers.methods.waves import chain_grid, chain_solve
from solvers.methods.waves.chain import ExactHistory
from solvers.methods.waves.chain_grid import GridHistory, best_steps, rounded
from solvers.methods.waves.chain_motion import ChainMotion
from solvers.methods.waves.chain_scene import ChainScene

RIGID = {"law": "rigid"}


def rod(length, area=9e-4, **more):
    return {"length": length, "section": {"area": area}, "material": "steel"} | more


def struck(mass, rods, support, contact=RIGID):
    target = {"kind": "rods", "rods": list(rods), "support": support}
    return Scene.from_table({"impactor": {"mass": mass, "velocity": 1.0}, "target": target, "contact": contact})


def velocity_at_end(history):
    return float(ChainMotion(history).impactor_velocity(np.array([history.reach * history.trip]))[0])


# --- late contacts ----------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("duration", [None, 0.03])
def test_a_gap_before_a_rod_without_end_is_closed_however_late(duration):
    rods = rod(0.3), rod(0.3, 9e-3, joint="touching", gap=1e-3)
    solution = solvers.solve(struck(0.5, rods, "anechoic"), duration=duration)
    assert solution.duration >= 9e-3 if duration is None else solution.duration == approx(duration, rel=1e-12)
    (joint,) = solution.joints[0]
    assert joint.start == approx(4.26e-3, rel=2e-3)
    assert joint.impulse == approx(0.909, abs=1e-3)
    assert len(solution.contacts) == 2
    # the same by a kernel that knows nothing of events
    given = ChainScene(solution.scene)
    grid = GridHistory(given, 0.0105 / given.trip, math.inf)
    assert solution.impactor_velocity == approx(velocity_at_end(grid), abs=2e-5)
    assert solution.impactor_velocity < -0.3
    assert [note.code for note in solution.notes] == ["pulse-short"]


def test_contacts_before_a_rod_without_end_are_followed_until_nothing_is_left():
    solution = solvers.solve(struck(1.3, (rod(0.3), rod(0.3, 1.98e-4)), "anechoic"))
    assert len(solution.contacts) >= 4
    assert solution.contacts[1].start == approx(3.337e-3, rel=1e-3)
    assert abs(solution.impactor_velocity) <= 1e-6
    assert solution.impulse == approx(1.3, rel=2e-6)  # all momentum goes down the rod
    assert solution.diagnostics["estimated_error"] >= 1e-6
    assert any("changes the velocities by a millionth" in str(note) for note in solution.notes)


def test_a_pulse_is_followed_for_as_long_as_asked():
    target = {"kind": "rods", "rods": [rod(0.3), rod(0.3, joint="touching", gap=1e-4)], "support": "free"}
    impactor = {"kind": "pulse", "force": 720.0, "duration": 5.8e-5}
    solution = solvers.solve(Scene.from_table({"impactor": impactor, "target": target}), duration=0.02)
    assert solution.duration == approx(0.02, rel=1e-12)
    (joint,) = solution.joints[0]
    # the first rod flies on with its momentum over its mass, and gives all of it to its equal
    speed = solution.impulse / solution.scene.target.rods[0].mass
    assert joint.start == approx(1e-4 / speed, rel=0.03)  # it moves by leaps, one per round trip
    assert joint.impulse == approx(solution.impulse, rel=1e-9)
    position = solution.motion.displacement(np.array([0.012, 0.02]), np.array([0.6]))[:, 0]
    assert position[1] - position[0] == approx(0.008 * speed, rel=0.03)  # it goes on moving to the end


# --- laws that were not solved ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("support", ["free", "fixed", "anechoic"])
def test_a_damped_joint_that_sends_steep_fronts_is_solved(support):
    contact = {"law": "lee-wang", "stiffness": 1e11, "exponent": 1.0, "restitution": 0.1}
    area = math.pi * 1e-4
    rods = rod(0.2, area), rod(0.1, area, joint="touching", gap=1e-7, contact=contact)
    solution = solvers.solve(struck(5.0, rods, support))
    assert not ended_early(solution.notes)
    assert abs(solution.diagnostics["energy_error"]) < 1e-8
    assert solution.energy["dissipated"] > 0.0


# --- a coarser tolerance, and the grid --------------------------------------------------------------------------------

THREE = rod(0.3), rod(0.217, 4e-4), rod(0.11, 2e-3)
YIELDING = {"law": "plastic-linear", "stiffness": 1e10, "yield_indentation": 1e-6}
GAPS = (
    rod(0.3),
    rod(0.217, 4e-4, joint="touching", gap=1e-6, contact=YIELDING),
    rod(0.11, 2e-3, joint="touching", contact=YIELDING),
)


@pytest.mark.parametrize(
    "rods, support, contact, trips",
    [
        (THREE, "free", RIGID, 3.0),
        ((rod(0.3), rod(0.3, 9e-3, joint="touching", gap=1e-4)), "anechoic", RIGID, 10.0),
        (THREE, "fixed", {"law": "hertz", "stiffness": 1e10}, 5.0),
        (THREE, "anechoic", {"law": "kelvin-voigt", "stiffness": 1e9, "restitution": 0.6}, 5.0),
        (GAPS, "free", {"law": "hertz", "stiffness": 1e10}, 5.0),
    ],
    ids=["rigid", "gap", "hertz", "kelvin-voigt", "yielding joints"],
)
def test_the_grid_is_of_second_order_and_agrees_with_what_follows_every_event(rods, support, contact, trips):
    given = ChainScene(struck(0.5, rods, support, contact))
    exact = velocity_at_end(ExactHistory(given, trips, 1e-11))

    def error(share):
        """The largest of some grids next to each other: on one of them events may happen to fall well."""
        grids = (GridHistory(given, trips, trips, share * (1.0 + 0.1 * k)) for k in range(5))
        return max(abs(velocity_at_end(grid) - exact) for grid in grids)

    coarse, fine = error(0.02), error(0.2)
    assert fine < 5e-6
    assert math.log10(coarse / fine) > 1.6  # 2, but for how events fall on the grid


def test_on_a_grid_nothing_is_lost_but_where_rigid_faces_meet():
    scene = struck(0.5, THREE, "free", {"law": "hertz", "stiffness": 1e10})
    grid = GridHistory(ChainScene(scene), 5.0, 5.0, 0.05)
    motion, end = ChainMotion(grid), np.array([grid.reach * grid.trip])
    energies = motion.energies(end)
    assert sum(float(part[0]) for part in energies.values()) == approx(scene.initial_energy, rel=1e-12)
    momentum = scene.target.mass * motion.rigid_velocity(end)[0] + 0.5 * motion.impactor_velocity(end)[0]
    assert momentum == approx(0.5, rel=1e-12)


def test_the_grid_changes_lengths_little_and_masses_not_at_all():
    chain = ChainScene(struck(0.5, (rod(0.3), rod(0.3 / math.sqrt(2.0)), rod(0.3 / math.pi)), "free")).chain
    count, lags = best_steps(chain, 20.0, 50_000)
    on_grid = rounded(chain, lags, 20.0 / count)
    assert np.abs(on_grid.transit / chain.transit - 1.0).max() < 20.0 / count / chain.transit.min() / 20.0
    assert on_grid.transit * on_grid.impedance == approx(chain.transit * chain.impedance, rel=1e-14)


def many_echoes():
    """Six unequal bonded rods: fronts multiply."""
    return [rod(0.1 * (1.0 + 0.17 * i), math.pi * 1e-4 * (1.0 + 0.3 * (i % 2))) for i in range(6)]


def test_a_chain_with_too_many_echoes_is_solved_less_exactly_and_says_so(monkeypatch):
    scene = struck(0.5, many_echoes(), "free", {"law": "hertz", "stiffness": 1e10})
    whole = solvers.solve(scene, duration=1e-3)
    assert whole.notes == []
    monkeypatch.setattr(wave_chain, "MAX_STRETCHES", whole.diagnostics["steps"] // 2)
    looser = solvers.solve(scene, duration=1e-3)
    assert any("followed to a tolerance of 1e-07" in str(note) for note in looser.notes)
    monkeypatch.setattr(wave_chain, "MAX_STRETCHES", 400)
    grid = solvers.solve(scene, duration=1e-3)
    assert any("stepped on a grid" in str(note) for note in grid.notes)
    for found in (looser, grid):
        assert not ended_early(found.notes)
        assert found.duration == whole.duration
        off = abs(found.impactor_velocity - whole.impactor_velocity)
        assert off <= 2.0 * found.diagnostics["estimated_error"] + whole.diagnostics["estimated_error"]
        assert found.diagnostics["estimated_error"] < 1e-4
        assert len(found.contacts) == len(whole.contacts)


@pytest.mark.parametrize("nodes", [3_000, 10_000, 30_000])
def test_a_first_contact_on_a_grid_that_is_too_coarse_is_solved_anew(nodes, monkeypatch):
    """Before a rod without end a force may fade for ever, over which a grid is laid that knows nothing of the peak."""
    scene = struck(0.5, many_echoes(), "anechoic", {"law": "kelvin-voigt", "stiffness": 1e9, "restitution": 0.3})
    exact = solvers.solve(scene, duration=2e-3).contacts[0]
    monkeypatch.setattr(wave_chain, "MAX_STRETCHES", 400)
    monkeypatch.setattr(chain_grid, "NODE_STEPS", nodes)
    found = solvers.solve(scene)
    first, estimated = found.contacts[0], found.diagnostics["estimated_error"]
    assert found.peak_force >= first.peak_force
    # the end of the first contact is known to a step of the grid that is laid over it
    sure = estimated + 2.0 * chain_solve.CLOSER * (len(scene.target.rods) + 1) / nodes
    assert first.peak_force == approx(exact.peak_force, rel=sure)
    assert first.end == approx(exact.end, rel=sure)
    history = found.known_motion.force(np.linspace(first.start, first.end, 2_000))
    off = abs(history.max() / exact.peak_force - 1.0)
    assert off < 0.01 + sure or "grid-too-coarse" in [note.code for note in found.notes]
    assert off < estimated + sure


@pytest.mark.parametrize("support", ["free", "anechoic"])
def test_on_a_grid_too_bodies_are_followed_until_they_part_for_good(support, monkeypatch):
    scene = struck(0.5, many_echoes(), support)
    whole = solvers.solve(scene)
    monkeypatch.setattr(chain_solve, "ExactHistory", _gives_up)
    grid = solvers.solve(scene)
    assert grid.contacts[-1].end == approx(whole.contacts[-1].end, rel=1e-3)
    assert grid.impactor_velocity == approx(whole.impactor_velocity, abs=1e-6)
    assert len(grid.contacts) == len(whole.contacts)
    assert not ended_early(grid.notes)


def _gives_up(given, until, tolerance, **options):
    history = ExactHistory(given, min(until, 0.1), tolerance)
    history.gave_up = True
    return history


def test_a_pulse_is_followed_until_its_push_has_closed_the_gap():
    """Also where no time is asked for: the first rod comes over 0.1 mm with the momentum of the pulse."""
    target = {"kind": "rods", "rods": [rod(0.3), rod(0.5, joint="touching", gap=1e-4)], "support": "free"}
    pulse = {"kind": "pulse", "shape": "rectangle", "force": 1000.0, "duration": 1e-4}
    found = solvers.solve(Scene.from_table({"impactor": pulse, "target": target}))
    [[closing]] = found.joints
    mass = 0.3 * 9e-4 * found.scene.target.rods[0].material.density
    assert closing.start == approx(1e-4 * mass / 0.1, rel=0.1) and closing.end < found.duration
    assert closing.impulse == approx(0.1, rel=1e-9)  # the longer rod takes all of it


def test_a_bonded_joint_bears_tension():
    """Its impulse is the momentum behind it, at any time."""
    found = solvers.solve(struck(1.0, [rod(0.3), rod(0.2)], "free"), duration=1e-3)
    [[period]] = found.joints
    places = 0.3 + 0.2 * (np.arange(4000) + 0.5) / 4000
    mass = found.scene.target.rods[1].mass
    momentum = mass * found.motion.velocity(np.array([1e-3]), places).mean()
    assert (period.end, period.impulse) == (approx(1e-3), approx(momentum, rel=2e-3))


def test_a_damped_surface_that_echoes_bring_back_to_rest_presses_no_more():
    """On a free rod the closing speed comes back after two round trips to just that at which the force ended: what is
    left of a force there is error."""
    scene = solvers.load("free-rod")
    scene = scene.with_impactor_mass(scene.target.mass / 0.1944402799627793)
    law = HuntCrossley(0.4852980359622802, 4.653820119359451)  # in units of T, v and Z v
    units = (scene.speed * scene.time_unit, scene.speed, scene.target.impedance * scene.speed)
    law = law.scaled(*(1.0 / unit for unit in units))
    table = {"law": law.NAME, "stiffness": law.stiffness, "damping": law.damping}
    (contact,) = solvers.solve(scene.replace({"contact": table})).contacts
    assert contact.end / scene.time_unit == approx(1.759018, abs=1e-5)
