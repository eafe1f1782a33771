"""Modes of beams struck across: against independent numbers, by convergence, by what is kept, at the extremes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

import solvers
from solvers import Modal, Scene
from tests.catalog import RIGID, SCENES, STEEL_BEAM, struck_beam
from tests.catalog import contact_table as rod_contact

SUPPORTS = ("cantilever", "pinned-pinned", "clamped-clamped", "free-free", "pinned-free")
THEORIES = ("euler-bernoulli", "timoshenko")
STIFFNESS = 2.4e10  # N/m^1.5, of a steel ball of 25 mm on steel


def plastic_impact(theory: str, law: str, mass: float = 2.133, radius: float = 0.025, yields: float = 280e6) -> Scene:
    """Thesis 8.4 with five modes and none left out, a density of 7900 kg/m3 and kappa = 5/6."""
    changes = {"target.theory": theory, "contact.law": law, "impactor.mass": mass, "impactor.radius": radius}
    changes |= {"impactor.material.yield": yields, "target.material.yield": yields, "method.modes": 5}
    return SCENES["figure-8.14"].replace(changes)


# Recomputed by an integrator of variable step at tolerances of 1e-9 and 1e-12, which agree to 1e-9
@pytest.mark.parametrize(
    ("theory", "law", "velocity", "lost"),
    [
        ("euler-bernoulli", "plastic-linear", -0.782032192040781, 0.2002196299726034),
        ("euler-bernoulli", "plastic-power", -0.8400121747525218, 0.14157477034354154),
        ("timoshenko", "plastic-linear", -0.8347484179333103, 0.18882533500703458),
        ("timoshenko", "plastic-power", -0.8467079020006655, 0.10262617139155744),
    ],
)
def test_thesis_8_4_with_five_modes(theory, law, velocity, lost):
    coarse, fine = (solvers.solve(plastic_impact(theory, law), steps=n, duration=6e-3) for n in (30_000, 120_000))
    assert fine.impactor_velocity == approx(velocity, abs=1e-6)
    assert fine.energy["dissipated"] == approx(lost, abs=1e-6)
    assert abs(coarse.impactor_velocity - velocity) < 2e-5
    assert solvers.solve(plastic_impact(theory, law)).impactor_velocity == approx(velocity, abs=1e-5)


@pytest.mark.parametrize(
    ("law", "lost"), [("plastic-linear", 0.012822865612297465), ("plastic-power", 0.008298902927704192)]
)
def test_thesis_8_4_4_of_50_g(law, lost):
    found = solvers.solve(plastic_impact("timoshenko", law, 0.05))
    assert len(found.contacts) == 1
    assert found.energy["dissipated"] == approx(lost, rel=1e-5)


@pytest.mark.parametrize("theory", THEORIES)
@pytest.mark.parametrize("support", SUPPORTS)
def test_more_modes_agree(support, theory):
    scene = struck_beam(10.0, support=support, theory=theory, at=0.6)
    found, finer = (solvers.solve(scene, modes=modes) for modes in (20, 40))
    assert found.impactor_velocity == approx(finer.impactor_velocity, abs=3e-3)
    assert found.diagnostics["estimated_error"] < 0.05


@pytest.mark.parametrize("support", SUPPORTS)
def test_energy_and_momentum(support):
    found = solvers.solve(struck_beam(3.0, support=support, at=0.7), modes=12)
    assert abs(found.diagnostics["energy_error"]) < 1e-11
    assert abs(found.diagnostics["momentum_error"]) < 1e-11
    time = np.linspace(0.0, found.duration, 40)
    split, energies = found.motion.target_energies(time), found.motion.energies(time)
    total = energies["target_rigid"] + energies["target_vibration"]
    assert split["kinetic"] + split["strain"] == approx(total, rel=1e-9, abs=1e-12)


def test_a_free_beam_struck_off_centre_turns():
    """Impulse and angular momentum: the field's own mean velocity and mean rotation."""
    scene = struck_beam(2.0, support="free-free", at=0.8)
    found = solvers.solve(scene, modes=10)
    length, mass = 0.3, scene.target.mass
    x, weights = np.polynomial.legendre.leggauss(60)
    x, weights = 0.5 * length * (x + 1.0), 0.5 * weights
    speed = found.motion.velocity(np.array([found.duration]), x)[0]
    assert mass * weights @ speed == approx(found.impulse, rel=1e-9)
    assert mass * weights @ (speed * (x - 0.15)) == approx(found.impulse * 0.3 * length, rel=1e-9)
    assert found.target_velocity == approx(found.impulse / mass, rel=1e-12)


def test_a_pinned_beam_swings_on():
    found = solvers.solve(struck_beam(2.0, support="pinned-free"), modes=10)
    time = np.linspace(found.contacts[-1].end, found.duration, 400)
    swing = found.motion.rigid_velocity(time).mean()
    # J = m L^2 / 3 about the pin: its middle gets 3 P / (2 m), and rings about that
    assert swing == approx(1.5 * found.impulse / found.scene.target.mass, rel=0.05)
    assert found.target_velocity == approx(1.5 * found.impulse / found.scene.target.mass, rel=1e-12)
    assert found.restitution["newton"] is None
    assert found.restitution["newton_at_contact"] is not None


def test_struck_where_the_lowest_mode_is_at_rest():
    node = 0.22415754  # of the first mode of a free beam
    found = solvers.solve(struck_beam(20.0, support="free-free", at=node), modes=6)
    lowest = found.scene.target.modes(1)
    assert abs(lowest.at_contact[0]) < 1e-6 * np.abs(lowest.shapes(np.zeros(1))).max()
    assert abs(found.diagnostics["energy_error"]) < 1e-11


def test_modes_at_rest_where_it_is_struck_change_nothing():
    middle = struck_beam(5.0, support="pinned-pinned", at=0.5)
    six, five = (solvers.solve(middle, modes=modes, steps=40_000, duration=4e-3) for modes in (6, 5))
    assert six.impactor_velocity == approx(five.impactor_velocity, abs=1e-12)
    assert six.motion.pair.frequencies.size == 3


def test_struck_at_a_node_of_every_mode_kept():
    node = struck_beam(20.0, support="free-free", at=0.224157541)
    assert any("at a node of every mode kept (1)" in str(note) for note in solvers.solve(node, modes=1).notes)
    assert not any("node" in str(note) for note in solvers.solve(node, modes=2).notes)


def test_stress_of_the_struck_side():
    """A simply supported beam is compressed there, a cantilever pulled; by (M c / I)."""
    for support, at, place, sign in (("pinned-pinned", 0.5, 0.15, 1.0), ("cantilever", 1.0, 0.0, -1.0)):
        found = solvers.solve(struck_beam(1.0, support=support, at=at), modes=6)
        time = np.linspace(0.0, found.contacts[-1].end, 300)
        stress, moment = (getattr(found.motion, name)(time, np.array([place]))[:, 0] for name in ("stress", "moment"))
        assert stress == approx(-moment * 0.015 / found.scene.target.second_moment, rel=1e-12)
        assert sign * stress[np.abs(stress).argmax()] > 0.0


def test_shear_is_the_slope_of_the_moment():
    motion = solvers.solve(struck_beam(2.0), modes=6).motion
    time, x, step = np.array([5e-4, 1e-3]), np.linspace(0.02, 0.28, 9), 1e-5
    slope = (motion.moment(time, x + step) - motion.moment(time, x - step)) / (2.0 * step)
    assert motion.shear(time, x) == approx(slope, rel=1e-6, abs=1e-6 * np.abs(slope).max())


@pytest.mark.parametrize("support", ["cantilever", "pinned-pinned", "clamped-clamped"])
def test_supports_carry_a_slow_impact_with_one_mode_as_with_all(support):
    """On a soft spring the beam bends as at rest: its supports carry the force, and M'' = 0 beside it."""
    law = {"law": "linear", "stiffness": 1e4}
    scene = struck_beam(1e-2, law, support=support, at=0.6, length=0.2, damping=0.2)  # so that it hardly rings
    motion = solvers.solve(scene, modes=2, steps=4000, duration=0.3).motion
    time, ends, x = np.array([0.25]), np.array([0.0, 0.2]), np.array([0.01, 0.05, 0.09])
    left, right = motion.shear(time, ends)[0]
    force = float(motion.force(time)[0])
    assert right - left == approx(force, rel=1e-3)
    moment = motion.moment(time, x)[0]
    assert moment[0] - 2.0 * moment[1] + moment[2] == approx(0.0, abs=1e-3 * abs(moment[0] - moment[2]))
    assert motion.stress(time, x)[0] == approx(-moment * 0.015 / scene.target.second_moment, rel=1e-12)


@pytest.mark.parametrize("theory", THEORIES)
@pytest.mark.parametrize("support", SUPPORTS)
def test_few_modes_give_the_moments_and_support_reactions(support, theory):
    scene = struck_beam(support=support, theory=theory, at=0.6)
    few, many = (Modal(modes=count, estimate=False).solve(scene, 6e-4).motion for count in (20, 80))
    time, x = np.linspace(0.0, 6e-4, 150), np.linspace(0.0, 0.3, 21)
    for name, places, share in (("shear", x[[0, -1]], 4e-3), ("moment", x, 1e-3), ("stress", x, 1e-3)):
        true = getattr(many, name)(time, places)
        share = 5e-4 if theory == "euler-bernoulli" else share  # no shear waves, which nothing slow shows
        whole = np.abs(many.shear(time, x)).max() if name == "shear" else np.abs(true).max()
        assert np.abs(getattr(few, name)(time, places) - true).max() < share * whole


def test_moment_and_shear_of_a_beam_that_strikes():
    bar = STEEL_BEAM | {"length": 0.2, "support": "free-free", "velocity": 1.0}
    law = {"law": "linear", "stiffness": 1e7}
    scene = Scene.from_table({"impactor": bar, "target": STEEL_BEAM, "contact": law})
    motion = solvers.solve(scene, modes=8, duration=2e-4).motion
    time, x, step = np.array([5e-5, 1e-4]), np.array([-0.17, -0.13, -0.06, -0.02]), 1e-5
    slope = (motion.moment(time, x + step) - motion.moment(time, x - step)) / (2.0 * step)
    assert motion.shear(time, x) == approx(slope, rel=1e-6, abs=1e-6 * np.abs(slope).max())
    elements = solvers.solve(scene, "fe-nodal", duration=2e-4).motion.moment(time, x)
    assert motion.moment(time, x) == approx(elements, abs=0.01 * np.abs(elements).max())


def test_damping_takes_what_it_should():
    """Work taken from a mode at rate 2 zeta omega q'^2, summed over the modes."""
    scene = struck_beam(5.0, damping=0.03)
    found = solvers.solve(scene, modes=4)
    assert abs(found.diagnostics["energy_error"]) < 1e-11
    time = np.linspace(0.0, found.duration, 20_001)
    rates = found.motion._coordinates(time)[1]
    modes = scene.target.modes(4)
    power = ((rates / modes.at_contact) ** 2 * (2.0 * 0.03 * modes.frequencies)).sum(axis=1)
    taken = float(np.sum(0.5 * (power[1:] + power[:-1]) * np.diff(time)))
    assert found.energy["dissipated"] == approx(taken, rel=1e-4)
    undamped = solvers.solve(scene.replace({"target.damping": 0.0}), modes=4)
    assert found.energy["target_vibration"] < undamped.energy["target_vibration"]


def test_two_beams_across_one_another():
    """Of the same kind and free: by symmetry each takes half of the approach, whatever the contact."""
    bar = {"kind": "beam", "length": 0.2, "section": {"radius": 0.005}, "material": "steel"}
    scene = Scene.from_table(
        {
            "impactor": bar | {"velocity": 2.0},
            "target": bar | {"support": "free-free", "velocity": -2.0},
            "contact": {"law": "linear", "stiffness": 1e7},
        }
    )
    found = solvers.solve(scene, modes=10)
    assert found.impactor_velocity == approx(-found.target_velocity, abs=1e-9)
    assert abs(found.diagnostics["energy_error"]) < 1e-11
    assert abs(found.diagnostics["momentum_error"]) < 1e-11


def test_a_rod_strikes_a_beam():
    rod = {"kind": "rod", "length": 0.3, "section": {"radius": 0.01}, "material": "steel", "velocity": 1.0}
    scene = Scene.from_table({"impactor": rod, "target": STEEL_BEAM, "contact": {"law": "linear", "stiffness": 1e9}})
    found, finer = (solvers.solve(scene, modes=modes) for modes in (20, 40))
    assert found.impactor_velocity == approx(finer.impactor_velocity, abs=5e-3)
    assert abs(found.diagnostics["energy_error"]) < 1e-11


def test_a_heavy_mass_on_the_tip_is_a_wall():
    found = solvers.solve(struck_beam(5.0, end_mass=1e6), modes=10)
    assert found.impactor_velocity == approx(-1.0, abs=1e-5)
    assert abs(found.diagnostics["momentum_error"]) < 1e-11


LAW_NAMES = sorted(name for name in solvers.LAWS if name != "rigid")


@settings(max_examples=25, deadline=None)
@given(
    law=st.sampled_from(LAW_NAMES),
    support=st.sampled_from(SUPPORTS),
    theory=st.sampled_from(THEORIES),
    modes=st.sampled_from((1, 2, 7, 40, 150, 500)),
    softness=st.floats(-6.0, 6.0),
    mass=st.floats(-3.0, 3.0),
    at=st.floats(0.3, 0.7),
)
def test_energy_is_never_created(law, support, theory, modes, softness, mass, at):
    scene = struck_beam(10.0**mass, rod_contact(law, 10.0**softness), support=support, theory=theory, at=at)
    found = Modal(modes=modes, steps=2_000, estimate=False).solve(scene, 2.0 * scene.time_unit)
    time = np.linspace(0.0, found.duration, 50)
    total = sum(found.motion.energies(time).values())
    initial = found.energy["initial"]
    assert np.all(np.isfinite(total))
    assert np.abs(total - initial).max() <= 1e-10 * initial
    assert np.diff(found.motion.energies(time)["dissipated"]).min() >= -1e-12 * initial


@pytest.mark.parametrize("theory", THEORIES)
def test_a_light_mass_in_rigid_contact_gets_a_note_until_the_modes_give_way(theory):
    """With modes heavier than the mass it rebounds in one impulse, the faster the fewer: waves nearly stop it."""
    light = struck_beam(60.0, RIGID, support="clamped-clamped", at=0.3, theory=theory)
    few, many = (Modal(modes=count).solve(light, 3e-5) for count in (10, 160))
    assert few.impactor_velocity < -0.5 < many.impactor_velocity
    assert few.diagnostics["estimated_error"] >= 1.0 and any("slow down so light" in str(note) for note in few.notes)
    assert not any("slow down so light" in str(note) for note in many.notes)
    for method in ("balance", "fe-modal", "fe-nodal"):
        found = solvers.solve(light, method=method, elements=20, duration=3e-5)
        assert found.diagnostics["estimated_error"] >= 1.0
        assert any("slow down so light" in str(note) for note in found.notes)
    soft = solvers.solve(light.replace({"contact": {"law": "hertz", "stiffness": STIFFNESS}}), modes=10)
    assert not any("slow down" in str(note) for note in soft.notes)


@pytest.mark.parametrize("support", ["cantilever", "free-free", "pinned-free"])
def test_a_free_end_slows_down_a_mass_in_sixteen_times_the_time(support):
    tip, middle = (struck_beam(100.0, RIGID, support=support, at=at) for at in (1.0, 0.5))
    assert tip.halting_time == approx(16.0 * middle.halting_time, rel=1e-9)
    line, mass = middle.target.line, middle.impactor.mass
    beside = np.sqrt(line.bending_stiffness * line.mass_per_length**3)
    assert middle.halting_time == approx(2.0 * mass**2 / (np.pi * beside), rel=1e-9)


def test_a_contact_of_few_steps_gets_a_note():
    """A grain on a long beam: it must rebound as from a half-space, which few steps do not show."""
    sphere = {"kind": "sphere", "radius": 2e-4, "velocity": 1.0, "material": STEEL_BEAM["material"]}
    law = {"law": "plastic-power", "yield_indentation": 5e-9}
    scene = struck_beam(1.0, law, support="pinned-pinned", length=3.0).replace({"impactor": sphere})
    beside = solvers.compare_with_half_space(scene).impactor_velocity
    found, fine = solvers.solve(scene), solvers.solve(scene, duration=1e-5, steps=20_000)
    assert fine.contacts[0].end == approx(1.5e-6, rel=0.1)  # over, though the time solved is short against the beam's
    assert not any("still in contact" in str(note) for note in fine.notes)
    assert fine.impactor_velocity == approx(beside, abs=1e-4)
    assert abs(found.impactor_velocity - beside) < found.diagnostics["estimated_error"]
    assert any("steps, too few" in str(note) for note in found.notes)
    assert not any("steps, too few" in str(note) for note in fine.notes)
