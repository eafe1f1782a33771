"""The methods `fe-nodal` and `fe-modal` on beams: against exact modes, accounts, fields, options and refusals."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

import solvers
from solvers import Modal, Scene, SceneError, SceneNotSupported
from solvers.methods.parting import End
from tests.catalog import RIGID, STEEL_BEAM, STEEL_ROD_MASS, contact_table, struck_beam

VARIANTS = [
    ("fe-nodal", {}),
    ("fe-modal", {}),
    ("fe-modal", {"scheme": "newmark"}),
    ("fe-modal", {"boundary": "consistent"}),
]
IDS = ["nodal", "modes", "modes-newmark", "consistent"]
EACH = pytest.mark.parametrize("method, options", VARIANTS, ids=IDS)
SOFT = {"law": "hertz", "stiffness": 2.4e10}
FREE = STEEL_BEAM | {"support": "free-free", "velocity": 1.0}


def quick(method: str, **options):
    """The method without its estimate of the error, which costs as much again."""
    return replace(solvers.METHODS[method].read({"elements": 40} | options), estimate=False)


IMPACTS = [
    {"support": "cantilever"},
    {"support": "cantilever", "end_mass": 0.5, "theory": "timoshenko"},
    {"support": "pinned-pinned", "at": 0.3},
    {"support": "clamped-clamped", "theory": "timoshenko"},
    {"support": "free-free"},
    {"support": "free-free", "at": 0.85, "velocity": -0.5},
    {"support": "pinned-free", "at": 0.7},
]


@EACH
@pytest.mark.parametrize("law", [SOFT, {"law": "rigid"}], ids=["hertz", "rigid"])
@pytest.mark.parametrize("beam", IMPACTS, ids=lambda beam: " ".join(map(str, beam.values())))
def test_accounts_balance(method, options, law, beam):
    scene = struck_beam(1.0, law, **beam)
    solution = solvers.solve(scene, quick(method, **options), duration=1.5e-3)
    assert abs(solution.diagnostics["energy_error"]) < 2e-9
    assert abs(solution.diagnostics["momentum_error"]) < 2e-9
    assert sum(contact.impulse for contact in solution.contacts) == approx(solution.impulse, rel=1e-9)
    assert min(solution.energy.values()) > -1e-9 * scene.initial_energy
    at_rows = solution.motion.course.step * solution.motion.course.stride * np.arange(0, 900, 100)
    face = solution.motion.displacement(at_rows, np.array([scene.target.place]))[:, 0]
    # off by the rounding of a static solution of 1e-7 m/N under 1e5 N and less
    assert face == approx(solution.motion.end_position(at_rows), abs=1e-12 if method == "fe-nodal" else 1e-10)
    json.dumps(solution.table())


@pytest.mark.slow
@pytest.mark.parametrize("beam", IMPACTS, ids=lambda beam: " ".join(map(str, beam.values())))
def test_a_soft_impact_is_that_of_the_exact_modes(beam):
    scene = struck_beam(1.0, SOFT, **beam)
    exact = solvers.solve(scene, Modal(modes=60, estimate=False), duration=1.5e-3)
    times, x = np.array([2e-4, 1.2e-3]), np.linspace(0.02, 0.28, 7)
    shears = beam.get("theory") == "timoshenko"
    elements = 120 if shears else 40  # of second order there
    for method in ("fe-nodal", "fe-modal"):
        found = solvers.solve(scene, quick(method, elements=elements), duration=1.5e-3)
        assert found.impactor_velocity == approx(exact.impactor_velocity, abs=1e-3 if shears else 2e-4)
        assert found.target_velocity == approx(exact.target_velocity, abs=2e-3)
        assert found.peak_force == approx(exact.peak_force, rel=2e-3)
        assert [contact.start for contact in found.contacts] == approx(
            [contact.start for contact in exact.contacts], abs=3e-6
        )
        for field, share in (("displacement", 2e-3), ("velocity", 0.01), ("moment", 0.03), ("stress", 0.03)):
            true = getattr(exact.motion, field)(times, x)
            assert getattr(found.motion, field)(times, x) == approx(true, abs=share * np.abs(true).max())
        assert found.motion.rigid_velocity(times) == approx(exact.motion.rigid_velocity(times), abs=5e-3)
        for part in ("impactor", "target_rigid", "target_vibration", "local"):
            assert found.energy[part] == approx(exact.energy[part], abs=3e-3 * scene.initial_energy)


@pytest.mark.slow
@pytest.mark.parametrize("beam", IMPACTS, ids=lambda beam: " ".join(map(str, beam.values())))
def test_supports_carry_what_the_modes_left_out_pass_on(beam):
    scene = struck_beam(1.0, SOFT, **beam)
    exact = solvers.solve(scene, Modal(modes=60, estimate=False), duration=8e-4).motion
    times, ends = np.linspace(0.0, 8e-4, 150), np.array([0.0, 0.3 * (1.0 - 1e-9)])
    found = solvers.solve(scene, quick("fe-modal", elements=100), duration=8e-4).motion
    largest = np.abs(exact.shear(times, np.linspace(0.0, 0.3, 21))).max()
    share = 6e-3 if beam.get("theory") == "timoshenko" else 1.2e-3  # the mesh is of second order where it shears
    assert np.abs(found.shear(times, ends) - exact.shear(times, ends)).max() < share * largest
    x = np.linspace(0.0, 0.3, 21)
    true = exact.moment(times, x)
    assert np.abs(found.moment(times, x) - true).max() < 2e-3 * np.abs(true).max()


@pytest.mark.parametrize("theory", ["euler-bernoulli", "timoshenko"])
@pytest.mark.parametrize("support", ["cantilever", "free-free", "pinned-free"])
@pytest.mark.parametrize("method, options", [("fe-nodal", {}), ("fe-modal", {}), ("balance", {"restitution": 0.5})])
def test_nothing_is_carried_over_a_free_end(method, options, support, theory):
    """2.5 to 6 % of the peak force when the shear force was constant in every element, as it is at rest."""
    scene = struck_beam(1.0, SOFT if method != "balance" else RIGID, support=support, theory=theory, at=0.5)
    found = solvers.solve(scene, quick(method, elements=30, **options), duration=6e-4).motion
    times, x = np.linspace(0.0, 6e-4, 400), np.linspace(0.0, 0.3, 31)
    free = x[[0, -1]] if support == "free-free" else x[-1:]
    for name in ("shear", "moment"):
        field = getattr(found, name)
        assert np.abs(field(times, free)).max() < 1e-7 * np.abs(field(times, x)).max()
    if method != "balance":  # whose forces are impacts, in all modes at once
        exact = solvers.solve(scene, Modal(modes=60, estimate=False), duration=6e-4).motion
        true, between = exact.shear(times, x), np.abs(x - 0.15) > 0.01  # it jumps where the beam is struck
        assert np.abs(found.shear(times, x) - true)[:, between].max() < 0.02 * np.abs(true).max()


def test_fe_modal_tends_to_the_exact_modes_with_the_fourth_power_of_the_elements():
    scene = struck_beam(1.0, SOFT, support="pinned-pinned")
    exact = solvers.solve(scene, Modal(modes=8, estimate=False), duration=4e-4).impactor_velocity
    errors = [
        abs(
            solvers.solve(scene, quick("fe-modal", elements=n, modes=8, steps=20_000), duration=4e-4).impactor_velocity
            - exact
        )
        for n in (8, 16)
    ]
    assert errors[1] < errors[0] / 10.0
    assert errors[1] < 1e-4


@pytest.mark.parametrize("law", ["linear", "kelvin-voigt", "hunt-crossley", "plastic-power"])
def test_laws_elastic_lossy_and_with_memory(law):
    table = contact_table(law, softness=10.0)
    scene = struck_beam(1.0, table)
    exact = solvers.solve(scene, Modal(modes=40, estimate=False), duration=3e-3)
    for method in ("fe-nodal", "fe-modal"):
        found = solvers.solve(scene, quick(method), duration=3e-3)
        assert found.impactor_velocity == approx(exact.impactor_velocity, abs=1e-3)
        assert found.energy["dissipated"] == approx(exact.energy["dissipated"], abs=1e-3 * scene.initial_energy)
        assert found.peak_indentation == approx(exact.peak_indentation, rel=5e-3)
        assert found.residual_indentation == approx(scene.contact.dent(found.peak_indentation))


IMPACTORS = [
    {"kind": "sphere", "radius": 0.02, "material": "steel", "velocity": 1.0},
    {"kind": "rod", "length": 0.2, "section": {"area": 2e-4}, "material": "bronze", "velocity": 1.0},
    FREE,
    FREE | {"at": 0.9},
]


@pytest.mark.parametrize("impactor", IMPACTORS, ids=["sphere", "rod", "beam", "beam-off-centre"])
def test_whatever_strikes(impactor):
    target = STEEL_BEAM | {"support": "pinned-pinned"}
    scene = Scene.from_table({"impactor": impactor, "target": target, "contact": SOFT})
    exact = solvers.solve(scene, Modal(modes=60, estimate=False), duration=1e-3)
    times, x = np.array([3e-4, 9e-4]), np.array([-0.15, -0.03, 0.05, 0.2])
    x = x[x >= 0.0] if impactor["kind"] == "sphere" else x
    for method in ("fe-nodal", "fe-modal"):
        found = solvers.solve(scene, quick(method), duration=1e-3)
        assert found.impactor_velocity == approx(exact.impactor_velocity, abs=5e-4)
        assert found.peak_force == approx(exact.peak_force, rel=2e-3)
        for field in ("displacement", "stress"):
            true = getattr(exact.motion, field)(times, x)
            assert getattr(found.motion, field)(times, x) == approx(true, abs=0.04 * np.abs(true).max())
        stuck = Scene.from_table({"impactor": impactor, "target": {"kind": "stop"}, "contact": SOFT})
        if impactor["kind"] != "sphere":
            assert abs(solvers.solve(stuck, quick(method), duration=1e-3).diagnostics["energy_error"]) < 1e-8


def test_momentum_of_a_free_beam_by_its_own_velocities():
    scene = struck_beam(0.5, SOFT, support="free-free", at=0.7)
    x = np.linspace(0.0, scene.target.length, 2001)
    for method in ("fe-nodal", "fe-modal"):
        motion = solvers.solve(scene, quick(method), duration=1e-3).motion
        times = motion.course.step * motion.course.stride * np.array([100, 400, 800])
        along = np.trapezoid(motion.velocity(times, x), x, axis=1) * scene.target.mass / scene.target.length
        assert along == approx(motion.impulse(times), rel=2e-4)
        # and about the middle: the impact has an arm of 0.2 L
        turning = np.trapezoid(motion.velocity(times, x) * (x - 0.15), x, axis=1) * scene.target.mass / 0.3
        assert turning == approx(0.2 * 0.3 * motion.impulse(times), rel=2e-4)


def test_a_slow_impact_bends_as_a_steady_force_does():
    # so soft that the contact lasts for many periods of the beam: M = F (L - x) towards the clamp, V = -F
    scene = struck_beam(1e-3, {"law": "linear", "stiffness": 1e4})
    assert scene.contact.stiffness < 0.01 * 3.0 * 14175.0 / 0.3**3
    found = solvers.solve(scene, quick("fe-nodal", elements=10), duration=0.6)
    at = np.array([float(found.motion.time[found.motion.force(found.motion.time).argmax()])])
    force, x = float(found.motion.force(at)[0]), np.array([0.0, 0.1, 0.2])
    assert found.motion.moment(at, x)[0] == approx(force * (0.3 - x), rel=0.01)
    assert found.motion.shear(at, x)[0] == approx(np.full(3, -force), rel=0.02)
    assert found.motion.stress(at, x)[0] == approx(-force * (0.3 - x) * 0.015 / 6.75e-8, rel=0.01)  # pulled
    across = struck_beam(1e-3, {"law": "linear", "stiffness": 1e4}, support="pinned-pinned")
    middle = solvers.solve(across, quick("fe-modal", elements=10, modes=6), duration=0.3).motion
    assert np.all(middle.stress(np.array([0.2, 0.3]), np.array([0.15])) > 0.0)  # pressed where it is struck


@settings(max_examples=12, deadline=None)
@given(
    factor=st.floats(-6.0, 6.0).map(lambda exponent: 10.0**exponent),
    ratio=st.floats(-2.0, 2.0).map(lambda exponent: 10.0**exponent),
    at=st.floats(0.1, 0.9),
    support=st.sampled_from(["cantilever", "clamped-clamped", "free-free", "pinned-free"]),
    theory=st.sampled_from(["euler-bernoulli", "timoshenko"]),
    method=st.sampled_from([("fe-nodal", {}), ("fe-modal", {"boundary": "consistent", "modes": 10})]),
)
def test_no_energy_comes_from_nowhere(factor, ratio, at, support, theory, method):
    scene = struck_beam(ratio, {"law": "rigid"}, support=support, at=at, theory=theory)
    chosen = quick(method[0], elements=12, contact_stiffness=factor, steps=3000, **method[1])
    found = solvers.solve(scene, chosen, duration=5e-3)
    course = found.motion.course
    total = sum(course.energies.values())
    assert total == approx(np.full(total.size, scene.initial_energy), rel=1e-8)


def test_a_frozen_status_is_cut_where_it_diverges_and_agrees_where_it_does_not():
    scene = struck_beam(1.0, {"law": "rigid"})
    stiff = {"elements": 15, "contact_stiffness": 100.0, "steps": 2000}
    cut = solvers.solve(scene, "fe-nodal", status="frozen", duration=5e-3, **stiff)
    assert cut.duration < 5e-3
    assert any("grows without bound" in str(note) for note in cut.notes)
    assert "NaN" not in json.dumps(cut.table()) and "Infinity" not in json.dumps(cut.table())
    calm = solvers.solve(scene, quick("fe-nodal", **stiff), duration=5e-3)
    assert abs(calm.diagnostics["energy_error"]) < 1e-10
    short = {"elements": 15, "steps": 4000}
    both = [solvers.solve(scene, quick("fe-nodal", status=s, **short), duration=9e-5) for s in ("frozen", "implicit")]
    assert both[0].impactor_velocity == approx(both[1].impactor_velocity, abs=1e-5)


def test_impacts_end_where_beams_turn_away():
    for beam in ({"support": "free-free", "at": 1.0}, {"support": "pinned-free"}):
        scene = struck_beam(1.0, SOFT, **beam)
        for method in ("fe-nodal", "fe-modal"):
            found = solvers.solve(scene, quick(method))
            assert found.motion.course.end is End.PARTED
            assert found.duration < 5.0 * scene.time_unit


def test_the_estimate_is_of_the_size_of_the_error():
    for beam in ({}, {"theory": "timoshenko"}, {"support": "free-free"}):
        scene = struck_beam(1.0, SOFT, **beam)
        true = solvers.solve(scene, Modal(modes=80, estimate=False), duration=1e-3).impactor_velocity
        for method in ("fe-nodal", "fe-modal"):
            found = solvers.solve(scene, method, elements=20, duration=1e-3)
            error = abs(found.impactor_velocity - true)
            assert error < 3.0 * found.diagnostics["estimated_error"] + 1e-6


@pytest.mark.parametrize("elements", [1, 2, 3])
def test_the_coarsest_meshes(elements):
    for support in ("cantilever", "pinned-pinned", "clamped-clamped", "free-free", "pinned-free"):
        for law in (SOFT, {"law": "rigid"}):
            scene = struck_beam(1.0, law, support=support)
            for method in ("fe-nodal", "fe-modal"):
                if (elements, support, law["law"], method) == (1, "clamped-clamped", "rigid", "fe-modal"):
                    continue  # see below
                found = solvers.solve(scene, method, elements=elements, duration=5e-4)
                assert abs(found.diagnostics["energy_error"]) < 1e-10
    # two elements between clamps have one mode that an impact in the middle moves, and must leave it out to give way
    light = struck_beam(1e5, {"law": "rigid"}, support="clamped-clamped")
    if elements == 1:
        return  # refused, see below
    found = solvers.solve(light, quick("fe-modal", elements=elements))
    assert abs(found.diagnostics["energy_error"]) < 1e-10
    assert found.impactor_velocity == approx(-1.0, abs=0.05)


@pytest.mark.parametrize("length", [0.3, 0.4])
def test_one_element_clamped_at_both_ends_leaves_no_mode_that_gives_way(length):
    scene = struck_beam(1.0, {"law": "rigid"}, support="clamped-clamped", length=length)
    with pytest.raises(SceneNotSupported, match="2 elements or more"):
        solvers.solve(scene, "fe-modal", elements=1)
    for options in ({"elements": 1, "boundary": "consistent"}, {"elements": 2}, {"elements": 3}):
        found = solvers.solve(scene, "fe-modal", **options)  # and its estimate, from no fewer than 2
        assert found.impactor_velocity < 0.0


def test_what_is_refused():
    damped = struck_beam(damping=0.01)
    for method in ("fe-nodal", "fe-modal"):
        with pytest.raises(SceneNotSupported, match="damping"):
            solvers.solve(damped, method)
    with pytest.raises(SceneNotSupported, match="newmark"):
        solvers.solve(struck_beam(), "fe-nodal", scheme="central-difference")
    with pytest.raises(SceneError) as caught:
        solvers.solve(struck_beam(), "fe-modal", modes=0)
    assert caught.value.key == "method.modes"


def test_what_a_rigid_contact_is_reported_to_be():
    scene = struck_beam(1.0, {"law": "rigid"})
    nodal = solvers.solve(scene, quick("fe-nodal", elements=15), duration=2e-3)
    assert any("1.77e+09 N/m" in str(note) for note in nodal.notes)  # E I / l^3
    modal = solvers.solve(scene, quick("fe-modal"), duration=2e-3)
    assert not any("local stiffness" in str(note) for note in modal.notes)
    assert STEEL_ROD_MASS * (1.0 - modal.impactor_velocity) == approx(modal.impulse, rel=1e-9)


@pytest.mark.parametrize("support, at", [("free-free", 0.5), ("free-free", 0.9), ("pinned-free", 1.0)])
@pytest.mark.parametrize("stiffness", [1e3, 1e5])
def test_a_soft_impact_that_carries_a_beam_far_keeps_its_energy(support, at, stiffness):
    scene = struck_beam(1.0, {"law": "linear", "stiffness": stiffness}, support=support, at=at)
    found = solvers.solve(scene, quick("fe-nodal", elements=100))
    course = found.motion.course
    total = sum(course.energies.values())
    assert total == approx(np.full(total.size, scene.initial_energy), rel=1e-10)
    assert abs(found.diagnostics["momentum_error"]) < 1e-10
    x = np.linspace(0.0, 0.3, 9)
    moved = found.motion.displacement(np.array([found.duration]), x)[0]
    assert np.abs(moved).max() > 0.01 * (1e3 / stiffness) ** 0.5  # as a whole, far beyond what it bends
