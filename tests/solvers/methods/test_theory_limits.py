"""What rod theory leaves out is remarked where it matters, by the figures of closed forms, and nowhere else."""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import ContactPeriod, Rod, Scene, Solution
from solvers.methods.theory_limits import MIN_GROWTH, Loaded, bend_growth, euler_load, peak_stress
from tests.catalog import RIGID, ROD, SCENES, STEEL_ROD, struck_rod

FRONT = ROD.impedance / ROD.area  # rho c v at 1 m/s [Pa]
STEEL = {"young": 210e9, "density": 7900.0, "poisson": 0.3}


def struck(mass: float = 2.133, speed: float = 1.0, contact: dict = RIGID, **changes) -> Scene:
    """A steel rod struck by a mass."""
    impactor = {"mass": mass, "velocity": speed}
    return Scene.from_table({"impactor": impactor, "target": STEEL_ROD | changes, "contact": contact})


def note(solution: Solution, code: str):
    return next((each for each in solution.notes if each.code == code), None)


def of_target(solution: Solution, number: int = 0) -> float:
    rod = solution.scene.target.rods[0]
    return peak_stress(solution, Loaded("target", number, True, rod))


@pytest.mark.parametrize("support, times", [("fixed", 2.0), ("free", 1.0), ("anechoic", 1.0)])
def test_a_front_is_rho_c_v_and_twice_that_where_the_rod_is_held(support, times):
    solution = solvers.solve(struck(mass=0.02, support=support), "waves")  # so light that the front is the peak
    assert of_target(solution) == approx(times * FRONT, rel=1e-9)


def test_of_two_equal_rods_each_bears_half():
    solution = solvers.solve(SCENES["two-equal-rods"], "waves")
    rod = solution.scene.target.rods[0]
    assert of_target(solution, 1) == approx(0.5 * rod.impedance / rod.area * solution.scene.speed, rel=1e-9)


def test_the_stress_found_is_the_largest_of_the_field():
    solution = solvers.solve(struck_rod(0.7), "waves")
    field = solution.known_motion.stress(np.linspace(0.0, solution.duration, 2001), np.linspace(0.0, 0.3, 31))
    assert of_target(solution) == approx(np.abs(field).max(), rel=0.01)  # sampled, both of them


@pytest.mark.parametrize("method", ["waves", "modal"])
def test_a_rod_that_yields_says_from_which_speed_on(method):
    material = STEEL | {"yield": 100e6}
    found = note(solvers.solve(struck(speed=5.0, material=material), method), "stress-beyond-yield")
    assert (found.severity, found.values["strength"]) == ("warning", approx(100e6, rel=1e-12))
    assert found.values["stress"] > (5.0 * FRONT if method == "waves" else 4.999 * FRONT)
    slower = found.values["slower"]
    for share, yields in ((0.99, False), (1.01, True)):
        again = solvers.solve(struck(speed=share * slower, material=material), method)
        assert (note(again, "stress-beyond-yield") is not None) == yields


def test_a_beam_that_yields_says_so_by_the_largest_stress_of_its_fibres():
    scene = SCENES["hammer-on-cantilever"]
    fast = solvers.solve(scene.replace({"impactor.velocity": 10.0}), "modal")
    found = note(fast, "stress-beyond-yield")
    moment = fast.motion.moment(np.linspace(0.0, fast.duration, 800), np.linspace(0.0, 0.4, 21))
    assert found.values["stress"] == approx(np.abs(moment).max() * 0.01 / 2e-8, rel=0.12)
    assert str(found).startswith("The struck beam yields")
    assert found.values["strength"] == approx(400e6, rel=1e-12)
    assert note(solvers.solve(scene, "modal"), "stress-beyond-yield") is None


def test_without_a_yield_strength_a_large_strain_is_remarked():
    found = note(solvers.solve(struck(speed=8.0), "waves"), "strain-large")
    assert found.values["strain"] == approx(found.values["stress"] / 210e9) and found.values["strain"] > 2e-3
    assert found.severity == "remark" and found.values["rod"] == 0
    assert note(solvers.solve(struck(), "waves"), "strain-large") is None


def test_the_specimen_of_a_hopkinson_bar_is_strained_beyond_all_elasticity():
    (found,) = solvers.solve(SCENES["split-hopkinson"]).notes
    assert (found.code, found.values["rod"]) == ("strain-large", 2)


def test_a_pulse_shorter_than_the_rod_is_thick_is_remarked():
    scene = struck(mass=0.1)
    found = note(solvers.solve(scene, "waves"), "pulse-short")
    halted, radius = 0.1 / ROD.impedance, math.sqrt(9e-4 / math.pi)
    assert found.values["radii"] == approx(ROD.wave_speed * halted / radius, rel=1e-12)
    assert found.values["error"] == approx((0.3 * math.pi / found.values["radii"]) ** 2, rel=1e-12)
    soft = {"law": "linear", "stiffness": 1e7}  # the remedies: a thin rod, a heavy mass, a soft contact
    for other in (struck(mass=0.1, section={"radius": 0.002}), struck(), struck(mass=0.1, contact=soft)):
        assert note(solvers.solve(other, "waves"), "pulse-short") is None


@pytest.mark.parametrize("support, share", [("free", 1.0), ("fixed", 0.25)])
def test_euler_load_and_the_growth_of_a_bend(support, share):
    rod = Scene.from_table(
        {
            "impactor": {"mass": 1.0, "velocity": 1.0},
            "target": STEEL_ROD | {"length": 2.0, "section": {"width": 0.01, "height": 0.004}, "support": support},
        }
    ).target
    assert isinstance(rod, Rod)
    stiffness = 210e9 * 0.01 * 0.004**3 / 12.0  # about the axis about which it bends most easily
    assert euler_load(rod) == approx(share * math.pi**2 * stiffness / 2.0**2, rel=1e-12)
    force, seconds = 40.0 * euler_load(rod), 1e-3
    waves = np.linspace(0.5, 1.4, 2001) * math.sqrt(0.5 * force / stiffness)
    rates = np.sqrt(waves**2 * (force - stiffness * waves**2) / (7900.0 * 4e-5))
    assert bend_growth(rod, ContactPeriod(0.0, seconds, force * seconds, force)) == approx(
        rates.max() * seconds, rel=1e-6
    )
    weak = 0.99 * euler_load(rod)
    assert bend_growth(rod, ContactPeriod(0.0, 1.0, weak, weak)) == 0.0


def test_a_slender_rod_may_buckle_and_a_stout_or_short_one_does_not():
    slender = {"section": {"radius": 0.002}, "length": 1.0}
    found = note(solvers.solve(struck(mass=1.0, speed=3.0, **slender), "waves"), "rod-buckles")
    assert found.values["times"] > MIN_GROWTH and found.values["length"] < 1.0
    for other in ({"section": {"radius": 0.05}, "length": 1.0}, {"section": {"radius": 0.002}, "length": 0.01}):
        assert note(solvers.solve(struck(mass=1.0, speed=3.0, **other), "waves"), "rod-buckles") is None
    unknown = {"section": {"area": math.pi * 0.002**2}, "length": 1.0}
    assert note(solvers.solve(struck(mass=1.0, speed=3.0, **unknown), "waves"), "rod-buckles") is None


def test_what_the_section_of_a_rod_says_of_bending():
    for section, moment in (
        ({"width": 0.03, "height": 0.01}, 0.03 * 0.01**3 / 12.0),
        ({"radius": 0.01}, 0.25 * math.pi * 0.01**4),
        ({"area": 1e-4, "second_moment": 2e-10}, 2e-10),
        ({"area": 1e-4}, None),
    ):
        scene = struck(section=section)
        assert scene.target.second_moment == (moment if moment is None else approx(moment, rel=1e-12))
        assert Scene.from_table(scene.table()) == scene  # which has nothing else from it
