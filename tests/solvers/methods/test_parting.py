"""When bodies have parted for good: late contacts, which come when what swings slowly is back, by every method."""

import math

import numpy as np
import pytest

import solvers
from solvers import Balance, FeModal, FeNodal, Modal, Scene, Waves
from solvers.methods.finite_elements.follow import SNAPSHOTS
from solvers.numerics.elements.modes import mesh_modes
from tests.catalog import struck_rod
from tests.random_necks import random_neck

LONGER = 8.0  # times what a method takes for the whole impact


def steel(length, area, **more):
    return {"length": length, "section": {"area": area}, "material": {"young": 210e9, "density": 7900.0}} | more


def on_neck(impactor, contact, rods, **target):
    rods = [rods[0], *(rod | {"joint": "bonded"} for rod in rods[1:])]
    target = {"kind": "rods", "rods": rods, "support": "fixed"} | target
    return Scene.from_table({"impactor": {"velocity": 1.0} | impactor, "contact": contact, "target": target})


# Scenes, the velocity that is right and when the second contact begins. Known by an independent delay line (A), and by
# the two masses that head and impactor are in all of them: the head hardly moves on its neck while it is struck.
HEADS = {
    "A": (
        on_neck({"mass": 0.7}, {"law": "linear", "stiffness": 1e9}, [steel(0.1, 1e-3), steel(0.1, 1e-5)]),
        (-0.9676, 647e-6),
    ),
    "B": (
        on_neck({"kind": "rod"} | steel(0.07, 1e-3), {"law": "rigid"}, [steel(0.18, 1e-3), steel(0.06, 2.5e-5)]),
        (-0.709, 391e-6),
    ),
    "C": (
        on_neck(
            {"mass": 0.5},
            {"law": "linear", "stiffness": 3e9},
            [steel(0.065, 1e-3), steel(0.3, 2e-5)],
            support="free",
            end_mass=8.0,
        ),
        (-0.832, 640e-6),
    ),
    "D": (
        on_neck({"mass": 0.6}, {"law": "linear", "stiffness": 1e9}, [steel(0.1, 1e-3), steel(0.1, 1e-4)]),
        (-0.852, 230e-6),
    ),
}
STARTS = 4e-3  # to which the instants above are known, of each
ROD_ON_SPRING = Scene.from_table(
    {
        "impactor": {"kind": "rod", "length": 1.0, "section": {"radius": 0.01}, "material": "steel", "velocity": 0.2},
        "target": {"kind": "spring-mass", "mass": 0.85, "stiffness": 3000.0},
        "contact": {"law": "linear", "stiffness": 1e6},
    }
)


@pytest.mark.parametrize("name", HEADS)
def test_a_head_comes_back_on_its_neck(name):
    scene, (velocity, second) = HEADS[name]
    solution = Waves().solve(scene)
    assert solution.impactor_velocity == pytest.approx(velocity, abs=1e-3)
    assert [contact.start for contact in solution.contacts[1:]] == [pytest.approx(second, rel=STARTS)]


@pytest.mark.parametrize("method", [FeModal(), FeNodal()], ids=lambda method: method.NAME)
@pytest.mark.parametrize("name", ["A", "C", "D"])
def test_elements_wait_for_the_head_too(name, method):
    scene, (velocity, _) = HEADS[name]
    solution = method.solve(scene)
    exact = Waves().solve(scene)
    assert len(solution.contacts) == len(exact.contacts) == 2
    allowed = max(3.0 * solution.diagnostics["estimated_error"], 1e-3)
    assert abs(solution.impactor_velocity - exact.impactor_velocity) < allowed
    assert solution.impactor_velocity == pytest.approx(velocity, abs=5e-3)


@pytest.mark.parametrize("method", [FeModal(), FeNodal(), Balance(restitution=0.0)], ids=lambda method: method.NAME)
def test_rigid_faces_of_elements_wait_for_the_head(method):
    """Where the front runs through rigid faces the velocity scatters by some 0.1 of that before, which they say."""
    scene, (velocity, second) = HEADS["B"]
    solution = method.solve(scene)
    late = [contact for contact in solution.contacts if contact.start > 0.9 * second]
    assert late
    allowed = max(solution.diagnostics["estimated_error"], 0.05)
    assert abs(solution.impactor_velocity - velocity) < allowed
    as_asked = method.solve(scene, duration=1.5 * second)
    assert as_asked.duration == 1.5 * second
    assert as_asked.contacts[-1].start > 0.9 * second


@pytest.mark.parametrize("method", [Modal(), FeModal(), FeNodal()], ids=lambda method: method.NAME)
def test_a_rod_meets_a_mass_on_a_spring_three_times(method):
    solution = method.solve(ROD_ON_SPRING)
    assert solution.impactor_velocity == pytest.approx(-0.18529, abs=1e-5)
    starts = [contact.start for contact in solution.contacts]
    assert starts == [pytest.approx(start, abs=2e-5) for start in (0.0, 38.93e-3, 73.88e-3)]


def test_balances_of_a_rod_go_on_until_it_is_clear_of_the_spring():
    method = Balance(restitution=0.5, estimate=False)
    solution = method.solve(ROD_ON_SPRING)
    longer = method.solve(ROD_ON_SPRING, duration=2.0 * solution.duration)
    assert longer.impactor_velocity == pytest.approx(solution.impactor_velocity, rel=1e-12)
    assert solution.contacts[-1].start > 30e-3


@pytest.mark.parametrize("method", [Waves(), FeModal(), FeNodal(), Balance()], ids=lambda method: method.NAME)
@pytest.mark.parametrize("times", [0.3, 3.0])
def test_a_duration_that_is_asked_for_is_lived_through(method, times):
    scene, (_, second) = HEADS["B"]
    solution = method.without_estimate().solve(scene, duration=times * second)
    assert solution.duration == pytest.approx(times * second, rel=1e-12)
    assert (solution.contacts[-1].start > 0.9 * second) == (times > 1.0)


def missed(method, scene):
    """How many contacts a solution until the bodies part has missed of one that goes on, and whether the velocity is
    another. One that goes on may be found on a grid, whose contacts break up and join within its steps.
    """
    found = method.solve(scene)
    if {"may-touch-again", "touches-for-ever", "contact-fades-for-ever"} & {note.code for note in found.notes}:
        return 0, False
    longer = method.solve(scene, duration=LONGER * found.duration)
    error = max(found.diagnostics["estimated_error"], longer.diagnostics["estimated_error"])
    apart = abs(found.impactor_velocity - longer.impactor_velocity) / scene.speed
    late = [contact for contact in longer.contacts if contact.start > 1.01 * found.contacts[-1].end]
    return len(late), apart > max(3.0 * error, 1e-7)


@pytest.mark.parametrize("number", range(3))
def test_nothing_is_missed_by_stopping_when_they_have_parted(number):
    assert missed(Waves(), random_neck(number)) == (0, False)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(3, 63, 4))
def test_nothing_is_missed_by_stopping_in_many_scenes(number):
    assert missed(Waves(), random_neck(number)) == (0, False)


@pytest.mark.slow
@pytest.mark.parametrize("method", [FeModal(elements=40, estimate=False), FeNodal(elements=40, estimate=False)])
@pytest.mark.parametrize("number", [k for k in range(60) if k % 15 in (0, 7)])
def test_elements_miss_nothing_by_stopping(method, number):
    """The same steps go on, so that until then all is the same to rounding."""
    scene = random_neck(number)
    found = method.solve(scene)
    if "may-touch-again" in [note.code for note in found.notes]:
        return
    step = found.motion.course.step
    steps = int(LONGER * found.duration / step)
    longer = method.solve(scene, duration=steps * step)
    assert longer.contacts[-1].end == pytest.approx(found.contacts[-1].end, rel=1e-2)
    assert longer.impactor_velocity == pytest.approx(found.impactor_velocity, abs=1e-3 * scene.speed)


@pytest.mark.parametrize("end", [{"support": "fixed"}, {"support": "free"}, {"support": "free", "end_mass": 3.0}])
def test_the_slowest_period_is_bounded_and_the_compliance_exact(end):
    """Against all modes of a fine mesh; compliances of consistent mass are off with the square of its elements."""
    rods = [steel(0.1, 1e-3), steel(0.2, 5e-5, joint="bonded"), steel(0.05, 4e-4, joint="bonded")]
    table = {
        "impactor": {"mass": 1.0, "velocity": 1.0},
        "target": {"kind": "rods", "rods": rods} | end,
        "contact": {"law": "rigid"},
    }
    body = Scene.from_table(table).target
    modes = mesh_modes(body.mesh(400), None)
    compliance = float(np.sum((modes.at_contact / modes.frequencies) ** 2))
    assert body.face_compliance == pytest.approx(compliance, rel=1e-4)
    period = 2.0 * math.pi / modes.frequencies[0]
    assert period < body.slowest_period < 1.3 * period


@pytest.mark.parametrize("method", [FeNodal, FeModal])
@pytest.mark.parametrize("steps", [20_000, 20_011, 39_983])
def test_a_number_of_steps_without_divisors_stores_no_more(method, steps):
    """20 011 and 39 983 are prime."""
    scene = struck_rod(1.0)
    duration = 2.5 * scene.time_unit
    solution = method(elements=4, steps=steps, estimate=False).solve(scene, duration=duration)
    course = solution.motion.course
    assert course.energies["impactor"].size <= 2 * SNAPSHOTS + 1
    assert course.step * course.steps == pytest.approx(duration, rel=1e-12)
    assert steps <= course.steps <= 1.002 * steps


@pytest.mark.slow
def test_auto_and_an_ensemble_see_the_late_contact():
    scene, (velocity, _) = HEADS["A"]
    chosen = solvers.solve(scene, method="auto", tolerance=0.01)
    assert chosen.impactor_velocity == pytest.approx(velocity, abs=0.01)
    found = solvers.ensemble(scene, runs=10, spread=1e-3)
    assert found.contacts.tolist() == [2] * 10
    assert found.final_velocity == pytest.approx(np.full(10, velocity), abs=0.01)
