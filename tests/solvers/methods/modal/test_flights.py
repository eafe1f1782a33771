"""Flights that are taken at once, for figures alone: the same contacts and the same end as step by step."""

import numpy as np
import pytest

from solvers.methods.modal.method import Modal
from solvers.scene import Scene
from solvers.scenes.library import scene_of
from solvers.solve import chosen_method
from solvers.studies.figures import ENERGIES, USUAL, figures_of

NAMES = [name for name in (*USUAL, *ENERGIES) if name != "estimated_error"]
LAWS = {
    "linear": {"law": "linear", "stiffness": 2e7},
    "hertz": {"law": "hertz", "stiffness": 5e9},
    "force that jumps": {"law": "kelvin-voigt", "stiffness": 2e7, "damping": 200.0},
    "dent": {"law": "plastic-power", "yield_force": 500.0, "stiffness": 5e9},
}


def hammer(support="cantilever", law="linear", mass=0.4, speed=1.3, at=1.0, **method) -> Scene:
    steel = {"young": 210e9, "density": 7900.0, "poisson": 0.3, "yield": 400e6}
    plastic = law == "dent"
    return Scene.from_table(
        {
            "impactor": {"mass": mass, "velocity": speed, "radius": 0.05, "material": steel},
            "target": {
                "kind": "beam",
                "length": 0.4,
                "section": {"width": 0.03, "height": 0.02},
                "material": steel,
                "support": support,
                "at": at,
            },
            "contact": {"law": "plastic-power"} if plastic else LAWS[law],
            "method": {"name": "modal", "modes": 12, **method},
        }
    )


def both(scene: Scene):
    """Solved step by step, and for figures alone."""
    method, duration = chosen_method(scene)
    return method.without_estimate().solve(scene, duration), method.for_figures(False, False).solve(scene, duration)


def check(scene: Scene, tolerance=1e-8):
    whole, few = both(scene)
    assert len(few.contacts) == len(whole.contacts)
    units, scales = USUAL | ENERGIES, {"m/s": scene.speed, "J": scene.initial_energy, "": 1.0}
    for name, had, found in zip(NAMES, figures_of(whole, NAMES), figures_of(few, NAMES), strict=True):
        assert (had is None) == (found is None), name
        if had is not None:
            scale = scales.get(units[name][0], 0.0)
            assert found == pytest.approx(had, rel=tolerance, abs=tolerance * scale), name
    return whole, few


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("support", "at"), [("cantilever", 1.0), ("simply-supported", 0.35), ("free-free", 0.0)])
def test_figures_are_those_of_every_step(support, at, law):
    check(hammer(support, law, at=at))


def test_a_light_hammer_that_flies_long_is_followed_in_few_steps():
    whole, few = check(hammer(mass=0.4))
    assert len(whole.contacts) > 1  # it flies between
    gaps = [np.diff(solution.motion.record.indentation) == 0.0 for solution in (whole, few)]
    assert gaps[0].mean() < 0.01 < 0.5 < gaps[1].mean()  # the gap is not written as it goes


@pytest.mark.parametrize("seed", range(20))
def test_random_hammers(seed):
    draw = np.random.default_rng(seed)
    mass, speed = 10.0 ** draw.uniform(-2.0, 0.5), 10.0 ** draw.uniform(-1.0, 0.7)
    support, at = [("cantilever", 1.0), ("clamped-clamped", 0.4), ("simply-supported", 0.5)][draw.integers(3)]
    scene = hammer(support, list(LAWS)[draw.integers(len(LAWS))], mass, speed, at)
    whole, _ = both(scene)
    check(scene, 1e-9 * 10.0 ** len(whole.contacts) if len(whole.contacts) < 5 else 1e-4)  # each magnifies rounding


@pytest.mark.parametrize("scene", ["table-8.1", "bronze-rod-steel-ball", "fixed-rod", "drop-test"])
def test_rods_and_what_falls(scene):
    scene, method = scene_of(scene), Modal(modes=20)
    whole, few = method.without_estimate().solve(scene), method.for_figures(False, False).solve(scene)
    assert few.impactor_velocity == pytest.approx(whole.impactor_velocity, abs=1e-8 * scene.speed)
    assert len(few.contacts) == len(whole.contacts)


def test_fields_and_estimates_are_not_left_out_where_they_are_read():
    assert not Modal().for_figures(fields=True, estimate=False).flights
    assert not Modal().for_figures(fields=False, estimate=True).flights
    assert Modal().for_figures(fields=False, estimate=True).estimate
    assert Modal(flights=True).table() == Modal().table()
