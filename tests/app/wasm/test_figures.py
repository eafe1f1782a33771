"""Figures alone, as maps take them: those of the solution, and those beside the histories that are drawn."""

from functools import cache

import numpy as np
import pytest

from solvers import Scene, Solution, Waves
from solvers.contact import Rigid
from solvers.solution.peaks import PEAKS

from . import test_module
from .answered import by_node
from .test_module import impact_of, random_scene

SEED, THROUGH_LAWS, RIGID = 17, 60, 20
CLOSE = 1e-9  # of the largest, as waves are solved through laws
SOUGHT = 1e-3  # by which a search among even times misses the largest stress
FINE = 400_001

pytestmark = pytest.mark.browser  # needs Node


@cache
def scenes() -> list[Scene]:
    """Masses on rods through every law, and with rigid faces."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(test_module, "RANDOM", np.random.default_rng(SEED))
        found = [random_scene() for _ in range(THROUGH_LAWS + RIGID)]
    rigid = [scene.replace({"contact": {"law": "rigid"}}) for scene in found[THROUGH_LAWS:]]
    return found[:THROUGH_LAWS] + rigid


@cache
def answers() -> tuple[list[dict], list[dict]]:
    """Figures alone, and the same impacts as they are drawn."""
    given = [impact_of(scene) for scene in scenes()]
    drawn = [each[:2] if each[2] == Rigid.NAME else each for each in given]
    found = by_node({"figures": given, "law": drawn[:THROUGH_LAWS], "rod": drawn[THROUGH_LAWS:]})
    return found["figures"], found["law"] + found["rod"]


@cache
def solved() -> list[tuple[Solution, dict]]:
    """Solutions, with the figures of all that there is room for."""
    return [(Waves().solve(scene), here) for scene, here in zip(scenes(), answers()[0], strict=True) if here]


def test_most_impacts_find_room():
    assert len(solved()) >= 0.95 * len(scenes())


def test_they_are_those_of_the_solution():
    for solution, here in solved():
        scene = solution.scene
        speed, trip = scene.speed, scene.time_unit
        force, energy = scene.target.impedance * speed, solution.energy
        share = force * speed * trip / energy["initial"]
        known = {
            "final": (here["final"], solution.impactor_velocity / speed),
            "energy": (here["energy"] * share, 1.0 - (energy["impactor"] + energy["dissipated"]) / energy["initial"]),
            "dissipated": (here["dissipated"] * share, energy["dissipated"] / energy["initial"]),
            "peak": (here["peak"] * force / solution.peak_force, 1.0),
            "touching": (here["touching"] * trip / solution.contact_time, 1.0),
            "parting": (here["parting"] * trip / solution.contacts[-1].end, 1.0),
            "duration": (here["duration"] * trip / solution.duration, 1.0),
        }
        if not scene.target.held:
            known["target"] = here["target"], solution.target_velocity / speed
        if not scene.rigid_contact:
            known["deepest"] = here["deepest"] * speed * trip / solution.peak_indentation, 1.0
        assert here["contacts"] == len(solution.contacts), scene.table()
        for name, (found, there) in known.items():
            assert found == pytest.approx(there, abs=CLOSE), (name, scene.table())


def test_they_are_those_beside_what_is_drawn():
    """To the last bits: it is the same code. The same impacts have no room."""
    for scene, here, drawn in zip(scenes(), *answers(), strict=True):
        assert bool(here) == bool(drawn), scene.table()
        if not here:
            continue
        if scene.rigid_contact:
            _, target, _, energy, final, _, duration = drawn["out"]
            named = {"target": target, "energy": energy, "final": final, "duration": duration}
        else:
            _, final, target, _, _, energy, dissipated, deepest, _ = drawn["out"]
            named = {"target": target, "energy": energy, "final": final, "dissipated": dissipated, "deepest": deepest}
        rows = np.array(drawn["contacts"]).reshape(-1, 5)
        named["peak"] = (rows[:, 4] if scene.rigid_contact else rows[:, 3]).max()
        named["touching"], named["parting"] = (rows[:, 1] - rows[:, 0]).sum(), rows[-1, 1]
        for name, value in named.items():
            assert here[name] == pytest.approx(value, rel=1e-13, abs=1e-14), (name, scene.table())


def test_the_largest_stress_is_no_less_than_any_that_is_found():
    """Beside that of a search, that of the force on the struck face, which such a search may miss."""
    for solution, here in solved():
        scene = solution.scene
        area = scene.target.rods[0].area
        stress = here["stress"] * scene.target.impedance * scene.speed / area
        peak = PEAKS["stress"].find(solution)
        assert peak is not None
        known = max(abs(peak.value), solution.peak_force / area)
        assert known * (1.0 - CLOSE) <= stress <= known * (1.0 + SOUGHT), scene.table()


def test_the_largest_stress_of_a_fixed_rod_is_twice_its_highest_wave():
    held = [(solution, here) for solution, here in solved() if solution.scene.target.held]
    assert len(held) > 20
    for solution, here in held:
        reach = solution.duration / solution.scene.time_unit
        times = np.union1d(np.linspace(0.0, reach, FINE), solution.motion.jumps(0, True, reach))
        sent = max(solution.motion.sent(0, True, times, after).max() for after in (False, True))
        assert here["stress"] == pytest.approx(2.0 * sent, rel=1e-5), solution.scene.table()


@pytest.mark.parametrize("tolerance", [1e-5, 1e-7])
def test_with_longer_steps_they_differ_by_little(tolerance):
    smooth = [solution.scene.contact for solution, _ in solved()]
    known = [each for each, law in zip(solved(), smooth, strict=True) if not law.LOSSY and not law.PLASTIC]
    exact = [(solution.scene, here) for solution, here in known if not solution.scene.rigid_contact]
    assert len(exact) > 10
    found = by_node({"figures": [[*impact_of(scene), tolerance] for scene, _ in exact]})["figures"]
    names = ("final", "peak", "energy")
    here, there = (np.array([[each[name] for name in names] for each in of]) for of in ([h for _, h in exact], found))
    off = np.abs(there - here).max(axis=0)
    assert (off > 0.0).all() and (off < 100.0 * tolerance).all()


def test_of_an_impact_that_is_followed_for_a_time_there_is_no_stress():
    given = [impact_of(scene, asked=0.7) for scene in scenes()[:5]]
    found = by_node({"figures": given})["figures"]
    assert [here["stress"] for here in found] == [None] * 5  # as JSON has what is no number
    assert [here["duration"] for here in found] == pytest.approx([0.7] * 5)


def test_rigid_faces_are_followed_until_they_part_alone():
    (found,) = by_node({"figures": [[1.0, 1, "rigid", [], False, 0.7]]})["figures"]
    assert not found
