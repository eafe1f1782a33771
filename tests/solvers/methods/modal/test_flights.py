"""Flights that are taken at once, for figures alone: the same contacts and the same end as step by step."""

import numpy as np
import pytest

from solvers.methods.modal import march as marching
from solvers.methods.modal.method import Modal
from solvers.scene import Scene
from solvers.scenes.library import scene_of
from solvers.solve import chosen_method
from solvers.studies.figures import ENERGIES, USUAL, figures_of

NAMES = [name for name in (*USUAL, *ENERGIES) if name != "estimated_error"]
SEEDS = 14, 47, 111, 149, 151, 158, 165, 214, 243, 301, 324, 327, 332, 475, 726, 930  # that have such gaps
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


def test_a_light_hammer_that_flies_long_is_followed_in_few_steps(monkeypatch):
    def unwritten(*sizes):
        record = new_record(*sizes)
        record.position[1:] = np.nan
        return record

    new_record = marching._record
    monkeypatch.setattr(marching, "_record", unwritten)
    whole, few = check(hammer(mass=0.4))
    assert len(whole.contacts) > 1  # it flies between
    left_out = [np.isnan(solution.motion.record.position) for solution in (whole, few)]
    assert not left_out[0].any() and 0.5 < left_out[1].mean() < 1.0  # positions are not written as it goes


def random_rod(seed: int):
    """The mass ratio, an impact of it, and a method with few modes, of which those left out give way much."""
    draw = np.random.default_rng(seed)
    name, speed = ["fixed-rod", "free-rod"][draw.integers(2)], 10.0 ** draw.uniform(-1.0, 1.0)
    ratio, hard = 10.0 ** draw.uniform(-1.5, 1.5), 10.0 ** draw.uniform(-1.0, 2.5, 2)
    law = [{"law": "linear", "stiffness": 1e9 * hard[0]}, {"law": "hertz", "stiffness": 1e10 * hard[1]}]
    scene = scene_of(name).replace({"impactor.velocity": speed, "contact": law[draw.integers(2)]})
    return ratio, scene, Modal(modes=int(draw.integers(1, 13)), steps=20_000)


def near_the_limit(seed: int) -> list[Scene]:
    """Impacts of masses a little to both sides of those at which a gap between contacts is just wide enough."""
    ratio, scene, method = random_rod(seed)

    def struck(share: float) -> Scene:
        return scene.with_impactor_mass(scene.target.mass / ratio / share)

    def counted(share: float) -> tuple[int, int]:
        found = method.without_estimate().solve(struck(share))
        return len(found.contacts), found.diagnostics["raw_contacts"]

    found, shares = [], np.geomspace(0.6, 1.6, 9).tolist()
    counts = [counted(share) for share in shares]
    for low, high, few, more in zip(shares, shares[1:], counts, counts[1:], strict=False):
        if few[0] == more[0] or few[1] != more[1]:
            continue
        for _ in range(25):
            middle = (low * high) ** 0.5
            low, high = (middle, high) if counted(middle)[0] == few[0] else (low, middle)
        found += [struck(high * (1.0 + off)) for off in (-1e-3, -1e-4, -1e-5, -1e-6, 1e-6, 1e-5, 1e-4, 1e-3)]
    return found


@pytest.mark.parametrize("seed", SEEDS)
def test_gaps_that_are_just_wide_enough_are_counted(seed):
    method, found = random_rod(seed)[2], near_the_limit(seed)
    assert found
    counts = []
    for scene in found:
        whole, few = (way.solve(scene) for way in (method.without_estimate(), method.for_figures(False, False)))
        assert len(few.contacts) == len(whole.contacts), scene.table()
        assert few.impactor_velocity == pytest.approx(whole.impactor_velocity, abs=1e-8 * scene.speed)
        times = [[time for each in solution.contacts for time in (each.start, each.end)] for solution in (whole, few)]
        assert times[1] == pytest.approx(times[0], rel=1e-8)
        counts.append(len(whole.contacts))
    assert len(set(counts)) > 1


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
