"""Waves in several rods: what is known exactly, what must not change, when it is over."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

import solvers
from solvers import LAWS, Scene, SceneError, Waves
from solvers.numerics.waves import network as wave_network

SPEED = 5000.0  # m/s, of waves in the material below
MATERIAL = {"young": 2e11, "density": 8000.0}


def rod(length, area=1e-3, **more):
    return {"length": length, "section": {"area": area}, "material": MATERIAL} | more


def struck(impactor, target, contact=None):
    return Scene.from_table({"impactor": impactor, "target": target, "contact": contact or {"law": "rigid"}})


def striker(length, velocity=1.0, area=1e-3):
    return {"kind": "rod", "velocity": velocity} | rod(length, area)


def chain(*rods, support="free", **more):
    return {"kind": "rods", "rods": list(rods), "support": support} | more


def test_two_equal_rods_exchange_their_velocities():
    scene = struck(striker(1.0), {"kind": "rod", "support": "free", "velocity": -1.0} | rod(1.0))  # thesis 4.3
    solution = solvers.solve(scene)
    assert [(c.start, c.end) for c in solution.contacts] == [(0.0, approx(2.0 / SPEED, rel=1e-12))]
    assert solution.peak_force == approx(1e-3 * 8000.0 * SPEED, rel=1e-12)  # A v sqrt(E rho)
    assert (solution.impactor_velocity, solution.target_velocity) == (approx(-1.0), approx(1.0))
    assert solution.energy["target_vibration"] == approx(0.0, abs=1e-9)


@pytest.mark.parametrize("length, first, second", [(3.5, 1.0, 0.0), (3.0, 2.0, -1.0), (5.0, 1.0, 0.25)])
def test_a_short_rod_is_stopped_by_a_long_one(length, first, second):
    scene = struck(striker(1.0, first), {"kind": "rod", "support": "free", "velocity": second} | rod(length))
    solution = solvers.solve(scene)
    assert solution.contacts[0].end == approx(2.0 / SPEED, rel=1e-12)  # thesis 4.3, (4.7)
    assert solution.impactor_velocity == approx(second, abs=1e-12)  # all its speed over the long rod's is given
    assert abs(solution.diagnostics["energy_error"]) < 1e-13


def test_a_step_of_impedance_lets_through_what_it_must():
    scene = struck({"mass": 1e6, "velocity": 1.0}, chain(rod(1.0), rod(1.0, 3e-3), support="anechoic"))
    motion = solvers.solve(scene, duration=1.5 / SPEED).motion
    first = 1e-3 * 8000.0 * SPEED  # Z v, the mass being as good as infinite
    through = motion.stress(np.array([1.4 / SPEED]), np.array([1.2]))[0, 0] * 3e-3
    assert through == approx(first * 2.0 * 3.0 / (1.0 + 3.0), rel=1e-5)


@pytest.mark.parametrize("law", ["rigid", "hertz", "plastic-linear", "kelvin-voigt"])
@pytest.mark.parametrize("support", ["fixed", "free"])
def test_a_rod_cut_in_three_and_bonded_is_the_rod(law, support):
    contact = {"law": law} | solvers.LAWS[law].EXAMPLE
    whole = solvers.solve(struck({"mass": 4.0, "velocity": 1.0}, rod(1.0) | {"support": support}, contact))
    parts = chain(rod(0.2), rod(0.3), rod(0.5), support=support)
    cut = solvers.solve(struck({"mass": 4.0, "velocity": 1.0}, parts, contact))
    assert cut.impactor_velocity == approx(whole.impactor_velocity, abs=1e-8)
    # where a damped force fades out its end is known less well than the velocity
    assert [c.end for c in cut.contacts] == approx([c.end for c in whole.contacts], rel=1e-6)


def test_a_rod_without_end_is_a_dashpot():
    mass, impedance = 4.0, 1e-3 * 8000.0 * SPEED
    solution = solvers.solve(struck({"mass": mass, "velocity": 1.0}, rod(1.0) | {"support": "anechoic"}))
    t = np.linspace(0.0, 3.0 * mass / impedance, 50)
    expected = np.exp(-impedance * t / mass)
    assert solution.motion.impactor_velocity(t) == approx(expected, abs=1e-10)
    assert abs(solution.diagnostics["energy_error"]) < 1e-11


def test_a_part_that_flies_over_a_gap_comes_back_and_strikes_again():
    target = chain(rod(0.5), rod(2.0, 4e-3, joint="touching", gap=0.01), support="fixed")
    solution = solvers.solve(struck({"mass": 4.0, "velocity": 1.0}, target))
    long = solvers.solve(struck({"mass": 4.0, "velocity": 1.0}, target), duration=3.0 * solution.contacts[-1].end)
    assert len(solution.contacts) == len(long.contacts) == 3
    assert solution.impactor_velocity == approx(long.impactor_velocity, abs=1e-9)
    assert solution.impactor_velocity < 0.0  # away from what is held


@pytest.mark.parametrize("trips", [1, 2, 3, 4])
def test_a_mass_on_the_far_end_keeps_momentum_also_as_a_front_arrives(trips):
    scene = struck({"mass": 4.0, "velocity": 1.0}, rod(0.9) | {"support": "free", "end_mass": 3.0})
    found = solvers.solve(scene, duration=trips * 0.9 / SPEED).diagnostics
    assert abs(found["momentum_error"]) < 1e-10
    assert abs(found["energy_error"]) < 1e-10


def test_a_front_that_turns_a_yielding_contact_is_followed():
    target = chain(rod(0.1), rod(0.5, 5e-3, joint="touching", gap=1e-5), support="fixed")
    contact = {"law": "plastic-linear", "stiffness": 1e10, "yield_indentation": 1e-6}
    solution = solvers.solve(struck({"mass": 20.0, "velocity": 1.0}, target, contact))
    assert solution.notes == []
    assert abs(solution.diagnostics["energy_error"]) < 1e-9


@pytest.mark.parametrize("law", [law for law in solvers.LAWS if law != "rigid"])
def test_every_law_serves_at_a_joint(law):
    contact = {"law": law} | solvers.LAWS[law].EXAMPLE
    target = chain(rod(0.5), rod(0.5, joint="touching", contact=contact))
    solution = solvers.solve(struck({"mass": 4.0, "velocity": 1.0}, target), duration=1e-3)
    assert abs(solution.diagnostics["energy_error"]) < 1e-8
    assert solution.joints[0]
    assert solution.energy["dissipated"] >= -1e-9 * solution.energy["initial"]


@settings(max_examples=25)
@given(
    areas=st.lists(st.floats(-1.0, 1.0).map(lambda p: 1e-3 * 10.0**p), min_size=2, max_size=3),
    lengths=st.lists(st.floats(0.2, 2.0), min_size=3, max_size=3),
    gap=st.sampled_from([0.0, 1e-5]),
    support=st.sampled_from(["free", "fixed", "anechoic"]),
    heavy=st.floats(0.1, 50.0),
)
def test_energy_and_momentum_are_kept_and_nothing_pulls(areas, lengths, gap, support, heavy):
    rods = [rod(lengths[0], areas[0])]
    rods += [rod(*pair, joint="touching", gap=gap) for pair in zip(lengths[1:], areas[1:], strict=False)]
    solution = Waves().solve(struck({"mass": heavy, "velocity": 1.0}, chain(*rods, support=support)), duration=2e-3)
    assert abs(solution.diagnostics["energy_error"]) < 1e-10
    assert abs(solution.diagnostics["momentum_error"]) < 1e-10
    assert solution.motion.force_history()[1].min() >= 0.0
    assert all(contact.impulse > -1e-12 for joint in solution.joints for contact in joint)
    assert math.isfinite(solution.impactor_velocity)


def test_a_law_of_a_joint_that_lacks_a_constant_is_named_where_it_stands():
    target = chain(rod(0.3), rod(0.3, joint="touching", contact={"law": "linear"}))
    with pytest.raises(SceneError) as refused:
        struck(striker(0.2), target)
    assert refused.value.key == "target.rods[2].contact.stiffness"


def test_the_network_is_compiled_once_whatever_strikes_whatever_by_any_law():
    solvers.solve(solvers.load("bronze-rod-steel-ball"))
    compiled = len(wave_network.solve.signatures)  # one, and those of kernels that call it
    for name in ("rod-with-gap", "pressure-bar"):
        solvers.solve(solvers.load(name))
    pressed = chain(rod(0.3), rod(0.3, joint="touching", contact={"law": "linear", "stiffness": 1e9}))
    for law in ("hertz", "plastic-power"):
        solvers.solve(struck(striker(0.2), pressed, {"law": law} | LAWS[law].EXAMPLE))
    assert len(wave_network.solve.signatures) == compiled


@pytest.mark.parametrize("duration", [None, 1e-3])
def test_what_a_damped_law_holds_as_its_faces_part_is_lost(duration):
    """As modes say: the force is over before the indentation is."""
    contact = {"law": "lee-wang", "stiffness": 1e9, "exponent": 1.5, "restitution": 0.1}
    target = {"kind": "rod", "length": 0.3, "section": {"area": 9e-4}, "material": "steel", "support": "fixed"}
    scene = Scene.from_table({"impactor": {"mass": 1.0, "velocity": 1.0}, "target": target, "contact": contact})
    found, modes = (solvers.solve(scene, method, duration).energy for method in ("waves", "modal"))
    assert (found["local"], modes["local"]) == approx((0.0, 0.0), abs=1e-12)
    assert found["dissipated"] == approx(modes["dissipated"], rel=1e-4)
