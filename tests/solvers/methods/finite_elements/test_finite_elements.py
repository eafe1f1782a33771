"""The methods `fe-nodal` and `fe-modal`: against the exact waves, the accounts, options and refusals."""

import json
from dataclasses import replace

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import Modal, Scene, SceneError, SceneNotSupported
from solvers.methods.estimates import error_left
from tests.catalog import STEEL_ROD, STEEL_ROD_MASS, T, contact_table, struck_rod

VARIANTS = [
    ("fe-nodal", {}),
    ("fe-nodal", {"scheme": "central-difference"}),
    ("fe-modal", {}),
    ("fe-modal", {"scheme": "newmark"}),
    ("fe-modal", {"boundary": "consistent"}),
]
IDS = ["newmark", "explicit", "massless", "massless-newmark", "20-modes"]


def l2_error(solution, exact) -> float:
    times = np.linspace(0.0, 2.3 * exact.scene.time_unit, 3000)
    found, true = solution.motion.force(times), exact.motion.force(times)
    return float(np.sqrt(np.sum((found - true) ** 2) / np.sum(true**2)))


@pytest.mark.parametrize("method, options", VARIANTS, ids=IDS)
@pytest.mark.parametrize("support", ["fixed", "free"])
def test_accounts_balance(method, options, support):
    scene = struck_rod(support=support)
    solution = solvers.solve(scene, method, **options)
    explicit = options.get("scheme") == "central-difference"
    # only the explicit scheme keeps another energy than the true one, off by (step * frequency)^2
    assert abs(solution.diagnostics["energy_error"]) < (2e-3 if explicit else 1e-10)
    assert abs(solution.diagnostics["momentum_error"]) < 1e-9
    assert sum(contact.impulse for contact in solution.contacts) == approx(solution.impulse, rel=1e-9)
    at_rows = solution.motion.course.step * solution.motion.course.stride * np.arange(0, 500, 7)
    at_rows = at_rows[at_rows <= solution.duration]
    face = solution.motion.displacement(at_rows, np.array([0.0]))[:, 0]
    # the modes left out have given way too: 0.2 to 0.4 % of 2 v T when the field was without them
    assert face == approx(solution.motion.end_position(at_rows), abs=1e-11 * scene.speed * scene.time_unit)
    json.dumps(solution.table())


SLIM_BRONZE = {
    "length": 0.5,
    "section": {"radius": 0.012},
    "material": {"young": 98e9, "density": 8800.0, "poisson": 0.34},
}
STOCKY_STEEL = {key: STEEL_ROD[key] for key in ("length", "section", "material")}


@pytest.mark.parametrize(
    "method, options",
    [*VARIANTS, ("fe-nodal", {"status": "frozen"})],
    ids=[*IDS, "frozen"],
)
def test_it_does_not_matter_who_strikes(method, options):
    """Peak 20 311 against 15 590 N when the local stiffness of a rigid contact was that of the target's element."""

    def strike(first, second):
        impactor, target = first | {"kind": "rod", "velocity": 1.0}, second | {"kind": "rod", "support": "free"}
        scene = Scene.from_table({"impactor": impactor, "target": target})
        return solvers.solve(scene, quick(method, elements=40, **options), duration=1e-3)

    one, other = strike(SLIM_BRONZE, STOCKY_STEEL), strike(STOCKY_STEEL, SLIM_BRONZE)
    assert one.peak_force == approx(other.peak_force, rel=1e-9)
    assert one.impulse == approx(other.impulse, rel=1e-9)
    assert one.contacts[0].end == approx(other.contacts[0].end, rel=1e-9)


def quick(method: str, **options):
    """The method without its estimate of the error, which costs as much again."""
    return replace(solvers.METHODS[method].read(options), estimate=False)


@pytest.mark.parametrize("mass_ratio", [0.25, 1.0, 2.0])
@pytest.mark.parametrize("method, options", VARIANTS, ids=IDS)
def test_rebound_tends_to_that_of_the_waves(method, options, mass_ratio):
    exact = solvers.solve(struck_rod(mass_ratio), "waves").impactor_velocity
    fine = options | ({"elements": 200, "modes": 60} if "boundary" in options else {"elements": 200})
    errors = [
        abs(solvers.solve(struck_rod(mass_ratio), quick(method, **chosen)).impactor_velocity - exact)
        for chosen in (options | {"elements": 50}, fine)
    ]
    assert errors[0] < 0.04
    assert errors[1] < 0.01


@pytest.mark.parametrize("mass_ratio, elements", [(1.0, 50), (1.0, 100), (0.8, 100), (0.8, 200)])
def test_a_massless_boundary_shows_the_two_contacts_there_are(mass_ratio, elements):
    scene = struck_rod(mass_ratio)
    exact = solvers.solve(scene, "waves")
    solution = solvers.solve(scene, "fe-modal", elements=elements)
    assert solution.diagnostics["raw_contacts"] == len(solution.contacts) == len(exact.contacts) == 2
    # dispersion spreads a front over elements^(1/3) of them; the square of the error is that width over the length
    assert l2_error(solution, exact) < elements ** (-1.0 / 3.0)
    for found, true in zip(solution.contacts, exact.contacts, strict=True):
        assert found.start == approx(true.start, abs=0.015 * T)
        assert found.end == approx(true.end, abs=0.015 * T)
    assert not any("chatters" in str(note) for note in solution.notes)


def test_the_neighbouring_stiffness_chatters_and_says_so():
    solution = solvers.solve(struck_rod(), "fe-nodal")
    assert solution.diagnostics["raw_contacts"] > len(solution.contacts)
    assert any("chatters" in str(note) for note in solution.notes)
    assert any("local stiffness" in str(note) for note in solution.notes)


THREE = pytest.mark.parametrize(
    "method, options", [VARIANTS[0], VARIANTS[1], VARIANTS[4]], ids=["newmark", "explicit", "modes"]
)


@pytest.mark.parametrize("law", ["hertz", "hunt-crossley", "plastic-power"])
@THREE
def test_laws_elastic_lossy_and_with_memory(method, options, law):
    scene = struck_rod(contact=contact_table(law))
    memory = scene.contact.PLASTIC  # the waves know none
    exact = solvers.solve(scene, Modal(modes=200, estimate=False) if memory else "waves")
    found = solvers.solve(scene, quick(method, **options))
    assert found.impactor_velocity == approx(exact.impactor_velocity, abs=2e-4)
    assert found.energy["dissipated"] == approx(exact.energy["dissipated"], abs=2e-4 * scene.initial_energy)
    assert found.peak_force == approx(exact.peak_force, rel=5e-3)
    assert found.peak_indentation == approx(exact.peak_indentation, rel=5e-3)
    assert found.residual_indentation == approx(scene.contact.dent(found.peak_indentation))


@pytest.mark.parametrize("law", ["hertz", "hunt-crossley", "plastic-linear"])
@pytest.mark.parametrize("method, options", VARIANTS, ids=IDS)
def test_contacts_end_inside_a_step(method, options, law):
    scene, steps = struck_rod(contact=contact_table(law)), 1000
    coarse, fine = (solvers.solve(scene, method, elements=50, steps=n * steps, **options) for n in (1, 8))
    assert len(coarse.contacts) == len(fine.contacts) == 1
    assert coarse.contacts[0].end == approx(fine.contacts[0].end, abs=0.1 * coarse.duration / steps)


def test_modal_and_nodal_are_one_mesh():
    scene = struck_rod(contact=contact_table("linear"))
    nodal = solvers.solve(scene, "fe-nodal", elements=30, steps=20_000, duration=3.0 * T)
    modal = solvers.solve(
        scene, "fe-modal", elements=30, modes=30, boundary="consistent", steps=20_000, duration=3.0 * T
    )
    assert nodal.impactor_velocity == approx(modal.impactor_velocity, abs=1e-6)
    both = solvers.solve(
        scene, "fe-modal", elements=30, modes=30, boundary="consistent", scheme="newmark", steps=2000, duration=3.0 * T
    )
    same = solvers.solve(scene, "fe-nodal", elements=30, steps=2000, duration=3.0 * T)
    assert both.impactor_velocity == approx(same.impactor_velocity, rel=1e-9)  # one scheme in two sets of coordinates


def test_stress_and_velocity_behind_the_front():
    scene = struck_rod()
    rod, times = scene.target, np.array([0.3 * T])
    for method in ("fe-nodal", "fe-modal"):
        motion = solvers.solve(scene, quick(method, elements=150)).motion
        exact = solvers.solve(scene, "waves").motion
        x = np.linspace(0.1, 0.25, 40) * rod.length  # behind the front, which is at 0.6 of the length
        assert motion.stress(times, x).mean() == approx(exact.stress(times, x).mean(), rel=0.02)
        assert motion.velocity(times, x).mean() == approx(exact.velocity(times, x).mean(), rel=0.02)
        assert abs(motion.stress(times, np.array([0.9 * rod.length]))[0, 0]) < 0.05 * rod.material.young * 2e-4


def test_rods_masses_walls_and_chains():
    steel = {"area": 9e-4}
    rod = {"kind": "rod", "length": 0.2, "section": steel, "material": "steel", "velocity": 1.0}
    other = {"kind": "rod", "length": 0.3, "section": steel, "material": "steel", "support": "free"}
    half = {key: STEEL_ROD[key] for key in ("section", "material")} | {"length": 0.15}
    chain = {"impactor": {"mass": STEEL_ROD_MASS, "velocity": 1.0}, "target": {"kind": "rods", "rods": [half, half]}}
    for method in ("fe-nodal", "fe-modal"):
        impact = solvers.solve(Scene.from_table({"impactor": rod, "target": other}), method)
        assert impact.impactor_velocity == approx(0.0, abs=0.02)  # (4.7): the shorter rod stops
        assert impact.target_velocity == approx(2.0 / 3.0, abs=0.02)
        wall = solvers.solve(Scene.from_table({"impactor": rod, "target": {"kind": "stop"}}), method)
        assert wall.impactor_velocity == approx(-1.0, abs=0.01)
        both = solvers.solve(Scene.from_table(chain), method, elements=40).impactor_velocity
        assert both == approx(solvers.solve(struck_rod(), method, elements=40).impactor_velocity, rel=1e-8)


def test_a_frozen_status_is_cut_where_it_diverges():
    scene = struck_rod()
    options = {"elements": 20, "status": "frozen", "contact_stiffness": 100.0}
    solution = solvers.solve(scene, "fe-nodal", steps=400, duration=4e-4, **options)
    assert solution.duration < 4e-4
    assert any("grows without bound" in str(note) for note in solution.notes)
    assert "NaN" not in json.dumps(solution.table()) and "Infinity" not in json.dumps(solution.table())
    calm = solvers.solve(scene, "fe-nodal", steps=400, duration=4e-4, elements=20, contact_stiffness=100.0)
    assert calm.impactor_velocity == approx(-0.7, abs=0.05)
    assert abs(calm.diagnostics["energy_error"]) < 1e-10


def test_more_than_the_explicit_limit_is_refused():
    with pytest.raises(SceneError, match="explicit") as caught:
        solvers.solve(struck_rod(), "fe-nodal", scheme="central-difference", steps=100, duration=3.0 * T)
    assert caught.value.key == "method.steps"


def test_the_estimate_is_of_the_size_of_the_error():
    for method in ("fe-nodal", "fe-modal"):
        for mass_ratio in (0.25, 1.0, 5.0):
            scene = struck_rod(mass_ratio)
            error = abs(
                solvers.solve(scene, method).impactor_velocity - solvers.solve(scene, "waves").impactor_velocity
            )
            assert error < 3.0 * solvers.solve(scene, method).diagnostics["estimated_error"] + 1e-3


@pytest.mark.parametrize("method, options", VARIANTS, ids=IDS)
def test_an_impact_too_short_for_the_mesh_gets_a_note_and_a_long_one_is_followed(method, options):
    short = solvers.solve(struck_rod(1e4), method, **options)
    assert short.diagnostics["estimated_error"] >= 1.0
    long = solvers.solve(struck_rod(1e-6), method, **options)
    assert long.impactor_velocity == approx(-1.0, abs=2e-3)
    assert abs(long.diagnostics["energy_error"]) < 1e-3


@pytest.mark.parametrize(
    "method, options, key",
    [
        ("fe-nodal", {"elements": 0}, "method.elements"),
        ("fe-nodal", {"elements": 1e3}, "method.elements"),
        ("fe-nodal", {"scheme": "exact"}, "method.scheme"),
        ("fe-nodal", {"status": "late"}, "method.status"),
        ("fe-nodal", {"status": "frozen", "scheme": "central-difference"}, "method.status"),
        ("fe-nodal", {"contact_stiffness": 0.0}, "method.contact_stiffness"),
        ("fe-nodal", {"modes": 5}, "method.modes"),
        ("fe-modal", {"modes": -1}, "method.modes"),
        ("fe-modal", {"boundary": "soft"}, "method.boundary"),
        ("fe-modal", {"status": "frozen"}, "method.status"),
        ("fe-modal", {"steps": 3}, "method.steps"),
    ],
)
def test_options_out_of_range(method, options, key):
    with pytest.raises(SceneError) as caught:
        solvers.solve(struck_rod(), method, **options)
    assert caught.value.key == key


def test_what_has_no_elements_is_refused():
    masses = {"impactor": {"mass": 1.0, "velocity": 1.0}, "target": {"kind": "mass", "mass": 2.0}}
    endless = {"impactor": {"mass": 1.0, "velocity": 1.0}, "target": STEEL_ROD | {"support": "anechoic"}}
    for table, words in ((masses, "divided into elements"), (endless, "waves")):
        for method in ("fe-nodal", "fe-modal"):
            with pytest.raises(SceneNotSupported, match=words):
                solvers.solve(Scene.from_table(table), method)
    with pytest.raises(SceneNotSupported, match="implicit"):
        solvers.solve(struck_rod(contact=contact_table("hertz")), "fe-nodal", status="frozen")


@pytest.mark.parametrize("order", [0.7, 1.0, 2.0])
def test_what_is_left_of_an_error_of_a_known_order(order):
    shares = (1 / 3, 1 / 2, 1.0, 2.0)
    differences = [(share, 1e-3 * (1.0 - share**-order)) for share in shares]
    assert error_left(differences, order) == approx(1e-3, rel=1e-12)
    assert error_left([(share, -difference) for share, difference in differences], order) == approx(1e-3, rel=1e-12)
    assert error_left([(1.0, 0.0)], order) == 0.0


def test_two_answers_that_agree_by_chance_hide_no_error():
    assert error_left([(1 / 2, 1e-6), (1 / 3, -1e-3)], 1.0) > 3e-4
    scene = struck_rod(2.52, "free")  # its error is nearly the same with 50 and with 100 elements
    found = solvers.solve(scene, "fe-modal")
    error = abs(found.impactor_velocity - solvers.solve(scene, "waves").impactor_velocity)
    assert error / 4.0 < found.diagnostics["estimated_error"] < 4.0 * error


def test_momentum_is_that_of_the_last_instant_where_the_steps_run_out():
    scene = struck_rod(1.0, "free", {"law": "linear", "stiffness": 0.1})  # touches for longer than it is followed
    found = solvers.solve(scene, quick("fe-nodal", elements=40))
    assert any(f"limit of {found.motion.course.steps} steps" in str(note) for note in found.notes)
    assert abs(found.diagnostics["momentum_error"]) < 1e-10
    assert abs(found.diagnostics["energy_error"]) < 1e-11


@pytest.mark.parametrize("law", ["kelvin-voigt", "hunt-crossley", "lee-wang"])
def test_a_damped_law_too_stiff_for_the_step_is_solved_and_warned_of(law):
    """Its force may be nowhere positive: they part in the step in which they touch."""
    contact = {"law": law, "stiffness": 1e18, "restitution": 0.2}
    if law == "lee-wang":
        contact["exponent"] = 1.5
    scene = struck_rod(100.0, "free").replace({"contact": contact, "method": {"name": "fe-nodal", "elements": 20}})
    found = solvers.solve(scene)
    assert np.isfinite(found.impactor_velocity) and found.notes
