"""Quasi-static estimates against their closed forms, the exact waves where they must agree, and energy."""

import dataclasses

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import QuasiStatic, Scene, SceneError, SceneNotSupported
from solvers.contact.plastic import PlasticLinear
from solvers.contact.viscous import HuntCrossley, damping_for
from solvers.numerics.collisions import damped_collision
from tests.catalog import STEEL_ROD, bronze_rod, struck_beam, struck_rod
from tests.solvers.methods.quasi_static.impacts import rods, two_masses
from tests.solvers.numerics.plain_laws import MASS, SPEED, STIFFNESS, Power


def test_local_impacts_on_beams_feel_the_mass_where_they_strike():
    """Free and struck beside its centre: 1 / (1 / m + d^2 / J); on a pin J / x^2."""
    for beam, felt in (
        ({"support": "free-free", "at": 0.9}, 1.0 / 2.92),
        ({"support": "pinned-free", "at": 0.5}, 4.0 / 3.0),
    ):
        found = QuasiStatic(model="local").solve(struck_beam(1.0, **beam))
        assert found.impactor_velocity == approx((1.0 - felt) / (1.0 + felt), rel=1e-9)
        assert abs(found.diagnostics["energy_error"]) < 1e-9
        assert abs(found.diagnostics["momentum_error"]) < 1e-9
        x = np.array([0.0, 0.15, 0.3])
        field = found.motion.velocity(np.array([found.duration]), x)[0]
        assert field[1] == approx(found.target_velocity, rel=1e-9) and field[2] > field[0] - 1e-12
    held = QuasiStatic(model="local").solve(struck_beam(50.0))
    assert (held.impactor_velocity, held.target_velocity) == approx((-1.0, 0.0), rel=1e-9)


def test_auto_on_beams_goes_by_the_equivalent_mass():
    for ratio, model in ((1.0, "structural"), (4.0, "structural"), (4.5, "local")):  # 140 / 33 = 4.24
        assert QuasiStatic().solve(struck_beam(ratio)).diagnostics["model"] == model


@pytest.mark.parametrize("target", ["mass", "stop"])
def test_local_collision_keeps_momentum_and_energy(target):
    found = QuasiStatic().solve(two_masses(Power(STIFFNESS, 1.5), v2=-0.3, target=target))
    speed = found.scene.speed
    assert found.restitution["newton"] == approx(1.0, rel=1e-11)
    assert found.impulse == approx(2.0 * found.scene.reduced_mass * speed, rel=1e-11)
    assert abs(found.diagnostics["energy_error"]) < 1e-11
    assert abs(found.diagnostics["momentum_error"]) < 1e-11
    time = np.linspace(0.0, found.contacts[0].end, 30)
    total = sum(found.motion.energies(time).values())
    assert total == approx(np.full(30, found.energy["initial"]), rel=1e-4)  # straight lines between instants
    closing = found.motion.impactor_position(time) - found.motion.end_position(time)
    assert closing.max() == approx(found.peak_indentation, rel=1e-2)
    assert found.residual_indentation == 0.0


def test_plastic_impact_leaves_a_dent():
    law = PlasticLinear(2e10, 1e-5)
    found = QuasiStatic().solve(two_masses(law))
    assert found.residual_indentation == approx(law.dent(found.peak_indentation), rel=1e-12)
    assert found.restitution["newton"] == approx(found.diagnostics["delivered_restitution"], rel=1e-11)
    assert 0.3 < found.restitution["newton"] < 0.9
    assert found.energy["dissipated"] > 0.0 and abs(found.diagnostics["energy_error"]) < 1e-11


@pytest.mark.parametrize("restitution", [0.95, 0.6, 0.2, 0.01])
def test_damped_law_delivers_its_restitution(restitution):
    """Against the first integral d (1 + e) = ln((1 + d) / (1 - d e))."""
    law = HuntCrossley(STIFFNESS, damping_for(restitution) / SPEED)
    found = damped_collision(law, MASS, SPEED, 1e-4)
    assert -found.rate[-1] / SPEED == approx(restitution, abs=1e-10)
    assert found.lost[-1] / (0.5 * MASS * SPEED**2) == approx(1.0 - restitution**2, abs=1e-10)
    impact = QuasiStatic().solve(two_masses(law, target="stop"))
    assert impact.diagnostics["delivered_restitution"] == approx(restitution, abs=1e-10)


@pytest.mark.parametrize("law", [law for law in solvers.LAWS if law != "rigid"])
@pytest.mark.parametrize("target", ["half-space", "mass"])
def test_every_law_between_compact_bodies(law, target):
    other = {"kind": "half-space", "material": "steel"} if target == "half-space" else {"kind": "mass", "mass": 1.0}
    striker = {"kind": "sphere", "radius": 0.015, "velocity": 2.0}
    contact = {"law": law} | solvers.LAWS[law].EXAMPLE
    found = QuasiStatic().solve(Scene.from_table({"impactor": striker, "target": other, "contact": contact}))
    assert abs(found.diagnostics["energy_error"]) < 1e-10
    assert abs(found.diagnostics["momentum_error"]) < 1e-12
    assert found.restitution["newton"] == approx(found.diagnostics["delivered_restitution"], rel=1e-11)
    kind = solvers.LAWS[law]
    if kind.LOSSY or kind.PLASTIC:
        assert 0.0 < found.restitution["newton"] < 1.0
    else:
        assert found.restitution["newton"] == approx(1.0, rel=1e-11)
    assert found.restitution["poisson"] == approx(found.restitution["newton"], rel=1e-4)
    assert found.energy["dissipated"] >= 0.0 and found.residual_indentation >= 0.0


def test_a_damped_contact_leaves_no_dent():
    """The force ends before the faces are back where they met; the rest creeps back, as it does by 'modal'."""
    law = {"law": "kelvin-voigt", "stiffness": 1e8, "restitution": 0.4}
    found = solvers.solve(bronze_rod().replace({"contact": law}), "quasi-static", model="local")
    assert found.residual_indentation == 0.0
    assert found.peak_indentation > 0.0


def test_auto_chooses_by_contact_and_mass_ratio():
    assert QuasiStatic().solve(struck_rod(0.5)).diagnostics["model"] == "structural"
    for beta, model in ((0.5, "structural"), (50.0, "local")):
        scene = dataclasses.replace(struck_rod(beta), contact=Power(1e10, 1.5))
        assert QuasiStatic().solve(scene).diagnostics["model"] == model
    free = dataclasses.replace(struck_rod(0.5, "free"), contact=Power(1e10, 1.5))
    found = QuasiStatic().solve(free)
    assert found.diagnostics["model"] == "local" and "3.2 round trips" in str(found.notes[0])
    assert found.target_velocity == approx(2.0 / 1.5, rel=1e-11)  # a rod as a whole


@pytest.mark.parametrize(
    "scene, model, words",
    [
        (struck_rod(1.0, "free"), "auto", "fixed rod"),
        (struck_rod(1.0), "local", "must have a law"),
        (struck_rod(1.0), "structural-printed", "two equal rods"),
        (rods(), "structural-massless", "without mass"),
        (rods(STEEL_ROD | {"kind": "rod", "length": 0.5, "support": "free"}), "structural", "its equal"),
        (struck_rod(1.0, "anechoic"), "auto", "finite length"),
        (two_masses(Power(1e9, 1.5)), "structural", "fixed rod"),
        (two_masses(Power(1e9, 1.5)), "hertz-sine", "for Hertz contact"),
    ],
)
def test_refusals_say_what_to_use(scene, model, words):
    with pytest.raises(SceneNotSupported, match=words):
        QuasiStatic(model=model).solve(scene)


def test_unknown_model():
    with pytest.raises(SceneError, match=r"method\.model"):
        solvers.solve(struck_rod(1.0), "quasi-static", model="lumped")


@pytest.mark.parametrize("scene", [struck_rod(1.0), rods(), two_masses(Power(1e9, 1.5))], ids=["rod", "rods", "masses"])
def test_duration_may_end_inside_the_contact(scene):
    whole = QuasiStatic().solve(scene)
    cut = QuasiStatic().solve(scene, 0.3 * whole.contacts[0].end)
    assert cut.restitution["newton"] is None and "still in contact" in str(cut.notes[0])
    moving = whole.motion.impactor_velocity(np.array([cut.duration]))[0]
    assert cut.impactor_velocity == approx(moving, rel=1e-12)
    assert cut.impulse == approx(cut.contacts[0].impulse, rel=1e-12)
    assert cut.peak_force < whole.peak_force
