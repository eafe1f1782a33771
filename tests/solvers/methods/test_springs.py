"""Structures that bend in one shape, against their closed forms and the exact waves where they must agree."""

import math

import numpy as np
import pytest
from pytest import approx

from solvers import QuasiStatic, Scene, Waves
from solvers.methods.springs import spring_of
from tests.catalog import RIGID, ROD, SIGMA0_AREA, STEEL_ROD, STEEL_ROD_MASS, T, struck_beam, struck_rod
from tests.solvers.methods.quasi_static.impacts import rods

# -- a mass on a fixed rod, (3.13)-(3.20) -----------------------------------------------------------------------------


@pytest.mark.parametrize("beta", [0.01, 0.1, 1.0, 3.0])
def test_rod_without_mass(beta):
    found = QuasiStatic(model="structural-massless").solve(struck_rod(beta))
    mass, stiffness = ROD.mass / beta, ROD.stiffness
    (contact,) = found.contacts
    assert contact.end == approx(math.pi * math.sqrt(mass / stiffness), rel=1e-12)  # (3.17)
    assert found.peak_force == approx(math.sqrt(mass * stiffness), rel=1e-9)  # (3.13)
    assert found.motion.impactor_position(np.array([0.5 * contact.end])) == approx([math.sqrt(mass / stiffness)])
    assert [found.impactor_velocity, found.impulse] == approx([-1.0, 2.0 * mass], rel=1e-12)
    assert found.restitution["newton"] == approx(1.0, rel=1e-12)
    assert found.restitution["poisson"] == approx(1.0, abs=1e-5)  # straight lines between 1000 instants
    assert abs(found.diagnostics["energy_error"]) < 1e-12


@pytest.mark.parametrize("beta", [0.01, 0.1, 1.0, 3.0])
def test_a_third_of_the_rods_mass(beta):
    """(3.19), (3.20): kappa for deflection and root force; kappa^3 for the force on the impactor, after an impulse."""
    without = QuasiStatic(model="structural-massless").solve(struck_rod(beta))
    found = QuasiStatic().solve(struck_rod(beta))
    kappa = 1.0 / math.sqrt(1.0 + beta / 3.0)
    mass = ROD.mass / beta
    assert found.contacts[0].end == approx(without.contacts[0].end / kappa, rel=1e-12)
    assert found.diagnostics["peak_root_force"] == approx(kappa * without.peak_force, rel=1e-9)
    assert found.peak_force == approx(kappa**3 * without.peak_force, rel=1e-9)
    middle = np.array([0.5 * found.contacts[0].end])
    deepest = without.motion.impactor_position(np.array([0.5 * without.contacts[0].end]))
    assert found.motion.impactor_position(middle) == approx(kappa * deepest, rel=1e-9)
    first = mass * (beta / 3.0) / (1.0 + beta / 3.0)
    assert found.diagnostics["initial_impulse"] == approx(first, rel=1e-12)
    assert found.motion.impulse(np.zeros(1)) == approx([first], rel=1e-12)
    assert found.impactor_velocity == approx(-(kappa**2), rel=1e-12)
    assert found.energy["dissipated"] / found.energy["initial"] == approx(1.0 - kappa**2, rel=1e-9)
    assert abs(found.diagnostics["energy_error"]) < 1e-5  # straight lines between the instants of the free swing
    assert abs(found.diagnostics["momentum_error"]) < 1e-12


def test_force_is_that_of_the_impactors_deceleration():
    found = QuasiStatic().solve(struck_rod(1.0))
    time = np.linspace(0.02, 0.98, 40) * found.contacts[0].end
    step = 1e-3 * found.contacts[0].end
    slowing = found.motion.impactor_velocity(time - step) - found.motion.impactor_velocity(time + step)
    assert found.motion.force(time) == approx(ROD.mass * slowing / (2.0 * step), rel=1e-4)


def test_field_is_a_straight_line():
    found = QuasiStatic().solve(struck_rod(0.5))
    time, x = np.array([0.3, 0.7]) * found.contacts[0].end, ROD.length * np.array([0.0, 0.5, 1.0])
    end = found.motion.end_position(time)
    assert found.motion.displacement(time, x) == approx(end[:, None] * np.array([1.0, 0.5, 0.0]))
    stress = np.repeat(ROD.material.young / ROD.length * end[:, None], 3, axis=1)
    assert found.motion.stress(time, x) == approx(stress)
    assert found.motion.rigid_velocity(time) == approx(0.5 * found.motion.end_velocity(time))


def test_against_the_waves():
    """Thesis 5.4: for equal masses the peak is half that of the waves, 0.46831; a heavy impactor feels a spring."""
    found, reference = QuasiStatic(model="structural-massless").solve(struck_rod(1.0)), Waves().solve(struck_rod(1.0))
    assert found.peak_force / reference.peak_force == approx(0.4683105308334812, rel=1e-6)
    assert found.peak_force == approx(SIGMA0_AREA, rel=1e-9)
    heavy = QuasiStatic(model="structural-massless").solve(struck_rod(0.1))
    fronts = Waves().solve(struck_rod(0.1)).peak_force  # figure 5.11: their steps stand on the half sine
    assert heavy.peak_force / SIGMA0_AREA == approx(math.sqrt(10.0), rel=1e-9)
    assert heavy.peak_force / fronts == approx(0.776271, abs=1e-6)  # recomputed
    errors = []
    for beta in (0.1, 0.01, 0.001):
        found, reference = QuasiStatic().solve(struck_rod(beta)), Waves().solve(struck_rod(beta))
        errors.append(abs(found.impactor_velocity - reference.impactor_velocity))
        assert found.contacts[0].end == approx(reference.contacts[-1].end, rel=0.1)
        assert found.peak_force == approx(
            reference.peak_force, rel=2.0 * math.sqrt(beta)
        )  # fronts on top of a half sine
    assert errors[0] < 0.01 and errors[2] < 0.001


def test_spring_mass():
    target = {"kind": "spring-mass", "mass": 1.0, "stiffness": 16e4}
    found = QuasiStatic().solve(Scene.from_table({"impactor": {"mass": 3.0, "velocity": 2.0}, "target": target}))
    assert found.contacts[0].end == approx(math.pi / 200.0, rel=1e-12)
    assert found.impactor_velocity == approx(-1.5, rel=1e-12)
    assert found.energy["target_vibration"] == approx(0.5 * 1.5**2, rel=1e-5)
    assert found.energy["dissipated"] == approx(6.0 - 0.5 * 4.0 * 1.5**2, rel=1e-12)


# -- a mass on a beam, (8.13)-(8.15) ----------------------------------------------------------------------------------

FREE = [{"support": "free-free"}, {"support": "free-free", "at": 0.9, "velocity": -0.3}, {"support": "pinned-free"}]
HELD = [{}, {"at": 0.6, "end_mass": 1.0}, {"support": "pinned-pinned"}, {"support": "clamped-clamped", "at": 0.3}]


def test_beam_of_thesis_8_4_3():
    """Printed 1.164 mm and 1833 N."""
    found = QuasiStatic(model="structural-massless").solve(struck_beam(1.0, RIGID))
    assert found.diagnostics["peak_deflection"] == approx(0.00116373782025236, rel=1e-12)
    assert found.peak_force == approx(1832.8870668974666, rel=1e-12)
    assert found.impactor_velocity == approx(-1.0, rel=1e-12)
    time, x = np.array([0.5 * found.contacts[0].end]), np.array([0.1, 0.2, 0.3])
    part = x / 0.3
    assert found.motion.displacement(time, x)[0] == approx(
        3.0 * (part**2 / 2.0 - part**3 / 6.0) * 0.00116373782025236, rel=1e-9
    )
    assert found.motion.moment(time, x)[0] == approx(1832.8870668974666 * (0.3 - x), rel=1e-6, abs=1e-6)
    assert np.abs(found.motion.shear(time, x)[0]) == approx(1832.8870668974666, rel=1e-6)
    fibre = 0.5 * 0.03 / (0.03**4 / 12.0)
    assert found.motion.stress(time, x) == approx(-found.motion.moment(time, x) * fibre, abs=1.0)


@pytest.mark.parametrize(
    "support, share, stiffness", [("cantilever", 33.0 / 140.0, 3.0), ("pinned-pinned", 17.0 / 35.0, 48.0)]
)
def test_equivalent_mass_of_the_static_shape(support, share, stiffness):
    found = QuasiStatic().solve(struck_beam(1.0, RIGID, support=support))
    line = found.scene.target.line
    assert found.diagnostics["equivalent_mass"] == approx(share * STEEL_ROD_MASS, rel=1e-12)
    stiffness *= line.bending_stiffness / line.length**3
    assert found.contacts[0].end == approx(math.pi * math.sqrt(STEEL_ROD_MASS * (1.0 + share) / stiffness), rel=1e-12)
    assert found.impactor_velocity == approx(-1.0 / (1.0 + share), rel=1e-12)


@pytest.mark.parametrize("theory", ["euler-bernoulli", "timoshenko"])
@pytest.mark.parametrize("beam", HELD + FREE, ids=str)
def test_equivalent_mass_by_the_modes(beam, theory):
    """Rayleigh: the static shape is the sum of the modes by their compliance, its mass that of the fourth powers."""
    target = struck_beam(1.0, RIGID, **beam, theory=theory).target
    modes = target.modes(60)
    compliance = float(np.sum((modes.at_contact / modes.frequencies) ** 2)) + modes.residual_compliance
    spring = spring_of(target)
    assert spring.stiffness == approx(1.0 / compliance, rel=1e-12)
    assert spring.carried == approx(np.sum(modes.at_contact**2 / modes.frequencies**4) / compliance**2, rel=1e-6)
    assert (spring.whole_mass, spring.rigid_mean) == approx((modes.rigid_mass, modes.rigid_mean), rel=1e-12)
    mean = np.sum(modes.means * modes.at_contact / modes.frequencies**2) / compliance
    assert spring.mean == approx(mean, abs=1e-4)


@pytest.mark.parametrize("model", ["structural", "structural-massless"])
@pytest.mark.parametrize("beam", HELD + FREE, ids=str)
def test_accounts_of_a_bent_beam(beam, model):
    found = QuasiStatic(model=model).solve(struck_beam(0.5, RIGID, **beam))
    assert abs(found.diagnostics["energy_error"]) < 1e-5  # straight lines between the instants of the free swing
    assert abs(found.diagnostics["momentum_error"]) < 1e-12
    target, time = found.scene.target, np.linspace(0.0, found.duration, 7)
    struck = np.array([target.place])
    assert found.motion.displacement(time, struck)[:, 0] == approx(found.motion.end_position(time), abs=1e-9)
    assert found.motion.velocity(time, struck)[:, 0] == approx(found.motion.end_velocity(time), abs=1e-6)
    touching = time[time < found.contacts[0].end]
    assert found.motion.impactor_position(touching) == approx(found.motion.end_position(touching), abs=1e-9)
    assert found.restitution["newton_at_contact"] == approx(
        1.0 if model.endswith("massless") else found.restitution["newton_at_contact"], rel=1e-9
    )


# -- two equal rods, (3.21)-(3.23) ------------------------------------------------------------------------------------


def test_two_equal_rods():
    """Reference case of thesis 3.3, every value; start 15/16 v, so that the impulse is exactly 2 m v."""
    found = QuasiStatic().solve(rods())
    frequency = math.pi / found.contacts[0].end
    assert frequency**2 * ROD.mass / ROD.stiffness == approx(2.5, rel=1e-12)  # (3.22)
    place, weights = np.polynomial.legendre.leggauss(6)
    x, middle = 0.5 * ROD.length * (place + 1.0), np.array([0.5 * ROD.length])
    deepest = np.array([0.5 * found.contacts[0].end])
    unit = found.motion.displacement(deepest, middle)
    shape = found.motion.displacement(deepest, x) / unit
    strain = found.motion.stress(deepest, x) / ROD.material.young * ROD.length / unit
    assert 0.5 * (shape**2) @ weights == approx(0.9481481481481482, rel=1e-12)  # of the mass, (3.21)
    assert 0.5 * (strain**2) @ weights == approx(2.3703703703703702, rel=1e-12)  # of EA/L
    assert found.contacts[0].end / T == approx(0.9934588265796102, rel=1e-12)
    assert found.peak_force / SIGMA0_AREA == approx(1.5811388300841898, rel=1e-12)
    assert found.impulse == approx(2.0 * ROD.mass, rel=1e-12)
    assert [found.impactor_velocity, found.target_velocity] == approx([-1.0, 1.0], rel=1e-12)
    assert found.restitution["newton"] == approx(1.0, rel=1e-12)
    assert abs(found.diagnostics["energy_error"]) < 1e-12
    assert abs(found.diagnostics["momentum_error"]) < 1e-12
    middle = found.motion.velocity(np.zeros(1), np.array([0.5 * ROD.length]))  # of the middle, at the start
    assert middle == approx(-15.0 / 16.0, rel=1e-12)


def test_two_equal_rods_as_printed():
    """Differs: (3.21) starts with v, which gives the peak 1.6865 and the impulse 32/15 m v."""
    found = QuasiStatic(model="structural-printed").solve(rods())
    assert found.peak_force / SIGMA0_AREA == approx(1.6865480854231356, rel=1e-12)
    assert found.impulse == approx(32.0 / 15.0 * ROD.mass, rel=1e-12)
    assert found.diagnostics["energy_error"] == approx((17.0 / 15.0) ** 2 - 1.0, rel=1e-9)
    assert "32/15" in str(found.notes[-1])


def test_rod_without_mass_under_a_load_at_its_tip():
    """Thesis 4.3: only that shape has the peak of the waves, and then pi/2 times their duration."""
    found = QuasiStatic(model="structural-massless").solve(struck_rod(1.0))
    assert [found.peak_force / SIGMA0_AREA, found.contacts[0].end / T] == approx([1.0, math.pi / 2.0], rel=1e-9)


def test_a_rod_on_a_stop_is_one_of_two():
    stop, pair = QuasiStatic().solve(rods({"kind": "stop"})), QuasiStatic().solve(rods())
    assert stop.contacts[0] == pair.contacts[0]
    assert stop.impactor_velocity == pair.impactor_velocity
    moving = {key: value for key, value in STEEL_ROD.items() if key != "support"} | {"kind": "rod", "support": "free"}
    chased = QuasiStatic().solve(rods(moving | {"velocity": -0.4}, speed=1.6))
    assert [chased.impactor_velocity, chased.target_velocity] == approx([-0.4, 1.6], rel=1e-12)
    time = np.linspace(0.0, 1.0, 30) * chased.duration
    assert chased.motion.displacement(time, np.zeros(1))[:, 0] == approx(chased.motion.end_position(time), abs=1e-12)
    fall = chased.motion.end_position(time[1:]) - chased.motion.end_position(time[:-1])
    assert fall.sum() == approx(chased.motion.end_position(time[-1:])[0])
