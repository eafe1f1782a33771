"""Scenes of the thesis show the body, the method and the stretch of time of their figure, and what their notes say."""

import math
import re

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Solution
from solvers.contact import tabor
from solvers.contact.constants import contact_modulus
from tests.catalog import SCENES, SIGMA0_AREA, T


def numbers(name: str) -> list[float]:
    """All that stand in the note of a scene."""
    return [float(text) for text in re.findall(r"-?\d+(?:\.\d+)?", SCENES[name].note)]


@pytest.mark.parametrize("name", ["figure-4.8", "figure-9.13", *(f"figure-10.{k}" for k in range(3, 8))])
def test_what_comes_back_is_shown_three_times(name):
    scene = SCENES[name]
    assert solvers.solve(scene).duration >= 3.0 * scene.time_unit


# --- chapters 5 and 6 -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["figure-5.1", "figure-5.2"])
def test_the_first_mode_of_a_beam_on_two_supports_is_two_running_half_sines(name):
    """5.2: sin(k x) sin(w t) = [cos(k (x - c t)) - cos(k (x + c t))] / 2, each running at c = w / k."""
    scene = SCENES[name]
    beam, found = scene.target, solvers.solve(scene)
    assert (beam.kind, beam.support, found.method["modes"]) == ("beam", "pinned-pinned", 1)
    (contact,) = found.contacts
    k = math.pi / beam.length
    speed = k * math.sqrt(beam.material.young * beam.second_moment / (beam.material.density * beam.area))
    assert 0.5 * k * speed / math.pi == approx(779.3, abs=0.05)  # [Hz]
    assert speed == approx(467.6, abs=0.05) and contact.end == approx(0.40e-3, abs=0.005e-3)
    x, time = np.linspace(0.0, beam.length, 31), np.linspace(1.1 * contact.end, found.duration, 40)
    field = found.motion.displacement(time, x)
    amplitude = math.hypot(field[0, 15], found.motion.velocity(time[:1], x)[0, 15] / (k * speed))
    began = time[0] - math.atan2(field[0, 15], found.motion.velocity(time[:1], x)[0, 15] / (k * speed)) / (k * speed)
    gone = speed * (time[:, None] - began)
    assert field == approx(0.5 * amplitude * (np.cos(k * (x - gone)) - np.cos(k * (x + gone))), abs=1e-6 * amplitude)


def test_figure_5_10_has_a_second_contact():
    scene = SCENES["figure-5.10"]
    first, second = solvers.solve(scene, "waves").contacts
    assert [second.start / T, second.end / T] == approx(numbers("figure-5.10")[1:], abs=5e-3)
    assert 0.005 < second.impulse / first.impulse < 0.02
    assert len(solvers.solve(scene).contacts) == 1


def test_figure_6_5_the_circles_are_impulses_over_the_step():
    found = solvers.solve(SCENES["figure-6.5"])
    time, impulse = found.motion.impulses
    circles = impulse / found.method["step"]
    assert circles[:4] / 1e3 == approx(numbers("figure-6.5")[2:6], abs=0.5)  # "171, 224, 214, 209 kN"
    second = time > found.contacts[1].start - 1e-9
    assert circles[second] / 1e3 == approx([55.3, 62.5], abs=0.1)  # printed: two balances in the second contact
    assert found.peak_force / 1e3 == approx(81.0, abs=0.5)
    assert (2.0 + math.exp(-2.0)) * SIGMA0_AREA / 1e3 == approx(78.0, abs=0.5)


# --- chapter 7 --------------------------------------------------------------------------------------------------------


def test_figure_7_1_is_the_tip_of_a_cantilever():
    """8.4 says so. Deflection and indentation add up; the force depends on the indentation alone."""
    scene = SCENES["figure-7.1"]
    found = solvers.solve(scene)
    assert (scene.target.kind, scene.target.support, scene.target.at) == ("beam", "cantilever", 1.0)
    time = np.linspace(0.0, found.duration, 4001)
    deflection = found.motion.end_position(time)
    indentation = np.maximum(found.motion.impactor_position(time) - deflection, 0.0)
    law = scene.contact.stiffness * indentation**1.5
    assert np.abs(found.motion.force(time) - law).max() < 0.01 * found.peak_force  # the force is constant over a step
    assert found.peak_force == approx(scene.contact.stiffness * found.peak_indentation**1.5, rel=1e-5)
    assert (found.peak_indentation, deflection.max()) == (approx(0.049e-3, abs=5e-7), approx(1.10e-3, abs=5e-6))


def test_figure_7_8_how_near_the_power_law_comes_to_the_curve():
    """(7.33) over (7.28). Differs: "aproxima muy bien"."""
    scene = SCENES["figure-7.8"]
    law, flow = scene.contact, scene.target.material.yield_strength
    ratio = np.geomspace(1.0, law.full_indentation / law.yield_indentation, 4000)
    depth = ratio * law.yield_indentation
    modulus = contact_modulus(scene.impactor, scene.target)
    curve = tabor.force(depth, scene.impactor.radius, modulus, flow, law.yield_indentation, law.full_indentation)
    apart = np.array([law.force(a, 0.0, 0.0) for a in depth.tolist()]) / curve - 1.0
    assert (apart.min(), ratio[apart.argmin()]) == (approx(-0.052, abs=5e-4), approx(1.7, abs=0.05))
    assert (apart.max(), ratio[apart.argmax()]) == (approx(0.1475, abs=5e-4), approx(41.0, abs=0.5))
    assert apart[-1] == approx(0.041, abs=5e-4)


# --- chapter 8 --------------------------------------------------------------------------------------------------------


def lag(found: Solution, exact: Solution) -> float:
    """By how much the struck face is late during the first contact [s], in the least-squares sense."""
    time, delays = np.linspace(5e-6, 170e-6, 2001), np.linspace(0.0, 2e-6, 81)
    face = found.motion.end_position(time)
    return float(delays[np.argmin([np.sum((face - exact.motion.end_position(time - late)) ** 2) for late in delays])])


def test_figures_8_5_and_8_6_both_lag():
    """Differs: the text has no lag with modes."""
    exact = solvers.solve(SCENES["figure-8.5"], "waves")
    assert lag(solvers.solve(SCENES["figure-8.5"]), exact) == approx(1.05e-6, abs=0.05e-6)
    assert lag(solvers.solve(SCENES["figure-8.6"]), exact) == approx(0.55e-6, abs=0.05e-6)


@pytest.mark.parametrize(
    ("name", "peak", "at", "parting", "velocity", "deflection", "contacts"),
    [
        ("figure-8.9", 10576.576, 11.324e-6, 99.46e-6, 0.8429314, 1.067e-3, 22),
        ("figure-8.10", 23540.334, 2.475e-6, 49.55e-6, 0.8830770, 1.064e-3, 61),
    ],
)
def test_figures_8_9_and_8_10(name, peak, at, parting, velocity, deflection, contacts):
    """The well-determined beginning against an independent integration; the rest as the note says."""
    found = solvers.solve(SCENES[name])
    first, (time, force) = found.contacts[0], found.motion.force_history()
    within = time <= first.end
    assert force[within].max() == approx(peak, rel=2e-4)
    assert time[force[within].argmax()] == approx(at, abs=0.05e-6)
    assert first.end == approx(parting, abs=0.02e-6)
    assert found.motion.impactor_velocity(np.array([first.end]))[0] == approx(velocity, abs=1e-5)
    tip = found.motion.end_position(np.linspace(0.0, found.duration, 20_001))
    assert tip.max() == approx(deflection, abs=1e-6)
    assert len(found.contacts) == contacts
    assert f"{contacts} contacts" in SCENES[name].note or f"{contacts} of them" in SCENES[name].note


@pytest.mark.parametrize(
    ("theory", "law", "left", "swing"),
    [
        ("euler-bernoulli", "plastic-power", 0.172, 0.354e-3),
        ("timoshenko", "plastic-power", 0.199, 0.346e-3),
        ("euler-bernoulli", "plastic-linear", 0.214, None),
        ("timoshenko", "plastic-linear", 0.135, None),
    ],
)
def test_figure_8_15_what_vibrates_freely(theory, law, left, swing):
    """Differs: that Euler-Bernoulli modes leave the larger vibration holds of the amplitude, not of the energy."""
    scene = SCENES["figure-8.15"].replace({"target.theory": theory, "contact.law": law})
    found = solvers.solve(scene, duration=12e-3)
    assert found.energy["target_vibration"] == approx(left, abs=1e-3)
    tip = found.motion.end_position(np.linspace(found.contacts[-1].end, found.duration, 20_001))
    assert swing is None or 0.5 * (tip.max() - tip.min()) == approx(swing, abs=1e-6)
    assert f"{left:.3f} J" in scene.note


def test_figure_8_22_is_euler_bernoulli_beside_the_static_shape():
    scene = SCENES["figure-8.22"]
    assert scene.target.theory == "euler-bernoulli"
    found = solvers.solve(scene)
    time = np.linspace(0.0, found.duration, 8001)
    tip = found.motion.end_position(time)
    assert (tip.max(), time[tip.argmax()]) == (approx(1.051e-3, abs=1e-6), approx(2.06e-3, abs=0.01e-3))
    part = np.linspace(0.0, 1.0, 61)
    bent = found.motion.displacement(time[[tip.argmax()]], part * scene.target.length)[0] / tip.max()
    assert np.abs(bent - 3.0 * (part**2 / 2.0 - part**3 / 6.0)).max() < 0.03  # (8.13)
    reported = []
    for model in ("structural-massless", "structural"):
        static = solvers.solve(scene, "quasi-static", model=model)
        reported += [static.motion.end_position(np.linspace(0.0, static.duration, 8001)).max() * 1e3, static.peak_force]
    assert reported == approx([1.163738, 1832.887, 1.047, 1334.0], rel=3e-4)  # (8.14), (8.15)
    assert found.peak_force == approx(7.66e3, rel=1e-3)


# --- chapters 9 and 10 ------------------------------------------------------------------------------------------------


def test_figure_9_4_has_the_ripples_of_gibbs():
    found = solvers.solve(SCENES["figure-9.4"])
    time, force = found.motion.force_history()
    assert force[0] == 0.0
    assert (force.max() / SIGMA0_AREA, time[force.argmax()] / T) == (approx(1.13, abs=2e-3), approx(0.025, abs=1e-3))
    assert found.contacts[-1].end / T == approx(0.988, abs=1e-3)
    smooth = solvers.solve(SCENES["figure-9.4"], smoothing="delay")
    assert smooth.peak_force < SIGMA0_AREA


def test_figure_10_2_stands_beside_the_waves():
    clamped, exact = solvers.solve(SCENES["figure-10.2"]), solvers.solve(SCENES["figure-10.2"], "waves")
    assert clamped.impactor_velocity == approx(-1.0195, abs=5e-5)
    assert exact.impactor_velocity == approx(-1.01936, abs=1e-5)


def test_figure_10_3_moves_by_jerks_round_after_round():
    """The attached coordinate rests between two visits of the pulse, each 2 L / c."""
    scene = SCENES["figure-10.3"]
    found, trip = solvers.solve(scene), scene.time_unit
    for visit in (1, 2, 3):
        rests = np.linspace(visit - 0.65, visit - 0.1, 50) * trip  # the pulse is 0.22 trips long
        moves = found.motion.end_position(np.array([rests[-1], (visit + 0.25) * trip])) if visit < 3 else None
        assert np.abs(found.motion.end_velocity(rests)).max() < 0.05 * scene.speed
        assert moves is None or moves[1] - moves[0] == approx(found.target_velocity * trip, rel=0.02)
