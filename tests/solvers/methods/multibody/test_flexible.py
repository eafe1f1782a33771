"""The method `multibody` with flexible links: impacts beside those of the frozen mechanism, its start, its fields."""

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Scene, SceneNotSupported
from solvers.methods.multibody.method import Multibody
from solvers.text.notes import Severity
from tests.catalog import SCENES
from tests.solvers.bodies.linkage.mechanisms import FLAT, STEEL, four_bar, rotating_bar


@pytest.fixture(scope="module")
def followed():
    """Thesis 6.4.2 with five modes, for as long as it is in contact."""
    return Multibody(estimate=False).solve(rotating_bar(5), 0.016)


@pytest.fixture(scope="module")
def frozen():
    return solvers.solve(rotating_bar(5), method="balance")


def test_impacts_are_those_of_the_frozen_mechanism(followed, frozen):
    """The first to rounding; later ones while the bar has turned by little: table 6.6."""
    times, impulses = followed.motion.impulses
    still_times, still = frozen.motion.impulses
    assert impulses[0] == approx(still[0], rel=1e-10)
    assert impulses[:5] == approx(still[:5], rel=1e-3)
    assert times[:5] == approx(still_times[:5], rel=1e-3)
    assert followed.impactor_velocity == approx(frozen.impactor_velocity, abs=0.09)  # chaotic: two standard deviations


def test_reactions_at_the_joint(followed, frozen):
    """Their impulses are a fixed share of that of the contact: 0.1263 by table 6.6, of modes of 15 elements."""
    share = followed.reactions[0]["impulse"][1] / followed.impulse
    assert share == approx(frozen.reactions[0]["impulse"][1] / frozen.impulse, rel=2e-3)
    assert abs(share) == approx(0.1263, rel=0.01)


def test_energy_and_joints(followed):
    assert followed.diagnostics["energy_drift"] < 1e-9
    assert followed.diagnostics["constraint_error"] < 1e-13
    assert followed.energy["target_vibration"] > 0.0 and followed.energy["drives"] != 0.0
    assert abs(followed.diagnostics["momentum_error"]) < 1e-12


def test_a_four_bar_that_bends_leaves_the_mass_as_it_does_frozen():
    """Table 6.8: impacts while the bar turns by 5 degrees; its joints stay where the bent links meet."""
    found = Multibody(estimate=False).solve(four_bar(3), 0.04)
    still = solvers.solve(four_bar(3), method="balance")
    assert found.diagnostics["balances"] == still.diagnostics["balances"]
    assert found.impactor_velocity == approx(still.impactor_velocity, abs=0.01)
    times = np.linspace(0.0, 0.04, 5)
    points = found.motion.link_points(times, 8)
    assert points["coupler"][:, -1] == approx(points["bar"][:, 5], abs=1e-7)  # straight between the instants
    assert found.diagnostics["energy_drift"] < 1e-9 and found.diagnostics["constraint_error"] < 1e-13
    assert found.motion.displacement(times, [0.5])[:, 0] == approx(
        (points["bar"][:, 5] - points["bar"][0, 5]) @ [-1.0, 0.0], abs=1e-12
    )


def lying(**bar):
    """A bar clamped to a drive at rest, under its weight."""
    link = {"name": "bar", "from": [0.0, 0.0], "to": [0.5, 0.0], "mass": 1.9, "section": FLAT, "material": STEEL}
    target = {
        "kind": "mechanism",
        "gravity": [0.0, -9.81],
        "links": [link | {"modes": 3} | bar],
        "joints": [{"links": ["ground", "bar"], "at": [0.0, 0.0]}],
        "drives": [{"joint": 0, "speed": 0.0}],
        "struck": {"link": "bar", "at": 1.0, "normal": [0.0, -1.0]},
    }
    return Scene.from_table({"impactor": {"mass": 1e-8, "velocity": 1e-3}, "target": target})


@pytest.mark.slow
def test_it_starts_bent_by_its_weight():
    """By w L^4 / 8 E I at the tip, but for the modes left out; and the joint carries it, steadily."""
    scene = lying()
    found = Multibody(estimate=False).solve(scene, 0.02)
    line = scene.target.links[0].line
    deflection = 1.9 * 9.81 * 0.5**3 / (8.0 * line.bending_stiffness)
    times = np.linspace(0.001, 0.019, 4)
    assert found.motion.link_points(times)["bar"][:, -1, 1] == approx(np.full(4, -deflection), rel=2e-3)
    reactions = found.motion.reaction_forces(times)[:, 0]
    assert reactions[:, 1] == approx(np.full(4, 1.9 * 9.81), rel=1e-4)
    assert reactions[:, 2] == approx(np.full(4, 1.9 * 9.81 * 0.25), rel=1e-3)
    assert found.motion.moment(times, [0.0])[:, 0] == approx(np.full(4, -1.9 * 9.81 * 0.25), rel=0.08)  # of 3 modes


def test_a_slider_crank_with_a_flexible_rod():
    """Its crank held at its speed, the rod bends and stretches little: piston and crank are where rigid ones are."""
    scene = SCENES["slider-crank"].table()
    scene["target"]["drives"][0].pop("initial")
    rigid = Multibody(restitution=0.5).solve(Scene.from_table(scene), 0.05)
    scene["target"]["links"][1] |= {"section": {"width": 0.01, "height": 0.01}, "material": STEEL}
    scene["target"]["links"][1] |= {"modes": 1, "axial": 1, "shapes": "pinned-pinned"}
    found = Multibody(restitution=0.5, estimate=False).solve(Scene.from_table(scene), 0.05)
    assert found.diagnostics["constraint_error"] < 1e-13 and found.diagnostics["energy_drift"] < 1e-6
    for name in ("crank", "piston"):
        assert found.motion.link_points(0.05)[name] == approx(rigid.motion.link_points(0.05)[name], abs=5e-5)
    assert found.energy["target_vibration"] > 0.0


def test_a_ball_comes_to_rest_on_a_bar_that_bends():
    scene = lying().replace({"impactor.mass": 0.05, "impactor.velocity": 0.3, "target.struck.at": 0.8})
    found = Multibody(restitution=0.3, estimate=False).solve(scene, 0.15)
    assert found.diagnostics["balances"] > 3
    assert found.energy["dissipated"] > 0.0 and abs(found.diagnostics["energy_error"]) < 1e-8


@pytest.mark.parametrize(
    ("young", "severity"), [(1e9, Severity.WARNING), pytest.param(1e4, Severity.INVALID, marks=pytest.mark.slow)]
)
def test_links_that_bend_too_far_are_named(young, severity):
    scene = lying(material={"young": young, "density": 7900.0}).replace({"impactor.mass": 0.1})
    notes = {note.code: note.severity for note in Multibody().solve(scene, 0.01).notes}
    assert notes["links-bend-far"] == severity


def test_steps_too_long_for_the_vibrations_are_named():
    found = Multibody(steps=20).solve(rotating_bar(5), 0.01)
    note = next(note for note in found.notes if note.code == "vibrations-unresolved")
    finer = Multibody(steps=note.values["needed"]).solve(rotating_bar(5), 0.01)
    assert all(other.code != "vibrations-unresolved" for other in finer.notes)
    assert found.diagnostics["energy_drift"] < 0.05  # stable all the same


def test_more_steps_than_anyone_waits_for_are_refused():
    with pytest.raises(SceneNotSupported) as refused:
        solvers.solve(rotating_bar(12), method="multibody", duration=100.0)
    reason = refused.value.reason
    assert reason.code == "refusals.flexible-steps"
    assert Multibody().too_long(rotating_bar(12), reason.values["reached"], reason.values["most"] + 1) is None
    assert Multibody(steps=50).too_long(rotating_bar(12), 100.0, 10_000) is None
    assert Multibody().too_long(rotating_bar(0), 100.0, 10_000) is None
